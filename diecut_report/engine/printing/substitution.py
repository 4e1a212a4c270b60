"""Numbers as texts: rounded for print, in their display unit; formulas with these numbers in, proved by computing them again.

Texts are neutral here (decimal point, ``1.2e-05``): the report gives them their local form.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from diecut_report.contract.binding import Bound
from diecut_report.contract.steps import Step, Words
from diecut_report.engine.printing.rounding import bounded
from diecut_report.engine.shown_units import declared_unit, number_unit, unit_for
from diecut_report.engine.steps import plain_code
from diecut_report.expressions import Node, evaluate, transform
from diecut_report.expressions.tree import walk
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.display import easy_unit, is_nothing
from diecut_report.quantities.formatting import (
    DIGITS,
    NAMED,
    author_digits,
    given_shown,
    number_text,
    rounded,
    shortest,
    shown_digits,
    told,
    with_unit,
)
from diecut_report.quantities.units import unit

if TYPE_CHECKING:
    from diecut_report.engine.calculation import Calculation

MOST_DIGITS = 17
QUANTITY = re.compile(r"(\d+(?:\.\d+)?) (\S+)")  # a constant that is named by what it is: 254 mm
PURE_NOTHING = 1e-12  # a pure number that is but the rounding of the computer: a residual
TRUSTED = 8  # digits up to which a number that is but the rounding of the computer stands as 0
EXACT = ("num", "qty")
TRIGONOMETRIC = ("sin", "cos", "tan")


def printed(calc: Calculation, name: str, variant: int = 0, part: int = 0, up: bool | None = None) -> str:
    """Return a quantity as one would say it: ``40 mm``; of a row the value of one part; rounded up or down where ``up`` says so."""
    step = calc.steps.get(name)
    if isinstance(step, Words):
        return phrase(
            plain_code.text(step, step.function(*(_plain(calc[taken], variant) for taken in step.takes)), part)
        )
    row: Any = calc[name]
    if isinstance(row, str | tuple):
        return row if isinstance(row, str) else str(row[part])
    value = row[variant, min(part, row.shape[1] - 1)]
    if isinstance(value, str):
        return phrase(value)
    declared = calc.step_or_input(name)
    digits = getattr(declared, "digits", DIGITS)
    if name not in calc.values:
        display = declared_unit(calc, name, declared.unit)
        return with_unit(*given_shown(float(value), display).values())
    display = unit_for(calc, name, declared.unit, [float(value)])
    own = author_digits(float(value), display, digits) if digits != DIGITS else digits
    return told(float(value), display, own, up=up)


def _plain(value: Any, variant: int) -> Any:
    """A number of one machine, SI; a text as it is."""
    found = value[variant, 0] if isinstance(value, np.ndarray) else value
    return float(found) if isinstance(found, int | float | np.number | np.bool_) else found


def filled(
    calc: Calculation, text: str, variant: int = 0, places: Mapping[str, int | str] = MappingProxyType({})
) -> str:
    """Return a message with its ``{ids}`` printed; of rows the part at ``places["index"]``; ``places`` stand for themselves.

    ``{id:up}`` and ``{id:down}`` are rounded that way: what "at least" and "at most" name must be enough.
    """

    def said(found: re.Match[str]) -> str:
        name = found[1]
        up = {"up": True, "down": False}.get(found[2])
        return str(places[name]) if name in places else printed(calc, name, variant, int(places.get("index", 0)), up)

    return Phrase(text, {found[0][1:-1]: said(found) for found in NAMED.finditer(text)})


@cache
def formula_unit(display: str) -> str:
    """Return the unit in which a number stands inside a formula: the display unit where it is a power of ten of SI, else SI."""
    own = unit(display)
    decade = math.log10(own.factor)
    return display if abs(decade - round(decade)) < 1e-12 else own.si


class Contradiction(Exception):
    """Report that a printed expression does not give the result that is printed, and that is not rounding; both in SI."""

    def __init__(self, result: float, printed: float) -> None:
        super().__init__(result, printed)
        self.result, self.printed = result, printed


Elsewhere = Callable[[str], tuple[Node, Node] | None]  # of a quantity: its abscissa and place, if not the chapter's


class Substitution:
    """Hold a formula with numbers in, so precise that computing what is printed gives the printed result."""

    def __init__(
        self, calc: Calculation, part: Bound, value_of: Callable[[str], float], elsewhere: Elsewhere | None = None
    ) -> None:
        self.calc, self.part, self.value_of, self.elsewhere = calc, part, cache(value_of), elsewhere
        self.constants: Mapping[str, Any] = part.formula.constants
        self.is_copy = part.formula.tree.op == "sym"  # whether it takes a quantity over as it is
        self.numbers: dict[str, Node] = {}  # as what each quantity was put in
        self._displays: dict[str, str] = {}
        self.in_degrees = False  # whether angles stand in degrees in all of it
        self.shares = {name for node in walk(part.formula.tree) for name in _beside_a_number(node)}

    def symbolic(self) -> Node:
        """Return the expression in the plugin's symbols."""
        return transform(self.part.formula.tree, self._symbol)

    def _symbol(self, leaf: Node) -> Node:
        name = self.part.names.get(leaf.args[0]) if leaf.op == "sym" else None
        if name is None:
            return _quantity(leaf.args[0]) or leaf if leaf.op == "sym" else leaf
        return self._marked(name) if isinstance(name, str) else Node("num", (f"{name:g}",))

    def _marked(self, name: str) -> Node:
        """A quantity's symbol; where it is taken at another place than the chapter's, marked with that place."""
        symbol = Node("sym", (self.calc.step_or_input(name).symbol,))
        found = self.calc.names.result(name, self.calc.steps)
        if found is not None and found.role == "place":
            return Node("at", (symbol, Node("sym", (self.calc.steps[found.id].symbol,))))
        place = self.elsewhere(name) if self.elsewhere else None
        return symbol if place is None else Node("at", (symbol, *place))

    def numeric(self, target: float, display: str, result_digits: int) -> Node | None:
        """Return the expression with numbers and units; computed as printed it gives ``target`` (SI) as printed in ``display``.

        None where only rounding hides it: it is the difference of terms proved equal, or nearly so. ``Contradiction`` where it gives something else.
        """
        if unit(display).text == "1" and 0 < abs(target) < PURE_NOTHING:
            return None
        asked = result_digits
        result_digits = shown_digits(target, display, author_digits(target, display, asked))
        wanted = rounded(target, display, result_digits)
        self.in_degrees = unit(display).text == "deg" and self.is_angle(self.part.formula.tree)
        tree = self._at(DIGITS)
        again, error = bounded(tree, self._printed_value)
        if self._shows(again, display, result_digits, wanted):
            return tree
        whole = bounded(self._at(MOST_DIGITS), self._printed_value)
        is_rounding = abs(target) * 10.0**-asked <= whole.error < math.inf  # no number of digits shows it
        if not is_rounding and is_nothing(target, display) and is_nothing(again, display):
            return tree  # 0 is printed, and 0 is what the printed numbers give
        for digits in () if is_rounding else range(DIGITS, MOST_DIGITS + 1):
            if digits > DIGITS:
                tree = self._at(digits)
                again, error = bounded(tree, self._printed_value)
            if self._shows(again, display, result_digits, wanted) or abs(again - target) <= error < math.inf:
                return tree
        if abs(whole.value - target) <= whole.error or whole.error == math.inf:
            return None
        raise Contradiction(target, whole.value)

    @staticmethod
    def _shows(value: float, display: str, digits: int, wanted: str) -> bool:
        return math.isfinite(value) and rounded(value, display, digits) == wanted

    def unit_of(self, declared: str, *, angle: bool) -> str:
        """Return the unit in which a quantity's number stands; ``angle`` where it stands in degrees."""
        return "deg" if angle and unit(declared).si == "rad" else formula_unit(declared)

    def _at(self, digits: int) -> Node:
        """The expression with numbers of so many digits."""
        return self._with_numbers(self.part.formula.tree, digits, angle=self.in_degrees)

    def is_angle(self, node: Node) -> bool:
        """Return whether an expression is an angle in whatever unit the angles in it stand: φ_2 − φ_1, 2·φ, but not φ + π."""
        match node:
            case Node("sym", (name,)):
                return self._si_of(name) == "rad"
            case Node("neg" | "+" | "-", parts):
                return all(map(self.is_angle, parts))
            case Node("*", (left, right)):
                return self.is_angle(left) != self.is_angle(right) and (self._is_pure(left) or self._is_pure(right))
            case Node("/", (over, under)):
                return self.is_angle(over) and self._is_pure(under)
        return False

    def _is_pure(self, node: Node) -> bool:
        """Whether an expression holds pure numbers alone."""
        leaves = [leaf for leaf in walk(node) if leaf.op in ("sym", "qty")]
        return node.op != "apply" and all(leaf.op == "sym" and self._si_of(leaf.args[0]) == "1" for leaf in leaves)

    def _si_of(self, name: str) -> str:
        """The SI unit of what a parameter or a constant of the formula stands for."""
        taken = self.part.names.get(name)
        if isinstance(taken, str):
            return unit(self.calc.step_or_input(taken).unit).si
        constant = self.constants.get(name)
        return "1" if constant is None else unit(constant.unit).si

    def comparison(self, holds: bool) -> Node | None:
        """Return a condition with numbers, precise enough that it holds (or not) as printed; None where no number of digits shows it."""
        for digits in range(DIGITS, MOST_DIGITS + 1):
            tree = self._at(digits)
            if bool(evaluate(tree, self._printed_value)) is holds:
                return tree
        return None

    def _printed_value(self, leaf: Node) -> float:
        if leaf.op == "qty":
            return float(leaf.args[0]) * unit(leaf.args[1]).factor
        return float(self.constants[leaf.args[0]])

    def _with_numbers(self, node: Node, digits: int, *, angle: bool) -> Node:
        """Angles stand in degrees where a trigonometric function takes them or the whole is shown so, else in rad."""
        op, args = node
        if op == "sym":
            return self._number(node, digits, angle=angle)
        if op in EXACT:
            return node
        in_sum = angle and (op in ("+", "-", "neg") or (op in ("*", "/") and self.is_angle(node)))
        inside = args[0] in TRIGONOMETRIC if op == "call" else in_sum
        return Node(op, self._parts(args, digits, angle=inside))

    def _parts(self, parts: tuple[Any, ...], digits: int, *, angle: bool) -> tuple[Any, ...]:
        return tuple([
            self._with_numbers(part, digits, angle=angle) if type(part) is Node
            else self._parts(part, digits, angle=angle) if isinstance(part, tuple)
            else part
            for part in parts
        ])  # fmt: skip

    def _number(self, leaf: Node, digits: int, *, angle: bool) -> Node:
        name = self.part.names.get(leaf.args[0])
        if name is None:
            constant = self.constants.get(leaf.args[0])
            return leaf if constant is None else _constant(leaf.args[0], float(constant), constant.unit)
        if not isinstance(name, str):
            return Node("num", (f"{name:g}",))
        declared, value = self.calc.step_or_input(name), self.value_of(name)
        own = self.display(name)
        display = own if self.is_copy else self.unit_of(own, angle=angle)
        display = "1" if leaf.args[0] in self.shares and unit(display).si == "1" else display
        text = self._text(name, unit(display).from_si(value), digits)
        is_zero = digits <= TRUSTED and is_nothing(value, declared.unit)
        self.numbers[name] = Node("qty", ("0" if is_zero else text, display))
        return self.numbers[name]

    def _text(self, name: str, number: float, digits: int) -> str:
        """A number with so many digits; what is typed as it is."""
        if digits == MOST_DIGITS:
            return f"{number:.{digits}g}"  # exact: neither as typed nor taken as whole
        is_typed = name not in self.calc.curves and not isinstance(self.calc.step_or_input(name), Step)
        return shortest(number, digits) if is_typed else number_text(number, digits)

    def display(self, name: str) -> str:
        """Return the unit in which a quantity is shown where it stands for itself."""
        if name not in self._displays:
            self._displays[name] = self._unit(name)
        return self._displays[name]

    def _unit(self, name: str) -> str:
        return number_unit(self.calc, name, self.calc.step_or_input(name), self.value_of(name))


def _beside_a_number(node: Node) -> list[str]:
    """What a comparison holds against a plain number: 0.99 < 0.995, not 99 % < 0.995."""
    _, *sides = node.args if node.op == "cmp" else ("",)
    is_number = any(side.op == "num" and float(side.args[0]) for side in sides)
    return [side.args[0] for side in sides if side.op == "sym"] if is_number else []


def _quantity(symbol: str) -> Node | None:
    """A constant that is named by its number and its unit, as both; None for any other name."""
    found = QUANTITY.fullmatch(symbol)
    return Node("qty", found.groups()) if found else None


def _constant(symbol: str, value: float, declared: str) -> Node:
    """A constant of a formula: as it is named where its name is its quantity in SI's powers of ten, else in a unit easy to read."""
    named = _quantity(symbol)
    if named and formula_unit(named.args[1]) == named.args[1]:
        return named
    display = easy_unit(value, declared)
    return Node("qty", (shortest(unit(display).from_si(value), MOST_DIGITS), display))
