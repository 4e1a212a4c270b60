"""Rows of numbers for the page's scripts, each kept once, and the diagrams and drawings that share a cursor."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from diecut_report.quantities.units import unit
from diecut_report.report.curves import period_of

Data = Mapping[str, Any]
X_DIGITS, Y_DIGITS = 6, 5  # of the greatest number of a line: finer than a cursor reads


class ReaderRows:
    """Hold rows of numbers, and the groups of diagrams that share a cursor, with the turn after which the place of each comes again."""

    def __init__(self) -> None:
        self.rows: list[list[float | None]] = []
        self.turns: list[float | None] = []
        self._groups: dict[tuple[str, ...], int] = {}
        self._known: dict[tuple[float | None, ...], int] = {}

    def row(self, values: Any, digits: int) -> int:
        """Return the place of a row of numbers, rounded to so many digits of its greatest."""
        found = rounded(values, digits)
        place = self._known.setdefault(tuple(found), len(self.rows))
        if place == len(self.rows):
            self.rows.append(found)
        return place

    def group(self, chapter: str, title: str, symbol: str, shown: str) -> int:
        """Return the number of the group of all that runs over something in a chapter."""
        found = self._groups.setdefault((chapter, title, symbol, shown), len(self._groups))
        if found == len(self.turns):
            self.turns.append(None)
        return found

    def over(self, chapter: str, abscissa: Data, shown: str) -> int:
        """Return the number of the group of the curves over an abscissa of the results, in the unit that is shown."""
        found = self.group(chapter, abscissa["description"], abscissa["symbol"], shown)
        period = period_of(abscissa)
        self.turns[found] = period / unit(shown).factor if period else None
        return found


def rounded(values: Any, digits: int = Y_DIGITS) -> list[float | None]:
    """Return numbers rounded to so many digits of their greatest, None for what is not finite."""
    found = np.asarray(values, dtype=float)
    greatest = float(np.abs(found[np.isfinite(found)]).max(initial=0.0))
    decimals = digits - 1 - int(np.floor(np.log10(greatest))) if greatest else 0
    kept = np.round(found, decimals) + 0.0  # no minus before a zero
    return [short(value) if math.isfinite(value) else None for value in kept.tolist()]


def short(value: float) -> float:
    """Return a number as JSON writes it shortest: a whole one without ``.0``."""
    return int(value) if value.is_integer() else value
