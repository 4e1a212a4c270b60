"""Ids: each is given once, and given before it is taken, whatever inputs are given."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

from diecut_report.contract.chapters import Chapter
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import Lookup, Pick
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import SILENT, Root, Step, Words
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault, short, unknown
from diecut_report.declaration.world import When, told
from diecut_report.languages.phrases import Phrase, phrase


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the ids that are doubled, never made, not given, or taken too early."""
    yield from _doubled(mechanism, names)
    yield from _in_two_chapters(mechanism, names)
    for number, (_, step) in enumerate(mechanism.steps):
        when = names.when(number)
        if names.world.example(when) is None:
            yield Fault(
                step.at,
                Phrase("step {id}", id=step.id),
                phrase("is never calculated: what it needs and lacks is never given together"),
            )
            continue
        if not isinstance(step, SILENT) and not (step.symbol and step.description):
            yield Fault(step.at, Phrase("step {id}", id=step.id), phrase("has no symbol or no description"))
        for name in sorted(asked(step)):
            late = name == getattr(step, "shown_at", "") or isinstance(step, Words)
            text = lacking(names, name, when_asked(step, when), None if late else number)
            if text:
                yield Fault(step.at, Phrase("step {id}", id=step.id), Phrase("takes {text}", text=text))


def asked(step: Step) -> set[str]:
    """Return the ids that a step takes from elsewhere."""
    own = (
        {step.unknown, step.id}
        if isinstance(step, Root)
        else {step.given}
        if isinstance(step, Lookup | Pick)
        else set()
    )
    return {name for name in taken(step) if name not in own}


def when_asked(step: Step, when: When) -> When:
    """Return when a step takes what it asks for: what may be given instead, where that is not given."""
    given = step.given.removeprefix("inputs.") if isinstance(step, Lookup | Pick) else ""
    return when.with_(When(frozenset(), frozenset((given,)))) if given else when


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
        step = later[0].step
        place = short(step.at) if step else ""
        return Phrase(
            "{name} before it is calculated (at {place}); move that step up, or this one down", name=name, place=place
        )
    key = names.world.keys.get(name.removeprefix("inputs."))
    home = names.world.keys.get(key.home) if key else None
    if home and home.may_be_absent and home.path not in when.needs:
        words = (
            '{name}, but {home} may have no parts, by its default; write needs=("{home}",), or take its default away'
        )
        return Phrase(words, name=name, home=home.path)
    tokens = set().union(*(part for each in (when, *(giver.when for giver in givers)) for part in each))
    where = told(given, tokens)
    words = (
        "{name}, which nothing gives {where}; give it there too, or leave this out by needs or lacks"
        if where
        else "{name}, which nothing gives; give it there too, or leave this out by needs or lacks"
    )
    return Phrase(words, name=name, where=where)


def _doubled(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Steps, figures and exports with one id that can be made together."""
    steps = [(step, names.when(number)) for number, (_, step) in enumerate(mechanism.steps)]
    yield from pairs(names, "step", steps)
    yield from pairs(names, "figure", [(figure, When(frozenset(figure.needs))) for figure in mechanism.figures])
    yield from pairs(names, "export", [(profile, When(frozenset(profile.needs))) for profile in mechanism.exports])


def _in_two_chapters(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Steps that stand in two chapters which are both calculated."""
    for first, second in combinations(mechanism.chapters, 2):
        shared = (
            [step for step in second.steps if any(step is other for other in first.steps)]
            if first is not second
            else []
        )
        doubled = [step.id for step in shared if names.world.example(_together(first, second, step)) is not None]
        if doubled:
            text = Phrase(
                "has {doubled} of another chapter too, {title} (at {place}), so that they are calculated twice; "
                "add them to one of the two, or let their needs exclude each other",
                doubled=", ".join(doubled),
                title=repr(first.title),
                place=short(first.at),
            )
            yield Fault(second.at, Phrase("chapter {title}", title=repr(second.title)), text)


def _together(first: Chapter, second: Chapter, step: Step) -> When:
    return When(frozenset(first.needs + second.needs + step.needs), frozenset(step.lacks))


def pairs(names: DeclaredNames, what: str, declared: list[tuple[Any, When]]) -> Iterator[Fault]:
    """Yield the second of two that have one id and can be made together."""
    by_id: dict[str, list[tuple[Any, When]]] = {}
    for part, when in declared:
        by_id.setdefault(part.id, []).append((part, when))
    for name, alike in by_id.items():
        for (first, one), (second, other) in combinations(alike, 2):
            both = one.with_(other)
            given = names.world.example(both) if first is not second else None
            if given is not None:
                where = told(given, both.needs | both.lacks)
                yield Fault(second.at, _subject(what, name), _doubled_id(what, short(first.at), where))
                break


def _subject(what: str, name: str) -> Phrase:
    return {
        "step": Phrase("step {id}", id=name),
        "check": Phrase("check {id}", id=name),
        "figure": Phrase("figure {id}", id=name),
        "export": Phrase("export {id}", id=name),
    }[what]


ANOTHER = {
    "step": phrase("another step"),
    "check": phrase("another check"),
    "figure": phrase("another figure"),
    "export": phrase("another export"),
}


def _doubled_id(what: str, place: str, where: str) -> Phrase:
    words = (
        "has the id of {another} (at {place}), and both are made {where}; name one of them otherwise, or let their needs exclude each other"
        if where
        else "has the id of {another} (at {place}), and both are made; name one of them otherwise, or let their needs exclude each other"
    )
    return Phrase(words, another=ANOTHER[what], place=place, where=where)
