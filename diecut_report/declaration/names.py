"""What a mechanism's names stand for: which step or input gives each, when, and whether it is a number, a row or a curve."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from diecut_report.contract.code_steps import ComputedCurve, Fact, PartCurves, PartNames, PartTable
from diecut_report.contract.inputs import CurveInput, MechanismInput, PhaseInput, Quantity, Text
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import Lookup, Neighbour, Running
from diecut_report.contract.result_names import has_own_names, names_ahead, read
from diecut_report.contract.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Choice,
    Clash,
    Computed,
    Crossings,
    Derivative,
    FromCurve,
    Phase,
    Prepared,
    Reduction,
    Require,
    Step,
    Value,
    Words,
)
from diecut_report.contract.varying import Varying
from diecut_report.declaration.world import Key, When, World, world

NO_QUANTITY = Breakpoints | Require | Clash | Phase | PartTable | PartCurves | Fact


class Giver(NamedTuple):
    """What gives a name: an input, or a step at a place in the order; when, and what it is."""

    when: When
    kind: str  # number, row, curve, abscissa, crossings, text, curve input, block
    axis: str  # of a curve its abscissa, of a row its list
    unit: str | None
    step: Step | None = None
    number: int = -1
    units: tuple[tuple[str, str], ...] = ()

    def units_when(self, needs: Iterable[str]) -> set[str]:
        """Return the units that it may have where these inputs are given."""
        held = {other for key, other in self.units if key in needs}
        return held or {other for _, other in self.units} | ({self.unit} if self.unit else set())


@dataclass(frozen=True)
class DeclaredNames:
    """All names of a mechanism."""

    mechanism: Mechanism

    @cached_property
    def world(self) -> World:
        """What may be given, with the facts that may hold."""
        found = world(self.mechanism.inputs)
        found.keys |= {name: Key(name, None, None, is_block=False, may_be_absent=True) for name in self.mechanism.facts}
        return found

    def when(self, number: int) -> When:
        """Return when a step is made."""
        section, step = self.mechanism.steps[number]
        return When(frozenset(section.needs + step.needs), frozenset(step.lacks))

    @cached_property
    def known(self) -> dict[str, list[Giver]]:
        """Each name with all that gives it, inputs first, then steps in their order."""
        found: dict[str, list[Giver]] = {}
        for key in self.world.keys.values():
            for name in (key.path, f"inputs.{key.path}"):
                found.setdefault(name, []).append(_input(key))
        for number, (_, step) in enumerate(self.mechanism.steps):
            for name, giver in self._given(number, step, found):
                found.setdefault(name, []).append(giver)
        return found

    def _given(self, number: int, step: Step, found: dict[str, list[Giver]]) -> Iterator[tuple[str, Giver]]:
        if isinstance(step, NO_QUANTITY):
            return
        when = self.when(number)
        for kind, axis in _kinds(step, found):
            yield (
                step.id,
                Giver(
                    when,
                    kind,
                    axis,
                    None if kind in ("text", "prepared", "list of parts") else step.unit,
                    step,
                    number,
                    step.units,
                ),
            )
        for each in names_ahead(step):
            if each.role == "place" and isinstance(step, Reduction):
                places = [axis for curve in found.get(step.of, ()) for axis in found.get(curve.axis, ())]
                own, forms = (places[0].unit, places[0].units) if places else (None, ())
                yield each.name, Giver(when, "number", "", own, step, number, forms)
            if each.role == "count":
                yield each.name, Giver(when, "number", "", "1", step, number)

    def givers(self, name: str) -> list[Giver]:
        """Return what gives a name; of several crossings or numbered parts one that has a name of its own."""
        return self.known.get(name) or list(self._numbered(name))

    def _numbered(self, name: str) -> Iterator[Giver]:
        for number, (_, step) in enumerate(self.mechanism.steps):
            found = read(name, step) if has_own_names(step) else None
            if found and found.role in ("crossing", "part"):
                yield Giver(self.when(number), "number", "", step.unit, step, number)

    def kinds(self, name: str) -> set[str]:
        """Return what a name may be: number, row, curve, …"""
        return {giver.kind for giver in self.givers(name)}

    def axes(self, name: str) -> set[str]:
        """Return the abscissas or lists that a name may run over; of an abscissa itself."""
        return {giver.axis for giver in self.givers(name) if giver.axis}

    def missing(self, name: str, when: When, before: int | None = None) -> dict[str, str | None] | None:
        """Return what is given where a name is wanted and nothing (before a step) gives it; None where that cannot be."""
        givers = [g.when for g in self.givers(name) if before is None or g.number < before]
        return self.world.example(when, givers)


def _input(key: Key) -> Giver:
    when = When(frozenset((key.path,)) if key.may_be_absent or "." in key.path else frozenset())
    kind = "row" if key.home else "number"
    match key.meta:
        case _ if key.is_block:
            kind = "block"
        case Varying():
            return Giver(when, "varying", key.home, key.meta.unit)
        case Quantity():
            return Giver(when, kind, key.home, key.meta.unit, units=key.meta.units)
        case PhaseInput():
            return Giver(when, "phase", key.home, key.meta.unit)
        case MechanismInput():
            return Giver(when, "mechanism", key.home, None)
        case CurveInput():
            return Giver(when, "curve input", "", key.meta.unit, units=key.meta.units)
        case Text():
            kind = "text"
    return Giver(when, kind, key.home, None)


def _kinds(step: Step, found: dict[str, list[Giver]]) -> set[tuple[str, str]]:
    """What a step may give: the kind, and the abscissa or the list that it runs over."""

    def over(*names: str) -> set[tuple[str, str]]:
        axes = {
            (g.kind, g.axis) for name in names for g in found.get(name, ()) if g.kind in ("curve", "abscissa", "row")
        }
        return {("curve" if kind == "abscissa" else kind, axis) for kind, axis in axes}

    match step:
        case Words():
            return {("text", "")}
        case Prepared():
            return {("prepared", "")}
        case Choice(cases=cases) if cases and isinstance(cases[0].value, str):
            return {("text", axis) for _, axis in over(*_names(step))} or {("text", "")}
        case Abscissa():
            return {("abscissa", step.id)}
        case Computed(is_text=True):
            return {("text", "")}
        case PartNames():
            return {("list of parts", "")}
        case FromCurve(abscissa=axis) | ComputedCurve(abscissa=axis):
            return {("curve", axis)}
        case Crossings():
            return {("crossings", "")}
        case Accumulated(of=of) | Derivative(of=of):
            return over(of) or {("curve", "")}
        case Neighbour(of=of) | Running(of=of):
            return over(of) or {("row", "")}
        case Computed(over=list_path) if list_path:
            return {("row", list_path)}
        case Lookup(by=by):
            homes = {g.axis for g in found.get(by, ()) if g.axis}
            return {("row", home) for home in homes} or {("number", "")}
        case Value() | Choice():
            return over(*_names(step)) or {("number", "")}
    return {("number", "")}


def _names(step: Value | Choice) -> list[str]:
    return [name for name in step.takes() if isinstance(name, str)]
