"""What a user gives: the keys of ``kind: gripper_chain``."""

from __future__ import annotations

from typing import Literal

from diecut_report.api import POINTS, Annotated, Block, FromPress, Inputs, Quantity, Text


class Station(Block):
    """A station below the upper strand, at which a sheet is worked on or braked."""

    name: Annotated[str, Text("Name of the station")]
    position: Annotated[
        float, Quantity("s_i", "mm", "Distance of the station from the axis of the driving sprocket", ge=0)
    ]
    drag: Annotated[float, Quantity("D_i", "N", "Force that holds a sheet back there", ge=0)] = 0


class GripperCam(Block):
    """The fixed cam that opens the grippers of each bar that passes the pick-up point."""

    before: Annotated[float, Quantity("l_1", "mm", "Length of the cam before the pick-up point", gt=0)]
    after: Annotated[float, Quantity("l_2", "mm", "Length of the cam behind the pick-up point", gt=0)]
    opening: Annotated[float, Quantity("h_g", "mm", "Greatest opening of the grippers", gt=0)]


class GripperChain(Inputs):
    """Keys of ``gripper_chain``."""

    chain: Annotated[Literal["08B", "10B", "12B", "16B", "20B", "24B"], Text("Chain of ISO 606, series B")]
    teeth: Annotated[int, Quantity("z", "1", "Teeth of each of the two sprockets", ge=9, le=150, integer=True)]
    links: Annotated[int, Quantity("X", "1", "Links of each chain", ge=20, le=10_000, integer=True)]
    bar_links: Annotated[int, Quantity("k", "1", "Links from one gripper bar to the next", ge=4, integer=True)]
    centre_distance: Annotated[float, Quantity("a", "mm", "Distance of the sprockets' axes, which lie level", gt=0)]
    elongation: Annotated[float, Quantity("ε", "%", "Elongation of the chain by wear", ge=0, le=3)] = 0
    sheet_rate: Annotated[
        float | None,
        Quantity("n", "1/h", "Sheets an hour, one for each bar", gt=0, press=FromPress("press.productivity")),
    ] = None
    bar_mass: Annotated[float, Quantity("m_b", "kg", "Mass of a gripper bar with its grippers", ge=0)]
    rail_friction: Annotated[float, Quantity("μ_r", "1", "Friction of the chain in its rails", ge=0, lt=1)] = 0.15
    sheet_length: Annotated[
        float | None, Quantity("l", "mm", "Length of the sheet", gt=0, press=FromPress("press.sheet.length"))
    ] = None
    sheet_width: Annotated[
        float | None, Quantity("b", "mm", "Width of the sheet", gt=0, press=FromPress("press.sheet.width"))
    ] = None
    grammage: Annotated[float, Quantity("g_s", "g/m**2", "Mass of the board for each area", gt=0)]
    stations: Annotated[list[Station], Text("Stations, in the order in which a sheet passes them")]
    grippers: Annotated[int, Quantity("j", "1", "Grippers on a bar", ge=1, integer=True)]
    grip_force: Annotated[float, Quantity("F_g", "N", "Force with which a gripper presses", gt=0)]
    grip_friction: Annotated[float, Quantity("μ_g", "1", "Friction of the board on gripper and pad", gt=0, lt=1)] = 0.2
    cam: Annotated[GripperCam | None, Text("Cam that opens the grippers at the pick-up point")] = None
    efficiency: Annotated[
        float | None, Quantity("η", "%", "Efficiency from motor to sprockets; with it a motor is chosen", gt=0, le=100)
    ] = None
    required_safety: Annotated[float, Quantity("[S]", "1", "Required safety against breaking", ge=1)] = 7
    allowable_pressure: Annotated[float | None, Quantity("[p]", "MPa", "Allowed pressure of the joints", gt=0)] = None
    allowable_shift: Annotated[float | None, Quantity("[Δ]", "mm", "Allowed shift of the sheet's front edge", gt=0)] = (
        None
    )
    sag_least: Annotated[
        float, Quantity("[ζ_1]", "%", "Least sag of the slack strand to the distance of the axes", gt=0)
    ] = 1
    sag_greatest: Annotated[float, Quantity("[ζ_2]", "%", "Greatest such sag", gt=0, le=20)] = 4
    n_points: Annotated[int, POINTS] = 180
