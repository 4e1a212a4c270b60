"""The types of steps, each in one file, and their register: an import for each; what gives no single quantity is a call of a chapter."""
# mypy: implicit-reexport
# ruff: noqa: F401

from __future__ import annotations

import reprlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from diecut_report.errors import nearest
from diecut_report.formulas.expression import Expression
from diecut_report.mechanism.names import Misdeclared, ids
from diecut_report.mechanism.steps.abscissa import Abscissa, Breakpoints
from diecut_report.mechanism.steps.base import (
    Options,
    QuantityStep,
    Recipe,
    ResultName,
    SilentStep,
    Step,
    StepCondition,
    form,
    name_of_call,
    recipe,
)
from diecut_report.mechanism.steps.choice import Case, Choice, case
from diecut_report.mechanism.steps.code_curves import ComputedCurve, PartCurves
from diecut_report.mechanism.steps.computed import Computed, Words
from diecut_report.mechanism.steps.from_curve import CurvePeriod, FromCurve, MadeCurve
from diecut_report.mechanism.steps.interpolated import Interpolated
from diecut_report.mechanism.steps.lookup import Lookup
from diecut_report.mechanism.steps.phase import PREFIX, ROLES, Phase
from diecut_report.mechanism.steps.pick import Pick
from diecut_report.mechanism.steps.point import is_of_point, steps_of_point
from diecut_report.mechanism.steps.prepared import Cell, ListedColumn, Listing, Prepared
from diecut_report.mechanism.steps.reduction import Crossings, Reduction
from diecut_report.mechanism.steps.require import Clash, Fact, Require
from diecut_report.mechanism.steps.result_names import (
    CROSSING_COLUMNS,
    count_name,
    has_own_names,
    named,
    names_ahead,
    numbered_symbol,
    part_result,
    pattern,
    place_name,
    read,
    result_names,
)
from diecut_report.mechanism.steps.root import Root
from diecut_report.mechanism.steps.rows import Neighbour, Part, PartNames, PartTable, Running, Total
from diecut_report.mechanism.steps.self_test import SelfTest
from diecut_report.mechanism.steps.series import Accumulated, Derivative
from diecut_report.mechanism.steps.value import Value
from diecut_report.text.phrases import Phrase


@dataclass(eq=False)
class Steps:
    """Hold declared steps in the order in which they are calculated; a family of them may be added to several chapters."""

    steps: Sequence[Step] = field(default=(), kw_only=True)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def add(self, *steps: Step | Iterable[Any]) -> None:
        """Add steps that are declared elsewhere: a family, several of them, or what several chapters share."""
        for step in steps:
            if isinstance(step, Step):
                if any(step is other for other in self.steps):
                    raise Misdeclared(Phrase("{id} is added twice; add it once", id=step.id))
                self.steps = (*self.steps, step)
            else:
                self.add(*step)

    def __setattr__(self, name: str, declared: Any) -> None:
        """Declare a quantity: what gives it, its symbol, its unit, its description and, if it is not the last step's, its source.

        A point of the plane (``mechanics.plane``) is two, ``NAME_x`` and ``NAME_y``.
        """
        is_quantity = isinstance(declared, tuple) and declared and not isinstance(declared[0], str | Step)
        if name in self.__dataclass_fields__ and not (is_quantity and len(declared) > 1):
            object.__setattr__(self, name, ids(declared))
        else:
            self[name] = declared

    def __setitem__(self, name: str, declared: Any) -> None:
        """Declare a quantity whose id is made of other names: ``chapter[f"force_{side}"] = …``."""
        if not isinstance(declared, tuple) or not 4 <= len(declared) <= 5:
            template = (
                "{id} = {given}; write what gives it, its symbol, its unit, its description and, where there is one, its source: "
                '… = m.radius / 2, "h", "mm", "Height", "geometry"'
            )
            raise Misdeclared(Phrase(template, id=name, given=_shown(declared)))
        gives, *told = declared
        given = gives if isinstance(gives, Recipe) else Recipe(Value, (gives,), {})
        self.add(steps_of_point(given, name, *told) if is_of_point(given) else given.step(name, *told))

    def __getattr__(self, name: str) -> Any:
        """Raise AttributeError: a chapter gives no quantities back, and quantities are declared by assigning them."""
        raise AttributeError(_unknown(name, {each.id for each in self.__dict__.get("steps", ())}))

    breakpoints = form(Breakpoints.of)
    part_names = form(PartNames)
    part_table = form(PartTable)
    part_curves = form(PartCurves)
    prepared = form(Prepared)
    listing = form(Listing)
    fact = form(Fact)
    require = form(Require)
    clash = form(Clash)
    words = form(Words)
    phase = form(Phase.of)


# What an author writes in place of a quantity's declaration, in words.


def _shown(declared: Any) -> str:
    """Return what is assigned as a line of text."""
    if isinstance(declared, tuple):
        return ", ".join(map(_shown, declared))
    return repr(declared) if isinstance(declared, Recipe | Expression) else reprlib.repr(declared)


def _unknown(name: str, quantities: set[str]) -> str:
    """Return what is said of a name that a chapter does not have: a quantity of it, a way to give one, or a call that is misspelt."""
    if name in quantities:
        return Phrase("a chapter does not give {name} back; in an expression write m.{name}", name=name)
    if name == "inner" or name in map(name_of_call, _types(QuantityStep)):
        template = 'a chapter has no call {name}; say how a quantity is given where it is declared: chapter.ID = {name}(…), "h", "mm", "Height"'
        return Phrase(template, name=name)
    calls = sorted(each for each, own in vars(Steps).items() if callable(own) and not each.startswith("_"))
    template = "a chapter has no call {name}{near}; it has {calls}, and a quantity is declared by chapter.ID = …"
    return Phrase(template, name=name, near=nearest(name, calls), calls=", ".join(calls))


def _types(base: type[Step]) -> Iterator[type[Step]]:
    for each in base.__subclasses__():
        yield each
        yield from _types(each)
