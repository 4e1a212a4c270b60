"""A formula computes and prints from the same body."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from diecut_report.api import pi
from diecut_report.formulas.formula import Formula, FormulaError, evaluate, formula
from diecut_report.formulas.tree import GRAVITY, Constant, Node, arccos, substitute, symbols

GENT = Constant(98100.0, "k_G", "Pa")


@formula
def segment_area(radius: Any, angle: Any) -> Any:
    """Area of a segment."""
    return radius**2 * (angle - np.sin(angle) * np.cos(angle))


@formula
def chained(a: Any, b: Any, c: Any) -> Any:
    half = a / 2
    return -half * b - c / (a - b) / 3 + segment_area(c, half)


@formula
def weight(mass: Any) -> Any:
    return mass * GRAVITY


@formula
def braking(torque: Any, efficiency: Any) -> Any:
    return np.where(torque >= 0, torque / efficiency, torque * efficiency)


@formula
def gent(mass: Any) -> Any:
    return weight(mass) * GENT * pi


def leaf_values(**values: float) -> Any:
    """Values of symbols, for evaluating a tree."""
    return lambda leaf: values[leaf.args[0]]


def test_the_tree_computes_what_the_function_computes() -> None:
    values = {"a": 1.3, "b": 0.4, "c": 2.2}
    assert evaluate(chained.tree, leaf_values(**values)) == pytest.approx(chained(**values), rel=1e-15)


def test_the_tree_of_a_called_formula_stands_in_place_of_the_call() -> None:
    assert "call" not in [
        node[0] for node in chained.tree.to_json()[1:] if isinstance(node, list) and node[0] == "segment_area"
    ]
    assert symbols(chained.tree) == ["a", "b", "c"]


def test_a_formula_takes_arrays_of_variants() -> None:
    radius, angle = np.array([[1.0], [2.0]]), np.array([[0.1, 0.2, 0.3]])
    assert segment_area(radius, angle).shape == (2, 3)


@pytest.mark.parametrize("torque", [-3.0, 0.0, 5.0])
def test_a_choice_prints_as_cases(torque: float) -> None:
    assert braking.tree.op == "cases"
    assert evaluate(braking.tree, leaf_values(torque=torque, efficiency=0.8)) == pytest.approx(
        float(braking(torque, 0.8))
    )


def test_constants_print_with_their_symbol_and_are_known_through_called_formulas() -> None:
    assert weight.tree == Node("*", (Node("sym", ("mass",)), Node("sym", ("g",))))
    assert gent.constants == {"g": GRAVITY, "k_G": GENT}
    assert gent.constants["g"].unit == "m/s**2"


def test_symbols_are_replaced_without_touching_the_original() -> None:
    replaced = substitute(weight.tree, {"mass": Node("num", ("2",))})
    assert symbols(replaced) == ["g"]
    assert symbols(weight.tree) == ["mass", "g"]


def test_the_json_form_holds_the_whole_tree() -> None:
    assert braking.tree.to_json() == [
        "cases",
        [["/", ["sym", "torque"], ["sym", "efficiency"]], ["cmp", ">=", ["sym", "torque"], ["num", "0"]]],
        [["*", ["sym", "torque"], ["sym", "efficiency"]]],
    ]


@pytest.mark.parametrize("cosine, angle", [(1 + 1e-12, 0.0), (-1 - 1e-12, np.pi), (0.5, np.pi / 3)])
def test_rounding_does_not_lose_an_angle_at_its_end(cosine: float, angle: float) -> None:
    assert arccos(cosine) == pytest.approx(angle, abs=1e-15)


def test_a_cosine_that_is_really_beyond_one_is_no_angle() -> None:
    with np.errstate(invalid="ignore"):
        assert np.isnan(arccos(1.001))


@formula
def looping(a: Any) -> Any:
    for _ in range(3):
        a = a + 1
    return a


@formula
def foreign(a: Any) -> Any:
    return np.fft.fft(a)


@formula
def unknown_name(a: Any) -> Any:
    return a + leaf_values


@formula
def endless(a: Any) -> None:
    a + 1


DENSITY = 7850


@formula
def choosing(a: Any) -> Any:
    if a > 0:
        return a
    return -a


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        (Formula(lambda a, b: a > 0 and b > 0), r"write \(a\) & \(b\), each condition in brackets"),
        (Formula(lambda a, b: a > 0 or b > 0), r"write \(a\) \| \(b\), each condition in brackets"),
        (Formula(lambda a: not a), r"write ~\(a\)"),
        (Formula(lambda a: 0 < a < 1), r"write \(a < b\) & \(b < c\)"),
        (Formula(lambda a: a if a > 0 else -a), r"write np.where\(condition, a, b\)"),
        (choosing, r"write np.where\(condition, a, b\)"),
        (Formula(lambda a: math.sin(a)), "write np.sin"),
        (Formula(lambda a: math.acos(a)), "write np.arccos"),
        (Formula(lambda a, b: max(a, b)), "write np.maximum"),
        (Formula(lambda a: a * DENSITY), r"or bind it: bind\(…, DENSITY=7850\), or make it one of the constants"),
        (Formula(lambda a: a @ a), "a formula holds assignments, one return"),
    ],
)
def test_what_a_formula_cannot_hold_is_told_with_what_to_write_instead(broken: Formula, words: str) -> None:
    with pytest.raises(FormulaError, match=words):
        _ = broken.tree


@pytest.mark.parametrize("broken", [looping, foreign, unknown_name, endless])
def test_a_body_that_cannot_be_printed_is_refused_with_its_place(broken: Any) -> None:
    with pytest.raises(FormulaError, match=broken.__name__):
        _ = broken.tree
