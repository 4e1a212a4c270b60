"""Extremes of curves on arrays of variants: every local extreme that may be the greatest is refined by a bounded search."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from diecut_report.engine.calculation import Calculation
from diecut_report.engine.numerics.bracketing import Function, smooth_minimum
from diecut_report.engine.numerics.curve_evaluation import MANY, Curves
from diecut_report.engine.numerics.domain import SMALLEST
from diecut_report.engine.numerics.polynomial_peaks import ALIKE, Spots, around, vertices
from diecut_report.engine.numerics.sample_cache import CachedPieces
from diecut_report.expressions import Array

PLACE_TOLERANCE = 1e-6  # of an extreme's place, as a share of its bracket; its value errs by the square of it
SAME_HEIGHT = 1e-9  # share of an extreme within which two places reach the same, as far as rounding lets tell
FEW = 2048  # places up to which all curves are evaluated together
PLATEAU = 1e-11  # share of an extreme within which neighbouring points of the grid lie on a plateau
APPROACH = 12  # steps by which an end of a piece is approached, each a quarter of the one before


Wanted = tuple[str, float]  # a curve, and 1 for its greatest or -1 for its least value
Found = tuple[Array, Array, Array]  # value, place, middle of the smooth piece; each of shape (variants, 1)


class Candidates(NamedTuple):
    """Hold points of the grid that may be an extreme, one row each: which one, piece (its row), number in it, place, height there.

    Also their bracket, whether they lie on a plateau, and the heights around them.
    """

    which: Array
    piece: Array
    k: Array
    place: Array
    height: Array
    left: Array
    right: Array
    flat: Array
    around: Array


def extreme(calc: Calculation, curve: str, sign: float) -> Found:
    """Return the greatest (sign 1) or least (sign -1) value over the period, one-sided limits included."""
    search(calc, [(curve, sign)])
    return calc.extremes[curve, sign][1]


def search(calc: Calculation, wanted: Sequence[Wanted]) -> None:
    """Find several extremes over one abscissa at once; those that are known for the present pieces are kept."""
    axis = calc.axis[wanted[0][0]]
    domain = calc.domains[axis]
    known = {w for w in wanted if w in calc.extremes and calc.extremes[w][0] is domain.edges}
    curves = list(dict.fromkeys(curve for curve, _ in wanted))
    open_ones = sorted((w for w in dict.fromkeys(wanted) if w not in known), key=lambda w: curves.index(w[0]))
    if not open_ones:
        return
    table = calc.table(axis)
    curves = list(dict.fromkeys(curve for curve, _ in open_ones))
    values = dict(zip(curves, table.on_grid(curves), strict=True))
    pieces = table.pieces()
    broken = {curve for curve, found in values.items() if np.isnan(np.vdot(found, found))}
    parts = [
        _candidates(pieces, i, _low(values[curve], sign) if curve in broken else values[curve], sign)
        for i, (curve, sign) in enumerate(open_ones)
    ]
    seen = Candidates(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))
    seen = _refined(_depths(calc, axis, open_ones, seen), seen, pieces)
    start = np.searchsorted(seen.which, np.arange(len(open_ones) + 1))
    for i, (curve, sign) in enumerate(open_ones):
        own = Candidates(*(column[start[i] : start[i + 1]] for column in seen))
        best, flat = _best(pieces, own, sign)
        calc.extremes[curve, sign] = domain.edges, _at_start(pieces, best, flat, values[curve], sign)


def _best(pieces: CachedPieces, seen: Candidates, sign: float) -> tuple[Found, Array]:
    """The greatest candidate of each variant, at the first of the places that reach it but for rounding; NaN where there is none.

    Also which variants' are on a plateau.
    """
    variant = pieces.variant[seen.piece]
    greatest = np.full(pieces.shape[0], -np.inf)
    np.maximum.at(greatest, variant, seen.height)
    top = greatest[variant]
    alike = np.flatnonzero(seen.height >= top - SAME_HEIGHT * np.abs(top))
    best = alike[np.flatnonzero(np.diff(variant[alike], prepend=-1))]
    found = np.full((3, pieces.shape[0], 1), np.nan)
    found[:, variant[best], 0] = sign * top[best], seen.place[best], pieces.middle[seen.piece[best]]
    return (found[0], found[1], found[2]), np.unique(variant[alike[seen.flat[alike]]])


def _at_start(pieces: CachedPieces, found: Found, flat: Array, values: Array, sign: float) -> Found:
    """Extremes of which some are on a plateau: rounding must not choose the place on it, so it is the first point of the grid there."""
    if not len(flat):
        return found
    value, place, middle = found
    is_flat = np.zeros(len(value), dtype=bool)
    is_flat[flat] = True
    rows = np.flatnonzero(is_flat[pieces.variant])
    variant = pieces.variant[rows]
    least = sign * value[variant] - PLATEAU * np.abs(value[variant])
    reached = sign * values[rows] >= least
    own = np.flatnonzero(reached.any(axis=1))
    own = own[np.flatnonzero(np.diff(variant[own], prepend=-1))]
    place[variant[own], 0] = pieces.point(rows[own], reached[own].argmax(axis=1))
    middle[variant[own], 0] = pieces.middle[rows[own]]
    return found


def outruns(calc: Calculation, curve: str, found: Array, sign: float) -> Array:
    """Return how far the curve goes beyond the extreme found at other places, relative to its greatest value: the proof of it.

    These are the samples of a single machine, and Gauss–Legendre points of the pieces of many: neither served the search.
    """
    table = calc.table(calc.axis[curve])
    pieces = table.pieces()
    values = calc.curve_samples(curve) if calc.count == 1 else table.at_gauss([curve], pieces.proof_order)[0]

    def most(choose: np.ufunc, heights: Array) -> Array:
        if calc.count > 1:
            return pieces.of_variants(choose, heights)
        whole: Array = choose.reduce(heights, axis=1, keepdims=True)
        return whole

    beyond = sign * (most(np.fmax if sign > 0 else np.fmin, values) - found)
    share = np.where(np.isfinite(found), 0.0, np.nan)
    if (beyond > 0).any():
        beyond /= np.maximum(most(np.fmax, np.abs(values)), SMALLEST)
        share = np.where(beyond > 0, beyond, share)
    return share


def _candidates(pieces: CachedPieces, which: int, values: Array, sign: float) -> Candidates:
    """Points of the grid not below their neighbours, and near enough to the greatest that a search may lift them above it.

    Near enough: a smooth curve rises between two points by less than what it falls to the next ones. At the end of a piece it may
    fall to its one neighbour by next to nothing, the extreme lying half-way between them: there the second neighbour tells.
    """
    heights, last = values.ravel(), values.shape[1] - 1
    flat = np.flatnonzero(_peaks(heights, last + 1, sign))
    piece, k = np.divmod(flat, last + 1)
    before, after = flat - np.where(k == last, 2, k > 0), flat + np.where(k == 0, 2, k < last)
    height = sign * heights[flat]
    fall = np.fmax(height - sign * heights[before], height - sign * heights[after])
    greatest = np.full(pieces.shape[0], -np.inf)
    np.maximum.at(greatest, pieces.variant[piece], height)
    is_near = (height + np.where(np.isfinite(fall), fall, 0) >= greatest[pieces.variant[piece]]) & (height > -np.inf)
    near = np.flatnonzero(is_near)
    piece, k, height = piece[near], k[near], height[near]
    place, left, right = pieces.point(piece, np.stack([k, np.maximum(k - 1, 0), np.minimum(k + 1, last)]))
    return Candidates(
        np.full(len(near), which), piece, k, place, height, left, right, fall[near] <= PLATEAU * np.abs(height),
        sign * around(values, piece, k),
    )  # fmt: skip


def _low(values: Array, sign: float) -> Array:
    """Values of which those that are none stand below all others."""
    return np.where(np.isnan(values), -sign * np.inf, values)


def _peaks(heights: Array, points: int, sign: float) -> Array:
    """Which of the heights of pieces, so many points each, are not below their neighbours in the piece (sign -1: not above)."""
    higher, lower = (np.greater_equal, np.less_equal) if sign > 0 else (np.less_equal, np.greater_equal)
    before, after = np.empty((2, len(heights)), dtype=bool)
    higher(heights[1:], heights[:-1], out=before[1:])
    lower(heights[1:], heights[:-1], out=after[:-1])
    before[::points] = after[points - 1 :: points] = True
    return np.logical_and(before, after, out=before)


def _depths(calc: Calculation, axis: str, wanted: Sequence[Wanted], seen: Candidates) -> Function:
    """The height of each candidate's curve at other places of its piece, turned round; candidates are ordered by their curves.

    A few places are evaluated on all curves together, many on their own curve alone.
    """
    table = calc.table(axis)
    pieces = table.pieces()
    curves = list(dict.fromkeys(curve for curve, _ in wanted))
    curve_of = np.array([curves.index(curve) for curve, _ in wanted])[seen.which]
    turned = np.array([-sign for _, sign in wanted])[seen.which]
    starts = np.searchsorted(curve_of, np.arange(len(curves) + 1))

    @cache
    def of(curve: int | None) -> Curves:
        if curve is None:
            return table.curves(curves, seen.piece)
        return table.curves([curves[curve]], seen.piece[starts[curve] : starts[curve + 1]])

    def together(x: Array, rows: Array) -> Array:
        if calc.count >= MANY or not len(rows):
            every: Array = np.stack(of(None).at(x, rows))[curve_of[rows], np.arange(len(x)), 0]
            return every
        own, number = np.unique(curve_of[rows], return_inverse=True)  # what is still searched are often few curves
        values = np.stack(table.curves([curves[i] for i in own], seen.piece).at(x, rows))
        found: Array = values[number, np.arange(len(x)), 0]
        return found

    def depths(x: Array, rows: Array) -> Array:
        x = pieces.inside(x[:, None], seen.piece[rows])
        if len(rows) < FEW and len(curves) > 1:
            values = together(x, rows)
        else:
            values, which = np.empty(len(rows)), curve_of[rows]
            for curve in np.flatnonzero(np.bincount(which)):
                own = np.flatnonzero(which == curve)
                values[own] = of(int(curve)).at(x[own], rows[own] - starts[curve])[0][:, 0]
        chosen: Array = turned[rows] * values
        return chosen

    return depths


def _refined(depth_of: Function, seen: Candidates, pieces: CachedPieces) -> Candidates:
    """The candidates at their vertices, by a polynomial or else by a search; on a plateau as they are."""
    rising = np.flatnonzero(~seen.flat)
    piece = seen.piece[rising]
    spots = Spots(seen.k[rising], seen.around[rising], pieces.left[piece], pieces.width[piece], pieces.intervals)
    place, height, holds = vertices(lambda x, row: -depth_of(x, rising[row]), spots)
    higher = np.flatnonzero(holds & (height > seen.height[rising]))
    seen.place[rising[higher]], seen.height[rising[higher]] = place[higher], height[higher]
    return seen if holds.all() else _searched(depth_of, seen, rising[~holds])


def _searched(depth_of: Function, seen: Candidates, rising: Array) -> Candidates:
    """The candidates, of which these were searched in their brackets; at a piece's end within its first interval."""
    low, centre, high, depths = _brackets(
        Candidates(*(column[rising] for column in seen)), lambda x, row: depth_of(x, rising[row])
    )
    is_inner = (depths[1] <= depths[0]) & (depths[1] <= depths[2]) & (low < centre) & (centre < high)
    is_inner &= ~_stands(seen, rising, depths[1])
    low, centre, high, depths = (part[..., is_inner] for part in (low, centre, high, depths))
    inner = rising[is_inner]
    if not len(inner):
        return seen
    found, depth = smooth_minimum(lambda x, row: depth_of(x, inner[row]), low, centre, high, depths, PLACE_TOLERANCE)
    better = -depth >= seen.height[inner]
    place, height = seen.place.copy(), seen.height.copy()
    place[inner] = np.where(better, found, place[inner])
    height[inner] = np.where(better, -depth, height[inner])
    return seen._replace(place=place, height=height)


def _stands(seen: Candidates, rising: Array, depths: Array) -> Array:
    """Which candidates are ends of pieces that nothing near them rises above but by rounding: what begins at rest rises from there."""
    place, heights = seen.place[rising], seen.around[rising]
    is_end = (place == seen.left[rising]) | (place == seen.right[rising])
    found: Array = is_end & (-depths <= seen.height[rising] + ALIKE * np.abs(heights).max(axis=1))
    return found


def _brackets(seen: Candidates, depth_of: Function) -> tuple[Array, Array, Array, Array]:
    """Three places about each candidate, its neighbours on the grid and itself, and the depths there, (3, candidates).

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
    every = np.arange(len(centre))
    return left, centre, right, depth_of(np.concatenate([left, centre, right]), np.tile(every, 3)).reshape(3, -1)
