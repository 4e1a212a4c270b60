"""Advice: the inputs that it names can be changed, to values that they may have, and what is judged follows from them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

from diecut_report.declaration.inputs import allowed_wrong, fault_of
from diecut_report.declaration.names import DeclaredNames, Fault, fault
from diecut_report.declaration.texts import not_an_input
from diecut_report.errors import nearest
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import Check, Vary
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.names import ByText
from diecut_report.mechanism.steps import Require
from diecut_report.mechanism.steps.table_steps import unlike_units
from diecut_report.standards.tables import StandardSeries
from diecut_report.text.phrases import Phrase, named


def faults(names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the advice of conditions and checks."""
    for section, step in names.mechanism.steps:
        if isinstance(step, Require):
            judged = (*taken(step), *step.needs, *section.needs)
            yield from (fault(step, text) for text in _wrong(names, step, judged))
    for check in names.mechanism.checks:
        judged = (*check.named, *check.needs, *check.only_with, *check.founded)
        yield from (fault(check, text) for text in _wrong(names, check, judged))


def _wrong(names: DeclaredNames, owner: Check | Require, judged: Iterable[str]) -> Iterator[str]:
    """What is wrong with the ways that a check or a condition advises; ``judged`` are the names on which its verdict rests."""
    advise: Any = owner.advise  # as an author wrote it
    if not isinstance(advise, tuple):
        if not isinstance(advise, str):  # which is told where words are
            template = "has advise={given}; write a tuple of ways, with a comma behind a single one"
            yield Phrase(template, given=repr(advise))
        return
    behind = _behind(names, judged) if all(map(names.givers, judged)) else None
    for way in advise:
        keys = (way.key,) if isinstance(way, Vary) else (way,) if isinstance(way, str) else way
        if not keys or not isinstance(keys, tuple) or not all(isinstance(key, str) for key in keys):
            template = "advise holds {way}; write the key of an input, Vary(key, …), or a tuple of keys that are changed together"
            yield Phrase(template, way=repr(way))
            continue
        found = [text for key in keys if (text := _not_changed(names, key, keys, behind))]
        yield from (Phrase("{field} names {text}", field="advise", text=text) for text in found)
        if isinstance(way, Vary) and not found:
            yield from _vary(names, way)


def _behind(names: DeclaredNames, judged: Iterable[str]) -> set[str]:
    """The inputs from which something follows: by what is taken, and by what switches steps on and off."""
    found: set[str] = set()
    pending = list(judged)
    while pending:
        name = pending.pop().removeprefix("inputs.").partition("=")[0]
        if name not in found:
            found.add(name)
            for giver in names.givers(name):
                pending += [*giver.when.needs, *giver.when.lacks]
                if step := giver.step:
                    pending += [*taken(step), *getattr(step, "holds", ())]
                    pending += [each.formula.key for each in step.formulas() if isinstance(each.formula, ByText)]
    return found


def _not_changed(names: DeclaredNames, key: str, together: tuple[str, ...], behind: set[str] | None) -> str:
    """Why nothing can be advised on a key; empty where something can."""
    known = names.world.keys.get(key)
    if known is None or key in names.mechanism.facts:
        return not_an_input(names, key)
    if not isinstance(known.meta, Quantity) and not known.texts:
        return Phrase("{key}, which is neither a number nor a text with allowed values", key=key)
    if not isinstance(known.meta, Quantity) and known.home:
        return Phrase("{token}, but each part of {home} has a text of its own", token=key, home=known.home)
    if not isinstance(known.meta, Quantity) and len(together) > 1:
        others = named([each for each in together if each != key], " and ")
        return Phrase("{key} together with {others}, but texts are changed each by itself", key=key, others=others)
    if behind is not None and key not in behind:
        return Phrase("{key}, on which its verdict does not depend; name an input that changes it", key=key)
    return ""


def _vary(names: DeclaredNames, way: Vary) -> Iterator[str]:
    """What is wrong with the direction and the series of a key."""
    known = names.world.keys[way.key]
    series: Any = way.series
    wrong = list(allowed_wrong(way))
    if not wrong and isinstance(series, StandardSeries):
        title = Phrase("the series “{title}”", title=series.title)
        yield from unlike_units(title, series.unit, names.units(way.key), way.key)
    elif not wrong:
        template = "has {value} in its series{nearest}; allowed: {texts}"
        wrong += [
            Phrase(template, value=repr(text), nearest=nearest(str(text), known.texts), texts=", ".join(known.texts))
            for text in (series if known.texts else ()) if text not in known.texts
        ]  # fmt: skip
        wrong += () if known.texts else _numbers_wrong(known.meta, series)
    yield from (Phrase("the advice on {key} {text}", key=way.key, text=text) for text in wrong)


def _numbers_wrong(meta: Any, series: tuple[Any, ...]) -> Iterator[str]:
    for strange in [each for each in series if isinstance(each, bool) or not isinstance(each, int | float)][:1]:
        template = "has {value} in its series; write plain numbers, which count in its unit ({unit})"
        yield Phrase(template, value=repr(strange), unit=meta.unit)
        return
    for one, other in [pair for pair in pairwise(series) if pair[0] >= pair[1]][:1]:
        yield Phrase("has a series that does not ascend ({one} before {other}); put it in order", one=one, other=other)
    refused = [fault_of(meta, each) for each in series]
    if refused and all(refused):
        template = "has a series of which no value is allowed: {why}; its numbers count in {unit}"
        yield Phrase(template, why=refused[0], unit=meta.unit)
