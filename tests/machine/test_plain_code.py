"""What plain code gives back is a number for each machine, an index for each part, a curve, a row or a text; all else is told with its step."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Block,
    Chapter,
    Check,
    Constant,
    Extremes,
    Inputs,
    Mechanism,
    MechanismInput,
    Quantity,
    Refusal,
    Varying,
    abscissa,
    computed,
    computed_curve,
    m,
    parts,
    reduction,
)
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.mechanism import MechanismHandle
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.names import Misdeclared
from diecut_report.results.checks import check_results


class Peg(Block):
    place = Quantity("x_i", "mm", "Place")


class Row(Inputs):
    width = Quantity("b", "mm", "Width", gt=0)
    pegs = parts(Peg, "Pegs")


def calculated(number: Any = 1.0, clash: Any = None, machines: int = 1) -> Calculation:
    chapter = Chapter("Row")
    chapter.found = computed(lambda width: number, takes=("width",), method="plain code"), "f", "mm", "Found"
    chapter.clash("meet", lambda x: -np.ones(x.shape) if clash is None else clash, takes=("pegs.place",), key="pegs",
                  message="peg {part} meets peg {other}")  # fmt: skip
    mechanism = Mechanism(kind="row", version="1", title="Row", summary="Row.", inputs=Row, chapters=(chapter,))
    width = np.full(machines, 0.5) if machines > 1 else 0.5
    return calculate(mechanism, {"width": width, "pegs": True, "pegs.place": (0.1, 0.2, 0.3)}, machines)


@pytest.mark.parametrize("number", [2, 2.0, [2], [[2.0]], np.float64(2), np.array([[Fraction(2)]], dtype=object)])
def test_numbers_of_any_kind_are_numbers(number: Any) -> None:
    assert calculated(number)["found"] == 2


@pytest.mark.parametrize(
    ("number", "words"),
    [(None, "gives None"), ("long", "gives 'long'"), (np.zeros(3), r"gives an array of shape \(3,\)"), ([[1], [2, 3]], r"gives \[\[1\]"),
     (2j, "gives 2j"), ({"a": 1}, "gives {'a': 1}"), (np.array([[None]]), "gives array"), ([], r"gives an array of shape \(0,\)"),
     (True, "gives True; it must return a number in SI of mm"), (np.float32(2), r"gives (np\.float32\(2.0\)|2.0); it must"),
     (np.array([[2]], np.int8), r"gives array\(\[\[2\]\], dtype=int8\); it must return numbers of 64 bits"),
     (np.ma.masked_greater([[2.0]], 1), "gives masked_array")],
)  # fmt: skip
def test_what_is_no_number_is_told(number: Any, words: str) -> None:
    with pytest.raises(Misdeclared, match=rf"test_plain_code\.py:\d+: step found: its function <lambda> {words}.*"):
        calculated(number)


def test_what_plain_code_is_given_cannot_be_changed_by_it() -> None:
    """The step after it takes the same number: a change in place was a wrong result in silence."""

    def doubled(width: Any) -> Any:
        width *= 2
        return width

    chapter = Chapter("Row")
    chapter.found = computed(doubled, takes=("width",), method="plain code"), "f", "mm", "Found"
    mechanism = Mechanism(kind="row", version="1", title="Row", summary="Row.", inputs=Row, chapters=(chapter,))
    with pytest.raises(ValueError, match="read-only"):
        calculate(mechanism, {"width": 0.5, "pegs": True, "pegs.place": (0.1,)})


def test_several_machines_have_a_number_each() -> None:
    assert calculated(np.array([[1.0], [2.0]]), machines=2)["found"].tolist() == [[1.0], [2.0]]
    with pytest.raises(Misdeclared, match=r"gives an array of shape \(2,\); it must return a number, shape \(2, 1\)"):
        calculated(np.array([1.0, 2.0]), machines=2)


@pytest.mark.parametrize(
    "made",
    [lambda x: x[:, :1], lambda x: x[:, :-1], lambda x: x[:, 0], lambda x: np.hstack([x, x]), lambda x: x.T],
    ids=range(5),
)
def test_a_row_has_a_number_for_each_part(made: Any) -> None:
    """One that is left out would be judged by nothing."""
    chapter = Chapter("Row")
    chapter.row = computed(made, takes=("pegs.place",), method="plain code", over="pegs"), "r", "mm", "Row"
    mechanism = Mechanism(kind="row", version="1", title="Row", summary="Row.", inputs=Row, chapters=(chapter,))
    with pytest.raises(Misdeclared, match="it must return a number for each of the 3 parts of pegs"):
        calculate(mechanism, {"width": 0.5, "pegs": True, "pegs.place": (0.1, 0.2, 0.3)})


class Other(Block):
    other = MechanismInput("Mechanism that is asked")


class AskingOne(Inputs):
    width = Quantity("b", "mm", "Width", gt=0)
    other = MechanismInput("Mechanism that is asked")
    pegs = parts(Peg, "Pegs")


class Asking(Inputs):
    width = Quantity("b", "mm", "Width", gt=0)
    others = parts(Other, "Others")
    pegs = parts(Peg, "Pegs")


@pytest.mark.parametrize("in_list", [False, True])
def test_what_a_mechanism_tells_of_one_machine_is_asked_for_each(in_list: bool) -> None:
    """Three machines, and three parts in each: the numbers of the first machine are as many as the machines."""
    own = Chapter("Row")
    own.row = (
        computed(lambda x, width: x * width / 1e-3, takes=("pegs.place", "width"), method="m", over="pegs"),
        "r",
        "mm",
        "Row",
    )
    row = Mechanism(kind="row", version="1", title="Row", summary="Row.", inputs=Row, chapters=(own,))
    widths = np.array([1e-3, 2e-3, 3e-3])
    told = calculate(row, {"width": widths, "pegs": True, "pegs.place": (0.1, 0.2, 0.3)}, 3)
    handle = MechanismHandle(told, "told")
    asks = Chapter("Asks")

    def asked(given: Any) -> Any:
        return (given[0] if in_list else given).parts("row")

    asks.taken = (
        computed(asked, takes=("others.other" if in_list else "other",), method="m", over="pegs"),
        "t",
        "m",
        "Taken",
    )
    inputs = Asking if in_list else AskingOne
    mechanism = Mechanism(kind="asks", version="1", title="Asks", summary="Asks.", inputs=inputs, chapters=(asks,))
    given: dict[str, Any] = {"others": True, "others.other": (handle,)} if in_list else {"other": handle}
    calc = calculate(mechanism, {**given, "width": widths, "pegs": True, "pegs.place": (0.1, 0.2, 0.3)}, 3)
    assert calc["taken"] == pytest.approx(np.outer([1, 2, 3], [0.1, 0.2, 0.3]))


def test_parts_that_meet_are_told_by_their_number() -> None:
    with pytest.raises(Impossible, match="peg 2 meets peg 3"):
        calculated(clash=np.array([[-1, 2, 1]]))


@pytest.mark.parametrize(("clash", "words"), [(np.zeros(3), r"an array of shape \(3,\)"), ("none", "gives 'none'")])
def test_an_index_is_needed_for_each_part(clash: Any, words: str) -> None:
    with pytest.raises(Misdeclared, match=f"step meet: .*{words}.*must return an"):
        calculated(clash=clash)


def test_a_truth_value_is_printed_as_yes_or_no_and_what_serves_others_alone_is_not() -> None:
    chapter = Chapter("Row")
    for id, answer in (("held", True), ("lost", False)):
        chapter[id] = (computed(lambda width, answer=answer: width > 0.1 if answer else width > 1, takes=("width",), method="compared"), id[0], "1",
            f"Whether it is {id}")  # fmt: skip
    chapter.place = (
        computed(lambda width: 2.0, takes=("width",), method="counted", printed=False),
        "i",
        "1",
        "Number of the place",
    )
    chapter.wide = (computed(lambda place: np.asarray(place) > 0.15, takes=("pegs.place",), method="compared", over="pegs"), "w", "1",
        "Whether each is wide")  # fmt: skip
    mechanism = Mechanism(kind="row", version="1", title="Row", summary="Row.", inputs=Row, chapters=(chapter,))
    calc = calculate(mechanism, {"width": 0.5, "pegs": True, "pegs.place": (0.1, 0.2, 0.3)})
    (section,) = section_items(calc)
    assert [item.get("id") for item in section["items"]] == ["held", "lost", None]
    assert [item["result"]["text"] for item in section["items"][:2]] == ["yes", "no"]
    assert [row[-1] for row in section["items"][2]["rows"]] == ["no", "yes", "yes"]


class Ramp(Inputs):
    """A force that jumps at a place of a bar, and two points that are judged."""

    force = Varying("F", "N", "Force", extremes=True, words=("none",))
    jump = Quantity("x_j", "m", "Place of the jump", gt=0, lt=10, default=4)
    allowed = Quantity("[S]", "N", "Allowed force", gt=0, default=5)
    grade = Quantity("g", "1", "Grade", listed=(1, 2.5), default=1)
    n_points = Quantity("N", "1", "Samples", integer=True, ge=4, default=8)


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
chapter.x = abscissa(Constant(10.0, "l", "m")), "x", "m", "Place"
chapter.along = (
    computed_curve(Bar.at, "bar", "x", "as it is laid out", joints=lambda bar: bar.jump),
    "F(x)",
    "N",
    "Force along the bar",
)
chapter.twice = 2 * m.along, "2F", "N", "Twice the force"
chapter.greatest = reduction("max", of="along"), "F_max", "N", "Greatest force"
chapter.mean = reduction("mean", of="along"), "F_m", "N", "Mean force"
chapter.part_names("points", "Points", lambda grade: ["left", "right"], ("grade",), shown_at="worst")
chapter.at_point = (
    computed(lambda bar: bar.force * np.array([[1.0, 2.0]]), ("bar",), "by the bar", over="points"),
    "F_p",
    "N",
    "Force there",
)
chapter.doubled = 2 * m.at_point * m.grade, "D_p", "N", "Twice the force there"
chapter.worst = (
    computed(lambda row: np.argmax(row, axis=1)[:, None], ("doubled",), "the greatest", whole=True),
    "i_w",
    "1",
    "Worst point",
)
chapter.word = (
    computed(lambda index: [f"point {int(i)}" for i in index[:, 0]], ("worst",), "the greatest", is_text=True),
    "w",
    "1",
    "Its name",
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
        Check("force", "strength", "Force", "doubled", "allowed", unit="N", demand_label="force", limit_label="allowed",
            consequence="the {word} breaks."),
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
