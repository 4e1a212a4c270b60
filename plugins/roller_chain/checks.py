"""Checks of the roller chain."""

from __future__ import annotations

from diecut_report.api import Check, Vary
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, DRIVE
from diecut_report.plugins.roller_chain.strength import USUAL_PITCHES

CHAIN = Vary("chain", series=("08B", "10B", "12B", "16B", "20B", "24B"))
STRONGER = (CHAIN, Vary("breaking_load", "up"), Vary("strands", "up"), Vary("teeth_1", "up"))

# fmt: off

CHECKS = (
    Check(id="safety_dynamic", check_class="strength", title="Dynamic safety against breaking", demand="required_safety_dynamic",
        limit="safety_dynamic", unit="1", demand_label="required safety factor", limit_label="safety", source="Diamond Chain",
        sized_unless=("chain",), consequence="the plates break by fatigue.", advise=STRONGER),
    Check(id="safety_static", check_class="strength", title="Static safety against breaking", demand="required_safety_static", limit="safety_static",
        unit="1", demand_label="required safety factor", limit_label="safety", source="iwis", sized_unless=("chain",),
        consequence="too little is left for what is not calculated.", advise=STRONGER),
    Check(id="bearing_pressure", check_class="strength", title="Pressure of the joints", demand="bearing_pressure",
        limit="allowable_bearing_pressure", unit="MPa", demand_label="pressure", limit_label="allowed", source="maker",
        sized_unless=("chain",), consequence="the joints wear and the chain lengthens.",
        advise=(CHAIN, Vary("bearing_area", "up"), Vary("strands", "up"))),
    Check(id="links_even", check_class="practice", title="Even number of links", demand="links_odd", limit=0.0, unit="1", severity="warn",
        demand_label="links in excess of an even number", limit_label="allowed", source="practice",
        consequence="the chain needs a cranked link, with which a ninth of the breaking load may be used in place of a sixth (Diamond Chain): then "
            "required_safety_dynamic is 9.", advise=("links",)),
    Check(id="teeth", check_class="practice", title="Number of teeth of the smaller sprocket", demand="teeth_usual", limit="teeth_small", unit="1",
        severity="warn", demand_label="usual", limit_label="teeth", source="practice", consequence="the chain runs roughly and wears.",
        advise=(Vary("teeth_1", "up"), Vary("teeth_2", "up"))),
    Check(id="speed_unevenness", check_class="practice", title="Speed ripple", demand="speed_unevenness", limit=2.0, unit="%", severity="warn",
        demand_label="drop in velocity within a tooth", limit_label="usual", source="practice", consequence="the strand is shaken at each tooth.",
        advise=(Vary("teeth_1", "up"),)),
    Check(id="center_distance", check_class="practice", title="Centre distance", demand="center_in_pitches", limit=float(USUAL_PITCHES[1]),
        at_least=float(USUAL_PITCHES[0]), unit="1", severity="warn", needs=(DRIVE,), demand_label="distance in pitches",
        limit_label="usual", at_least_label="at least", source="practice",
        consequence="short strands wear sooner, long ones whip (beyond 80 pitches they must be carried).", advise=("center_distance", "links")),
    Check(id="wrap", check_class="practice", title="Wrap of the smaller sprocket", demand=120.0, limit="wrap_small", unit="deg", severity="warn",
        demand_label="required", limit_label="wrap", source="practice", consequence="too few teeth share the load.",
        advise=(Vary("center_distance", "up"), Vary("links", "up"))),
    Check(id="power_rating", check_class="practice", title="Power rating", demand="design_power", limit="rated_power", unit="kW", severity="warn",
        needs=(DRIVE, "power_rating"), demand_label="power with application factor", limit_label="rated", source="ANSI B29.1",
        consequence="the chain does not last 15 000 h, by its {rating_governing}.", advise=(CHAIN, Vary("strands", "up"), Vary("teeth_1", "up"))),
    Check(id="slack_side", check_class="practice", title="Slack of the returning strand", demand="useful_tension", limit="slack_tension", unit="N",
        severity="warn", needs=(CONVEYOR,), demand_label="useful tension when the drive brakes", limit_label="sag and pretension",
        source="statics", consequence="the returning strand goes slack when the drive brakes; a tensioner avoids it.",
        advise=(Vary("pretension", "up"),)),
    Check(id="length_formula", check_class="practice", presumed=True, title="Length formula", demand="links_residual", limit=0.01, unit="1",
        severity="warn", demand_label="difference from exact polygon", limit_label="accepted", source="geometry",
        consequence="sprockets so unlike stand so near that the formula of the catalogues is coarse: let the centre distance be adjustable."),
)
