"""Chapters on speed and swing of the rings, and the life."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, bind, number, pi
from diecut_report.plugins.rolling_bearing import ratings as f
from diecut_report.plugins.rolling_bearing.bearings import STATIC_SAFETIES, Bearings
from diecut_report.plugins.rolling_bearing.loads import NAMES, SEARCH, row, value

# fmt: off

LIFE = "ISO 281:2007, 5.3"
PRACTICE = "practice"

motion = Chapter("Motion of the rings",
    text="For a relative angle the total travel per cycle counts, there and back: a swing of the range W is W/180° revolutions. Where the rings "
        "only oscillate, the paths of neighbouring rolling elements overlap only from a swing of 720°/Z.")
row(motion, "is_angle", "w", "1", "Motion given as an angle (1) or a speed (0)",
    lambda known: known.flag(each.angle is not None for each in known.duties), "from the given keys", output=False)
row(motion, "travel", "V", "deg", "Travel of the relative angle per cycle (0 where a speed is given)",
    lambda known: known.row(lambda i: known.duties[i].travel if known.is_swinging(i) else np.zeros((known.variants, 1))),
    "∮ |dθ/dφ| dφ between the reversals", output=False)
row(motion, "cycles", "n_z", "rpm", "Cycle rate, as a speed: 1 r/min is one cycle per minute (0 where a speed is given)",
    lambda known: known.row(lambda i: known.cycle_speed[i] * known.is_swinging(i)), "as given", output=False)
value(motion, "turns_per_cycle", "N_c", "1", "Revolutions of the rings per cycle", lambda travel: travel / (2 * pi),
    exists=lambda is_angle: is_angle > 0, source="kinematics")
row(motion, "given_mean", "n_s", "rpm", "Mean absolute value of the given speed (0 where an angle is given)",
    lambda known: known.row(lambda i: np.zeros((known.variants, 1)) if known.is_swinging(i) else known.duties[i].mean_speed),
    "Gauss–Legendre between the breakpoints and reversals", output=False)
value(motion, "mean_speed", "n_m", "rpm", "Mean speed of the rings", lambda cycles, travel, given_mean: cycles * travel / (2 * pi) + given_mean,
    source="kinematics")
row(motion, "speed_max", "n_max", "rpm", "Maximum speed of the rings over the cycle", lambda known: known.row(known.greatest_speed), SEARCH,
    output=False)
row(motion, "returns", "r", "1", "Rings only oscillate (1) or rotate (0)", lambda known: known.row(known.oscillates),
    "the relative angle returns, and its range is less than one revolution per cycle", output=False)
row(motion, "swing", "W", "deg", "Range of the swing", lambda known: known.row(known.swing_width), "maximum less minimum relative angle",
    exists=lambda returns: returns > 0)
row(motion, "elements", "Z", "1", "Number of rolling elements: as given, otherwise 8", lambda known: known.row(known.elements.__getitem__),
    "as given, else 8", output=False)
value(motion, "critical_swing", "W_crit", "deg", "Minimum oscillation at which neighbouring rolling elements overlap",
    lambda elements: 4 * pi / elements, exists=lambda returns: returns > 0, source="this method")

motion.part_table("motion_table", "Motion of all bearings", "bearings", ("turns_per_cycle", "mean_speed", "speed_max", "swing", "critical_swing"))

life = Chapter("Life",
    text="A bearing that stands has no rolling fatigue life, only a static safety. A life far above the required one means that rolling fatigue "
        "does not limit the bearing; lubrication, contamination and corrosion then end its use.")
value(life, "life_revolutions", "L_10", "1", "Basic rating life in revolutions",
    bind(f.revolutions, rating="dynamic_rating", load="equivalent_load", exponent="exponent"),
    exists=lambda turned, equivalent_load: (turned > 0) & (equivalent_load > 0), source=LIFE)
value(life, "life", "L_10h", "h", "Basic rating life", bind(f.duration, turns="life_revolutions", speed="mean_speed"),
    exists=lambda turned, equivalent_load: (turned > 0) & (equivalent_load > 0), source=LIFE)
value(life, "life_modified", "L_nmh", "h", "Modified rating life", bind(f.modified, reliability="reliability_factor", a_iso="bearings.a_iso"),
    exists=lambda turned, equivalent_load: (turned > 0) & (equivalent_load > 0), source="ISO 281:2007, 6.3")
life.computed("lives", "k_L", "1", "Life is calculated (1) or not (0)", lambda load: (np.nan_to_num(load) > 0) * 1.0, ("equivalent_load",),
    "1 where the rings turn under load", over="bearings", named_by=NAMES, output=False)
life.total("any_life", "n_L", "1", "Bearings with a life", "sum", of="lives", source="this method", output=False)


def _least(life: Any) -> Any:
    known = np.where(np.isnan(life), np.inf, life)
    found = np.min(known, axis=1, keepdims=True)
    return np.where(np.isfinite(found), found, 0.0)


def _governing(known: Bearings, life: Any) -> list[str]:
    least = np.argmin(np.where(np.isnan(life), np.inf, life), axis=1)
    return [known.names[index] if np.isfinite(own).any() else "none" for index, own in zip(least, life, strict=True)]


life.computed("life_min", "L_min", "h", "Minimum modified rating life", _least, ("life_modified",), "the minimum of all bearings that turn",
    exists=lambda any_life: any_life > 0, source=LIFE)
life.computed("governing_bearing", "B_L", "1", "Bearing with the shortest life", _governing, ("all_bearings", "life_modified"),
    "the minimum of all bearings that turn", is_text=True)
value(life, "life_share", "s_L", "1", "Ratio of the shortest life to this bearing's, to the power of the Weibull slope",
    lambda lives, life_min, life_modified: np.where(lives > 0, (life_min / life_modified) ** (number(10) / 9), 0), exists=lambda any_life: any_life > 0,
    source="Lundberg and Palmgren", output=False)
life.computed("life_sum", "Σ s_L", "1", "Sum of these ratios", lambda share: np.sum(share, axis=1, keepdims=True), ("life_share",), "of all bearings",
    exists=lambda any_life: any_life > 0, output=False, source="Lundberg and Palmgren")
life.value("system_life", "L_sys", "h", "Combined life of all bearings, at the same reliability",
    lambda life_min, life_sum: life_min * life_sum ** (-0.9), exists=lambda any_life: any_life > 0, source="Lundberg and Palmgren")

life.part_table("life_table", "Life of all bearings", "bearings", ("life_revolutions", "life", "life_modified"))

limits = Chapter("Practical limits")
limits.lookup("static_usual", "s_0,u", "1", "Usual static safety", STATIC_SAFETIES, by="bearings.type", source=PRACTICE, output=False, named_by=NAMES)
limits.computed("static_required", "[s_0]_i", "1", "Required static safety factor: as given",
    lambda given, usual: np.broadcast_to(given, usual.shape), ("required_static_safety", "static_usual"), "the same for each bearing",
    over="bearings", named_by=NAMES, needs=("required_static_safety",), source="input", output=False)
value(limits, "static_required", "[s_0]_i", "1", "Required static safety factor: the usual one", lambda static_usual: static_usual,
    lacks=("required_static_safety",), source=PRACTICE, output=False)
limits.lookup("least_share", "c_min", "1", "Minimum load as a fraction of C", {"deep_groove": 0.01, "ball": 0.01, "roller": 0.02}, by="bearings.type",
    source="SKF catalogue", output=False, named_by=NAMES)
value(limits, "least_load", "P_min", "N", "Minimum load for the rolling elements to roll",
    lambda least_share, dynamic_rating: least_share * dynamic_rating, source="SKF catalogue", output=False)
value(limits, "valid_load", "P_lim", "N", "Load up to which the rating life is valid", lambda dynamic_rating: dynamic_rating / 2, source="ISO 281",
    output=False)
value(limits, "rating_needed", "C_req", "kN", "Dynamic load rating required for the life",
    lambda dynamic_rating, required_life, life_modified, exponent: dynamic_rating * (required_life / life_modified) ** (1 / exponent),
    exists=lambda lives: lives > 0, source=LIFE, output=False)
value(limits, "static_needed", "C_0,req", "kN", "Static load rating required for the static safety",
    lambda static_required, static_load: static_required * static_load, source="ISO 76", output=False)
row(limits, "tilt_limit", "ψ_zul", "mrad", "Permissible misalignment", lambda known: known.row(lambda i: known.permitted_tilt[i]),
    "as given, otherwise 0.58 for ball bearings, 0.87 for roller bearings N, NJ and NU, and 0.29 for others", output=False)
row(limits, "type_tilt", "ψ_t", "mrad", "Most misalignment that any bearing of the type takes", lambda known: known.row(lambda i: known.type_tilt[i]),
    "as makers state it for the type and designation", needs=("bearings.permitted_tilt",), output=False)
limits.part_table("limits_table", "Limits and requirements of all bearings", "bearings",
    ("static_required", "least_load", "valid_load", "rating_needed", "static_needed"))
