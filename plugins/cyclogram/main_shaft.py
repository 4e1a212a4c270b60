"""The lines on the main shaft: their phases over the common period, from what the configuration names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import Any

import numpy as np

from diecut_report.api import GivenMechanism, GivenPhase, Phrase, Refusal, named
from diecut_report.mechanics.timing.intervals import DrivenLine, Intervals, common_period, composed, exact_turns
from diecut_report.plugins.cyclogram.passing import Stretch

TURN = 2 * pi
AUTO = "auto"


@dataclass(frozen=True)
class OwnPhase:
    """Hold a phase of a line over its own turns (rad, 2π being the period of the mechanism), which repeats after ``every`` of them."""

    intervals: Intervals
    every: int = 1


@dataclass(frozen=True, eq=False)
class LineOnShaft:
    """Hold a line: its mechanism, how it is driven, its phases, and whether its offset is to be found."""

    mechanism: GivenMechanism
    line: DrivenLine
    efficiency: float
    is_auto: bool
    torque_curve: str
    phases: Mapping[str, OwnPhase]
    roles: Mapping[str, str]  # working, rest, moving or window; what the sheet passes is moving
    words: Mapping[str, str]  # what they are called; a stretch that the sheet passes is called as it was typed

    @property
    def name(self) -> str:
        """Return the name of its mechanism."""
        return self.mechanism.name

    @property
    def periods(self) -> tuple[Fraction, ...]:
        """Return the periods of its phases in turns of the main shaft."""
        every = {1, *(phase.every for phase in self.phases.values())}
        return tuple(map(self.line.period_turns, sorted(every)))

    @cached_property
    def told(self) -> dict[str, str]:
        """Return in words the phases of which no interval is told twice: what holds others together stands for them, of equal ones the last."""
        whole = composed({
            name: frozenset((self.roles[name], phase.every, *ends) for ends in phase.intervals)
            for name, phase in self.phases.items()
        })  # fmt: skip
        parts = {part for each in whole.values() for part in each}
        return {name: self._told(whole.get(name, ()), name) for name in self.phases if name not in parts}

    def _told(self, parts: tuple[str, ...], name: str) -> str:
        """What a phase is called; of one that is the same as another, both."""
        if len(parts) != 1:
            return self.words[name]
        return Phrase("{phase} ({other})", phase=self.words[name], other=self.words[parts[0]])

    def on_main_shaft(self, phase: str, common: Fraction, number: int | None) -> Intervals:
        """Return a phase, or one of its intervals alone, over the common period (rad)."""
        own = self.phases[phase]
        chosen = own.intervals if number is None else (own.intervals[number],)
        return self.line.on_main_shaft(chosen, common, own.every)

    def turned(self, by: float) -> LineOnShaft:
        """Return the line with its zero later by a main-shaft angle."""
        return replace(self, line=replace(self.line, offset=self.line.offset + by))


def lines_of(given: Mapping[str, Any]) -> tuple[LineOnShaft, ...]:
    """Return the lines that the configuration names; Refusal in words where they cannot be."""
    found: list[LineOnShaft] = []
    for index, mechanism in enumerate(given["lines.mechanism"]):
        _sound(mechanism, index, found)
        offset = of_part(given["lines.offset"], index)
        turns = turns_of(given["lines.turns_per_sheet"][index], f"lines.{index}.turns_per_sheet")
        phases = mechanism.phases
        ways = _passing(mechanism, given["stretches"][index], f"lines.{index}.passing")
        found.append(
            LineOnShaft(
                mechanism,
                DrivenLine(turns, 0.0 if offset == AUTO else float(offset)),
                float(of_part(given["lines.path_efficiency"], index)),
                offset == AUTO,
                given["lines.torque_curve"][index],
                {**_own_phases(phases), **ways},
                {**{name: phase.role for name, phase in phases.items()}, **dict.fromkeys(ways, "moving")},
                {**{name: phase.description for name, phase in phases.items()}, **{name: name for name in ways}},
            )
        )
    automatic = [str(index) for index, each in enumerate(found) if each.is_auto]
    if len(automatic) > 1:
        template = "is auto, and so is another line's; one offset at most can be found, give the others a number"
        raise Refusal(f"lines.{automatic[1]}.offset", template)
    return tuple(found)


def _sound(mechanism: Any, index: int, before: list[LineOnShaft]) -> None:
    if any(mechanism.name == other.name for other in before):
        raise Refusal(
            f"lines.{index}.mechanism",
            Phrase("is {name}, which is a line already; name each mechanism once", name=mechanism.name),
        )
    if not mechanism.has_period:
        message = Phrase(
            "is {name}, which runs over nothing that comes again, so that it has no phases; leave it out",
            name=mechanism.name,
        )
        raise Refusal(f"lines.{index}.mechanism", message)


def of_part(row: Any, index: int) -> Any:
    """The value of a part of a row, which is a tuple where it holds texts."""
    value = row[index] if isinstance(row, tuple) else row[0, index]
    return np.ravel(value)[0] if isinstance(value, np.ndarray) else value


def turns_of(text: str, key: str) -> Fraction:
    try:
        return exact_turns(text)
    except ValueError:
        message = Phrase(
            "is “{text}”; a number or a ratio above zero such as 1/2 is needed, with a denominator of at most 64",
            text=text,
        )
        raise Refusal(key, message) from None


def _own_phases(phases: Mapping[str, GivenPhase]) -> dict[str, OwnPhase]:
    found = {}
    for name, phase in phases.items():
        share = TURN / phase.period()
        found[name] = OwnPhase(tuple((start * share, end * share) for start, end in phase.intervals()))
    return found


def _passing(mechanism: GivenMechanism, stretches: tuple[Stretch, ...], key: str) -> dict[str, OwnPhase]:
    found: dict[str, OwnPhase] = {}
    for index, each in enumerate(stretch.of_machine(0) for stretch in stretches):
        if each.name in mechanism.phases or each.name in found:
            message = Phrase(
                "is {name}, the name of another phase of {name_2}; give it one of its own",
                name=each.name,
                name_2=mechanism.name,
            )
            raise Refusal(f"{key}.{index}.name", message)
        each.require(mechanism, f"{key}.{index}")
        turned = TURN * (each.first % each.every)
        found[each.name] = OwnPhase(((each.begins + turned, each.ends + turned),), each.every)
    return found


def common_turns(lines: tuple[LineOnShaft, ...]) -> Fraction:
    """Return after how many turns of the main shaft all phases of all lines are where they were."""
    return common_period(period for each in lines for period in each.periods)


def named_phase(lines: tuple[LineOnShaft, ...], text: str, key: str) -> tuple[int, str, int | None]:
    """Return which line, which of its phases, and which interval alone a text names; Refusal in words where it names none."""
    name, _, rest = text.partition(".")
    phase, _, number = rest.partition(".")
    index = next((i for i, each in enumerate(lines) if each.name == name), None)
    if index is None:
        known = named([each.name for each in lines], ", ")
        raise Refusal(
            key,
            Phrase("is “{text}”, but {name} is not a line; the lines are {known}", text=text, name=name, known=known),
        )
    own = lines[index].phases
    if phase not in own:
        raise Refusal(key, Phrase("is “{text}”, but {no_phase}", text=text, no_phase=_no_phase(lines[index], phase)))
    if number and not (number.isdecimal() and int(number) < len(own[phase].intervals)):
        message = Phrase(
            "is “{text}”, but the phase has {len} intervals, counted from 0", text=text, len=len(own[phase].intervals)
        )
        raise Refusal(key, message)
    return index, phase, int(number) if number else None


def _no_phase(line: LineOnShaft, phase: str) -> str:
    missing = line.mechanism.missing_keys(phase)
    if missing:
        return Phrase(
            "{name} has this phase only if {missing} is given there", name=line.name, missing=named(missing, " and ")
        )
    if missing is not None:
        return Phrase("the phase {phase} does not apply to the machine {name}", phase=phase, name=line.name)
    return Phrase(
        "{name} has no phase “{phase}”; it has {phases}",
        name=line.name,
        phase=phase,
        phases=named(list(line.phases), ", "),
    )
