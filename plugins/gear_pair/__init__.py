"""External gear pair, also sector and pinion: geometry (ISO 21771), pitting and tooth root (ISO 6336-2, -3:2006, method B)."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.gear_pair import load, load_factors, rating
from diecut_report.plugins.gear_pair.checks import CHECKS
from diecut_report.plugins.gear_pair.example import EXAMPLE
from diecut_report.plugins.gear_pair.figures import FIGURES
from diecut_report.plugins.gear_pair.inputs import ExternalGearPair
from diecut_report.plugins.gear_pair.mesh import mesh
from diecut_report.plugins.gear_pair.root_form import root_form
from diecut_report.plugins.gear_pair.sizing import module

MECHANISM = Mechanism(
    kind="gear_pair",
    version="1.0",
    title="External gear pair",
    summary="Geometry, forces and safety against pitting and tooth breakage of an external spur or helical gear pair, of full wheels or of "
            "pinion and sector. The K factors are calculated by ISO 6336-1 from grade, speed and slope of the shafts. If the module is omitted, the "
            "smallest preferred one is selected with which flank and root of both gears have the required safety.",
    inputs=ExternalGearPair,
    example=EXAMPLE,
    chapters=(load.cycle, load.load, load_factors.factors, mesh, root_form, load_factors.accuracy, module, rating.sizes, rating.forces,
              load_factors.dynamic, load_factors.face, load_factors.transverse, rating.pitting, rating.root_stress, rating.over_cycle, rating.sector),
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
