"""Inputs of the Geneva drive."""

from __future__ import annotations

from diecut_report.api import FromPress, Inputs, Quantity, formula, pi, samples

# fmt: off


class GenevaTransport(Inputs):
    """Keys of ``geneva_transport``."""

    slots = Quantity("z", "1", "Number of slots of the wheel", ge=3, le=18, integer=True, default=6)
    center_distance = Quantity("C", "mm", "Centre distance of crank and wheel", gt=0)
    roller_radius = Quantity("ρ", "mm", "Radius of the crank roller", gt=0)
    crank_speed = Quantity("ω_1", "rpm", "Speed of the crank; one sheet per revolution", gt=0,
        press=FromPress("press.productivity", formula(lambda productivity: 2 * pi * productivity)))
    gear_ratio = Quantity("u", "1", "Revolutions of the sprocket per revolution of the wheel", gt=0, default=1)
    sprocket_teeth = Quantity("z_s", "1", "Number of teeth of the conveyor's sprocket; required with chain_pitch for the sheet's motion", gt=0,
        integer=True, optional=True)
    chain_pitch = Quantity("p", "mm", "Pitch of the conveyor's chain", gt=0, optional=True)
    allowable_sheet_acceleration = Quantity("[a]", "m/s**2", "Allowable acceleration of the sheet", gt=0, optional=True)
    grammage = Quantity("m_A", "g/m**2", "Mass of the board per unit area; required with gripper_force for the grip check", gt=0, optional=True)
    sheet_length = Quantity("L_s", "mm", "Length of the sheet", gt=0, press=FromPress("press.sheet.length", optional=True))
    sheet_width = Quantity("B_s", "mm", "Width of the sheet", gt=0, press=FromPress("press.sheet.width", optional=True))
    gripper_force = Quantity("[F_g]", "N", "Total force with which the grippers hold a sheet", gt=0, optional=True)
    rest_tolerance = Quantity("e_r", "mm", "Tolerance on the sheet's position within which it counts as at rest; required for that phase", gt=0,
        optional=True)
    driven_inertia = Quantity("J", "kg*m**2",
        "Moment of inertia of everything that the wheel moves, referred to its shaft (a conveyor of mass m adds m·(z_s·p·u/2π)²); "
        "required for torque and roller force",
        gt=0, optional=True)
    own_inertia = Quantity("J_0", "kg*m**2", "What of it turns with the wheel itself, before the losses of the gear to the conveyor", ge=0, default=0)
    efficiency = Quantity("η", "1", "Efficiency of the gear from the wheel's shaft to the conveyor", gt=0, le=1, default=1)
    roller_width = Quantity("b", "mm", "Contact width of the roller on the slot; required for the contact pressure", gt=0, optional=True)
    elastic_modulus = Quantity("E", "GPa", "Elastic modulus of roller and wheel", gt=0, default=210)
    poisson_ratio = Quantity("ν", "1", "Poisson's ratio of roller and wheel", ge=0, lt=0.5, default=0.3)
    allowable_contact_pressure = Quantity("[p_H]", "MPa", "Allowable contact pressure between roller and slot", gt=0, optional=True)
    allowable_torque = Quantity("[M]", "N*m", "Allowable torque at the crank", gt=0, optional=True)
    locking_radius = Quantity("r_l", "mm", "Radius of the wheel's locking arcs; default: the arm between arc and slot is as thick as the roller",
        gt=0, optional=True)
    locking_clearance = Quantity("j", "mm", "Radial clearance of the locking disc in the wheel's arcs", ge=0, default=0.1)
    cover_angle = Quantity("φ_h", "deg",
        "Minimum crank angle from the wheel's exit, and to its entry, while the sheet must rest; required for the play during the dwell", gt=0,
        lt=180, optional=True)
    allowable_sheet_play = Quantity("[Δx]", "mm", "Allowable play of the sheet while it must rest: the register tolerance", gt=0, optional=True)
    n_points = samples(720)


GRIPPED = ("sprocket_teeth", "chain_pitch", "grammage", "sheet_length", "sheet_width")
"""The keys with which the pull of the sheet at its grippers is known."""
