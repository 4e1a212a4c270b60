"""Margins, offsets and the largest productivity of the lines on the main shaft."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import inf, pi
from typing import Any

import numpy as np

from diecut_report.api import InOtherUnit, Phrase, Refusal, phrase, told
from diecut_report.mechanics.timing.intervals import (
    BestOffset,
    Interval,
    Intervals,
    Moved,
    PairMargin,
    best_offset,
    common_period,
    complement,
    margins_within,
    needed_length,
    tents,
    worst,
)
from diecut_report.mechanics.timing.productivity import (
    Interlock,
    ProductivityLimit,
    fixed_productivity_limit,
    productivity_limit,
    tents_of,
)
from diecut_report.plugins.cyclogram.main_shaft import LineOnShaft, common_turns, lines_of, named_phase

TURN = 2 * pi
NAME = re.compile("[A-Za-z][A-Za-z0-9_]*")


@dataclass(frozen=True, eq=False)
class Held:
    """Hold an interlock as it is given: what it is called, both phases with their lines, and the required margin."""

    name: str
    inner: tuple[int, str, int | None]
    outer: tuple[int, str, int | None]
    is_apart: bool
    angle: float
    time: float


@dataclass(frozen=True, eq=False)
class Timing:
    """Hold a press's lines and interlocks; what follows from them is calculated when it is asked for.

    ``drawn`` are the lines as given, the one with the automatic offset at zero; ``lines`` have their final offsets.
    """

    productivity: float
    drawn: tuple[LineOnShaft, ...]
    held: tuple[Held, ...]

    @property
    def sheet_time(self) -> float:
        """Return the time of a turn of the main shaft, s."""
        return 1 / self.productivity

    @cached_property
    def common(self) -> Fraction:
        """Return the common period in turns of the main shaft."""
        return common_turns(self.drawn)

    @property
    def period(self) -> float:
        """Return it as an angle, rad."""
        return TURN * float(self.common)

    @cached_property
    def moved(self) -> int | None:
        """Return the line with the automatic offset."""
        return next((index for index, each in enumerate(self.drawn) if each.is_auto), None)

    @cached_property
    def span(self) -> float:
        """Return the range of its offsets, rad: the period over all its phases."""
        return self.period if self.moved is None else TURN * float(common_period(self.drawn[self.moved].periods))

    @cached_property
    def best(self) -> BestOffset | None:
        """Return the offset found, None where none is to be found."""
        if self.moved is None:
            return None
        return best_offset(tents_of(self.as_drawn, self.period, self.productivity), self.span)

    @cached_property
    def lines(self) -> tuple[LineOnShaft, ...]:
        """Return the lines with their final offsets."""
        return tuple(each.turned(self.best.shift) if self.best and each.is_auto else each for each in self.drawn)

    @property
    def offsets(self) -> list[float]:
        """Return the offset of each line, rad."""
        return [each.line.offset for each in self.lines]

    def interlocks(self, lines: tuple[LineOnShaft, ...]) -> list[Interlock]:
        """Return the interlocks over the main shaft's common period, with the side that the automatic offset moves."""
        return [self._interlock(each, lines) for each in self.held]

    def _interlock(self, held: Held, lines: tuple[LineOnShaft, ...]) -> Interlock:
        sides: list[Intervals] = [
            lines[index].on_main_shaft(phase, self.common, number) for index, phase, number in (held.inner, held.outer)
        ]
        outer = complement(sides[1], self.period) if held.is_apart else sides[1]
        inside, outside = (self.moved is not None and side[0] == self.moved for side in (held.inner, held.outer))
        moved: Moved | None = None if inside == outside else "inner" if inside else "outer"
        return Interlock(held.name, sides[0], outer, moved, held.angle, held.time)

    @cached_property
    def as_drawn(self) -> list[Interlock]:
        """Return the interlocks with the automatic offset at zero."""
        return self.interlocks(self.drawn)

    @cached_property
    def final(self) -> list[Interlock]:
        """Return the interlocks at the final offsets."""
        return self.interlocks(self.lines)

    @cached_property
    def pairs(self) -> list[tuple[PairMargin, ...]]:
        """Return the margins of each interval of each interlock."""
        return [margins_within(each.inner, each.outer, self.period) for each in self.final]

    @cached_property
    def worst(self) -> list[PairMargin]:
        """Return the worst of them for each interlock."""
        nothing = PairMargin((0.0, 0.0), None, inf, inf)
        return [worst(pairs) or nothing for pairs in self.pairs]

    def row(self, values: Iterator[float]) -> Any:
        """Return numbers of the interlocks as a row; what is not bounded counts as the whole period, of its sign."""
        return np.array([list(np.clip(list(values), -self.period, self.period))])

    def required(self, interlock: Interlock) -> float:
        """Return the required margin, rad."""
        return interlock.required(self.productivity)

    @cached_property
    def needed(self) -> list[float]:
        """Return for each interlock how long its one window must be; NaN where it has several, or the offset is fixed."""
        return [self._needed(each) for each in self.as_drawn]

    def _needed(self, each: Interlock) -> float:
        lengths = {round(end - start, 9) for start, end in each.outer}
        if each.moved is None or len(lengths) != 1:
            return np.nan
        rows = tents(each.inner, each.outer, self.period, each.moved, self.required(each))
        found = needed_length(each.outer[0][1] - each.outer[0][0], rows, self.span)
        return found if np.isfinite(found) else np.nan

    def name_of(self, side: tuple[int, str, int | None]) -> str:
        """Return a phase in words, with its line, and with the number of the interval that alone is meant."""
        index, phase, number = side
        line = self.drawn[index]
        message = Phrase("“{phase}” of {line}", phase=line.words[phase], line=line.name)
        return message if number is None else Phrase("{told}, interval {number}", told=message, number=number)

    def trial(self, index: int) -> Timing | None:
        """Return the timing with an offset to be found that an interlock depends on: the automatic one, else its later line's.

        None where its two phases belong to one line.
        """
        sides = {self.held[index].inner[0], self.held[index].outer[0]}
        if len(sides) == 1:
            return None
        if self.moved in sides:
            return self
        return self._free(max(sides))

    def _free(self, line: int) -> Timing:
        """The timing with the offset of one line to be found, the others as they are."""
        lines = list(self.lines)
        own = replace(lines[line].line, offset=0.0)
        lines[line] = replace(lines[line], line=own, is_auto=True)
        return Timing(
            self.productivity, tuple(replace(each, is_auto=i == line) for i, each in enumerate(lines)), self.held
        )

    @cached_property
    def limit(self) -> ProductivityLimit:
        """Return the largest productivity that the margins of time allow."""
        if self.moved is None:
            return fixed_productivity_limit(self.final, self.period)
        return productivity_limit(self.as_drawn, self.period, self.span)

    @cached_property
    def needed_lengths(self) -> list[float]:
        """Return the same, with an offset to be found where they are all fixed."""
        trials = [self.trial(index) for index in range(len(self.held))]
        return [np.nan if trial is None else trial.needed[index] for index, trial in enumerate(trials)]

    @property
    def feasible(self) -> Interval:
        """Return the feasible offsets about the one found, rad; without any it alone."""
        best = self.best or BestOffset(0.0, 0.0, ())
        return next((each for each in best.feasible if each[0] <= best.shift <= each[1]), (best.shift, best.shift))

    @property
    def rate_errors(self) -> list[float]:
        """Return for each line how far its own rate is off the press's, relative; 0 where its speed is not known."""
        return [self._rate_error(each) for each in self.lines]

    def _rate_error(self, line: LineOnShaft) -> float:
        speed = line.mechanism.speed()
        if speed is None:
            return 0.0
        sheets = speed / line.mechanism.cycle() / float(line.line.turns)
        return abs(sheets / self.productivity - 1)

    def told(self, angle: float, up: bool | None = None) -> str:
        """Return an angle of the main shaft in words, with its time."""
        return f"{told(angle, 'deg', up=up)} ({told(self.time(angle), 'ms', up=up)})"

    def time(self, angle: float) -> float:
        """Return the time in which the main shaft turns by an angle, s."""
        return angle / TURN * self.sheet_time


def timing_of(given: Mapping[str, Any]) -> Timing:
    """Return the press's timing from the inputs; Refusal in words where something is named that there is not."""
    lines = lines_of(given)
    held = tuple(_held(given, index, lines) for index in range(len(given["interlocks.name"])))
    names = [each.name for each in held]
    strange = next((index for index, name in enumerate(names) if not NAME.fullmatch(name)), None)
    if strange is not None:
        message = Phrase(
            "is “{names}”; its check is called after it, so that it must be letters, digits and _, such as sheet_rests",
            names=names[strange],
        )
        raise Refusal(f"interlocks.{strange}.name", message)
    again = next((index for index, name in enumerate(names) if name in names[:index]), None)
    if again is not None:
        raise Refusal(
            f"interlocks.{again}.name",
            Phrase("is {names}, the name of another one; give each its own", names=names[again]),
        )
    return Timing(float(given["productivity"][0, 0]), lines, held)


def _held(given: Mapping[str, Any], index: int, lines: tuple[LineOnShaft, ...]) -> Held:
    key = f"interlocks.{index}"
    within, apart = (given[f"interlocks.{side}"][index] for side in ("within", "apart_from"))
    if bool(within) == bool(apart):
        message = (
            phrase("needs one of within and apart_from")
            if not within
            else phrase("has both within and apart_from; give one of them")
        )
        raise Refusal(key, message)
    margins = given["interlocks.margin"]
    margin = margins[index] if isinstance(margins, tuple) else margins[0, index]
    in_time = isinstance(margin, InOtherUnit)
    return Held(
        given["interlocks.name"][index],
        named_phase(lines, given["interlocks.phase"][index], f"{key}.phase"),
        named_phase(lines, within or apart, f"{key}.{'within' if within else 'apart_from'}"),
        bool(apart),
        0.0 if in_time else float(np.ravel(margin)[0]),
        float(np.ravel(margin.value)[0]) if in_time else 0.0,
    )
