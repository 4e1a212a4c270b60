"""The inputs of a configuration that a designer may change: found by their names, with their values today and their bounds."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.targets import Target
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.inputs import POINTS, SI, Quantity
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import number_text, outward, with_unit
from diecut_report.quantities.units import UnitError, number_and_unit, unit
from diecut_report.study.definition.base_inputs import MECHANISMS, Input, UnknownPath, find_input, with_values

MANY_STEPS = 20  # references that are followed to where a value stands; a loop is refused where a file is read


@dataclass(frozen=True, eq=False)
class DesignInput:
    """Hold an input that may be changed. ``today`` is its value (SI), None where it has none; ``unit`` the one it is typed in.

    ``stands`` is its place in the file, whether it is there or not.
    """

    asked: Input
    today: float | None
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
        if found.today is not None:
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
        words = "{name} says how densely curves are listed; the machine is the same with any number of points."
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
    return DesignInput(asked, _today(config, asked), _typed_unit(typed, asked.meta), typed is not None, stands)


def _today(config: Config, asked: Input) -> float | None:
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
