"""What is found where one input is solved for, and how it is told: as text and as plain data."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Literal, Protocol

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.design.inputs import DesignInput, design_input
from diecut_report.design.machines import CHECKS, UTILISATION, ProvedMachine, VariedMachines, narrowed, quantities
from diecut_report.errors import Problem, UserError, nearest
from diecut_report.formulas import Array
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import UnitError, parse_quantity, unit
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.execution.variant_rows import columns_of
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import localised

# What a designer asks of a machine: a quantity that is to have a value, stay below or above one, or be as small or great as can be.


Kind = Literal["=", "<=", ">=", "max", "min"]
COMPARED = re.compile(r"\s*(?P<name>[\w.-]+?)\s*(?P<sign>==|=|<=|>=|≤|≥|<|>)\s*(?P<value>.+?)\s*")
EXTREME = re.compile(r"\s*(?P<way>max|maximise|maximize|min|minimise|minimize)\s+(?P<name>[\w.-]+)\s*")
SIGNS: dict[str, Kind] = {"==": "=", "=": "=", "<=": "<=", "≤": "<=", "<": "<=", ">=": ">=", "≥": ">=", ">": ">="}
SHOWN = 12  # known names that a message lists


@dataclass(frozen=True)
class AskedNumber:
    """Hold a number that a machine gives, or an input of it: its name, its column among the results, the unit it is read in."""

    name: str
    column: str
    unit: str
    home: str
    asked: Input | None = None
    description: str = ""

    @property
    def si(self) -> str:
        """Return its SI unit."""
        return unit(self.unit).si

    def told(self, value: float, digits: int = 6) -> str:
        """Return a value (SI) as one says it."""
        return told(value, self.unit, digits)


@dataclass(frozen=True)
class DesignQuestion:
    """Hold what is asked: a quantity, what it is to be, and the value (SI) where that is one."""

    quantity: AskedNumber
    kind: Kind
    value: float = 0.0

    @property
    def told(self) -> str:
        """Return it as it may be typed."""
        name = self.quantity.name
        return (
            f"{self.kind} {name}"
            if self.kind in ("max", "min")
            else f"{name} {self.kind} {self.quantity.told(self.value)}"
        )


def question(config: Config, text: str) -> DesignQuestion:
    """Read what is asked, such as ``drive.crank_torque_peak = 400 N*m`` or ``max press.productivity``; UserError in words."""
    if extreme := EXTREME.fullmatch(text):
        return DesignQuestion(quantity(config, extreme["name"]), "max" if extreme["way"].startswith("max") else "min")
    compared = COMPARED.fullmatch(text)
    if compared is None:
        words = (
            "{text} is not a question; write one such as “drive.crank_torque_peak = 400 N*m”, "
            "“cylinder.mass <= 90 kg” or “max press.productivity”."
        )
        raise UserError(Problem(Phrase(words, text=repr(text)), path="--for"))
    asked = quantity(config, compared["name"])
    try:
        return DesignQuestion(asked, SIGNS[compared["sign"]], parse_quantity(compared["value"], asked.unit))
    except UnitError as fault:
        raise UserError(Problem(Phrase("{name}: {fault}", name=asked.name, fault=fault), path="--for")) from None


def quantity(config: Config, name: str) -> AskedNumber:
    """Return the number that a name stands for: an output, the utilisation of a check, or an input; UserError in words."""
    home, _, own = name.removeprefix("mechanisms.").partition(".")
    column = quantities(config).get(f"{home}.{own}")
    if column is not None:
        return AskedNumber(column.name, column.name, column.display or column.unit, home, None, column.description)
    if own.startswith(CHECKS[1:]):
        return _utilisation(config, home, own.removeprefix(CHECKS[1:]).removesuffix(UTILISATION))
    if home == PRESS or (home in config.instances and _is_input(config, home, own)):
        found = design_input(config, name)
        return AskedNumber(
            found.name, found.asked.path, found.unit, found.asked.instance, found.asked, found.meta.description
        )
    raise UserError(Problem(_unknown(config, home, own), config.tree.file))


def needed(config: Config, asked: AskedNumber, varied: Input) -> Config:
    """Return what must be calculated for a number: that of an output alone; of an input the whole, which says whether it can be."""
    return config if asked.asked is not None else narrowed(config, [asked.home, varied.instance])


def _utilisation(config: Config, home: str, check: str) -> AskedNumber:
    column = f"{home}{CHECKS}{check}{UTILISATION}"
    known = [each.name for each in columns_of(config) if each.name.endswith(UTILISATION)]
    if column not in known:
        own = [name for name in known if name.startswith(f"{home}.")]
        words = "{home}.checks.{check} is not a check{near}."
        near = nearest(column, own or known)
        raise UserError(Problem(Phrase(words, home=home, check=check, near=near), config.tree.file))
    return AskedNumber(column, column, "1", home)


def _is_input(config: Config, home: str, own: str) -> bool:
    instance = config.instances[home]
    return instance is not None and own.split(".")[0] in instance.model.model_fields


def _unknown(config: Config, home: str, own: str) -> Phrase:
    mechanisms = [name for name in config.instances if name != PRESS]
    if home not in config.instances:
        words = "{name}: there is no mechanism {home}{near}. Known: {known}."
        near = nearest(home, mechanisms)
        return Phrase(words, name=f"{home}.{own}", home=repr(home), near=near, known=", ".join(mechanisms))
    known = [name.removeprefix(f"{home}.") for name in quantities(config) if name.startswith(f"{home}.")]
    if not own:
        words = "{home} names no number; add one, as in {example}."
        return Phrase(words, home=home, example=f"{home}.{next(iter(known), 'output')}")
    words = "{name} is neither a number that {home} gives nor an input of it{near}."
    return Phrase(words, name=f"{home}.{own}", home=home, near=nearest(own, known) or _listed(known))


def _listed(names: Iterable[str]) -> Phrase:
    every = list(names)
    if len(every) > SHOWN:
        return Phrase("; it gives {names} and {n} more", names=", ".join(every[:SHOWN]), n=len(every) - SHOWN)
    return Phrase("; it gives {names}", names=", ".join(every) or phrase("none"))


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
    design, asked, present = answer.design, answer.question.quantity, answer.design.present
    passing = phrase(" with no check failing") if answer.passing else ""
    reached = "" if math.isnan(answer.reached) else f", {asked.name} {localised(asked.told(answer.reached))}"
    now = (
        phrase("not given at present")
        if present is None
        else Phrase("at present {value}", value=localised(design.told(present)))
    )
    words = "{question}{passing}, by {input} ({now}{reached})"
    yield Phrase(words, question=answer.question.told, passing=passing, input=design.name, now=now, reached=reached)
    yield from (_indented(line) for line in (_found(answer) if answer.found else _nearest(answer)))
    for place in answer.jumps:
        jump = "  at {place} {asked} jumps past {value} without taking that value"
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
    what = phrase("is already satisfied") if first.role == "today" else f"{design.name} = {first.typed}"
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
        yield Phrase("just beyond it, these fail: {checks}", checks=", ".join(first.beyond))
    for low, high in answer.ranges:
        yield Phrase("satisfied from {low} to {high}", low=_side(low), high=_side(high))
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
    return Phrase("{value} (end of the search range)", value=found.typed) if found.at_end else found.typed


def _end(found: FoundValue) -> str:
    return phrase(", at the end of the search range") if found.at_end else ""


def _verdict(machine: ProvedMachine, found: FoundValue) -> Phrase:
    """The machine that was calculated alone."""
    if not found.failing:
        words = "recalculated as a single machine: no check fails; governing: {check}"
        return Phrase(words, check=machine.governing or phrase("none"))
    one = "recalculated as a single machine: {n} check fails: {checks}"
    many = "recalculated as a single machine: {n} checks fail: {checks}"
    return Counted(len(found.failing), one, many, checks=", ".join(found.failing))


def _nearest(answer: Answer) -> Iterator[str]:
    design, asked, near = answer.design, answer.question.quantity, answer.nearest
    ends = {"low": localised(design.told(answer.low)), "high": localised(design.told(answer.high))}
    yield Phrase("no value of {input} from {low} to {high} satisfies it", input=design.name, **ends)
    if near is not None:
        words = "nearest: {input} = {typed}, where {asked} is {value}{end}{fails}"
        value, fails = localised(asked.told(near.reached)), _fails(near)
        yield Phrase(
            words, input=design.name, typed=near.typed, asked=asked.name, value=value, end=_end(near), fails=fails
        )
    if answer.always:
        one = "at any value, {checks} fails: change another input first; `advise` looks for one"
        many = "at any value, {checks} fail: change another input first; `advise` looks for one"
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
        "vary": {"path": design.asked.path, "unit": design.meta.parsed_unit.si, "today": design.present, "from": answer.low, "to": answer.high},
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


# Values that were found, as they are typed: with few digits where these answer as well, each calculated as it is typed.


EXACT, ALL = 9, 17  # digits of a root; of one beside a jump
REACHED = 1e-5  # share of its size by which a root as it is typed may miss the value
FEW = 5  # digits of the end of a range
SAME_END = 1e-6  # share of an end by which a rounded one may lie beyond it, where it holds all the same
SAME_EXTREME = 2e-5  # share of an extreme that rounding the input may take from it
BEYOND = 1e-4  # share of a value by which it is left to see what fails there


class Searched(Protocol):
    """What typed values are calculated by."""

    design: DesignInput
    question: DesignQuestion
    passing: bool

    def machines(self, x: Array) -> VariedMachines:
        """Return the machines with these values."""

    def holds(self, made: VariedMachines, y: Array) -> Array:
        """Return how far what is asked holds, not below zero where it does."""

    def missed(self, y: Array) -> Array:
        """Return by what share of its size each misses the value that is asked for."""


def typed_answers(search: Searched, places: list[tuple[float, Role]]) -> list[FoundValue]:
    """Return for each place what is typed there, all calculated in one run."""
    texts = [_candidates(search.design, value, role) for value, role in places]
    rows = [(number, search.design.read(text)) for number, each in enumerate(texts) for text in each]
    beyond = [(number, value) for number, (value, role) in enumerate(places) for value in _outside(search, value, role)]
    if not rows:
        return []
    x = np.array([value for _, value in (*rows, *beyond)])
    made = search.machines(x)
    y = made.values(search.question.quantity.column)
    held, missed = search.holds(made, y) >= 0, search.missed(y)
    owner = np.array([number for number, _ in (*rows, *beyond)])
    found = []
    for number, (value, role) in enumerate(places):
        own = np.flatnonzero(owner[: len(rows)] == number)
        best = _chosen(own, x, y, held, missed, value, role)
        text = texts[number][best - own[0]]
        outside = np.flatnonzero(owner[len(rows) :] == number) + len(rows)
        failing = tuple(made.failing(int(best))) if search.passing else ()
        limits = tuple(dict.fromkeys(name for row in outside for name in made.failing(int(row)) if name not in failing))
        found.append(FoundValue(float(x[best]), text, float(y[best]), role, failing, limits))
    return found


def _candidates(design: DesignInput, value: float, role: Role) -> list[str]:
    """What may be typed, the best first."""
    exact = design.typed(value, EXACT)
    if design.is_whole or role == "today" or value == design.present:
        return [exact]
    inwards = [design.typed_inwards(value, EXACT, up=up) for up in (True, False)]
    few = {
        "root": [exact, *inwards, design.typed(value, ALL)],  # beside a jump rounding may fall over its edge
        "lower": [design.typed(value, FEW), design.typed_inwards(value, FEW, up=True), inwards[0], exact],
        "upper": [design.typed(value, FEW), design.typed_inwards(value, FEW, up=False), inwards[1], exact],
        "extreme": [*(design.typed(value, digits) for digits in (3, 4, 5, 6, 7)), exact],
    }.get(role, [exact])
    return [text for text in dict.fromkeys(few) if design.allows(np.array(_number(design, text)))]


def _number(design: DesignInput, text: str) -> float:
    try:
        return design.read(text)
    except ValueError:  # rounded beyond what its declaration allows
        return float("nan")


def _chosen(own: Array, x: Array, y: Array, held: Array, missed: Array, value: float, role: Role) -> int:
    """The first of the candidates that is as good as the exact one, which is the last."""
    exact = int(own[-1])
    if role in ("lower", "upper"):
        near = np.abs(x[own] - value) <= SAME_END * abs(value)
        inside = x[own] >= value if role == "lower" else x[own] <= value
        good = held[own] & (near | inside)
    elif role == "extreme":
        good = held[own] & (np.abs(y[own] - y[exact]) <= SAME_EXTREME * abs(y[exact]))
    elif role == "root":
        good = missed[own] <= REACHED
    else:
        return exact
    return int(own[np.argmax(good)]) if good.any() else exact


def _outside(search: Searched, value: float, role: Role) -> list[float]:
    """Values just beyond the end of what passes."""
    if not search.passing or role in ("root", "today", "nearest"):
        return []
    step = 1.0 if search.design.is_whole else BEYOND * abs(value)
    ways = {"lower": (-step,), "upper": (step,)}.get(role, (-step, step))
    beyond = np.array([value + way for way in ways])
    return [float(each) for each in beyond[search.design.allows(beyond)]]
