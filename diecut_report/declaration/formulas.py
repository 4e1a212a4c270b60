"""Steps: each id is given once and above what takes it; each formula can be read and printed; each takes what it can."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from inspect import signature
from itertools import chain, combinations
from typing import Any

from diecut_report.declaration.names import DeclaredNames, Fault, fault, kinds_told, short, unknown, where
from diecut_report.formulas.expression import FormulaError
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import ByText, When, formula_of
from diecut_report.mechanism.steps import SilentStep, Step
from diecut_report.mechanism.steps.protocols import TakenName
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, named, phrase

# Ids: each is given once, and given before it is taken, whatever inputs are given.


def order_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the ids that are doubled, never made, not given, or taken too early."""
    yield from pairs(names, phrase("another step"), names.steps)
    for another, several in (
        (phrase("another figure"), names.mechanism.figures),
        (phrase("another export"), names.mechanism.exports),
    ):
        yield from pairs(names, another, [(each, When(frozenset(each.needs))) for each in several])
    yield from _in_two_chapters(names)
    for number, (step, when) in enumerate(names.steps):
        if names.world.example(when) is None:
            yield fault(step, phrase("is never calculated: what it needs and what it lacks are never given together"))
            continue
        if not isinstance(step, SilentStep) and not (step.symbol and step.description):
            yield fault(step, phrase("has no symbol or no description"))
        for name in sorted(name for name in taken(step) if name not in step.own_names):
            late = name == getattr(step, "shown_at", "") or step.is_made_late
            text = lacking(names, name, names.without(when, step.instead), None if late else number)
            if text:
                yield fault(step, Phrase("takes {text}", text=text))


def lacking(names: DeclaredNames, name: str, when: When, before: int | None = None) -> str:
    """Return in words why a name is not known (before a step) where it is wanted; empty where it always is."""
    givers = names.givers(name)
    if not givers:
        return unknown(name, names.known)
    given = names.missing(name, when, before)
    if given is None:
        return ""
    later = [giver for giver in givers if before is not None and giver.number >= before]
    if later and names.missing(name, when) is None:
        place = short(later[0].step.at) if later[0].step else ""
        template = "{name} before it is calculated (at {place}); move that step up, or this one down"
        return Phrase(template, name=name, place=place)
    key = names.world.keys.get(name.removeprefix("inputs."))
    home = names.world.keys.get(key.home) if key else None
    if home and home.may_be_absent and home.path not in when.needs:
        template = (
            '{name}, but {home} may have no parts, by its default; write needs=("{home}",), or take its default away'
        )
        return Phrase(template, name=name, home=home.path)
    tokens = set().union(*(part for each in (when, *(giver.when for giver in givers)) for part in each))
    template = "{name}, which nothing gives{where}; give it there too, or leave this out by needs or lacks"
    return Phrase(template, name=name, where=where(given, tokens))


def _in_two_chapters(names: DeclaredNames) -> Iterator[Fault]:
    """Steps that stand in two chapters which are both calculated."""
    for first, second in combinations(names.mechanism.chapters, 2):
        shared = [step for step in second.steps if first is not second and any(step is other for other in first.steps)]
        whens = {s.id: When(frozenset(first.needs + second.needs + s.needs), frozenset(s.lacks)) for s in shared}
        if doubled := [id for id, both in whens.items() if names.world.example(both) is not None]:
            template = (
                "has {doubled} of another chapter too, {title} (at {place}), so that they are calculated twice; "
                "add them to one of the two, or let their needs exclude each other"
            )
            text = Phrase(template, doubled=", ".join(doubled), title=repr(first.title), place=short(first.at))
            yield fault(second, text)


def pairs(names: DeclaredNames, another: str, declared: Iterable[tuple[Any, When]]) -> Iterator[Fault]:
    """Yield the second of two that have one id and can be made together; ``another`` is what messages call the first."""
    by_id: dict[str, list[tuple[Any, When]]] = {}
    for part, when in declared:
        by_id.setdefault(part.id, []).append((part, when))
    for alike in by_id.values():
        for (first, one), (second, other) in combinations(alike, 2):
            both = one.with_(other)
            given = names.world.example(both) if first is not second else None
            if given is not None:
                template = (
                    "has the id of {another} (at {place}), and both are made{where}; name one of them otherwise, "
                    "or let their needs exclude each other"
                )
                told = where(given, both.needs | both.lacks)
                yield fault(second, Phrase(template, another=another, place=short(first.at), where=told))
                break


def faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield texts without a formula, and what is wrong with what a step takes."""
    for step, when in names.steps:
        by_text = [each.formula for each in step.formulas() if isinstance(each.formula, ByText)]
        wrong = (names.incomplete(own.key, own.formulas, when, phrase("no formula")) for own in by_text)
        yield from (fault(step, text) for text in chain(*wrong, step.faults(names, when), _function_faults(step)))


def unreadable_faults(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield the formulas that cannot be made into an expression: whatever this raises is the author's to mend."""
    seen: set[Formula] = set()
    for _, step in mechanism.steps:
        for each in step.formulas():
            for formula in each.options:
                if formula not in seen:
                    seen.add(formula)
                    yield from _unreadable(step, each.part, formula)


def _unreadable(step: Step, part: str, formula: Formula) -> Iterator[Fault]:
    template = "the {part} cannot be printed: {why}"
    try:
        _ = formula.constants
    except FormulaError as why:
        yield fault(step, Phrase(template, part=part, why=why.text), why.place)
    except Exception as why:
        yield fault(step, Phrase(template, part=part, why=why), formula.place or step.at)


def _function_faults(step: Step) -> Iterator[str]:
    """A function that cannot be called with what it gets, by position."""
    called = step.called
    if called is None:
        return
    function: object = getattr(step, "function", None)
    if not callable(function):
        template = "the function is {function}, which cannot be called; name one without brackets"
        yield Phrase(template, function=repr(function))
        return
    try:
        parameters = signature(function)
    except ValueError:  # of the interpreter itself, which says nothing of what it takes
        return
    try:
        parameters.bind(*range(called.arguments))
    except TypeError:
        asked = [p for p in parameters.parameters.values() if p.default is p.empty and p.kind is not p.VAR_POSITIONAL]
        named = called.words or Phrase("takes names {given}: each is given by its position", given=called.arguments)
        yield Phrase("its function takes {count}, and {named}", count=len(asked), named=named)
        return
    own = [name for name, each in parameters.parameters.items() if each.kind is not each.VAR_POSITIONAL]
    given = getattr(step, "takes", ())
    if any(given[i] != each and each in given for i, each in enumerate(own[: len(given)])):
        template = (
            "its function has the parameters {own}, and takes names {given}: each is given by its position; "
            "where that is meant, write a lambda"
        )
        yield Phrase(template, own=", ".join(own), given=", ".join(given))


# What steps take: a curve where a curve is wanted, a row where a row is, an abscissa, a text with allowed values.


def kinds_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the steps that take another kind of thing than they can."""
    for _, step in names.mechanism.steps:
        for each in _taken(step):
            kinds = names.kinds(each.name)
            if kinds and not kinds & each.allowed:
                filling = {
                    "field": each.field,
                    "name": each.name,
                    "said": kinds_told(kinds),
                    "wanted": each.wanted_text,
                }
                yield fault(step, Phrase("{field} is {name}, {said}; {wanted} is wanted", filling))


def _taken(step: Step) -> Iterator[TakenName]:
    """What a step takes, by its formulas and its other fields."""
    for part in step.formulas():
        if part.takes:
            taken = formula_of(part.formula).parameters
            yield from (TakenName(part.field, name, part.takes) for name in taken)
    yield from step.takes_ids()


# Units: what a step takes over as it is has the step's kind of unit.


def units_faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield the steps in another kind of unit than what they take over."""
    for number, (step, _) in enumerate(names.steps):
        own = [step.unit, *(other for _, other in step.units)]

        def units(name: str, step: Step = step, number: int = number) -> set[str]:
            """Return the units of what is given before the step."""
            givers = [giver for giver in names.givers(name) if giver.number < number]
            return {each for giver in givers for each in giver.units_when(step.needs)}

        for what, found in step.same_units(units, names):
            if found and not any(kind_of(one) == kind_of(other) for one in own for other in found):
                template = "is in {own}, {what} in {units}; give it the unit of what it takes over"
                filling = {"own": named(own, " or "), "what": what, "units": named(sorted(found), " or ")}
                yield fault(step, Phrase(template, filling))


def kind_of(text: str) -> object:
    """Return the kind of a unit; of one that is unknown, which is told where formulas are, its text."""
    try:
        return unit(text).kind
    except ValueError:
        return text
