"""Formulas: each is one, can be read and printed, and has a value for each text that chooses; tables have a row for each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from inspect import signature
from typing import Any

from diecut_report.contract.binding import Binding, Bound, ByText, bound
from diecut_report.contract.code_steps import ComputedCurve, PartCurves
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import Lookup, Pick
from diecut_report.contract.steps import Case, Choice, Prepared, Root, Step, Words
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.order import when_asked
from diecut_report.declaration.tables import rows_of
from diecut_report.declaration.words import Fault
from diecut_report.declaration.world import When
from diecut_report.expressions import Formula
from diecut_report.languages.phrases import Phrase, phrase

PARTS = (phrase("formula"), "exists", phrase("condition"), phrase("equation"), "low", "high", "left", "right")


def unmarked(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield what stands where a formula is wanted and is none: the first thing to be mended, as nothing can be asked of it."""
    for _, step in mechanism.steps:
        for part, declared in _declared(step):
            if declared is not None and not isinstance(declared, Binding):
                name = getattr(declared, "__name__", repr(declared))
                what = (
                    phrase("a plain function; write @formula above it")
                    if callable(declared)
                    else phrase("no formula; write one with @formula")
                )
                yield Fault(
                    _place(declared, step.at),
                    Phrase("step {id}", id=step.id),
                    Phrase("the {part} {name} is {what}", part=part, name=name, what=what),
                )
        if isinstance(step, Choice) and not step.cases:
            yield Fault(step.at, Phrase("step {id}", id=step.id), phrase("has no cases; give at least one Case"))


def _declared(step: Step) -> Iterator[tuple[str, Any]]:
    for part in PARTS:
        if hasattr(step, part):
            yield part, getattr(step, part)
    for case in getattr(step, "cases", ()):
        if isinstance(case, Case):
            yield phrase("condition of a case"), case.condition
            yield phrase("value of a case"), None if isinstance(case.value, str) else case.value


def _place(function: Any, otherwise: str) -> str:
    code = getattr(function, "__code__", None)
    return f"{code.co_filename}:{code.co_firstlineno}" if code else otherwise


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the formulas that cannot be printed, and texts without a formula or a row."""
    seen: set[Formula] = set()
    for number, (_, step) in enumerate(mechanism.steps):
        for part, declared in _declared(step):
            options = (
                declared.options() if isinstance(declared, ByText) else (declared,) if declared is not None else ()
            )
            for link in map(bound, options):
                if link.formula not in seen:
                    seen.add(link.formula)
                    yield from _unreadable(step, part, link)
        for text in _choices(step, names, names.when(number)):
            yield Fault(step.at, Phrase("step {id}", id=step.id), text)


def _unreadable(step: Step, part: str, link: Bound) -> Iterator[Fault]:
    """A formula whose body cannot be read: whatever reading it raises is the author's to mend."""
    try:
        _ = link.formula.tree
    except RecursionError:
        text = Phrase(
            "the {part} {formula} calls itself; name it otherwise than what it calls",
            part=part,
            formula=link.formula.__name__,
        )
        yield Fault(_place(link.formula.function, step.at), Phrase("step {id}", id=step.id), text)
    except Exception as why:
        yield Fault(
            _place(link.formula.function, step.at),
            Phrase("step {id}", id=step.id),
            Phrase("the {part} cannot be printed: {why}", part=part, why=why),
        )


def _choices(step: Step, names: DeclaredNames, when: When) -> Iterator[str]:
    for _, declared in _declared(step):
        if isinstance(declared, ByText):
            yield from _complete(names, declared.key, declared.formulas, when, phrase("no formula"))
    match step:
        case Lookup(by=by) if not step.is_by_number:
            yield from _complete(names, by, rows_of(step), when_asked(step, when), phrase("no row in the table"))
            yield from _of_steps(names, by, rows_of(step))
        case Pick(by=by, series=Mapping() as series):
            yield from _complete(names, by, series, when, phrase("no series"))
        case Root(unknown=unknown):
            takes = bound(step.equation).names.values()
            if unknown not in takes:
                asked = ", ".join(str(name) for name in takes)
                yield Phrase(
                    "the unknown {unknown} is nothing that the equation takes; it takes {asked}",
                    unknown=unknown,
                    asked=asked,
                )
    function: object = getattr(step, "function", None)
    if hasattr(step, "function") and not callable(function):
        yield Phrase(
            "the function is {function}, which cannot be called; name one without brackets", function=repr(function)
        )
    elif callable(function):
        if isinstance(step, ComputedCurve):
            first = phrase("the part's index, ") if step.named_by else ""
            told = Phrase("it is called with {first}the object, x, the middles of the pieces and the rows", first=first)
            yield from _signature(function, OF_CURVE + bool(step.named_by), told)
        elif isinstance(step, PartCurves):
            words = phrase("it is called with the object, the part's number, x, the middles of the pieces and the rows")
            yield from _signature(function, OF_CURVE + 1, words)
        else:
            yield from _signature(function, 1 if isinstance(step, Prepared) else len(getattr(step, "takes", ())))


OF_CURVE = 4  # what the function of a computed curve takes


def _signature(function: Callable[..., object], given: int, called: str = "") -> Iterator[str]:
    """A function that cannot be called with so many things by position."""
    try:
        parameters = signature(function)
    except ValueError:  # of the interpreter itself, which says nothing of what it takes
        return
    try:
        parameters.bind(*range(given))
    except TypeError:
        asked = [p for p in parameters.parameters.values() if p.default is p.empty and p.kind is not p.VAR_POSITIONAL]
        named = called or Phrase("takes names {given}: each is given by its position", given=given)
        yield Phrase("its function takes {count}, and {named}", count=len(asked), named=named)


def _of_steps(names: DeclaredNames, by: str, rows: Mapping[str, Any]) -> Iterator[str]:
    """What is wrong with a row that is taken by a text of a step: one that a message makes, or a text of a choice without a row."""
    for step in (giver.step for giver in names.givers(by)):
        if isinstance(step, Words):
            words = "by is {by}, words that are made where a message asks for them; let choice or computed(…, is_text=True) give the row's name"
            yield Phrase(words, by=by)
        elif isinstance(step, Choice):
            missing = [case.value for case in step.cases if isinstance(case.value, str) and case.value not in rows]
            if missing:
                words = "has no row in the table for {by}={missing}; the rows are {rows}"
                yield Phrase(words, by=by, missing=", ".join(map(str, missing)), rows=", ".join(rows))


def _complete(names: DeclaredNames, by: str, rows: Mapping[str, Any], when: When, none: str) -> Iterator[str]:
    """What is wrong with a choice by a text: each text that may be given there has its row."""
    key = names.world.keys.get(by)
    if key is None:
        return  # told where ids are
    if not key.texts:
        allowed = ", ".join(map(repr, rows))
        yield Phrase(
            "is chosen by {by}, which may be any text; give it allowed ones: Annotated[Literal[{allowed}], Text(…)]",
            by=by,
            allowed=allowed,
        )
        return
    possible = [
        text for text in key.texts if key.home or names.world.example(when.with_(When(frozenset((f"{by}={text}",)))))
    ]
    missing = [text for text in possible if text not in rows]
    if missing:
        yield Phrase(
            "has {none} for {by}={missing}; add {them}, or forbid the text",
            none=none,
            by=by,
            missing=", ".join(missing),
            them=phrase("it" if len(missing) == 1 else "them"),
        )
