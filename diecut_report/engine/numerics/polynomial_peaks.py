"""Extremes of smooth curves by the polynomial through the points of the search grid about each, proved by the curve itself."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from diecut_report.engine.numerics.bracketing import Function
from diecut_report.expressions import Array

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
