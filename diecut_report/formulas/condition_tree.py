"""The tree of a condition: what was read and judged, with all quantities in SI.

A value that is missing, and a calculated one that is not finite (a division by zero, the root of less than zero), is not a value. A
comparison with no value is neither true nor false, and ``and``, ``or``, ``not`` of such follow: ``false and`` anything is false,
``true or`` anything is true, else it stays undecided. A condition picks the rows for which it is true.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from functools import reduce
from typing import Any, Literal

from diecut_report.formulas.tree import Node as FormulaNode

# Values.


@dataclass(frozen=True)
class Number:
    """Stand for a number, in SI."""

    value: float


@dataclass(frozen=True)
class TextLiteral:
    """Stand for a text."""

    value: str


@dataclass(frozen=True)
class ColumnName:
    """Stand for what a name stands for in each row; ``holds`` says what that is."""

    name: str
    holds: Literal["number", "text", "truth"]


@dataclass(frozen=True)
class Negative:
    """Stand for a number with the other sign."""

    of: Node


@dataclass(frozen=True)
class Chain:
    """Stand for numbers joined from left to right, either by ``+`` and ``-`` or by ``*`` and ``/``."""

    first: Node
    rest: tuple[tuple[str, Node], ...]


@dataclass(frozen=True)
class Power:
    """Stand for a number raised to another one."""

    base: Node
    exponent: Node


@dataclass(frozen=True)
class Call:
    """Stand for a function (abs, sqrt, min, max) of numbers."""

    name: str
    of: tuple[Node, ...]


# Conditions.


@dataclass(frozen=True)
class Truth:
    """Stand for a condition that always or never holds."""

    value: bool


@dataclass(frozen=True)
class Compared:
    """Stand for a comparison (``== != < <= > >=``) of two numbers, two texts or two conditions."""

    sign: str
    left: Node
    right: Node


@dataclass(frozen=True)
class Like:
    """Stand for whether a text is like a pattern: ``%`` stands for any letters, ``_`` for one."""

    text: Node
    pattern: str


@dataclass(frozen=True)
class Missing:
    """Stand for whether there is no value, or a condition is undecided."""

    of: Node


@dataclass(frozen=True)
class Joined:
    """Stand for conditions joined by ``and`` or by ``or``."""

    word: Literal["and", "or"]
    parts: tuple[Node, ...]


@dataclass(frozen=True)
class Not:
    """Stand for the contrary of a condition."""

    of: Node


Node = (
    Number
    | TextLiteral
    | ColumnName
    | Negative
    | Chain
    | Power
    | Call
    | Truth
    | Compared
    | Like
    | Missing
    | Joined
    | Not
)


def is_condition(node: Node) -> bool:
    """Return whether a node is true, false or undecided, rather than a number or a text."""
    return isinstance(node, Truth | Compared | Like | Missing | Joined | Not) or (
        isinstance(node, ColumnName) and node.holds == "truth"
    )


def is_text(node: Node) -> bool:
    """Return whether a node is a text."""
    return isinstance(node, TextLiteral) or (isinstance(node, ColumnName) and node.holds == "text")


def names(node: Node) -> tuple[str, ...]:
    """Return the names in a tree, in order of appearance, each once."""
    return tuple(dict.fromkeys(_names(node)))


def _names(node: Node) -> Iterator[str]:
    if isinstance(node, ColumnName):
        yield node.name
    for part in operands(node):
        yield from _names(part)


def operands(part: Node | tuple[Any, ...]) -> Iterator[Node]:
    """Yield the nodes that a node joins, in order."""
    for each in part if isinstance(part, tuple) else (getattr(part, field.name) for field in fields(part)):
        if isinstance(each, Node):
            yield each
        elif isinstance(each, tuple):
            yield from operands(each)


# The tree of an expression as the tree of a formula, so that it may stand within one.


def as_formula(node: Node, known: Mapping[str, FormulaNode]) -> FormulaNode:
    """Return the tree of an expression with what its names stand for."""
    match node:
        case Number(value):
            return FormulaNode("qty", (value,))
        case ColumnName(name):
            return known[name]
        case Negative(of):
            return FormulaNode("neg", (as_formula(of, known),))
        case Chain(first, rest):
            found = as_formula(first, known)
            for sign, part in rest:
                found = FormulaNode(sign, (found, as_formula(part, known)))
            return found
        case Power(base, exponent):
            return FormulaNode("^", (as_formula(base, known), as_formula(exponent, known)))
        case Call(name, of):
            return _called(name, [as_formula(part, known) for part in of])
    raise TypeError(f"{node} is not a number")


def _called(name: str, given: list[FormulaNode]) -> FormulaNode:
    """The least and the greatest take two at a time in formulas."""
    if name in ("abs", "sqrt"):
        return FormulaNode("call", (name, *given))
    of_two = {"min": "minimum", "max": "maximum"}[name]
    return reduce(lambda one, other: FormulaNode("call", (of_two, one, other)), given)
