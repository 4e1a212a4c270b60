"""A run of an optimisation: generation after generation to the processes, each written as a part of a study's folder.

A generation is a part file. A run that goes on is told again what is stored, asks for the same machines, and so comes to where it
ended: nothing of the search itself is kept.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery
from diecut_report.config.validation import ConfigPlace
from diecut_report.design.machines import CHECKS, MARGIN, SIZE, STATUS, UTILISATION, ProvedMachine, margins, proved
from diecut_report.errors import PluginError, Problem, UserError, refusal
from diecut_report.files import refuse_unreadable_name
from diecut_report.formulas import Array
from diecut_report.press import Press
from diecut_report.quantities.plausible import plausible
from diecut_report.study.analysis.variant_config import variant_of
from diecut_report.study.analysis.variants import Stored, opened, quoted
from diecut_report.study.definition.base_inputs import present_value
from diecut_report.study.definition.samples import Values
from diecut_report.study.definition.study_file import Objective, Optimise, Study
from diecut_report.study.execution.engines import Engine, WorkerSetup, local_engine, results, settle
from diecut_report.study.execution.study_run import Counts, Tell, Where, described, engine_for, facts
from diecut_report.study.execution.variant_rows import Rows, calculate_rows
from diecut_report.study.storage.description import JUDGED, SEARCHED, Description, ResultColumn
from diecut_report.study.storage.store import Store, columns_of_part, refuse_used
from diecut_report.text.phrases import Phrase, phrase

# A generation calculated: many machines at once, what each costs, and by how much each breaks what is asked.


VIOLATION = ResultColumn(
    SEARCHED, "float", description="By how much limits and constraints are broken in sum; 0 where none is"
)
TOGETHER = 256  # machines of a piece, whatever number of processes there is: equal pieces give equal bytes
MOST, LEAST = 10.0, 1e-3  # that a check adds which fails by far, or by next to nothing
# of machines without an objective; that cannot exist; that break a constraint on inputs
NO_VALUE, NO_MACHINE, NOT_TRIED = 1e3, 1e4, 2e4


@dataclass(frozen=True)
class GenerationPiece:
    """Hold some machines of a generation: the number of the first, and their values by path."""

    start: int
    values: Mapping[str, Values]

    def __str__(self) -> str:
        return Phrase("machines from {start} on", start=self.start)


@dataclass
class Tried:
    """Hold what came of machines: the columns of those that were calculated, and for all costs and violations.

    ``costs`` are the objectives, less is better, shape (machines, objectives); ``violations`` are 0 where all holds.
    """

    columns: dict[str, Array]
    costs: Array
    violations: Array
    slow: dict[str, str] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)


def asked_of(study: Study) -> Optimise:
    """Return what the study searches for; its command has seen to it that it does."""
    assert study.optimise is not None
    return study.optimise


def generation_pieces(start: int, values: Mapping[str, Values]) -> Iterator[GenerationPiece]:
    """Cut a generation, whose first machine has this number, into equal pieces."""
    count = size(values)
    for part in np.array_split(np.arange(count), max(1, -(-count // TOGETHER))):
        if len(part):
            yield GenerationPiece(start + int(part[0]), rows_of(values, part))


def size(values: Mapping[str, Values]) -> int:
    """Return how many machines there are."""
    return len(next(iter(values.values())))


def rows_of(values: Mapping[str, Values], rows: Array) -> dict[str, Values]:
    """Return some of the machines."""
    return {
        path: column[rows] if isinstance(column, np.ndarray) else [column[row] for row in rows]
        for path, column in values.items()
    }


def broken_inputs(study: Study, values: Mapping[str, Values]) -> Array:
    """Return for each machine by how much it breaks constraints between inputs: such a one is not calculated."""
    early = [constraint for constraint in study.constraints if not constraint.outputs]
    return sum((each.shortfall(values) for each in early), np.zeros(size(values)))


def evaluate(study: Study, piece: GenerationPiece) -> Tried:
    """Calculate the machines of a piece that the constraints between inputs leave, and judge them all."""
    broken = broken_inputs(study, piece.values)
    left = np.flatnonzero(broken == 0)
    values = rows_of(piece.values, left)
    given = {study.inputs[p]: v for p, v in values.items()}
    further = margins if asked_of(study).is_passing else None
    rows = calculate_rows(study.base, given, len(left), study.curves, further=further)
    known = {**values, **rows.columns}
    violation = _violation(study, rows, known)
    own = {
        name: column for name, column in rows.columns.items() if not (CHECKS in name and name.endswith((MARGIN, SIZE)))
    }
    wanted = {*(own if study.outputs is None else study.outputs), *study.curves}
    kept = {name: column for name, column in own.items() if CHECKS in name or name in wanted}
    inputs = {path: np.asarray(v, dtype=float if isinstance(v, np.ndarray) else object) for path, v in values.items()}
    found = {"variant": piece.start + left} | inputs | kept | {VIOLATION.name: violation}
    found |= {JUDGED.name: rows.verdict, "status": rows.status, "governing": rows.governing, "error": rows.errors}
    return Tried(found, *_judged(study, broken, known, violation), rows.slow, rows.broken)


def _judged(study: Study, broken: Array, known: Mapping[str, Values], violation: Array) -> tuple[Array, Array]:
    """Costs and violations of all machines, of which those that break no constraint between inputs were calculated."""
    left, objectives = broken == 0, asked_of(study).objectives
    costs, violations = np.zeros((len(broken), len(objectives))), np.where(left, 0.0, NOT_TRIED + broken)
    costs[left], violations[left] = costs_of(known, objectives, len(violation)), violation
    costs[violations > 0] = 0.0
    return costs, violations


def costs_of(known: Mapping[str, Values], objectives: Sequence[Objective], count: int) -> Array:
    """Return the objectives of machines, less is better; NaN where one has no value."""
    absent = np.full(count, np.nan)
    found = [
        np.asarray(known.get(each.output, absent), dtype=float) * (1 if each.minimise else -1) for each in objectives
    ]
    return np.stack(found, axis=1)


def _violation(study: Study, rows: Rows, known: Mapping[str, Values]) -> Array:
    """By how much calculated machines break what is asked."""
    found = failing(rows.columns, rows.count) if asked_of(study).is_passing else np.zeros(rows.count)
    absent = np.full(rows.count, None, dtype=object)
    for constraint in study.constraints:
        if constraint.outputs:
            named = {name: known.get(name, absent) for name in constraint.outputs}
            found = found + constraint.shortfall({**known, **named})
    without = ~np.isfinite(costs_of(known, asked_of(study).objectives, rows.count)).all(axis=1)
    found = np.where(without, found + NO_VALUE, found)
    return np.where(rows.status == "error", NO_MACHINE, found)


def failing(known: Mapping[str, Array], count: int) -> Array:
    """Return for each machine how far its failing checks are beyond their limits, in sum."""
    found = np.zeros(count)
    for name in known:
        if CHECKS in name and name.endswith(STATUS):
            found += np.where(known[name] == "fail", _beyond(known, name.removesuffix(STATUS)), 0.0)
    return found


def _beyond(known: Mapping[str, Array], check: str) -> Array:
    """How far a check is beyond its limit: by its utilisation, and further, the more the margin is below zero, where the limit is not above zero."""
    used = np.clip(np.asarray(known[check + UTILISATION], dtype=float) - 1, LEAST, MOST)
    short = -np.asarray(known.get(check + MARGIN, np.nan), dtype=float)
    share = np.nan_to_num(short / (1 + np.abs(short)), nan=1.0)
    return np.asarray(np.where(np.isnan(used), MOST * (1 + np.maximum(share, 0.0)), used))


def joined(tried: Sequence[Tried]) -> Tried:
    """Return pieces as one; a column that some of them lack holds nothing there."""
    kinds = {name: column.dtype for each in tried for name, column in each.columns.items()}
    found = {name: np.concatenate([_column(each, name, kind) for each in tried]) for name, kind in kinds.items()}
    return Tried(
        found, np.concatenate([each.costs for each in tried]), np.concatenate([each.violations for each in tried]),
        {k: v for each in tried for k, v in each.slow.items()}, {k: v for each in tried for k, v in each.broken.items()},
    )  # fmt: skip


def _column(each: Tried, name: str, kind: np.dtype[np.generic]) -> Array:
    if name in each.columns:
        return each.columns[name]
    return np.full(len(each.columns["status"]), None if kind.kind == "O" else np.nan, dtype=kind)


# The listed machines once more, each by itself: written into the base, read again and calculated as its report would.


TOLERATED = 1e-6  # share of its size by which a number may differ
NOTHING = 1e-6  # a utilisation below which a difference is none
FEW = 8  # machines that are calculated sooner than other processes begin


@dataclass(frozen=True)
class SomeMachines:
    """Name machines that are to be calculated, each by itself."""

    variants: tuple[int, ...]

    def __str__(self) -> str:
        return Phrase("machines {variants} individually", variants=", ".join(map(str, self.variants)))


@dataclass(frozen=True)
class Recheck:
    """Hold a machine as it was among many and by itself: verdicts, and the number that differs most, with its share, or why there is none."""

    variant: int
    status: str
    alone: str
    name: str = ""
    share: float = 0.0
    fault: str = ""

    @property
    def is_same(self) -> bool:
        return not self.fault and self.status == self.alone and self.share <= TOLERATED


def rechecked(store: Store, stored: Stored, variants: Sequence[int], where: Where) -> list[Recheck]:
    """Return each of the machines as it was among many and by itself, in their order."""
    goals = [name for each in stored.study.get("objectives") or () for name in each.values()]
    used = [column.name for column, _ in stored.checks.values()]
    names = tuple(name for name in dict.fromkeys([*goals, *used]) if not name.startswith(("mechanisms.", "press.")))
    jobs = min(where.jobs or os.cpu_count() or 1, len(variants)) if len(variants) > FEW else 1
    some = [SomeMachines(tuple(variants[start::jobs])) for start in range(jobs)]
    plugins = tuple(where.plugins)
    setup = WorkerSetup("\n".join(["alone", *plugins]), _loaded, plugins)
    alone = partial(_alone, directory=store.directory, names=names)
    with local_engine(jobs, jobs, setup) as engine:
        found = {each.variant: each for _, part in results(engine, alone, some) for each in part}
    return [found[variant] for variant in variants]


def _loaded(*plugins: str) -> Discovery:
    settle()
    return Discovery([Path(plugin) for plugin in plugins])


def _alone(discovery: Discovery, some: SomeMachines, directory: Path, names: Sequence[str]) -> list[Recheck]:
    with opened(directory) as stored:
        return [_compared(discovery, stored, names, variant) for variant in some.variants]


def _compared(discovery: Discovery, stored: Stored, names: Sequence[str], variant: int) -> Recheck:
    listed = ", ".join(map(quoted, names)) or "NULL"
    ((status, *values),) = stored.rows(f"SELECT status, {listed} FROM v WHERE variant = ?", [variant])
    try:
        tree = variant_of(stored, variant, discovery, f"{variant}.yaml")
        machine = proved(Press.read(yaml.parse(tree.text, tree.file), discovery))
    except (UserError, PluginError) as error:
        return Recheck(variant, status, "error", fault=str(error).splitlines()[0])
    known = _numbers(machine)
    least = {column.name: plausible(column.unit).ends[0] for column in stored.columns.values() if column.unit}
    apart = [
        (_share(one, known.get(name), least.get(name, NOTHING)), name) for name, one in zip(names, values, strict=False)
    ]
    share, name = max(apart, default=(0.0, ""))
    return Recheck(variant, status, machine.run.status, name if share else "", share)


def _numbers(machine: ProvedMachine) -> dict[str, float]:
    """The outputs of a machine, and the utilisations of its checks."""
    found = dict(machine.outputs)
    for home, checks in machine.run.checks.items():
        for each in checks:
            column, used = f"{home}{CHECKS}{each.id}{UTILISATION}", each.utilisation
            if used is not None:  # of repeated parts the one that is used most governs
                found[column] = max(float(used), found.get(column, -math.inf))
    return found


def _share(one: Any, other: float | None, least: float) -> float:
    """By which share of its size a number differs; of one below the least size that a machine may have by a share of that."""
    if one is None or other is None or not math.isfinite(other):
        return 0.0 if one is None and (other is None or not math.isfinite(other)) else math.inf
    return abs(float(one) - other) / max(abs(float(one)), abs(other), least)


# Today's machine among those that are searched: the values that the base has for what varies.


def present_values(study: Study) -> dict[str, Any]:
    """Return what the base gives for each varied path (SI, texts); what it does not give, or calculates, is left out."""
    found = {path: present_value(study.base, asked) for path, asked in study.inputs.items()}
    return {path: value for path, value in found.items() if value is not None}


PYMOO = "pymoo"
STILL, ENOUGH = 1e-12, 10  # share of its size by which an objective differs by rounding alone; machines that show it


def description(study: Study) -> Description:
    """Return the study as the folder of its optimisation keeps it: a part for each generation, and what each machine breaks."""
    asked, found = asked_of(study), described(study)
    count = min(asked.evaluations, asked.combinations or asked.evaluations)
    return replace(found, rows=count, chunk=min(asked.population, count), columns=(*found.columns, VIOLATION))


def run_search(study: Study, directory: Path, where: Where, *, resume: bool, tell: Tell) -> SearchRun:
    """Try as many machines as the study says, but for those that the folder holds; each part file is whole or absent."""
    wanted = description(study)
    store = Store.open(directory, wanted) if resume else None
    if store is None:
        refuse_unreadable_name(directory)
        if directory.is_dir():
            refuse_used(directory)  # before anything is calculated
    with engine_for(study, where, wanted.parts * wanted.chunk // TOGETHER, wanted.rows) as engine:
        run = SearchRun(study, engine, wanted.rows, tell)
        first = None if store else run.first(wanted.chunk)
        run.store = store or Store.create(directory, wanted)
        with run.store.lock():
            run.through(first)
    return run


class SearchRun:
    """One run: what is stored is told to the search, what is not is calculated. ``slow`` and ``broken`` name plugins, and why."""

    store: Store

    def __init__(self, study: Study, engine: Engine, rows: int, tell: Tell) -> None:
        from diecut_report.design.optimisation.search import search  # with pymoo, which takes half a second

        self.study, self.engine, self.tell = study, engine, tell
        self.search = search(asked_of(study), present_values(study))
        self.counts = Counts(rows)
        self.slow: dict[str, str] = {}
        self.broken: dict[str, str] = {}

    def first(self, count: int) -> Tried:
        """Calculate the first generation; UserError where an objective is the same in all of its machines."""
        self.tell(self.counts)
        tried = self._calculated(0, rows_of(self.search.ask(), np.arange(count)))
        self._refuse_still(tried)
        return tried

    def through(self, first: Tried | None) -> None:
        """Go through all generations, and mark the folder as complete."""
        store = self.store
        self._started()
        began, before = time.monotonic(), float(store.state.get("seconds") or 0)
        there, is_new = store.done_parts(), False
        try:
            for part in range(store.description.parts):
                is_new |= part not in there
                self._generation(part, part in there, first if part == 0 else None)
        finally:
            if is_new:
                faults = {"broken": self.broken} if self.broken else {}
                store.note({"slow": self.slow, "seconds": before + time.monotonic() - began} | faults)
        store.finish()

    def _started(self) -> None:
        store = self.store
        store.start(facts(replace(self.study, objectives=asked_of(self.study).objectives)))
        known = store.state
        versions = dict.fromkeys([*known["libraries"].get(PYMOO, ()), version(PYMOO)])
        store.note({"libraries": known["libraries"] | {PYMOO: list(versions)}})
        self.slow, self.broken = dict(known.get("slow") or {}), dict(known.get("broken") or {}) | self.broken
        there = store.done_parts()
        for path in (path for index, path in store.parts().items() if index not in there):
            path.unlink(missing_ok=True)  # a damaged part is calculated again

    def _generation(self, part: int, is_there: bool, tried: Tried | None) -> None:
        """One generation: from its part file, else calculated and written; then told to the search."""
        rows = self.store.description.part_rows(part)
        if tried is None:
            values = rows_of(self.search.ask(), np.arange(len(rows)))
            tried = self._stored(part, values) if is_there else self._calculated(rows.start, values)
        if not is_there:
            self.store.write_part(part, tried.columns)
        self._count(tried, len(rows), is_there)
        if len(rows) == self.store.description.chunk and rows.stop < self.store.description.rows:
            self.search.tell(tried.costs, tried.violations)

    def _calculated(self, start: int, values: Mapping[str, Values]) -> Tried:
        pieces = results(self.engine, evaluate, generation_pieces(start, values))
        tried = joined([found for _, found in sorted(pieces, key=lambda each: int(each[0].start))])
        self.slow |= tried.slow
        self.broken |= tried.broken
        return tried

    def _stored(self, part: int, values: Mapping[str, Values]) -> Tried:
        """Return a generation as it is stored; UserError where it holds other machines than those that are asked for now."""
        broken, store = broken_inputs(self.study, values), self.store
        left = np.flatnonzero(broken == 0)
        goals = (each.output for each in asked_of(self.study).objectives)
        names = dict.fromkeys(["variant", "status", VIOLATION.name, *values, *goals])
        table = columns_of_part(store.part(part), store.schema, list(names))
        columns = zip(table.column_names, table.columns, strict=True) if table else ()
        known = {name: column.to_numpy() for name, column in columns}
        if not _is_same(known, rows_of(values, left), store.description.part_rows(part).start + left):
            used = "; ".join(
                f"{name} {', '.join(store.state['libraries'].get(name, ['?']))}" for name in ("numpy", PYMOO)
            )
            template = (
                "These results belong to another search, so it cannot be resumed. They were started with {used}: continue with those "
                "versions, or start again in another folder with -o."
            )
            raise refusal(template, store.directory, used=used)
        return Tried(known, *_judged(self.study, broken, known, known[VIOLATION.name]))

    def _count(self, tried: Tried, rows: int, is_there: bool) -> None:
        status = tried.columns["status"]
        self.counts.done += 0 if is_there else rows
        self.counts.before += rows if is_there else 0
        self.counts.variants += len(status)
        self.counts.failed += int(np.sum(status == "fail"))
        self.counts.errors += int(np.sum(status == "error"))
        self.tell(self.counts)

    def _refuse_still(self, tried: Tried) -> None:
        """Refuse an objective that is the same in all machines of a generation, or has a value in none."""
        exists = tried.columns["status"] != "error"
        if exists.sum() < ENOUGH:
            return
        objectives = asked_of(self.study).objectives
        costs = costs_of(tried.columns, objectives, len(exists))[exists]
        for index, (objective, values) in enumerate(zip(objectives, np.abs(costs.T), strict=True)):
            there = values[np.isfinite(values)]
            if not len(there) or np.ptp(there) <= STILL * there.max():
                template = "has no value" if not len(there) else "is the same"
                what = Phrase(
                    "{name} {words} in all of the first {n} machines tried: it does not depend on the varied inputs. Name another objective, or "
                    "vary inputs that affect it.",
                    name=objective.output, words=phrase(template), n=len(values),
                )  # fmt: skip
                raise UserError(_of_objective(self.study, index, what))


def _of_objective(study: Study, index: int, words: str) -> Problem:
    """A problem of an objective, with its place in the study."""
    home = ("optimise",) if "objectives" in study.tree.data["optimise"] else ()
    return ConfigPlace(study.tree).problem((*home, "objectives", index), words)


def _is_same(known: Mapping[str, Array], values: Mapping[str, Values], numbers: Array) -> bool:
    """Whether a part holds these machines, to the last digit."""
    if not known or not np.array_equal(known["variant"], numbers):
        return False
    return all(np.array_equal(known[path], np.asarray(given, known[path].dtype)) for path, given in values.items())
