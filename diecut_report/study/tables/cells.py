"""The cells of a table's column: to SI numbers or texts, each wrong one with its cell."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.quantities.units import UnitError, number_and_unit, parse_quantity, unit
from diecut_report.text.phrases import Phrase, phrase

EMPTY = phrase("the cell is empty (or a formula without a stored value); every row needs a value")
REPORTED = 5  # wrong cells of a column that are reported one by one
REMEMBERED = 65_536  # different cells that are remembered while a column is read
SLICE = 65_536  # cells that are Python values at a time

DECIMAL = re.compile(r"\s*[-+−]?[\d\s']*([.,])\d")
MIXED = phrase(
    "the cell has the decimal sign {mark}, but row {row} has {other}; a column has one, and thousands are not set apart by it"
)

Wrong = tuple[Array, Callable[[int], str]]
"""The places of wrong cells, counted from 0, and what is wrong with one; asked of the first ones alone."""


@dataclass(frozen=True, eq=False)
class Cells:
    """Hold the cells of a column as a file holds them: an Arrow array of numbers or texts, or a list of Python values.

    `first` is the file's row of the first cell; `skipped` are rows of the file without cells, ascending.
    """

    raw: Any
    first: int = 2
    skipped: tuple[int, ...] = ()

    def __len__(self) -> int:
        return len(self.raw)

    def row(self, place: int) -> int:
        """Return the row of the file, counted from 1, in which a cell stands."""
        behind = [skipped - count for count, skipped in enumerate(self.skipped)]
        return place + self.first + bisect_right(behind, place + self.first)

    def floats(self) -> Array | None:
        """Return the cells as floats, NaN where a number is missing; None unless all are plain numbers."""
        import pyarrow
        from pyarrow import compute, types

        if isinstance(self.raw, list):
            plain = all(isinstance(value, int | float) and not isinstance(value, bool) for value in self.raw)
            return np.array(self.raw, dtype=float) if plain else None
        is_text = types.is_string(self.raw.type) or types.is_large_string(self.raw.type)
        found = np.empty(len(self.raw))
        for start in range(0, len(self.raw), SLICE):  # all at once would be a second copy of all texts
            part = self.raw.slice(start, SLICE)
            part = compute.utf8_trim_whitespace(part) if is_text else part
            try:
                found[start : start + SLICE] = compute.cast(part, pyarrow.float64(), safe=False).to_numpy()
            except pyarrow.ArrowInvalid:  # a text that is not a plain number: the cells are read one by one
                return None
        return found

    def items(self) -> Iterator[Any]:
        """Yield the cells as Python values, some of them at a time; None where there is nothing."""
        if isinstance(self.raw, list):
            yield from self.raw
            return
        for start in range(0, len(self.raw), SLICE):
            yield from self.raw.slice(start, SLICE).to_pylist()

    def texts(self) -> list[str]:
        """Return the cells as texts without blanks around them, "" where there is nothing; whole numbers without a point."""
        once: dict[str, str] = {}  # a text that repeats is kept once
        return [once.setdefault(text, text) for text in map(_text, self.items())]


def _text(value: Any) -> str:
    if isinstance(value, float) and value.is_integer():
        return f"{int(value)}"
    return "" if value is None else str(value).strip()


def si_numbers(cells: Cells, unit_text: str, *, own: bool) -> tuple[Array, Wrong]:
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
    for start in range(0, len(values), SLICE):  # all at once would take several times what the numbers themselves do
        different, places = np.unique(values[start : start + SLICE], return_inverse=True)
        finite = np.isfinite(different)
        different[finite] = [given.to_si(value) for value in different[finite].tolist()]
        read[start : start + SLICE] = different[places]
    return read


def _one_by_one(cells: Cells, unit_text: str, own: bool) -> tuple[Array, Wrong]:
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
            read = known[key] = _read(item, unit_text)
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


def _read(item: Any, unit_text: str) -> tuple[float, str] | str:
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
