"""The calculation of the parallel key: its inputs, its dimensions, the load, and the pressures on its flanks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from diecut_report.api import (
    CURVE_ROUNDING,
    ROUNDING,
    Block,
    Chapter,
    Constant,
    CurveInput,
    FromTable,
    Inputs,
    OneOf,
    Quantity,
    Text,
    abscissa,
    case,
    choice,
    computed,
    crossings,
    formula,
    from_curve,
    inner,
    m,
    number,
    parts,
    pi,
    pick,
    reduction,
    samples,
    si,
    standard_series,
    standard_table,
    total,
    value,
)
from diecut_report.mechanics.load_cases import GREATEST, governing_case

# fmt: off


class KeyLoadCase(Block):
    """A load case beside the run."""

    name = Text("Engagement of the clutch, start of the motor, or stop by the brake", ("engage", "start", "stop"))
    torque = Quantity("T_j", "N*m", "Torque of the load case, its size", ge=0)


class ParallelKey(Inputs):
    """Keys of ``parallel_key``."""

    one_of = (
        OneOf(("torque", "application_factor"), ("torque_curve",), shared=("application_factor",)),
        OneOf(("width", "height", "depth_shaft", "depth_hub"), optional=True),
        OneOf(("load_direction_factor",), ("flank_changes",), ("required_life", "cycle_speed"), optional=True),
    )
    curve_keys = {"torque": "torque_curve"}
    from_tables = (
        FromTable(
            "key",
            "keys",
            {name: name for name in ("width", "height", "depth_shaft", "depth_hub", "chamfer", "yield_key")},
        ),
    )

    shaft_diameter = Quantity("d", "mm", "Diameter of the shaft; the table has keys for 10 (not included) to 200 mm", gt=0)
    key = Text("Key: an entry of keys in a table of your own, in place of its dimensions", optional=True)
    key_length = Quantity("l", "mm", "Length of the key; if omitted, the smallest sufficient standard length is selected", gt=0, optional=True)
    form = Text("Form of the key's ends: A round, B square", ("A", "B"), default="A")
    key_count = Quantity("i", "1", "Number of keys around the shaft", ge=1, le=2, integer=True, default=1)
    torque = Quantity("T", "N*m", "Torque, signed; a reference to a curve over a cycle is used as torque_curve", optional=True)
    torque_curve = CurveInput("T_φ", "N*m", "Torque over a cycle, signed, in the place of torque", optional=True)
    torque_peak = Quantity("T_max", "N*m", "Rare peak of the torque; default: the maximum absolute torque", gt=0, optional=True)
    load_cases = parts(KeyLoadCase, "Load cases beside the run, each as a maximum torque", optional=True)
    application_factor = Quantity("K_A", "1", "Application factor; default 1 with a curve, which includes the dynamics", ge=1, optional=True)
    yield_shaft = Quantity("R_eW", "MPa", "Yield strength of the shaft", gt=0)
    yield_hub = Quantity("R_eN", "MPa", "Yield strength of the hub; of a brittle one its tensile strength", gt=0)
    yield_key = Quantity("R_eP", "MPa", "Yield strength of the key (C45+C; set that of your own)", gt=0, default=335)
    brittle_hub = Text("Hub of grey cast iron", default=False)
    load_peak_factor = Quantity("f_L", "1", "Load peak factor: increases the allowable pressure for rare peaks", ge=1, le=1.5, default=1.0)
    load_distribution_factor = Quantity("K_λ", "1",
        "Load distribution factor: unevenness of the load over the length; 1.2 is from one source only, give that of your joint with its basis",
        ge=1, le=2, default=1.2)
    load_direction_factor = Quantity("f_wg", "1", "Load direction factor of a reversing torque, in place of the life", ge=0.2, le=1, optional=True)
    flank_changes = Quantity("N_Wg", "1", "Number of load direction changes in the whole life, instead of the life", ge=0, plausible=("1", "1e12"),
        optional=True)
    required_life = Quantity("L_h", "h", "Life for which the load direction changes of torque_curve are counted", gt=0, optional=True)
    cycle_speed = Quantity("n_c", "rpm", "Cycle rate of the torque, as a speed: 1 r/min is one cycle per minute", gt=0, optional=True)
    chamfer = Quantity("s", "mm", "Chamfer of the key, subtracted from the bearing heights in shaft and hub", ge=0, default=0)
    hub_length = Quantity("l_H", "mm", "Length of the hub", gt=0, optional=True)
    width = Quantity("b", "mm", "Width of the key; default: from the table", gt=0, optional=True)
    height = Quantity("h", "mm", "Height of the key; default: from the table", gt=0, optional=True)
    depth_shaft = Quantity("t_1", "mm", "Depth of the shaft keyway; default: from the table", gt=0, optional=True)
    depth_hub = Quantity("t_2", "mm", "Depth of the hub keyway; default: from the table", gt=0, optional=True)
    n_points = samples(360)


@formula
def key_force(torque: Any, shaft_diameter: Any, key_count: Any, key_share: Any) -> Any:
    """Force on the worst loaded key."""
    return 2 * torque / (shaft_diameter * key_count * key_share)


@formula
def direction_factor(changes_of_flank: Any) -> Any:
    """Load direction factor by the changes of flank in the life (DIN 6892, method B)."""
    return np.minimum(1, 2 * np.maximum(changes_of_flank, 1) ** -0.1)


KEYS = standard_table("parallel_keys")
SHAFTS = np.array([si(value, "mm") for value in KEYS.column("d").values])
THINNEST = si(10, "mm")
LENGTHS = standard_series("din_6885_lengths")
LONGEST = si(LENGTHS.values[-1], LENGTHS.unit)
GIVEN = ("width",)
DIMENSIONS = {"width": ("b", "b", "Width of the key"), "height": ("h", "h", "Height of the key"),
              "depth_shaft": ("t_1", "t1", "Depth of the shaft keyway"), "depth_hub": ("t_2", "t2", "Depth of the hub keyway")}
LEAST_SHAFT = Constant(THINNEST, "d_0", "m")
GREATEST_SHAFT = Constant(float(SHAFTS[-1]) * (1 + ROUNDING), "d_1", "m")
LONGEST_KEY = Constant(LONGEST, "l_1", "m")


def of_shaft(column: str) -> Callable[[Any], Any]:
    """Return what gives a column of the table by shaft diameters of shape (variants, 1); NaN outside of the table."""
    values = np.array([si(value, "mm") for value in KEYS.column(column).values])

    def found(diameter: Any) -> Any:
        row = np.searchsorted(SHAFTS, diameter * (1 - ROUNDING))
        inside = (diameter > THINNEST) & (row < len(SHAFTS))
        return np.where(inside, values[np.minimum(row, len(SHAFTS) - 1)], np.nan)

    return found


dimensions = Chapter("Dimensions")
dimensions.require("in_table", (m.shaft_diameter > LEAST_SHAFT) & (m.shaft_diameter <= GREATEST_SHAFT), key="shaft_diameter", lacks=GIVEN,
    message="is {shaft_diameter}, for which the table of DIN 6885-1 has no key: it goes from above 10 to 200 mm; give width, height, depth_shaft "
    "and depth_hub")
for name, (symbol, column, words) in DIMENSIONS.items():
    dimensions[name] = (computed(function=of_shaft(column), takes=("shaft_diameter",), lacks=GIVEN,
        method="the row of the table whose range of diameters holds the shaft, its upper end included"), symbol, "mm", words, "DIN 6885-1")
    dimensions[name] = value(m.inputs[name], needs=GIVEN), symbol, "mm", f"{words}: as given", "input"
dimensions.height_shaft = inner(m.depth_shaft - m.chamfer), "h_W", "mm", "Bearing height in the shaft", "geometry"
dimensions.height_hub = inner(m.height - m.depth_shaft - m.chamfer), "h_N", "mm", "Bearing height in the hub", "geometry"
dimensions.height_key = (inner(np.minimum(m.height_shaft, m.height_hub)), "h_P", "mm",
    "Smaller bearing height, which governs the pressure on the key", "geometry")
dimensions.require("key_stands_out", m.depth_shaft < m.height, key="depth_shaft", needs=GIVEN,
    message="is {depth_shaft}, in which a key of height {height} sinks whole; take a keyway that is less deep")
dimensions.require("bears", m.height_key > 0, key="chamfer",
    message="is {chamfer}, which leaves no height to bear of the {height} high key; take a smaller chamfer")


CURVE = ("torque_curve",)
CASES = ("load_cases",)
ONE_SPEED = 1e-3  # relative difference of two speeds that are one
METHOD = "DIN 6892:2012, method B"
BY_LIFE = ("required_life",)
FACTOR_GIVEN = ("load_direction_factor",)
KNOWN = (*BY_LIFE, "flank_changes", *FACTOR_GIVEN)
JUDGED = ("flank_known",)
SELDOM = 1024  # changes of flank up to which the formula gives 1
LEAST_LIFE = Constant(2000 * 3600, "L_min", "s")  # as that of required_life: no machine is built for less
DIAGRAM = 1e7  # changes of flank up to which the factor is confirmed

cycle = Chapter("Torque over the cycle", needs=CURVE, text="One period of the referenced curve is mapped to one revolution of the cycle angle.")
cycle.cycle_angle = abscissa(period=2 * np.pi, shown_at="torque_size_at"), "φ", "deg", "Cycle angle, one revolution per period of the torque"
cycle.torque_over_cycle = from_curve(given="torque_curve", abscissa="cycle_angle"), "T_φ", "N*m", "Torque as given"
cycle.torque_size = reduction("abs_max", of="torque_over_cycle", output=False), "T_m", "N*m", "Maximum absolute torque"
cycle.torque_greatest = reduction("max", of="torque_over_cycle", output=False), "T_up", "N*m", "Maximum torque"
cycle.flank_change = crossings(of="torque_over_cycle", output=False), "φ_f", "deg", "Cycle angle at which the torque changes its sign"
cycle.curve_rate = (computed(function=lambda torque: torque.rate, takes=CURVE,
    method="the speed of what it runs over, divided by the turns of a cycle", output=False), "n_φ", "rpm",
    "Cycle rate of the referred torque, as a speed; 0 where a list of values tells none", "kinematics")
cycle.require("one_speed", (m.curve_rate <= 0) | (abs(m.cycle_speed - m.curve_rate) <= ONE_SPEED * m.curve_rate), key="cycle_speed",
    needs=("cycle_speed",),
    message="is {cycle_speed}, but the curve that torque refers to comes again with {curve_rate}; refer to the speed with which that curve is "
    "calculated")
cycle.torque_least = reduction("min", of="torque_over_cycle", output=False), "T_low", "N*m", "Minimum torque"

load = Chapter("Load", text="A peak in every revolution is a regular load and is included in the equivalent torque; torque_peak is a rare one.")
load.torque_size = inner(abs(m.torque), lacks=CURVE), "T_m", "N*m", "Absolute torque", "input"
load.require("loaded", m.torque_size > 0, key="torque", message="is 0; give the torque that the key carries", lacks=CURVE)
load.require("loaded_by_curve", m.torque_size > 0, key="torque_curve", needs=CURVE, message="is 0 everywhere; give the torque that the key carries")
load.application_factor = value(m.inputs.application_factor, needs=("application_factor",)), "K_A", "1", "Application factor: as given", "input"
load.application_factor = value(1, lacks=("application_factor",)), "K_A", "1", "Application factor: the curve includes the dynamics", "this method"
load.torque_equivalent = m.application_factor * m.torque_size, "T_eq", "N*m", "Equivalent torque", METHOD
load.require("peak_is_greatest", m.inputs.torque_peak >= m.torque_size * (1 - ROUNDING), key="torque_peak", needs=("torque_peak",),
    message="is {inputs.torque_peak}, less than the torque of {torque_size} that acts anyway; give the maximum one, or remove the key")
PEAK = ("T_run", "N*m", "Maximum torque of the run")
load.torque_run = inner(m.inputs.torque_peak, needs=("torque_peak",)), *PEAK, "input"
load.torque_run = inner(m.torque_size, lacks=("torque_peak",)), *PEAK, "this method"
load.torque_case = total("max", of="load_cases.torque", needs=CASES, output=False), "T_j,max", "N*m", "Maximum torque of the load cases"
load.torque_peak = value(m.torque_run, lacks=CASES), "T_max", "N*m", "Maximum torque: that of the run", "this method"
load.torque_peak = value(np.maximum(m.torque_run, m.torque_case), needs=CASES), "T_max", "N*m", "Maximum torque of run and load cases", "this method"
PEAK_CASE = ("C", "1", "Load case of the maximum torque")
load.peak_case = (computed(governing_case, ("torque_run", "load_cases.name", "load_cases.torque"), GREATEST, is_text=True, needs=CASES), *PEAK_CASE)
load.peak_case = computed(governing_case, ("torque_run",), GREATEST, is_text=True, lacks=CASES, printed=False, output=False), *PEAK_CASE
load.reversing = (value((m.torque_greatest > CURVE_ROUNDING * m.torque_size) & (-m.torque_least > CURVE_ROUNDING * m.torque_size), needs=CURVE),
    "R_T", "1", "Reversing torque over the cycle", "this method")
load.reversing = value(m.torque_size < 0, lacks=CURVE), "R_T", "1", "Reversing torque: a single torque does not reverse", "this method"
FLANKS = ("N_W", "1", "Number of load direction changes in the life")
load.changes_of_flank = (value(m.reversing * m.flank_change_count * m.cycle_speed * m.required_life / (2 * pi), needs=(*CURVE, *BY_LIFE)), *FLANKS,
    "this method")
load.changes_of_flank = value(0, needs=BY_LIFE, lacks=CURVE), *FLANKS, "this method"
load.least_changes = (inner(m.reversing * m.flank_change_count * np.maximum(1, m.curve_rate * LEAST_LIFE / (2 * pi)), needs=CURVE, lacks=BY_LIFE),
    "N_W,min", "1", "Load direction changes of the curve in the least plausible life; in a cycle, if its speed is not known", "this method")
load.require("as_many_as_the_curve_has", m.flank_changes >= m.least_changes, key="flank_changes", needs=(*CURVE, "flank_changes"),
    message="is {flank_changes}, but the torque changes its sign {flank_change_count} times a cycle, so at least {least_changes} times in 2000 h "
    "(in one cycle, if its speed is not known); give required_life and cycle_speed, by which the changes are counted")
load.changes_of_flank = value(m.flank_changes, needs=("flank_changes",)), *FLANKS, "input"
FACTOR = ("f_w", "1", "Load direction factor")
SELDOM_CHANGED = m.changes_of_flank <= SELDOM
COUNTED = case(direction_factor, "from the load direction changes in the life", m.changes_of_flank <= DIAGRAM)
for needs in (BY_LIFE, ("flank_changes",)):
    load.direction_factor = (choice(case(1, "the load direction changes too rarely to count", SELDOM_CHANGED), COUNTED,
        case(direction_factor, "from the load direction changes; beyond 10⁷ of them the formula is extrapolated"), needs=needs), *FACTOR, METHOD)
load.direction_factor = value(m.load_direction_factor, needs=FACTOR_GIVEN), *FACTOR, "input"
load.factor_of_least = (inner(direction_factor.of(changes_of_flank=m.least_changes), needs=(*CURVE, *FACTOR_GIVEN)), "f_w,max", "1",
    "Load direction factor with the least number of changes", METHOD)
load.fact("flank_known", m.reversing <= 0, "the torque reverses, and the number of reversals in the life is not known", lacks=KNOWN)
load.direction_factor = (choice(case(1, "the torque keeps its sign", m.reversing <= 0),
    case(0.2, "as for 10¹⁰ load direction changes, since the torque reverses and their number in the life is not known"), lacks=KNOWN), *FACTOR,
    "this method")
load.key_share = (choice(case(1, "one key", m.key_count < 2), case(0.75, "the second key of two carries less"), output=False), "φ_k", "1",
    "Load share of the second key", METHOD)
load.key_share_peak = (choice(case(1, "one key", m.key_count < 2), case(0.9, "the second key of two carries nearly as much"), output=False),
    "φ_k,max", "1", "Load share of the second key under the maximum load", METHOD)
load.key_force = key_force.of(torque=m.torque_equivalent), "F", "N", "Force on one key, equivalent", METHOD
load.key_force_peak = key_force.of(torque=m.torque_peak, key_share=m.key_share_peak), "F_max", "N", "Force on one key, maximum", METHOD


PARTS = {"shaft": "W", "hub": "N", "key": "P"}
LOADS = {"": ("key_force", "direction_factor", "", "equivalent"), "_peak": ("key_force_peak", "load_peak_factor", "max", "maximum")}
"""Of the regular load and the peak: the force, the factor of what is allowed, the symbol's end, and words."""
PRESSED = [(part, peak) for peak in LOADS for part in PARTS]
SIX = ("shaft", "hub", "key", "shaft_peak", "hub_peak", "key_peak")

allowed = Chapter("Allowable stresses",
    text="Each part withstands more than its yield strength because of the support of the material around the loaded face.")
needed = Chapter("Required length",
    text="The smallest bearing length at which all pressures and the shear of the key are within the allowable values.")
allowed.support_shaft = inner(1.3), "f_SW", "1", "Support factor of the shaft, of steel", METHOD
allowed.support_hub = inner(1.5, needs=("brittle_hub=false",)), "f_SN", "1", "Support factor of the hub, of steel", METHOD
allowed.support_hub = inner(2, needs=("brittle_hub=true",)), "f_SN", "1", "Support factor of the hub, of cast iron", METHOD
allowed.support_key = inner(1.1), "f_SP", "1", "Support factor of the key", METHOD
for part, peak in PRESSED:
    _, factor, end, words = LOADS[peak]
    allowed[f"allowed_{part}{peak}"] = (inner(m[factor] * m[f"support_{part}"] * m[f"yield_{part}"]), f"p_{PARTS[part]}zul{end}", "MPa",
        f"Allowable pressure on the {part}, {words} load", METHOD)
allowed.allowed_shear = inner(m.yield_key / np.sqrt(number(3))), "τ_zul", "MPa", "Allowable shear stress of the key", "strength of materials"
for part, peak in PRESSED:
    force, _, end, words = LOADS[peak]
    needed[f"length_{part}{peak}"] = (inner(m.load_distribution_factor * m[force] / (m[f"height_{part}"] * m[f"allowed_{part}{peak}"])),
        f"l_{PARTS[part]}{end}", "mm", f"Bearing length required by the {part}, {words} load", METHOD)
needed.length_shear = (inner(m.key_force_peak / (m.width * m.allowed_shear)), "l_τ", "mm", "Bearing length required by the shear of the key",
    "strength of materials")
needed.length_pressed = (inner(np.maximum(np.maximum(np.maximum(m.length_shaft, m.length_hub), m.length_key),
    np.maximum(np.maximum(m.length_shaft_peak, m.length_hub_peak), m.length_key_peak))), "l_p", "mm", "Bearing length required by the pressures",
    METHOD)
needed.bearing_length_needed = inner(np.maximum(m.length_pressed, m.length_shear)), "l_tr,req", "mm", "Required bearing length", "this method"
needed.round_ends = inner(m.width, needs=("form=A",)), "l_r", "mm", "Length of the round ends, which do not carry", "DIN 6892"
needed.round_ends = inner(0, needs=("form=B",)), "l_r", "mm", "Length of the round ends: square ends carry fully", "DIN 6892"
needed.least_key_length = inner(m.bearing_length_needed + m.round_ends), "l_min", "mm", "Minimum length of the key", METHOD
needed.require("standard_key_exists", m.least_key_length <= LONGEST_KEY, key="shaft_diameter", lacks=("key_length",),
    message="is {shaft_diameter}, on which the key would have to be {least_key_length} long; the longest standard key has 280 mm: take a thicker "
    "shaft, two keys or stronger material")
needed.standard_key_length = (pick("above", of="least_key_length", series=LENGTHS, beyond="last", output=False), "l_std,req", "mm",
    "Next standard length", "DIN 6885-1")
needed.required_key_length = (value(m.standard_key_length, exists=m.least_key_length <= LONGEST_KEY), "l_req", "mm",
    "Smallest sufficient standard length", "DIN 6885-1")

pressures = Chapter("Pressures",
    text="Shaft and hub each bear on their own height of the key; the pressure on the key is highest where this height is smaller.")
pressures.key_length = value(m.inputs.key_length, needs=("key_length",)), "l", "mm", "Length of the key: as given", "input"
pressures.key_length = (value(m.required_key_length, lacks=("key_length",)), "l", "mm", "Length of the key: the smallest sufficient standard length",
    "this method")
pressures.require("longer_than_wide", m.key_length > m.round_ends, key="key_length", needs=("key_length", "form=A"),
    message="is {key_length}, of which the round ends of the {width} wide key leave nothing to bear; take a longer key, or form B")
BEARING = ("l_tr", "mm")
pressures.bearing_length = (value(np.minimum(m.key_length - m.round_ends, m.hub_length), needs=("hub_length",)), *BEARING,
    "Bearing length, no longer than the hub", METHOD)
pressures.bearing_length = value(m.key_length - m.round_ends, lacks=("hub_length",)), *BEARING, "Bearing length", METHOD
for part, peak in PRESSED:
    force, _, end, words = LOADS[peak]
    pressures[f"pressure_{part}{peak}"] = (m.load_distribution_factor * m[force] / (m[f"height_{part}"] * m.bearing_length), f"p_{PARTS[part]}{end}",
        "MPa", f"Pressure on the {part}, {words} load", METHOD)
pressures.shear_stress = m.key_force_peak / (m.width * m.bearing_length), "τ", "MPa", "Shear stress of the key, maximum load", "strength of materials"
for part, peak in PRESSED:
    pressures[f"safety_{part}{peak}"] = (inner(m[f"allowed_{part}{peak}"] / m[f"pressure_{part}{peak}"]), f"S_{PARTS[part]}{LOADS[peak][2]}", "1",
        f"Safety factor of the {part}, {LOADS[peak][3]} load", METHOD)
pressures.safety = (np.minimum(np.minimum(np.minimum(m.safety_shaft, m.safety_hub), m.safety_key),
    np.minimum(np.minimum(m.safety_shaft_peak, m.safety_hub_peak), m.safety_key_peak)), "S", "1", "Minimum safety factor", METHOD)
pressures.safety_peak = (inner(np.minimum(np.minimum(m.safety_shaft_peak, m.safety_hub_peak), m.safety_key_peak)), "S_max", "1",
    "Minimum safety factor under the maximum load", METHOD)
pressures.governing = (choice(*(case(f"{part}, {LOADS[peak][3]} load", f"the {part} has the lowest safety factor, under the {LOADS[peak][3]} load",
    m[f"safety_{part}{peak}"] <= m.safety) for part, peak in PRESSED[:-1]), case("key, maximum load",
    "the key has the lowest safety factor, under the maximum load")), "G", "1", "Governing part and load", METHOD)
pressures.longest_wanted = inner(1.3 * m.shaft_diameter), "l_max", "mm", "Maximum bearing length over which the load still distributes", METHOD
pressures.nearest_length = (pick("nearest", of="key_length", series=LENGTHS, beyond="last", output=False), "l_std", "mm", "Nearest standard length",
    "DIN 6885-1")
pressures.length_off = inner(abs(m.key_length - m.nearest_length)), "Δl", "mm", "Deviation from it", "this method"
pressures.reversal_left_out = (choice(case(1, "the torque reverses, and the number of reversals in the life is not known", m.reversing > 0),
    case(0, "the torque keeps its sign"), output=False, lacks=KNOWN), "n_w", "1", "Reversing torque not considered (1) or considered (0)",
    "this method")
for needs, lacks in ((BY_LIFE, ()), (("flank_changes",), ()), (FACTOR_GIVEN, CURVE)):
    pressures.reversal_left_out = (inner(0, needs=needs, lacks=lacks), "n_w", "1", "Reversing torque not considered: no, the factor includes it",
        "this method")
pressures.reversal_left_out = (choice(case(1, "the factor is greater than with the load direction changes that the curve has at least",
    m.load_direction_factor > m.factor_of_least), case(0, "the factor includes it"), output=False, needs=(*CURVE, *FACTOR_GIVEN)), "n_w", "1",
    "Reversing torque not considered (1) or considered (0)", "this method")
