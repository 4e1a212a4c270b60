"""Checks of the roller chain."""

from __future__ import annotations

from diecut_report.api import Check
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, DRIVE
from diecut_report.plugins.roller_chain.strength import USUAL_PITCHES

ROUNDING = 1e-9  # relative: what is typed in at its limit reaches it
STRONGER = "take a chain of at least {breaking_load_needed:up} breaking load, more strands or a larger sprocket (less tension)."

# fmt: off

CHECKS = (
    Check(id="safety_dynamic", check_class="strength", title="Safety against breaking, dynamic", demand="required_safety_dynamic",
          limit="safety_dynamic", unit="1", demand_label="required safety", limit_label="safety", tolerance=ROUNDING, source="Diamond Chain",
          sized_unless=("chain",), consequence="the plates break by fatigue; " + STRONGER),
    Check(id="safety_static", check_class="strength", title="Safety against breaking, static", demand="required_safety_static",
          limit="safety_static", unit="1", demand_label="required safety", limit_label="safety", tolerance=ROUNDING, source="iwis",
          sized_unless=("chain",), consequence="too little is left for what is not calculated; " + STRONGER),
    Check(id="bearing_pressure", check_class="strength", title="Pressure of the joints", demand="bearing_pressure",
          limit="allowable_bearing_pressure", unit="MPa", demand_label="pressure", limit_label="allowed", tolerance=ROUNDING, source="maker",
          sized_unless=("chain",),
          consequence="the joints wear and the chain lengthens; take a chain with a bearing_area of at least {bearing_area_needed:up}, or more "
          "strands."),
    Check(id="links_even", check_class="practice", title="Even number of links", demand="links_odd", limit=0.0, unit="1", severity="warn",
          demand_label="links beyond an even number", limit_label="allowed", source="practice",
          consequence="the chain needs a cranked link, with which a ninth of the breaking load may be used in place of a sixth (Diamond Chain); set "
          "links to {links_next}, or required_safety_dynamic to 9."),
    Check(id="teeth", check_class="practice", title="Teeth of the smaller sprocket", demand="teeth_usual", limit="teeth_small", unit="1",
          severity="warn", demand_label="usual", limit_label="teeth", source="practice",
          consequence="the chain runs roughly and wears; give it {teeth_usual} teeth or more."),
    Check(id="speed_unevenness", check_class="practice", title="Unevenness of the velocity", demand="speed_unevenness", limit=2.0, unit="%",
          severity="warn", demand_label="velocity lost within a tooth", limit_label="usual", source="practice",
          consequence="the strand is shaken at each tooth; set teeth_1 to at least {teeth_even_running}."),
    Check(id="center_distance", check_class="practice", title="Distance of the axes", demand="center_in_pitches", limit=float(USUAL_PITCHES[1]),
          at_least=float(USUAL_PITCHES[0]), unit="1", severity="warn", needs=(DRIVE,), tolerance=ROUNDING, demand_label="distance in pitches",
          limit_label="usual", at_least_label="at least", source="practice",
          consequence="short strands wear sooner, long ones whip (beyond 80 pitches they must be carried); set center_distance to between "
          "{center_low:up} and {center_high:down}."),
    Check(id="wrap", check_class="practice", title="Wrap of the smaller sprocket", demand=120.0, limit="wrap_small", unit="deg", severity="warn",
          tolerance=ROUNDING, demand_label="needed", limit_label="wrap", source="practice",
          consequence="too few teeth share the load; the distance of the axes must be at least {center_wrapped:up}."),
    Check(id="power_rating", check_class="practice", title="Power rating", demand="design_power", limit="rated_power", unit="kW", severity="warn",
          tolerance=ROUNDING, needs=(DRIVE, "power_rating"), demand_label="power with application factor", limit_label="rated", source="ANSI B29.1",
          consequence="the chain does not last 15 000 h, by its {rating_governing}; take a larger chain, more strands or more teeth."),
    Check(id="slack_side", check_class="practice", title="Slack of the returning strand", demand="useful_tension", limit="slack_tension", unit="N",
          severity="warn", tolerance=ROUNDING, needs=(CONVEYOR,), demand_label="useful tension when the drive brakes",
          limit_label="sag and pretension", source="statics",
          consequence="the returning strand goes slack when the drive brakes; give it a tensioner, or set pretension to at least "
          "{pretension_needed:up}."),
    Check(id="length_formula", check_class="practice", presumed=True, title="Formula of the length", demand="links_residual", limit=0.01,
          unit="1", severity="warn",
          demand_label="links that the exact polygon differs", limit_label="accepted", source="geometry",
          consequence="sprockets so unlike stand so near that the formula of the catalogues is coarse: let the distance of the axes be "
          "adjustable."),
)
