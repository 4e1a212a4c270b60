"""Roots, crossings and integrals, on arrays of variants; each is proved by a second way before it is used."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import chebyshev

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.numerics.domain import SMALLEST, PieceSeries, grid_weights, nodes_of
from diecut_report.mechanics import numerics
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.names import formula_of
from diecut_report.mechanism.steps import Accumulated, Derivative, Root
from diecut_report.quantities.units import unit

ORDERS = (24, 48, 96, 192, 384)  # of the Gauss–Legendre rules that follow where the search grid's rule is not proved
INTEGRAL_TOLERANCE = 1e-11
SAMPLE_TOLERANCE = 1e-8
NEGLIGIBLE = 1e-17  # share of the greatest Chebyshev coefficient below which the last ones are left out
ROUNDING = 1e-14  # share of a difference's terms that may be rounding
DIP_LOOKS = 9  # closer and closer at a dip: to 1e-8 of its bracket
POLE = 1e3  # times the size of an equation at the ends of its bracket: what changes its sign with more is a pole
BESIDE = (
    0.0,
    0.31,
    0.5,
    0.77,
    1.0,
)  # shares of a bracket at which the relation is not to hold, but for one that is the root
NARROW = 1e-3  # of its ends: a bracket in which a relation may hold to rounding everywhere
SEARCHES = 5  # for crossings, each on a finer grid
NOISE = 1e-10  # share of a curve's greatest value below which its sign is rounding


def root(calc: Calculation, step: Root) -> tuple[Array, Array]:
    """Return the root in the bracket, shape (variants, 1), and how far left and right of its relation differ there, relative.

    The difference is infinite where the equation has a pole there, and no root.
    """
    equation = formula_of(step.equation)

    def residual(x: Array, rows: Array) -> Array:
        result: Array = equation(*(x if name == step.unknown else calc[name][rows, 0] for name in equation.parameters))
        return result

    low, high = (calc.apply(end)[:, 0] for end in (step.low, step.high))
    found, every = numerics.root(residual, low, high), np.arange(calc.count)
    ends = np.maximum(np.abs(residual(low, every)), np.abs(residual(high, every)))
    is_pole = np.abs(residual(found, every)) > POLE * ends
    difference, _ = _unequal(calc, step, found)
    return found[:, None], np.where(is_pole[:, None], np.inf, difference)


def proves_nothing(calc: Calculation, step: Root) -> Array:
    """Return where the relation of a root holds in the whole of its bracket, not at the root alone, shape (variants,).

    Sides that are zero throughout, as of a machine without the gap that they are about, are as they may be.
    """
    low, high = (calc.apply(end)[:, 0] for end in (step.low, step.high))
    found = calc.values[step.id]
    is_wide = high - low > NARROW * np.maximum(np.abs(low), np.abs(high))
    beside = [_unequal(calc, step, low + share * (high - low)) for share in BESIDE]
    calc.values[step.id] = found
    differences, sizes = (np.concatenate(each, axis=1) for each in zip(*beside, strict=True))
    holds: Array = np.all(differences <= step.tolerance, axis=1) & np.any(sizes > 0, axis=1)
    return holds & is_wide


def _unequal(calc: Calculation, step: Root, places: Array) -> tuple[Array, Array]:
    """How far left and right differ, relative, with the unknown at these places (variants,), and their size; the places are the root then."""
    calc.values[step.id] = places[:, None]
    left, right = calc.apply(step.left), calc.apply(step.right)
    size = np.maximum(np.abs(left), np.abs(right))
    return np.abs(left - right) / np.maximum(size, SMALLEST), np.broadcast_to(size, (calc.count, 1))


def integral(calc: Calculation, curve: str, power: int) -> tuple[Array, Array]:
    """Return ∫ curve^power over the period, piece by piece, and its relative difference to the rule before.

    The rules follow each other by what they are exact for; each machine keeps the first that agrees with the one before.
    """
    table = calc.table(calc.axis[curve])
    pieces = table.pieces()

    def total(values: Array, weights: Array, rows: Array | slice = slice(None)) -> Array:
        parts = ((values if power == 1 else values**power) @ weights) * pieces.width[rows]
        return np.bincount(pieces.variant[rows], parts, calc.count)[:, None]

    heights, weights, order = table.on_grid([curve])[0], grid_weights(pieces.intervals), pieces.proof_order
    found = total(heights, weights)
    scale = found if power == 2 else total(np.abs(heights), weights)
    difference = _apart(found, total(table.at_gauss([curve], order)[0], nodes_of(order)[1] / 2), scale)
    for order in filter(lambda order: order > pieces.proof_order, ORDERS):
        is_open = difference >= INTEGRAL_TOLERANCE
        if not is_open.any():
            break
        rows = np.flatnonzero(is_open[pieces.variant])
        now = total(table.curves([curve], rows).at(pieces.gauss(order, rows))[0], nodes_of(order)[1] / 2, rows)
        difference = np.where(is_open, _apart(now, found, scale), difference)
        found = np.where(is_open, now, found)
    return found, difference


def _apart(one: Array, other: Array, scale: Array) -> Array:
    found: Array = np.abs(one - other) / np.maximum(scale, SMALLEST)
    return found


def crossings(calc: Calculation, curve: str) -> tuple[Array, Array]:
    """Return places where the curve changes sign, ascending, padded with NaN, shape (variants, most); and the greatest |curve| at
    those found inside a smooth piece, relative to the curve's greatest value."""
    table = calc.table(calc.axis[curve])
    pieces, heights = table.pieces(), table.on_grid([curve])[0]
    top = pieces.of_variants(np.maximum, np.abs(heights))
    noise = NOISE * top[pieces.variant]
    sign = ((heights > noise).view(np.int8) - (heights < -noise).view(np.int8)).ravel()
    points = heights.shape[1]
    is_last = sign[1:] != sign[:-1]
    is_last[pieces.starts[1:] * points - 1] = True
    run = np.concatenate([[0], np.flatnonzero(is_last) + 1])  # where runs of one sign begin
    run = run[sign[run] != 0]
    variant = pieces.variant[run // points]
    is_change = (sign[run[1:]] != sign[run[:-1]]) & (variant[1:] == variant[:-1])  # zeros count as what is before them
    k = run[1:][is_change] - 1
    piece, rows = k // points, pieces.variant[k // points]
    places = pieces.point(piece, k % points)
    inside = (sign[k] != 0) & (piece == (k + 1) // points)
    worst = np.zeros((calc.count, 1))
    if inside.any():
        places[inside], left = _roots(calc, curve, k[inside])
        np.maximum.at(worst[:, 0], rows[inside], np.abs(left) / top[rows[inside], 0])
    first, last = (run[np.flatnonzero(np.diff(variant, **ends))] for ends in ({"prepend": -1}, {"append": calc.count}))
    at_start = np.zeros(calc.count, dtype=bool)
    at_start[pieces.variant[first // points]] = sign[first] != sign[last]
    found = numerics.in_rows(places, rows, calc.count)
    return np.sort(np.concatenate([found, np.where(at_start, 0.0, np.nan)[:, None]], axis=1), axis=1), worst


def all_crossings(calc: Calculation, curve: str) -> tuple[Array, Array]:
    """Return what ``crossings`` finds, searched again between those found: two may lie between two points of the first grid."""
    domain = calc.domains[calc.axis[curve]]
    edges, joints = domain.edges, domain.joints
    domain.cut(dips(calc, curve))
    found = crossings(calc, curve)
    for _ in range(SEARCHES):
        before = domain.edges
        domain.cut(found[0])
        last = found
        if domain.edges is before:
            break
        found = crossings(calc, curve)
        if np.array_equal(np.isfinite(last[0]).sum(axis=1), np.isfinite(found[0]).sum(axis=1)):
            break
    domain.edges, domain.joints = edges, joints
    return last


def _roots(calc: Calculation, curve: str, k: Array) -> tuple[Array, Array]:
    """Roots between a point of the flat search grid and the next one, and what is left there."""
    table = calc.table(calc.axis[curve])
    pieces, heights = table.pieces(), table.on_grid([curve])[0]
    piece, k = np.divmod(k, heights.shape[1])
    ends = np.stack([k, k + 1])
    low, high = pieces.point(piece, ends)
    own = table.curves([curve], piece)
    return numerics.narrowed(lambda x, row: own.at(x[:, None], row)[0][:, 0], low, high, heights[piece, ends])


def dips(calc: Calculation, curve: str) -> Array:
    """Return places where a curve dips beyond zero and back between two points of the search grid, shape (variants, most), NaN-padded."""
    table = calc.table(calc.axis[curve])
    pieces, heights = table.pieces(), table.on_grid([curve])[0]
    sizes = np.abs(heights)
    lowest = (sizes[:, 1:-1] <= sizes[:, :-2]) & (sizes[:, 1:-1] <= sizes[:, 2:])
    piece, k = np.divmod(np.flatnonzero(lowest), lowest.shape[1])
    before, here, after = (heights[piece, k + i] for i in range(3))
    same = (np.sign(before) == np.sign(here)) & (np.sign(here) == np.sign(after))
    rise = np.maximum(np.abs(before), np.abs(after))
    noise = NOISE * pieces.of_variants(np.maximum, sizes)[pieces.variant, 0]
    # a dip no deeper than its rise; what rests at zero has none
    near = same & (2 * np.abs(here) <= rise) & (rise > noise[piece])
    piece, k = piece[near], k[near]
    if not len(piece):
        return np.full((calc.count, 0), np.nan)
    side, own = np.sign(heights[piece, k])[:, None], table.curves([curve], piece)
    low, high = (pieces.point(piece, k + i) for i in (0, 2))
    place, depth = numerics.least(lambda x, row: side[row] * own.at(x, row)[0], low, high, rounds=DIP_LOOKS)
    return numerics.in_rows(np.where(depth < 0, place, np.nan), pieces.variant[piece], calc.count)


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
    # SciPy's cosine transform gives the same to the last bit, and takes longer to import than all integrals of a press
    mirrored = np.concatenate([values[:, :, ::-1], values[:, :, 1:-1]], axis=2)
    series = np.moveaxis(np.fft.rfft(mirrored).real, 2, 0) / (values.shape[2] - 1)
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
    table = calc.table(calc.axis[step.of])
    pieces, order = table.pieces(), domain.proof_order
    expected = table.at_gauss([step.of], order)[0]
    found = PieceSeries(domain.edges, series).values(
        pieces.gauss(order, slice(None)), pieces.middle[:, None], pieces.variant
    )
    apart = pieces.of_variants(np.maximum, np.abs(found - expected))
    top = np.max(np.abs(values), axis=(1, 2))[:, None]
    residual: Array = apart / np.maximum(top, SMALLEST)
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
