"""What is said of interlocks that do not hold: by how much, and which offset, window and productivity would do."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diecut_report.api import told
from diecut_report.plugins.cyclogram.timing import Timing


def verdicts(timing: Timing) -> tuple[str, ...]:
    """Return what is to be said of each interlock where it does not hold."""
    return tuple(" ".join(_verdict(timing, index)) for index in range(len(timing.held)))


def _verdict(timing: Timing, index: int) -> Iterator[str]:
    held, pair = timing.held[index], timing.worst[index]
    phase, other = (timing.name_of(side) for side in (held.inner, held.outer))
    where = "apart from" if held.is_apart else "within"
    if pair.outer is None:
        yield f"{phase} cannot lie {where} {other}, which leaves nothing that could hold it."
    else:
        yield (
            f"{phase} does not lie {where} {other}: the margins are {timing.told(pair.start)} at the start and {timing.told(pair.end)} "
            f"at the end, {timing.told(timing.required(timing.final[index]))} are required."
        )
    yield from _offset(timing, index)
    yield _speed(timing)


def _offset(timing: Timing, index: int) -> Iterator[str]:
    """The best offset, and what would have to be longer where there is none."""
    trial = timing.trial(index)
    if trial is None or trial.best is None or trial.moved is None:
        yield "Both belong to one line, so that no offset changes it."
        return
    line = trial.lines[trial.moved].name
    slack = f"leaves a slack of {timing.told(trial.best.slack)}" if np.isfinite(trial.best.slack) else "does not help"
    yield f"The best offset of {line} is {told(trial.best.shift, 'deg', 7)}, which {slack}{'' if trial.best.feasible else ': no offset holds all'}."
    length = trial.needed[index]
    if np.isfinite(length):
        held = timing.held[index]
        what = f"the gap that {timing.name_of(held.outer)} leaves" if held.is_apart else timing.name_of(held.outer)
        yield f"At the best offset for it alone {what} must be {timing.told(length)} long."


def _speed(timing: Timing) -> str:
    limit = timing.limit
    if limit.value is not None and limit.value < timing.productivity:
        return f"All hold up to press.productivity = {limit.value * 3600:.2f} 1/h."
    return "Slowing the press down by press.productivity does not help: angles decide."
