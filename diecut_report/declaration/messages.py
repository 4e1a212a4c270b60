"""Texts: each ``{id}`` in a message names something that can be printed there, and no other text holds one."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.steps import Choice, Clash, Computed, CurvePeriod, Require, Words
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.order import lacking
from diecut_report.declaration.words import Fault
from diecut_report.declaration.world import When
from diecut_report.errors import nearest
from diecut_report.quantities.formatting import NAMED

BRACE = re.compile(r"\{[^{}]*\}?|\}")  # what looks as if it were filled in
OF_PARTS = {Require: ("part", "next", "index"), Clash: ("part", "other", "index")}


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the messages that name what cannot be printed, keys of no input, and texts that nothing fills in."""
    for number, (_, step) in enumerate(mechanism.steps):
        if isinstance(step, Require | Clash):
            when, parts = names.when(number), OF_PARTS[type(step)]
            for text in named(names, step.message, when, parts, number):
                yield Fault(step.at, f"step {step.id}", f"the message names {text}")
            yield from (Fault(step.at, f"step {step.id}", text) for text in _key(names, step.key))
    yield from _unfilled(mechanism)


def named(
    names: DeclaredNames, text: str, when: When, parts: Collection[str] = (), before: int | None = None
) -> Iterator[str]:
    """Yield what is wrong with the ``{ids}`` of a message that is told (before a step) when something is made."""
    for left in BRACE.findall(NAMED.sub("", text)):
        yield f"{left}: write {{id}}, {{id:up}} or {{id:down}}; nothing else is filled in"
    for name in dict.fromkeys(found[1] for found in NAMED.finditer(text)):
        if name in parts:
            continue
        makers = [g for g in names.givers(name) if isinstance(g.step, Words)]
        words = lacking(names, name, when, None if makers else before)
        if not words and "curve" in names.kinds(name) | {k.replace("curve input", "curve") for k in names.kinds(name)}:
            words = f"{{{name}}}, a curve, which has no single number; name an extreme or a mean of it"
        if words:
            yield words
            continue
        for maker in makers:  # a text is made where a message asks for it, of what is known then
            assert isinstance(maker.step, Words)
            of = (lacking(names, taken, when.with_(maker.when), before) for taken in maker.step.takes)
            yield from (f"{{{name}}}, which takes {said}" for said in of if said)


def _key(names: DeclaredNames, key: str) -> Iterator[str]:
    """What is wrong with the key of an input that a message stands at."""
    parts = [part for part in key.split(".") if not part.isdigit() and not NAMED.fullmatch(part)]
    path = ".".join(parts)
    if path not in names.world.keys:
        yield f"the key {key!r} is not an input{nearest(path, names.world.keys)}; name the input that is to be changed"


def _unfilled(mechanism: Mechanism) -> Iterator[Fault]:
    """Texts with ``{id}`` that are printed as they stand."""
    said = "stands in braces in {}, where nothing is filled in; write it without, or say it in a message or consequence"
    for place, subject, field, text in _plain(mechanism):
        found = NAMED.search(text)
        if found:
            yield Fault(place, subject, f"{found[0]} {said.format(field)}")


def _plain(mechanism: Mechanism) -> Iterator[tuple[str, str, str, str]]:
    for section in mechanism.chapters:
        yield from (
            (section.at, f"section {section.title!r}", f, getattr(section, f)) for f in ("title", "text", "absent")
        )
    for _, step in mechanism.steps:
        fields = {Computed: ("description", "method"), CurvePeriod: ("description", "otherwise")}
        for field in fields.get(type(step), ("description",)):
            yield step.at, f"step {step.id}", field, getattr(step, field)
        for case in step.cases if isinstance(step, Choice) else ():
            yield step.at, f"step {step.id}", "the words of a case", case.words
    for check in mechanism.checks:
        texts = ("title", "demand_label", "limit_label", "at_least_label")
        yield from ((check.at, f"check {check.id}", field, getattr(check, field)) for field in texts)
    for figure in mechanism.figures:
        yield from ((figure.at, f"figure {figure.id}", field, getattr(figure, field)) for field in ("title", "caption"))
