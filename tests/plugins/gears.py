"""Gear pairs that the tests of gear pairs calculate."""

from __future__ import annotations

from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.gear_pair import MECHANISM
from tests.machines import inputs

STEEL: dict[str, Any] = {"sigma_h_lim_1": 767, "sigma_h_lim_2": 767, "sigma_f_lim_1": 314, "sigma_f_lim_2": 314}
FACTORS: dict[str, Any] = {
    "application_factor": 1.25,
    "dynamic_factor": 1.1,
    "face_load_factor": 1.3,
    "transverse_load_factor": 1.2,
}
SPUR: dict[str, Any] = STEEL | {"module": 4, "teeth_1": 24, "teeth_2": 61, "face_width": 40, "torque": 200}
HELICAL: dict[str, Any] = SPUR | FACTORS | {"helix_angle": 14, "shift_1": 0.2, "shift_2": -0.1, "speed": 300}
SECTOR: dict[str, Any] = STEEL | {
    "module": 4, "teeth_1": 35, "teeth_2": 212, "face_width": 40, "torque_curve": [248.37, 100, -20, -133.57, 0, 50, 100, 200],
    "application_factor": 1, "sector": {"swing": "59.4576 deg", "teeth_present": 39},
}  # fmt: skip
AT_DISTANCE: dict[str, Any] = HELICAL | {
    "center_distance": 177,
    "keep_clearance": True,
    "torque_on": "wheel",
    "alternating_factor": 0.8,
}
del AT_DISTANCE["shift_2"]
GRADED: dict[str, Any] = STEEL | {  # the crank drive of the method's sheet
    "module": 5, "teeth_1": 24, "teeth_2": 48, "face_width": 50, "torque": 501.53, "torque_on": "wheel", "application_factor": 1, "grade": 8,
    "speed": 100, "slope": 0.106,
}  # fmt: skip
SIZED_BY_GRADE: dict[str, Any] = {key: value for key, value in GRADED.items() if key != "module"} | {
    "helix_angle": 10, "crowned": True, "flanks_1": "case_hardened", "flanks_2": "grey_iron",
}  # fmt: skip
SIZED: dict[str, Any] = {key: value for key, value in HELICAL.items() if key != "module"}


def pair(keys: dict[str, Any] = SPUR, **changes: Any) -> Calculation:
    """A gear pair with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, keys | changes))
