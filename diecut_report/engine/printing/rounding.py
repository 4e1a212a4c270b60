"""How far the rounding of the computer may carry a formula: a bound on the error of each node, through the whole tree.

The bound is what two computations of one expression may differ by, whose numbers are the same but for their last places.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from diecut_report.expressions import APPLY, NUMERIC
from diecut_report.expressions.tree import Node

LAST_PLACES = 4 * 2.0**-53  # what an operation, or a number read in another unit, may be off by, of its value
LEAVES = ("num", "sym", "qty")
OPERATIONS: dict[str, Callable[..., Any]] = {**APPLY, **NUMERIC}
COMPARISONS = frozenset(("<", "<=", ">", ">=", "==", "!="))
INTEGERS = 2.0**53  # below which an integer of a formula is exact


class Bounded(NamedTuple):
    """Hold a value (a number, or whether a condition holds) and how far rounding may carry it; infinite where nothing is known.

    Of a condition the error is 1 where rounding may turn it, else 0.
    """

    value: Any
    error: float


PI = Bounded(math.pi, LAST_PLACES * math.pi)
LeafOf = Callable[[Node], Bounded]


def bounded(tree: Node, value_of: Callable[[Node], float]) -> Bounded:
    """Compute a tree with a bound on the rounding in it; ``value_of`` gives the SI value of ``sym`` and ``qty`` leaves."""

    def leaf(node: Node) -> Bounded:
        value = float(node.args[0]) if node.op == "num" else float(value_of(node))
        exact = node.op == "num" and value == round(value) and abs(value) < INTEGERS
        return Bounded(value, 0.0 if exact else LAST_PLACES * abs(value))

    with np.errstate(all="ignore"):
        return _bounded(tree, leaf)


def _bounded(node: Node, leaf: LeafOf) -> Bounded:
    op, args = node  # thousands of nodes are bounded for a document: no patterns are matched one after another
    if op in LEAVES:
        return PI if args == ("π",) and op == "sym" else leaf(node)
    if op in ("call", "cmp"):
        return _combined(args[0], [_bounded(a, leaf) for a in args[1:]])
    if op == "cases":
        return _branches([[_bounded(part, leaf) for part in branch] for branch in args])
    if op == "apply":
        called = args[0].formula
        known = dict(zip(called.parameters, (_bounded(a, leaf) for a in args[1:]), strict=True))
        return _bounded(called.tree, lambda own: known[own.args[0]] if own.args[0] in known else leaf(own))
    return _combined(op, [_bounded(a, leaf) for a in args])


def _branches(branches: Sequence[Sequence[Bounded]]) -> Bounded:
    """The first branch whose condition holds, or any before or after it that rounding may take in its place."""
    possible: list[tuple[bool, Bounded]] = []
    for value, *condition in branches:
        holds, error = condition[0] if condition else Bounded(True, 0.0)
        if holds or error:
            possible.append((bool(holds), value))
        if holds and not error:
            break
    taken = next((value for holds, value in possible if holds), Bounded(math.nan, math.inf))
    return Bounded(taken.value, max((abs(v.value - taken.value) + v.error for _, v in possible), default=math.inf))


def _combined(name: str, args: Sequence[Bounded]) -> Bounded:
    if name in COMPARISONS:
        (left, left_error), (right, right_error) = args
        return Bounded(APPLY[name](left, right), float(abs(left - right) <= left_error + right_error))
    if name in ("and", "or", "not"):
        return Bounded(APPLY[name](*(part.value for part in args)), max(part.error for part in args))
    try:
        value = float(OPERATIONS[name](*[part.value for part in args]))
    except ArithmeticError:  # of Python's own numbers: a division by zero, a power that is too great
        return Bounded(math.nan, math.inf)
    error = _error(name, value, args) + LAST_PLACES * abs(value)
    return Bounded(value, error if math.isfinite(error) else math.inf)


def _error(name: str, value: float, args: Sequence[Bounded]) -> float:
    """How far the errors of what an operation takes carry its value."""
    errors = [part.error for part in args]
    match name:
        case "+" | "-":
            return sum(errors)
        case "neg" | "abs" | "minimum" | "maximum":
            return max(errors)
        case "*":
            (one, one_error), (other, other_error) = args
            return float(abs(one) * other_error + abs(other) * one_error + one_error * other_error)
        case "/":
            over, (under, under_error) = args
            left = abs(under) - under_error
            return (over.error + abs(value) * under_error) / left if left > 0 else math.inf
        case "sin" | "cos":
            return min(errors[0], 2.0)
        case "tan" if abs(math.cos(args[0].value)) <= errors[0]:
            return math.inf
        case "arctan2" if _about_the_cut(*args):
            return 2 * math.pi
    return _over_the_ends(name, value, args)


def _about_the_cut(up: Bounded, across: Bounded) -> bool:
    """Whether rounding may carry a direction over ±180°, or its point into the origin."""
    return bool(abs(up.value) <= up.error and across.value <= across.error)


DOMAIN = {
    "sqrt": (0.0, math.inf), "log": (0.0, math.inf), "log10": (0.0, math.inf), "arcsin": (-1.0, 1.0), "arccos": (-1.0, 1.0),
    "arccosh": (1.0, math.inf), "arctanh": (-1.0, 1.0),
}  # fmt: skip


def _over_the_ends(name: str, value: float, args: Sequence[Bounded]) -> float:
    """The greatest change over the ends of what the arguments may be, and over zero where that lies between them.

    It holds for what rises or falls in each argument on either side of zero. What lies outside of where a function is
    defined does not count, for it has no value there.
    """
    if not all(math.isfinite(part.error) for part in args):
        return math.inf
    low, high = DOMAIN.get(name, (-math.inf, math.inf))
    if name == "^" and args[1].value != round(args[1].value):
        low = 0.0
    places = [_places(part, low, high) for part in args[:1]] + [_places(part) for part in args[1:]]
    found = [_value(name, place) for place in product(*places)]
    return max((abs(each - value) for each in found), default=math.inf)


def _places(part: Bounded, low: float = -math.inf, high: float = math.inf) -> list[float]:
    if part.error == 0:
        return [min(max(part.value, low), high)]
    ends = [min(max(part.value + sign * part.error, low), high) for sign in (-1, 1)]
    return [*ends, *([0.0] if ends[0] < 0 < ends[1] else [])]


def _value(name: str, place: Sequence[float]) -> float:
    try:
        return float(OPERATIONS[name](*map(np.float64, place)))
    except ArithmeticError:
        return math.inf
