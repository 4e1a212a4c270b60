"""Chapters on what the chain bears: safeties against breaking, pressure of the joints, power rating; and what to change."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind, case
from diecut_report.plugins.roller_chain import formulas as f
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, DRIVE

# fmt: off

UNEVENNESS, USUAL_PITCHES = 0.02, (30, 50)
RATED = ("power_rating",)
RATED_TEETH = (11, 45)

safety = Chapter("Safety factor against breaking",
    text="No standard gives required safety factors; the defaults are manufacturers' values. iwis takes 7 against the breaking load by rule of "
        "thumb, since fatigue governs in most cases. Diamond Chain limits the working load to a sixth of the breaking load, with slip-fit or "
        "cranked connecting links to a ninth: required_safety_dynamic is then 9.")
safety.value("safety_dynamic", "S_dyn", "1", "Safety factor against breaking under all tensions",
    lambda breaking_load, tension_peak: breaking_load / tension_peak, source="Diamond Chain")
safety.value("safety_static", "S_stat", "1", "Safety factor against breaking under the static tensions",
    lambda breaking_load, tension_static: breaking_load / tension_static, source="iwis")
safety.value("bearing_pressure", "p_r", "MPa", "Pressure of the joints", lambda tension_peak, bearing_area: tension_peak / bearing_area,
    source="statics")
safety.value("breaking_load_needed", "F_B,min", "kN", "Breaking load required by both safety factors",
    lambda required_safety_dynamic, tension_peak, required_safety_static, tension_static:
        np.maximum(required_safety_dynamic * tension_peak, required_safety_static * tension_static), source="Diamond Chain, iwis", output=False)
safety.value("bearing_area_needed", "A_min", "mm**2", "Bearing area required by the allowable pressure",
    lambda tension_peak, allowable_bearing_pressure: tension_peak / allowable_bearing_pressure, needs=("allowable_bearing_pressure",),
    source="statics", output=False)

rating = Chapter("Power rating", needs=(DRIVE, *RATED), absent="not calculated: power_rating is not given, or the chain conveys",
    text="Rating of ANSI B29.1 chains, taken for series B of the same pitch: 15 000 h, a chain of 100 links, lubricated as recommended. It holds "
        "for the smaller sprocket.")
rating.require("teeth_rated",
    bind(lambda teeth_small, least, most: (teeth_small >= least) & (teeth_small <= most), least=RATED_TEETH[0], most=RATED_TEETH[1]), key="teeth_1",
    message="leaves the smaller sprocket {teeth_small} teeth, and the rating holds for 11 to 45; change the teeth, or leave out power_rating")
rating.value("speed_small", "n_s", "rpm", "Speed of the smaller sprocket", lambda speed, teeth_1, teeth_small: speed * teeth_1 / teeth_small,
    source="kinematics", output=False)
rating.value("plate_power", "P_1", "kW", "Power limit of the plates of one strand", bind(f.plate_power, teeth="teeth_small", speed="speed_small"),
    source="ANSI B29.1")
rating.value("roller_power", "P_2", "kW", "Power limit of the rollers of one strand", bind(f.roller_power, teeth="teeth_small", speed="speed_small"),
    source="ANSI B29.1")
rating.choice("strand_factor", "k_s", "1", "Strand factor",
    *(case((lambda: 1.0, lambda: 1.7, lambda: 2.5)[count - 1], f"{count} strand{'s' * (count > 1)}",
           bind(lambda strands, count: strands == count, count=count)) for count in (1, 2, 3)), case(lambda: 3.3, "4 strands"), source="ANSI B29.1",
    output=False)
rating.value("rated_power", "P_zul", "kW", "Rated power",
    lambda plate_power, roller_power, strand_factor: strand_factor * np.minimum(plate_power, roller_power), source="ANSI B29.1")
rating.choice("rating_governing", "G", "1", "Governing criterion of the rating",
    case("plate", "the power limit of the plates is lower than that of the rollers", lambda plate_power, roller_power: plate_power <= roller_power),
    case("roller", "the power limit of the rollers is lower than that of the plates"), source="ANSI B29.1")
rating.value("design_power", "P_d", "kW", "Power with the application factor",
    lambda application, torque_carried, angular_speed: application * torque_carried * angular_speed, source="power", output=False)

limits = Chapter("Practical limits")
limits.value("teeth_usual", "z_u", "1", "Minimum usual number of teeth of a drive", lambda: 17, needs=(DRIVE,), source="practice", output=False)
limits.value("teeth_usual", "z_u", "1", "Minimum usual number of teeth of a conveyor", lambda: 12, needs=(CONVEYOR,), source="practice", output=False)
limits.value("slack_tension", "F_l", "N", "Static tension of the returning strand", lambda sag_tension, pretension: sag_tension + pretension,
    needs=(CONVEYOR,), source="statics", output=False)
