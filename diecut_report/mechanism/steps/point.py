"""A point of the plane that is declared in one statement: the steps of its coordinates, and of what else a meeting has."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.formulas.expression import m
from diecut_report.mechanics.plane import Demand, Meeting, point
from diecut_report.mechanism.steps.base import Recipe, Step
from diecut_report.mechanism.steps.require import Require
from diecut_report.mechanism.steps.value import Value
from diecut_report.text.phrases import Phrase, phrase


def is_of_point(recipe: Recipe) -> bool:
    """Return whether what gives a quantity gives a point."""
    return recipe.make is Value and isinstance(recipe.args[0], tuple)


def steps_of_point(recipe: Recipe, id: str, symbol: str, *told: str) -> Iterator[Step]:
    """Yield the steps of a point: what must hold for it, and quantities that have its id, symbol and description in theirs."""
    gives, options = recipe.args[0], recipe.options
    unit, description, *source = told
    of = gives if isinstance(gives, Meeting) else point(gives)
    when: dict[str, Any] = {name: options[name] for name in ("needs", "lacks") if name in options}
    for each in of.parts(lambda name: m[f"{id}_{name}"]):
        words = Phrase(each.message, point=phrase(description))
        if isinstance(each, Demand):
            yield Require(f"{id}_{each.name}", each.condition, each.key, words, **when)
            continue
        own = Recipe(Value, (each.gives,), options if each.output else options | {"output": False})
        yield own.step(f"{id}_{each.name}", f"{each.letter}_{symbol.replace('_', ',')}", unit, words, *source)
