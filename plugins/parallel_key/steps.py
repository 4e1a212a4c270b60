"""The calculation of the parallel key: its inputs, its dimensions, the load, and the pressures on its flanks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar, Literal

import numpy as np

from diecut_report.api import (
    POINTS,
    Annotated,
    Block,
    Chapter,
    Constant,
    CurveInput,
    FromTable,
    Inputs,
    OneOf,
    Quantity,
    Text,
    bind,
    case,
    formula,
    number,
    pi,
    si,
    standard_series,
    standard_table,
)
from diecut_report.mechanics.load_cases import GREATEST, governing_case

# fmt: off


class KeyLoadCase(Block):
    """A load case beside the run."""

    name: Annotated[Literal["engage", "start", "stop"], Text("Engagement of the clutch, start of the motor, or stop by the brake")]
    torque: Annotated[float, Quantity("T_j", "N*m", "Torque of the load case, its size", ge=0)]


class ParallelKey(Inputs):
    """Keys of ``parallel_key``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("torque", "application_factor"), ("torque_curve",), shared=("application_factor",)),
        OneOf(("width", "height", "depth_shaft", "depth_hub"), optional=True),
        OneOf(("load_direction_factor",), ("flank_changes",), ("required_life", "cycle_speed"), optional=True),
    )
    curve_keys: ClassVar[dict[str, str]] = {"torque": "torque_curve"}
    from_tables: ClassVar[tuple[FromTable, ...]] = (
        FromTable(
            "key",
            "keys",
            {name: name for name in ("width", "height", "depth_shaft", "depth_hub", "chamfer", "yield_key")},
        ),
    )

    shaft_diameter: Annotated[float, Quantity("d", "mm", "Diameter of the shaft; the table has keys for 10 (not included) to 200 mm", gt=0)]
    key: Annotated[str | None, Text("Key: an entry of keys in a table of your own, in place of its dimensions")] = None
    key_length: Annotated[float | None,
        Quantity("l", "mm", "Length of the key; if omitted, the smallest sufficient standard length is selected", gt=0)] = None
    form: Annotated[Literal["A", "B"], Text("Form of the key's ends: A round, B square")] = "A"
    key_count: Annotated[int, Quantity("i", "1", "Number of keys around the shaft", ge=1, le=2, integer=True)] = 1
    torque: Annotated[float | None, Quantity("T", "N*m", "Torque, signed; a reference to a curve over a cycle is used as torque_curve")] = None
    torque_curve: Annotated[Any | None, CurveInput("T_φ", "N*m", "Torque over a cycle, signed, in the place of torque")] = None
    torque_peak: Annotated[float | None, Quantity("T_max", "N*m", "Rare peak of the torque; default: the maximum absolute torque", gt=0)] = None
    load_cases: Annotated[list[KeyLoadCase], Text("Load cases beside the run, each as a maximum torque")] = []  # noqa: RUF012
    application_factor: Annotated[float | None,
        Quantity("K_A", "1", "Application factor; default 1 with a curve, which includes the dynamics", ge=1)] = None
    yield_shaft: Annotated[float, Quantity("R_eW", "MPa", "Yield strength of the shaft", gt=0)]
    yield_hub: Annotated[float, Quantity("R_eN", "MPa", "Yield strength of the hub; of a brittle one its tensile strength", gt=0)]
    yield_key: Annotated[float, Quantity("R_eP", "MPa", "Yield strength of the key (C45+C; set that of your own)", gt=0)] = 335
    brittle_hub: Annotated[bool, Text("Hub of grey cast iron")] = False
    load_peak_factor: Annotated[float, Quantity("f_L", "1", "Load peak factor: increases the allowable pressure for rare peaks", ge=1, le=1.5)] = 1.0
    load_distribution_factor: Annotated[float,
        Quantity("K_λ", "1",
            "Load distribution factor: unevenness of the load over the length; 1.2 is from one source only, give that of your joint with its "
                "basis", ge=1, le=2)] = 1.2
    load_direction_factor: Annotated[float | None,
        Quantity("f_wg", "1", "Load direction factor of a reversing torque, in place of the life", ge=0.2, le=1)] = None
    flank_changes: Annotated[float | None,
        Quantity("N_Wg", "1", "Number of load direction changes in the whole life, instead of the life", ge=0, plausible=("1", "1e12"))] = None
    required_life: Annotated[float | None,
        Quantity("L_h", "h", "Life for which the load direction changes of torque_curve are counted", gt=0)] = None
    cycle_speed: Annotated[float | None, Quantity("n_c", "rpm", "Cycle rate of the torque, as a speed: 1 r/min is one cycle per minute", gt=0)] = None
    chamfer: Annotated[float, Quantity("s", "mm", "Chamfer of the key, subtracted from the bearing heights in shaft and hub", ge=0)] = 0
    hub_length: Annotated[float | None, Quantity("l_H", "mm", "Length of the hub", gt=0)] = None
    width: Annotated[float | None, Quantity("b", "mm", "Width of the key; default: from the table", gt=0)] = None
    height: Annotated[float | None, Quantity("h", "mm", "Height of the key; default: from the table", gt=0)] = None
    depth_shaft: Annotated[float | None, Quantity("t_1", "mm", "Depth of the shaft keyway; default: from the table", gt=0)] = None
    depth_hub: Annotated[float | None, Quantity("t_2", "mm", "Depth of the hub keyway; default: from the table", gt=0)] = None
    n_points: Annotated[int, POINTS] = 360


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
ROUNDING = 1e-9  # relative: a diameter at the end of a row belongs to it
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
dimensions.require("in_table", lambda shaft_diameter: (shaft_diameter > LEAST_SHAFT) & (shaft_diameter <= GREATEST_SHAFT), key="shaft_diameter",
    lacks=GIVEN,
    message="is {shaft_diameter}, for which the table of DIN 6885-1 has no key: it goes from above 10 to 200 mm; give width, height, depth_shaft "
        "and depth_hub")
for name, (symbol, column, words) in DIMENSIONS.items():
    dimensions.computed(name, symbol, "mm", words, function=of_shaft(column), takes=("shaft_diameter",), lacks=GIVEN, source="DIN 6885-1",
        method="the row of the table whose range of diameters holds the shaft, its upper end included")
    dimensions.value(name, symbol, "mm", f"{words}: as given", bind(lambda given: given, given=f"inputs.{name}"), needs=GIVEN, source="input")
dimensions.value("height_shaft", "h_W", "mm", "Bearing height in the shaft", lambda depth_shaft, chamfer: depth_shaft - chamfer, source="geometry",
    output=False)
dimensions.value("height_hub", "h_N", "mm", "Bearing height in the hub", lambda height, depth_shaft, chamfer: height - depth_shaft - chamfer,
    source="geometry", output=False)
dimensions.value("height_key", "h_P", "mm", "Smaller bearing height, which governs the pressure on the key",
    lambda height_shaft, height_hub: np.minimum(height_shaft, height_hub), source="geometry", output=False)
dimensions.require("key_stands_out", lambda height, depth_shaft: depth_shaft < height, key="depth_shaft", needs=GIVEN,
    message="is {depth_shaft}, in which a key of height {height} sinks whole; take a keyway that is less deep")
dimensions.require("bears", lambda height_key: height_key > 0, key="chamfer",
    message="is {chamfer}, which leaves no height to bear of the {height} high key; take a smaller chamfer")


CURVE = ("torque_curve",)
CASES = ("load_cases",)
REVERSED = 1e-6  # share of the torque's size up to which the other sign is rounding
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
cycle.abscissa("cycle_angle", "φ", "deg", "Cycle angle, one revolution per period of the torque", period=2 * np.pi, shown_at="torque_size_at")
cycle.from_curve("torque_over_cycle", "T_φ", "N*m", "Torque as given", given="torque_curve", abscissa="cycle_angle")
cycle.reduction("torque_size", "T_m", "N*m", "Maximum absolute torque", "abs_max", of="torque_over_cycle", output=False)
cycle.reduction("torque_greatest", "T_up", "N*m", "Maximum torque", "max", of="torque_over_cycle", output=False)
cycle.crossings("flank_change", "φ_f", "deg", "Cycle angle at which the torque changes its sign", of="torque_over_cycle", output=False)
cycle.computed("curve_rate", "n_φ", "rpm", "Cycle rate of the referred torque, as a speed; 0 where a list of values tells none",
    function=lambda torque: torque.rate, takes=CURVE, method="the speed of what it runs over, divided by the turns of a cycle", source="kinematics",
    output=False)
cycle.require("one_speed",
    bind(lambda own, curve_rate, tolerance: (curve_rate <= 0) | (abs(own - curve_rate) <= tolerance * curve_rate), own="cycle_speed",
        tolerance=ONE_SPEED), key="cycle_speed", needs=("cycle_speed",),
    message="is {cycle_speed}, but the curve that torque refers to comes again with {curve_rate}; refer to the speed with which that curve is "
        "calculated")
cycle.reduction("torque_least", "T_low", "N*m", "Minimum torque", "min", of="torque_over_cycle", output=False)

load = Chapter("Load", text="A peak in every revolution is a regular load and is included in the equivalent torque; torque_peak is a rare one.")
load.value("torque_size", "T_m", "N*m", "Absolute torque", lambda torque: abs(torque), lacks=CURVE, source="input", output=False)
load.require("loaded", lambda torque_size: torque_size > 0, key="torque", message="is 0; give the torque that the key carries", lacks=CURVE)
load.require("loaded_by_curve", lambda torque_size: torque_size > 0, key="torque_curve", needs=CURVE,
    message="is 0 everywhere; give the torque that the key carries")
load.value("application_factor", "K_A", "1", "Application factor: as given", bind(lambda given: given, given="inputs.application_factor"),
    needs=("application_factor",), source="input")
load.value("application_factor", "K_A", "1", "Application factor: the curve includes the dynamics", lambda: 1, lacks=("application_factor",),
    source="this method")
load.value("torque_equivalent", "T_eq", "N*m", "Equivalent torque", lambda application_factor, torque_size: application_factor * torque_size,
    source=METHOD)
load.require("peak_is_greatest",
    bind(lambda peak, torque_size, rounding: peak >= torque_size * (1 - rounding), peak="inputs.torque_peak", rounding=ROUNDING), key="torque_peak",
    needs=("torque_peak",),
    message="is {inputs.torque_peak}, less than the torque of {torque_size} that acts anyway; give the maximum one, or remove the key")
PEAK = ("torque_run", "T_run", "N*m", "Maximum torque of the run")
load.value(*PEAK, bind(lambda given: given, given="inputs.torque_peak"), needs=("torque_peak",), source="input", output=False)
load.value(*PEAK, lambda torque_size: torque_size, lacks=("torque_peak",), source="this method", output=False)
load.total("torque_case", "T_j,max", "N*m", "Maximum torque of the load cases", "max", of="load_cases.torque", needs=CASES, output=False)
load.value("torque_peak", "T_max", "N*m", "Maximum torque: that of the run", lambda torque_run: torque_run, lacks=CASES, source="this method")
load.value("torque_peak", "T_max", "N*m", "Maximum torque of run and load cases", lambda torque_run, torque_case: np.maximum(torque_run, torque_case),
    needs=CASES, source="this method")
PEAK_CASE = ("peak_case", "C", "1", "Load case of the maximum torque", governing_case)
load.computed(*PEAK_CASE, ("torque_run", "load_cases.name", "load_cases.torque"), GREATEST, is_text=True, needs=CASES)
load.computed(*PEAK_CASE, ("torque_run",), GREATEST, is_text=True, lacks=CASES, printed=False, output=False)
load.value("reversing", "R_T", "1", "Reversing torque over the cycle",
    bind(lambda torque_greatest, torque_least, torque_size, share: (torque_greatest > share * torque_size) & (-torque_least > share * torque_size),
        share=REVERSED), needs=CURVE, source="this method")
load.value("reversing", "R_T", "1", "Reversing torque: a single torque does not reverse", lambda torque_size: torque_size < 0, lacks=CURVE,
    source="this method")
FLANKS = ("changes_of_flank", "N_W", "1", "Number of load direction changes in the life")
load.value(*FLANKS,
    bind(lambda reversing, count, speed, life: reversing * count * speed * life / (2 * pi), count="flank_change_count", speed="cycle_speed",
        life="required_life"), needs=(*CURVE, *BY_LIFE), source="this method")
load.value(*FLANKS, lambda: 0, needs=BY_LIFE, lacks=CURVE, source="this method")
load.value("least_changes", "N_W,min", "1", "Load direction changes of the curve in the least plausible life; in a cycle, if its speed is not known",
    bind(lambda reversing, count, rate: reversing * count * np.maximum(1, rate * LEAST_LIFE / (2 * pi)), count="flank_change_count",
        rate="curve_rate"), needs=CURVE, lacks=BY_LIFE, source="this method", output=False)
load.require("as_many_as_the_curve_has", bind(lambda given, least: given >= least, given="flank_changes", least="least_changes"), key="flank_changes",
    needs=(*CURVE, "flank_changes"),
    message="is {flank_changes}, but the torque changes its sign {flank_change_count} times a cycle, so at least {least_changes} times in 2000 h "
        "(in one cycle, if its speed is not known); give required_life and cycle_speed, by which the changes are counted")
load.value(*FLANKS, lambda flank_changes: flank_changes, needs=("flank_changes",), source="input")
FACTOR = ("direction_factor", "f_w", "1", "Load direction factor")
SELDOM_CHANGED = bind(lambda changes_of_flank, seldom: changes_of_flank <= seldom, seldom=SELDOM)
COUNTED = case(direction_factor, "from the load direction changes in the life", bind(lambda changes_of_flank, end: changes_of_flank <= end,
                                                                                       end=DIAGRAM))
for needs in (BY_LIFE, ("flank_changes",)):
    load.choice(*FACTOR, case(lambda: 1, "the load direction changes too rarely to count", SELDOM_CHANGED), COUNTED,
        case(direction_factor, "from the load direction changes; beyond 10⁷ of them the formula is extrapolated"), source=METHOD, needs=needs)
load.value(*FACTOR, lambda load_direction_factor: load_direction_factor, needs=FACTOR_GIVEN, source="input")
load.value("factor_of_least", "f_w,max", "1", "Load direction factor with the least number of changes",
    bind(direction_factor, changes_of_flank="least_changes"), needs=(*CURVE, *FACTOR_GIVEN), source=METHOD, output=False)
load.fact("flank_known", lambda reversing: reversing <= 0, "the torque reverses, and the number of reversals in the life is not known", lacks=KNOWN)
load.choice(*FACTOR, case(lambda: 1, "the torque keeps its sign", lambda reversing: reversing <= 0),
    case(lambda: 0.2, "as for 10¹⁰ load direction changes, since the torque reverses and their number in the life is not known"), lacks=KNOWN,
    source="this method")
load.choice("key_share", "φ_k", "1", "Load share of the second key", case(lambda: 1, "one key", lambda key_count: key_count < 2),
    case(lambda: 0.75, "the second key of two carries less"), source=METHOD, output=False)
load.choice("key_share_peak", "φ_k,max", "1", "Load share of the second key under the maximum load",
    case(lambda: 1, "one key", lambda key_count: key_count < 2), case(lambda: 0.9, "the second key of two carries nearly as much"), source=METHOD,
    output=False)
load.value("key_force", "F", "N", "Force on one key, equivalent", bind(key_force, torque="torque_equivalent"), source=METHOD)
load.value("key_force_peak", "F_max", "N", "Force on one key, maximum", bind(key_force, torque="torque_peak", key_share="key_share_peak"),
    source=METHOD)


PARTS = {"shaft": "W", "hub": "N", "key": "P"}
LOADS = {"": ("key_force", "direction_factor", "", "equivalent"), "_peak": ("key_force_peak", "load_peak_factor", "max", "maximum")}
"""Of the regular load and the peak: the force, the factor of what is allowed, the symbol's end, and words."""
PRESSED = [(part, peak) for peak in LOADS for part in PARTS]
SIX = ("shaft", "hub", "key", "shaft_peak", "hub_peak", "key_peak")

allowed = Chapter("Allowable stresses",
    text="Each part withstands more than its yield strength because of the support of the material around the loaded face.")
needed = Chapter("Required length",
    text="The smallest bearing length at which all pressures and the shear of the key are within the allowable values.")
allowed.value("support_shaft", "f_SW", "1", "Support factor of the shaft, of steel", lambda: 1.3, source=METHOD, output=False)
allowed.value("support_hub", "f_SN", "1", "Support factor of the hub, of steel", lambda: 1.5, source=METHOD, needs=("brittle_hub=false",),
    output=False)
allowed.value("support_hub", "f_SN", "1", "Support factor of the hub, of cast iron", lambda: 2, source=METHOD, needs=("brittle_hub=true",),
    output=False)
allowed.value("support_key", "f_SP", "1", "Support factor of the key", lambda: 1.1, source=METHOD, output=False)
for part, peak in PRESSED:
    _, factor, end, words = LOADS[peak]
    allowed.value(f"allowed_{part}{peak}", f"p_{PARTS[part]}zul{end}", "MPa", f"Allowable pressure on the {part}, {words} load",
        bind(lambda factor, support, strength: factor * support * strength, factor=factor, support=f"support_{part}", strength=f"yield_{part}"),
        source=METHOD, output=False)
allowed.value("allowed_shear", "τ_zul", "MPa", "Allowable shear stress of the key", lambda yield_key: yield_key / np.sqrt(number(3)),
    source="strength of materials", output=False)
for part, peak in PRESSED:
    force, _, end, words = LOADS[peak]
    needed.value(f"length_{part}{peak}", f"l_{PARTS[part]}{end}", "mm", f"Bearing length required by the {part}, {words} load",
        bind(lambda force, height, allowed, load_distribution_factor: load_distribution_factor * force / (height * allowed), force=force,
            height=f"height_{part}", allowed=f"allowed_{part}{peak}"), source=METHOD, output=False)
needed.value("length_shear", "l_τ", "mm", "Bearing length required by the shear of the key",
    lambda key_force_peak, width, allowed_shear: key_force_peak / (width * allowed_shear), source="strength of materials", output=False)
needed.value("length_pressed", "l_p", "mm", "Bearing length required by the pressures",
    bind(lambda shaft, hub, key, shaft_peak, hub_peak, key_peak:
            np.maximum(np.maximum(np.maximum(shaft, hub), key), np.maximum(np.maximum(shaft_peak, hub_peak), key_peak)),
        **{name: f"length_{name}" for name in SIX}), source=METHOD, output=False)
needed.value("bearing_length_needed", "l_tr,req", "mm", "Required bearing length",
    lambda length_pressed, length_shear: np.maximum(length_pressed, length_shear), source="this method", output=False)
needed.value("round_ends", "l_r", "mm", "Length of the round ends, which do not carry", lambda width: width, needs=("form=A",), source="DIN 6892",
    output=False)
needed.value("round_ends", "l_r", "mm", "Length of the round ends: square ends carry fully", lambda: 0, needs=("form=B",), source="DIN 6892",
    output=False)
needed.value("least_key_length", "l_min", "mm", "Minimum length of the key",
    lambda bearing_length_needed, round_ends: bearing_length_needed + round_ends, source=METHOD, output=False)
needed.require("standard_key_exists", lambda least_key_length: least_key_length <= LONGEST_KEY, key="shaft_diameter", lacks=("key_length",),
    message="is {shaft_diameter}, on which the key would have to be {least_key_length} long; the longest standard key has 280 mm: take a thicker "
        "shaft, two keys or stronger material")
needed.pick("standard_key_length", "l_std,req", "mm", "Next standard length", "above", of="least_key_length", series=LENGTHS, beyond="last",
    source="DIN 6885-1", output=False)
needed.value("required_key_length", "l_req", "mm", "Smallest sufficient standard length", lambda standard_key_length: standard_key_length,
    exists=lambda least_key_length: least_key_length <= LONGEST_KEY, source="DIN 6885-1")

pressures = Chapter("Pressures",
    text="Shaft and hub each bear on their own height of the key; the pressure on the key is highest where this height is smaller.")
pressures.value("key_length", "l", "mm", "Length of the key: as given", bind(lambda given: given, given="inputs.key_length"), needs=("key_length",),
    source="input")
pressures.value("key_length", "l", "mm", "Length of the key: the smallest sufficient standard length",
    lambda required_key_length: required_key_length, lacks=("key_length",), source="this method")
pressures.require("longer_than_wide", lambda key_length, round_ends: key_length > round_ends, key="key_length", needs=("key_length", "form=A"),
    message="is {key_length}, of which the round ends of the {width} wide key leave nothing to bear; take a longer key, or form B")
BEARING = ("bearing_length", "l_tr", "mm")
pressures.value(*BEARING, "Bearing length, no longer than the hub",
    lambda key_length, round_ends, hub_length: np.minimum(key_length - round_ends, hub_length), needs=("hub_length",), source=METHOD)
pressures.value(*BEARING, "Bearing length", lambda key_length, round_ends: key_length - round_ends, lacks=("hub_length",), source=METHOD)
for part, peak in PRESSED:
    force, _, end, words = LOADS[peak]
    pressures.value(f"pressure_{part}{peak}", f"p_{PARTS[part]}{end}", "MPa", f"Pressure on the {part}, {words} load",
        bind(lambda force, height, length, load_distribution_factor: load_distribution_factor * force / (height * length), force=force,
            height=f"height_{part}", length="bearing_length"), source=METHOD)
pressures.value("shear_stress", "τ", "MPa", "Shear stress of the key, maximum load",
    lambda key_force_peak, width, bearing_length: key_force_peak / (width * bearing_length), source="strength of materials")
for part, peak in PRESSED:
    pressures.value(f"safety_{part}{peak}", f"S_{PARTS[part]}{LOADS[peak][2]}", "1", f"Safety factor of the {part}, {LOADS[peak][3]} load",
        bind(lambda limit, pressure: limit / pressure, limit=f"allowed_{part}{peak}", pressure=f"pressure_{part}{peak}"), source=METHOD,
        output=False)
pressures.value("safety", "S", "1", "Minimum safety factor", bind(lambda shaft, hub, key, shaft_peak, hub_peak, key_peak:
        np.minimum(np.minimum(np.minimum(shaft, hub), key), np.minimum(np.minimum(shaft_peak, hub_peak), key_peak)),
    **{name: f"safety_{name}" for name in SIX}), source=METHOD)
pressures.value("safety_peak", "S_max", "1", "Minimum safety factor under the maximum load",
    lambda safety_shaft_peak, safety_hub_peak, safety_key_peak: np.minimum(np.minimum(safety_shaft_peak, safety_hub_peak), safety_key_peak),
    source=METHOD, output=False)
pressures.choice("governing", "G", "1", "Governing part and load",
    *(case(f"{part}, {LOADS[peak][3]} load", f"the {part} has the lowest safety factor, under the {LOADS[peak][3]} load",
           bind(lambda own, safety: own <= safety, own=f"safety_{part}{peak}")) for part, peak in PRESSED[:-1]),
    case("key, maximum load", "the key has the lowest safety factor, under the maximum load"), source=METHOD)
pressures.value("longest_wanted", "l_max", "mm", "Maximum bearing length over which the load still distributes",
    lambda shaft_diameter: 1.3 * shaft_diameter, source=METHOD, output=False)
pressures.pick("nearest_length", "l_std", "mm", "Nearest standard length", "nearest", of="key_length", series=LENGTHS, beyond="last",
    source="DIN 6885-1", output=False)
pressures.value("length_off", "Δl", "mm", "Deviation from it", lambda key_length, nearest_length: abs(key_length - nearest_length),
    source="this method", output=False)
pressures.choice("reversal_left_out", "n_w", "1", "Reversing torque not considered (1) or considered (0)",
    case(lambda: 1, "the torque reverses, and the number of reversals in the life is not known", lambda reversing: reversing > 0),
    case(lambda: 0, "the torque keeps its sign"), source="this method", output=False, lacks=KNOWN)
for needs, lacks in ((BY_LIFE, ()), (("flank_changes",), ()), (FACTOR_GIVEN, CURVE)):
    pressures.value("reversal_left_out", "n_w", "1", "Reversing torque not considered: no, the factor includes it", lambda: 0, source="this method",
        output=False, needs=needs, lacks=lacks)
pressures.choice("reversal_left_out", "n_w", "1", "Reversing torque not considered (1) or considered (0)",
    case(lambda: 1, "the factor is greater than with the load direction changes that the curve has at least",
        lambda load_direction_factor, factor_of_least: load_direction_factor > factor_of_least), case(lambda: 0, "the factor includes it"),
    source="this method", output=False, needs=(*CURVE, *FACTOR_GIVEN))
