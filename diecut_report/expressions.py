"""A formula is written once, as a small Python function: it computes, and its own syntax tree prints.

``@formula`` marks a function whose parameters are named for what it takes (SI), whose body holds assignments of
intermediate terms and one return, in plain NumPy. Calling it computes, on numbers and on arrays; ``.tree`` is what
prints. The tree is read on first use only, so that importing a plugin costs nothing for it.
"""

from __future__ import annotations

import ast
import inspect
import math
import operator
from collections.abc import Callable, Mapping
from functools import cached_property, reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report import formula_source as source
from diecut_report.formula_source import LAMBDA as LAMBDA

Array = NDArray[Any]


class Node(NamedTuple):
    """One node of an expression: an operation and its operands (nodes, or the texts of a leaf)."""

    op: str
    args: tuple[Any, ...]

    def to_json(self) -> list[Any]:
        """The node as nested lists, the form in which results hold it."""
        return [self.op, *(a.to_json() if isinstance(a, Node) else list(map(_plain, a)) if isinstance(a, tuple) else a
                           for a in self.args)]  # fmt: skip


def _plain(part: Any) -> Any:
    return part.to_json() if isinstance(part, Node) else part


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


def as_number(angle: Any) -> Any:
    """Say to the check of dimensions that the radian drops: the number of radians stands as a plain number.

    It gives back what it takes and is not printed.
    """
    return angle


def as_angle(number: Any) -> Any:
    """Say to the check of dimensions that what it takes stands as an angle in radians (1/s as rad/s, rad²/s² as rad/s²).

    It gives back what it takes and is not printed.
    """
    return number


FUNCTIONS: dict[Any, str] = {
    np.sqrt: "sqrt", np.sin: "sin", np.cos: "cos", np.tan: "tan", np.arcsin: "arcsin", np.arccos: "arccos",
    arccos: "arccos", np.arctan: "arctan", np.arctan2: "arctan2", np.exp: "exp", np.log: "log", np.abs: "abs", abs: "abs",
    np.sign: "sign", np.minimum: "minimum", np.maximum: "maximum", np.ceil: "ceil", np.floor: "floor", np.round: "round",
}  # fmt: skip
NUMERIC: dict[str, Callable[..., Any]] = {name: function for function, name in FUNCTIONS.items()}
AS_NUMBER, AS_ANGLE = "as_number", "as_angle"
SAID: dict[Any, str] = {as_number: AS_NUMBER, as_angle: AS_ANGLE}
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


class FormulaError(TypeError):
    """A formula's body holds something that cannot be printed: a mistake of the plugin's author."""


class Formula:
    """A function that computes and prints; see the module's text."""

    def __init__(self, function: Callable[..., Any], name: str = "") -> None:
        self.function = function
        self.__name__ = name or function.__name__
        self.__doc__ = function.__doc__
        self.__module__ = function.__module__

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return self.function(*args, **kwargs)

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """The names of what the formula takes."""
        code = self.function.__code__
        return code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]

    @cached_property
    def tree(self) -> Node:
        """The expression that the formula returns; its parameters stand as ``("sym", (name,))``."""
        return _Reader(self).read()

    @cached_property
    def full_tree(self) -> Node:
        """The expression with all that is said by ``as_number`` and ``as_angle``, which is checked but not printed."""
        return _Reader(self, full=True).read()

    @cached_property
    def constants(self) -> dict[str, Constant]:
        """The physical constants that the body names, by the symbol they print with."""
        names = self.function.__code__.co_names
        found = (self.function.__globals__.get(name) for name in names)
        own = {value.symbol: value for value in found if isinstance(value, Constant)}
        called = (self.function.__globals__.get(name) for name in names)
        inner: list[dict[str, Constant]] = [value.constants for value in called if isinstance(value, Formula)]
        return reduce(operator.or_, inner, own)


def formula(function: Callable[..., Any]) -> Formula:
    """Mark a function as a formula (see the module's text)."""
    return Formula(function)


class _Reader:
    """Reads one formula's body into a tree."""

    def __init__(self, owner: Formula, full: bool = False) -> None:
        self.owner, self.full = owner, full
        self.globals = owner.function.__globals__
        self.locals: dict[str, Node] = {name: Node("sym", (name,)) for name in owner.parameters}

    def read(self) -> Node:
        for statement in self._statements():
            match statement:
                case ast.Return(value=ast.expr() as value):
                    return self._node(value)
                case ast.Assign(targets=[ast.Name(id=name)], value=value):
                    self.locals[name] = self._node(value)
                case ast.Expr(value=ast.Constant(value=str())):
                    continue  # the docstring
                case _:
                    raise self._refuse(statement)
        raise FormulaError(f"formula {self.owner.__name__} returns nothing")

    def _statements(self) -> list[ast.stmt]:
        code = self.owner.function.__code__
        try:
            return source.body(code)
        except source.Unreadable as error:
            words = f"{code.co_filename}:{code.co_firstlineno}: the source of formula {self.owner.__name__} cannot be read: {error}"
            raise FormulaError(words) from None

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
            case ast.Call(func=func, args=args, keywords=[]):
                return self._call(self._object(func), tuple(map(self._node, args)), expression)
        raise self._refuse(expression)

    def _call(self, callee: Any, args: tuple[Node, ...], at: ast.expr) -> Node:
        if callee is np.where and len(args) == 3:
            otherwise = args[2].args if args[2].op == "cases" else ((args[2],),)
            return Node("cases", ((args[1], args[0]), *otherwise))
        if isinstance(callee, Formula):
            tree = callee.full_tree if self.full else callee.tree
            return substitute(tree, dict(zip(callee.parameters, args, strict=True)))
        if callee in FUNCTIONS:
            return Node("call", (FUNCTIONS[callee], *args))
        if callee in SAID and len(args) == 1:
            return Node("call", (SAID[callee], *args)) if self.full else args[0]
        raise self._refuse(at)

    def _constant(self, expression: ast.expr) -> Node:
        value = self._object(expression)
        if isinstance(value, Constant):
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
        where = f"{inspect.getfile(self.owner.function)}:{getattr(node, 'lineno', '?')}"
        return FormulaError(f"{where}: formula {self.owner.__name__} cannot print {ast.unparse(node)!r}; a formula holds "
                            "assignments, one return, arithmetic, NumPy functions, constants and other formulas")  # fmt: skip


def transform(node: Node, leaf: Callable[[Node], Node]) -> Node:
    """The tree with each leaf (``sym``, ``num``, ``qty``) replaced by ``leaf(node)``."""
    if node.op in ("sym", "num", "qty"):
        return leaf(node)
    return Node(node.op, tuple(_inner(a, lambda n: transform(n, leaf)) for a in node.args))


def _inner(part: Any, apply: Callable[[Node], Any]) -> Any:
    if isinstance(part, Node):
        return apply(part)
    return tuple(apply(p) for p in part) if isinstance(part, tuple) else part


def substitute(node: Node, values: Mapping[str, Node]) -> Node:
    """The tree with the named symbols replaced."""
    return transform(node, lambda n: values.get(n.args[0], n) if n.op == "sym" else n)


def symbols(node: Node) -> list[str]:
    """The symbols in the tree, in order of appearance, each once."""
    found: dict[str, None] = {}

    def note(leaf: Node) -> Node:
        if leaf.op == "sym":
            found[leaf.args[0]] = None
        return leaf

    transform(node, note)
    return list(found)


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
