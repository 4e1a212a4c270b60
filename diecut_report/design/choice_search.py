"""Inputs that take one of some values (texts, yes/no, whole numbers, numbers of a list), tried where a change of sizes alone mends nothing.

One after the other is given each of its values, with the sizes as they were reached and as they are today; the best is kept, and from
it the sizes are changed again. Several rounds change several of them.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.changeable import is_form, is_stepped
from diecut_report.design.changed_machines import ChangedMachines
from diecut_report.design.design_choices import options_of
from diecut_report.design.design_inputs import DesignInput, any_input, design_input, given_numbers
from diecut_report.design.mending import MendingPath
from diecut_report.languages.phrases import Phrase
from diecut_report.study.definition.base_inputs import Input

ROUNDS, BEGINNINGS = 3, 3  # choices that are changed at most; machines of a round from which sizes are changed again
WHOLE_REACH = 10  # to each side of a whole number
BETTER = 1e-9


@dataclass(frozen=True)
class ChangeableChoice:
    """Hold an input that takes one of ``values``, as they are typed, the nearest to today's first; ``cost`` of each, 0 for a text."""

    asked: Input
    values: tuple[str, ...]
    costs: tuple[float, ...]


def changeable_choices(config: Config, free: Iterable[str], keep: Container[str]) -> list[ChangeableChoice]:
    """Return what is named by ``free`` and takes one of some values, else the sizes that are numbers of a list; not those paths."""
    named = [_named(config, name) for name in free]
    if not named:
        own = (each for each in given_numbers(config) if each.meta.listed and is_form(config, each))
        named = [_of_number(each) for each in own]
    return [each for each in named if each is not None and each.values and each.asked.path not in keep]


def with_choices(path: MendingPath, choices: Sequence[ChangeableChoice], tell: Callable[[str], None]) -> MendingPath:
    """Return the best path that was found by changing choices; the same where none is better."""
    for _ in range(ROUNDS):
        found = sorted(_changed(path, choices, tell), key=lambda each: each[0])
        best = path
        for _, other in found[:BEGINNINGS]:
            if not other.passes and len(other.inputs):
                other.go(tell)
            best = other if other.passes or other.merit < best.merit - BETTER else best
            if best.passes:
                return best
        if best is path:
            break
        path = best
    return path


def _changed(
    path: MendingPath, choices: Iterable[ChangeableChoice], tell: Callable[[str], None]
) -> Iterator[tuple[float, MendingPath]]:
    """Each value of each choice, with the sizes that were reached and with today's, and how bad each of them is."""
    machines = path.run
    assert isinstance(machines, ChangedMachines)
    places = {tuple(share): share for share in (path.share, np.zeros(len(path.share)))}.values()
    for choice in choices:
        tell(Phrase("trying the values of {input}", input=choice.asked.path))
        for value, cost in zip(choice.values, choice.costs, strict=True):
            run = machines.with_choice(choice.asked, value)
            for share in places:
                other = MendingPath(run, path.inputs, share)
                yield other.merit + cost, other


def _named(config: Config, name: str) -> ChangeableChoice | None:
    asked = any_input(config, name)
    if asked.unit is None:
        values = _texts(config, asked)
        return ChangeableChoice(asked, values, (0.0,) * len(values))
    return _of_number(design_input(config, name))


def _texts(config: Config, asked: Input) -> tuple[str, ...]:
    """The other texts that it may be."""
    instance = config.instances[asked.instance]
    assert instance is not None
    today = config.tree.typed(instance.place.stands(asked.key)[1])
    return tuple(text for text in options_of(asked) if text != today)


def _of_number(design: DesignInput) -> ChangeableChoice | None:
    if not is_stepped(design) or not design.today:
        return None
    values = [each for each in _steps(design) if each != design.today]
    values.sort(key=lambda each: abs(each - (design.today or 0.0)))
    costs = tuple(abs(each / design.today - 1.0) for each in values)
    return ChangeableChoice(design.asked, tuple(map(design.typed, values)), costs)


def _steps(design: DesignInput) -> Iterator[float]:
    if design.meta.listed:
        factor = design.meta.parsed_unit.factor
        yield from (value * factor for value in design.meta.listed)
        return
    today = round(design.today or 0.0)
    tried = np.arange(today - WHOLE_REACH, today + WHOLE_REACH + 1, dtype=float)
    yield from tried[design.allows(tried)].tolist()
