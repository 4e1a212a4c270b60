"""Extremes of curves on arrays of variants: every local extreme that may be the greatest is refined by a bounded search."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Found
from diecut_report.machine.numerics.curves import MANY, Curves
from diecut_report.machine.numerics.domain import SMALLEST
from diecut_report.machine.numerics.samples import CachedPieces
from diecut_report.mechanics import numerics
from diecut_report.mechanics.numerics import Function

# Extremes of smooth curves by the polynomial through the points of the search grid about each, proved by the curve itself.


REACH = 4  # points of the grid to each side of a candidate that the polynomial goes through
OFFSETS = np.arange(-REACH, REACH + 1)
POWERS = np.linalg.inv(
    np.vander(OFFSETS, increasing=True)
)  # gives the polynomial's coefficients by these points' heights
APART = 0.01  # intervals of the grid between the places where the curve is compared with the polynomial
BESIDE, BESIDE_APART = 0.5, 0.25  # intervals from the end of a piece to the middle of these places, and between them
SHIFT = 0.02  # most intervals by which the curve's own slope may move the polynomial's vertex
FOLLOWS = 1e-5  # share of the heights' spread by which the curve may be off the polynomial
ROUNDING = 1e-14  # share of the height by which it may be off besides
ALIKE = 1e-12  # share of the height by which rounding may lift a place beside the vertex above it


class Spots(NamedTuple):
    """Hold points of the search grid, one each: their number in the piece, the heights around them, left end and width of the piece."""

    k: Array
    around: Array
    left: Array
    width: Array
    intervals: int

    def place(self, share: Array) -> Array:
        """Return places so many intervals of the grid beside the points, as the grid is spaced there; back from the end at an end."""
        square = np.tan((self.k + share) * (np.pi / 2 / self.intervals)) ** 2  # NumPy's sine is many times slower
        found: Array = self.left + self.width * (square / (1 + square))
        return found


def around(values: Array, piece: Array, k: Array) -> Array:
    """Return values of pieces (rows, points) at points of the grid and their neighbours, shape (spots, 2·REACH + 1).

    The grid's points lie as the cosines of equal angles; over that angle a smooth curve goes on past the ends as in a mirror.
    """
    last = values.shape[1] - 1
    beside = last - np.abs(last - np.abs(k[:, None] + OFFSETS))
    found: Array = values.ravel().take(beside + piece[:, None] * (last + 1))
    return found


def vertices(height_of: Function, spots: Spots) -> tuple[Array, Array, Array]:
    """Return the place and the height of the greatest height about each spot, and whether they hold; at the end of a piece it is the end itself.

    They hold where the curve follows the polynomial at three places, and falls from the end of a piece. Between these places the
    polynomial tells bend and third derivative alone: the slope, so the vertex, is the curve's own.
    """
    powers, centre = POWERS @ spots.around.T, spots.around[:, REACH]
    inward = (spots.k == 0) * 1.0 - (spots.k == spots.intervals)
    at_end = (inward != 0) & (_rise(powers) <= ROUNDING * np.abs(centre))
    near = np.where(at_end, BESIDE * inward, _top(powers, inward))
    apart = np.where(at_end, BESIDE_APART, APART)
    shares = near + apart * np.array([[-1.0], [0.0], [1.0]])
    found = height_of(spots.place(shares).ravel(), np.tile(np.arange(len(near)), 3)).reshape(3, -1)
    bend, third = (_value(_derived(powers, order), near) for order in (2, 3))
    slope = (found[2] - found[0]) / (2 * apart) - apart**2 / 6 * third
    share = -slope / bend
    is_top = at_end | ((bend < 0) & (np.abs(share) < SHIFT) & (np.abs(near + share) <= 1))
    place, top = spots.place(np.where(at_end, 0, near + share)), centre.copy()
    inner = np.flatnonzero(is_top & ~at_end)
    top[inner] = height_of(place[inner], inner)
    is_highest = (found <= top + ALIKE * np.abs(top)).all(axis=0)
    return place, top, _follows(spots, powers, shares, found) & is_top & is_highest


def _rise(powers: Array) -> Array:
    """How far the polynomial, which is even at the end of a piece, rises from there."""
    _, _, second, _, fourth, *_ = powers
    turns = (second > 0) & (fourth < 0)
    found: Array = np.where(turns, -(second**2) / np.where(turns, 4 * fourth, 1), second)
    return found


def _follows(spots: Spots, powers: Array, shares: Array, found: Array) -> Array:
    """Whether the heights found are the polynomial's at all places of a spot."""
    centre = spots.around[:, REACH]
    allowed = FOLLOWS * np.abs(spots.around - centre[:, None]).max(axis=1) + ROUNDING * np.abs(centre)
    apart: Array = np.abs(found - _value(powers, shares)) - allowed
    follows: Array = apart.max(axis=0) <= 0
    return follows


def _top(powers: Array, inward: Array) -> Array:
    """The polynomial's vertex within an interval of the middle, by Newton's method from that of the parabola.

    At the end of a piece, where the polynomial is even, from that of the parabola over the square.
    """
    slope, bend = _derived(powers, 1), _derived(powers, 2)
    start = np.where(inward == 0, -powers[1] / (2 * powers[2]), inward * np.sqrt(np.abs(powers[2] / (2 * powers[4]))))
    share: Array = np.clip(start, -1, 1)
    for _ in range(3):
        step = _value(slope, share) / _value(bend, share)
        share = np.clip(share - step, -1, 1)
    return share


def _derived(powers: Array, order: int) -> Array:
    """The coefficients of polynomials' derivatives; NumPy's own ways take several times as long for a few polynomials."""
    for _ in range(order):
        powers = powers[1:] * np.arange(1.0, len(powers))[:, None]
    return powers


def _value(powers: Array, x: Array) -> Array:
    """The polynomials' values by Horner's rule."""
    found: Array = powers[-1]
    for coefficient in powers[-2::-1]:
        found = coefficient + found * x
    return found


SAME_HEIGHT = 1e-9  # share of an extreme within which two places reach the same, as far as rounding lets tell
FEW = 2048  # places up to which all curves are evaluated together
PLATEAU = 1e-11  # share of an extreme within which neighbouring points of the grid lie on a plateau
COARSE = 2  # closer looks before a polynomial tells the place, if the curve is smooth there
NEAR = 128  # share of the bracket between the places that this polynomial goes through
SMOOTH = 1e-12  # share of a curve's size by which it may be off this polynomial


Wanted = tuple[str, float]  # a curve, and 1 for its greatest or -1 for its least value


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
    parts = []
    for i, (curve, sign) in enumerate(open_ones):
        heights = values[curve]
        if curve in broken:  # what has no value stands below all others
            heights = np.where(np.isnan(heights), -sign * np.inf, heights)
        parts.append(_candidates(pieces, i, heights, sign))
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
        return turned[rows] * values

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
    """The candidates, of which these were looked at closer and closer between their neighbours on the grid."""

    def depths(x: Array, row: Array) -> Array:
        return depth_of(x.ravel(), rising[row].repeat(x.shape[1])).reshape(x.shape)

    low, high = seen.left[rising], seen.right[rising]
    found, depth = numerics.least(depths, low, high, rounds=COARSE)
    found, depth, is_smooth = _at_vertex(lambda x, row: depth_of(x, rising[row]), found, high - low, depth)
    rest = np.flatnonzero(~is_smooth)
    if len(rest):
        found[rest], depth[rest] = numerics.least(lambda x, row: depths(x, rest[row]), low[rest], high[rest])
    is_end = (seen.place[rising] == low) | (seen.place[rising] == high)  # what begins at rest rises by rounding alone
    rounding = np.where(is_end, ALIKE * np.abs(seen.around[rising]).max(axis=1), 0.0)
    better = np.flatnonzero(-depth > seen.height[rising] + rounding)
    seen.place[rising[better]], seen.height[rising[better]] = found[better], -depth[better]
    return seen


def _at_vertex(function: Function, place: Array, width: Array, depth: Array) -> tuple[Array, Array, Array]:
    """Place and value at the vertex of the polynomial through five places about each, and whether the function follows it.

    There the place is far more exact than the values could tell by themselves.
    """
    step = width / NEAR
    around = place + step * np.array([[-2.0], [-1.0], [1.0], [2.0]])
    row = np.arange(len(place))
    values = function(around.ravel(), np.tile(row, 4)).reshape(4, -1) - depth
    even, odd = values[:2] + values[:1:-1], values[:1:-1] - values[:2]  # of the outer and of the inner places
    first, third = (8 * odd[1] - odd[0]) / 12, (odd[0] - 2 * odd[1]) / 12
    second, fourth = (16 * even[1] - even[0]) / 24, (even[0] - 4 * even[1]) / 24
    s = -first / (2 * second)
    for _ in range(3):
        bend = 2 * second + s * (6 * third + s * 12 * fourth)
        s = s - (first + s * (2 * second + s * (3 * third + s * 4 * fourth))) / bend
    expected = s * (first + s * (second + s * (third + s * fourth)))
    s = np.where(np.abs(s) <= 2, s, 0)
    vertex = place + s * step
    found = function(vertex, row)
    size = np.abs(depth) + np.abs(values).max(axis=0)
    follows: Array = (np.abs(found - depth - expected) <= SMOOTH * size) & (found <= depth + SMOOTH * size)
    return np.where(follows, vertex, place), np.where(follows, found, depth), follows
