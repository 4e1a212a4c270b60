"""Inputs of the roller chain."""

from __future__ import annotations

from diecut_report.api import CurveInput, FromTable, Inputs, OneOf, Quantity, Text, samples

# fmt: off

DRIVE, CONVEYOR, CUSTOM = "use=drive", "use=conveyor", "chain=custom"
OVERRIDES = ("pitch", "pin_diameter", "bearing_area", "breaking_load", "mass_per_length")


class RollerChain(Inputs):
    """Keys of ``roller_chain``."""

    one_of = (
        OneOf(OVERRIDES, when=CUSTOM),
        OneOf(("center_distance",), ("links",)),
        OneOf(("speed",), when=DRIVE),
        OneOf(
            ("torque", "application_factor"),
            ("torque_curve",),
            ("power", "application_factor"),
            shared=("application_factor",),
            when=DRIVE,
        ),
        OneOf(("acceleration",), ("acceleration_curve",), when=CONVEYOR),
        OneOf(("velocity",), ("velocity_curve",), when=CONVEYOR),
        OneOf(("moving_mass",), when=CONVEYOR),
    )
    curve_keys = {
        "torque": "torque_curve",
        "acceleration": "acceleration_curve",
        "velocity": "velocity_curve",
    }

    from_tables = (
        FromTable("chain", "chains", {key: key for key in OVERRIDES}, stands_for="custom"),
    )

    chain = Text("Chain of ISO 606, series B; if omitted, the smallest sufficient one is selected; or an entry of chains in a table of your own",
        ("08B", "10B", "12B", "16B", "20B", "24B", "custom"), optional=True)
    pitch = Quantity("p", "mm", "Pitch; default: that of the chain", gt=0, optional=True)
    pin_diameter = Quantity("d_p", "mm", "Diameter of the pins; default: that of the chain", gt=0, optional=True)
    bearing_area = Quantity("A", "mm**2", "Bearing area of a joint; default: pin diameter times length of the bush", gt=0, optional=True)
    breaking_load = Quantity("F_B", "kN", "Breaking load of one strand; default: that of the chain", gt=0, optional=True)
    mass_per_length = Quantity("q", "kg/m", "Mass per unit length of one strand; default: that of the chain", gt=0, optional=True)
    strands = Quantity("s", "1", "Number of parallel chains or strands that share the load", ge=1, le=4, integer=True, default=1)
    teeth_1 = Quantity("z_1", "1", "Number of teeth of the driving sprocket", ge=6, le=150, integer=True)
    teeth_2 = Quantity("z_2", "1", "Number of teeth of the driven sprocket; default: that of the driving one", ge=6, le=150, integer=True,
        optional=True)
    center_distance = Quantity("a", "mm", "Centre distance of the sprockets; or links", gt=0, optional=True)
    links = Quantity("X", "1", "Number of links of the chain; or center_distance", ge=8, le=100_000, integer=True, optional=True)
    speed = Quantity("n_1", "rpm", "Speed of the driving sprocket of a drive", gt=0, optional=True)
    use = Text("Use of the chain: drives a shaft or conveys", ("drive", "conveyor"), default="drive")
    torque = Quantity("T_1", "N*m", "Torque of the driving sprocket; a reference to a curve over a cycle is used as torque_curve", optional=True)
    torque_curve = CurveInput("T_φ", "N*m", "Torque of the driving sprocket over a cycle, in the place of torque", optional=True)
    power = Quantity("P", "kW", "Power of a drive, in the place of torque", gt=0, optional=True)
    acceleration = Quantity("a_c", "m/s**2", "Acceleration of a conveyor chain; a reference to a curve is used as acceleration_curve", optional=True)
    acceleration_curve = CurveInput("a_φ", "m/s**2", "Acceleration of a conveyor chain over a cycle", optional=True)
    velocity = Quantity("v_c", "m/s", "Velocity of a conveyor chain; a reference to a curve is used as velocity_curve", optional=True)
    velocity_curve = CurveInput("v_φ", "m/s", "Velocity of a conveyor chain over the same cycle", optional=True)
    moving_mass = Quantity("m", "kg", "Mass of grippers, bars and load on all strands of a conveyor, without the chains", ge=0, optional=True)
    driven_inertia = Quantity("J", "kg*m**2", "Additional moment of inertia accelerated by a conveyor chain, at the driven sprocket", ge=0, default=0)
    friction_coefficient = Quantity("μ", "1", "Coefficient of friction of everything that a conveyor chain moves, applied to its weight", ge=0,
        default=0.1)
    process_force = Quantity("F_p", "N", "Force along a conveyor chain against its motion, on all strands", ge=0, default=0)
    application_factor = Quantity("K_A", "1", "Application factor; default 1 where a curve includes the dynamics, and for a conveyor", ge=1,
        optional=True)
    sag = Quantity("f_a", "1", "Ratio of the sag of the slack strand to the centre distance", ge=0.005, le=0.05, default=0.02)
    inclination = Quantity("ψ", "deg", "Inclination of the line through the axes", ge=0, le=90, default=0)
    pretension = Quantity("F_v", "N", "Pretension of each strand", ge=0, default=0)
    allowable_bearing_pressure = Quantity("p_zul", "MPa", "Allowable pressure of the joints by the manufacturer; it decreases with velocity", gt=0,
        optional=True)
    required_safety_static = Quantity("S_1", "1", "Required static safety factor against breaking: a manufacturer's rule of thumb (iwis)", ge=1,
        default=7)
    required_safety_dynamic = Quantity("S_2", "1",
        "Required dynamic safety factor against breaking, with press-fit connecting links; 9 with slip-fit or cranked ones (Diamond Chain)", ge=1,
        default=6)
    power_rating = Text("Rating of a drive: that of ANSI chains of the same pitch", ("ansi_b29_1",), optional=True)
    n_points = samples(360)
