"""Places of a cycle at which what is smooth is integrated exactly, and where it is not smooth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from diecut_report.mechanics.numerics import in_rows, narrowed

Array = NDArray[Any]
ORDER = 8  # places within a piece: polynomials up to twice that less one are integrated exactly
STILL = 1e-9  # share of the greatest value that is none


def _places() -> tuple[Array, Array, Array, Array]:
    """Places in [0, 1] with both ends, their weights (Gauss; the ends have none), barycentric ones, and the matrix that differentiates."""
    x, weights = leggauss(ORDER)
    places = np.concatenate([[0.0], (x + 1) / 2, [1.0]])
    gaps = places[:, None] - places + np.eye(len(places))
    barycentric = 1 / np.prod(gaps, axis=1)
    matrix = barycentric / barycentric[:, None] / gaps
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -np.sum(matrix, axis=1))
    return places, np.concatenate([[0.0], weights / 2, [0.0]]), barycentric, matrix


PLACES, WEIGHTS, BARYCENTRIC, DERIVATIVE = _places()


@dataclass(frozen=True)
class Nodes:
    """Hold places of the cycle, (variants, pieces, places) each: both forces, and by how much each place counts."""

    share: Array
    radial: Array
    axial: Array
    turned: Array  # signed speed (or angle by share of a piece)
    weight: Array


def flat(values: Array) -> Array:
    """Return what stands at the places of all pieces, (variants, places)."""
    return values.reshape(len(values), -1)


def edges_of(nodes: Nodes) -> Array:
    """Return the edges of the pieces."""
    return np.concatenate([nodes.share[:, :, 0], nodes.share[:, -1:, -1]], axis=1)


def in_order(*places: Array) -> Array:
    """Return edges in their order, (variants, places); what is missing lies at 0."""
    found: Array = np.sort(np.clip(np.nan_to_num(np.concatenate(places, axis=1)), 0.0, 1.0), axis=1)
    return found


def crossings(nodes: Nodes, values: Array) -> Array:
    """Return where values change their sign, or begin or cease to be zero, (variants, most of them), NaN where there are fewer."""
    scale = np.max(np.abs(flat(values)), axis=1)[:, None, None]
    known = np.where(np.abs(values) <= STILL * scale, 0.0, values)
    variant, piece, place = np.nonzero(np.sign(known[:, :, :-1]) != np.sign(known[:, :, 1:]))
    start, width = nodes.share[variant, piece, 0], nodes.share[variant, piece, -1] - nodes.share[variant, piece, 0]
    return in_rows(start + width * _zeros(known[variant, piece], place), variant, len(values))


def _zeros(values: Array, place: Array) -> Array:
    """Where the polynomial through values (rows, places) is zero, in [0, 1] and from a place to the next."""
    rows = np.arange(len(values))
    ends, heights = PLACES[[place, place + 1]], np.stack([values[rows, place], values[rows, place + 1]])
    found: Array = np.where(heights[0] == 0, ends[0], ends[1])
    rows = rows[(heights != 0).all(axis=0)]

    def polynomial(x: Array, row: Array) -> Array:
        terms = BARYCENTRIC / (x[:, None] - PLACES)
        height: Array = np.sum(terms * values[rows[row]], axis=1) / np.sum(terms, axis=1)
        return height

    found[rows], _ = narrowed(polynomial, ends[0, rows], ends[1, rows], heights[:, rows])
    return found
