"""Links of the made-up kind swing, and their motion in closed form."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from diecut_report.machine.calculation import Calculation, CurveHandle
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.chapters import in_form
from diecut_report.mechanism.inputs import flatten
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import MechanismRecord
from tests.machine.swing import MECHANISM, Swing

TURN = 2 * np.pi / 3
CLOSED: dict[str, Callable[[Any, float], Any]] = {  # of the share of the time and the time itself, for a lift of 1
    "position": lambda k, T: np.where(k < 1 / 4, 64 * k**3, np.cos(TURN * (k - 1 / 4))),
    "speed": lambda k, T: np.where(k < 1 / 4, 192 * k**2, -TURN * np.sin(TURN * (k - 1 / 4))) / T,
    "acceleration": lambda k, T: np.where(k < 1 / 4, 384 * k, -(TURN**2) * np.cos(TURN * (k - 1 / 4))) / T**2,
    "area": lambda k, T: T * np.where(k < 1 / 4, 16 * k**4, 1 / 16 + np.sin(TURN * (k - 1 / 4)) / TURN),
    "way": lambda k, T: CLOSED["position"](k, T),
}
VARIANTS = {"lift": [1.5, 0.2, 2.0], "duration": [2.0, 0.5, 3.0], "ripple": [0.3, 1.0, 0.75]}


def swing(**keys: Any) -> Calculation:
    """A link with these keys, as a config gives them."""
    given = {"inertia": 1.0} | keys
    return calculate(MECHANISM, flatten(in_form(Swing, given).model_validate(given)))


def made(**keys: Any) -> Calculation:
    """A link with a law of its own, its lift 1 rad."""
    return swing(**{"lift": "1 rad"} | keys)


def follower(source: Calculation, curve: str = "position", **keys: Any) -> Calculation:
    """A link that follows a curve of another one."""
    return swing(motion=CurveHandle(source, curve), **keys)


def results(calc: Calculation) -> MechanismRecord:
    return mechanism_results(calc, {})


def values(calc: Calculation, curve: str) -> Any:
    return np.array(results(calc).curves[curve].values)


def several(**keys: Any) -> Calculation:
    """Three links at once."""
    numbers = {name: np.array(row) for name, row in VARIANTS.items()} | keys
    common = {"inertia": 1.0, "stiffness": 100.0, "share": 0.0, "grade": "plain", "n_points": 48}
    return calculate(MECHANISM, common | numbers, 3)


def single(index: int) -> Calculation:
    return swing(n_points=48, **{name: row[index] if name != "lift" else f"{row[index]} rad" for name, row in VARIANTS.items()})  # fmt: skip


def grown(passed: Any) -> Any:
    """The curve that gains 2 in each period, over shares that go on."""
    return CLOSED["position"](passed % 1, 1) + 2 * passed
