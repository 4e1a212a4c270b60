"""Self-tests: two ways to numbers, rows and curves agree but for rounding, or the mechanism is in error."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    CURVE_ROUNDING,
    ROUNDING,
    Block,
    Chapter,
    Inputs,
    Mechanism,
    Quantity,
    abscissa,
    derivative,
    m,
    parts,
    reduction,
    samples,
    self_test,
)
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation, Unproven
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.mechanism import without_checks
from diecut_report.results.checks import check_results


class Spring(Block):
    force = Quantity("F_i", "N", "Force")
    travel = Quantity("s_i", "mm", "Travel", ge=0)


class Springs(Inputs):
    springs = parts(Spring, "Springs")
    stiffness = Quantity("c", "N/mm", "Stiffness", gt=0, default=2)
    work = Quantity("W", "J", "Work", default=0)
    heat = Quantity("Q", "J", "Heat", default=0)
    swing = Quantity("s", "mm", "Swing", gt=0, default=30)
    off = Quantity("δ", "1", "By how much a curve is off", default=0)
    n_points = samples(36)


one = Chapter("Numbers")
one.work_error = self_test(m.work, m.heat), "e_W", "1", "Work against heat", "energy"
many = Chapter("Rows")
many.force_error = (
    self_test(m.springs.force, m.stiffness * m.springs.travel, check="springs", title="Law of the springs", consequence="weigh {part}."),
    "e_F", "1", "Force against stiffness",
)  # fmt: skip
turn = Chapter("Curves")
turn.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
turn.place = m.swing * np.sin(m.angle), "x", "mm", "Place"
turn.arm = m.swing * np.cos(m.angle) * (1 + m.off), "x′", "mm", "Way for each radian"
turn.arm_taken = derivative(of="place"), "x′_d", "mm", "Derivative of the place"
turn.arm_max = reduction("abs_max", of="arm_taken"), "x′_max", "mm", "Greatest way for each radian"
turn.arm_error = (
    self_test(m.arm, m.arm_taken, scale=m.arm_max, within=CURVE_ROUNDING),
    "e_x",
    "1",
    "Way against its derivative",
)
MECHANISM = Mechanism(
    kind="springs", version="1", title="Springs", summary="Springs.", inputs=Springs, chapters=(one, many, turn)
)
SOUND = ((4.0, 2.0), (6.0, 3.0))


def run(springs: tuple[tuple[float, float], ...] = SOUND, **given: Any) -> Calculation:
    return calculate(MECHANISM, flatten(Springs(springs=[{"force": f, "travel": s} for f, s in springs], **given)))


def status(calc: Calculation) -> dict[str, str]:
    return {check.id: check.status for check in check_results(calc)}


PASS = {"work_error": "pass", "springs": "pass", "arm_error": "pass"}


def test_two_ways_that_agree_pass() -> None:
    check_mechanism(MECHANISM)
    assert status(run(work=3, heat=3 * (1 + 1e-15))) == PASS


@pytest.mark.parametrize(
    ("given", "failing"),
    [
        ({"work": 3.0, "heat": 3 * (1 + 1.1 * ROUNDING)}, "work_error"),
        ({"work": 3.0, "heat": -3.0}, "work_error"),
        ({"work": 1e-6}, "work_error"),  # of nothing all is greater than rounding
        ({"springs": ((4.0, 2.0), (6.0, 3.00001))}, "springs"),
        ({"springs": ((0.0, 1e-3), (6.0, 3.0))}, "springs"),
        ({"off": 2 * CURVE_ROUNDING}, "arm_error"),
        ({"off": -2 * CURVE_ROUNDING}, "arm_error"),
    ],
)
def test_what_does_not_agree_fails(given: dict[str, Any], failing: str) -> None:
    assert status(run(**given)) == PASS | {failing: "fail"}


def test_the_worst_part_and_the_worst_place_govern() -> None:
    found = {check.id: check for check in check_results(run(((4.0, 2.0), (6.0, 4.0)), off=0.1))}
    assert found["springs"].part == 2 and found["springs"].demand == pytest.approx(0.25)
    assert "Relative difference 0.25, accepted 1e-9 at part 2 of 2: weigh 2." in found["springs"].message
    assert found["arm_error"].demand == pytest.approx(0.1)
    assert found["arm_error"].at.text in ("0", "180", "360")


def test_a_difference_at_its_limit_is_rounding() -> None:
    assert status(run(work=1.0, heat=1 - ROUNDING * (1 - 1e-6)))["work_error"] == "pass"


def test_nothing_is_apart_from_nothing_and_so_it_is_printed() -> None:
    calc = run(((0.0, 0.0), (6.0, 3.0)))
    assert status(calc) == PASS
    assert calc["work_error"][0, 0] == 0 and calc["force_error"][0].tolist() == [0, 0]
    chapters = {chapter["title"]: chapter["items"] for chapter in section_items(calc)}
    assert chapters["Numbers"][0]["result"]["text"] == chapters["Rows"][0]["result"]["text"] == "0"
    assert run(((0.0, 0.0), (6.0, 3.0)), work=2)["work_error"][0, 0] == 1


def test_both_sides_are_printed_with_numbers() -> None:
    [item] = section_items(run(work=3, heat=2))[0]["items"]
    assert item["result"]["text"] == "0.3333" and "3" in str(item["substituted"]) and "2" in str(item["substituted"])


@pytest.mark.parametrize("given", [{"work": np.nan}, {"springs": ((np.nan, 2.0),)}, {"off": np.nan}], ids=str)
def test_what_is_no_number_never_passes(given: dict[str, Any]) -> None:
    values = flatten(Springs(springs=[{"force": 4, "travel": 2}]))
    springs = given.pop("springs", ())
    values |= given | ({"springs.force": (np.nan,)} if springs else {})
    with pytest.raises(Unproven) as refused:
        status(calculate(MECHANISM, values))
    assert "has no value" in str(refused.value) or "proof leaves nan" in str(refused.value)


def test_among_many_machines_each_is_judged() -> None:
    values = flatten(Springs(springs=[{"force": 4, "travel": 2}]))
    many = calculate(MECHANISM, values | {"work": np.array([0.0, 1.0, 2.0]), "heat": np.array([0.0, 1.0, 1.0])}, 3)
    assert many["work_error"][:, 0].tolist() == [0, 0, 0.5]


def test_a_self_test_is_one_of_the_checks_and_has_their_form() -> None:
    assert [check.id for check in MECHANISM.checks] == ["work_error", "springs", "arm_error"]
    work = MECHANISM.checks[0]
    assert (work.check_class, work.title, work.demand, work.limit) == (
        "numerical",
        "Work against heat",
        "work_error",
        1e-9,
    )
    assert (work.unit, work.source, work.demand_label, work.limit_label) == (
        "1",
        "energy",
        "relative difference",
        "accepted",
    )
    assert [check.id for check in replace(MECHANISM, title="Other").checks] == ["work_error", "springs", "arm_error"]
    assert [check.id for check in without_checks(MECHANISM, frozenset({"springs"})).checks] == [
        "work_error",
        "arm_error",
    ]


def test_a_scale_that_is_nothing_is_told() -> None:
    apart = Chapter("Numbers")
    apart.work_error = self_test(m.work, 0, scale=m.heat), "e_W", "1", "Work that is left"
    mechanism = replace(MECHANISM, chapters=(apart,))
    values = flatten(Springs(springs=[{"force": 4, "travel": 2}]))
    assert status(calculate(mechanism, values)) == {"work_error": "pass"}
    assert status(calculate(mechanism, values | {"work": 1e-9, "heat": 2.0})) == {"work_error": "pass"}
    with pytest.raises(Unproven, match="has no value"):
        calculate(mechanism, values | {"work": 1.0})


def test_what_a_self_test_cannot_be_is_told() -> None:
    wrong = Chapter("Wrong")
    wrong.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    wrong.place = m.swing * np.sin(m.angle), "x", "mm", "Place"
    wrong.same = self_test(m.work + m.heat, m.heat + m.work), "e_1", "1", "Same"
    wrong.nothing = self_test(m.work, 0), "e_2", "1", "Nothing"
    wrong.curve = self_test(m.place, m.swing), "e_3", "1", "Curve"
    wrong.length = self_test(m.work, m.heat), "e_4", "mm", "Length"
    told = "\n".join(map(str, faults(replace(MECHANISM, chapters=(wrong,)))))
    assert "check same: compares same with 1e-09, neither of which depends on an input" in told
    assert "step nothing: compares with 0, to which no difference is relative; give scale=" in told
    assert "step curve: compares curves, which may pass zero; give scale=" in told
    assert 'step length: gives a relative difference, but is in mm; write "1"' in told
