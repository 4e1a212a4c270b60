"""What decides in the formulas of a curve, comparisons and functions that take steps, and which flags of its smooth pieces it takes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.formula import evaluate
from diecut_report.formulas.tree import APPLY, Node, symbols, walk
from diecut_report.machine.curve_samples import CurveSampler
from diecut_report.machine.numerics.jumps import STEPWISE, expanded, parts
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.names import Bound, bound
from diecut_report.mechanism.steps import Choice, Step, Value

Formulas = Value | Choice


@dataclass(frozen=True, eq=False)
class Decision:
    """Hold a part of a formula that decides: a comparison, or a function that takes steps. Each is one object."""

    step: Formulas
    link: Bound
    node: Node

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Return the quantities that it decides by."""
        found = (self.link.names.get(symbol) for symbol in symbols(self.node))
        return tuple(dict.fromkeys(name for name in found if isinstance(name, str)))

    @cached_property
    def meaning(self) -> tuple[Node, tuple[str | float | None, ...]]:
        """Return what two decisions that decide the same have in common, as a key."""
        return self.node, tuple(
            self.link.names.get(symbol, self.link.formula.constants.get(symbol)) for symbol in symbols(self.node)
        )


class Deciding(NamedTuple):
    """Hold what makes a curve jump inside a piece: decisions that may change within one, and what it takes of flags of its pieces.

    These are decisions by flags and numbers alone, and flags that are taken otherwise. A flag that only another flag
    takes has no part in the curve unless that one varies.
    """

    changing: tuple[Decision, ...]
    by_flags: tuple[Decision, ...]
    flags: tuple[str, ...]


@lru_cache(maxsize=1024)
def asked(curves: tuple[tuple[str, Step], ...], axis: str, curve: str) -> Deciding:
    """Return what makes a curve jump.

    What is under an integral or a derivative is a curve of its own, which was searched before these were taken.
    """
    steps = dict(curves)
    flags = {name for name, step in curves if getattr(step, "per_piece", False)}
    varying = (steps.keys() - flags) | {axis}
    changing, by_flags, taken_flags = list[Decision](), list[Decision](), {curve} & flags
    for step, is_direct in _followed(steps, curve):
        of_places = [each for each in _decisions(step) if varying.intersection(each.names)]
        changing += of_places
        if is_direct:
            by_flags += (each for each in _decisions(step) if each not in of_places and flags.intersection(each.names))
            taken_flags |= flags & _taken_as_they_are(step).union(*(each.names for each in of_places))
    return Deciding(tuple(dict.fromkeys(changing)), tuple(dict.fromkeys(by_flags)), tuple(sorted(taken_flags)))


@lru_cache(maxsize=1024)
def is_decided(curves: tuple[tuple[str, Step], ...], axis: str, flag: str) -> bool:
    """Return whether a flag of pieces is constant in a piece in which no decision changes that it follows from."""
    steps = dict(curves)
    flags = {name for name, step in curves if getattr(step, "per_piece", False)}
    varying = (steps.keys() - flags) | {axis}
    return not any(step.per_piece and varying & _taken_as_they_are(step) for step, _ in _followed(steps, flag))


def _followed(steps: dict[str, Step], curve: str) -> Iterator[tuple[Formulas, bool]]:
    """The formulas that a curve follows from, its own included, and whether it does so otherwise than through a flag."""
    pending, seen = [(curve, True)], set[tuple[str, bool]]()
    while pending:
        name, is_direct = pending.pop()
        step = steps.get(name)
        if not isinstance(step, Formulas):
            continue
        is_direct = is_direct and not step.per_piece
        if (name, is_direct) not in seen:
            seen.add((name, is_direct))
            pending += [(each, is_direct) for each in sorted(taken(step), reverse=True)]
            yield step, is_direct


@lru_cache(maxsize=4096)
def _decisions(step: Formulas) -> tuple[Decision, ...]:
    return tuple(
        Decision(step, link, node)
        for link in _links(step)
        for node in walk(expanded(link.formula.tree))
        if _decides(node)
    )


@lru_cache(maxsize=4096)
def _taken_as_they_are(step: Formulas) -> frozenset[str]:
    """What a step takes otherwise than to decide by it alone."""
    within = frozenset(name for each in _decisions(step) for name in each.names)
    beside = (
        link.names.get(symbol) for link in _links(step) for symbol in _beside_decisions(expanded(link.formula.tree))
    )
    return (taken(step) - within) | frozenset(name for name in beside if isinstance(name, str))


def _beside_decisions(node: Node) -> Iterator[str]:
    """The symbols of a tree that stand elsewhere than in what decides."""
    if node.op == "sym":
        yield node.args[0]
    elif not _decides(node):
        for part in parts(node):
            yield from _beside_decisions(part)


def _links(step: Formulas) -> list[Bound]:
    bindings = [step.formula] if isinstance(step, Value) else [p for c in step.cases for p in (c.condition, c.value)]
    return [bound(part) for part in bindings if part is not None and not isinstance(part, str)]


def _decides(node: Node) -> bool:
    return node.op == "cmp" or (node.op == "call" and node.args[0] in STEPWISE)


def key(what: Decision | str) -> Any:
    """Return a key: what flags decide in several formulas alike is one."""
    return what if isinstance(what, str) else what.meaning


def value(what: Decision | str, sampler: CurveSampler) -> Any:
    """Return a flag at places, or what flags decide there."""
    return sampler[what] if isinstance(what, str) else evaluate(what.node, partial(_leaf, what, sampler))


def _leaf(decision: Decision, sampler: CurveSampler, leaf: Node) -> Any:
    name = decision.link.names.get(leaf.args[0])
    if name is None:
        return float(decision.link.formula.constants[leaf.args[0]])
    return sampler[name] if isinstance(name, str) else float(name)


def decided(decision: Decision, sampler: CurveSampler) -> tuple[Array, Array]:
    """Return what is decided at places, and how far the decision is from changing there."""
    node = decision.node
    if node.op == "cmp":
        left, right = (side(decision, part, sampler) for part in node.args[1:])
        return APPLY[node.args[0]](left, right), left - right
    inner = side(decision, node.args[1], sampler)
    return side(decision, node, sampler), STEPS.get(node.args[0], _whole)(inner)


def side(decision: Decision, part: Node, sampler: CurveSampler) -> Array:
    """Return a part of a decision at places."""
    return over(evaluate(part, partial(_leaf, decision, sampler)), sampler.x)


def _whole(inner: Array) -> Array:
    """How far numbers are from whole ones."""
    found: Array = np.sin(np.pi * inner)
    return found


def _half(inner: Array) -> Array:
    """How far numbers are from those between two whole ones."""
    found: Array = np.cos(np.pi * inner)
    return found


STEPS: dict[str, Callable[[Array], Array]] = {"sign": np.asarray, "round": _half}  # how far a function's step is


def over(values: Any, x: Array) -> Array:
    """Return values as numbers, one for each place."""
    found: Array = np.broadcast_to(values, x.shape).astype(float, copy=False)
    return found
