"""Numbers as they are printed, and printed formulas computed again."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.formulas.formula import evaluate
from diecut_report.formulas.tree import Node
from diecut_report.quantities.formatting import number_text, shortest, told
from diecut_report.quantities.units import unit
from diecut_report.results.mechanism import mechanism_results
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
