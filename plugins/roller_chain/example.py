"""Example of a roller chain: those that carry the gripper bars, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired


def _of_sheet(name: str, otherwise: str) -> Wired:
    """A curve of the transport that there is."""
    cam_gear = Wired(f"${{<cam_gear_transport>.{name}}}", otherwise=otherwise)
    return Wired(f"${{<geneva_transport>.{name}}}", otherwise=cam_gear)


EXAMPLE = ExampleBlock(
    "gripper_chain",
    {
        "chain": "12B",
        "use": "conveyor",
        "strands": 2,
        "teeth_1": _of_sheet("sprocket_teeth", otherwise="30"),
        "teeth_2": 30,
        "links": 240,
        "acceleration": _of_sheet("sheet_acceleration", otherwise="80 m/s**2"),
        "velocity": _of_sheet("sheet_velocity", otherwise="5.7 m/s"),
        "moving_mass": "9.6 kg",
        "driven_inertia": "0.02 kg*m**2",
        "pretension": "800 N",
    },
)
