"""Least values in many brackets at once, by few evaluations (Brent)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from diecut_report.expressions import Array

GOLDEN = (3 - 5**0.5) / 2
COARSE = (
    0.02  # share of a bracket to which the least value of a smooth function is searched before a polynomial tells it
)
FOLLOWS = 1e-12  # share of a function's size by which it may be off the polynomial that tells its least value
MOST = 100  # evaluations in one bracket

Function = Callable[[Array, Array], Array]  # of places and the rows of their brackets


def smooth_minimum(
    function: Function, low: Array, centre: Array, high: Array, depths: Array, share: float
) -> tuple[Array, Array]:
    """Find the minimum as ``minimum`` does; where the function is smooth, the place is far more exact than its values could tell by themselves."""
    place, depth = minimum(function, low, centre, high, depths, COARSE)
    place, depth, is_smooth = _at_vertex(function, low, place, high, depth)
    rest = np.flatnonzero(~is_smooth)
    if len(rest):
        place[rest], depth[rest] = minimum(
            lambda x, row: function(x, rest[row]), low[rest], centre[rest], high[rest], depths[:, rest], share
        )
    return place, depth


def _at_vertex(function: Function, low: Array, place: Array, high: Array, depth: Array) -> tuple[Array, Array, Array]:
    """Place and value at the vertex of the polynomial through five places about each, and whether the function follows it."""
    step = np.minimum((high - low) / 32, np.minimum(place - low, high - place) / 2)
    around = place + step * np.array([[-2.0], [-1.0], [1.0], [2.0]])
    row = np.arange(len(place))
    values = function(around.ravel(), np.tile(row, 4)).reshape(4, -1) - depth
    even, odd = values[:2] + values[:1:-1], values[:1:-1] - values[:2]  # of the outer and of the inner places
    first, third = (8 * odd[1] - odd[0]) / 12, (odd[0] - 2 * odd[1]) / 12
    second, fourth = (16 * even[1] - even[0]) / 24, (even[0] - 4 * even[1]) / 24
    s = -first / (2 * second)
    for _ in range(3):
        s = s - (first + s * (2 * second + s * (3 * third + s * 4 * fourth))) / (
            2 * second + s * (6 * third + s * 12 * fourth)
        )
    expected = s * (first + s * (second + s * (third + s * fourth)))
    s = np.where(np.abs(s) <= 2, s, 0)
    vertex = place + s * step
    found = function(vertex, row)
    size = np.abs(depth) + np.abs(values).max(axis=0)
    follows: Array = (
        (np.abs(found - depth - expected) <= FOLLOWS * size) & (found <= depth + FOLLOWS * size) & (step > 0)
    )
    return np.where(follows, vertex, place), np.where(follows, found, depth), follows


def minimum(
    function: Function, low: Array, centre: Array, high: Array, depths: Array, share: float
) -> tuple[Array, Array]:
    """Return the place and the value of the least value in brackets low < centre < high, to a share of each.

    ``depths`` are the known values at the three, of shape (3, brackets), the middle one not above the others.
    """
    best, value = centre.copy(), depths[1].copy()
    row = np.arange(len(centre))
    nearer = depths[0] <= depths[2]
    second, third = np.where(nearer, low, high), np.where(nearer, high, low)
    state = np.stack([low, high, centre, second, third, depths[1], *np.where(nearer, depths[::2], depths[::-2]),
                      high - low, high - low, share * (high - low)])  # fmt: skip
    for _ in range(MOST):
        a, b, x, w, v, fx, fw, fv, last, before, least = state
        going = np.abs(x - (a + b) / 2) > 2 * least - (b - a) / 2
        if not going.all():
            best[row[~going]], value[row[~going]] = x[~going], fx[~going]
            state, row = state[:, going], row[going]
            if not len(row):
                break
            a, b, x, w, v, fx, fw, fv, last, before, least = state
        step, earlier = _step(a, b, x, w, v, fx, fw, fv, last, before, least)
        place = x + step
        state = _taken(state, place, function(place, row), step, earlier)
    best[row], value[row] = state[2], state[5]
    return best, value


def _step(a: Array, b: Array, x: Array, w: Array, v: Array, fx: Array, fw: Array, fv: Array,
          last: Array, before: Array, least: Array) -> tuple[Array, Array]:  # fmt: skip
    """The next step from x, to the top of the parabola through the three best places or into the longer part."""
    r, q = (x - w) * (fx - fv), (x - v) * (fx - fw)
    p, q = (x - v) * q - (x - w) * r, 2 * (q - r)
    p, q = np.where(q > 0, -p, p), np.abs(q)
    longer = np.where(x >= (a + b) / 2, a - x, b - x)
    fits = (np.abs(p) < np.abs(q * before / 2)) & (p > q * (a - x)) & (p < q * (b - x))
    step = np.where(fits, p / np.where(q == 0, 1, q), GOLDEN * longer)
    at_end = fits & ((x + step - a < 2 * least) | (b - x - step < 2 * least))
    step = np.where(at_end, np.copysign(least, (a + b) / 2 - x), step)
    return np.where(np.abs(step) < least, np.copysign(least, step), step), np.where(fits, last, longer)


def _taken(state: Array, u: Array, fu: Array, step: Array, earlier: Array) -> Array:
    """The brackets with one more place."""
    a, b, x, w, v, fx, fw, fv, _, _, least = state
    better = fu <= fx
    second = ~better & ((fu <= fw) | (w == x))
    third = ~better & ~second & ((fu <= fv) | (v == x) | (v == w))
    inner = np.where(better, x, u)  # the place that becomes an end
    left = np.where(better, u >= x, u < x)
    return np.stack([
        np.where(left, inner, a), np.where(left, b, inner), np.where(better, u, x),
        np.where(better, x, np.where(second, u, w)),
        np.where(better | second, w, np.where(third, u, v)),
        np.where(better, fu, fx), np.where(better, fx, np.where(second, fu, fw)),
        np.where(better | second, fw, np.where(third, fu, fv)),
        step, earlier, least,
    ])  # fmt: skip
