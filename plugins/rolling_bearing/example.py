"""Example of rolling bearings: those of a shaft, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "bearings",
    {
        "bearings": [
            {
                "name": "main_a",
                "type": "deep_groove",
                "designation": "6209",
                "dynamic_rating": "35.1 kN",
                "static_rating": "21.6 kN",
                "radial_force": Wired("${<shaft>.reaction_a}", otherwise="3 kN"),
                "speed": Wired("${<cylinder_drive>.crank_speed}", otherwise="50 rpm"),
            },
            {
                "name": "main_b",
                "type": "deep_groove",
                "designation": "6212",
                "dynamic_rating": "55.3 kN",
                "static_rating": "36 kN",
                "radial_force": Wired("${<shaft>.reaction_b}", otherwise="9 kN"),
                "speed": Wired("${<cylinder_drive>.crank_speed}", otherwise="50 rpm"),
            },
        ],
    },
)
