"""Example of a clutch on the crank's shaft, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "clutch",
    {
        "torque": Wired("${<cylinder_drive>.crank_torque_peak}", otherwise="500 N*m"),
        "speed": Wired(
            "${<cylinder_drive>.crank_speed}", otherwise=Wired("${<drive_train>.output_speed}", otherwise="50 rpm")
        ),
        "shoe_radius": "180 mm",
        "wedge_angle": "10 deg",
        # what moves is at its fastest, at this shaft
        "driven_inertia": Wired(
            "2 * ${<cylinder_drive>.kinetic_energy_max} / ${<cylinder_drive>.crank_speed}**2", otherwise="20 kg*m**2"
        ),
        "engagements_per_hour": "60 1/h",
        "radial_gap": "0.6 mm",
        "available_travel": "6 mm",
        "available_force": "4 kN",
    },
)
