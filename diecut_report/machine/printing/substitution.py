"""Numbers as texts: rounded for print, in their display unit; formulas with these numbers in, proved by computing them again.

Texts are neutral here (decimal point, ``1.2e-05``): the report gives them their local form.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import product
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from diecut_report.formulas.formula import Formula, evaluate
from diecut_report.formulas.tree import APPLY, COMPARE, LEAVES, NUMERIC, Node, transform, walk
from diecut_report.machine.calculation import declared_unit, number_unit, unit_for
from diecut_report.mechanism.names import formula_of
from diecut_report.mechanism.steps import Interpolated, Step, Words, plain_code
from diecut_report.quantities.formatting import (
    DIGITS,
    MOST_DIGITS,
    NAMED,
    author_digits,
    easy_unit,
    given_shown,
    is_nothing,
    number_text,
    rounded,
    shortest,
    shown_digits,
    told,
    with_unit,
)
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import sources_told
from diecut_report.text.phrases import Phrase, phrase

if TYPE_CHECKING:
    from diecut_report.machine.calculation import Calculation


# How far the rounding of the computer may carry a formula: a bound on the error of each node, through the whole tree.
#
# The bound is what two computations of one expression may differ by, whose numbers are the same but for their last places.


LAST_PLACES = 4 * 2.0**-53  # what an operation, or a number read in another unit, may be off by, of its value
OPERATIONS: dict[str, Callable[..., Any]] = {**APPLY, **NUMERIC}
COMPARISONS = frozenset(COMPARE.values())
INTEGERS = 2.0**53  # below which an integer of a formula is exact


class Bounded(NamedTuple):
    """Hold a value (a number, or whether a condition holds) and how far rounding may carry it; infinite where nothing is known.

    Of a condition the error is 1 where rounding may turn it, else 0.
    """

    value: Any
    error: float


PI = Bounded(math.pi, LAST_PLACES * math.pi)
LeafOf = Callable[[Node], Bounded]


def bounded(tree: Node, value_of: Callable[[Node], float]) -> Bounded:
    """Compute a tree with a bound on the rounding in it; ``value_of`` gives the SI value of ``sym`` and ``qty`` leaves."""

    def leaf(node: Node) -> Bounded:
        value = float(node.args[0]) if node.op == "num" else float(value_of(node))
        exact = node.op == "num" and value == round(value) and abs(value) < INTEGERS
        return Bounded(value, 0.0 if exact else LAST_PLACES * abs(value))

    with np.errstate(all="ignore"):
        return _bounded(tree, leaf)


def _bounded(node: Node, leaf: LeafOf) -> Bounded:
    op, args = node  # thousands of nodes are bounded for a document: no patterns are matched one after another
    if op in LEAVES:
        return PI if args == ("π",) and op == "sym" else leaf(node)
    if op in ("call", "cmp"):
        return _combined(args[0], [_bounded(a, leaf) for a in args[1:]])
    if op == "cases":
        return _branches([[_bounded(part, leaf) for part in branch] for branch in args])
    if op == "apply":
        called = args[0].formula
        known = dict(zip(called.parameters, (_bounded(a, leaf) for a in args[1:]), strict=True))
        return _bounded(called.tree, lambda own: known[own.args[0]] if own.args[0] in known else leaf(own))
    return _combined(op, [_bounded(a, leaf) for a in args])


def _branches(branches: Sequence[Sequence[Bounded]]) -> Bounded:
    """The first branch whose condition holds, or any before or after it that rounding may take in its place."""
    possible: list[tuple[bool, Bounded]] = []
    for value, *condition in branches:
        holds, error = condition[0] if condition else Bounded(True, 0.0)
        if holds or error:
            possible.append((bool(holds), value))
        if holds and not error:
            break
    taken = next((value for holds, value in possible if holds), Bounded(math.nan, math.inf))
    return Bounded(taken.value, max((abs(v.value - taken.value) + v.error for _, v in possible), default=math.inf))


def _combined(name: str, args: Sequence[Bounded]) -> Bounded:
    if name in COMPARISONS:
        (left, left_error), (right, right_error) = args
        return Bounded(APPLY[name](left, right), float(abs(left - right) <= left_error + right_error))
    if name in ("and", "or", "not"):
        return Bounded(APPLY[name](*(part.value for part in args)), max(part.error for part in args))
    try:
        value = float(OPERATIONS[name](*[part.value for part in args]))
    except ArithmeticError:  # of Python's own numbers: a division by zero, a power that is too great
        return Bounded(math.nan, math.inf)
    error = _error(name, value, args) + LAST_PLACES * abs(value)
    return Bounded(value, error if math.isfinite(error) else math.inf)


def _error(name: str, value: float, args: Sequence[Bounded]) -> float:
    """How far the errors of what an operation takes carry its value."""
    errors = [part.error for part in args]
    match name:
        case "+" | "-":
            return sum(errors)
        case "neg" | "abs" | "minimum" | "maximum":
            return max(errors)
        case "*":
            (one, one_error), (other, other_error) = args
            return float(abs(one) * other_error + abs(other) * one_error + one_error * other_error)
        case "/":
            over, (under, under_error) = args
            left = abs(under) - under_error
            return (over.error + abs(value) * under_error) / left if left > 0 else math.inf
        case "sin" | "cos":
            return min(errors[0], 2.0)
        case "tan" if abs(math.cos(args[0].value)) <= errors[0]:
            return math.inf
        case "arctan2":
            up, across = args
            if abs(up.value) <= up.error and across.value <= across.error:  # about the cut
                return 2 * math.pi
    return _over_the_ends(name, value, args)


DOMAIN = {
    "sqrt": (0.0, math.inf), "log": (0.0, math.inf), "log10": (0.0, math.inf), "arcsin": (-1.0, 1.0), "arccos": (-1.0, 1.0),
    "arccosh": (1.0, math.inf), "arctanh": (-1.0, 1.0),
}  # fmt: skip


def _over_the_ends(name: str, value: float, args: Sequence[Bounded]) -> float:
    """The greatest change over the ends of what the arguments may be, and over zero where that lies between them.

    It holds for what rises or falls in each argument on either side of zero. What lies outside of where a function is
    defined does not count, for it has no value there.
    """
    if not all(math.isfinite(part.error) for part in args):
        return math.inf
    low, high = DOMAIN.get(name, (-math.inf, math.inf))
    if name == "^" and args[1].value != round(args[1].value):
        low = 0.0
    places = [_places(part, low, high) for part in args[:1]] + [_places(part) for part in args[1:]]
    found = [_value(name, place) for place in product(*places)]
    return max((abs(each - value) for each in found), default=math.inf)


def _places(part: Bounded, low: float = -math.inf, high: float = math.inf) -> list[float]:
    if part.error == 0:
        return [min(max(part.value, low), high)]
    ends = [min(max(part.value + sign * part.error, low), high) for sign in (-1, 1)]
    return [*ends, *([0.0] if ends[0] < 0 < ends[1] else [])]


def _value(name: str, place: Sequence[float]) -> float:
    try:
        return float(OPERATIONS[name](*map(np.float64, place)))
    except ArithmeticError:
        return math.inf


QUANTITY = re.compile(r"(\d+(?:\.\d+)?) (\S+)")  # a constant that is named by what it is: 254 mm
PURE_NOTHING = 1e-12  # a pure number that is but the rounding of the computer: a residual
TRUSTED = 8  # digits up to which a number that is but the rounding of the computer stands as 0
EXACT = ("num", "qty")
TRIGONOMETRIC = ("sin", "cos", "tan")


def printed(calc: Calculation, name: str, variant: int = 0, part: int = 0, up: bool | None = None) -> str:
    """Return a quantity as one would say it: ``40 mm``; of a row the value of one part; rounded up or down where ``up`` says so."""
    step = calc.steps.get(name)
    if isinstance(step, Words):
        return phrase(plain_code.text(step, step.function(*(_plain(calc[name], variant) for name in step.takes)), part))
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
    found = value[variant, 0] if isinstance(value, np.ndarray) else value
    return float(found) if isinstance(found, int | float | np.number | np.bool_) else found


def filled(
    calc: Calculation, text: str, variant: int = 0, places: Mapping[str, int | str] = MappingProxyType({})
) -> str:
    """Return a message with its ``{ids}`` printed; of rows the part at ``places["index"]``; ``places`` stand for themselves.

    ``{id:up}`` and ``{id:down}`` are rounded that way: what "at least" and "at most" name must be enough.
    """

    if isinstance(text, Phrase) and text.values:  # filled already
        return text

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
        self, calc: Calculation, part: Formula, value_of: Callable[[str], float], elsewhere: Elsewhere | None = None
    ) -> None:
        self.calc, self.part, self.value_of, self.elsewhere = calc, part, cache(value_of), elsewhere
        self.constants: Mapping[str, Any] = part.constants
        self.is_copy = part.tree.op == "sym"  # whether it takes a quantity over as it is
        self.numbers: dict[str, Node] = {}  # as what each quantity was put in
        self._displays: dict[str, str] = {}
        self.in_degrees = False  # whether angles stand in degrees in all of it
        self.shares = {name for node in walk(part.tree) for name in _beside_a_number(node)}

    def symbolic(self) -> Node:
        """Return the expression in the plugin's symbols."""
        return transform(self.part.tree, self._symbol)

    def _symbol(self, leaf: Node) -> Node:
        if leaf.op != "sym":
            return leaf
        name = leaf.args[0]
        return self._marked(name) if name in self.part.parameters else _quantity(name) or leaf

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
        self.in_degrees = unit(display).text == "deg" and self.is_angle(self.part.tree)
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
        return self._with_numbers(self.part.tree, digits, angle=self.in_degrees)

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
        leaves = [leaf for leaf in walk(node) if leaf.op in ("sym", "qty")]
        return node.op != "apply" and all(leaf.op == "sym" and self._si_of(leaf.args[0]) == "1" for leaf in leaves)

    def _si_of(self, name: str) -> str:
        """The SI unit of what a quantity or a constant of the formula stands for."""
        if name in self.part.parameters:
            return unit(self.calc.step_or_input(name).unit).si
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
        if op == "cases":
            return self._with_numbers(self._case(args), digits, angle=angle)
        in_sum = angle and (op in ("+", "-", "neg") or (op in ("*", "/") and self.is_angle(node)))
        inside = args[0] in TRIGONOMETRIC if op == "call" else in_sum
        return Node(op, self._parts(args, digits, angle=inside))

    def _case(self, branches: Sequence[Sequence[Node]]) -> Node:
        """The value of the case that holds; with numbers the others say nothing: {2.580 if 0 > 0; …}."""
        for value, *condition in branches:
            if not condition or evaluate(condition[0], self._true_value):
                return value
        return Node("cases", tuple(branches))  # none holds: there is no value

    def _true_value(self, leaf: Node) -> float:
        is_quantity = leaf.op == "sym" and leaf.args[0] in self.part.parameters
        return self.value_of(leaf.args[0]) if is_quantity else self._printed_value(leaf)

    def _parts(self, parts: tuple[Any, ...], digits: int, *, angle: bool) -> tuple[Any, ...]:
        return tuple([
            self._with_numbers(part, digits, angle=angle) if type(part) is Node
            else self._parts(part, digits, angle=angle) if isinstance(part, tuple)
            else part
            for part in parts
        ])  # fmt: skip

    def _number(self, leaf: Node, digits: int, *, angle: bool) -> Node:
        name = leaf.args[0]
        if name not in self.part.parameters:
            constant = self.constants.get(name)
            return leaf if constant is None else _constant(name, float(constant), self._beside(constant.unit))
        declared, value = self.calc.step_or_input(name), self.value_of(name)
        own = self.display(name)
        display = own if self.is_copy else self.unit_of(own, angle=angle)
        display = "1" if name in self.shares and unit(display).si == "1" else display
        text = self._text(name, unit(display).from_si(value), digits)
        is_zero = digits <= TRUSTED and is_nothing(value, declared.unit)
        self.numbers[name] = Node("qty", ("0" if is_zero else text, display))
        return self.numbers[name]

    def _beside(self, declared: str) -> str:
        """The unit in which quantities of the same kind stand in the formula; a constant's own where there are none."""
        alike = (
            name
            for name in self.part.parameters
            if unit(self.calc.step_or_input(name).unit).kind == unit(declared).kind
        )
        return next((formula_unit(self.display(name)) for name in alike), declared)

    def _text(self, name: str, number: float, digits: int) -> str:
        """A number with so many digits; what is typed as it is."""
        if digits == MOST_DIGITS:
            return f"{number:.{digits}g}"  # exact: neither as typed nor taken as whole
        is_typed = name not in self.calc.curves and not isinstance(self.calc.step_or_input(name), Step)
        return shortest(number, digits) if is_typed else number_text(number, digits)

    def display(self, name: str) -> str:
        """Return the unit in which a quantity is shown where it stands for itself."""
        if name not in self._displays:
            self._displays[name] = number_unit(self.calc, name, self.calc.step_or_input(name), self.value_of(name))
        return self._displays[name]


def _beside_a_number(node: Node) -> list[str]:
    _, *sides = node.args if node.op == "cmp" else ("",)
    is_number = any(side.op == "num" and float(side.args[0]) for side in sides)
    return [side.args[0] for side in sides if side.op == "sym"] if is_number else []


def _quantity(symbol: str) -> Node | None:
    found = QUANTITY.fullmatch(symbol)
    return Node("qty", found.groups()) if found else None


def _constant(symbol: str, value: float, display: str) -> Node:
    """A constant of a formula: as it is named where its name is its quantity in SI's powers of ten, else in a unit easy to read."""
    named = _quantity(symbol)
    if named and formula_unit(named.args[1]) == named.args[1]:
        return named
    display = easy_unit(value, display) if unit(display).factor == 1 else display
    return Node("qty", (shortest(unit(display).from_si(value), MOST_DIGITS), display))


# What is wrong with a formula that does not give what is printed of it.


def contradicted(step: Step, part: Formula, found: Contradiction) -> str:
    """Return what is wrong with a formula whose expression does not give its result, with so many digits as show it."""
    factor, said = unit(step.unit).factor, ("", "")
    for digits in range(step.digits, MOST_DIGITS + 1):
        said = (number_text(found.result / factor, digits), number_text(found.printed / factor, digits))
        if said[0] != said[1]:
            break
    result, again = (with_unit(text, step.unit) for text in said)
    formula = part
    template = (
        "{description} ({id}) is {result}, but its formula {name} as it is printed gives {again}, which "
        "is more than rounding; it must compute by its parameters and constants alone ({place})"
    )
    return Phrase(
        template,
        description=step.description,
        id=step.id,
        result=result,
        name=formula.__name__,
        again=again,
        place=formula.place,
    )


# A value between two rows of a table as it is printed: the line through them, in symbols and with its numbers.


class BetweenRows(Substitution):
    """Describe the line through the two rows on either side of a quantity; its numbers stand in the table's units."""

    def __init__(
        self,
        calc: Calculation,
        step: Interpolated,
        value_of: Callable[[str], float],
        elsewhere: Elsewhere | None = None,
    ) -> None:
        super().__init__(calc, formula_of(step.formula), value_of, elsewhere)
        self.step = step
        row = int(step.between.piece(value_of(step.of)))
        self.rows = [
            [(own, shortest(own.values[k], MOST_DIGITS)) for own in step.between.columns] for k in (row, row + 1)
        ]

    def symbolic(self) -> Node:
        """Return the line in symbols, those of the rows with 1 and 2."""
        rows = [Node("sym", (symbol,)) for number in (1, 2) for symbol in self._symbols(number)]
        return self.step.between.through(self._marked(self.step.of), *rows)

    def told(self) -> dict[str, str]:
        """Return in words the two rows, and the table with where it comes from."""
        pairs = (zip(self._symbols(number), row, strict=True) for number, row in enumerate(self.rows, 1))
        rows = (", ".join(f"{symbol} = {with_unit(text, own.unit)}" for symbol, (own, text) in each) for each in pairs)
        told = Phrase("Rows of the table: {rows}.", rows="; ".join(rows))
        return {"table_rows": told, "series": phrase(self.step.table.title), "note": sources_told(self.step.table)}

    def unit_of(self, declared: str, *, angle: bool) -> str:
        """Return the table's unit."""
        return self.step.between.columns[0].unit

    def _at(self, digits: int) -> Node:
        rows = [Node("qty", (text, own.unit)) for row in self.rows for own, text in row]
        return self._with_numbers(self.step.between.through(Node("sym", (self.step.of,)), *rows), digits, angle=False)

    def _symbols(self, number: int) -> tuple[str, str]:
        own = self.calc.step_or_input(self.step.of).symbol, self.step.symbol
        first, second = (f"{symbol}{',' if '_' in symbol else '_'}{number}" for symbol in own)
        return first, second
