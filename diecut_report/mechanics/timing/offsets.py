"""The offset of one line on the main shaft that leaves its interlocks the greatest slack, exactly.

Shifted by x, an interval of one set lies in one of the other with the slack min(x + rise, fall − x), a tent. The slack of all
is G(x) = min over intervals of max over their tents. Its slopes are ±1, so that each maximum is a tent's peak or the crossing
of a rising side with a falling one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from typing import Literal

import numpy as np

from diecut_report.expressions import Array
from diecut_report.mechanics.timing.intervals import Interval, Intervals, is_whole

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
