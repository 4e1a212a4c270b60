"""Machines of the kinds that the parts of a machine make: bodies of shafts, their inertia, what joins them, and their loads."""

from __future__ import annotations

from functools import cache
from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.mechanism import MechanismHandle
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.geneva_transport import MECHANISM as GENEVA
from tests.machines import drive, inputs

Data = dict[str, Any]
OF_PARTS = {"drive_line", "machine_inertia", "shaft_body", "shaft_loads"}
"""Kinds that the parts of a machine are calculated by: no example in configs/ has parts, so none has these."""

BODY: Data = {
    "discs": [
        {"name": "journal", "diameter": "50 mm", "width": "40 mm"},
        {"name": "tube", "diameter": "60 mm", "bore": "59.7 mm", "width": "0.3 m"},  # a little more bore, and nothing is left
        {"name": "wheel", "diameter": "348 mm", "bore": "60 mm", "width": "50 mm", "density": "7200 kg/m**3", "fill": 0.6},
    ],
    "bodies": [{"name": "disc", "mass": "9 kg", "inertia": "0.08 kg*m**2"}, {"name": "nut", "mass": "0.4 kg"}],
}  # fmt: skip
INERTIA: Data = {
    "shafts": [
        {"name": "main", "ratio": 1, "mass": "57.8 kg", "inertia": "0.576 kg*m**2"},
        {"name": "crank", "ratio": -0.5, "mass": "36.9 kg", "inertia": "0.13 kg*m**2"},
    ],
    "moving": [{"name": "rocker", "mass": "30 kg"}, {"name": "wheel", "mass": "41 kg"}],
}
LINE: Data = {
    "reference_speed": "100 rpm",
    "shafts": [{"name": "main", "ratio": 1}, {"name": "crank", "ratio": -0.5}],
    "meshes": [
        {"name": "crank_drive", "module": "5 mm", "teeth_1": 24, "teeth_2": 48},
        {"name": "helical", "module": "4 mm", "helix_angle": "15 deg", "teeth_1": 18, "teeth_2": 87},
    ],
    "chains": [
        {"name": "cylinder", "pitch": "12.7 mm", "links": 240, "teeth_1": 52, "teeth_2": 52, "mass_per_length": "0.69 kg/m", "strands": 2,
         "moving_mass": "9.6 kg", "pretension": "800 N"},
        {"name": "feeder", "pitch": "19.05 mm", "links": 120, "teeth_1": 30, "teeth_2": 20, "mass_per_length": "1.25 kg/m"},
    ],
    "belts": [{"name": "motor", "diameter_1": "125 mm", "diameter_2": "375 mm"}],
}  # fmt: skip
JOINTED: Data = {"crank_length": "100 mm", "pinion_radius": "60 mm", "n_points": 72}
CROSS: Data = {
    "slots": 6, "center_distance": "240 mm", "crank_speed": "100 rpm", "roller_radius": "16 mm", "sprocket_teeth": 30, "chain_pitch": "19.05 mm",
    "gear_ratio": 6, "driven_inertia": 1, "n_points": 72,
}  # fmt: skip
HALF: Data = {"mechanism": "drive", "turns_per_sheet": "1/2"}
ONCE: Data = {"mechanism": "cross", "turns_per_sheet": "1", "offset": "39.4 deg"}
LOADS: Data = {
    "main_turns": 2,
    "torques": [
        HALF | {"name": "wheel", "curve": "crank_torque", "ratio": 0.5, "efficiency": 0.97},
        ONCE | {"name": "crank", "curve": "torque", "ratio": -1},
        ONCE | {"name": "inertia", "curve": "wheel_acceleration", "inertia": "0.5 kg*m**2", "efficiency": 0.95},
    ],
    "forces": [
        HALF | {"name": "bearing", "curve": "crank_bearing_force_x", "ratio": -1, "constant": "120 N"},
        HALF | {"name": "chain", "curve": "crank_torque", "lever": "105 mm", "absolute": True, "constant": "800 N"},
        ONCE | {"name": "tooth", "curve": "wheel_acceleration", "inertia": "0.5 kg*m**2", "lever": "60 mm"},
    ],
    "n_points": 72,
}
STEPPED: Data = LOADS | {"motion": ONCE | {"curve": "wheel_angle"}, "main_turns": 6}
SWINGING: Data = {"main_turns": 2, "motion": HALF | {"curve": "rocker_angle", "ratio": -2.5}, "n_points": 72}


@cache
def moved_by() -> dict[str, Calculation]:
    """The mechanisms that drive the shafts, or are driven by them."""
    return {"drive": drive(**JOINTED), "cross": calculate(GENEVA, inputs(GENEVA, CROSS))}


def with_mechanisms(value: Any) -> Any:
    """The keys with mechanisms in place of their names."""
    if isinstance(value, list):
        return [with_mechanisms(each) for each in value]
    if isinstance(value, str) and value in ("drive", "cross"):
        return MechanismHandle(moved_by()[value], value)
    return {key: with_mechanisms(each) for key, each in value.items()} if isinstance(value, dict) else value
