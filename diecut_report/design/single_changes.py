"""One input alone changed over its whole range: finds what steps from one machine to the next do not see, such as a size that is rounded."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from diecut_report.design.changed_machines import ChangedMachines
from diecut_report.design.typed_changes import passes
from diecut_report.expressions import Array

LEAST, LOWEST, HIGHEST = 0.004, 0.95, 3.0  # shares of today's value by which an input is changed
MACHINES, EACH = 500, (24, 100)  # of one scan, and of each input to each side
CLOSER = 12  # machines between one that passes and the next smaller change


def single_change(run: ChangedMachines, base: Array, among: Collection[int], most: float) -> Array | None:
    """Return the smallest changes of one input among these, beside what ``base`` changes of the others, with which all passes.

    None where none is found whose sum is less than ``most``.
    """
    if not among:
        return None
    count = int(np.clip(MACHINES / 2 / len(among), *EACH))
    tried = np.concatenate([-np.geomspace(LOWEST, LEAST, count), np.geomspace(LEAST, HIGHEST, count)])
    found = _best(run, [_with(base, each, tried) for each in among], most)
    if found is None:
        return None
    which, row = found
    index, share = list(among)[which], float(row[list(among)[which]])
    sizes = np.sort(np.abs(tried[np.sign(tried) == np.sign(share)]))
    smaller = float(sizes[max(int(np.searchsorted(sizes, abs(share) * (1 - 1e-9))) - 1, 0)])
    nearer = np.sign(share) * np.linspace(min(smaller, abs(share)), abs(share), CLOSER)
    closer = _best(run, [_with(base, index, nearer)], most)
    return row if closer is None else closer[1]


def _with(base: Array, index: int, shares: Array) -> Array:
    rows = np.repeat(base[None], len(shares), axis=0)
    rows[:, index] = shares
    return rows


def _best(run: ChangedMachines, rows: list[Array], most: float) -> tuple[int, Array] | None:
    """The smallest changes of these that pass, and in which group of rows they stand."""
    best: tuple[int, Array] | None = None
    for which, group in enumerate(rows):
        size = np.abs(group).sum(axis=1)
        allowed = group[_allowed(run, group) & (size < most)]
        if not len(allowed):
            continue
        good = allowed[passes(run(allowed))]
        if len(good):
            row = good[int(np.argmin(np.abs(good).sum(axis=1)))]
            best, most = (which, row), float(np.abs(row).sum())
    return best


def _allowed(run: ChangedMachines, rows: Array) -> Array:
    """Which rows change no input beyond what its declaration allows."""
    found = np.ones(len(rows), dtype=bool)
    for index, each in enumerate(run.inputs):
        found &= each.allows((each.today or 0.0) * (1.0 + rows[:, index]))
    return found
