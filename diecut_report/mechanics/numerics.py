"""Roots and least values in many brackets at once, and series of Chebyshev polynomials.

Roots of smooth functions take few evaluations (Chandrupatla, Advances in Engineering Software 28 (1997), 145–149).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from diecut_report.formulas import Array

MOST = 100  # evaluations in one bracket

Function = Callable[[Array, Array], Array]  # of places and the numbers of their brackets


def root(function: Function, low: Array, high: Array, within: float = 0.0) -> Array:
    """Return the root in each bracket, to rounding or ``within`` it; NaN where the function does not change its sign, or has no value."""
    low, high, every = np.asarray(low, dtype=float), np.asarray(high, dtype=float), np.arange(len(low))
    heights = np.stack([function(low, every), function(high, every)])
    row = np.flatnonzero(np.sign(heights[0]) * np.sign(heights[1]) <= 0)
    found = np.full(len(low), np.nan)
    if len(row):
        with np.errstate(all="ignore"):  # where a step cannot be told by interpolation, the bracket is halved
            place, left = narrowed(lambda x, own: function(x, row[own]), low[row], high[row], heights[:, row], within)
        found[row] = np.where(np.isnan(left), np.nan, place)
    return found


def narrowed(function: Function, low: Array, high: Array, heights: Array, within: float = 0.0) -> tuple[Array, Array]:
    """Return the root and what is left there in brackets with a change of sign; ``heights`` (2, brackets) are the values at their ends."""
    best, value = np.full_like(low, np.nan), np.full_like(low, np.nan)
    row = np.arange(len(low))
    state = np.stack([high, low, low, heights[1], heights[0], heights[0], np.full_like(low, 0.5)])
    for _ in range(MOST if len(low) else 0):
        a, b, _, fa, fb, _, share = state
        place = a + share * (b - a)
        found = function(place, row)
        kept = np.sign(found) == np.sign(fa)
        state = np.stack([place, np.where(kept, b, a), np.where(kept, a, b), found, np.where(kept, fb, fa),
                          np.where(kept, fa, fb), share])  # fmt: skip
        a, b, _, fa, fb, *_ = state
        close = np.maximum(2 * np.spacing(np.maximum(np.abs(a), np.abs(b))), within / 2)
        least = close / np.where(b == a, 1, np.abs(b - a))
        is_a = np.abs(fa) < np.abs(fb)
        top, left = np.where(is_a, a, b), np.where(is_a, fa, fb)
        going = (least <= 0.5) & (left != 0)
        if not going.all():
            best[row[~going]], value[row[~going]] = top[~going], left[~going]
            state, row, least = state[:, going], row[going], least[going]
            if not len(row):
                break
        state[6] = _between(state, least)
    return best, value


def _between(state: Array, least: Array) -> Array:
    """The share of the bracket for the next place: by inverse quadratic interpolation where it may be trusted, else half."""
    a, b, c, fa, fb, fc, _ = state
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    trusted = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi)
    share = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.clip(np.where(trusted, share, 0.5), least, 1 - least)


# Places in many brackets at once by looking closer and closer: for what is no smooth function.


PARTS, ROUNDS = 16, 15  # of a bracket, and how often it is looked at: down to the rounding of a place


def first(holds: Function, low: Array, high: Array, parts: int = PARTS, rounds: int = ROUNDS) -> tuple[Array, Array]:
    """Return the neighbouring places (brackets,) in each bracket of which the second is the first where something holds.

    ``holds`` is asked at places (brackets, points); at the high end it is taken to hold, at the low one not to.
    """
    each = np.arange(len(low))
    for _ in range(rounds if len(low) else 0):
        places = low[:, None] + (high - low)[:, None] * _even(parts)
        places[:, -1] = high  # to the last bit
        found = holds(places, each)[:, 1:]
        found[:, -1] = True
        index = found.argmax(axis=1)
        low, high = places[each, index], places[each, index + 1]
    return low, high


def least(
    function: Function, low: Array, high: Array, parts: int = PARTS, rounds: int = ROUNDS,
    goes_on: Callable[[Array], bool] | None = None,
) -> tuple[Array, Array]:  # fmt: skip
    """Return where a function of places (brackets, points) is least in each bracket, and its value there.

    It is looked at as long as ``goes_on`` says of its values, by default so many times.
    """
    places, values = looks(function, low, high, parts, rounds, goes_on)
    each, best = np.arange(len(low)), values.argmin(axis=1)
    return places[each, best], values[each, best]


def looks(
    function: Function, low: Array, high: Array, parts: int = PARTS, rounds: int = ROUNDS,
    goes_on: Callable[[Array], bool] | None = None,
) -> tuple[Array, Array]:  # fmt: skip
    """Return the equally spaced places (brackets, parts + 1) of the last look at where a function is least, and its values there."""
    each = np.arange(len(low))
    for number in range(rounds):
        places = low[:, None] + (high - low)[:, None] * _even(parts)
        values = np.broadcast_to(function(places, each), places.shape)
        if number + 1 == rounds or not len(low) or (goes_on is not None and not goes_on(values)):
            break
        best = values.argmin(axis=1)
        low, high = places[each, np.maximum(best - 1, 0)], places[each, np.minimum(best + 1, parts)]
    return places, values


@cache
def _even(parts: int) -> Array:
    return np.linspace(0, 1, parts + 1)


def vertex(places: Array, values: Array) -> Array:
    """Return where a parabola through the least of values at equally spaced places (rows, points) and its neighbours is lowest.

    It is at most half a spacing from the least; the place of the least itself where that is the first or the last.
    """
    row, best = np.arange(len(values)), values.argmin(axis=1)
    inner = np.clip(best, 1, values.shape[1] - 2)
    before, here, after = (values[row, inner + step] for step in (-1, 0, 1))
    bend = before - 2 * here + after
    found = np.where((bend > 0) & (best == inner), (before - after) / (2 * np.where(bend > 0, bend, 1.0)), 0.0)
    lowest: Array = places[row, best] + np.clip(found, -0.5, 0.5) * (places[:, 1] - places[:, 0])
    return lowest


def in_rows(places: Array, row: Array, count: int) -> Array:
    """Return places as rows (count, most), each in its row (ascending), NaN behind them."""
    number = np.bincount(row, minlength=count)
    found = np.full((count, int(number.max(initial=0))), np.nan)
    found[row, np.arange(len(row)) - (np.cumsum(number) - number)[row]] = places
    return found


# Chebyshev series of many pieces at many places, in blocks that stay in the processor's cache.


BLOCK = 8192  # places at once


def at_places(terms: Array, piece: Array, x: Array) -> Array:
    """Return the series of pieces at places x in [-1, 1] (rows, points), by Clenshaw's recurrence.

    ``terms`` (degrees, pieces) are the coefficients, ``piece`` (rows, points), or (rows, 1) where a row lies in a single one.
    """
    found = np.empty(x.shape)
    size = max(1, BLOCK // max(1, x.shape[1]))
    for start in range(0, len(x), size):
        part = slice(start, start + size)
        found[part] = _summed(terms, np.ascontiguousarray(piece[part]), x[part])
    return found


def _summed(terms: Array, piece: Array, x: Array) -> Array:
    twice, product = 2 * x, np.empty(x.shape)
    after, here = np.zeros((2, *x.shape))
    own = terms.take(piece, axis=1)
    for coefficients in own[:0:-1]:
        np.multiply(twice, here, product)  # named arguments take as long as a few places
        np.subtract(product, after, after)
        np.add(after, coefficients, after)
        after, here = here, after
    np.multiply(x, here, product)
    product -= after
    product += own[0]
    return product


def of_legendre(count: int) -> Array:
    """Return the matrix that makes Chebyshev coefficients of so many Legendre coefficients.

    P_n(cos t) is the sum over k of a_k a_(n-k) cos((n-2k) t), where a_k = (1·3·…·(2k-1)) / (2·4·…·2k): no term is a difference.
    """
    shares = np.cumprod(np.concatenate([[1.0], (np.arange(1, count) - 0.5) / np.arange(1, count)]))
    found = np.zeros((count, count))
    for degree in range(count):
        for k in range(degree + 1):
            found[abs(degree - 2 * k), degree] += shares[k] * shares[degree - k]
    return found
