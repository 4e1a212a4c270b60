"""The inputs of a configuration that a designer may change: found by their names, with their values today and their bounds."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Container, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal, get_args, get_origin

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.parts.reading import typed_places, typed_value
from diecut_report.config.yaml import KeyPath, dotted, plain_text
from diecut_report.errors import Problem, UserError, refusal
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import Vary
from diecut_report.mechanism.curve_inputs import InOtherUnit
from diecut_report.mechanism.inputs import Quantity, Samples
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import Text
from diecut_report.mechanism.steps import Require
from diecut_report.quantities.formatting import number_text, outward, with_unit
from diecut_report.quantities.units import UnitError, number_and_unit, unit
from diecut_report.standards import related_bearings
from diecut_report.study.definition.base_inputs import (
    MECHANISMS,
    Input,
    UnknownPath,
    find_input,
    is_of_parts,
    present_value,
    typed_place,
    varied_input,
)
from diecut_report.text.phrases import Phrase, phrase

TEXT = phrase("is a text; name those that are to be tried with --among.")
MANY_STEPS = 20  # references that are followed to where a value stands; a loop is refused where a file is read


@dataclass(frozen=True, eq=False)
class DesignInput:
    """Hold an input that may be changed. ``present`` is its value (SI), None of a text or without one; ``unit`` the one it is typed in.

    ``stands`` is its place in the file, whether it is there or not; ``written`` what is typed there, None where nothing is. ``among`` are the
    only values that are tried, as they are typed; none where it may be any.
    """

    asked: Input
    present: float | None
    unit: str
    written: str | None
    stands: KeyPath
    among: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Return what people call it: ``drive.crank_length``, ``press.productivity``."""
        return self.asked.path.removeprefix(f"{MECHANISMS}.")

    @property
    def key(self) -> str:
        """Return its key within its mechanism, without places in lists."""
        return dotted(self.asked.key)

    @property
    def meta(self) -> Quantity:
        """Return how a number is declared."""
        assert isinstance(self.asked.meta, Quantity)
        return self.asked.meta

    @property
    def is_whole(self) -> bool:
        return self.asked.is_integer

    @property
    def listed(self) -> np.ndarray:
        """Return the only numbers (SI) that it may be, ascending; none where it may be any of a range."""
        if self.among:
            return np.unique([self.read(text) for text in self.among])
        return np.sort([self.meta.parsed_unit.to_si(value) for value in self.meta.listed])

    @property
    def is_stepped(self) -> bool:
        """Return whether a number takes some values alone, and so none between them."""
        return self.is_whole or bool(self.among or self.meta.listed)

    @property
    def is_text(self) -> bool:
        return not isinstance(self.asked.meta, Quantity)

    @property
    def options(self) -> tuple[str, ...]:
        """Return the values of a text or yes/no, as they are typed, or those that are tried; none of a number, or where it may be any text."""
        meta = self.asked.meta
        if self.among or isinstance(meta, Quantity):
            return self.among
        return tuple(meta.options) or tuple(allowed_texts(self.asked.annotation))

    @property
    def bounds(self) -> tuple[float, float]:
        """Return the least and the greatest value (SI) that its declaration has, open ends included; infinite without one."""
        factor = self.meta.parsed_unit.factor
        low = [limit * factor for limit in (self.meta.gt, self.meta.ge) if limit is not None]
        high = [limit * factor for limit in (self.meta.lt, self.meta.le) if limit is not None]
        return max(low, default=-math.inf), min(high, default=math.inf)

    def allows(self, values: np.ndarray) -> np.ndarray:
        """Return which values (SI) the declaration allows."""
        return np.asarray(self.meta.holds(values))

    def changed(self, share: Any) -> Any:
        """Return today's value (SI) changed by a share of it, or by many."""
        return (self.present or 0.0) * (1.0 + share)

    def share(self, value: float) -> float:
        """Return by which share of today's value another one (SI) differs."""
        return value / (self.present or 1.0) - 1.0

    def told(self, value: float, digits: int = 6) -> str:
        """Return a value (SI) as one says it, in the unit that it is typed in."""
        return with_unit(number_text(unit(self.unit).from_si(value), digits), self.unit)

    def typed(self, value: float, digits: int = 12) -> str:
        """Return a value (SI) as it is typed into the file, with so many digits at most."""
        return self._typed(float(f"{unit(self.unit).from_si(value):.{digits}g}"))

    def typed_inwards(self, value: float, digits: int, *, up: bool) -> str:
        """Return it rounded upwards, or downwards, to so many digits."""
        return self._typed(outward(unit(self.unit).from_si(value), up, digits))

    def _typed(self, number: float) -> str:
        text = f"{round(number)}" if number.is_integer() and abs(number) < 1e15 else f"{number!r}"
        return text if self.unit == "1" else f"{text} {self.unit}"

    def in_file(self, typed: str) -> str:
        """Return a value as it stands in a file: a text in quotes where it would be read as something else, as the bearing 6210."""
        return plain_text(typed) if self.is_text and typed not in ("true", "false") else typed

    def read(self, typed: str) -> float:
        """Return the value (SI) of what was typed; ValueError in words where it is not allowed, or is no number."""
        if self.is_text:
            raise ValueError(TEXT)
        return float(self.meta.validate(typed))

    def read_allowed(self, typed: str) -> float:
        """Return the value (SI) of what was typed; NaN where it was rounded beyond what the declaration allows."""
        try:
            return self.read(typed)
        except ValueError:
            return math.nan


def design_input(config: Config, name: str) -> DesignInput:
    """Return the number that a name stands for, also where it refers to it; UserError in words where it cannot be changed."""
    asked = _asked(config, name)
    for _ in range(MANY_STEPS):
        target = config.links.get(asked.node)
        if target is None or target.is_default:
            break
        if target.expression or target.result is not None or target.is_broken:
            template = (
                "{name} follows from {what}, {told}, and is not changed by itself; "
                "change an input that {origins} follows from, or write a number at {path} first."
            )
            what = phrase("an expression") if target.expression else phrase("an output")
            origins = ", ".join(sorted({single.path for single in target.single}))
            raise refusal(
                template, config.tree.file, name=name, what=what, told=target.told, origins=origins, path=asked.path
            )
        asked = find_input(config, _path(target.instance, target.key))
    return _number(config, asked)


def _number(config: Config, asked: Input) -> DesignInput:
    found = _made(config, asked)
    if not isinstance(asked.meta, Quantity):
        template = "{name} is a text, a choice or a yes/no; name an input that is a number."
        raise refusal(template, config.tree.file, name=found.name)
    if isinstance(asked.meta, Samples):
        template = "{name} only sets how densely curves are listed; it does not affect the machine."
        raise refusal(template, config.tree.file, name=found.name)
    return found


def free_input(config: Config, name: str) -> DesignInput:
    """Return the number that a name stands for, which takes other values, also one that is typed at a part of a machine.

    UserError in words where it is no number, or follows from the parts.
    """
    return _number(config, named_input(config, name).asked)


def solved_input(config: Config, name: str, among: Sequence[str] = ()) -> DesignInput:
    """Return the input that a name stands for, also one of the parts of a machine, or that these are made with, which then follow it.

    Of ``among``, values as they are typed, one is looked for; a text takes one of them, or of all that it may be. UserError in words where
    it cannot be changed, or follows from the parts itself.
    """
    found = named_input(config, name)
    if isinstance(found.written, str) and "${" in found.written:
        template = "{name} follows from {written}; change what that refers to, or write a value there first."
        raise refusal(template, config.tree.file, name=found.name, written=found.written)
    if found.is_text and not (among or found.options):
        raise refusal("{name} {fault}", config.tree.file, name=found.name, fault=TEXT)
    for text in () if found.is_text else among:
        try:
            found.read(text)
        except ValueError as fault:
            wrong = Phrase("{name}: {fault}", name=found.name, fault=fault)
            raise UserError(Problem(wrong, config.tree.file, path="--among")) from None
    return replace(found, among=tuple(dict.fromkeys(among)))


def untied(config: Config, designs: Iterable[DesignInput]) -> list[DesignInput]:
    """Return those that the parts of a machine neither give nor are made with."""
    parts = config.parts
    return [
        each
        for each in designs
        if parts is None or not (parts.follows(each.asked.node) or parts.is_made_with(each.asked.node))
    ]


def named_input(config: Config, name: str) -> DesignInput:
    """Return the input of a name, be it a number, a text or a yes/no, which the parts of a machine follow where it is of them.

    UserError in words where there is none, or it follows from the parts.
    """
    try:
        if config.parts is not None and name.split(".")[0] in WORDS:
            asked = varied_input(config, name)
        else:
            own = _asked(config, name)
            asked = varied_input(config, (design_input(config, name).asked if own.unit is not None else own).path)
    except UnknownPath as fault:
        raise refusal("{name} {fault}", config.tree.file, name=name, fault=fault) from None
    return _number(config, asked) if asked.unit is not None else _made(config, asked)


def typed_input(config: Config, path: str) -> DesignInput:
    """Return the input of a path, or the part of a machine that it follows from; UserError in words where that is not typed."""
    asked, parts = _asked(config, path), config.parts
    place = parts.typed_at(asked.node) if parts is not None and parts.follows(asked.node) else None
    return named_input(config, ".".join(str(step) for step in place if step != "value") if place else path)


def _asked(config: Config, name: str) -> Input:
    first = name.split(".")[0]
    try:
        return find_input(config, f"{MECHANISMS}.{name}" if first in config.instances and first != PRESS else name)
    except UnknownPath as fault:
        raise refusal("{name} {fault}", config.tree.file, name=name, fault=fault) from None


def touched_by(config: Config, asked: Input) -> set[str]:
    """Return the mechanisms that an input is of: all that are calculated, where the parts of a machine follow it."""
    return {*config.instances} if is_of_parts(config, asked) else {asked.instance}


def given_numbers(config: Config) -> list[DesignInput]:
    """Return all inputs that stand in the file as a number of their own, in its order."""
    return [
        each for each in _own(config, Quantity, given=True) if each.present is not None and _stands_there(config, each)
    ]


def numbers_to_vary(config: Config) -> list[DesignInput]:
    """Return all numbers of the file whose other values give another machine, also those that are typed at its parts, in its order."""
    parts = config.parts
    given = [each for each in given_numbers(config) if parts is None or not parts.follows(each.asked.node)]
    return sorted([*given, *_numbers_at_parts(config)], key=lambda each: config.tree.position(each.stands))


def _numbers_at_parts(config: Config) -> Iterator[DesignInput]:
    """What is typed at the parts of a machine as a number of its own."""
    if (parts := config.parts) is not None:
        for place in typed_places(parts.reader.tree):
            with suppress(UnknownPath):  # a key that goes into no calculation
                found = _made(config, varied_input(config, parts.called(place)))
                if found.present is not None:
                    yield found


def given_words(config: Config) -> list[DesignInput]:
    """Return all inputs for whose number a word stands in the file, as ``auto``, in its order."""
    own = (each for each in _own(config, Quantity, given=True) if each.present is None and _stands_there(config, each))
    return [each for each in own if each.written in each.meta.words]


def numbers_at_default(config: Config) -> list[DesignInput]:
    """Return all inputs that are not given and stand at a number that their declaration has as default."""
    return [each for each in _own(config, Quantity, given=False) if each.present is not None]


def standing_numbers(config: Config) -> dict[str, DesignInput]:
    """Return all inputs that are a number of their own, given or by default, by their paths."""
    own = (each for is_given in (True, False) for each in _own(config, Quantity, given=is_given))
    return {each.asked.path: each for each in own if each.present is not None}


def given_choices(config: Config) -> list[DesignInput]:
    """Return all texts and yes/no of the file that have a few allowed values, in its order."""
    return [each for each in _own(config, Text, given=True) if each.options and _stands_there(config, each)]


def inputs_of_parts(config: Config) -> dict[str, list[DesignInput]]:
    """Return what is typed at the parts of a machine, by the mechanisms that are made with it: numbers, and texts that may be another one.

    Of a bearing these are designations of its bore, and of its series.
    """
    parts, found, made = config.parts, dict[KeyPath, DesignInput](), dict[str, list[DesignInput]]()
    if parts is None:
        return made
    for node, place in parts.sources.items():
        if place and place[0] in WORDS:
            with suppress(UnknownPath):  # a block, or what the program writes there
                each = found[place] if place in found else _made(config, varied_input(config, parts.called(place)))
                found[place] = replace(each, among=related_bearings(each.written or "")) if each.is_text else each
                own = made.setdefault(str(node[0]), [])
                if found[place] not in own and (found[place].present is not None or found[place].among):
                    own.append(found[place])
    return made


def choices_at_default(config: Config) -> list[DesignInput]:
    """Return all texts and yes/no with a few allowed values that are not given and stand at a default, which is ``written`` here."""
    own = (each for each in _own(config, Text, given=False) if each.options)
    return [replace(each, written=str(text)) for each in own if (text := present_value(config, each.asked))]


def _own(config: Config, kind: type, *, given: bool) -> Iterator[DesignInput]:
    """The inputs that refer to nothing."""
    for name, instance in config.instances.items():
        for slot in instance.slots if instance else ():
            is_meant = isinstance(slot.meta, kind) and slot.is_given is given and not isinstance(slot.meta, Samples)
            if is_meant and (name, *slot.key) not in config.links:
                with suppress(UnknownPath):  # it stands for several, as in a list
                    yield _made(config, find_input(config, _path(name, slot.key)))


def _stands_there(config: Config, found: DesignInput) -> bool:
    """Whether it is typed in the configuration itself, and not in a table beside it or taken from a partner."""
    instance = config.instances[found.asked.instance]
    assert instance is not None
    return instance.place.stands(found.asked.key)[0] is config.tree and found.written is not None


def _path(instance: str, key: KeyPath) -> str:
    return ".".join(map(str, (*(() if instance == PRESS else (MECHANISMS,)), instance, *key)))


def _made(config: Config, asked: Input) -> DesignInput:
    if config.parts is not None and asked.instance in WORDS:
        stands = typed_place(config, asked)
        typed, present = typed_value(config.parts.reader.tree, stands), present_value(config, asked)
        written = None if typed is None else str(typed)
        number = present if isinstance(present, float) else None
        return DesignInput(asked, number, _typed_unit(written, asked.meta), written, stands)
    instance = config.instances[asked.instance]
    assert instance is not None
    _, stands = instance.place.stands(asked.key)
    written = config.tree.typed(stands)
    return DesignInput(asked, _present(config, asked), _typed_unit(written, asked.meta), written, stands)


def _present(config: Config, asked: Input) -> float | None:
    """The value that the file gives, or the default."""
    link = config.links.get(asked.node)
    if link is not None and (link.expression or link.result is not None or link.node in config.links):
        return None
    instance = config.instances[asked.instance if link is None else link.instance]
    assert instance is not None
    value = instance.value(asked.key if link is None else link.key)
    value = value.value if isinstance(value, InOtherUnit) else value
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(link.formula(value)) if link and link.formula else float(value)


def _typed_unit(typed: str | None, meta: Quantity | Text) -> str:
    if isinstance(meta, Text):
        return ""
    try:
        own = number_and_unit(typed)[1] if typed else ""
        return own if own and unit(own).kind == meta.parsed_unit.kind else meta.unit
    except UnitError:
        return meta.unit


def allowed_texts(annotation: Any) -> Iterator[str]:
    """Yield the few texts that an annotation allows; none where it takes any."""
    if annotation is bool:
        yield from ("true", "false")
    elif get_origin(annotation) is Literal:
        yield from (text for text in get_args(annotation) if isinstance(text, str))
    else:
        for part in get_args(annotation):
            yield from allowed_texts(part)


# What may be named by ``--free`` beside what is free by itself: for messages that say what to do.


NAMED = 12  # inputs that a message names


def nothing_free(config: Config, left_out: Collection[str]) -> Phrase:
    """Return what is to be done where no input is free: the inputs that could be named, but for those paths."""
    known = untied(config, [*given_choices(config), *(each for each in given_numbers(config) if each.present)])
    found = [each.name for each in known if each.asked.path not in left_out]
    if not found:
        return Phrase("nothing is free to be changed: keep fewer inputs by --keep.")
    template = "nothing is free to be changed: name inputs by --free, such as --free {first}, or keep fewer by --keep; the file has {names}"
    return Phrase(template, first=found[0], names=", ".join(found[:NAMED]) + (" …" if len(found) > NAMED else "."))


def untried(config: Config, instances: Collection[str], known: Collection[str]) -> tuple[str, ...]:
    """Return the texts, yes/no and numbers of parts of mechanisms that are tried only where they are named."""
    choices = [each for each in untied(config, given_choices(config)) if len(each.options) > 1]
    whole = [each for each in untied(config, given_numbers(config)) if each.is_whole and each.present]
    own = (each for each in (*choices, *whole) if each.asked.instance in instances and each.asked.path not in known)
    return tuple(dict.fromkeys(each.name for each in own))


# Which inputs are what a machine must do: those that a check holds against what is calculated, and from which nothing else follows.


@cache
def demanded(mechanism: Mechanism) -> frozenset[str]:
    """Return the inputs that are themselves a side of a check, whichever, and that no other check follows from.

    A size of a part that is held against a bound, such as a width, is not one: other checks follow from it.
    """
    named = [(check.demand, check.limit, check.at_least) for check in mechanism.checks]
    sides = [{side for side in own if isinstance(side, str)} for own in named]
    given = set().union(*sides) - {step.id for _, step in mechanism.steps}
    reached = {name: _reached(mechanism, name) for name in given}
    return frozenset(name for name in given if all(name in own for own in sides if reached[name] & own))


def _reached(mechanism: Mechanism, name: str) -> set[str]:
    """An input with all that is calculated from it; what only must hold gives nothing."""
    found = {name}
    for _, step in mechanism.steps:
        if not isinstance(step, Require) and found & taken(step):
            found.add(step.id)
    return found


# Which inputs may be changed to mend a machine: those that the designer names, else what gives the parts their form.


FORM = ("m", "rad")  # SI units of sizes and angles, which give a part its form
RATIO = re.compile(r"(^|_)ratio($|_)")
LIMIT = re.compile(
    r"^(allowable|allowed|required|min|max|limiting|least|greatest|available|accepted)_|(^|_)(margin|tolerance)s?$"
)
FIXED_BASES = ("standard", "catalogue", "measured")


def changeable(
    config: Config, free: Sequence[DesignInput], keep: Container[str], advised: Iterable[DesignInput]
) -> list[DesignInput]:
    """Return the numbers that may be changed: the ``free`` ones, else sizes, angles and ratios, and what is advised, but for those paths.

    What the press is for, what checks demand, limits, loads, materials and numbers of parts stay as they are unless they are named.
    UserError where one of those that are named has no value.
    """
    for each in free:
        if not each.present:
            template = "{input} has no value at present, or is zero, and cannot be varied by a percentage; give it a value first."
            raise UserError(Problem(Phrase(template, input=each.name), config.tree.file, path="--free"))
    own = free or [*(each for each in untied(config, given_numbers(config)) if is_form(config, each)), *advised]
    left = [
        each for each in own if not in_series(config, each).is_stepped and each.present and each.asked.path not in keep
    ]
    return list({each.asked.path: each for each in left}.values())


NEAR = 3.0  # times today's value, and by that less: how far values of a series are tried


def in_series(config: Config, design: DesignInput) -> DesignInput:
    """Return a number that has a value of the series that its kind knows for it with the values of that near it alone, else as it is.

    What can be bought in some sizes, and is one of them, becomes another of them: a pulley of R40, a module, the length of a key.
    """
    instance, present = config.instances.get(design.asked.instance), design.present  # a part of a machine is of none
    if design.is_text or design.is_stepped or not present:
        return design
    checks = instance.mechanism.checks if instance and instance.mechanism else ()
    ways = (way for check in checks for way in check.advise if isinstance(way, Vary) and way.key == design.key)
    own = sorted({float(value) for way in ways for value in way.values if not isinstance(value, str)})
    shares = [design.meta.parsed_unit.to_si(value) / present for value in own]
    if not any(math.isclose(share, 1.0) for share in shares):
        return design
    near = (value for value, share in zip(own, shares, strict=True) if 1 / NEAR <= share <= NEAR)
    return replace(design, among=tuple(with_unit(f"{value:g}", design.meta.unit) for value in near))


def is_form(config: Config, design: DesignInput) -> bool:
    """Return whether an input gives a part its form, and is neither demanded nor fixed by what it rests on."""
    instance = config.instances.get(design.asked.instance)
    key = str(design.asked.key[-1])
    if instance is None or design.asked.instance == PRESS or design.is_whole or LIMIT.search(key):
        return False
    id = dotted(design.asked.key)  # as its steps and checks call it
    if (instance.mechanism and id in demanded(instance.mechanism)) or is_fixed(config, design.asked):
        return False
    own = design.meta.parsed_unit.si
    return own in FORM or (own == "1" and RATIO.search(key) is not None)


def is_fixed(config: Config, asked: Input) -> bool:
    """Return whether an input rests on what no designer changes: a standard, a catalogue, a measurement."""
    instance = config.instances.get(asked.instance)
    basis = instance.bases.get(asked.key) if instance else None
    return basis is not None and basis.basis in FIXED_BASES
