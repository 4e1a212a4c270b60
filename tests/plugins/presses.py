"""A press whose mechanisms are held against one another: the published drive with a train, as a consistency check takes it."""

from __future__ import annotations

from functools import cache
from typing import Any

from diecut_report.machine.calculation import Calculation, CurveHandle
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.names import SI
from diecut_report.plugins.drive_train import MECHANISM as DRIVE_TRAIN
from tests.machines import UNBALANCED, drive, inputs, number
from tests.plugins.drive_trains import EXAMPLE as TRAIN
from tests.plugins.drive_trains import PAIRS

OF_DRIVE = {
    "cylinder_rotation": "cylinder_rotation", "cylinder_speed": "cylinder_speed", "displacement": "displacement", "velocity": "velocity",
    "stroke": "stroke", "dead_center_outer": "dead_center_outer", "dead_center_inner": "dead_center_inner",
    "crank_speed": "inputs.crank_speed", "cylinder_mass": "inputs.cylinder_mass", "cylinder_inertia": "inputs.cylinder_inertia",
    "cylinder_radius": "inputs.cylinder_radius", "static_unbalance": "inputs.static_unbalance",
}  # fmt: skip
OF_TRAIN = {
    "flywheel_torque": "flywheel_torque", "output_speed": "output_speed", "flywheel_inertia": "flywheel_inertia",
    "flywheel_speed": "shaft_2_speed", "belt_ratio": "vbelt_ratio_actual", "motor_rated_torque": "motor_rated_torque",
    "motor_speed": "inputs.motor_speed", "synchronous_speed": "synchronous_speed", "breakdown_ratio": "inputs.breakdown_ratio",
    "speed_fluctuation": "inputs.speed_fluctuation",
}  # fmt: skip
TYPED: dict[str, Any] = {
    "productivity": "6000 1/h", "sheet_length": "700 mm", "sheet_width": "470.7 mm", "sheet_gap": "60 mm", "working_length": "470.7 mm",
    "generatrix_length": "700 mm", "sheet_step": "571.5 mm", "chain_pitch": "19.05 mm", "sprocket_teeth": 30, "sheet_play": "0.2743 mm",
    "register_tolerance": "0.3 mm", "conveyor_mass": "12 kg", "chain_mass": "11.5 kg", "chain_links": 240, "wheel_inertia": "3.6 kg*m**2",
    "wheel_side_inertia": "0.02 kg*m**2", "loaded_output_speed": "50 rpm",
    "travel_radius": "545.7423 mm",
    "clutch_torque": "741.166 N*m", "clutch_load": "20 N*m", "clutch_speed": "49.32 rpm", "clutch_inertia": "16 kg*m**2",
    "damper_velocity": "0.6 m/s", "contact_distance": "10 mm", "damper_impacts": "3000 1/h",
    "timing_slack": "5 deg", "belt_efficiency": 0.95, "n_points": 72,
}  # fmt: skip


def taken(calculation: Calculation, names: dict[str, str]) -> dict[str, Any]:
    """Curves and numbers of a mechanism, by the keys that take them."""
    curves = {key: CurveHandle(calculation, name) for key, name in names.items() if name in calculation.curves}
    numbers = {key: number(calculation, name) for key, name in names.items() if key not in curves}
    units = {key: calculation.step_or_input(names[key]).unit for key in numbers}
    return curves | {key: SI(value, units[key], names[key]) for key, value in numbers.items()}


@cache
def whole_press() -> dict[str, Any]:
    """The keys of a consistency check that has all that it needs."""
    cylinder = drive(**UNBALANCED, crank_speed="50 rpm", n_points=72)
    load = CurveHandle(cylinder, "crank_torque")
    keys = TRAIN | {
        "gears": PAIRS,
        "torque_curve": load,
        "torque_mean": 65,
        "torque_peak": 700,
        "output_speed": "50 rpm",
    }
    train = calculate(DRIVE_TRAIN, inputs(DRIVE_TRAIN, keys))
    return TYPED | taken(cylinder, OF_DRIVE) | taken(train, OF_TRAIN)
