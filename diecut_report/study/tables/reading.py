"""Tables of variants: CSV, Parquet or XLSX into columns of SI floats or texts, with every fault reported by its row.

A column is headed by its name, with the unit in brackets where the cells have none: ``mechanisms.drive.crank_speed
[rpm]``. All cells of a column are in one unit: that of the header, of the cells themselves, or the display unit.
Rows count as a spreadsheet shows them, the header being row 1; in Parquet from 1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from diecut_report.config.hidden_letters import hidden
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import UnitError, unit
from diecut_report.study.tables.cells import EMPTY, TOLD, Cells, Faults, si_numbers
from diecut_report.study.tables.file_formats import NO_ROWS, read_cells
from diecut_report.study.tables.limits import UnreadableTable

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
        held = {text: letter for text in set(found) if (letter := hidden(text))}
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
