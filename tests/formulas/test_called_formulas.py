"""Formulas that call others, by keyword or by their names in print, and those that would never end."""

from __future__ import annotations

import json
import math
from concurrent.futures import ThreadPoolExecutor
from threading import Event
from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, Constant, Inputs, Mechanism, Quantity, formula, m, pi
from diecut_report.declaration.formula_checks import dimensions
from diecut_report.formulas.expression import FormulaError
from diecut_report.formulas.formula import Formula, evaluate
from diecut_report.formulas.tree import Node
from diecut_report.machine.numerics.curves import Program
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.steps import Abscissa, Value
from diecut_report.report.equations import Equations, Typesetter
from diecut_report.report.mathematics import Latex, Linear
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import ItemRecord

TWICE = Constant(2.0, "k_0", "1")


@formula
def tan(x: Any) -> Any:
    return np.tan(x)


@formula
def sqrt(x: Any) -> Any:  # as after "from numpy import sqrt", which it shadows
    return sqrt(x)


@formula
def first(x: Any) -> Any:
    return second(x) + 1


@formula
def second(x: Any) -> Any:
    return first(x) - 1


@formula
def moment(chord: Any, depth: Any) -> Any:
    return chord**2 * depth


@formula
def by_keywords(c: Any, d: Any) -> Any:
    return moment(depth=d, chord=c) + moment(c, depth=d)


@formula
def wrong_keyword(c: Any) -> Any:
    return moment(c, width=c)


@formula(printed_as="k_t")
def stress_factor(x: Any) -> Any:
    """Factor of a notch."""
    return TWICE + np.exp(-x)


@formula(printed_as="k_n")
def nested_factor(y: Any) -> Any:
    return stress_factor(2 * y) ** 2


@formula
def notch(radius: Any, depth: Any) -> Any:
    return stress_factor(radius / depth) * depth + nested_factor(radius / depth) * radius


def test_a_formula_may_have_the_name_of_the_function_that_it_calls() -> None:
    assert tan(0.5) == math.tan(0.5)
    assert tan.tree == Node("call", ("tan", Node("sym", ("x",)))) and tan.constants == {}


@pytest.mark.parametrize("rule", [sqrt, first])
def test_a_formula_that_calls_itself_is_told_before_it_runs_away(rule: Any) -> None:
    for use in (lambda: rule(2.0), lambda: rule.tree, lambda: rule.constants, lambda: rule.function(2.0)):
        with pytest.raises(FormulaError, match=rf"test_called_formulas\.py:\d+: formula {rule.__name__} calls itself"):
            use()


def test_two_threads_may_follow_one_formula() -> None:
    begun, gone_on = Event(), Event()

    def waiting(x: Any) -> Any:
        begun.set()
        gone_on.wait(0.2)
        return 2 * x

    rule = Formula(waiting)
    with ThreadPoolExecutor(2) as pool:
        first = pool.submit(lambda: rule(m.a))
        begun.wait(5)
        second = pool.submit(lambda: rule(m.b))
        assert repr(first.result()) == "<2 * a>" and repr(second.result()) == "<2 * b>"


def test_a_call_may_name_what_it_gives() -> None:
    values = {"c": 3.0, "d": 5.0}
    assert by_keywords(**values) == 90 == evaluate(by_keywords.tree, lambda leaf: values[leaf.args[0]])


def test_a_call_that_does_not_fit_is_told_with_its_line() -> None:
    with pytest.raises(FormulaError, match=r"test_called_formulas\.py:\d+: .*formula moment: .*depth"):
        _ = wrong_keyword.tree


# --- calls that print by their names -----------------------------------------------------------------------------------


def test_a_named_call_computes_what_the_function_computes() -> None:
    values = {"radius": 0.3, "depth": 0.7} | {"k_0": 2.0}
    again = evaluate(notch.tree, lambda leaf: values[leaf.args[0]])
    assert again == pytest.approx(notch(radius=0.3, depth=0.7), rel=1e-15)
    assert again == pytest.approx((2 + math.exp(-3 / 7)) * 0.7 + (2 + math.exp(-6 / 7)) ** 2 * 0.3)


class Bar(Inputs):
    radius = Quantity("r", "mm", "Radius", gt=0, default=3)
    depth = Quantity("d", "mm", "Depth", gt=0, default=7)
    n_points = Quantity("N", "1", "Samples", ge=4, integer=True, default=8)


def bar(rule: Formula, **names: str) -> Mechanism:
    step = Value(
        id="found",
        symbol="x",
        unit="mm",
        description="What is found",
        formula=rule.of(**{name: m[id] for name, id in names.items()}),
    )
    return Mechanism(
        kind="bar", version="1", title="Bar", summary="", inputs=Bar, chapters=(Chapter("All", steps=(step,)),)
    )


def test_a_named_call_prints_by_its_name_and_its_definition_once_below() -> None:
    (chapter,) = section_items(calculate(bar(notch), {"radius": 0.003, "depth": 0.007}))
    item = ItemRecord.model_validate(json.loads(json.dumps(chapter["items"][0])))
    assert item.equation is not None and item.equation[1] == [
        "*",
        ["apply", "k_t", ["/", ["sym", "r"], ["sym", "d"]]],
        ["sym", "d"],
    ]
    equations = Equations(Catalogue("en"), Typesetter().measure)
    told = equations.of(item)
    assert told is not None and "x = k_t(r/d)·d + k_n(r/d)·r" in told.text
    assert [each.text for each in equations.definitions(item)] == [
        "k_t(x) = k_0 + exp(−x)",
        "k_n(y) = (k_t(2·y))²",
        "k_0 = 2",
    ]


def test_a_formula_without_named_calls_defines_nothing() -> None:
    (chapter,) = section_items(calculate(bar(moment, chord="radius"), {"radius": 0.003, "depth": 0.007}))
    assert "where" not in chapter["items"][0]


def test_a_named_call_is_checked_for_its_dimensions() -> None:
    assert list(dimensions(bar(notch))) == []
    assert any("found" in flaw for flaw in dimensions(bar(notch, depth="n_points")))


# --- more functions ------------------------------------------------------------------------------------------------------


@formula
def hyperbolic(x: Any) -> Any:
    return np.sinh(x) + np.cosh(x) * np.tanh(x) - np.arcsinh(x) * np.arccosh(1 + x) / np.arctanh(x / 2)


@formula
def others(x: Any, y: Any) -> Any:
    return np.log10(x) + np.hypot(x - y, y) * np.clip(x, 0.2, y) - np.cosh(x) ** 2


def exact_hyperbolic(x: float) -> float:
    e = math.e
    sinh, cosh = (e**x - e**-x) / 2, (e**x + e**-x) / 2
    area = math.log(x + math.sqrt(x * x + 1)) * math.log(1 + x + math.sqrt((1 + x) ** 2 - 1))
    return sinh + cosh * (sinh / cosh) - area / (0.5 * math.log((1 + x / 2) / (1 - x / 2)))


@pytest.mark.parametrize("x", [0.1, 0.5, 1.3])
def test_hyperbolic_functions_compute_and_print_alike(x: float) -> None:
    assert float(hyperbolic(x)) == pytest.approx(exact_hyperbolic(x))
    assert evaluate(hyperbolic.tree, lambda leaf: x) == pytest.approx(exact_hyperbolic(x))


@pytest.mark.parametrize(("x", "y"), [(0.1, 0.5), (0.3, 0.5), (3.0, 0.5)])
def test_other_functions_compute_and_print_alike(x: float, y: float) -> None:
    wanted = math.log(x) / math.log(10) + math.dist((x, y), (y, 0)) * sorted((0.2, x, y))[1]
    wanted -= ((math.e**x + math.e**-x) / 2) ** 2
    values = {"x": x, "y": y}
    assert float(others(x, y)) == pytest.approx(wanted)
    assert evaluate(others.tree, lambda leaf: values[leaf.args[0]]) == pytest.approx(wanted)


def test_the_functions_print_as_one_writes_them() -> None:
    tree = others.tree.to_json()
    assert Linear()(tree) == "lg x + √((x − y)² + y²)·min(max(x, 0.2), y) − (cosh x)²"
    names = Linear()(hyperbolic.tree.to_json())
    assert names == "sinh x + cosh x·tanh x − arsinh x·arcosh(1 + x)/artanh(x/2)"
    typesetter = Typesetter()
    for rule in (others, hyperbolic):
        latex = Latex()(rule.tree.to_json())
        assert "<math" in typesetter.mathml(latex, display=True) and typesetter.outline(latex, display=True).width > 0


@formula
def over_a_turn(angle: Any, radius: Any, depth: Any) -> Any:
    share = angle / (7 * pi)
    return radius * hyperbolic(0.1 + share) + notch(radius, depth + np.hypot(radius, radius * np.log10(1 + share)))


def test_compiled_curves_give_what_the_functions_give() -> None:
    steps = (
        Abscissa(id="angle", symbol="φ", unit="deg", description="Angle", period=2 * np.pi),
        Value(id="y", symbol="y", unit="mm", description="Curve", formula=over_a_turn),
    )
    made = Program({"y": steps[1]}, "angle", ("y",), at_middle=False)
    x = np.linspace(0.0, 6.0, 50)[None, :]
    given = {"radius": np.array([[0.003]]), "depth": np.array([[0.007]]), "angle": x}
    numbers = made.numbers(*(given[leaf.name] for leaf in made.leaves[0].values()))
    into = np.empty(x.shape)
    made.points(*(given[leaf.name] for leaf in made.leaves[2].values()), *numbers, into)
    assert into == pytest.approx(over_a_turn(x, 0.003, 0.007), rel=1e-12)
