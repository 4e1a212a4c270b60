"""What is found where one input is solved for, and how it is told: as text and as plain data."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.proved_machine import ProvedMachine
from diecut_report.design.questions import DesignQuestion
from diecut_report.languages.phrases import Counted, Phrase, phrase
from diecut_report.languages.speech import localised

ALSO = 12  # further values that a text names
Role = Literal["root", "lower", "upper", "extreme", "today", "nearest"]


@dataclass(frozen=True)
class FoundValue:
    """Hold a value that answers: of the input (SI and as typed), of what is asked, and the checks that fail there.

    ``role``: a root; the lower or upper end of a range of values where it holds; an extreme; today's value, which holds already;
    or the nearest value that is reached where none answers. ``at_end``: it is the end of the range that was searched. ``beyond`` are the checks that
    fail just beyond it, where only machines that pass are searched.
    """

    value: float
    typed: str
    reached: float
    role: Role
    failing: tuple[str, ...] = ()
    beyond: tuple[str, ...] = ()
    at_end: bool = False


Range = tuple[FoundValue, FoundValue]


@dataclass(frozen=True)
class Answer:
    """Hold what was found: the answers, the nearest first; the ranges of values in which it holds; the places where the
    asked number jumps over the value; the proof of the first.

    Without an answer ``nearest`` is the value that comes nearest, and ``always`` are the checks that fail with every value, where all are to pass.
    ``reached`` is what is asked for today (NaN where that is nothing).
    """

    question: DesignQuestion
    design: DesignInput
    low: float
    high: float
    reached: float
    found: tuple[FoundValue, ...] = ()
    ranges: tuple[Range, ...] = ()
    jumps: tuple[float, ...] = ()
    nearest: FoundValue | None = None
    machine: ProvedMachine | None = None
    passing: bool = False
    always: tuple[str, ...] = ()


def lines(answer: Answer) -> Iterator[str]:
    """Yield what is found, in words."""
    design, asked, today = answer.design, answer.question.quantity, answer.design.today
    passing = phrase(" with no check failing") if answer.passing else ""
    reached = "" if math.isnan(answer.reached) else f", {asked.name} {localised(asked.told(answer.reached))}"
    now = phrase("not given today") if today is None else Phrase("today {value}", value=localised(design.told(today)))
    words = "{question}{passing}, by {input} ({now}{reached})"
    yield Phrase(words, question=answer.question.told, passing=passing, input=design.name, now=now, reached=reached)
    yield from (_indented(line) for line in (_found(answer) if answer.found else _nearest(answer)))
    for place in answer.jumps:
        jump = "  at {place} {asked} jumps over {value} and does not take that value"
        yield Phrase(
            jump,
            place=localised(design.told(place)),
            asked=asked.name,
            value=localised(asked.told(answer.question.value)),
        )


def _indented(line: str) -> Phrase:
    return Phrase("  {line}", line=line)


def _found(answer: Answer) -> Iterator[str]:
    design, asked, machine = answer.design, answer.question.quantity, answer.machine
    first = answer.found[0]
    what = phrase("holds today already") if first.role == "today" else f"{design.name} = {first.typed}"
    yield Phrase(
        "{what}: {asked} is {value}{end}",
        what=what,
        asked=asked.name,
        value=localised(asked.told(first.reached)),
        end=_end(first),
    )
    if machine is not None:
        yield _verdict(machine, first)
    if first.beyond:
        yield Phrase("just beyond it fails {checks}", checks=", ".join(first.beyond))
    for low, high in answer.ranges:
        yield Phrase("it holds from {low} to {high}", low=_side(low), high=_side(high))
    if not answer.ranges:
        yield from _also(answer)


def _also(answer: Answer) -> Iterator[str]:
    """The other values, of which a text names the nearest."""
    design, asked, others = answer.design, answer.question.quantity, answer.found[1:]
    for each in others[:ALSO]:
        words = "also {input} = {typed}: {asked} is {value}"
        yield Phrase(
            words, input=design.name, typed=each.typed, asked=asked.name, value=localised(asked.told(each.reached))
        )
    if len(others) > ALSO:
        one = "and {n} more value; --format json has all of them"
        many = "and {n} more values; --format json has all of them"
        yield Counted(len(others) - ALSO, one, many)


def _side(found: FoundValue) -> str:
    return Phrase("{value} (end of the search)", value=found.typed) if found.at_end else found.typed


def _end(found: FoundValue) -> str:
    return phrase(", at the end of the range that was searched") if found.at_end else ""


def _verdict(machine: ProvedMachine, found: FoundValue) -> Phrase:
    """The machine that was calculated alone."""
    if not found.failing:
        words = "calculated as a machine of its own: no check fails; governing: {check}"
        return Phrase(words, check=machine.governing or phrase("none"))
    one = "calculated as a machine of its own: {n} check fails: {checks}"
    many = "calculated as a machine of its own: {n} checks fail: {checks}"
    return Counted(len(found.failing), one, many, checks=", ".join(found.failing))


def _nearest(answer: Answer) -> Iterator[str]:
    design, asked, near = answer.design, answer.question.quantity, answer.nearest
    ends = {"low": localised(design.told(answer.low)), "high": localised(design.told(answer.high))}
    yield Phrase("no value of {input} from {low} to {high} does", input=design.name, **ends)
    if near is not None:
        words = "nearest: {input} = {typed}, where {asked} is {value}{end}{fails}"
        value, fails = localised(asked.told(near.reached)), _fails(near)
        yield Phrase(
            words, input=design.name, typed=near.typed, asked=asked.name, value=value, end=_end(near), fails=fails
        )
    if answer.always:
        one = "whatever it is, {checks} fails: change another input first; `advise` looks for one"
        many = "whatever it is, {checks} fail: change another input first; `advise` looks for one"
        yield Counted(len(answer.always), one, many, checks=", ".join(answer.always))
    elif near is not None:
        yield phrase("give another range with --from and --to, or change another input")


def _fails(found: FoundValue) -> str:
    return Phrase(", and these checks fail: {checks}", checks=", ".join(found.failing)) if found.failing else ""


def data(answer: Answer) -> dict[str, Any]:
    """Return the same as plain data, SI."""
    question, design, machine = answer.question, answer.design, answer.machine
    return {
        "schema_version": 1,
        "vary": {"path": design.asked.path, "unit": design.meta.parsed_unit.si, "today": design.today, "from": answer.low, "to": answer.high},
        "for": {"name": question.quantity.name, "kind": question.kind, "passing": answer.passing, "unit": question.quantity.si,
                "today": None if math.isnan(answer.reached) else answer.reached,
                **({} if question.kind in ("max", "min") else {"value": question.value})},
        "solutions": [_data(each) for each in answer.found],
        "ranges": [[_data(each) for each in ends] for ends in answer.ranges],
        "jumps": list(answer.jumps),
        "always": list(answer.always),
        "nearest": None if answer.nearest is None else _data(answer.nearest),
        "machine": None if machine is None else {"status": machine.status, "governing": machine.governing,
                                                 "failing": [name for name, _ in machine.checks("fail")]},
    }  # fmt: skip


def _data(found: FoundValue) -> dict[str, Any]:
    reached = None if math.isnan(found.reached) else found.reached
    return {"value": found.value, "typed": found.typed, "reached": reached, "role": found.role, "at_end": found.at_end,
            "beyond": list(found.beyond)}  # fmt: skip
