"""Curves, rows and texts that plain code gives from a prepared object, for one machine and for many; inputs that vary."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Annotated,
    Chapter,
    Check,
    Constant,
    Extremes,
    Inputs,
    Mechanism,
    Quantity,
    Refusal,
    Varying,
)
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.names import Misdeclared
from diecut_report.results.checks import check_results


class Ramp(Inputs):
    """A force that jumps at a place of a bar, and two points that are judged."""

    force: Annotated[Any, Varying("F", "N", "Force", extremes=True, words=("none",))]
    jump: Annotated[float, Quantity("x_j", "m", "Place of the jump", gt=0, lt=10)] = 4
    allowed: Annotated[float, Quantity("[S]", "N", "Allowed force", gt=0)] = 5
    grade: Annotated[float, Quantity("g", "1", "Grade", listed=(1, 2.5))] = 1
    n_points: Annotated[int, Quantity("N", "1", "Samples", integer=True, ge=4)] = 8


class Bar:
    """What is made of the inputs, for all variants."""

    def __init__(self, given: dict[str, Any]) -> None:
        force = given["force"]
        if isinstance(force, Extremes):
            force = np.full_like(given["jump"], force.high)
        if isinstance(force, str):
            raise Refusal("force", "is none; a bar without a force is not judged")
        self.force, self.jump = np.broadcast_to(force, given["jump"].shape), given["jump"]

    def at(self, x: Any, middle: Any, rows: Any) -> Any:
        """The force, twice as great behind the jump."""
        own, jump = (each if rows is None else each[rows] for each in (self.force, self.jump))
        return own * np.where(middle > jump, 2, 1) + 0 * x


chapter = Chapter("Bar")
chapter.prepared("bar", Bar, ("force", "jump"), for_many=True)
chapter.abscissa("x", "x", "m", "Place", Constant(10.0, "l", "m"))
chapter.computed_curve(
    "along",
    "F(x)",
    "N",
    "Force along the bar",
    Bar.at,
    "bar",
    "x",
    "as it is laid out",
    joints=lambda bar: bar.jump,
)
chapter.value("twice", "2F", "N", "Twice the force", lambda along: 2 * along)
chapter.reduction("greatest", "F_max", "N", "Greatest force", "max", of="along")
chapter.reduction("mean", "F_m", "N", "Mean force", "mean", of="along")
chapter.part_names("points", "Points", lambda grade: ["left", "right"], ("grade",), shown_at="worst")
chapter.computed(
    "at_point",
    "F_p",
    "N",
    "Force there",
    lambda bar: bar.force * np.array([[1.0, 2.0]]),
    ("bar",),
    "by the bar",
    over="points",
)
chapter.value("doubled", "D_p", "N", "Twice the force there", lambda at_point, grade: 2 * at_point * grade)
chapter.computed(
    "worst",
    "i_w",
    "1",
    "Worst point",
    lambda row: np.argmax(row, axis=1)[:, None],
    ("doubled",),
    "the greatest",
    whole=True,
)
chapter.computed(
    "word",
    "w",
    "1",
    "Its name",
    lambda index: [f"point {int(i)}" for i in index[:, 0]],
    ("worst",),
    "the greatest",
    is_text=True,
)
chapter.part_table("table", "All points", "points", ("at_point", "doubled"))

MECHANISM = Mechanism(
    kind="ramp",
    version="1.0",
    title="Ramp",
    summary="A force along a bar.",
    inputs=Ramp,
    chapters=(chapter,),
    checks=(
        Check(
            id="force", check_class="strength", title="Force", demand="doubled", limit="allowed", unit="N", demand_label="force",
            limit_label="allowed", consequence="the {word} breaks.",
        ),
    ),
)  # fmt: skip


def ramp(**keys: Any) -> Calculation:
    """A bar."""
    return calculate(MECHANISM, flatten(Ramp.model_validate({"force": 3} | keys)))


def test_the_declaration_is_sound() -> None:
    check_mechanism(MECHANISM)


def test_a_curve_of_plain_code_jumps_where_its_joints_say() -> None:
    calculation = ramp()
    assert calculation["greatest"][0, 0] == 6
    assert calculation["mean"][0, 0] == pytest.approx((3 * 4 + 6 * 6) / 10)
    limits = [calculation.sample("twice", np.array([[4.0]]), np.array([[middle]]))[0, 0] for middle in (2, 7)]
    assert limits == [6, 12]


def test_many_machines_are_each_machine_alone() -> None:
    values = flatten(Ramp.model_validate({"force": 3}))
    jumps = np.linspace(1, 9, 20)
    together = calculate(MECHANISM, values | {"jump": jumps, "force": jumps + 1}, 20)
    for i, jump in enumerate(jumps):
        alone = ramp(jump=jump, force=jump + 1)
        for name in ("mean", "greatest", "at_point", "doubled"):
            assert together[name][i] == pytest.approx(alone[name][0], rel=1e-12)
        assert together["word"][i, 0] == alone["word"][0, 0] == "point 1"


def test_formulas_of_rows_are_shown_with_the_part_that_is_named_and_the_table_holds_all() -> None:
    (section,) = section_items(ramp())
    doubled = next(item for item in section["items"] if item.get("id") == "doubled")
    assert doubled["result"]["text"] == "12"
    assert doubled["note"] == "Shown for: right."
    table = next(item for item in section["items"] if item["type"] == "table")
    assert table["rows"] == [["left", "3", "6"], ["right", "6", "12"]]
    assert all(
        item.get("id") != "worst" for item in section["items"]
    )  # the index from 0, which says nothing to a reader


def test_a_check_over_named_parts_tells_the_name() -> None:
    (check,) = check_results(ramp())
    assert check.message.startswith("Force 12 N, allowed 5 N at right: the point 1 breaks")
    assert check.part_name == "right"


def test_extremes_and_words_come_as_such_and_refusals_are_told_at_their_key() -> None:
    assert ramp(force={"min": 1, "max": 7})["greatest"][0, 0] == 14
    with pytest.raises(Impossible) as refused:
        ramp(force="none")
    assert refused.value.key == "force"


@pytest.mark.parametrize(
    ("force", "words"),
    [
        ({"min": 2, "max": 1}, "exchange"),
        ({"max": 1}, "min and max"),
        ("some", "none"),
        ([1, 2], "a list"),
        (None, "no value"),
    ],
)
def test_what_may_not_be_given_is_told(force: Any, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Ramp.model_validate({"force": force})


@pytest.mark.parametrize("grade", [2, 1.7])
def test_a_number_that_is_not_listed_is_refused_with_the_list(grade: float) -> None:
    with pytest.raises(ValueError, match=r"allowed: 1, 2\.5"):
        Ramp.model_validate({"force": 1, "grade": grade})


def test_code_that_names_no_parts_is_told() -> None:
    other = Chapter("Other")
    other.part_names("points", "Points", lambda grade: [], ("grade",))
    faulty = Mechanism(kind="f", version="1", title="F", summary="F.", inputs=Ramp, chapters=(other,))
    with pytest.raises(Misdeclared, match="a list of texts"):
        calculate(faulty, flatten(Ramp.model_validate({"force": 1})))
