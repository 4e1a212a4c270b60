"""What the cyclogram tells: tables of phases, margins and offsets, and what is said of interlocks that do not hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isfinite, pi
from typing import Any

import numpy as np

from diecut_report.api import Cell, ListedColumn, Phrase, joined, phrase, told
from diecut_report.plugins.cyclogram.kinds import ENERGIES, POSITION
from diecut_report.plugins.cyclogram.timing import Timing
from diecut_report.plugins.cyclogram.torques import energy_parts, torque_name


def verdicts(timing: Timing) -> tuple[str, ...]:
    """Return what is to be said of each interlock where it does not hold."""
    return tuple(joined(_verdict(timing, index), " ") for index in range(len(timing.held)))


def _verdict(timing: Timing, index: int) -> Iterator[str]:
    held, pair = timing.held[index], timing.worst[index]
    phase, other = (timing.name_of(side) for side in (held.inner, held.outer))
    where = phrase("apart from") if held.is_apart else phrase("within")
    if pair.outer is None:
        yield Phrase(
            "{phase} cannot lie {where} {other}, which leaves nothing that could hold it.",
            phase=phase,
            where=where,
            other=other,
        )
    else:
        yield Phrase(
            "{phase} does not lie {where} {other}: the margins are {told} at the start and {told_2} at the "
            "end, {told_3} are required.",
            phase=phase,
            where=where,
            other=other,
            told=timing.told(pair.start),
            told_2=timing.told(pair.end),
            told_3=timing.told(timing.required(timing.final[index])),
        )
    yield from _offset(timing, index)
    yield _speed(timing)


def _offset(timing: Timing, index: int) -> Iterator[str]:
    """The best offset, and what would have to be longer where there is none."""
    trial = timing.trial(index)
    if trial is None or trial.best is None or trial.moved is None:
        yield phrase("Both belong to one line, so that no offset changes it.")
        return
    line = trial.lines[trial.moved].name
    slack = (
        Phrase("leaves a slack of {told}", told=timing.told(trial.best.slack))
        if np.isfinite(trial.best.slack)
        else phrase("does not help")
    )
    yield Phrase(
        "The best offset of {line} is {shift}, which {slack}{text}.",
        line=line,
        shift=told(trial.best.shift, "deg", 6),
        slack=slack,
        text="" if trial.best.feasible else phrase(": no offset holds all"),
    )
    length = trial.needed[index]
    if np.isfinite(length):
        held = timing.held[index]
        what = (
            Phrase("the gap that {name_of} leaves", name_of=timing.name_of(held.outer))
            if held.is_apart
            else timing.name_of(held.outer)
        )
        yield Phrase(
            "At the best offset for it alone {what} must be {told} long.", what=what, told=timing.told(length, up=True)
        )


def _speed(timing: Timing) -> str:
    limit = timing.limit
    if limit.value is not None and limit.value < timing.productivity:
        return Phrase("All hold up to press.productivity = {value} 1/h.", value=f"{limit.value * 3600:.2f}")
    return phrase("Slowing the press down by press.productivity does not help: angles decide.")


Rows = Iterator[tuple[Cell, ...]]
TURN = 2 * pi

PHASES = (
    ListedColumn("phase", "Key of the phase", printed=False), ListedColumn("what", "Phase"), ListedColumn("role", "Role"),
    ListedColumn("start", "from", "Φ_1", "deg"), ListedColumn("end", "to", "Φ_2", "deg"),
    ListedColumn("start_time", "from", "t_1", "ms"), ListedColumn("end_time", "to", "t_2", "ms"), ListedColumn("time", "Time", "Δt", "ms"),
)  # fmt: skip
MARGINS = (
    ListedColumn("interlock", "Interlock"), ListedColumn("start", "from", "Φ_1", "deg"), ListedColumn("end", "to", "Φ_2", "deg"),
    ListedColumn("margin_start", "Margin at the start", "m_1", "deg"), ListedColumn("margin_end", "Margin at the end", "m_2", "deg"),
    ListedColumn("margin_start_time", "Margin at the start", "t_1", "ms"), ListedColumn("margin_end_time", "Margin at the end", "t_2", "ms"),
)  # fmt: skip
OFFSETS = (
    ListedColumn("line", "Line"),
    ListedColumn("start", "from", "Φ_a", "deg"),
    ListedColumn("end", "to", "Φ_b", "deg"),
)
LACKING = (ListedColumn("what", "Missing"), ListedColumn("because", "Reason"))
ROLES = {
    "working": phrase("working"),
    "rest": phrase("at rest"),
    "moving": phrase("moving"),
    "window": phrase("clearance for another part"),
}


def phases(given: Mapping[str, Any]) -> Rows:
    """Return each interval of each phase over the common period, as angle and as time."""
    timing: Timing = given["timing"]
    for line in timing.lines:
        for name, words in line.told.items():
            what = Phrase("{line}: {phase}", line=line.name, phase=words)
            for start, end in line.on_main_shaft(name, timing.common, None):
                times = (timing.time(start), timing.time(end), timing.time(end - start))
                yield (f"{line.name}.{name}", what, ROLES.get(line.roles[name], line.roles[name]), start, end, *times)


def margins(given: Mapping[str, Any]) -> Rows:
    """Return the margins of each interval that is held; none where it is not bounded, or nothing could hold it."""
    timing: Timing = given["timing"]
    for held, pairs in zip(timing.held, timing.pairs, strict=True):
        for pair in pairs:
            bounds = [each if isfinite(each) else None for each in (pair.start, pair.end)]
            yield (held.name, *pair.inner, *bounds, *(None if each is None else timing.time(each) for each in bounds))


def offsets(given: Mapping[str, Any]) -> Rows:
    """Return all intervals of the offset that is to be found in which all interlocks hold."""
    timing: Timing = given["timing"]
    if timing.best is not None and timing.moved is not None:
        yield from ((timing.lines[timing.moved].name, *interval) for interval in timing.best.feasible)


def lacking(given: Mapping[str, Any]) -> Rows:
    """Return what is not checked, or not in the sum, because something is not given."""
    timing: Timing = given["timing"]
    has_cylinder = any(line.mechanism.kind == "cylinder_drive" for line in timing.lines)
    for line in timing.lines:
        transports = line.mechanism.curve(POSITION) is not None
        if transports and not set(line.phases) - set(line.mechanism.phases):
            yield (
                Phrase("carriages of {name} against the window", name=line.name),
                Phrase("passing of {name} is not given", name=line.name),
            )
        if transports and has_cylinder and "station.transport" not in given:
            yield (
                Phrase("height over the carriages of {name}, carriage_height", name=line.name),
                phrase("station is not given"),
            )
        if line.mechanism.curve(torque_name(line.mechanism, line.torque_curve)) is None:
            yield (
                Phrase("torque of {name}", name=line.name),
                Phrase("{name} has none; the sum is too small by this amount", name=line.name),
            )
        if line.mechanism.kind in ENERGIES and energy_parts(line.mechanism) is None:
            numbers = [key for key in ENERGIES[line.mechanism.kind].numbers if line.mechanism.number(key) is None]
            yield (
                Phrase("kinetic energy of {name}", name=line.name),
                Phrase(
                    "{numbers} of {name} is not given; it contributes nothing",
                    numbers=joined(numbers, " and "),
                    name=line.name,
                ),
            )
    for held in timing.held:
        if held.angle == held.time == 0:
            yield Phrase("margin of {name}", name=held.name), phrase("margin is not given; 0 is taken")
