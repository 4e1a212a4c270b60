"""A formula: a function that computes, and whose own syntax tree prints."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable
from decimal import Decimal
from functools import cached_property
from typing import Any, NamedTuple, overload

import numpy as np

from diecut_report.expressions.functions import BINARY, COMPARE, FUNCTIONS, OF_TWO, PI, SAID, Constant
from diecut_report.expressions.hints import instead
from diecut_report.expressions.source import FormulaError, Unreadable, body, given_to, perhaps_named, place
from diecut_report.expressions.tree import Node, substitute
from diecut_report.languages.phrases import Phrase, joined

GREAT, SHORT = (
    1e5,
    4,
)  # a number from which zeros are not counted, and letters of what then stands before the power of ten


class Formula:
    """Compute and print a function; see the module's text. ``printed_as`` is the name by which calls of it print."""

    def __init__(self, function: Callable[..., Any], name: str = "", printed_as: str = "") -> None:
        self._function, self.printed_as = function, printed_as
        self.__name__ = name or function.__name__
        self.__doc__ = function.__doc__
        self.__module__ = function.__module__
        self._readings: dict[bool, Reading] = {}

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
        """Return where it is written, as ``file:line``."""
        return place(self._function)

    @property
    def tree(self) -> Node:
        """Return the expression that the formula returns; its parameters stand as ``("sym", (name,))``."""
        return self.reading().tree

    @property
    def full_tree(self) -> Node:
        """Return the expression with all that is said by ``as_number`` and ``as_angle``, which is checked but not printed."""
        return self.reading(full=True).tree

    @property
    def constants(self) -> dict[str, Constant]:
        """Return the physical constants that the body names, by the symbol they print with."""
        return self.reading().constants

    def reading(self, above: tuple[Formula, ...] = (), *, full: bool = False) -> Reading:
        """Return what the body says; ``above`` are the formulas in whose bodies it is called, ``full`` as for ``full_tree``."""
        if full not in self._readings:
            if self in above:
                chain = " → ".join(each.__name__ for each in (*above[above.index(self) :], self))
                raise FormulaError(Phrase("{place}: formula {name} calls itself ({chain}) and would never end; give the formula another "
"name than what it calls", place=self.place, name=self.__name__, chain=chain))  # fmt: skip
            self._readings[full] = _BodyReader(self, above, full).read()
        return self._readings[full]


class Reading(NamedTuple):
    """What a formula's body says: its expression, and the constants in it by their symbols."""

    tree: Node
    constants: dict[str, Constant]


class FormulaName(str):
    """The name by which a formula is called in print, and the formula."""

    formula: Formula

    def __new__(cls, formula: Formula) -> FormulaName:
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
    return Formula(function) if function is not None else lambda own: Formula(own, printed_as=printed_as)


class _BodyReader:
    """Reads one formula's body into a tree."""

    def __init__(self, owner: Formula, above: tuple[Formula, ...], full: bool) -> None:
        self.owner, self.above, self.full = owner, above, full
        self.function = owner._function
        self.globals = self.function.__globals__
        self.locals: dict[str, Node] = {name: Node("sym", (name,)) for name in owner.parameters}
        self.constants: dict[str, Constant] = {}

    def read(self) -> Reading:
        for statement in self._statements():
            match statement:
                case ast.Return(value=ast.expr() as value):
                    return Reading(self._node(value), self.constants)
                case ast.Assign(targets=[ast.Name(id=name)], value=value):
                    self.locals[name] = self._node(value)
                case ast.Expr(value=ast.Constant(value=str())):
                    continue  # the docstring
                case _:
                    raise self._refuse(statement)
        raise FormulaError(
            Phrase("{place}: formula {name} returns nothing", place=self.owner.place, name=self.owner.__name__)
        )

    def _statements(self) -> list[ast.stmt]:
        try:
            return body(self.function.__code__)
        except Unreadable as error:
            words = Phrase(
                "{place}: the source of formula {name} cannot be read: {error}",
                place=self.owner.place,
                name=self.owner.__name__,
                error=error,
            )
            raise FormulaError(words) from None

    def _node(self, expression: ast.expr) -> Node:
        match expression:
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
                return Node("num", (_literal(value),))
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
            self._counted(FUNCTIONS[callee], args, at)
            return Node("call", (FUNCTIONS[callee], *args))
        if callee in SAID and len(args) == 1:
            return Node("call", (SAID[callee], *args)) if self.full else args[0]
        raise self._refuse(at)

    def _counted(self, name: str, args: tuple[Node, ...], at: ast.Call) -> None:
        """FormulaError where a function is called with more or fewer than it takes."""
        wanted = 2 if name in OF_TWO else 1
        if len(args) != wanted:
            raise FormulaError(
                Phrase(
                    "{place}: formula {name} calls {called} with {count}, in {call}; it takes {wanted}",
                    place=self._place(at),
                    name=self.owner.__name__,
                    called=ast.unparse(at.func),
                    count=len(args),
                    call=repr(ast.unparse(at)),
                    wanted=wanted,
                )
            )

    def _called(self, callee: Formula, args: tuple[Node, ...], at: ast.Call) -> Node:
        """A call of another formula: its expression in place of the call, or its name with what it is given."""
        reading = callee.reading((*self.above, self.owner), full=self.full)
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
        by_name = callee.printed_as and not self.full
        return Node("apply", (FormulaName(callee), *nodes.values())) if by_name else substitute(reading.tree, nodes)

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
        value = self._object(node) if isinstance(node, ast.Name) else None
        words = Phrase(
            "formula {name} cannot print {node}; {instead}",
            name=self.owner.__name__,
            node=repr(ast.unparse(node)),
            instead=instead(node, value),
        )
        return FormulaError(joined((self._place(node), words), ": "))

    def _place(self, node: ast.AST) -> str:
        return f"{self.function.__code__.co_filename}:{getattr(node, 'lineno', '?')}"


def _literal(value: float) -> str:
    """A number of a formula's body as it is printed: a great power of ten as such, not with its zeros and a decimal."""
    text = repr(value)
    if not text.endswith(".0") or abs(value) < GREAT:
        return text
    mantissa, power = f"{Decimal(value).normalize():e}".split("e")
    return f"{mantissa}e{int(power)}" if len(mantissa) < SHORT else f"{value:.0f}"
