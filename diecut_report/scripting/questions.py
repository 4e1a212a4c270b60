"""Questions to a press: the commands ``solve``, ``advise`` and ``influence``, with presses and quantities for answers."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from diecut_report.config.loader import Config
from diecut_report.design import advice, influence
from diecut_report.design.answers import Answer, FoundValue, data, lines
from diecut_report.design.inputs import solved_input
from diecut_report.design.solving import solved
from diecut_report.errors import ConfigError, Problem
from diecut_report.press import Press
from diecut_report.quantities.units import number_and_unit
from diecut_report.scripting.values import QuantityValue
from diecut_report.text.phrases import Phrase

Data = dict[str, Any]
PressT = TypeVar("PressT")
Make = Callable[[Press], PressT]


@dataclass(frozen=True, eq=False, repr=False)
class _Answered:
    data: Data
    text: str

    def __str__(self) -> str:
        return self.text

    __repr__ = __str__


@dataclass(frozen=True, eq=False, repr=False)
class Solution(_Answered, Generic[PressT]):
    """Hold the values of an input that answer (``values``, the nearest to today's first); ``press`` is the press with the first, calculated once.

    Of an input that is a text they are texts. Without one ``values`` is empty, ``nearest`` is the value that comes nearest, and ``press`` is
    None. ``data`` is what the command gives as JSON; ``str`` what it says.
    """

    found: bool
    values: tuple[QuantityValue | str, ...]
    nearest: QuantityValue | str | None
    press: PressT | None


@dataclass(frozen=True, eq=False, repr=False)
class MendedPress(_Answered, Generic[PressT]):
    """Hold the least changes with which no check fails: for each path what is to be typed; ``press`` is the press with them.

    ``press`` is None where none was found, or where no check fails today. ``data`` is what the command gives as JSON; ``str`` what it says.
    """

    changes: dict[str, str]
    press: PressT | None


@dataclass(frozen=True, eq=False, repr=False)
class InfluenceTable(_Answered):
    """Hold how far each input moves numbers, the greatest first. ``data`` is what the command gives as JSON; ``str`` what it says."""

    def bars(self) -> list[Data]:
        """Return for each number its inputs, one below the other: ``of``, ``path``, ``low`` and ``high`` (SI), as rows of a table."""
        return [
            {"of": each["name"], "path": bar["path"], "low": bar["low"], "high": bar["high"], "today": each["today"], "unit": each["unit"]}
            for each in self.data["tornados"]
            for bar in each["bars"]
        ]  # fmt: skip


def solved_press(
    asked: Press, make: Make[PressT], vary: str, target: str, ends: tuple[str | None, str | None], among: Sequence[str], *, passing: bool
) -> Solution[PressT]:  # fmt: skip
    """Return the answer to a question, as the command gives it; ``make`` makes the press of a script."""
    design = solved_input(asked.config, vary, among)

    def end(given: str | None, name: str) -> float | None:
        try:
            return None if given is None else design.read(given)
        except ValueError as fault:
            raise ConfigError(Problem(fault.args[0], path=f"{name} of {design.name}")) from None

    low, high = end(ends[0], "low"), end(ends[1], "high")
    answer = solved(asked, target, design, passing=passing, low=low, high=high)
    values = tuple(_value(answer, each) for each in answer.found)
    near = None if answer.nearest is None else _value(answer, answer.nearest)
    press = None if answer.machine is None else make(answer.machine.press)
    return Solution(data(answer), "\n".join(lines(answer)), bool(values), values, near, press)


def _value(answer: Answer, found: FoundValue) -> QuantityValue | str:
    if answer.design.is_text:
        return found.typed
    meta, (number, own) = answer.design.meta, number_and_unit(found.typed)
    printed = str(number), own or "1"
    return QuantityValue(
        found.value, meta.parsed_unit.si, answer.design.name, meta.symbol, meta.description, "", printed
    )


def mended_press(asked: Press, make: Make[PressT], free: Iterable[str], keep: Iterable[str]) -> MendedPress[PressT]:
    """Return the smallest changes with which no check fails, as the command gives them."""
    found = advice.mended(asked, free=free, keep=keep)
    press = None if found.machine is None else make(found.machine.press)
    changes = {each.design.name: each.after for each in found.changes} if found.machine is not None else {}
    return MendedPress(advice.data(found), "\n".join(advice.lines(found)), changes, press)


def influence_of(config: Config, names: Sequence[str], share: float, *, defaults: bool = False) -> InfluenceTable:
    """Return what inputs do to numbers, as the command gives it; ConfigError where the share is not between 0 and 1."""
    if not (math.isfinite(share) and 0 < share <= 1):
        template = "{share} is not a share between 0 and 1, such as 0.1 for a tenth."
        raise ConfigError(Problem(Phrase(template, share=repr(share)), path="share"))
    found = influence.tornados(config, list(names), share, {}, defaults=defaults)
    text = "\n".join(influence.lines(found, None, "defaults=True"))
    return InfluenceTable(influence.data(found), text)
