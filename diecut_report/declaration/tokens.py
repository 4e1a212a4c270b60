"""``needs`` and ``lacks``: each names an input that there is, or a text that it may be."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from diecut_report.contract.figures import Drawing
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the tokens that can never hold."""
    for section in mechanism.chapters:
        yield from _wrong(
            names, section.at, Phrase("section {title}", title=repr(section.title)), "needs", section.needs
        )
    for _, step in mechanism.steps:
        yield from _wrong(names, step.at, Phrase("step {id}", id=step.id), "needs", step.needs)
        yield from _wrong(names, step.at, Phrase("step {id}", id=step.id), "lacks", step.lacks)
        for fact in sorted(mechanism.facts.intersection(step.lacks)):
            yield Fault(
                step.at,
                Phrase("step {id}", id=step.id),
                Phrase("lacks names the fact {fact}; a fact can only be needed", fact=fact),
            )
    for check in mechanism.checks:
        yield from _wrong(names, check.at, Phrase("check {id}", id=check.id), "needs", check.needs)
        yield from _wrong(names, check.at, Phrase("check {id}", id=check.id), "only_with", check.only_with)
        yield from _wrong(names, check.at, Phrase("check {id}", id=check.id), "asks_for", check.asks_for)
        yield from _wrong(names, check.at, Phrase("check {id}", id=check.id), "sized_unless", check.sized_unless or ())
    for figure in mechanism.figures:
        yield from _wrong(names, figure.at, Phrase("figure {id}", id=figure.id), "needs", figure.needs)
        if isinstance(figure, Drawing) and figure.scaled_by:
            yield from _wrong(names, figure.at, Phrase("figure {id}", id=figure.id), "scaled_by", (figure.scaled_by,))
    for profile in mechanism.exports:
        yield from _wrong(names, profile.at, Phrase("export {id}", id=profile.id), "needs", profile.needs)


def _wrong(names: DeclaredNames, place: str, subject: str, field: str, tokens: Iterable[str]) -> Iterator[Fault]:
    if isinstance(tokens, str):
        yield Fault(
            place,
            subject,
            Phrase('{field} is the text {tokens}; write a tuple, {field}=("{tokens}",)', field=field, tokens=tokens),
        )
        return
    for token in tokens:
        text = _told(names, token)
        if text:
            yield Fault(place, subject, Phrase("{field} names {text}", field=field, text=text))


def _told(names: DeclaredNames, token: str) -> str:
    """What is wrong with a token, in words; empty where nothing is."""
    path, is_text, text = token.partition("=")
    key = names.world.keys.get(path)
    if key is None:
        inputs = [known for known in names.world.keys if "=" not in known]
        what = (
            phrase("a step; only inputs can be named")
            if names.givers(path)
            else Phrase("not an input{nearest}", nearest=nearest(path, inputs))
        )
        return Phrase("{path}, which is {what}", path=path, what=what)
    if not is_text:
        return ""
    if key.home:
        return Phrase("{token}, but each part of {home} has a text of its own", token=token, home=key.home)
    if not key.texts:
        return Phrase(
            "{token}, but {path} is not a text with allowed values; name {path} alone", token=token, path=path
        )
    return (
        ""
        if text in key.texts
        else Phrase(
            "{token}{nearest}; {path} may be {texts}",
            token=token,
            nearest=nearest(text, key.texts),
            path=path,
            texts=", ".join(key.texts),
        )
    )
