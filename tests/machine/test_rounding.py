"""A printed formula gives its printed result, or it is proved that rounding alone keeps it from showing it."""

from __future__ import annotations

import math
import sys
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.api import Annotated, Chapter, Constant, Inputs, Mechanism, Quantity, Value, bind, formula
from diecut_report.formulas.formula import Formula
from diecut_report.formulas.tree import Node
from diecut_report.machine.calculation import Unproven
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.printing.substitution import bounded
from diecut_report.machine.steps.run import calculate

SHARE = Constant(2.0, "k", "1")


class Bar(Inputs):
    length: Annotated[float, Quantity("l", "mm", "Length", gt=0)] = 100
    other: Annotated[float, Quantity("b", "mm", "Other length", gt=0)] = 100


def item(rule: Formula, **lengths: float) -> dict[str, Any]:
    """The printed item of a length that a formula gives (inputs in metres)."""
    step = Value(id="found", symbol="x", unit="mm", description="What is found", formula=bind(rule))
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


def test_a_formula_of_a_global_that_changes_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    assert scaled.constants == {"k": 2.0}
    monkeypatch.setattr(sys.modules[__name__], "SHARE", Constant(3.0, "k", "1"))
    with pytest.raises(Unproven, match=r"is 300 mm, but its formula scaled .* gives 200 mm.*test_rounding\.py:\d+"):
        item(scaled)


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
