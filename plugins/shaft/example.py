"""Example of a shaft: the crank's, with a gear between its bearings and the crank's disc at its end, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "crankshaft",
    {
        "sections": [
            {"length": "50 mm", "diameter": "45 mm", "fillet_radius": "1.5 mm"},
            {"length": "170 mm", "diameter": "55 mm", "fillet_radius": "2 mm"},
            {"length": "60 mm", "diameter": "60 mm", "fillet_radius": "2 mm"},
            {"length": "60 mm", "diameter": "50 mm"},
        ],
        "notches": [
            {"position": "130 mm", "type": "keyseat_end_mill"},
            {"position": "310 mm", "type": "keyseat_end_mill"},
        ],
        "bearing_a": "25 mm",
        "bearing_b": "250 mm",
        "tensile_strength": "900 MPa",
        "yield_strength": "650 MPa",
        "speed": Wired("${<cylinder_drive>.crank_speed}", otherwise="50 rpm"),
        "loads": [
            {
                "name": "gear",
                "position": "130 mm",
                "torque": Wired("${<cylinder_drive>.crank_torque}", otherwise="500 N*m"),
                "gear": {"pitch_radius": "120 mm", "mesh_angle": "0 deg"},
                "mass": "12 kg",
            },
            {
                "name": "crank",
                "position": "310 mm",
                "offset": "45 mm",
                "force_y": Wired("${<cylinder_drive>.crank_bearing_force_x}", otherwise="5 kN"),
                "force_z": Wired("${<cylinder_drive>.crank_bearing_force_y}", otherwise="5 kN"),
                "torque": "balance",
                "mass": "8 kg",
            },
        ],
    },
)
