"""Example of dampers at the ends of the travel, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "damper",
    {
        "mass": Wired("${<cylinder_sizing>.mass}", otherwise="104 kg"),
        "inertia": Wired("${<cylinder_sizing>.inertia}", otherwise="0.74 kg*m**2"),
        "rolling_radius": Wired("${<cylinder_sizing>.radius}", otherwise="105.5 mm"),
        "velocity": "0.6 m/s",
        "carriage_mass": "40 kg",
        "static_unbalance": Wired("${<cylinder_sizing>.static_unbalance}", otherwise="2 kg*m"),
        "contact_distance": "10 mm",
        "shore_hardness": 70,
        "dynamic_stiffness_factor": 1.5,
        "ring_width": "60 mm",
        "pad_height": "60 mm",
        "loss_tangent": 0.15,
    },
)
