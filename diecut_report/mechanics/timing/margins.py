"""How well one set of intervals lies within another, or apart from it, on a circle."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from math import inf

from diecut_report.mechanics.timing.intervals import Interval, Intervals, complement, is_whole

TURNS_APART = (-1, 0, 1)


@dataclass(frozen=True)
class PairMargin:
    """Hold an interval and the one it lies in best, with the room at its start and at its end (negative: what it overlaps).

    ``outer`` is None where nothing can hold it (margins −∞) or where everything does (∞).
    """

    inner: Interval
    outer: Interval | None
    start: float
    end: float

    @property
    def least(self) -> float:
        """Return the smaller of the margins."""
        return min(self.start, self.end)

    @property
    def inner_length(self) -> float:
        """Return the length of the interval that must lie within."""
        return self.inner[1] - self.inner[0]


def margins_within(inner: Intervals, outer: Intervals, period: float) -> tuple[PairMargin, ...]:
    """Return for each interval of ``inner`` the margins in that interval of ``outer`` where the smaller of them is greatest.

    The whole circle holds everything; an empty set holds nothing, and what fills the whole circle lies in nothing shorter.
    """
    if is_whole(outer, period):
        return tuple(PairMargin(each, None, inf, inf) for each in inner)
    if not outer or is_whole(inner, period):
        return tuple(PairMargin(each, None, -inf, -inf) for each in inner)
    return tuple(max(_pairs(each, outer, period), key=lambda pair: pair.least) for each in inner)


def _pairs(inner: Interval, outer: Intervals, period: float) -> list[PairMargin]:
    shifted = ((start + k * period, end + k * period) for (start, end), k in product(outer, TURNS_APART))
    return [PairMargin(inner, each, inner[0] - each[0], each[1] - inner[1]) for each in shifted]


def margins_apart(inner: Intervals, other: Intervals, period: float) -> tuple[PairMargin, ...]:
    """Return for each interval of ``inner`` its margins in the greatest gap that ``other`` leaves it."""
    return margins_within(inner, complement(other, period), period)


def worst(margins: tuple[PairMargin, ...]) -> PairMargin | None:
    """Return the pair with the least margin; None where there is no interval to be held."""
    return min(margins, key=lambda pair: pair.least, default=None)
