"""Checks that cannot fail, or cannot hold: both sides are one expression, or neither depends on an input."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import Any

from diecut_report.contract.binding import ByText, bound
from diecut_report.contract.checks import Check
from diecut_report.contract.steps import Value
from diecut_report.declaration.names import DeclaredNames, Giver
from diecut_report.expressions import FormulaError
from diecut_report.expressions.tree import Node, substitute, symbols
from diecut_report.languages.phrases import Phrase, phrase

NEUTRAL = {"+": 0.0, "*": 1.0}
DEEP = 40  # formulas within formulas, of which a declaration may have a circle that is reported elsewhere


def told(names: DeclaredNames, check: Check) -> Iterator[str]:
    """Yield what is wrong with the sides of a check.

    Where inputs decide which formula gives a side, one of them may bound the other: a size that is chosen, a count that is not
    left out. A check is refused where none of its forms can turn out otherwise.
    """
    for one, other in check.pairs:
        found = [_empty(*sides) for sides in product(_ways(names, one), _ways(names, other))]
        if all(found):
            yield from (Phrase(text, one=_told(one), other=_told(other)) for text in dict.fromkeys(found))


def _empty(demand: Node, limit: Node) -> str:
    """Return why two expressions are no check; nothing where they are one."""
    if _ordered(demand) == _ordered(limit):
        return phrase("compares {one} with {other}, which is the same expression: it can never fail")
    if not symbols(demand) and not symbols(limit):
        return phrase(
            "compares {one} with {other}, neither of which depends on an input: its verdict is always the same"
        )
    if limit in _least(demand) or demand in _greatest(limit):
        return phrase("compares {one} with {other}, by which it is bounded itself: it can never fail")
    return ""


def _ordered(part: Any) -> Any:
    """An expression with the parts of its sums and products in one order, without those that change nothing."""
    if not isinstance(part, tuple):
        return part
    if not isinstance(part, Node):
        return tuple(map(_ordered, part))
    parts = [_ordered(each) for each in part.args]
    neutral = NEUTRAL.get(part.op)
    if neutral is None:
        return Node(part.op, tuple(parts))
    flat = [each for own in parts for each in (own.args if own.op == part.op else (own,))]
    kept = sorted((each for each in flat if each.op != "num" or float(each.args[0]) != neutral), key=repr)
    return kept[0] if len(kept) == 1 else Node(part.op, tuple(kept))


def _ways(names: DeclaredNames, side: str | float) -> list[Node]:
    """The expressions that a side may be, down to the inputs and to what is no closed formula."""
    if not isinstance(side, str):
        return [Node("num", (repr(float(side)),))]
    return list(dict.fromkeys(_expanded(names, side, giver, DEEP) for giver in names.givers(side)))


def _expanded(names: DeclaredNames, name: str, giver: Giver, deep: int) -> Node:
    step = giver.step
    if type(step) is not Value or isinstance(step.formula, ByText) or not deep:
        return Node("sym", (name,))
    link = bound(step.formula)
    try:
        tree = link.formula.tree
    except FormulaError:  # which is reported as a fault of the formula
        return Node("sym", (name,))
    return substitute(tree, {own: _part(names, taken, deep - 1) for own, taken in link.names.items()})


def _part(names: DeclaredNames, taken: str | float, deep: int) -> Node:
    """What a formula takes; a name that several steps give stands for itself."""
    if not isinstance(taken, str):
        return Node("num", (repr(float(taken)),))
    givers = names.givers(taken)
    return _expanded(names, taken, givers[0], deep) if len(givers) == 1 else Node("sym", (taken,))


def _least(node: Node) -> set[Node]:
    return set(_arguments(node, "minimum"))


def _greatest(node: Node) -> set[Node]:
    return set(_arguments(node, "maximum"))


def _arguments(node: Node, name: str) -> Iterator[Node]:
    """What a least or greatest value is taken of, also of several after one another."""
    for part in node.args[1:] if node.op == "call" and node.args[0] == name else ():
        yield part
        yield from _arguments(part, name)


def _told(side: str | float) -> str:
    return side if isinstance(side, str) else f"{side:g}"
