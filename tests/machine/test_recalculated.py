"""A machine calculated again with another input, and curves taken at the same places: only what follows from the change is made anew."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle, Impossible, Unproven, same_curve
from diecut_report.machine.numerics.domain import RecentPlaces, SharedPlaces
from diecut_report.machine.steps.needed import needed_again
from diecut_report.machine.steps.run import calculate, recalculated
from diecut_report.mechanism.inputs import Quantity
from diecut_report.plugins.circular_knife import MECHANISM as KNIFE
from tests.examples import few
from tests.machine.swing import MECHANISM
from tests.machine.test_jumps import FORMULAS, run, wheel
from tests.machines import UNBALANCED, drive, inputs
from tests.plugins.bearings import BALL, ROLLER, bearings
from tests.plugins.gears import GRADED, pair
from tests.plugins.keys import TURNING, key
from tests.plugins.shafts import LAYSHAFT, shaft
from tests.validation.rows_circular_knife import KEYS as CIRCULAR

MACHINES: dict[str, Callable[[], Calculation]] = {
    "gears": lambda: pair(GRADED),
    "key": lambda: key(TURNING),
    "drive": lambda: drive(**UNBALANCED, pinion_inertia=0.03, rocker_inertia=1.2, pinion_radius=0.07, n_points=72),
    "shaft": lambda: shaft(LAYSHAFT),
    "bearings": lambda: bearings(BALL, ROLLER, required_life=20000, service_factor=1.2),
    "one bearing": lambda: bearings(BALL, required_life=20000, service_factor=1.2),
}  # fmt: skip


@pytest.mark.parametrize("which", few(MACHINES, lambda which: which != "drive"))
def test_each_number_that_a_check_compares_is_that_of_the_whole_calculation(which: str) -> None:
    calc = MACHINES[which]()
    names = [name for check in calc.mechanism.checks for name in check.named if name in calc.values]
    tried = 0
    for name, value in calc.inputs.items():
        meta = calc.meta.get(name)
        if (
            not isinstance(meta, Quantity)
            or not isinstance(value, np.ndarray)
            or value.shape != (1, 1)
            or not value.any()
        ):
            continue
        changed = {name: np.array([value[0, 0] * 1.03])}
        again = recalculated(calc, changed, 1, names)
        inputs = {each: own[0, 0] if isinstance(own, np.ndarray) and own.shape == (1, 1) else own for each, own in calc.inputs.items()
                  if each in calc.given}  # fmt: skip
        try:
            whole = calculate(calc.mechanism, inputs | changed)
        except (Impossible, Unproven):
            assert again is None
            continue
        assert again is not None
        for quantity in names:
            assert again[quantity] == pytest.approx(whole[quantity], rel=1e-12, abs=1e-15, nan_ok=True), (
                name,
                quantity,
            )
        tried += 1
    assert tried


def test_what_does_not_follow_from_an_input_stays() -> None:
    calc = pair(GRADED)
    numbers = frozenset(name for name, value in calc.values.items() if value.shape == (1, 1) and value.dtype != object)
    only, stays = needed_again(calc.mechanism, calc.given, ("pitting_safety_1",), frozenset({"sigma_h_lim_1"}), numbers)
    assert {"contact_ratio", "working_pressure_angle", "mesh_stiffness", "dynamic_factor"} <= stays
    assert {"run_in_share_1", "face_load_factor", "pitting_safety_1"} <= only and not stays & {
        "face_load_factor",
        "pitting_safety_1",
    }
    assert "working_pressure_angle" not in only


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


HERE, THERE = np.linspace(0, 1, 12).reshape(3, 4), np.linspace(0, 2, 12).reshape(3, 4)


class Asked:
    """Curves that tell what they were asked for."""

    def __init__(self, most: int = 10_000) -> None:
        self.shared, self.calls = SharedPlaces(most), list[list[str]]()

    def at(self, name: str, places: Array, axis: str = "angle") -> Array:
        def evaluate(names: Sequence[str]) -> list[Array]:
            self.calls.append(list(names))
            return [places * (2 + "abc".index(each)) for each in names]

        return self.shared.at(name, axis, (places, places[:, :1], None), evaluate)


def test_what_is_known_at_places_is_not_evaluated_again() -> None:
    asked = Asked()
    for _ in range(2):
        assert np.array_equal(asked.at("b", HERE.copy()), 3 * HERE)
    assert np.array_equal(asked.at("b", THERE), 3 * THERE)
    assert np.array_equal(asked.at("b", THERE, "way"), 3 * THERE)
    assert asked.calls == [["b"]] * 3


def test_what_was_asked_together_before_is_evaluated_together() -> None:
    asked = Asked()
    for places in (HERE, THERE):
        for name in "acb":
            assert np.array_equal(asked.at(name, places), places * (2 + "abc".index(name)))
    assert asked.calls == [["a"], ["c"], ["b"], ["a", "c", "b"]]
    asked.at("c", HERE + 1)
    assert asked.calls[-1] == ["c"]


def test_no_more_is_kept_than_it_may() -> None:
    asked = Asked(2 * HERE.nbytes)
    for places in (HERE, THERE, HERE + 1, HERE):
        asked.at("a", places)
    assert len(asked.calls) == 4
    asked.at("a", HERE + 1)
    assert len(asked.calls) == 4


def test_what_others_read_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="read-only"):
        Asked().at("a", HERE)[0] = 1.0


X = np.linspace(0, 1, 5)[None, :]
MOST = 3


def test_what_is_known_at_places_is_made_once_and_only_for_these_places() -> None:
    recent, made = RecentPlaces[int](MOST), list[int]()

    def make() -> int:
        made.append(len(made))
        return made[-1]

    assert [recent.at("angle", (X, X, None), make), recent.at("angle", (X.copy(), X, None), make)] == [0, 0]
    assert recent.at("time", (X, X, None), make) == 1
    assert recent.at("angle", (X + 1, X, None), make) == 2
    assert recent.at("angle", (X, X + 1, None), make) == 3
    assert recent.at("angle", (X.T, X.T, None), make) == 4
    assert recent.at("angle", (X.T, X.T, np.array([0])), make) == 5


def test_no_more_places_are_kept_than_the_last_ones() -> None:
    recent = RecentPlaces[float](MOST)
    for first in range(MOST + 1):
        recent.at("angle", (X + first, X), lambda first=first: first)  # type: ignore[misc]
    assert recent.at("angle", (X + MOST, X), lambda: -1.0) == MOST
    assert recent.at("angle", (X, X), lambda: -1.0) == -1


def test_a_curve_taken_over_is_that_of_its_own_piece_and_of_no_other_curve() -> None:
    calc = run(wheel(FORMULAS["a narrow window"], "start", "end"))
    lift, torque = (CurveHandle(calc, name) for name in ("lift", "torque"))
    share, edge = np.array([[0.1, 0.25]]), np.full((1, 2), 100 / 360)
    for _ in range(2):
        assert np.allclose(lift.values(share, share, None), np.cos(share * 2 * np.pi - 1))
        assert np.allclose(torque.values(share, share, None), 81)
    before, within = (torque.values(edge, edge + step / 360, None)[0, 0] for step in (-1, 1))
    assert (before, within) == (81, 81), "at the very edge the condition does not hold"
    inside = edge + 0.5 / 360
    assert torque.values(inside, inside, None)[0, 0] == 3 * 81
