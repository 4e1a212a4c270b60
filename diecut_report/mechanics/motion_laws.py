"""Laws of motion between two rests: a unit rise over a unit time, with its velocity, acceleration and jerk.

A law's formulas take k, the share of the rise's time that has passed, in [0, 1]; a rise h in a time t has the velocity
velocity(k)·h/t, the acceleration acceleration(k)·h/t² and the jerk jerk(k)·h/t³. The jerk is given without its impulses
where the acceleration jumps. ``LAWS`` holds them all: a plugin adds its own laws by ``register``, and all that is
chosen by a law's name (inputs, formulas, comparisons) knows them from then on. Sources: the invariants of 003 [6];
modified laws as in the usual tables for cams (VDI 2143).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np

from diecut_report.formulas.expression import as_number, number, pi
from diecut_report.formulas.formula import Formula, formula

# The modified laws join sine waves and straight lines.


@formula
def quick_wave(k: Any) -> Any:
    """Position that a sine wave of the acceleration, four half waves over the rise, gives from rest."""
    return k - np.sin(4 * pi * k) / as_number(4 * pi)


@formula
def quick_rate(k: Any) -> Any:
    """Velocity of the same wave."""
    return 1 - np.cos(4 * pi * k)


@formula
def slow_angle(k: Any) -> Any:
    """Phase of the modified sine's slow wave."""
    return pi / 3 + 4 * pi * k / 3


def sine_position(k: Any) -> Any:
    """Position of the modified sine."""
    plain_pi = as_number(pi)
    factor = plain_pi / (4 + plain_pi)
    middle = factor * (2 / plain_pi + k - 9 / (4 * plain_pi) * np.sin(slow_angle(k)))
    end = factor * (4 / plain_pi + quick_wave(k))
    return np.where(k < number(1) / 8, factor * quick_wave(k), np.where(k <= number(7) / 8, middle, end))


def sine_velocity(k: Any) -> Any:
    """Velocity of the modified sine."""
    plain_pi = as_number(pi)
    factor = plain_pi / (4 + plain_pi)
    middle = factor * (1 - 3 * np.cos(slow_angle(k)))
    return np.where((k < number(1) / 8) | (k > number(7) / 8), factor * quick_rate(k), middle)


def sine_acceleration(k: Any) -> Any:
    """Acceleration of the modified sine: a quick quarter wave, a slow half wave, a quick quarter wave."""
    plain_pi = as_number(pi)
    peak = 4 * plain_pi**2 / (4 + plain_pi)
    return np.where((k < number(1) / 8) | (k > number(7) / 8), peak * np.sin(4 * pi * k), peak * np.sin(slow_angle(k)))


def sine_jerk(k: Any) -> Any:
    """Jerk of the modified sine."""
    plain_pi = as_number(pi)
    peak = 16 * plain_pi**3 / (4 + plain_pi)
    return np.where(
        (k < number(1) / 8) | (k > number(7) / 8), peak * np.cos(4 * pi * k), peak / 3 * np.cos(slow_angle(k))
    )


def trapezoidal_position(k: Any) -> Any:
    """Position of the modified trapezoidal law."""
    plain_pi = as_number(pi)
    factor = 2 / (2 + plain_pi)
    rising = factor * (k - 1 / (4 * plain_pi) + 2 * plain_pi * (k - number(1) / 8) ** 2)
    middle = number(1) / 2 + factor * ((1 + plain_pi) * (k - number(1) / 2) + np.sin(4 * pi * k) / (4 * plain_pi))
    falling = 1 - factor * (1 - k - 1 / (4 * plain_pi) + 2 * plain_pi * (number(7) / 8 - k) ** 2)
    later = np.where(k <= number(7) / 8, falling, 1 - factor * quick_wave(1 - k))
    half = np.where(k <= number(5) / 8, middle, later)
    return np.where(k < number(1) / 8, factor * quick_wave(k), np.where(k < number(3) / 8, rising, half))


def trapezoidal_velocity(k: Any) -> Any:
    """Velocity of the modified trapezoidal law."""
    plain_pi = as_number(pi)
    factor = 2 / (2 + plain_pi)
    rising = factor * (1 + 4 * plain_pi * (k - number(1) / 8))
    middle = factor * (1 + plain_pi + np.cos(4 * pi * k))
    falling = factor * (1 + 4 * plain_pi * (number(7) / 8 - k))
    inside = np.where(k < number(3) / 8, rising, np.where(k <= number(5) / 8, middle, falling))
    return np.where((k < number(1) / 8) | (k > number(7) / 8), factor * quick_rate(k), inside)


def trapezoidal_acceleration(k: Any) -> Any:
    """Acceleration of the modified trapezoidal law: quarter waves between stretches of constant acceleration."""
    plain_pi = as_number(pi)
    peak = 8 * plain_pi / (2 + plain_pi)
    middle = np.where(k <= number(5) / 8, -peak * np.sin(4 * pi * k), -peak)
    inside = np.where(k < number(3) / 8, peak, middle)
    return np.where((k < number(1) / 8) | (k > number(7) / 8), peak * np.sin(4 * pi * k), inside)


def trapezoidal_jerk(k: Any) -> Any:
    """Jerk of the modified trapezoidal law."""
    plain_pi = as_number(pi)
    peak = 32 * plain_pi**2 / (2 + plain_pi)
    middle = np.where((k < number(3) / 8) | (k > number(5) / 8), 0, -peak * np.cos(4 * pi * k))
    return np.where((k < number(1) / 8) | (k > number(7) / 8), peak * np.cos(4 * pi * k), middle)


ROUNDING = 1e-9  # by which a law may miss its ends


@formula
def smooth(k: Any) -> Any:
    """Above zero everywhere: the law is one formula from end to end."""
    return 1 + k


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionLaw:
    """A law of motion: a unit rise over a unit time.

    ``peak_velocity`` and ``peak_acceleration`` are formulas without parameters (B and A give their values);
    ``breakpoints`` are the places in (0, 1) where the formulas change, and ``joint`` is a formula of k that changes its sign
    there and nowhere else.
    """

    name: str
    title: str
    position: Formula
    velocity: Formula
    acceleration: Formula
    jerk: Formula
    peak_velocity: Formula
    peak_acceleration: Formula
    breakpoints: tuple[float, ...] = ()
    joint: Formula = smooth

    @property
    def B(self) -> float:  # noqa: N802 - the letter that the sources use
        """Peak velocity."""
        return float(self.peak_velocity())

    @property
    def A(self) -> float:  # noqa: N802 - the letter that the sources use
        """Peak acceleration."""
        return float(self.peak_acceleration())


def _fault(law: MotionLaw) -> str:
    """What keeps a law from being a unit rise with the joints that it declares; empty where nothing does."""
    curves = (law.position, law.velocity, law.acceleration, law.jerk, law.joint)
    if any(curve.parameters != ("k",) for curve in curves):
        return "position, velocity, acceleration, jerk and joint are formulas of k alone"
    if law.peak_velocity.parameters or law.peak_acceleration.parameters:
        return "the peaks are formulas without parameters"
    edges = (0.0, *law.breakpoints, 1.0)
    if any(right <= left for left, right in pairwise(edges)):
        return "the breakpoints lie between 0 and 1 in ascending order"
    if abs(law.position(0.0)) > ROUNDING or abs(law.position(1.0) - 1) > ROUNDING:
        return "the position goes from 0 at k = 0 to 1 at k = 1"
    signs = [float(np.sign(law.joint((left + right) / 2))) for left, right in pairwise(edges)]
    turns = all(one * other < 0 for one, other in pairwise(signs))
    if not turns or any(abs(law.joint(place)) > ROUNDING for place in law.breakpoints):
        return "joint changes its sign at each breakpoint"
    return ""


T = TypeVar("T")


class PartOf(Mapping[str, T]):
    """One part of each known law by the law's name: a live view of ``LAWS``."""

    def __init__(self, part: Callable[[MotionLaw], T]) -> None:
        self._part = part

    def __getitem__(self, name: str) -> T:
        return self._part(LAWS[name])

    def __iter__(self) -> Iterator[str]:
        return iter(LAWS)

    def __len__(self) -> int:
        return len(LAWS)


LAWS: dict[str, MotionLaw] = {}
"""The known laws by their names, in the order in which they were registered."""

POSITION = PartOf(lambda law: law.position)
VELOCITY = PartOf(lambda law: law.velocity)
ACCELERATION = PartOf(lambda law: law.acceleration)
JERK = PartOf(lambda law: law.jerk)
PEAK_VELOCITY = PartOf(lambda law: law.peak_velocity)
PEAK_ACCELERATION = PartOf(lambda law: law.peak_acceleration)
JOINT = PartOf(lambda law: law.joint)
MIDDLE_POSITION = PartOf(lambda law: float(law.position(0.5)))
MIDDLE_VELOCITY = PartOf(lambda law: float(law.velocity(0.5)))


def register(law: MotionLaw) -> MotionLaw:
    """Add a law to ``LAWS``; ValueError where its name is taken or it is not a unit rise."""
    fault = _fault(law) or (f"the name {law.name} is taken" if law.name in LAWS else "")
    if fault:
        raise ValueError(f"motion law {law.name}: {fault}")
    return LAWS.setdefault(law.name, law)


def _add(name: str, title: str, *breakpoints: float, **curves: Callable[..., Any]) -> None:
    parts = {part: formula(curve) for part, curve in curves.items()}
    register(MotionLaw(name=name, title=title, breakpoints=breakpoints, **parts))


# fmt: off

_add("cycloidal", "Cycloidal (sinusoidal acceleration)",
    position=lambda k: k - np.sin(2 * pi * k) / as_number(2 * pi), velocity=lambda k: 1 - np.cos(2 * pi * k),
    acceleration=lambda k: as_number(2 * pi) * np.sin(2 * pi * k), jerk=lambda k: as_number(4 * pi**2) * np.cos(2 * pi * k),
    peak_velocity=lambda: 2, peak_acceleration=lambda: as_number(2 * pi))
_add("harmonic", "Harmonic (cosine acceleration)",
    position=lambda k: (1 - np.cos(pi * k)) / 2, velocity=lambda k: as_number(pi / 2) * np.sin(pi * k),
    acceleration=lambda k: as_number(pi**2 / 2) * np.cos(pi * k), jerk=lambda k: as_number(-(pi**3) / 2) * np.sin(pi * k),
    peak_velocity=lambda: as_number(pi / 2), peak_acceleration=lambda: as_number(pi**2 / 2))
_add("parabolic", "Parabolic (constant acceleration)", 1 / 2,
    position=lambda k: np.where(k < number(1) / 2, 2 * k**2, 1 - 2 * (1 - k) ** 2), velocity=lambda k: np.where(k < number(1) / 2, 4 * k,
    4 * (1 - k)),
    acceleration=lambda k: np.where(k < number(1) / 2, 4, -4), jerk=lambda k: 0 * k,
    peak_velocity=lambda: 2, peak_acceleration=lambda: 4, joint=lambda k: k - number(1) / 2)
_add("modified_trapezoidal", "Modified trapezoidal acceleration", 1 / 8, 3 / 8, 5 / 8, 7 / 8,
    position=trapezoidal_position, velocity=trapezoidal_velocity, acceleration=trapezoidal_acceleration, jerk=trapezoidal_jerk,
    peak_velocity=lambda: 2, peak_acceleration=lambda: 8 * as_number(pi) / (2 + as_number(pi)),
    joint=lambda k: (k - number(1) / 8) * (k - number(3) / 8) * (k - number(5) / 8) * (k - number(7) / 8))
_add("modified_sine", "Modified sine acceleration", 1 / 8, 7 / 8,
    position=sine_position, velocity=sine_velocity, acceleration=sine_acceleration, jerk=sine_jerk,
    peak_velocity=lambda: 4 * as_number(pi) / (4 + as_number(pi)),
    peak_acceleration=lambda: 4 * as_number(pi) ** 2 / (4 + as_number(pi)), joint=lambda k: (k - number(1) / 8) * (k - number(7) / 8))
_add("polynomial_345", "Polynomial 3-4-5",
    position=lambda k: 10 * k**3 - 15 * k**4 + 6 * k**5, velocity=lambda k: 30 * k**2 * (1 - k) ** 2,
    acceleration=lambda k: 60 * k * (1 - k) * (1 - 2 * k), jerk=lambda k: 60 * (1 - 6 * k + 6 * k**2),
    peak_velocity=lambda: number(15) / 8, peak_acceleration=lambda: 10 / np.sqrt(number(3)))
_add("polynomial_4567", "Polynomial 4-5-6-7",
    position=lambda k: 35 * k**4 - 84 * k**5 + 70 * k**6 - 20 * k**7, velocity=lambda k: 140 * k**3 * (1 - k) ** 3,
    acceleration=lambda k: 420 * k**2 * (1 - k) ** 2 * (1 - 2 * k), jerk=lambda k: 840 * k * (1 - k) * (1 - 5 * k + 5 * k**2),
    peak_velocity=lambda: number(35) / 16, peak_acceleration=lambda: 84 / (5 * np.sqrt(number(5))))
