"""Inputs of rolling bearings."""

from __future__ import annotations

from diecut_report.api import Block, Inputs, OneOf, Quantity, Text, Varying, parts, samples

# fmt: off

RELIABILITIES = (90, 95, 96, 97, 98, 99)


class Bearing(Block):
    """A bearing with its load over one cycle."""

    one_of = (
        OneOf(("speed",), ("relative_angle", "cycle_speed")),
        OneOf(("dynamic_rating", "static_rating"), optional=True),
        OneOf(("x", "y", "e"), optional=True),
        OneOf(("x0", "y0"), optional=True),
    )

    name = Text("Name, used as the prefix of its results")
    type = Text("Type: deep groove, other ball or roller bearing", ("deep_groove", "ball", "roller"))
    designation = Text("Designation, such as 6209 or NU2208E; looked up in the tables if no ratings are given, otherwise for information only",
        optional=True)
    series = Text(
        "Series in which the smallest sufficient bearing is selected, without ratings and designation; default: 62 for deep groove ball "
        "bearings, NU2 for roller bearings",
        ("60", "62", "63", "NU2", "NU22", "NU3", "NU23"), optional=True)
    bore_min = Quantity("d_min", "mm", "Minimum bore of the bearing to be selected", ge=0, le=100, default=0)
    on = Text(
        "Shaft (its mechanism) on which it sits: its bore is compared with the seat; default: the shaft whose reaction it bears, or that "
        "has its name",
        optional=True)
    dynamic_rating = Quantity("C_g", "kN", "Basic dynamic load rating, from the manufacturer's catalogue", gt=0, optional=True)
    static_rating = Quantity("C_0g", "kN", "Basic static load rating, from the manufacturer's catalogue", gt=0, optional=True)
    f0 = Quantity("f_0g", "1", "Factor f0 from the manufacturer's catalogue (deep_groove with axial force)", ge=10, le=17, optional=True)
    x = Quantity("X_g", "1", "Radial factor (ball, roller, with axial force)", gt=0, optional=True)
    y = Quantity("Y_g", "1", "Axial factor (ball, roller, with axial force)", gt=0, optional=True)
    e = Quantity("e_g", "1", "Limit of F_a/F_r (ball, roller, with axial force)", gt=0, optional=True)
    x0 = Quantity("X_0g", "1", "Static radial factor; 0.6 of a deep groove ball bearing", ge=0, optional=True)
    y0 = Quantity("Y_0g", "1", "Static axial factor; 0.5 of a deep groove ball bearing", ge=0, optional=True)
    radial_force = Varying("F_rg", "N", "Radial force, a number or a curve over one cycle")
    axial_force = Varying("F_ag", "N", "Axial force, a number or a curve over one cycle", default=0)
    speed = Varying("n_g", "rpm", "Relative speed of the rings, a number or a curve over one cycle", optional=True)
    relative_angle = Varying("θ_g", "deg", "Relative angle of the rings: a curve over one cycle, instead of speed", optional=True)
    cycle_speed = Quantity("n_c", "rpm", "Cycle rate of the relative angle, as a speed: 1 r/min is one cycle per minute", gt=0, optional=True)
    rolling_elements = Quantity("Z_g", "1", "Number of rolling elements per row, for the minimum swing", ge=5, integer=True, optional=True)
    a_iso = Quantity("a_ISO", "1", "Life modification factor for lubrication and contamination (ISO 281, clause 9)", ge=0.1, le=50, default=1)
    tilt = Quantity("ψ_g", "mrad", "Misalignment of the rings: slope of the shaft; for a pin its own and that of its support", ge=0, optional=True)
    permitted_tilt = Quantity("ψ_zul,g", "mrad",
        "Misalignment permitted by the manufacturer; default: 0.58 for ball bearings (2′), 0.87 for roller bearings N, NJ and NU (3′), "
        "0.29 for others (1′)",
        gt=0, optional=True)
    limiting_speed = Quantity("n_lim", "rpm", "Limiting speed, from the manufacturer's catalogue", gt=0, optional=True)


class RollingBearing(Inputs):
    """Keys of ``rolling_bearing``."""

    bearings = parts(Bearing, "Bearings")
    reliability = Quantity("R", "%", "Reliability of the life", listed=RELIABILITIES, default=90)
    required_life = Quantity("[L]", "h", "Required life", gt=0, default=20000)
    required_static_safety = Quantity("[s_0]", "1", "Required static safety factor; default: 1 for ball, 1.5 for roller bearings", gt=0,
        optional=True)
    service_factor = Quantity("f_s", "1", "Factor on all forces, for shocks not included in the curves", ge=1, default=1)
    n_points = samples(360)
