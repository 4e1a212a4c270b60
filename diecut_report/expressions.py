"""A formula is written once, as a small Python function: it computes, and its own syntax tree prints.

``@formula`` marks a function whose parameters are named for what it takes (SI), whose body holds assignments of
intermediate terms and one return, in plain NumPy. Calling it computes, on numbers and on arrays; ``.tree`` is what
prints. The tree is read on first use only, so that importing a plugin costs nothing for it.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable
from functools import cached_property
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from diecut_report.formula_source import FormulaError as FormulaError
from diecut_report.formula_source import definition, given_to, perhaps_named, place
from diecut_report.trees import Node as Node
from diecut_report.trees import substitute as substitute
from diecut_report.trees import symbols as symbols
from diecut_report.trees import transform as transform

Array = NDArray[Any]


class Constant(float):
    """A physical constant of a formula: an SI value with symbol and unit (pint-readable, coherent SI)."""

    symbol: str
    unit: str

    def __new__(cls, value: float, symbol: str, unit: str) -> Constant:
        self = super().__new__(cls, value)
        self.symbol, self.unit = symbol, unit
        return self


GRAVITY = Constant(9.80665, "g", "m/s**2")

ROUNDING = 1e-9  # how far beyond ±1 rounding may carry the cosine of an angle that exists


def arccos(cosine: Any) -> Any:
    """Angle of a cosine, in [0, π] rad; a cosine beyond ±1 by rounding alone counts as ±1, beyond that is NaN."""
    beyond = (abs(cosine) > 1) & (abs(cosine) < 1 + ROUNDING)
    return np.arccos(np.where(beyond, np.sign(cosine), cosine))


FUNCTIONS: dict[Any, str] = {
    np.sqrt: "sqrt", np.sin: "sin", np.cos: "cos", np.tan: "tan", np.arcsin: "arcsin", np.arccos: "arccos",
    arccos: "arccos", np.arctan: "arctan", np.arctan2: "arctan2", np.exp: "exp", np.log: "log", np.abs: "abs", abs: "abs",
    np.sign: "sign", np.minimum: "minimum", np.maximum: "maximum", np.ceil: "ceil", np.floor: "floor", np.round: "round",
    np.sinh: "sinh", np.cosh: "cosh", np.tanh: "tanh", np.arcsinh: "arcsinh", np.arccosh: "arccosh", np.arctanh: "arctanh",
    np.log10: "log10",
}  # fmt: skip
NUMERIC: dict[str, Callable[..., Any]] = {name: function for function, name in FUNCTIONS.items()}
BINARY: dict[type[ast.operator], str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "^", ast.BitAnd: "and", ast.BitOr: "or",
}  # fmt: skip
COMPARE: dict[type[ast.cmpop], str] = {
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=",
}  # fmt: skip
APPLY: dict[str, Callable[..., Any]] = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "^": operator.pow,
    "and": operator.and_, "or": operator.or_, "not": np.logical_not, "neg": operator.neg,
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
}  # fmt: skip
PI = Node("sym", ("π",))


class Formula:
    """A function that computes and prints; see the module's text. ``printed_as`` is the name by which calls of it print."""

    def __init__(self, function: Callable[..., Any], printed_as: str = "") -> None:
        self._function, self.printed_as = function, printed_as
        self.__name__ = function.__name__
        self.__doc__ = function.__doc__
        self.__module__ = function.__module__
        self._reading: Reading | None = None

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return self.function(*args, **kwargs)

    @cached_property
    def function(self) -> Callable[..., Any]:
        """The function itself. FormulaError where it calls itself, at once or by way of others."""
        seen: list[Formula] = []
        pending = [self]
        while pending:
            seen += (here := list(perhaps_named(pending.pop()._function, Formula)))
            pending += [each for each in here if seen.count(each) == 1]
        if self in seen:
            self.reading()  # which knows for certain
        return self._function

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """The names of what the formula takes."""
        code = self._function.__code__
        return code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]

    @property
    def place(self) -> str:
        """Where it is written, as ``file:line``."""
        return place(self._function)

    @property
    def tree(self) -> Node:
        """The expression that the formula returns; its parameters stand as ``("sym", (name,))``."""
        return self.reading().tree

    @property
    def constants(self) -> dict[str, Constant]:
        """The physical constants that the body names, by the symbol they print with."""
        return self.reading().constants

    def reading(self, above: tuple[Formula, ...] = ()) -> Reading:
        """What the body says; ``above`` are the formulas in whose bodies it is called."""
        if self._reading is None:
            if self in above:
                chain = " → ".join(each.__name__ for each in (*above[above.index(self) :], self))
                raise FormulaError(f"{self.place}: formula {self.__name__} calls itself ({chain}) and would never end; "
                                   "give the formula another name than what it calls")  # fmt: skip
            self._reading = _Reader(self, above).read()
        return self._reading


class Reading(NamedTuple):
    """What a formula's body says: its expression, and the constants in it by their symbols."""

    tree: Node
    constants: dict[str, Constant]


class Named(str):
    """The name by which a formula is called in print, and the formula."""

    formula: Formula

    def __new__(cls, formula: Formula) -> Named:
        self = super().__new__(cls, formula.printed_as)
        self.formula = formula
        return self


@overload
def formula(function: Callable[..., Any], /) -> Formula: ...
@overload
def formula(*, printed_as: str) -> Callable[[Callable[..., Any]], Formula]: ...
def formula(
    function: Callable[..., Any] | None = None, /, *, printed_as: str = ""
) -> Formula | Callable[[Callable[..., Any]], Formula]:
    """Mark a function as a formula (see the module's text).

    With ``printed_as="k_t"`` a formula that calls it prints ``k_t(r/d)``, and its definition once below; without, its
    expression stands in place of the call.
    """
    return Formula(function) if function is not None else lambda own: Formula(own, printed_as)


class _Reader:
    """Reads one formula's body into a tree."""

    def __init__(self, owner: Formula, above: tuple[Formula, ...]) -> None:
        self.owner, self.above = owner, above
        self.function = owner._function
        self.globals = self.function.__globals__
        self.locals: dict[str, Node] = {name: Node("sym", (name,)) for name in owner.parameters}
        self.constants: dict[str, Constant] = {}

    def read(self) -> Reading:
        for statement in definition(self.function.__code__).body:
            match statement:
                case ast.Return(value=ast.expr() as value):
                    return Reading(self._node(value), self.constants)
                case ast.Assign(targets=[ast.Name(id=name)], value=value):
                    self.locals[name] = self._node(value)
                case ast.Expr(value=ast.Constant(value=str())):
                    continue  # the docstring
                case _:
                    raise self._refuse(statement)
        raise FormulaError(f"{self.owner.place}: formula {self.owner.__name__} returns nothing")

    def _node(self, expression: ast.expr) -> Node:
        match expression:
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
                return Node("num", (repr(value),))
            case ast.Name(id=name) if name in self.locals:
                return self.locals[name]
            case ast.Name() | ast.Attribute():
                return self._constant(expression)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in BINARY:
                return Node(BINARY[type(op)], (self._node(left), self._node(right)))
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return Node("neg", (self._node(operand),))
            case ast.UnaryOp(op=ast.Invert(), operand=operand):
                return Node("not", (self._node(operand),))
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in COMPARE:
                return Node("cmp", (COMPARE[type(op)], self._node(left), self._node(right)))
            case ast.Call(func=func, args=args):
                callee, given = self._object(func), tuple(map(self._node, args))
                return (
                    self._called(callee, given, expression)
                    if isinstance(callee, Formula)
                    else self._call(callee, given, expression)
                )
        raise self._refuse(expression)

    def _call(self, callee: Any, args: tuple[Node, ...], at: ast.Call) -> Node:
        if at.keywords:
            raise self._refuse(at)
        if callee is np.where and len(args) == 3:
            otherwise = args[2].args if args[2].op == "cases" else ((args[2],),)
            return Node("cases", ((args[1], args[0]), *otherwise))
        if callee is np.hypot and len(args) == 2:
            return Node("call", ("sqrt", Node("+", tuple(Node("^", (side, Node("num", ("2",)))) for side in args))))
        if callee is np.clip and len(args) == 3:
            return Node("call", ("minimum", Node("call", ("maximum", *args[:2])), args[2]))
        if callee in FUNCTIONS:
            return Node("call", (FUNCTIONS[callee], *args))
        raise self._refuse(at)

    def _called(self, callee: Formula, args: tuple[Node, ...], at: ast.Call) -> Node:
        """A call of another formula: its expression in place of the call, or its name with what it is given."""
        reading = callee.reading((*self.above, self.owner))
        named = {word.arg: self._node(word.value) for word in at.keywords if word.arg is not None}
        if len(named) < len(at.keywords):
            raise self._refuse(at)
        try:
            given = given_to(callee._function, args, named)
        except TypeError as error:
            raise FormulaError(
                f"{self._place(at)}: formula {self.owner.__name__} calls {callee.__name__}: {error}"
            ) from None
        self.constants |= reading.constants
        nodes = {name: part if isinstance(part, Node) else Node("num", (repr(part),)) for name, part in given.items()}
        return Node("apply", (Named(callee), *nodes.values())) if callee.printed_as else substitute(reading.tree, nodes)

    def _constant(self, expression: ast.expr) -> Node:
        value = self._object(expression)
        if isinstance(value, Constant):
            self.constants[value.symbol] = value
            return Node("sym", (value.symbol,))
        if value is np.pi or value is math.pi:
            return PI
        raise self._refuse(expression)

    def _object(self, expression: ast.expr) -> Any:
        match expression:
            case ast.Name(id=name):
                builtins = self.globals["__builtins__"]
                builtins = builtins if isinstance(builtins, dict) else vars(builtins)
                return self.globals.get(name, builtins.get(name))
            case ast.Attribute(value=owner, attr=name):
                return getattr(self._object(owner), name, None)
        raise self._refuse(expression)

    def _refuse(self, node: ast.AST) -> FormulaError:
        return FormulaError(f"{self._place(node)}: formula {self.owner.__name__} cannot print {ast.unparse(node)!r}; a formula holds "
                            "assignments, one return, arithmetic, NumPy functions, constants and other formulas")  # fmt: skip

    def _place(self, node: ast.AST) -> str:
        return f"{self.function.__code__.co_filename}:{getattr(node, 'lineno', '?')}"


def evaluate(node: Node, value_of: Callable[[Node], Any]) -> Any:
    """Compute the tree as it is printed; ``value_of`` gives the SI value of ``sym`` and ``qty`` leaves."""
    match node:
        case Node("num", (text,)):
            return float(text)
        case Node("sym", ("π",)):
            return math.pi
        case Node("sym" | "qty", _):
            return value_of(node)
        case Node("call", (name, *args)):
            return NUMERIC[name](*(evaluate(a, value_of) for a in args))
        case Node("apply", (Named(formula=called), *args)):
            known = dict(zip(called.parameters, (evaluate(a, value_of) for a in args), strict=True))
            return evaluate(called.tree, lambda leaf: known[leaf.args[0]] if leaf.args[0] in known else value_of(leaf))
        case Node("cmp", (sign, left, right)):
            return APPLY[sign](evaluate(left, value_of), evaluate(right, value_of))
        case Node("cases", branches):
            return _first_that_holds(branches, value_of)
    return APPLY[node.op](*(evaluate(a, value_of) for a in node.args))


def _first_that_holds(branches: tuple[tuple[Node, ...], ...], value_of: Callable[[Node], Any]) -> Any:
    for branch in branches:
        if len(branch) == 1 or evaluate(branch[1], value_of):
            return evaluate(branch[0], value_of)
    raise ValueError("no case of the formula holds")
