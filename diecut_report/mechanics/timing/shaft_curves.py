"""Curves of lines over the angle of the main shaft, of many machines at once, and what a torque at a line's shaft is there.

A torque M at a line's own shaft is i·M·η^(−sgn M) at the main shaft, i turns of the line a turn of the main shaft: losses add
where the shaft gives power, and take away where the line gives it back.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import ceil

import numpy as np

from diecut_report.expressions import Array
from diecut_report.mechanics.timing.piece_rows import PieceRows
from diecut_report.mechanics.timing.turn_samples import Curve, TurnSamples

TURN = 2 * np.pi
PIECES = (8, 16, 32)  # of a line's turn, at least: so many are tried


@dataclass(frozen=True, eq=False)
class ShaftCurve:
    """Hold a curve over a line's own turn: a function of shares of it, as ``TurnSamples`` takes it, with its breakpoints there.

    ``turns`` are those of the line for each of the main shaft, ``offset`` (machines, 1) the main-shaft angle (rad) of its zero.
    """

    function: Curve
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
