"""Places of a cycle at which what is smooth is integrated exactly, and where it is not smooth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial.legendre import Legendre
from numpy.typing import NDArray

Array = NDArray[Any]
ORDER = 8  # of the polynomials that are integrated exactly: twice that less one
STILL = 1e-9  # share of the greatest value that is none


def _lobatto() -> tuple[Array, Array, Array]:
    """Places in [0, 1] with both ends, their weights, and the matrix that differentiates values at them."""
    last = Legendre.basis(ORDER)
    x = np.concatenate([[-1.0], last.deriv().roots(), [1.0]])
    weights = 2 / (ORDER * (ORDER + 1) * last(x) ** 2)
    gaps = x[:, None] - x + np.eye(len(x))
    level = last(x)
    matrix = level[:, None] / level / gaps
    np.fill_diagonal(matrix, 0.0)
    matrix[0, 0], matrix[-1, -1] = -ORDER * (ORDER + 1) / 4, ORDER * (ORDER + 1) / 4
    return (x + 1) / 2, weights / 2, 2 * matrix


PLACES, WEIGHTS, DERIVATIVE = _lobatto()


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
    before, after = known[:, :, :-1], known[:, :, 1:]
    crosses = np.sign(before) != np.sign(after)
    count = int(np.max(np.sum(crosses, axis=(1, 2)), initial=0))
    gap = np.diff(nodes.share, axis=2)
    place = nodes.share[:, :, :-1] + gap * before / np.where(crosses, before - after, 1.0)
    found: Array = np.sort(flat(np.where(crosses, place, np.nan)), axis=1)[:, :count]
    return found
