"""Chapters on the load: the torque on the pinion over a cycle, its peak, whether it turns round, and the K factors."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind, case, named

KEYS = ("application_factor", "dynamic_factor", "face_load_factor", "transverse_load_factor")


def assumed_factors(*assumed: float) -> str:
    """The keys of the factors that are assumed."""
    *first, last = [key for key, is_assumed in zip(KEYS, assumed, strict=True) if is_assumed] or [""]
    return named([named(first, ", "), last] if first else [last], " and ")


# fmt: off

CURVE = ("torque_curve",)
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
load.value("torque_peak", "T_1", "N*m", "Maximum torque on the pinion", lambda torque_size: torque_size, needs=CURVE, source="this method")
load.value("torque_peak", "T_1", "N*m", "Maximum torque on the pinion", lambda torque: abs(torque), needs=("torque", "torque_on=pinion"),
    source="input")
load.value("torque_peak", "T_1", "N*m", "Maximum torque on the pinion, from that on the wheel without losses",
    lambda torque, teeth_1, teeth_2: abs(torque) * teeth_1 / teeth_2, needs=("torque", "torque_on=wheel"), source="statics")
load.require("loaded", lambda torque_peak: torque_peak > 0, key="torque", message="is 0; give the torque that the teeth carry", lacks=CURVE)
load.require("loaded_by_curve", lambda torque_peak: torque_peak > 0, key="torque_curve", needs=CURVE,
    message="is 0 everywhere; give the torque that the teeth carry")
load.value("reversing", "R_T", "1", "Reversing torque over the cycle: each tooth is bent in both directions",
    bind(lambda torque_max, torque_min, torque_peak, share: (torque_max > share * torque_peak) & (-torque_min > share * torque_peak), share=REVERSED),
    needs=CURVE, source="this method")
load.value("reversing", "R_T", "1", "Reversing torque: a single torque does not reverse", lambda torque_peak: torque_peak < 0, lacks=CURVE,
    source="this method")
load.value("alternating_factor", "Y_M", "1", "Mean stress influence factor: as given", bind(lambda given: given, given="inputs.alternating_factor"),
    needs=("alternating_factor",), source="input")
load.choice("alternating_factor", "Y_M", "1", "Mean stress influence factor",
    case(lambda: 0.7, "the torque reverses, so that each tooth is bent in both directions", lambda reversing: reversing > 0),
    case(lambda: 1, "the torque keeps its sign"), lacks=("alternating_factor",), source="ISO 6336-5 (idlers)")

FACTORS = {"application": ("K_A", "Application factor", 1.25), "dynamic": ("K_V", "Dynamic factor", 1.1),
           "face_load": ("K_Hβ", "Face load factor for contact stress", 1.3)}
"""The K factors by the beginning of their keys: symbol, words, and what is assumed without the key."""

factors = Chapter("K factors", text="The factors of ISO 6336-1 are given, not calculated; those that are not given are assumed.")
for name, (symbol, words, assumed) in FACTORS.items():
    key = f"{name}_factor"
    factors.value(key, symbol, "1", f"{words}: as given", bind(lambda given: given, given=f"inputs.{key}"), needs=(key,), source="input")
    factors.value(key, symbol, "1", f"{words}: assumed", bind(lambda assumed: assumed, assumed=assumed), lacks=(key,), source="this method")
factors.value("transverse_load_factor", "K_Hα", "1", "Transverse load factor: as given",
    bind(lambda given: given, given="inputs.transverse_load_factor"), needs=("transverse_load_factor",), source="input")
factors.choice("transverse_load_factor", "K_Hα", "1", "Transverse load factor: assumed",
    case(lambda: 1.2, "the teeth are helical", lambda helix_angle: helix_angle > 0), case(lambda: 1, "the teeth are straight"),
    lacks=("transverse_load_factor",), source="this method")
for name, words in (*((name, words) for name, (_, words, _) in FACTORS.items()), ("transverse_load", "Transverse load factor")):
    key, told = f"{name}_factor", f"{words}: 1 where it is assumed, 0 where it is given"
    factors.value(f"{name}_assumed", f"n_{name[0]}", "1", told, lambda: 0, needs=(key,), output=False, printed=False)
    factors.value(f"{name}_assumed", f"n_{name[0]}", "1", told, lambda: 1, lacks=(key,), output=False, printed=False)
ASSUMED = tuple(f"{name}_assumed" for name in (*FACTORS, "transverse_load"))
factors.computed("factors_assumed", "n_K", "1", "Number of assumed K factors", lambda *assumed: sum(assumed), ASSUMED, "those above that are assumed",
    whole=True, source="this method")
factors.words("assumed_told", assumed_factors, ASSUMED, output=False)
