"""Branch conditions of curves: the comparisons in their formulas, and the functions that take steps."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import FormulaError
from diecut_report.formulas.formula import Formula, evaluate, is_id
from diecut_report.formulas.tree import APPLY, Node, symbols, unsaid, walk
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.names import formula_of
from diecut_report.mechanism.steps import Accumulated, Choice, Derivative, Step, Value

STEPWISE = {
    "sign": None,
    "floor": "sin",
    "ceil": "sin",
    "round": "cos",
}  # which function of π times a number is zero at its steps
FLATTENING = {"exp", "tanh", "arctan", "minimum", "maximum", "clip", "/", "^"}  # what levels off, or has a corner

Formulas = Value | Choice
Known = Callable[[str], Array]  # values of a quantity


@dataclass(frozen=True, eq=False)
class BranchCondition:
    """Hold a part of a formula that decides between branches. Each is one object."""

    step: Formulas
    formula: Formula
    node: Node

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Return the quantities that it takes."""
        return tuple(filter(is_id, symbols(self.node)))

    @cached_property
    def meaning(self) -> Hashable:
        """Return what conditions of several formulas that change together have in common."""
        return type(self), self.node, tuple(map(self.formula.constants.get, symbols(self.node)))

    @cached_property
    def gap(self) -> Node:
        """Return what is zero where the condition changes."""
        if self.node.op == "cmp":
            return Node("-", self.node.args[1:])
        name, inner = self.node.args
        wave = STEPWISE[name]
        return inner if wave is None else Node("call", (wave, Node("*", (Node("sym", ("π",)), inner))))

    def arguments(self, varies: Callable[[str], bool]) -> tuple[Node, ...]:
        """Return what goes into its functions where one of them levels off: there it may hold in a window that the gap shows nowhere else."""
        found = [
            (str(part.args[0]) if part.op == "call" else part.op, inner)
            for part in walk(self.node)[1:]
            for inner in _taken_by(part)
            if any(varies(symbol) for symbol in symbols(inner))
        ]
        levels_off = FLATTENING.intersection(op for op, _ in found)
        return tuple(dict.fromkeys(inner for _, inner in found)) if levels_off else ()

    def sides(self, known: Known, x: Array) -> tuple[Array, Array]:
        """Return at places whether a comparison holds, or what a function that takes steps gives (infinity for no value), and the gap."""
        if self.node.op != "cmp":
            return np.nan_to_num(self.value(self.node, known, x), nan=np.inf), self.value(self.gap, known, x)
        left, right = (evaluate(part, partial(self._leaf, known)) for part in self.node.args[1:])
        holds = APPLY[self.node.args[0]](left, right)
        return np.broadcast_to(holds, x.shape), np.broadcast_to(left - right, x.shape)

    def value(self, part: Node, known: Known, x: Array) -> Array:
        """Return a part of the formula at places."""
        return np.broadcast_to(evaluate(part, partial(self._leaf, known)), x.shape).astype(float, copy=False)

    def _leaf(self, known: Known, leaf: Node) -> Any:
        name = leaf.args[0]
        return known(name) if is_id(name) else float(self.formula.constants[name])


@dataclass(frozen=True, eq=False)
class Singularity(BranchCondition):
    """Hold a part of a formula where it is zero the curve may have a pole, or an angle may wrap."""

    @property
    def gap(self) -> Node:
        """Return what is zero there."""
        return self.node

    def arguments(self, varies: Callable[[str], bool]) -> tuple[Node, ...]:
        """Return nothing: what is zero is looked at itself."""
        return ()

    def sides(self, known: Known, x: Array) -> tuple[Array, Array]:
        """Return at places whether it is above zero, and what it is."""
        gap = self.value(self.node, known, x)
        return gap > 0, gap


def _taken_by(node: Node) -> Iterator[Node]:
    """What a function takes, or by how much two of its arguments differ: where they are equal is a corner."""
    match node:
        case Node("call", ("minimum" | "maximum" | "clip", first, *others)):
            yield from (Node("-", (first, other)) for other in others)
        case Node("call", (_, *inner)):
            yield from inner
        case Node("/", (_, below)):
            yield below
        case Node("^", (base, _)):
            yield base


class CurveConditions(NamedTuple):
    """Hold the conditions that a curve follows from and that may change within a smooth piece.

    ``of_flags`` are those on which flags of its pieces rest, ``singular`` where it may have a pole or wrap, ``names`` the curves that all of
    them and the flags take.
    ``varies_by_flag``: a flag takes over what varies; ``is_opaque``: the curve follows from what has no formula to be read.
    """

    direct: tuple[BranchCondition, ...]
    of_flags: tuple[BranchCondition, ...]
    singular: tuple[Singularity, ...]
    names: tuple[str, ...]
    varies_by_flag: bool
    is_opaque: bool

    @property
    def may_jump(self) -> bool:
        """Return whether the curve itself may jump within a piece, its flags being constant."""
        return bool(self.direct) or self.is_opaque


@lru_cache(maxsize=1024)
def conditions_of(curves: tuple[tuple[str, Step], ...], axis: str, curve: str) -> CurveConditions:
    """Return the conditions that a curve follows from. What is under an integral or a derivative is a curve of its own."""
    steps, varying = dict(curves), _varying(curves, axis)
    found: dict[bool, list[BranchCondition]] = {False: [], True: []}
    singular = list[Singularity]()
    names, by_flag, is_opaque = set[str](), False, False
    for name, by in _followed(steps, curve):
        step = steps[name]
        is_read = isinstance(step, Formulas) and all(_tree(formula) is not None for formula in _formulas(step))
        is_opaque |= not (by or is_read or isinstance(step, Accumulated | Derivative))
        if isinstance(step, Formulas):
            own = [each for each in _conditions(step) if varying.intersection(each.names)]
            found[by] += own
            by_flag |= step.per_piece and name in varying
            if not by:
                zeros = [each for each in _singular(step) if varying.intersection(each.names)]
                singular += zeros
                own = [*own, *zeros]
            names.update(*(each.names for each in own), taken(step) if step.per_piece else ())
    taken_names = tuple(name for name in steps if name in names and not is_flag(steps[name]))
    direct, of_flags = (tuple(dict.fromkeys(found[by])) for by in (False, True))
    return CurveConditions(direct, of_flags, tuple(dict.fromkeys(singular)), taken_names, by_flag, is_opaque)


def is_flag(step: Step) -> bool:
    """Return whether a curve is a flag of the smooth pieces, taken at their middles."""
    return bool(getattr(step, "per_piece", False))


@lru_cache(maxsize=256)
def _varying(curves: tuple[tuple[str, Step], ...], axis: str) -> frozenset[str]:
    """What varies otherwise than by the change of a condition."""
    found = {axis}
    for name, step in curves:
        if not isinstance(step, Formulas) or found.intersection(_beside_conditions(step)):
            found.add(name)
    return frozenset(found)


def _followed(steps: dict[str, Step], curve: str) -> Iterator[tuple[str, bool]]:
    """The curves that a curve follows from, itself included, each with whether it does so through a flag."""
    pending, seen = [(curve, False)], set[tuple[str, bool]]()
    while pending:
        name, by_flag = pending.pop()
        step = steps.get(name)
        by_flag = by_flag or is_flag(step) if step is not None else by_flag
        if step is None or (name, by_flag) in seen:
            continue
        seen.add((name, by_flag))
        yield name, by_flag
        if isinstance(step, Formulas):
            pending += [(each, by_flag) for each in sorted(taken(step), reverse=True)]


def _formulas(step: Formulas) -> list[Formula]:
    written = [step.formula] if isinstance(step, Value) else [p for c in step.cases for p in (c.condition, c.value)]
    return [formula_of(part) for part in written if part is not None and not isinstance(part, str)]


def _tree(formula: Formula) -> Node | None:
    """A formula with the expressions of others in the place of the names by which they are printed; None where it cannot be made."""
    try:
        return unsaid(formula.full_tree)
    except FormulaError:
        return None


@lru_cache(maxsize=4096)
def _conditions(step: Formulas) -> tuple[BranchCondition, ...]:
    trees = ((formula, _tree(formula)) for formula in _formulas(step))
    return tuple(
        BranchCondition(step, formula, node) for formula, tree in trees if tree for node in walk(tree) if _decides(node)
    )


@lru_cache(maxsize=4096)
def _singular(step: Formulas) -> tuple[Singularity, ...]:
    trees = ((formula, _tree(formula)) for formula in _formulas(step))
    found = ((formula, part) for formula, tree in trees if tree for node in walk(tree) for part in _zeros(node))
    return tuple(Singularity(step, formula, part) for formula, part in dict.fromkeys(found) if symbols(part))


def _zeros(node: Node) -> Iterator[Node]:
    """Parts of what a function may have a pole, or wrap, where they are zero."""
    match node:
        case Node("/", (_, below)):
            yield from _factors(below)
        case Node("^", (base, power)) if power.op != "num" or float(power.args[0]) < 0:
            yield from _factors(base)
        case Node("call", ("tan", inner)):
            yield Node("call", ("cos", inner))
        case Node("call", ("arctan2", above, _)):
            yield above
        case Node("call", ("log" | "log10", inner)):
            yield from _factors(inner)
        case Node("call", ("arctanh", inner)):
            yield from (Node(sign, (Node("num", ("1",)), inner)) for sign in ("+", "-"))


def _factors(node: Node) -> Iterator[Node]:
    """What is zero where a product is."""
    match node:
        case Node("*", parts):
            for part in parts:
                yield from _factors(part)
        case (
            Node("/", (part, _))
            | Node("neg", (part,))
            | Node("call", ("abs" | "sqrt", part))
            | Node("^", (part, Node("num", _)))
        ):
            yield from _factors(part)
        case Node("num" | "qty"):
            return
        case _:
            yield node


@lru_cache(maxsize=4096)
def _beside_conditions(step: Formulas) -> frozenset[str]:
    """What a step takes otherwise than in a condition."""
    found = set[str]()
    for formula in _formulas(step):
        tree = _tree(formula)
        found.update(formula.parameters if tree is None else filter(is_id, _symbols_beside(tree)))
    return frozenset(found)


def _symbols_beside(part: Any) -> Iterable[str]:
    if not isinstance(part, Node | tuple) or (isinstance(part, Node) and _decides(part)):
        return ()
    if isinstance(part, Node) and part.op == "sym":
        return part.args
    return (name for each in (part.args if isinstance(part, Node) else part) for name in _symbols_beside(each))


def _decides(node: Node) -> bool:
    return node.op == "cmp" or (node.op == "call" and node.args[0] in STEPWISE)
