"""The exact height that the cylinder leaves the carriages, where it is known where they stand; of all machines at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.api import Phrase, Refusal, named
from diecut_report.mechanics.timing.clearance import LeastClearance, Station, carriage_clearance, least_clearance
from diecut_report.mechanics.timing.shaft_curves import ShaftCurve
from diecut_report.plugins.cyclogram.kinds import POSITION, STEP
from diecut_report.plugins.cyclogram.torques import LineOfMachines, lines_of_all

CYLINDER = ("cylinder_radius", "flat_half_angle", "stroke")
ROTATION = "cylinder_rotation"


@dataclass(frozen=True, eq=False)
class Clearance:
    """Hold the station of each machine, how the cylinder turns and the carriages go over the main shaft, and the least height."""

    station: Station
    rotation: ShaftCurve
    position: ShaftCurve
    standing: Any  # where in its way a carriage stands, shape (machines, 1)
    period: Any

    def height(self, angle: Any, machine: Any) -> Any:
        """Return the least height over all carriages at main-shaft angles (rows, points), infinite where none is below the cylinder."""
        return self._height(angle, angle, machine)

    def _height(self, angle: Any, middle: Any, machine: Any) -> Any:
        step = self.station.step[machine] if len(self.station.step) > 1 else self.station.step
        standing = self.standing[machine] if len(self.standing) > 1 else self.standing
        share, inside, passed, machine = self.position.turned(angle, middle, machine)
        way = self.position.function(share, inside, machine) + passed * step - standing
        return carriage_clearance(self.station.of(machine), self.rotation.at(angle, middle, machine), way)

    def over(self, angle: Any, middle: Any, machine: Any) -> Any:
        """Return it as a curve over the main shaft; where no carriage is below the cylinder, its radius stands."""
        machine = np.arange(len(angle)) % len(self.period) if machine is None else machine
        radius = self.station.radius[machine] if len(self.station.radius) > 1 else self.station.radius
        return np.minimum(self._height(angle, middle, machine), radius)

    @property
    def least(self) -> LeastClearance:
        """Return the least height of each machine, and the main-shaft angle where it is."""
        return least_clearance(self.height, self.period[:, 0])


def clearance_of(given: Mapping[str, Any]) -> Clearance:
    """Return the heights over all carriages; Refusal in words where something is missing."""
    lines = lines_of_all(given)
    cylinder = _line(lines, given["station.cylinder"].name, "station.cylinder")
    transport = _line(lines, given["station.transport"].name, "station.transport")
    radius, half, stroke = (_numbers(cylinder, name, "station.cylinder") for name in CYLINDER)
    step = _numbers(transport, STEP, "station.transport")
    stop, width = given["station.carriage_stop"], given["station.carriage_width"]
    station = Station(radius, half, stroke, given["station.forward_direction"] == "with", stop, step, width)
    position = _curve(transport, POSITION, "station.transport")
    rotation = _curve(cylinder, ROTATION, "station.cylinder")
    return Clearance(station, rotation, position, _standing(transport, position), given["main_period"])


def _standing(transport: LineOfMachines, position: ShaftCurve) -> Any:
    """The way of each machine at which the carriages stand in the dwell."""
    mechanism, count = transport.mechanism, len(transport.offset)
    own = [mechanism.of_machine(row) for row in range(count)]
    dwells = [each.phases.get("dwell") for each in own]
    shares = [np.nan if dwell is None else dwell.intervals()[0][0] / dwell.period() % 1 for dwell in dwells]
    places = np.array(shares)[:, None]
    return position.function(places, places, np.arange(count))


def _line(lines: list[LineOfMachines], name: str, key: str) -> LineOfMachines:
    found = next((each for each in lines if each.name == name), None)
    if found is None:
        raise Refusal(
            key,
            Phrase(
                "is {name}, which is not a line; the lines are {text}",
                name=name,
                text=named([each.name for each in lines], ", "),
            ),
        )
    return found


def _numbers(line: LineOfMachines, name: str, key: str) -> Any:
    found = line.mechanism.numbers(name)
    if found is None:
        raise Refusal(
            key,
            Phrase(
                "is {name}, which has no {name_2}; give what it needs there, or leave the station out",
                name=line.name,
                name_2=name,
            ),
        )
    return found


def _curve(line: LineOfMachines, name: str, key: str) -> ShaftCurve:
    curve = line.mechanism.curve(name)
    if curve is None:
        raise Refusal(key, Phrase("is {name}, which has no curve {name_2}", name=line.name, name_2=name))
    return line.curve(curve)
