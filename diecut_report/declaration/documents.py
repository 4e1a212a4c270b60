"""What is said beside the calculation: sources, errata, key results, exports, spectra and comparisons name what there is."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations

from diecut_report.contract.mechanism import Comparison, CurveTable, Mechanism
from diecut_report.contract.steps import SILENT
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.order import lacking
from diecut_report.declaration.words import Fault, short, unknown
from diecut_report.declaration.world import When, world
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, named, phrase

CITED = re.compile(r"(?:^|; ?)(?:(\d{3,})\b|(\S+?),? (?:eq\.|Fig\.|Table|erratum)\s)")


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what names a source or a quantity that there is none of."""
    yield from _sources(mechanism)
    yield from _titles(mechanism, names)
    for first, second in combinations(mechanism.sources, 2):
        if first.id == second.id:
            yield Fault(
                second.at,
                Phrase("source {id}", id=second.id),
                Phrase("has the id of another source (at {place}); give it another", place=short(first.at)),
            )
    yield from _errata(mechanism, names)
    for name in mechanism.key_results:
        text = _key_result(names, name)
        if text:
            yield Fault(mechanism.at, "key_results", text)
    yield from _exports(mechanism, names)
    for comparison in mechanism.comparisons:
        for text in _comparison(mechanism, names, comparison):
            yield Fault(comparison.at, Phrase("comparison {kind}", kind=comparison.mechanism.kind), text)


def _errata(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Errata of sources that are not listed, and those that touch what there is not."""
    known = [source.id for source in mechanism.sources]
    for erratum in mechanism.errata:
        subject = Phrase("erratum of {source}", source=erratum.source)
        if erratum.source not in known:
            words = "is of no listed source{nearest}; listed: {known}"
            listed = {"nearest": nearest(erratum.source, known), "known": ", ".join(known)}
            yield Fault(erratum.at, subject, Phrase(words, listed))
        for name in erratum.touches:
            if not names.givers(name) and name not in _silent(mechanism):
                yield Fault(erratum.at, subject, Phrase("touches {unknown}", unknown=unknown(name, names.known)))


def _titles(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Chapters of one title that may stand in one report."""
    for first, second in combinations(mechanism.chapters, 2):
        both = When(frozenset(first.needs + second.needs))
        if first.title == second.title and names.world.example(both) is not None:
            text = Phrase(
                "has the title of another chapter (at {place}); give it another, or put their steps into one",
                place=short(first.at),
            )
            yield Fault(second.at, Phrase("chapter {title}", title=repr(second.title)), text)


def _silent(mechanism: Mechanism) -> set[str]:
    return {step.id for _, step in mechanism.steps if isinstance(step, SILENT)}


def _sources(mechanism: Mechanism) -> Iterator[Fault]:
    """Sources that are cited by their id and not listed; a mechanism that lists none cites elsewhere."""
    known = [source.id for source in mechanism.sources]
    if not known:
        return
    cited = [(step.at, Phrase("step {id}", id=step.id), step.source) for _, step in mechanism.steps]
    cited += [(check.at, Phrase("check {id}", id=check.id), check.source) for check in mechanism.checks]
    for place, subject, text in cited:
        for found in CITED.finditer(text):
            name = found[1] or found[2]
            if not any(text[found.start() :].lstrip("; ").startswith(source) for source in known):
                words = "cites {name}, which is not a source{nearest}; listed: {known}"
                listed = {"name": name, "nearest": nearest(name, known), "known": ", ".join(known)}
                yield Fault(place, subject, Phrase(words, listed))


def _key_result(names: DeclaredNames, name: str) -> str:
    givers = [giver for giver in names.givers(name) if giver.step is not None]
    if not givers:
        steps = [known for known, all_ in names.known.items() if any(giver.step for giver in all_)]
        return Phrase("{name} is not a step{nearest}; name what a step gives", name=name, nearest=nearest(name, steps))
    if not any(giver.step and giver.step.output for giver in givers):
        return Phrase("{name} is not an output; take output=False away from its step", name=name)
    return (
        Phrase("{name} is a curve; name an extreme of it", name=name)
        if {g.kind for g in givers} <= {"curve", "abscissa"}
        else ""
    )


def _exports(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    for profile in mechanism.exports:
        when, subject = When(frozenset(profile.needs)), Phrase("export {id}", id=profile.id)
        if isinstance(profile, CurveTable):
            kinds = [names.kinds(name) for name in profile.columns]
            if kinds != [{"abscissa"}]:
                yield Fault(
                    profile.at,
                    subject,
                    Phrase(
                        'has columns={columns}; name the abscissa of its curves alone: ("angle",)',
                        columns=repr(profile.columns),
                    ),
                )
            continue
        if len(profile.columns) < 2:
            yield Fault(profile.at, subject, phrase("has fewer than two columns; name x and y at least"))
        for name in profile.columns:
            absent = lacking(names, name, when)
            curves = [giver for giver in names.givers(name) if giver.kind == "curve"]
            if absent:
                yield Fault(profile.at, subject, Phrase("writes {absent}", absent=absent))
            elif not curves:
                yield Fault(profile.at, subject, Phrase("writes {name}, which is not a curve", name=name))
            elif not all(giver.step and giver.step.output for giver in curves):
                yield Fault(
                    profile.at,
                    subject,
                    Phrase("writes {name}, which is not an output; take output=False away from its step", name=name),
                )
        axes = set().union(*(names.axes(name) for name in profile.columns))
        if len(axes) > 1:
            yield Fault(
                profile.at,
                subject,
                Phrase("writes curves over {axes}; give each its own export", axes=named(sorted(axes), " and over ")),
            )


def _comparison(mechanism: Mechanism, names: DeclaredNames, comparison: Comparison) -> Iterator[str]:
    keys = world(comparison.mechanism.inputs).keys
    for key, (kind, name) in comparison.takes.items():
        if key not in keys:
            yield Phrase("fills {key}, which is not an input of it{nearest}", key=key, nearest=nearest(key, keys))
        if kind == mechanism.kind and not names.givers(name):
            yield Phrase("takes {unknown} in {kind}", unknown=unknown(name, names.known), kind=kind)
    for name, declared in comparison.mechanism.inputs.model_fields.items():
        if declared.is_required() and name not in comparison.takes:
            yield Phrase(
                "fills nothing into {name}, which is required; add it to takes, or give it a default", name=name
            )
