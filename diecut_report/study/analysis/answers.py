"""Answers to questions as CSV, JSON and XLSX: in SI or in the units that people read, with the signs that a firm's spreadsheet takes."""

from __future__ import annotations

import csv
import io
import json
import math
import shutil
import sys
from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report import pipeline
from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.formulas import Array
from diecut_report.quantities.units import unit
from diecut_report.report.text import number
from diecut_report.results.checks import NOT_CHECKED
from diecut_report.results.conclusion import governing
from diecut_report.results.origins import MOVES
from diecut_report.study.analysis.query import Question, Request, Row, question
from diecut_report.study.analysis.variant_config import variant_of
from diecut_report.study.analysis.variants import FIXED, Stored, StoredColumn, opened, text
from diecut_report.study.definition.base_inputs import Input, UnknownPath, find_input
from diecut_report.study.execution.press_batch import CalculatedVariants, Mixed, NotOnArrays, calculated
from diecut_report.study.execution.variant_rows import verdicts
from diecut_report.study.storage.spreadsheets import SHEET_COLUMNS, SHEET_ROWS, workbook
from diecut_report.study.storage.state import continuing, read_state
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted, spoken_language

SEPARATORS = {"comma": ",", "semicolon": ";", "tab": "\t"}
DECIMALS = {"point": ".", "comma": ","}
UNITS = ("si", "display")
BLOCK = 1 << 16  # letters that are given at a time
MOST_COMPARED = 1_000  # variants side by side


@dataclass(frozen=True)
class Notation:
    """Say how values are written: in SI or in the units that people read, and with which signs between them and within them."""

    units: str = "si"
    separator: str = "comma"
    decimal: str = "point"

    def __post_init__(self) -> None:
        for given, allowed in ((self.units, UNITS), (self.separator, SEPARATORS), (self.decimal, DECIMALS)):
            if given not in allowed:
                raise UserError(
                    Problem(
                        Phrase(
                            "{given} is not known here; allowed: {allowed}.",
                            given=repr(given),
                            allowed=", ".join(allowed),
                        )
                    )
                )
        if self.separator == self.decimal == "comma":
            words = phrase("A comma cannot part both values and decimals; add --separator semicolon, or tab.")
            raise UserError(Problem(words))

    def unit_of(self, column: StoredColumn) -> str:
        """Return the unit that the column's values are written in."""
        return column.unit if self.units == "si" or not column.is_number else column.display

    def head(self, column: StoredColumn) -> str:
        """Return the column's name with its unit, as tables of a study have it."""
        own = self.unit_of(column)
        return column.name if own == "1" else f"{column.name} [{own}]"

    def value(self, value: Any, column: StoredColumn) -> Any:
        """Return a stored value in the unit that it is written in; 15 digits, so that the conversion leaves no noise."""
        if not isinstance(value, float) or self.unit_of(column) == column.unit:
            return value
        return float(f"{unit(column.display).from_si(value):.15g}")

    def text(self, value: Any) -> str:
        """Return a value as a cell of a CSV file holds it."""
        if isinstance(value, bool):
            return str(value).lower()
        if isinstance(value, float):
            return repr(value).replace(".", DECIMALS[self.decimal])
        return "" if value is None else str(value)


SI = Notation()


def csv_text(heads: Sequence[Any], rows: Iterator[Sequence[Any]], notation: Notation) -> Iterator[str]:
    """Yield rows as CSV, some at a time."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, delimiter=SEPARATORS[notation.separator], lineterminator="\n")
    writer.writerow(heads)
    for row in rows:
        writer.writerow(map(notation.text, row))
        if buffer.tell() > BLOCK:
            yield _emptied(buffer)
    yield _emptied(buffer)


def _emptied(buffer: io.StringIO) -> str:
    text = buffer.getvalue()
    buffer.seek(0)
    buffer.truncate()
    return text


def written(stored: Stored, question: Question, notation: Notation) -> Iterator[list[Any]]:
    """Yield the variants with their values as they are written."""
    columns = question.columns
    for row in question.rows(stored):
        yield [notation.value(value, column) for value, column in zip(row, columns, strict=True)]


def as_csv(stored: Stored, question: Question, notation: Notation) -> Iterator[str]:
    """Yield a line for each variant, units in the header, as a study reads its tables."""
    return csv_text(
        [notation.head(column) for column in question.columns], written(stored, question, notation), notation
    )


def as_json(stored: Stored, question: Question, notation: Notation) -> Iterator[str]:
    """Yield an object for each variant, with the units of the columns before them."""
    names = [column.name for column in question.columns]
    numbers = [column for column in question.columns if column.name not in FIXED and column.is_number]
    units = {column.name: notation.unit_of(column) for column in numbers}
    yield f'{{"units": {json.dumps(units, ensure_ascii=False)},\n "variants": ['
    before = "\n  "
    for row in written(stored, question, notation):
        yield before + json.dumps(dict(zip(names, map(_finite, row), strict=True)), ensure_ascii=False, allow_nan=False)
        before = ",\n  "
    yield "]}\n"


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def as_workbook(stored: Stored, question: Question, notation: Notation) -> bytes:
    """Return a workbook with a row for each variant; UserError where a sheet cannot hold them."""
    rows = [[_finite(value) for value in row] for row in islice(written(stored, question, notation), SHEET_ROWS)]
    if len(rows) == SHEET_ROWS or len(question.columns) > SHEET_COLUMNS:
        words = Phrase(
            "A sheet holds {sheet_rows} variants and {sheet_columns} columns; ask for fewer (--where, "
            "--top, --columns), or for csv.",
            sheet_rows=SHEET_ROWS - 1,
            sheet_columns=SHEET_COLUMNS,
        )
        raise UserError(Problem(words))
    return workbook({say("variants"): [[notation.head(column) for column in question.columns], *rows]})


def side_by_side(stored: Stored, question: Question, notation: Notation) -> tuple[list[Any], list[list[Any]]]:
    """Return the variants as columns: a head, and for each quantity its name, its unit and the values.

    UserError where there are more variants than anybody compares.
    """
    rows: list[Row] = list(islice(question.rows(stored), MOST_COMPARED + 1))
    if len(rows) > MOST_COMPARED:
        words = Phrase(
            "More than {most_compared} variants cannot stand side by side; choose some with --pick, --where or --top.",
            most_compared=MOST_COMPARED,
        )
        raise UserError(Problem(words))
    lines = [
        [column.name, "" if notation.unit_of(column) == "1" else notation.unit_of(column),
         *(_finite(notation.value(row[index], column)) for row in rows)]
        for index, column in enumerate(question.columns)
    ]  # fmt: skip
    variant = next(line for line in lines if line[0] == "variant")
    return ["quantity", "unit", *variant[2:]], [line for line in lines if line is not variant]


# Questions to the stored variants: which fulfil a condition, the best first, as a table, CSV, JSON or a workbook.


FORMATS = ("table", "csv", "json")


def variants(
    directory: Path,
    where: str | None = None,
    sort: str | None = None,
    top: int | None = None,
    format: str = "table",
    columns: Sequence[str] | None = None,
    width: int | None = None,
) -> Generator[str, None, None]:
    """Yield the answer in pieces of text: a ``table`` for people (in the units that they read), ``csv`` or ``json`` (SI, all columns).

    ``sort`` names columns, parted by commas, with - for the greatest first; without ``columns`` a table shows the varied
    quantities and what the question names. UserError in words for what cannot be asked.
    """
    yield from answer(directory, Request(where, sort, top, columns), format, width=width)


def answer(
    directory: Path,
    asked: Request,
    format: str = "table",
    notation: Notation = SI,
    *,
    transposed: bool = False,
    width: int | None = None,
) -> Generator[str, None, None]:
    """Yield the answer in pieces of text; with ``transposed`` a line for each quantity and a column for each variant.

    A table that compares variants leaves out what is the same for all, and says how much that is, unless the columns are named.
    """
    if format not in FORMATS:
        raise UserError(
            Problem(
                Phrase(
                    "{format} is not a format of variants; known: {formats}.",
                    format=repr(format),
                    formats=", ".join(FORMATS),
                )
            )
        )
    if transposed and format == "json":
        raise UserError(
            Problem(phrase("JSON names each value, so that it has no rows to transpose; ask for table, csv or xlsx."))
        )
    with opened(directory) as stored:
        found = question(stored, asked, is_table=format == "table" and not transposed)
        if transposed and format == "csv":
            yield from csv_text(*_rows_of(stored, found, notation), notation)
        elif transposed:
            yield _compared(stored, found, asked, width)
        elif format == "table":
            yield from _table(stored, found, width)
        else:
            yield from {"csv": as_csv, "json": as_json}[format](stored, found, notation)


def answer_workbook(directory: Path, asked: Request, notation: Notation = SI, *, transposed: bool = False) -> bytes:
    """Return the answer as a workbook (XLSX); UserError in words for what cannot be asked."""
    with opened(directory) as stored:
        found = question(stored, asked, is_table=False)
        if not transposed:
            return as_workbook(stored, found, notation)
        (_, _, *numbers), lines = side_by_side(stored, found, notation)
        return workbook({say("variants"): [[say("quantity"), say("unit"), *numbers], *lines]})


def unfinished(directory: Path) -> Iterator[str]:
    """Return a warning where a study is not calculated to its end: its best variant may still come."""
    state = read_state(directory)
    if state.get("state") != "complete":
        parts, rows, chunk = len(list((directory / "variants").glob("part-*.parquet"))), state["rows"], state["chunk"]
        yield (
            Phrase(
                "This study is not finished: {parts} of {all} parts are calculated. Go on with: {continued}",
                parts=parts,
                all=-(-rows // chunk),
                continued=continuing(directory, state["columns"]),
            )
        )


def _rows_of(stored: Stored, asked: Question, notation: Notation) -> tuple[list[object], Iterator[list[object]]]:
    head, lines = side_by_side(stored, asked, notation)
    return head, iter(lines)


def _table(stored: Stored, asked: Question, width: int | None) -> Iterator[str]:
    """A table for people, and how many variants there are."""
    from diecut_report.study.analysis.variants import table_text

    rows = list(asked.rows(stored))
    found, without = table_text(asked.columns, rows, width or _terminal())
    yield f"{found}\n{_counted(stored, asked, len(rows))}\n"
    if without:
        words = "No room on a line for: {columns} (--columns names some, --format csv has them all)."
        yield say(words, columns=", ".join(column.name for column in without)) + "\n"


def _compared(stored: Stored, found: Question, asked: Request, width: int | None) -> str:
    from diecut_report.study.analysis.variants import compared_text

    rows = list(found.rows(stored))
    text, equal = compared_text(found.columns, rows, width or _terminal(), keep_equal=asked.columns is not None)
    words = say_counted(len(rows), "{n} variant", "{n} variants")
    if equal:
        words += say_counted(
            equal,
            "; {n} quantity that is the same for all is left out (--columns, --format csv)",
            "; {n} quantities that are the same for all are left out (--columns, --format csv)",
        )
    return f"{text}\n{words}.\n"


def _terminal() -> int | None:
    """How many letters a line of the terminal has; nothing where the answer goes elsewhere."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def _counted(stored: Stored, asked: Question, given: int) -> str:
    sql = f"SELECT count(*) FILTER ({asked.where}), count(*) FROM v"
    found, total = stored.rows(sql, asked.condition.parameters)[0]
    sign = decimal_sign()
    of_all = Counted(
        total,
        "{found} of {n} variant",
        "{found} of {n} variants",
        found=number(str(found), sign),
        n=number(str(total), sign),
    )
    words = of_all if asked.condition.sql == "true" else Phrase("Fulfilling the condition: {count}", count=of_all)
    shown = Phrase("{words}; {given} are shown (--top, --format csv).", words=words, given=given)
    return said(shown if given < found else Phrase("{words}.", words=words))


__all__ = ["FORMATS", "answer", "answer_workbook", "unfinished", "variants"]


# How much the assumed values of a config matter: each is varied by a tenth, all at once, and the governing checks are looked at.


Data = Mapping[str, Any]
SHARE = 0.1  # of a value, downwards and upwards


def moves(config: Config, results: Data) -> list[dict[str, Any]]:
    """Return the assumed values that move a governing check of a mechanism: path, check and change of its utilisation.

    Mechanisms whose plugin cannot take arrays are left out, with those that refer to them.
    """
    varied = {path: found for path in results["summary"]["assumed"] if (found := _number(config, path))}
    names = _governing(results)
    if not varied or not names:
        return []
    try:
        made = _calculated(config, dict(_columns(list(varied.values()))), 1 + 2 * len(varied))
    except (NotOnArrays, Mixed):  # not of one mechanism that could be left out: the order is that of the file
        return []
    try:
        return list(_moved(made, list(varied), names))
    finally:
        made.release()


def _calculated(config: Config, values: dict[Input, Array], count: int) -> CalculatedVariants:
    """All variants of what can be calculated together; the others are as if their plugins were broken."""
    left_out: dict[str, PluginError] = dict(config.broken)
    while True:
        try:
            return calculated(replace(config, broken=left_out), dict(values), count)
        except NotOnArrays as fault:
            names = [name for name, kind in config.kinds.items() if kind == fault.kind and name not in left_out]
            if not names:
                raise
            left_out |= {name: PluginError(fault.message, fault.kind, name) for name in names}


def _number(config: Config, path: str) -> tuple[Input, float] | None:
    """An input with its value in the file; None for what is not a single number there (also words, and a time in place of an angle), and
    for whole numbers, which have no tenth.
    """
    try:
        asked = find_input(config, path)
    except UnknownPath:
        return None
    instance = config.instances[asked.instance]
    if instance is None or (asked.instance, *asked.key) in config.links or asked.unit is None or asked.is_integer:
        return None
    value = instance.value(asked.key)
    return (asked, float(value)) if isinstance(value, int | float) else None


def _columns(varied: list[tuple[Input, float]]) -> Iterator[tuple[Input, Array]]:
    """A column for each input: the first row is the config itself, then two rows for each input."""
    for index, (asked, value) in enumerate(varied):
        column = np.full(1 + 2 * len(varied), value)
        column[1 + 2 * index : 3 + 2 * index] *= (1 - SHARE, 1 + SHARE)
        yield asked, column


def _governing(results: Data) -> list[str]:
    """The governing check of each mechanism, the press's first."""
    found = [governing({name: data}) for name, data in results["mechanisms"].items()]
    whole = [results.get("governing"), *found]
    return list(dict.fromkeys(f"{each['mechanism']}.checks.{each['check']}" for each in whole if each))


def _moved(made: CalculatedVariants, paths: list[str], names: list[str]) -> Iterator[dict[str, Any]]:
    found = verdicts(made.calculations, made.count)
    rows = {name: index for index, name in enumerate(found.names)}
    known = [name for name in names if name in rows]
    for index, path in enumerate(paths):
        at = [1 + 2 * index, 2 + 2 * index]
        changes = {name: _change(found.ratios[rows[name]], at) for name in known}
        name = max(changes, key=lambda each: changes[each], default="")
        if name and changes[name] > MOVES:
            yield {"path": path, "check": name.replace(".checks.", "."), "change": float(f"{changes[name]:.6g}")}


def _change(utilisation: Array, at: list[int]) -> float:
    """The greatest change of a utilisation; a machine that cannot be any more is changed most."""
    changes = np.abs(utilisation[at] - utilisation[0])
    return 0.0 if math.isnan(utilisation[0]) else float(np.where(np.isnan(changes), 1.0, changes).max())


# What a strict judge counts as failed in a study: variants that warn, and checks that are not made.


def is_doubtful(folder: Path) -> bool:
    """Return whether a stored variant warns, or a check of one is not made; one that cannot exist does not count."""
    with opened(folder) as stored:
        columns = (status.sql for _, status in stored.checks.values())
        asked = " OR ".join(["status = 'warn'", *(f"{column} = {text(NOT_CHECKED)}" for column in columns)])
        ((count,),) = stored.rows(f"SELECT count(*) FROM v WHERE status <> 'error' AND ({asked})")
    return bool(count)


# Numbers that differ by rounding alone.


DIGITS = 10


def rounded(values: Array) -> Array:
    """Return the values to ten digits, so that nothing is better than another by rounding."""
    sizes = np.abs(np.where(np.isfinite(values) & (values != 0), values, 1.0))
    unit = 10.0 ** (np.floor(np.log10(sizes)) + 1 - DIGITS)
    found: Array = np.where(np.isfinite(values), np.round(values / unit) * unit, values)
    return found


# Why variants cannot be calculated, in the language that is spoken: what is stored of it is English.


def told_reason(stored: Stored, variant: int, reason: str, discovery: Discovery) -> str:
    """Return the stored reason of a variant in the language that is spoken.

    The variant is judged once more by itself, so that the words know what they were made of. Where that says something else, or
    the base is not kept any more, the reason stands as it is stored.
    """
    if spoken_language() == SOURCE_LANGUAGE or stored.description.base.content is None:
        return reason
    try:
        pipeline.validate(variant_of(stored, variant, discovery, str(variant), in_error=True), discovery)
    except UserError as error:
        for problem in (replace(each, file="", line=None, column=None) for each in error.problems):
            if str(problem) == reason:
                return localised(said(str(problem)))
    except PluginError:  # it is told where it broke
        return reason
    return reason


# First and total Sobol indices from the rows of a `SobolIndices` sample.


SOURCE = phrase(
    "first order: Saltelli et al. 2010, Computer Physics Communications 181, 259–270, table 2 (b); "
    "total: Jansen 1999, Computer Physics Communications 117, 35–43 (table 2 (f) there)"
)


@dataclass(frozen=True)
class Indices:
    """Hold what part of the variance of a quantity the inputs cause, in the order of the sample's paths.

    `first` is the part that an input causes alone, `total` the part in which it takes part at all. Both are estimates
    and may lie a little outside 0 … 1. `points` of the sample's points were complete and served.
    """

    first: Array
    total: Array
    points: int


def sobol_indices(values: Array) -> Indices | None:
    """Return the indices from the values of a quantity, (points, paths + 2) in the order of `Saltelli`; NaN where there is none.

    A point of which any value is missing is left out whole, since its rows only count together. None where fewer than
    two points remain or the quantity is the same in all of them. See SOURCE for the formulas.
    """
    complete = values[np.isfinite(values).all(axis=1)]
    if len(complete) < 2:
        return None
    both = complete[:, :2]
    scale = np.abs(both).max()
    middle = both.mean()
    variance = both.var()
    if variance <= (1e-14 * scale) ** 2:
        return None
    a, b, ab = complete[:, :1] - middle, complete[:, 1:2] - middle, complete[:, 2:] - middle
    first = (b * (ab - a)).mean(axis=0) / variance
    total = ((a - ab) ** 2).mean(axis=0) / (2 * variance)
    return Indices(first, total, len(complete))
