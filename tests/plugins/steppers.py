"""Cam-gear steppers that the tests calculate."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.cam_gear_transport import MECHANISM
from tests.machines import at, inputs

PUBLISHED: dict[str, Any] = {
    "dwell_angle": "160 deg",
    "sector_dwell_sweep": "60 deg",
    "sector_stop_sweep": "20 deg",
    "motion_law": "cycloidal",
    "center_distance": "300 mm",
    "cycles_per_hour": "6000 1/h",
}
CAMS: dict[str, Any] = {
    "arm_length": "90 mm",
    "roller_radius": "25 mm",
    "arm_angle_1": "72 deg",
    "arm_angle_2": "232 deg",
}
CONVEYOR: dict[str, Any] = {"sprocket_teeth": 20, "chain_pitch": "25.4 mm", "sprocket_ratio": 1.5}
LOADED: dict[str, Any] = (
    CAMS | CONVEYOR | {"conveyor_mass": "20 kg", "sector_inertia": "0.3 kg*m**2", "roller_width": "25 mm"}
)
RATE = 6000 / 3600  # cycles a second


def stepper(**changes: Any) -> Calculation:
    """The published stepper with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, PUBLISHED | changes))


def smooth_places(calc: Calculation, count: int = 1501, clear: float = 2e-3) -> Array:
    """Disc angles that keep clear of all joints, so that differences may be taken there."""
    phi = np.linspace(0, 2 * np.pi, count, endpoint=False)
    edges = calc.domains["disc_angle"].edges[0]
    distance = np.abs(phi[:, None] - np.concatenate([edges, [2 * np.pi]])[None, :]).min(axis=1)
    found: Array = phi[distance > clear]
    return found


def slope(calc: Calculation, curve: str, phi: Array, step: float = 4e-4) -> Array:
    """The derivative of a curve by the disc angle, by central differences of fourth order."""
    near, far = (at(calc, curve, phi + n * step) - at(calc, curve, phi - n * step) for n in (1, 2))
    found: Array = (8 * near - far) / (12 * step)
    return found
