"""Example of an elastic drive: the conveyor behind a cam-gear stepper, or one rise, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "conveyor",
    {
        "inertia": "0.1 kg*m**2",
        "stiffness": "5000 N*m/rad",
        "rise": Wired(None, needs=("cam_gear_transport",), otherwise="1.2 rad"),
        "rise_time": Wired(None, needs=("cam_gear_transport",), otherwise="0.3 s"),
        "motion_curve": Wired("${<cam_gear_transport>.gear_angle}"),
        "cycles_per_hour": Wired("${press.productivity}", needs=("cam_gear_transport",)),
    },
)
