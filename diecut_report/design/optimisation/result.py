"""All that an optimisation has to tell, before it is put into words, tables and figures."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pymoo.indicators.hv import HV

from diecut_report.design.optimisation.run import VIOLATION, Recheck, asked_of, present_values, rechecked
from diecut_report.design.optimisation.search import gene, is_alike
from diecut_report.formulas import Array
from diecut_report.mechanism.inputs import Quantity
from diecut_report.study.analysis.answers import rounded
from diecut_report.study.analysis.variants import Stored, StoredColumn, quoted
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.study_run import Where
from diecut_report.study.storage.store import Store
from diecut_report.study.summary.best import StoredObjective, objectives, pareto_best
from diecut_report.text.phrases import phrase

# What an optimisation has found: the machines that no other betters, some of them to look at, and one that stands out.


BULGE = 0.02  # share of the front's size by which a point must stand out to be suggested


@dataclass(frozen=True)
class TriedMachines:
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

    ``suggested`` is the place of the point that stands out, ``why`` says how; ``present`` the number of today's machine, where it was
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
    present: int | None
    allowed: int

    @property
    def is_single(self) -> bool:
        return len(self.objectives) == 1

    @property
    def columns(self) -> list[StoredColumn]:
        """Return objectives and varied inputs, each once."""
        return list(dict.fromkeys([*(goal.column for goal in self.objectives), *self.varied]))

    def numbers(self) -> list[int]:
        """Return the numbers of the listed machines."""
        return [int(self.variants[place]) for place in self.listed]


def known(stored: Stored) -> TriedMachines:
    """Return what is stored of all machines."""
    goals = objectives(stored)
    asked = [f"CAST({goal.column.sql} AS DOUBLE)" for goal in goals]
    inputs = [column.sql for column in stored.varied]
    columns = _columns(stored, ["variant", "status", "governing", VIOLATION.name, *asked, *inputs])
    costs = np.column_stack(columns[4 : 4 + len(goals)]).astype(float) * signs(goals)
    given = {column.name: values for column, values in zip(stored.varied, columns[4 + len(goals) :], strict=True)}
    return TriedMachines(columns[0], columns[1], columns[2], columns[3].astype(float), costs, given)


def signs(goals: Sequence[StoredObjective]) -> Array:
    """Return with which sign each objective is a cost, of which less is better."""
    return np.array([1.0 if goal.is_less else -1.0 for goal in goals])


def _columns(stored: Stored, terms: Sequence[str]) -> list[Array]:
    """What each of these terms of SQL gives for all machines, in their order."""
    labelled = ", ".join(f"{term} AS c{n}" for n, term in enumerate(terms))
    found = stored.connection.execute(f"SELECT {labelled} FROM v ORDER BY variant").fetchnumpy()
    return [_filled(found[f"c{n}"]) for n in range(len(terms))]


def _filled(values: Any) -> Array:
    """A column of DuckDB as an array; what is missing is NaN, or nothing."""
    if not isinstance(values, np.ma.MaskedArray):
        return np.asarray(values)
    if values.dtype.kind == "f":
        return np.asarray(values.filled(np.nan))
    found: Array = np.array(values.data, dtype=object)
    found[np.ma.getmaskarray(values)] = None
    return found


def found_front(study: Study, stored: Stored, there: TriedMachines) -> FoundFront:
    """Return the machines that no other betters; none where no machine is allowed."""
    goals = objectives(stored)
    allowed = np.flatnonzero(there.violations == 0)
    places = allowed[_unbeaten(there.costs[allowed])] if len(allowed) else allowed
    costs = there.costs[places]
    suggested, why = _outstanding(costs, there.status[places] == "pass")
    return FoundFront(
        goals, tuple(stored.varied), there.variants[places], costs * signs(goals), there.status[places], there.governing[places],
        {path: values[places] for path, values in there.inputs.items()},
        _listed(costs, asked_of(study).points, suggested), suggested, why, _present(study, there), len(allowed),
    )  # fmt: skip


def _unbeaten(costs: Array) -> Array:
    """Which machines no other betters, in the order of the first objective; of equal ones the first."""
    level = rounded(costs)
    if costs.shape[1] == 1:
        return np.array([int(np.argmin(level[:, 0]))])
    kept = np.sort(pareto_best(level))
    _, first = np.unique(level[kept], axis=0, return_index=True)
    return kept[first][np.lexsort(level[kept[first]].T[::-1])]


def shares(costs: Array) -> Array:
    """Return costs as shares of their range on the front; 0 for what is the same on all of it."""
    low, size = costs.min(axis=0), np.ptp(costs, axis=0)
    found: Array = (costs - low) / np.where(size > 0, size, 1.0)
    return found


def _outstanding(costs: Array, passing: Array) -> tuple[int | None, str]:
    """The point that stands out of the front, and by what: of those that pass without a warning, where there are any."""
    if costs.shape[1] == 1:
        return (0, "") if len(costs) else (None, "")
    if len(costs) < 3:
        return None, phrase("no point is suggested: the front has too few of them")
    sums = shares(costs).sum(axis=1)
    place = int(np.argmin(sums))
    if costs.shape[1] == 2 and 1.0 - sums[place] < BULGE:
        return None, phrase("no point is suggested: the front is straight, or curves the other way")
    if passing.any() and not passing[place]:
        place = int(np.argmin(np.where(passing, sums, np.inf)))
        return place, phrase("minimum sum of the normalised objectives among the machines without a warning")
    if costs.shape[1] > 2:
        return place, phrase("minimum sum of the objectives, each normalised by its range on the front")
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


def _present(study: Study, there: TriedMachines) -> int | None:
    """The number of today's machine: the first, where it has today's values."""
    own = present_values(study)
    if not len(there.variants) or there.variants[0] != 0 or own.keys() != there.inputs.keys():
        return None
    return 0 if all(is_alike(there.inputs[path][0], value) for path, value in own.items()) else None


# Where no machine is allowed: which demands no machine holds together, and which machine comes nearest.


MOST = 200  # demands that are looked through: those that fail most


@dataclass(frozen=True)
class Conflict:
    """Hold the demands (checks, constraints) that none of the calculated machines holds together, and the nearest machine.

    ``nearest`` is None where no machine could be calculated; ``failing`` are the demands that it breaks, each with its utilisation
    (NaN where it has none). ``reason`` is why most of the machines cannot exist.
    """

    together: tuple[str, ...]
    nearest: int | None
    failing: tuple[tuple[str, float], ...]
    reason: str


def conflict(study: Study, stored: Stored, there: TriedMachines) -> Conflict:
    """Return why no machine is allowed."""
    exists = there.status != "error"
    demands = {name: broken[exists] for name, broken in _broken(study, stored).items()}
    numbers, violations = there.variants[exists], there.violations[exists]
    place = int(np.argmin(violations)) if len(violations) else None
    failing = () if place is None else tuple(_failing(stored, demands, place, int(numbers[place])))
    nearest = None if place is None else int(numbers[place])
    return Conflict(_together(demands), nearest, failing, _reason(stored))


def _broken(study: Study, stored: Stored) -> dict[str, Array]:
    """For each check and constraint which machines break it, those that all hold left out."""
    checks = list(stored.checks) if asked_of(study).is_passing else []
    found: dict[str, Array] = {}
    if checks:
        columns = _columns(stored, [f"{stored.checks[check][1].sql} = 'fail'" for check in checks])
        found = {check: failed.astype(bool) for check, failed in zip(checks, columns, strict=True)}
    for constraint in study.constraints:
        if constraint.outputs:
            rows = zip(constraint.paths, _columns(stored, list(map(quoted, constraint.paths))), strict=True)
            found[constraint.text] = constraint.shortfall(dict(rows)) > 0
    telling = sorted((name for name, broken in found.items() if broken.any()), key=lambda name: -int(found[name].sum()))
    return {name: found[name] for name in telling[:MOST]}


def _together(broken: dict[str, Array]) -> tuple[str, ...]:
    """A few demands that no machine holds together: the one that most break, then always the one that leaves fewest; no more than it needs."""
    chosen: list[str] = []
    left = np.ones(len(next(iter(broken.values()), ())), dtype=bool)
    while left.any():
        name = max(broken, key=lambda name: int(np.sum(broken[name] & left)), default=None)
        if name is None or not (broken[name] & left).any():
            return ()
        chosen.append(name)
        left = left & ~broken[name]
    for name in list(chosen):
        others = [each for each in chosen if each != name]
        if others and np.logical_or.reduce([broken[each] for each in others]).all():
            chosen = others
    return tuple(chosen)


def _failing(stored: Stored, broken: dict[str, Array], place: int, number: int) -> list[tuple[str, float]]:
    found = []
    for name in (name for name, rows in broken.items() if rows[place]):
        value = None
        if name in stored.checks:
            ((value,),) = stored.rows(f"SELECT {stored.checks[name][0].sql} FROM v WHERE variant = ?", [number])
        found.append((name, float("nan") if value is None else float(value)))
    return found


def _reason(stored: Stored) -> str:
    """The most frequent reason for which machines cannot exist."""
    rows = stored.rows(
        "SELECT error, count(*) AS n FROM v WHERE error IS NOT NULL GROUP BY error ORDER BY n DESC, error LIMIT 1"
    )
    return str(rows[0][0]) if rows else ""


# Where the front lies within what varies: an input that stands at an end of its range is held by that end.


AT_END = 1e-2  # share of a range within which a value stands at its end


@dataclass(frozen=True)
class InputPlace:
    """Hold where the front lies within one varied input: its ends (SI), how many points stand at each, and their shares of the range.

    Of a text ``counts`` says how many points have each value; numbers have ``low`` and ``high``. ``may_lower`` and ``may_raise`` say
    whether the input itself allows less or more than what is searched.
    """

    column: StoredColumn
    low: float = 0.0
    high: float = 0.0
    shares: Array = field(default_factory=lambda: np.empty(0))
    at_low: int = 0
    at_high: int = 0
    may_lower: bool = False
    may_raise: bool = False
    counts: tuple[tuple[str, int], ...] = ()

    @property
    def is_text(self) -> bool:
        return bool(self.counts)

    @property
    def count(self) -> int:
        return len(self.shares) if not self.is_text else sum(n for _, n in self.counts)


def places(study: Study, front: FoundFront) -> list[InputPlace]:
    """Return where the front lies within each input that has more than one value."""
    columns = {column.name: column for column in front.varied}
    found = []
    for variable in asked_of(study).variables:
        own = gene(variable)
        if not own.is_free:
            continue
        values = front.inputs[variable.path]
        if own.kind == "text":
            counted = Counter(map(str, values))
            told = tuple((option, counted[option]) for option in own.options)
            found.append(InputPlace(columns[variable.path], counts=told))
            continue
        low, high = (own.options[0], own.options[-1]) if own.options else sorted(own.ends)
        least = len(values) / 2 if own.options else 0.0
        found.append(_of_numbers(study, columns[variable.path], values.astype(float), low, high, least))
    return found


def _of_numbers(study: Study, column: StoredColumn, values: Array, low: float, high: float, least: float) -> InputPlace:
    """Where numbers lie; an end holds some where it holds more than so many: the ends of a short list are met by chance."""
    shares = (values - low) / (high - low)
    at_ends = (int(np.sum(shares <= AT_END)), int(np.sum(shares >= 1 - AT_END)))
    at_low, at_high = (count if count > least else 0 for count in at_ends)
    meta: Any = study.inputs[column.name].meta
    assert isinstance(meta, Quantity)
    step = meta.parsed_unit.factor if meta.integer else AT_END * (high - low)
    beyond = meta.holds(np.array([low - step, high + step]))
    return InputPlace(column, low, high, shares, at_low, at_high, bool(beyond[0]), bool(beyond[1]))


# How a search went: after each generation what is best so far, or which share of the final front's volume is reached.


BEYOND = 1.1  # of the front's size: the corner against which its volume is measured, so that its ends count
PROGRESS_MOST = 300  # points of a front of which the volume is taken


@dataclass(frozen=True)
class SearchProgress:
    """Hold for the end of each generation the machines tried so far and what is reached (NaN before the first that is allowed).

    It is the best cost of a single objective, else the volume that the front dominates, as a share of that at the end.
    """

    tried: tuple[int, ...]
    reached: tuple[float, ...]

    @property
    def last_gain(self) -> int:
        """Return how many machines were tried when the last thousandth was gained."""
        final = self.reached[-1] if self.reached else float("nan")
        near = [n for n, value in zip(self.tried, self.reached, strict=True) if abs(value - final) <= 1e-3 * abs(final)]
        return near[0] if near else 0


def progress(there: TriedMachines, rows: int, chunk: int) -> SearchProgress:
    """Return how the search went: ``rows`` machines were proposed, ``chunk`` in a generation."""
    ends = [min(end, rows) for end in range(chunk, rows + chunk, chunk)]
    allowed = there.violations == 0
    if not allowed.any():
        return SearchProgress(tuple(ends), (float("nan"),) * len(ends))
    if there.costs.shape[1] == 1:
        costs = np.where(allowed, there.costs[:, 0], np.inf)
        found = [float(np.min(costs[there.variants < end], initial=np.inf)) for end in ends]
        return SearchProgress(tuple(ends), tuple(value if np.isfinite(value) else float("nan") for value in found))
    return SearchProgress(tuple(ends), tuple(_volumes(there, allowed, ends)))


def _volumes(there: TriedMachines, allowed: Array, ends: list[int]) -> Iterator[float]:
    """The volume after each generation, as a share of the last."""
    fronts: list[Array] = []
    front, begin = np.empty((0, there.costs.shape[1])), 0
    for end in ends:
        new = there.costs[allowed & (there.variants >= begin) & (there.variants < end)]
        front = np.concatenate([front, new])
        front, begin = front[pareto_best(front)], end
        fronts.append(front)
    low, size = front.min(axis=0), np.where(np.ptp(front, axis=0) > 0, np.ptp(front, axis=0), 1.0)
    volume = HV(ref_point=np.full(front.shape[1], BEYOND))
    volumes = []
    for costs in ((each - low) / size for each in fronts):
        inside = costs[(costs < BEYOND).all(axis=1)]
        if len(inside) > PROGRESS_MOST:
            inside = inside[np.linspace(0, len(inside) - 1, PROGRESS_MOST).astype(int)]
        volumes.append(float(volume(inside)) if len(inside) else 0.0)
    yield from (own / volumes[-1] if len(each) else float("nan") for own, each in zip(volumes, fronts, strict=True))


@dataclass(frozen=True)
class OptimisationResult:
    """Hold what was found: ``conflict`` stands in place of a front where no machine is allowed."""

    study: Study
    stored: Stored
    known: TriedMachines
    front: FoundFront
    bounds: Sequence[InputPlace]
    progress: SearchProgress
    rechecks: Sequence[Recheck]
    conflict: Conflict | None

    @property
    def tried(self) -> int:
        """Return how many machines the search proposed."""
        return self.stored.description.rows

    @property
    def calculated(self) -> int:
        """Return how many of them were calculated: those that can exist and break no constraint between inputs."""
        return int((self.known.status != "error").sum())

    @property
    def errors(self) -> int:
        """Return how many of them cannot exist."""
        return int((self.known.status == "error").sum())

    @property
    def dropped(self) -> int:
        """Return how many of them break a constraint between inputs."""
        return self.tried - len(self.known.status)

    @property
    def differing(self) -> list[Recheck]:
        """Return the listed machines that are not by themselves what they were among many."""
        return [each for each in self.rechecks if not each.is_same]

    @property
    def is_all(self) -> bool:
        """Return whether every machine there is was tried."""
        return asked_of(self.study).is_exhaustive


def result(study: Study, store: Store, stored: Stored, where: Where) -> OptimisationResult:
    """Return what the stored machines say, and what the listed ones are by themselves."""
    there = known(stored)
    front = found_front(study, stored, there)
    is_found = bool(len(front.variants))
    return OptimisationResult(
        study, stored, there, front, places(study, front) if is_found else [],
        progress(there, stored.description.rows, stored.description.chunk),
        rechecked(store, stored, front.numbers(), where) if is_found else [],
        None if is_found else conflict(study, stored, there),
    )  # fmt: skip
