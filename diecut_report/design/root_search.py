"""All places of a range where a function takes a value: passed through, stayed at, or hidden beside an end of what exists."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from diecut_report.design.line_search import Function, crossings, greatest, looked_closer
from diecut_report.expressions import Array

SAME_PLACE = 1e-8  # relative: two roots that are no further apart are one
ROUNDS = 4  # towards an end of what exists: to a 4096th of the distance between two numbers
NEARER = 60  # machines about today's value, as far as the nearest root that was found


def roots(
    function: Function, x: Array, values: Array, today: float | None, allows: Callable[[Array], Array]
) -> tuple[list[float], list[float]]:
    """Return where a function is zero, ascending, and where it jumps over zero; of places that are all zero the ends, and ``today``.

    It is searched between ascending numbers with their values, and closer about today's, so that the nearest root is not missed.
    """
    x, values = looked_closer(function, x, values, ROUNDS)
    places, jumps = _crossed(function, x, values, today)
    more = _about(today, places, x, allows) if places else _about_the_nearest(function, x, values)
    if not len(more):
        return places, jumps
    x = np.union1d(x, more)
    return _crossed(function, x, function(x), today)


def _crossed(function: Function, x: Array, values: Array, today: float | None) -> tuple[list[float], list[float]]:
    """The places between these numbers alone."""
    places: list[float] = []
    jumps: list[float] = []
    for run in _existing(values):
        own, known = x[run], values[run]
        for each in crossings(function, own, known):
            (jumps if each.is_jump else places).append(each.at)
        ends = ((known[1:] == 0) != (known[:-1] == 0)) & (known[1:] >= 0) & (known[:-1] >= 0)
        places += [each.at for each in crossings(lambda at: -function(at), own, -known, among=ends)]
    beside = np.concatenate([[np.nan], values, [np.nan]])
    before, after = beside[:-2], beside[2:]
    is_kept = ((before == 0) | (after == 0)) & np.isfinite(before) & np.isfinite(after)  # its ends are found
    taken = [float(each) for each in x[(values == 0) & (~is_kept | (x == today))]]
    found = [each for each in places if all(abs(each - one) > SAME_PLACE * abs(one) for one in taken)]
    return sorted([*taken, *found]), jumps


def _about(today: float | None, places: list[float], x: Array, allows: Callable[[Array], Array]) -> Array:
    """Numbers about today's value, as far as the nearest place: another may lie nearer."""
    if today is None:
        return np.array([])
    reach = min(abs(each - today) for each in places)
    near = np.linspace(today - reach, today + reach, NEARER + 1)
    return np.asarray(near[(near > x[0]) & (near < x[-1]) & allows(near)])


def _about_the_nearest(function: Function, x: Array, values: Array) -> Array:
    """Numbers about the one whose value comes nearest to zero: it may change its sign beside it."""
    tried: list[float] = []

    def nearness(places: Array) -> Array:
        tried.extend(places.tolist())
        return -np.abs(function(places))

    greatest(nearness, x, -np.abs(values))
    return np.array(tried)


def _existing(values: Array) -> list[slice]:
    """The runs of neighbours that all have a value."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], np.isfinite(values), [False]]).astype(int)))
    return [slice(int(first), int(last)) for first, last in zip(edges[::2], edges[1::2], strict=True)]
