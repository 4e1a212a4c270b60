"""Example of a cam-gear stepper: that of source 003, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock

EXAMPLE = ExampleBlock(
    "feeder",
    {
        "dwell_angle": "160 deg",
        "center_distance": "300 mm",
        "arm_length": "90 mm",
        "roller_radius": "20 mm",
        "arm_angle_1": "72 deg",
        "arm_angle_2": "232 deg",
        "roller_width": "25 mm",
        "sprocket_teeth": 30,
        "chain_pitch": "19.05 mm",
        "conveyor_mass": "22.6 kg",
    },
)
