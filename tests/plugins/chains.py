"""Roller chains that the tests of roller chains calculate."""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.roller_chain import MECHANISM
from tests.machines import inputs

DRIVE: dict[str, Any] = {
    "chain": "12B", "teeth_1": 19, "torque": 200, "speed": 300, "center_distance": 600, "application_factor": 1,
}  # fmt: skip
GRIPPERS: dict[str, Any] = {
    "chain": "12B", "use": "conveyor", "strands": 2, "teeth_1": 30, "links": 240, "moving_mass": 9.6, "driven_inertia": 0.02,
    "velocity_curve": [0, 0, 0, 0, 1, 3, 5, 5, 3, 1], "acceleration_curve": [0, 0, 20, 60, 80, 40, 0, -40, -80, -60],
}  # fmt: skip
CUSTOM: dict[str, Any] = DRIVE | {
    "chain": "custom", "pitch": 20, "pin_diameter": 6, "bearing_area": 90, "breaking_load": 30, "mass_per_length": 1.2,
}  # fmt: skip
UNEVEN: dict[str, Any] = {key: value for key, value in DRIVE.items() if key not in ("torque", "application_factor")} | {
    "torque_curve": [200, 100, -50, 20, 80, 150],
}  # fmt: skip
RATED: dict[str, Any] = {key: value for key, value in DRIVE.items() if key not in ("chain", "torque")} | {
    "teeth_2": 57, "center_distance": 800, "power": 6, "power_rating": "ansi_b29_1", "allowable_bearing_pressure": 40,
}  # fmt: skip


def chain(keys: dict[str, Any] = DRIVE, **changes: Any) -> Calculation:
    """A chain with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, keys | changes))


def without(keys: dict[str, Any], *names: str) -> dict[str, Any]:
    """Keys without some of them."""
    return {key: value for key, value in keys.items() if key not in names}
