"""What a user gives: the keys of ``kind: gripper_chain``."""

from __future__ import annotations

from diecut_report.api import Block, FromPress, Inputs, Quantity, Text, block, parts, samples


class Station(Block):
    """A station below the upper strand, at which a sheet is worked on or braked."""

    name = Text("Name of the station")
    position = Quantity("s_i", "mm", "Distance of the station from the axis of the driving sprocket", ge=0)
    drag = Quantity("D_i", "N", "Drag on a sheet at the station", ge=0, default=0)


class GripperCam(Block):
    """The fixed cam that opens the grippers of each bar that passes the pick-up point."""

    before = Quantity("l_1", "mm", "Length of the cam before the pick-up point", gt=0)
    after = Quantity("l_2", "mm", "Length of the cam behind the pick-up point", gt=0)
    opening = Quantity("h_g", "mm", "Maximum opening of the grippers", gt=0)


class GripperChain(Inputs):
    """Keys of ``gripper_chain``."""

    chain = Text("Chain of ISO 606, series B", ("08B", "10B", "12B", "16B", "20B", "24B"))
    teeth = Quantity("z", "1", "Number of teeth of each of the two sprockets", ge=9, le=150, integer=True)
    links = Quantity("X", "1", "Number of links of each chain", ge=20, le=10_000, integer=True)
    bar_links = Quantity("k", "1", "Number of links from one gripper bar to the next", ge=4, integer=True)
    centre_distance = Quantity("a", "mm", "Centre distance of the sprockets, whose axes are level", gt=0)
    elongation = Quantity("ε", "%", "Elongation of the chain by wear", ge=0, le=3, default=0)
    sheet_rate = Quantity(
        "n", "1/h", "Sheets per hour, one per gripper bar", gt=0, press=FromPress("press.productivity"), optional=True
    )
    bar_mass = Quantity("m_b", "kg", "Mass of a gripper bar with its grippers", ge=0)
    rail_friction = Quantity("μ_r", "1", "Coefficient of friction of the chain in its rails", ge=0, lt=1, default=0.15)
    sheet_length = Quantity(
        "l", "mm", "Length of the sheet", gt=0, press=FromPress("press.sheet.length"), optional=True
    )
    sheet_width = Quantity("b", "mm", "Width of the sheet", gt=0, press=FromPress("press.sheet.width"), optional=True)
    grammage = Quantity("g_s", "g/m**2", "Mass of the board per unit area", gt=0)
    stations = parts(Station, "Stations, in the order in which a sheet passes them")
    grippers = Quantity("j", "1", "Number of grippers on a bar", ge=1, integer=True)
    grip_force = Quantity("F_g", "N", "Clamping force of a gripper", gt=0)
    grip_friction = Quantity(
        "μ_g", "1", "Coefficient of friction of the board on gripper and pad", gt=0, lt=1, default=0.2
    )
    cam = block(GripperCam, "Cam that opens the grippers at the pick-up point", optional=True)
    efficiency = Quantity(
        "η", "%", "Efficiency from motor to sprockets; required to select a motor", gt=0, le=100, optional=True
    )
    required_safety = Quantity("[S]", "1", "Required safety factor against breaking", ge=1, default=7)
    allowable_pressure = Quantity("[p]", "MPa", "Allowable pressure of the joints", gt=0, optional=True)
    allowable_shift = Quantity("[Δ]", "mm", "Allowable shift of the sheet's front edge", gt=0, optional=True)
    sag_least = Quantity(
        "[ζ_1]", "%", "Minimum ratio of the sag of the slack strand to the centre distance", gt=0, default=1
    )
    sag_greatest = Quantity("[ζ_2]", "%", "Maximum value of this ratio", gt=0, le=20, default=4)
    n_points = samples(180)
