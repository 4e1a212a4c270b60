"""Numbers and constants as they are printed; a printed formula gives its printed result, or rounding alone keeps it from showing it."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.api import Chapter, Constant, Inputs, Mechanism, Quantity, abscissa, formula, m, samples
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.formulas.formula import Formula, evaluate
from diecut_report.formulas.tree import Node
from diecut_report.machine.calculation import Unproven
from diecut_report.machine.printing.page import definitions, items, section_items
from diecut_report.machine.printing.substitution import _constant, _quantity, bounded
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.mechanism.steps import Value
from diecut_report.quantities.formatting import number_text, shortest, told
from diecut_report.quantities.units import unit
from diecut_report.report.chapters.chapters import chapter as chapter_of
from diecut_report.report.equations import Equations, Typesetter
from diecut_report.report.mathematics import Linear
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.press_run import compute
from tests.configs import MECHANISMS
from tests.machines import UNBALANCED, cylinder, drive


@pytest.mark.parametrize(
    "value, text",
    [(0.0, "0"), (105.0, "105"), (164.9242, "164.9"), (0.164924, "0.1649"), (9.99996, "10.00"), (-5.0, "-5"), (21000, "21000"),
     (1234567.0, "1.235e6"), (1.2e-5, "1.2e-5"), (0.00012346, "0.0001235"), (189112.88, "189113"), (104.9999999999999, "105")],
)  # fmt: skip
def test_four_significant_digits(value: float, text: str) -> None:
    assert number_text(value) == text


@given(st.floats(min_value=-1e12, max_value=1e12, allow_subnormal=False).filter(lambda x: abs(x) > 1e-12))
def test_a_printed_number_is_within_its_rounding(value: float) -> None:
    assert float(number_text(value)) == pytest.approx(value, rel=5.01e-4)


@pytest.mark.parametrize("typed", ["470.7", "0.6", "40", "1200", "0.3", "7800"])
def test_what_was_typed_is_not_rounded(typed: str) -> None:
    assert shortest(unit("mm").to_si(float(typed)) / unit("mm").factor) == typed


def node(tree: Any) -> Any:
    """A tree of the results as nodes."""
    if not isinstance(tree, list):
        return tree
    if tree and isinstance(tree[0], list):
        return tuple(map(node, tree))
    return Node(tree[0], tuple(map(node, tree[1:])))


def said(leaf: Node) -> float:
    """The SI value of a printed quantity."""
    if leaf.op == "qty":
        return float(leaf.args[0]) * unit(leaf.args[1]).factor
    return {"g": 9.80665}[leaf.args[0]]


OPTIONS = {"crank_length": 100, "pinion_radius": 60, "segment_height": 40, "carriage_clearance": 30}
MACHINES = {
    "published cylinder": lambda: cylinder(bearing_span=900),
    "sized cylinder": lambda: cylinder(radius=None, bore_radius=30),
    "published drive": lambda: drive(),
    "drive with all options": lambda: drive(**UNBALANCED, **OPTIONS),
}


@pytest.mark.parametrize("machine", MACHINES)
def test_every_printed_formula_gives_its_printed_result(machine: str) -> None:
    results = mechanism_results(MACHINES[machine](), {})
    items = [i for s in results.sections for i in s.items if i.substituted]
    assert len(items) > 20
    for item in items:
        display = item.result.unit
        again = float(evaluate(node(item.substituted), said)) / unit(display).factor
        printed = item.result.text
        decimals = len(printed.partition("e")[0].partition(".")[2])
        half = 0.5 * 10.0 ** (int(printed.partition("e")[2] or 0) - decimals)
        assert abs(again - float(printed)) <= half * 1.001 + 1e-9 * abs(again), item.id


@pytest.mark.parametrize(
    ("value", "up", "text"),
    [(0.01110011, True, "11.11 mm"), (0.0111, True, "11.1 mm"), (0.01110011, False, "11.1 mm"), (-0.0031004, False, "-3.101 mm"),
     (0.04, True, "40 mm"), (0.0399999999999999, True, "40 mm"), (0.0, False, "0 mm")],
)  # fmt: skip
def test_advice_is_rounded_to_the_safe_side(value: float, up: bool, text: str) -> None:
    assert told(value, "mm", up=up) == text


SHARE = Constant(2.0, "k", "1")


class Bar(Inputs):
    length = Quantity("l", "mm", "Length", gt=0, default=100)
    other = Quantity("b", "mm", "Other length", gt=0, default=100)


def item(rule: Formula, **lengths: float) -> dict[str, Any]:
    """The printed item of a length that a formula gives (inputs in metres)."""
    step = Value(id="found", symbol="x", unit="mm", description="What is found", formula=rule)
    mechanism = Mechanism(
        kind="bar", version="1", title="Bar", summary="", inputs=Bar, chapters=(Chapter("All", steps=(step,)),)
    )
    (chapter,) = section_items(calculate(mechanism, {"length": 0.1, "other": 0.1} | lengths))
    found: dict[str, Any] = chapter["items"][0]
    return found


@formula
def difference(length: Any, other: Any) -> Any:
    return length - other


@formula
def locked(length: Any, other: Any) -> Any:
    return length / (1 - other / np.sqrt(other * other))


@formula
def scaled(length: Any) -> Any:
    return length * SHARE


def test_a_residual_of_rounding_is_noted_and_not_refused() -> None:
    told = item(difference, length=0.1 * (1 + 2.0**-52), other=0.1)
    assert told["substituted"] is None and "equal to machine precision" in told["note"]


def test_a_true_difference_is_printed_with_its_numbers() -> None:
    told = item(difference, length=0.1 * (1 + 1e-9), other=0.1)
    assert told["substituted"] and "note" not in told


def test_a_function_that_computes_what_its_body_does_not_say_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(difference, "function", lambda length, other: 1.01 * (length - other))
    with pytest.raises(
        Unproven, match=r"What is found \(found\) is 50\.5 mm, but its formula difference .* gives 50 mm"
    ):
        item(difference, length=0.15)


def test_a_zero_that_the_formula_does_not_give_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """A result of zero is not rounding where the terms differ."""
    monkeypatch.setattr(difference, "function", lambda length, other: 0 * length)
    with pytest.raises(Unproven, match=r"\(found\) is 0 mm, but .* gives 50 mm"):
        item(difference, length=0.15)


def test_a_formula_keeps_the_constant_with_which_it_was_read(monkeypatch: pytest.MonkeyPatch) -> None:
    assert scaled.constants == {"k": 2.0}
    monkeypatch.setattr(sys.modules[__name__], "SHARE", Constant(3.0, "k", "1"))
    assert item(scaled)["result"]["text"] == "200" and scaled(0.1) == 0.2


def test_a_refusal_holds_for_a_sixth_digit_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the printed result differs in its last digit only."""
    monkeypatch.setattr(difference, "function", lambda length, other: (length - other) * 1.001)
    with pytest.raises(Unproven, match="more than rounding"):
        item(difference, length=0.15)


# --- the bound --------------------------------------------------------------------------------------------------------


def tree(op: str, *args: Any) -> Node:
    return Node(op, args)


def called(name: str, *args: Any) -> Node:
    return Node("call", (name, *args))


X, Y = Node("sym", ("x",)), Node("sym", ("y",))
TREES = {
    "difference": tree("-", X, Y),
    "quotient": tree("/", X, tree("+", Y, Node("num", ("3",)))),
    "product of differences": tree("*", tree("-", X, Y), tree("-", Y, X)),
    "power": tree("^", tree("-", X, Y), Node("num", ("3",))),
    "square": tree("^", tree("-", X, Y), Node("num", ("2",))),
    "root": called("sqrt", called("abs", tree("-", X, Y))),
    "sine": called("sin", tree("*", X, Y)),
    "direction": called("arctan2", tree("-", X, Y), X),
    "greater": called("maximum", X, tree("-", Y, X)),
    "hyperbolic": called("cosh", tree("-", X, Y)),
    "cases": tree("cases", (X, Node("cmp", (">=", X, Y))), (tree("neg", Y),)),
}


@pytest.mark.parametrize("name", TREES)
@given(
    x=st.floats(0.01, 9.0),
    y=st.floats(0.01, 9.0),
    near=st.integers(-3, 3),
    ulps=st.tuples(st.integers(-1, 1), st.integers(-1, 1)),
)
def test_numbers_off_by_their_last_place_stay_within_the_bound(
    name: str, x: float, y: float, near: int, ulps: tuple[int, int]
) -> None:
    """Also where both are nearly the same, and at the edge of two cases."""
    other = x * (1 + near * 2.0**-52) if near else y
    found = bounded(TREES[name], lambda leaf: {"x": x, "y": other}[leaf.args[0]])
    moved = {"x": x * (1 + ulps[0] * 2.0**-52), "y": other * (1 + ulps[1] * 2.0**-52)}
    again = bounded(TREES[name], lambda leaf: moved[leaf.args[0]])
    assert abs(found.value - again.value) <= found.error


def test_the_bound_is_no_larger_than_rounding() -> None:
    """Against exact arithmetic: what a sum of unlike terms is off by is of the size of its terms' last places."""
    found = bounded(tree("-", X, Y), lambda leaf: {"x": 1.0, "y": 0.9999}[leaf.args[0]])
    exact = Fraction(1) - Fraction(0.9999)
    assert abs(Fraction(found.value) - exact) <= Fraction(found.error) < Fraction(2) * 8 * Fraction(2) ** -53


@pytest.mark.parametrize(
    ("over", "known"), [(tree("/", X, tree("-", X, Y)), False), (tree("/", X, tree("+", X, Y)), True)]
)
def test_nothing_is_known_of_a_quotient_by_rounding(over: Node, known: bool) -> None:
    assert math.isfinite(bounded(over, lambda leaf: 0.7).error) is known


def test_a_formula_at_its_limit_is_noted_and_not_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a clutch's at the limit of self-locking: its denominator is the difference of equal numbers."""
    monkeypatch.setattr(locked, "function", lambda length, other: length / 2.0**-53)
    told = item(locked)
    assert told["substituted"] is None and "equal to machine precision" in told["note"]


def chapters(calc: Any) -> dict[str, dict[str, Any]]:
    return {chapter["title"]: chapter for chapter in section_items(calc)}


def places(chapter: dict[str, Any]) -> set[str]:
    """Where its formulas are shown that are not marked as shown elsewhere."""
    shown = [i for i in chapter["items"] if i["type"] in ("formula", "choice") and i.get("at")]
    return {i["at"]["text"] for i in shown if not i.get("note", "").startswith("Shown at ")}


@pytest.fixture(scope="module")
def run() -> Any:
    return compute(load_config(MECHANISMS, Discovery()), lambda _: None)


def test_every_chapter_of_an_example_shows_one_place_and_says_which(run: Any) -> None:
    seen = 0
    for calc in run.calculations.values():
        for chapter in section_items(calc):
            assert places(chapter) <= {at["text"] for at in chapter.get("shown", ())}
            assert len({at["symbol"] for at in chapter.get("shown", ())}) == len(chapter.get("shown", ()))
            seen += "shown" in chapter
    assert seen > 10


def test_the_moments_of_the_drive_add_up_where_they_are_shown() -> None:
    """M_Σ = M_in + M_t·s: all of them at the crank angle of the greatest torque, not two of them in the middle of a stroke."""
    calc = drive(**UNBALANCED)
    chapter = chapters(calc)["Moments on the cylinder"]
    (place,) = chapter["shown"]
    assert float(place["text"]) == pytest.approx(np.degrees(calc["crank_torque_peak_at"][0, 0]), rel=1e-5)
    assert places(chapter) == {place["text"]}
    direction = next(item for item in chapter["items"] if item["id"] == "direction")
    speed = calc.sample("cylinder_speed", calc["crank_torque_peak_at"], calc.middle["crank_torque_peak_at"])[0, 0]
    assert f"{speed:.2f}" == direction["substituted"][2][1]


def test_what_is_taken_in_the_middle_of_a_piece_is_marked_with_its_place(run: Any) -> None:
    calc = run.calculations["feeder"]
    assert items(calc, calc.steps["law_middle"]) == []  # which serves how numbers are found
    [item] = items(calc, replace(calc.steps["law_middle"], printed=True))
    assert Linear()(item["equation"]) == "k(φ = 260°)"
    assert item["note"].startswith("Shown at φ = 260°, in the middle of its smooth piece")


def test_constants_stand_with_their_value_and_unit_among_the_numbers() -> None:
    items = [item for chapter in section_items(drive(**UNBALANCED)) for item in chapter["items"]]
    moment = next(item for item in items if item["id"] == "inertia_moment")
    assert "g" in Linear()(moment["equation"]) and "9.80665 m/s²" in Linear()(moment["substituted"])


def test_the_report_says_at_the_chapters_head_where_curves_are_shown() -> None:
    results = mechanism_results(drive(**UNBALANCED), {})
    part = chapter_of("A", "drive", results, Equations(Catalogue("en"), Typesetter().measure), Catalogue("en"))
    said = [section.shown for section in part.sections if section.shown]
    assert said and all(words.startswith("Curves are shown at φ = ") and words.endswith("°.") for words in said)


class Turned(Inputs):
    """A crank that is shown at an angle of its own."""

    shown = Quantity("φ_0", "deg", "Where it is shown", ge=0, default=30)
    radius = Quantity("r", "mm", "Radius", gt=0, default=100)
    n_points = samples(36)


@pytest.mark.parametrize(("shown", "printed"), [(30, "30"), (390, "30")])
def test_curves_are_shown_at_any_number_that_an_abscissa_names(shown: float, printed: str) -> None:
    motion = Chapter("Motion")
    motion.angle = abscissa(2 * np.pi, shown_at="shown"), "φ", "deg", "Angle"
    motion.height = m.radius * np.sin(m.angle), "y", "mm", "Height"
    crank = Mechanism(kind="crank", version="1", title="Crank", summary="", inputs=Turned, chapters=(motion,))
    calc = calculate(crank, flatten(Turned.model_validate({"shown": shown})))
    assert places(chapters(calc)["Motion"]) == {printed}


@formula(printed_as="inv")
def involute(alpha: float) -> float:
    """A formula of one angle, named in letters."""
    return 2.0 * alpha


@formula
def named_call(angle: float) -> float:
    """A formula that calls it, with a great number of its own."""
    return 1e6 * involute(angle)


@pytest.mark.parametrize(
    ("name", "value", "unit", "symbolic", "numeric"),
    [
        ("254 mm", 0.254, "m", ("254", "mm"), ("254", "mm")),
        ("700 MPa", 7e8, "Pa", ("700", "MPa"), ("700", "MPa")),
        ("1 in", 0.0254, "m", ("1", "in"), ("25.4", "mm")),  # not of SI: its number stands in the substituted formula
        ("p_G", 98100.0, "Pa", None, ("98.1", "kPa")),
    ],
)
def test_a_constant_stands_as_the_quantity_that_it_is(
    name: str, value: float, unit: str, symbolic: tuple[str, str] | None, numeric: tuple[str, str]
) -> None:
    found = _quantity(name)
    assert (found and found.args) == symbolic
    assert _constant(name, value, unit).args == numeric


def test_a_parameter_named_after_a_greek_letter_is_printed_as_it() -> None:
    (told,) = definitions(named_call.tree)
    assert told["defined"] == ["apply", "inv", ["sym", "α"]]
    assert "alpha" not in str(told)


def test_a_great_number_of_a_formula_has_no_row_of_zeros() -> None:
    assert named_call.tree.args[0] == Node("num", ("1e6",))


class InCases(Inputs):
    """Inputs of a formula of cases."""

    strength = Quantity("R_m", "MPa", "Strength", gt=0)
    given = Quantity("K_0", "1", "Factor, 0 where it is not given", default=0)


KPSI = Constant(6.894757e6, "1 kpsi", "Pa")
IN_CASES = Chapter("Cases")
IN_CASES.factor = np.where(m.given > 0, m.given, 2 + 0.001 * m.strength / KPSI), "K", "1", "Factor"  # fmt: skip


@pytest.mark.parametrize(("given", "printed"), [(0.0, ["900", "MPa", "6.894757"]), (1.5, ["1.5"])])
def test_with_numbers_only_the_case_that_holds_is_printed_and_a_constant_in_the_unit_beside_it(
    given: float, printed: list[str]
) -> None:
    mechanism = Mechanism(
        kind="cases", version="1", title="Cases", summary="Cases.", inputs=InCases, chapters=(IN_CASES,)
    )
    calc = calculate(mechanism, {"strength": 9e8, "given": given})
    (item,) = [
        each for section in mechanism_results(calc, {}).sections for each in section.items if each.id == "factor"
    ]
    symbolic, numbers = str(item.equation), str(item.substituted)
    assert "cases" in symbolic and "cases" not in numbers and "kPa" not in numbers
    assert all(f"'{each}'" in numbers for each in printed)
