"""Numbers as texts: rounded for print, in their display unit; formulas with these numbers in, proved by computing them again.

Texts are neutral here (decimal point, ``1.2e-05``): the report gives them their local form.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from diecut_report.contract.binding import Bound
from diecut_report.contract.steps import Words
from diecut_report.expressions import Node, evaluate, transform
from diecut_report.texts import DIGITS, NAMED, number_text, rounded, shortest, told, with_unit
from diecut_report.units import unit

if TYPE_CHECKING:
    from diecut_report.engine.calculation import Calculation

MOST_DIGITS = 17
ROUNDING = 1e-11  # share of a sum's terms below which a result is rounding alone
TRIGONOMETRIC = ("sin", "cos", "tan")


def printed(calc: Calculation, name: str, variant: int = 0, part: int = 0, up: bool | None = None) -> str:
    """A quantity as one would say it: ``40 mm``; of a row the value of one part; rounded up or down where ``up`` says so."""
    step = calc.steps.get(name)
    if isinstance(step, Words):
        return step.function(*(_plain(calc[taken], variant) for taken in step.takes))
    row: Any = calc[name]
    if isinstance(row, str | tuple):
        return row if isinstance(row, str) else str(row[part])
    value = row[variant, min(part, row.shape[1] - 1)]
    if isinstance(value, str):
        return value
    declared = calc.step_or_input(name)
    digits = getattr(declared, "digits", DIGITS)
    if name not in calc.values:
        return with_unit(shortest(float(value) / unit(declared.unit).factor), declared.unit)
    return told(float(value), declared.unit, digits, up=up)


def _plain(value: Any, variant: int) -> Any:
    """A number of one machine, SI; a text as it is."""
    found = value if isinstance(value, str) else value[variant, 0]
    return found if isinstance(found, str) else float(found)


def filled(calc: Calculation, text: str, variant: int = 0, places: Mapping[str, int] = MappingProxyType({})) -> str:
    """A message with its ``{ids}`` printed; of rows the part at ``places["index"]``; ``places`` stand for themselves.

    ``{id:up}`` and ``{id:down}`` are rounded that way: what "at least" and "at most" name must be enough.
    """

    def said(found: re.Match[str]) -> str:
        name = found[1]
        up = {"up": True, "down": False}.get(found[2])
        return str(places[name]) if name in places else printed(calc, name, variant, places.get("index", 0), up)

    return NAMED.sub(said, text)


def formula_unit(display: str) -> str:
    """The unit in which a number stands inside a formula: the display unit where it is a power of ten of SI, else SI."""
    own = unit(display)
    decade = math.log10(own.factor)
    return display if abs(decade - round(decade)) < 1e-12 else own.si


class Substitution:
    """A formula with numbers in, so precise that computing what is printed gives the printed result."""

    def __init__(self, calc: Calculation, part: Bound, value_of: Callable[[str], float]) -> None:
        self.calc, self.part, self.value_of = calc, part, value_of
        self.constants: Mapping[str, Any] = part.formula.constants

    def symbolic(self) -> Node:
        """The expression in the plugin's symbols."""
        return transform(self.part.formula.tree, self._symbol)

    def _symbol(self, leaf: Node) -> Node:
        name = self.part.names.get(leaf.args[0]) if leaf.op == "sym" else None
        if name is None:
            return leaf
        return (
            Node("sym", (self.calc.step_or_input(name).symbol,))
            if isinstance(name, str)
            else Node("num", (f"{name:g}",))
        )

    def numeric(self, target: float, display: str, result_digits: int) -> Node | None:
        """The expression with numbers and units; computed as printed it gives ``target`` (SI) as printed in ``display``.

        None where no number of digits shows it: the terms that it is the difference of are equal, or nearly so.
        """
        for digits in range(DIGITS, MOST_DIGITS + 1):
            tree = self._with_numbers(self.part.formula.tree, digits, angle=False)
            with np.errstate(all="ignore"):
                again = float(evaluate(tree, self._printed_value))
            if math.isfinite(again) and rounded(again, display, result_digits) == rounded(
                target, display, result_digits
            ):
                return tree
            if digits == DIGITS and self._is_rounding(target):
                return None
            if math.isfinite(again) and abs(again - target) <= ROUNDING * self._size(tree):
                return tree
        return None

    def _is_rounding(self, target: float) -> bool:
        tree = self._with_numbers(self.part.formula.tree, MOST_DIGITS, angle=False)
        return abs(target) <= ROUNDING * self._size(tree)

    def comparison(self, holds: bool) -> Node | None:
        """A condition with numbers, precise enough that it holds (or not) as printed; None where no number of digits shows it."""
        for digits in range(DIGITS, MOST_DIGITS + 1):
            tree = self._with_numbers(self.part.formula.tree, digits, angle=False)
            if bool(evaluate(tree, self._printed_value)) is holds:
                return tree
        return None

    def _size(self, tree: Node) -> float:
        """The size of the terms that a result is the sum of: what its rounding is to be judged by."""
        inner = tree.args[1] if tree.op == "call" and tree.args[0] == "abs" else tree
        if inner.op == "/":
            return self._size(inner.args[0]) / abs(float(evaluate(inner.args[1], self._printed_value)))
        if inner.op == "call" and inner.args[0] in ("sin", "cos"):
            return 1.0
        if inner.op == "*":
            return self._size(inner.args[0]) * self._size(inner.args[1])
        terms = inner.args if inner.op in ("+", "-") else (inner,)
        with np.errstate(all="ignore"):
            return max(abs(float(evaluate(term, self._printed_value))) for term in terms)

    def _printed_value(self, leaf: Node) -> float:
        if leaf.op == "qty":
            return float(leaf.args[0]) * unit(leaf.args[1]).factor
        return float(self.constants[leaf.args[0]])

    def _with_numbers(self, node: Node, digits: int, *, angle: bool) -> Node:
        """Angles stand in degrees where a trigonometric function takes them, else in rad."""
        if node.op == "sym":
            return self._number(node, digits, angle=angle)
        if node.op in ("num", "qty"):
            return node
        inside = node.args[0] in TRIGONOMETRIC if node.op == "call" else angle and node.op in ("+", "-", "neg")

        def descend(part: Any) -> Any:
            if isinstance(part, Node):
                return self._with_numbers(part, digits, angle=inside)
            return tuple(map(descend, part)) if isinstance(part, tuple) else part

        return Node(node.op, tuple(map(descend, node.args)))

    def _number(self, leaf: Node, digits: int, *, angle: bool) -> Node:
        name = self.part.names.get(leaf.args[0])
        if name is None:
            return leaf
        if not isinstance(name, str):
            return Node("num", (f"{name:g}",))
        declared = self.calc.step_or_input(name)
        display = "deg" if angle and unit(declared.unit).si == "rad" else formula_unit(declared.unit)
        number = self.value_of(name) / unit(display).factor
        text = (
            shortest(number, max(digits, 6))
            if name not in self.calc.values and name not in self.calc.curves
            else number_text(number, digits)
        )
        return Node("qty", (text, display))
