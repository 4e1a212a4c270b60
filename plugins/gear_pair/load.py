"""Chapters on the load: the torque on the pinion over a cycle, its peak, and whether it turns round."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind, case
from diecut_report.mechanics.load_cases import GREATEST, governing_case

# fmt: off

CURVE = ("torque_curve",)
CASES = ("load_cases",)
OF_RUN = ("torque_run", "T_1,run", "N*m")
SELDOM = 1e5  # load cycles up to which a load case does not count for pitting
REVERSED = 1e-6  # share of the torque's size up to which the other sign is rounding

cycle = Chapter("Torque over the cycle", needs=CURVE, text="One period of the referenced curve is mapped to one revolution of the cycle angle.")
cycle.abscissa("cycle_angle", "φ", "deg", "Cycle angle, one revolution per period of the torque", period=2 * np.pi, shown_at="torque_size_at")
cycle.from_curve("torque_given", "T_φ", "N*m", "Torque as given", given="torque_curve", abscissa="cycle_angle", output=False)
cycle.value("torque_pinion_curve", "T_1φ", "N*m", "Torque on the pinion", lambda torque_given: torque_given, needs=("torque_on=pinion",),
    source="input")
cycle.value("torque_pinion_curve", "T_1φ", "N*m", "Torque on the pinion, from that on the wheel without losses",
    lambda torque_given, teeth_1, teeth_2: torque_given * teeth_1 / teeth_2, needs=("torque_on=wheel",), source="statics")
cycle.reduction("torque_size", "T_m", "N*m", "Maximum absolute torque on the pinion", "abs_max", of="torque_pinion_curve", output=False)
cycle.reduction("torque_max", "T_max", "N*m", "Maximum torque on the pinion", "max", of="torque_pinion_curve")
cycle.reduction("torque_min", "T_min", "N*m", "Minimum torque on the pinion", "min", of="torque_pinion_curve")

load = Chapter("Load", text="A peak in every revolution is a regular load: the maximum torque of the cycle counts in full.")
load.value(*OF_RUN, "Maximum torque of the run on the pinion", lambda torque_size: torque_size, needs=CURVE, source="this method")
load.value(*OF_RUN, "Maximum torque of the run on the pinion", lambda torque: abs(torque), needs=("torque", "torque_on=pinion"),
    source="input")
load.value(*OF_RUN, "Maximum torque of the run on the pinion, from that on the wheel without losses",
    lambda torque, teeth_1, teeth_2: abs(torque) * teeth_1 / teeth_2, needs=("torque", "torque_on=wheel"), source="statics")
load.require("loaded", lambda torque_run: torque_run > 0, key="torque", message="is 0; give the torque that the teeth carry", lacks=CURVE)
load.require("loaded_by_curve", lambda torque_run: torque_run > 0, key="torque_curve", needs=CURVE,
    message="is 0 everywhere; give the torque that the teeth carry")
load.value("case_frequent", "T_jH", "N*m", "Torque of the load case where it counts for pitting",
    bind(lambda torque, cycles, seldom: np.where(cycles > seldom, torque, 0), torque="load_cases.torque", cycles="load_cases.cycles", seldom=SELDOM),
    needs=CASES, source="this method", output=False)
load.total("torque_frequent", "T_jH,max", "N*m", "Maximum torque of the frequent load cases", "max", of="case_frequent", needs=CASES, output=False)
load.total("torque_case", "T_j,max", "N*m", "Maximum torque of the load cases", "max", of="load_cases.torque", needs=CASES, output=False)
load.value("torque_peak", "T_1", "N*m", "Maximum torque on the pinion, of run and frequent load cases",
    lambda torque_run, torque_frequent: np.maximum(torque_run, torque_frequent), needs=CASES, source="this method")
load.value("torque_root", "T_1F", "N*m", "Maximum torque on the pinion, of run and all load cases",
    lambda torque_run, torque_case: np.maximum(torque_run, torque_case), needs=CASES, source="this method")
for id, symbol in (("torque_peak", "T_1"), ("torque_root", "T_1F")):
    load.value(id, symbol, "N*m", "Maximum torque on the pinion: that of the run", lambda torque_run: torque_run, lacks=CASES, source="this method")
for id, symbol, words, torque in (("pitting_case", "C_H", "pitting", "case_frequent"), ("root_case", "C_F", "the tooth root", "load_cases.torque")):
    named = (id, symbol, "1", f"Governing load case for {words}", governing_case)
    load.computed(*named, ("torque_run", "load_cases.name", torque), GREATEST, is_text=True, needs=CASES)
    load.computed(*named, ("torque_run",), GREATEST, is_text=True, lacks=CASES, printed=False, output=False)
load.value("reversing", "R_T", "1", "Reversing torque over the cycle: each tooth is bent in both directions",
    bind(lambda torque_max, torque_min, torque_run, share: (torque_max > share * torque_run) & (-torque_min > share * torque_run), share=REVERSED),
    needs=CURVE, source="this method")
load.value("reversing", "R_T", "1", "Reversing torque: a single torque does not reverse", lambda torque_run: torque_run < 0, lacks=CURVE,
    source="this method")
load.value("alternating_factor", "Y_M", "1", "Mean stress influence factor: as given", bind(lambda given: given, given="inputs.alternating_factor"),
    needs=("alternating_factor",), source="input")
load.choice("alternating_factor", "Y_M", "1", "Mean stress influence factor",
    case(lambda: 0.7, "the torque reverses, so that each tooth is bent in both directions", lambda reversing: reversing > 0),
    case(lambda: 1, "the torque keeps its sign"), lacks=("alternating_factor",), source="ISO 6336-5 (idlers)")
