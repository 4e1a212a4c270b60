"""Shafts that several tests calculate: the crankshaft of the method's worked example, and one with all that may be given."""

from __future__ import annotations

from functools import cache
from typing import Any

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.shaft import MECHANISM
from tests.machines import inputs

SECTIONS: list[dict[str, Any]] = [
    {"length": 50, "diameter": 45, "fillet_radius": 1.5},
    {"length": 170, "diameter": 55, "fillet_radius": 2},
    {"length": 60, "diameter": 60, "fillet_radius": 2},
    {"length": 60, "diameter": 50},
]
GEAR: dict[str, Any] = {
    "name": "gear",
    "position": 130,
    "force_y": -1498.344,
    "force_z": 4116.667,
    "torque": {"min": -327, "max": 494},
    "mass": 12,
}
CRANK: dict[str, Any] = {
    "name": "crank",
    "position": 310,
    "offset": 45,
    "force_y": -9994,
    "torque": "balance",
    "mass": 8,
}
CRANKSHAFT: dict[str, Any] = {
    "sections": SECTIONS,
    "seat_a": "loose",
    "seat_b": "loose",  # as the method calculates its example
    "notches": [{"position": 130, "type": "keyseat_end_mill"}, {"position": 310, "type": "keyseat_end_mill"}],
    "bearing_a": 25,
    "bearing_b": 250,
    "tensile_strength": 900,
    "yield_strength": 650,
    "loads": [GEAR, CRANK],
    "n_points": 72,
}
LAYSHAFT: dict[str, Any] = {
    "sections": [
        {"length": 60, "diameter": 40},
        {"length": 120, "diameter": 50, "bore": 10, "fillet_radius": 2.5},
        {"length": 80, "diameter": 45, "bore": 10},
        {"length": 40, "diameter": 45},
    ],
    "notches": [
        {"position": 100, "type": "keyseat_sled_runner", "radius": 0.6, "k_t": 1.7, "k_ts": 3},
        {"position": 120, "type": "groove_ring"},
        {"position": 140, "type": "press_fit"},
        {"position": 220, "type": "custom", "k_t": 1.8, "k_ts": 1.4, "radius": 1},
        {"position": 230, "type": "custom", "k_f": 1.6, "k_fs": 1.3},
    ],
    "bearing_a": 20,
    "bearing_b": 250,
    "locating": "b",
    "tensile_strength": 700,
    "yield_strength": 450,
    "surface": "ground",
    "reliability": 99.9,
    "speed": 1500,
    "turns_per_cycle": 2,
    "allowable_deflection": 0.1,
    "allowable_twist": 0.5,
    "loads": [
        {"name": "wheel", "position": 100, "torque": 120, "gear": {"pitch_radius": 80, "helix_angle": 15, "mesh_angle": 90}},
        {"name": "pinion", "position": 220, "torque": "balance", "gear": {"pitch_radius": 40, "helix_angle": 15, "mesh_angle": 0}},
        {"name": "thrust", "position": 300, "axial_force": {"min": -500, "max": 200}, "couple_xy": 5, "couple_xz": -3, "force_y": 100},
    ],
    "n_points": 72,
}  # fmt: skip
STANDING: dict[str, Any] = {key: value for key, value in CRANKSHAFT.items() if key != "speed"} | {
    "rotation": "none",
    "notches": [],
    "loads": [
        {"name": "pulley", "position": 100, "force_y": 2000, "force_z": -500, "torque": 50},
        {"name": "brake", "position": 200, "force_z": 800, "torque": "balance"},
    ],
}
SIZED: dict[str, Any] = {
    "sections": [{"length": 60, "diameter": 40}, {"length": 190}],
    "bearing_a": 20,
    "bearing_b": 230,
    "material": "C45E+QT",
    "fatigue_strength": 300,
    "loads": [
        {"name": "pulley", "position": 100, "force_y": 2000, "torque": 50},
        {"name": "brake", "position": 200, "torque": "balance"},
    ],
    "n_points": 72,
}
OWN_STEEL: dict[str, Any] = {
    key: value for key, value in CRANKSHAFT.items() if key not in ("tensile_strength", "yield_strength")
} | {
    "strengths": [
        {"diameter": 40, "tensile_strength": 1100, "yield_strength": 900, "fatigue_strength": 500},
        {"diameter": 100, "tensile_strength": 1000, "yield_strength": 800, "fatigue_strength": 450},
    ]
}


@cache
def crankshaft() -> Calculation:
    """The crankshaft of the worked example, with plain numbers."""
    return shaft(CRANKSHAFT)


def shaft(keys: dict[str, Any], **changes: Any) -> Calculation:
    """A shaft with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, keys | changes))


def row(calculation: Calculation, name: str) -> dict[str, float]:
    """A row by the names of its places."""
    return dict(zip(calculation.part_names["places"], map(float, calculation[name][0]), strict=True))
