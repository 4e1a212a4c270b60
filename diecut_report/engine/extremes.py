"""Extremes of curves on arrays of variants: every local extreme that may be the greatest is refined by a bounded search."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import elementwise

from diecut_report.engine.calculation import Calculation
from diecut_report.engine.domain import SMALLEST, Domain
from diecut_report.expressions import Array

PLACE_TOLERANCE = 1e-6  # of an extreme's place, as a share of its bracket; its value errs by the square of it
APPROACH = 12  # steps by which an end of a piece is approached, each a quarter of the one before


Wanted = tuple[str, float]  # a curve, and 1 for its greatest or -1 for its least value
Found = tuple[Array, Array, Array]  # value, place, middle of the smooth piece; each of shape (variants, 1)


class Candidates(NamedTuple):
    """Places that may be an extreme, one row each: which one, variant, place, height there, middle of the piece, bracket."""

    which: Array
    variant: Array
    place: Array
    height: Array
    middle: Array
    left: Array
    right: Array


def extreme(calc: Calculation, curve: str, sign: float) -> Found:
    """Greatest (sign 1) or least (sign -1) value over the period, one-sided limits included."""
    search(calc, [(curve, sign)])
    return calc.extremes[curve, sign][1]


def search(calc: Calculation, wanted: Sequence[Wanted]) -> None:
    """Find several extremes over one abscissa at once; those that are known for the present pieces are kept."""
    domain = calc.domains[calc.axis[wanted[0][0]]]
    known = {w for w in wanted if w in calc.extremes and calc.extremes[w][0] is domain.edges}
    open_ones = [w for w in dict.fromkeys(wanted) if w not in known]
    if not open_ones:
        return
    heights = [sign * calc.on_search_grid(curve) for curve, sign in open_ones]
    parts = [_candidates(domain, i, height) for i, height in enumerate(heights)]
    seen = _refined(calc, open_ones, Candidates(*(np.concatenate(columns) for columns in zip(*parts, strict=True))))
    for i, (height, (curve, sign)) in enumerate(zip(heights, open_ones, strict=True)):
        impossible: Array = np.asarray(np.isnan(height).all(axis=(1, 2)))
        calc.extremes[curve, sign] = domain.edges, _best(calc, seen, seen.which == i, sign, impossible)


def _best(calc: Calculation, seen: Candidates, own: Array, sign: float, impossible: Array) -> Found:
    """The greatest candidate of each variant."""
    variant, height = seen.variant[own], seen.height[own]
    order = np.lexsort((height, variant))
    best = order[np.searchsorted(variant[order], np.arange(calc.count), side="right") - 1]
    value, place, middle = (
        np.where(impossible, np.nan, part[best])[:, None] for part in (sign * height, seen.place[own], seen.middle[own])
    )
    return value, place, middle


def outruns(calc: Calculation, curve: str, found: Array, sign: float) -> Array:
    """How far the sampled curve goes beyond the extreme found, relative to the curve's greatest value: the proof of it."""
    samples = calc.curve_samples(curve)
    beyond = np.max(sign * (samples - found), axis=1, keepdims=True)
    top = np.max(np.abs(samples), axis=1, keepdims=True)
    share: Array = np.maximum(beyond, 0) / np.maximum(top, SMALLEST)
    return share


def _candidates(domain: Domain, which: int, curve_heights: Array) -> Candidates:
    """Points of the grid not below their neighbours, and near enough to the greatest that a search may lift them above it.

    Near enough: a smooth curve rises between two points by less than what it falls to the next ones.
    """
    heights = np.where((domain.widths > 0)[:, :, None], np.nan_to_num(curve_heights, nan=-np.inf), -np.inf)
    low = np.full((*heights.shape[:2], 1), -np.inf)
    before = np.concatenate([low, heights[:, :, :-1]], axis=2)
    after = np.concatenate([heights[:, :, 1:], low], axis=2)
    with np.errstate(invalid="ignore"):  # -inf beside -inf, where a piece has no width
        fall = np.maximum(*(np.where(np.isfinite(side), heights - side, 0) for side in (before, after)))
    greatest = heights.max(axis=(1, 2), keepdims=True)
    variant, piece, k = np.nonzero((heights >= before) & (heights >= after) & (heights + fall >= greatest))
    grid, last = domain.search_grid(), heights.shape[2] - 1
    left, right = grid[variant, piece, np.maximum(k - 1, 0)], grid[variant, piece, np.minimum(k + 1, last)]
    return Candidates(
        np.full(len(variant), which),
        variant,
        grid[variant, piece, k],
        heights[variant, piece, k],
        domain.middles[variant, piece],
        left,
        right,
    )


def _refined(calc: Calculation, wanted: Sequence[Wanted], seen: Candidates) -> Candidates:
    """The candidates after a search in their brackets; at a piece's end within its first interval."""

    def depth(x: Array, which: Array, variant: Array, middle: Array) -> Array:
        curves = calc.sampler(wanted[0][0], x[:, None], middle[:, None], variant.astype(int))
        choices = [np.broadcast_to(-sign * curves[curve], (len(x), 1))[:, 0] for curve, sign in wanted]
        chosen: Array = np.choose(which.astype(int), choices)
        return chosen

    def depth_of(x: Array, rows: Array) -> Array:
        return depth(x, seen.which[rows], seen.variant[rows], seen.middle[rows])

    low, centre, high = _brackets(seen, depth_of)
    every = np.arange(len(centre))
    left, middle, right = (depth_of(x, every) for x in (low, centre, high))
    inner = (middle <= left) & (middle <= right) & (low < centre) & (centre < high)
    if not inner.any():
        return seen
    start, width = low[inner], (high - low)[inner]

    def depth_at(share: Array, row: Array) -> Array:
        rows = row.astype(int)
        return depth_of(start[rows] + share * width[rows], np.flatnonzero(inner)[rows])

    searched = elementwise.find_minimum(
        depth_at,
        (np.zeros(len(start)), (centre[inner] - start) / width, np.ones(len(start))),
        args=(np.arange(len(start), dtype=float),),
        tolerances={"xatol": PLACE_TOLERANCE, "xrtol": 0.0},
    )
    better = -searched.f_x >= seen.height[inner]
    place, height = seen.place.copy(), seen.height.copy()
    place[inner] = np.where(better, start + searched.x * width, place[inner])
    height[inner] = np.where(better, -searched.f_x, height[inner])
    return seen._replace(place=place, height=height)


def _brackets(seen: Candidates, depth_of: Callable[[Array, Array], Array]) -> tuple[Array, Array, Array]:
    """Three places about each candidate: its neighbours on the grid and itself.

    At a piece's end a peak may hide between the end and the next point: there the deepest of places that come nearer and
    nearer to the end, between its neighbours among these.
    """
    at_end = np.flatnonzero((seen.place == seen.left) | (seen.place == seen.right))
    left, centre, right = seen.left.copy(), seen.place.copy(), seen.right.copy()
    if len(at_end):
        end = seen.place[at_end, None]
        inward = (seen.left + seen.right)[at_end, None] - 2 * end
        places = end + inward * np.concatenate([[1.0], 4.0 ** -np.arange(1, APPROACH), [0.0]])
        rows = np.repeat(at_end, places.shape[1])
        best = np.argmin(depth_of(places.ravel(), rows).reshape(places.shape)[:, 1:-1], axis=1) + 1
        row = np.arange(len(at_end))
        around = np.stack([places[row, best + 1], places[row, best - 1]])
        left[at_end], right[at_end], centre[at_end] = around.min(axis=0), around.max(axis=0), places[row, best]
    return left, centre, right
