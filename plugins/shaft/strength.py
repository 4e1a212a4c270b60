"""The chapters on steel, loads, deflection, fatigue, yield and critical speed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    ROUNDING,
    Case,
    Chapter,
    Refusal,
    StandardTable,
    abscissa,
    case,
    choice,
    computed,
    computed_curve,
    inner,
    m,
    number,
    standard_table,
    total,
    value,
)
from diecut_report.mechanics.load_cases import called
from diecut_report.mechanics.sections import tube
from diecut_report.plugins.shaft import curves, formulas
from diecut_report.plugins.shaft.body import Body
from diecut_report.plugins.shaft.curves import UnderLoad
from diecut_report.plugins.shaft.cycle import Cycle, cycle
from diecut_report.plugins.shaft.formulas import MEGAPASCAL, MILLIMETRE

# fmt: off

Array = NDArray[Any]


def by_size(sizes: Array, values: Any, diameter: Array) -> Array:
    """Return the value of the least size (variants, sizes) that holds the diameter (variants, 1); of a thicker shaft the last."""
    if isinstance(values, tuple):
        raise Refusal(
            "strengths", "gives the fatigue strength of some diameters and not of others; give it for all, or for none"
        )
    index = np.minimum(np.sum(diameter > sizes * (1 + ROUNDING), axis=1, keepdims=True), sizes.shape[1] - 1)
    return np.asarray(np.take_along_axis(values, index, axis=1))


def ascends(sizes: Array) -> Array:
    """Return whether sizes (variants, sizes) ascend, (variants, 1)."""
    return np.asarray(np.all(np.diff(sizes, axis=1) > 0, axis=1, keepdims=True).astype(float))


# fmt: off

SIZES = {"42CrMo4+QT": (16, 40, 100, 160, 250), "C45E+QT": (16, 40, 100), "C45E+N": (16, 100, 250)}  # mm, each up to and with it


def _cases(table: StandardTable, grade: str) -> Iterator[Case]:
    """The strengths of a grade by its sizes; the last one for what is greater than the others."""
    *others, last = SIZES[grade]
    for size in others:
        yield case(_strength(table, grade, size) * MEGAPASCAL, f"{grade} up to {size} mm", m.greatest_diameter <= float(size) * MILLIMETRE)
    yield case(_strength(table, grade, last) * MEGAPASCAL, f"{grade} up to {last} mm")


def _strength(table: StandardTable, grade: str, size: float) -> float:
    return table.values[f"{grade} ≤ {size} mm"]  # MPa


steel = Chapter("Steel", needs=("material",), text="The minimum strengths of the grade at the maximum diameter of the shaft, from which it is made.")
steel.greatest_diameter = total("max", of="section_diameter"), "d_max", "mm", "Maximum diameter of the shaft", "geometry"
for grade, sizes in SIZES.items():
    token = (f"material={grade}",)
    steel.require("size_known", m.greatest_diameter <= float(sizes[-1]) * MILLIMETRE, key="material", needs=token,
        message=f"is {grade}, whose strengths are known up to {sizes[-1]} mm, but the shaft has {{greatest_diameter}}; give tensile_strength and "
        "yield_strength in its place, or take another grade")
    for name, symbol, what in (("tensile", "S_ut", "Tensile strength"), ("yield", "S_y", "Yield strength")):
        steel[f"{name}_strength"] = (choice(*_cases(standard_table(f"steel_{name}_strengths"), grade), needs=token), symbol, "MPa",
            f"{what} at the shaft's size", "EN 10083")

own_steel = Chapter("Steel", needs=("strengths",), text="The given strengths, at the maximum diameter of the shaft, from which it is made.")
own_steel.greatest_diameter = total("max", of="section_diameter"), "d_max", "mm", "Maximum diameter of the shaft", "geometry"
own_steel.greatest_size = total("max", of="strengths.diameter", output=False), "d_R,max", "mm", "Maximum diameter with known strengths", "input"
own_steel.sizes_ascend = (computed(ascends, ("strengths.diameter",), "each is compared with the one before it", output=False), "k_R", "1",
    "Diameters of the strengths ascend (1) or not (0)")
own_steel.require("sizes_in_order", m.sizes_ascend > 0, key="strengths",
    message="are not in the order of their diameters; begin with the minimum one, each diameter once")
own_steel.require("own_size_known", m.greatest_diameter <= m.greatest_size * (number(1) + 1e-9), key="strengths",
    message="are known up to {greatest_size}, but the shaft has {greatest_diameter}; give the strengths of that size too, or take another steel")
BY_SIZE = "for the smallest diameter of the list that covers the shaft's maximum one"
for name, symbol, what in (("tensile", "S_ut", "Tensile strength"), ("yield", "S_y", "Yield strength")):
    own_steel[f"{name}_strength"] = (computed(by_size, ("strengths.diameter", f"strengths.{name}_strength", "greatest_diameter"), BY_SIZE), symbol,
        "MPa", f"{what} at the shaft's size", "input")
own_steel.own_fatigue_strength = (computed(by_size, ("strengths.diameter", "strengths.fatigue_strength", "greatest_diameter"), BY_SIZE,
    needs=("strengths.fatigue_strength",), output=False), "σ_D,d", "MPa", "Fatigue strength at the shaft's size", "input")


CYCLE = ("loads.name", "loads.position", "loads.force_y", "loads.force_z", "loads.axial_force", "loads.torque", "loads.couple_xy",
         "loads.couple_xz", "loads.offset", "loads.mass", "loads.gear.pitch_radius", "loads.gear.pressure_angle", "loads.gear.helix_angle",
         "loads.gear.mesh_angle", "rotation", "turns_per_cycle", "load_cases.torque", "load_cases.enters", "load_cases.leaves",
         "downwards")
LOADED = ("body", "cycle", "bearing_a", "bearing_b", "locating", "elastic_modulus", "shear_modulus", "density")
CASES = ("load_cases",)
TOOTHED = ("loads.gear.pitch_radius",)
OVER_CYCLE = "over at least 720 instants of the cycle and both limits at each breakpoint of the loads"
INTEGRATED = "E I v″ = M exactly, piece by piece, " + OVER_CYCLE
FACTORS = {"k_f": "k_f", "k_fs": "k_fs", "endurance": "place_endurance", "area": "place_area", "modulus": "place_modulus",
           "tensile_strength": "tensile_strength"}


def _under_load(body: Body, cycle: Cycle, bearing_a: Array, bearing_b: Array, locating: str, *elastic: Array) -> UnderLoad:
    return UnderLoad(body, cycle, bearing_a[:, 0], bearing_b[:, 0], locating == "a", *(each[:, 0] for each in elastic))


def _states(under_load: UnderLoad, *factors: Array) -> dict[str, Array]:
    wide = np.broadcast_shapes(*(each.shape for each in factors))
    return under_load.states({name: np.broadcast_to(each, wide) for name, each in zip(FACTORS, factors, strict=True)})


def _number(chapter: Chapter, id: str, symbol: str, unit: str, description: str, name: str, method: str, **options: Any) -> None:
    """A number of the shaft under its loads."""
    of = "critical" if chapter is critical else "numbers"
    chapter[id] = computed(lambda under_load: getattr(under_load, of)[name], ("under_load",), method, **options), symbol, unit, description


critical = Chapter("Critical speed",
    text="The shaft bends without mass; the masses of the loads, and its own in eight lumped masses per piece, move transversely. For a shaft that "
        "is hardly longer than thick the value only means that the critical speed is far above any running speed: shear, which is neglected, lowers "
        "it.")
loads = Chapter("Loads and reactions",
    text="Reactions are forces on the shaft. The weights of the loads' masses act where the direction of gravity is given; "
        "that of the shaft itself is left out. In each plane R_B = −(Σ F_i (x_i − x_A) + Σ C_j)/(x_B − x_A), R_A = −Σ F_i − R_B; behind x M = "
        "Σ F_i (x − x_i) − Σ C_j, T = Σ T_i and N = −Σ F_x,i of what acts before x. A torque known by its extremes adds as an interval.")
loads.prepared("cycle", lambda given: cycle(*map(given.get, CYCLE)), CYCLE, for_many=True)
loads.prepared("under_load", lambda given: _under_load(*map(given.get, LOADED)), LOADED, for_many=True)
_number(loads, "torque_left", "ΣT", "N*m", "Torque balance", "torque_left", OVER_CYCLE, output=False)
_number(loads, "torque_scale", "T_i,max", "N*m", "Maximum torque of a load", "torque_scale", OVER_CYCLE, output=False)
loads.require("torques_balance", m.torque_left <= 1e-6 * m.torque_scale, key="loads",
    message="have torques that add up to {torque_left}, so that the shaft would not turn evenly; correct them, or give one load torque: balance")
_number(loads, "load_scale", "F_i,max", "N", "Maximum force on the shaft; a couple is divided by the bearing span", "load_scale", OVER_CYCLE,
    output=False)
loads.require("is_loaded", (m.load_scale > 0) | (m.torque_scale > 0), key="loads",
    message="have neither force, couple nor torque, so that nothing is to be calculated; give one of them")
_number(loads, "reaction_a_max", "R_A", "N", "Maximum reaction of bearing A", "reaction_a", OVER_CYCLE, source="statics")
_number(loads, "reaction_b_max", "R_B", "N", "Maximum reaction of bearing B", "reaction_b", OVER_CYCLE, source="statics")
_number(loads, "axial_reaction_max", "R_x", "N", "Maximum axial force on the locating bearing", "axial_reaction", OVER_CYCLE, source="statics")
_number(loads, "bending_moment_max", "M_b,max", "N*m", "Maximum bending moment", "bending_moment", OVER_CYCLE, source="statics")
_number(loads, "torque_max", "T_max", "N*m", "Maximum torque in the shaft", "torque_max", OVER_CYCLE, source="statics")
_number(loads, "torque_min", "T_min", "N*m", "Minimum torque in the shaft", "torque_min", OVER_CYCLE, source="statics")
loads.cycle_angle = abscissa(2 * np.pi), "φ", "deg", "Cycle angle: one revolution is one cycle"
for bearing, sign in (("a", "A"), ("b", "B")):
    loads[f"reaction_{bearing}"] = (computed_curve(curves.reaction(bearing), "under_load", "cycle_angle", "by statics",
        joints=lambda under_load: under_load.cycle_joints), f"R_{sign}(φ)", "N", f"Reaction of bearing {sign} over the cycle", "statics")
    for plane, axis in enumerate("yz"):
        loads[f"reaction_{bearing}_{axis}"] = (computed_curve(curves.reaction(bearing, plane), "under_load", "cycle_angle", "by statics"),
            f"R_{sign}{axis}", "N", f"Reaction of bearing {sign} in {axis} over the cycle", "statics")
loads.axial_reaction = (computed_curve(UnderLoad.axial_reaction, "under_load", "cycle_angle", "by statics",
    joints=lambda under_load: under_load.cycle_joints, output=False), "R_x(φ)", "N", "Axial force on the locating bearing over the cycle", "statics")
loads.shaft_angle = (computed_curve(curves.shaft_angle, "under_load", "cycle_angle", "as given", joints=lambda under_load: under_load.cycle_joints,
    output=False), "θ(φ)", "deg", "Angle of the shaft over the cycle", "kinematics")
loads.position = abscissa("length"), "x_s", "mm", "Position along the shaft"
loads.bending_moment = (computed_curve(curves.bending_moment, "under_load", "position", OVER_CYCLE, joints=lambda under_load: under_load.joints),
    "M_b(x)", "N*m", "Maximum bending moment over the cycle, along the shaft", "statics")
for plane, axis in enumerate("yz"):
    loads[f"moment_x{axis}"] = (computed_curve(curves.moment_in(plane), "under_load", "position", OVER_CYCLE), f"M_x{axis}", "N*m",
        f"Moment in the plane x–{axis} at the instant of the maximum moment", "statics")
loads.torque = (computed_curve(curves.torque, "under_load", "position", OVER_CYCLE), "T(x)", "N*m",
    "Maximum absolute torque over the cycle, along the shaft", "statics")
loads.diameter = computed_curve(curves.diameter, "under_load", "position", "as it is given"), "d(x)", "mm", "Diameter along the shaft"

bending = Chapter("Deflection and twist")
_number(bending, "deflection_max", "v_max", "um", "Maximum deflection", "deflection", INTEGRATED, source="Euler–Bernoulli")
_number(bending, "deflection_end", "v_e", "um", "Maximum deflection at the shaft's ends", "deflection_end", INTEGRATED, source="Euler–Bernoulli")
_number(bending, "slope_a", "v′_A", "mrad", "Maximum slope at bearing A", "slope_a", INTEGRATED, source="Euler–Bernoulli")
_number(bending, "slope_b", "v′_B", "mrad", "Maximum slope at bearing B", "slope_b", INTEGRATED, source="Euler–Bernoulli")
bending.bearing_slope_max = np.maximum(m.slope_a, m.slope_b), "v′_max", "mrad", "Maximum slope at a bearing", "Euler–Bernoulli"
bending.slope = (computed(lambda under_load: under_load.load_slopes, ("under_load",), INTEGRATED, over="loads", named_by="loads.name"), "v′_i",
    "mrad", "Maximum slope at the load", "Euler–Bernoulli")
bending.is_toothed = (computed(lambda under_load: under_load.is_toothed, ("under_load",), "as given", over="loads", needs=TOOTHED, output=False),
    "s_z", "1", "Load with teeth (1) or without (0)")
bending.mesh_slope = (computed(lambda under_load: under_load.mesh_slopes, ("under_load",), INTEGRATED, over="loads", named_by="loads.name",
    exists=m.is_toothed > 0, needs=TOOTHED), "v′_t", "mrad", "Slope at the gear in the direction of the force on its teeth, at its maximum torque",
    "Euler–Bernoulli")
_number(bending, "twist", "ϑ", "deg", "Maximum twist between the outermost torques", "twist", "Σ T h/(2 G I), " + OVER_CYCLE, source="Saint-Venant")
_number(bending, "torque_span", "l_T", "mm", "Distance between the outermost torques", "torque_span", "from the loads that have one", output=False)
bending.twist_by_length = (inner(m.twist / m.torque_span, exists=m.torque_span > 0), "ϑ′", "deg/m",
    "Twist per unit length between the outermost torques", "Saint-Venant")
bending.stress_along = (computed_curve(curves.nominal_stress, "under_load", "position",
    "from bending moment, torque and axial force at each instant, without notches"), "σ_vM(x)", "MPa",
    "Maximum nominal stress over the cycle, along the shaft", "Shigley 7-15")
bending.deflection = (computed_curve(curves.deflection, "under_load", "position", INTEGRATED), "v(x)", "um",
    "Deflection at the instant of its maximum value", "Euler–Bernoulli")
_number(bending, "energy_difference", "ΔU/U", "1",
    "Strain energy of the bent shaft less the work of its loads, beyond rounding, relative to the maximum energy", "energy_difference",
    "∫ M²/(2 E I) dx compared with half the loads times their displacements (Castigliano)", output=False)

fatigue = Chapter("Fatigue",
    text="Stress of a material point that turns with the shaft by θ, at ψ from y: σ = N/A − (M_xy cos(ψ + θ) + M_xz sin(ψ + θ))/W_b. Ranges of "
        "bending and torsion are combined as if in phase; ψ and the side of a location (before or behind its load) are those of the minimum safety "
        "factor, found by a scan of 120 directions and bounded search. Safety factors are limited to 10⁶, which denotes a location without stress.")
STATES = ("under_load", *FACTORS.values())
fatigue.prepared("states", lambda given: _states(*map(given.get, STATES)), STATES, for_many=True)


def _state(chapter: Chapter, id: str, symbol: str, unit: str, description: str, name: str, method: str) -> None:
    chapter[id] = computed(lambda states: states[name], ("states",), method, over="places", output=False), symbol, unit, description


_state(fatigue, "sigma_a", "σ_a", "MPa", "Amplitude of the normal stress", "sigma_a", "half the range over the cycle")
_state(fatigue, "sigma_m", "σ_m", "MPa", "Mean normal stress", "sigma_m", "middle of the range over the cycle")
_state(fatigue, "torque_upper", "T_o", "N*m", "Maximum torque over the cycle at this location", "torque_upper", "over the cycle")
_state(fatigue, "torque_lower", "T_u", "N*m", "Minimum torque over the cycle at this location", "torque_lower", "over the cycle")
fatigue.tau_a = inner((m.torque_upper - m.torque_lower) / (4 * m.place_modulus)), "τ_a", "MPa", "Amplitude of the shear stress", "Shigley 7-2"
fatigue.tau_m = inner((m.torque_upper + m.torque_lower) / (4 * m.place_modulus)), "τ_m", "MPa", "Mean shear stress", "Shigley 7-2"
fatigue.place_safety = (value(formulas.goodman.of(endurance=m.place_endurance), shown_to=100), "n_f", "1", "Safety factor against fatigue",
    "Shigley 7-7")
fatigue.fatigue_safety = total("min", of="place_safety", shown_to=100), "n_f,min", "1", "Minimum safety factor against fatigue", "Shigley 7-7"
fatigue.governing_place = (computed(lambda row: np.argmin(row, axis=1)[:, None], ("place_safety",), "the minimum of all locations", output=False,
    whole=True, printed=False), "i_f", "1", "Index of the location of the minimum safety factor, from 0")
fatigue.fatigue_place = (computed(lambda body, index: [body.names[int(each)] for each in index[:, 0]], ("body", "governing_place"),
    "the minimum of all locations", is_text=True), "P_f", "1", "Location of the minimum safety factor against fatigue")


def _at_governing(chapter: Chapter, id: str, symbol: str, unit: str, description: str, of: str) -> None:
    chapter[id] = (computed(lambda row, index: np.take_along_axis(row, index.astype(int), axis=1), (of, "governing_place"),
        "at the location of the minimum safety factor"), symbol, unit, description)


_at_governing(fatigue, "fatigue_position", "x_f", "mm", "Position of the minimum safety factor against fatigue", "place_x")
_at_governing(fatigue, "endurance_limit", "S_e,f", "MPa", "Endurance limit at the location of the minimum safety factor", "place_endurance")

yielding = Chapter("Yield")
for name, symbol, unit, description in (
    ("nominal_position", "x_y", "mm", "Location of the maximum nominal stress"), ("nominal_diameter", "d_y", "mm", "Diameter at this location"),
    ("nominal_bore", "d_iy", "mm", "Bore at this location"), ("nominal_axial", "N_y", "N", "Axial force at this location"),
    ("nominal_moment", "M_by", "N*m", "Bending moment at this location"), ("nominal_torque", "T_y", "N*m", "Torque at this location"),
):
    _number(yielding, name, symbol, unit, description, name, "at the location and instant of the maximum stress, of all locations on both sides",
        output=False)
_number(yielding, "nominal_case", "j", "1", "Load case of the maximum stress, by its place in the list; 0 is the run", "nominal_case",
    "that with the maximum stress", output=False, needs=CASES, printed=False)
YIELD_CASE = ("C_y", "1", "Governing load case for yield")
yielding.yield_case = (computed(lambda index, names: [called(int(each), names) for each in index[:, 0]], ("nominal_case", "load_cases.name"),
    "that with the maximum stress", is_text=True, needs=CASES), *YIELD_CASE)
yielding.yield_case = (computed(lambda length: [called(0)] * len(length), ("length",), "that with the maximum stress", is_text=True, lacks=CASES,
    printed=False, output=False), *YIELD_CASE)
yielding.nominal_area = (inner(tube(m.nominal_diameter, m.nominal_bore).area), "A_y", "mm**2", "Area at this location",
    "geometry")
yielding.nominal_modulus = (inner(tube(m.nominal_diameter, m.nominal_bore).modulus), "W_by", "mm**3",
    "Section modulus at this location", "geometry")
yielding.von_mises_max = (formulas.nominal_stress.of(axial_force=m.nominal_axial, moment=m.nominal_moment, torque=m.nominal_torque,
    area=m.nominal_area, modulus=m.nominal_modulus), "σ_vM", "MPa", "Maximum nominal stress", "Shigley 7-15")
yielding.yield_safety = (value(1 / np.maximum(m.von_mises_max / m.yield_strength, 1e-6), shown_to=100), "n_y", "1",
    "Nominal safety factor against yield", "Shigley 7-16")
for name, symbol, unit, description in (("yield_axial", "N_v", "N", "Axial force at the instant of the maximum notch stress"),
                                        ("yield_moment", "M_bv", "N*m", "Bending moment at this instant"), ("yield_torque", "T_v", "N*m",
                                                                                                            "Torque at this instant")):
    _state(yielding, name, symbol, unit, description, name, "at the instant and on the side of the maximum stress")
yielding.notch_stress = (inner(formulas.yield_stress.of(axial_force=m.yield_axial, moment=m.yield_moment, torque=m.yield_torque, area=m.place_area,
    modulus=m.place_modulus)), "σ_vM,n", "MPa", "Maximum notch stress", "Shigley 7-15")
yielding.place_yield_safety = (value(1 / np.maximum(m.notch_stress / m.yield_strength, 1e-6), shown_to=100), "n_y,n", "1",
    "Safety factor against yield with the notch", "Shigley 7-16")
yielding.yield_safety_notch = (total("min", of="place_yield_safety", shown_to=100), "n_y,notch", "1",
    "Minimum safety factor against yield with the notches", "Shigley 7-16")
yielding.part_table("place_table", "All locations", "places", ("place_x", "place_diameter", "k_t", "k_ts", "k_f", "k_fs", "sigma_a", "sigma_m",
        "tau_a", "tau_m", "place_endurance", "place_safety", "place_yield_safety"))

MOST_CRITICAL = 30_000  # rpm, ten times any shaft of a press: of a stiffer one the value, without shear, means nothing more
_number(critical, "critical_speed", "n_crit", "rpm", "Lowest critical speed", "critical",
    "largest eigenvalue of √m_i δ_ij √m_j with the exact deflections δ_ij for unit forces", source="Shigley 7-6", shown_to=MOST_CRITICAL)
_number(critical, "critical_speed_rayleigh", "n_R", "rpm", "Critical speed by Rayleigh, upper bound", "rayleigh",
    "ω² = Σ f_i y_i/Σ m_i y_i² with f_i = m_i g, downwards on overhangs", source="Shigley 7-23",
    shown_to=MOST_CRITICAL)
_number(critical, "critical_speed_dunkerley", "n_D", "rpm", "Critical speed by Dunkerley, lower bound", "dunkerley", "1/ω² = Σ m_i δ_ii",
    source="Shigley 7-32", shown_to=MOST_CRITICAL)
critical.turns = (computed(lambda rotation, length: np.full(length.shape, isinstance(rotation, str) and rotation == "turning"),
    ("rotation", "length"), "by rotation", output=False), "k_n", "1", "Shaft rotates; otherwise it stands or oscillates")
critical.stands = (computed(lambda rotation, length: np.full(length.shape, isinstance(rotation, str) and rotation == "none"), ("rotation", "length"),
    "by rotation", output=False), "k_0", "1", "Shaft stands; otherwise it rotates or oscillates")
critical.standing_speed = inner(m.speed, exists=m.stands > 0, needs=("speed",)), "n_0", "rpm", "Speed of a shaft that stands by rotation", "input"
critical.turning_limit = (inner(m.critical_speed, exists=m.turns > 0), "n_k", "rpm",
    "Critical speed with which the speed of a rotating shaft is compared", "Shigley 7-6")
critical.speed_verdict = (choice(case("more than ten times as high, not limiting", "the critical speed is at least ten times the speed",
    m.critical_speed >= 10 * m.speed), case("twice to ten times as high", "the critical speed is at least twice the speed",
    m.critical_speed >= 2 * m.speed), case("less than twice as high", "the critical speed is near the speed"), exists=m.turns > 0, needs=("speed",)),
    "n_k/n", "1", "Critical speed relative to the speed", "Shigley 7-6")
critical.twice_speed = inner(2 * m.speed, needs=("speed",)), "2n", "rpm", "Twice the speed", "Shigley 7-6"

enough = Chapter("Size of the shaft")
enough.effective_diameter = inner(m.size_share * m.place_diameter), "d_e", "mm", "Effective diameter there", "Shigley 6-24"
enough.greatest_effective = total("max", of="effective_diameter", output=False), "d_e,max", "mm", "Greatest effective diameter", "Shigley 6-24"
