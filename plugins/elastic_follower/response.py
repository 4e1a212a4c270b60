"""Chapters on the driven link: its vibration, peaks, torque, and the comparison of the laws of motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np

from diecut_report.api import Binding, Case, Chapter, Spectrum, SpectrumLine, Steps, bind, case
from diecut_report.mechanics import common, followers
from diecut_report.mechanics.followers import Peaks, peaks
from diecut_report.mechanics.motion_laws import LAWS, MotionLaw
from diecut_report.plugins.elastic_follower import motion, rests
from diecut_report.plugins.elastic_follower.motion import (
    CURVE,
    LAW,
    MOVING,
    RATE,
    STRAIGHT,
    STRAIGHT_ACCELERATION,
    STRAIGHT_SPEED,
)

# fmt: off

FIRST, LAST = 0.5, 10.0  # natural periods within the rise
RATIOS = np.linspace(FIRST, LAST, 96)
DAMPINGS = (0.0, 0.02, 0.05, 0.1, 0.2)


@cache
def of_law(name: str) -> Peaks:
    """Peaks of a law over ``RATIOS``, a row for each of ``DAMPINGS``."""
    return peaks(LAWS[name], RATIOS, np.array(DAMPINGS)[:, None])


def lines() -> Sequence[SpectrumLine]:
    """The peak in the rise for each law and damping."""
    return [
        SpectrumLine(
            id=f"peak_ratio_{name}_damping_{round(100 * damping):02d}",
            symbol="q",
            description=f"Peak acceleration in the rise, to the rigid one: {law.title[0].lower()}{law.title[1:]}, ζ = {damping:g}",
            values=row,
            source="001, first paper",
        )
        for name, law in LAWS.items()
        for damping, row in zip(DAMPINGS, of_law(name).rise, strict=True)
    ]


SPECTRUM = Spectrum(
    id="tuning_ratio", symbol="λ", description="Natural periods within the rise", values=RATIOS, lines=lines
)


FORCE = (("mass", "N"),)

response = Chapter("Motion of the driven link",
    text="I·ẍ = K·(y − x) + C·(ẏ − ẋ), from rest. The deflection z = x − y follows exactly from two running integrals over the input's acceleration "
        "(Duhamel's integral split into two), which are evaluated piece by piece.")
response.breakpoints("natural_periods", "time", every="natural_period")
response.value("decay", "E", "1", "Remaining fraction of a vibration after the time t", followers.decay, source="vibration", output=False)
response.value("phase", "ψ", "deg", "Phase of the damped vibration", followers.phase, source="vibration", output=False)
response.value("in_phase_part", "c", "rad/s**2", "Integrand of the first integral",
    bind(followers.in_phase_part, input_acceleration="rigid_acceleration"), units=STRAIGHT_ACCELERATION, source="Duhamel's integral", output=False)
response.value("quadrature_part", "s_q", "rad/s**2", "Integrand of the second integral",
    bind(followers.quadrature_part, input_acceleration="rigid_acceleration"), units=STRAIGHT_ACCELERATION, source="Duhamel's integral", output=False)
response.accumulated("in_phase", "C_t", "rad/s", "First integral up to the time t", of="in_phase_part", units=STRAIGHT_SPEED,
    source="Duhamel's integral", output=False)
response.accumulated("quadrature", "S_t", "rad/s", "Second integral up to the time t", of="quadrature_part", units=STRAIGHT_SPEED,
    source="Duhamel's integral", output=False)
response.value("deflection", "z", "deg", "Deflection of the drive: lead of the link over the input", followers.deflection, units=STRAIGHT,
    source="Duhamel's integral")
response.value("swing_speed", "v_ψ", "rad/s", "Contribution of the phase change to the speed of the deflection", followers.swing_speed,
    units=STRAIGHT_SPEED, source="Duhamel's integral", output=False)
response.value("deflection_speed", "v_z", "rad/s", "Speed of the deflection", followers.deflection_velocity, units=STRAIGHT_SPEED,
    source="Duhamel's integral", output=False)
response.value("response", "x", "deg", "Position of the driven link", lambda input, deflection: input + deflection, units=STRAIGHT,
    source="kinematics")
response.value("acceleration", "a", "rad/s**2", "Acceleration of the driven link",
    bind(followers.response_acceleration, deflection_velocity="deflection_speed"), units=STRAIGHT_ACCELERATION, source="001, first paper")
response.value("torque", "M", "N*m", "Torque (or force) of the drive on the link",
    bind(followers.drive_torque, deflection_velocity="deflection_speed"), units=FORCE, source="statics")


def _while(chapter: Steps, rising: bool, symbol: str, words: str) -> None:
    there = bind(common.same, quantity="acceleration")
    chapter.choice(f"acceleration_{'rising' if rising else 'resting'}", symbol, "rad/s**2",
        f"Acceleration of the driven link {words} the motion, else zero", case(there if rising else common.zero, "the input moves", MOVING),
        case(common.zero if rising else there, "the input rests"), units=STRAIGHT_ACCELERATION, output=False, source="this method")


settling = Chapter("Settling after the motion", needs=(*RATE, "rest_tolerance"), absent="not calculated: {missing} not given",
    text="The link is at rest once it stays within the tolerance of its input. Where its vibration is still greater at the end of the calculated "
        "time, its amplitude tells when. Without damping, or where the next motion begins before, it never rests.")
settling.value("settle_excess", "Π_z", "rad**2", "Square of the deflection less that of the tolerance",
    lambda deflection, rest_tolerance: deflection ** 2 - rest_tolerance ** 2, units=(("mass", "m**2"),), output=False)
settling.crossings("settle_edge", "t_z", "ms", "Time at which the link crosses the tolerance", of="settle_excess")
settling.computed("last_edge", "t_zl", "ms", "The last of these times, no earlier than the end of the motion", rests.last_or_end,
    ("settle_edge", "rise_duration"), "the greatest of them", output=False)
settling.reduction("in_phase_end", "C_e", "rad/s", "First integral at the end of the calculated time", "integral", of="in_phase_part",
    units=STRAIGHT_SPEED, source="Duhamel's integral", output=False)
settling.reduction("quadrature_end", "S_e", "rad/s", "Second integral at the end of the calculated time", "integral", of="quadrature_part",
    units=STRAIGHT_SPEED, source="Duhamel's integral", output=False)
settling.value("decay_end", "E_e", "1", "Remaining fraction of a vibration at the end of the calculated time",
    bind(followers.decay, time="duration"), source="vibration", output=False)
settling.value("swing_end", "z_e", "deg", "Amplitude of the vibration at the end of the calculated time",
    bind(followers.swing_amplitude, decay="decay_end", in_phase="in_phase_end", quadrature="quadrature_end"), units=STRAIGHT, source="vibration",
    output=False)
settling.choice("rest_start", "t_s0", "ms", "Time from which the link stays within the tolerance",
    case(bind(common.same, quantity="last_edge"), "it does before the calculated time ends",
        bind(common.is_at_most, smaller="swing_end", greater="rest_tolerance")),
    case(bind(lambda duration, swing, tolerance, angular_frequency, damping_ratio:
            duration + followers.time_to_fall(swing, tolerance, angular_frequency, damping_ratio), swing="swing_end", tolerance="rest_tolerance"),
        "otherwise when the amplitude has fallen to it"), source="vibration", output=False,
    exists=lambda swing_end, rest_tolerance, damping_ratio: (swing_end <= rest_tolerance) | (damping_ratio > 0))
settling.value("settle_end", "t_s", "ms", "Time from which the link stays at rest", lambda rest_start: rest_start,
    exists=lambda rest_start, cycle_time: rest_start < cycle_time)
settling.phase("settling", "moving", "The link settles after the motion", "time", ("rise_duration", "settle_end"), period="cycle_time")
settling.phase("rest", "rest", "The link rests", "time", ("settle_end", 0), period="cycle_time")

extremes = Chapter("Peaks")
_while(extremes, True, "a_1", "during")
_while(extremes, False, "a_2", "after")
extremes.reduction("acceleration_during", "a_1,max", "rad/s**2", "Peak acceleration of the driven link during the motion", "abs_max",
    of="acceleration_rising", units=STRAIGHT_ACCELERATION)
extremes.reduction("acceleration_after", "a_2,max", "rad/s**2", "Peak acceleration of the driven link after the motion", "abs_max",
    of="acceleration_resting", units=STRAIGHT_ACCELERATION)
extremes.reduction("acceleration_peak", "a_max", "rad/s**2", "Peak acceleration of the driven link, during or after the motion", "abs_max",
    of="acceleration", units=STRAIGHT_ACCELERATION)
extremes.value("peak_ratio", "q", "1", "Ratio of the peak acceleration during the motion to the rigid-drive value",
    lambda acceleration_during, acceleration_rigid: acceleration_during / acceleration_rigid, source="001, first paper")
extremes.value("residual_ratio", "q_2", "1", "Ratio of the peak acceleration after the motion to the rigid-drive value",
    lambda acceleration_after, acceleration_rigid: acceleration_after / acceleration_rigid, source="001, first paper")
extremes.reduction("response_max", "x_max", "deg", "Upper extreme position of the driven link", "max", of="response", units=STRAIGHT, output=False)
extremes.reduction("response_min", "x_min", "deg", "Lower extreme position of the driven link", "min", of="response", units=STRAIGHT, output=False,
    needs=CURVE)
extremes.value("overshoot", "ε", "1", "Relative overshoot beyond the rise", lambda response_max, rise: (response_max - rise) / rise, needs=LAW)
extremes.value("overshoot", "ε", "1", "Overshoot beyond the limits of the motion, relative to its range",
    lambda response_max, response_min, input_max, input_min, rise: np.maximum(response_max - input_max, input_min - response_min) / rise,
    needs=CURVE)
extremes.reduction("torque_peak", "M_max", "N*m", "Maximum torque (or force) of the drive", "abs_max", of="torque", units=FORCE)


def greatest(law: MotionLaw) -> Callable[..., Any]:
    """The link's peak acceleration with a law, during or after the rise, as a function of λ, ζ, rise and duration."""

    def found(tuning_ratio: Any, damping_ratio: Any, rise: Any, rise_duration: Any) -> Any:
        ratio = np.maximum(*peaks(law, tuning_ratio, damping_ratio))
        return ratio * motion.law_acceleration(rise, rise_duration, law.A)

    return found

OF_LAWS = {name: f"{name}_acceleration" for name in LAWS}


def _least(name: str, *, is_last: bool = False) -> Case:
    held = None if is_last else bind(common.is_at_most, smaller=OF_LAWS[name], greater="least_acceleration")
    return case(name, f"{LAWS[name].title} has the lowest", held)


def recommended(chapter: Steps, description: str, needs: tuple[str, ...], exists: Binding | None) -> None:
    """The law to take; it has a meaning for a motion in one direction only, and of a curve only where that is a single rise."""
    chapter.choice("recommended_law", "L", "1", description, *(_least(name) for name in list(LAWS)[:-1]), _least(list(LAWS)[-1], is_last=True),
        source="this method", needs=needs, exists=exists)


compared = Chapter("Comparison of laws of motion",
    text="For a single rise of the same height and duration on the same drive: the maximum acceleration of the driven link with each law, during or "
        "after the rise. A motion composed of several rises, given as a curve, has other peaks and may rank the laws differently: there each law is "
        "to be tried in the mechanism that generates the curve.")
for number, (name, law) in enumerate(LAWS.items(), 1):
    compared.computed(OF_LAWS[name], f"a_{number}L", "rad/s**2", f"Peak acceleration of the driven link: {law.title[0].lower()}{law.title[1:]}",
        greatest(law), takes=("tuning_ratio", "damping_ratio", "rise", "rise_duration"),
        method="exact propagation of the drive's vibration through the law's smooth pieces", units=STRAIGHT_ACCELERATION, source="this method")
compared.computed("least_acceleration", "a_L", "rad/s**2", "Minimum of these",
    function=lambda *accelerations: np.minimum.reduce(accelerations), takes=tuple(OF_LAWS.values()), method="comparison",
    units=STRAIGHT_ACCELERATION, source="this method", output=False)
compared.computed("one_way", "g", "1", "Drift of the motion per cycle, relative to its range", function=rests.gained, takes=CURVE,
    method="positions at both ends of the cycle", source="this method", output=False, needs=CURVE)
recommended(compared, "Law of motion with the lowest peak acceleration of the driven link", LAW, None)
recommended(compared, "Law that loads the link least in a single rise; this motion, of several parts, may need another", CURVE,
        bind(common.is_at_least, greater="one_way", smaller=0.999))
