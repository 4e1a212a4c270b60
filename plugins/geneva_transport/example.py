"""Example of a Geneva drive: that of source 000, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "cross",
    {
        "slots": 6,
        "center_distance": "240 mm",
        "roller_radius": "16 mm",
        "roller_width": "25 mm",
        "gear_ratio": "${<geneva_transport>.slots}",  # the sprocket turns once a step
        "sprocket_teeth": Wired("${<cam_gear_transport>.sprocket_teeth}", otherwise=30),
        "chain_pitch": Wired("${<cam_gear_transport>.chain_pitch}", otherwise="19.05 mm"),
        # the conveyor on the sprocket's pitch circle, referred to the wheel
        "driven_inertia": Wired(
            "${<cam_gear_transport>.conveyor_mass} * (${<geneva_transport>.sprocket_teeth} * ${<geneva_transport>.chain_pitch}"
            " / 1 revolution)**2 * ${<geneva_transport>.gear_ratio}**2",
            otherwise="6.7 kg*m**2",
        ),
    },
)
