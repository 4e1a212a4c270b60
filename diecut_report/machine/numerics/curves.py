"""Curves at given places of their abscissa: each computed once from those that it takes, or compiled, in blocks, where there is much to compute."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import FormulaError
from diecut_report.formulas.formula import Formula, FormulaName
from diecut_report.formulas.tree import NUMERIC, SIGNS, Node
from diecut_report.machine.numerics.domain import CalculatedMachines, Inside
from diecut_report.mechanism.names import Written, formula_of
from diecut_report.mechanism.steps import Choice, Step, Value


class CurveSampler:
    """Give curves at given places of their abscissa; each is computed once.

    ``inside`` are the middles of all pieces (rows, pieces) and which of them each place lies in, where there are more places than pieces.
    """

    def __init__(
        self,
        owner: CalculatedMachines,
        axis: str,
        x: Array,
        middle: Array,
        rows: Array | None,
        inside: Inside | None = None,
    ) -> None:
        self.owner, self.axis, self.x, self.mid, self.inside = owner, axis, x, middle, inside
        self.rows = rows if owner.count > 1 else None  # a single machine's numbers broadcast to all rows
        self.known: dict[str, Array] = {axis: x}

    def __getitem__(self, name: str) -> Array:
        found = self.known.get(name)
        if found is None:
            found = self.known[name] = self._compute(name)
        return found

    def over(self, name: str) -> Array:
        """Return a curve, or a number, at each of the places."""
        found = self[name]
        if np.shape(found) == self.x.shape:
            return found
        return np.broadcast_to(found, np.broadcast_shapes(np.shape(found), np.shape(self.x)))

    def _compute(self, name: str) -> Array:
        step = self.owner.curves.get(name)
        if step is None:
            number = self.owner[name]
            return number if self.rows is None else number[self.rows]
        return step.curve(self)

    def of_pieces(self, name: str) -> Array:
        """Return a flag of the pieces, at their middles."""
        if self._present is not None:
            pieces, own = self._present
            found: Array = pieces.over(name)[0].take(own)
            return found
        if self.inside is None:
            return self._at_middles[name]
        return np.take_along_axis(self._at_middles.over(name), self.inside[1], axis=1)

    @cached_property
    def _present(self) -> tuple[CurveSampler, Array] | None:
        """What gives the flags of all present pieces of a single machine, each computed once, and which of these each place lies in.

        None of many machines, and where a place lies in a piece that is not there any more.
        """
        if self.owner.count > 1:
            return None
        pieces = self.owner.of_pieces(self.axis)
        own = pieces.mid[0].searchsorted(self.mid)
        return (pieces, own) if np.array_equal(pieces.mid[0].take(own, mode="clip"), self.mid) else None

    @cached_property
    def _at_middles(self) -> CurveSampler:
        middles = self.mid if self.inside is None else self.inside[0]
        return CurveSampler(self.owner, self.axis, middles, middles, self.rows)

    def apply(self, part: Written) -> Array:
        """Return what a formula gives at the places."""
        formula, known = formula_of(part), self.known
        found: Array = formula.function(*[known[n] if n in known else self[n] for n in formula.parameters])
        return found


# A curve that is given as a list of values.


@dataclass(frozen=True)
class SampledCurve:
    """Hold a curve given as equally spaced values over one period; between them it runs straight."""

    numbers: tuple[float, ...]

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares of the period, of any shape (all variants have the same curve, which has no jumps)."""
        places = np.arange(len(self.numbers) + 1) / len(self.numbers)
        found: Array = np.interp(share % 1, places, [*self.numbers, self.numbers[0]])
        return found

    @property
    def breakpoints(self) -> Array:
        return np.arange(len(self.numbers))[None, :] / len(self.numbers)

    joints = breakpoints
    cycle = "list"  # of values, over whatever takes it
    rate = np.zeros((1, 1))  # which nothing tells
    turns = np.ones((1, 1))

    def gain(self, rows: Array | None) -> Array:
        """Return nothing: the curve closes."""
        return np.zeros((1, 1))


# Many curves of one abscissa as one function: their formulas' trees joined, with every common term computed once.
#
# The function that a formula is stays what counts; this gives the same numbers to rounding, faster on large arrays. What
# depends on numbers alone is computed once for each variant, what belongs to a smooth piece once for each piece.


NUMBERS, PIECES, POINTS = 0, 1, 2  # what a term depends on at most: each is computed on arrays of its own
WRITING = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide"}  # what may put its result where it belongs


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

    # Joining the trees.

    def _quantity(self, name: str) -> str:
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
        formula = formula_of(part)
        return self._tree(formula, {name: self._quantity(name) for name in formula.parameters})

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

    # Terms, each once.

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


def _has_tree(part: Any) -> bool:
    """Whether a formula can be read; one that cannot is called as it is."""
    try:
        return formula_of(part).tree is not None
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


BLOCK = 16384  # places at once
NARROW = 4  # places a row up to which it is faster to take them in turn, each for all rows
MANY = 8  # variants from which compiling pays


Flags = Callable[[tuple[str, ...]], list[Array]]  # of names, a column (rows, 1) for each


class Curves:
    """Hold curves in smooth pieces, a row for each: the middle (rows,) of the piece and the machine ``variant`` (rows,) it belongs to.

    ``flags`` gives flags of these pieces where they are known already.
    """

    def __init__(
        self,
        calc: CalculatedMachines,
        axis: str,
        wanted: Sequence[str],
        middle: Array,
        variant: Array,
        flags: Flags | None = None,
    ) -> None:
        self.calc, self.axis, self.wanted, self.middle, self.variant = calc, axis, tuple(wanted), middle, variant
        self.program: Program | None = None
        if calc.count >= MANY:
            self.program = _program(calc, axis, self.wanted, at_middle=False)
            self.numbers = _numbers(calc, self.program)
            self.pieces = _Columns(self._of_pieces(self.program, flags) if self.program.carried[PIECES] else ())

    def at(self, x: Array, rows: Array | slice = slice(None)) -> list[Array]:
        """Return the curves at x (rows, points), in these of the rows (default all)."""
        middle, variant = self.middle[rows][:, None], self.variant[rows]
        if self.program is None:
            sampler = self.calc.sampler_of(self.axis, x, middle, variant)
            return [_filled(x.shape, sampler[name]) for name in self.wanted]
        chosen = np.arange(len(self.middle))[rows] if self.pieces.tables else variant
        found = [np.empty(x.shape) for _ in self.wanted]
        if 1 < x.shape[1] <= NARROW:
            for i in range(x.shape[1]):
                for values, column in zip(found, self.at(x[:, [i]], rows), strict=True):
                    values[:, i] = column[:, 0]
            return found
        size = max(1, BLOCK // x.shape[1])
        for start in range(0, len(x), size):
            part = slice(start, start + size)
            given = _given(self.calc, self.axis, self.program, x[part], middle[part], variant[part])
            carried = [*self.numbers.of(variant[part]), *self.pieces.of(chosen[part])]
            self.program.points(*given, *carried, *(result[part] for result in found))
        return found

    def _of_pieces(self, program: Program, flags: Flags | None) -> Sequence[Any]:
        """What belongs to a piece as a whole."""
        names = tuple(leaf.name for leaf in program.leaves[PIECES].values())
        known = flags(names) if flags else flags_of(self.calc, self.axis, names, self.middle, self.variant)
        found: Sequence[Any] = program.pieces(*known, *self.numbers.of(self.variant))
        return found


def several(
    calc: CalculatedMachines,
    axis: str,
    wanted: Sequence[str],
    x: Array,
    middle: Array,
    inside: Inside | None,
    rows: Array | None,
) -> list[Array]:
    """Return curves of variants (default all) at x (rows, points), with what they have in common computed once."""
    own = np.arange(calc.count) if rows is None else rows
    if calc.count >= MANY and middle.shape == (len(own), 1) and len(own) == len(x):
        return Curves(calc, axis, wanted, middle[:, 0], own).at(x)
    found = calc.sampler_of(axis, x, middle, rows, inside)
    return [_filled(np.broadcast_shapes(np.shape(found[name]), x.shape), found[name]) for name in wanted]


def _filled(shape: tuple[int, ...], values: Array) -> Array:
    """A new array of a shape, filled with values that stand for all of it or for a column."""
    made = np.empty(shape)
    made[...] = values
    return made


def flags_of(calc: CalculatedMachines, axis: str, names: tuple[str, ...], middle: Array, variant: Array) -> list[Array]:
    """Return the flags of pieces, taken at their middles; (rows, 1) each."""
    if not names:
        return []
    own, places = _program(calc, axis, names, at_middle=True), middle[:, None]
    numbers = _numbers(calc, own).of(variant)
    found = own.points(*_given(calc, axis, own, places, places, variant), *numbers)
    return [np.broadcast_to(flag, places.shape) for flag in found]


class _Columns:
    """Columns (rows, 1) and plain numbers, to be taken by rows together."""

    def __init__(self, values: Sequence[Any]) -> None:
        self.values = list(values)
        self.tables: list[tuple[list[int], Array]] = []
        columns = {i: value for i, value in enumerate(values) if isinstance(value, np.ndarray) and value.ndim}
        for kind in dict.fromkeys(value.dtype for value in columns.values()):  # numbers, flags, counts
            own = [i for i, value in columns.items() if value.dtype == kind]
            self.tables.append((own, np.stack([values[i][:, 0] for i in own])))

    def of(self, rows: Array) -> list[Any]:
        """These rows of the columns, in the columns' order."""
        found = list(self.values)
        for own, table in self.tables:
            for i, column in zip(own, table.take(rows, axis=1)[:, :, None], strict=True):
                found[i] = column
        return found


def _program(calc: CalculatedMachines, axis: str, wanted: tuple[str, ...], *, at_middle: bool) -> Program:
    return program(tuple(calc.curves.items()), axis, wanted, at_middle)


def _numbers(calc: CalculatedMachines, of: Program) -> _Columns:
    """What depends on numbers alone, a row for each machine."""
    return _Columns(of.numbers(*(calc[leaf.name] for leaf in of.leaves[NUMBERS].values())))


def _given(calc: CalculatedMachines, axis: str, of: Program, x: Array, middle: Array, variant: Array) -> list[Array]:
    leaves = of.leaves[POINTS].values()
    if all(leaf.kind == "abscissa" for leaf in leaves):
        return [x] * len(leaves)
    sampler = calc.sampler_of(axis, x, middle, variant)
    return [sampler[leaf.name] for leaf in leaves]
