"""Chapters on speed and swing of the rings, and the life."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, computed, lookup, m, number, pi, total, value
from diecut_report.plugins.rolling_bearing import ratings as f
from diecut_report.plugins.rolling_bearing.bearings import STATIC_SAFETIES, Bearings
from diecut_report.plugins.rolling_bearing.loads import NAMES, SEARCH, each, row

# fmt: off

LIFE = "ISO 281:2007, 5.3"
PRACTICE = "practice"

motion = Chapter("Motion of the rings",
    text="For a relative angle the total travel per cycle counts, there and back: a swing of the range W is W/180° revolutions. Where the rings "
        "only oscillate, the paths of neighbouring rolling elements overlap only from a swing of 720°/Z.")
motion.is_angle = (row(lambda known: known.flag(each.angle is not None for each in known.duties), "from the given keys", output=False), "w", "1",
    "Motion given as an angle (1) or a speed (0)")
motion.travel = (row(lambda known: known.row(lambda i: known.duties[i].travel if known.is_swinging(i) else np.zeros((known.variants, 1))),
    "∮ |dθ/dφ| dφ between the reversals", output=False), "V", "deg", "Travel of the relative angle per cycle (0 where a speed is given)")
motion.cycles = (row(lambda known: known.row(lambda i: known.cycle_speed[i] * known.is_swinging(i)), "as given", output=False), "n_z", "rpm",
    "Cycle rate, as a speed: 1 r/min is one cycle per minute (0 where a speed is given)")
motion.turns_per_cycle = each(m.travel / (2 * pi), exists=m.is_angle > 0), "N_c", "1", "Revolutions of the rings per cycle", "kinematics"
motion.given_mean = (row(lambda known: known.row(lambda i: np.zeros((known.variants, 1)) if known.is_swinging(i) else known.duties[i].mean_speed),
    "Gauss–Legendre between the breakpoints and reversals", output=False), "n_s", "rpm",
    "Mean absolute value of the given speed (0 where an angle is given)")
motion.mean_speed = each(m.cycles * m.travel / (2 * pi) + m.given_mean), "n_m", "rpm", "Mean speed of the rings", "kinematics"
motion.speed_max = (row(lambda known: known.row(known.greatest_speed), SEARCH, output=False), "n_max", "rpm",
    "Maximum speed of the rings over the cycle")
motion.returns = (row(lambda known: known.row(known.oscillates), "the relative angle returns, and its range is less than one revolution per cycle",
    output=False), "r", "1", "Rings only oscillate (1) or rotate (0)")
motion.swing = (row(lambda known: known.row(known.swing_width), "maximum less minimum relative angle", exists=m.returns > 0), "W", "deg",
    "Range of the swing")
motion.elements = (row(lambda known: known.row(known.elements.__getitem__), "as given, else 8", output=False), "Z", "1",
    "Number of rolling elements: as given, otherwise 8")
motion.critical_swing = (each(4 * pi / m.elements, exists=m.returns > 0), "W_crit", "deg",
    "Minimum oscillation at which neighbouring rolling elements overlap", "this method")

motion.part_table("motion_table", "Motion of all bearings", "bearings", ("turns_per_cycle", "mean_speed", "speed_max", "swing", "critical_swing"))

life = Chapter("Life",
    text="A bearing that stands has no rolling fatigue life, only a static safety. A life far above the required one means that rolling fatigue "
        "does not limit the bearing; lubrication, contamination and corrosion then end its use.")
life.life_revolutions = (each(f.revolutions.of(rating=m.dynamic_rating, load=m.equivalent_load, exponent=m.exponent),
    exists=(m.turned > 0) & (m.equivalent_load > 0)), "L_10", "1", "Basic rating life in revolutions", LIFE)
life.life = (each(f.duration.of(turns=m.life_revolutions, speed=m.mean_speed), exists=(m.turned > 0) & (m.equivalent_load > 0)), "L_10h", "h",
    "Basic rating life", LIFE)
life.life_modified = (each(f.modified.of(reliability=m.reliability_factor, a_iso=m.bearings.a_iso), exists=(m.turned > 0) & (m.equivalent_load > 0)),
    "L_nmh", "h", "Modified rating life", "ISO 281:2007, 6.3")
life.lives = (computed(lambda load: (np.nan_to_num(load) > 0) * 1.0, ("equivalent_load",), "1 where the rings turn under load", over="bearings",
    named_by=NAMES, output=False), "k_L", "1", "Life is calculated (1) or not (0)")
life.any_life = total("sum", of="lives", output=False), "n_L", "1", "Bearings with a life", "this method"


def _least(life: Any) -> Any:
    known = np.where(np.isnan(life), np.inf, life)
    found = np.min(known, axis=1, keepdims=True)
    return np.where(np.isfinite(found), found, 0.0)


def _governing(known: Bearings, life: Any) -> list[str]:
    least = np.argmin(np.where(np.isnan(life), np.inf, life), axis=1)
    return [known.names[index] if np.isfinite(own).any() else "none" for index, own in zip(least, life, strict=True)]


life.life_min = (computed(_least, ("life_modified",), "the minimum of all bearings that turn", exists=m.any_life > 0), "L_min", "h",
    "Minimum modified rating life", LIFE)
life.governing_bearing = (computed(_governing, ("all_bearings", "life_modified"), "the minimum of all bearings that turn", is_text=True), "B_L", "1",
    "Bearing with the shortest life")
life.life_share = (each(np.where(m.lives > 0, (m.life_min / m.life_modified) ** (number(10) / 9), 0), exists=m.any_life > 0, output=False), "s_L",
    "1", "Ratio of the shortest life to this bearing's, to the power of the Weibull slope", "Lundberg and Palmgren")
life.life_sum = (computed(lambda share: np.sum(share, axis=1, keepdims=True), ("life_share",), "of all bearings", exists=m.any_life > 0,
    output=False), "Σ s_L", "1", "Sum of these ratios", "Lundberg and Palmgren")
life.system_life = (value(m.life_min * m.life_sum ** (-0.9), exists=m.any_life > 0), "L_sys", "h",
    "Combined life of all bearings, at the same reliability", "Lundberg and Palmgren")

life.part_table("life_table", "Life of all bearings", "bearings", ("life_revolutions", "life", "life_modified"))

limits = Chapter("Practical limits")
limits.static_usual = lookup(STATIC_SAFETIES, by="bearings.type", output=False, named_by=NAMES), "s_0,u", "1", "Usual static safety", PRACTICE
limits.static_required = (computed(lambda given, usual: np.broadcast_to(given, usual.shape), ("required_static_safety", "static_usual"),
    "the same for each bearing", over="bearings", named_by=NAMES, needs=("required_static_safety",), output=False), "[s_0]_i", "1",
    "Required static safety factor: as given", "input")
limits.static_required = (each(m.static_usual, lacks=("required_static_safety",), output=False), "[s_0]_i", "1",
    "Required static safety factor: the usual one", PRACTICE)
limits.least_share = (lookup({"deep_groove": 0.01, "ball": 0.01, "roller": 0.02}, by="bearings.type", output=False, named_by=NAMES), "c_min", "1",
    "Minimum load as a fraction of C", "SKF catalogue")
limits.least_load = (each(m.least_share * m.dynamic_rating, output=False), "P_min", "N", "Minimum load for the rolling elements to roll",
    "SKF catalogue")
limits.valid_load = each(m.dynamic_rating / 2, output=False), "P_lim", "N", "Load up to which the rating life is valid", "ISO 281"
limits.rating_needed = (each(m.dynamic_rating * (m.required_life / m.life_modified) ** (1 / m.exponent), exists=m.lives > 0, output=False), "C_req",
    "kN", "Dynamic load rating required for the life", LIFE)
limits.static_needed = (each(m.static_required * m.static_load, output=False), "C_0,req", "kN", "Static load rating required for the static safety",
    "ISO 76")
limits.tilt_limit = (row(lambda known: known.row(lambda i: known.permitted_tilt[i]),
    "as given, otherwise 0.58 for ball bearings, 0.87 for roller bearings N, NJ and NU, and 0.29 for others", output=False), "ψ_zul", "mrad",
    "Permissible misalignment")
limits.type_tilt = (row(lambda known: known.row(lambda i: known.type_tilt[i]), "as makers state it for the type and designation",
    needs=("bearings.permitted_tilt",), output=False), "ψ_t", "mrad", "Most misalignment that any bearing of the type takes")
limits.part_table("limits_table", "Limits and requirements of all bearings", "bearings",
    ("static_required", "least_load", "valid_load", "rating_needed", "static_needed"))
