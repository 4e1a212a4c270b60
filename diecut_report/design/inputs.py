"""The inputs of a configuration that a designer may change: found by their names, with their values today and their bounds."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Container, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal, get_args, get_origin

import numpy as np

from diecut_report.config.instances import Target, slots
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.yaml import KeyPath
from diecut_report.errors import Problem, UserError
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.inputs import POINTS, Quantity
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import SI, Text
from diecut_report.mechanism.steps import Require
from diecut_report.quantities.formatting import number_text, outward, with_unit
from diecut_report.quantities.units import UnitError, number_and_unit, unit
from diecut_report.study.definition.base_inputs import MECHANISMS, Input, UnknownPath, find_input, with_values
from diecut_report.text.phrases import Phrase, phrase

MANY_STEPS = 20  # references that are followed to where a value stands; a loop is refused where a file is read


@dataclass(frozen=True, eq=False)
class DesignInput:
    """Hold an input that may be changed. ``present`` is its value (SI), None where it has none; ``unit`` the one it is typed in.

    ``stands`` is its place in the file, whether it is there or not.
    """

    asked: Input
    present: float | None
    unit: str
    is_given: bool
    stands: KeyPath

    @property
    def name(self) -> str:
        """Return what people call it: ``drive.crank_length``, ``press.productivity``."""
        return self.asked.path.removeprefix(f"{MECHANISMS}.")

    @property
    def meta(self) -> Quantity:
        assert isinstance(self.asked.meta, Quantity)
        return self.asked.meta

    @property
    def is_whole(self) -> bool:
        return self.asked.is_integer

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

    def read(self, typed: str) -> float:
        """Return the value (SI) of what was typed; ValueError in words where it is not allowed."""
        return float(self.meta.validate(typed))


def design_input(config: Config, name: str) -> DesignInput:
    """Return the input that a name stands for, also where it refers to it; UserError in words where it cannot be changed."""
    return _followed(config, any_input(config, name), name)


def any_input(config: Config, name: str) -> Input:
    """Return the input of a name, be it a number, a text or a yes/no; UserError in words where there is none."""
    try:
        return find_input(config, _whole_path(config, name))
    except UnknownPath as fault:
        raise UserError(Problem(Phrase("{name} {fault}", name=name, fault=fault), config.tree.file)) from None


def with_input(config: Config, design: DesignInput, value: float) -> Config:
    """Return the configuration with a value of an input, which may bring quantities with it that it has not without."""
    return with_values(config, {design.asked: SI(value, design.meta.parsed_unit.si, design.name)})[0]


def given_numbers(config: Config) -> list[DesignInput]:
    """Return all inputs that stand in the file as a number of their own, in its order."""
    found = (each for name in config.instances for each in _of_instance(config, name, given=True))
    return [each for each in found if each.is_given and _stands_there(config, each)]


def numbers_at_default(config: Config) -> list[DesignInput]:
    """Return all inputs that are not given and stand at a number that their declaration has as default."""
    return [each for name in config.instances for each in _of_instance(config, name, given=False)]


def _whole_path(config: Config, name: str) -> str:
    first = name.split(".")[0]
    return f"{MECHANISMS}.{name}" if first in config.instances and first != PRESS else name


def _of_instance(config: Config, name: str, *, given: bool) -> Iterator[DesignInput]:
    instance = config.instances[name]
    for slot in instance.slots if instance else ():
        is_number = isinstance(slot.meta, Quantity) and slot.is_given is given and slot.meta is not POINTS
        if not is_number or (name, *slot.key) in config.links:
            continue
        prefix = "" if name == PRESS else f"{MECHANISMS}."
        try:
            found = _made(config, find_input(config, f"{prefix}{'.'.join(map(str, (name, *slot.key)))}"))
        except UnknownPath:  # it stands for several, as in a list
            continue
        if found.present is not None:
            yield found


def _stands_there(config: Config, found: DesignInput) -> bool:
    """Whether it is typed in the configuration itself, and not in a table beside it or taken from a partner."""
    instance = config.instances[found.asked.instance]
    assert instance is not None
    return instance.place.stands(found.asked.key)[0] is config.tree and config.tree.typed(found.stands) is not None


def _followed(config: Config, asked: Input, name: str) -> DesignInput:
    """The input itself or, where it refers to another one, that; UserError where it refers to what is calculated."""
    for _ in range(MANY_STEPS):
        target = config.links.get((asked.instance, *asked.key))
        if target is None or target.is_default:
            break
        if target.expression or target.result is not None or target.is_broken:
            raise UserError(Problem(_calculated(target, asked, name), config.tree.file))
        asked = find_input(config, _path(target))
    if not isinstance(asked.meta, Quantity):
        words = "{name} is a text, a choice or a yes/no; name an input that is a number."
        raise UserError(Problem(Phrase(words, name=name), config.tree.file))
    if asked.meta is POINTS:
        words = "{name} only sets how densely curves are listed; it does not affect the machine."
        raise UserError(Problem(Phrase(words, name=name), config.tree.file))
    return _made(config, asked)


def _calculated(target: Target, asked: Input, name: str) -> Phrase:
    words = (
        "{name} follows from {what}, {told}, and is not changed by itself; "
        "change an input that {origins} follows from, or write a number at {path} first."
    )
    what = phrase("an expression") if target.expression else phrase("an output")
    origins = ", ".join(sorted({single.path for single in target.single}))
    return Phrase(words, name=name, what=what, told=target.told, origins=origins, path=asked.path)


def _path(target: Target) -> str:
    prefix = "" if target.instance == PRESS else f"{MECHANISMS}."
    return prefix + ".".join(map(str, (target.instance, *target.key)))


def _made(config: Config, asked: Input) -> DesignInput:
    instance = config.instances[asked.instance]
    assert instance is not None and isinstance(asked.meta, Quantity)
    _, stands = instance.place.stands(asked.key)
    typed = config.tree.typed(stands)
    return DesignInput(asked, _present(config, asked), _typed_unit(typed, asked.meta), typed is not None, stands)


def _present(config: Config, asked: Input) -> float | None:
    """The value that the file gives, or the default."""
    link = config.links.get((asked.instance, *asked.key))
    if link is not None and (link.expression or link.result is not None or link.node in config.links):
        return None
    instance = config.instances[asked.instance if link is None else link.instance]
    assert instance is not None
    value = instance.value(asked.key if link is None else link.key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(link.formula(value)) if link and link.formula else float(value)


def _typed_unit(typed: str | None, meta: Quantity) -> str:
    try:
        own = number_and_unit(typed)[1] if typed else ""
        return own if own and unit(own).kind == meta.parsed_unit.kind else meta.unit
    except UnitError:
        return meta.unit


# The inputs of a configuration that take one of some values: texts, yes and no, and numbers of a list.


YES_NO = ("true", "false")


@dataclass(frozen=True, eq=False)
class DesignChoice:
    """Hold an input that takes one of ``options``, each as it is typed; ``typed`` is what stands in the file."""

    asked: Input
    options: tuple[str, ...]
    typed: str
    stands: KeyPath

    @property
    def name(self) -> str:
        """Return what people call it: ``feeder.motion_law``."""
        return self.asked.path.removeprefix(f"{MECHANISMS}.")


def given_choices(config: Config) -> list[DesignChoice]:
    """Return all texts and yes/no of the file that have a few allowed values, in its order."""
    return [found for name in config.instances for found in _design_choices_of_instance(config, name)]


def options_of(asked: Input) -> tuple[str, ...]:
    """Return the values that an input may have, as they are typed; none where it may have any of a range, or any text."""
    if isinstance(asked.meta, Quantity):
        return tuple(_listed(asked.meta))
    return _texts(asked.meta, asked.annotation)


def _texts(meta: Any, annotation: Any) -> tuple[str, ...]:
    return tuple(meta.options) or tuple(_options(annotation))


def _listed(meta: Quantity) -> Iterator[str]:
    own = "" if meta.unit == "1" else f" {meta.unit}"
    yield from (f"{value:.12g}{own}" for value in meta.listed)


def _options(annotation: Any) -> Iterator[str]:
    if annotation is bool:
        yield from YES_NO
    elif get_origin(annotation) is Literal:
        yield from (text for text in get_args(annotation) if isinstance(text, str))
    else:
        for part in get_args(annotation):
            yield from _options(part)


def _design_choices_of_instance(config: Config, name: str) -> Iterator[DesignChoice]:
    instance = config.instances[name]
    for slot in slots(instance.model, instance.data) if instance else ():
        if not isinstance(slot.meta, Text) or not slot.is_given or (name, *slot.key) in config.links:
            continue
        prefix = "" if name == PRESS else f"{MECHANISMS}."
        try:
            asked = find_input(config, f"{prefix}{'.'.join(map(str, (name, *slot.key)))}")
        except UnknownPath:
            continue
        assert instance is not None
        home, stands = instance.place.stands(asked.key)
        typed, options = config.tree.typed(stands), options_of(asked)
        if home is config.tree and typed is not None and options:
            yield DesignChoice(asked, options, typed, stands)


# What may be named by ``--free`` beside what is free by itself: for messages that say what to do.


NAMED = 12  # inputs that a message names


def nothing_free(config: Config, left_out: Collection[str]) -> Phrase:
    """Return what is to be done where no input is free: the inputs that could be named, but for those paths."""
    numbers = [each.name for each in given_numbers(config) if each.present and each.asked.path not in left_out]
    found = [*(each.name for each in given_choices(config) if each.asked.path not in left_out), *numbers]
    if not found:
        return Phrase("nothing is free to be changed: keep fewer inputs by --keep.")
    words = "nothing is free to be changed: name inputs by --free, such as --free {first}, or keep fewer by --keep; the file has {names}"
    return Phrase(words, first=found[0], names=_may_be_freed_listed(found))


def untried(config: Config, instances: Collection[str], known: Collection[str]) -> tuple[str, ...]:
    """Return the texts, yes/no and numbers of parts of mechanisms that are tried only where they are named."""
    choices = [(each.asked, each.name) for each in given_choices(config) if len(each.options) > 1]
    whole = [(each.asked, each.name) for each in given_numbers(config) if each.is_whole and each.present]
    own = [name for asked, name in (*choices, *whole) if asked.instance in instances and asked.path not in known]
    return tuple(dict.fromkeys(own))


def _may_be_freed_listed(names: Collection[str]) -> str:
    shown = ", ".join(list(names)[:NAMED])
    return f"{shown} …" if len(names) > NAMED else f"{shown}."


# Which inputs are what a machine must do: those that a check holds against what is calculated, and from which nothing else follows.


@cache
def demanded(mechanism: Mechanism) -> frozenset[str]:
    """Return the inputs that are themselves a side of a check, whichever, and that no other check follows from.

    A size of a part that is held against a bound, such as a width, is not one: other checks follow from it.
    """
    own = {side for check in mechanism.checks for side in _sides(check)}
    given = own - {step.id for _, step in mechanism.steps}
    return frozenset(name for name in given if _is_demanded(mechanism, name))


def _is_demanded(mechanism: Mechanism, name: str) -> bool:
    reached = _reached(mechanism, name)
    return all(name in _sides(check) for check in mechanism.checks if reached & _sides(check))


def _sides(check: Check) -> set[str]:
    return {side for side in (check.demand, check.limit, check.at_least) if isinstance(side, str)}


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
    config: Config, free: Iterable[str], keep: Container[str], advised: Iterable[str] = ()
) -> list[DesignInput]:
    """Return the inputs that may be changed: numbers named by ``free``, else sizes, angles and ratios, and what is advised, but for those paths.

    What the press is for, what checks demand, limits, loads, materials and numbers of parts stay as they are unless they are named.
    UserError where one of those that are named has no value.
    """
    if free:
        named = [design_input(config, name) for name in free]
        _require_values(config, named)
        named = [each for each in named if not is_stepped(each)]
    else:
        own = [each for each in given_numbers(config) if is_form(config, each) and not is_stepped(each)]
        named = own + [design_input(config, name) for name in advised]
    found = {each.asked.path: each for each in named if each.asked.path not in keep and each.present}
    return list(found.values())


def named_paths(config: Config, names: Iterable[str]) -> tuple[list[str], set[str]]:
    """Return of names of inputs those that stand for a number, and the paths of all, also of texts and yes/no."""
    numbers, paths = [], set()
    for name in names:
        asked = any_input(config, name)
        if isinstance(asked.meta, Quantity):
            numbers.append(name)
            paths.add(design_input(config, name).asked.path)
        else:
            paths.add(asked.path)
    return numbers, paths


def _require_values(config: Config, named: Iterable[DesignInput]) -> None:
    for each in named:
        if not each.present:
            words = "{input} has no value at present, or is zero, and cannot be varied by a percentage; give it a value first."
            raise UserError(Problem(Phrase(words, input=each.name), config.tree.file, path="--free"))


def is_stepped(design: DesignInput) -> bool:
    """Return whether a number takes some values alone, and so none between them."""
    return design.is_whole or bool(design.meta.listed)


def is_form(config: Config, design: DesignInput) -> bool:
    """Return whether an input gives a part its form, and is neither demanded nor fixed by what it rests on."""
    instance = config.instances[design.asked.instance]
    key = str(design.asked.key[-1])
    if instance is None or design.asked.instance == PRESS or design.is_whole or LIMIT.search(key):
        return False
    if instance.mechanism and _id(design) in demanded(instance.mechanism):
        return False
    if is_fixed(config, design.asked):
        return False
    own = design.meta.parsed_unit.si
    return own in FORM or (own == "1" and RATIO.search(key) is not None)


def is_fixed(config: Config, asked: Input) -> bool:
    """Return whether an input rests on what no designer changes: a standard, a catalogue, a measurement."""
    instance = config.instances[asked.instance]
    basis = instance.bases.get(asked.key) if instance else None
    return basis is not None and basis.basis in FIXED_BASES


def _id(design: DesignInput) -> str:
    """What the steps and checks of its mechanism call it: without the number of a part."""
    return ".".join(part for part in design.asked.key if isinstance(part, str))
