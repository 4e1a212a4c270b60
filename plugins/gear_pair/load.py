"""Chapters on the load of the teeth, and the factors that raise it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from diecut_report.api import (
    CURVE_ROUNDING,
    Chapter,
    Constant,
    abscissa,
    case,
    choice,
    computed,
    from_curve,
    inner,
    lookup,
    m,
    named,
    number,
    own_table,
    reduction,
    total,
    value,
)
from diecut_report.mechanics.load_cases import GREATEST, governing_case
from diecut_report.plugins.gear_pair import formulas as f
from diecut_report.plugins.gear_pair.mesh import TEETH

# fmt: off

CURVE = ("torque_curve",)
CASES = ("load_cases",)
OF_RUN = ("T_1,run", "N*m")
SELDOM = 1e5  # load cycles up to which a load case does not count for pitting

cycle = Chapter("Torque over the cycle", needs=CURVE, text="One period of the referenced curve is mapped to one revolution of the cycle angle.")
cycle.cycle_angle = abscissa(period=2 * np.pi, shown_at="torque_size_at"), "φ", "deg", "Cycle angle, one revolution per period of the torque"
cycle.torque_given = from_curve(given="torque_curve", abscissa="cycle_angle", output=False), "T_φ", "N*m", "Torque as given"
cycle.torque_pinion_curve = value(m.torque_given, needs=("torque_on=pinion",)), "T_1φ", "N*m", "Torque on the pinion", "input"
cycle.torque_pinion_curve = (value(m.torque_given * m.teeth_1 / m.teeth_2, needs=("torque_on=wheel",)), "T_1φ", "N*m",
    "Torque on the pinion, from that on the wheel without losses", "statics")
cycle.torque_size = reduction("abs_max", of="torque_pinion_curve", output=False), "T_m", "N*m", "Maximum absolute torque on the pinion"
cycle.torque_max = reduction("max", of="torque_pinion_curve"), "T_max", "N*m", "Maximum torque on the pinion"
cycle.torque_min = reduction("min", of="torque_pinion_curve"), "T_min", "N*m", "Minimum torque on the pinion"

load = Chapter("Load", text="A peak in every revolution is a regular load: the maximum torque of the cycle counts in full.")
load.torque_run = value(m.torque_size, needs=CURVE), *OF_RUN, "Maximum torque of the run on the pinion", "this method"
load.torque_run = value(abs(m.torque), needs=("torque", "torque_on=pinion")), *OF_RUN, "Maximum torque of the run on the pinion", "input"
load.torque_run = (value(abs(m.torque) * m.teeth_1 / m.teeth_2, needs=("torque", "torque_on=wheel")), *OF_RUN,
    "Maximum torque of the run on the pinion, from that on the wheel without losses", "statics")
load.require("loaded", m.torque_run > 0, key="torque", message="is 0; give the torque that the teeth carry", lacks=CURVE)
load.require("loaded_by_curve", m.torque_run > 0, key="torque_curve", needs=CURVE, message="is 0 everywhere; give the torque that the teeth carry")
load.case_frequent = (inner(np.where(m.load_cases.cycles > SELDOM, m.load_cases.torque, 0), needs=CASES), "T_jH", "N*m",
    "Torque of the load case where it counts for pitting", "this method")
load.torque_frequent = total("max", of="case_frequent", needs=CASES, output=False), "T_jH,max", "N*m", "Maximum torque of the frequent load cases"
load.torque_case = total("max", of="load_cases.torque", needs=CASES, output=False), "T_j,max", "N*m", "Maximum torque of the load cases"
load.torque_peak = (value(np.maximum(m.torque_run, m.torque_frequent), needs=CASES), "T_1", "N*m",
    "Maximum torque on the pinion, of run and frequent load cases", "this method")
load.torque_root = (value(np.maximum(m.torque_run, m.torque_case), needs=CASES), "T_1F", "N*m",
    "Maximum torque on the pinion, of run and all load cases", "this method")
for id, symbol in (("torque_peak", "T_1"), ("torque_root", "T_1F")):
    load[id] = value(m.torque_run, lacks=CASES), symbol, "N*m", "Maximum torque on the pinion: that of the run", "this method"
for id, symbol, words, torque in (("pitting_case", "C_H", "pitting", "case_frequent"), ("root_case", "C_F", "the tooth root", "load_cases.torque")):
    case_of = (symbol, "1", f"Governing load case for {words}")
    load[id] = computed(governing_case, ("torque_run", "load_cases.name", torque), GREATEST, is_text=True, needs=CASES), *case_of
    load[id] = computed(governing_case, ("torque_run",), GREATEST, is_text=True, lacks=CASES, printed=False, output=False), *case_of
load.reversing = (value((m.torque_max > CURVE_ROUNDING * m.torque_run) & (-m.torque_min > CURVE_ROUNDING * m.torque_run), needs=CURVE), "R_T", "1",
    "Reversing torque over the cycle: each tooth is bent in both directions", "this method")
load.reversing = value(m.torque_run < 0, lacks=CURVE), "R_T", "1", "Reversing torque: a single torque does not reverse", "this method"
load.alternating_factor = (value(m.inputs.alternating_factor, needs=("alternating_factor",)), "Y_M", "1", "Mean stress influence factor: as given",
    "input")
load.alternating_factor = (choice(case(0.7, "the torque reverses, so that each tooth is bent in both directions", m.reversing > 0),
    case(1, "the torque keeps its sign"), lacks=("alternating_factor",)), "Y_M", "1", "Mean stress influence factor", "ISO 6336-5 (idlers)")


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
    factors[key] = value(m.inputs[key], needs=(key,)), symbol, "1", f"{words}: as given", "input"
    for when in unless_known(key):
        factors[key] = value(assumed, **when), symbol, "1", f"{words}: assumed", "this method"
for id, symbol, words in (("transverse_load_factor", "K_Hα", "contact stress"), ("transverse_load_root", "K_Fα", "tooth root stress")):
    factors[id] = (value(m.inputs.transverse_load_factor, needs=("transverse_load_factor",)), symbol, "1",
        f"Transverse load factor for {words}: as given", "input")
    for when in unless_known("transverse_load_factor"):
        factors[id] = (choice(case(1.2, "the teeth are helical", m.helix_angle > 0), case(1, "the teeth are straight"), **when), symbol, "1",
            f"Transverse load factor for {words}: assumed", "this method")
for name, words in (*((name, words) for name, (_, words, _) in FACTORS.items()), ("transverse_load", "Transverse load factor")):
    key, told = f"{name}_factor", f"{words}: 1 where it is assumed, 0 where it is given or calculated"
    mark, marked = f"{name}_assumed", (f"n_{name[0]}", "1", told)
    factors[mark] = inner(0, needs=(key,), printed=False), *marked
    if key in BY:
        factors[mark] = inner(0, needs=BY[key], lacks=(key,), printed=False), *marked
    for when in unless_known(key):
        factors[mark] = inner(1, printed=False, **when), *marked
ASSUMED = tuple(f"{name}_assumed" for name in (*FACTORS, "transverse_load"))
factors.factors_assumed = (computed(lambda *assumed: sum(assumed), ASSUMED, "those above that are assumed", whole=True), "n_K", "1",
    "Number of assumed K factors", "this method")
factors.words("assumed_told", assumed_factors, ASSUMED, output=False)

accuracy = Chapter("Accuracy, stiffness and running-in of the teeth", needs=CALCULATED,
    text="Permissible deviations are those of the worse gear's grade, and of the wheel's size where only one counts. Solid gears.")
for kind, symbol in (("spur", "K_1α"), ("helical", "K_1β")):
    accuracy[f"k_1_{kind}"] = (lookup(K_1, by="grade", column=kind, key="grade", output=False), symbol, "N/mm",
        f"Coefficient K_1 of the dynamic factor, {kind} teeth", ISO)
accuracy.grade_step = inner(2 ** ((m.grade - 5) / 2)), "f_Q", "1", "Ratio of the deviations of the grade to those of grade 5", "ISO 1328-1:2013"
accuracy.grade_confirmed = (choice(case(11, "the teeth are straight", m.helix_angle <= 0), case(8, "the teeth are helical"), output=False), "Q_max",
    "1", "Coarsest grade of which two sources have K_1", "this method")
accuracy.tooth_compliance = (inner(f.tooth_compliance.of(teeth_1=m.virtual_teeth_1, teeth_2=m.virtual_teeth_2)), "q′", "mm*um/N",
    "Theoretical compliance of a pair of teeth", f"{ISO}, 9")
accuracy.tooth_stiffness = (inner(f.tooth_stiffness.of(compliance=m.tooth_compliance)), "c′", "N/(mm*um)",
    "Stiffness of a pair of teeth from a line load of 100 N/mm on", f"{ISO}, 9")
accuracy.crowning = inner(1, needs=("crowned=false",)), "B", "1", "Share of the misalignment that crowning leaves: all, without crowning", f"{ISO}, 7"
accuracy.crowning = (inner(0.5, needs=("crowned=true",)), "B", "1", "Share of the misalignment that crowning by half of both deviations leaves",
    f"{ISO}, 7")
for g in TEETH:
    flanks = f"flanks_{g}"
    accuracy[f"run_in_share_{g}"] = (inner(320 * f.MEGAPASCAL / m[f"sigma_h_lim_{g}"], needs=(f"{flanks}=through_hardened",)), f"η_β{g}", "1",
        f"Share of a helix deviation that gear {g} loses by running in", f"{ISO}, 7")
    for of, share in (("case_hardened", 0.15), ("grey_iron", 0.55)):
        accuracy[f"run_in_share_{g}"] = (inner(share, needs=(f"{flanks}={of}",)), f"η_β{g}", "1",
            f"Share of a helix deviation that gear {g} loses by running in", f"{ISO}, 7")
    for end, symbol, speed, words in (("slow", "s", 5, "whatever the deviation"), ("fast", "f", 10, "deviations of up to 80 µm")):
        accuracy[f"run_in_{end}_{g}"] = (lookup({"through_hardened": speed, "case_hardened": 0, "grey_iron": speed}, by=flanks, output=False),
            f"v_{symbol}{g}", "m/s", f"Pitch line velocity up to which gear {g} runs in {words}", f"{ISO}, 7")

dynamic = Chapter("Dynamic load", needs=CALCULATED, text="Method C: below the resonance, for the worse grade of the pair.")
dynamic.line_load = m.application_factor * m.tangential_force / m.face_width, "w_A", "N/mm", "Line load with the application factor", ISO
dynamic.speed_parameter = (value(m.pitch_velocity * m.teeth_1 / 100 * np.sqrt(m.ratio**2 / (1 + m.ratio**2)), lacks=KEYS[1:2]), "X", "m/s",
    "Speed that the dynamic factor depends on", f"{ISO}, 6")
dynamic.fact(DYNAMIC_KNOWN, m.speed_parameter <= METHOD_C,
    "not calculated: so fast teeth come near their resonance, where method C does not hold; give dynamic_factor", lacks=KEYS[1:2])
dynamic.k_1 = (inner(f.of_overlap.of(spur=m.k_1_spur, helical=m.k_1_helical), lacks=KEYS[1:2]), "K_1", "N/mm",
    "Coefficient of the dynamic factor, of the grade", f"{ISO}, 6")
dynamic.k_2 = (inner(f.of_overlap.of(spur=number(0.0193), helical=number(0.0087)), lacks=KEYS[1:2]), "K_2", "1",
    "Coefficient of the dynamic factor, of the speed",
    f"{ISO}, 6")
dynamic.dynamic_factor = value(f.dynamic_factor, needs=(DYNAMIC_KNOWN,), lacks=KEYS[1:2]), "K_V", "1", "Dynamic factor", f"{ISO}, 6"
dynamic.mesh_stiffness = f.mesh_stiffness.of(stiffness=m.tooth_stiffness), "c_γα", "N/(mm*um)", "Mesh stiffness", f"{ISO}, 9"

face = Chapter("Distribution of the load over the face width", needs=(*BY["face_load_factor"], DYNAMIC_KNOWN),
    text="The misalignment under load is that of the shafts, which bend and thereby stand askew in the plane of action; the twist and bending of the "
        "pinion's own body, which ISO adds, are left out.")
GIVEN: dict[str, Any] = {"lacks": ("face_load_factor",)}
for g in TEETH:
    face[f"helix_deviation_{g}"] = (inner(f.helix_deviation.of(diameter=m[f"pitch_diameter_{g}"]), **GIVEN), f"f_Hβ{g}", "um",
        f"Helix slope deviation of gear {g}", "ISO 1328-1:2013")
face.manufacture = value(np.sqrt(m.helix_deviation_1**2 + m.helix_deviation_2**2), **GIVEN), "f_ma", "um", "Misalignment by manufacture", f"{ISO}, 7"
face.bending = (value(m.face_width * abs(m.slope) * m.torque_peak / m.torque_run, **GIVEN), "f_sh", "um",
    "Misalignment by the shafts under load, of which the slope is that of the run", "this method")
face.crowning_height = value((m.manufacture + m.bending) / 2, needs=("crowned=true",), **GIVEN), "C_β", "um", "Height of the crowning", f"{ISO}, 7"
face.mean_line_load = inner(m.line_load * m.dynamic_factor, **GIVEN), "w_m", "N/mm", "Mean line load with the dynamic factor", f"{ISO}, 7"
face.misalignment = (value(f.misalignment.of(line_load=m.mean_line_load, deviation_1=m.helix_deviation_1, deviation_2=m.helix_deviation_2), **GIVEN),
    "F_βx", "um", "Equivalent misalignment before running-in", f"{ISO}, 7")
for g in TEETH:
    face[f"run_in_helix_{g}"] = (inner(f.run_in_deviation.of(deviation=m.misalignment, velocity=m.pitch_velocity, slow=m[f"run_in_slow_{g}"],
        fast=m[f"run_in_fast_{g}"]), **GIVEN), f"F_β{g}", "um", f"Misalignment that gear {g} reduces by running in", f"{ISO}, 7")
face.misalignment_run_in = (value(m.misalignment - (np.minimum(m.run_in_share_1, 1) * m.run_in_helix_1 + np.minimum(m.run_in_share_2,
    1) * m.run_in_helix_2) / 2, **GIVEN), "F_βy", "um", "Equivalent misalignment after running-in", f"{ISO}, 7")
face.opening = (inner(m.misalignment_run_in * 0.85 * m.mesh_stiffness / (2 * m.mean_line_load), **GIVEN), "ρ_β", "1",
    "Half the ratio of the load that the misalignment causes to the mean one", f"{ISO}, 7")
face.face_load_factor = (value(np.where(m.opening < 1, 1 + m.opening, 2 * np.sqrt(m.opening)), **GIVEN), "K_Hβ", "1",
    "Face load factor for contact stress", f"{ISO}, 7")

transverse = Chapter("Distribution of the load over the teeth in mesh", needs=(*CALCULATED, DYNAMIC_KNOWN),
    text="Method B. The base pitch deviation is taken as that of the pitch of the wheel, which is on the safe side.")
TYPED: dict[str, Any] = {"lacks": ("transverse_load_factor",)}
transverse.pitch_deviation = (inner((0.001 * m.pitch_diameter_2 / f.MILLIMETRE + 0.4 * m.module / f.MILLIMETRE + 5) * m.grade_step * f.MICROMETRE,
    **TYPED), "f_pb", "um", "Base pitch deviation", "ISO 1328-1:2013")
for g in TEETH:
    transverse[f"run_in_pitch_{g}"] = (inner(f.run_in_deviation.of(deviation=m.pitch_deviation, velocity=m.pitch_velocity,
        slow=m[f"run_in_slow_{g}"], fast=m[f"run_in_fast_{g}"]), **TYPED), f"f_p{g}", "um", f"Pitch deviation that gear {g} reduces by running in",
        f"{ISO}, 8")
transverse.pitch_run_in = (inner(m.pitch_deviation - (m.run_in_share_1 * m.run_in_pitch_1 + m.run_in_share_2 * m.run_in_pitch_2) / 4, **TYPED),
    "f_pbe", "um", "Base pitch deviation after running-in, which takes half of the share of a helix deviation", f"{ISO}, 8")
transverse.transverse_line_load = (inner(m.line_load * m.dynamic_factor * m.face_load_factor, **TYPED), "w_H", "N/mm",
    "Greatest line load over the face width", f"{ISO}, 8")
transverse.transverse_factor = (inner(f.transverse_factor.of(stiffness=m.mesh_stiffness, deviation=m.pitch_run_in, line_load=m.transverse_line_load),
    **TYPED), "K_α", "1", "Transverse load factor before its limits", f"{ISO}, 8")
transverse.transverse_load_factor = (value(f.limited_for_flank.of(factor=m.transverse_factor), **TYPED), "K_Hα", "1",
    "Transverse load factor for contact stress", f"{ISO}, 8")
transverse.transverse_load_root = (value(np.maximum(np.minimum(m.transverse_factor, m.contact_ratio_total / (0.25 * m.contact_ratio + 0.75)), 1),
    **TYPED), "K_Fα", "1", "Transverse load factor for tooth root stress", f"{ISO}, 8")
