"""Torques of all lines at the main shaft, and the kinetic energy that they lend one another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Any

import numpy as np

from diecut_report.mechanics.timing.bracketed import sign_changes
from diecut_report.mechanics.timing.legendre_pieces import unique_edges
from diecut_report.mechanics.timing.lines import DrivenLine
from diecut_report.mechanics.timing.torque_sum import (
    Consumer,
    EnergySum,
    LineCurve,
    TorqueFigures,
    TorqueSum,
    energy_exchange,
    figures,
    friction,
    sum_edges,
    torque_sum,
)
from diecut_report.plugins.cyclogram.kinds import TORQUES, at, energy_curve
from diecut_report.plugins.cyclogram.main_shaft import LineOnShaft, of_part, turns_of
from diecut_report.plugins.cyclogram.timing import Timing

TURN = 2 * pi


@dataclass(frozen=True, eq=False)
class SumCurve:
    """Give the sum of consumers' torques over shares of the common period, one-sided at its breakpoints."""

    consumers: tuple[Consumer, ...]
    period: float
    edges: Any

    def values(self, share: Any, middle: Any, rows: Any) -> Any:
        """Return the sum, N·m, at shares of the period, each in the smooth piece of its middle."""
        places, inside = np.broadcast_arrays(np.asarray(share) * self.period, np.asarray(middle) * self.period)
        total = sum(each.at_main_shaft(places.ravel(), inside.ravel()) for each in self.consumers)
        return np.broadcast_to(total, places.size).reshape(places.shape)

    @property
    def breakpoints(self) -> Any:
        """Return the inner edges of its smooth pieces, as shares."""
        return self.edges[None, 1:-1] / self.period

    joints = breakpoints

    def gain(self, rows: Any) -> Any:
        """Return nothing: the sum closes."""
        return np.zeros((1, 1))


@dataclass(frozen=True, eq=False)
class Sum:
    """Hold what takes torque from the main shaft; ``without`` are the lines whose torque is not known."""

    timing: Timing
    consumers: tuple[Consumer, ...]
    without: tuple[str, ...]

    @property
    def curves(self) -> list[LineCurve]:
        """Return the torques at the consumers' own shafts."""
        return [each.torque for each in self.consumers]

    @cached_property
    def joints(self) -> Any:
        """Return the main-shaft angles at which the torques jump, have a corner, or change their sign, the ends included."""
        common = self.timing.common
        smooth = sum_edges(self.curves, common)
        reversals = [sign_changes(each.torque.at, smooth) for each in self.consumers]
        places = np.concatenate([*(each.edges(common) for each in self.curves), *reversals])
        return unique_edges(places, 0.0, self.timing.period)

    @cached_property
    def figures(self) -> TorqueSum:
        """Return the torques as series, with what follows from them."""
        return torque_sum(self.consumers, self.timing.common)

    @property
    def curve(self) -> SumCurve:
        """Return the total torque."""
        return SumCurve(self.consumers, self.timing.period, self.joints)

    @cached_property
    def greatest(self) -> SumCurve:
        """Return the torque of the consumer that takes most, in the mean."""
        parts = self.figures.parts
        index = max(range(len(self.consumers)), key=lambda i: parts[self.consumers[i].name].mean)
        return SumCurve((self.consumers[index],), self.timing.period, self.joints)

    @cached_property
    def greatest_figures(self) -> TorqueFigures:
        """Return the figures of that consumer's torque."""
        return max((figures(part) for part in self.figures.parts.values()), key=lambda each: each.mean)

    @cached_property
    def energies(self) -> EnergySum | None:
        """Return the kinetic energies of the lines of which they are known; None where that is none."""
        found = [curve for curve in map(energy_of, self.timing.lines) if curve is not None]
        return energy_exchange(found, self.timing.common) if found else None


def sum_of(given: Mapping[str, Any]) -> Sum:
    """Return what takes torque from the main shaft: the lines with a torque, and constant consumers."""
    timing: Timing = given["timing"]
    torques = {line.name: torque_of(line) for line in timing.lines}
    consumers = [
        Consumer(line.name, torque, line.efficiency)
        for line in timing.lines
        if (torque := torques[line.name]) is not None
    ]
    consumers += [_friction(given, index, timing) for index in range(len(given.get("friction.name", ())))]
    return Sum(timing, tuple(consumers), tuple(name for name, torque in torques.items() if torque is None))


def torque_of(line: LineOnShaft) -> LineCurve | None:
    """Return the torque at a line's own shaft; None where it is not known."""
    curve = line.mechanism.curve(line.torque_curve or TORQUES.get(line.mechanism.kind, ""))
    if curve is None:
        return None
    return LineCurve(lambda share, middle: at(curve, share, middle), curve.breakpoints[0], line.line)


def energy_of(line: LineOnShaft) -> LineCurve | None:
    """Return the kinetic energy of a line; None where it is not known."""
    found = energy_curve(line.mechanism)
    if found is None:
        return None
    function, curves = found
    places = np.unique(np.concatenate([curve.breakpoints[0] for curve in curves]))
    return LineCurve(function, places, line.line)


def _friction(given: Mapping[str, Any], index: int, timing: Timing) -> Consumer:
    turns = turns_of(given["friction.turns_per_sheet"][index], f"friction.{index}.turns_per_sheet")
    torque = _optional(given.get("friction.torque"), index)
    if torque is None:
        power = _optional(given.get("friction.power"), index) or 0.0
        torque = power / (float(turns) * TURN * timing.productivity)
    efficiency = float(of_part(given["friction.path_efficiency"], index))
    return friction(given["friction.name"][index], torque, DrivenLine(turns), efficiency)


def _optional(row: Any, index: int) -> float | None:
    value = None if row is None else of_part(row, index)
    return None if value is None else float(value)
