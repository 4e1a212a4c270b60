"""Expressions: what an author writes with quantities, in ordinary Python, keeps the tree of what is to be calculated.

``m.radius - m.height`` is an expression: the quantities are taken by their ids, the arithmetic of Python and the functions of NumPy make the tree.
Nothing is calculated then; the tree is printed, checked for its dimensions and made into the function that computes it.
"""

from __future__ import annotations

import linecache
import math
import operator
import reprlib
import sys
from collections.abc import Callable
from decimal import Decimal
from traceback import walk_tb
from types import FrameType
from typing import Any, NoReturn, Self

import numpy as np

from diecut_report.formulas.tree import AS_ANGLE, AS_NUMBER, FUNCTIONS, OF_TWO, PI, ROUNDING, Node, arccos_of, written
from diecut_report.quantities.units import unit as known
from diecut_report.text.phrases import Phrase, joined, phrase


class FormulaError(TypeError):
    """Report what a formula cannot hold: a mistake of the plugin's author, with the place (``file:line``) where it stands."""

    def __init__(self, text: str, place: str = "") -> None:
        super().__init__(joined((place, text), ": ") if place else text)
        self.text, self.place = text, place


ARITHMETIC: dict[Any, str] = {
    np.add: "+", np.subtract: "-", np.multiply: "*", np.true_divide: "/", np.power: "^", np.float_power: "^",
    np.less: "<", np.less_equal: "<=", np.greater: ">", np.greater_equal: ">=", np.equal: "==", np.not_equal: "!=",
    np.logical_and: "and", np.logical_or: "or", np.bitwise_and: "and", np.bitwise_or: "or",
}  # fmt: skip
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
NOTHING_ADDED, NOT_MULTIPLIED = 0, 1  # with which sum and math.prod begin
SHOWN = 60  # letters of an expression in a message


def _text(node: Node) -> str:
    text = written(node)
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}…"


# modules in which no author writes
OWN = ("numpy", "functools", *(f"diecut_report.{room}" for room in ("formulas", "mechanics", "mechanism")))
GENERATED = "<string>"  # the code of a dataclass


def is_own(frame: FrameType) -> bool:
    """Return whether code that is run stands in the program or a library, not in what an author writes."""
    name = f"{frame.f_globals.get('__name__', '')}."
    return frame.f_code.co_filename == GENERATED or any(name.startswith(f"{each}.") for each in OWN)


def author_place() -> tuple[str, int]:
    """Return file and number of the author's line that is being run."""
    frame = sys._getframe(1)
    while frame.f_back and is_own(frame):
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno


def failed_at(error: BaseException) -> str:
    """Return the place of the author's line in which something was raised; empty where none led to it."""
    frames = [(frame, line) for frame, line in walk_tb(error.__traceback__) if not is_own(frame)]
    return f"{frames[-1][0].f_code.co_filename}:{frames[-1][1]}" if frames else ""


def refuse(text: str) -> NoReturn:
    """Raise FormulaError with the author's line in front of the text."""
    file, number = author_place()
    line = linecache.getline(file, number).strip()
    text = joined((Phrase("in “{line}”", line=line), text), ": ") if line else text
    raise FormulaError(text, f"{file}:{number}") from None


class Expression:
    """Hold what is to be calculated of quantities; see the module's text. A quantity's parts are attributes or stand in brackets."""

    __slots__ = ("_node",)

    def __init__(self, node: Node) -> None:
        self._node = node

    # Quantities by their ids.

    def __getattr__(self, name: str) -> Expression:
        if name.startswith("__"):
            raise AttributeError(name)
        return self[name]

    def __getitem__(self, name: Any) -> Expression:
        if self._node.op != "sym":
            template = "{expression} is not a quantity and has no {name}; functions are those of NumPy, as np.clip(…)"
            refuse(Phrase(template, expression=_text(self._node), name=str(name)))
        if not isinstance(name, str | int):
            template = "{expression}[{name}] is not a part of it; a part is counted from 0, and m[text] gives a quantity by its id"
            refuse(Phrase(template, expression=_text(self._node), name=reprlib.repr(name)))
        return Expression(Node("sym", (f"{self._node.args[0]}.{name}",)))

    @property
    def id(self) -> str:
        """Return the id where it is a quantity and nothing else; empty for all others."""
        name = self._node.args[0]
        return name if self._node.op == "sym" and isinstance(name, str) and not isinstance(name, Symbol) else ""

    # Arithmetic.

    def __add__(self, other: Any) -> Expression:
        return _of("+", self, other)

    def __radd__(self, other: Any) -> Expression:
        return self if other is NOTHING_ADDED else _of("+", other, self)

    def __sub__(self, other: Any) -> Expression:
        return _of("-", self, other)

    def __rsub__(self, other: Any) -> Expression:
        return _of("-", other, self)

    def __mul__(self, other: Any) -> Expression:
        return _of("*", self, other)

    def __rmul__(self, other: Any) -> Expression:
        return self if other is NOT_MULTIPLIED else _of("*", other, self)

    def __truediv__(self, other: Any) -> Expression:
        return _of("/", self, other)

    def __rtruediv__(self, other: Any) -> Expression:
        return _of("/", other, self)

    def __pow__(self, other: Any) -> Expression:
        return _of("^", self, other)

    def __rpow__(self, other: Any) -> Expression:
        return _of("^", other, self)

    def __neg__(self) -> Expression:
        return Expression(Node("neg", (self._node,)))

    def __pos__(self) -> Self:
        return self

    def __abs__(self) -> Expression:
        return call("abs", self)

    # Conditions.

    def __lt__(self, other: Any) -> Expression:
        return _of("<", self, other)

    def __le__(self, other: Any) -> Expression:
        return _of("<=", self, other)

    def __gt__(self, other: Any) -> Expression:
        return _of(">", self, other)

    def __ge__(self, other: Any) -> Expression:
        return _of(">=", self, other)

    def __eq__(self, other: object) -> Expression:  # type: ignore[override]
        return _of("==", self, other)

    def __ne__(self, other: object) -> Expression:  # type: ignore[override]
        return _of("!=", self, other)

    def __and__(self, other: Any) -> Expression:
        return _of("and", self, other)

    def __or__(self, other: Any) -> Expression:
        return _of("or", self, other)

    def __invert__(self) -> Expression:
        return Expression(Node("not", (self._node,)))

    # NumPy.

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Expression:
        if method == "__call__" and not options:
            if ufunc is np.hypot:
                return call("sqrt", _of("+", *(_of("^", side, 2) for side in inputs)))
            if ufunc in ARITHMETIC:
                return _of(ARITHMETIC[ufunc], *inputs)
            if ufunc is np.negative:
                return -self
            if ufunc in (np.logical_not, np.invert):
                return ~self
            if ufunc in FUNCTIONS:
                return call(FUNCTIONS[ufunc], *inputs)
        return _unprinted(ufunc)

    def __array_function__(self, function: Any, types: Any, args: Any, options: Any) -> Expression:
        if not options:
            if function is np.where and len(args) == 3:
                return where(*args)
            if function is np.clip and len(args) == 3:
                return call("minimum", call("maximum", *args[:2]), args[2])
            if function in FUNCTIONS:
                return call(FUNCTIONS[function], *args)
        return _unprinted(function)

    # What a single number has, and an expression has not.

    def __bool__(self) -> bool:
        template = (
            "whether {expression} holds is another matter for each machine, so that if, and, or, not, min, max and a < b < c cannot ask it; "
            "write np.where(condition, a, b) for a choice, (a < b) & (b < c) for a range, (a) & (b), (a) | (b), ~(a), each condition in brackets, "
            "and np.minimum and np.maximum"
        )
        refuse(Phrase(template, expression=_text(self._node)))

    def _single(self, *_: Any) -> NoReturn:
        template = "{expression} is not a single number; write the function of NumPy, as np.sin for math.sin, which takes arrays too"
        refuse(Phrase(template, expression=_text(self._node)))

    __float__ = __int__ = __complex__ = __round__ = __ceil__ = __floor__ = __trunc__ = _single

    def __index__(self) -> int:
        template = (
            "{expression} is another number for each machine, which takes nothing from a list and counts no loop; write lookup(…) for a row "
            "of a table, np.where(condition, a, b) for a choice"
        )
        refuse(Phrase(template, expression=_text(self._node)))

    def __iter__(self) -> Any:
        template = (
            "{expression} is one quantity, which cannot be gone through or taken apart; a formula of what a list has is taken for each of "
            'its parts, and total("sum", of=…) adds them'
        )
        refuse(Phrase(template, expression=_text(self._node)))

    def __call__(self, *_: Any, **__: Any) -> NoReturn:
        template = (
            "{expression} is a quantity, which is not called; functions are those of NumPy, as np.clip(m.length, 0, 1)"
        )
        refuse(Phrase(template, expression=_text(self._node)))

    def __hash__(self) -> int:
        template = "{expression} cannot be the key of a table or stand in a set; write its id as a text"
        refuse(Phrase(template, expression=_text(self._node)))

    # What a text would have.

    def __str__(self) -> str:
        template = (
            "{expression} stands for a number of each machine and is not a text; a message names a quantity in braces, {braces}, and is "
            'not an f"…"'
        )
        refuse(Phrase(template, expression=_text(self._node), braces=f"{{{self.id or 'id'}}}"))

    def __format__(self, form: str) -> str:
        return str(self)

    def __repr__(self) -> str:
        return f"<{_text(self._node)}>"


# What Python has for numbers and a formula cannot print.


WITHOUT = {
    "xor": ("^", "a ** b for a power, (a) != (b) for either of two conditions"),
    "floordiv": ("//", "np.floor(a / b)"),
    "mod": ("%", "a - b * np.floor(a / b)"),
    "matmul": ("@", "a * b, or the sum of the products"),
    "lshift": ("<<", "a * 2**b"),
    "rshift": (">>", "np.floor(a / 2**b)"),
}


def _without(sign: str, instead: str) -> Callable[[Expression, Any], NoReturn]:
    def refused(self: Expression, other: Any) -> NoReturn:
        template = "a formula cannot print {expression} {sign} …; write {instead}"
        refuse(Phrase(template, expression=_text(self._node), sign=sign, instead=instead))

    return refused


for _name, (_sign, _instead) in WITHOUT.items():
    for _side in ("", "r"):
        setattr(Expression, f"__{_side}{_name}__", _without(_sign, _instead))


OTHERS = {
    "where": 3,
    "hypot": 2,
    "clip": 3,
}  # functions of NumPy that are printed as others, with how many values they take


def _unprinted(function: Any) -> NoReturn:
    name = FUNCTIONS.get(function, function.__name__)
    if name in OTHERS or function in FUNCTIONS:
        _refuse_values(name, OTHERS.get(name, 2 if name in OF_TWO else 1))
    template = "a formula cannot print {function}; it holds arithmetic, conditions, numbers, constants and these functions of NumPy: {known}"
    names = ", ".join(sorted({*FUNCTIONS.values(), *OTHERS}))
    refuse(Phrase(template, function=f"np.{name}", known=names))


def _refuse_values(name: str, wanted: int) -> NoReturn:
    form = "np.where(condition, a, b)" if name == "where" else f"np.{name}({', '.join('abc'[:wanted])})"
    template = "np.{name} is given more or fewer values than a formula prints, or keywords; write {form}"
    refuse(Phrase(template, name=name, form=form))


def _of(sign: str, *operands: Any) -> Expression:
    """Return an operation of two operands, of which one at least is an expression."""
    if sign in ("==", "!=") and any(isinstance(each, str) for each in operands):
        _refuse_text(*operands)
    nodes = tuple(map(node_of, operands))
    return Expression(Node("cmp", (sign, *nodes)) if sign in COMPARISONS else Node(sign, nodes))


def _refuse_text(*operands: Any) -> NoReturn:
    quantity = next((each.id for each in operands if isinstance(each, Expression) and each.id), "key")
    text = next(each for each in operands if isinstance(each, str))
    template = "{text} is a text, which no formula compares; with a text the whole quantity is given another way: needs=({token},)"
    refuse(Phrase(template, text=repr(text), token=f'"{quantity}={text}"'))


def call(name: str, *args: Any) -> Expression:
    """Return a function's value."""
    wanted = 2 if name in OF_TWO else 1
    if len(args) != wanted:
        _refuse_values(name, wanted)
    return Expression(Node("call", (name, *map(node_of, args))))


def where(condition: Any, value: Any, otherwise: Any) -> Expression:
    """Return a value where a condition holds, another one elsewhere."""
    last = node_of(otherwise)
    return Expression(
        Node("cases", ((node_of(value), node_of(condition)), *(last.args if last.op == "cases" else ((last,),))))
    )


def node_of(operand: Any, *, as_written: bool = False) -> Node:
    """Return the node of an expression or of a number; a multiple of π that is not given as such is refused."""
    match operand:
        case Expression():
            return operand._node
        case WrittenNumber():
            return operand.node
        case int() | float() | np.integer() | np.floating() if not isinstance(operand, bool):
            return _number(float(operand) if isinstance(operand, float | np.floating) else int(operand), as_written)
        case str() if all(each.isidentifier() for each in operand.split(".")):
            refuse(Phrase("{text} is a text; a quantity is written m.{name}", text=repr(operand), name=operand))
        case str():
            refuse(Phrase("{text} is a text; a number stands without quotes", text=reprlib.repr(operand)))
        case _ if callable(operand):
            name = getattr(operand, "__name__", "function")
            refuse(Phrase("{name} is a function that is not called; write {name}(…)", name=name))
    refuse(Phrase("{operand} is neither a quantity nor a number", operand=reprlib.repr(operand)))


OF_TURNS = 360  # the shares of π by which a formula is likely to multiply
POWERS_OF_PI = (1, 2, 3, -1, -2, 0.5)
EQUAL = 1e-12  # relative
ALL_DIGITS = 16  # which nobody types
PLAIN_BELOW = 1e5  # numbers from here on are printed as a power of ten
MAX_MANTISSA_LENGTH = 4  # letters before the power of ten, less than these


def _number(value: float, as_written: bool) -> Node:
    if not math.isfinite(value):
        refuse(Phrase("{value} is not a number that can be printed", value=repr(value)))
    if value % 1 and not as_written:
        _refuse_worked_out(value)
    return Node("neg", (Node("num", (_literal(-value),)),)) if value < 0 else Node("num", (_literal(value),))


def _refuse_worked_out(value: float) -> None:
    """Raise FormulaError where a number was worked out of π or of other numbers: it would be printed with all its digits."""
    for power in POWERS_OF_PI:
        turns = value / math.pi**power * OF_TURNS
        if 1 <= abs(turns) < OF_TURNS**2 and abs(turns - round(turns)) < EQUAL * abs(turns):
            template = "holds {value}, worked out of π, that would be printed as a number; write pi of diecut_report.api in place of np.pi"
            refuse(Phrase(template, value=f"{value:.6g}"))
    if len(repr(value).partition("e")[0].strip("-0.").replace(".", "")) >= ALL_DIGITS:
        template = (
            "holds {value}, worked out of other numbers, that would be printed with all its digits; write number(1) / 3 for what is to be "
            "printed as it is written, or number(…) of the whole"
        )
        refuse(Phrase(template, value=repr(value)))


def _literal(value: float) -> str:
    """A number as it is printed: a great power of ten as such, not with its zeros and a decimal."""
    text = repr(value)
    if not text.endswith(".0") or abs(value) < PLAIN_BELOW:
        return text
    mantissa, power = f"{Decimal(value).normalize():e}".split("e")
    return f"{mantissa}e{int(power)}" if len(mantissa) < MAX_MANTISSA_LENGTH else f"{value:.0f}"


# Numbers that are printed as they are written.


class WrittenNumber(float):
    """Hold a number that is printed as its author writes it: π as π, a third as 1/3. It computes as any other number."""

    node: Node

    def __new__(cls, value: float, node: Node | None = None) -> Self:
        """Return the number; without a node it stands as it is."""
        self = super().__new__(cls, value)
        self.node = node if node is not None else _number(value, as_written=True)
        return self

    def __neg__(self) -> WrittenNumber:
        return WrittenNumber(-float(self), Node("neg", (self.node,)))

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        plain = [float(each) if isinstance(each, WrittenNumber) else each for each in inputs]
        if any(isinstance(each, Expression) for each in inputs):
            return NotImplemented
        found = getattr(ufunc, method)(*plain, **options)
        kept = ufunc in FUNCTIONS and not options and all(type(each) in (int, float) for each in plain)
        return (
            WrittenNumber(found, Node("call", (FUNCTIONS[ufunc], *(node_of(each, as_written=True) for each in inputs))))
            if kept
            else found
        )


def _kept(sign: str, operation: Callable[[Any, Any], Any]) -> tuple[Any, Any]:
    """The operation and its reflection, of which the tree is kept where both sides are single numbers."""

    def of(left: Any, right: Any) -> Any:
        kept = all(isinstance(each, WrittenNumber) or type(each) in (int, float) for each in (left, right))
        value = operation(*(float(each) if isinstance(each, WrittenNumber) else each for each in (left, right)))
        return (
            WrittenNumber(value, Node(sign, (node_of(left, as_written=True), node_of(right, as_written=True))))
            if kept
            else value
        )

    def forward(self: WrittenNumber, other: Any) -> Any:
        return NotImplemented if isinstance(other, Expression) else of(self, other)

    def reflected(self: WrittenNumber, other: Any) -> Any:
        return of(other, self)

    return forward, reflected


for _sign, _name in (("+", "add"), ("-", "sub"), ("*", "mul"), ("/", "truediv"), ("^", "pow")):
    _forward, _reflected = _kept(_sign, getattr(operator, _name))
    setattr(WrittenNumber, f"__{_name}__", _forward)
    setattr(WrittenNumber, f"__r{_name}__", _reflected)


def number(value: float) -> WrittenNumber:
    """Return a number with which arithmetic is printed as it is written: ``number(1) / 3`` is 1/3, not 0.3333."""
    return WrittenNumber(value)


class Symbol(str):
    """Hold the symbol of a constant in a tree, and the constant."""

    constant: Constant

    def __new__(cls, constant: Constant, symbol: str) -> Self:
        self = super().__new__(cls, symbol)
        self.constant = constant
        return self


class Constant(WrittenNumber):
    """Hold a physical constant of a formula: an SI value with symbol and unit (pint-readable, coherent SI)."""

    symbol: str
    unit: str

    def __new__(cls, value: float, symbol: str, unit: str) -> Self:
        given = known(unit)
        if abs(given.factor - 1) > ROUNDING:
            template = "{symbol} is in {unit}, which is {factor} {si}; give it in SI, {value} {si}"
            given_text, in_si = format(given.factor, "g"), format(value * given.factor, "g")
            raise TypeError(Phrase(template, symbol=symbol, unit=unit, factor=given_text, si=given.si, value=in_si))
        self = super().__new__(cls, value, Node("sym", (symbol,)))
        self.symbol, self.unit = symbol, unit
        self.node = Node("sym", (Symbol(self, symbol),))
        return self


pi = WrittenNumber(math.pi, PI)
GRAVITY = Constant(9.80665, "g", "m/s**2")


class Quantities:
    """Give quantities by their ids: ``m.radius``, ``m.rods[0].length``, ``m.inputs.torque``; ``m[f"force_{side}"]`` where an id is made."""

    def __getattr__(self, name: str) -> Expression:
        if name.startswith("__"):
            raise AttributeError(name)
        return Expression(Node("sym", (name,)))

    def __getitem__(self, name: str) -> Expression:
        if not isinstance(name, str):
            refuse(Phrase("m[{name}] is not a quantity; in brackets stands the text of an id", name=reprlib.repr(name)))
        return Expression(Node("sym", (name,)))

    def __setattr__(self, name: str, given: Any) -> None:
        template = "m.{name} takes a quantity and declares none; write chapter.{name} = …, with the name of the chapter that it stands in"
        refuse(Phrase(template, name=name))

    __setitem__ = __setattr__

    def __call__(self, *_: Any, **__: Any) -> NoReturn:
        refuse(phrase("m is not called; m.height takes a quantity by its id, m[text] one whose id is made"))


m: Any = Quantities()  # NumPy says of its functions that they take arrays alone


def arccos(cosine: Any) -> Any:
    """Return the angle of a cosine, in [0, π] rad; a cosine beyond ±1 by rounding alone counts as ±1, beyond that is NaN."""
    return call("arccos", cosine) if isinstance(cosine, Expression) else arccos_of(cosine)


def as_number(angle: Any) -> Any:
    """Say to the check of dimensions that the radian drops: the number of radians stands as a plain number.

    It gives back what it takes and is not printed.
    """
    return _said(AS_NUMBER, angle)


def as_angle(number: Any) -> Any:
    """Say to the check of dimensions that what it takes stands as an angle in radians (1/s as rad/s, rad²/s² as rad/s²).

    It gives back what it takes and is not printed.
    """
    return _said(AS_ANGLE, number)


def _said(what: str, of: Any) -> Any:
    match of:
        case Expression():
            return Expression(Node("call", (what, node_of(of))))
        case WrittenNumber():
            return WrittenNumber(float(of), Node("call", (what, of.node)))
    return of
