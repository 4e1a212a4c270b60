"""What is found where one input is solved for, and how it is told: as text and as plain data."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from diecut_report.design.design_inputs import DesignInput
from diecut_report.design.proved_machine import ProvedMachine
from diecut_report.design.questions import DesignQuestion

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

    Without an answer ``nearest`` is the value that comes nearest. ``reached`` is what is asked for today (NaN where that is nothing).
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


def lines(answer: Answer) -> Iterator[str]:
    """Yield what is found, in words."""
    design, asked = answer.design, answer.question.quantity
    today = "" if design.today is None else f"today {design.told(design.today)}"
    reached = "" if math.isnan(answer.reached) else f", {asked.name} {asked.told(answer.reached)}"
    yield f"{answer.question.told}{' with all checks passing' if answer.passing else ''}, by {design.name} ({today or 'not given today'}{reached})"
    yield from (f"  {line}" for line in (_found(answer) if answer.found else _nearest(answer)))
    for place in answer.jumps:
        yield f"  at {design.told(place)} {asked.name} jumps over {asked.told(answer.question.value)} and does not take that value"


def _found(answer: Answer) -> Iterator[str]:
    design, asked, machine = answer.design, answer.question.quantity, answer.machine
    first = answer.found[0]
    what = "holds today already" if first.role == "today" else f"{design.name} = {first.typed}"
    yield f"{what}: {asked.name} is {asked.told(first.reached)}{_end(first)}"
    if machine is not None:
        yield _verdict(machine, first)
    if first.beyond:
        yield f"just beyond it fails {', '.join(first.beyond)}"
    for low, high in answer.ranges:
        ends = (f"{each.typed}{' (end of the search)' if each.at_end else ''}" for each in (low, high))
        yield f"it holds from {' to '.join(ends)}"
    if not answer.ranges:
        for each in answer.found[1:]:
            yield f"also {design.name} = {each.typed}: {asked.name} is {asked.told(each.reached)}"


def _end(found: FoundValue) -> str:
    return ", at the end of the range that was searched" if found.at_end else ""


def _verdict(machine: ProvedMachine, found: FoundValue) -> str:
    """The machine that was calculated alone."""
    if not found.failing:
        return f"calculated as a machine of its own: no check fails; governing: {machine.governing or 'none'}"
    count = len(found.failing)
    return f"calculated as a machine of its own: {count} check{'s fail' if count > 1 else ' fails'}: {', '.join(found.failing)}"


def _nearest(answer: Answer) -> Iterator[str]:
    design, asked, near = answer.design, answer.question.quantity, answer.nearest
    yield f"no value of {design.name} from {design.told(answer.low)} to {design.told(answer.high)} does"
    if near is not None:
        yield f"nearest: {design.name} = {near.typed}, where {asked.name} is {asked.told(near.reached)}{_end(near)}{_fails(near)}"
        yield "give another range with --from and --to, or change another input"


def _fails(found: FoundValue) -> str:
    return f", and these checks fail: {', '.join(found.failing)}" if found.failing else ""


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
        "nearest": None if answer.nearest is None else _data(answer.nearest),
        "machine": None if machine is None else {"status": machine.status, "governing": machine.governing,
                                                 "failing": [name for name, _ in machine.checks("fail")]},
    }  # fmt: skip


def _data(found: FoundValue) -> dict[str, Any]:
    reached = None if math.isnan(found.reached) else found.reached
    return {"value": found.value, "typed": found.typed, "reached": reached, "role": found.role, "at_end": found.at_end,
            "beyond": list(found.beyond)}  # fmt: skip
