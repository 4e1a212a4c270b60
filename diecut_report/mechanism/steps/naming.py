"""The names in a step: which quantities it takes, and the same step with others."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from typing import Any

from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.names import ByText
from diecut_report.mechanism.steps.base import Step
from diecut_report.mechanism.steps.choice import Case
from diecut_report.mechanism.steps.result_names import names_ahead

Rename = Callable[[str], str]


def prefixed(prefix: str, steps: Iterable[Step], shared: tuple[str, ...], symbol_suffix: str = "") -> tuple[Step, ...]:
    """Return one family of steps for another variant: each id gets the prefix, except what is ``shared`` by all variants."""
    steps = tuple(steps)
    own_steps = [step for step in steps if step.id not in shared]
    own = {step.id for step in own_steps} | {
        e.name for step in own_steps if not step.numbered for e in names_ahead(step)
    }

    def rename(name: str) -> str:
        return f"{prefix}{name}" if name in own else name

    return tuple(
        replace(
            step,
            id=rename(step.id),
            symbol=step.symbol + symbol_suffix,
            source_symbol=step.source_symbol and step.source_symbol + symbol_suffix,
            **_renamed(step, rename),
        )
        for step in steps
    )


def with_texts(step: Step, given: frozenset[str]) -> Step:
    """Return the step with the formulas that a text chooses, where the text is known."""

    def settle(part: Any) -> Any:
        match part:
            case ByText(key=key, formulas=formulas):
                chosen = [text for text in formulas if f"{key}={text}" in given]
                return part.of(chosen[0]) if chosen else part
            case Case():
                return part.mapped(settle)
            case tuple():
                return tuple(map(settle, part))
        return part

    chosen_by_text = {name: own for name in _fields(step) if _holds_text(own := getattr(step, name))}
    return replace(step, **{name: settle(part) for name, part in chosen_by_text.items()}) if chosen_by_text else step


def _holds_text(part: Any) -> bool:
    match part:
        case ByText():
            return True
        case Case(value=value, condition=condition):
            return _holds_text(value) or _holds_text(condition)
        case tuple():
            return any(map(_holds_text, part))
    return False


def _fields(step: Step) -> tuple[str, ...]:
    return tuple(name for name in (*step.TAKES, *step.FORMULAS, "exists") if step.__dataclass_fields__[name].init)


@cache
def taken(step: Step) -> frozenset[str]:
    """Return the ids that a step names: inputs, and what earlier steps gave."""
    names: set[str] = set()

    def note(name: str) -> str:
        if name:
            names.add(name)
        return name

    _renamed(step, note)
    return frozenset(names)


def _renamed(step: Step, rename: Rename) -> dict[str, Any]:
    def walk(part: Any) -> Any:
        match part:
            case str():
                return rename(part)
            case Formula():
                return part if all(rename(name) == name for name in part.parameters) else part.renamed(rename)
            case ByText():
                return part.renamed(rename)
            case Case():
                return part.mapped(walk)
            case tuple():
                return tuple(map(walk, part))
        return part

    return {name: walk(getattr(step, name)) for name in _fields(step)}
