"""Chapters on the load of the teeth, and the factors that raise it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from diecut_report.api import Chapter, Constant, bind, case, named, own_table
from diecut_report.mechanics.load_cases import GREATEST, governing_case
from diecut_report.plugins.gear_pair import formulas as f
from diecut_report.plugins.gear_pair.mesh import TEETH

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
    case_of = (id, symbol, "1", f"Governing load case for {words}", governing_case)
    load.computed(*case_of, ("torque_run", "load_cases.name", torque), GREATEST, is_text=True, needs=CASES)
    load.computed(*case_of, ("torque_run",), GREATEST, is_text=True, lacks=CASES, printed=False, output=False)
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


KEYS = ("application_factor", "dynamic_factor", "face_load_factor", "transverse_load_factor")
CALCULATED = ("grade", "speed")
"""The inputs with which the factors are calculated; the face load factor also with the slope of the shafts."""
METHOD_C = Constant(3.0, "3 m/s", "m/s")
"""The end of method C by the parameter of speed: beyond it the dynamic factor is known only where it is given."""
DYNAMIC_KNOWN = "dynamic_known"
BY: dict[str, tuple[str, ...]] = {
    "dynamic_factor": CALCULATED,
    "face_load_factor": (*CALCULATED, "slope"),
    "transverse_load_factor": CALCULATED,
}


def assumed_factors(*assumed: float) -> str:
    """The keys of the factors that are assumed."""
    *first, last = [key for key, is_assumed in zip(KEYS, assumed, strict=True) if is_assumed] or [""]
    return named([named(first, ", "), last] if first else [last], " and ")


def unless_known(key: str) -> Iterator[dict[str, Any]]:
    """Yield what a step needs and lacks where a factor is neither given nor calculated."""
    by = BY.get(key, ())
    yield from ({"needs": by[:number], "lacks": (key, missing)} for number, missing in enumerate(by))
    if not by:
        yield {"lacks": (key,)}


# fmt: off

ISO = "ISO 6336-1:2019"
K_1 = own_table(title="Coefficient K_1 of the dynamic factor of method C by the grade of accuracy",
    columns={"grade": "1", "spur": "N/mm", "helical": "N/mm"},
    rows=((3, 2.1, 1.9), (4, 3.9, 3.5), (5, 7.5, 6.7), (6, 14.9, 13.3), (7, 26.8, 23.9), (8, 39.1, 34.8), (9, 52.8, 47.0), (10, 76.6, 68.2),
          (11, 102.6, 91.4)),
    sources=("IACS, UR M56, marine gears (grades 3 to 8)",
             "ISO 6336-1, table of method C, as DIN 3990-11 in public code has it (hanslhansl/din3990; grades 5 to 11)"))

FACTORS = {"application": ("K_A", "Application factor", 1.25), "dynamic": ("K_V", "Dynamic factor", 1.1),
           "face_load": ("K_Hβ", "Face load factor for contact stress", 1.3)}
"""The factors by the beginning of their keys: symbol, words, and what is assumed where nothing is known."""

factors = Chapter("K factors",
    text="The factors of ISO 6336-1: as given; calculated below where the grade of accuracy and the speed are given, for K_Hβ also the slope of the "
        "shafts; else assumed.")
for name, (symbol, words, assumed) in FACTORS.items():
    key = f"{name}_factor"
    factors.value(key, symbol, "1", f"{words}: as given", bind(lambda given: given, given=f"inputs.{key}"), needs=(key,), source="input")
    for when in unless_known(key):
        factors.value(key, symbol, "1", f"{words}: assumed", bind(lambda assumed: assumed, assumed=assumed), source="this method", **when)
for id, symbol, words in (("transverse_load_factor", "K_Hα", "contact stress"), ("transverse_load_root", "K_Fα", "tooth root stress")):
    factors.value(id, symbol, "1", f"Transverse load factor for {words}: as given",
        bind(lambda given: given, given="inputs.transverse_load_factor"), needs=("transverse_load_factor",), source="input")
    for when in unless_known("transverse_load_factor"):
        factors.choice(id, symbol, "1", f"Transverse load factor for {words}: assumed",
            case(lambda: 1.2, "the teeth are helical", lambda helix_angle: helix_angle > 0), case(lambda: 1, "the teeth are straight"),
            source="this method", **when)
for name, words in (*((name, words) for name, (_, words, _) in FACTORS.items()), ("transverse_load", "Transverse load factor")):
    key, told = f"{name}_factor", f"{words}: 1 where it is assumed, 0 where it is given or calculated"
    marked = (f"{name}_assumed", f"n_{name[0]}", "1", told)
    factors.value(*marked, lambda: 0, needs=(key,), output=False, printed=False)
    if key in BY:
        factors.value(*marked, lambda: 0, needs=BY[key], lacks=(key,), output=False, printed=False)
    for when in unless_known(key):
        factors.value(*marked, lambda: 1, output=False, printed=False, **when)
ASSUMED = tuple(f"{name}_assumed" for name in (*FACTORS, "transverse_load"))
factors.computed("factors_assumed", "n_K", "1", "Number of assumed K factors", lambda *assumed: sum(assumed), ASSUMED, "those above that are assumed",
    whole=True, source="this method")
factors.words("assumed_told", assumed_factors, ASSUMED, output=False)

accuracy = Chapter("Accuracy, stiffness and running-in of the teeth", needs=CALCULATED,
    text="Permissible deviations are those of the worse gear's grade, and of the wheel's size where only one counts. Solid gears.")
for kind, symbol in (("spur", "K_1α"), ("helical", "K_1β")):
    accuracy.lookup(f"k_1_{kind}", symbol, "N/mm", f"Coefficient K_1 of the dynamic factor, {kind} teeth", K_1, by="grade", column=kind, key="grade",
        source=ISO, output=False)
accuracy.value("grade_step", "f_Q", "1", "Ratio of the deviations of the grade to those of grade 5", lambda grade: 2 ** ((grade - 5) / 2),
    source="ISO 1328-1:2013", output=False)
accuracy.choice("grade_confirmed", "Q_max", "1", "Coarsest grade of which two sources have K_1",
    case(lambda: 11, "the teeth are straight", lambda helix_angle: helix_angle <= 0), case(lambda: 8, "the teeth are helical"),
    source="this method", output=False)
accuracy.value("tooth_compliance", "q′", "mm*um/N", "Theoretical compliance of a pair of teeth",
    bind(f.tooth_compliance, teeth_1="virtual_teeth_1", teeth_2="virtual_teeth_2"), source=f"{ISO}, 9", output=False)
accuracy.value("tooth_stiffness", "c′", "N/(mm*um)", "Stiffness of a pair of teeth from a line load of 100 N/mm on",
    bind(f.tooth_stiffness, compliance="tooth_compliance"), source=f"{ISO}, 9", output=False)
accuracy.value("crowning", "B", "1", "Share of the misalignment that crowning leaves: all, without crowning", lambda: 1, needs=("crowned=false",),
    source=f"{ISO}, 7", output=False)
accuracy.value("crowning", "B", "1", "Share of the misalignment that crowning by half of both deviations leaves", lambda: 0.5,
    needs=("crowned=true",), source=f"{ISO}, 7", output=False)
for g in TEETH:
    flanks = f"flanks_{g}"
    accuracy.value(f"run_in_share_{g}", f"η_β{g}", "1", f"Share of a helix deviation that gear {g} loses by running in",
        bind(lambda limit: 320 * f.MEGAPASCAL / limit, limit=f"sigma_h_lim_{g}"), needs=(f"{flanks}=through_hardened",),
        source=f"{ISO}, 7", output=False)
    for of, share in (("case_hardened", 0.15), ("grey_iron", 0.55)):
        accuracy.value(f"run_in_share_{g}", f"η_β{g}", "1", f"Share of a helix deviation that gear {g} loses by running in",
            bind(lambda share: share, share=share), needs=(f"{flanks}={of}",), source=f"{ISO}, 7", output=False)
    for end, symbol, speed, words in (("slow", "s", 5, "whatever the deviation"), ("fast", "f", 10, "deviations of up to 80 µm")):
        accuracy.lookup(f"run_in_{end}_{g}", f"v_{symbol}{g}", "m/s", f"Pitch line velocity up to which gear {g} runs in {words}",
            {"through_hardened": speed, "case_hardened": 0, "grey_iron": speed}, by=flanks, source=f"{ISO}, 7", output=False)

dynamic = Chapter("Dynamic load", needs=CALCULATED, text="Method C: below the resonance, for the worse grade of the pair.")
dynamic.value("line_load", "w_A", "N/mm", "Line load with the application factor",
    lambda application_factor, tangential_force, face_width: application_factor * tangential_force / face_width, source=ISO)
dynamic.value("speed_parameter", "X", "m/s", "Speed that the dynamic factor depends on",
    bind(lambda velocity, teeth_1, ratio: velocity * teeth_1 / 100 * np.sqrt(ratio**2 / (1 + ratio**2)), velocity="pitch_velocity"),
    source=f"{ISO}, 6", lacks=KEYS[1:2])
dynamic.fact(DYNAMIC_KNOWN, lambda speed_parameter: speed_parameter <= METHOD_C,
    "not calculated: so fast teeth come near their resonance, where method C does not hold; give dynamic_factor", lacks=KEYS[1:2])
dynamic.value("k_1", "K_1", "N/mm", "Coefficient of the dynamic factor, of the grade", bind(f.of_overlap, spur="k_1_spur", helical="k_1_helical"),
    source=f"{ISO}, 6", output=False, lacks=KEYS[1:2])
dynamic.value("k_2", "K_2", "1", "Coefficient of the dynamic factor, of the speed", bind(f.of_overlap, spur=0.0193, helical=0.0087),
    source=f"{ISO}, 6", output=False, lacks=KEYS[1:2])
dynamic.value("dynamic_factor", "K_V", "1", "Dynamic factor", f.dynamic_factor, source=f"{ISO}, 6", needs=(DYNAMIC_KNOWN,), lacks=KEYS[1:2])
dynamic.value("mesh_stiffness", "c_γα", "N/(mm*um)", "Mesh stiffness", bind(f.mesh_stiffness, stiffness="tooth_stiffness"), source=f"{ISO}, 9")

face = Chapter("Distribution of the load over the face width", needs=(*BY["face_load_factor"], DYNAMIC_KNOWN),
    text="The misalignment under load is that of the shafts, which bend and thereby stand askew in the plane of action; the twist and bending of the "
        "pinion's own body, which ISO adds, are left out.")
GIVEN: dict[str, Any] = {"lacks": ("face_load_factor",)}
for g in TEETH:
    face.value(f"helix_deviation_{g}", f"f_Hβ{g}", "um", f"Helix slope deviation of gear {g}",
        bind(f.helix_deviation, diameter=f"pitch_diameter_{g}"), source="ISO 1328-1:2013", output=False, **GIVEN)
face.value("manufacture", "f_ma", "um", "Misalignment by manufacture", lambda helix_deviation_1, helix_deviation_2:
        np.sqrt(helix_deviation_1**2 + helix_deviation_2**2), source=f"{ISO}, 7", **GIVEN)
face.value("bending", "f_sh", "um", "Misalignment by the shafts under load, of which the slope is that of the run",
    lambda face_width, slope, torque_peak, torque_run: face_width * abs(slope) * torque_peak / torque_run, source="this method", **GIVEN)
face.value("crowning_height", "C_β", "um", "Height of the crowning", lambda manufacture, bending: (manufacture + bending) / 2,
    needs=("crowned=true",), source=f"{ISO}, 7", **GIVEN)
face.value("mean_line_load", "w_m", "N/mm", "Mean line load with the dynamic factor",
    lambda line_load, dynamic_factor: line_load * dynamic_factor, source=f"{ISO}, 7", output=False, **GIVEN)
face.value("misalignment", "F_βx", "um", "Equivalent misalignment before running-in",
    bind(f.misalignment, line_load="mean_line_load", deviation_1="helix_deviation_1", deviation_2="helix_deviation_2"), source=f"{ISO}, 7", **GIVEN)
for g in TEETH:
    face.value(f"run_in_helix_{g}", f"F_β{g}", "um", f"Misalignment that gear {g} reduces by running in",
        bind(f.run_in_deviation, deviation="misalignment", velocity="pitch_velocity", slow=f"run_in_slow_{g}", fast=f"run_in_fast_{g}"),
        source=f"{ISO}, 7", output=False, **GIVEN)
face.value("misalignment_run_in", "F_βy", "um", "Equivalent misalignment after running-in",
    lambda misalignment, run_in_share_1, run_in_helix_1, run_in_share_2, run_in_helix_2:
        misalignment - (np.minimum(run_in_share_1, 1) * run_in_helix_1 + np.minimum(run_in_share_2, 1) * run_in_helix_2) / 2,
    source=f"{ISO}, 7", **GIVEN)
face.value("opening", "ρ_β", "1", "Half the ratio of the load that the misalignment causes to the mean one",
    lambda misalignment_run_in, mesh_stiffness, mean_line_load: misalignment_run_in * 0.85 * mesh_stiffness / (2 * mean_line_load),
    source=f"{ISO}, 7", output=False, **GIVEN)
face.value("face_load_factor", "K_Hβ", "1", "Face load factor for contact stress",
    lambda opening: np.where(opening < 1, 1 + opening, 2 * np.sqrt(opening)), source=f"{ISO}, 7", **GIVEN)

transverse = Chapter("Distribution of the load over the teeth in mesh", needs=(*CALCULATED, DYNAMIC_KNOWN),
    text="Method B. The base pitch deviation is taken as that of the pitch of the wheel, which is on the safe side.")
TYPED: dict[str, Any] = {"lacks": ("transverse_load_factor",)}
transverse.value("pitch_deviation", "f_pb", "um", "Base pitch deviation",
    bind(lambda diameter, module, grade_step: (0.001 * diameter / f.MILLIMETRE + 0.4 * module / f.MILLIMETRE + 5) * grade_step * f.MICROMETRE,
        diameter="pitch_diameter_2"),
    source="ISO 1328-1:2013", output=False, **TYPED)
for g in TEETH:
    transverse.value(f"run_in_pitch_{g}", f"f_p{g}", "um", f"Pitch deviation that gear {g} reduces by running in",
        bind(f.run_in_deviation, deviation="pitch_deviation", velocity="pitch_velocity", slow=f"run_in_slow_{g}", fast=f"run_in_fast_{g}"),
        source=f"{ISO}, 8", output=False, **TYPED)
transverse.value("pitch_run_in", "f_pbe", "um", "Base pitch deviation after running-in, which takes half of the share of a helix deviation",
    lambda pitch_deviation, run_in_share_1, run_in_pitch_1, run_in_share_2, run_in_pitch_2:
        pitch_deviation - (run_in_share_1 * run_in_pitch_1 + run_in_share_2 * run_in_pitch_2) / 4, source=f"{ISO}, 8", output=False, **TYPED)
transverse.value("transverse_line_load", "w_H", "N/mm", "Greatest line load over the face width",
    lambda line_load, dynamic_factor, face_load_factor: line_load * dynamic_factor * face_load_factor, source=f"{ISO}, 8", output=False, **TYPED)
transverse.value("transverse_factor", "K_α", "1", "Transverse load factor before its limits",
    bind(f.transverse_factor, stiffness="mesh_stiffness", deviation="pitch_run_in", line_load="transverse_line_load"), source=f"{ISO}, 8",
    output=False, **TYPED)
transverse.value("transverse_load_factor", "K_Hα", "1", "Transverse load factor for contact stress",
    bind(f.limited_for_flank, factor="transverse_factor"), source=f"{ISO}, 8", **TYPED)
transverse.value("transverse_load_root", "K_Fα", "1", "Transverse load factor for tooth root stress",
    bind(lambda factor, contact_ratio, contact_ratio_total:
            np.maximum(np.minimum(factor, contact_ratio_total / (0.25 * contact_ratio + 0.75)), 1),
        factor="transverse_factor"), source=f"{ISO}, 8", **TYPED)
