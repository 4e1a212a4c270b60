"""What is asked of a machine where one input is solved for, what is found, and how it is told: as text and as plain data."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.parts.reading import place_of
from diecut_report.design.inputs import DesignInput, design_input
from diecut_report.design.machines import CHECKS, UTILISATION, ProvedMachine, quantities
from diecut_report.errors import Problem, UserError, nearest, refusal
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import UnitError, parse_quantity, unit
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.execution.variant_rows import columns_of
from diecut_report.text.phrases import Counted, Phrase, named, phrase
from diecut_report.text.translation import localised

# What a designer asks of a machine: a quantity that is to have a value, stay below or above one, or be as small or great as can be.


Kind = Literal["=", "<=", ">=", "max", "min"]
COMPARED = re.compile(r"\s*(?P<name>[\w.-]+?)\s*(?P<sign>==|=|<=|>=|≤|≥|<|>)\s*(?P<value>.+?)\s*")
EXTREME = re.compile(r"\s*(?P<way>max|min)(imi[sz]e)?\s+(?P<name>[\w.-]+)\s*")
SIGNS: dict[str, Kind] = {"==": "=", "=": "=", "<=": "<=", "≤": "<=", "<": "<=", ">=": ">=", "≥": ">=", ">": ">="}
SHOWN = 12  # known names that a message lists, further values that a text names


@dataclass(frozen=True)
class AskedNumber:
    """Hold a number that a machine gives, or an input of it: its name, its column among the results, the unit it is read in."""

    name: str
    column: str
    unit: str
    home: str
    asked: Input | None = None

    @property
    def si(self) -> str:
        """Return its SI unit."""
        return unit(self.unit).si

    def told(self, value: float, digits: int = 6) -> str:
        """Return a value (SI) as one says it."""
        return localised(told(value, self.unit, digits))


@dataclass(frozen=True)
class DesignQuestion:
    """Hold what is asked: a quantity, what it is to be, and the value (SI) where that is one."""

    quantity: AskedNumber
    kind: Kind
    value: float = 0.0

    @property
    def is_extreme(self) -> bool:
        return self.kind in ("max", "min")

    @property
    def told(self) -> str:
        """Return it as it may be typed."""
        name = self.quantity.name
        if self.is_extreme:
            return f"{self.kind} {name}"
        return f"{name} {self.kind} {told(self.value, self.quantity.unit, 6)}"


def question(config: Config, text: str) -> DesignQuestion:
    """Read what is asked, such as ``drive.crank_torque_peak = 400 N*m`` or ``max press.productivity``; UserError in words."""
    if extreme := EXTREME.fullmatch(text):
        return DesignQuestion(quantity(config, extreme["name"]), "max" if extreme["way"] == "max" else "min")
    compared = COMPARED.fullmatch(text)
    if compared is None:
        template = (
            "{text} is not a question; write one such as “drive.crank_torque_peak = 400 N*m”, "
            "“cylinder.mass <= 90 kg” or “max press.productivity”."
        )
        raise UserError(Problem(Phrase(template, text=repr(text)), path="--for"))
    asked = quantity(config, compared["name"])
    try:
        return DesignQuestion(asked, SIGNS[compared["sign"]], parse_quantity(compared["value"], asked.unit))
    except UnitError as fault:
        raise UserError(Problem(Phrase("{name}: {fault}", name=asked.name, fault=fault), path="--for")) from None


def quantity(config: Config, name: str) -> AskedNumber:
    """Return the number that a name stands for: an output, the utilisation of a check, an input, or one of a part; UserError in words."""
    home, _, own = name.removeprefix("mechanisms.").partition(".")
    if home in WORDS and config.parts is not None and (made := _of_part(config.parts, name)):
        return quantity(config, made)
    column = quantities(config).get(f"{home}.{own}")
    if column is not None:
        return AskedNumber(column.name, column.name, column.display or column.unit, home)
    if own.startswith(CHECKS[1:]):
        return _utilisation(config, home, own.removeprefix(CHECKS[1:]).removesuffix(UTILISATION))
    instance = config.instances.get(home)
    if home == PRESS or (instance and own.split(".")[0] in instance.model.model_fields):
        found = design_input(config, name)
        return AskedNumber(found.name, found.asked.path, found.unit, found.asked.instance, found.asked)
    raise UserError(Problem(_unknown(config, home, own), config.tree.file))


def _of_part(parts: MachineParts, name: str) -> str:
    """The first input of a calculation that follows from a number of a part; nothing where none does."""
    place = place_of(parts.reader.data, name)
    nodes = (node for node, there in parts.sources.items() if there == place and len(node) > 1)
    return next((".".join(map(str, node)) for node in nodes), "")


def _utilisation(config: Config, home: str, check: str) -> AskedNumber:
    column = f"{home}{CHECKS}{check}{UTILISATION}"
    known = [each.name for each in columns_of(config) if each.name.endswith(UTILISATION)]
    if column not in known:
        near = nearest(column, [name for name in known if name.startswith(f"{home}.")] or known)
        raise refusal(
            "{home}.checks.{check} is not a check{near}.", config.tree.file, home=home, check=check, near=near
        )
    return AskedNumber(column, column, "1", home)


def _unknown(config: Config, home: str, own: str) -> Phrase:
    mechanisms = [name for name in config.instances if name != PRESS]
    if home not in config.instances:
        template = "{name}: there is no mechanism {home}{near}. Known: {known}."
        near = nearest(home, mechanisms)
        return Phrase(template, name=f"{home}.{own}", home=repr(home), near=near, known=", ".join(mechanisms))
    known = [name.removeprefix(f"{home}.") for name in quantities(config) if name.startswith(f"{home}.")]
    if not own:
        template = "{home} names no number; add one, as in {example}."
        return Phrase(template, home=home, example=f"{home}.{next(iter(known), 'output')}")
    near = nearest(own, known)
    if not near and len(known) > SHOWN:
        near = Phrase("; it gives {names} and {n} more", names=", ".join(known[:SHOWN]), n=len(known) - SHOWN)
    near = near or Phrase("; it gives {names}", names=", ".join(known) or phrase("none"))
    template = "{name} is neither a number that {home} gives nor an input of it{near}."
    return Phrase(template, name=f"{home}.{own}", home=home, near=near)


Role = Literal["root", "lower", "upper", "extreme", "choice", "today", "nearest"]


@dataclass(frozen=True)
class FoundValue:
    """Hold a value that answers: of the input (SI and as typed), of what is asked, and the checks that fail there.

    ``role``: a root; the lower or upper end of a range of values where it holds; an extreme; one of some texts, of which ``value`` is NaN;
    today's value, which holds already; or the nearest value that is reached where none answers. ``at_end``: it is the end of the range
    that was searched. ``beyond`` are the checks that fail just beyond it, where only machines that pass are searched.
    """

    value: float
    typed: str
    reached: float
    role: Role
    failing: tuple[str, ...] = ()
    beyond: tuple[str, ...] = ()
    at_end: bool = False

    @property
    def data(self) -> dict[str, Any]:
        """Return it as plain data."""
        reached = None if math.isnan(self.reached) else self.reached
        value = None if math.isnan(self.value) else self.value
        return {"value": value, "typed": self.typed, "reached": reached, "role": self.role, "at_end": self.at_end,
                "beyond": list(self.beyond)}  # fmt: skip


Range = tuple[FoundValue, FoundValue]


@dataclass(frozen=True)
class Answer:
    """Hold what was found: the answers, the nearest first; the ranges of values in which it holds; the places where the
    asked number jumps over the value; the proof of the first.

    Without an answer ``nearest`` is the value that comes nearest, and ``always`` are the checks that fail with every value, where all are to pass.
    ``reached`` is what is asked for today (NaN where that is nothing). ``refused`` are values with which no machine can be, and why.
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
    refused: Mapping[str, str] = field(default_factory=dict)


def lines(answer: Answer) -> Iterator[str]:
    """Yield what is found, in words."""
    design, asked, present = answer.design, answer.question.quantity, answer.design.present
    passing = phrase(" with no check failing") if answer.passing else ""
    reached = "" if math.isnan(answer.reached) else f", {asked.name} {asked.told(answer.reached)}"
    now = phrase("not given at present")
    if present is not None or (design.is_text and design.written):
        value = str(design.written) if present is None else localised(design.told(present))
        now = Phrase("at present {value}", value=value)
    template = "{question}{passing}, by {input} ({now}{reached})"
    yield Phrase(template, question=answer.question.told, passing=passing, input=design.name, now=now, reached=reached)
    for line in _found(answer) if answer.found else _nearest(answer):
        yield Phrase("  {line}", line=line)
    for place in answer.jumps:
        jump = "  at {place} {asked} jumps past {value} without taking that value"
        yield Phrase(
            jump, place=localised(design.told(place)), asked=asked.name, value=asked.told(answer.question.value)
        )

    for text, reason in answer.refused.items():
        yield Phrase("  {input} = {typed} cannot be: {reason}", input=design.name, typed=text, reason=reason)


def _found(answer: Answer) -> Iterator[str]:
    design, asked, machine, first = answer.design, answer.question.quantity, answer.machine, answer.found[0]
    what = phrase("is already satisfied") if first.role == "today" else f"{design.name} = {first.typed}"
    template = "{what}: {asked} is {value}{end}"
    yield Phrase(template, what=what, asked=asked.name, value=asked.told(first.reached), end=_end(first))
    if machine is not None and first.failing:
        one = "recalculated as a single machine: {n} check fails: {checks}"
        many = "recalculated as a single machine: {n} checks fail: {checks}"
        yield Counted(len(first.failing), one, many, checks=", ".join(first.failing))
    elif machine is not None:
        template = "recalculated as a single machine: no check fails; governing: {check}"
        yield Phrase(template, check=machine.governing or phrase("none"))
    if machine is not None and (warned := machine.checks("warn")):
        yield Phrase("with a warning: {checks}", checks=", ".join(warned))
    if first.beyond:
        yield Phrase("just beyond it, these fail: {checks}", checks=", ".join(first.beyond))
    for low, high in answer.ranges:
        if low.typed == high.typed:
            yield Phrase("satisfied by {value} alone", value=low.typed)
        else:
            yield Phrase("satisfied from {low} to {high}", low=_side(low), high=_side(high))
    others = () if answer.ranges else answer.found[1:]  # of which a text names the nearest
    for each in others[:SHOWN]:
        template = "also {input} = {typed}: {asked} is {value}"
        yield Phrase(template, input=design.name, typed=each.typed, asked=asked.name, value=asked.told(each.reached))
    if len(others) > SHOWN:
        more = "and {n} more values; --format json has all of them"
        yield Counted(len(others) - SHOWN, "and {n} more value; --format json has all of them", more)


def _side(found: FoundValue) -> str:
    return Phrase("{value} (end of the search range)", value=found.typed) if found.at_end else found.typed


def _end(found: FoundValue) -> str:
    return phrase(", at the end of the search range") if found.at_end else ""


def _nearest(answer: Answer) -> Iterator[str]:
    design, asked, near = answer.design, answer.question.quantity, answer.nearest
    if design.among or design.is_text:
        template = "none of these satisfies it: {input} = {values}"
        yield Phrase(template, input=design.name, values=named([*design.options], " or "))
    else:
        ends = {"low": localised(design.told(answer.low)), "high": localised(design.told(answer.high))}
        yield Phrase("no value of {input} from {low} to {high} satisfies it", input=design.name, **ends)
    if near is not None:
        fails: str = Phrase(", and these checks fail: {checks}", checks=", ".join(near.failing)) if near.failing else ""
        reached = {"asked": asked.name, "value": asked.told(near.reached), "end": _end(near), "fails": fails}
        template = "nearest: {input} = {typed}, where {asked} is {value}{end}{fails}"
        yield Phrase(template, reached, input=design.name, typed=near.typed)
    if answer.always:
        one = "at any value, {checks} fails: change another input first; `advise` looks for one"
        many = "at any value, {checks} fail: change another input first; `advise` looks for one"
        yield Counted(len(answer.always), one, many, checks=", ".join(answer.always))
    elif near is not None and not (design.among or design.is_text):
        yield phrase("give another range with --from and --to, or change another input")


def _varied(answer: Answer) -> dict[str, Any]:
    design = answer.design
    if design.is_text:
        return {"unit": None, "today": design.written, "among": list(design.options), "refused": dict(answer.refused)}
    listed = {"among": list(design.among), "refused": dict(answer.refused)}
    ends = listed if design.among else {"from": answer.low, "to": answer.high}
    return {"unit": design.meta.parsed_unit.si, "today": design.present, **ends}


def data(answer: Answer) -> dict[str, Any]:
    """Return the same as plain data, SI."""
    question, design, machine = answer.question, answer.design, answer.machine
    return {
        "schema_version": 1,
        "vary": {"path": design.asked.path, **_varied(answer)},
        "for": {"name": question.quantity.name, "kind": question.kind, "passing": answer.passing, "unit": question.quantity.si,
                "today": None if math.isnan(answer.reached) else answer.reached,
                **({} if question.is_extreme else {"value": question.value})},
        "solutions": [each.data for each in answer.found],
        "ranges": [[each.data for each in ends] for ends in answer.ranges],
        "jumps": list(answer.jumps),
        "always": list(answer.always),
        "nearest": answer.nearest and answer.nearest.data,
        "machine": machine and {"status": machine.run.status, "governing": machine.governing, "failing": list(machine.failing)},
    }  # fmt: skip
