"""Extremes of curves on arrays of variants: every local extreme that may be the greatest is refined by a bounded search."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import elementwise

from diecut_report.engine.calculation import Calculation
from diecut_report.engine.domain import Domain
from diecut_report.expressions import Array

PLACE_TOLERANCE = 1e-7  # of an extreme's place; its value errs by the square of it


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
    share: Array = np.maximum(beyond, 0) / np.maximum(top, np.finfo(float).tiny)
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
        return depth(x[rows], seen.which[rows], seen.variant[rows], seen.middle[rows])

    every = np.ones(len(seen.place), dtype=bool)
    at_end = (seen.place == seen.left) | (seen.place == seen.right)
    centre = np.where(at_end, (seen.left + seen.right) / 2, seen.place)
    left, middle, right = (depth_of(x, every) for x in (seen.left, centre, seen.right))
    inner = (middle <= left) & (middle <= right) & (seen.left < centre) & (centre < seen.right)
    if not inner.any():
        return seen
    searched = elementwise.find_minimum(
        depth,
        (seen.left[inner], centre[inner], seen.right[inner]),
        args=(seen.which[inner].astype(float), seen.variant[inner].astype(float), seen.middle[inner]),
        tolerances={"xrtol": PLACE_TOLERANCE},
    )
    better = -searched.f_x >= seen.height[inner]
    place, height = seen.place.copy(), seen.height.copy()
    place[inner] = np.where(better, searched.x, place[inner])
    height[inner] = np.where(better, -searched.f_x, height[inner])
    return seen._replace(place=place, height=height)
