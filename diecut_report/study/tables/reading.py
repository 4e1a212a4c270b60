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
from typing import Any

import numpy as np

from diecut_report.config.yaml import forbidden_character
from diecut_report.errors import Problem, UserError, nearest, refusal
from diecut_report.files import opened
from diecut_report.formulas import Array
from diecut_report.quantities.units import UnitError, number_and_unit, parse_quantity, unit
from diecut_report.study.tables import formats
from diecut_report.text.phrases import Phrase, phrase

READERS = {".csv": formats.read_csv, ".parquet": formats.read_parquet, ".xlsx": formats.read_xlsx}
EMPTY = phrase("the cell is empty (or a formula without a stored value); every row needs a value")
REPORTED = 5  # wrong cells of a column that are reported one by one
REMEMBERED = 65_536  # different cells that are remembered while a column is read

DECIMAL = re.compile(r"\s*[-+−]?[\d\s']*([.,])\d")
MIXED = phrase(
    "the cell has the decimal sign {mark}, but row {row} has {other}; a column has one, and thousands are not set apart by it"
)

Wrong = tuple[Array, Callable[[int], str]]
"""The places of wrong cells, counted from 0, and what is wrong with one; asked of the first ones alone."""

_HEADER = re.compile(r"\s*(.*?)\s*(?:\[\s*([^\[\]]*?)\s*\])?\s*", re.DOTALL)


@dataclass(frozen=True, eq=False)
class ReadColumn:
    """Hold a column of a table as it stands in the file: `unit` is that of its header, `number` its place from 1."""

    file: str
    name: str
    unit: str | None
    number: int
    cells: formats.Cells

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
        problems.append(Problem(formats.NO_ROWS, str(path)))
    if problems:
        raise UserError(problems)
    return TableFile(str(path), {column.name: column for column in columns}, sha256)


def _read(path: Path) -> tuple[formats.Columns, str]:
    kind = path.suffix.lower()
    if kind not in READERS:
        template = "the ending {suffix} is not known; save the table as {known}"
        raise refusal(template, suffix=path.suffix or phrase("(none)"), known=", ".join(READERS))
    with opened(path, formats.MAX_BYTES[kind], Phrase("a table ({kind})", kind=kind)) as file:
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


# --- the cells of a column as SI numbers ------------------------------------------------------------------------------


def si_numbers(cells: formats.Cells, unit_text: str, *, own: bool) -> tuple[Array, Wrong]:
    """Return SI values of cells; bare numbers are in `unit_text`, which is the header's where `own`.

    Cells with a unit must all have the same one, and that of the header where it has one.
    """
    floats = cells.floats()
    if floats is None:
        return _one_by_one(cells, unit_text, own)
    infinite = phrase("the number is infinite; a finite one is needed")
    wrong = np.flatnonzero(~np.isfinite(floats))
    return _to_si(floats, unit_text), (wrong, lambda place: EMPTY if np.isnan(floats[place]) else infinite)


def _to_si(values: Array, unit_text: str) -> Array:
    # Each number by the same rounding as in a config (2.1 mm are 0.0021 m, not 2.1 / 1000), each different one once.
    given = unit(unit_text)
    if given.factor == 1:
        return values
    read = np.empty(len(values))
    for start in range(
        0, len(values), formats.SLICE
    ):  # all at once would take several times what the numbers themselves do
        different, places = np.unique(values[start : start + formats.SLICE], return_inverse=True)
        finite = np.isfinite(different)
        different[finite] = [given.to_si(value) for value in different[finite].tolist()]
        read[start : start + formats.SLICE] = different[places]
    return read


def _one_by_one(cells: formats.Cells, unit_text: str, own: bool) -> tuple[Array, Wrong]:
    values, is_wrong, messages = np.full(len(cells), np.nan), np.zeros(len(cells), dtype=bool), dict[int, str]()
    known: dict[Any, tuple[float, str] | str] = {}
    agreed = (unit(unit_text).text, phrase("the header")) if own else None
    sign: tuple[str, int] | None = None  # the decimal sign, and the place where it stands first
    for place, item in enumerate(cells.items()):
        key = (type(item), item)
        read = known.get(key)
        if read is None:
            if len(known) == REMEMBERED:
                known.clear()
            read = known[key] = _read_cell(item, unit_text)
        if not isinstance(read, str):
            values[place], given = read
            agreed = agreed or (given, Phrase("row {row}", row=cells.row(place)))
            mark = DECIMAL.match(item) if isinstance(item, str) else None
            sign = sign or (mark and (mark[1], place))
            if sign and mark and mark[1] != sign[0]:
                read = Phrase(MIXED, mark=mark[1], other=sign[0], row=cells.row(sign[1]))
            elif given == agreed[0] or (own and not given):
                continue
            else:
                read = _unlike(given, *agreed)
        is_wrong[place] = True
        if len(messages) <= REPORTED:
            messages[place] = read
    return values, (np.flatnonzero(is_wrong), messages.__getitem__)


def _unlike(given: str, agreed: str, where: str) -> str:
    mine, other = (Phrase("is in {unit}", unit=text) if text else phrase("has no unit") for text in (given, agreed))
    return Phrase("the cell {mine}, but {where} {other}; a column has one unit", mine=mine, where=where, other=other)


def _read_cell(item: Any, unit_text: str) -> tuple[float, str] | str:
    """Return the SI value of a cell and its own unit ("" where it is bare), or what is wrong with it."""
    if item is None or (isinstance(item, str) and not item.strip()):
        return EMPTY
    if isinstance(item, str) and item.strip().lower() in ("nan", "null", "na", "n/a", "#n/a"):
        return Phrase("{text} is not a value; every row needs a number", text=repr(item.strip()))
    if not isinstance(item, str | int | float):
        template = "{item} is not a number (the cell holds a {name}); format the cell as a number"
        return Phrase(template, item=item, name=type(item).__name__)
    try:
        value = parse_quantity(item, unit_text)
        own = number_and_unit(item)[1] if isinstance(item, str) else ""
        return value, unit(own).text if own else ""
    except UnitError as error:
        return str(error)
