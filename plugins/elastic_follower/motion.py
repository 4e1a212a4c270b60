"""Chapters on the drive and on the motion of its input: a rise by a law, or a curve."""

from __future__ import annotations

from typing import Any

from diecut_report.api import (
    Abscissa,
    Breakpoints,
    ByText,
    Case,
    Chapter,
    Choice,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    Formula,
    FromCurve,
    Reduction,
    Require,
    Value,
    bind,
)
from diecut_report.mechanics import common, linear_follower
from diecut_report.mechanics.motion_laws import ACCELERATION, JOINT, PEAK_ACCELERATION, POSITION
from diecut_report.plugins.elastic_follower import formulas, rests

STRAIGHT = (("mass", "mm"),)
STRAIGHT_SPEED = (("mass", "m/s"),)
STRAIGHT_ACCELERATION = (("mass", "m/s**2"),)
LAW, CURVE, RATE = ("rise",), ("motion_curve",), ("cycles_per_hour",)
STIFFEST, SOFTEST = 50, 0.1  # natural periods within the rise, between which the drive is calculated


def of_each_body(formula: Formula, **declared: Any) -> tuple[Value, Value]:
    """A step that takes the inertia of a turning link, or the mass of a sliding one."""
    turning, sliding = (bind(formula, inertia=body) for body in ("inertia", "mass"))
    return Value(formula=turning, needs=("inertia",), **declared), Value(formula=sliding, needs=("mass",), **declared)


DRIVE = Chapter(
    "Elastic drive",
    steps=(
        *of_each_body(linear_follower.natural_angular_frequency, id="angular_frequency", symbol="ω", unit="rad/s", source="001, first paper",
                      description="Natural angular frequency"),
        Value(id="natural_frequency", symbol="f_n", unit="Hz", description="Natural frequency", source="001, first paper",
              formula=formulas.cycles_a_second),
        Value(id="natural_period", symbol="T_n", unit="ms", description="Natural period", source="vibration", output=False,
              formula=bind(formulas.inverse, frequency="natural_frequency")),
        Value(id="damped_frequency", symbol="ω_d", unit="rad/s", description="Angular frequency of the damped vibration", source="vibration",
              output=False, formula=linear_follower.damped_angular_frequency),
        *of_each_body(linear_follower.damping_constant, id="damping_constant", symbol="C", unit="N*m*s/rad", units=(("mass", "N*s/m"),),
                      source="vibration", description="Damping of the drive"),
    ),
)  # fmt: skip

TIMES = Chapter(
    "Duration of the motion",
    text="The motion lasts from one rest to the next; where a curve is given, from the end of its longest rest to its start.",
    steps=(
        Value(id="cycle_time", symbol="T", unit="ms", description="Duration of a cycle", needs=RATE,
              formula=bind(formulas.inverse, frequency="cycles_per_hour")),
        CurvePeriod(id="cycle_time", symbol="T", unit="ms", description="Duration of a cycle", needs=CURVE, lacks=RATE, given="motion_curve",
                    otherwise="give cycles_per_hour, with which it runs through once a cycle"),
        Computed(id="motion_start", symbol="s_0", description="Share of the cycle at which the motion begins", needs=CURVE, output=False,
                 source="this method", function=rests.start, takes=CURVE, method="the end of the longest rest among the curve's smooth pieces"),
        Computed(id="motion_share", symbol="s_m", description="Share of the cycle that the motion takes", needs=CURVE, output=False,
                 source="this method", function=rests.share, takes=CURVE, method="what the longest rest leaves of the cycle"),
        Require(id="moves", condition=bind(common.is_below, smaller=0, greater="motion_share"), key="motion_curve", needs=CURVE,
                message="does not move; give a curve that rises between two rests"),
        Require(id="rests", condition=bind(common.is_below, smaller="motion_share", greater=1), key="motion_curve", needs=CURVE,
                message="never rests within its period; give a curve that moves between two rests"),
        Computed(id="speed_jump", symbol="δ_v", description="Greatest jump of position or speed in the motion, to its range and greatest speed",
                 needs=CURVE, output=False, source="this method", function=rests.jump, takes=CURVE,
                 method="position and speed at the end of each smooth piece, compared with those at the start of the next"),
        Require(id="no_jump", condition=bind(common.is_at_most, smaller="speed_jump", greater=1e-6), key="motion_curve", needs=CURVE,
                message="jumps in its position or speed, for which no drive is strong enough; give a motion without such jumps"),
        Value(id="rise_duration", symbol="t_r", unit="ms", description="Duration of the rise", needs=("rise_time",), lacks=RATE,
              formula=bind(common.same, quantity="rise_time")),
        Require(id="share_of_cycle", condition=bind(common.is_at_most, smaller="rise_time", greater=1), key="rise_time",
                needs=("rise_time", *RATE), message="is {rise_time}, more than the cycle: with cycles_per_hour it is the share of the cycle that "
                "the rise takes; give a share up to 1, or seconds without cycles_per_hour"),
        Value(id="rise_duration", symbol="t_r", unit="ms", description="Duration of the rise", needs=("rise_time", *RATE),
              formula=bind(common.product, first="rise_time", second="cycle_time")),
        Value(id="rise_duration", symbol="t_r", unit="ms", description="Duration of the motion", needs=CURVE,
              formula=bind(common.product, first="motion_share", second="cycle_time")),
        Value(id="tuning_ratio", symbol="λ", description="Natural periods within the rise", source="001, first paper",
              formula=bind(linear_follower.tuning_ratio, rise_time="rise_duration")),
        Require(id="not_too_soft", condition=bind(common.is_at_least, greater="tuning_ratio", smaller=SOFTEST), key="stiffness",
                message=f"leaves {{tuning_ratio}} natural periods within the rise; at least {SOFTEST} are needed for this calculation "
                "(the spectrum covers 0.5 to 10): give a stiffer drive or a longer rise"),
        Require(id="not_too_stiff", condition=bind(common.is_at_most, smaller="tuning_ratio", greater=STIFFEST), key="stiffness",
                message=f"leaves {{tuning_ratio}} natural periods within the rise; with more than {STIFFEST} the link follows as if it were "
                "rigid, and needs no such calculation (the spectrum covers 0.5 to 10)"),
        Value(id="follow_time", symbol="t_f", unit="ms", description="Time after the motion for which the vibration is followed", needs=LAW,
              output=False, formula=bind(common.product, first="dwell_cycles", second="natural_period")),
        Value(id="rest_time", symbol="t_0", unit="ms", description="Rest after the motion", needs=CURVE,
              formula=bind(common.difference, greater="cycle_time", smaller="rise_duration")),
        Value(id="wanted_time", symbol="t_w", unit="ms", description="Time for which the vibration is to be followed", needs=CURVE,
              output=False, formula=bind(common.product, first="dwell_cycles", second="natural_period")),
        Value(id="follow_time", symbol="t_f", unit="ms", description="Time after the motion for which the vibration is followed, no longer "
              "than the rest", needs=CURVE, output=False, formula=bind(common.smaller_of, first="wanted_time", second="rest_time")),
        Value(id="duration", symbol="t_e", unit="ms", description="Time from the start of the motion that is calculated", output=False,
              formula=bind(common.sum_of, first="rise_duration", second="follow_time")),
        Abscissa(id="time", symbol="t", unit="ms", description="Time from the start of the motion", period="duration",
                 shown_at="acceleration_peak_at"),
        Breakpoints(id="end_of_rise", abscissa="time", places=("rise_duration",)),
        Value(id="piece_middle", symbol="t_m", unit="ms", description="Time in the middle of the present piece", source="this method",
              output=False, per_piece=True, formula=bind(common.same, quantity="time")),
    ),
)  # fmt: skip

MOVING = bind(common.is_below, smaller="piece_middle", greater="rise_duration")

BY_LAW = Chapter(
    "Motion of the input",
    needs=LAW,
    text="One rise by a law of motion; k is the share of the rise's time that has passed.",
    steps=(
        Value(id="law_share", symbol="k", description="Share of the rise's time that has passed", source="motion laws", output=False,
              formula=formulas.passed_share),
        Value(id="law_joint", symbol="j", description="Joint of the law: changes its sign where the law's formula changes", output=False,
              source="motion laws", formula=ByText("motion_law", JOINT, k="law_share")),
        Crossings(id="law_break", symbol="t_j", unit="ms", description="Time at which the law's formula changes", output=False, of="law_joint"),
        Breakpoints(id="law_breaks", abscissa="time", places=("law_break",)),
        Value(id="law_middle", symbol="k_m", description="Share k in the middle of the present piece", source="this method", output=False,
              per_piece=True, formula=bind(common.same, quantity="law_share")),
        Value(id="law_side", symbol="k_i", output=False, source="this method",
              description="Share k just inside its piece: where the law's acceleration jumps, this tells the side",
              formula=bind(common.just_inside, share="law_share", middle="law_middle")),
        Value(id="law_position", symbol="s", description="Law of motion: position at k", source="motion laws", output=False,
              formula=ByText("motion_law", POSITION, k="law_share")),
        Value(id="law_acceleration", symbol="s″", description="Law of motion: acceleration at k", source="motion laws", output=False,
              formula=ByText("motion_law", ACCELERATION, k="law_side")),
        Value(id="law_peak", symbol="A", description="Law of motion: greatest acceleration", source="motion laws", output=False,
              formula=ByText("motion_law", PEAK_ACCELERATION)),
        Value(id="input", symbol="y", unit="deg", units=STRAIGHT, description="Position of the input", source="motion laws",
              formula=bind(common.product, first="rise", second="law_position")),
        Choice(id="rigid_acceleration", symbol="a_y", unit="rad/s**2", units=STRAIGHT_ACCELERATION, source="motion laws",
               description="Acceleration of the input, which a rigidly driven link would have",
               cases=(Case(bind(formulas.law_acceleration, acceleration="law_acceleration"), "the input rises", MOVING),
                      Case(common.zero, "the input rests"))),
        Value(id="acceleration_rigid", symbol="a_r", unit="rad/s**2", units=STRAIGHT_ACCELERATION, source="motion laws",
              description="Peak acceleration of the input, and of a link that were driven rigidly",
              formula=bind(formulas.law_acceleration, acceleration="law_peak")),
    ),
)  # fmt: skip

BY_CURVE = Chapter(
    "Motion of the input",
    needs=CURVE,
    text="y is the referred curve, from the start s_0 of its motion on (t = 0); one cycle of it lasts T. Its speed and acceleration follow "
    "from the position within the smooth pieces.",
    steps=(
        FromCurve(id="input", symbol="y", unit="deg", units=STRAIGHT, description="Position of the input", source="reference",
                  given="motion_curve", abscissa="time", start="motion_start", lasts="cycle_time", gains=True),
        Derivative(id="input_speed", symbol="v_y", unit="rad/s", units=STRAIGHT_SPEED, description="Speed of the input", source="kinematics",
                   of="input"),
        Derivative(id="rigid_acceleration", symbol="a_y", unit="rad/s**2", units=STRAIGHT_ACCELERATION, source="kinematics",
                   description="Acceleration of the input, which a rigidly driven link would have", of="input_speed"),
        Reduction(id="rise", symbol="h", unit="deg", units=STRAIGHT, description="Range of the motion", of="input", operation="range"),
        Reduction(id="input_max", symbol="y_max", unit="deg", units=STRAIGHT, description="Upper end of the motion", output=False, of="input",
                  operation="max"),
        Reduction(id="input_min", symbol="y_min", unit="deg", units=STRAIGHT, description="Lower end of the motion", output=False, of="input",
                  operation="min"),
        Reduction(id="acceleration_rigid", symbol="a_r", unit="rad/s**2", units=STRAIGHT_ACCELERATION, of="rigid_acceleration",
                  description="Peak acceleration of the input, and of a link that were driven rigidly", operation="abs_max"),
    ),
)  # fmt: skip
