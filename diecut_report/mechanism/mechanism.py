"""A mechanism: the whole of what a plugin declares."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, lru_cache, reduce, wraps
from itertools import product
from typing import Any, TypeVar

import numpy as np

from diecut_report.mechanism.chapters import Chapter, in_unit
from diecut_report.mechanism.check_sides import CheckSides
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.curve_inputs import CurveInput, InOtherUnit
from diecut_report.mechanism.figures import Figure, Spectrum
from diecut_report.mechanism.inputs import Inputs, fields, keys, list_inputs, rules
from diecut_report.mechanism.names import Misdeclared, When, ids, placed, with_ids
from diecut_report.mechanism.steps import Fact, Phase, SelfTest, SilentStep, Step, names_ahead, read
from diecut_report.mechanism.steps.naming import with_texts
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase

# What plain code gets of one among many machines: the values of its inputs, the mechanisms that it names, what was made of it.


class Machines(tuple[Any, ...]):
    """Hold what plain code made of each of many machines; None of one that cannot be."""

    __slots__ = ()


def of_machine(value: Any, row: int, count: int) -> Any:
    """Return what a value of many machines is of one of them: arrays with one row, texts as they are."""
    match value:
        case Machines():
            return value[row]
        case InOtherUnit():
            own: Any = value.value
            return replace(value, value=own if np.ndim(own) == 0 or len(own) == 1 else own[row])
        case np.ndarray() if value.shape[:1] == (count,):
            return value[row : row + 1]
        case tuple():
            return tuple(of_machine(each, row, count) for each in value)
    return value.of_machine(row) if hasattr(value, "of_machine") else value


# An example of a kind: values with which it can be calculated, and how it is wired to mechanisms of other kinds.
#
# A value is written as in a configuration: a number in the key's display unit, a text such as ``"40 mm"``, a list, a block of keys.


Made = TypeVar("Made")
KIND = re.compile(r"<([^<>\s]+)>")


@dataclass(frozen=True)
class Wired:
    """Take a value where a press has the kinds that it names, and ``otherwise`` another one; None leaves the key or the part out.

    ``value`` is written as in a configuration, with ``<KIND>`` in the place of a mechanism's name:
    ``Wired("${<cylinder_sizing>.mass}", otherwise="80 kg")``. ``needs`` are kinds that it does not name itself.
    """

    value: Any
    otherwise: Any = None
    needs: tuple[str, ...] = ()

    @property
    def kinds(self) -> tuple[str, ...]:
        """Return the kinds that must be there, in the order in which they are named."""
        return tuple(dict.fromkeys((*self.needs, *kinds_named(self.value))))


@dataclass(frozen=True)
class ForEach:
    """Declare a part of a list for each mechanism of a kind that a press has: ``ForEach("clutch", {"mechanism": "<clutch>"})``."""

    kind: str
    part: Any


@dataclass(frozen=True, eq=False)
class ExampleBlock:
    """Declare the name and the inputs of an example of a kind, by which ``diecut-report new`` begins a configuration.

    ``press`` are values of the press that the example is made for, by their paths: ``{"productivity": "1200 1/h"}``.
    """

    name: str
    inputs: Mapping[str, Any]
    press: Mapping[str, Any] = field(default_factory=dict)
    at: str = placed()


def kinds_named(value: Any) -> Iterator[str]:
    """Yield the kinds that a value names, without what stands in the wired values in it."""
    match value:
        case str():
            yield from KIND.findall(value)
        case dict():
            for part in value.values():
                yield from kinds_named(part)
        case list() | tuple():
            for part in value:
                yield from kinds_named(part)


def axes(steps: tuple[Step, ...], inputs: type[Inputs]) -> dict[str, str]:
    """Return for each curve its abscissa, for each row over repeated parts its list; single numbers are left out."""
    found = dict(list_inputs(inputs))
    for step in steps:
        if axis := step.runs_over(found):
            found[step.id] = axis
    return found


def made_when(chapter: Chapter, step: Step) -> When:
    """Return when a step of a chapter is made."""
    return When(frozenset(chapter.needs + step.needs), frozenset(step.lacks))


def of_given(make: Callable[[Any, frozenset[str]], Made]) -> Callable[[Any, frozenset[str]], Made]:
    """Remember what follows from the inputs that are given, of each mechanism, which is declared once."""
    known = lru_cache(maxsize=1024)(make)
    return wraps(make)(lambda mechanism, given: known(mechanism, given))


@dataclass(frozen=True, eq=False)
class Source:
    """Declare a publication that formulas come from."""

    id: str
    citation: str
    at: str = placed()


@dataclass(frozen=True, eq=False)
class Erratum:
    """Declare a mistake found in a source, and the quantities (ids) that it touches."""

    source: str
    text: str
    touches: tuple[str, ...] = ()
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Port:
    """Declare a shaft of the mechanism that a part of the machine stands for, by the ids of its curves over one cycle of the mechanism.

    ``torque`` is what the mechanism takes from the shaft. ``forces`` act on the part: along the line from the turning shaft's axis to the
    other one's, and across it, to the left where the turning shaft turns anticlockwise; a single one acts along the line. ``opposite`` where
    they act the other way.
    ``angle`` is that of a shaft which swings or turns in steps, ``backwards`` where it is counted against the turning of the other shaft.
    ``acceleration`` is its angular acceleration, by which the inertia of what turns with it counts.
    ``speed`` is the input with the speed of one that turns. ``joint`` are the force in the joint of its pin and the angle that the joint's
    parts turn by, nothing where they turn with the shaft. ``advance`` is the input whose reciprocal is the part of a revolution by which a
    shaft that turns in steps has moved on after a cycle. ``radius`` are the numbers whose product is the distance of the part's pin, or of the
    mouths of its slots, from the shaft's axis. ``fills`` gives inputs of the mechanism by what the shaft's join provides: ratio, efficiency,
    pinion_radius, teeth, pitch, inertia, and by the shafts' own: own_inertia, driven_inertia.
    """

    name: str
    torque: str = ""
    forces: tuple[str, ...] = ()
    opposite: bool = False
    angle: str = ""
    backwards: bool = False
    acceleration: str = ""
    speed: str = ""
    joint: tuple[str, str] = ("", "")
    advance: str = ""
    radius: tuple[str, ...] = ()
    fills: Mapping[str, str] = field(default_factory=dict)
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Profile:
    """Declare curves over one abscissa that are written beside the report as tables and drawings: ``columns`` are x, y, and more.

    ``needs`` as for steps.
    """

    id: str
    title: str
    columns: tuple[str, ...]
    needs: tuple[str, ...] = ()
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class CurveTable(Profile):
    """Declare that all curves over an abscissa, the only one of ``columns``, are written beside the report as a table."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Declare what is calculated last, from the results of mechanisms of the named kinds, where a press has one of each.

    ``takes`` fills the inputs of ``mechanism`` by the kind and the id of an output, input or curve there; what is absent there
    leaves its input without a value.
    """

    kinds: tuple[str, ...]
    mechanism: Mechanism
    takes: Mapping[str, tuple[str, str]]
    at: str = placed()

    def __post_init__(self) -> None:
        foreign = [key for key, (kind, _) in self.takes.items() if kind not in self.kinds]
        if foreign or self.mechanism.checks:
            template = "{kind}: a comparison has no checks, and takes from its own kinds only"
            raise Misdeclared(Phrase(template, kind=self.mechanism.kind))


@dataclass(frozen=True, kw_only=True, eq=False)
class Partner:
    """Declare another mechanism that a kind takes inputs from: the one that the text input ``key`` names, else the only one of its kinds.

    ``takes`` gives for inputs of this kind the id of a result or the path of an input there; what is given in the block, or is
    absent there, is not taken. Where a press has none of these kinds, checks that need what they give do not apply, unless every
    press must have one (``always``). One whose input refers to a mechanism of the kind that ``unless`` names for it is not meant.
    """

    key: str
    kinds: tuple[str, ...]
    takes: Mapping[str, str]
    always: bool = False
    unless: Mapping[str, str] = field(default_factory=dict)
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Mechanism:
    """Declare a kind of mechanism: inputs, calculation, checks, figures, and what is said of it in the report.

    ``key_results`` are the ids of the outputs that the report's summary shows. ``example`` are inputs with which a configuration begins.
    ``reactions`` are the curves of the forces on what carries it, which another mechanism of the machine is to take.
    """

    kind: str
    version: str
    title: str
    summary: str
    inputs: type[Inputs]
    chapters: tuple[Chapter, ...]
    key_results: tuple[str, ...] = ()
    checks: tuple[Check, ...] = ()
    figures: tuple[Figure, ...] = ()
    assumptions: tuple[str, ...] = ()
    sources: tuple[Source, ...] = ()
    errata: tuple[Erratum, ...] = ()
    exports: tuple[Profile, ...] = ()
    comparisons: tuple[Comparison, ...] = ()
    partners: tuple[Partner, ...] = ()
    ports: tuple[Port, ...] = ()
    reactions: tuple[str, ...] = ()
    spectra: tuple[Spectrum, ...] = ()
    example: ExampleBlock | None = None
    at: str = placed()

    def __post_init__(self) -> None:
        for name in (
            "key_results",
            "checks",
            "figures",
            "errata",
            "exports",
            "partners",
            "ports",
            "reactions",
            "spectra",
        ):
            object.__setattr__(self, name, ids(with_ids(getattr(self, name))))
        object.__setattr__(self, "checks", self._full_checks())

    def _full_checks(self) -> tuple[Check, ...]:
        """The checks with what follows from the quantities that they compare, and those of self-tests; as they are where a part has another shape."""
        model: Any = self.inputs  # as an author wrote it
        has_inputs = isinstance(model, type) and issubclass(model, Inputs)
        if not (has_inputs and _all_are(Chapter, self.chapters) and _all_are(Check, self.checks)):
            return self.checks
        steps = [step for chapter in self.chapters for step in chapter.steps]
        known = {(check.id, check.at) for check in self.checks}
        tests = (step.as_check for step in steps if isinstance(step, SelfTest))
        every = (*self.checks, *(check for check in tests if (check.id, check.at) not in known))
        return tuple(map(CheckSides(steps, self.inputs).full, every))

    @cached_property
    def steps(self) -> tuple[tuple[Chapter, Step], ...]:
        """Return all steps in the order in which they are calculated, each with its chapter."""
        return tuple((chapter, step) for chapter in self.chapters for step in chapter.steps)

    @of_given
    def active(self, given: frozenset[str]) -> tuple[tuple[Chapter, Step], ...]:
        """Return the steps that take part when these optional inputs (and texts, as ``key=value``) are given.

        They have the unit that holds then, and the formulas that the texts choose.
        """
        held = ((chapter, step) for chapter, step in self.steps if made_when(chapter, step).holds(given))
        return tuple((chapter, with_texts(in_unit(step, given), given)) for chapter, step in held)

    def steps_by_id(self, given: frozenset[str]) -> dict[str, Step]:
        """Return those steps by their ids, in a new dictionary."""
        return {step.id: step for _, step in self.active(given)}

    @cached_property
    def facts(self) -> frozenset[str]:
        """Return the facts that steps may need: each counts as given until a machine turns out not to meet it."""
        return frozenset(step.id for _, step in self.steps if isinstance(step, Fact))

    @of_given
    def results_of(self, given: frozenset[str]) -> Mapping[str, tuple[str | None, bool]]:
        """Return what a reference may name, without calculating: the SI unit (None for a text), and whether it is a curve."""
        found: dict[str, tuple[str | None, bool]] = {}
        for _, step in self.active(given):
            if isinstance(step, SilentStep):
                continue
            si = unit(step.unit).si
            for each in names_ahead(step):
                axis = self.axis_of(step.asked_curve, given) if each.role == "place" else None
                of_place = found[axis][0] if axis in found else None
                found[each.name] = {"count": "1", "place": of_place}.get(each.role, si), False
            if not step.is_counted:
                found[step.id] = None if step.is_text else si, self.axis_of(step.id, given) is not None
        return found

    def phases_of(self, given: frozenset[str]) -> dict[str, str]:
        """Return the ids of the phases that take part, each with the SI unit of its abscissa."""
        units = {step.id: unit(step.unit).si for _, step in self.active(given)}
        return {step.id: units[step.abscissa] for _, step in self.active(given) if isinstance(step, Phase)}

    def axis_of(self, name: str, given: frozenset[str]) -> str | None:
        """Return the abscissa that a quantity runs over, or the list whose parts it has a row for; None for a single number."""
        return self.axes(given).get(name)

    @of_given
    def axes(self, given: frozenset[str]) -> dict[str, str]:
        """Return for each curve its abscissa, for each row over repeated parts its list; single numbers are left out."""
        return axes(tuple(step for _, step in self.active(given)), self.inputs)

    @cached_property
    def curve_inputs(self) -> frozenset[str]:
        """Return the inputs that are curves."""
        return frozenset(name for name, meta in fields(self.inputs) if isinstance(meta, CurveInput))


def _all_are(kind: type, given: object) -> bool:
    return isinstance(given, tuple | list) and all(isinstance(each, kind) for each in given)


# The number of the contract between the program and its plugins: it grows when a plugin that was written before would no longer run.


CONTRACT = 2


# What a check still needs: the optional inputs without which it is not made, as far as the declarations tell.


@lru_cache(maxsize=4096)
def missing_keys(mechanism: Mechanism, check: Check, given: frozenset[str]) -> tuple[str, ...] | None:
    """Return the keys that must be given beside the given ones for a check to be made, of several ways the shortest.

    None where it does not apply to this machine: a text, a block, a list or an alternative that it needs was not chosen.
    Empty where nothing is missing. Keys stand in the order in which they are declared.
    """
    if not given.issuperset(check.only_with):
        return None
    found = []
    for chosen in product(*(list(_givers(mechanism, name)) for name in check.named)):
        when = reduce(When.with_, chosen, When(frozenset(check.needs)))
        if not when.lacks & given:
            missing = _settling(mechanism, when.needs - given) - given
            found.append(_completing(mechanism, missing, given, check.asks_for))
    shortest = min((each for each in found if each is not None), key=len, default=None)
    if shortest is None:
        return None
    order = {path: number for number, path in enumerate(keys(mechanism.inputs))}
    return tuple(sorted(shortest, key=lambda key: (order.get(key, len(order)), key)))


def absent_partners_checks(mechanism: Mechanism, kinds: Collection[str], given: frozenset[str]) -> frozenset[str]:
    """Return the ids of the checks that need what only kinds give of which a press has none, or apply beside such kinds alone."""
    absent = [each for each in mechanism.partners if not each.always and not set(each.kinds) & set(kinds)]
    lost = {key for partner in absent for key in (partner.key, *partner.takes)}
    return frozenset(
        check.id
        for check in mechanism.checks
        if (check.only_beside and not set(check.only_beside) & set(kinds))
        or lost.intersection(missing_keys(mechanism, check, given) or ())
    )


@cache
def without_checks(mechanism: Mechanism, ids: frozenset[str]) -> Mechanism:
    """Return a mechanism kind without some of its checks; the same object for the same ones, as calculations are remembered by it."""
    if not ids:
        return mechanism
    found = copy(mechanism)
    object.__setattr__(found, "checks", tuple(check for check in mechanism.checks if check.id not in ids))
    return found


def _givers(mechanism: Mechanism, name: str) -> Iterator[When]:
    """When an input is there, or each of the steps that give a quantity."""
    if name.removeprefix("inputs.") in keys(mechanism.inputs):
        yield When(frozenset((name.removeprefix("inputs."),)))
    yield from (made_when(chapter, step) for chapter, step in mechanism.steps if read(name, step))


def _settling(mechanism: Mechanism, missing: frozenset[str]) -> frozenset[str]:
    first = {step.id: step.lacks[0] for _, step in mechanism.steps if isinstance(step, Fact) and step.lacks}
    groups = {group[0]: group for _, rule in rules(mechanism.inputs) for group in rule.groups}
    return frozenset().union(
        *(groups.get(first[each], (first[each],)) if each in first else (each,) for each in missing)
    )


def _completing(
    mechanism: Mechanism, missing: frozenset[str], given: frozenset[str], blocks: tuple[str, ...]
) -> frozenset[str] | None:
    """The missing keys and ``blocks``, if they can be given beside the given ones; None where that would be another machine."""
    known_keys = keys(mechanism.inputs)
    if any(key not in known_keys or (known_keys[key].block and key not in blocks) for key in missing):
        return None
    missing = frozenset(key for key in missing if key.rpartition(".")[0] not in missing)  # a block is missed as a whole
    if any(key.rpartition(".")[0] not in given for key in missing if "." in key):  # of a block that is not there
        return None
    known = {key for key in given if "=" not in key}
    for home, rule in rules(mechanism.inputs):
        if not rule.when or f"{home}{rule.when}" in given:
            own, more = (
                {k.removeprefix(home) for k in some if k.startswith(home)} for some in (known, known | missing)
            )
            if (fault := rule.fault(more)) and rule.fault(own) != fault:
                return None
    return missing
