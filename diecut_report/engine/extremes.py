"""Extremes of curves on arrays of variants: every local extreme that may be the greatest is refined by a bounded search."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import elementwise

from diecut_report.engine.calculation import Calculation
from diecut_report.engine.domain import Domain
from diecut_report.expressions import Array

PLACE_TOLERANCE = 1e-6  # of an extreme's place; its value errs by the square of it


class Candidates(NamedTuple):
    """Places that may be the extreme, one row each: variant, place, height there, middle of the piece, and the bracket."""

    variant: Array
    place: Array
    height: Array
    middle: Array
    left: Array
    right: Array


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


def outruns(calc: Calculation, curve: str, found: Array, sign: float) -> Array:
    """How far the sampled curve goes beyond the extreme found, relative to the curve's greatest value: the proof of it."""
    samples = calc.curve_samples(curve)
    beyond = np.max(sign * (samples - found), axis=1, keepdims=True)
    top = np.max(np.abs(samples), axis=1, keepdims=True)
    share: Array = np.maximum(beyond, 0) / np.maximum(top, np.finfo(float).tiny)
    return share


def _searched(calc: Calculation, curve: str, sign: float, domain: Domain) -> tuple[Array, Array, Array]:
    heights = np.where((domain.widths > 0)[:, :, None], sign * calc.on_search_grid(curve), -np.inf)
    place, height, variant, middle = _refined(
        calc, curve, sign, _candidates(domain, np.nan_to_num(heights, nan=-np.inf))
    )
    order = np.lexsort((height, variant))
    last = np.searchsorted(variant[order], np.arange(calc.count), side="right") - 1  # the greatest of each variant
    best = order[last]
    impossible = np.isnan(calc.on_search_grid(curve)).all(axis=(1, 2))
    return tuple(np.where(impossible, np.nan, part[best])[:, None] for part in (sign * height, place, middle))  # type: ignore[return-value]


def _candidates(domain: Domain, heights: Array) -> Candidates:
    """Points of the grid not below their neighbours, and near enough to the greatest that a search may lift them above it.

    Near enough: a smooth curve rises between two points by less than what it falls to the next ones.
    """
    low = np.full((*heights.shape[:2], 1), -np.inf)
    before = np.concatenate([low, heights[:, :, :-1]], axis=2)
    after = np.concatenate([heights[:, :, 1:], low], axis=2)
    fall = np.maximum(*(np.where(np.isfinite(side), heights - side, 0) for side in (before, after)))
    greatest = heights.max(axis=(1, 2), keepdims=True)
    variant, piece, k = np.nonzero((heights >= before) & (heights >= after) & (heights + fall >= greatest))
    grid, last = domain.search_grid(), heights.shape[2] - 1
    left, right = grid[variant, piece, np.maximum(k - 1, 0)], grid[variant, piece, np.minimum(k + 1, last)]
    return Candidates(
        variant, grid[variant, piece, k], heights[variant, piece, k], domain.middles[variant, piece], left, right
    )


def _refined(calc: Calculation, curve: str, sign: float, seen: Candidates) -> tuple[Array, Array, Array, Array]:
    """The candidates' places and heights after a search in their brackets; at a piece's end within its first interval."""

    def depth(x: Array, variant: Array, middle: Array) -> Array:
        found: Array = calc.sample(curve, x[:, None], middle[:, None], variant.astype(int))
        return -sign * found[:, 0]

    at_end = (seen.place == seen.left) | (seen.place == seen.right)
    centre = np.where(at_end, (seen.left + seen.right) / 2, seen.place)
    depths = [depth(x, seen.variant, seen.middle) for x in (seen.left, centre, seen.right)]
    inner = (depths[1] <= depths[0]) & (depths[1] <= depths[2]) & (seen.left < centre) & (centre < seen.right)
    place, height = seen.place.copy(), seen.height.copy()
    if inner.any():
        searched = elementwise.find_minimum(
            depth,
            (seen.left[inner], centre[inner], seen.right[inner]),
            args=(seen.variant[inner].astype(float), seen.middle[inner]),
            tolerances={"xrtol": PLACE_TOLERANCE},
        )
        better = -searched.f_x >= height[inner]
        place[inner] = np.where(better, searched.x, place[inner])
        height[inner] = np.where(better, -searched.f_x, height[inner])
    return place, height, seen.variant, seen.middle
