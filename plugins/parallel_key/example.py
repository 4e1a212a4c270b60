"""Example of a parallel key: that of the gear on the crank's shaft, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "gear_key",
    {
        "shaft_diameter": Wired("${<shaft>.sections.1.diameter}", otherwise="55 mm"),
        "key_length": "70 mm",
        "torque": Wired("${<cylinder_drive>.crank_torque}", otherwise="500 N*m"),
        "application_factor": Wired(None, needs=("cylinder_drive",), otherwise=1.25),  # a curve holds the dynamics
        "yield_shaft": "650 MPa",
        "yield_hub": "370 MPa",
        "required_life": Wired("20000 h", needs=("cylinder_drive",)),  # the torque reverses in every turn
        "cycle_speed": Wired("${<cylinder_drive>.crank_speed}"),
        "hub_length": "80 mm",
    },
)
