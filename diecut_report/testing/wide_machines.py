"""Machines so unlike each other that they take other values of the series: a pick is tried where it changes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from diecut_report.contract.inputs import Quantity, fields
from diecut_report.contract.part_steps import Pick
from diecut_report.engine import Calculation
from diecut_report.testing.many_machines import MachineCase, Ranges

WIDTHS = (1.2, 2.0, 5.0)  # by what numbers are multiplied and divided, until each pick changes


def picks(machine: MachineCase, seed: int, count: int) -> tuple[MachineCase, int, int]:
    """Return the machine with its numbers varied until its picks change, how many of them do then, and how many there are."""
    found, most, all_of_them = machine, 0, 0
    for width in WIDTHS:
        wide = replace(machine, widely={**_ranges(machine, width), **machine.widely})
        changing = list(_changing(wide.together(count, seed)[1]))
        all_of_them = max(all_of_them, len(changing))
        if sum(changing) > most or found is machine:
            found, most = wide, sum(changing)
        if all(changing):
            break
    return found, most, all_of_them


def has_picks(machine: MachineCase) -> bool:
    """Return whether something of the machine is taken from a series."""
    return any(isinstance(step, Pick) for _, step in machine.mechanism.steps)


def _changing(calc: Calculation) -> Iterator[bool]:
    """Of each pick whether machines that can be take unlike values."""
    possible = [row for row in range(calc.count) if row not in calc.flaws]
    for id in calc.branch:
        if isinstance(calc.steps[id], Pick):
            yield len(np.unique(calc.branch[id][possible])) > 1


def _ranges(machine: MachineCase, width: float) -> Ranges:
    """Limits of each single number, as far as both ends are allowed."""
    known, found = dict(fields(machine.mechanism.inputs)), dict[str, tuple[float, float]]()
    for name, value in machine.values.items():
        meta = known.get(name)
        if (
            isinstance(meta, Quantity)
            and not meta.integer
            and not meta.listed
            and isinstance(value, float)
            and value > 0
        ):
            ends = np.array([value / width, value * width])
            low, high = np.where(meta.holds(ends), ends, value)
            found[name] = float(low), float(high)
    return found
