"""What matters, for a chapter of the report: asked for in its configuration, calculated, and put as plain data among the results."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

from diecut_report.config.loader import Config
from diecut_report.config.model import InfluenceSettings
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.design.design_inputs import DesignInput, design_input
from diecut_report.design.influence import (
    Chance,
    Tolerances,
    Tornado,
    by_input,
    require_scatter,
    tornados,
    within_tolerances,
)
from diecut_report.design.questions import quantity
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import UnitError, parse_quantity, unit

SHOWN = 10  # inputs of a tornado
PLACE = ("report", "influence")
Data = dict[str, Any]
Found = TypeVar("Found")


def influenced(config: Config) -> Data | None:
    """Return what the chapter tells, numbers in the units that they are read in; None where the configuration asks for none.

    UserError with the line where something is named there that this machine does not have.
    """
    asked = config.report.influence
    if asked is None:
        return None
    sizes = _sizes(config, asked)
    for index, name in enumerate(asked.of):
        _asked(config, index, name)
    found = _placed(config, ("of",), lambda: tornados(config, asked.of, asked.by, sizes, defaults=asked.defaults))
    drawn = _drawn(config, asked, sizes) if sizes else None
    return {"by": asked.by, "tornados": [_tornado(each) for each in found]} | ({"tolerances": drawn} if drawn else {})


def misnamed(config: Config) -> list[Problem]:
    """Return what is wrong with what a configuration asks the chapter for, without calculating."""
    asked, problems = config.report.influence, list[Problem]()
    if asked is None:
        return problems
    finds: list[Callable[[], object]] = [
        partial(_tolerance, config, name, str(size)) for name, size in (asked.tolerances or {}).items()
    ]
    finds += [partial(_asked, config, index, name) for index, name in enumerate(asked.of)]
    for find in finds:
        try:
            find()
        except UserError as fault:
            problems += fault.problems
    if not problems:
        try:
            _sizes(config, asked)
        except UserError as fault:
            problems += fault.problems
    return problems


def _sizes(config: Config, asked: InfluenceSettings) -> dict[DesignInput, float]:
    """All inputs that scatter, and how far."""
    sizes = [_tolerance(config, name, str(size)) for name, size in (asked.tolerances or {}).items()]
    return _placed(config, ("tolerances",), lambda: by_input(sizes))


def _asked(config: Config, index: int, name: str) -> object:
    return _placed(config, ("of", index), partial(quantity, config, name))


def _drawn(config: Config, asked: InfluenceSettings, sizes: dict[DesignInput, float]) -> Data:
    return _tolerances(within_tolerances(config, sizes, asked.distribution, asked.count, asked.seed))


def _tolerance(config: Config, name: str, typed: str) -> tuple[DesignInput, float]:
    """An input and how far it scatters."""
    own = ("tolerances", name)
    design = _placed(config, own, lambda: design_input(config, name))
    try:
        size = parse_quantity(typed, design.meta.unit)
    except UnitError as fault:
        raise UserError(_problem(config, own, str(fault))) from None
    if not 0 < size < math.inf:
        raise UserError(_problem(config, own, Phrase("{name}: {size} is not above zero", name=name, size=typed)))
    _placed(config, own, lambda: require_scatter(design))
    return design, size


def _placed(config: Config, key: KeyPath, find: Callable[[], Found]) -> Found:
    """What is found; a UserError of it with the place in the file that asked for it."""
    try:
        return find()
    except UserError as fault:
        raise UserError([_problem(config, key, each.message, is_name=True) for each in fault.problems]) from None


def _problem(config: Config, key: KeyPath, words: str, *, is_name: bool = False) -> Problem:
    """What is wrong with a value there, or with the name that is its key."""
    place = (*PLACE, *key)
    line, column = config.tree.key_position(place) if is_name else config.tree.position(place)
    return Problem(words, config.tree.file, line, column, ".".join(map(str, place)))


def _tornado(found: Tornado) -> Data:
    own = found.asked.unit
    bars = [
        {"name": bar.design.name, "unit": bar.design.unit, "lowered": _in(bar.design.unit, bar.lowered),
         "raised": _in(bar.design.unit, bar.raised), "low": _known(own, bar.low), "high": _known(own, bar.high)}
        for bar in found.bars[:SHOWN]
    ]  # fmt: skip
    more = len(found.bars) - len(bars)
    return {"name": found.asked.name, "unit": found.asked.unit, "today": _in(own, found.today), "bars": bars, "more": more,
            "still": found.still, "at_default": found.at_default}  # fmt: skip


def _tolerances(found: Tolerances) -> Data:
    inputs = [
        {
            "name": each.name,
            "unit": each.unit,
            "value": _in(each.unit, each.today or 0.0),
            "tolerance": _size(each, size),
        }
        for each, size in found.by_input.items()
    ]
    return {"distribution": found.distribution, "seed": found.seed, "count": found.count, "inputs": inputs, "whole": _chance(found.whole),
            "checks": [_chance(each) for each in found.chances]}  # fmt: skip


def _chance(found: Chance) -> Data:
    return {
        "check": found.check,
        "held": found.held,
        "count": found.count,
        "probability": found.probability,
        "low": found.low,
        "high": found.high,
    }


def _known(name: str, value: float) -> float | None:
    return None if math.isnan(value) else _in(name, value)


def _in(name: str, value: float) -> float:
    return float(unit(name).from_si(value))


def _size(design: DesignInput, size: float) -> float:
    """A tolerance in the unit of its input: of a difference, so that a unit with a zero of its own takes nothing away."""
    return _in(design.unit, size) - _in(design.unit, 0.0)
