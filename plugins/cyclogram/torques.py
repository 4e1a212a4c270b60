"""Torques of all lines at the main shaft, the ways and kinetic energies of the lines over it, of all machines at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import isclose, pi
from typing import Any

import numpy as np

from diecut_report.api import Curve, GivenMechanism, Phrase, Refusal
from diecut_report.mechanics.timing.shaft_curves import Consumer, ShaftCurve
from diecut_report.plugins.cyclogram.kinds import ENERGIES, TORQUES, WAYS, Energy
from diecut_report.plugins.cyclogram.main_shaft import turns_of
from diecut_report.plugins.cyclogram.timing import Timing

TURN = 2 * pi


@dataclass(frozen=True, eq=False)
class Together:
    """Hold several curves over the main shaft by their names; what they are at the places that were last asked for is kept."""

    names: tuple[str, ...]
    parts: tuple[Any, ...]  # each a function of angles, middles and machines
    _last: list[Any] = field(default_factory=list)

    def each(self, angle: Any, middle: Any, machine: Any) -> Any:
        """Return all curves at main-shaft angles (rows, points), shape (curves, rows, points)."""
        asked = (angle, middle, machine)
        if not self._last or any(one is not other for one, other in zip(self._last[0], asked, strict=True)):
            found = [np.broadcast_to(part(*asked), np.shape(angle)) for part in self.parts]
            self._last[:] = asked, np.stack(found) if found else np.zeros((0, *np.shape(angle)))
        return self._last[1]

    def total(self, angle: Any, middle: Any, machine: Any) -> Any:
        """Return the sum of all."""
        return self.each(angle, middle, machine).sum(axis=0)

    def one(self, part: int, angle: Any, middle: Any, machine: Any) -> Any:
        """Return one of them."""
        return self.each(angle, middle, machine)[part]


@dataclass(frozen=True, eq=False)
class Torques:
    """Hold what takes torque from the main shaft; ``without`` are the lines whose torque is not known."""

    consumers: tuple[Consumer, ...]
    without: tuple[str, ...]
    period: Any

    @cached_property
    def together(self) -> Together:
        """Return the torques of all consumers at the main shaft."""
        return Together(
            tuple(each.name for each in self.consumers), tuple(each.at_main_shaft for each in self.consumers)
        )

    @cached_property
    def joints(self) -> Any:
        """Return the main-shaft angles at which a torque jumps, has a corner, or changes its sign, shape (machines, places)."""
        return np.concatenate([each.joints(self.period) for each in self.consumers], axis=1)

    @cached_property
    def greatest(self) -> Any:
        """Return the number of the consumer that takes most in the mean, of each machine."""
        return np.argmax(self._figures["mean"], axis=0)

    @cached_property
    def _figures(self) -> dict[str, Any]:
        """Figures of each consumer's torque over its own turn, shapes (consumers, machines)."""
        pieces = [each.pieces for each in self.consumers]
        found = {
            name: np.stack([getattr(each, name) for each in pieces]) for name in ("mean", "rms", "largest", "least")
        }
        periods = [TURN / float(each.torque.turns) for each in self.consumers]
        excess = [each.excess.range * period for each, period in zip(pieces, periods, strict=True)]
        return found | {"fluctuation": np.stack(excess)}

    def figure_of_greatest(self, name: str) -> Any:
        """Return a figure of the torque of the consumer that takes most, shape (machines, 1)."""
        return np.take_along_axis(self._figures[name], self.greatest[None], axis=0)[0][:, None]

    def of_greatest(self, angle: Any, middle: Any, machine: Any) -> Any:
        """Return the torque of that consumer alone at main-shaft angles."""
        chosen = (
            self.greatest
            if machine is None
            else self.greatest[machine if len(self.greatest) > 1 else np.zeros_like(machine)]
        )
        every = self.together.each(angle, middle, machine)
        return every[np.broadcast_to(chosen, len(angle)), np.arange(len(angle))]


@dataclass(frozen=True, eq=False)
class Motions:
    """Hold how the lines move over the main shaft: their ways, their kinetic energies, and the places where these are not smooth."""

    ways: Together
    energies: Together
    joints: Any
    ranges: Any  # of each line's kinetic energy added up, shape (machines, 1)


def torques_of(given: Mapping[str, Any]) -> Torques:
    """Return what takes torque from the main shaft: the lines with a torque, and constant consumers."""
    lines = lines_of_all(given)
    known = {line.name: _torque(line, f"lines.{index}.torque_curve") for index, line in enumerate(lines)}
    consumers = [
        Consumer(line.name, torque, line.efficiency) for line in lines if (torque := known[line.name]) is not None
    ]
    consumers += [_friction(given, index) for index in range(len(given.get("friction.name", ())))]
    return Torques(
        tuple(consumers), tuple(name for name, torque in known.items() if torque is None), given["main_period"]
    )


def motions_of(given: Mapping[str, Any]) -> Motions:
    """Return how the lines move, as far as it is known."""
    lines, period = lines_of_all(given), given["main_period"]
    ways = {line.name: way for line in lines if (way := _way(line)) is not None}
    energies = {line.name: curve for line in lines if (curve := _energy(line)) is not None}
    places = [each[0].joints(period) for each in ways.values()] + [each.joints(period) for each in energies.values()]
    ranges = sum((_range(each) for each in energies.values()), np.zeros_like(period))
    return Motions(
        Together(tuple(ways), tuple(function for _, function in ways.values())),
        Together(tuple(energies), tuple(each.at for each in energies.values())),
        np.concatenate([np.full_like(period, np.nan), *places], axis=1),
        ranges,
    )


def _range(curve: ShaftCurve) -> Any:
    return curve.samples.range if curve.pieces is None else curve.pieces.range[:, None]


@dataclass(frozen=True, eq=False)
class LineOfMachines:
    """Hold a line of all machines: how it is driven, and its offset (machines, 1)."""

    mechanism: Any
    turns: Any
    offset: Any
    efficiency: Any
    torque_curve: str

    @property
    def name(self) -> str:
        """Return the name of its mechanism."""
        return str(self.mechanism.name)

    def curve(self, of: Curve) -> ShaftCurve:
        """Return a curve of the mechanism over the main shaft."""
        return ShaftCurve(of.values, of.breakpoints, self.turns, self.offset)


def lines_of_all(given: Mapping[str, Any]) -> list[LineOfMachines]:
    """Return the lines of all machines."""
    timings: tuple[Timing | None, ...] = given["timing"] if isinstance(given["timing"], tuple) else (given["timing"],)
    offsets = [[0.0] * len(given["lines.mechanism"]) if each is None else each.offsets for each in timings]
    return [
        LineOfMachines(mechanism, turns_of(given["lines.turns_per_sheet"][index], ""), np.array(offsets)[:, [index]],
             given["lines.path_efficiency"][:, [index]], given["lines.torque_curve"][index])
        for index, mechanism in enumerate(given["lines.mechanism"])
    ]  # fmt: skip


def _torque(line: LineOfMachines, key: str) -> ShaftCurve | None:
    curve = line.mechanism.curve(torque_name(line.mechanism, line.torque_curve))
    if curve is None and line.torque_curve:
        message = Phrase(
            "is “{torque_curve}”, but {name} has no curve of this name; leave it out, and its kind's own is taken",
            torque_curve=line.torque_curve,
            name=line.name,
        )
        raise Refusal(key, message)
    if curve is not None and not curve.is_in("N*m"):
        template = "is “{curve}” of {name}, which is not a curve in N*m; name that of the torque at its crank"
        raise Refusal(key, Phrase(template, curve=line.torque_curve, name=line.name))
    if curve is not None and not isclose(line.mechanism.period(), line.mechanism.cycle()):
        template = (
            "is over a part of the cycle of {name} alone, so that it tells no torque over the main shaft; leave it out"
        )
        raise Refusal(key, Phrase(template, name=line.name))
    return None if curve is None else line.curve(curve)


def torque_name(mechanism: GivenMechanism, named: str) -> str:
    """Return the id of the curve of a line's torque: the one that is named, else that of its kind."""
    return named or TORQUES.get(mechanism.kind, "")


def energy_parts(mechanism: Any) -> tuple[Energy, list[Curve], list[Any]] | None:
    """Return how a line's kinetic energy is made, with the curves and numbers that it is made of; None where it is not known."""
    known = ENERGIES.get(mechanism.kind)
    if known is None:
        return None
    curves = [curve for curve in map(mechanism.curve, known.curves) if curve is not None]
    numbers = [number for number in map(mechanism.numbers, known.numbers) if number is not None]
    return (known, curves, numbers) if (len(curves), len(numbers)) == (len(known.curves), len(known.numbers)) else None


def _energy(line: LineOfMachines) -> ShaftCurve | None:
    found = energy_parts(line.mechanism)
    if found is None:
        return None
    known, curves, numbers = found

    def energy(share: Any, middle: Any, machine: Any) -> Any:
        own = [number if len(number) == 1 else number[machine] for number in numbers]
        return known.of(*(curve.values(share, middle, machine) for curve in curves), *own)

    return ShaftCurve(energy, curves[0].breakpoints, line.turns, line.offset)


def _way(line: LineOfMachines) -> tuple[ShaftCurve, Any] | None:
    """The curve of a line's way, and the way from where it is at the line's zero, going on where its curve gains in a turn."""
    curve = line.mechanism.curve(WAYS.get(line.mechanism.kind, ""))
    if curve is None:
        return None
    own, gain = line.curve(curve), curve.gain(None)

    def way(angle: Any, middle: Any, machine: Any) -> Any:
        share, inside, passed, machine = own.turned(angle, middle, machine)
        return own.function(share, inside, machine) + passed * (gain if len(gain) == 1 else gain[machine])

    return own, way


def _friction(given: Mapping[str, Any], index: int) -> Consumer:
    turns = turns_of(given["friction.turns_per_sheet"][index], f"friction.{index}.turns_per_sheet")
    speed = float(turns) * given["main_shaft_speed"]
    torque = _part(given.get("friction.torque"), index)
    torque = _part(given["friction.power"], index) / speed if torque is None else np.broadcast_to(torque, speed.shape)
    zero = np.zeros_like(speed)

    def constant(share: Any, middle: Any, machine: Any) -> Any:
        return np.broadcast_to(torque[machine] if len(torque) > 1 else torque, np.shape(share))

    curve = ShaftCurve(constant, np.zeros((len(speed), 0)), turns, zero)
    return Consumer(given["friction.name"][index], curve, _part(given["friction.path_efficiency"], index))


def _part(values: Any, index: int) -> Any:
    """The numbers of one of repeated parts, shape (machines, 1); None where it does not have it."""
    if values is None or isinstance(values, tuple):
        found = None if values is None else values[index]
        return None if found is None else np.reshape(np.asarray(found, dtype=float), (-1, 1))
    return values[:, [index]]
