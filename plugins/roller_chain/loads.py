"""Chapters on the motion of the chain, its useful tension and the tension of its strands, for numbers and over a cycle."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, Curve, as_angle, bind, case
from diecut_report.plugins.roller_chain import formulas as f
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, DRIVE

ANY = "list"  # what a list of values runs over: whatever takes it


def one_cycle(acceleration: Curve, velocity: Curve, like: Any) -> Any:
    """Whether both curves run over one cycle, of each machine."""
    alike = ANY in (acceleration.cycle, velocity.cycle) or acceleration.cycle == velocity.cycle
    return np.full(np.shape(like), bool(alike))


# fmt: off

STILL = 1e-9  # share of the greatest velocity up to which the chain stands
Way = dict[str, Any]
TORQUE: Way = {"needs": (DRIVE, "torque_curve")}
VELOCITY: Way = {"needs": (CONVEYOR, "velocity_curve")}
ACCELERATION: Way = {"needs": (CONVEYOR, "acceleration_curve", "velocity")}
CURVES = (TORQUE, VELOCITY, ACCELERATION)
NUMBERS: tuple[Way, ...] = (
    {"needs": (DRIVE,), "lacks": ("torque_curve",)},
    {"needs": (CONVEYOR, "acceleration", "velocity")},
)
DRIVEN: Way = {"needs": (DRIVE,)}
CONVEYED: Way = {"needs": (CONVEYOR,)}
OUT_OF_PLACE = {
    CONVEYOR: {"speed": "rpm", "torque": "", "torque_curve": "", "power": "", "power_rating": ""},
    DRIVE: {"moving_mass": "", "acceleration": "", "acceleration_curve": "", "velocity": "", "velocity_curve": ""},
}
"""Keys of the other use."""

cycle = Chapter("Cycle", text="One period of the referenced curves is mapped to one revolution of the cycle angle.")
for use, keys in OUT_OF_PLACE.items():
    for key in keys:
        cycle.require(f"{key}_out_of_place", lambda teeth_1: teeth_1 < 0, key=key, needs=(use, key),
            message=f"has no use beside {use.replace('=', ': ')}; remove it, or set use to {'drive' if use == CONVEYOR else 'conveyor'}")
BOTH_CURVES: Way = {"needs": (CONVEYOR, "acceleration_curve", "velocity_curve")}
cycle.computed("one_cycle", "k_z", "1", "Both curves run over the same cycle", function=one_cycle,
    takes=("acceleration_curve", "velocity_curve", "teeth_1"), method="their abscissae are compared", output=False, **BOTH_CURVES)
cycle.require("same_cycle", lambda one_cycle: one_cycle > 0, key="velocity_curve",
    message="runs over another cycle than acceleration; give both over one cycle, or one of them as a number", **BOTH_CURVES)
for way in CURVES:
    cycle.abscissa("cycle_angle", "φ", "deg", "Cycle angle, one revolution per period of the curves", period=2 * np.pi, shown_at="tension_peak_at",
        **way)
cycle.from_curve("torque_over", "T_φ", "N*m", "Torque as given", given="torque_curve", abscissa="cycle_angle", output=False, **TORQUE)
cycle.from_curve("velocity_over", "v_φ", "m/s", "Velocity as given", given="velocity_curve", abscissa="cycle_angle", output=False, **VELOCITY)
cycle.from_curve("acceleration_over", "a_φ", "m/s**2", "Acceleration as given", given="acceleration_curve", abscissa="cycle_angle", output=False,
    needs=(CONVEYOR, "acceleration_curve"))

cycle.reduction("velocity_size", "v_m", "m/s", "Maximum absolute velocity", "abs_max", of="velocity_over", output=False, **VELOCITY)
cycle.value("velocity_margin", "v_k", "m/s", "Absolute velocity above the threshold of rest",
    bind(lambda speed, size, still: abs(speed) - still * size, speed="velocity_over", size="velocity_size", still=STILL), source="this method",
    output=False, **VELOCITY)
cycle.crossings("rest_edge", "φ_r", "deg", "Start or end of a rest", of="velocity_margin", output=False, **VELOCITY)
cycle.breakpoints("rests", "cycle_angle", "rest_edge", **VELOCITY)

motion = Chapter("Motion",
    text="The chain forms a polygon on the sprocket: at constant shaft speed its velocity rises and falls with each tooth, and its acceleration "
        "jumps where a joint meets the sprocket.")
motion.value("velocity", "v", "m/s", "Mean velocity of the chain", bind(f.mean_velocity, teeth="teeth_1"), source="kinematics", **DRIVEN)
motion.value("velocity", "v", "m/s", "Absolute velocity", bind(lambda given: abs(given), given="inputs.velocity"), needs=(CONVEYOR, "velocity"),
    source="input")
motion.value("velocity", "v", "m/s", "Maximum velocity over the cycle", lambda velocity_size: velocity_size, source="this method", **VELOCITY)
motion.value("angular_speed", "ω", "rad/s", "Angular speed of the driving sprocket", lambda speed: speed, source="input", **DRIVEN)
motion.value("angular_speed", "ω", "rad/s", "Maximum angular speed of the driving sprocket",
    lambda velocity, sprocket_diameter_1: as_angle(velocity / (sprocket_diameter_1 / 2)), source="kinematics", **CONVEYED)
motion.value("velocity_max", "v_max", "m/s", "Maximum velocity within a tooth",
    lambda angular_speed, sprocket_diameter_1: angular_speed * sprocket_diameter_1 / 2, source="geometry")
motion.value("velocity_min", "v_min", "m/s", "Minimum velocity within a tooth", lambda velocity_max, teeth_1: velocity_max * np.cos(np.pi / teeth_1),
    source="geometry")
motion.value("speed_unevenness", "δ", "%", "Relative drop in velocity within a tooth", lambda teeth_1: 1 - np.cos(np.pi / teeth_1), source="geometry")
motion.value("chordal_acceleration", "a_ch", "m/s**2", "Jump in the acceleration where a joint meets the sprocket", f.chordal_step, source="geometry")

useful = Chapter("Useful tension", text="All tensions are those of one strand.")
useful.value("torque_carried", "T_d", "N*m", "Absolute torque of the driving sprocket", lambda torque: abs(torque), needs=(DRIVE, "torque"),
    source="input", output=False)
useful.value("torque_carried", "T_d", "N*m", "Torque of the driving sprocket", lambda power, angular_speed: power / angular_speed,
    needs=(DRIVE, "power"), source="power", output=False)
useful.reduction("torque_carried", "T_d", "N*m", "Maximum absolute torque over the cycle", "abs_max", of="torque_over", output=False, **TORQUE)
useful.value("moving_mass_with_chain", "m_h", "kg", "Moving mass, with the chains; all of it is assumed to hang on one side",
    bind(f.hanging_mass, mass="moving_mass", length="chain_length"), source="this method", output=False, **CONVEYED)
useful.value("moving_mass_total", "m_tot", "kg", "Accelerated mass, with the parts that turn with the driven sprocket",
    bind(f.total_mass, hanging="moving_mass_with_chain", inertia="driven_inertia", diameter="sprocket_diameter_2"), source="dynamics", **CONVEYED)
useful.value("resistance", "F_w", "N", "Force against the motion", bind(f.resistance, friction="friction_coefficient", mass="moving_mass_with_chain"),
    source="this method", **CONVEYED)
MOVES = "Chain in motion (1) or at rest (0)"
useful.choice("moving_over", "k_φ", "1", MOVES, case(lambda: 1, "the chain moves", lambda velocity_margin: velocity_margin > 0),
    case(lambda: 0, "the chain stands"), per_piece=True, source="this method", output=False, **VELOCITY)
useful.choice("moving", "k_v", "1", MOVES, case(lambda: 1, "the chain moves", lambda velocity: velocity > 0), case(lambda: 0, "the chain stands"),
    needs=(CONVEYOR, "velocity"), source="this method", output=False)


def pulled(acceleration: str, moving: str) -> Any:
    """Useful tension of a conveyor."""
    return bind(f.conveyor_tension, total="moving_mass_total", acceleration=acceleration, moving=moving)


for way, formula in ((TORQUE, bind(f.drive_tension, torque="torque_over", diameter="sprocket_diameter_1")),
                     ({"needs": (*VELOCITY["needs"], "acceleration_curve")}, pulled("acceleration_over", "moving_over")),
                     ({"needs": (*VELOCITY["needs"], "acceleration")}, pulled("acceleration", "moving_over")),
                     (ACCELERATION, pulled("acceleration_over", "moving"))):
    useful.value("useful_tension_curve", "F_tφ", "N", "Useful tension", formula, source="statics", **way)
    useful.reduction("useful_tension", "F_t", "N", "Maximum useful tension over the cycle", "max", of="useful_tension_curve", **way)
useful.value("useful_tension", "F_t", "N", "Useful tension", bind(f.drive_tension, torque="torque_carried", diameter="sprocket_diameter_1"),
    source="statics", **NUMBERS[0])
useful.value("useful_tension", "F_t", "N", "Useful tension", pulled("acceleration", "moving"), source="statics", **NUMBERS[1])

tension = Chapter("Tension of the strands",
    text="In addition to the useful tension a strand carries its weight, the centrifugal force, the polygon shocks and its pretension. The static "
        "tension excludes application factor and shocks.")
tension.value("centrifugal_tension", "F_c", "N", "Centrifugal tension, at the maximum velocity", f.centrifugal, source="dynamics")
tension.value("sag_tension", "F_s", "N", "Tension due to sag, at the upper end of the strand", bind(f.sag_tension), source="statics (parabola)")
tension.value("chordal_tension", "F_ch", "N", "Polygon shock force on the free strand, at the maximum velocity",
    bind(f.chordal, step="chordal_acceleration"), source="this method")
tension.value("centrifugal_over", "F_cφ", "N", "Centrifugal tension", bind(f.centrifugal, velocity="velocity_over"), source="dynamics", output=False,
    **VELOCITY)
tension.value("angular_speed_over", "ω_φ", "rad/s", "Angular speed of the driving sprocket",
    lambda velocity_over, sprocket_diameter_1: as_angle(velocity_over / (sprocket_diameter_1 / 2)), source="kinematics", output=False, **VELOCITY)
tension.value("chordal_step_over", "a_chφ", "m/s**2", "Jump in the acceleration where a joint meets the sprocket",
    bind(f.chordal_step, angular_speed="angular_speed_over"), source="geometry", output=False, **VELOCITY)
tension.value("chordal_over", "F_chφ", "N", "Polygon shock force on the free strand", bind(f.chordal, step="chordal_step_over"), source="this method",
    output=False, **VELOCITY)
SAME = {"centrifugal": "centrifugal_tension", "chordal": "chordal_tension"}
OVER = {"centrifugal": "centrifugal_over", "chordal": "chordal_over"}


def whole(useful_tension: str, parts: dict[str, str]) -> Any:
    """Whole tension of the tight strand, of these parts."""
    return bind(f.whole_tension, application="application", useful=useful_tension, sag="sag_tension", **parts)


def quiet(useful_tension: str, parts: dict[str, str]) -> Any:
    """Tension without shocks, of these parts."""
    return bind(f.quiet_tension, useful=useful_tension, sag="sag_tension", centrifugal=parts["centrifugal"])


for way, parts in ((TORQUE, SAME), (VELOCITY, OVER), (ACCELERATION, SAME)):
    tension.value("strand_tension", "F_φ", "N", "Tension of the tight strand", whole("useful_tension_curve", parts), source="statics", **way)
    tension.value("static_tension_curve", "F_0φ", "N", "Tension of the tight strand without shocks", quiet("useful_tension_curve", parts),
        source="statics", output=False, **way)
    tension.reduction("tension_peak", "F", "N", "Maximum tension over the cycle", "max", of="strand_tension", **way)
    tension.value("tension_peak_angle", "φ_F", "deg", "Cycle angle of this maximum", lambda tension_peak_at: tension_peak_at, source="this method",
        **way)
    tension.reduction("tension_static", "F_0", "N", "Maximum static tension over the cycle", "max", of="static_tension_curve", **way)
for way in NUMBERS:
    tension.value("tension_peak", "F", "N", "Tension of the tight strand", whole("useful_tension", SAME), source="statics", **way)
    tension.value("tension_static", "F_0", "N", "Static tension of the tight strand", quiet("useful_tension", SAME), source="statics", **way)
tension.value("shaft_load", "F_a", "N", "Shaft load from all strands",
    lambda strands, application, useful_tension, sag_tension, pretension: strands * (application * useful_tension + 2 * sag_tension + 2 * pretension),
    source="statics", **DRIVEN)
