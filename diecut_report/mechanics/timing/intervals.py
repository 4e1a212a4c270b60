"""Sets of intervals on a circle: what repeats after a common period.

A set is a tuple of pairs (start, end) with 0 ≤ start < period and start < end ≤ start + period, sorted and disjoint; an end
may lie beyond the period. All functions take and give such sets in one unit (radians, seconds), as plain numbers.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import gcd, inf, lcm, pi
from typing import Literal

import numpy as np

from diecut_report.formulas import Array

Interval = tuple[float, float]
Intervals = tuple[Interval, ...]

TOUCHING = 1e-12  # share of the period below which two edges are one


def merged(pairs: Iterable[Interval], period: float) -> Intervals:
    """Return the union of any pairs (start ≤ end, anywhere) on the circle; those that touch become one, across the seam too.

    The whole circle is the one pair (0, period).
    """
    near = TOUCHING * period
    found: list[Interval] = []
    for start, end in sorted(_reduced(pairs, period)):
        if found and start <= found[-1][1] + near:
            found[-1] = (found[-1][0], max(found[-1][1], end))
        else:
            found.append((start, end))
    found = _closed(found, period)
    return ((0.0, period),) if found and found[0][1] - found[0][0] >= period - near else tuple(found)


def _reduced(pairs: Iterable[Interval], period: float) -> Iterator[Interval]:
    """Yield the pairs that have a length, each with its start in the period; a start that rounding puts just before the seam is on it."""
    for start, end in pairs:
        if end > start:
            place = start % period
            place = 0.0 if period - place <= TOUCHING * period else place
            yield place, place + min(end - start, period)


def _closed(found: list[Interval], period: float) -> list[Interval]:
    """Join what passes the seam with what begins behind it."""
    while len(found) > 1 and found[-1][1] - period >= found[0][0] - TOUCHING * period:
        start, end = found[-1]
        found = [*found[1:-1], (start, max(end, found[0][1] + period))]
    if found and found[-1][1] - found[-1][0] > period:
        found[-1] = (found[-1][0], found[-1][0] + period)
    return found


def complement(intervals: Intervals, period: float) -> Intervals:
    """Return what a set leaves of the circle."""
    if not intervals:
        return ((0.0, period),)
    starts = [start for start, _ in intervals[1:]] + [intervals[0][0] + period]
    return merged(zip((end for _, end in intervals), starts, strict=True), period)


def composed(sets: Mapping[str, frozenset[Hashable]]) -> dict[str, tuple[str, ...]]:
    """Return, of named sets of any things, those that are nothing but others together, with these; of equal ones each holds those before it."""
    names = list(sets)
    found = {}
    for place, name in enumerate(names):
        others = [*names[:place], *(each for each in names[place + 1 :] if sets[each] != sets[name])]
        parts = tuple(each for each in others if sets[each] and sets[each] <= sets[name])
        if parts and frozenset().union(*(sets[each] for each in parts)) == sets[name]:
            found[name] = parts
    return found


def union(one: Intervals, other: Intervals, period: float) -> Intervals:
    """Return what is in one of two sets."""
    return merged((*one, *other), period)


def intersection(one: Intervals, other: Intervals, period: float) -> Intervals:
    """Return what is in both of two sets."""
    return complement(union(complement(one, period), complement(other, period), period), period)


def repeated(intervals: Intervals, own_period: float, period: float) -> Intervals:
    """Return a set that repeats after its own period, over a common period that is a whole number of them."""
    count = round(period / own_period)
    return merged(((a + k * own_period, b + k * own_period) for k in range(count) for a, b in intervals), period)


def shifted(intervals: Intervals, by: float, period: float) -> Intervals:
    """Return a set moved along the circle."""
    return merged(((start + by, end + by) for start, end in intervals), period)


def total_length(intervals: Intervals) -> float:
    """Return the length of all intervals together."""
    return sum(end - start for start, end in intervals)


def is_whole(intervals: Intervals, period: float) -> bool:
    """Return whether a set is the whole circle."""
    return total_length(intervals) >= period * (1 - TOUCHING)


# Lines: mechanisms that the main shaft drives at a fixed ratio, and the period that all of them have in common.


MAX_DENOMINATOR = 64
WHOLE = 1e-9  # by which a ratio may miss its fraction, relative

Rational = Fraction | float


def exact_turns(turns_per_sheet: Rational | str) -> Fraction:
    """Return turns of a line for each turn of the main shaft (a sheet) as a fraction with a denominator of at most 64.

    A text is a number or a ratio such as ``1 / 2``. ValueError where there is no such fraction, or where it is not above zero.
    """
    if isinstance(turns_per_sheet, str):
        turns_per_sheet = _ratio(turns_per_sheet)
    found = Fraction(turns_per_sheet).limit_denominator(MAX_DENOMINATOR)
    if found <= 0 or abs(found - Fraction(turns_per_sheet)) > WHOLE * found:
        raise ValueError(
            f"{turns_per_sheet} is not a fraction above zero with a denominator of at most {MAX_DENOMINATOR}"
        )
    return found


def _ratio(text: str) -> Fraction:
    try:
        return Fraction(text.replace(" ", ""))
    except ZeroDivisionError:
        raise ValueError(f"{text} is divided by zero") from None


def common_period(turns: Iterable[Fraction]) -> Fraction:
    """Return the turns of the main shaft after which all lines, given by their periods in turns, are where they were.

    The least common multiple of fractions: that of the numerators over the greatest common divisor of the denominators.
    """
    given = tuple(turns)
    return Fraction(lcm(*(t.numerator for t in given)), gcd(*(t.denominator for t in given)))


@dataclass(frozen=True)
class DrivenLine:
    """Hold how a mechanism is driven: turns of its own shaft for each of the main shaft, and the main-shaft angle of its zero (rad)."""

    turns: Fraction
    offset: float = 0.0

    def period_turns(self, every: int = 1) -> Fraction:
        """Return the turns of the main shaft for a turn of the line, or for ``every`` of its turns."""
        return every / self.turns

    def main_angle(self, own_angle: float) -> float:
        """Return the main-shaft angle at which the line is at an angle of its own shaft."""
        return self.offset + own_angle / float(self.turns)

    def on_main_shaft(self, intervals: Intervals, common: Fraction, every: int = 1) -> Intervals:
        """Return a phase in main-shaft angle over the common period (turns of the main shaft).

        ``intervals`` are angles of the line's own shaft (rad), over one own turn, or over ``every`` own turns. A phase over
        time is handed over with its time as the share of 2π of its cycle.
        """
        period = 2 * pi * float(common)
        main = tuple((self.main_angle(start), self.main_angle(end)) for start, end in intervals)
        own_period = 2 * pi * float(self.period_turns(every))
        return repeated(merged(main, own_period), own_period, period)


# How well one set of intervals lies within another, or apart from it, on a circle.


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


def worst(margins: tuple[PairMargin, ...]) -> PairMargin | None:
    """Return the pair with the least margin; None where there is no interval to be held."""
    return min(margins, key=lambda pair: pair.least, default=None)


# The offset of one line on the main shaft that leaves its interlocks the greatest slack, exactly.
#
# Shifted by x, an interval of one set lies in one of the other with the slack min(x + rise, fall − x), a tent. The slack of all
# is G(x) = min over intervals of max over their tents. Its slopes are ±1, so that each maximum is a tent's peak or the crossing
# of a rising side with a falling one.


EQUAL = 1e-9  # rad, by which two slacks are taken as equal
SHIFTS = (-2, -1, 0, 1, 2)  # periods by which an interval may lie apart after a shift by up to a period
MANY = 1_000_000  # slacks that are evaluated at one time

Moved = Literal["inner", "outer"]
Tent = tuple[float, float]  # rise, fall
Tents = tuple[tuple[Tent, ...], ...]  # for each interval that must be held, the tents of all that may hold it


@dataclass(frozen=True)
class BestOffset:
    """Hold the shift with the greatest slack (rad), and all shifts that leave a slack of zero or more.

    The slack is ∞ where nothing bounds it, and −∞ where something holds at no shift.
    """

    shift: float
    slack: float
    feasible: Intervals


def tents(inner: Intervals, outer: Intervals, period: float, moved: Moved, margin: float = 0.0) -> Tents:
    """Return the tents of ``inner`` within ``outer`` when one of them is shifted, margins counted above the required one (rad).

    Every shift by the common period is a tent of its own. An interval that nothing can hold has none; where ``outer`` is the
    whole circle, nothing has to be held.
    """
    if is_whole(outer, period):
        return ()
    if is_whole(inner, period):
        return ((),)
    return tuple(tuple(_tents(each, outer, period, moved, margin)) for each in inner)


def _tents(inner: Interval, outer: Intervals, period: float, moved: Moved, margin: float) -> Iterator[Tent]:
    for start, end in outer:
        for k in SHIFTS:
            at_start = inner[0] - start - k * period - margin
            at_end = end + k * period - inner[1] - margin
            yield (at_start, at_end) if moved == "inner" else (at_end, at_start)


def relevant(rows: Tents, span: float) -> Tents:
    """Return the tents without those that others cover everywhere on [0, span]."""
    return tuple(tuple(_uncovered(row, span)) for row in rows)


def _uncovered(row: tuple[Tent, ...], span: float) -> list[Tent]:
    """Cut down the row by peaks: on the span a tent equals one whose peak is moved along its side to the span's end."""
    kept: list[tuple[float, float, Tent]] = []
    for tent in sorted(row, key=sum, reverse=True):
        peak, height = (tent[1] - tent[0]) / 2, (tent[1] + tent[0]) / 2
        place = min(max(peak, 0.0), span)
        height -= abs(peak - place)
        covers = [each for each in kept if each[1] - abs(each[0] - place) >= height]
        if not covers:
            kept = [each for each in kept if height - abs(each[0] - place) < each[1]]
            kept.append((place, height, tent))
    return [tent for _, _, tent in kept]


def slack(shift: Array, rows: Tents) -> Array:
    """Return G, the least slack over all rows, at shifts of shape (points,); ∞ without rows, −∞ where a row has no tent."""
    found = np.full(np.shape(shift), inf)
    for row in rows:
        rise, fall = np.array(row, dtype=float).reshape(-1, 2).T[:, :, None]
        found = np.minimum(found, np.minimum(shift + rise, fall - shift).max(axis=0, initial=-inf))
    return found


def best_offset(rows: Tents, span: float) -> BestOffset:
    """Return the least shift in [0, span) with the greatest slack; ``span`` is the period after which the moved line repeats.

    Where none leaves slack, it is the shift of least violation; rows that hold nowhere are left out in choosing it.
    """
    kept = relevant(rows, span)
    possible = tuple(row for row in kept if row)
    places = _candidates(possible, span)
    slacks = np.concatenate([slack(part, possible) for part in np.array_split(places, 1 + len(places) // MANY)])
    best = float(places[np.flatnonzero(slacks >= slacks.max() - EQUAL)[0]])
    greatest = float(slacks.max()) if len(possible) == len(kept) else -inf
    return BestOffset(best, greatest, feasible_shifts(kept, span))


def _candidates(rows: Tents, span: float) -> Array:
    """Places of all peaks, and crossings of a rising side with a falling one, sorted; zero where there are none."""
    rises = np.unique([tent[0] for row in rows for tent in row])
    falls = np.unique([tent[1] for row in rows for tent in row])
    places = (falls[:, None] - rises).ravel() / 2
    near = places[(places > -EQUAL) & (places < span - EQUAL)]
    return np.unique(np.concatenate([[0.0], np.maximum(near, 0.0)]))


def feasible_shifts(rows: Tents, span: float) -> Intervals:
    """Return all shifts in [0, span] that leave a slack of zero or more, as sorted intervals (a single shift has no length)."""
    found: Intervals = ((0.0, span),)
    for row in rows:
        own = [(max(-rise, 0.0), min(fall, span)) for rise, fall in row if -rise <= fall]
        found = _common(found, _joined(each for each in own if each[0] <= each[1]))
    return found


def _joined(pairs: Iterator[Interval]) -> list[Interval]:
    found: list[Interval] = []
    for start, end in sorted(pairs):
        if found and start <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], end))
        else:
            found.append((start, end))
    return found


def _common(one: Intervals, other: list[Interval]) -> Intervals:
    both = ((max(a[0], b[0]), min(a[1], b[1])) for a in one for b in other)
    return tuple(each for each in both if each[0] <= each[1])


def needed_length(outer_length: float, rows: Tents, span: float) -> float:
    """Return how long the one interval of ``outer`` would have to be, for an interlock alone to leave no negative slack.

    Infinite where no length helps.
    """
    return outer_length - 2 * best_offset(rows, span).slack
