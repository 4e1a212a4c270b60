"""Checks of the gear pair, and the chapter of words that they end with."""

from __future__ import annotations

from diecut_report.api import Chapter, Check
from diecut_report.plugins.gear_pair import advice
from diecut_report.plugins.gear_pair.mesh import GIVEN_DISTANCE, TEETH

ROUNDING = 1e-9  # relative: what is typed in at its limit reaches it
GEARS = {1: "pinion", 2: "wheel"}
LEAST_CONTACT, LEAST_CLEARANCE = 1.1, 0.12

# fmt: off

advice_chapter = Chapter("Advice")
for g in TEETH:
    safety, strength = (f"pitting_safety_{g}", "required_pitting_safety"), (f"root_safety_{g}", "required_root_safety")
    advice_chapter.words(f"pitting_advice_{g}", advice.against_pitting(g), (f"sigma_h_lim_{g}", *safety, "face_width", "face_width_wanted"),
                         output=False)
    advice_chapter.words(f"root_advice_{g}", advice.against_breakage(g),
                         (f"sigma_f_lim_{g}", *strength, "face_width", "face_width_wanted", "face_load_factor", "face_load_root"), output=False)
advice_chapter.words("module_advice", advice.greater_module, ("module", "module_least"), lacks=GIVEN_DISTANCE, output=False)
advice_chapter.words("module_advice", advice.greater_module_and_distance, ("module",), needs=GIVEN_DISTANCE, output=False)
SHIFTS = ("shift_1", "shift_min_1", "shift_2", "shift_min_2")
advice_chapter.words("undercut_advice", advice.against_undercut, SHIFTS, lacks=GIVEN_DISTANCE, output=False)
advice_chapter.words("undercut_advice", advice.against_undercut_at_distance, SHIFTS, needs=GIVEN_DISTANCE, output=False)
ROOM = ("tip_clearance_least", "module", "addendum", "dedendum")
advice_chapter.words("meeting_advice", advice.clearance_for(0.0), ROOM, output=False)
advice_chapter.words("clearance_advice", advice.clearance_for(LEAST_CLEARANCE), ROOM, output=False)


def _strength(gear: int) -> tuple[Check, Check]:
    """Pitting and breakage of one gear."""
    name = GEARS[gear]
    return (
        Check(id=f"pitting_{gear}", check_class="strength", title=f"Pitting of the {name}", demand="required_pitting_safety",
              limit=f"pitting_safety_{gear}", unit="1", demand_label="required safety", limit_label="safety", tolerance=ROUNDING,
              source="ISO 6336-2:2006", consequence=f"the flanks of the {name} wear out by pitting; {{pitting_advice_{gear}}}{{module_advice}}."),
        Check(id=f"root_{gear}", check_class="strength", title=f"Tooth root of the {name}", demand="required_root_safety",
              limit=f"root_safety_{gear}", unit="1", demand_label="required safety", limit_label="safety", tolerance=ROUNDING,
              source="ISO 6336-3:2006", consequence=f"teeth of the {name} break at the root; {{root_advice_{gear}}}{{module_advice}}."),
    )


STRENGTH = [_strength(g) for g in GEARS]
CHECKS = (
    STRENGTH[0][0], STRENGTH[1][0], STRENGTH[0][1], STRENGTH[1][1],
    Check(id="contact_ratio", check_class="function", title="Contact ratio", demand=LEAST_CONTACT, limit="contact_ratio", unit="1",
          demand_label="needed", limit_label="contact ratio", source="practice",
          consequence="a pair of teeth parts before the next one carries; more teeth, a greater addendum, less shift or tips that are not "
          "shortened raise it."),
    Check(id="clearance", check_class="function", title="Room at the tips", demand=0.0, limit="tip_clearance_least", unit="mm",
          demand_label="needed", limit_label="smaller tip clearance", source="ISO 21771",
          consequence="a tip meets the other gear's root; {meeting_advice}."),
    Check(id="sector_teeth", check_class="function", title="Teeth of the sector", demand="teeth_needed", limit="sector.teeth_present", unit="1",
          needs=("sector", "sector.teeth_present"), demand_label="needed for the swing", limit_label="present", source="this method",
          consequence="the pinion leaves the sector at the end of its swing; set sector.teeth_present to at least {teeth_needed}."),
    Check(id="undercut", check_class="practice", title="Undercut", demand="shift_lacking", limit=0.0, unit="1", severity="warn", tolerance=1e-9,
          demand_label="shift that is lacking", limit_label="allowed", source="ISO 21771",
          consequence="the rack cuts the involute away near the root, and the root is weaker than calculated; {undercut_advice}."),
    Check(id="tip_thickness", check_class="practice", title="Thickness at the tips", demand="tip_thickness_wanted", limit="tip_thickness_least",
          unit="mm", severity="warn", demand_label="usual, 0.2 modules", limit_label="thinner tip", source="practice",
          consequence="thin tips chip where they are hardened; less shift, a smaller addendum or more teeth thicken them."),
    Check(id="tip_clearance", check_class="practice", title="Tip clearance", demand="tip_clearance_wanted", limit="tip_clearance_least", unit="mm",
          severity="warn", tolerance=ROUNDING, demand_label="usual, 0.12 modules", limit_label="smaller tip clearance", source="practice",
          consequence="little room for errors and dirt; {clearance_advice}."),
    Check(id="notch_parameter", check_class="practice", presumed=True, title="Notch at the root", demand="notch_parameter", limit=8.0, at_least=1.0,
          unit="1",
          operator="<", severity="warn", demand_label="notch parameter", limit_label="range of Y_S", source="ISO 6336-3:2006, 7",
          consequence="the stress correction Y_S does not hold there; a greater root_radius lowers the parameter, a smaller one raises it."),
    Check(id="face_width", check_class="practice", title="Face width", demand="face_width", limit="face_width_wanted", unit="mm", severity="warn",
          tolerance=ROUNDING, demand_label="face width", limit_label="usual, 1.2 pinion diameters", source="practice",
          consequence="so wide teeth bear at one end; set face_width to at most {face_width_wanted:down}, or take a greater module."),
    Check(id="k_factors", check_class="practice", title="K factors", demand="factors_assumed", limit=0.0, unit="1", severity="warn",
          founded=("application_factor", "dynamic_factor", "face_load_factor", "transverse_load_factor"),
          demand_label="factors that are assumed", limit_label="accepted", source="ISO 6336-1",
          consequence="{assumed_told} are assumed, not calculated; give them by ISO 6336-1."),
)
