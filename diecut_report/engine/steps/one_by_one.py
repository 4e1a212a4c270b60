"""Plain code that knows one machine, run for each of many: what it refuses is marked, what others refused is not asked of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from diecut_report.contract.machines import Machines, of_machine
from diecut_report.contract.refusal import Refusal
from diecut_report.contract.steps import Computed, Prepared
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.mechanism_handle import MechanismHandle
from diecut_report.engine.steps.feasibility import refuse
from diecut_report.engine.steps.soundness import possible
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase


def prepared(calc: Calculation, step: Prepared, known: Mapping[str, Any]) -> Machines:
    """Make an object of each machine, of a mapping of its values."""
    _without_broken(calc, known)

    def make(row: int) -> Any:
        return step.function({name: of_machine(value, row, calc.count) for name, value in known.items()})

    return Machines(_each(calc, make))


def computed(calc: Calculation, step: Computed, taken: Sequence[Any]) -> Array:
    """Return what a function gives for each machine, as rows; NaN for one that cannot be."""

    def make(row: int) -> Any:
        return np.ravel(step.function(*(of_machine(value, row, calc.count) for value in taken)))

    rows = _each(calc, make)
    width = max((len(row) for row in rows if row is not None), default=1)
    return np.stack([np.full(width, np.nan) if row is None else row for row in rows])


def _each(calc: Calculation, make: Callable[[int], Any]) -> list[Any]:
    """What is made of each machine, None of one that cannot be."""
    found: list[Any] = [None] * calc.count
    for row in np.flatnonzero(possible(calc)):
        try:
            found[row] = make(int(row))
        except Refusal as refused:
            refuse(calc, int(row), refused.key, refused.words)
    return found


def _without_broken(calc: Calculation, known: Mapping[str, Any]) -> None:
    """Mark the machines of which another mechanism cannot be."""
    for key, value in known.items():
        for each in value if isinstance(value, tuple) else (value,):
            if isinstance(each, MechanismHandle):
                for row in each.calculation.flaws:
                    refuse(calc, row, key, Phrase("is {name}, which cannot be", name=each.name))
