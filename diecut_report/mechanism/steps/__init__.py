"""The types of steps, each in one file, and their register: an import for each; what gives no single quantity is a call of a chapter."""
# mypy: implicit-reexport
# ruff: noqa: F401

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.steps.abscissa import Abscissa, Breakpoints
from diecut_report.mechanism.steps.base import (
    Options,
    Recipe,
    ResultName,
    SilentStep,
    Step,
    StepCondition,
    form,
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
        """Declare a quantity: what gives it, its symbol, its unit, its description and, if it is not the last step's, its source."""
        is_quantity = isinstance(declared, tuple) and declared and not isinstance(declared[0], str | Step)
        if name in self.__dataclass_fields__ and not is_quantity:
            object.__setattr__(self, name, declared)
        else:
            self[name] = declared

    def __setitem__(self, name: str, declared: Any) -> None:
        """Declare a quantity whose id is made of other names: ``chapter[f"force_{side}"] = …``."""
        if not isinstance(declared, tuple) or not 4 <= len(declared) <= 5:
            template = (
                "{id} = {given}; write what gives it, its symbol, its unit, its description and its source: "
                '… = m.radius / 2, "h", "mm", "Height", "geometry"'
            )
            raise Misdeclared(Phrase(template, id=name, given=repr(declared)))
        gives, *told = declared
        self.add((gives if isinstance(gives, Recipe) else Recipe(Value, (gives,), {})).step(name, *told))

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
