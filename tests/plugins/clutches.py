"""Clutches that the clutch's tests calculate."""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.clutch import MECHANISM
from tests.machines import inputs

BASE: dict[str, Any] = {"torque": "300 N*m", "service_factor": 1, "shoe_radius": "120 mm", "wedge_angle": "10 deg"}
HEATED: dict[str, Any] = BASE | {
    "speed": "600 rpm",
    "driven_inertia": "3 kg*m**2",
    "load_torque_at_engagement": "80 N*m",
    "engagements_per_hour": "240 1/h",
}
COOLED: dict[str, Any] = HEATED | {
    "drum_mass": "9 kg",
    "cooling": {"area": "0.2 m**2", "heat_transfer_coefficient": "25 W/(m**2*K)"},
}


def clutch(keys: dict[str, Any] = BASE, **changes: Any) -> Calculation:
    """A clutch with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, keys | changes))
