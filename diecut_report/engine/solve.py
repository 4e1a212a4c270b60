"""Roots, crossings and integrals, on arrays of variants; each is proved by a second way before it is used."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.polynomial import chebyshev
from scipy.fft import dct
from scipy.optimize import elementwise

from diecut_report.contract.binding import bound
from diecut_report.contract.families import taken
from diecut_report.contract.steps import Accumulated, Derivative, Root
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.domain import LOBATTO, SMALLEST
from diecut_report.engine.series import PieceSeries
from diecut_report.expressions import Array
from diecut_report.units import unit

ORDERS = (24, 48, 96, 192, 384)  # of Gauss–Legendre; the next one proves the one before
INTEGRAL_TOLERANCE = 1e-11
SAMPLE_TOLERANCE = 1e-8
NEGLIGIBLE = 1e-17  # share of the greatest Chebyshev coefficient below which the last ones are left out
ROUNDING = 1e-14  # share of a difference's terms that may be rounding
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


def integral(calc: Calculation, curve: str, power: int) -> tuple[Array, Array]:
    """∫ curve^power over the period, piece by piece, and its relative difference to the next higher order of the rule."""
    scale = _gauss(calc, curve, ORDERS[0], lambda f: np.abs(f) ** power)
    last = _gauss(calc, curve, ORDERS[0], lambda f: f**power)
    for order in ORDERS[1:]:
        now = _gauss(calc, curve, order, lambda f: f**power)
        difference = np.abs(now - last) / np.maximum(scale, SMALLEST)
        last = now
        if np.nanmax(difference, initial=0.0) < INTEGRAL_TOLERANCE:
            break
    return last, difference


def _gauss(calc: Calculation, curve: str, order: int, of: Callable[[Array], Array]) -> Array:
    weights = calc.domains[calc.axis[curve]].gauss(order)[1].reshape(calc.count, -1)
    values = calc.at_gauss_points(curve, order)
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


def dips(calc: Calculation, curve: str) -> Array:
    """Places where a curve dips beyond zero and back between two points of the search grid, shape (variants, most), NaN-padded."""
    domain = calc.domains[calc.axis[curve]]
    grid, heights = domain.search_grid(), calc.on_search_grid(curve)
    side = np.sign(heights)
    before, here, after = (np.abs(heights[:, :, part]) for part in (slice(None, -2), slice(1, -1), slice(2, None)))
    same = (side[:, :, :-2] == side[:, :, 1:-1]) & (side[:, :, 1:-1] == side[:, :, 2:])
    near = (here <= before) & (here <= after) & (2 * here <= np.maximum(before, after))  # a dip no deeper than its rise
    rows, piece, k = np.nonzero(same & near & (domain.widths > 0)[:, :, None])
    if not len(rows):
        return np.full((calc.count, 0), np.nan)

    def depth(x: Array, row: Array, middle: Array, sign: Array) -> Array:
        height: Array = sign * _at(calc, curve, x, row, middle)
        return height

    left, centre, right = (grid[rows, piece, k + i] for i in range(3))
    found = elementwise.find_minimum(
        depth,
        (left, centre, right),
        args=(rows.astype(float), domain.middles[rows, piece], side[rows, piece, k]),
    )
    places = np.where(found.f_x < 0, found.x, np.nan)
    return _rows_of(places, rows, calc.count, np.zeros(calc.count, dtype=bool))


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


def accumulate(calc: Calculation, step: Accumulated) -> Array:
    """Make the running integral of a curve known; gives its relative difference to the integral by another rule, (variants, 1)."""
    domain = calc.domains[calc.axis[step.of]]
    values, series = _series(calc, step.of)
    integrated = chebyshev.chebint(series, lbnd=-1) * domain.widths / 2
    ends = np.cumsum(integrated.sum(axis=0), axis=1)
    integrated[0] += np.concatenate([np.zeros((calc.count, 1)), ends[:, :-1]], axis=1)
    sizes = np.nanmax(np.abs(integrated), axis=(1, 2), initial=0)
    order = int(np.max(np.nonzero(sizes > NEGLIGIBLE * sizes.max(initial=0))[0], initial=0)) + 1
    calc.curves[step.id] = step
    calc.series[step.id] = PieceSeries(domain.edges, integrated[:order])
    whole, _ = integral(calc, step.of, 1)
    scale = np.max(np.abs(values), axis=(1, 2))[:, None] * domain.period
    noise = ROUNDING * _terms(calc, step.of) * domain.period
    residual: Array = np.maximum(np.abs(ends[:, -1:] - whole) - noise, 0) / np.maximum(scale, SMALLEST)
    return residual


def _series(calc: Calculation, curve: str) -> tuple[Array, Array]:
    """A curve on the search grid, zero in pieces without a width, and the Chebyshev series of its pieces.

    The series have the shape (order, variants, pieces).
    """
    wide = calc.domains[calc.axis[curve]].widths > 0
    values = np.where(wide[:, :, None], calc.on_search_grid(curve), 0)
    series = np.moveaxis(dct(values[:, :, ::-1], type=1, axis=2), 2, 0) / LOBATTO
    series[[0, -1]] /= 2
    return values, series


def differentiate(calc: Calculation, step: Derivative) -> Array:
    """Make the derivative of a curve known; gives how far the series is from the curve elsewhere, relative, (variants, 1)."""
    domain = calc.domains[calc.axis[step.of]]
    values, series = _series(calc, step.of)
    sizes = np.abs(series)
    series[sizes <= ROUNDING * sizes.max(axis=0)] = 0  # rounding would grow with the square of the order
    half = np.where(domain.widths > 0, domain.widths, np.inf) / 2
    calc.curves[step.id] = step
    calc.series[step.id] = PieceSeries(domain.edges, chebyshev.chebder(series) / half)
    x, middle = domain.flat_gauss(ORDERS[0])
    apart = np.abs(PieceSeries(domain.edges, series).values(x, middle, None) - calc.at_gauss_points(step.of, ORDERS[0]))
    apart = np.where(np.repeat(domain.widths > 0, ORDERS[0], axis=1), apart, 0)
    top = np.max(np.abs(values), axis=(1, 2))[:, None]
    residual: Array = np.max(apart, axis=1, keepdims=True) / np.maximum(top, SMALLEST)
    return residual


def _terms(calc: Calculation, curve: str) -> Array:
    """The size of what a curve may be the difference of, shape (variants, 1): its own rounding cannot be less than that share."""
    declared = calc.steps[curve]
    kind = unit(declared.unit).kind
    sizes = [np.zeros((calc.count, 1))]
    for name in taken(declared):
        if unit(getattr(calc.step_or_input(name), "unit", "1")).kind != kind:
            continue
        values = calc.on_search_grid(name).reshape(calc.count, -1) if name in calc.curves else calc[name]
        if isinstance(values, np.ndarray):  # a curve input is counted where it is taken over
            sizes.append(np.max(np.abs(values), axis=1, keepdims=True))
    greatest: Array = np.maximum.reduce(sizes)
    return greatest
