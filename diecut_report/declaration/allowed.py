"""What a declaration may say: words among the allowed ones, yes or no, tuples of ids, tolerances of rounding."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from functools import cache
from typing import Any, Literal, cast, get_args, get_origin, get_type_hints

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase

MOST_TOLERANCE = 0.01  # of a check: more than rounding and measuring leave open is a limit of its own
NOT_READ = {"StandardSeries": object, "StandardTable": object, "Chapter": object}  # imported for type checkers alone
PLAIN = ("needs", "lacks", "only_with", "asks_for")  # which are told of where tokens are judged


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield words that are not among the allowed ones, and tolerances that let a machine fail."""
    for subject, declared in _declared(mechanism):
        for text in _wrong(declared):
            yield Fault(declared.at, subject, text)
    for check in mechanism.checks:
        if not 0 <= check.tolerance <= MOST_TOLERANCE:
            text = Phrase(
                "has the tolerance {tolerance}, a share of the limit; allowed: 0 to {most} (1 %), for rounding alone; "
                "put what is allowed into the limit",
                tolerance=repr(check.tolerance),
                most=MOST_TOLERANCE,
            )
            yield Fault(check.at, Phrase("check {id}", id=check.id), text)


def _declared(mechanism: Mechanism) -> Iterator[tuple[str, Any]]:
    yield Phrase("mechanism {kind}", kind=mechanism.kind), mechanism
    yield from ((Phrase("chapter {title}", title=repr(chapter.title)), chapter) for chapter in mechanism.chapters)
    yield from ((Phrase("step {id}", id=step.id), step) for _, step in mechanism.steps)
    yield from ((Phrase("check {id}", id=check.id), check) for check in mechanism.checks)
    yield from ((Phrase("figure {id}", id=figure.id), figure) for figure in mechanism.figures)
    yield from ((Phrase("export {id}", id=profile.id), profile) for profile in mechanism.exports)
    yield from ((Phrase("erratum of {source}", source=erratum.source), erratum) for erratum in mechanism.errata)


def _wrong(declared: Any) -> Iterator[str]:
    for name, (words, kind) in _fields(cast(Hashable, type(declared))).items():
        value = getattr(declared, name)
        if words and value not in words:
            told = ", ".join(map(repr, words))
            yield Phrase(
                "has {name}={value}{nearest}; allowed: {told}",
                name=name,
                value=repr(value),
                nearest=nearest(str(value), map(str, words)),
                told=told,
            )
        elif kind is bool and not isinstance(value, bool):
            yield Phrase("has {name}={value}; allowed: True, False", name=name, value=repr(value))
        elif kind is tuple and isinstance(value, str):
            yield Phrase("has {name}={value}, a text; write a tuple, ({value},)", name=name, value=repr(value))


@cache
def _fields(kind: Hashable) -> dict[str, tuple[tuple[Any, ...], Any]]:
    """The fields that hold one of several words, yes or no, or a tuple."""
    found: dict[str, tuple[tuple[Any, ...], Any]] = {}
    for name, hint in get_type_hints(cast(type, kind), localns=NOT_READ).items():
        origin = get_origin(hint)
        words = get_args(hint) if origin is Literal else ()
        if words or hint is bool or (origin is tuple and name not in PLAIN):
            found[name] = words, bool if hint is bool else origin
    return found
