"""External gear pair, also sector and pinion: geometry (ISO 21771), pitting and tooth root (ISO 6336-2, -3:2006, method B)."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.gear_pair import load, rating
from diecut_report.plugins.gear_pair.figures import FIGURES
from diecut_report.plugins.gear_pair.inputs import GEARS, ExternalGearPair
from diecut_report.plugins.gear_pair.load import CALCULATED, DYNAMIC_KNOWN, ISO, KEYS, METHOD_C
from diecut_report.plugins.gear_pair.mesh import mesh
from diecut_report.plugins.gear_pair.rating import root_form
from diecut_report.plugins.gear_pair.sizing import MODULES, module

LEAST_CONTACT = 1.1

# fmt: off

MODULE = (Vary("module", "up", MODULES), ("center_distance", "module"))
ROOM = ("keep_clearance", Vary("dedendum", "up"))


def _strength(gear: int) -> tuple[Check, Check]:
    """Pitting and breakage of one gear."""
    name = GEARS[gear]
    return (
        Check(f"pitting_{gear}", "strength", f"Pitting of the {name}", m.required_pitting_safety, m[f"pitting_safety_{gear}"],
              demand_label="required safety factor", limit_label="safety", source="ISO 6336-2:2006", needs=(DYNAMIC_KNOWN,),
              founded=(f"life_factor_h_{gear}",), consequence=f"the flanks of the {name} wear out by pitting; governing load case: {{pitting_case}}.",
              advise=(Vary(f"sigma_h_lim_{gear}", "up"), Vary("face_width", "up"), *MODULE)),
        Check(f"root_{gear}", "strength", f"Tooth root of the {name}", m.required_root_safety, m[f"root_safety_{gear}"],
              demand_label="required safety factor", limit_label="safety", source="ISO 6336-3:2006", needs=(DYNAMIC_KNOWN,),
              founded=(f"life_factor_f_{gear}",), consequence=f"teeth of the {name} break at the root; governing load case: {{root_case}}.",
              advise=(Vary(f"sigma_f_lim_{gear}", "up"), Vary("face_width", "up"), *MODULE)),
    )


STRENGTH = [_strength(g) for g in GEARS]
CHECKS = (STRENGTH[0][0], STRENGTH[1][0], STRENGTH[0][1], STRENGTH[1][1],
    Check("contact_ratio", "function", "Contact ratio", LEAST_CONTACT, m.contact_ratio, demand_label="required", limit_label="contact ratio",
        source="practice", consequence="a pair of teeth parts before the next one carries; less shift or tips that are not shortened raise it.",
        advise=(Vary("addendum", "up"), ("teeth_1", "teeth_2"))),
    Check("clearance", "function", "Tip clearance to the mating root", 0.0, m.tip_clearance_least, demand_label="required",
        consequence="a tip meets the other gear's root.", advise=ROOM),
    Check("sector_teeth", "function", "Teeth of the sector", m.teeth_needed, m.sector.teeth_present, needs=("sector", "sector.teeth_present"),
        demand_label="required for the swing", limit_label="present", consequence="the pinion leaves the sector at the end of its swing.",
        advise=(Vary("sector.teeth_present", "up"),)),
    Check("undercut", "practice", "Undercut", m.shift_lacking, 0.0, severity="warn", demand_label="missing profile shift", limit_label="allowed",
        consequence="the rack cuts the involute away near the root, and the root is weaker than calculated.",
        advise=("shift_1", "shift_2", ("shift_1", "shift_2"))),
    Check("tip_thickness", "practice", "Tip thickness", m.tip_thickness_wanted, m.tip_thickness_least, severity="warn",
        demand_label="usual, 0.2 modules", limit_label="thinner tip", consequence="thin tips chip where they are hardened; more teeth thicken them.",
        advise=(Vary("addendum", "down"), Vary("shift_1", "down"), Vary("shift_2", "down"), ("shift_1", "shift_2"))),
    Check("tip_clearance", "practice", "Tip clearance", m.tip_clearance_wanted, m.tip_clearance_least, severity="warn",
        demand_label="usual, 0.12 modules", consequence="little room for errors and dirt.", advise=ROOM),
    Check("notch_parameter", "practice", "Notch at the root", m.notch_parameter, 8.0, presumed=True, at_least=1.0, operator="<", severity="warn",
        demand_label="notch parameter", limit_label="range of Y_S", consequence="the stress correction Y_S does not hold there.",
        advise=("root_radius",)),
    Check("face_width", "practice", "Face width", m.face_width, m.face_width_wanted, severity="warn", demand_label="face width",
        limit_label="usual, 1.2 pinion diameters", consequence="so wide teeth bear at one end.", advise=(Vary("face_width", "down"), MODULE[0])),
    Check("k_factors", "practice", "K factors", m.factors_assumed, 0.0, severity="warn", founded=KEYS, demand_label="number of assumed factors",
        source=ISO,
        consequence="{assumed_told} are assumed, not calculated; give the grade of accuracy, the speed and the slope of the shafts, with "
                    "which they are calculated, or their values."),
    Check("dynamic_range", "practice", "Range of the dynamic factor", m.speed_parameter, METHOD_C, severity="warn", only_with=CALCULATED,
        presumed=True, demand_label="speed", limit_label="end of method C", source="IACS UR M56",
        consequence="method C does not hold near the resonance; give dynamic_factor.", advise=(Vary("speed", "down"),)),
    Check("grade_confirmed", "practice", "Sources of the dynamic factor", m.grade, m.grade_confirmed, severity="warn", only_with=CALCULATED,
        presumed=True, demand_label="grade", limit_label="confirmed by two sources", source=ISO,
        consequence="the coefficient K_1 of so coarse helical teeth is from one source; give dynamic_factor.", advise=(Vary("grade", "down"),)))


EXAMPLE = ExampleBlock(
    "main_gears",
    {
        "module": "5 mm",
        "teeth_1": 24,
        "teeth_2": 48,
        "face_width": "50 mm",
        "torque": Wired("${<cylinder_drive>.crank_torque}", otherwise="500 N*m"),
        "torque_on": "wheel",
        "application_factor": Wired(1, needs=("cylinder_drive",), otherwise=1.25),  # a curve holds the dynamics
        "dynamic_factor": 1.1,
        "face_load_factor": 1.3,
        "transverse_load_factor": 1.1,
        "sigma_h_lim_1": "767 MPa",
        "sigma_h_lim_2": "767 MPa",
        "sigma_f_lim_1": "314 MPa",
        "sigma_f_lim_2": "314 MPa",
    },
)


MECHANISM = Mechanism(
    kind="gear_pair",
    version="1.0",
    title="External gear pair",
    summary="Geometry, forces and safety against pitting and tooth breakage of an external spur or helical gear pair, of full wheels or of "
            "pinion and sector. The K factors are calculated by ISO 6336-1 from grade, speed and slope of the shafts. If the module is omitted, the "
            "smallest preferred one is selected with which flank and root of both gears have the required safety.",
    inputs=ExternalGearPair,
    example=EXAMPLE,
    chapters=(load.cycle, load.load, load.factors, mesh, root_form, load.accuracy, module, rating.sizes, rating.forces,
              load.dynamic, load.face, load.transverse, rating.pitting, rating.root_stress, rating.over_cycle, rating.sector),
    key_results=("module", "center_distance", "shift_2", "contact_ratio", "tangential_force", "pitting_safety_1", "pitting_safety_2", "root_safety_1",
                 "root_safety_2"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "Edition 2006 of ISO 6336: that of 2019 adds f_ε to Y_F for helical gears and divides Y_β by cos³β; for spur gears with a contact ratio "
        "below 2 both agree.",
        "Not covered: scuffing, micropitting, flank breakage, yield of the flanks, load spectra, "
        "internal gears, racks, bevel gears, protuberance and grinding notches, thin rims (Y_B > 1), deep teeth (Y_DT < 1), virtual contact "
        "ratios from 2 upwards.",
        "The misalignment under load is that of the shafts alone: twist and bending of the pinion's own body are left out. Solid gears.",
        "The maximum torque of cycle and load cases acts at any position in the mesh, on every tooth; no losses between pinion and wheel.",
        "A torque that changes its sign bends each tooth in both directions: Y_M = 0.7, on the safe side where the reverse torque is smaller. A "
        "reversing sector hammers through its backlash at each change of flank; the application factor must include that shock.",
        "All lengths are without backlash; both gears are cut by the same basic rack.",
    ),
    sources=(
        Source("ISO 21771", "ISO 21771:2007, Gears. Cylindrical involute gears and gear pairs. Concepts and geometry."),
        Source("ISO 6336-1", "ISO 6336-1:2019, Calculation of load capacity of spur and helical gears. Part 1: Basic principles, introduction and "
               "general influence factors."),
        Source("ISO 6336-2:2006", "ISO 6336-2:2006, Part 2: Calculation of surface durability (pitting), with corrigendum 1:2008."),
        Source("ISO 6336-3:2006", "ISO 6336-3:2006, Part 3: Calculation of tooth bending strength."),
        Source("ISO 6336-5", "ISO 6336-5, Part 5: Strength and quality of materials."),
        Source("ISO 1328-1:2013", "ISO 1328-1:2013, Cylindrical gears. ISO system of flank tolerance classification. Part 1: Definitions and "
               "allowable values of deviations relevant to flanks of gear teeth."),
        Source("ISO 54", "ISO 54, Cylindrical gears for general engineering and for heavy engineering. Modules."),
    ),
)  # fmt: skip
