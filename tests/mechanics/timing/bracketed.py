"""Places where a function changes its sign inside its smooth pieces, all at once by few evaluations."""

from __future__ import annotations

import numpy as np

from diecut_report.formulas import Array
from tests.mechanics.timing.legendre_pieces import NODES, Function

_SHARES = (np.concatenate([[-1.0], NODES, [1.0]]) + 1) / 2
ACROSS = np.linspace(0, 1, 33)  # places of a closer look
LOOKS = 3  # each makes a bracket narrower by 1/32


def sign_changes(function: Function, edges: Array) -> Array:
    """Return the places inside the pieces between edges where a function changes its sign, to a millionth of a piece or better.

    It may have a corner there. What is integrated over such a corner is off by the square of that.
    """
    widths = np.diff(edges)[:, None]
    places = edges[:-1, None] + widths * _SHARES
    middles = edges[:-1] + widths[:, 0] / 2
    row, first = np.nonzero(_changes(_values(function, places, middles)))
    low, high, inside = places[row, first], places[row, first + 1], middles[row]
    for _ in range(LOOKS if len(row) else 0):
        places = low[:, None] + (high - low)[:, None] * ACROSS
        first = np.argmax(_changes(_values(function, places, inside)), axis=1)
        each = np.arange(len(row))
        low, high = places[each, first], places[each, first + 1]
    return (low + high) / 2


def _values(function: Function, places: Array, middles: Array) -> Array:
    """The function at places (rows, points), each row in the piece of its middle."""
    inside = np.repeat(middles, places.shape[1])
    return np.broadcast_to(function(places.ravel(), inside), places.size).reshape(places.shape)


def _changes(values: Array) -> Array:
    """Whether the sign changes from each value to the next; at a value of zero, from the one before it to the next."""
    found: Array = values[:, 1:] * values[:, :-1] < 0
    found[:, 1:] |= (values[:, 1:-1] == 0) & (values[:, :-2] * values[:, 2:] < 0)
    return found
