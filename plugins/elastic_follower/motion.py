"""Chapters on the drive and on the motion of its input: a rise by a law, or a curve."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import ByText, Chapter, Formula, Steps, bind, case, formula, pi
from diecut_report.mechanics import common, followers
from diecut_report.mechanics.motion_laws import ACCELERATION, JOINT, PEAK_ACCELERATION, POSITION
from diecut_report.plugins.elastic_follower import rests

# fmt: off


@formula
def law_acceleration(rise: Any, rise_duration: Any, acceleration: Any) -> Any:
    """Acceleration of a rise by a law, of the law's acceleration."""
    return rise / rise_duration**2 * acceleration


STRAIGHT = (("mass", "mm"),)
STRAIGHT_SPEED = (("mass", "m/s"),)
STRAIGHT_ACCELERATION = (("mass", "m/s**2"),)
LAW, CURVE, RATE = ("rise",), ("motion_curve",), ("cycles_per_hour",)
ONE_RATE = 1e-3  # relative difference of two rates that are one
STIFFEST, SOFTEST = 50, 0.1  # natural periods within the rise, between which the drive is calculated


def of_each_body(chapter: Steps, id: str, symbol: str, unit: str, description: str, formula: Formula, **options: Any) -> None:
    """A quantity that takes the inertia of a turning link, or the mass of a sliding one."""
    for body in ("inertia", "mass"):
        chapter.value(id, symbol, unit, description, bind(formula, inertia=body), needs=(body,), **options)


drive = Chapter("Elastic drive")
of_each_body(drive, "angular_frequency", "ω", "rad/s", "Natural angular frequency", followers.natural_angular_frequency, source="001, first paper")
drive.value("natural_frequency", "f_n", "Hz", "Natural frequency", lambda angular_frequency: angular_frequency / (2 * pi),
    source="001, first paper")
drive.value("natural_period", "T_n", "ms", "Natural period", lambda natural_frequency: 1 / natural_frequency, source="vibration", output=False)
drive.value("damped_frequency", "ω_d", "rad/s", "Angular frequency of the damped vibration", followers.damped_angular_frequency, source="vibration",
    output=False)
of_each_body(drive, "damping_constant", "C", "N*m*s/rad", "Damping of the drive", followers.damping_constant, units=(("mass", "N*s/m"),),
        source="vibration")

times = Chapter("Duration of the motion",
    text="The motion lasts from one rest to the next; where a curve is given, from the end of its longest rest to its start.")
times.value("cycle_time", "T", "ms", "Duration of a cycle", lambda cycles_per_hour: 1 / cycles_per_hour, needs=RATE)
times.curve_period("cycle_time", "T", "ms", "Duration of a cycle", given="motion_curve",
    otherwise="give cycles_per_hour, with which it runs through once a cycle", needs=CURVE, lacks=RATE)
times.computed("curve_rate", "n_φ", "1/h", "Rate at which the curve comes again; 0 where nothing tells it",
    function=lambda motion_curve: motion_curve.rate / (2 * np.pi), takes=CURVE, method="the speed of what it runs over, by the turns of its period",
    needs=(*CURVE, *RATE), output=False, source="kinematics")
times.require("one_rate",
    bind(lambda cycles_per_hour, curve_rate, tolerance: (curve_rate <= 0) | (abs(cycles_per_hour - curve_rate) <= tolerance * curve_rate),
        tolerance=ONE_RATE), key="cycles_per_hour", needs=(*CURVE, *RATE),
    message="is {cycles_per_hour}, but the curve that motion_curve refers to comes again at {curve_rate}; refer to the rate with which that curve is "
        "calculated")
times.computed("motion_start", "s_0", "1", "Fraction of the cycle at which the motion begins",
    function=lambda curve: rests.moving(curve)[0], takes=CURVE,
    method="the end of the longest rest among the curve's smooth pieces", needs=CURVE, output=False, source="this method")
times.computed("motion_share", "s_m", "1", "Fraction of the cycle taken by the motion",
    function=lambda curve: rests.moving(curve)[1], takes=CURVE,
    method="the rest of the cycle after the longest rest", needs=CURVE, output=False, source="this method")
times.require("moves", lambda motion_share: motion_share > 0, key="motion_curve", message="does not move; give a curve that rises between two rests",
    needs=CURVE)
times.require("rests", lambda motion_share: motion_share < 1, key="motion_curve",
    message="never rests within its period; give a curve that moves between two rests", needs=CURVE)
times.computed("speed_jump", "δ_v", "1", "Maximum jump of position or speed in the motion, relative to its range and maximum speed",
    function=rests.jump, takes=CURVE, method="position and speed at the end of each smooth piece, compared with those at the start of the next",
    needs=CURVE, output=False, source="this method")
times.require("no_jump", lambda speed_jump: speed_jump <= 1e-06, key="motion_curve",
    message="jumps in its position or speed, for which no drive is strong enough; give a motion without such jumps", needs=CURVE)
times.value("rise_duration", "t_r", "ms", "Duration of the rise", lambda rise_time: rise_time, needs=("rise_time",), lacks=RATE)
times.require("share_of_cycle", lambda rise_time: rise_time <= 1, key="rise_time",
    message="is {rise_time}, more than the cycle: with cycles_per_hour it is the fraction of the cycle that the rise takes; give a fraction up to "
        "1, or seconds without cycles_per_hour", needs=("rise_time", *RATE))
times.value("rise_duration", "t_r", "ms", "Duration of the rise", lambda rise_time, cycle_time: rise_time * cycle_time, needs=("rise_time", *RATE))
times.value("rise_duration", "t_r", "ms", "Duration of the motion", lambda motion_share, cycle_time: motion_share * cycle_time, needs=CURVE)
times.value("tuning_ratio", "λ", "1", "Natural periods within the rise", bind(followers.tuning_ratio, rise_time="rise_duration"),
    source="001, first paper")
times.require("not_too_soft", bind(common.is_at_least, greater="tuning_ratio", smaller=SOFTEST), key="stiffness",
    message=f"leaves {{tuning_ratio}} natural periods within the rise; at least {SOFTEST} are needed for this calculation (the spectrum covers 0.5 "
        "to 10): give a stiffer drive or a longer rise")
times.require("not_too_stiff", bind(common.is_at_most, smaller="tuning_ratio", greater=STIFFEST), key="stiffness",
    message=f"leaves {{tuning_ratio}} natural periods within the rise; with more than {STIFFEST} the link follows as if it were rigid, and needs no "
        "such calculation (the spectrum covers 0.5 to 10)")
times.value("follow_time", "t_f", "ms", "Time after the motion for which the vibration is calculated",
    lambda dwell_cycles, natural_period: dwell_cycles * natural_period, needs=LAW, output=False)
times.value("rest_time", "t_0", "ms", "Rest after the motion", lambda cycle_time, rise_duration: cycle_time - rise_duration, needs=CURVE)
times.value("wanted_time", "t_w", "ms", "Requested time of the vibration after the motion",
    lambda dwell_cycles, natural_period: dwell_cycles * natural_period, needs=CURVE, output=False)
times.value("follow_time", "t_f", "ms", "Calculated time of the vibration after the motion, no longer than the rest",
    lambda wanted_time, rest_time: np.minimum(wanted_time, rest_time), needs=CURVE, output=False)
times.value("duration", "t_e", "ms", "Calculated time from the start of the motion", lambda rise_duration, follow_time: rise_duration + follow_time,
    output=False)
times.abscissa("time", "t", "ms", "Time from the start of the motion", "duration", shown_at="acceleration_peak_at")
times.breakpoints("end_of_rise", "time", "rise_duration")
times.phase("moving", "moving", "The input moves", "time", (0, "rise_duration"), period="cycle_time", needs=RATE)
times.value("piece_middle", "t_m", "ms", "Time in the middle of the present piece", lambda time: time, source="this method", output=False,
    per_piece=True)

MOVING = bind(common.is_below, smaller="piece_middle", greater="rise_duration")

by_law = Chapter("Motion of the input", text="One rise by a law of motion; k is the elapsed fraction of the rise time.", needs=LAW)
by_law.value("law_share", "k", "1", "Elapsed fraction of the rise time", lambda time, rise_duration: np.minimum(time / rise_duration, 1),
    source="motion laws", output=False)
by_law.value("law_joint", "j", "1", "Junction of the law: changes its sign where the law's formula changes",
    ByText("motion_law", JOINT, k="law_share"), output=False, source="motion laws", printed=False)
by_law.crossings("law_break", "t_j", "ms", "Time at which the law's formula changes", of="law_joint", output=False, printed=False)
by_law.breakpoints("law_breaks", "time", "law_break")
by_law.value("law_middle", "k_m", "1", "Fraction k in the middle of the current piece", lambda law_share: law_share, source="this method",
    output=False, per_piece=True, printed=False)
by_law.value("law_side", "k", "1", "Fraction k just inside its piece: selects the side where the law's acceleration jumps",
    lambda law_share, law_middle: law_share + 1e-12 * (law_middle - law_share), output=False, source="this method", printed=False)
by_law.value("law_position", "s", "1", "Law of motion: position at k", ByText("motion_law", POSITION, k="law_share"), source="motion laws",
    output=False)
by_law.value("law_acceleration", "s″", "1", "Law of motion: acceleration at k", ByText("motion_law", ACCELERATION, k="law_side"),
    source="motion laws", output=False)
by_law.value("law_peak", "A", "1", "Law of motion: maximum acceleration", ByText("motion_law", PEAK_ACCELERATION), source="motion laws", output=False)
by_law.value("input", "y", "deg", "Position of the input", lambda rise, law_position: rise * law_position, units=STRAIGHT, source="motion laws")
by_law.choice("rigid_acceleration", "a_y", "rad/s**2", "Acceleration of the input, and of a rigidly driven link",
    case(bind(law_acceleration, acceleration="law_acceleration"), "the input rises", MOVING), case(lambda: 0, "the input rests"),
    units=STRAIGHT_ACCELERATION, source="motion laws")
by_law.value("acceleration_rigid", "a_r", "rad/s**2", "Peak acceleration of the input, and of a rigidly driven link",
    bind(law_acceleration, acceleration="law_peak"), units=STRAIGHT_ACCELERATION, source="motion laws")

by_curve = Chapter("Motion of the input",
    text="y is the referred curve, from the start s_0 of its motion on (t = 0); one cycle of it lasts T. Its speed and acceleration follow from the "
        "position within the smooth pieces.", needs=CURVE)
by_curve.from_curve("input", "y", "deg", "Position of the input", given="motion_curve", abscissa="time", start="motion_start", lasts="cycle_time",
    gains=True, units=STRAIGHT, source="reference")
by_curve.derivative("input_speed", "v_y", "rad/s", "Speed of the input", of="input", units=STRAIGHT_SPEED, source="kinematics")
by_curve.derivative("rigid_acceleration", "a_y", "rad/s**2", "Acceleration of the input, and of a rigidly driven link", of="input_speed",
    units=STRAIGHT_ACCELERATION, source="kinematics")
by_curve.reduction("rise", "h", "deg", "Range of the motion", "range", of="input", units=STRAIGHT)
by_curve.reduction("input_max", "y_max", "deg", "Upper limit of the motion", "max", of="input", units=STRAIGHT, output=False)
by_curve.reduction("input_min", "y_min", "deg", "Lower limit of the motion", "min", of="input", units=STRAIGHT, output=False)
by_curve.reduction("acceleration_rigid", "a_r", "rad/s**2", "Peak acceleration of the input, and of a rigidly driven link", "abs_max",
    of="rigid_acceleration", units=STRAIGHT_ACCELERATION)
