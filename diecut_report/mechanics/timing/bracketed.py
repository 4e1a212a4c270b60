"""Places where a function changes its sign inside its smooth pieces, all at once."""

from __future__ import annotations

import numpy as np
from scipy.optimize import elementwise

from diecut_report.expressions import Array
from diecut_report.mechanics.timing.legendre_pieces import NODES, Function

_SHARES = (np.concatenate([[-1.0], NODES, [1.0]]) + 1) / 2


def sign_changes(function: Function, edges: Array) -> Array:
    """Return the places inside the pieces between edges where a function changes its sign; it may have a corner there."""
    widths = np.diff(edges)[:, None]
    places = edges[:-1, None] + widths * _SHARES
    middles = np.broadcast_to(edges[:-1, None] + widths / 2, places.shape)
    values = np.broadcast_to(function(places.ravel(), middles.ravel()), places.size).reshape(places.shape)
    met = places[:, 1:-1][(values[:, 1:-1] == 0) & (values[:, :-2] * values[:, 2:] < 0)]
    bracket = np.nonzero(values[:, :-1] * values[:, 1:] < 0)
    inside = middles[:, 1:][bracket]
    if len(inside) == 0:
        return met
    ends = places[:, :-1][bracket], places[:, 1:][bracket]
    found: Array = np.concatenate([met, elementwise.find_root(function, ends, args=(inside,)).x])
    return found
