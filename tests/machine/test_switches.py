"""A curve that jumps where no breakpoint is declared is refused, with the formula, the condition and the place."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.api import POINTS, Annotated, Chapter, Check, Inputs, Mechanism, Quantity, bind, case, formula
from diecut_report.machine.calculation import Calculation, Unproven
from diecut_report.machine.steps.run import calculate

DEGREE = np.pi / 180


class Wheel(Inputs):
    moment: Annotated[float, Quantity("M", "N*m", "Moment")] = 81
    start: Annotated[float, Quantity("φ_1", "deg", "Start")] = 100
    end: Annotated[float, Quantity("φ_2", "deg", "End")] = 102
    n_points: Annotated[int, POINTS] = 36


@formula(printed_as="w")
def window(angle: Any, start: Any, end: Any) -> Any:
    return np.where((angle > start) & (angle < end), 3, 1)


FORMULAS: dict[str, Any] = {
    "a narrow window": lambda angle, moment, start, end: moment * np.where((angle > start) & (angle < end), 3, 1),
    "a window in a formula that prints by its name": lambda angle, moment, start, end: moment * window(angle, start, end),
    "a window by its distance": lambda angle, moment, start, end: moment * np.where(abs(angle - start) < (end - start) / 50, 3, 1),
    "a step": lambda angle, moment, start: moment * (2 + np.sign(angle - start)),
    "a staircase": lambda angle, moment, start: moment * (1 + np.floor(angle / start)),
    "a condition on a curve": lambda lift, moment: moment * np.where(lift > 0.9999, 3, 1),
}  # fmt: skip
NARROW: dict[str, Any] = {  # each holds within about 1e-8 rad of the start, the end standing for that width
    "a bell": lambda angle, moment, start, end: moment * np.where(np.exp(-(((angle - start) / end) ** 2)) > 0.5, 3, 1),
    "a resonance": lambda angle, moment, start, end: moment * np.where(1 / (1 + ((angle - start) / end) ** 2) > 0.5, 3, 1),
    "a pole": lambda angle, moment, start, end: moment * np.where(end**2 / (angle - start) ** 2 > 1, 3, 1),
    "a power": lambda angle, moment, start, end: moment * np.where(np.cos(angle - start) ** (1 / end**2) > 0.5, 3, 1),
    "two steps": lambda angle, moment, start, end: moment * np.where(np.tanh((angle - start) / end) > 0.5 + np.tanh((angle - start) / end - 1), 3, 1),
    "what is left of a width": lambda angle, moment, start, end: moment * np.where(np.maximum(0, end - abs(angle - start)) > 0, 3, 1),
    "a distance up to a limit": lambda angle, moment, start, end: moment * np.where(np.minimum(abs(angle - start), 0.001) < end, 3, 1),
    "a curve in a bell": lambda lift, moment, start, end: moment * np.where(np.exp(-(((lift - start / 9) / end) ** 2)) > 0.5, 3, 1),
}  # fmt: skip
CONTINUOUS: dict[str, Any] = {
    "the greater": lambda angle, moment, start: moment * np.maximum(angle, start),
    "two branches that meet": lambda angle, moment, start: moment * np.where(angle < start, start, angle),
    "a condition on numbers": lambda angle, moment, start, end: np.where(start < end, moment, 0) * np.sin(angle),
    "a bell that stays below": lambda angle, moment, start: (
        moment * np.where(np.exp(-(((angle - start) / 1e-8) ** 2)) > 2, 3, 1)
    ),
    "a condition that never changes": lambda angle, moment: moment * np.where(angle < 7, 1, 3),
}


def wheel(
    torque: Any, *places: str, per_piece: bool = False, checks: tuple[Check, ...] = (), last: Any = None
) -> Mechanism:
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    chapter.breakpoints("edges", "angle", *places)
    chapter.value("lift", "h", "1", "Lift", lambda angle: np.cos(angle - 1))
    chapter.value("inner", "T_i", "N*m", "Inner torque", torque, per_piece=per_piece)
    chapter.value("torque", "T", "N*m", "Torque", last or bind(lambda inner: inner))
    if not checks:
        chapter.reduction("peak", "T_max", "N*m", "Maximum torque", "max", "torque")
    return Mechanism(kind="wheel", version="1", title="", summary="", inputs=Wheel, chapters=(chapter,), checks=checks)


def run(mechanism: Mechanism, variants: int = 1, **given: Any) -> Calculation:
    values = {"moment": 81.0, "start": 100 * DEGREE, "end": 102 * DEGREE, "n_points": 36, **given}
    return calculate(mechanism, values, variants)


@pytest.mark.parametrize("name", FORMULAS)
def test_a_jump_without_a_breakpoint_is_refused(name: str) -> None:
    with pytest.raises(Unproven) as caught:
        run(wheel(FORMULAS[name]))
    words = str(caught.value)
    assert (
        words.startswith("Torque (torque, test_switches.py:")
        and "declare that place among the breakpoints of angle" in words
    )
    assert "changes in the formula inner of inner (test_switches.py:" in words


@pytest.mark.parametrize("name", NARROW)
def test_a_window_that_the_condition_shows_at_its_place_alone_is_refused(name: str) -> None:
    narrow = {"start": 117.3 * DEGREE, "end": 1e-8}
    with pytest.raises(Unproven, match="jumps inside a smooth piece, at φ = "):
        run(wheel(NARROW[name]), **narrow)
    many = {key: np.full(9, value) for key, value in narrow.items()}
    assert set(run(wheel(NARROW[name]), 9, **many).flaws) == set(range(9))


def test_the_place_and_the_condition_are_told() -> None:
    with pytest.raises(Unproven, match=r"jumps inside a smooth piece, at φ = 100°, where φ > φ_1 changes"):
        run(wheel(FORMULAS["a narrow window"]))


def test_with_its_places_declared_it_is_calculated() -> None:
    calc = run(wheel(FORMULAS["a narrow window"], "start", "end"))
    assert calc["peak"][0, 0] == 3 * 81


@pytest.mark.parametrize("name", CONTINUOUS)
def test_what_does_not_jump_is_calculated(name: str) -> None:
    assert np.isfinite(run(wheel(CONTINUOUS[name]))["peak"]).all()


def test_a_flag_that_changes_within_its_piece_is_refused() -> None:
    flag = FORMULAS["a narrow window"]
    with pytest.raises(Unproven, match="at φ = 100°, where φ > φ_1 changes"):
        run(wheel(flag, per_piece=True))
    assert run(wheel(flag, "start", "end", per_piece=True))["peak"][0, 0] == 3 * 81


def test_a_varying_value_taken_at_the_middle_of_the_piece_is_refused() -> None:
    with pytest.raises(
        Unproven, match=r"takes a flag of its smooth pieces \(per_piece\) that is not constant within one"
    ):
        run(wheel(lambda angle, moment: moment * np.sin(angle), per_piece=True))


def test_a_jump_of_which_nothing_is_left_is_no_fault() -> None:
    calc = run(wheel(FORMULAS["a narrow window"], last=lambda inner, moment, angle: np.sin(angle) * moment + 0 * inner))
    assert calc["peak"][0, 0] == pytest.approx(81)


def test_a_choice_and_a_check_on_a_curve_are_searched_too() -> None:
    check = Check(
        id="weak", title="", demand="torque", limit=100.0, unit="N*m", demand_label="", limit_label="", consequence=""
    )
    with pytest.raises(Unproven, match="jumps inside a smooth piece"):
        run(wheel(FORMULAS["a narrow window"], checks=(check,)))
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    chapter.choice("torque", "T", "N*m", "Torque", case(lambda moment: 3 * moment, "within", lambda angle, start: angle < start),
                   case(lambda moment: moment, "beyond"))  # fmt: skip
    chapter.reduction("mean", "T_m", "N*m", "Mean torque", "mean", "torque")
    of_choice = Mechanism(kind="wheel", version="1", title="", summary="", inputs=Wheel, chapters=(chapter,))
    with pytest.raises(Unproven, match="at φ = 100°, where φ < φ_1 changes in its formula"):
        run(of_choice)


def test_each_variant_that_jumps_is_marked() -> None:
    mechanism = wheel(FORMULAS["a narrow window"], "start", "end")
    starts = np.array([10.0, 20, 30, 40, 50, 60, 70, 80, 90]) * DEGREE
    assert not run(mechanism, 9, start=starts).flaws
    open_one = wheel(FORMULAS["a narrow window"])
    assert set(run(open_one, 9, start=starts).flaws) == set(range(9))


@pytest.mark.parametrize("count", [2, 7, pytest.param(100, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("per_piece", [False, True])
def test_each_variant_among_many_is_judged_as_alone(count: int, per_piece: bool) -> None:
    """Its edges fit the first machine, so that this one does not jump; each other one is judged by itself."""
    rng = np.random.default_rng(count)
    edges = rng.uniform(10, 350, (2, count)) * DEGREE
    starts = np.where(rng.random(count) < 0.5, edges[0], rng.uniform(10, 350, count) * DEGREE)
    starts[:2] = edges[0, 0], edges[0, 1] + 20 * DEGREE
    step: Any = lambda angle, moment: moment * np.where(angle > moment, 3, 1)  # noqa: E731  the moment stands for an angle
    mechanism = wheel(step, "start", "end", per_piece=per_piece)
    given = {"start": edges[0], "end": edges[1], "moment": starts}
    told = {}
    for row in range(count):
        try:
            run(mechanism, **{name: float(values[row]) for name, values in given.items()})
        except Unproven as fault:
            told[row] = "peak", str(fault)
    assert 0 not in told and 1 in told
    assert run(mechanism, count, **given).flaws == told


def by_middle(*places: str) -> Mechanism:
    """A torque that a condition on the middle of its piece decides, which varies from piece to piece."""
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    chapter.breakpoints("edges", "angle", *places)
    chapter.value("middle", "φ_m", "deg", "Middle", lambda angle: angle, per_piece=True)
    chapter.value("torque", "T", "N*m", "Torque", lambda middle, start, moment: moment * np.where(middle < start, 1, 3))
    chapter.reduction("peak", "T_max", "N*m", "Maximum torque", "max", "torque")
    return Mechanism(kind="wheel", version="1", title="", summary="", inputs=Wheel, chapters=(chapter,))


@pytest.mark.parametrize("count", [1, 9])
def test_what_a_varying_flag_decides_is_searched_and_not_the_flag(count: int) -> None:
    starts = np.linspace(10, 90, count) * DEGREE
    calc = run(by_middle("start"), count, start=starts)
    assert not calc.flaws
    assert calc["peak"][:, 0].tolist() == [3 * 81] * count
    if count == 1:
        with pytest.raises(Unproven, match="takes a flag of its smooth pieces"):
            run(by_middle("end"))
    else:
        assert set(run(by_middle("end"), count, start=starts).flaws) == set(range(count))


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9])
@pytest.mark.parametrize("before", [False, True])
def test_a_window_between_a_breakpoint_and_the_next_point_of_the_grid_is_found(share: float, before: bool) -> None:
    """One of its ends is declared, the other is not; the condition is curved, so that it is nothing at both."""
    first = (1 - np.cos(np.pi / 64)) / 2 * (100 if before else 260) * DEGREE
    end = 100 * DEGREE + share * first * (-1 if before else 1)
    bent: Any = lambda angle, moment, start, end: moment * np.where((angle - start) * (angle - end) < 0, 3, 1)  # noqa: E731
    with pytest.raises(Unproven, match="jumps inside a smooth piece"):
        run(wheel(bent, "start"), end=end)
    many = run(wheel(bent, "start"), 9, end=np.full(9, end), start=np.full(9, 100 * DEGREE))
    assert set(many.flaws) == set(range(9))


@pytest.mark.parametrize("start", [0.02, 0.05])
def test_a_window_between_the_end_of_a_piece_and_the_next_point_of_the_grid_is_refused(start: float) -> None:
    def near(angle: Any, moment: Any, start: Any) -> Any:
        return moment * np.where(abs(angle - start) < start / 20, 3, 1)

    with pytest.raises(Unproven, match=r"jumps inside a smooth piece, at φ = 0\.0"):
        run(wheel(near), start=start * DEGREE)
