"""What is said of interlocks that do not hold: by how much, and which offset, window and productivity would do."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diecut_report.api import Phrase, joined, phrase, told
from diecut_report.plugins.cyclogram.timing import Timing


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
        yield (
            Phrase(
                "{phase} does not lie {where} {other}: the margins are {told} at the start and {told_2} at the "
                "end, {told_3} are required.",
                phase=phase,
                where=where,
                other=other,
                told=timing.told(pair.start),
                told_2=timing.told(pair.end),
                told_3=timing.told(timing.required(timing.final[index])),
            )
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
