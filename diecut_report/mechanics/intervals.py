"""Intervals of a periodic quantity: put in order, joined, and what they leave out."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

Interval = tuple[float, float]

SAME = 1e-12
"""Share of the period within which two places are one."""


def in_order(spans: Iterable[Interval], period: float) -> list[Interval]:
    """Return spans as disjoint intervals that begin in [0, period), ascending; what overlaps or touches is one.

    A span goes from its first place on to its second one, which lies at most a period later; if it is smaller, it is meant a
    period later. What covers everything is [0, period].
    """
    placed = sorted(_placed(start, end, period) for start, end in spans)
    found: list[Interval] = []
    for start, end in (each for each in placed if each[1] - each[0] > SAME * period):
        if found and start <= found[-1][1] + SAME * period:
            found[-1] = (found[-1][0], max(found[-1][1], end))
        else:
            found.append((start, end))
    return _across_the_seam(found, period)


def left_out(intervals: Sequence[Interval], period: float) -> list[Interval]:
    """Return what ordered, disjoint intervals leave of the period, in the same form."""
    if not intervals:
        return [(0.0, period)]
    following = [*intervals[1:], (intervals[0][0] + period, 0.0)]
    return in_order(((one[1], other[0]) for one, other in zip(intervals, following, strict=True)), period)


def _placed(start: float, end: float, period: float) -> Interval:
    """A span that begins in [0, period); a start next to the period's end is its beginning."""
    length = end - start
    length += period if length < -SAME * period else 0.0
    first = start % period
    first = 0.0 if period - first <= SAME * period else first
    return first, first + min(length, period)


def _across_the_seam(found: list[Interval], period: float) -> list[Interval]:
    """Join what passes the end of the period with what lies at its beginning."""
    while len(found) > 1 and found[-1][1] >= found[0][0] + period - SAME * period:
        first, *found = found
        found[-1] = (found[-1][0], max(found[-1][1], first[1] + period))
    return [(0.0, period)] if found and found[0][1] - found[0][0] >= period * (1 - SAME) else found
