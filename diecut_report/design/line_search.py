"""Roots, limits and extremes of a function of one number that is calculated for many numbers at once, each call being dear.

Every call asks for a handful of numbers for each bracket: some spread evenly, which shrink any bracket, and some close to
where a straight line through its ends says, which shrink a smooth one at once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanics import numerics

Function = Callable[[Array], Array]
"""Of numbers, shape (n,): what is to be zero, above zero where it holds, NaN where there is nothing."""

EVEN, LEAST_EVEN = 12, 3  # numbers that are spread evenly, of all brackets together, and of each at least
AROUND = np.array([-1e-2, -1e-4, 0.0, 1e-4, 1e-2])
ROUNDS = 20
CLOSE = 1e-9  # relative width at which a bracket is closed
JUMP = 1e-2  # share of a bracket's first difference that is left in one so narrow: the function jumps there
PARTS, ZOOMS = 10, 6  # of the neighbourhood of the greatest value, and how often it is looked at closer
EIGHTHS, HALF = np.arange(1, 8) / 8, np.array([0.5])  # of a pair of neighbours
HALVED = 5  # how often the distances of such neighbours are halved at most
MOST_CELLS = 12  # such ends that are looked at closer
SEARCH_ROUNDS = 4  # towards an end of what exists: to a 4096th of the distance between two numbers


@dataclass(frozen=True)
class Crossing:
    """Hold a place where a function changes its sign: ``inside`` is on the side where it is not below zero, ``at`` between both.

    ``is_jump``: it does not pass through zero there, but from one value to another (or to none).
    """

    at: float
    inside: float
    is_jump: bool


def crossings(
    function: Function, x: Array, values: Array, close: float = CLOSE, among: Array | None = None
) -> list[Crossing]:
    """Return where a function changes its sign, between neighbours of ascending numbers with their values; NaN is below zero.

    ``among`` says of each pair of neighbours whether it is looked at.
    """
    holds = values >= 0
    cells = np.flatnonzero((holds[1:] != holds[:-1]) & (True if among is None else among))
    if not len(cells):
        return []
    low, high = np.array([x[cells], values[cells]]), np.array([x[cells + 1], values[cells + 1]])
    first = np.abs(high[1] - low[1])
    for _ in range(ROUNDS):
        open_ = high[0] - low[0] > close * np.maximum(np.abs(low[0]), np.abs(high[0]))
        if not open_.any():
            break
        low[:, open_], high[:, open_] = _narrower(function, low[:, open_], high[:, open_])
    return [_crossing(low[:, i], high[:, i], first[i]) for i in range(len(cells))]


def _narrower(function: Function, low: Array, high: Array) -> tuple[Array, Array]:
    """The same brackets, each between the two of the numbers within it where the sign changes first."""
    share = _shares(low[1], high[1])
    places = low[0] + share * (high[0] - low[0])
    found = function(places.ravel()).reshape(places.shape)
    x = np.concatenate([low[:1], places, high[:1]])
    values = np.concatenate([low[1:], found, high[1:]])
    holds = values >= 0
    cell = np.argmax(holds[1:] != holds[:-1], axis=0)
    column = np.arange(x.shape[1])
    return (
        np.array([x[cell, column], values[cell, column]]),
        np.array([x[cell + 1, column], values[cell + 1, column]]),
    )


def _shares(low: Array, high: Array) -> Array:
    """Where to look in each bracket, as ascending shares of its width, shape (places, brackets)."""
    with np.errstate(all="ignore"):
        line = low / (low - high)
    line = np.where(np.isfinite(line), line, 0.5)
    near = np.clip(line[None] + AROUND[:, None], 1e-6, 1 - 1e-6)
    count = max(LEAST_EVEN, EVEN // len(low))
    even = np.broadcast_to(np.arange(1, count + 1)[:, None] / (count + 1), (count, len(low)))
    return np.sort(np.concatenate([even, near]), axis=0)


def _crossing(low: Array, high: Array, first: float) -> Crossing:
    inside = low if low[1] >= 0 else high
    left = abs(high[1] - low[1])
    is_jump = not np.isfinite(left) or (left > JUMP * first and inside[1] != 0)
    at = inside[0] if is_jump or not left else low[0] - low[1] * (high[0] - low[0]) / (high[1] - low[1])
    return Crossing(float(at), float(inside[0]), bool(is_jump))


def greatest(function: Function, x: Array, values: Array) -> tuple[float, float]:
    """Return where a function is greatest and its value there, refined from values at ascending numbers, of which some are not NaN."""
    best = int(np.nanargmax(values))
    low, high = x[max(best - 1, 0)], x[min(best + 1, len(x) - 1)]
    rounds = ZOOMS if high > low else 1
    place, depth = numerics.least(
        lambda at, _: np.nan_to_num(-function(at[0]), nan=np.inf)[None],
        np.array([low]),
        np.array([high]),
        PARTS,
        rounds,
    )
    return (float(place[0]), float(-depth[0])) if -depth[0] > values[best] else (float(x[best]), float(values[best]))


def looked_closer(function: Function, x: Array, values: Array) -> tuple[Array, Array]:
    """Return ascending numbers and values with more of them where a pair of roots, or the end of what exists, may hide.

    Towards each such end they stand closer with each round: much may happen there, and all that exists may lie between two of the numbers.
    """
    cells = np.unique(np.concatenate([_edges(values), _lows(values)])).astype(int)
    for _ in range(SEARCH_ROUNDS):
        if not len(cells):
            break
        x, values = _with_more(function, x, values, cells)
        cells = _edges(values)[:MOST_CELLS]
    return x, values


def without_gaps(function: Function, x: Array, values: Array) -> tuple[Array, Array]:
    """Return ascending numbers and values with more of them between neighbours that are not below zero, as long as one there is."""
    for _ in range(HALVED):
        cells = np.flatnonzero((values[1:] >= 0) & (values[:-1] >= 0))
        before = int((~(values >= 0)).sum())
        if len(cells):
            x, values = _with_more(function, x, values, cells, HALF)
        if int((~(values >= 0)).sum()) == before:
            break
    return x, values


def _with_more(
    function: Function, x: Array, values: Array, cells: Array, shares: Array = EIGHTHS
) -> tuple[Array, Array]:
    more = (x[cells] + shares[:, None] * (x[cells + 1] - x[cells])).ravel()
    joined, place = np.unique(np.concatenate([x, more]), return_index=True)
    return joined, np.concatenate([values, function(more)])[place]


def _edges(values: Array) -> Array:
    """The pairs of neighbours of which one alone has a value."""
    exists = np.isfinite(values)
    return np.flatnonzero(exists[1:] != exists[:-1])


def _lows(values: Array) -> Array:
    """The pairs of neighbours beside a value that is nearest to zero, and may reach it between them."""
    size, inner = np.abs(values), np.arange(1, len(values) - 1)
    with np.errstate(invalid="ignore"):
        signs = np.sign(values)
        alike = (signs[inner - 1] == signs[inner]) & (signs[inner] == signs[inner + 1])
        rise = np.maximum(size[inner - 1], size[inner + 1]) - size[inner]
        is_lowest = (size[inner] <= size[inner - 1]) & (size[inner] <= size[inner + 1])
        low = inner[alike & is_lowest & (size[inner] <= rise)]  # else it is too far from zero to reach it
    return np.concatenate([low - 1, low])


# All places of a range where a function takes a value: passed through, stayed at, or hidden beside an end of what exists.


SAME_PLACE = 1e-8  # relative: two roots that are no further apart are one
NEARER = 60  # machines about today's value, as far as the nearest root that was found


def roots(
    function: Function, x: Array, values: Array, present: float | None, allows: Callable[[Array], Array]
) -> tuple[list[float], list[float]]:
    """Return where a function is zero, ascending, and where it jumps over zero; of places that are all zero the ends, and ``present``.

    It is searched between ascending numbers with their values, and closer about today's, so that the nearest root is not missed.
    """
    x, values = looked_closer(function, x, values)
    places, jumps = _crossed(function, x, values, present)
    more = _about(present, places, x, allows) if places else _about_the_nearest(function, x, values)
    if not len(more):
        return places, jumps
    x = np.union1d(x, more)
    return _crossed(function, x, function(x), present)


def _crossed(function: Function, x: Array, values: Array, present: float | None) -> tuple[list[float], list[float]]:
    """The places between these numbers alone."""
    places: list[float] = []
    jumps: list[float] = []
    for run in runs(np.isfinite(values)):
        own, known = x[run], values[run]
        for each in crossings(function, own, known):
            (jumps if each.is_jump else places).append(each.at)
        ends = ((known[1:] == 0) != (known[:-1] == 0)) & (known[1:] >= 0) & (known[:-1] >= 0)
        places += [each.at for each in crossings(lambda at: -function(at), own, -known, among=ends)]
    beside = np.concatenate([[np.nan], values, [np.nan]])
    before, after = beside[:-2], beside[2:]
    is_kept = ((before == 0) | (after == 0)) & np.isfinite(before) & np.isfinite(after)  # its ends are found
    taken = [float(each) for each in x[(values == 0) & (~is_kept | (x == present))]]
    found = [each for each in places if all(abs(each - one) > SAME_PLACE * abs(one) for one in taken)]
    return sorted([*taken, *found]), jumps


def _about(present: float | None, places: list[float], x: Array, allows: Callable[[Array], Array]) -> Array:
    """Numbers about today's value, as far as the nearest place: another may lie nearer."""
    if present is None:
        return np.array([])
    reach = min(abs(each - present) for each in places)
    near = np.linspace(present - reach, present + reach, NEARER + 1)
    return np.asarray(near[(near > x[0]) & (near < x[-1]) & allows(near)])


def _about_the_nearest(function: Function, x: Array, values: Array) -> Array:
    """Numbers about the one whose value comes nearest to zero: it may change its sign beside it."""
    tried: list[float] = []

    def nearness(places: Array) -> Array:
        tried.extend(places.tolist())
        return -np.abs(function(places))

    greatest(nearness, x, -np.abs(values))
    return np.array(tried)


def runs(holds: Array) -> list[slice]:
    """Return the runs of neighbours that all hold."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], holds, [False]]).astype(int)))
    return [slice(int(first), int(last)) for first, last in zip(edges[::2], edges[1::2], strict=True)]
