"""Texts: each ``{id}`` in a message names something that can be printed there, and no other text holds one."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from diecut_report.contract.chapters import MISSING
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.steps import Choice, Clash, Computed, CurvePeriod, Require, Words
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.order import lacking
from diecut_report.declaration.words import Fault
from diecut_report.declaration.world import When
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import NAMED

BRACE = re.compile(r"\{[^{}]*\}?|\}")  # what looks as if it were filled in
OF_PARTS = {Require: ("part", "next", "index"), Clash: ("part", "other", "index")}


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the messages that name what cannot be printed, keys of no input, and texts that nothing fills in."""
    for number, (_, step) in enumerate(mechanism.steps):
        if isinstance(step, Require | Clash):
            when, parts = names.when(number), OF_PARTS[type(step)]
            for text in unprintable(names, step.message, when, parts, number):
                yield Fault(step.at, Phrase("step {id}", id=step.id), Phrase("the message names {text}", text=text))
            yield from (Fault(step.at, Phrase("step {id}", id=step.id), text) for text in _key(names, step.key))
    yield from _unfilled(mechanism)


def unprintable(
    names: DeclaredNames, text: str, when: When, parts: Collection[str] = (), before: int | None = None
) -> Iterator[str]:
    """Yield what is wrong with the ``{ids}`` of a message that is told (before a step) when something is made."""
    for left in BRACE.findall(NAMED.sub("", text)):
        words = "{left}: write {plain}, {up} or {down}; nothing else is filled in"
        yield Phrase(words, left=left, plain="{id}", up="{id:up}", down="{id:down}")
    for name in dict.fromkeys(found[1] for found in NAMED.finditer(text)):
        if name in parts:
            continue
        braced = f"{{{name}}}"
        makers = [g for g in names.givers(name) if isinstance(g.step, Words)]
        words = lacking(names, name, when, None if makers else before)
        if not words and "curve" in names.kinds(name) | {k.replace("curve input", "curve") for k in names.kinds(name)}:
            words = Phrase("{name}, a curve, which has no single number; name an extreme or a mean of it", name=braced)
        if words:
            yield words
            continue
        for maker in makers:  # a text is made where a message asks for it, of what is known then
            assert isinstance(maker.step, Words)
            of = (lacking(names, taken, when.with_(maker.when), before) for taken in maker.step.takes)
            yield from (Phrase("{name}, which takes {said}", name=braced, said=said) for said in of if said)


def _key(names: DeclaredNames, key: str) -> Iterator[str]:
    """What is wrong with the key of an input that a message stands at."""
    parts = [part for part in key.split(".") if not part.isdigit() and not NAMED.fullmatch(part)]
    path = ".".join(parts)
    if path not in names.world.keys:
        yield Phrase(
            "the key {key} is not an input{nearest}; name the input that is to be changed",
            key=repr(key),
            nearest=nearest(path, names.world.keys),
        )


def _unfilled(mechanism: Mechanism) -> Iterator[Fault]:
    """Texts with ``{id}`` that are printed as they stand."""
    words = "{braced} stands in braces in {field}, where nothing is filled in; write it without, or say it in a message or consequence"
    for place, subject, field, text in _plain(mechanism):
        found = NAMED.search(text.replace(MISSING, "") if field == "absent" else text)
        if found:
            yield Fault(place, subject, Phrase(words, braced=found[0], field=field))


def _plain(mechanism: Mechanism) -> Iterator[tuple[str, str, str, str]]:
    for section in mechanism.chapters:
        yield from (
            (section.at, Phrase("section {title}", title=repr(section.title)), f, getattr(section, f))
            for f in ("title", "text", "absent")
        )
    for _, step in mechanism.steps:
        fields = {Computed: ("description", "method"), CurvePeriod: ("description", "otherwise")}
        for field in fields.get(type(step), ("description",)):
            yield step.at, Phrase("step {id}", id=step.id), field, getattr(step, field)
        for case in step.cases if isinstance(step, Choice) else ():
            yield step.at, Phrase("step {id}", id=step.id), phrase("the words of a case"), case.words
    for check in mechanism.checks:
        texts = ("title", "demand_label", "limit_label", "at_least_label")
        yield from ((check.at, Phrase("check {id}", id=check.id), field, getattr(check, field)) for field in texts)
    for figure in mechanism.figures:
        yield from (
            (figure.at, Phrase("figure {id}", id=figure.id), field, getattr(figure, field))
            for field in ("title", "caption")
        )
