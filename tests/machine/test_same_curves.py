"""A curve of a mechanism that is calculated twice: the same where all that it follows from is, to the last bit."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.machine.calculation import Calculation, CurveHandle, same_curve
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.circular_knife import MECHANISM as KNIFE
from tests.machine.swing import MECHANISM
from tests.machines import inputs
from tests.validation.rows_circular_knife import KEYS as CIRCULAR

LINK = {"inertia": 2.0, "stiffness": 100.0, "duration": 2.0, "ripple": 1.0, "share": 0.0, "n_points": 48, "grade": "plain"}  # fmt: skip
OWN = {"position", "level", "turned", "passed", "middle", "speed", "acceleration", "area", "way", "force"}
DRIVEN = {"position", "grown", "stretched", "speed", "acceleration", "area", "way", "force"}


def turned(**other: Any) -> Calculation:
    """A link by its own law."""
    return calculate(MECHANISM, LINK | {"lift": 0.5} | other)


def follower(other: Calculation, **more: Any) -> Calculation:
    """A link that moves by the position of another one."""
    return calculate(MECHANISM, LINK | {"motion": CurveHandle(other, "position")} | more)


def unlike(one: Calculation, other: Calculation) -> set[str]:
    """Which curves are not the same in both."""
    return {name for name in one.curves if not same_curve(CurveHandle(one, name), CurveHandle(other, name))}


@pytest.mark.parametrize(
    ("changed", "others"),
    [
        ({}, set()),
        ({"inertia": 2.5}, set()),
        ({"stiffness": 110.0}, {"force"}),
        ({"lift": 0.6}, OWN - {"passed", "middle"}),
        ({"lift": float.fromhex("0x1.0000000000001p-1")}, OWN - {"passed", "middle"}),
        ({"duration": 2.5}, OWN),
        ({"ripple": 0.9}, OWN),
        ({"n_points": 50}, OWN),
    ],
)
def test_only_what_follows_from_a_change_is_another_curve(changed: dict[str, Any], others: set[str]) -> None:
    start = turned()
    assert start.curves.keys() == OWN
    assert unlike(start, turned(**changed)) == others


def test_a_curve_that_is_taken_over_is_the_same_where_its_origin_is() -> None:
    start = follower(turned())
    assert start.curves.keys() == DRIVEN
    assert unlike(start, follower(turned(inertia=3.0))) == set()
    assert unlike(start, follower(turned(lift=0.6))) == DRIVEN
    assert unlike(start, follower(turned(), share=0.25)) == DRIVEN  # the pieces are others, too
    assert not same_curve(CurveHandle(start, "position"), CurveHandle(start, "grown"))


def test_a_curve_that_is_run_through_at_another_speed_is_another() -> None:
    """The torque of a circular knife does not depend on its speed; how often it comes again does."""
    one, same, faster = (calculate(KNIFE, inputs(KNIFE, CIRCULAR | {"speed": speed})) for speed in (50, 50, 60))
    assert same_curve(CurveHandle(one, "torque"), CurveHandle(same, "torque"))
    assert not same_curve(CurveHandle(one, "torque"), CurveHandle(faster, "torque"))
    assert CurveHandle(faster, "torque").rate == pytest.approx(2 * np.pi)
