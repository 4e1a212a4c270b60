"""Many curves of one abscissa as one function: their formulas' trees joined, with every common term computed once.

The function that a formula is stays what counts; this gives the same numbers to rounding, faster on large arrays. What
depends on numbers alone is computed once for each variant, what belongs to a smooth piece once for each piece.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from diecut_report.contract.binding import Binding, bound
from diecut_report.contract.steps import Choice, Step, Value
from diecut_report.expressions import NUMERIC, Formula, FormulaError, FormulaName, Node

NUMBERS, PIECES, POINTS = 0, 1, 2  # what a term depends on at most: each is computed on arrays of its own
WRITING = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide"}  # what may put its result where it belongs
SIGNS = {"^": "**", "and": "&", "or": "|"}


class Leaf(NamedTuple):
    """Hold what a program is given: a number, a flag of the piece, a curve of another origin, or the abscissa."""

    kind: str
    name: str


LEVEL = {"number": NUMBERS, "flag": PIECES, "curve": POINTS, "abscissa": POINTS}


class Program:
    """Hold curves over one abscissa, compiled; ``at_middle`` for flags of pieces, which are taken where the abscissa is and returned.

    ``numbers``, ``pieces`` and ``points`` take the values of their ``leaves`` and what the functions before them gave;
    of curves ``points`` also takes the arrays that its results are put into.
    """

    def __init__(self, curves: Mapping[str, Step], axis: str, wanted: Iterable[str], at_middle: bool) -> None:
        self._curves, self._axis, self._at_middle = curves, axis, at_middle
        self._ids: dict[tuple[Any, ...], str] = {}
        self._level: dict[str, int] = {}
        self._lines: dict[str, tuple[str, tuple[str, ...]]] = {}
        self._made: dict[str, tuple[str, ...]] = {}  # of each term the operation and what it takes
        self._quantities: dict[str, str] = {}
        self._leaves: dict[str, Leaf] = {}
        results = [self._quantity(name) for name in wanted]
        needed = self._needed(results)
        self._lines = {own: line for own, line in self._lines.items() if own in needed}
        self.leaves = tuple(
            {name: leaf for name, leaf in self._leaves.items() if name in needed and LEVEL[leaf.kind] == level}
            for level in range(3)
        )
        self.carried = self._carried(results)
        self.numbers = self._function(NUMBERS, (), self.carried[NUMBERS])
        self.pieces = self._function(PIECES, self.carried[NUMBERS], self.carried[PIECES])
        given = (*self.carried[NUMBERS], *self.carried[PIECES])
        returned, into = (tuple(results), ()) if at_middle else ((), tuple(results))
        self.points = self._function(POINTS, given, returned, into)

    # --- joining the trees ---------------------------------------------------------------------------------------------

    def _quantity(self, name: str | float) -> str:
        if not isinstance(name, str):
            return self._constant(name)
        if name not in self._quantities:
            self._quantities[name] = self._declared(name)
        return self._quantities[name]

    def _declared(self, name: str) -> str:
        if name == self._axis:
            return self._leaf("abscissa", name)
        step = self._curves.get(name)
        match step:
            case None:
                return self._leaf("number", name)
            case Value(per_piece=True) | Choice(per_piece=True) if not self._at_middle:
                return self._leaf("flag", name)
            case Value(formula=part) if _has_tree(part):
                return self._formula(part)
            case Choice(cases=cases) if all(_has_tree(part) for c in cases for part in (c.value, c.condition) if part):
                *first, last = ((c.condition, c.value) for c in cases)
                result = self._formula(last[1])
                for condition, value in reversed(first):
                    result = self._term("where", self._formula(condition), self._formula(value), result)
                return result
        return self._leaf("curve", name)

    def _formula(self, part: Any) -> str:
        link = bound(_binding(part))
        known = {parameter: self._quantity(name) for parameter, name in link.names.items()}
        return self._tree(link.formula, known)

    def _tree(self, formula: Formula, known: Mapping[str, str]) -> str:
        """The term that a formula gives, its parameters being known."""
        constants = {symbol: self._constant(float(value)) for symbol, value in formula.constants.items()}
        return self._node(formula.tree, {"π": self._constant(np.pi)} | constants | dict(known))

    def _node(self, node: Node, known: Mapping[str, str]) -> str:
        match node:
            case Node("num", (text,)):
                return self._constant(float(text))
            case Node("sym", (symbol,)):
                return known[symbol]
            case Node("apply", (FormulaName(formula=called), *args)):
                own = dict(zip(called.parameters, (self._node(part, known) for part in args), strict=True))
                return self._tree(called, own)
            case Node("call", (name, *args)):
                return self._call(name, *(self._node(part, known) for part in args))
            case Node("cmp", (sign, left, right)):
                return self._term(sign, self._node(left, known), self._node(right, known))
            case Node("cases", (*branches, (otherwise,))):
                result = self._node(otherwise, known)
                for value, condition in reversed(branches):
                    result = self._term("where", self._node(condition, known), self._node(value, known), result)
                return result
        return self._term(node.op, *(self._node(part, known) for part in node.args))

    def _call(self, name: str, *args: str) -> str:
        if name == "arccos":
            return self._term(name, self._term("cosine", *args))
        if name not in ("sin", "cos") or self._level.get(args[0], NUMBERS) < POINTS:
            return self._term(name, *args)
        return self._sine(args[0]) if name == "sin" else self._cosine(args[0])

    def _sine(self, angle: str) -> str:
        match self._made.get(angle):
            case ("neg", other):
                return self._term("neg", self._sine(other))
            case ("arccos", cosine):
                one = self._constant(1.0)
                return self._term("sqrt", self._term("*", self._term("-", one, cosine), self._term("+", one, cosine)))
        tangent, share = self._half(angle)
        return self._term("*", tangent, share)

    def _cosine(self, angle: str) -> str:
        match self._made.get(angle):
            case ("neg", other):
                return self._cosine(other)
            case ("arccos", cosine):
                return cosine
        return self._term("-", self._half(angle)[1], self._constant(1.0))

    def _half(self, angle: str) -> tuple[str, str]:
        """tan(x/2) and 2/(1 + tan²(x/2)): one tangent gives sine and cosine, and faster than either is computed."""
        tangent = self._term("tan", self._term("*", angle, self._constant(0.5)))
        over = self._term("+", self._constant(1.0), self._term("*", tangent, tangent))
        return tangent, self._term("/", self._constant(2.0), over)

    # --- terms, each once ----------------------------------------------------------------------------------------------

    def _constant(self, value: float) -> str:
        return repr(float(value)) if value >= 0 else f"({float(value)!r})"

    def _leaf(self, kind: str, name: str) -> str:
        key = ("leaf", kind, name)
        if key not in self._ids:
            self._ids[key] = own = f"given_{len(self._ids)}"
            self._level[own], self._leaves[own] = LEVEL[kind], Leaf(kind, name)
        return self._ids[key]

    def _term(self, op: str, *args: str) -> str:
        match op, *(self._made.get(arg, arg) for arg in args):
            case "^", _, "2.0":
                return self._term("*", args[0], args[0])
            case "-", _, ("+", *parts) if args[0] in parts:  # a - (a + b)
                parts.remove(args[0])
                return self._term("neg", parts[0])
        key = (op, *args)
        if key not in self._ids:
            self._ids[key] = own = f"term_{len(self._ids)}"
            self._level[own] = max((self._level.get(a, NUMBERS) for a in args), default=NUMBERS)
            self._lines[own], self._made[own] = (_written(op, args), args), key
        return self._ids[key]

    def _needed(self, results: list[str]) -> set[str]:
        """What results are made of: a sine may be known without its angle."""
        needed = set(results)
        for own, (_, args) in reversed(self._lines.items()):
            needed |= set(args) if own in needed else set()
        return needed

    def _carried(self, results: list[str]) -> tuple[tuple[str, ...], ...]:
        """The terms of each level that a later level takes."""
        taken: dict[str, None] = dict.fromkeys(r for r in results if r in self._level and self._level[r] < POINTS)
        for own, (_, args) in self._lines.items():
            taken |= dict.fromkeys(a for a in args if a in self._level and self._level[a] < self._level[own])
        return tuple(tuple(name for name in taken if self._level[name] == level) for level in (NUMBERS, PIECES))

    def _function(
        self, level: int, carried: tuple[str, ...], results: tuple[str, ...], into: tuple[str, ...] = ()
    ) -> Callable[..., Any]:
        """The terms of a level as one function; its results are returned, or put into arrays that are given."""
        own = {name: line for name, line in self._lines.items() if self._level[name] == level}
        last = {arg: name for name, (_, args) in own.items() for arg in args if arg in own}
        home = {name: f"into_{i}" for i, name in enumerate(into) if name in own and self._made[name][0] in WRITING}
        body = []
        for name, (text, args) in own.items():
            put = f"{WRITING[self._made[name][0]]}({', '.join(args)}, out={home[name]})" if name in home else text
            done = [arg for arg, user in last.items() if user == name and arg not in (*results, *into)]
            body += [f"    {name} = {put}", *([f"    del {', '.join(done)}"] if done else [])]
        body += [f"    into_{i}[...] = {name}" for i, name in enumerate(into) if home.get(name) != f"into_{i}"]
        given = ", ".join([*self.leaves[level], *carried, *(f"into_{i}" for i in range(len(into)))])
        source = "\n".join([f"def run({given}):", *body, f"    return ({''.join(f'{r}, ' for r in results)})"])
        space = dict(SPACE)
        exec(compile(source, "<formulas>", "exec"), space)
        run: Callable[..., Any] = space["run"]
        return run


def _binding(part: Any) -> Binding:
    assert not isinstance(part, str), "a curve has no texts"
    found: Binding = part
    return found


def _has_tree(part: Any) -> bool:
    """Whether a formula can be read; one that cannot is called as it is."""
    try:
        return bound(_binding(part)).formula.tree is not None
    except FormulaError:
        return False


def _written(op: str, args: tuple[str, ...]) -> str:
    if op == "where":
        return f"where({', '.join(args)})"
    if op == "neg":
        return f"-{args[0]}"
    if op in ("not", "cosine") or op in NUMERIC:
        return f"np_{op}({', '.join(args)})"
    return f"{args[0]} {SIGNS.get(op, op)} {args[1]}"


def _cosine(value: Any) -> Any:
    """What ``expressions.arccos`` takes the angle of, which looks at each place; most often none is beyond ±1."""
    if np.min(value) >= -1 and np.max(value) <= 1:
        return value
    return np.where(np.isnan(NUMERIC["arccos"](value)), np.nan, np.clip(value, -1, 1))


SPACE: dict[str, Any] = {
    **{f"np_{name}": function for name, function in NUMERIC.items()},
    **{name: getattr(np, name) for name in WRITING.values()},
    "where": np.where, "np_not": np.logical_not, "inf": np.inf, "nan": np.nan, "np_cosine": _cosine, "np_arccos": np.arccos,
}  # fmt: skip
"""What the text of a function may name."""


@lru_cache(maxsize=512)
def program(curves: tuple[tuple[str, Step], ...], axis: str, wanted: tuple[str, ...], at_middle: bool) -> Program:
    """Return the compiled curves, kept for the next chunk of variants."""
    return Program(dict(curves), axis, wanted, at_middle)
