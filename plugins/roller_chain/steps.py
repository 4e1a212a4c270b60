"""Chapters on the geometry of the chain, its loads and its strength, with their formulas."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    GRAVITY,
    Chapter,
    Constant,
    Curve,
    abscissa,
    as_angle,
    as_number,
    case,
    choice,
    computed,
    crossings,
    formula,
    from_curve,
    inner,
    interpolated,
    lookup,
    m,
    pi,
    reduction,
    value,
)
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
    chain[key] = lookup(CHAINS, by="chain", column=key, given=key, needs=("chain",)), symbol, unit, words, "ISO 606"
    if key != "pitch":
        chain[key] = interpolated(BY_PITCH, of="pitch", column=key, key="chain", lacks=("chain",)), symbol, unit, f"{words} of this pitch", "ISO 606"
for key, (symbol, unit, words) in MEASURED.items():
    chain[key] = lookup(CHAINS, by="chain", column=key, needs=("chain",), lacks=(CUSTOM,), output=False), symbol, unit, words, "ISO 606"
    chain[key] = (interpolated(BY_PITCH, of="pitch", column=key, key="chain", lacks=("chain", "bearing_area"), output=False), symbol, unit,
        f"{words} of this pitch", "ISO 606")
chain.bearing_area = (value(bearing_area, lacks=("bearing_area",)), "A", "mm**2",
    "Bearing area of a joint: pin and bush, whose length is the width of the inner link", "geometry")
chain.bearing_area = value(m.inputs.bearing_area, needs=("bearing_area",)), "A", "mm**2", "Bearing area of a joint: as given", "input"
for key, (symbol, unit, words) in TAKEN.items():
    chain[f"{key}_of_table"] = (lookup(CHAINS, by="chain", column=key, needs=("chain",), lacks=(CUSTOM,), output=False), f"{symbol},t", unit,
        f"{words}: that of the table", "ISO 606")
chain.bearing_area_of_table = (inner(bearing_area.of(pin_diameter=m.pin_diameter_of_table), needs=("chain",), lacks=(CUSTOM,)), "A_t", "mm**2",
    "Bearing area of a joint: that of the table", "geometry")
for key, (least, most) in SHARES.items():
    chain.require(f"{key}_as_table", (m.inputs[key] >= least * m[f"{key}_of_table"]) & (m.inputs[key] <= most * m[f"{key}_of_table"]), key=key,
        needs=("chain", key), lacks=(CUSTOM,),
        message=f"is {{inputs.{key}}}, but the table has {{{key}_of_table}} for this designation, and no maker less than {least:g} or more than "
        f"{most:g} times that; correct it, or its unit, or the designation, or set chain to custom with all its values")

loop = Chapter("Loop over the sprockets",
    text="The number of links follows from the centre distance and is even, so that no link is cranked; with whole links the distance is adjusted. "
        "The catalogue formulas are compared with the exact polygon.")
loop.teeth_small = inner(np.minimum(m.teeth_1, m.driven_teeth), whole=True), "z_s", "1", "Number of teeth of the smaller sprocket", "geometry"
for g, teeth in TEETH.items():
    loop[f"sprocket_diameter_{g}"] = (value(drive_line.sprocket_diameter.of(teeth=m[teeth]), digits=6), f"d_{g}", "mm",
        f"Pitch circle diameter of the {'driving' if g == 1 else 'driven'} sprocket", "geometry")
loop.center_least = (inner((m.sprocket_diameter_1 + m.sprocket_diameter_2) / 2), "a_min", "mm", "Centre distance at which the sprockets touch",
    "geometry")
loop.require("sprockets_apart", m.center_distance > m.center_least, key="center_distance", needs=GIVEN_DISTANCE,
    message="is {center_distance}, at which sprockets of {sprocket_diameter_1} and {sprocket_diameter_2} overlap; give more than {center_least:up}")
loop.links_exact = (value(exact_links.of(center=m.center_distance, teeth_1=m.teeth_1, teeth_2=m.driven_teeth), needs=GIVEN_DISTANCE, digits=7),
    "X_0", "1", "Number of links required by the centre distance", SHIGLEY)
loop.links = value(even_links.of(exact=m.links_exact), needs=GIVEN_DISTANCE, whole=True), "X", "1", "Links: the next even number", SHIGLEY
loop.links = value(m.inputs.links, lacks=GIVEN_DISTANCE, whole=True), "X", "1", "Links: as given", "input"
loop.links_free = (inner(drive_line.free_links.of(teeth_1=m.teeth_1, teeth_2=m.driven_teeth), digits=6), "B", "1",
    "Links that are not on the sprockets", SHIGLEY)
loop.links_discriminant = (inner(drive_line.links_discriminant.of(free=m.links_free, teeth_1=m.teeth_1, teeth_2=m.driven_teeth), digits=6), "D_X",
    "1", "Condition for a whole number of links (positive)", SHIGLEY)
loop.require("long_enough", (m.links_free > 0) & (m.links_discriminant > 0), key="links", lacks=GIVEN_DISTANCE,
    message="is {inputs.links}, too few to go round sprockets of {teeth_1} and {driven_teeth} teeth; give more links or fewer teeth")
loop.center_distance_adjusted = (value(drive_line.chain_center_distance.of(free=m.links_free, root_of=m.links_discriminant), digits=7), "a_X", "mm",
    "Centre distance for this number of links", SHIGLEY)
loop.require("adjusted_apart", m.center_distance_adjusted > m.center_least, key="links", lacks=GIVEN_DISTANCE,
    message="is {inputs.links}, with which the sprockets overlap: the centre distance would be {center_distance_adjusted}, and they touch at "
    "{center_least}; give more links")
loop.center = inner(m.center_distance, needs=GIVEN_DISTANCE), "a", "mm", "Centre distance, for the tensions: as given", "input"
loop.center = inner(m.center_distance_adjusted, lacks=GIVEN_DISTANCE), "a", "mm", "Centre distance, for the tensions", SHIGLEY
loop.chain_length = m.links * m.pitch, "L", "m", "Length of the chain", "geometry"
loop.links_polygon = (inner(polygon_links.of(center=m.center_distance_adjusted, diameter_1=m.sprocket_diameter_1, diameter_2=m.sprocket_diameter_2,
    teeth_1=m.teeth_1, teeth_2=m.driven_teeth), digits=8), "X_e", "1", "Number of links at the adjusted distance by the exact polygon", "geometry")
loop.links_residual = inner(abs(m.links_polygon - m.links)), "ΔX", "1", "Deviation of the formula from the exact polygon, in links", "geometry"
loop.wrap_small = (pi - 2 * np.arcsin(abs(m.sprocket_diameter_2 - m.sprocket_diameter_1) / (2 * m.center)), "β_s", "deg",
    "Wrap of the smaller sprocket", "geometry")
loop.center_in_pitches = inner(m.center / m.pitch), "a_p", "1", "Centre distance in pitches", "geometry"
loop.links_odd = inner(m.links - 2 * np.floor(m.links / 2)), "X_2", "1", "Links in excess of an even number", "this method"


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
        cycle.require(f"{key}_out_of_place", m.teeth_1 < 0, key=key, needs=(use, key),
            message=f"has no use beside {use.replace('=', ': ')}; remove it, or set use to {'drive' if use == CONVEYOR else 'conveyor'}")
BOTH_CURVES: Way = {"needs": (CONVEYOR, "acceleration_curve", "velocity_curve")}
cycle.one_cycle = (computed(function=one_cycle, takes=("acceleration_curve", "velocity_curve", "teeth_1"), method="their abscissae are compared",
    output=False, **BOTH_CURVES), "k_z", "1", "Both curves run over the same cycle")
cycle.require("same_cycle", m.one_cycle > 0, key="velocity_curve",
    message="runs over another cycle than acceleration; give both over one cycle, or one of them as a number", **BOTH_CURVES)
for way in CURVES:
    cycle.cycle_angle = (abscissa(period=2 * np.pi, shown_at="tension_peak_at", **way), "φ", "deg",
        "Cycle angle, one revolution per period of the curves")
cycle.torque_over = from_curve(given="torque_curve", abscissa="cycle_angle", output=False, **TORQUE), "T_φ", "N*m", "Torque as given"
cycle.velocity_over = from_curve(given="velocity_curve", abscissa="cycle_angle", output=False, **VELOCITY), "v_φ", "m/s", "Velocity as given"
cycle.acceleration_over = (from_curve(given="acceleration_curve", abscissa="cycle_angle", output=False, needs=(CONVEYOR, "acceleration_curve")),
    "a_φ", "m/s**2", "Acceleration as given")

cycle.velocity_size = reduction("abs_max", of="velocity_over", output=False, **VELOCITY), "v_m", "m/s", "Maximum absolute velocity"
cycle.velocity_margin = (inner(abs(m.velocity_over) - STILL * m.velocity_size, **VELOCITY), "v_k", "m/s",
    "Absolute velocity above the threshold of rest", "this method")
cycle.rest_edge = crossings(of="velocity_margin", output=False, **VELOCITY), "φ_r", "deg", "Start or end of a rest"
cycle.breakpoints("rests", "cycle_angle", "rest_edge", **VELOCITY)

motion = Chapter("Motion",
    text="The chain forms a polygon on the sprocket: at constant shaft speed its velocity rises and falls with each tooth, and its acceleration "
        "jumps where a joint meets the sprocket.")
motion.velocity = value(mean_velocity.of(teeth=m.teeth_1), **DRIVEN), "v", "m/s", "Mean velocity of the chain", "kinematics"
motion.velocity = value(abs(m.inputs.velocity), needs=(CONVEYOR, "velocity")), "v", "m/s", "Absolute velocity", "input"
motion.velocity = value(m.velocity_size, **VELOCITY), "v", "m/s", "Maximum velocity over the cycle", "this method"
motion.angular_speed = value(m.speed, **DRIVEN), "ω", "rad/s", "Angular speed of the driving sprocket", "input"
motion.angular_speed = (value(as_angle(m.velocity / (m.sprocket_diameter_1 / 2)), **CONVEYED), "ω", "rad/s",
    "Maximum angular speed of the driving sprocket", "kinematics")
motion.velocity_max = m.angular_speed * m.sprocket_diameter_1 / 2, "v_max", "m/s", "Maximum velocity within a tooth", "geometry"
motion.velocity_min = m.velocity_max * np.cos(pi / m.teeth_1), "v_min", "m/s", "Minimum velocity within a tooth", "geometry"
motion.speed_unevenness = 1 - np.cos(pi / m.teeth_1), "δ", "%", "Relative drop in velocity within a tooth", "geometry"
motion.chordal_acceleration = chordal_step, "a_ch", "m/s**2", "Jump in the acceleration where a joint meets the sprocket", "geometry"

useful = Chapter("Useful tension", text="All tensions are those of one strand.")
useful.torque_carried = inner(abs(m.torque), needs=(DRIVE, "torque")), "T_d", "N*m", "Absolute torque of the driving sprocket", "input"
useful.torque_carried = inner(m.power / m.angular_speed, needs=(DRIVE, "power")), "T_d", "N*m", "Torque of the driving sprocket", "power"
useful.torque_carried = reduction("abs_max", of="torque_over", output=False, **TORQUE), "T_d", "N*m", "Maximum absolute torque over the cycle"
useful.moving_mass_with_chain = (inner(hanging_mass.of(mass=m.moving_mass, length=m.chain_length), **CONVEYED), "m_h", "kg",
    "Moving mass, with the chains; all of it is assumed to hang on one side", "this method")
useful.moving_mass_total = (value(total_mass.of(hanging=m.moving_mass_with_chain, inertia=m.driven_inertia, diameter=m.sprocket_diameter_2),
    **CONVEYED), "m_tot", "kg", "Accelerated mass, with the parts that turn with the driven sprocket", "dynamics")
useful.resistance = (value(resistance.of(friction=m.friction_coefficient, mass=m.moving_mass_with_chain), **CONVEYED), "F_w", "N",
    "Force against the motion", "this method")
MOVES = "Chain in motion (1) or at rest (0)"
useful.moving_over = (choice(case(1, "the chain moves", m.velocity_margin > 0), case(0, "the chain stands"), per_piece=True, output=False,
    **VELOCITY), "k_φ", "1", MOVES, "this method")
useful.moving = (choice(case(1, "the chain moves", m.velocity > 0), case(0, "the chain stands"), needs=(CONVEYOR, "velocity"), output=False), "k_v",
    "1", MOVES, "this method")


def pulled(acceleration: str, moving: str) -> Any:
    """Useful tension of a conveyor."""
    return conveyor_tension.of(total=m.moving_mass_total, acceleration=m[acceleration], moving=m[moving])


for way, pull in ((TORQUE, drive_tension.of(torque=m.torque_over, diameter=m.sprocket_diameter_1)),
                  ({"needs": (*VELOCITY["needs"], "acceleration_curve")}, pulled("acceleration_over", "moving_over")),
                  ({"needs": (*VELOCITY["needs"], "acceleration")}, pulled("acceleration", "moving_over")),
                  (ACCELERATION, pulled("acceleration_over", "moving"))):
    useful.useful_tension_curve = value(pull, **way), "F_tφ", "N", "Useful tension", "statics"
    useful.useful_tension = reduction("max", of="useful_tension_curve", **way), "F_t", "N", "Maximum useful tension over the cycle"
useful.useful_tension = (value(drive_tension.of(torque=m.torque_carried, diameter=m.sprocket_diameter_1), **NUMBERS[0]), "F_t", "N",
    "Useful tension", "statics")
useful.useful_tension = value(pulled("acceleration", "moving"), **NUMBERS[1]), "F_t", "N", "Useful tension", "statics"

tension = Chapter("Tension of the strands",
    text="In addition to the useful tension a strand carries its weight, the centrifugal force, the polygon shocks and its pretension. The static "
        "tension excludes application factor and shocks.")
tension.centrifugal_tension = centrifugal, "F_c", "N", "Centrifugal tension, at the maximum velocity", "dynamics"
tension.sag_tension = sag_tension.of(), "F_s", "N", "Tension due to sag, at the upper end of the strand", "statics (parabola)"
tension.chordal_tension = (chordal.of(step=m.chordal_acceleration), "F_ch", "N", "Polygon shock force on the free strand, at the maximum velocity",
    "this method")
tension.centrifugal_over = inner(centrifugal.of(velocity=m.velocity_over), **VELOCITY), "F_cφ", "N", "Centrifugal tension", "dynamics"
tension.angular_speed_over = (inner(as_angle(m.velocity_over / (m.sprocket_diameter_1 / 2)), **VELOCITY), "ω_φ", "rad/s",
    "Angular speed of the driving sprocket", "kinematics")
tension.chordal_step_over = (inner(chordal_step.of(angular_speed=m.angular_speed_over), **VELOCITY), "a_chφ", "m/s**2",
    "Jump in the acceleration where a joint meets the sprocket", "geometry")
tension.chordal_over = inner(chordal.of(step=m.chordal_step_over), **VELOCITY), "F_chφ", "N", "Polygon shock force on the free strand", "this method"
SAME = {"centrifugal": "centrifugal_tension", "chordal": "chordal_tension"}
OVER = {"centrifugal": "centrifugal_over", "chordal": "chordal_over"}


def whole(useful_tension: str, parts: dict[str, str]) -> Any:
    """Whole tension of the tight strand, of these parts."""
    return whole_tension.of(useful=m[useful_tension], sag=m.sag_tension, centrifugal=m[parts["centrifugal"]], chordal=m[parts["chordal"]])


def quiet(useful_tension: str, parts: dict[str, str]) -> Any:
    """Tension without shocks, of these parts."""
    return quiet_tension.of(useful=m[useful_tension], sag=m.sag_tension, centrifugal=m[parts["centrifugal"]])


for way, parts in ((TORQUE, SAME), (VELOCITY, OVER), (ACCELERATION, SAME)):
    tension.strand_tension = value(whole("useful_tension_curve", parts), **way), "F_φ", "N", "Tension of the tight strand", "statics"
    tension.static_tension_curve = (inner(quiet("useful_tension_curve", parts), **way), "F_0φ", "N", "Tension of the tight strand without shocks",
        "statics")
    tension.tension_peak = reduction("max", of="strand_tension", **way), "F", "N", "Maximum tension over the cycle"
    tension.tension_peak_angle = value(m.tension_peak_at, **way), "φ_F", "deg", "Cycle angle of this maximum", "this method"
    tension.tension_static = reduction("max", of="static_tension_curve", **way), "F_0", "N", "Maximum static tension over the cycle"
for way in NUMBERS:
    tension.tension_peak = value(whole("useful_tension", SAME), **way), "F", "N", "Tension of the tight strand", "statics"
    tension.tension_static = value(quiet("useful_tension", SAME), **way), "F_0", "N", "Static tension of the tight strand", "statics"
tension.shaft_load = (value(m.strands * (m.application * m.useful_tension + 2 * m.sag_tension + 2 * m.pretension), **DRIVEN), "F_a", "N",
    "Shaft load from all strands", "statics")


USUAL_PITCHES = (30, 50)
RATED = ("power_rating",)
RATED_TEETH = (11, 45)

safety = Chapter("Safety factor against breaking",
    text="No standard gives required safety factors; the defaults are manufacturers' values. iwis takes 7 against the breaking load by rule of "
        "thumb, since fatigue governs in most cases. Diamond Chain limits the working load to a sixth of the breaking load, with slip-fit or "
        "cranked connecting links to a ninth: required_safety_dynamic is then 9.")
safety.safety_dynamic = m.breaking_load / m.tension_peak, "S_dyn", "1", "Safety factor against breaking under all tensions", "Diamond Chain"
safety.safety_static = m.breaking_load / m.tension_static, "S_stat", "1", "Safety factor against breaking under the static tensions", "iwis"
safety.bearing_pressure = m.tension_peak / m.bearing_area, "p_r", "MPa", "Pressure of the joints", "statics"
safety.breaking_load_needed = (inner(np.maximum(m.required_safety_dynamic * m.tension_peak, m.required_safety_static * m.tension_static)), "F_B,min",
    "kN", "Breaking load required by both safety factors", "Diamond Chain, iwis")
safety.bearing_area_needed = (inner(m.tension_peak / m.allowable_bearing_pressure, needs=("allowable_bearing_pressure",)), "A_min", "mm**2",
    "Bearing area required by the allowable pressure", "statics")

rating = Chapter("Power rating", needs=(DRIVE, *RATED), absent="not calculated: power_rating is not given, or the chain conveys",
    text="Rating of ANSI B29.1 chains, taken for series B of the same pitch: 15 000 h, a chain of 100 links, lubricated as recommended. It holds "
        "for the smaller sprocket.")
rating.require("teeth_rated", (m.teeth_small >= RATED_TEETH[0]) & (m.teeth_small <= RATED_TEETH[1]), key="teeth_1",
    message="leaves the smaller sprocket {teeth_small} teeth, and the rating holds for 11 to 45; change the teeth, or leave out power_rating")
rating.speed_small = inner(m.speed * m.teeth_1 / m.teeth_small), "n_s", "rpm", "Speed of the smaller sprocket", "kinematics"
rating.plate_power = plate_power.of(teeth=m.teeth_small, speed=m.speed_small), "P_1", "kW", "Power limit of the plates of one strand", "ANSI B29.1"
rating.roller_power = roller_power.of(teeth=m.teeth_small, speed=m.speed_small), "P_2", "kW", "Power limit of the rollers of one strand", "ANSI B29.1"
rating.strand_factor = (choice(*(case(factor, f"{count} strand{'s' * (count > 1)}", m.strands == count)
    for count, factor in ((1, 1.0), (2, 1.7), (3, 2.5))), case(3.3, "4 strands"), output=False), "k_s", "1",
    "Strand factor", "ANSI B29.1")
rating.rated_power = m.strand_factor * np.minimum(m.plate_power, m.roller_power), "P_zul", "kW", "Rated power", "ANSI B29.1"
rating.rating_governing = (choice(case("plate", "the power limit of the plates is lower than that of the rollers", m.plate_power <= m.roller_power),
    case("roller", "the power limit of the rollers is lower than that of the plates")), "G", "1", "Governing criterion of the rating", "ANSI B29.1")
rating.design_power = inner(m.application * m.torque_carried * m.angular_speed), "P_d", "kW", "Power with the application factor", "power"

limits = Chapter("Practical limits")
limits.teeth_usual = inner(17, needs=(DRIVE,)), "z_u", "1", "Minimum usual number of teeth of a drive", "practice"
limits.teeth_usual = inner(12, needs=(CONVEYOR,)), "z_u", "1", "Minimum usual number of teeth of a conveyor", "practice"
limits.slack_tension = inner(m.sag_tension + m.pretension, needs=(CONVEYOR,)), "F_l", "N", "Static tension of the returning strand", "statics"
