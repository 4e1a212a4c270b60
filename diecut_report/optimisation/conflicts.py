"""Where no machine is allowed: which demands no machine holds together, and which machine comes nearest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.expressions import Array
from diecut_report.optimisation.front import TriedMachines, filled
from diecut_report.optimisation.generation import asked_of
from diecut_report.study.analysis.stored_variants import Stored, quoted
from diecut_report.study.definition.study_file import Study

MOST = 200  # demands that are looked through: those that fail most


@dataclass(frozen=True)
class Conflict:
    """Hold the demands (checks, constraints) that none of so many calculated machines holds together, and the nearest machine.

    ``nearest`` is None where no machine could be calculated; ``failing`` are the demands that it breaks, each with its utilisation
    (NaN where it has none). ``reason`` is why most of the machines cannot exist.
    """

    together: tuple[str, ...]
    calculated: int
    errors: int
    nearest: int | None
    failing: tuple[tuple[str, float], ...]
    reason: str


def conflict(study: Study, stored: Stored, there: TriedMachines) -> Conflict:
    """Return why no machine is allowed."""
    exists = there.status != "error"
    demands = _broken(study, stored)
    demands = {name: broken[exists] for name, broken in demands.items()}
    numbers, violations = there.variants[exists], there.violations[exists]
    place = int(np.argmin(violations)) if len(violations) else None
    failing = () if place is None else tuple(_failing(stored, demands, place, int(numbers[place])))
    return Conflict(
        _together(demands), len(numbers), int(np.sum(~exists)),
        None if place is None else int(numbers[place]), failing, _reason(stored),
    )  # fmt: skip


def _broken(study: Study, stored: Stored) -> dict[str, Array]:
    """For each check and constraint which machines break it, those that all hold left out."""
    checks = list(stored.checks) if asked_of(study).is_passing else []
    found: dict[str, Array] = {}
    if checks:
        names = ", ".join(f"{stored.checks[check][1].sql} = 'fail' AS c{n}" for n, check in enumerate(checks))
        columns = stored.connection.execute(f"SELECT {names} FROM v ORDER BY variant").fetchnumpy()
        found = {check: _truths(columns[f"c{n}"]) for n, check in enumerate(checks)}
    for constraint in study.constraints:
        if constraint.outputs:
            names = ", ".join(f"{quoted(name)} AS c{n}" for n, name in enumerate(constraint.paths))
            columns = stored.connection.execute(f"SELECT {names} FROM v ORDER BY variant").fetchnumpy()
            rows = {name: filled(columns[f"c{n}"]) for n, name in enumerate(constraint.paths)}
            found[constraint.text] = constraint.shortfall(rows) > 0
    telling = sorted((name for name, broken in found.items() if broken.any()), key=lambda name: -int(found[name].sum()))
    return {name: found[name] for name in telling[:MOST]}


def _truths(values: Array) -> Array:
    return np.asarray(values.filled(False) if isinstance(values, np.ma.MaskedArray) else values, dtype=bool)


def _together(broken: dict[str, Array]) -> tuple[str, ...]:
    """A few demands that no machine holds together: the one that most break, then always the one that leaves fewest."""
    chosen: list[str] = []
    left = np.ones(len(next(iter(broken.values()), ())), dtype=bool)
    while left.any():
        name = max(broken, key=lambda name: int(np.sum(broken[name] & left)), default=None)
        if name is None or not (broken[name] & left).any():
            return ()
        chosen.append(name)
        left = left & ~broken[name]
    return tuple(_needed(broken, chosen))


def _needed(broken: dict[str, Array], chosen: list[str]) -> list[str]:
    """Those of the demands without which some machine would hold the others."""
    for name in list(chosen):
        others = [each for each in chosen if each != name]
        if others and np.logical_or.reduce([broken[each] for each in others]).all():
            chosen = others
    return chosen


def _failing(stored: Stored, broken: dict[str, Array], place: int, number: int) -> list[tuple[str, float]]:
    found = []
    for name, rows in broken.items():
        if rows[place]:
            used = float("nan")
            if name in stored.checks:
                ((value,),) = stored.rows(f"SELECT {stored.checks[name][0].sql} FROM v WHERE variant = ?", [number])
                used = float("nan") if value is None else float(value)
            found.append((name, used))
    return found


def _reason(stored: Stored) -> str:
    """The most frequent reason for which machines cannot exist."""
    rows = stored.rows(
        "SELECT error, count(*) AS n FROM v WHERE error IS NOT NULL GROUP BY error ORDER BY n DESC, error LIMIT 1"
    )
    return str(rows[0][0]) if rows else ""
