"""Answers to questions as CSV, JSON and XLSX: in SI or in the units that people read, with the signs that a firm's spreadsheet takes."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import say
from diecut_report.quantities.units import unit
from diecut_report.study.analysis.question import Question, Row
from diecut_report.study.analysis.stored_variants import FIXED, Stored, StoredColumn
from diecut_report.study.storage.spreadsheets import SHEET_COLUMNS, SHEET_ROWS, workbook

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
