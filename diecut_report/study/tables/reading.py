"""Tables of variants: CSV, Parquet or XLSX into columns of SI floats or texts, with every fault reported by its row.

A column is headed by its name, with the unit in brackets where the cells have none: ``mechanisms.drive.crank_speed
[rpm]``. All cells of a column are in one unit: that of the header, of the cells themselves, or the display unit.
Rows count as a spreadsheet shows them, the header being row 1; in Parquet from 1.
"""

from __future__ import annotations

import codecs
import csv
import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from diecut_report.config.yaml import forbidden_character
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.files import opened
from diecut_report.formulas import Array
from diecut_report.quantities.units import UnitError, unit
from diecut_report.study.tables import formats
from diecut_report.study.tables.cells import (
    EMPTY,
    MAX_BYTES,
    MAX_COLUMNS,
    TOLD,
    Cells,
    Faults,
    UnreadableTable,
    judge_size,
    si_numbers,
)
from diecut_report.text.phrases import Phrase, phrase

# Files of tables (CSV, Parquet, XLSX) as headers and cells. The libraries are imported where they are needed.


DELIMITERS = ",;\t"
NO_ROWS = phrase("the table has no rows below its header; give at least one")
NOT_UTF8 = phrase("is not in UTF-8; save it as “CSV UTF-8”")
LINE = 1_000_000  # bytes of a row at most
KEPT = 100  # rows of another length that are told one by one
CHUNK = 1 << 20

Header = tuple[str, str | None]
"""What heads a column, and the unit that the file stores beside it."""


class Read(NamedTuple):
    """Hold what a file gives: its columns' headers and cells, and the SHA-256 of the very bytes that were read."""

    headers: list[Header]
    cells: list[Cells]
    sha256: str


def read_cells(path: Path, sheet: str | None) -> Read:
    """Return the headers and the cells of all columns of a file.

    UnreadableTable in words for what is not a table or too large a one, UserError for what is no regular file or too large a one.
    """
    kind = path.suffix.lower()
    if kind not in MAX_BYTES:
        known = ", ".join(MAX_BYTES)
        raise UnreadableTable(
            Phrase(
                "the ending {suffix} is not known; save the table as {known}",
                suffix=path.suffix or phrase("(none)"),
                known=known,
            )
        )
    if sheet is not None and kind != ".xlsx":
        raise UnreadableTable(phrase("sheet is given, but only a workbook (.xlsx) has sheets; remove it"))
    with opened(path, MAX_BYTES[kind], Phrase("a table ({kind})", kind=kind)) as file:
        try:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
            file.seek(0)
            return Read(*_read(kind, file, sheet), digest)
        except OSError as error:
            raise UnreadableTable(Phrase("cannot be read: {strerror}", strerror=error.strerror or error)) from error


def _read(kind: str, file: BinaryIO, sheet: str | None) -> tuple[list[Header], list[Cells]]:
    if kind == ".xlsx":
        return formats.workbooks_read(file, sheet)
    return formats.read(file) if kind == ".parquet" else _csv(file)


def _csv(file: BinaryIO) -> tuple[list[Header], list[Cells]]:
    import pyarrow
    from pyarrow import csv as arrow_csv

    names, delimiter = _csv_header(file)
    judge_size(".csv", _lines(file), len(names))
    other = _OtherRows()
    try:
        table = arrow_csv.read_csv(
            file,
            arrow_csv.ReadOptions(use_threads=False, skip_rows=1, column_names=[str(i) for i in range(len(names))]),
            arrow_csv.ParseOptions(delimiter=delimiter, ignore_empty_lines=False, invalid_row_handler=other),
            arrow_csv.ConvertOptions(column_types={str(i): pyarrow.string() for i in range(len(names))}),
        )
    except pyarrow.ArrowMemoryError as error:
        raise UnreadableTable(phrase("needs more memory than there is. Give fewer rows or columns")) from error
    except pyarrow.ArrowException as error:
        raise UnreadableTable(_csv_fault(str(error))) from error
    other.refuse()
    kept, blank = _without_blank_rows(table)
    return [(name, None) for name in names], [Cells(column, 2, blank) for column in kept.columns]


class _OtherRows:
    """Gathers the rows that have not as many cells as the header, as many of them as are told one by one."""

    def __init__(self) -> None:
        self.faults: list[tuple[str, int | None]] = []
        self.more = 0

    def __call__(self, row: Any) -> str:
        """Note a row; Arrow leaves it out."""
        words = Phrase(
            "row {number} has {actual_columns} cells, the header {expected_columns}; fill up or quote",
            number=row.number,
            actual_columns=row.actual_columns,
            expected_columns=row.expected_columns,
        )
        if len(self.faults) < KEPT:
            self.faults.append((words, row.number))
        else:
            self.more += 1
        return "skip"

    def refuse(self) -> None:
        """UnreadableTable where there are any."""
        if self.faults:
            told = (
                [(Phrase("{more} more rows have not as many cells as the header", more=self.more), None)]
                if self.more
                else []
            )
            raise UnreadableTable([*self.faults, *told])


def _csv_header(file: BinaryIO) -> tuple[list[str], str]:
    """The cells of the first row, and what separates them: the comma, or what the first row has more of."""
    line = re.split(rb"[\r\n]", file.readline(LINE), maxsplit=1)[0]
    if len(line) == LINE:
        raise UnreadableTable([(phrase("row 1 is too long; it must hold the names of the columns"), 1)])
    try:
        first = line.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UnreadableTable(NOT_UTF8) from error
    if not first.strip():
        raise UnreadableTable([(phrase("row 1 is empty; it must hold the names of the columns"), 1)])
    delimiter = max(DELIMITERS, key=first.count)
    if first.count(delimiter) >= 2 * MAX_COLUMNS:  # before it is parted; some may stand in quotes
        judge_size(".csv", 0, first.count(delimiter) + 1)
    try:
        return next(csv.reader([first], delimiter=delimiter)), delimiter
    except csv.Error as error:
        raise UnreadableTable(
            [(Phrase("row 1 cannot be read: {error}; it must hold the names of the columns", error=error), 1)]
        ) from error


def _lines(file: BinaryIO) -> int:
    """How many rows there may be; the file stands at its beginning again. UnreadableTable where it is no text, or a quotation is open."""
    file.seek(0)
    feeds = returns = quotes = 0
    decoder = codecs.getincrementaldecoder("utf-8")()
    try:
        while chunk := file.read(CHUNK):
            decoder.decode(chunk)  # Arrow prints a traceback for a row of another length that is not in UTF-8
            feeds, returns = feeds + chunk.count(b"\n"), returns + chunk.count(b"\r")
            quotes += chunk.count(b'"')
        decoder.decode(b"", final=True)
    except UnicodeDecodeError as error:
        raise UnreadableTable(NOT_UTF8) from error
    if quotes % 2:  # Arrow takes what follows the last one, whatever it is, for one cell
        raise UnreadableTable(
            Phrase(
                "has {quotes} quotation marks, so that one is not closed; within a quoted cell it is doubled",
                quotes=quotes,
            )
        )
    file.seek(0)
    return max(feeds, returns)


def _csv_fault(message: str) -> str:
    if "straddling" in message or "out of sync" in message:
        return phrase(
            "has a row that ends in another line, or is longer than 1 MB; look for a quotation mark that is not closed"
        )
    return (
        NO_ROWS
        if "Empty" in message or "Could not skip" in message
        else Phrase("is not a CSV file: {message}", message=message)
    )


def _without_blank_rows(table: Any) -> tuple[Any, tuple[int, ...]]:
    """The table without rows that hold nothing, and their rows in the file; in a single column only those at its end."""
    import numpy as np
    from pyarrow import compute

    empty = (compute.equal(compute.utf8_trim_whitespace(column), "").to_numpy() for column in table.columns)
    blank = np.logical_and.reduce([np.asarray(column, dtype=bool) for column in empty])
    if table.num_columns == 1:
        blank[: np.max(np.flatnonzero(~blank), initial=-1) + 1] = False
    return table.filter(~blank), tuple((np.flatnonzero(blank) + 2).tolist())


_HEADER = re.compile(r"\s*(.*?)\s*(?:\[\s*([^\[\]]*?)\s*\])?\s*", re.DOTALL)


@dataclass(frozen=True, eq=False)
class ReadColumn:
    """Hold a column of a table as it stands in the file: `unit` is that of its header, `number` its place from 1."""

    file: str
    name: str
    unit: str | None
    number: int
    cells: Cells

    def problem(self, message: str, row: int | None = None) -> Problem:
        """Return a problem of this column, or of its cell in a row of the file."""
        where = Phrase("row {row}: ", row=row) if row is not None else ""
        return Problem(where + message, self.file, row or 1, self.number, self.name)

    def si(self, display: str) -> Array:
        """Return the column's SI values; bare numbers without a unit in the header are in the unit `display`.

        Raises UserError with the cells that are empty, not numbers, of another dimension or in another unit.
        """
        values, faults = si_numbers(self.cells, self._unit(display), own=self.unit is not None)
        self._refuse(faults)
        return values

    def texts(self) -> list[str]:
        """Return the column's texts, without blanks around them; UserError with the cells that are empty."""
        if self.unit is not None:
            words = Phrase(
                "the header has the unit [{unit}], but {name} is a text; remove the unit",
                unit=self.unit,
                name=self.name,
            )
            raise UserError(self.problem(words))
        found = self.cells.texts()
        self._refuse(Faults.of((place for place, text in enumerate(found) if not text), lambda _: EMPTY))
        held = {text: letter for text in set(found) if (letter := forbidden_character(text))}
        places = (place for place, text in enumerate(found) if text in held)
        self._refuse(
            Faults.of(
                places, lambda place: Phrase("the text holds the invisible character {held}", held=held[found[place]])
            )
        )
        return found

    def _unit(self, display: str) -> str:
        if self.unit is None:
            return display
        try:
            given, wanted = unit(self.unit), unit(display)
        except UnitError as error:
            raise UserError(self.problem(Phrase("the header's unit: {error}", error=error))) from None
        if given.kind != wanted.kind:
            words = Phrase(
                "the header's unit [{unit}] is of another kind; give one such as [{text}]",
                unit=self.unit,
                text=wanted.text,
            )
            raise UserError(self.problem(words))
        return self.unit

    def faulty(self, faults: Faults) -> Iterator[Problem]:
        """The cells that are wrong, the first ones in words."""
        for place, message in faults.told[:TOLD]:
            yield self.problem(message, self.cells.row(place))
        if faults.count > TOLD:
            more = Phrase("{count} more cells of this column are wrong", count=faults.count - TOLD)
            yield self.problem(more, self.cells.row(faults.told[TOLD][0]))

    def _refuse(self, faults: Faults) -> None:
        if faults.count:
            raise UserError(self.faulty(faults))


@dataclass(frozen=True, eq=False)
class TableFile:
    """Hold a table that was read: its columns by their names, in the file's order, all with `count` cells, and its SHA-256."""

    file: str
    columns: dict[str, ReadColumn]
    count: int
    sha256: str

    def column(self, name: str) -> ReadColumn:
        """Return a column by its name; UserError where there is none."""
        if name not in self.columns:
            raise UserError(self._missing(name))
        return self.columns[name]

    def _missing(self, name: str) -> Problem:
        there = ", ".join(self.columns)
        return Problem(
            Phrase(
                "the table has no column {name}{nearest}. Its columns: {there}",
                name=name,
                nearest=nearest(name, self.columns),
                there=there,
            ),
            self.file,
            1,
        )


def read_table(path: Path, sheet: str | None = None) -> TableFile:
    """Read a table by its file name's ending (.csv, .parquet, .xlsx); `sheet` is of a workbook, else its first one.

    Raises UserError for a file that cannot be read, columns without or with equal names, and a table without rows.
    """
    try:
        headers, cells, sha256 = read_cells(path, sheet)
    except UnreadableTable as error:
        raise UserError([Problem(message, str(path), row) for message, row in error.faults]) from None
    numbered = enumerate(zip(headers, cells, strict=True), 1)
    columns = [_column(str(path), number, header, under) for number, (header, under) in numbered]
    problems = list(_wrong_headers(columns))
    count = len(cells[0]) if cells else 0
    if not problems and count == 0:
        problems.append(Problem(NO_ROWS, str(path)))
    if problems:
        raise UserError(problems)
    return TableFile(str(path), {column.name: column for column in columns}, count, sha256)


def _column(file: str, number: int, header: tuple[str, str | None], cells: Cells) -> ReadColumn:
    text, stored_unit = header
    matched = _HEADER.fullmatch(text)
    name, own = (matched[1], matched[2]) if matched else (text, None)
    return ReadColumn(file, name, own or stored_unit, number, cells)


def _wrong_headers(columns: list[ReadColumn]) -> Iterator[Problem]:
    seen: dict[str, int] = {}
    for column in columns:
        if not column.name:
            yield column.problem(
                Phrase("column {number} has no name in the header; give it a path, or remove it", number=column.number)
            )
        elif column.name in seen:
            words = Phrase(
                "columns {seen} and {number} have the same name; keep one of them",
                seen=seen[column.name],
                number=column.number,
            )
            yield column.problem(words)
        seen.setdefault(column.name, column.number)
