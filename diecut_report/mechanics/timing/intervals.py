"""Sets of intervals on a circle: what repeats after a common period.

A set is a tuple of pairs (start, end) with 0 ≤ start < period and start < end ≤ start + period, sorted and disjoint; an end
may lie beyond the period. All functions take and give such sets in one unit (radians, seconds), as plain numbers.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping

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


def contains(intervals: Intervals, place: float, period: float) -> bool:
    """Return whether a place of the circle lies in a set, edges included."""
    return any(0 <= (place - start) % period <= end - start for start, end in intervals)
