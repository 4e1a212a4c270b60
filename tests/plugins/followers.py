"""Elastic followers that the tests calculate, and the same link integrated by scipy from the sheets' accelerations alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.chapters import in_form
from diecut_report.mechanism.inputs import flatten
from diecut_report.plugins.elastic_follower import MECHANISM
from diecut_report.results.checks import applies, judged

SHAFT: dict[str, Any] = {
    "inertia": "0.8 kg*m**2",
    "stiffness": "5200 N*m/rad",
    "damping_ratio": 0.05,
    "rise": "1.2 rad",
    "rise_time": "0.2 s",
}


def follower(**changes: Any) -> Calculation:
    """The shaft with changes; a key with the value None is left out."""
    keys = {key: value for key, value in (SHAFT | changes).items() if value is not None}
    return calculate(MECHANISM, flatten(in_form(MECHANISM.inputs, keys).model_validate(keys)))


def driven(source: Calculation, curve: str, **changes: Any) -> Calculation:
    """The shaft driven by a curve of another machine, with changes."""
    return follower(**{"rise": None, "rise_time": None, "motion_curve": CurveHandle(source, curve)} | changes)


def verdicts(calc: Calculation) -> dict[str, str]:
    """The verdicts of a follower's checks by their id, without their messages, which take most of the time."""
    return {
        check.id: "pass" if bool(judged(calc, check).held.all()) else check.severity
        for check in calc.mechanism.checks
        if applies(calc, check)
    }


def at(calc: Calculation, curve: str, places: Any) -> Array:
    """A curve at any times; at a joint the piece that begins there."""
    times = np.atleast_1d(np.asarray(places, dtype=float))[None, :]
    domain = calc.domains["time"]
    middle = np.concatenate([domain.middle_of(part) for part in np.array_split(times, 20, axis=1)], axis=1)
    found: Array = calc.sample(curve, times, middle)[0]
    return found


# --- laws of motion: acceleration over k alone, from the text of their definitions -----------------------------------

Formula = Callable[[Array], Array]


def modified_sine(k: Array) -> Array:
    """Quarter waves of a quick sine at both ends, a slow one between them."""
    inner = np.sin(np.pi / 3 + 4 * np.pi * k / 3)
    return 4 * np.pi**2 / (4 + np.pi) * np.where((k < 1 / 8) | (k > 7 / 8), np.sin(4 * np.pi * k), inner)


def modified_trapezoidal(k: Array) -> Array:
    """Sine, constant, cosine, constant, sine."""
    parts = [
        np.sin(4 * np.pi * k),
        0 * k + 1,
        np.cos(4 * np.pi * (k - 3 / 8)),
        0 * k - 1,
        -np.cos(4 * np.pi * (k - 7 / 8)),
    ]
    return 8 * np.pi / (2 + np.pi) * np.select([k < 1 / 8, k < 3 / 8, k < 5 / 8, k < 7 / 8], parts[:4], parts[4])


class Law(NamedTuple):
    """Acceleration of a unit rise, its greatest value, greatest velocity, joints."""

    acceleration: Formula
    peak: float
    velocity: float
    joints: tuple[float, ...] = ()


LAWS = {
    "cycloidal": Law(lambda k: 2 * np.pi * np.sin(2 * np.pi * k), 2 * np.pi, 2),
    "harmonic": Law(lambda k: np.pi**2 / 2 * np.cos(np.pi * k), np.pi**2 / 2, np.pi / 2),
    "parabolic": Law(lambda k: np.where(k < 0.5, 4.0, -4.0), 4, 2, (0.5,)),
    "modified_trapezoidal": Law(modified_trapezoidal, 8 * np.pi / (2 + np.pi), 2, (1 / 8, 3 / 8, 5 / 8, 7 / 8)),
    "modified_sine": Law(modified_sine, 4 * np.pi**2 / (4 + np.pi), 4 * np.pi / (4 + np.pi), (1 / 8, 7 / 8)),
    "polynomial_345": Law(lambda k: 60 * k - 180 * k**2 + 120 * k**3, 10 / np.sqrt(3), 15 / 8),
    "polynomial_4567": Law(lambda k: 420 * k**2 * (1 - k) ** 2 * (1 - 2 * k), 84 / np.sqrt(125), 35 / 16),
}


# --- the link by scipy's integration ---------------------------------------------------------------------------------


class Stretch(NamedTuple):
    """A smooth stretch of the input's motion, in time, with its acceleration as a function of time."""

    start: float
    end: float
    acceleration: Formula


@dataclass(frozen=True)
class Part:
    """A stretch integrated: the cubic pieces of ẍ of the link, its place and ÿ at fine places."""

    time: Array
    states: Array  # y, ẏ, z, ż
    rigid: Array
    swing: CubicHermiteSpline

    @property
    def response(self) -> Array:
        """The link's place."""
        return np.asarray(self.states[0] + self.states[2])

    def peak(self) -> float:
        """The greatest |ẍ| of the link."""
        return float(np.abs(extremes(self.swing)).max())

    def reach(self) -> tuple[float, float]:
        """The lowest and the farthest place of the link."""
        speed = self.states[1] + self.states[3]
        places = extremes(CubicHermiteSpline(self.time, self.response, speed))
        return float(places.min()), float(places.max())


def extremes(curve: CubicHermiteSpline) -> Array:
    """Values of a curve at its ends and where it turns back."""
    still = curve.derivative().roots(extrapolate=False)
    places = np.concatenate([curve.x[[0, -1]], still[np.isfinite(still)]])
    return np.asarray(curve(places), float)


def law_stretches(name: str, rise: float, rise_time: float) -> list[Stretch]:
    """The rise of a law, broken at its joints."""
    law = LAWS[name]
    edges = np.array([0.0, *law.joints, 1.0]) * rise_time
    return [Stretch(a, b, lambda t: rise / rise_time**2 * law.acceleration(t / rise_time)) for a, b in pairwise(edges)]


def integrated(
    stretches: Sequence[Stretch], follow: float, omega: float, damping: float, fine: int = 800
) -> list[Part]:
    """The link from rest through all stretches and a rest after them: the last part is the rest.

    ẍ and its derivative are known at ``fine`` places a natural period: cubic pieces between them are out by (2π/fine)⁴/384.
    """
    end = stretches[-1].end
    rest = Stretch(end, end + follow, lambda t: np.zeros(np.shape(t)))
    state, parts = np.zeros(4), []
    for stretch in (*stretches, rest):
        part, state = _one(stretch, state, omega, damping, fine)
        parts.append(part)
    return parts


def _one(stretch: Stretch, start: Array, omega: float, damping: float, fine: int) -> tuple[Part, Array]:
    length = stretch.end - stretch.start
    time = np.linspace(stretch.start, stretch.end, 400 + int(fine * length * omega / (2 * np.pi)))
    inside = np.clip(time, stretch.start + 1e-12 * length, stretch.end - 1e-12 * length)  # not on a joint

    def rates(t: float, s: Array) -> list[float]:
        driving = float(stretch.acceleration(min(max(t, inside[0]), inside[-1])))  # type: ignore[arg-type]  # one place
        return [s[1], driving, s[3], -driving - 2 * damping * omega * s[3] - omega**2 * s[2]]

    size = np.abs(stretch.acceleration(inside)).max() * np.array([1, 1, omega**-2, omega**-1]) + 1e-30
    solved = solve_ivp(rates, (stretch.start, stretch.end), start, "DOP853", time, rtol=1e-12, atol=1e-14 * size,
                       max_step=min(0.15 / omega, length / 20))  # fmt: skip
    z, speed = solved.y[2:]
    rigid = np.asarray(stretch.acceleration(inside), float)
    swing = -2 * damping * omega * speed - omega**2 * z
    rate = -2 * damping * omega * (swing - rigid) - omega**2 * speed
    return Part(time, solved.y, rigid, CubicHermiteSpline(time, swing, rate)), solved.y[:, -1]


# --- the motions that transports give, from their own equations -------------------------------------------------------


class Gear(NamedTuple):
    """A cam-gear stepper: angles in degrees, cycles a second."""

    dwell: float
    dwell_sweep: float
    stop_sweep: float
    law: str
    rate: float


def gear_stretches(gear: Gear, unit: float = 1.0) -> tuple[float, list[Stretch]]:
    """How long the gear's motion lasts, and its acceleration in the phases III, IV and I from the end of the dwell.

    The gear turns as the disc less R₃/R₁ times the sector; ``unit`` is what one radian of the gear moves.
    """
    law, sweep, stop = LAWS[gear.law], np.radians(gear.dwell_sweep), np.radians(gear.stop_sweep)
    dwell = gear.dwell / 360
    both = law.velocity * stop / (sweep / dwell)  # time of the phases III and I, in turns
    back = 1 - dwell - both
    size = unit * np.radians(gear.dwell) / sweep * gear.rate**2
    phases = [  # start, k there, time of the whole law, what the sector rises in it
        (0.0, 0.5, both, stop), (both / 2, 0.0, back, -(sweep + stop)), (both / 2 + back, 0.0, both, stop),
    ]  # fmt: skip
    ends = (1.0, 1.0, 0.5)
    found = [part for phase, end in zip(phases, ends, strict=True) for part in _phase(law, phase, end, size, gear.rate)]
    return (1 - dwell) / gear.rate, found


def _phase(law: Law, phase: tuple[float, float, float, float], last: float, size: float, rate: float) -> list[Stretch]:
    start, first, whole, rise = phase
    edges = [first, *(k for k in law.joints if first < k < last), last]

    def acceleration(t: Array) -> Array:
        return -size * rise / whole**2 * law.acceleration((t * rate - start) / whole + first)

    times = [(start + (k - first) * whole) / rate for k in edges]
    return [Stretch(a, b, acceleration) for a, b in pairwise(times)]


def geneva_stretches(slots: int, rate: float, unit: float = 1.0) -> tuple[float, list[Stretch]]:
    """How long a Geneva wheel's motion lasts, and its acceleration from the roller's entry; ``rate`` in turns a second."""
    half = np.pi / 2 - np.pi / slots
    lever, speed = np.sin(np.pi / slots), 2 * np.pi * rate

    def acceleration(t: Array) -> Array:
        alpha = speed * t - half
        below = 1 - 2 * lever * np.cos(alpha) + lever**2
        return np.asarray(-unit * speed**2 * lever * (1 - lever**2) * np.sin(alpha) / below**2)

    return 2 * half / speed, [Stretch(0.0, 2 * half / speed, acceleration)]


def rigid_peak(stretches: Sequence[Stretch]) -> float:
    """The input's greatest |ÿ|: the best of many places, and of three successive refinements about it."""
    return max(_highest(stretch.acceleration, stretch.start, stretch.end) for stretch in stretches)


def _highest(acceleration: Formula, low: float, high: float) -> float:
    margin = 1e-12 * (high - low)  # not on a joint
    low, high = low + margin, high - margin
    for _ in range(4):
        places = np.linspace(low, high, 2001)
        sizes = np.abs(acceleration(places))
        best = int(np.argmax(sizes))
        low, high = places[max(best - 1, 0)], places[min(best + 1, 2000)]
    return float(sizes.max())
