"""What is asked of stored variants, judged and written as one query; the answers as a table, CSV, JSON and XLSX.

A question has a condition, an order, how many, which columns. Answers are in SI or in the units that people read, with the signs
that a firm's spreadsheet takes.
"""

from __future__ import annotations

import csv
import io
import json
import math
import shutil
import sys
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from diecut_report.config.plugins import Discovery
from diecut_report.errors import PluginError, Problem, UserError, nearest, refusal
from diecut_report.formulas import Array
from diecut_report.formulas import condition_tree as tree
from diecut_report.formulas.condition_parts import Name, read
from diecut_report.formulas.conditions import ConditionError
from diecut_report.press import Press
from diecut_report.quantities.units import unit
from diecut_report.report.text import number
from diecut_report.results.checks import NOT_CHECKED
from diecut_report.study.analysis.variant_config import variant_of
from diecut_report.study.analysis.variants import (
    FIXED,
    Stored,
    StoredColumn,
    compared_text,
    opened,
    table_text,
    text,
)
from diecut_report.study.storage.description import continuing, read_state
from diecut_report.study.storage.spreadsheets import SHEET_COLUMNS, SHEET_ROWS, workbook
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted, spoken_language

# A condition as SQL with parameters for DuckDB; see `condition_tree` for what holds where there is no value.
#
# Nothing of what a user writes reaches DuckDB but as a parameter or as the quoted name of a known column.


_SIGNS = {"==": "=", "!=": "<>", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_LEAST = {"min": "<=", "max": ">="}


class Sql(NamedTuple):
    """Hold an expression and what goes into its question marks."""

    text: str
    parameters: tuple[Any, ...] = ()


def _filled(form: str, *parts: Sql) -> Sql:
    return Sql(form.format(*(part.text for part in parts)), tuple(value for part in parts for value in part.parameters))


@dataclass(frozen=True)
class SqlWriter:
    """Write conditions whose names are all columns."""

    columns: Mapping[str, StoredColumn]

    def expression(self, node: tree.Node) -> Sql:
        """Return a side of a comparison or a condition; what is calculated and not finite is NULL."""
        match node:
            case tree.ColumnName(name):
                return Sql(self.columns[name].sql)
            case tree.Number(value) | tree.TextLiteral(value):
                return Sql("?", (value,))
            case tree.Truth(value):
                return Sql("true" if value else "false")
            case tree.Negative() | tree.Chain() | tree.Power() | tree.Call():
                return _filled("list_transform([{}], lambda x: CASE WHEN isfinite(x) THEN x END)[1]", self.number(node))
            case tree.Compared(sign, left, right):
                return _filled(f"({{}} {_SIGNS[sign]} {{}})", self.expression(left), self.expression(right))
            case tree.Like(text, pattern):
                return _filled("({} LIKE {})", self.expression(text), Sql("?", (pattern,)))
            case tree.Missing(of):
                return _filled("({} IS NULL)", self.expression(of))
            case tree.Not(of):
                return _filled("(NOT {})", self.expression(of))
            case tree.Joined(word, parts):
                places = f" {word.upper()} ".join(["{}"] * len(parts))
                return _filled(f"({places})", *map(self.expression, parts))

    def number(self, node: tree.Node) -> Sql:
        """Return a number that something is calculated from; NaN and infinite ones go on through sums, products and roots."""
        match node:
            case tree.ColumnName(name) if self.columns[name].kind == "int":
                return Sql(f"CAST({self.columns[name].sql} AS DOUBLE)")
            case tree.Negative(of):
                return _filled("(-{})", self.number(of))
            case tree.Chain(first, rest):
                found = self.number(first)
                for sign, part in rest:
                    # one divided by what is infinite would be 0
                    other = self._finite(part) if sign == "/" else self.number(part)
                    found = _filled(f"({{}} {sign} {{}})", found, other)
                return found
            case tree.Power(base, exponent):  # 1 ** NaN would be 1
                return _filled("pow({}, {})", self._finite(base), self._finite(exponent))
            case tree.Call(name, of) if name in _LEAST:  # least() and greatest() would pass over what is NULL
                least = f"lambda x, y: CASE WHEN x {_LEAST[name]} y THEN x WHEN y {_LEAST[name]} x THEN y END"
                given = ", ".join(["{}"] * len(of))
                return _filled(f"list_reduce([{given}], {least})", *map(self._finite, of))
            case tree.Call(name, (of,)):
                return _filled(f"{name}({{}})", self.number(of))
        return self.expression(node)

    def _finite(self, node: tree.Node) -> Sql:
        """Return a number that is NULL where it is calculated and not finite."""
        return self.number(node) if isinstance(node, tree.ColumnName | tree.Number) else self.expression(node)


# Conditions on stored variants: ``drive.crank_torque_peak < '40 N*m' and status = 'pass'`` to SQL with parameters.


EXAMPLE = "drive.crank_torque_peak < '40 N*m' and status = 'pass'"
MAX_SHOWN = 300  # letters of a condition in a message


def condition(given: str, columns: Mapping[str, StoredColumn]) -> tuple[Sql, list[str]]:
    """Return the condition that a text says, and the columns that it names; UserError, with the place, for what cannot be asked."""

    def name(name: str) -> Name:
        if name not in columns:
            near = nearest(name, columns) or phrase("; put texts in quotes")
            raise ConditionError("{name} is not a column of these variants{near}.", name=repr(name), near=near)
        return columns[name].in_condition

    try:
        node = read(given, columns, name, EXAMPLE)
    except ConditionError as fault:
        where = "" if fault.place is None else Phrase(", at character {place}", place=fault.place + 1)
        shown = given if len(given) <= MAX_SHOWN else given[:MAX_SHOWN] + "…"
        raise refusal("The condition “{shown}”{where}: {words}", shown=shown, where=where, words=fault.words) from None
    return SqlWriter(columns).expression(node), list(tree.names(node))


def column_named(name: str, columns: Mapping[str, StoredColumn]) -> StoredColumn:
    """Return the column of a name; UserError with the nearest where there is none."""
    if name not in columns:
        template = "{name} is not a column of these variants{nearest}."
        raise refusal(template, name=repr(name), nearest=nearest(name, columns))
    return columns[name]


DEFAULT_TOP = 20  # variants of a table that asks for no number of them
ROWS = 2_000  # at a time

Row = tuple[Any, ...]


@dataclass(frozen=True)
class Request:
    """Hold what a user asks, as typed: ``sort`` names columns parted by commas, ``picked`` are variants by their numbers."""

    where: str | None = None
    sort: str | None = None
    top: int | None = None
    columns: Sequence[str] | None = None
    picked: Sequence[int] = ()


@dataclass(frozen=True)
class Question:
    """Say what is asked: a condition, the order, how many, and which columns."""

    condition: Sql
    order: tuple[tuple[StoredColumn, bool], ...]
    top: int | None
    columns: tuple[StoredColumn, ...]
    picked: tuple[int, ...] = ()

    @property
    def where(self) -> str:
        """Return the condition as SQL."""
        chosen = f" AND variant IN ({', '.join(map(str, self.picked))})" if self.picked else ""
        return f"WHERE ({self.condition.text}){chosen}"

    def rows(self, stored: Stored) -> Iterator[Row]:
        """Yield the variants that answer it; those of equal rank stand in the order of the sample, missing values last."""
        chosen = ", ".join(column.sql for column in self.columns)
        order = [f"{column.sql} {'DESC' if falls else 'ASC'} NULLS LAST" for column, falls in self.order]
        limit = "" if self.top is None else f" LIMIT {self.top}"
        sql = f"SELECT {chosen} FROM v {self.where} ORDER BY {', '.join([*order, 'variant'])}{limit}"
        cursor = stored.connection.execute(sql, list(self.condition.parameters))
        while rows := cursor.fetchmany(ROWS):
            yield from rows


def question(stored: Stored, asked: Request, *, is_table: bool) -> Question:
    """Return the question; UserError for what cannot be asked.

    A table for people shows the varied quantities and what the question names, of at most 20 variants; other answers hold all.
    """
    _refuse_strange(stored, asked.picked)
    where = (asked.where or "").strip()
    found, names_asked = condition(where, stored.columns) if where else (Sql("true"), [])
    parts = [part.strip() for part in (asked.sort or "").split(",") if part.strip()]
    named = [(column_named(part.removeprefix("-").strip(), stored.columns), part.startswith("-")) for part in parts]
    top = DEFAULT_TOP if is_table and asked.top is None else asked.top
    if asked.columns is not None:
        given = [column_named(name, stored.columns).name for name in asked.columns]
        shown = [stored.columns[name] for name in dict.fromkeys(["variant", *given])]
    elif is_table:
        shown = _shown(stored, found, [*(column.name for column, _ in named), *names_asked])
    else:
        shown = list(stored.columns.values())
    return Question(found, tuple(named), top, tuple(shown), tuple(asked.picked))


def _refuse_strange(stored: Stored, picked: Sequence[int]) -> None:
    if not picked:
        return
    listed = ", ".join(map(str, picked))
    found = {number for (number,) in stored.rows(f"SELECT variant FROM v WHERE variant IN ({listed})")}
    if missing := [number for number in picked if number not in found]:
        first, last = stored.rows("SELECT min(variant), max(variant) FROM v")[0]
        template = "There is no variant {listed} here. The stored ones are within {first} … {last}."
        raise refusal(template, stored.folder, listed=", ".join(map(str, missing)), first=first, last=last)


def _shown(stored: Stored, asked: Sql, needed: Sequence[str]) -> list[StoredColumn]:
    objectives = [name for each in stored.study.get("objectives") or () for name in each.values()]
    sql = f"SELECT 1 FROM v WHERE error IS NOT NULL AND {asked.text} LIMIT 1"
    reason = ["error"] if stored.rows(sql, asked.parameters) else []
    varied = (column.name for column in stored.varied)
    wanted = ["variant", "verdict", "status", "governing", *needed, *objectives, *varied, *reason]
    return [stored.columns[name] for name in dict.fromkeys(wanted) if name in stored.columns]


SEPARATORS = {"comma": ",", "semicolon": ";", "tab": "\t"}
DECIMALS = {"point": ".", "comma": ","}
BLOCK = 1 << 16  # letters that are given at a time
MAX_COMPARED = 1_000  # variants side by side


@dataclass(frozen=True)
class Notation:
    """Say how values are written: in SI or in the units that people read, and with which signs between them and within them."""

    units: str = "si"
    separator: str = "comma"
    decimal: str = "point"

    def __post_init__(self) -> None:
        if self.separator == self.decimal == "comma":
            raise refusal("A comma cannot separate both values and decimals; add --separator semicolon, or tab.")

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


def answer(
    directory: Path, asked: Request, format: str = "table", notation: Notation = SI, *, transposed: bool = False, width: int | None = None
) -> Generator[str, None, None]:  # fmt: skip
    """Yield the answer in pieces of text: a ``table`` for people (in the units that they read), ``csv`` or ``json``.

    With ``transposed`` it has a line for each quantity and a column for each variant. UserError for what cannot be asked.
    A table that compares variants leaves out what is the same for all, and says how much that is, unless the columns are named.
    """
    if transposed and format == "json":
        raise refusal("JSON names each value, so that it has no rows to transpose; ask for table, csv or xlsx.")
    if width is None and sys.stdout.isatty():
        width = shutil.get_terminal_size().columns
    with opened(directory) as stored:
        found = question(stored, asked, is_table=format == "table" and not transposed)
        if transposed and format == "csv":
            yield from _csv_text(*_side_by_side(stored, found, notation), notation)
        elif transposed:
            yield _compared(stored, found, width, keep_equal=asked.columns is not None)
        elif format == "table":
            yield from _table(stored, found, width)
        elif format == "csv":  # units in the header, as a study reads its tables
            yield from _csv_text(list(map(notation.head, found.columns)), _written(stored, found, notation), notation)
        else:
            yield from _json_text(stored, found, notation)


def answer_workbook(directory: Path, asked: Request, notation: Notation = SI, *, transposed: bool = False) -> bytes:
    """Return the answer as a workbook (XLSX); UserError for what cannot be asked."""
    with opened(directory) as stored:
        found = question(stored, asked, is_table=False)
        if transposed:
            (_, _, *numbers), rows = _side_by_side(stored, found, notation)
            heads = [say("quantity"), say("unit"), *numbers]
        else:
            heads = list(map(notation.head, found.columns))
            rows = [list(map(_finite, row)) for row in islice(_written(stored, found, notation), SHEET_ROWS)]
            if len(rows) == SHEET_ROWS or len(heads) > SHEET_COLUMNS:
                template = (
                    "A sheet holds {sheet_rows} variants and {sheet_columns} columns; ask for fewer (--where, "
                    "--top, --columns), or for csv."
                )
                raise refusal(template, sheet_rows=SHEET_ROWS - 1, sheet_columns=SHEET_COLUMNS)
        return workbook({say("variants"): [heads, *rows]})


def unfinished(directory: Path) -> Iterator[str]:
    """Yield a warning where a study is not calculated to its end: its best variant may still come."""
    state = read_state(directory)
    if state.get("state") != "complete":
        template = "This study is not finished: {parts} of {all} parts are calculated. Continue with: {continued}"
        done, every = len(list((directory / "variants").glob("part-*.parquet"))), -(-state["rows"] // state["chunk"])
        yield Phrase(template, {"all": every}, parts=done, continued=continuing(directory, state["columns"]))


def is_doubtful(folder: Path) -> bool:
    """Return whether a stored variant warns, or a check of one is not made: a strict judge counts it as failed, unless it cannot exist."""
    with opened(folder) as stored:
        columns = (status.sql for _, status in stored.checks.values())
        asked = " OR ".join(["status = 'warn'", *(f"{column} = {text(NOT_CHECKED)}" for column in columns)])
        ((count,),) = stored.rows(f"SELECT count(*) FROM v WHERE status <> 'error' AND ({asked})")
    return bool(count)


def _written(stored: Stored, question: Question, notation: Notation) -> Iterator[list[Any]]:
    for row in question.rows(stored):
        yield [notation.value(value, column) for value, column in zip(row, question.columns, strict=True)]


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _csv_text(heads: Sequence[Any], rows: Iterable[Sequence[Any]], notation: Notation) -> Iterator[str]:
    buffer = io.StringIO()
    writer = csv.writer(buffer, delimiter=SEPARATORS[notation.separator], lineterminator="\n")
    writer.writerow(heads)
    for row in rows:
        writer.writerow(map(notation.text, row))
        if buffer.tell() > BLOCK:
            yield buffer.getvalue()
            buffer.seek(0)
            buffer.truncate()
    yield buffer.getvalue()


def _json_text(stored: Stored, question: Question, notation: Notation) -> Iterator[str]:
    """Yield an object for each variant, with the units of the columns before them."""
    names = [column.name for column in question.columns]
    numbers = [column for column in question.columns if column.name not in FIXED and column.is_number]
    units = {column.name: notation.unit_of(column) for column in numbers}
    yield f'{{"units": {json.dumps(units, ensure_ascii=False)},\n "variants": ['
    before = "\n  "
    for row in _written(stored, question, notation):
        yield before + json.dumps(dict(zip(names, map(_finite, row), strict=True)), ensure_ascii=False, allow_nan=False)
        before = ",\n  "
    yield "]}\n"


def _side_by_side(stored: Stored, question: Question, notation: Notation) -> tuple[list[Any], list[list[Any]]]:
    """Return the variants as columns: a head, and for each quantity its name, its unit and the values.

    UserError where there are more variants than anybody compares.
    """
    rows: list[Row] = list(islice(question.rows(stored), MAX_COMPARED + 1))
    if len(rows) > MAX_COMPARED:
        template = (
            "More than {most_compared} variants cannot stand side by side; choose some with --pick, --where or --top."
        )
        raise refusal(template, most_compared=MAX_COMPARED)
    head, lines = ["quantity", "unit"], []
    for index, column in enumerate(question.columns):
        own = notation.unit_of(column)
        values = [_finite(notation.value(row[index], column)) for row in rows]
        if column.name == "variant":
            head += values
        else:
            lines.append([column.name, "" if own == "1" else own, *values])
    return head, lines


def _table(stored: Stored, asked: Question, width: int | None) -> Iterator[str]:
    """Yield a table for people, how many variants there are, and the columns that have no room."""
    rows = list(asked.rows(stored))
    table, without = table_text(asked.columns, rows, width)
    sql = f"SELECT count(*) FILTER ({asked.where}), count(*) FROM v"
    found, total = stored.rows(sql, asked.condition.parameters)[0]
    counts = {"found": number(str(found), decimal_sign()), "n": number(str(total), decimal_sign())}
    words: Phrase = Counted(total, "{found} of {n} variant", "{found} of {n} variants", counts)
    if asked.condition.text != "true":
        words = Phrase("Matching the condition: {count}", count=words)
    some = Phrase("{words}; {given} are shown (--top, --format csv).", words=words, given=len(rows))
    yield f"{table}\n{said(some if len(rows) < found else Phrase('{words}.', words=words))}\n"
    if without:
        message = "No room on a line for: {columns} (--columns names some, --format csv has them all)."
        yield say(message, columns=", ".join(column.name for column in without)) + "\n"


def _compared(stored: Stored, asked: Question, width: int | None, *, keep_equal: bool) -> str:
    rows = list(asked.rows(stored))
    table, equal = compared_text(asked.columns, rows, width, keep_equal=keep_equal)
    words = say_counted(len(rows), "{n} variant", "{n} variants")
    if equal:
        one = "; {n} quantity that is equal in all is omitted (--columns, --format csv)"
        words += say_counted(equal, one, "; {n} quantities that are equal in all are omitted (--columns, --format csv)")
    return f"{table}\n{words}.\n"


# Numbers that differ by rounding alone.


DIGITS = 10


def rounded(values: Array) -> Array:
    """Return the values to ten digits, so that nothing is better than another by rounding."""
    sizes = np.abs(np.where(np.isfinite(values) & (values != 0), values, 1.0))
    unit = 10.0 ** (np.floor(np.log10(sizes)) + 1 - DIGITS)
    return np.asarray(np.where(np.isfinite(values), np.round(values / unit) * unit, values))


# Why variants cannot be calculated, in the language that is spoken: what is stored of it is English.


def reason_text(stored: Stored, variant: int, reason: str, discovery: Discovery) -> str:
    """Return the stored reason of a variant in the language that is spoken.

    The variant is judged once more by itself, so that the message knows what it was made of. Where that says something else, or
    the base is not kept any more, the reason stands as it is stored.
    """
    if spoken_language() == SOURCE_LANGUAGE or stored.description.base.content is None:
        return reason
    problems: Sequence[Problem] = ()
    try:
        Press.validate(variant_of(stored, variant, discovery, str(variant), in_error=True), discovery)
    except UserError as error:
        problems = error.problems
    except PluginError:  # it is reported where it broke
        return reason
    same = (str(replace(each, file="", line=None, column=None, advice="")) for each in problems)
    return next((localised(said(each)) for each in same if each == reason), reason)
