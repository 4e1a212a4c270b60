"""Roots, crossings and integrals, on arrays of variants; each is proved by a second way before it is used."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.optimize import elementwise

from diecut_report.contract.steps import Root, bound
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.domain import LOBATTO
from diecut_report.expressions import Array

ORDERS = (24, 48, 96, 192, 384)  # of Gauss–Legendre; the next one proves the one before
INTEGRAL_TOLERANCE = 1e-11
SAMPLE_TOLERANCE = 1e-8
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
        difference = np.abs(now - last) / np.maximum(scale, np.finfo(float).tiny)
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
