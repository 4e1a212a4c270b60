"""Stepped shaft on two bearings (Shigley, chapters 6 and 7)."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired
from diecut_report.plugins.shaft import geometry, sizing, strength
from diecut_report.plugins.shaft.figures import FIGURES
from diecut_report.plugins.shaft.inputs import Shaft

THICKER = (("sections.diameter", "sections.bore", "sections.fillet_radius"),)

CHECKS = (
    Check(id="fatigue", check_class="strength", title="Fatigue", demand="required_fatigue_safety", limit="place_safety", unit="1",
        founded=("reliability",), demand_label="required safety factor", limit_label="safety", source="Shigley 7-7",
        consequence="a crack would begin at the {fatigue_place}, at {fatigue_position} from the left end; a stronger steel or bearings nearer to "
            "the loads helps, too.", advise=THICKER),
    Check(id="yield", check_class="strength", title="Yield", demand="required_yield_safety", limit="yield_safety", unit="1",
        demand_label="required safety factor", limit_label="safety", source="Shigley 7-16",
        consequence="the shaft would bend for good at {nominal_position} from the left end, governing load case: {yield_case}; a stronger steel or "
            "bearings nearer to the loads helps, too.", advise=THICKER),
    Check(id="yield_notch", check_class="practice", title="Yield in a notch", demand=1.0, limit="place_yield_safety", unit="1", severity="warn",
        demand_label="minimum safety factor", limit_label="safety factor with the notch", source="Shigley 7-16",
        consequence="the ground of a notch yields.", advise=(Vary("yield_strength", "up"), *THICKER)),
    Check(id="bearing_slope", check_class="practice", title="Slope at the bearings", demand="bearing_slope_max", limit="allowable_bearing_slope",
        unit="mrad", severity="warn", demand_label="maximum slope", limit_label="accepted", source="Shigley table 7-2",
        consequence="rollers and balls are loaded unevenly (deep groove balls bear 1 to 3 mrad, cylindrical rollers 0.8 to 1.2 mrad).",
        advise=THICKER),
    Check(id="critical_speed", check_class="practice", title="Critical speed", demand="twice_speed", limit="turning_limit", unit="rpm",
        severity="warn", needs=("speed",), demand_label="twice the speed", limit_label="critical speed", source="Shigley 7-6",
        consequence="the shaft runs too near to its critical speed; a shorter shaft has a higher one.", advise=(Vary("speed", "down"), *THICKER)),
    Check(id="at_rest", check_class="function", title="Shaft at rest", demand="standing_speed", limit=0.0, unit="rpm", only_with=("speed",),
        demand_label="speed", limit_label="by rotation", source="input",
        consequence="what has a speed turns: its fatigue and its critical speed are not those of a shaft that stands; write turning for rotation, "
            "or remove speed."),
    Check(id="deflection", check_class="function", title="Deflection", demand="deflection_max", limit="allowable_deflection", unit="um",
        needs=("allowable_deflection",), demand_label="maximum deflection", limit_label="allowed", source="input",
        consequence="what runs on the shaft leaves its place.", advise=THICKER),
    Check(id="twist", check_class="function", title="Twist", demand="twist_by_length", limit="allowable_twist", unit="deg/m",
        needs=("allowable_twist",), demand_label="twist per unit length", limit_label="allowed", source="input",
        consequence="the shaft is too soft in torsion.", advise=THICKER),
    Check(id="notch_range", check_class="practice", title="Range of the fillets", demand="fillet_ratio", limit=4.0, at_least=0.25, unit="1",
        severity="warn", demand_label="ratio of step to radius", limit_label="end of the charts", at_least_label="start of the charts",
        source="Peterson, charts 3.10 and 3.12", presumed=True,
        consequence="the factors of shoulder {part} are taken beyond the charts, and are uncertain.", advise=("sections.fillet_radius",)),
    Check(id="hollow_notch", check_class="practice", title="Bore at a fillet", demand="bore_ratio", limit=0.5, unit="1", severity="warn",
        demand_label="ratio of bore to diameter", limit_label="end of the charts", source="Peterson", presumed=True,
        consequence="the charts are for solid shafts, and the factors of shoulder {part} uncertain.", advise=(Vary("sections.bore", "down"),)),
    Check(id="size", check_class="practice", title="Size of the shaft", demand="greatest_effective", limit=254.0, unit="mm", severity="warn",
        demand_label="effective diameter", limit_label="limit of the size factor", source="Shigley 6-20", presumed=True,
        consequence="the size factor of 254 mm is taken, which is too good for a thicker shaft; ask for tests of so thick a section."),
    Check(id="energy", check_class="numerical", title="Strain energy of the bent shaft", demand="energy_difference", limit=1e-8, unit="1",
        demand_label="difference from the work of the loads", limit_label="rounding", source="Castigliano",
        consequence="the deflection line does not fit the moments."),
    Check(id="critical_bounds", check_class="numerical", title="Bounds of the critical speed", demand="critical_speed",
        limit="critical_speed_rayleigh", at_least="critical_speed_dunkerley", unit="rpm", tolerance=1e-6, demand_label="critical speed",
        limit_label="Rayleigh", at_least_label="Dunkerley", source="Shigley 7-6", consequence="the eigenvalue is wrong."),
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
