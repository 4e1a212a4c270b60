"""Chapters on the drive and on the motion of its input: a rise by a law, or a curve."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    ByText,
    Chapter,
    Formula,
    Steps,
    abscissa,
    case,
    choice,
    computed,
    crossings,
    curve_period,
    derivative,
    formula,
    from_curve,
    inner,
    m,
    pi,
    reduction,
    value,
)
from diecut_report.mechanics import followers
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
        chapter[id] = value(formula.of(inertia=m[body]), needs=(body,), **options), symbol, unit, description


drive = Chapter("Elastic drive")
of_each_body(drive, "angular_frequency", "ω", "rad/s", "Natural angular frequency", followers.natural_angular_frequency, source="001, first paper")
drive.natural_frequency = m.angular_frequency / (2 * pi), "f_n", "Hz", "Natural frequency", "001, first paper"
drive.natural_period = inner(1 / m.natural_frequency), "T_n", "ms", "Natural period", "vibration"
drive.damped_frequency = inner(followers.damped_angular_frequency), "ω_d", "rad/s", "Angular frequency of the damped vibration", "vibration"
of_each_body(drive, "damping_constant", "C", "N*m*s/rad", "Damping of the drive", followers.damping_constant, units=(("mass", "N*s/m"),),
        source="vibration")

times = Chapter("Duration of the motion",
    text="The motion lasts from one rest to the next; where a curve is given, from the end of its longest rest to its start.")
times.cycle_time = value(1 / m.cycles_per_hour, needs=RATE), "T", "ms", "Duration of a cycle"
times.cycle_time = (curve_period(given="motion_curve", otherwise="give cycles_per_hour, with which it runs through once a cycle", needs=CURVE,
    lacks=RATE), "T", "ms", "Duration of a cycle")
times.curve_rate = (computed(function=lambda motion_curve: motion_curve.rate / (2 * np.pi), takes=CURVE,
    method="the speed of what it runs over, by the turns of its period", needs=(*CURVE, *RATE), output=False), "n_φ", "1/h",
    "Rate at which the curve comes again; 0 where nothing tells it", "kinematics")
times.require("one_rate", (m.curve_rate <= 0) | (abs(m.cycles_per_hour - m.curve_rate) <= ONE_RATE * m.curve_rate), key="cycles_per_hour",
    needs=(*CURVE, *RATE),
    message="is {cycles_per_hour}, but the curve that motion_curve refers to comes again at {curve_rate}; refer to the rate with which that curve is "
    "calculated")
times.motion_start = (computed(function=lambda curve: rests.moving(curve)[0], takes=CURVE,
    method="the end of the longest rest among the curve's smooth pieces", needs=CURVE, output=False), "s_0", "1",
    "Fraction of the cycle at which the motion begins", "this method")
times.motion_share = (computed(function=lambda curve: rests.moving(curve)[1], takes=CURVE, method="the rest of the cycle after the longest rest",
    needs=CURVE, output=False), "s_m", "1", "Fraction of the cycle taken by the motion", "this method")
times.require("moves", m.motion_share > 0, key="motion_curve", message="does not move; give a curve that rises between two rests", needs=CURVE)
times.require("rests", m.motion_share < 1, key="motion_curve", message="never rests within its period; give a curve that moves between two rests",
    needs=CURVE)
times.speed_jump = (computed(function=rests.jump, takes=CURVE,
    method="position and speed at the end of each smooth piece, compared with those at the start of the next", needs=CURVE, output=False), "δ_v",
    "1", "Maximum jump of position or speed in the motion, relative to its range and maximum speed", "this method")
times.require("no_jump", m.speed_jump <= 1e-06, key="motion_curve",
    message="jumps in its position or speed, for which no drive is strong enough; give a motion without such jumps", needs=CURVE)
times.rise_duration = value(m.rise_time, needs=("rise_time",), lacks=RATE), "t_r", "ms", "Duration of the rise"
times.require("share_of_cycle", m.rise_time <= 1, key="rise_time",
    message="is {rise_time}, more than the cycle: with cycles_per_hour it is the fraction of the cycle that the rise takes; give a fraction up to "
    "1, or seconds without cycles_per_hour", needs=("rise_time", *RATE))
times.rise_duration = value(m.rise_time * m.cycle_time, needs=("rise_time", *RATE)), "t_r", "ms", "Duration of the rise"
times.rise_duration = value(m.motion_share * m.cycle_time, needs=CURVE), "t_r", "ms", "Duration of the motion"
times.tuning_ratio = followers.tuning_ratio.of(rise_time=m.rise_duration), "λ", "1", "Natural periods within the rise", "001, first paper"
times.require("not_too_soft", m.tuning_ratio >= SOFTEST, key="stiffness",
    message=f"leaves {{tuning_ratio}} natural periods within the rise; at least {SOFTEST} are needed for this calculation (the spectrum covers 0.5 "
    "to 10): give a stiffer drive or a longer rise")
times.require("not_too_stiff", m.tuning_ratio <= STIFFEST, key="stiffness",
    message=f"leaves {{tuning_ratio}} natural periods within the rise; with more than {STIFFEST} the link follows as if it were rigid, and needs no "
    "such calculation (the spectrum covers 0.5 to 10)")
times.follow_time = inner(m.dwell_cycles * m.natural_period, needs=LAW), "t_f", "ms", "Time after the motion for which the vibration is calculated"
times.rest_time = value(m.cycle_time - m.rise_duration, needs=CURVE), "t_0", "ms", "Rest after the motion"
times.wanted_time = inner(m.dwell_cycles * m.natural_period, needs=CURVE), "t_w", "ms", "Requested time of the vibration after the motion"
times.follow_time = (inner(np.minimum(m.wanted_time, m.rest_time), needs=CURVE), "t_f", "ms",
    "Calculated time of the vibration after the motion, no longer than the rest")
times.duration = inner(m.rise_duration + m.follow_time), "t_e", "ms", "Calculated time from the start of the motion"
times.time = abscissa("duration", shown_at="acceleration_peak_at"), "t", "ms", "Time from the start of the motion"
times.breakpoints("end_of_rise", "time", "rise_duration")
times.phase("moving", "moving", "The input moves", "time", (0, "rise_duration"), period="cycle_time", needs=RATE)
times.piece_middle = inner(m.time, per_piece=True), "t_m", "ms", "Time in the middle of the present piece", "this method"

MOVING = m.piece_middle < m.rise_duration

by_law = Chapter("Motion of the input", text="One rise by a law of motion; k is the elapsed fraction of the rise time.", needs=LAW)
by_law.law_share = inner(np.minimum(m.time / m.rise_duration, 1)), "k", "1", "Elapsed fraction of the rise time", "motion laws"
by_law.law_joint = (inner(ByText("motion_law", JOINT, k=m.law_share), printed=False), "j", "1",
    "Junction of the law: changes its sign where the law's formula changes", "motion laws")
by_law.law_break = crossings(of="law_joint", output=False, printed=False), "t_j", "ms", "Time at which the law's formula changes"
by_law.breakpoints("law_breaks", "time", "law_break")
by_law.law_middle = inner(m.law_share, per_piece=True, printed=False), "k_m", "1", "Fraction k in the middle of the current piece", "this method"
by_law.law_side = (inner(m.law_share + 1e-12 * (m.law_middle - m.law_share), printed=False), "k", "1",
    "Fraction k just inside its piece: selects the side where the law's acceleration jumps", "this method")
by_law.law_position = inner(ByText("motion_law", POSITION, k=m.law_share)), "s", "1", "Law of motion: position at k", "motion laws"
by_law.law_acceleration = inner(ByText("motion_law", ACCELERATION, k=m.law_side)), "s″", "1", "Law of motion: acceleration at k", "motion laws"
by_law.law_peak = inner(ByText("motion_law", PEAK_ACCELERATION)), "A", "1", "Law of motion: maximum acceleration", "motion laws"
by_law.input = value(m.rise * m.law_position, units=STRAIGHT), "y", "deg", "Position of the input", "motion laws"
by_law.rigid_acceleration = (choice(case(law_acceleration.of(acceleration=m.law_acceleration), "the input rises", MOVING),
    case(0, "the input rests"), units=STRAIGHT_ACCELERATION), "a_y", "rad/s**2", "Acceleration of the input, and of a rigidly driven link",
    "motion laws")
by_law.acceleration_rigid = (value(law_acceleration.of(acceleration=m.law_peak), units=STRAIGHT_ACCELERATION), "a_r", "rad/s**2",
    "Peak acceleration of the input, and of a rigidly driven link", "motion laws")

by_curve = Chapter("Motion of the input",
    text="y is the referred curve, from the start s_0 of its motion on (t = 0); one cycle of it lasts T. Its speed and acceleration follow from the "
        "position within the smooth pieces.", needs=CURVE)
by_curve.input = (from_curve(given="motion_curve", abscissa="time", start="motion_start", lasts="cycle_time", gains=True, units=STRAIGHT), "y",
    "deg", "Position of the input", "reference")
by_curve.input_speed = derivative(of="input", units=STRAIGHT_SPEED), "v_y", "rad/s", "Speed of the input", "kinematics"
by_curve.rigid_acceleration = (derivative(of="input_speed", units=STRAIGHT_ACCELERATION), "a_y", "rad/s**2",
    "Acceleration of the input, and of a rigidly driven link", "kinematics")
by_curve.rise = reduction("range", of="input", units=STRAIGHT), "h", "deg", "Range of the motion"
by_curve.input_max = reduction("max", of="input", units=STRAIGHT, output=False), "y_max", "deg", "Upper limit of the motion"
by_curve.input_min = reduction("min", of="input", units=STRAIGHT, output=False), "y_min", "deg", "Lower limit of the motion"
by_curve.acceleration_rigid = (reduction("abs_max", of="rigid_acceleration", units=STRAIGHT_ACCELERATION), "a_r", "rad/s**2",
    "Peak acceleration of the input, and of a rigidly driven link")
