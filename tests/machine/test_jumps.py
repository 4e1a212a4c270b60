"""A curve that jumps or has a pole where no breakpoint is declared is refused with the place; what is only steep, bent or rounded is not."""

from __future__ import annotations

import re
import tracemalloc
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Chapter,
    Check,
    Inputs,
    Mechanism,
    Quantity,
    abscissa,
    as_number,
    case,
    choice,
    derivative,
    formula,
    inner,
    m,
    pi,
    reduction,
    samples,
    value,
)
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.machine.calculation import Calculation, Unproven
from diecut_report.machine.numerics.conditions import conditions_of
from diecut_report.machine.numerics.domain import SAME, Domain
from diecut_report.machine.numerics.samples import JUMP
from diecut_report.machine.steps.run import calculate
from diecut_report.results.mechanism import curves
from tests.configs import ON_ARRAYS
from tests.machine.test_engine import EXAMPLES_AT_HAND, axes, machines, stem


def jumps(calc: Calculation, axis: str) -> frozenset[str]:
    known = tuple(calc.curves.items())
    return frozenset(
        name for name in calc.curves if calc.axis[name] == axis and conditions_of(known, axis, name).may_jump
    )


@pytest.mark.parametrize("path", EXAMPLES_AT_HAND, ids=stem)
def test_what_does_not_jump_is_the_same_at_the_end_and_just_inside(path: Any) -> None:
    for calc in machines(load_config(path, Discovery([])), {}, 5).values():
        for axis, names in axes(calc):
            pieces = calc.table(axis).pieces()
            row = np.array([i for i, variant in enumerate(pieces.variant) if variant not in calc.flaws])
            ends = np.stack([pieces.left[row], pieces.right[row]], axis=1)
            places = np.concatenate([pieces.inside(ends, row), pieces.grid(row)], axis=1)
            with np.errstate(all="ignore"):
                known = calc.sampler_of(axis, places, pieces.middle[row][:, None], pieces.variant[row])
                for name in set(names) - jumps(calc, axis):
                    values = np.broadcast_to(known[name], places.shape).astype(float)
                    apart = np.abs(values[:, :2] - values[:, [2, -1]])
                    assert (apart <= JUMP * np.abs(values).max()).all(), name


def test_the_drive_jumps_only_where_the_direction_of_power_decides() -> None:
    base = load_config(next(path for path in ON_ARRAYS if path.stem == "flat_cylinder_mechanisms"), Discovery([]))
    calc = machines(base, {}, 6)["drive"]
    assert jumps(calc, "crank_angle") == {
        "rocker_torque", "crank_torque", "coupler_force", "rocker_bearing_force", "crank_bearing_force_x", "crank_bearing_force_y",
    }  # fmt: skip


DEGREE = np.pi / 180


class Wheel(Inputs):
    moment = Quantity("M", "N*m", "Moment", default=81)
    start = Quantity("φ_1", "deg", "Start", default=100)
    end = Quantity("φ_2", "deg", "End", default=102)
    n_points = samples(36)


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
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.breakpoints("edges", "angle", *places)
    chapter.lift = np.cos(m.angle - 1), "h", "1", "Lift"
    chapter.inner = value(torque, per_piece=per_piece), "T_i", "N*m", "Inner torque"
    chapter.torque = last or m.inner, "T", "N*m", "Torque"
    if not checks:
        chapter.peak = reduction("max", "torque"), "T_max", "N*m", "Maximum torque"
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
        words.startswith("Torque (torque, test_jumps.py:")
        and "declare that place among the breakpoints of angle" in words
    )
    assert "changes in the formula inner of inner (test_jumps.py:" in words


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
    check = Check("weak", "strength", "", m.torque, 100.0, consequence="")
    with pytest.raises(Unproven, match="jumps inside a smooth piece"):
        run(wheel(FORMULAS["a narrow window"], checks=(check,)))
    chapter = Chapter("Turn")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.torque = choice(case(3 * m.moment, "within", m.angle < m.start), case(m.moment, "beyond")), "T", "N*m", "Torque"  # fmt: skip
    chapter.mean = reduction("mean", "torque"), "T_m", "N*m", "Mean torque"
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
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.breakpoints("edges", "angle", *places)
    chapter.middle = value(m.angle, per_piece=True), "φ_m", "deg", "Middle"
    chapter.torque = m.moment * np.where(m.middle < m.start, 1, 3), "T", "N*m", "Torque"
    chapter.peak = reduction("max", "torque"), "T_max", "N*m", "Maximum torque"
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


def cut(places: np.ndarray, period: float = 2.0) -> Domain:
    """A domain for each row of places."""
    found = Domain(np.full((len(places), 1), period), np.arange(3.0))
    found.cut(places)
    return found


def test_a_place_is_a_joint_where_any_joint_is_as_near_as_rounding() -> None:
    draw = np.random.default_rng(5)
    domain = cut(draw.uniform(0, 2, (4, 30)))
    near = domain.joints + draw.choice([0, 0.4, -0.4, 3, -3], domain.joints.shape) * SAME * 2
    places = np.concatenate([near, draw.uniform(-1, 3, (4, 20)), np.full((4, 1), np.nan)], axis=1)
    expected = [
        [any(abs(place - joint) <= SAME * 2 for joint in row) for place in own]
        for row, own in zip(domain.joints, places, strict=True)
    ]
    assert domain.is_joint(places).tolist() == expected
    assert 0 < np.sum(expected) < np.size(expected)


def test_ten_thousand_places_among_ten_thousand_joints_take_little_memory() -> None:
    domain = cut(np.linspace(0, 2, 10_000, endpoint=False)[None, :])
    tracemalloc.start()
    found = domain.is_joint(domain.joints)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert found.all() and peak < 5e6  # comparing each with each takes 800 MB


class Arm(Inputs):
    arm = Quantity("a", "mm", "Arm", gt=0)
    place = Quantity("φ_p", "deg", "Place", gt=0)
    n_points = samples(36)


ROUGH: dict[str, tuple[str, Any]] = {
    "an angle that wraps": ("deg", lambda angle, place: np.arctan2(np.sin(angle - place), -np.cos(angle - place))),
    "an angle of a tangent": ("deg", lambda angle, place: np.arctan(1 / np.tan(angle - place))),
    "a simple pole": ("mm", lambda arm, angle, place: arm / as_number(angle - place)),
    "a pole of one sign": ("mm", lambda arm, angle, place: arm / np.abs(as_number(angle - place))),
    "a double pole": ("mm", lambda arm, angle, place: arm / np.sin((angle - place) / 2) ** 2),
    "a tangent": ("mm", lambda arm, angle, place: arm * np.tan((angle - place) / 2 + pi / 2)),
    "a logarithm": ("mm", lambda arm, angle, place: -arm * np.log(np.abs(np.sin((angle - place) / 2)))),
    "a logarithm beside much": (
        "mm",
        lambda arm, angle, place: 10 * arm * np.cos(angle) + arm * np.log(np.abs(np.sin((angle - place) / 2))),
    ),
    "a slow pole": ("mm", lambda arm, angle, place: arm / np.abs(as_number(angle - place)) ** 0.1),
}
SMOOTH: dict[str, tuple[str, Any]] = {
    "steep": ("mm", lambda arm, angle, place: arm * np.tanh(1e4 * as_number(angle - place))),
    "narrow": ("mm", lambda arm, angle, place: arm / (1e-6 + as_number(angle - place) ** 2)),
    "a narrow step": ("mm", lambda arm, angle, place: arm * np.arctan(1e6 * as_number(angle - place))),
    "a narrow turn": ("mm", lambda arm, angle, place: arm / np.sqrt(1e-10 + as_number(angle - place) ** 2) ** 0.1),
    "a corner": ("mm", lambda arm, angle, place: arm * np.abs(as_number(angle - place))),
    "upright": ("mm", lambda arm, angle, place: arm * np.sqrt(np.abs(as_number(angle - place)))),
    "nearly upright": ("mm", lambda arm, angle, place: arm * np.abs(as_number(angle - place)) ** 0.1),
    "a logarithm with an end": ("mm", lambda arm, angle, place: arm * np.log(1e-10 + as_number(angle - place) ** 2)),
    "rounding": ("mm", lambda arm, angle: (arm * np.sin(angle) + 1000 * arm) - 1000 * arm - arm * np.sin(angle)),
    "a share of rounding": ("1", lambda arm, angle: (arm + arm * np.cos(angle) ** 2 - 2 * arm + arm * np.sin(angle) ** 2) / arm),
    "a number": ("mm", lambda arm, angle: arm + 0 * as_number(angle)),
    "nothing": ("mm", lambda arm, angle: 0 * arm * as_number(angle)),
}  # fmt: skip


def calculated(unit: str, formula: Any, place: float, *, breakpoint: bool = False) -> Calculation:
    chapter = Chapter("Turn")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    if breakpoint:
        chapter.breakpoints("there", "angle", "place")
    chapter.rough = formula, "R", unit, "Rough"
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    return calculate(mechanism, {"arm": 0.05, "place": place, "n_points": 36})


@pytest.mark.parametrize("name", ROUGH)
@pytest.mark.parametrize("place", [2.0, np.pi, 0.1, 6.2])
def test_a_rough_place_is_refused_with_its_place(name: str, place: float) -> None:
    with pytest.raises(Unproven) as caught:
        curves(calculated(*ROUGH[name], place))
    told = str(caught.value)
    assert re.match(
        r"Rough \(rough, test_jumps.py:\d+\) (jumps inside a|jumps or has a pole inside a|has a pole at)", told
    )
    found = float(told.partition("φ = ")[2].partition("°")[0])
    assert np.tan(np.radians(found)) == pytest.approx(
        np.tan(place), abs=0.01
    )  # half a turn farther on the tangent is the same
    assert ("declare that place among the breakpoints of angle" in told) == ("has a pole at" not in told)
    assert "require what keeps away from it" in told


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("place", [2.0, np.pi, 0.1, 6.2])
def test_what_is_whole_passes(name: str, place: float) -> None:
    curves(calculated(*SMOOTH[name], place))


def test_a_pole_of_what_is_not_printed_is_refused_where_its_extreme_is_asked() -> None:
    chapter = Chapter("Turn")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.rough = inner(ROUGH["a pole of one sign"][1]), "R", "mm", "Rough"
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    given = {"arm": 0.05, "place": 2.0, "n_points": 36}
    curves(calculate(mechanism, given))  # it may be masked by what takes it
    chapter.most = reduction("max", of="rough"), "R_m", "mm", "Most"
    asked = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    with pytest.raises(Unproven, match="pole"):
        curves(calculate(asked, given))


ENDLESS: dict[str, tuple[str, Any]] = {
    "a tangent whose pole is a place of the grid": ("max", lambda arm, angle: -arm * np.tan(angle)),
    "a secant on its high side": ("min", lambda arm, angle, place: arm / np.cos(angle - place)),
    "a pole of a hundredth": ("abs_max", lambda arm, angle, place: arm * (1 + 0.01 / np.cos(angle - place))),
    "a pole of a ten-thousandth": ("max", lambda arm, angle, place: arm * (np.sin(angle) + 1e-4 / np.cos(angle - place))),
    "a pole that touches": ("max", lambda arm, angle, place: arm * (1 + 0.001 / (1 - np.cos(angle - place)))),
    "a logarithm": ("max", lambda arm, angle, place: -arm * np.log(np.abs(np.sin((angle - place) / 2)))),
    "a slow pole": ("max", lambda arm, angle, place: arm / np.abs(as_number(angle - place)) ** 0.1),
    "an eighth root": ("max", lambda arm, angle, place: arm / np.abs(np.sin((angle - place) / 2)) ** (1 / 8)),
    "a power that is given": ("max", lambda arm, angle, place: arm * np.abs(np.sin((angle - place) / 2)) ** (-arm / arm)),
    "the end of the turn": ("max", lambda arm, angle: arm / np.cos(angle / 4)),
    "both ends": ("max", lambda arm, angle: arm * np.tan((angle - pi) / 2)),
    "a power": ("max", lambda arm, angle, place: arm * np.cos(angle - place) ** -2),
}  # fmt: skip
WHOLE: dict[str, tuple[str, Any]] = {
    "a hole that is filled": ("max", lambda arm, angle, place: arm * np.sin(2 * (angle - place)) / np.sin(angle - place)),
    "a double hole": ("max", lambda arm, angle, place: arm * (1 - np.cos(angle - place)) / np.tan((angle - place) / 2) ** 2),
    "a wrap that the sine undoes": ("max", lambda arm, angle, place: arm * np.sin(np.arctan2(np.sin(angle - place), -np.cos(angle - place)))),
    "an upright turn": ("max", lambda arm, angle, place: arm * as_number(angle - place) / np.abs(as_number(angle - place)) ** 0.9),
    "a logarithm that is drowned": ("max", lambda arm, angle, place: arm * np.sin((angle - place) / 2) * np.log(np.abs(np.sin((angle - place) / 2)))),
    "a turn beside the end": (
        "max",
        lambda arm, angle: arm * (7 + 30 * as_number(angle - 0.00345) ** 2 + 0 * as_number(np.arctan2(np.sin(angle), 2 + np.cos(angle)))),
    ),
    "a narrow peak": ("max", lambda arm, angle, place: arm / (1e-10 + as_number(angle - place) ** 2)),
    "near a pole": ("max", lambda arm, angle, place: arm / (1.0001 - np.cos(angle - place))),
}  # fmt: skip


def reduced(operation: str, formula: Any, places: list[float], *, breakpoint: bool = False) -> Calculation:
    chapter = Chapter("Turn")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    if breakpoint:
        chapter.breakpoints("there", "angle", "place")
    chapter.rough = formula, "R", "mm", "Rough"
    chapter.most = reduction(operation, of="rough"), "R_m", "mm", "Most"
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    given = {"arm": 0.05, "place": np.array(places) if len(places) > 1 else places[0], "n_points": 36}
    return calculate(mechanism, given, len(places))


PLACES = [1e-5, 0.3, 0.7853981633974483, 1.0, 2.2, np.pi, 4.014, 5.9]


@pytest.mark.parametrize("name", ENDLESS)
def test_an_extreme_of_what_has_a_pole_is_refused_of_one_machine_and_of_many(name: str) -> None:
    for place in PLACES:
        with pytest.raises(Unproven, match=r"has a pole at φ = |near φ = .*pole"):
            reduced(*ENDLESS[name], [place])
    assert sorted(reduced(*ENDLESS[name], PLACES).flaws) == list(range(len(PLACES)))


@pytest.mark.parametrize("name", WHOLE)
def test_what_is_divided_by_nothing_and_stays_finite_passes(name: str) -> None:
    assert not reduced(*WHOLE[name], PLACES).flaws
    for place in PLACES:
        assert np.isfinite(reduced(*WHOLE[name], [place])["most"]).all()


@pytest.mark.parametrize("place", PLACES)
def test_a_breakpoint_at_a_pole_is_no_remedy(place: float) -> None:
    for name in ("a simple pole", "a pole of one sign", "a slow pole"):
        with pytest.raises(Unproven, match=r"has a pole at φ = .*; require what keeps away from it"):
            reduced("max", ROUGH[name][1], [place], breakpoint=True)


def test_of_many_machines_those_whose_curve_has_no_value_somewhere_are_in_error() -> None:
    """The root of what is negative where the crank is longer than the rod."""
    push = lambda arm, angle, place: arm * np.sqrt(1 - (place / pi * np.sin(angle)) ** 2)  # noqa: E731
    made = reduced("max", push, [1.0, 4.0, 3.0])
    assert list(made.flaws) == [1] and "has no value at some of its places" in made.flaws[1][1]
    with pytest.raises(Unproven, match="has no value at some of its places"):
        curves(reduced("max", push, [4.0]))


def test_what_is_not_proved_tells_where_the_curve_bends() -> None:
    chapter = Chapter("Turn")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.rough = SMOOTH["a corner"][1], "R", "mm", "Rough"
    chapter.slope = derivative(of="rough"), "R′", "mm", "Slope"
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    with pytest.raises(
        Unproven,
        match=r"Slope: the proof leaves .*; Rough \(rough, .*\) bends most near φ = 114\.6°: if it has a corner",
    ):
        calculate(mechanism, {"arm": 0.05, "place": 2.0, "n_points": 36})


def test_an_angle_that_wraps_at_a_breakpoint_passes() -> None:
    curves(calculated(*ROUGH["an angle that wraps"], 2.0, breakpoint=True))
