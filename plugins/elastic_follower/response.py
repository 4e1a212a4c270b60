"""Chapters on the driven link: its vibration, peaks, torque, and the comparison of the laws of motion."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from diecut_report.api import Accumulated, Binding, Breakpoints, Case, Chapter, Choice, Computed, Reduction, Value, bind
from diecut_report.mechanics import common, linear_follower
from diecut_report.mechanics.follower_peaks import peaks
from diecut_report.mechanics.motion_laws import LAWS, MotionLaw
from diecut_report.plugins.elastic_follower import formulas, rests
from diecut_report.plugins.elastic_follower.motion import (
    CURVE,
    LAW,
    MOVING,
    STRAIGHT,
    STRAIGHT_ACCELERATION,
    STRAIGHT_SPEED,
)

FORCE = (("mass", "N"),)

RESPONSE = Chapter(
    "Motion of the driven link",
    text="I·ẍ = K·(y − x) + C·(ẏ − ẋ), from rest. The deflection z = x − y follows exactly from two running integrals over the input's "
    "acceleration (Duhamel's integral taken apart), which are taken piece by piece.",
    steps=(
        Breakpoints(id="natural_periods", abscissa="time", every="natural_period"),
        Value(id="decay", symbol="E", source="vibration", output=False, description="Share of a vibration that is left after the time t",
              formula=linear_follower.decay),
        Value(id="phase", symbol="ψ", unit="deg", source="vibration", output=False, description="Phase of the damped vibration",
              formula=linear_follower.phase),
        Value(id="in_phase_part", symbol="c", unit="rad/s**2", units=STRAIGHT_ACCELERATION, source="Duhamel's integral", output=False,
              description="What the first integral adds up", formula=bind(linear_follower.in_phase_part, input_acceleration="rigid_acceleration")),
        Value(id="quadrature_part", symbol="s_q", unit="rad/s**2", units=STRAIGHT_ACCELERATION, source="Duhamel's integral", output=False,
              description="What the second integral adds up",
              formula=bind(linear_follower.quadrature_part, input_acceleration="rigid_acceleration")),
        Accumulated(id="in_phase", symbol="C_t", unit="rad/s", units=STRAIGHT_SPEED, description="First integral up to the time t",
                    source="Duhamel's integral", output=False, of="in_phase_part"),
        Accumulated(id="quadrature", symbol="S_t", unit="rad/s", units=STRAIGHT_SPEED, description="Second integral up to the time t",
                    source="Duhamel's integral", output=False, of="quadrature_part"),
        Value(id="deflection", symbol="z", unit="deg", units=STRAIGHT, description="Deflection of the drive: link ahead of the input",
              source="Duhamel's integral", formula=linear_follower.deflection),
        Value(id="swing_speed", symbol="v_ψ", unit="rad/s", units=STRAIGHT_SPEED, source="Duhamel's integral", output=False,
              description="What the phase's growth gives of the deflection's speed", formula=linear_follower.swing_speed),
        Value(id="deflection_speed", symbol="v_z", unit="rad/s", units=STRAIGHT_SPEED, description="Speed of the deflection",
              source="Duhamel's integral", output=False, formula=linear_follower.deflection_velocity),
        Value(id="response", symbol="x", unit="deg", units=STRAIGHT, description="Position of the driven link", source="kinematics",
              formula=bind(common.sum_of, first="input", second="deflection")),
        Value(id="acceleration", symbol="a", unit="rad/s**2", units=STRAIGHT_ACCELERATION, description="Acceleration of the driven link",
              source="001, first paper",
              formula=bind(linear_follower.response_acceleration, deflection_velocity="deflection_speed")),
        Value(id="torque", symbol="M", unit="N*m", units=FORCE, description="Torque (or force) of the drive on the link", source="statics",
              formula=bind(linear_follower.drive_torque, deflection_velocity="deflection_speed")),
    ),
)  # fmt: skip


def _while(rising: bool, symbol: str, words: str) -> Choice:
    there = bind(common.same, quantity="acceleration")
    return Choice(
        id=f"acceleration_{'rising' if rising else 'resting'}", symbol=symbol, unit="rad/s**2", units=STRAIGHT_ACCELERATION, output=False,
        description=f"Acceleration of the driven link {words} the motion, else zero", source="this method",
        cases=(Case(there if rising else common.zero, "the input moves", MOVING), Case(common.zero if rising else there, "the input rests")),
    )  # fmt: skip


PEAKS = Chapter(
    "Peaks",
    steps=(
        _while(True, "a_1", "during"),
        _while(False, "a_2", "after"),
        Reduction(id="acceleration_during", symbol="a_1,max", unit="rad/s**2", units=STRAIGHT_ACCELERATION, of="acceleration_rising",
                  description="Peak acceleration of the driven link during the motion", operation="abs_max"),
        Reduction(id="acceleration_after", symbol="a_2,max", unit="rad/s**2", units=STRAIGHT_ACCELERATION, of="acceleration_resting",
                  description="Peak acceleration of the driven link after the motion", operation="abs_max"),
        Reduction(id="acceleration_peak", symbol="a_max", unit="rad/s**2", units=STRAIGHT_ACCELERATION, of="acceleration",
                  description="Peak acceleration of the driven link, during or after the motion", operation="abs_max"),
        Value(id="peak_ratio", symbol="q", description="Peak acceleration during the motion, to the rigid one", source="001, first paper",
              formula=bind(common.quotient, quantity="acceleration_during", by="acceleration_rigid")),
        Value(id="residual_ratio", symbol="q_2", description="Peak acceleration after the motion, to the rigid one", source="001, first paper",
              formula=bind(common.quotient, quantity="acceleration_after", by="acceleration_rigid")),
        Reduction(id="response_max", symbol="x_max", unit="deg", units=STRAIGHT, description="Farthest position of the driven link", output=False,
                  of="response", operation="max"),
        Reduction(id="response_min", symbol="x_min", unit="deg", units=STRAIGHT, description="Lowest position of the driven link", output=False,
                  needs=CURVE, of="response", operation="min"),
        Value(id="overshoot", symbol="ε", description="What the link goes beyond the rise, to the rise", needs=LAW,
              formula=formulas.overshoot_of_rise),
        Value(id="overshoot", symbol="ε", description="What the link goes beyond the ends of the motion, to its range", needs=CURVE,
              formula=formulas.overshoot_of_curve),
        Reduction(id="torque_peak", symbol="M_max", unit="N*m", units=FORCE, description="Greatest torque (or force) of the drive", of="torque",
                  operation="abs_max"),
    ),
)  # fmt: skip


def greatest(law: MotionLaw) -> Callable[..., Any]:
    """The link's peak acceleration with a law, during or after the rise, as a function of λ, ζ, rise and duration."""

    def found(tuning_ratio: Any, damping_ratio: Any, rise: Any, rise_duration: Any) -> Any:
        ratio = np.maximum(*peaks(law, tuning_ratio, damping_ratio))
        return ratio * formulas.law_acceleration(rise, rise_duration, law.A)

    return found


def least(*accelerations: Any) -> Any:
    """The least of the laws' peaks."""
    return np.minimum.reduce(accelerations)


OF_LAWS = {name: f"{name}_acceleration" for name in LAWS}


def _least(name: str, *, is_last: bool = False) -> Case:
    held = None if is_last else bind(common.is_at_most, smaller=OF_LAWS[name], greater="least_acceleration")
    return Case(name, f"{LAWS[name].title} has the least", held)


def recommended(needs: tuple[str, ...], exists: Binding | None) -> Choice:
    """The law to take; it has a meaning for a motion in one direction only."""
    return Choice(
        id="recommended_law", symbol="L", description="Law of motion with the least peak acceleration of the driven link", source="this method",
        needs=needs, exists=exists, cases=(*(_least(name) for name in list(LAWS)[:-1]), _least(list(LAWS)[-1], is_last=True)),
    )  # fmt: skip


COMPARED = Chapter(
    "Laws of motion compared",
    text="For a single rise of the same height and duration on the same drive: the greatest acceleration of the driven link with each law, "
    "during the rise or after it.",
    steps=(
        *(Computed(id=OF_LAWS[name], symbol=f"a_{number}L", unit="rad/s**2", units=STRAIGHT_ACCELERATION, source="this method",
                   description=f"Peak acceleration of the driven link: {law.title[0].lower()}{law.title[1:]}", function=greatest(law),
                   takes=("tuning_ratio", "damping_ratio", "rise", "rise_duration"),
                   method="exact propagation of the drive's vibration through the law's smooth pieces")
          for number, (name, law) in enumerate(LAWS.items(), 1)),
        Computed(id="least_acceleration", symbol="a_L", unit="rad/s**2", units=STRAIGHT_ACCELERATION, source="this method", output=False,
                 description="Least of these", function=least, takes=tuple(OF_LAWS.values()), method="comparison"),
        Computed(id="one_way", symbol="g", description="What the motion gains in a cycle, to its range", source="this method", output=False,
                 needs=CURVE, function=rests.gained, takes=CURVE, method="positions at both ends of the cycle"),
        recommended(LAW, None),
        recommended(CURVE, bind(common.is_at_least, greater="one_way", smaller=0.999)),
    ),
)  # fmt: skip
