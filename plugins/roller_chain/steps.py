"""Chapters on the geometry of the chain, its loads and its strength, with their formulas."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import GRAVITY, Chapter, Constant, Curve, as_angle, as_number, bind, case, formula, pi
from diecut_report.mechanics import drive_line
from diecut_report.plugins.roller_chain.chains import BY_PITCH, CHAINS
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, CUSTOM, DRIVE

# fmt: off


@formula
def exact_links(center: Any, pitch: Any, teeth_1: Any, teeth_2: Any) -> Any:
    """Links over two sprockets, by the formula of all catalogues."""
    return (
        2 * center / pitch
        + (teeth_1 + teeth_2) / 2
        + ((teeth_2 - teeth_1) / (2 * as_number(pi))) ** 2 * pitch / center
    )


@formula
def even_links(exact: Any) -> Any:
    """Next even number of links, so that none is cranked; a chain that fits exactly takes no more."""
    return 2 * np.ceil(exact / 2 - 1e-9)


@formula
def polygon_links(center: Any, pitch: Any, teeth_1: Any, teeth_2: Any, diameter_1: Any, diameter_2: Any) -> Any:
    """Links over two sprockets: two straight runs, and the teeth that each sprocket has in its wrap."""
    slope = np.arcsin((diameter_2 - diameter_1) / (2 * center))
    wrapped = teeth_1 * (pi - 2 * slope) / (2 * pi) + teeth_2 * (pi + 2 * slope) / (2 * pi)
    return 2 * center * np.cos(slope) / pitch + wrapped


@formula
def bearing_area(pin_diameter: Any, inner_width: Any, plate_thickness: Any) -> Any:
    """Area of pin and bush, which is as long as the inner link is wide."""
    return pin_diameter * (inner_width + 2 * plate_thickness)


@formula
def mean_velocity(teeth: Any, pitch: Any, speed: Any) -> Any:
    """Mean velocity of a chain: so many pitches a turn."""
    return teeth * pitch * speed / (2 * pi)


@formula
def sag_tension(mass_per_length: Any, center: Any, sag: Any, inclination: Any) -> Any:
    """Tension of a strand by its weight, at its upper end: a parabola."""
    return mass_per_length * GRAVITY * center * (np.cos(inclination) / (8 * sag) + np.sin(inclination))


@formula
def centrifugal(mass_per_length: Any, velocity: Any) -> Any:
    """Tension that keeps the chain on its circles."""
    return mass_per_length * velocity**2


@formula
def chordal_step(angular_speed: Any, pitch: Any) -> Any:
    """Acceleration of the chain where a joint meets the sprocket."""
    return as_number(angular_speed) ** 2 * pitch / 2


@formula
def chordal(mass_per_length: Any, center: Any, step: Any) -> Any:
    """Force that the acceleration asks of the free strand."""
    return mass_per_length * center * step


@formula
def drive_tension(torque: Any, strands: Any, diameter: Any) -> Any:
    """Useful tension of a strand of a drive."""
    return 2 * abs(torque) / (strands * diameter)


@formula
def conveyor_tension(total: Any, acceleration: Any, moving: Any, resistance: Any, strands: Any) -> Any:
    """Useful tension of a strand of a conveyor: the mass is accelerated, and what moves rubs."""
    return (abs(total * acceleration) + moving * resistance) / strands


@formula
def resistance(friction: Any, mass: Any, process_force: Any) -> Any:
    """Force against the motion of a conveyor."""
    return friction * mass * GRAVITY + process_force


@formula
def hanging_mass(mass: Any, strands: Any, mass_per_length: Any, length: Any) -> Any:
    """Mass that moves with a conveyor's chains, and they themselves."""
    return mass + strands * mass_per_length * length


@formula
def total_mass(hanging: Any, inertia: Any, diameter: Any) -> Any:
    """Mass that is accelerated, with what turns at the driven sprocket."""
    return hanging + inertia / (diameter / 2) ** 2


@formula
def whole_tension(application: Any, useful: Any, centrifugal: Any, sag: Any, chordal: Any, pretension: Any) -> Any:
    """Tension of the tight strand."""
    return application * useful + centrifugal + sag + chordal + pretension


@formula
def quiet_tension(useful: Any, centrifugal: Any, sag: Any, pretension: Any) -> Any:
    """Tension of the tight strand without shocks."""
    return useful + centrifugal + sag + pretension


@formula
def plate_power(teeth: Any, speed: Any, pitch: Any) -> Any:
    """Power up to which the plates last, one strand (ANSI B29.1)."""
    turns = speed / SPEED
    inches = pitch / INCH
    return HORSEPOWER * 0.004 * teeth**1.08 * turns**0.9 * inches ** (3 - 0.07 * inches)


@formula
def roller_power(teeth: Any, speed: Any, pitch: Any) -> Any:
    """Power up to which rollers and bushes last, one strand (ANSI B29.1)."""
    turns = speed / SPEED
    return HORSEPOWER * 17000 * teeth**1.5 * (pitch / INCH) ** 0.8 / turns**1.5


SHIGLEY = "Shigley, eq. 17-34 … 17-36"
TEETH = {1: "teeth_1", 2: "driven_teeth"}
BOTH = {"teeth_1": "teeth_1", "teeth_2": "driven_teeth"}
GIVEN_DISTANCE = ("center_distance",)

TAKEN = {
    "pitch": ("p", "mm", "Pitch"), "pin_diameter": ("d_p", "mm", "Diameter of the pins"),
    "breaking_load": ("F_B", "kN", "Breaking load of one strand"),
    "mass_per_length": ("q", "kg/m", "Mass per unit length of one strand"),
}
MEASURED = {"inner_width": ("b_1", "mm", "Width between the inner plates"), "plate_thickness": ("t_i", "mm", "Thickness of the inner plates")}
SHARES = {"pitch": (0.999, 1.001), "pin_diameter": (0.8, 1.25), "bearing_area": (0.5, 1.25), "breaking_load": (0.5, 1.25),
          "mass_per_length": (0.5, 1.25)}
"""Within what share of its row of the table a value of a chain can be, whoever makes it."""

chain = Chapter("Chain", text="All values are those of one strand.")
for key, (symbol, unit, words) in TAKEN.items():
    chain.lookup(key, symbol, unit, words, CHAINS, by="chain", column=key, given=key, needs=("chain",), source="ISO 606")
    if key != "pitch":
        chain.interpolated(key, symbol, unit, f"{words} of this pitch", BY_PITCH, of="pitch", column=key, key="chain", lacks=("chain",),
            source="ISO 606")
for key, (symbol, unit, words) in MEASURED.items():
    chain.lookup(key, symbol, unit, words, CHAINS, by="chain", column=key, needs=("chain",), lacks=(CUSTOM,), source="ISO 606", output=False)
    chain.interpolated(key, symbol, unit, f"{words} of this pitch", BY_PITCH, of="pitch", column=key, key="chain", lacks=("chain", "bearing_area"),
        source="ISO 606", output=False)
chain.value("bearing_area", "A", "mm**2", "Bearing area of a joint: pin and bush, whose length is the width of the inner link", bearing_area,
    lacks=("bearing_area",), source="geometry")
chain.value("bearing_area", "A", "mm**2", "Bearing area of a joint: as given", bind(lambda given: given, given="inputs.bearing_area"),
    needs=("bearing_area",), source="input")
for key, (symbol, unit, words) in TAKEN.items():
    chain.lookup(f"{key}_of_table", f"{symbol},t", unit, f"{words}: that of the table", CHAINS, by="chain", column=key, needs=("chain",),
        lacks=(CUSTOM,), source="ISO 606", output=False)
chain.value("bearing_area_of_table", "A_t", "mm**2", "Bearing area of a joint: that of the table",
    bind(bearing_area, pin_diameter="pin_diameter_of_table"), needs=("chain",), lacks=(CUSTOM,), source="geometry", output=False)
for key, (least, most) in SHARES.items():
    chain.require(f"{key}_as_table", bind(lambda given, own, least, most: (given >= least * own) & (given <= most * own),
        given=f"inputs.{key}", own=f"{key}_of_table", least=least, most=most), key=key,
        needs=("chain", key), lacks=(CUSTOM,),
        message=f"is {{inputs.{key}}}, but the table has {{{key}_of_table}} for this designation, and no maker less than {least:g} or more than "
            f"{most:g} times that; correct it, or its unit, or the designation, or set chain to custom with all its values")

loop = Chapter("Loop over the sprockets",
    text="The number of links follows from the centre distance and is even, so that no link is cranked; with whole links the distance is adjusted. "
        "The catalogue formulas are compared with the exact polygon.")
loop.value("teeth_small", "z_s", "1", "Number of teeth of the smaller sprocket", lambda teeth_1, driven_teeth: np.minimum(teeth_1, driven_teeth),
    source="geometry", whole=True, output=False)
for g, teeth in TEETH.items():
    loop.value(f"sprocket_diameter_{g}", f"d_{g}", "mm", f"Pitch circle diameter of the {'driving' if g == 1 else 'driven'} sprocket",
        bind(drive_line.sprocket_diameter, teeth=teeth), source="geometry", digits=6)
loop.value("center_least", "a_min", "mm", "Centre distance at which the sprockets touch",
    lambda sprocket_diameter_1, sprocket_diameter_2: (sprocket_diameter_1 + sprocket_diameter_2) / 2, source="geometry", output=False)
loop.require("sprockets_apart", lambda center_distance, center_least: center_distance > center_least, key="center_distance", needs=GIVEN_DISTANCE,
    message="is {center_distance}, at which sprockets of {sprocket_diameter_1} and {sprocket_diameter_2} overlap; give more than {center_least:up}")
loop.value("links_exact", "X_0", "1", "Number of links required by the centre distance", bind(exact_links, center="center_distance", **BOTH),
    needs=GIVEN_DISTANCE, source=SHIGLEY, digits=7)
loop.value("links", "X", "1", "Links: the next even number", bind(even_links, exact="links_exact"), needs=GIVEN_DISTANCE, source=SHIGLEY,
    whole=True)
loop.value("links", "X", "1", "Links: as given", bind(lambda given: given, given="inputs.links"), lacks=GIVEN_DISTANCE, source="input", whole=True)
loop.value("links_free", "B", "1", "Links that are not on the sprockets", bind(drive_line.free_links, **BOTH), source=SHIGLEY, output=False, digits=6)
loop.value("links_discriminant", "D_X", "1", "Condition for a whole number of links (positive)",
    bind(drive_line.links_discriminant, free="links_free", **BOTH), source=SHIGLEY, output=False, digits=6)
loop.require("long_enough", lambda links_free, links_discriminant: (links_free > 0) & (links_discriminant > 0), key="links", lacks=GIVEN_DISTANCE,
    message="is {inputs.links}, too few to go round sprockets of {teeth_1} and {driven_teeth} teeth; give more links or fewer teeth")
loop.value("center_distance_adjusted", "a_X", "mm", "Centre distance for this number of links",
    bind(drive_line.chain_center_distance, free="links_free", root_of="links_discriminant"), source=SHIGLEY, digits=7)
loop.require("adjusted_apart", lambda center_distance_adjusted, center_least: center_distance_adjusted > center_least, key="links",
    lacks=GIVEN_DISTANCE,
    message="is {inputs.links}, with which the sprockets overlap: the centre distance would be {center_distance_adjusted}, and they touch at "
        "{center_least}; give more links")
loop.value("center", "a", "mm", "Centre distance, for the tensions: as given", lambda center_distance: center_distance, needs=GIVEN_DISTANCE,
    source="input", output=False)
loop.value("center", "a", "mm", "Centre distance, for the tensions", lambda center_distance_adjusted: center_distance_adjusted, lacks=GIVEN_DISTANCE,
    source=SHIGLEY, output=False)
loop.value("chain_length", "L", "m", "Length of the chain", lambda links, pitch: links * pitch, source="geometry")
loop.value("links_polygon", "X_e", "1", "Number of links at the adjusted distance by the exact polygon",
    bind(polygon_links, center="center_distance_adjusted", diameter_1="sprocket_diameter_1", diameter_2="sprocket_diameter_2", **BOTH),
    source="geometry", output=False, digits=8)
loop.value("links_residual", "ΔX", "1", "Deviation of the formula from the exact polygon, in links",
    lambda links_polygon, links: abs(links_polygon - links), source="geometry", output=False)
loop.value("wrap_small", "β_s", "deg", "Wrap of the smaller sprocket",
    lambda sprocket_diameter_1, sprocket_diameter_2, center: pi - 2 * np.arcsin(abs(sprocket_diameter_2 - sprocket_diameter_1) / (2 * center)),
    source="geometry")
loop.value("center_in_pitches", "a_p", "1", "Centre distance in pitches", lambda center, pitch: center / pitch, source="geometry", output=False)
loop.value("links_odd", "X_2", "1", "Links in excess of an even number", lambda links: links - 2 * np.floor(links / 2), source="this method",
    output=False)


INCH = Constant(0.0254, "inch", "m")
SPEED = Constant(2 * np.pi / 60, "rpm", "rad/s")
HORSEPOWER = Constant(745.7, "hp", "W")


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
motion.value("velocity", "v", "m/s", "Mean velocity of the chain", bind(mean_velocity, teeth="teeth_1"), source="kinematics", **DRIVEN)
motion.value("velocity", "v", "m/s", "Absolute velocity", bind(lambda given: abs(given), given="inputs.velocity"), needs=(CONVEYOR, "velocity"),
    source="input")
motion.value("velocity", "v", "m/s", "Maximum velocity over the cycle", lambda velocity_size: velocity_size, source="this method", **VELOCITY)
motion.value("angular_speed", "ω", "rad/s", "Angular speed of the driving sprocket", lambda speed: speed, source="input", **DRIVEN)
motion.value("angular_speed", "ω", "rad/s", "Maximum angular speed of the driving sprocket",
    lambda velocity, sprocket_diameter_1: as_angle(velocity / (sprocket_diameter_1 / 2)), source="kinematics", **CONVEYED)
motion.value("velocity_max", "v_max", "m/s", "Maximum velocity within a tooth",
    lambda angular_speed, sprocket_diameter_1: angular_speed * sprocket_diameter_1 / 2, source="geometry")
motion.value("velocity_min", "v_min", "m/s", "Minimum velocity within a tooth", lambda velocity_max, teeth_1: velocity_max * np.cos(pi / teeth_1),
    source="geometry")
motion.value("speed_unevenness", "δ", "%", "Relative drop in velocity within a tooth", lambda teeth_1: 1 - np.cos(pi / teeth_1), source="geometry")
motion.value("chordal_acceleration", "a_ch", "m/s**2", "Jump in the acceleration where a joint meets the sprocket", chordal_step, source="geometry")

useful = Chapter("Useful tension", text="All tensions are those of one strand.")
useful.value("torque_carried", "T_d", "N*m", "Absolute torque of the driving sprocket", lambda torque: abs(torque), needs=(DRIVE, "torque"),
    source="input", output=False)
useful.value("torque_carried", "T_d", "N*m", "Torque of the driving sprocket", lambda power, angular_speed: power / angular_speed,
    needs=(DRIVE, "power"), source="power", output=False)
useful.reduction("torque_carried", "T_d", "N*m", "Maximum absolute torque over the cycle", "abs_max", of="torque_over", output=False, **TORQUE)
useful.value("moving_mass_with_chain", "m_h", "kg", "Moving mass, with the chains; all of it is assumed to hang on one side",
    bind(hanging_mass, mass="moving_mass", length="chain_length"), source="this method", output=False, **CONVEYED)
useful.value("moving_mass_total", "m_tot", "kg", "Accelerated mass, with the parts that turn with the driven sprocket",
    bind(total_mass, hanging="moving_mass_with_chain", inertia="driven_inertia", diameter="sprocket_diameter_2"), source="dynamics", **CONVEYED)
useful.value("resistance", "F_w", "N", "Force against the motion", bind(resistance, friction="friction_coefficient", mass="moving_mass_with_chain"),
    source="this method", **CONVEYED)
MOVES = "Chain in motion (1) or at rest (0)"
useful.choice("moving_over", "k_φ", "1", MOVES, case(lambda: 1, "the chain moves", lambda velocity_margin: velocity_margin > 0),
    case(lambda: 0, "the chain stands"), per_piece=True, source="this method", output=False, **VELOCITY)
useful.choice("moving", "k_v", "1", MOVES, case(lambda: 1, "the chain moves", lambda velocity: velocity > 0), case(lambda: 0, "the chain stands"),
    needs=(CONVEYOR, "velocity"), source="this method", output=False)


def pulled(acceleration: str, moving: str) -> Any:
    """Useful tension of a conveyor."""
    return bind(conveyor_tension, total="moving_mass_total", acceleration=acceleration, moving=moving)


for way, pull in ((TORQUE, bind(drive_tension, torque="torque_over", diameter="sprocket_diameter_1")),
                  ({"needs": (*VELOCITY["needs"], "acceleration_curve")}, pulled("acceleration_over", "moving_over")),
                  ({"needs": (*VELOCITY["needs"], "acceleration")}, pulled("acceleration", "moving_over")),
                  (ACCELERATION, pulled("acceleration_over", "moving"))):
    useful.value("useful_tension_curve", "F_tφ", "N", "Useful tension", pull, source="statics", **way)
    useful.reduction("useful_tension", "F_t", "N", "Maximum useful tension over the cycle", "max", of="useful_tension_curve", **way)
useful.value("useful_tension", "F_t", "N", "Useful tension", bind(drive_tension, torque="torque_carried", diameter="sprocket_diameter_1"),
    source="statics", **NUMBERS[0])
useful.value("useful_tension", "F_t", "N", "Useful tension", pulled("acceleration", "moving"), source="statics", **NUMBERS[1])

tension = Chapter("Tension of the strands",
    text="In addition to the useful tension a strand carries its weight, the centrifugal force, the polygon shocks and its pretension. The static "
        "tension excludes application factor and shocks.")
tension.value("centrifugal_tension", "F_c", "N", "Centrifugal tension, at the maximum velocity", centrifugal, source="dynamics")
tension.value("sag_tension", "F_s", "N", "Tension due to sag, at the upper end of the strand", bind(sag_tension), source="statics (parabola)")
tension.value("chordal_tension", "F_ch", "N", "Polygon shock force on the free strand, at the maximum velocity",
    bind(chordal, step="chordal_acceleration"), source="this method")
tension.value("centrifugal_over", "F_cφ", "N", "Centrifugal tension", bind(centrifugal, velocity="velocity_over"), source="dynamics", output=False,
    **VELOCITY)
tension.value("angular_speed_over", "ω_φ", "rad/s", "Angular speed of the driving sprocket",
    lambda velocity_over, sprocket_diameter_1: as_angle(velocity_over / (sprocket_diameter_1 / 2)), source="kinematics", output=False, **VELOCITY)
tension.value("chordal_step_over", "a_chφ", "m/s**2", "Jump in the acceleration where a joint meets the sprocket",
    bind(chordal_step, angular_speed="angular_speed_over"), source="geometry", output=False, **VELOCITY)
tension.value("chordal_over", "F_chφ", "N", "Polygon shock force on the free strand", bind(chordal, step="chordal_step_over"), source="this method",
    output=False, **VELOCITY)
SAME = {"centrifugal": "centrifugal_tension", "chordal": "chordal_tension"}
OVER = {"centrifugal": "centrifugal_over", "chordal": "chordal_over"}


def whole(useful_tension: str, parts: dict[str, str]) -> Any:
    """Whole tension of the tight strand, of these parts."""
    return bind(whole_tension, application="application", useful=useful_tension, sag="sag_tension", **parts)


def quiet(useful_tension: str, parts: dict[str, str]) -> Any:
    """Tension without shocks, of these parts."""
    return bind(quiet_tension, useful=useful_tension, sag="sag_tension", centrifugal=parts["centrifugal"])


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


USUAL_PITCHES = (30, 50)
RATED = ("power_rating",)
RATED_TEETH = (11, 45)

safety = Chapter("Safety factor against breaking",
    text="No standard gives required safety factors; the defaults are manufacturers' values. iwis takes 7 against the breaking load by rule of "
        "thumb, since fatigue governs in most cases. Diamond Chain limits the working load to a sixth of the breaking load, with slip-fit or "
        "cranked connecting links to a ninth: required_safety_dynamic is then 9.")
safety.value("safety_dynamic", "S_dyn", "1", "Safety factor against breaking under all tensions",
    lambda breaking_load, tension_peak: breaking_load / tension_peak, source="Diamond Chain")
safety.value("safety_static", "S_stat", "1", "Safety factor against breaking under the static tensions",
    lambda breaking_load, tension_static: breaking_load / tension_static, source="iwis")
safety.value("bearing_pressure", "p_r", "MPa", "Pressure of the joints", lambda tension_peak, bearing_area: tension_peak / bearing_area,
    source="statics")
safety.value("breaking_load_needed", "F_B,min", "kN", "Breaking load required by both safety factors",
    lambda required_safety_dynamic, tension_peak, required_safety_static, tension_static:
        np.maximum(required_safety_dynamic * tension_peak, required_safety_static * tension_static), source="Diamond Chain, iwis", output=False)
safety.value("bearing_area_needed", "A_min", "mm**2", "Bearing area required by the allowable pressure",
    lambda tension_peak, allowable_bearing_pressure: tension_peak / allowable_bearing_pressure, needs=("allowable_bearing_pressure",),
    source="statics", output=False)

rating = Chapter("Power rating", needs=(DRIVE, *RATED), absent="not calculated: power_rating is not given, or the chain conveys",
    text="Rating of ANSI B29.1 chains, taken for series B of the same pitch: 15 000 h, a chain of 100 links, lubricated as recommended. It holds "
        "for the smaller sprocket.")
rating.require("teeth_rated",
    bind(lambda teeth_small, least, most: (teeth_small >= least) & (teeth_small <= most), least=RATED_TEETH[0], most=RATED_TEETH[1]), key="teeth_1",
    message="leaves the smaller sprocket {teeth_small} teeth, and the rating holds for 11 to 45; change the teeth, or leave out power_rating")
rating.value("speed_small", "n_s", "rpm", "Speed of the smaller sprocket", lambda speed, teeth_1, teeth_small: speed * teeth_1 / teeth_small,
    source="kinematics", output=False)
rating.value("plate_power", "P_1", "kW", "Power limit of the plates of one strand", bind(plate_power, teeth="teeth_small", speed="speed_small"),
    source="ANSI B29.1")
rating.value("roller_power", "P_2", "kW", "Power limit of the rollers of one strand", bind(roller_power, teeth="teeth_small", speed="speed_small"),
    source="ANSI B29.1")
rating.choice("strand_factor", "k_s", "1", "Strand factor",
    *(case((lambda: 1.0, lambda: 1.7, lambda: 2.5)[count - 1], f"{count} strand{'s' * (count > 1)}",
           bind(lambda strands, count: strands == count, count=count)) for count in (1, 2, 3)), case(lambda: 3.3, "4 strands"), source="ANSI B29.1",
    output=False)
rating.value("rated_power", "P_zul", "kW", "Rated power",
    lambda plate_power, roller_power, strand_factor: strand_factor * np.minimum(plate_power, roller_power), source="ANSI B29.1")
rating.choice("rating_governing", "G", "1", "Governing criterion of the rating",
    case("plate", "the power limit of the plates is lower than that of the rollers", lambda plate_power, roller_power: plate_power <= roller_power),
    case("roller", "the power limit of the rollers is lower than that of the plates"), source="ANSI B29.1")
rating.value("design_power", "P_d", "kW", "Power with the application factor",
    lambda application, torque_carried, angular_speed: application * torque_carried * angular_speed, source="power", output=False)

limits = Chapter("Practical limits")
limits.value("teeth_usual", "z_u", "1", "Minimum usual number of teeth of a drive", lambda: 17, needs=(DRIVE,), source="practice", output=False)
limits.value("teeth_usual", "z_u", "1", "Minimum usual number of teeth of a conveyor", lambda: 12, needs=(CONVEYOR,), source="practice", output=False)
limits.value("slack_tension", "F_l", "N", "Static tension of the returning strand", lambda sag_tension, pretension: sag_tension + pretension,
    needs=(CONVEYOR,), source="statics", output=False)
