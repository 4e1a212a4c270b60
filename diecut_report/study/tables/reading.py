"""Tables of variants: CSV, Parquet or XLSX into columns of SI floats or texts, with every fault reported by its row.

A column is headed by its name, with the unit in brackets where the cells have none: ``mechanisms.drive.crank_speed
[rpm]``. All cells of a column are in one unit: that of the header, of the cells themselves, or the display unit.
Rows count as a spreadsheet shows them, the header being row 1; in Parquet from 1.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from diecut_report.config.yaml import forbidden_character
from diecut_report.errors import Problem, UserError, nearest, refusal
from diecut_report.files import opened
from diecut_report.formulas import Array
from diecut_report.quantities.units import UnitError, unit
from diecut_report.study.tables.cells import EMPTY, REPORTED, Cells, si_numbers
from diecut_report.study.tables.formats import (
    MAX_BYTES,
    NO_ROWS,
    Columns,
    read_csv,
    read_parquet,
    read_xlsx,
)
from diecut_report.text.phrases import Phrase, phrase

READERS = {".csv": read_csv, ".parquet": read_parquet, ".xlsx": read_xlsx}
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

    def faulty(self, places: Sequence[int] | Array, message: Callable[[int], str]) -> Iterator[Problem]:
        """Yield the cells that are wrong, counted from 0, the first ones each with its message."""
        for place in map(int, places[:REPORTED]):
            yield self.problem(message(place), self.cells.row(place))
        if len(places) > REPORTED:
            more = Phrase("{count} more cells of this column are wrong", count=len(places) - REPORTED)
            yield self.problem(more, self.cells.row(int(places[REPORTED])))

    def _refuse(self, places: Sequence[int] | Array, message: Callable[[int], str]) -> None:
        if len(places):
            raise UserError(self.faulty(places, message))

    def si(self, display: str) -> Array:
        """Return the column's SI values; bare numbers without a unit in the header are in the unit `display`.

        Raises UserError with the cells that are empty, not numbers, of another dimension or in another unit.
        """
        self._check_unit(display)
        values, wrong = si_numbers(self.cells, self.unit or display, own=self.unit is not None)
        self._refuse(*wrong)
        return values

    def texts(self) -> list[str]:
        """Return the column's texts, without blanks around them; UserError with the cells that are empty."""
        if self.unit is not None:
            template = "the header has the unit [{unit}], but {name} is a text; remove the unit"
            raise UserError(self.problem(Phrase(template, unit=self.unit, name=self.name)))
        found = self.cells.texts()
        self._refuse([place for place, text in enumerate(found) if not text], lambda _: EMPTY)
        held = {text: letter for text in set(found) if (letter := forbidden_character(text))}
        places = [place for place, text in enumerate(found) if text in held]
        template = "the text holds the invisible character {held}"
        self._refuse(places, lambda place: Phrase(template, held=held[found[place]]))
        return found

    def _check_unit(self, display: str) -> None:
        if self.unit is None:
            return
        try:
            given, wanted = unit(self.unit), unit(display)
        except UnitError as error:
            raise UserError(self.problem(Phrase("the header's unit: {error}", error=error))) from None
        if given.kind != wanted.kind:
            template = "the header's unit [{unit}] is of another kind; give one such as [{text}]"
            raise UserError(self.problem(Phrase(template, unit=self.unit, text=wanted.text)))


@dataclass(frozen=True, eq=False)
class TableFile:
    """Hold a table that was read: its columns by their names, in the file's order, and the SHA-256 of its bytes."""

    file: str
    columns: dict[str, ReadColumn]
    sha256: str

    def column(self, name: str) -> ReadColumn:
        """Return a column by its name; UserError where there is none."""
        if name not in self.columns:
            template = "the table has no column {name}{nearest}. Its columns: {there}"
            near = nearest(name, self.columns)
            raise UserError(
                Problem(Phrase(template, name=name, nearest=near, there=", ".join(self.columns)), self.file, 1)
            )
        return self.columns[name]


def read_table(path: Path) -> TableFile:
    """Read a table by its file name's ending (.csv, .parquet, .xlsx); of a workbook the first sheet.

    Raises UserError for a file that cannot be read, columns without or with equal names, and a table without rows.
    """
    try:
        (headers, cells), sha256 = _read(path)
    except UserError as error:
        raise UserError(replace(problem, file=problem.file or str(path)) for problem in error.problems) from None
    columns = []
    for number, ((text, stored_unit), under) in enumerate(zip(headers, cells, strict=True), 1):
        matched = _HEADER.fullmatch(text)
        name, own = (matched[1], matched[2]) if matched else (text, None)
        columns.append(ReadColumn(str(path), name, own or stored_unit, number, under))
    problems = list(_wrong_headers(columns))
    if not problems and not (cells and len(cells[0])):
        problems.append(Problem(NO_ROWS, str(path)))
    if problems:
        raise UserError(problems)
    return TableFile(str(path), {column.name: column for column in columns}, sha256)


def _read(path: Path) -> tuple[Columns, str]:
    kind = path.suffix.lower()
    if kind not in READERS:
        template = "the ending {suffix} is not known; save the table as {known}"
        raise refusal(template, suffix=path.suffix or phrase("(none)"), known=", ".join(READERS))
    with opened(path, MAX_BYTES[kind], Phrase("a table ({kind})", kind=kind)) as file:
        try:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
            file.seek(0)
            return READERS[kind](file), digest
        except OSError as error:
            raise refusal("cannot be read: {strerror}", strerror=error.strerror or error) from error


def _wrong_headers(columns: list[ReadColumn]) -> Iterator[Problem]:
    seen: dict[str, int] = {}
    for column in columns:
        if not column.name:
            template = "column {number} has no name in the header; give it a path, or remove it"
            yield column.problem(Phrase(template, number=column.number))
        elif column.name in seen:
            template = "columns {seen} and {number} have the same name; keep one of them"
            yield column.problem(Phrase(template, seen=seen[column.name], number=column.number))
        seen.setdefault(column.name, column.number)
