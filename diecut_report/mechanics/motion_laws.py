"""Laws of motion between two rests: a unit rise over a unit time, with its velocity, acceleration and jerk.

A law's formulas take k, the share of the rise's time that has passed, in [0, 1]; a rise h in a time t has the velocity
velocity(k)·h/t, the acceleration acceleration(k)·h/t² and the jerk jerk(k)·h/t³. The jerk is given without its impulses
where the acceleration jumps. ``LAWS`` is the one registry: a plugin adds its own laws by ``register``, and all that is
chosen by a law's name (inputs, formulas, comparisons) knows them from then on. Sources: the invariants of 003 [6];
modified laws as in the usual tables for cams (VDI 2143).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np

from diecut_report.expressions import Formula, as_number, formula
from diecut_report.mechanics import modified_laws as modified
from diecut_report.mechanics import polynomial_laws as polynomial

ROUNDING = 1e-9  # by which a law may miss its ends


@formula
def smooth(k: Any) -> Any:
    """Above zero everywhere: the law is one formula from end to end."""
    return 1 + k


@formula
def cycloidal_position(k: Any) -> Any:
    """Position: straight line less one sine wave."""
    return k - np.sin(2 * np.pi * k) / as_number(2 * np.pi)


@formula
def cycloidal_velocity(k: Any) -> Any:
    """Velocity."""
    return 1 - np.cos(2 * np.pi * k)


@formula
def cycloidal_acceleration(k: Any) -> Any:
    """Acceleration: one sine wave."""
    return as_number(2 * np.pi) * np.sin(2 * np.pi * k)


@formula
def cycloidal_jerk(k: Any) -> Any:
    """Jerk."""
    return as_number(4 * np.pi**2) * np.cos(2 * np.pi * k)


@formula
def cycloidal_peak_velocity() -> Any:
    """Peak velocity, in the middle."""
    return 2


@formula
def cycloidal_peak_acceleration() -> Any:
    """Peak acceleration, at a quarter."""
    return as_number(2 * np.pi)


@formula
def harmonic_position(k: Any) -> Any:
    """Position: half a cosine wave."""
    return (1 - np.cos(np.pi * k)) / 2


@formula
def harmonic_velocity(k: Any) -> Any:
    """Velocity."""
    return as_number(np.pi / 2) * np.sin(np.pi * k)


@formula
def harmonic_acceleration(k: Any) -> Any:
    """Acceleration: half a cosine wave, which jumps at both ends."""
    return as_number(np.pi**2 / 2) * np.cos(np.pi * k)


@formula
def harmonic_jerk(k: Any) -> Any:
    """Jerk, without its impulses at both ends."""
    return as_number(-(np.pi**3) / 2) * np.sin(np.pi * k)


@formula
def harmonic_peak_velocity() -> Any:
    """Peak velocity, in the middle."""
    return as_number(np.pi / 2)


@formula
def harmonic_peak_acceleration() -> Any:
    """Peak acceleration, at both ends."""
    return as_number(np.pi**2 / 2)


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


class Registry(Mapping[str, MotionLaw]):
    """The known laws by their names, in the order in which they were registered."""

    def __init__(self) -> None:
        self._laws: dict[str, MotionLaw] = {}

    def __getitem__(self, name: str) -> MotionLaw:
        return self._laws[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._laws)

    def __len__(self) -> int:
        return len(self._laws)

    def add(self, law: MotionLaw) -> MotionLaw:
        """Add a law; ValueError where its name is taken or it is not a unit rise."""
        fault = _fault(law) or (f"the name {law.name} is taken" if law.name in self._laws else "")
        if fault:
            raise ValueError(f"motion law {law.name}: {fault}")
        self._laws[law.name] = law
        return law


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
    """One part of each known law by the law's name: a live view of the registry."""

    def __init__(self, laws: Registry, part: Callable[[MotionLaw], T]) -> None:
        self._laws, self._part = laws, part

    def __getitem__(self, name: str) -> T:
        return self._part(self._laws[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._laws)

    def __len__(self) -> int:
        return len(self._laws)


LAWS = Registry()
POSITION = PartOf(LAWS, lambda law: law.position)
VELOCITY = PartOf(LAWS, lambda law: law.velocity)
ACCELERATION = PartOf(LAWS, lambda law: law.acceleration)
JERK = PartOf(LAWS, lambda law: law.jerk)
PEAK_VELOCITY = PartOf(LAWS, lambda law: law.peak_velocity)
PEAK_ACCELERATION = PartOf(LAWS, lambda law: law.peak_acceleration)
JOINT = PartOf(LAWS, lambda law: law.joint)
MIDDLE_POSITION = PartOf(LAWS, lambda law: float(law.position(0.5)))
MIDDLE_VELOCITY = PartOf(LAWS, lambda law: float(law.velocity(0.5)))


def register(law: MotionLaw) -> MotionLaw:
    """Add a law to ``LAWS``; ValueError where its name is taken or it is not a unit rise."""
    return LAWS.add(law)


register(MotionLaw(
    name="cycloidal", title="Cycloidal (sinusoidal acceleration)", position=cycloidal_position, velocity=cycloidal_velocity,
    acceleration=cycloidal_acceleration, jerk=cycloidal_jerk, peak_velocity=cycloidal_peak_velocity,
    peak_acceleration=cycloidal_peak_acceleration,
))  # fmt: skip
register(MotionLaw(
    name="harmonic", title="Harmonic (cosine acceleration)", position=harmonic_position, velocity=harmonic_velocity,
    acceleration=harmonic_acceleration, jerk=harmonic_jerk, peak_velocity=harmonic_peak_velocity,
    peak_acceleration=harmonic_peak_acceleration,
))  # fmt: skip
register(MotionLaw(
    name="parabolic", title="Parabolic (constant acceleration)", position=polynomial.parabolic_position,
    velocity=polynomial.parabolic_velocity, acceleration=polynomial.parabolic_acceleration, jerk=polynomial.parabolic_jerk,
    peak_velocity=polynomial.parabolic_peak_velocity, peak_acceleration=polynomial.parabolic_peak_acceleration,
    breakpoints=(1 / 2,), joint=polynomial.parabolic_joint,
))  # fmt: skip
register(MotionLaw(
    name="modified_trapezoidal", title="Modified trapezoidal acceleration", position=modified.trapezoidal_position,
    velocity=modified.trapezoidal_velocity, acceleration=modified.trapezoidal_acceleration, jerk=modified.trapezoidal_jerk,
    peak_velocity=modified.trapezoidal_peak_velocity, peak_acceleration=modified.trapezoidal_peak_acceleration,
    breakpoints=(1 / 8, 3 / 8, 5 / 8, 7 / 8), joint=modified.trapezoidal_joint,
))  # fmt: skip
register(MotionLaw(
    name="modified_sine", title="Modified sine acceleration", position=modified.sine_position, velocity=modified.sine_velocity,
    acceleration=modified.sine_acceleration, jerk=modified.sine_jerk, peak_velocity=modified.sine_peak_velocity,
    peak_acceleration=modified.sine_peak_acceleration, breakpoints=(1 / 8, 7 / 8), joint=modified.sine_joint,
))  # fmt: skip
register(MotionLaw(
    name="polynomial_345", title="Polynomial 3-4-5", position=polynomial.fifth_position, velocity=polynomial.fifth_velocity,
    acceleration=polynomial.fifth_acceleration, jerk=polynomial.fifth_jerk, peak_velocity=polynomial.fifth_peak_velocity,
    peak_acceleration=polynomial.fifth_peak_acceleration,
))  # fmt: skip
register(MotionLaw(
    name="polynomial_4567", title="Polynomial 4-5-6-7", position=polynomial.seventh_position, velocity=polynomial.seventh_velocity,
    acceleration=polynomial.seventh_acceleration, jerk=polynomial.seventh_jerk, peak_velocity=polynomial.seventh_peak_velocity,
    peak_acceleration=polynomial.seventh_peak_acceleration,
))  # fmt: skip
