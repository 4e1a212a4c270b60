"""Example of the cylinder's drive: that of source 000, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "drive",
    {
        "cylinder_radius": Wired("${<cylinder_sizing>.radius}", otherwise="105.5 mm"),
        "cylinder_length": Wired("${<cylinder_sizing>.generatrix_length}", otherwise="${press.sheet.length}"),
        # the carriages move with the axis
        "cylinder_mass": Wired(
            "${<cylinder_sizing>.mass} + ${<damper>.carriage_mass}",
            otherwise=Wired("${<cylinder_sizing>.mass}", otherwise="104 kg"),
        ),
        "cylinder_inertia": Wired("${<cylinder_sizing>.inertia}", otherwise="0.74 kg*m**2"),
        "static_unbalance": Wired("${<cylinder_sizing>.static_unbalance}", otherwise="2 kg*m"),
        "cutting_arc_fraction": Wired("${<cylinder_sizing>.cutting_arc_fraction}", otherwise=0.71),
        "segment_height": Wired("${<cylinder_sizing>.segment_height}", otherwise="40 mm"),
        "carriage_clearance": "22 mm",
        "crank_length": "100 mm",
        "pinion_radius": "70 mm",
    },
)
