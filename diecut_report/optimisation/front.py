"""What an optimisation has found: the machines that no other betters, some of them to look at, and one that stands out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.expressions import Array
from diecut_report.languages.phrases import phrase
from diecut_report.optimisation.generation import VIOLATION, asked_of
from diecut_report.optimisation.todays_machine import todays_values
from diecut_report.study.analysis.near_equality import rounded
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.definition.study_file import Study
from diecut_report.study.summary.pareto import StoredObjective, best, objectives

BULGE = 0.02  # share of the front's size by which a point must stand out to be suggested
NEAR = 1e-9  # share by which today's values may differ from those that were tried for them


@dataclass(frozen=True)
class Known:
    """Hold what is stored of all machines, in their order: numbers, verdicts, objectives as costs (less is better), inputs."""

    variants: Array
    status: Array
    governing: Array
    violations: Array
    costs: Array
    inputs: Mapping[str, Array]


@dataclass(frozen=True)
class FoundFront:
    """Hold the front in the order of its first objective; ``values`` are SI, ``listed`` places in it.

    ``suggested`` is the place of the point that stands out, ``why`` says how; ``today`` the number of today's machine, where it was
    tried; ``allowed`` how many machines break nothing.
    """

    objectives: tuple[StoredObjective, ...]
    varied: tuple[StoredColumn, ...]
    variants: Array
    values: Array
    status: Array
    governing: Array
    inputs: Mapping[str, Array]
    listed: tuple[int, ...]
    suggested: int | None
    why: str
    today: int | None
    allowed: int

    @property
    def is_single(self) -> bool:
        return len(self.objectives) == 1

    def numbers(self) -> list[int]:
        """Return the numbers of the listed machines."""
        return [int(self.variants[place]) for place in self.listed]


def known(stored: Stored) -> Known:
    """Return what is stored of all machines."""
    goals = objectives(stored)
    asked = [f"CAST({goal.column.sql} AS DOUBLE)" for goal in goals]
    inputs = [column.sql for column in stored.varied]
    names = ["variant", "status", "governing", VIOLATION.name, *asked, *inputs]
    labelled = ", ".join(f"{name} AS c{n}" for n, name in enumerate(names))
    found = stored.connection.execute(f"SELECT {labelled} FROM v ORDER BY variant").fetchnumpy()
    columns = [filled(found[f"c{n}"]) for n in range(len(names))]
    signs = np.array([1.0 if goal.is_less else -1.0 for goal in goals])
    costs = np.column_stack(columns[4 : 4 + len(goals)]).astype(float) * signs
    given = {column.name: values for column, values in zip(stored.varied, columns[4 + len(goals) :], strict=True)}
    return Known(columns[0], columns[1], columns[2], columns[3].astype(float), costs, given)


def filled(values: Any) -> Array:
    """Return a column of DuckDB as an array; what is missing is NaN, or nothing."""
    if not isinstance(values, np.ma.MaskedArray):
        return np.asarray(values)
    if values.dtype.kind == "f":
        return np.asarray(values.filled(np.nan))
    found: Array = np.array(values.data, dtype=object)
    found[np.ma.getmaskarray(values)] = None
    return found


def found_front(study: Study, stored: Stored, there: Known) -> FoundFront:
    """Return the machines that no other betters; none where no machine is allowed."""
    goals = objectives(stored)
    allowed = np.flatnonzero(there.violations == 0)
    places = allowed[_unbeaten(there.costs[allowed])] if len(allowed) else allowed
    signs = np.array([1.0 if goal.is_less else -1.0 for goal in goals])
    costs = there.costs[places]
    suggested, why = _outstanding(costs)
    return FoundFront(
        goals, tuple(stored.varied), there.variants[places], costs * signs, there.status[places], there.governing[places],
        {path: values[places] for path, values in there.inputs.items()},
        _listed(costs, asked_of(study).points, suggested), suggested, why, _today(study, there), len(allowed),
    )  # fmt: skip


def _unbeaten(costs: Array) -> Array:
    """Which machines no other betters, in the order of the first objective; of equal ones the first."""
    level = rounded(costs)
    if costs.shape[1] == 1:
        return np.array([int(np.argmin(level[:, 0]))])
    kept = np.sort(best(level))
    _, first = np.unique(level[kept], axis=0, return_index=True)
    return kept[first][np.lexsort(level[kept[first]].T[::-1])]


def shares(costs: Array) -> Array:
    """Return costs as shares of their range on the front; 0 for what is the same on all of it."""
    low, size = costs.min(axis=0), np.ptp(costs, axis=0)
    found: Array = (costs - low) / np.where(size > 0, size, 1.0)
    return found


def _outstanding(costs: Array) -> tuple[int | None, str]:
    """The point that stands out of the front, and by what."""
    if costs.shape[1] == 1:
        return (0, "") if len(costs) else (None, "")
    if len(costs) < 3:
        return None, phrase("no point is suggested: the front has too few of them")
    sums = shares(costs).sum(axis=1)
    place = int(np.argmin(sums))
    if costs.shape[1] > 2:
        return place, phrase("least sum of the objectives, each as a share of its range on the front")
    if 1.0 - sums[place] < BULGE:
        return None, phrase("no point is suggested: the front is straight, or bulges to the other side")
    return place, phrase("knee: furthest from the straight line between the ends of the front")


def _listed(costs: Array, most: int, suggested: int | None) -> tuple[int, ...]:
    """Places that show the front: its ends, the suggested point, then always the one that is furthest from those."""
    if len(costs) <= most:
        return tuple(range(len(costs)))
    level = shares(costs)
    chosen = list(dict.fromkeys([*([] if suggested is None else [suggested]), *map(int, level.argmin(axis=0))]))[:most]
    away = np.min([np.abs(level - level[place]).max(axis=1) for place in chosen], axis=0)
    while len(chosen) < most:
        chosen.append(int(np.argmax(away)))
        away = np.minimum(away, np.abs(level - level[chosen[-1]]).max(axis=1))
    return tuple(sorted(chosen))


def _today(study: Study, there: Known) -> int | None:
    """The number of today's machine: the first, where it has today's values."""
    own = todays_values(study)
    if not len(there.variants) or there.variants[0] != 0 or own.keys() != there.inputs.keys():
        return None
    return 0 if all(_is_alike(there.inputs[path][0], value) for path, value in own.items()) else None


def _is_alike(tried: Any, today: Any) -> bool:
    if isinstance(tried, str) or isinstance(today, str):
        return bool(tried == today)
    return bool(abs(tried - today) <= NEAR * max(abs(tried), abs(today)))


def columns_shown(front: FoundFront) -> Sequence[StoredColumn]:
    """Return objectives and varied inputs, each once."""
    return list(dict.fromkeys([*(goal.column for goal in front.objectives), *front.varied]))
