"""Example of a circular knife that cuts blanks, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock

EXAMPLE = ExampleBlock(
    "circular_knife",
    {
        "eccentricity": "20 mm",
        "edge_radius": "100 mm",
        "depth": "112 mm",
        "front_distance": "26 mm",
        "thickness": "${press.sheet.thickness}",
        "cut_length": "15 mm",
        "sharpening_angle": "20 deg",
        "speed": "1 revolution * ${press.productivity}",  # one cut a turn
        "shear_resistance": "42 N/mm**2",
        "rule_force": "21 N/mm",
    },
    press={"productivity": "3600 1/h", "sheet.thickness": "0.5 mm"},
)
