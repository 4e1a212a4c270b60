"""A condition held against arrays of rows by NumPy; see `tree` for what holds where there is no value."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import reduce
from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.condition_tree import (
    Call,
    Chain,
    ColumnName,
    Compared,
    Joined,
    Like,
    Missing,
    Negative,
    Node,
    Not,
    Number,
    Power,
    TextLiteral,
    Truth,
    is_condition,
    is_text,
)
from diecut_report.formulas.tree import APPLY, NUMERIC

ValueOf = Callable[[str], Any]
"""What a name stands for in each row: numbers (NaN where one is missing), texts or truths (None where one is missing)."""


class JudgedRows(NamedTuple):
    """Hold for each row whether a condition holds and whether it fails; where it does neither it is undecided."""

    holds: Array
    fails: Array


def judged(node: Node, value_of: ValueOf, count: int) -> JudgedRows:
    """Return for each of so many rows whether the condition holds, and whether it fails."""
    with np.errstate(all="ignore"):
        found = _condition(node, value_of)
    return JudgedRows(*(np.array(np.broadcast_to(each, (count,)), dtype=bool) for each in found))


# Conditions.


def _condition(node: Node, value_of: ValueOf) -> JudgedRows:
    match node:
        case Truth(value):
            return JudgedRows(np.array(value), np.array(not value))
        case ColumnName(name):
            values = np.asarray(value_of(name), dtype=object)
            return JudgedRows(_same(values, True), _same(values, False))
        case Not(of):
            found = _condition(of, value_of)
            return JudgedRows(found.fails, found.holds)
        case Joined(word, parts):
            return _joined(word, [_condition(part, value_of) for part in parts])
        case Missing(of):
            missing = _same(_texts(of, value_of), None) if is_text(of) else np.isnan(_sizes(of, value_of))
            return JudgedRows(missing, ~missing)
        case Like(text, pattern):
            return _like(_texts(text, value_of), pattern)
        case Compared(sign, left, right) if is_text(left):
            return _compared_texts(sign, _texts(left, value_of), _texts(right, value_of))
        case Compared(sign, left, right):
            return _compared(sign, _sizes(left, value_of), _sizes(right, value_of))
    raise TypeError(f"{node} is not a condition")


def _joined(word: str, parts: list[JudgedRows]) -> JudgedRows:
    everywhere, anywhere = np.logical_and, np.logical_or
    for_holds, for_fails = (everywhere, anywhere) if word == "and" else (anywhere, everywhere)
    holds, fails = parts[0]
    for part in parts[1:]:
        holds, fails = for_holds(holds, part.holds), for_fails(fails, part.fails)
    return JudgedRows(holds, fails)


def _sizes(node: Node, value_of: ValueOf) -> Array:
    """Return the numbers of a side of a comparison; a condition that is true counts as 1, one that is undecided as NaN."""
    if is_condition(node):
        found = _condition(node, value_of)
        return np.where(found.holds, 1.0, np.where(found.fails, 0.0, np.nan))
    return numbers(node, value_of)


def _compared(sign: str, left: Array, right: Array) -> JudgedRows:
    known = ~(np.isnan(left) | np.isnan(right))
    found = APPLY[sign](left, right)
    return JudgedRows(known & found, known & ~found)


def _same(values: Array, wanted: Any) -> Array:
    return np.asarray(np.equal(values, wanted), dtype=bool)


def _texts(node: Node, value_of: ValueOf) -> Array:
    if not isinstance(node, TextLiteral | ColumnName):
        raise TypeError(f"{node} is not a text")
    return np.array(node.value if isinstance(node, TextLiteral) else value_of(node.name), dtype=object)


def _compared_texts(sign: str, left: Array, right: Array) -> JudgedRows:
    known = ~(_same(left, None) | _same(right, None))
    found = np.asarray(
        APPLY[sign](np.where(_same(left, None), "", left), np.where(_same(right, None), "", right)), bool
    )
    return JudgedRows(known & found, known & ~found)


def _like(texts: Array, pattern: str) -> JudgedRows:
    first, *middle = [re.escape(piece).replace("_", ".") for piece in pattern.split("%")]
    last = f".*{middle.pop()}" if middle else ""
    # Each piece is taken where it comes first, for good: nothing is tried twice, however many pieces there are.
    wanted = re.compile(first + "".join(f"(?>.*?{piece})" for piece in middle) + last, re.DOTALL)
    known = ~_same(texts, None)
    found = np.array([text is not None and bool(wanted.fullmatch(text)) for text in texts.flat], dtype=bool)
    return JudgedRows(known & found.reshape(texts.shape), known & ~found.reshape(texts.shape))


# Numbers.


def numbers(node: Node, value_of: ValueOf) -> Array:
    """Return a calculated number for each row (or one for all), NaN where there is none."""
    match node:
        case Number(value):
            return np.array(value)
        case ColumnName(name):
            return np.asarray(value_of(name), dtype=float)
        case Negative(of):
            return _finite(-numbers(of, value_of))
        case Chain(first, rest):
            found = numbers(first, value_of)
            for sign, part in rest:
                found = _finite(APPLY[sign](found, numbers(part, value_of)))
            return found
        case Power(base, exponent):
            return _power(numbers(base, value_of), numbers(exponent, value_of))
        case Call(name, of):
            return _called(name, [numbers(part, value_of) for part in of])
    raise TypeError(f"{node} is not a number")


def _finite(values: Array) -> Array:
    return np.where(np.isfinite(values), values, np.nan)


def _power(base: Array, exponent: Array) -> Array:
    known = ~(np.isnan(base) | np.isnan(exponent))  # NumPy has 1 for 1 ** NaN
    return _finite(np.where(known, np.power(base, exponent), np.nan))


def _called(name: str, given: list[Array]) -> Array:
    function = NUMERIC[{"min": "minimum", "max": "maximum"}.get(name, name)]
    return _finite(reduce(function, given) if name in ("min", "max") else function(*given))


# How far rows are from a condition that does not hold: what a search follows to where it does.


UNKNOWN = 1.0  # of what holds or does not, without a size, and of what has no value
LEAST = 1e-9  # of what does not hold by next to nothing


def shortfall(node: Node, value_of: ValueOf, count: int) -> Array:
    """Return for each of so many rows 0 where the condition holds, else how far it is from that, from 0 to 1: the further, the greater."""
    holds = judged(node, value_of, count).holds
    with np.errstate(all="ignore"):
        found = np.broadcast_to(_distance(node, value_of, count), (count,))
    return np.where(holds, 0.0, np.maximum(found, LEAST))


def _distance(node: Node, value_of: ValueOf, count: int) -> Array:
    match node:
        case Joined("and", parts):
            return np.asarray(np.sum([shortfall(part, value_of, count) for part in parts], axis=0))
        case Joined(_, parts):
            return np.asarray(np.min([shortfall(part, value_of, count) for part in parts], axis=0))
        case Compared(sign, left, right) if sign != "!=" and not (is_text(left) or is_condition(left)):
            share = _beyond(numbers(left, value_of), numbers(right, value_of))
            return np.where(np.isfinite(share), share / (1 + share), UNKNOWN)
    return np.array(UNKNOWN)


def _beyond(left: Array, right: Array) -> Array:
    """How far two sides are apart, by the size of the one that is the same in all rows: a size of each row turns round at zero."""
    same = next((abs(float(side)) for side in (right, left) if not side.ndim), 0.0)
    return np.asarray(np.abs(left - right) / (same or 1.0))
