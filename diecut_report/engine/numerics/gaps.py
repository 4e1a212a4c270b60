"""How near a decision is to changing, on the points of the search grid: where it dips, and where it only begins at the end of a piece."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from diecut_report.expressions import Array

NEAR = 5  # points of the grid that tell how a gap runs from the end of its piece to the next point
BETWEEN = np.array([1 / 16, 1 / 4, 1 / 2])  # places from the end to the next point where it is looked at
ALIKE = 0.01  # of a gap: where the points beside the end tell it by so much, there is no bend between
FLAT = 0.1  # of a gap: where it moves by less about its least value that is not nothing
SOME = 5  # points of a piece at which a curve is held against its flag that varies in it


def lowest(gap: Array, is_change: Array) -> tuple[Array, Array]:
    """Return points of the grid, by row and number, where a gap is lower than beside it by as much as itself, and no change is beside it."""
    falls, rises = gap[:, 1:] <= gap[:, :-1], gap[:, :-1] <= gap[:, 1:]
    is_low = np.concatenate([rises[:, :1], falls[:, :-1] & rises[:, 1:], falls[:, -1:]], axis=1)
    row, k = nonzero(is_low)
    last = gap.shape[1] - 1
    before, after = np.where(k > 0, k - 1, 1), np.where(k < last, k + 1, last - 1)
    here = gap[row, k]
    changed = (is_change[row, k - 1] & (k > 0)) | (is_change[row, np.minimum(k, last - 1)] & (k < last))
    found = (2 * here <= np.maximum(gap[row, before], gap[row, after])) & (here > 0) & ~changed
    return row[found], k[found]


def rises(gap: Array, places: Array) -> Array:
    """Return whether gaps (rows, points) near the end of a piece have their least size at the end, by the polynomial through them.

    The points without the end must tell the gap there: no bend hides between the end and the next point.
    """
    inner, beside = _weights_beside_end(tuple(places.tolist()))
    tells = np.abs(gap[:, 1:] @ inner - gap[:, :1]) <= ALIKE * np.abs(gap[:, 1:2])
    between = gap @ beside
    rising = (np.abs(between) >= np.abs(gap[:, :1])) & ((between > 0) == (gap[:, 1:2] > 0))
    found: Array = (tells & rising).all(axis=1)
    return found


@lru_cache(maxsize=16)
def _weights_beside_end(places: tuple[float, ...]) -> tuple[Array, Array]:
    """What the places of a grid count at its end, without that, and between the end and the next place."""
    points = np.array(places)
    return _weights(points[1:], points[:1]), _weights(points, points[1] * BETWEEN)


def _weights(points: Array, places: Array) -> Array:
    """What each point counts at other places in the polynomial through all, (points, places)."""
    parts = [np.prod([(places - other) / (own - other) for other in points if other != own], axis=0) for own in points]
    return np.stack(parts)


def nonzero(marks: Array) -> tuple[Array, Array]:
    """Return rows and columns of marks (rows, columns) of which few are set."""
    row, k = np.divmod(np.flatnonzero(marks), marks.shape[1])
    return row, k


def some(apart: Array) -> Array:
    """Return of the points that are apart in each piece (rows, all) some, from the first to the last (rows, SOME)."""
    count = apart.sum(axis=1)
    rank = np.round(np.linspace(0, 1, SOME) * (count[:, None] - 1)).astype(int)
    found: Array = np.nonzero(apart)[1][np.cumsum(count)[:, None] - count[:, None] + rank]
    return found


def may_reach(gap: Array, least: Array) -> Array:
    """Return whether gaps (rows, places) may come down to nothing between their places: they turn back, and are not flat yet."""
    turns = (least > 0) & (least < gap.shape[1] - 1)
    found: Array = turns & (np.ptp(gap, axis=1) > FLAT * gap.min(axis=1))
    return found
