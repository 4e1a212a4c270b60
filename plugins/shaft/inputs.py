"""Inputs of the stepped shaft."""

from __future__ import annotations

from diecut_report.api import Block, FromTable, Inputs, OneOf, Quantity, Text, Varying, block, parts, samples

# fmt: off

Seat = ("tight", "loose")
HubSeat = ("tight", "loose", "none")
NotchType = ("keyseat_end_mill", "keyseat_pair", "keyseat_sled_runner", "groove_ring", "press_fit", "custom")


class Section(Block):
    """A section of the shaft, from left to right; its fillet is that of the step at its right end."""

    length = Quantity("l", "mm", "Length of the section", gt=0)
    diameter = Quantity("d", "mm", "Diameter of the section; if omitted, the smallest sufficient preferred diameter is selected", gt=0, optional=True)
    bore = Quantity("d_i", "mm", "Diameter of the section's bore", ge=0, default=0)
    fillet_radius = Quantity("r", "mm", "Fillet radius of the step at the right end of the section; if omitted, the step is sharp", gt=0,
        optional=True)


class Notch(Block):
    """A notch beside the shoulders: a keyseat, a groove, a press fit, or one with factors of its own."""

    position = Quantity("x_n", "mm", "Position of the notch, from the shaft's left end", ge=0)
    type = Text("Type of the notch", NotchType)
    radius = Quantity("r_n", "mm", "Radius of the notch root, if different from that of its type", gt=0, optional=True)
    k_t = Quantity("K_t,n", "1", "Stress concentration factor in bending (custom, keyseat_sled_runner)", ge=1, le=20, optional=True)
    k_ts = Quantity("K_ts,n", "1", "Stress concentration factor in torsion (custom, keyseat_sled_runner)", ge=1, le=20, optional=True)
    k_f = Quantity("K_f,n", "1", "Fatigue notch factor in bending (custom)", ge=1, le=20, optional=True)
    k_fs = Quantity("K_fs,n", "1", "Fatigue notch factor in torsion (custom)", ge=1, le=20, optional=True)


class Gear(Block):
    """The toothing of a load: the forces at its pitch circle follow from the load's torque."""

    pitch_radius = Quantity("r_w", "mm", "Pitch radius of the gear", gt=0)
    pressure_angle = Quantity("α_n", "deg", "Pressure angle in the normal section", gt=0, lt=45, default=20)
    helix_angle = Quantity("β", "deg", "Helix angle; its sign is that of the axial force of a positive torque", gt=-60, lt=60, default=0)
    mesh_angle = Quantity("ζ", "deg", "Direction of the mating gear, from y towards z", ge=-360, le=360)


class Load(Block):
    """A load of the shaft at one place; what is left out is zero."""

    name = Text("Name of the load")
    position = Quantity("x_i", "mm", "Position of the load, from the shaft's left end", ge=0)
    force_y = Varying("F_y", "N", "Force in y; a number, or a curve over one cycle", default=0)
    force_z = Varying("F_z", "N", "Force in z; a number, or a curve over one cycle", default=0)
    axial_force = Varying("F_x", "N", "Axial force; a number, a curve over one cycle, or {min, max}", extremes=True, default=0)
    torque = Varying("T", "N*m",
        "Torque about +x, from y to z; a number, a curve over one cycle, {min, max}, or balance: the remainder of the others", extremes=True,
        words=("balance",), default=0)
    couple_xy = Varying("C_xy", "N*m", "Couple from x to y; a number, or a curve over one cycle", default=0)
    couple_xz = Varying("C_xz", "N*m", "Couple from x to z; a number, or a curve over one cycle", default=0)
    offset = Quantity("e", "mm", "Offset of the plane of the forces beyond the position, along +x", default=0)
    gear = block(Gear, "Gear teeth, whose forces follow from the torque", optional=True)
    seat = Text(
        "Seat of the hub or ring that carries the load: tight, with the notch effect of a press fit, loose (g6, h6), or none: cut on "
        "the shaft, or a force alone",
        HubSeat, default="tight")
    mass = Quantity("m_i", "kg", "Mass that turns there, for the critical speed, and for its weight where the direction of gravity is given", ge=0,
        default=0)


class ShaftLoadCase(Block):
    """A load case beside the run: a torque that passes the shaft from one load to another one."""

    name = Text("Engagement of the clutch, numbered where its torque may enter or leave elsewhere, start of the motor, or stop by the brake",
        ("engage", "engage_2", "engage_3", "engage_4", "engage_5", "engage_6", "start", "stop", "stop_2", "stop_3", "stop_4", "stop_5", "stop_6"))
    torque = Quantity("T_j", "N*m", "Torque of the load case, its size", ge=0)
    enters = Text("Name of the load at which the torque enters")
    leaves = Text("Name of the load at which the torque leaves")


class Strength(Block):
    """The strengths of a steel up to a diameter, as a maker or a standard states them."""

    diameter = Quantity("d_R", "mm", "Maximum diameter for which the strengths apply", gt=0)
    tensile_strength = Quantity("R_m", "MPa", "Tensile strength", ge=340, le=1500)
    yield_strength = Quantity("R_e", "MPa", "Yield strength", gt=0)
    fatigue_strength = Quantity("σ_D,k", "MPa", "Fatigue strength of the polished specimen under reversed bending; of all or none", gt=0,
        optional=True)


class Shaft(Inputs):
    """Keys of ``shaft``."""

    one_of = (
        OneOf(("material",), ("tensile_strength", "yield_strength"), ("strengths",)),
    )
    from_tables = (FromTable("material", "steels", {"strengths": "strengths"}),)

    sections = parts(Section, "Sections of the shaft, from left to right")
    total_length = Quantity("L_0", "mm", "Length of the whole shaft, as drawn; the sections must add up to it", gt=0, optional=True)
    notches = parts(Notch, "Notches in addition to the shoulders", optional=True)
    bearing_a = Quantity("x_A", "mm", "Position of bearing A, from the shaft's left end", ge=0)
    bearing_b = Quantity("x_B", "mm", "Position of bearing B, from the shaft's left end", ge=0)
    seat_a = Text("Seat of bearing A: tight, with the notch effect of a press fit, or loose (g6, h6)", Seat, default="tight")
    seat_b = Text("Seat of bearing B: tight, with the notch effect of a press fit, or loose (g6, h6)", Seat, default="tight")
    locating = Text("Bearing that takes the axial force", ("a", "b"), default="a")
    loads = parts(Load, "Loads of the shaft")
    load_cases = parts(ShaftLoadCase, "Load cases beside the run, for which the shaft must not yield", optional=True)
    material = Text("Steel, in place of its strengths (EN 10083, round bars); or an entry of steels in a table of your own",
        ("42CrMo4+QT", "C45E+QT", "C45E+N"), optional=True)
    strengths = parts(Strength, "Strengths of a steel by diameter, in place of its name", optional=True)
    tensile_strength = Quantity("S_ut", "MPa", "Tensile strength at the shaft's size", ge=340, le=1500, optional=True)
    yield_strength = Quantity("S_y", "MPa", "Yield strength at the shaft's size", gt=0, optional=True)
    fatigue_strength = Quantity("σ_D", "MPa", "Fatigue strength of the polished specimen under reversed bending; default: half the tensile strength",
        gt=0, optional=True)
    surface = Text("Surface finish of the shaft", ("ground", "machined", "hot_rolled", "forged"), default="machined")
    reliability = Quantity("R", "%", "Reliability of the endurance limit", listed=(50, 90, 95, 99, 99.9, 99.99), default=99)
    elastic_modulus = Quantity("E", "GPa", "Modulus of elasticity", gt=0, default=206)
    shear_modulus = Quantity("G", "GPa", "Shear modulus", gt=0, default=79.3)
    density = Quantity("ρ", "kg/m**3", "Density", gt=0, default=7850)
    rotation = Varying("θ", "deg", "Motion of the shaft under its loads: turning, none, or by reference a curve of its angle over the cycle",
        words=("turning", "none"), default="turning")
    downwards = Quantity("ζ_g", "deg", "Direction of gravity, from y towards z; without it the weights of the loads are left out", ge=-360, le=360,
        optional=True)
    turns_per_cycle = Quantity("k_T", "1", "Revolutions of the shaft per cycle of its loads", ge=1, le=1000, integer=True, default=1)
    speed = Quantity("n", "rpm", "Speed of the shaft, compared with the critical one", gt=0, optional=True)
    required_fatigue_safety = Quantity("[n_f]", "1", "Required safety factor against fatigue", ge=1, default=1.5)
    required_yield_safety = Quantity("[n_y]", "1", "Required safety factor against yield", ge=1, default=1.5)
    allowable_bearing_slope = Quantity("[v′]", "mrad", "Permissible slope at the bearings", gt=0, plausible=("1e-6 rad", "1 rad"), default=1.0)
    allowable_deflection = Quantity("[v]", "mm", "Allowable deflection anywhere on the shaft", gt=0, optional=True)
    allowable_twist = Quantity("[ϑ′]", "deg/m", "Allowable twist per unit length between the torques", gt=0, optional=True)
    n_points = samples(360)
