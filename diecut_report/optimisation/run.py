"""A run of an optimisation: generation after generation to the processes, each written as a part of a study's folder.

A generation is a part file. A run that goes on is told again what is stored, asks for the same machines, and so comes to where it
ended: nothing of the search itself is kept.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path

import numpy as np

from diecut_report.config import yaml_tree
from diecut_report.errors import Problem, UserError
from diecut_report.expressions import Array
from diecut_report.given_files import refuse_unreadable_name
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.optimisation import generation
from diecut_report.optimisation.generation import VIOLATION, Tried, asked_of
from diecut_report.optimisation.todays_machine import todays_values
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.engines import Engine, results
from diecut_report.study.execution.study_run import Counts, Tell, Where, described, engine_for, facts
from diecut_report.study.sampling.variables import Values
from diecut_report.study.storage import state
from diecut_report.study.storage.description import Description
from diecut_report.study.storage.part_files import columns_of_part
from diecut_report.study.storage.store import Store

PYMOO = "pymoo"
STILL, ENOUGH = 1e-12, 10  # share of its size by which an objective differs by rounding alone; machines that show it


@dataclass
class SearchOutcome:
    """Hold what a run left in its folder; ``slow`` and ``broken`` name plugins, and why."""

    store: Store
    slow: dict[str, str] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)


def description(study: Study) -> Description:
    """Return the study as the folder of its optimisation keeps it: a part for each generation, and what each machine breaks."""
    asked, found = asked_of(study), described(study)
    count = min(asked.evaluations, asked.combinations or asked.evaluations)
    return replace(found, rows=count, chunk=min(asked.population, count), columns=(*found.columns, VIOLATION))


def run_search(study: Study, directory: Path, where: Where, *, resume: bool, tell: Tell) -> SearchOutcome:
    """Try as many machines as the study says, but for those that the folder holds; each part file is whole or absent."""
    wanted = description(study)
    store = Store.open(directory, wanted) if resume else None
    if store is None:
        _refuse_used(directory)
    with engine_for(study, where, wanted.parts * wanted.chunk // generation.TOGETHER, wanted.rows) as engine:
        run = _Run(study, engine, wanted.rows, tell)
        first = None if store else run.first(wanted.chunk)
        store = store or Store.create(directory, wanted)
        with store.lock():
            return run.through(store, first)


def _refuse_used(directory: Path) -> None:
    """Refuse a folder that holds anything, before anything is calculated."""
    refuse_unreadable_name(directory)
    if directory.is_dir():
        state.refuse_used(directory)


class _Run:
    """One run: what is stored is told to the search, what is not is calculated."""

    def __init__(self, study: Study, engine: Engine, rows: int, tell: Tell) -> None:
        from diecut_report.optimisation.search import search  # with pymoo, which takes half a second

        self.study, self.engine, self.tell = study, engine, tell
        self.search = search(asked_of(study), todays_values(study))
        self.counts = Counts(rows)
        self.slow: dict[str, str] = {}
        self.broken: dict[str, str] = {}

    def first(self, count: int) -> Tried:
        """Calculate the first generation; UserError where an objective is the same in all of its machines."""
        self.tell(self.counts)
        tried = self._calculated(0, generation.rows_of(self.search.ask(), np.arange(count)))
        self._refuse_still(tried)
        return tried

    def through(self, store: Store, first: Tried | None) -> SearchOutcome:
        """Go through all generations, and mark the folder as complete."""
        self._started(store)
        began, before = time.monotonic(), float(store.state.get("seconds") or 0)
        there, is_new = store.done_parts(), False
        try:
            for part in range(store.description.parts):
                is_new |= part not in there
                self._generation(store, part, part in there, first if part == 0 else None)
        finally:
            if is_new:
                store.note({"slow": self.slow, "seconds": before + time.monotonic() - began} | self._faults())
        store.finish({})
        return SearchOutcome(store, self.slow, self.broken)

    def _faults(self) -> dict[str, dict[str, str]]:
        return {"broken": self.broken} if self.broken else {}

    def _started(self, store: Store) -> None:
        store.start(facts(replace(self.study, objectives=asked_of(self.study).objectives)))
        known = store.state
        versions = dict.fromkeys([*known["libraries"].get(PYMOO, ()), version(PYMOO)])
        store.note({"libraries": known["libraries"] | {PYMOO: list(versions)}})
        self.slow, self.broken = dict(known.get("slow") or {}), dict(known.get("broken") or {}) | self.broken
        there = store.done_parts()
        for path in (path for index, path in store.parts().items() if index not in there):
            path.unlink(missing_ok=True)  # a damaged part is calculated again

    def _generation(self, store: Store, part: int, is_there: bool, tried: Tried | None) -> None:
        """One generation: from its part file, else calculated and written; then told to the search."""
        rows = store.rows(part)
        if tried is None:
            values = generation.rows_of(self.search.ask(), np.arange(len(rows)))
            tried = self._stored(store, part, values) if is_there else self._calculated(rows.start, values)
        if not is_there:
            store.write_part(part, tried.columns)
        self._count(tried, len(rows), is_there)
        if len(rows) == store.description.chunk and rows.stop < store.description.rows:
            self.search.tell(tried.costs, tried.violations)

    def _calculated(self, start: int, values: Mapping[str, Values]) -> Tried:
        """Calculate a generation, its pieces side by side."""
        pieces = results(self.engine, generation.evaluate, generation.pieces(start, values))
        tried = generation.joined([found for _, found in sorted(pieces, key=lambda each: int(each[0].start))])
        self.slow |= tried.slow
        self.broken |= tried.broken
        return tried

    def _stored(self, store: Store, part: int, values: Mapping[str, Values]) -> Tried:
        """Return a generation as it is stored; UserError where it holds other machines than those that are asked for now."""
        broken = generation.broken_inputs(self.study, values)
        left = np.flatnonzero(broken == 0)
        objectives = asked_of(self.study).objectives
        names = ["variant", "status", VIOLATION.name, *values, *(each.output for each in objectives)]
        table = columns_of_part(store.part(part), store.schema, list(dict.fromkeys(names)))
        known = (
            {name: table.column(name).to_numpy(zero_copy_only=False) for name in table.column_names} if table else {}
        )
        if not _is_same(known, generation.rows_of(values, left), store.rows(part).start + left):
            raise UserError(_other_machines(store))
        violations = np.where(broken > 0, generation.NOT_TRIED + broken, 0.0)
        violations[left] = known[VIOLATION.name]
        costs = np.zeros((len(broken), len(objectives)))
        costs[left] = generation.costs_of(known, objectives, len(left))
        costs[violations > 0] = 0.0
        return Tried(known, costs, violations)

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
        costs = generation.costs_of(tried.columns, objectives, len(exists))[exists]
        for index, (objective, values) in enumerate(zip(objectives, np.abs(costs.T), strict=True)):
            there = values[np.isfinite(values)]
            if not len(there) or np.ptp(there) <= STILL * there.max():
                words = "has no value" if not len(there) else "is the same"
                what = Phrase(
                    "{name} {words} in all {n} machines that were tried first: it does not follow from what varies. Name "
                    "another objective, or vary what it follows from.",
                    name=objective.output, words=phrase(words), n=len(values),
                )  # fmt: skip
                raise UserError(_of_objective(self.study, index, what))


def _of_objective(study: Study, index: int, words: str) -> Problem:
    """A problem of an objective, with its place in the study."""
    home = ("optimise",) if "objectives" in study.data["optimise"] else ()
    key = (*home, "objectives", index)
    line, column = yaml_tree.parse(study.text, str(study.file)).position(key)
    return Problem(words, str(study.file), line, column, ".".join(map(str, key)))


def _is_same(known: Mapping[str, Array], values: Mapping[str, Values], numbers: Array) -> bool:
    """Whether a part holds these machines, to the last digit."""
    if not known or not np.array_equal(known["variant"], numbers):
        return False
    return all(np.array_equal(known[path], np.asarray(given, known[path].dtype)) for path, given in values.items())


def _other_machines(store: Store) -> Problem:
    used = "; ".join(f"{name} {', '.join(store.state['libraries'].get(name, ['?']))}" for name in ("numpy", PYMOO))
    words = (
        "These results hold other machines than the search asks for now, so that it cannot go on where it ended. They were begun "
        "with {used}: continue with those versions, or begin anew in another folder with -o."
    )
    return Problem(Phrase(words, used=used), str(store.directory))
