"""Curves of lines over the angle of the main shaft, of many machines at once, and what a torque at a line's shaft is there.

A torque M at a line's own shaft is i·M·η^(−sgn M) at the main shaft, i turns of the line a turn of the main shaft: losses add
where the shaft gives power, and take away where the line gives it back.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import ceil

import numpy as np
from numpy.polynomial import legendre

from diecut_report.formulas import Array
from diecut_report.mechanics import numerics

# Curves of many machines as Legendre series on their smooth pieces: means, extremes and values anywhere follow from them.


COUNT = 20  # Gauss–Legendre places in a piece
NODES, WEIGHTS = legendre.leggauss(COUNT)
_VALUES = legendre.legvander(NODES, COUNT - 1)  # of each Legendre polynomial at the places
TO_SERIES = (_VALUES * WEIGHTS[:, None]).T * (np.arange(COUNT)[:, None] + 0.5)  # coefficients from values at the places
LOOK = np.linspace(-1, 1, 41)  # where a piece is looked at before its greatest value is looked at closer
_LOOK_VALUES = legendre.legvander(LOOK, COUNT)
NARROW = 1e-12  # a piece that is no wider holds nothing
BESIDE = 1e-11  # as near as a place is to an edge that it is taken to be on
TO_CHEBYSHEV = numerics.of_legendre(COUNT + 1)
RESOLVED = 1e-12  # of the greatest coefficient, below which a term is nothing
LOOKS = 3  # each makes the place of an extreme closer by 1/8; a parabola through the last ones does the rest

Function = Callable[[Array, Array, Array], Array]
"""Of places (rows, points), the middles (rows, 1) of the smooth pieces that they lie in, and the machine (rows,) of each row."""


def smooth_pieces(breakpoints: Array, least: int) -> tuple[Array, Array, Array]:
    """Return machine, start and end of at least so many pieces of [0, 1] between the breakpoints (machines, places) of many machines."""
    even = np.broadcast_to(np.linspace(0, 1, least + 1), (len(breakpoints), least + 1))
    edges = np.sort(np.concatenate([np.nan_to_num(breakpoints, nan=1.0), even], axis=1), axis=1)
    machine, piece = np.nonzero(np.diff(edges, axis=1) > NARROW)
    return machine, edges[machine, piece], edges[machine, piece + 1]


@dataclass(frozen=True, eq=False)
class PieceRows:
    """Hold pieces (pieces,) of the curves of ``count`` machines over [0, 1]: machine, start and width, and the series (pieces, 20).

    They stand in the order of their machines and starts.
    """

    count: int
    machine: Array
    low: Array
    width: Array
    series: Array

    @classmethod
    def of(cls, function: Function, breakpoints: Array, pieces: int) -> PieceRows:
        """Return a function of many machines that is smooth between its breakpoints (machines, places), in at least so many pieces."""
        machine, low, high = smooth_pieces(breakpoints, pieces)
        width = high - low
        places = low[:, None] + width[:, None] * (NODES + 1) / 2
        values = function(places, (low + width / 2)[:, None], machine)
        return cls(len(breakpoints), machine, low, width, np.broadcast_to(values, places.shape) @ TO_SERIES.T)

    @cached_property
    def values(self) -> Array:
        """Return the values at the Gauss–Legendre places of each piece."""
        return self.series @ _VALUES.T

    @cached_property
    def _keys(self) -> Array:
        return self.machine + self.low

    def at(self, places: Array, machine: Array, middles: Array | None = None) -> Array:
        """Return values at places (rows, points) in [0, 1] of the machine (rows,) of each row.

        At an edge it is that of the piece on the side of ``middles`` (rows, points or 1), by default of the piece behind it.
        """
        towards = 0.0 if middles is None else np.clip(middles - places, -BESIDE, BESIDE)
        inside = np.minimum(places + towards, 1 - NARROW)
        if not places.size:
            return np.zeros(places.shape)
        if places.shape[1] == 1:  # as a search for a root or an extreme asks, again and again
            return self._in_pieces(piece := self._piece_of(inside, machine), self._shares(places, piece))
        found = np.empty(places.shape)
        ends = self._piece_of(np.stack([inside.min(axis=1), inside.max(axis=1)], axis=1), machine)
        alike = (ends[:, 0] == ends[:, 1]) & np.isfinite(inside).all(axis=1)
        for rows in filter(len, (np.flatnonzero(alike), np.flatnonzero(~alike))):
            piece = ends[rows, :1] if alike[rows].all() else self._piece_of(inside[rows], machine[rows])
            found[rows] = self._in_pieces(piece, self._shares(places[rows], piece))
        return found

    def _shares(self, places: Array, piece: Array) -> Array:
        """Where places lie in their pieces, from -1 to 1."""
        return 2 * (places - self.low[piece]) / self.width[piece] - 1

    def _piece_of(self, inside: Array, machine: Array) -> Array:
        """The piece that each place (rows, points) lies in."""
        return np.searchsorted(self._keys, machine[:, None] + inside, side="right") - 1

    @cached_property
    def _terms(self) -> Array:
        """The Chebyshev coefficients of the pieces, (degrees, pieces): their recurrence is the shorter one."""
        count = self.series.shape[1]
        return np.ascontiguousarray(TO_CHEBYSHEV[:count, :count] @ self.series.T)

    def _in_pieces(self, piece: Array, x: Array) -> Array:
        """Values at places x of pieces, from -1 to 1: (rows, points), the pieces (rows, points) or (rows, 1)."""
        return numerics.at_places(self._terms, piece, x)

    @property
    def is_resolved(self) -> bool:
        """Return whether the series follow the curves to rounding: their last terms are nothing beside the greatest value."""
        size = np.zeros(self.count)
        np.fmax.at(size, self.machine, np.abs(self.series).max(axis=1))
        last = np.abs(self.series[:, -3:]).max(axis=1)
        return not (last > RESOLVED * size[self.machine]).any()

    def split(self, parts: Array) -> PieceRows:
        """Return the same with each piece in so many parts."""
        if (parts == 1).all():
            return self
        piece = np.repeat(np.arange(len(parts)), parts)
        number = np.arange(len(piece)) - np.repeat(np.cumsum(parts) - parts, parts)
        width = self.width[piece] / parts[piece]
        shares = (2 * number[:, None] + 1 + NODES) / parts[piece][:, None] - 1
        series = self._in_pieces(piece[:, None], shares) @ TO_SERIES.T
        return PieceRows(self.count, self.machine[piece], self.low[piece] + number * width, width, series)

    def through(self, values: Array) -> PieceRows:
        """Return curves on the same pieces through values at their places."""
        return replace(self, series=values @ TO_SERIES.T)

    @property
    def mean(self) -> Array:
        """Return the mean of each machine's curve."""
        return self._added(self.series[:, 0])

    @property
    def rms(self) -> Array:
        """Return the root mean square of each machine's curve (Gauss–Legendre)."""
        return np.sqrt(self._added(self.values**2 @ WEIGHTS / 2))

    def _added(self, means: Array) -> Array:
        return np.bincount(self.machine, means * self.width, self.count)

    @property
    def excess(self) -> PieceRows:
        """Return the integral of each machine's curve above its mean, from the start on."""
        above = self.series.copy()
        above[:, 0] -= self.mean[self.machine]
        inside = legendre.legint(above, lbnd=-1, axis=1) * self.width[:, None] / 2
        whole = above[:, 0] * self.width
        known = np.where(np.isfinite(whole), whole, 0.0)  # a machine without values leaves nothing to those behind it
        passed = np.cumsum(known) - known  # of the machines before nothing is left
        inside[:, 0] += passed
        return replace(self, series=inside)

    @property
    def range(self) -> Array:
        """Return the greatest less the least value of each machine's curve."""
        return self.largest - self.least

    @property
    def largest(self) -> Array:
        """Return the greatest value of each machine's curve, one-sided limits at the edges included."""
        return self._largest(1.0)

    @property
    def least(self) -> Array:
        """Return the least value of each machine's curve."""
        return -self._largest(-1.0)

    def _largest(self, sign: float) -> Array:
        looks = sign * self.series @ _LOOK_VALUES[:, : self.series.shape[1]].T
        tops = np.full(self.count, -np.inf)
        np.maximum.at(tops, self.machine, looks.max(axis=1))
        lows = np.full(self.count, np.inf)
        np.minimum.at(lows, self.machine, looks.min(axis=1))
        near = tops - 1e-2 * (tops - lows)
        piece = np.flatnonzero(looks.max(axis=1) >= near[self.machine])
        width = 2 / (len(LOOK) - 1)
        place = np.clip(LOOK[np.argmax(looks[piece], axis=1)], width - 1, 1 - width)
        closer, found = numerics.looks(
            lambda x, own: -sign * self._in_pieces(piece[own, None], x), place - width, place + width, rounds=LOOKS
        )
        vertex = numerics.vertex(closer, found)
        highest = np.maximum(-found.min(axis=1), sign * self._in_pieces(piece[:, None], vertex[:, None])[:, 0])
        np.maximum.at(tops, self.machine[piece], highest)
        return tops


# What is read from curves over a turn of many machines at once, places being shares of it: where they change their sign, and their range.


TURN_SAMPLES_PIECES = 16  # of a turn, at least
TURN_SAMPLES_COUNT = 12  # Gauss–Legendre places in a piece
SHARES = (np.concatenate([[-1.0], legendre.leggauss(TURN_SAMPLES_COUNT)[0], [1.0]]) + 1) / 2
ACROSS = np.linspace(0, 1, 17)  # places of a closer look
TURN_SAMPLES_LOOKS = 4  # each makes a bracket narrower by 1/16, or by 1/8 about an extreme


@dataclass(frozen=True, eq=False)
class TurnSamples:
    """Hold a curve of many machines over a turn; ``breakpoints`` (machines, places) are shares where it is not smooth, NaN for none."""

    curve: Function
    breakpoints: Array

    @cached_property
    def _pieces(self) -> tuple[Array, Array, Array]:
        return smooth_pieces(self.breakpoints, TURN_SAMPLES_PIECES)

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
        for _ in range(TURN_SAMPLES_LOOKS if len(piece) else 0):
            closer = low[:, None] + (high - low)[:, None] * ACROSS
            first = np.argmax(_changes(self._values(closer, piece)), axis=1)
            each = np.arange(len(piece))
            low, high = closer[each, first], closer[each, first + 1]
        return numerics.in_rows((low + high) / 2, self._pieces[0][piece], len(self.breakpoints))

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
        ends = low[piece, None], high[piece, None]
        _, lows = numerics.least(
            lambda x, own: -sign * self._values(np.clip(x, *ends), piece[own]),
            place - width, place + width, rounds=TURN_SAMPLES_LOOKS,
        )  # fmt: skip
        np.maximum.at(tops, machine[piece], -lows)
        return tops[:, None]


def _changes(values: Array) -> Array:
    """Whether the sign changes from each value to the next; at a value of zero, from the one before it to the next."""
    found: Array = values[:, 1:] * values[:, :-1] < 0
    found[:, 1:] |= (values[:, 1:-1] == 0) & (values[:, :-2] * values[:, 2:] < 0)
    return found


TURN = 2 * np.pi
PIECES = (8, 16, 32)  # of a line's turn, at least: so many are tried


@dataclass(frozen=True, eq=False)
class ShaftCurve:
    """Hold a curve over a line's own turn: a function of shares of it, as ``TurnSamples`` takes it, with its breakpoints there.

    ``turns`` are those of the line for each of the main shaft, ``offset`` (machines, 1) the main-shaft angle (rad) of its zero.
    """

    function: Function
    breakpoints: Array
    turns: Fraction
    offset: Array

    def at(self, angle: Array, middle: Array, machine: Array | None) -> Array:
        """Return the curve at main-shaft angles (rows, points), each in the smooth piece of its middle; machines by default all."""
        places, inside, _, machine = self.turned(angle, middle, machine)
        return self.of_shares(places, inside, machine)

    def of_shares(self, places: Array, inside: Array, machine: Array) -> Array:
        """Return the curve at shares of the own turn: from its series, which were sampled once, where they follow it."""
        if self.pieces is None:
            return self.function(places, inside, machine)
        return self.pieces.at(places, machine, inside)

    @cached_property
    def pieces(self) -> PieceRows | None:
        """Return the curve as series over the own turn of all machines; None where it is not smooth between its breakpoints."""
        for pieces in PIECES:
            found = PieceRows.of(self.function, self.breakpoints, pieces)
            if found.is_resolved:
                return found
        return None

    def turned(self, angle: Array, middle: Array, machine: Array | None) -> tuple[Array, Array, Array, Array]:
        """Return shares of the own turn for angles and middles, the whole turns before them, and the machines."""
        machine = np.arange(len(angle)) % len(self.offset) if machine is None else machine
        offset = self.offset if len(self.offset) == 1 else self.offset[machine]
        rate = float(self.turns) / TURN
        share, inside = (angle - offset) * rate, (middle - offset) * rate
        passed = np.floor(inside)
        return share - passed, inside - passed, passed, machine

    @property
    def samples(self) -> TurnSamples:
        """Return the curve over its own turn."""
        return TurnSamples(self.of_shares, self.breakpoints)

    def joints(self, period: Array, more: Array | None = None) -> Array:
        """Return the main-shaft angles of its breakpoints, and of more shares, inside the common period (machines, 1); NaN for none."""
        shares = [np.zeros((len(self.offset), 1)), self.breakpoints, *(() if more is None else (more,))]
        widest = max(len(each) for each in shares)
        own = np.concatenate([np.broadcast_to(each, (widest, each.shape[1])) for each in shares], axis=1)
        length = TURN / float(self.turns)
        count = ceil(np.nanmax(period) / length * (1 - 1e-12))
        first = self.offset % length
        places = np.concatenate([first + (turn + own) * length for turn in range(-1, count + 1)], axis=1)
        return np.where((places > 0) & (places < period), places, np.nan)


def with_losses(torque: Array, efficiency: Array) -> Array:
    """Return a torque before a way with losses: more where it drives, less where it is given back."""
    return np.where(torque > 0, torque / efficiency, torque * efficiency)


@dataclass(frozen=True, eq=False)
class Consumer:
    """Hold what takes torque from the main shaft: the torque at its own shaft (N·m), and the efficiency (machines, 1) of the way there."""

    name: str
    torque: ShaftCurve
    efficiency: Array

    def at_main_shaft(self, angle: Array, middle: Array, machine: Array | None) -> Array:
        """Return its torque at the main shaft (N·m)."""
        efficiency = self.efficiency if machine is None or len(self.efficiency) == 1 else self.efficiency[machine]
        return float(self.torque.turns) * with_losses(self.torque.at(angle, middle, machine), efficiency)

    @cached_property
    def _reversals(self) -> Array:
        """Shares of its own turn where it changes its sign, so that losses turn over."""
        lossless = bool((self.efficiency == 1).all())
        return np.zeros((len(self.efficiency), 0)) if lossless else self.torque.samples.sign_changes

    @cached_property
    def pieces(self) -> PieceRows:
        """Return its torque at the main shaft over shares of its own turn, of all machines."""
        turns, count = float(self.torque.turns), len(self.efficiency)

        def carried(share: Array, middle: Array, machine: Array) -> Array:
            return turns * with_losses(self.torque.of_shares(share, middle, machine), self.efficiency[machine])

        own = np.broadcast_to(self.torque.breakpoints, (count, self.torque.breakpoints.shape[1]))
        return PieceRows.of(carried, np.concatenate([own, self._reversals], axis=1), PIECES[0])

    def joints(self, period: Array) -> Array:
        """Return the main-shaft angles where its torque is not smooth."""
        return self.torque.joints(period, self._reversals)
