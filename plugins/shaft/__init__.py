"""Stepped shaft on two bearings (Shigley, chapters 6 and 7)."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.shaft import geometry, sizing, steels, strength
from diecut_report.plugins.shaft.checks import CHECKS
from diecut_report.plugins.shaft.example import EXAMPLE
from diecut_report.plugins.shaft.figures import FIGURES
from diecut_report.plugins.shaft.inputs import Shaft

MECHANISM = Mechanism(
    kind="shaft",
    version="1.0",
    title="Stepped shaft on two bearings",
    summary="A round stepped shaft rotates, stands or oscillates on two bearings under loads that are constant or vary over a cycle. The "
            "calculation gives reactions, bending moment, torque, deflection, slopes, twist, the safety against fatigue and yield at each "
            "shoulder, notch, bearing and load, and the critical speed. If the diameter of a section is omitted, the smallest sufficient "
            "preferred one is selected.",
    inputs=Shaft,
    example=EXAMPLE,
    chapters=(
        sizing.diameters, geometry.sections, steels.steel, steels.own_steel, geometry.places, geometry.notches, geometry.endurance, strength.loads,
        strength.bending, strength.fatigue, strength.yielding, strength.critical, strength.enough,
    ),
    reactions=("reaction_a", "reaction_b"),
    key_results=("reaction_a_max", "reaction_b_max", "bending_moment_max", "fatigue_safety", "fatigue_place", "yield_safety", "deflection_max",
                 "bearing_slope_max", "speed_verdict", "shaft_mass"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The bearings are rigid and without clearance, their reactions act at points; the shaft bends by Euler and Bernoulli, without shear "
        "deflection and gyroscopic effect. Its own weight does not bend it unless it is given as loads.",
        "Infinite life only. Ranges of bending and torsion are combined as if in phase, the axial stress takes the notch factor of bending, and a "
        "compressive mean stress counts like a tensile one: all on the safe side. The shear stress of the transverse force is neglected.",
        "The seats of the two bearings and of the parts that carry the loads have the notch effect of press fits, unless they are given as loose "
        "or as none; of a seat and a keyseat at one location the larger factor is used.",
        "Keyseats and press fits have the notch factors of DIN 743-2, which apply to the nominal stress of the full diameter; their size factor "
        "is from the formulas of two public implementations, one of which refers the keyseat's to 15 mm instead of 40 mm.",
        "Published fits of stress concentration factors differ by up to a tenth; further digits are not significant.",
        "Not covered: more than two bearings, finite life, DIN 743, fretting beyond the factor of a press fit, torsional vibration.",
    ),
    sources=(
        Source("Shigley", "Budynas R. G., Nisbett J. K. Shigley's Mechanical Engineering Design. 10th ed. McGraw-Hill, 2015, chapters 6, 7 and 17."),
        Source("Peterson", "Pilkey W. D. Peterson's Stress Concentration Factors. 2nd ed. Wiley, 1997, charts 3.10 and 3.12."),
        Source("EN 10083", "EN 10083, Steels for quenching and tempering: least strengths of round bars, as makers' tables agree on them."),
        Source("DIN 743-2", "DIN 743-2:2012, Calculation of load capacity of shafts and axles, part 2: theoretical stress concentration factors and "
               "fatigue notch factors, table 1."),
    ),
)  # fmt: skip
