"""Where a referred motion rests: the longest rest within its period; the motion is what lies between two of them."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from diecut_report.api import Curve

Array = NDArray[np.float64]
STILL = 1e-9  # share of the motion's range within which it rests
POINTS = 33  # of a smooth piece


class RestPieces(NamedTuple):
    """A motion's smooth pieces: edges (variants, pieces + 1), and positions in each (variants, pieces, points)."""

    edges: Array
    positions: Array


def pieces(curve: Curve) -> RestPieces:
    """The smooth pieces of a motion over its period."""
    inner = np.clip(curve.breakpoints, 0, 1)
    ends = np.ones((len(inner), 1))
    edges = np.concatenate([0 * ends, inner, ends], axis=1)
    middle = (edges[:, :-1] + edges[:, 1:]) / 2
    share = (1 - np.cos(np.linspace(0, np.pi, POINTS))) / 2
    places = edges[:, :-1, None] + np.diff(edges, axis=1)[:, :, None] * share
    around = np.broadcast_to(middle[:, :, None], places.shape)
    flat = (len(edges), -1)
    return RestPieces(edges, curve.values(places.reshape(flat), around.reshape(flat), None).reshape(places.shape))


def moving(curve: Curve) -> tuple[Array, Array]:
    """Start of the motion and its duration, as shares of the period, each of shape (variants, 1); all of it without a rest."""
    edges, positions = pieces(curve)
    extent = np.ptp(positions, axis=(1, 2))[:, None]
    still = (np.ptp(positions, axis=2) <= STILL * extent) | (np.diff(edges, axis=1) <= 0)
    rests = np.array([_longest_rest(*row) for row in zip(edges, still, strict=True)])
    return rests[:, 1:] % 1, 1 - np.diff(rests, axis=1)


def _longest_rest(edges: Array, still: NDArray[np.bool_]) -> tuple[float, float]:
    """Start and end of the longest rest, which may go on in the next period; of no length where there is none."""
    if still.all():
        return 0.0, 1.0
    turn = int(np.argmin(still))  # a piece that moves: no rest goes on over its start
    widths, rests = np.roll(np.diff(edges), -turn), np.roll(still, -turn)
    ends = edges[turn] + np.cumsum(widths)
    best, begin = (edges[turn], edges[turn]), None
    for end, width, rest in zip(ends, widths, rests, strict=True):
        begin = (end - width if begin is None else begin) if rest else None
        if begin is not None and end - begin > best[1] - best[0]:
            best = (begin, end)
    return float(best[0]), float(best[1])


def jump(curve: Curve) -> Array:
    """Greatest jump of position (to the motion's range) or of speed (to the greatest speed) from piece to piece, (variants, 1)."""
    edges, positions = pieces(curve)
    half = np.diff(edges, axis=1)[:, :, None] / 2
    speeds = np.divide(positions @ _differences().T, half, out=np.zeros_like(positions), where=half > 0)
    around, wide = (np.concatenate([part, part[:, :1]], axis=1) for part in (speeds, half > 0))  # a position may gain
    gaps = [
        _gap(positions, half > 0) / np.ptp(positions, axis=(1, 2)),
        _gap(around, wide) / np.abs(speeds).max(axis=(1, 2)),
    ]
    return np.asarray(np.maximum(*gaps)[:, None])


def gained(curve: Curve) -> Array:
    """What the motion gains in a period, to its range: 1 for a motion in one direction, 0 for one there and back, (variants, 1)."""
    positions = pieces(curve).positions
    found: Array = np.abs(positions[:, -1, -1] - positions[:, 0, 0]) / np.ptp(positions, axis=(1, 2))
    return found[:, None]


def _gap(values: Array, wide: NDArray[np.bool_]) -> Array:
    """The greatest difference between the end of a piece and the start of the next one, of pieces that have a width."""
    gaps = [0 * values[:, 0, 0]]
    last = values[:, 0, -1]
    for piece in range(1, values.shape[1]):
        here = wide[:, piece, 0]
        gaps.append(np.where(here, np.abs(values[:, piece, 0] - last), 0))
        last = np.where(here, values[:, piece, -1], last)
    return np.asarray(np.max(gaps, axis=0))


@cache
def _differences() -> Array:
    """The matrix that differentiates values at the points of a piece, for a half-width of 1."""
    series = chebyshev.chebvander(-np.cos(np.linspace(0, np.pi, POINTS)), POINTS - 1)
    slopes = chebyshev.chebvander(-np.cos(np.linspace(0, np.pi, POINTS)), POINTS - 2) @ chebyshev.chebder(
        np.eye(POINTS)
    )
    return np.asarray(slopes @ np.linalg.inv(series))


def last_or_end(crossings: Array, end: Array) -> Array:
    """The last crossing, no earlier than the end of the motion, (variants, 1)."""
    return np.asarray(np.maximum(np.where(np.isfinite(crossings), crossings, 0).max(axis=1, initial=0)[:, None], end))
