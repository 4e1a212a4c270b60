"""Chapters on the torque and the force on the key."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Constant, bind, case
from diecut_report.mechanics.load_cases import GREATEST, governing_case
from diecut_report.plugins.parallel_key import formulas as f

# fmt: off

CURVE = ("torque_curve",)
CASES = ("load_cases",)
REVERSED = 1e-6  # share of the torque's size up to which the other sign is rounding
ROUNDING = 1e-9
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
    bind(lambda reversing, count, speed, life: reversing * count * speed * life / (2 * np.pi), count="flank_change_count", speed="cycle_speed",
        life="required_life"), needs=(*CURVE, *BY_LIFE), source="this method")
load.value(*FLANKS, lambda: 0, needs=BY_LIFE, lacks=CURVE, source="this method")
load.value("least_changes", "N_W,min", "1", "Load direction changes of the curve in the least plausible life; in a cycle, if its speed is not known",
    bind(lambda reversing, count, rate: reversing * count * np.maximum(1, rate * LEAST_LIFE / (2 * np.pi)), count="flank_change_count",
        rate="curve_rate"), needs=CURVE, lacks=BY_LIFE, source="this method", output=False)
load.require("as_many_as_the_curve_has", bind(lambda given, least: given >= least, given="flank_changes", least="least_changes"), key="flank_changes",
    needs=(*CURVE, "flank_changes"),
    message="is {flank_changes}, but the torque changes its sign {flank_change_count} times a cycle, so at least {least_changes} times in 2000 h "
        "(in one cycle, if its speed is not known); give required_life and cycle_speed, by which the changes are counted")
load.value(*FLANKS, lambda flank_changes: flank_changes, needs=("flank_changes",), source="input")
FACTOR = ("direction_factor", "f_w", "1", "Load direction factor")
SELDOM_CHANGED = bind(lambda changes_of_flank, seldom: changes_of_flank <= seldom, seldom=SELDOM)
COUNTED = case(f.direction_factor, "from the load direction changes in the life", bind(lambda changes_of_flank, end: changes_of_flank <= end,
                                                                                       end=DIAGRAM))
for needs in (BY_LIFE, ("flank_changes",)):
    load.choice(*FACTOR, case(lambda: 1, "the load direction changes too rarely to count", SELDOM_CHANGED), COUNTED,
        case(f.direction_factor, "from the load direction changes; beyond 10⁷ of them the formula is extrapolated"), source=METHOD, needs=needs)
load.value(*FACTOR, lambda load_direction_factor: load_direction_factor, needs=FACTOR_GIVEN, source="input")
load.value("factor_of_least", "f_w,max", "1", "Load direction factor with the least number of changes",
    bind(f.direction_factor, changes_of_flank="least_changes"), needs=(*CURVE, *FACTOR_GIVEN), source=METHOD, output=False)
load.fact("flank_known", lambda reversing: reversing <= 0, "the torque reverses, and the number of reversals in the life is not known", lacks=KNOWN)
load.choice(*FACTOR, case(lambda: 1, "the torque keeps its sign", lambda reversing: reversing <= 0),
    case(lambda: 0.2, "as for 10¹⁰ load direction changes, since the torque reverses and their number in the life is not known"), lacks=KNOWN,
    source="this method")
load.choice("key_share", "φ_k", "1", "Load share of the second key", case(lambda: 1, "one key", lambda key_count: key_count < 2),
    case(lambda: 0.75, "the second key of two carries less"), source=METHOD, output=False)
load.choice("key_share_peak", "φ_k,max", "1", "Load share of the second key under the maximum load",
    case(lambda: 1, "one key", lambda key_count: key_count < 2), case(lambda: 0.9, "the second key of two carries nearly as much"), source=METHOD,
    output=False)
load.value("key_force", "F", "N", "Force on one key, equivalent", bind(f.key_force, torque="torque_equivalent"), source=METHOD)
load.value("key_force_peak", "F_max", "N", "Force on one key, maximum", bind(f.key_force, torque="torque_peak", key_share="key_share_peak"),
    source=METHOD)
