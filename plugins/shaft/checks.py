"""Checks of the shaft."""

from __future__ import annotations

from diecut_report.api import Check, Vary

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
