"""Example of a folding knife: the three drives of source 004, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock

EXAMPLE = ExampleBlock(
    "knife",
    {
        "cylinder_rate": "${press.productivity} / 2",
        "working_depth": "40 mm",
        "signature_length": "273 mm",
        "planetary": {"carrier_radius": "65.656 mm"},
        "crank_slider": {"crank_radius": "35 mm", "rod_length": "140 mm"},
        "crank_rocker": {
            "crank": "20 mm",
            "coupler": "110 mm",
            "rocker": "80 mm",
            "frame": "120 mm",
            "knife_arm": "107 mm",
            "lowest_dead_center": "inner",
        },
    },
    press={"productivity": "50000 1/h"},
)
