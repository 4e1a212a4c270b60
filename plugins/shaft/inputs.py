"""Inputs of the stepped shaft."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

from diecut_report.api import POINTS, Annotated, Block, FromTable, Inputs, OneOf, Quantity, Text, Varying

# fmt: off

Seat = Literal["tight", "loose"]
HubSeat = Literal["tight", "loose", "none"]
NotchType = Literal["keyseat_end_mill", "keyseat_pair", "keyseat_sled_runner", "groove_ring", "press_fit", "custom"]


class Section(Block):
    """A section of the shaft, from left to right; its fillet is that of the step at its right end."""

    length: Annotated[float, Quantity("l", "mm", "Length of the section", gt=0)]
    diameter: Annotated[float | None,
        Quantity("d", "mm", "Diameter of the section; if omitted, the smallest sufficient preferred diameter is selected", gt=0)] = None
    bore: Annotated[float, Quantity("d_i", "mm", "Diameter of the section's bore", ge=0)] = 0
    fillet_radius: Annotated[float | None,
        Quantity("r", "mm", "Fillet radius of the step at the right end of the section; if omitted, the step is sharp", gt=0)] = None


class Notch(Block):
    """A notch beside the shoulders: a keyseat, a groove, a press fit, or one with factors of its own."""

    position: Annotated[float, Quantity("x_n", "mm", "Position of the notch, from the shaft's left end", ge=0)]
    type: Annotated[NotchType, Text("Type of the notch")]
    radius: Annotated[float | None, Quantity("r_n", "mm", "Radius of the notch root, if different from that of its type", gt=0)] = None
    k_t: Annotated[float | None, Quantity("K_t,n", "1", "Stress concentration factor in bending (custom, keyseat_sled_runner)", ge=1, le=20)] = None
    k_ts: Annotated[float | None, Quantity("K_ts,n", "1", "Stress concentration factor in torsion (custom, keyseat_sled_runner)", ge=1, le=20)] = None
    k_f: Annotated[float | None, Quantity("K_f,n", "1", "Fatigue notch factor in bending (custom)", ge=1, le=20)] = None
    k_fs: Annotated[float | None, Quantity("K_fs,n", "1", "Fatigue notch factor in torsion (custom)", ge=1, le=20)] = None


class Gear(Block):
    """The toothing of a load: the forces at its pitch circle follow from the load's torque."""

    pitch_radius: Annotated[float, Quantity("r_w", "mm", "Pitch radius of the gear", gt=0)]
    pressure_angle: Annotated[float, Quantity("α_n", "deg", "Pressure angle in the normal section", gt=0, lt=45)] = 20
    helix_angle: Annotated[float, Quantity("β", "deg", "Helix angle; its sign is that of the axial force of a positive torque", gt=-60, lt=60)] = 0
    mesh_angle: Annotated[float, Quantity("ζ", "deg", "Direction of the mating gear, from y towards z", ge=-360, le=360)]


class Load(Block):
    """A load of the shaft at one place; what is left out is zero."""

    name: Annotated[str, Text("Name of the load")]
    position: Annotated[float, Quantity("x_i", "mm", "Position of the load, from the shaft's left end", ge=0)]
    force_y: Annotated[Any, Varying("F_y", "N", "Force in y; a number, or a curve over one cycle")] = 0
    force_z: Annotated[Any, Varying("F_z", "N", "Force in z; a number, or a curve over one cycle")] = 0
    axial_force: Annotated[Any, Varying("F_x", "N", "Axial force; a number, a curve over one cycle, or {min, max}", extremes=True)] = 0
    torque: Annotated[Any,
        Varying("T", "N*m",
            "Torque about +x, from y to z; a number, a curve over one cycle, {min, max}, or balance: the remainder of the others", extremes=True,
            words=("balance",))] = 0
    couple_xy: Annotated[Any, Varying("C_xy", "N*m", "Couple from x to y; a number, or a curve over one cycle")] = 0
    couple_xz: Annotated[Any, Varying("C_xz", "N*m", "Couple from x to z; a number, or a curve over one cycle")] = 0
    offset: Annotated[float, Quantity("e", "mm", "Offset of the plane of the forces beyond the position, along +x")] = 0
    gear: Annotated[Gear | None, Text("Gear teeth, whose forces follow from the torque")] = None
    seat: Annotated[HubSeat,
        Text(
            "Seat of the hub or ring that carries the load: tight, with the notch effect of a press fit, loose (g6, h6), or none: cut on "
                "the shaft, or a force alone")] = "tight"
    mass: Annotated[float,
        Quantity("m_i", "kg", "Mass that turns there, for the critical speed, and for its weight where the direction of gravity is given", ge=0)] = 0


class ShaftLoadCase(Block):
    """A load case beside the run: a torque that passes the shaft from one load to another one."""

    name: Annotated[Literal["engage", "engage_2", "engage_3", "engage_4", "engage_5", "engage_6", "start",
            "stop", "stop_2", "stop_3", "stop_4", "stop_5", "stop_6"],
        Text("Engagement of the clutch, numbered where its torque may enter or leave elsewhere, start of the motor, or stop by the brake")]
    torque: Annotated[float, Quantity("T_j", "N*m", "Torque of the load case, its size", ge=0)]
    enters: Annotated[str, Text("Name of the load at which the torque enters")]
    leaves: Annotated[str, Text("Name of the load at which the torque leaves")]


class Strength(Block):
    """The strengths of a steel up to a diameter, as a maker or a standard states them."""

    diameter: Annotated[float, Quantity("d_R", "mm", "Maximum diameter for which the strengths apply", gt=0)]
    tensile_strength: Annotated[float, Quantity("R_m", "MPa", "Tensile strength", ge=340, le=1500)]
    yield_strength: Annotated[float, Quantity("R_e", "MPa", "Yield strength", gt=0)]
    fatigue_strength: Annotated[float | None,
        Quantity("σ_D,k", "MPa", "Fatigue strength of the polished specimen under reversed bending; of all or none", gt=0)] = None


class Shaft(Inputs):
    """Keys of ``shaft``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("material",), ("tensile_strength", "yield_strength"), ("strengths",)),
    )
    from_tables: ClassVar[tuple[FromTable, ...]] = (FromTable("material", "steels", {"strengths": "strengths"}),)

    sections: Annotated[list[Section], Text("Sections of the shaft, from left to right")]
    total_length: Annotated[float | None, Quantity("L_0", "mm", "Length of the whole shaft, as drawn; the sections must add up to it", gt=0)] = None
    notches: Annotated[list[Notch], Text("Notches in addition to the shoulders")] = []  # noqa: RUF012
    bearing_a: Annotated[float, Quantity("x_A", "mm", "Position of bearing A, from the shaft's left end", ge=0)]
    bearing_b: Annotated[float, Quantity("x_B", "mm", "Position of bearing B, from the shaft's left end", ge=0)]
    seat_a: Annotated[Seat, Text("Seat of bearing A: tight, with the notch effect of a press fit, or loose (g6, h6)")] = "tight"
    seat_b: Annotated[Seat, Text("Seat of bearing B: tight, with the notch effect of a press fit, or loose (g6, h6)")] = "tight"
    locating: Annotated[Literal["a", "b"], Text("Bearing that takes the axial force")] = "a"
    loads: Annotated[list[Load], Text("Loads of the shaft")]
    load_cases: Annotated[list[ShaftLoadCase], Text("Load cases beside the run, for which the shaft must not yield")] = []  # noqa: RUF012
    material: Annotated[Literal["42CrMo4+QT", "C45E+QT", "C45E+N"] | None,
        Text("Steel, in place of its strengths (EN 10083, round bars); or an entry of steels in a table of your own")] = None
    strengths: Annotated[list[Strength], Text("Strengths of a steel by diameter, in place of its name")] = []  # noqa: RUF012
    tensile_strength: Annotated[float | None, Quantity("S_ut", "MPa", "Tensile strength at the shaft's size", ge=340, le=1500)] = None
    yield_strength: Annotated[float | None, Quantity("S_y", "MPa", "Yield strength at the shaft's size", gt=0)] = None
    fatigue_strength: Annotated[float | None,
        Quantity("σ_D", "MPa", "Fatigue strength of the polished specimen under reversed bending; default: half the tensile strength", gt=0)] = None
    surface: Annotated[Literal["ground", "machined", "hot_rolled", "forged"], Text("Surface finish of the shaft")] = "machined"
    reliability: Annotated[float, Quantity("R", "%", "Reliability of the endurance limit", listed=(50, 90, 95, 99, 99.9, 99.99))] = 99
    elastic_modulus: Annotated[float, Quantity("E", "GPa", "Modulus of elasticity", gt=0)] = 206
    shear_modulus: Annotated[float, Quantity("G", "GPa", "Shear modulus", gt=0)] = 79.3
    density: Annotated[float, Quantity("ρ", "kg/m**3", "Density", gt=0)] = 7850
    rotation: Annotated[Any,
        Varying("θ", "deg", "Motion of the shaft under its loads: turning, none, or by reference a curve of its angle over the cycle",
            words=("turning", "none"))] = "turning"
    downwards: Annotated[float | None,
        Quantity("ζ_g", "deg", "Direction of gravity, from y towards z; without it the weights of the loads are left out", ge=-360, le=360)] = None
    turns_per_cycle: Annotated[int, Quantity("k_T", "1", "Revolutions of the shaft per cycle of its loads", ge=1, le=1000, integer=True)] = 1
    speed: Annotated[float | None, Quantity("n", "rpm", "Speed of the shaft, compared with the critical one", gt=0)] = None
    required_fatigue_safety: Annotated[float, Quantity("[n_f]", "1", "Required safety factor against fatigue", ge=1)] = 1.5
    required_yield_safety: Annotated[float, Quantity("[n_y]", "1", "Required safety factor against yield", ge=1)] = 1.5
    allowable_bearing_slope: Annotated[float,
        Quantity("[v′]", "mrad", "Permissible slope at the bearings", gt=0, plausible=("1e-6 rad", "1 rad"))] = 1.0
    allowable_deflection: Annotated[float | None, Quantity("[v]", "mm", "Allowable deflection anywhere on the shaft", gt=0)] = None
    allowable_twist: Annotated[float | None, Quantity("[ϑ′]", "deg/m", "Allowable twist per unit length between the torques", gt=0)] = None
    n_points: Annotated[int, POINTS] = 360
