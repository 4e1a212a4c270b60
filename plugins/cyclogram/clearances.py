"""The exact height that the cylinder leaves the carriages, where it is known where they stand."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import pi
from typing import Any

import numpy as np

from diecut_report.api import GivenMechanism, Refusal
from diecut_report.mechanics.timing.clearance import LeastClearance, Station, least_clearance
from diecut_report.plugins.cyclogram.kinds import POSITION, STEP, at
from diecut_report.plugins.cyclogram.main_shaft import LineOnShaft
from diecut_report.plugins.cyclogram.timing import Timing

TURN = 2 * pi
CYLINDER = ("cylinder_radius", "flat_half_angle", "stroke")


def clearance_of(given: Mapping[str, Any]) -> LeastClearance:
    """Return the least height over all carriages and the main-shaft angle where it is; Refusal where something is missing."""
    timing: Timing = given["timing"]
    cylinder = _line(timing, given["station.cylinder"], "station.cylinder")
    transport = _line(timing, given["station.transport"], "station.transport")
    radius, half, stroke = (_number(cylinder.mechanism, name, "station.cylinder") for name in CYLINDER)
    step = _number(transport.mechanism, STEP, "station.transport")
    stop, width = (float(given[f"station.{key}"][0, 0]) for key in ("carriage_stop", "carriage_width"))
    station = Station(radius, half, stroke, given["station.forward_direction"] == "with", stop, step, width)
    rotation = _over_main(cylinder, "cylinder_rotation", "station.cylinder", 0.0)
    return least_clearance(station, rotation, way_of(transport, step), timing.period)


def _line(timing: Timing, mechanism: GivenMechanism, key: str) -> LineOnShaft:
    found = next((each for each in timing.lines if each.name == mechanism.name), None)
    if found is None:
        told = ", ".join(each.name for each in timing.lines)
        raise Refusal(key, f"is {mechanism.name}, which is not a line; the lines are {told}")
    return found


def _number(mechanism: GivenMechanism, name: str, key: str) -> float:
    found = mechanism.number(name)
    if found is None:
        raise Refusal(
            key, f"is {mechanism.name}, which has no {name}; give what it needs there, or leave the station out"
        )
    return found


def _over_main(line: LineOnShaft, name: str, key: str, gain: float) -> Callable[[Any], Any]:
    """A curve of a line over main-shaft angles; it has ``gain`` more after each turn of the line."""
    curve = line.mechanism.curve(name)
    if curve is None:
        raise Refusal(key, f"is {line.name}, which has no curve {name}")

    def over(angle: Any) -> Any:
        turned = (np.asarray(angle) - line.line.offset) * float(line.line.turns) / TURN
        passed = np.floor(turned)
        return at(curve, turned - passed, turned - passed) + passed * gain

    return over


def way_of(line: LineOnShaft, step: float) -> Callable[[Any], Any]:
    """Return the way of the carriages from where they stand in the dwell, over main-shaft angles."""
    position = _over_main(line, POSITION, "station.transport", step)
    rests = line.mechanism.phases["dwell"].intervals()[0][0] / line.mechanism.period()
    curve = line.mechanism.curve(POSITION)
    assert curve is not None
    middle = np.array([rests])
    standing = float(at(curve, middle, middle)[0])
    return lambda angle: position(angle) - standing
