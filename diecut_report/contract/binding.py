"""Formulas bound to the quantities of a mechanism: one formula serves many, each with its own letters."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from inspect import signature
from types import FunctionType
from typing import Any

from diecut_report.contract.place import Misdeclared
from diecut_report.expressions import LAMBDA, Formula
from diecut_report.languages.phrases import Phrase


@dataclass(frozen=True, eq=False)
class Bound:
    """Bind a formula to quantities: each parameter's quantity id, or a plain number."""

    formula: Formula
    names: Mapping[str, str | float]

    @cached_property
    def takes(self) -> tuple[str | float, ...]:
        """Return what the parameters take, in their order: ids, or plain numbers as floats."""
        return tuple(name if isinstance(name, str) else float(name) for name in self.names.values())


def bind(formula: Formula | Callable[..., Any], **names: str | float) -> Bound:
    """Bind a formula (or a lambda) to quantities; a parameter that is not named takes the quantity of its own name."""
    if not callable(formula):
        raise Misdeclared(
            Phrase(
                "bind takes a formula, and {formula} is none; write a lambda, or a def with @formula above it",
                formula=repr(formula),
            )
        )
    formula = formula if isinstance(formula, Formula) else Formula(formula)
    unknown = sorted(set(names) - set(formula.parameters))
    if unknown:
        known = ", ".join(formula.parameters) or "none"
        raise Misdeclared(
            Phrase(
                "formula {name} has no parameter {unknown}; it has {known}",
                name=formula.__name__,
                unknown=", ".join(unknown),
                known=known,
            )
        )
    return Bound(formula, {p: names.get(p, p) for p in formula.parameters})


class ByText:
    """Choose a formula by a text input: ``formulas[text]``, bound to quantities as by ``bind(formula, **names)``.

    ``formulas`` may be a live view of a registry; all its formulas have the same parameters.
    """

    def __init__(self, key: str, formulas: Mapping[str, Formula], /, **names: str | float) -> None:
        self.key, self.formulas, self.names = key, formulas, names

    def of(self, text: str) -> Bound:
        """Return the bound formula for a value of the text input."""
        return bind(self.formulas[text], **self.names)

    def options(self) -> tuple[Bound, ...]:
        """Return the bound formulas of all values."""
        return tuple(map(self.of, self.formulas))

    def renamed(self, rename: Callable[[str | float], str | float]) -> ByText:
        """Return the same choice with other ids for its quantities."""
        own = self.options()[0].names
        return ByText(self.key, self.formulas, **{parameter: rename(name) for parameter, name in own.items()})


Binding = Bound | Formula | ByText


def as_binding(part: Binding | Callable[..., Any], name: str) -> Binding:
    """Return what an author wrote as a formula of the engine; a lambda is called ``name`` in messages."""
    if isinstance(part, Bound) and part.formula.__name__ == LAMBDA:
        part.formula.__name__ = name
    return part if isinstance(part, Binding) else _formula(part, name)


def _formula(function: Any, name: str) -> Formula:
    if not isinstance(function, FunctionType):
        raise Misdeclared(
            Phrase(
                "{name} needs a formula, and {function} is none; write a lambda, or a def with @formula above it",
                name=name,
                function=repr(function),
            )
        )
    optional = [p.name for p in signature(function).parameters.values() if p.default is not p.empty]
    if optional:
        raise Misdeclared(
            Phrase(
                "the formula of {name} has a default for {optional}, which is never used: each parameter takes "
                "a quantity; remove it, or bind a number: bind(…, {first}=2)",
                name=name,
                optional=", ".join(optional),
                first=optional[0],
            )
        )
    return Formula(function, name)


def bound(part: Binding) -> Bound:
    """Let a formula that is not bound yet take the quantities of its parameters' own names.

    A choice by a text stands here for its first formula: what it takes does not depend on the text.
    """
    if isinstance(part, ByText):
        return part.options()[0]
    return part if isinstance(part, Bound) else _by_names(part)


@cache
def _by_names(formula: Formula) -> Bound:
    return bind(formula)
