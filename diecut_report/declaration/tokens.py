"""``needs`` and ``lacks``: each names an input that there is, or a text that it may be."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from diecut_report.contract.figures import Drawing
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.errors import nearest


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the tokens that can never hold."""
    for section in mechanism.chapters:
        yield from _wrong(names, section.at, f"section {section.title!r}", "needs", section.needs)
    for _, step in mechanism.steps:
        yield from _wrong(names, step.at, f"step {step.id}", "needs", step.needs)
        yield from _wrong(names, step.at, f"step {step.id}", "lacks", step.lacks)
        for fact in sorted(mechanism.facts.intersection(step.lacks)):
            yield Fault(step.at, f"step {step.id}", f"lacks names the fact {fact}; a fact can only be needed")
    for check in mechanism.checks:
        yield from _wrong(names, check.at, f"check {check.id}", "needs", check.needs)
        yield from _wrong(names, check.at, f"check {check.id}", "only_with", check.only_with)
        yield from _wrong(names, check.at, f"check {check.id}", "asks_for", check.asks_for)
        yield from _wrong(names, check.at, f"check {check.id}", "sized_unless", check.sized_unless or ())
    for figure in mechanism.figures:
        yield from _wrong(names, figure.at, f"figure {figure.id}", "needs", figure.needs)
        if isinstance(figure, Drawing) and figure.scaled_by:
            yield from _wrong(names, figure.at, f"figure {figure.id}", "scaled_by", (figure.scaled_by,))
    for profile in mechanism.exports:
        yield from _wrong(names, profile.at, f"export {profile.id}", "needs", profile.needs)


def _wrong(names: DeclaredNames, place: str, subject: str, field: str, tokens: Iterable[str]) -> Iterator[Fault]:
    if isinstance(tokens, str):
        yield Fault(place, subject, f'{field} is the text {tokens!r}; write a tuple, {field}=("{tokens}",)')
        return
    for token in tokens:
        text = _told(names, token)
        if text:
            yield Fault(place, subject, f"{field} names {text}")


def _told(names: DeclaredNames, token: str) -> str:
    """What is wrong with a token, in words; empty where nothing is."""
    path, is_text, text = token.partition("=")
    key = names.world.keys.get(path)
    if key is None:
        inputs = [known for known in names.world.keys if "=" not in known]
        what = "a step; only inputs can be named" if names.givers(path) else f"not an input{nearest(path, inputs)}"
        return f"{path}, which is {what}"
    if not is_text:
        return ""
    if key.home:
        return f"{token}, but each part of {key.home} has a text of its own"
    if not key.texts:
        return f"{token}, but {path} is not a text with allowed values; name {path} alone"
    return "" if text in key.texts else f"{token}{nearest(text, key.texts)}; {path} may be {', '.join(key.texts)}"
