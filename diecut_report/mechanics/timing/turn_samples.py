"""What is read from curves over a turn of many machines at once: where they change their sign, and their range.

A curve is a function of places (rows, points), the middles (rows, 1) of the smooth pieces that they lie in, and the machine
(rows,) of each row; places are shares of the turn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from diecut_report.expressions import Array

Curve = Callable[[Array, Array, Array], Array]

PIECES = 16  # of a turn, at least
COUNT = 12  # Gauss–Legendre places in a piece
NARROW = 1e-12  # of a turn: a piece that is no wider holds nothing
NODES = np.polynomial.legendre.leggauss(COUNT)[0]
SHARES = (np.concatenate([[-1.0], NODES, [1.0]]) + 1) / 2
ACROSS = np.linspace(0, 1, 17)  # places of a closer look
LOOKS = 4  # each makes a bracket narrower by 1/16, or by 1/8 about an extreme


@dataclass(frozen=True, eq=False)
class TurnSamples:
    """Hold a curve of many machines over a turn; ``breakpoints`` (machines, places) are shares where it is not smooth, NaN for none."""

    curve: Curve
    breakpoints: Array

    @cached_property
    def _pieces(self) -> tuple[Array, Array, Array]:
        """Machine, start and end of each piece."""
        count = len(self.breakpoints)
        even = np.broadcast_to(np.linspace(0, 1, PIECES + 1), (count, PIECES + 1))
        edges = np.sort(np.concatenate([np.nan_to_num(self.breakpoints, nan=1.0), even], axis=1), axis=1)
        machine, piece = np.nonzero(np.diff(edges, axis=1) > NARROW)
        return machine, edges[machine, piece], edges[machine, piece + 1]

    @cached_property
    def _places(self) -> tuple[Array, Array]:
        """The places in each piece, both ends among them, and the curve there."""
        machine, low, high = self._pieces
        places = low[:, None] + (high - low)[:, None] * SHARES
        return places, self._values(places, np.arange(len(machine)))

    def _values(self, places: Array, piece: Array) -> Array:
        """The curve at places (rows, points), each row in one of the pieces."""
        machine, low, high = self._pieces
        found = self.curve(places, ((low + high) / 2)[piece][:, None], machine[piece])
        return np.broadcast_to(found, places.shape)

    @property
    def sign_changes(self) -> Array:
        """Return the places inside the pieces where the curve changes its sign, shape (machines, most), NaN where there is none.

        They are found to a hundred thousandth of a piece. What is integrated over a corner there is off by the square of that.
        """
        places, values = self._places
        piece, first = np.nonzero(_changes(values))
        low, high = places[piece, first], places[piece, first + 1]
        for _ in range(LOOKS if len(piece) else 0):
            closer = low[:, None] + (high - low)[:, None] * ACROSS
            first = np.argmax(_changes(self._values(closer, piece)), axis=1)
            each = np.arange(len(piece))
            low, high = closer[each, first], closer[each, first + 1]
        return in_rows((low + high) / 2, self._pieces[0][piece], len(self.breakpoints))

    @property
    def range(self) -> Array:
        """Return the greatest less the least value, shape (machines, 1)."""
        return self._greatest(1.0) + self._greatest(-1.0)

    def _greatest(self, sign: float) -> Array:
        """The greatest value times a sign, looked at closer about the greatest of the places."""
        machine, low, high = self._pieces
        places, values = self._places
        best = np.argmax(sign * values, axis=1)
        tops = np.full(len(self.breakpoints), -np.inf)
        np.maximum.at(tops, machine, (sign * values).max(axis=1))
        spread = np.ptp(values) if len(values) else 0.0
        piece = np.flatnonzero((sign * values).max(axis=1) >= tops[machine] - 1e-2 * spread)
        place, width = places[piece, best[piece]], (high - low)[piece] / 4
        for _ in range(LOOKS):
            closer = np.clip(place[:, None] + width[:, None] * (2 * ACROSS - 1), low[piece, None], high[piece, None])
            found = sign * self._values(closer, piece)
            top = np.argmax(found, axis=1)[:, None]
            place, width = np.take_along_axis(closer, top, axis=1)[:, 0], width / 8
            np.maximum.at(tops, machine[piece], np.take_along_axis(found, top, axis=1)[:, 0])
        return tops[:, None]


def in_rows(places: Array, machine: Array, count: int) -> Array:
    """Return places as rows of their machines (ascending), shape (machines, most), NaN behind them."""
    number = np.bincount(machine, minlength=count)
    found = np.full((count, int(number.max(initial=0))), np.nan)
    found[machine, np.arange(len(machine)) - (np.cumsum(number) - number)[machine]] = places
    return found


def _changes(values: Array) -> Array:
    """Whether the sign changes from each value to the next; at a value of zero, from the one before it to the next."""
    found: Array = values[:, 1:] * values[:, :-1] < 0
    found[:, 1:] |= (values[:, 1:-1] == 0) & (values[:, :-2] * values[:, 2:] < 0)
    return found
