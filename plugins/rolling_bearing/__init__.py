"""Rolling bearings: life by ISO 281 under loads that vary over a cycle, static safety by ISO 76."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
from diecut_report.plugins.rolling_bearing import life, loads
from diecut_report.plugins.rolling_bearing.figures import FIGURES
from diecut_report.plugins.rolling_bearing.inputs import RollingBearing
from diecut_report.plugins.rolling_bearing.loads import NAMES

OF_BEARING: dict[str, Any] = {"named_by": NAMES, "part_id": "{name}_{id}"}
LIFE, FIXED = "ISO 281:2007", "ISO 76"
SWINGS = "the life is calculated by the turned way and is optimistic; "

# fmt: off

CHECKS = (
    Check("life", "strength", "Life", m.required_life, m.life_modified, demand_label="required", source=LIFE, founded=("bearings.a_iso",),
        **OF_BEARING, consequence="the bearing is worn out too soon; less load lets it live longer.",
        advise=(Vary("bearings.dynamic_rating", "up"),)),
    Check("static", "strength", "Static safety factor", m.static_required, m.static_safety, demand_label="required", limit_label="static safety",
        source=FIXED, **OF_BEARING, consequence="rolling elements dent the raceways; less load does not.",
        advise=(Vary("bearings.static_rating", "up"),)),
    Check("min_load", "practice", "Minimum load", m.least_load, m.equivalent_load, severity="warn", demand_label="required", limit_label="mean load",
        **OF_BEARING, consequence="rolling elements slide and do not roll; a preload avoids it.", advise=(Vary("bearings.dynamic_rating", "down"),)),
    Check("load_level", "practice", "Validity of the rating life", m.equivalent_load_max, m.valid_load, presumed=True, severity="warn",
        demand_label="maximum load", limit_label="half the dynamic load rating", source="ISO 281", **OF_BEARING,
        consequence="the raceways yield and the rating life does not hold.", advise=(Vary("bearings.dynamic_rating", "up"),)),
    Check("axial", "practice", "Axial load", m.axial_overload, 6.89, severity="warn", demand_label="relative axial force",
        limit_label="end of the table", **OF_BEARING,
        consequence="the balls run over the edge of the raceway; take a larger bearing, or one for axial loads."),
    Check("oscillation", "practice", "Swing", m.critical_swing, m.swing, severity="warn", demand_label="required", limit_label="swing",
        source="practice", **OF_BEARING,
        consequence=SWINGS + "fretting and false brinelling govern: take a needle cage, a full complement or a plain bearing."),
    Check("dwell", "practice", "Minimum swing", 20.0, m.swing, severity="warn", demand_label="required", limit_label="swing", source="SKF catalogue",
        **OF_BEARING, consequence="a rating life does not apply to so small a swing; take a plain bearing or a flexure."),
    Check("tilt", "strength", "Misalignment", m.bearings.tilt, m.tilt_limit, severity="warn", fails_beyond=2, demand_label="misalignment",
        limit_label="permissible", source="maker's catalogue", **OF_BEARING,
        consequence="the load crowds to an edge, the life is shorter than calculated, and beyond twice the permitted tilt the raceways break there; "
            "take a self-aligning bearing with its permitted_tilt, or a stiffer shaft."),
    Check("speed", "practice", "Speed", m.speed_max, m.bearings.limiting_speed, severity="warn", demand_label="maximum speed",
        limit_label="limiting speed", source="maker's catalogue", **OF_BEARING,
        consequence="the bearing runs hot; take a smaller one, or oil in place of grease."),
    Check("mean_bounds", "numerical", "Bounds of the mean load", m.equivalent_load, m.equivalent_load_max, at_least=m.arithmetic_load,
        demand_label="mean load", limit_label="maximum load", at_least_label="arithmetic mean", tolerance=1e-6, source="inequality of the means",
        consequence="the integral of the loads is wrong."),
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
