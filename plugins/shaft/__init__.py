"""Stepped shaft on two bearings (Shigley, chapters 6 and 7)."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.shaft import geometry, sizing, strength
from diecut_report.plugins.shaft.figures import FIGURES
from diecut_report.plugins.shaft.inputs import Shaft

THICKER = (("sections.diameter", "sections.bore", "sections.fillet_radius"),)

CHECKS = (
    Check("fatigue", "strength", "Fatigue", m.required_fatigue_safety, m.place_safety, founded=("reliability",),
        demand_label="required safety factor", limit_label="safety",
        consequence="a crack would begin at the {fatigue_place}, at {fatigue_position} from the left end; a stronger steel or bearings nearer to "
            "the loads helps, too.", advise=THICKER),
    Check("yield", "strength", "Yield", m.required_yield_safety, m.yield_safety, demand_label="required safety factor", limit_label="safety",
        consequence="the shaft would bend for good at {nominal_position} from the left end, governing load case: {yield_case}; a stronger steel or "
            "bearings nearer to the loads helps, too.", advise=THICKER),
    Check("yield_notch", "practice", "Yield in a notch", 1.0, m.place_yield_safety, severity="warn", demand_label="minimum safety factor",
        limit_label="safety factor with the notch", consequence="the ground of a notch yields.", advise=(Vary("yield_strength", "up"), *THICKER)),
    Check("bearing_slope", "practice", "Slope at the bearings", m.bearing_slope_max, m.allowable_bearing_slope, severity="warn",
        demand_label="maximum slope", limit_label="accepted", source="Shigley table 7-2",
        consequence="rollers and balls are loaded unevenly (deep groove balls bear 1 to 3 mrad, cylindrical rollers 0.8 to 1.2 mrad).",
        advise=THICKER),
    Check("critical_speed", "practice", "Critical speed", m.twice_speed, m.turning_limit, severity="warn", needs=("speed",),
        limit_label="critical speed", consequence="the shaft runs too near to its critical speed; a shorter shaft has a higher one.",
        advise=(Vary("speed", "down"), *THICKER)),
    Check("at_rest", "function", "Shaft at rest", m.standing_speed, 0.0, only_with=("speed",), demand_label="speed", limit_label="by rotation",
        consequence="what has a speed turns: its fatigue and its critical speed are not those of a shaft that stands; write turning for rotation, "
            "or remove speed."),
    Check("deflection", "function", "Deflection", m.deflection_max, m.allowable_deflection, needs=("allowable_deflection",), source="input",
        consequence="what runs on the shaft leaves its place.", advise=THICKER),
    Check("twist", "function", "Twist", m.twist_by_length, m.allowable_twist, needs=("allowable_twist",), demand_label="twist per unit length",
        source="input", consequence="the shaft is too soft in torsion.", advise=THICKER),
    Check("notch_range", "practice", "Range of the fillets", m.fillet_ratio, 4.0, at_least=0.25, severity="warn",
        demand_label="ratio of step to radius", limit_label="end of the charts", at_least_label="start of the charts",
        source="Peterson, charts 3.10 and 3.12", presumed=True,
        consequence="the factors of shoulder {part} are taken beyond the charts, and are uncertain.", advise=("sections.fillet_radius",)),
    Check("hollow_notch", "practice", "Bore at a fillet", m.bore_ratio, 0.5, severity="warn", demand_label="ratio of bore to diameter",
        limit_label="end of the charts", presumed=True, consequence="the charts are for solid shafts, and the factors of shoulder {part} uncertain.",
        advise=(Vary("sections.bore", "down"),)),
    Check("size", "practice", "Size of the shaft", m.greatest_effective, 254.0, severity="warn", demand_label="effective diameter",
        limit_label="limit of the size factor", source="Shigley 6-20", presumed=True,
        consequence="the size factor of 254 mm is taken, which is too good for a thicker shaft; ask for tests of so thick a section."),
    Check("energy", "numerical", "Strain energy of the bent shaft", m.energy_difference, 1e-8, demand_label="difference from the work of the loads",
        limit_label="rounding", source="Castigliano", consequence="the deflection line does not fit the moments."),
    Check("critical_bounds", "numerical", "Bounds of the critical speed", m.critical_speed, m.critical_speed_rayleigh,
        at_least=m.critical_speed_dunkerley, tolerance=1e-6, demand_label="critical speed", limit_label="Rayleigh", at_least_label="Dunkerley",
        consequence="the eigenvalue is wrong."),
)  # fmt: skip


EXAMPLE = ExampleBlock(
    "crankshaft",
    {
        "sections": [
            {"length": "50 mm", "diameter": "45 mm", "fillet_radius": "1.5 mm"},
            {"length": "170 mm", "diameter": "55 mm", "fillet_radius": "2 mm"},
            {"length": "60 mm", "diameter": "60 mm", "fillet_radius": "2 mm"},
            {"length": "60 mm", "diameter": "50 mm"},
        ],
        "notches": [
            {"position": "130 mm", "type": "keyseat_end_mill"},
            {"position": "310 mm", "type": "keyseat_end_mill"},
        ],
        "bearing_a": "25 mm",
        "bearing_b": "250 mm",
        "tensile_strength": "900 MPa",
        "yield_strength": "650 MPa",
        "speed": Wired("${<cylinder_drive>.crank_speed}", otherwise="50 rpm"),
        "loads": [
            {
                "name": "gear",
                "position": "130 mm",
                "torque": Wired("${<cylinder_drive>.crank_torque}", otherwise="500 N*m"),
                "gear": {"pitch_radius": "120 mm", "mesh_angle": "0 deg"},
                "mass": "12 kg",
            },
            {
                "name": "crank",
                "position": "310 mm",
                "offset": "45 mm",
                "force_y": Wired("${<cylinder_drive>.crank_bearing_force_x}", otherwise="5 kN"),
                "force_z": Wired("${<cylinder_drive>.crank_bearing_force_y}", otherwise="5 kN"),
                "torque": "balance",
                "mass": "8 kg",
            },
        ],
    },
)


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
        sizing.diameters, geometry.sections, strength.steel, strength.own_steel, geometry.places, geometry.notches, geometry.endurance,
        strength.loads, strength.bending, strength.fatigue, strength.yielding, strength.critical, strength.enough,
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
