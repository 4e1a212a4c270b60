"""A formula: a function that computes, and whose own syntax tree prints."""

from __future__ import annotations

import ast
import inspect
import linecache
import math
from collections.abc import Callable, Iterator
from decimal import Decimal
from functools import cached_property
from textwrap import dedent
from types import CodeType, ModuleType
from typing import Any, NamedTuple, overload

import numpy as np

from diecut_report.formulas.tree import (
    APPLY,
    BINARY,
    COMPARE,
    FUNCTIONS,
    NUMERIC,
    OF_TWO,
    PI,
    SAID,
    Constant,
    Node,
    substitute,
)
from diecut_report.text.phrases import Phrase, joined, phrase

# What is known of a formula's function from its code: its body as syntax, its place, and the formulas that it may call.
#
# Only the function's own lines are read: to parse whole files costs more than a short run may.


LAMBDA = "<lambda>"
CHANGED = phrase("its place in the file holds something else; was the file changed?")
Place = tuple[int, int]  # line from 1, column from 0 in bytes


class FormulaError(TypeError):
    """A formula's body holds something that cannot be printed: a mistake of the plugin's author."""


class Unreadable(Exception):
    """The source cannot be found, or is not what runs; the text says why."""


def body(code: CodeType) -> list[ast.stmt]:
    """Return the statements of a function (of a lambda the one ``return``), with the line numbers of their file.

    Raises ``Unreadable``.
    """
    lines = linecache.getlines(code.co_filename)
    if not lines:
        raise Unreadable(phrase("there is no such file"))
    if code.co_name != LAMBDA:
        return _definition(code, lines)
    span = _span(code)  # the instructions of a lambda tell where it begins and ends, also among others on one line
    value = _number(code) if span is None else _expression(code, lines, *span)
    return [ast.copy_location(ast.Return(value), value)]


def _definition(code: CodeType, lines: list[str]) -> list[ast.stmt]:
    first, last = code.co_firstlineno, max(line for *_, line in code.co_lines() if line)
    for end in range(last, len(lines) + 1):  # brackets may close below the last line that does something
        try:
            found = ast.parse("\n" * (first - 1) + dedent("".join(lines[first - 1 : end])))
        except SyntaxError:
            continue
        definition = found.body[0]
        if isinstance(definition, ast.FunctionDef):
            return definition.body
    raise Unreadable(phrase("its lines are not a function"))


def _span(code: CodeType) -> tuple[Place, Place] | None:
    """First and last place of what a code does; None where nothing has a place, as Python 3.12 has none for a number alone."""
    begins, ends = set[Place](), set[Place]()
    for line, last_line, column, last_column in code.co_positions():
        if line and last_line and column is not None and last_column and (line, column) != (last_line, last_column):
            begins.add((line, column))
            ends.add((last_line, last_column))
    return (min(begins), max(ends)) if begins else None


def _number(code: CodeType) -> ast.expr:
    numbers = [value for value in code.co_consts if isinstance(value, int | float)]
    if len(numbers) != 1 or code.co_names or code.co_argcount:
        raise Unreadable(
            phrase("this Python was told to keep no columns (PYTHONNODEBUGRANGES); write a def with @formula")
        )
    return ast.Constant(numbers[0], lineno=code.co_firstlineno, col_offset=0)


def _expression(code: CodeType, lines: list[str], begin: Place, end: Place) -> ast.expr:
    text = _between(lines, begin, end)
    try:
        value = ast.parse("\n" * (begin[0] - 1) + f"({text}\n)", mode="eval").body
    except SyntaxError:
        raise Unreadable(CHANGED) from None
    nodes = list(ast.walk(value))
    names = {n.id for n in nodes if isinstance(n, ast.Name)} | {n.attr for n in nodes if isinstance(n, ast.Attribute)}
    if names - set(code.co_varnames) - set(code.co_freevars) != set(code.co_names):
        raise Unreadable(CHANGED)
    return value


def _between(lines: list[str], begin: Place, end: Place) -> str:
    chosen = [line.encode() for line in lines[begin[0] - 1 : end[0]]]
    chosen[-1] = chosen[-1][: end[1]]
    chosen[0] = chosen[0][begin[1] :]
    return b"".join(chosen).decode()


def perhaps_named(function: Callable[..., Any]) -> Iterator[Formula]:
    """Give the formulas that a function may name, as globals or by way of a module, at no cost.

    They may be too many: of ``np.sqrt`` the code tells no more than that both names stand in it.
    """
    space, names = function.__globals__, function.__code__.co_names
    spaces = [space, *(vars(space[name]) for name in names if isinstance(space.get(name), ModuleType))]
    for each in spaces:
        yield from (each[name] for name in names if isinstance(each.get(name), Formula))


# What to write instead of what a formula cannot hold: Python that takes one machine alone, functions that are not NumPy's.


LISTED = phrase("a formula holds assignments, one return, arithmetic, NumPy functions, constants and other formulas")
OF_NUMPY = {name: name for name in NUMERIC} | {
    "asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "asinh": "arcsinh", "acosh": "arccosh", "atanh": "arctanh",
    "min": "minimum", "max": "maximum", "fabs": "abs",
}  # fmt: skip
"""Functions as Python's own library calls them, each with its name in NumPy."""


def instead(node: ast.AST, value: object) -> str:
    """Return in words what to write instead of a part of a formula; ``value`` is what it stands for where it is a name."""
    match node:
        case ast.BoolOp(op=ast.And()):
            return phrase("write (a) & (b), each condition in brackets, which takes arrays too")
        case ast.BoolOp(op=ast.Or()):
            return phrase("write (a) | (b), each condition in brackets, which takes arrays too")
        case ast.UnaryOp(op=ast.Not()):
            return phrase("write ~(a), which takes arrays too")
        case ast.Compare(ops=[_, _, *_]):
            return phrase("write (a < b) & (b < c), which takes arrays too")
        case ast.IfExp() | ast.If():
            return phrase("write np.where(condition, a, b), which takes arrays too")
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(value=ast.Name(id="math"), attr=name)) if name in OF_NUMPY:
            return Phrase("write np.{of_numpy}, which takes arrays too", of_numpy=OF_NUMPY[name])
        case ast.Name(id=name) if isinstance(value, int | float) and not isinstance(value, bool):
            template = (
                "write the number itself, or bind it: bind(…, {name}={value}), or make it one of the constants, "
                "Constant(value, symbol, unit), which are printed with their symbols"
            )
            return Phrase(template, name=name, value=format(value, "g"))
    return LISTED


PLAIN_BELOW = 1e5  # numbers from here on are printed as a power of ten
MAX_MANTISSA_LENGTH = 4  # letters before the power of ten, less than these


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
            seen += (here := list(perhaps_named(pending.pop()._function)))
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
        code = inspect.unwrap(self._function).__code__
        return f"{code.co_filename}:{code.co_firstlineno}"

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
        template = "{place}: formula {name} returns nothing"
        raise FormulaError(Phrase(template, place=self.owner.place, name=self.owner.__name__))

    def _statements(self) -> list[ast.stmt]:
        try:
            return body(self.function.__code__)
        except Unreadable as error:
            template = "{place}: the source of formula {name} cannot be read: {error}"
            named = {"place": self.owner.place, "name": self.owner.__name__, "error": error}
            raise FormulaError(Phrase(template, named)) from None

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
                if isinstance(callee, Formula):
                    return self._called(callee, given, expression)
                return self._call(callee, given, expression)
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
        wanted, call = 2 if name in OF_TWO else 1, repr(ast.unparse(at))
        if len(args) != wanted:
            template = "{place}: formula {name} calls {called} with {count}, in {call}; it takes {wanted}"
            named = {"place": self._place(at), "name": self.owner.__name__, "called": ast.unparse(at.func)}
            raise FormulaError(Phrase(template, named, count=len(args), call=call, wanted=wanted))

    def _called(self, callee: Formula, args: tuple[Node, ...], at: ast.Call) -> Node:
        """A call of another formula: its expression in place of the call, or its name with what it is given."""
        reading = callee.reading((*self.above, self.owner), full=self.full)
        named = {word.arg: self._node(word.value) for word in at.keywords if word.arg is not None}
        if len(named) < len(at.keywords):
            raise self._refuse(at)
        try:
            given = inspect.signature(callee._function).bind(*args, **named)
        except TypeError as error:
            raise FormulaError(
                f"{self._place(at)}: formula {self.owner.__name__} calls {callee.__name__}: {error}"
            ) from None
        given.apply_defaults()
        self.constants |= reading.constants
        parts = given.arguments.items()
        nodes = {name: part if isinstance(part, Node) else Node("num", (repr(part),)) for name, part in parts}
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
        template = "formula {name} cannot print {node}; {instead}"
        message = Phrase(template, name=self.owner.__name__, node=repr(ast.unparse(node)), instead=instead(node, value))
        return FormulaError(joined((self._place(node), message), ": "))

    def _place(self, node: ast.AST) -> str:
        return f"{self.function.__code__.co_filename}:{getattr(node, 'lineno', '?')}"


def _literal(value: float) -> str:
    """A number of a formula's body as it is printed: a great power of ten as such, not with its zeros and a decimal."""
    text = repr(value)
    if not text.endswith(".0") or abs(value) < PLAIN_BELOW:
        return text
    mantissa, power = f"{Decimal(value).normalize():e}".split("e")
    return f"{mantissa}e{int(power)}" if len(mantissa) < MAX_MANTISSA_LENGTH else f"{value:.0f}"


# Computing a tree as it is printed.


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
        case Node("apply", (FormulaName(formula=called), *args)):
            known = dict(zip(called.parameters, (evaluate(a, value_of) for a in args), strict=True))
            return evaluate(called.tree, lambda leaf: known[leaf.args[0]] if leaf.args[0] in known else value_of(leaf))
        case Node("cmp", (sign, left, right)):
            return APPLY[sign](evaluate(left, value_of), evaluate(right, value_of))
        case Node("cases", branches):
            return _first_that_holds(branches, value_of)
    return APPLY[node.op](*(evaluate(a, value_of) for a in node.args))


def _first_that_holds(branches: tuple[tuple[Node, ...], ...], value_of: Callable[[Node], Any]) -> Any:
    for number, branch in enumerate(branches):
        if len(branch) == 1:
            return evaluate(branch[0], value_of)
        held = evaluate(branch[1], value_of)
        if np.ndim(held):
            return np.where(held, evaluate(branch[0], value_of), _first_that_holds(branches[number + 1 :], value_of))
        if held:
            return evaluate(branch[0], value_of)
    raise ValueError(phrase("no case of the formula holds"))
