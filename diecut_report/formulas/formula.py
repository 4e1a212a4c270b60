"""A formula: what an author writes of quantities, as a tree that is printed and as a function that computes it."""

from __future__ import annotations

import inspect
import math
import reprlib
from collections.abc import Callable, Iterable
from functools import cached_property
from inspect import Parameter
from threading import RLock
from typing import Any, overload

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas.expression import Constant, Expression, FormulaError, Symbol, failed_at, m, node_of, refuse
from diecut_report.formulas.tree import (
    APPLY,
    LEAVES,
    NUMERIC,
    PI,
    SAID,
    SIGNS,
    Node,
    substitute,
    symbols,
    transform,
    unsaid,
    walk,
)
from diecut_report.text.phrases import Phrase, phrase

TRACING = RLock()  # two threads that follow one formula would each take the other for a call of itself


class Formula:
    """Compute and print a function of quantities; its parameters are named for what it takes (SI).

    Given numbers it computes, given expressions it is part of another formula: printed in place of the call, or by its name with
    ``printed_as``. Its tree is made on first use by calling the function with expressions.
    """

    def __init__(self, function: Callable[..., Any], name: str = "", printed_as: str = "") -> None:
        self._function, self.printed_as = function, printed_as
        self.__name__ = name or function.__name__
        self.__doc__ = function.__doc__
        self.__module__ = function.__module__
        self._is_traced = False

    def __call__(self, *args: Any, **given: Any) -> Any:
        """Return the value of numbers, or the expression of expressions."""
        taken = self._taken(args, given)
        if not any(isinstance(each, Expression) for each in taken):
            return self.function(*taken)
        self._refuse_texts(taken)
        _ = self.spoken  # what it cannot hold is told where it stands
        if self.printed_as:
            return Expression(Node("apply", (FormulaName(self), *map(node_of, taken))))
        return self._traced(*args, **given)

    def _taken(self, args: tuple[Any, ...], given: dict[str, Any]) -> tuple[Any, ...]:
        """What the parameters take in a call, in their order."""
        if not given and len(args) == len(self.parameters):
            return args
        try:
            taken = inspect.signature(self._function).bind(*args, **given)
        except TypeError as error:
            template = "formula {name}: {error}; it takes {known}"
            refuse(Phrase(template, name=self.__name__, error=error, known=self._told_parameters))
        taken.apply_defaults()
        return tuple(taken.arguments.values())

    def of(self, **given: Any) -> Expression:
        """Return the expression of other quantities; a parameter that is not given takes the quantity of its own name."""
        self._refuse_parameters(defaults=True)
        if unknown := sorted(set(given) - set(self.parameters)):
            template = "formula {name} has no parameter {unknown}{near}; it takes {known}"
            near = nearest(unknown[0], self.parameters)
            named = {"name": self.__name__, "unknown": ", ".join(unknown), "near": near, "known": self._told_parameters}
            refuse(Phrase(template, named))
        self._refuse_texts(given.values())
        _ = self.spoken
        taken = {name: given.get(name, m[name]) for name in self.parameters}
        if self.printed_as:
            return Expression(Node("apply", (FormulaName(self), *map(node_of, taken.values()))))
        return Expression(whole(self._traced(**taken)))

    def renamed(self, rename: Callable[[str], str]) -> Formula:
        """Return the formula of quantities with other ids."""
        return WrittenFormula(Expression(renamed(self.spoken, rename)), self.__name__, self.place)

    def _traced(self, *args: Any, **given: Any) -> Any:
        with TRACING:
            return self._followed(*args, **given)

    def _followed(self, *args: Any, **given: Any) -> Any:
        if self._is_traced:
            template = (
                "formula {name} calls itself and would never end; give the formula another name than what it calls"
            )
            raise FormulaError(Phrase(template, name=self.__name__), self.place)
        self._is_traced = True
        try:
            found = self._function(*args, **given)
        except FormulaError:
            raise
        except Exception as error:
            template = "formula {name} cannot be followed: {kind}: {error}"
            told = {"name": self.__name__, "kind": type(error).__name__, "error": error}
            raise FormulaError(Phrase(template, told), failed_at(error) or self.place) from error
        finally:
            self._is_traced = False
        if not isinstance(found, Expression | int | float | np.number):
            template = "formula {name} gives {found}, no expression; return one of what it takes"
            raise FormulaError(Phrase(template, name=self.__name__, found=reprlib.repr(found)), self.place)
        return found

    @property
    def _told_parameters(self) -> str:
        return ", ".join(self.parameters) or phrase("nothing")

    def _refuse_texts(self, taken: Iterable[Any]) -> None:
        for each in taken:
            if isinstance(each, str):
                node_of(each)

    def _refuse_parameters(self, *, defaults: bool) -> None:
        """Raise FormulaError where a parameter does not take one quantity: with a star, or, where it takes one anyway, with a default."""
        own = inspect.signature(self._function).parameters.values()
        stars = {Parameter.VAR_POSITIONAL: "*", Parameter.VAR_KEYWORD: "**"}
        unlike = [f"{stars[each.kind]}{each.name}" for each in own if each.kind in stars]
        unlike += self.defaults if defaults else ()
        if unlike:
            template = "formula {name} has the parameter {unlike}; each takes one quantity: name it alone, without a star and without a default"
            raise FormulaError(Phrase(template, name=self.__name__, unlike=", ".join(unlike)), self.place)

    @cached_property
    def function(self) -> Callable[..., Any]:
        """The function that computes the tree, of what the parameters take in their order."""
        return compiled(self.spoken, self.parameters)

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """The names of what the formula takes."""
        code = self._function.__code__
        return code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]

    @property
    def defaults(self) -> tuple[str, ...]:
        """Return the parameters that have a default, which another formula may leave out."""
        return tuple(p.name for p in inspect.signature(self._function).parameters.values() if p.default is not p.empty)

    @property
    def place(self) -> str:
        """Return where it is written, as ``file:line``."""
        code = inspect.unwrap(self._function).__code__
        return f"{code.co_filename}:{code.co_firstlineno}"

    @cached_property
    def spoken(self) -> Node:
        """The tree with all that is said by ``as_number`` and ``as_angle``, calls of named formulas as such."""
        self._refuse_parameters(defaults=False)
        tree = whole(self._traced(**{name: Expression(Node("sym", (Taken(name),))) for name in self.parameters}))
        own = (leaf.args[0] for leaf in walk(tree) if leaf.op == "sym")
        if others := [name for name in own if is_id(name) and not isinstance(name, Taken)]:
            template = "formula {name} takes {others} beside its parameters; make it one of them, or write an expression where it is used"
            raise FormulaError(
                Phrase(template, name=self.__name__, others=", ".join(f"m.{each}" for each in others)), self.place
            )
        return transform(
            tree, lambda leaf: Node(leaf.op, (str(leaf.args[0]),)) if isinstance(leaf.args[0], Taken) else leaf
        )

    @cached_property
    def tree(self) -> Node:
        """The expression that is printed; its parameters stand as ``("sym", (name,))``."""
        return unsaid(self.spoken)

    @cached_property
    def full_tree(self) -> Node:
        """The expression with all that is said, and with the expressions of named formulas in place of their calls."""
        tree: Node = written_out(self.spoken)
        return tree

    @cached_property
    def constants(self) -> dict[str, Constant]:
        """The physical constants in it, by the symbol they print with."""
        own = [leaf.args[0] for leaf in walk(self.full_tree) if leaf.op == "sym"]
        found = {str(symbol): symbol.constant for symbol in own if isinstance(symbol, Symbol)}
        if double := found.keys() & {*self.parameters, *filter(is_id, own)}:
            template = "{name} takes a quantity {symbol} and a constant of this symbol; give the constant another one"
            raise FormulaError(Phrase(template, name=self.__name__, symbol=", ".join(sorted(double))), self.place)
        for symbol in filter(lambda each: isinstance(each, Symbol), own):
            if (one := float(symbol.constant)) != (other := float(found[symbol])):
                template = (
                    "{name} has two constants with the symbol {symbol}, {one} and {other}; give one of them another"
                )
                raise FormulaError(
                    Phrase(template, name=self.__name__, symbol=symbol, one=f"{one:g}", other=f"{other:g}"), self.place
                )
        return found


def whole(written: Any) -> Node:
    """Return the tree of a whole formula, which may be a condition that always or never holds."""
    if isinstance(written, bool):
        return Node("cmp", (">=", *(Node("num", (text,)) for text in (str(int(written)), "1"))))
    return node_of(written)


class Taken(str):
    """Mark a name that a function takes, where it is followed, from those of quantities that it takes beside them."""


class FormulaName(str):
    """Hold the name by which a formula is called in print, and the formula."""

    formula: Formula

    def __new__(cls, formula: Formula) -> FormulaName:
        self = super().__new__(cls, formula.printed_as)
        self.formula = formula
        return self


def written_out(node: Any) -> Any:
    """Return a tree with the expressions of named formulas in place of their calls."""
    match node:
        case Node("apply", (FormulaName(formula=called), *args)):
            return substitute(called.full_tree, dict(zip(called.parameters, map(written_out, args), strict=True)))
        case Node(op, args):
            return node if op in LEAVES else Node(op, tuple(map(written_out, args)))
        case tuple():
            return tuple(map(written_out, node))
    return node


@overload
def formula(function: Callable[..., Any], /) -> Formula: ...
@overload
def formula(*, printed_as: str) -> Callable[[Callable[..., Any]], Formula]: ...
def formula(
    function: Callable[..., Any] | None = None, /, *, printed_as: str = ""
) -> Formula | Callable[[Callable[..., Any]], Formula]:
    """Mark a function as a formula (see ``Formula``).

    With ``printed_as="k_t"`` a formula that calls it prints ``k_t(r/d)``, and its definition once below; without, its
    expression stands in place of the call.
    """
    return Formula(function) if function is not None else lambda own: Formula(own, printed_as=printed_as)


def renamed(node: Node, rename: Callable[[str], str]) -> Node:
    """Return a tree with other ids for its quantities."""
    return substitute(node, {name: Node("sym", (rename(name),)) for name in symbols(node) if is_id(name)})


def is_id(name: str) -> bool:
    """Return whether a name in a tree is that of a quantity, not a constant's symbol."""
    return name != PI.args[0] and not isinstance(name, Symbol)


class WrittenFormula(Formula):
    """Hold an expression of quantities as a formula: it takes them by their ids, and the function that computes is made of its tree."""

    def __init__(self, expression: Any, name: str, place: str) -> None:
        self.spoken = whole(expression)
        self.__name__, self.printed_as, self.__doc__, self._place = name, "", None, place

    @property
    def place(self) -> str:
        return self._place

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        own = (leaf.args[0] for leaf in walk(self.spoken) if leaf.op == "sym")
        return tuple(dict.fromkeys(filter(is_id, own)))

    @property
    def defaults(self) -> tuple[str, ...]:
        return ()


# Computing a tree: as a function of its own, and as it is printed.


def compiled(tree: Node, parameters: tuple[str, ...]) -> Callable[..., Any]:
    """Return the function that computes a tree; what is one part of it in several places is computed once."""
    writer = _FunctionWriter(tree, parameters)
    space: dict[str, Any] = {f"_{name}": function for name, function in NUMERIC.items()}
    space |= {"_where": np.where, "_not": np.logical_not, "_of": writer.called}
    exec(compile(writer.source, "<formula>", "exec"), space)
    function: Callable[..., Any] = space["computed"]
    return function


class _FunctionWriter:
    """Write a tree as Python."""

    def __init__(self, tree: Node, parameters: tuple[str, ...]) -> None:
        self.names = {name: f"x{index}" for index, name in enumerate(parameters)}
        self.uses: dict[int, int] = {}
        self.shared: dict[int, str] = {}
        self.lines: list[str] = []
        self.called: list[Callable[..., Any]] = []
        self._count(tree)
        result = self._of(tree)
        lines = "".join(f"    {line}\n" for line in (*self.lines, f"return {result}"))
        self.source = f"def computed({', '.join(self.names.values())}):\n{lines}"

    def _count(self, part: Any) -> None:
        if type(part) is Node and part.op not in LEAVES:
            self.uses[id(part)] = self.uses.get(id(part), 0) + 1
            if self.uses[id(part)] > 1:
                return
        if isinstance(part, tuple):
            for each in part:
                self._count(each)

    def _of(self, node: Node) -> str:
        if self.uses.get(id(node), 0) < 2:
            return self._written(node)
        if id(node) not in self.shared:
            written = self._written(node)
            self.shared[id(node)] = name = f"s{len(self.shared)}"
            self.lines.append(f"{name} = {written}")
        return self.shared[id(node)]

    def _written(self, node: Node) -> str:
        match node:
            case Node("num", (text,)):
                return str(text)
            case Node("sym", (Symbol(constant=constant),)):
                return repr(float(constant))
            case Node("sym", ("π",)):
                return repr(math.pi)
            case Node("sym", (name,)):
                return self.names[name]
            case Node("call", (name, *args)):
                inner = ", ".join(map(self._of, args))
                return inner if name in SAID else f"_{name}({inner})"
            case Node("apply", (FormulaName(formula=called), *args)):
                self.called.append(called.function)
                return f"_of[{len(self.called) - 1}]({', '.join(map(self._of, args))})"
            case Node("cases", (*branches, (otherwise,))):
                return self._where(branches, otherwise)
            case Node("cmp", (sign, left, right)):
                return f"({self._of(left)} {sign} {self._of(right)})"
            case Node("neg", (inner,)):
                return f"(-{self._of(inner)})"
            case Node("not", (inner,)):
                return f"_not({self._of(inner)})"
        return f"({f' {SIGNS.get(node.op, node.op)} '.join(map(self._of, node.args))})"

    def _where(self, branches: list[Any], otherwise: Node) -> str:
        found = self._of(otherwise)
        for value, condition in reversed(branches):
            found = f"_where({self._of(condition)}, {self._of(value)}, {found})"
        return found


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
