"""Example of a platen press: the ZPPT-30 of source 001, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "platen",
    {
        "cycles_per_hour": "${press.productivity}",
        "material_thickness": "${press.sheet.thickness}",
        "cutting_force_max": "500 kN",
        "platen_mass": "306 kg",
        "drive_deformation": "0.45 mm",
        "crank_radius": "110 mm",
        "rod_length": "635 mm",
        "journal_radius": "50.25 mm",
        "crank_pin_radius": "47.5 mm",
        "platen_pin_radius": "60 mm",
        "journal_length": "120 mm",
        "crank_pin_length": "110 mm",
        "platen_pin_length": "90 mm",
        "allowable_pin_pressure": "30 MPa",
        "carriage_clearance": Wired("40 mm", needs=("cyclogram",)),  # of which the cyclogram takes the window
    },
    press={"productivity": "1200 1/h", "sheet.thickness": "0.5 mm"},
)
