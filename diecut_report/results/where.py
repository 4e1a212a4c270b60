"""Where a number, an input or a check of a calculated press comes from: file and line, what it takes, its source."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config.instances import Instance
from diecut_report.errors import Problem, UnknownName, UserError, nearest
from diecut_report.machine.calculation import Calculation, number_unit
from diecut_report.machine.steps.needed import giver_of
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.names import formula_of
from diecut_report.mechanism.steps import Step, named
from diecut_report.quantities.formatting import told
from diecut_report.results.checks import checks_of
from diecut_report.results.mechanism import numbers
from diecut_report.results.origins import placed_inputs
from diecut_report.results.warm_press import WarmRun
from diecut_report.text.phrases import Phrase, phrase

INPUTS = "inputs."


@dataclass(frozen=True)
class FoundPlace:
    """Hold where something is declared or typed: its name, value in words, file and line, and what may be said of it beside that.

    ``formula`` is the place of its function where that stands elsewhere; ``takes`` are the places of what it takes, ``checks`` those of the
    checks that compare it.
    """

    name: str
    value: str = ""
    symbol: str = ""
    description: str = ""
    place: str = ""
    formula: str = ""
    source: str = ""
    takes: tuple[FoundPlace, ...] = ()
    checks: tuple[FoundPlace, ...] = ()


def where(run: WarmRun, name: str) -> FoundPlace:
    """Return where a name of the results (``drive.crank_torque``, ``drive.inputs.speed``, ``drive.checks.timing``) comes from.

    Raises UnknownName where nothing has that name, UserError where the mechanism is not calculated.
    """
    mechanism, _, own = name.partition(".")
    instance = run.config.instances.get(mechanism)
    if instance is None or not own or instance.mechanism is None:
        known = [each for each in run.config.kinds if run.config.instances.get(each)]
        near = "" if mechanism in known else nearest(mechanism, known)
        template = "write MECHANISM.NAME; the mechanisms are: {known}{nearest}"
        raise UnknownName(Problem(Phrase(template, known=", ".join(known), nearest=near), name))
    if mechanism not in run.calculations:
        raise UserError(Problem(phrase("this mechanism could not be calculated; `calc` tells why"), mechanism))
    return _PlaceFinder(instance, run.calculations[mechanism]).found(own)


class _PlaceFinder:
    """Finds the places of one mechanism."""

    def __init__(self, instance: Instance, calc: Calculation) -> None:
        self.instance, self.calc = instance, calc
        self.checks = {check.id: check for check in checks_of(calc)}
        self.inputs = {path: (id, value) for path, id, _, value in placed_inputs(calc)}

    def found(self, name: str) -> FoundPlace:
        """Return a quantity with what it takes and the checks that compare it; of an input or a check likewise."""
        if name.startswith("checks.") and name.removeprefix("checks.") in self.checks:
            return self.check(self.checks[name.removeprefix("checks.")], whole=True)
        if name.removeprefix(INPUTS) in self.inputs:
            return self.input(name.removeprefix(INPUTS))
        step = self._step(name)
        if step is None:
            groups = numbers(self.calc)
            own = (*(f"{INPUTS}{path}" for path in self.inputs), *(f"checks.{id}" for id in self.checks))
            near = nearest(name, [*groups["outputs"], *groups["values"], *own])
            message = Phrase("{kind} gives nothing of this name{nearest}", kind=self.calc.mechanism.kind, nearest=near)
            raise UnknownName(Problem(message, f"{self.instance.name}.{name}"))
        compared = tuple(self.check(check) for check in self.checks.values() if {name, step.id} & {*check.named})
        names = taken(step) - {step.id, getattr(step, "unknown", ""), getattr(step, "given", "")}
        takes = tuple(place for each in sorted(names) for place in self._places(each))
        return self.quantity(step, name, takes=takes, checks=compared)

    def quantity(self, step: Step, name: str, **more: tuple[FoundPlace, ...]) -> FoundPlace:
        """Return the place of what a step gives."""
        own = getattr(step, "formula", None)
        function = formula_of(own).place if own is not None else ""
        formula = "" if function == step.at else function
        whole, value = f"{self.instance.name}.{name}", self._value(step, name)
        return FoundPlace(whole, value, step.symbol, step.description, step.at, formula, step.source, **more)

    def input(self, path: str) -> FoundPlace:
        """Return the place where an input is typed, or that it is at its default."""
        meta = self.calc.meta[self.inputs[path][0]]
        key = tuple(int(part) if part.isdecimal() else part for part in path.split("."))
        problem = self.instance.place.problem(key, "")
        typed = self._typed(key)
        place = f"{problem.file}:{problem.line}" if typed else phrase("at its default, or taken from the press")
        symbol = meta.symbol if isinstance(meta, Quantity) else ""
        name, value = f"{self.instance.name}.{INPUTS}{path}", self._input_value(path, typed)
        return FoundPlace(name, value, symbol, meta.description, place)

    def check(self, check: Check, *, whole: bool = False) -> FoundPlace:
        """Return the place of a check, with its sides where it is asked for itself."""
        sides = tuple(place for name in check.named for place in self._places(name)) if whole else ()
        name = f"{self.instance.name}.checks.{check.id}"
        return FoundPlace(name, "", "", check.title, check.at, source=check.source, takes=sides)

    def _places(self, name: str) -> Iterator[FoundPlace]:
        """The place of what has this name: of an input in a list, of each part; of what is not given, none."""
        step = self._step(name)
        if step is not None:
            yield self.quantity(step, name)
            return
        own = name.removeprefix(INPUTS)
        yield from (self.input(path) for path, (id, _) in self.inputs.items() if own in (path, id))

    def _step(self, name: str) -> Step | None:
        return self.calc.steps.get(giver_of(name, self.calc.steps))

    def _value(self, step: Step, name: str) -> str:
        """A single number, or that of a part, or a text; empty for a curve or a whole row."""
        known = named(name, self.calc.steps)
        is_part = known is not None and known.role == "part"
        id, index = (step.id, known.index) if known and is_part else (name, 0)
        row = np.ravel(self.calc[id]) if id in self.calc.values else ()
        if index >= len(row) or (len(row) > 1 and not is_part):
            return ""
        value = row[index]
        if isinstance(value, str):
            return value
        return told(float(value), number_unit(self.calc, step.id, step, float(value))) if np.isfinite(value) else ""

    def _typed(self, key: Sequence[str | int]) -> str:
        try:
            typed = self.instance.place.typed(tuple(key))
        except (KeyError, IndexError, TypeError):
            return ""
        return "" if typed is None else str(typed)

    def _input_value(self, path: str, typed: str) -> str:
        """What was typed; of a reference or a default what it stands for, too."""
        name, value = self.inputs[path]
        meta = self.calc.meta[name]
        known = isinstance(meta, Quantity) and isinstance(value, float | np.ndarray) and np.size(value) == 1
        shown = told(float(np.ravel(value)[0]), meta.unit) if known and isinstance(meta, Quantity) else ""
        return typed or shown if "${" not in typed else ", ".join(filter(None, (shown, typed)))


def lines(found: FoundPlace) -> Iterator[str]:
    """Yield what is known of a place, line by line."""
    yield _line(found)
    if found.description:
        yield f"  {found.symbol}  {phrase(found.description)}" if found.symbol else f"  {phrase(found.description)}"
    if found.formula:
        yield Phrase("  formula: {place}", place=_from_here(found.formula))
    if found.source:
        yield Phrase("  source: {source}", source=phrase(found.source))
    for head, places in ((phrase("  inputs:"), found.takes), (phrase("  used by checks:"), found.checks)):
        if places:
            yield head
            yield from (f"    {_line(each)}" for each in places)


def _line(found: FoundPlace) -> str:
    value = f" = {found.value}" if found.value else ""
    return f"{found.name}{value}  ({_from_here(found.place)})"


def _from_here(place: str) -> str:
    """A place as it is named from the current folder, where it lies in it."""
    return place.removeprefix(f"{Path.cwd()}{os.sep}")


def data(found: FoundPlace) -> dict[str, Any]:
    """Return the same as plain data."""
    parts = {
        key: [data(part) for part in each] if isinstance(each, tuple) else each for key, each in vars(found).items()
    }
    return {key: each for key, each in parts.items() if each}
