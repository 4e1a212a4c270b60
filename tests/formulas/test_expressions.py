"""A formula computes and prints from the same body."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from diecut_report.api import m, number, pi
from diecut_report.formulas.expression import GRAVITY, Constant, FormulaError, arccos, node_of
from diecut_report.formulas.formula import Formula, WrittenFormula, evaluate, formula
from diecut_report.formulas.tree import Node, substitute, symbols
from diecut_report.report.mathematics import Linear

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
    for factor in (2, SHARE, DENSITY):
        a = a * factor
    return a


def test_loops_names_and_helpers_are_ordinary_python() -> None:
    assert looping.tree.to_json() == ["*", ["*", ["*", ["sym", "a"], ["num", "2"]], ["sym", "k"]], ["num", "7850"]]
    assert looping(3.0) == 3 * 2 * 0.25 * 7850 and looping.constants == {"k": SHARE}


def test_numbers_print_as_they_are_written() -> None:
    third = node_of(m.a ** (number(1) / 3) + np.sqrt(number(3)) - 2 * pi)
    assert Linear()(third.to_json()) == "a^(1/3) + √3 − 2·π"
    assert Linear()(node_of(sum(m[f"F_{i}"] for i in (1, 2)) * math.prod((m.a, m.b))).to_json()) == "(F_1 + F_2)·a·b"
    assert Linear()(node_of(m.a ** (1 / 4) - 0.5).to_json()) == "a^(0.25) − 0.5"
    assert float(number(1) / 3) == 1 / 3 and pi * np.ones(2) == pytest.approx([math.pi, math.pi])


@given(st.one_of(st.floats(-1e16, 1e16), st.integers(-(10**12), 10**12).map(float)))
@example(100000001.0)
@example(-2e8)
def test_a_number_that_is_printed_is_the_number_itself(value: float) -> None:
    assert evaluate(number(value).node, leaf_values()) == value
    assert WrittenFormula(number(value) * m.a, "x", "").function(1.0) == value


def test_quantities_stand_by_their_ids() -> None:
    written = m.inputs.torque / m.rods[0].length * m[f"force_{2}"]
    assert WrittenFormula(written, "x", "").parameters == ("inputs.torque", "rods.0.length", "force_2")


def test_what_stands_in_several_places_is_computed_once() -> None:
    calls = []
    root = Formula(lambda a: np.sqrt(a), printed_as="root")
    root.function = lambda a: calls.append(a) or a**0.5  # type: ignore[method-assign, assignment, func-returns-value]
    shared = root(m.a)
    assert WrittenFormula(shared * shared + shared, "x", "").function(4.0) == 6 and len(calls) == 1


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
SHARE = Constant(0.25, "k", "1")


@formula
def choosing(a: Any) -> Any:
    if a > 0:
        return a
    return -a


BRACKETS, OF_ARRAYS = (
    r"write np.where.*\(a\) & \(b\), \(a\) \| \(b\), ~\(a\), each condition in brackets",
    "as np.sin for math.sin",
)


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        (Formula(lambda a, b: a > 0 and b > 0), BRACKETS),
        (Formula(lambda a, b: a > 0 or b > 0), BRACKETS),
        (Formula(lambda a: not a), BRACKETS),
        (Formula(lambda a: 0 < a < 1), BRACKETS),
        (Formula(lambda a: a if a > 0 else -a), BRACKETS),
        (choosing, BRACKETS),
        (Formula(lambda a, b: max(a, b)), "np.maximum"),
        (Formula(lambda a: math.sin(a)), OF_ARRAYS),
        (Formula(lambda a: round(a)), OF_ARRAYS),
        (Formula(lambda a: a * np.pi), "write pi of diecut_report.api in place of np.pi"),
        (Formula(lambda a: sum(part for part in a)), "is one quantity and cannot be gone through"),
        (Formula(lambda a: np.cbrt(a)), "cannot print np.cbrt; .*sqrt"),
        (Formula(lambda a: a + "b"), r"'b' is a text; a quantity is written m\.b"),
        (Formula(lambda a: (a + 1).length), r"a \+ 1 is not a quantity and has no length"),
        (Formula(lambda a: a @ a), "unsupported operand"),
    ],
)
def test_what_a_formula_cannot_hold_is_told_with_what_to_write_instead(broken: Formula, words: str) -> None:
    with pytest.raises(FormulaError, match=rf"test_expressions\.py:\d+: (.|\n)*{words}"):
        _ = broken.tree


@pytest.mark.parametrize("broken", [foreign, unknown_name, endless])
def test_a_body_that_cannot_be_printed_is_refused_with_its_place(broken: Any) -> None:
    with pytest.raises(FormulaError, match=r"test_expressions\.py:\d+: "):
        _ = broken.tree


def test_a_constant_with_the_symbol_of_a_quantity_is_refused() -> None:
    with pytest.raises(FormulaError, match="takes a quantity k and a constant of this symbol"):
        _ = WrittenFormula(m.k * SHARE, "x", "here.py:1").constants
