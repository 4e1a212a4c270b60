"""Chapters on the driven link: its vibration, peaks, torque, and the comparison of the laws of motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np

from diecut_report.api import (
    Case,
    Chapter,
    Spectrum,
    SpectrumLine,
    Steps,
    accumulated,
    case,
    choice,
    computed,
    crossings,
    inner,
    m,
    reduction,
    value,
)
from diecut_report.mechanics import followers
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
response.decay = inner(followers.decay), "E", "1", "Remaining fraction of a vibration after the time t", "vibration"
response["phase"] = inner(followers.phase), "ψ", "deg", "Phase of the damped vibration", "vibration"
response.in_phase_part = (inner(followers.in_phase_part.of(input_acceleration=m.rigid_acceleration), units=STRAIGHT_ACCELERATION), "c", "rad/s**2",
    "Integrand of the first integral", "Duhamel's integral")
response.quadrature_part = (inner(followers.quadrature_part.of(input_acceleration=m.rigid_acceleration), units=STRAIGHT_ACCELERATION), "s_q",
    "rad/s**2", "Integrand of the second integral", "Duhamel's integral")
response.in_phase = (accumulated(of="in_phase_part", units=STRAIGHT_SPEED, output=False), "C_t", "rad/s", "First integral up to the time t",
    "Duhamel's integral")
response.quadrature = (accumulated(of="quadrature_part", units=STRAIGHT_SPEED, output=False), "S_t", "rad/s", "Second integral up to the time t",
    "Duhamel's integral")
response.deflection = (value(followers.deflection, units=STRAIGHT), "z", "deg", "Deflection of the drive: lead of the link over the input",
    "Duhamel's integral")
response.swing_speed = (inner(followers.swing_speed, units=STRAIGHT_SPEED), "v_ψ", "rad/s",
    "Contribution of the phase change to the speed of the deflection", "Duhamel's integral")
response.deflection_speed = (inner(followers.deflection_velocity, units=STRAIGHT_SPEED), "v_z", "rad/s", "Speed of the deflection",
    "Duhamel's integral")
response.response = value(m.input + m.deflection, units=STRAIGHT), "x", "deg", "Position of the driven link", "kinematics"
response.acceleration = (value(followers.response_acceleration.of(deflection_velocity=m.deflection_speed), units=STRAIGHT_ACCELERATION), "a",
    "rad/s**2", "Acceleration of the driven link", "001, first paper")
response.torque = (value(followers.drive_torque.of(deflection_velocity=m.deflection_speed), units=FORCE), "M", "N*m",
    "Torque (or force) of the drive on the link", "statics")


def _while(chapter: Steps, rising: bool, symbol: str, words: str) -> None:
    there = m.acceleration
    chapter[f"acceleration_{'rising' if rising else 'resting'}"] = (choice(case(there if rising else 0, "the input moves", MOVING),
        case(0 if rising else there, "the input rests"), units=STRAIGHT_ACCELERATION, output=False), symbol, "rad/s**2",
        f"Acceleration of the driven link {words} the motion, else zero", "this method")


settling = Chapter("Settling after the motion", needs=(*RATE, "rest_tolerance"), absent="not calculated: {missing} not given",
    text="The link is at rest once it stays within the tolerance of its input. Where its vibration is still greater at the end of the calculated "
        "time, its amplitude tells when. Without damping, or where the next motion begins before, it never rests.")
settling.settle_excess = (inner(m.deflection ** 2 - m.rest_tolerance ** 2, units=(("mass", "m**2"),)), "Π_z", "rad**2",
    "Square of the deflection less that of the tolerance")
settling.settle_edge = crossings(of="settle_excess"), "t_z", "ms", "Time at which the link crosses the tolerance"
settling.last_edge = (computed(rests.last_or_end, ("settle_edge", "rise_duration"), "the greatest of them", output=False), "t_zl", "ms",
    "The last of these times, no earlier than the end of the motion")
settling.in_phase_end = (reduction("integral", of="in_phase_part", units=STRAIGHT_SPEED, output=False), "C_e", "rad/s",
    "First integral at the end of the calculated time", "Duhamel's integral")
settling.quadrature_end = (reduction("integral", of="quadrature_part", units=STRAIGHT_SPEED, output=False), "S_e", "rad/s",
    "Second integral at the end of the calculated time", "Duhamel's integral")
settling.decay_end = (inner(followers.decay.of(time=m.duration)), "E_e", "1", "Remaining fraction of a vibration at the end of the calculated time",
    "vibration")
settling.swing_end = (inner(followers.swing_amplitude.of(decay=m.decay_end, in_phase=m.in_phase_end, quadrature=m.quadrature_end), units=STRAIGHT),
    "z_e", "deg", "Amplitude of the vibration at the end of the calculated time", "vibration")
settling.rest_start = (choice(case(m.last_edge, "it does before the calculated time ends", m.swing_end <= m.rest_tolerance),
    case(m.duration + followers.time_to_fall(m.swing_end, m.rest_tolerance, m.angular_frequency, m.damping_ratio),
    "otherwise when the amplitude has fallen to it"), output=False, exists=(m.swing_end <= m.rest_tolerance) | (m.damping_ratio > 0)), "t_s0", "ms",
    "Time from which the link stays within the tolerance", "vibration")
settling.settle_end = value(m.rest_start, exists=m.rest_start < m.cycle_time), "t_s", "ms", "Time from which the link stays at rest"
settling.phase("settling", "moving", "The link settles after the motion", "time", ("rise_duration", "settle_end"), period="cycle_time")
settling.phase("rest", "rest", "The link rests", "time", ("settle_end", 0), period="cycle_time")

extremes = Chapter("Peaks")
_while(extremes, True, "a_1", "during")
_while(extremes, False, "a_2", "after")
extremes.acceleration_during = (reduction("abs_max", of="acceleration_rising", units=STRAIGHT_ACCELERATION), "a_1,max", "rad/s**2",
    "Peak acceleration of the driven link during the motion")
extremes.acceleration_after = (reduction("abs_max", of="acceleration_resting", units=STRAIGHT_ACCELERATION), "a_2,max", "rad/s**2",
    "Peak acceleration of the driven link after the motion")
extremes.acceleration_peak = (reduction("abs_max", of="acceleration", units=STRAIGHT_ACCELERATION), "a_max", "rad/s**2",
    "Peak acceleration of the driven link, during or after the motion")
extremes.peak_ratio = (m.acceleration_during / m.acceleration_rigid, "q", "1",
    "Ratio of the peak acceleration during the motion to the rigid-drive value", "001, first paper")
extremes.residual_ratio = (m.acceleration_after / m.acceleration_rigid, "q_2", "1",
    "Ratio of the peak acceleration after the motion to the rigid-drive value", "001, first paper")
extremes.response_max = reduction("max", of="response", units=STRAIGHT, output=False), "x_max", "deg", "Upper extreme position of the driven link"
extremes.response_min = (reduction("min", of="response", units=STRAIGHT, output=False, needs=CURVE), "x_min", "deg",
    "Lower extreme position of the driven link")
extremes.overshoot = value((m.response_max - m.rise) / m.rise, needs=LAW), "ε", "1", "Relative overshoot beyond the rise"
extremes.overshoot = (value(np.maximum(m.response_max - m.input_max, m.input_min - m.response_min) / m.rise, needs=CURVE), "ε", "1",
    "Overshoot beyond the limits of the motion, relative to its range")
extremes.torque_peak = reduction("abs_max", of="torque", units=FORCE), "M_max", "N*m", "Maximum torque (or force) of the drive"


def greatest(law: MotionLaw) -> Callable[..., Any]:
    """The link's peak acceleration with a law, during or after the rise, as a function of λ, ζ, rise and duration."""

    def found(tuning_ratio: Any, damping_ratio: Any, rise: Any, rise_duration: Any) -> Any:
        ratio = np.maximum(*peaks(law, tuning_ratio, damping_ratio))
        return ratio * motion.law_acceleration(rise, rise_duration, law.A)

    return found

OF_LAWS = {name: f"{name}_acceleration" for name in LAWS}


def _least(name: str, *, is_last: bool = False) -> Case:
    held = None if is_last else m[OF_LAWS[name]] <= m.least_acceleration
    return case(name, f"{LAWS[name].title} has the lowest", held)


def recommended(chapter: Steps, description: str, needs: tuple[str, ...], exists: Any | None) -> None:
    """The law to take; it has a meaning for a motion in one direction only, and of a curve only where that is a single rise."""
    chapter.recommended_law = (choice(*(_least(name) for name in list(LAWS)[:-1]), _least(list(LAWS)[-1], is_last=True), needs=needs, exists=exists),
        "L", "1", description, "this method")


compared = Chapter("Comparison of laws of motion",
    text="For a single rise of the same height and duration on the same drive: the maximum acceleration of the driven link with each law, during or "
        "after the rise. A motion composed of several rises, given as a curve, has other peaks and may rank the laws differently: there each law is "
        "to be tried in the mechanism that generates the curve.")
for number, (name, law) in enumerate(LAWS.items(), 1):
    compared[OF_LAWS[name]] = (computed(greatest(law), takes=("tuning_ratio", "damping_ratio", "rise", "rise_duration"),
        method="exact propagation of the drive's vibration through the law's smooth pieces", units=STRAIGHT_ACCELERATION), f"a_{number}L",
        "rad/s**2", f"Peak acceleration of the driven link: {law.title[0].lower()}{law.title[1:]}", "this method")
compared.least_acceleration = (computed(function=lambda *accelerations: np.minimum.reduce(accelerations), takes=tuple(OF_LAWS.values()),
    method="comparison", units=STRAIGHT_ACCELERATION, output=False), "a_L", "rad/s**2", "Minimum of these", "this method")
compared.one_way = (computed(function=rests.gained, takes=CURVE, method="positions at both ends of the cycle", output=False, needs=CURVE), "g", "1",
    "Drift of the motion per cycle, relative to its range", "this method")
recommended(compared, "Law of motion with the lowest peak acceleration of the driven link", LAW, None)
recommended(compared, "Law that loads the link least in a single rise; this motion, of several parts, may need another", CURVE,
        m.one_way >= 0.999)
