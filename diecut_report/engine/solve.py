"""Roots, extremes and integrals, on arrays of variants; each is proved by a second way before it is used."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.optimize import elementwise

from diecut_report.contract.steps import Root, bound
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.domain import LOBATTO, Domain
from diecut_report.expressions import Array

ORDERS = (24, 48, 96, 192, 384)  # of Gauss–Legendre; the next one proves the one before
INTEGRAL_TOLERANCE = 1e-11
SAMPLE_TOLERANCE = 1e-9
PLACE_TOLERANCE = 1e-6  # of an extreme's place; its value errs by the square of it
NOISE = 1e-10  # share of a curve's greatest value below which its sign is rounding


def root(calc: Calculation, step: Root) -> tuple[Array, Array]:
    """The root in the bracket, shape (variants, 1), and how far left and right of its relation differ there, relative."""
    equation = bound(step.equation)

    def residual(x: Array, rows: Array) -> Array:
        known = (
            x if n == step.unknown else calc[n][rows.astype(int), 0] if isinstance(n, str) else n
            for n in equation.names.values()
        )
        result: Array = equation.formula(*known)
        return result

    rows = np.arange(calc.count, dtype=float)
    found = elementwise.find_root(
        residual, (calc.apply(step.low)[:, 0], calc.apply(step.high)[:, 0]), args=(rows,), tolerances={"xrtol": 4e-16}
    )
    calc.values[step.id] = np.where(found.success, found.x, np.nan)[:, None]
    left, right = calc.apply(step.left), calc.apply(step.right)
    return calc.values[step.id], np.abs(left - right) / np.maximum(np.abs(left), np.abs(right))


def _at(calc: Calculation, curve: str, x: Array, rows: Array, middle: Array) -> Array:
    return calc.sample(curve, x[:, None], middle[:, None], rows.astype(int))[:, 0]


def extreme(calc: Calculation, curve: str, sign: float) -> tuple[Array, Array, Array]:
    """Greatest (sign 1) or least (sign -1) value over the period, one-sided limits included.

    Returns value, place and the middle of the smooth piece that it is in, each of shape (variants, 1).
    """
    domain = calc.domains[calc.axis[curve]]
    known = calc.extremes.get((curve, sign))
    if known is None or known[0] is not domain.edges:
        known = domain.edges, _searched(calc, curve, sign, domain)
        calc.extremes[curve, sign] = known
    return known[1]


def _searched(calc: Calculation, curve: str, sign: float, domain: Domain) -> tuple[Array, Array, Array]:
    grid = domain.search_grid()
    heights = np.where((domain.widths > 0)[:, :, None], sign * calc.on_search_grid(curve), -np.inf)
    best = np.nanargmax(np.nan_to_num(heights.reshape(calc.count, -1), nan=-np.inf), axis=1)
    piece, k = np.divmod(best, grid.shape[2])
    rows = np.arange(calc.count)
    middle, place, height = domain.middles[rows, piece], grid[rows, piece, k], heights[rows, piece, k]
    place, height = _refined(partial(_signed, calc, curve, sign), grid[rows, piece], k, (rows, middle), (place, height))
    return (sign * height)[:, None], place[:, None], middle[:, None]


def _signed(calc: Calculation, curve: str, sign: float, x: Array, rows: Array, middle: Array) -> Array:
    return sign * _at(calc, curve, x, rows, middle)


def _refined(
    height_at: Callable[[Array, Array, Array], Array],
    grid: Array,
    k: Array,
    where: tuple[Array, Array],
    best: tuple[Array, Array],
) -> tuple[Array, Array]:
    """Bounded search between the neighbours of the best grid point; at a piece's end within its first interval."""
    rows, middle = where
    place, height = best
    low = np.clip(k - 1, 0, None)
    high = np.clip(k + 1, None, grid.shape[1] - 1)
    left, right = grid[rows, low], grid[rows, high]
    centre = np.where((low == k) | (high == k), (left + right) / 2, place)
    peaks = [height_at(x, rows, middle) for x in (left, centre, right)]
    inner = (peaks[1] >= peaks[0]) & (peaks[1] >= peaks[2]) & (left < centre) & (centre < right)
    if not inner.any():
        return place, height

    def depth_at(x: Array, row: Array, mid: Array) -> Array:
        return -height_at(x, row, mid)

    searched = elementwise.find_minimum(
        depth_at,
        (left[inner], centre[inner], right[inner]),
        args=(rows[inner].astype(float), middle[inner]),
        tolerances={"xrtol": PLACE_TOLERANCE},
    )
    place, height = place.copy(), height.copy()
    better = -searched.f_x >= height[inner]
    place[inner] = np.where(better, searched.x, place[inner])
    height[inner] = np.where(better, -searched.f_x, height[inner])
    return place, height


def outruns(calc: Calculation, curve: str, found: Array, sign: float) -> Array:
    """How far the sampled curve goes beyond the extreme found, relative to the curve's greatest value: the proof of it."""
    samples = calc.curve_samples(curve)
    beyond = np.max(sign * (samples - found), axis=1, keepdims=True)
    top = np.max(np.abs(samples), axis=1, keepdims=True)
    share: Array = np.maximum(beyond, 0) / np.maximum(top, np.finfo(float).tiny)
    return share


def integral(calc: Calculation, curve: str, power: int) -> tuple[Array, Array]:
    """∫ curve^power over the period, piece by piece, and its relative difference to the next higher order of the rule."""
    scale = _gauss(calc, curve, ORDERS[0], lambda f: np.abs(f) ** power)
    last = _gauss(calc, curve, ORDERS[0], lambda f: f**power)
    for order in ORDERS[1:]:
        now = _gauss(calc, curve, order, lambda f: f**power)
        difference = np.abs(now - last) / np.maximum(scale, np.finfo(float).tiny)
        last = now
        if np.nanmax(difference, initial=0.0) < INTEGRAL_TOLERANCE:
            break
    return last, difference


def _gauss(calc: Calculation, curve: str, order: int, of: Callable[[Array], Array]) -> Array:
    domain = calc.domains[calc.axis[curve]]
    x, weight = domain.gauss(order)
    middle = np.broadcast_to(domain.middles[:, :, None], x.shape).reshape(calc.count, -1)
    values = calc.sample(curve, x.reshape(calc.count, -1), middle)
    weights = weight.reshape(calc.count, -1)
    total: Array = np.sum(np.where(weights > 0, of(values) * weights, 0), axis=1, keepdims=True)
    return total


def crossings(calc: Calculation, curve: str) -> tuple[Array, Array]:
    """Places where the curve changes sign, ascending, padded with NaN, shape (variants, most); and the greatest |curve| at
    those found inside a smooth piece, relative to the curve's greatest value."""
    domain = calc.domains[calc.axis[curve]]
    flat, middle = domain.flat_grid()
    heights = calc.on_search_grid(curve).reshape(calc.count, -1)
    top = np.max(np.abs(heights), axis=1, keepdims=True)
    width = np.repeat(domain.widths, LOBATTO + 1, axis=1)
    clear = (np.abs(heights) > NOISE * top) & (width > 0)
    sign = _settled(np.where(clear, np.sign(heights), 0))
    rows, k = np.nonzero(sign[:, :-1] * sign[:, 1:] < 0)
    inside = (middle[rows, k] == middle[rows, k + 1]) & clear[rows, k] & clear[rows, k + 1]
    places = flat[rows, k].copy()
    worst = np.zeros((calc.count, 1))
    if inside.any():
        r, i = rows[inside], k[inside]
        solved = elementwise.find_root(
            partial(_at, calc, curve), (flat[r, i], flat[r, i + 1]), args=(r.astype(float), middle[r, i])
        )
        places[inside] = np.where(solved.success, solved.x, np.nan)
        np.maximum.at(worst[:, 0], r, np.abs(solved.f_x) / top[r, 0])
    return _rows_of(places, rows, calc.count, (sign[:, :1] * sign[:, -1:] < 0)[:, 0]), worst


def _settled(sign: Array) -> Array:
    """Signs with each zero taking over the sign before it; leading zeros take the first one after them."""
    index = np.maximum.accumulate(np.where(sign != 0, np.arange(sign.shape[1]), 0), axis=1)
    forward = np.take_along_axis(sign, index, axis=1)
    first = np.take_along_axis(sign, np.argmax(sign != 0, axis=1)[:, None], axis=1)
    return np.where(forward == 0, first, forward)


def _rows_of(places: Array, rows: Array, count: int, at_start: Array) -> Array:
    """Places found for all variants together, put into one row for each variant, ascending, NaN at the end."""
    per_row = np.bincount(rows, minlength=count)
    table = np.full((count, max(int(per_row.max(initial=0)), 0) + 1), np.nan)
    table[rows, np.arange(len(rows)) - np.repeat(np.cumsum(per_row) - per_row, per_row)] = places
    table[at_start, -1] = 0.0
    return np.sort(table, axis=1)


__all__ = ["SAMPLE_TOLERANCE", "crossings", "extreme", "integral", "outruns", "root"]
