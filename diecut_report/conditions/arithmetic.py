"""Expressions of a configuration: ``${press.sheet.length} + 110 mm`` read, judged and computed, for one machine or for many."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.conditions import parts
from diecut_report.conditions.grammar import parsed_words
from diecut_report.conditions.kinds import alike, told_kind
from diecut_report.conditions.numpy_emitter import numbers
from diecut_report.conditions.reading import ConditionReader, Find
from diecut_report.conditions.tree import Call, Chain, Negative, Node, Power, names
from diecut_report.conditions.words import ConditionError, calculation
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.units import Kind, unit

WITHOUT_VALUE = phrase("a division by zero, the root of a number below zero, or a number too large to calculate with")

WORDS = (
    ("the condition ", "the expression "),
    ("Write several conditions.", "Write it in a simpler way."),
    (phrase("a name, a number or a quantity"), phrase("a reference, a number or a quantity")),
)


@dataclass(frozen=True)
class Expression:
    """Hold an expression: its text as typed, its tree, and the kind of what it gives; its names are ``${NAME.KEY}``."""

    text: str
    tree: Node
    kind: Kind

    @property
    def names(self) -> tuple[str, ...]:
        """Return the references in it, each once."""
        return names(self.tree)

    def value(self, value_of: Callable[[str], Any]) -> Any:
        """Return its value in SI, NaN where there is none; arrays where the references have arrays."""
        with np.errstate(all="ignore"):
            found = numbers(self.tree, value_of)
        return float(found) if found.ndim == 0 else found

    def fault(self, value_of: Callable[[str], Any]) -> str:
        """Return why a single machine gives it no value, in words."""
        with np.errstate(all="ignore"):
            return next(_faults(self.tree, value_of), phrase("gives a number that is too large to calculate with"))

    def refused(self, wanted: str) -> str:
        """Return why it cannot stand where a quantity in the unit ``wanted`` is needed; nothing where it can."""
        needed = unit(wanted)
        if alike(self.kind, needed.kind):
            return ""
        return Phrase(
            "“{text}” gives {told_kind}; {told_kind_2} in {wanted} is needed here",
            text=self.text,
            told_kind=told_kind(self.kind),
            told_kind_2=told_kind(needed.kind, wanted),
            wanted=wanted,
        )


def read_expression(text: str, find: Find) -> Expression:
    """Read an expression; ConditionError in words, with the place, for what it may not say. ``find`` says what a reference is."""
    try:
        whole = parsed_words(calculation(text))
        made = parts.quantity(ConditionReader(whole, find, exact=True).part(whole.body, 0))
    except ConditionError as fault:
        raise ConditionError(_of_expression(fault.words), fault.place) from None
    if not names(made.node):
        raise ConditionError(phrase("the expression refers to nothing; write the value itself."), 0)
    return Expression(text.strip(), made.node, made.kind)


def _of_expression(words: str) -> str:
    """Words of the grammar, which tell of conditions."""
    for of_condition, of_expression in WORDS:
        words = words.replace(of_condition, of_expression)
    return words


def _faults(node: Node, value_of: Callable[[str], Any]) -> Iterator[str]:
    """Yield what has no value in a tree, the innermost first."""
    for inner in _inner(node):
        yield from _faults(inner, value_of)
    match node:
        case Chain(_, rest):
            if any(sign == "/" and numbers(part, value_of) == 0.0 for sign, part in rest):
                yield phrase("divides by zero")
        case Power(base, exponent) if numbers(base, value_of) == 0.0 and numbers(exponent, value_of) < 0.0:
            yield phrase("divides by zero")
        case Call("sqrt", (of,)) if numbers(of, value_of) < 0.0:
            yield phrase("takes the root of a number below zero")


def _inner(node: Node) -> Iterator[Node]:
    match node:
        case Chain(first, rest):
            yield first
            yield from (part for _, part in rest)
        case Power(base, exponent):
            yield from (base, exponent)
        case Negative(of):
            yield of
        case Call(_, of):
            yield from of
