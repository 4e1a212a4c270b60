"""The cells of a table's column: to SI numbers or texts, each fault with its cell."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.quantities.units import UnitError, number_and_unit, parse_quantity, unit
from diecut_report.text.phrases import Phrase, joined, phrase

EMPTY = phrase("the cell is empty (or a formula without a stored value); every row needs a value")

TOLD = 5  # faulty cells of a column that are told one by one
KNOWN = 65_536  # different cells that are remembered while a column is read
SLICE = 65_536  # cells that are Python values at a time


@dataclass
class Faults:
    """Cells that are wrong: the places, counted from 0, of as many as are told and one more, why, and how many there are."""

    told: list[tuple[int, str]] = field(default_factory=list)
    count: int = 0

    @classmethod
    def of(cls, places: Iterable[int], words: Callable[[int], str]) -> Faults:
        """Of these places; ``words`` says what is wrong with one, and is asked only where that is told."""
        found = cls()
        for place in places:
            found.add(int(place), words)
        return found

    def add(self, place: int, words: Callable[[int], str]) -> None:
        """Count one more."""
        if len(self.told) <= TOLD:
            self.told.append((place, words(place)))
        self.count += 1


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
        if isinstance(self.raw, list):
            plain = all(isinstance(value, int | float) and not isinstance(value, bool) for value in self.raw)
            return np.array(self.raw, dtype=float) if plain else None
        return _arrow_floats(self.raw)

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


def _arrow_floats(raw: Any) -> Array | None:
    import pyarrow

    is_text = pyarrow.types.is_string(raw.type) or pyarrow.types.is_large_string(raw.type)
    if not is_text:
        return _cast(raw)
    found = np.empty(len(raw))
    for start in range(0, len(raw), SLICE):  # all at once would be a second copy of all texts
        part = _cast(raw.slice(start, SLICE), is_text=True)
        if part is None:
            return None
        found[start : start + SLICE] = part
    return found


def _cast(raw: Any, *, is_text: bool = False) -> Array | None:
    import pyarrow
    import pyarrow.compute as compute

    trimmed = compute.utf8_trim_whitespace(raw) if is_text else raw
    try:
        return np.array(compute.cast(trimmed, pyarrow.float64(), safe=False).to_numpy(), dtype=float)
    except pyarrow.ArrowInvalid:  # a text that is not a plain number: the cells are read one by one
        return None


def _text(value: Any) -> str:
    if isinstance(value, float) and value.is_integer():
        return f"{int(value)}"
    return "" if value is None else str(value).strip()


def si_numbers(cells: Cells, unit_text: str, *, own: bool) -> tuple[Array, Faults]:
    """Return SI values of cells; bare numbers are in `unit_text`, which is the header's where `own`.

    Cells with a unit must all have the same one, and that of the header where it has one.
    """
    floats = cells.floats()
    if floats is None:
        return _one_by_one(cells, unit_text, own)
    wrong = np.flatnonzero(~np.isfinite(floats))
    return _to_si(floats, unit_text), Faults.of(wrong, lambda place: _not_finite(floats[place]))


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


def _not_finite(value: float) -> str:
    return EMPTY if np.isnan(value) else phrase("the number is infinite; a finite one is needed")


def _one_by_one(cells: Cells, unit_text: str, own: bool) -> tuple[Array, Faults]:
    values, faults = np.full(len(cells), np.nan), Faults()
    known: dict[Any, tuple[float, str] | str] = {}
    agreed = (unit(unit_text).text, phrase("the header")) if own else None
    for place, item in enumerate(cells.items()):
        key = (type(item), item)
        read = known.get(key)
        if read is None:
            if len(known) == KNOWN:
                known.clear()
            read = known[key] = _read(item, unit_text)
        if isinstance(read, str):
            faults.add(place, _said(read))
            continue
        values[place], given = read
        if agreed is None:
            agreed = (given, Phrase("row {row}", row=cells.row(place)))
        elif given != agreed[0] and not (own and not given):
            faults.add(place, _said(_unlike(given, *agreed)))
    return values, faults


def _said(words: str) -> Callable[[int], str]:
    return lambda _: words


def _unlike(given: str, agreed: str, where: str) -> str:
    mine, other = (Phrase("is in {unit}", unit=text) if text else phrase("has no unit") for text in (given, agreed))
    return Phrase("the cell {mine}, but {where} {other}; a column has one unit", mine=mine, where=where, other=other)


def _read(item: Any, unit_text: str) -> tuple[float, str] | str:
    """The SI value of a cell and its own unit ("" where it is bare), or what is wrong with it."""
    if item is None or (isinstance(item, str) and not item.strip()):
        return EMPTY
    if isinstance(item, str) and item.strip().lower() in ("nan", "null", "na", "n/a", "#n/a"):
        return Phrase("{text} is not a value; every row needs a number", text=repr(item.strip()))
    if not isinstance(item, str | int | float):
        return Phrase(
            "{item} is not a number (the cell holds a {name}); format the cell as a number",
            item=item,
            name=type(item).__name__,
        )
    try:
        value = parse_quantity(item, unit_text)
        own = number_and_unit(item)[1] if isinstance(item, str) else ""
        return value, unit(own).text if own else ""
    except UnitError as error:
        return str(error)


# How large a table may be, and how it is told that one cannot be read.


MAX_BYTES = {".csv": 200_000_000, ".parquet": 200_000_000, ".xlsx": 25_000_000}
MAX_UNPACKED = {".parquet": 500_000_000, ".xlsx": 100_000_000}  # what the packed file holds, in bytes
MAX_CELLS = {".csv": 10_000_000, ".parquet": 10_000_000, ".xlsx": 500_000}
MAX_COLUMNS = 16_384  # as many as a sheet of a workbook holds
SMALLER = phrase("Give fewer rows or columns")
OTHER_FORM = phrase("save the table as CSV or Parquet, which may be larger")


class UnreadableTable(Exception):
    """A file that is no table, in words, each with the row where it is known."""

    def __init__(self, faults: str | Iterable[tuple[str, int | None]]) -> None:
        self.faults = [(faults, None)] if isinstance(faults, str) else list(faults)
        super().__init__(self.faults)


def judge_size(kind: str, rows: int, columns: int) -> None:
    """Refuse a table of more cells than a file of this kind may have."""
    if columns > MAX_COLUMNS:
        raise UnreadableTable(
            Phrase(
                "has {columns} columns; at most {max_columns} are allowed. {smaller}",
                columns=columns,
                max_columns=MAX_COLUMNS,
                smaller=SMALLER,
            )
        )
    if rows * columns > MAX_CELLS[kind]:
        advice = joined((SMALLER, OTHER_FORM), ", or ") if kind == ".xlsx" else SMALLER
        most = Phrase("at most {max_cells} cells are allowed", max_cells=format(MAX_CELLS[kind], ","))
        raise UnreadableTable(
            Phrase(
                "has {rows} rows × {columns} columns; {most}. {advice}",
                rows=f"{rows:,}",
                columns=f"{columns:,}",
                most=most,
                advice=advice,
            )
        )


def judge_unpacked(kind: str, size: int) -> None:
    """Refuse a file whose content, unpacked, takes more bytes than is bearable."""
    if size > MAX_UNPACKED[kind]:
        most = Phrase("at most {max_unpacked} MB are allowed", max_unpacked=format(MAX_UNPACKED[kind] / 1000000.0, "g"))
        advice = joined((SMALLER, OTHER_FORM), ", or ") if kind == ".xlsx" else SMALLER
        raise UnreadableTable(
            Phrase(
                "holds {size} MB when it is unpacked; {most}. {advice}",
                size=format(size / 1000000.0, ".1f"),
                most=most,
                advice=advice,
            )
        )
