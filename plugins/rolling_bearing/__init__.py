"""Rolling bearings: life by ISO 281 under loads that vary over a cycle, static safety by ISO 76."""

from __future__ import annotations

from diecut_report.api import Mechanism, Source
from diecut_report.plugins.rolling_bearing import life, loads
from diecut_report.plugins.rolling_bearing.checks import CHECKS
from diecut_report.plugins.rolling_bearing.example import EXAMPLE
from diecut_report.plugins.rolling_bearing.figures import FIGURES
from diecut_report.plugins.rolling_bearing.inputs import RollingBearing

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
