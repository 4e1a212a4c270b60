"""The tables of a chapter as data without layout: what stands in their columns, and how these are aligned."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup

from diecut_report.quantities.formatting import ABOVE
from diecut_report.report.text import decimals, is_power, rooms

LONG = 10  # rows of a table
WIDE = 10  # columns of a table
LONG_NAME, FEW = 18, 7  # letters of a line's name, and columns beside which it has room
DASH = "–"
MARKS = {"", "→"}  # of rows: which was taken


@dataclass(frozen=True)
class PrintedTable:
    """A table of the calculation, or of curves."""

    title: str
    columns: list[tuple[str, Markup, str]]  # title, symbol, unit
    rows: list[list[str]]
    number: str = ""

    @property
    def kinds(self) -> list[str]:
        """What stands in each column: ``nth`` numbers or marks of lines, ``named`` what the first one names, ``words`` texts; else numbers."""
        return [self._kind(index) for index in range(len(self.columns))]

    def _kind(self, index: int) -> str:
        texts = [row[index] for row in self.rows]
        if set(texts) <= MARKS:
            return "nth"
        numbers = (text.removeprefix(ABOVE) for text in texts)  # a bound is a number among others
        if any(decimals(text) is None and not is_power(text) and text not in (DASH, "") for text in numbers):
            return "named" if index in self._first else "words"
        _, letter, unit = self.columns[index]
        is_counted = texts == [str(nth) for nth in range(1, len(texts) + 1)] and not (letter or unit)
        return "nth" if is_counted and index in self._first else ""

    @property
    def _first(self) -> tuple[int, ...]:
        """The places of the first column: two in a table that is set in halves."""
        half = len(self.columns) // 2
        return (0, half) if half > 1 and self.columns[:half] == self.columns[half:] else (0,)

    @property
    def cells(self) -> list[list[tuple[str, str]]]:
        """Each text with the class by which its column is aligned on the decimal sign."""
        aligned = [zip(texts, rooms(texts), strict=True) for texts in zip(*self.rows, strict=True)]
        return [list(row) for row in zip(*aligned, strict=True)]

    @property
    def is_wide(self) -> bool:
        """Whether its columns have room for their symbols alone."""
        return len(self.columns) >= WIDE

    @property
    def has_long_names(self) -> bool:
        """Whether what its first column names needs more room than numbers do."""
        return len(self.columns) <= FEW and max((len(row[0]) for row in self.rows), default=0) > LONG_NAME

    @property
    def is_halved(self) -> bool:
        """Whether it is set in two halves."""
        return len(self._first) > 1

    @property
    def is_long(self) -> bool:
        """Whether it may go over to another sheet."""
        return len(self.rows) > LONG


@dataclass(frozen=True)
class TableCell:
    """A value in a table of repeated parts, and what is to be said of it: where it comes from, how it was typed."""

    text: str
    note: str = ""
    wordy: bool = False
    changed: str = ""


@dataclass(frozen=True)
class PrintedColumn:
    """The head of a column in a table of repeated parts."""

    title: str
    symbol: Markup
    unit: str
    key: str
    source: str


@dataclass(frozen=True)
class PartsTable:
    """Quantities of repeated parts: a line for each part, by its number."""

    number: str
    title: str
    family: str
    columns: list[PrintedColumn]
    lines: list[tuple[str, list[TableCell]]]

    @property
    def rooms(self) -> list[list[str]]:
        """For each line the classes by which its cells are aligned on the decimal sign."""
        columns = [
            rooms([cell.text for cell in column]) for column in zip(*(cells for _, cells in self.lines), strict=True)
        ]
        return [list(row) for row in zip(*columns, strict=True)]
