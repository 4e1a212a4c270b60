"""Constraints between inputs: a text such as ``mechanisms.a.bore <= 0.6 * mechanisms.a.height``, read once, held on arrays.

A constraint may name inputs by their paths, numbers, quantities in quotes (``'90 rpm'``), ``+ - * / **``, brackets,
comparisons, ``and or not``, and the functions ``abs min max sqrt``; nothing else is read, and nothing is ever executed.
Its dimensions are judged as it is read.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.errors import nearest
from diecut_report.expressions import BINARY, COMPARE, Array, Node, evaluate, symbols
from diecut_report.quantities.units import unit
from diecut_report.study.conditions.constraint_parts import (
    FUNCTIONS,
    ConstraintError,
    Part,
    calculated,
    called,
    compared,
    condition,
    joined,
    number,
    quantity,
)

MAX_TEXT, MAX_NESTING = 1000, 40
_TOKEN = re.compile(
    r"""(?P<quoted>'[^']*'|"[^"]*")
    |(?P<path>(?:mechanisms\.[A-Za-z][\w-]*|[^\W\d]\w*)(?:\.\w+)+)
    |(?P<unit>(?<![\w.])(?P<number>(?>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?))[^\S\n]*(?P<of>(?!(?:and|or|not|if|in|is)\b)[^\W\d_]\w*(?:/\w+)*))""",
    re.VERBOSE,
)


@dataclass(frozen=True)
class Term:
    """What a path stands for in a constraint: its SI unit (None for a text or a yes/no) and its value.

    The value is ``sym`` of a varied path, ``qty`` of a value that the base fixes, or an expression of these.
    """

    unit: str | None
    node: Node


Find = Callable[[str], Term]
"""What a path stands for; ConstraintError in words where it stands for nothing that is known before calculating."""


@dataclass(frozen=True)
class Constraint:
    """What must hold between the inputs of a variant; ``tree`` has the varied paths as symbols, all else in SI."""

    text: str
    tree: Node

    @property
    def paths(self) -> tuple[str, ...]:
        """The varied paths that it names."""
        return tuple(symbols(self.tree))

    def holds(self, rows: Mapping[str, Any]) -> Array:
        """For each row whether it holds; what cannot be compared (the root of a number below zero) does not."""

        def value_of(leaf: Node) -> Any:
            value = leaf.args[0]
            return np.asarray(rows[value]) if leaf.op == "sym" else np.float64(value) if _is_number(value) else value

        with np.errstate(all="ignore"):
            held = evaluate(self.tree, value_of)
        return np.asarray(np.broadcast_to(held, (len(rows[self.paths[0]]),)), dtype=bool)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def parse(text: str, find: Find) -> Constraint:
    """Read a constraint; ConstraintError in words for what it may not hold, unlike dimensions, or no varied path in it."""
    if len(text) > MAX_TEXT:
        raise ConstraintError(f"has {len(text)} characters; at most {MAX_TEXT} are allowed. Write several constraints.")
    reader = _Reader(find)
    made = reader.read(text)
    if made.what != "condition":
        raise ConstraintError(f"“{text}” compares nothing; a comparison is needed, such as {_EXAMPLE}.")
    if not symbols(made.node):
        raise ConstraintError(
            f"“{text}” names no varied path, so it would keep all variants or none; name one of vary."
        )
    return Constraint(text, made.node)


_EXAMPLE = "mechanisms.NAME.KEY <= '90 mm'"


class _Reader:
    """Reads one constraint by Python's own grammar, with names in the place of paths."""

    def __init__(self, find: Find) -> None:
        self.find = find
        self.paths: list[str] = []

    def read(self, text: str) -> Part:
        if own := re.search(r"\bpath_\d+_", text):
            raise self._no_path(own[0])
        named = _TOKEN.sub(self._named, text).strip()
        try:
            tree = ast.parse(named, mode="eval")
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise ConstraintError(
                f"“{text}” cannot be read; write a comparison such as {_EXAMPLE}, with quantities in quotes."
            ) from None
        return self._part(tree.body, 0)

    def _named(self, token: re.Match[str]) -> str:
        if token["unit"]:
            raise ConstraintError(f"“{token['unit']}”: put a quantity in quotes: '{token['number']} {token['of']}'.")
        if token["quoted"]:
            return token["quoted"]
        self.paths.append(token["path"])
        return f"path_{len(self.paths) - 1}_"

    def _part(self, at: ast.expr, depth: int) -> Part:
        if depth > MAX_NESTING:
            raise ConstraintError(f"is nested deeper than {MAX_NESTING} levels. Write several constraints.")
        inner: Callable[[ast.expr], Part] = lambda part: self._part(part, depth + 1)  # noqa: E731
        match at:
            case ast.Name(id=name):
                return self._path(name)
            case ast.Constant(value=str() as text):
                return Part(Node("qty", (text,)), "quoted", typed=f"'{text}'")
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
                return number(value)
            case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=operand):
                part = quantity(inner(operand))
                return (
                    Part(Node("neg", (part.node,)), "quantity", part.kind, part.loose)
                    if isinstance(sign, ast.USub)
                    else part
                )
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return Part(Node("not", (condition(inner(operand)),)), "condition")
            case ast.BoolOp(op=sign, values=values):
                return joined("and" if isinstance(sign, ast.And) else "or", [condition(inner(v)) for v in values])
            case ast.BinOp(left=left, op=op, right=right) if BINARY.get(type(op), "") in ("+", "-", "*", "/", "^"):
                return calculated(BINARY[type(op)], quantity(inner(left)), quantity(inner(right)))
            case ast.Compare(left=left, ops=ops, comparators=others) if all(type(op) in COMPARE for op in ops):
                return compared([COMPARE[type(op)] for op in ops], [inner(part) for part in (left, *others)])
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if not name.startswith("path_"):
                return called(name, (quantity(inner(part)) for part in args))
        raise ConstraintError(f"“{self._typed(at)}” is not allowed here; allowed: paths of inputs, numbers, quantities in "
                              f"quotes, + - * / **, comparisons, and, or, not, {', '.join(FUNCTIONS)}.")  # fmt: skip

    def _path(self, name: str) -> Part:
        match = re.fullmatch(r"path_(\d+)_", name)
        if match is None:
            raise self._no_path(name)
        path = self.paths[int(match[1])]
        term = self.find(path)
        if term.unit is None:
            return Part(term.node, "text", typed=path)
        return Part(term.node, "quantity", unit(term.unit).kind, typed=path)

    def _no_path(self, name: str) -> ConstraintError:
        advice = "; write the whole path of an input, such as mechanisms.NAME.KEY, and texts in quotes"
        return ConstraintError(f"“{name}” is no path of an input{nearest(name, FUNCTIONS) or advice}.")

    def _typed(self, at: ast.expr) -> str:
        return re.sub(r"path_(\d+)_", lambda match: self.paths[int(match[1])], ast.unparse(at))
