"""The values with which ``diecut-report new gripper_chain`` begins a configuration."""

from __future__ import annotations

from diecut_report.api import ExampleBlock

EXAMPLE = ExampleBlock(
    "transport",
    {
        "chain": "12B",
        "teeth": 20,
        "links": 240,
        "bar_links": 48,
        "centre_distance": "2093 mm",
        "bar_mass": "4.5 kg",
        "grammage": "350 g/m**2",
        "stations": [
            {"name": "cutting", "position": "1750 mm", "drag": "4 N"},
            {"name": "delivery", "position": "400 mm", "drag": "8 N"},
        ],
        "grippers": 9,
        "grip_force": "30 N",
    },
    press={"productivity": "6000 1/h", "sheet.length": "700 mm", "sheet.width": "1000 mm"},
)
