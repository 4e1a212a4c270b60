"""Parallel keys that the tests of parallel keys calculate."""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.parallel_key import MECHANISM
from tests.machines import inputs

KEY: dict[str, Any] = {
    "shaft_diameter": 50, "key_length": 63, "form": "A", "torque": 494, "application_factor": 1, "yield_shaft": 650, "yield_hub": 370,
}  # fmt: skip
SIZED: dict[str, Any] = {name: value for name, value in KEY.items() if name != "key_length"} | {
    "hub_length": 80,
    "torque_peak": 700,
}
TURNING: dict[str, Any] = {name: value for name, value in KEY.items() if name not in ("torque", "application_factor")} | {
    "torque_curve": [494.11, 130, -327.4, 0, 50, 100], "key_count": 2, "brittle_hub": True,
}  # fmt: skip
OWN: dict[str, Any] = KEY | {
    "width": 15, "height": 10, "depth_shaft": 5.5, "depth_hub": 4.8, "chamfer": 0.5, "form": "B", "load_peak_factor": 1.3,
    "load_direction_factor": 0.8,
}  # fmt: skip


def key(keys: dict[str, Any] = KEY, **changes: Any) -> Calculation:
    """A parallel key with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, keys | changes))
