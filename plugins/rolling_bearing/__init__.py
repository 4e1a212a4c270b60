"""Rolling bearings: life by ISO 281 under loads that vary over a cycle, static safety by ISO 76."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired
from diecut_report.plugins.rolling_bearing import life, loads
from diecut_report.plugins.rolling_bearing.figures import FIGURES
from diecut_report.plugins.rolling_bearing.inputs import RollingBearing
from diecut_report.plugins.rolling_bearing.loads import NAMES

OF_BEARING: dict[str, Any] = {"named_by": NAMES, "part_id": "{name}_{id}"}
LIFE, FIXED = "ISO 281:2007", "ISO 76"
SWINGS = "the life is calculated by the turned way and is optimistic; "

# fmt: off

CHECKS = (
    Check(id="life", check_class="strength", title="Life", demand="required_life", limit="life_modified", unit="h", demand_label="required",
        limit_label="modified rating life", source=LIFE, founded=("bearings.a_iso",), **OF_BEARING,
        consequence="the bearing is worn out too soon; less load lets it live longer.", advise=(Vary("bearings.dynamic_rating", "up"),)),
    Check(id="static", check_class="strength", title="Static safety factor", demand="static_required", limit="static_safety", unit="1",
        demand_label="required", limit_label="static safety", source=FIXED, **OF_BEARING,
        consequence="rolling elements dent the raceways; less load does not.", advise=(Vary("bearings.static_rating", "up"),)),
    Check(id="min_load", check_class="practice", title="Minimum load", demand="least_load", limit="equivalent_load", unit="N", severity="warn",
        demand_label="required", limit_label="mean load", source="SKF catalogue", **OF_BEARING,
        consequence="rolling elements slide and do not roll; a preload avoids it.", advise=(Vary("bearings.dynamic_rating", "down"),)),
    Check(id="load_level", check_class="practice", presumed=True, title="Validity of the rating life", demand="equivalent_load_max",
        limit="valid_load", unit="N", severity="warn", demand_label="maximum load", limit_label="half the dynamic load rating",
        source="ISO 281", **OF_BEARING, consequence="the raceways yield and the rating life does not hold.",
        advise=(Vary("bearings.dynamic_rating", "up"),)),
    Check(id="axial", check_class="practice", title="Axial load", demand="axial_overload", limit=6.89, unit="1", severity="warn",
        demand_label="relative axial force", limit_label="end of the table", source="ISO 281, table 3", **OF_BEARING,
        consequence="the balls run over the edge of the raceway; take a larger bearing, or one for axial loads."),
    Check(id="oscillation", check_class="practice", title="Swing", demand="critical_swing", limit="swing", unit="deg", severity="warn",
        demand_label="required", limit_label="swing", source="practice", **OF_BEARING,
        consequence=SWINGS + "fretting and false brinelling govern: take a needle cage, a full complement or a plain bearing."),
    Check(id="dwell", check_class="practice", title="Minimum swing", demand=20.0, limit="swing", unit="deg", severity="warn", demand_label="required",
        limit_label="swing", source="SKF catalogue", **OF_BEARING,
        consequence="a rating life does not apply to so small a swing; take a plain bearing or a flexure."),
    Check(id="tilt", check_class="strength", title="Misalignment", demand="bearings.tilt", limit="tilt_limit", unit="mrad", severity="warn",
        fails_beyond=2, demand_label="misalignment", limit_label="permissible", source="maker's catalogue", **OF_BEARING,
        consequence="the load crowds to an edge, the life is shorter than calculated, and beyond twice the permitted tilt the raceways break there; "
            "take a self-aligning bearing with its permitted_tilt, or a stiffer shaft."),
    Check(id="speed", check_class="practice", title="Speed", demand="speed_max", limit="bearings.limiting_speed", unit="rpm", severity="warn",
        demand_label="maximum speed", limit_label="limiting speed", source="maker's catalogue", **OF_BEARING,
        consequence="the bearing runs hot; take a smaller one, or oil in place of grease."),
    Check(id="mean_bounds", check_class="numerical", title="Bounds of the mean load", demand="equivalent_load", limit="equivalent_load_max",
        at_least="arithmetic_load", unit="N", demand_label="mean load", limit_label="maximum load", at_least_label="arithmetic mean", tolerance=1e-6,
        source="inequality of the means", consequence="the integral of the loads is wrong."),
)


EXAMPLE = ExampleBlock(
    "bearings",
    {
        "bearings": [
            {
                "name": "main_a",
                "type": "deep_groove",
                "designation": "6209",
                "dynamic_rating": "35.1 kN",
                "static_rating": "21.6 kN",
                "radial_force": Wired("${<shaft>.reaction_a}", otherwise="3 kN"),
                "speed": Wired("${<cylinder_drive>.crank_speed}", otherwise="50 rpm"),
            },
            {
                "name": "main_b",
                "type": "deep_groove",
                "designation": "6212",
                "dynamic_rating": "55.3 kN",
                "static_rating": "36 kN",
                "radial_force": Wired("${<shaft>.reaction_b}", otherwise="9 kN"),
                "speed": Wired("${<cylinder_drive>.crank_speed}", otherwise="50 rpm"),
            },
        ],
    },
)


MECHANISM = Mechanism(
    kind="rolling_bearing",
    version="1.0",
    title="Rolling bearings",
    summary="Bearings that rotate or oscillate under loads that are constant or vary over a cycle. The calculation gives the equivalent load "
            "over the cycle, the rating life with reliability and lubrication, the static safety, and the life of all bearings together. If a "
            "deep groove ball bearing or a cylindrical roller bearing is omitted, the smallest sufficient one of its series is selected.",
    inputs=RollingBearing,
    example=EXAMPLE,
    chapters=(loads.ratings, loads.loads, loads.static, life.motion, life.life, life.limits),
    key_results=("life_min", "governing_bearing", "system_life"),
    checks=CHECKS,
    figures=FIGURES,
    assumptions=(
        "The load acts in one direction on one ring, or turns with it; shaft and housings are stiff, without misalignment and preload, the "
        "clearance is normal.",
        "Time is uniform over the cycle: the shaft that drives it rotates at constant speed. Damage adds up linearly.",
        "a_ISO is as given: lubrication and contamination are not calculated; at low speed the film is thin, and a_ISO is below 1 unless the oil "
        "is thick. Grease life, heating and the cage at high acceleration are not covered; the speed is only compared with the manufacturer's "
        "limiting speed.",
        "Only the travel of a swing counts (Harris' first method, without the factors of Houpert or Rumbarger).",
        "The combined life of all bearings uses the Weibull slope 10/9 for roller bearings, too.",
        "Ratings in the tables are the lowest of three manufacturers; the ratings of the manufacturer actually used may be given instead. Series "
        "NU are of the reinforced design; needle, tapered and other bearings are not in the tables.",
    ),
    sources=(
        Source("ISO 281", "ISO 281:2007, Rolling bearings: Dynamic load ratings and rating life."),
        Source("ISO 76", "ISO 76:2006, Rolling bearings: Static load ratings."),
        Source("SKF catalogue", "SKF, General catalogue: selection of bearing size, minimum load, variable load."),
        Source("Lundberg and Palmgren", "Lundberg G., Palmgren A. Dynamic Capacity of Rolling Bearings. Acta Polytechnica, Mech. Eng. Series "
               "1, no. 3, 1947."),
    ),
)  # fmt: skip
