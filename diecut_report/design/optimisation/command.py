"""The command ``optimise``: from a study to its folder, its front, the page about it, and full reports of chosen machines."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from diecut_report.design.findings import with_findings
from diecut_report.design.optimisation.result import Conflict, InputPlace, OptimisationResult, result
from diecut_report.design.optimisation.run import SearchRun, run_search
from diecut_report.design.optimisation.texts import lines, plain
from diecut_report.errors import Problem, UserError
from diecut_report.files import write_all
from diecut_report.study.analysis.answers import Request, answer
from diecut_report.study.analysis.variants import opened
from diecut_report.study.command import Shown, in_its_language, loaded, untranslated
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.study_run import LARGEST, Where
from diecut_report.study.execution.variant_reports import Chosen, best, wanted, write_chosen
from diecut_report.study.storage.description import STATE
from diecut_report.study.storage.store import Store
from diecut_report.text.phrases import Phrase, phrase

# What an optimisation has found as plain data, in SI.


Data = dict[str, Any]


def data(found: OptimisationResult) -> Data:
    """Return all of it: objectives, counts, the whole front, what is suggested, where it lies, how it was found and proved."""
    front = found.front
    return {
        "study": found.stored.description.study.file,
        "objectives": [{"minimise" if goal.is_less else "maximise": goal.column.name} for goal in front.objectives],
        "units": {column.name: column.unit for column in front.columns if column.is_number},
        "tried": found.tried,
        "calculated": found.calculated,
        "allowed": front.allowed,
        "errors": found.errors,
        "dropped": found.dropped,
        "front": list(_points(found)),
        "suggested": None if front.suggested is None else int(front.variants[front.suggested]),
        "today": front.present,
        "bounds": [_place(each) for each in found.bounds],
        "progress": [
            {"tried": tried, "reached": _number(reached)}
            for tried, reached in zip(found.progress.tried, found.progress.reached, strict=True)
        ],
        "recheck": [
            {"variant": each.variant, "status": each.status, "alone": each.alone, "same": each.is_same, "differs": each.name or None,
             "share": _number(each.share), "fault": each.fault or None}
            for each in found.rechecks
        ],
        "conflict": None if found.conflict is None else _conflict(found.conflict),
    }  # fmt: skip


def _points(found: OptimisationResult) -> Iterator[Data]:
    front, listed = found.front, set(found.front.listed)
    for place, variant in enumerate(front.variants):
        values = {goal.column.name: plain(front.values[place, n]) for n, goal in enumerate(front.objectives)}
        inputs = {path: plain(column[place]) for path, column in front.inputs.items()}
        verdict = {"status": front.status[place], "governing": front.governing[place]}
        yield {"variant": int(variant), **verdict, "listed": place in listed, "values": {**values, **inputs}}


def _place(each: InputPlace) -> Data:
    if each.is_text:
        return {"input": each.column.name, "count": each.count, "values": dict(each.counts)}
    ends = {"from": each.low, "to": each.high, "at_from": each.at_low, "at_to": each.at_high}
    return {"input": each.column.name, "count": each.count, **ends}


def _conflict(why: Conflict) -> Data:
    failing = {name: _number(used) for name, used in why.failing}
    return {"together": list(why.together), "nearest": why.nearest, "failing": failing, "reason": why.reason or None}


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


SUGGESTED, FRONT = "suggested", "front"  # machines that a user may name for a report, beside their numbers


@dataclass(frozen=True)
class OptimiseOutcome:
    """Hold what a run found, as lines of text, as plain data and as CSV; the files that it wrote; and what went wrong in it."""

    lines: tuple[str, ...]
    data: Data
    csv: str
    written: tuple[Path, ...]
    search: SearchRun
    broken_reports: dict[str, str]
    notes: tuple[str, ...]
    is_found: bool

    @property
    def is_broken(self) -> bool:
        """Return whether a plugin broke for all machines, or in a full report."""
        counts = self.search.store.state.get("counts") or {}
        is_useless = bool(self.search.broken) and counts.get("error") == counts.get("variants")
        return bool(self.broken_reports) or is_useless


def run(
    file: Path | None,
    directory: Path,
    where: Where,
    *,
    resume: bool,
    agreed: bool,
    reports: Sequence[str],
    shown: Shown,
) -> OptimiseOutcome:
    """Search, or go on with the search of a folder; then prove, tell and draw what was found."""
    study = _asked(file, directory, where)
    _refuse(study, reports, agreed)
    search = run_search(study, directory, where, resume=resume, tell=shown)
    with search.store.lock(), ExitStack() as open_ones:
        with in_its_language(study, where):  # columns have their titles in the language of the documents
            stored = open_ones.enter_context(opened(directory))
        shown.doing(phrase("the front, machine by machine"))
        found = result(study, search.store, stored, where)
        chosen = _chosen(found, search.store, reports)
        notes, broken = write_chosen(chosen, search.store, where, with_findings, agreed=agreed, tell=shown.doing)
        shown.doing(phrase("the page of the optimisation"))
        csv = _csv(directory, found)
        files = _files(found, csv, where)
        write_all(files, keep=directory / STATE)
        told, notes = tuple(lines(found)), (*notes, *untranslated(study, where))
        return OptimiseOutcome(told, data(found), csv, tuple(files), search, broken, notes, found.conflict is None)


def _asked(file: Path | None, directory: Path, where: Where) -> Study:
    """The study, which must say what is searched for."""
    study = loaded(file, directory, where)
    if study.optimise is None:
        template = "is missing; say what is searched for, such as optimise: {objectives: [{minimise: cylinder.mass}], evaluations: 2000}."
        raise UserError(Problem(phrase(template), study.tree.file, path="optimise"))
    return study


def _refuse(study: Study, reports: Sequence[str], agreed: bool) -> None:
    """Refuse very many machines, and the number of a machine that is never tried."""
    assert study.optimise is not None
    count = study.optimise.evaluations
    if count > LARGEST and not agreed:
        message = Phrase("are {n}, more than {most}; give fewer, or --yes.", n=f"{count:,}", most=f"{LARGEST:,}")
        raise UserError(Problem(message, study.tree.file, path="optimise.evaluations"))
    for number in (int(name) for name in reports if name.isdecimal()):
        if number >= count:
            message = Phrase(
                "there is no machine {number}; those that are tried are numbered from 0 to {last}.",
                number=number,
                last=count - 1,
            )
            raise UserError(Problem(message, study.tree.file, path="--report"))


def _files(found: OptimisationResult, csv: str, where: Where) -> dict[Path, bytes]:
    """The files beside the results, by their paths."""
    from diecut_report.design.optimisation.page import page, sheets  # with matplotlib and WeasyPrint

    home = found.stored.folder
    text = json.dumps(data(found), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    with in_its_language(found.study, where):
        documents = {home / "optimisation.html": page(found).encode(), home / "optimisation.pdf": sheets(found)}
    return {**documents, home / "front.csv": csv.encode(), home / "front.json": text.encode()}


def _csv(directory: Path, found: OptimisationResult) -> str:
    """The whole front with all columns (SI), in the order of its first objective; the heads alone where there is none."""
    picked = found.front.variants.tolist()
    first = found.front.objectives[0]
    order = first.column.name if first.is_less else f"-{first.column.name}"
    asked = Request(sort=order, picked=picked) if picked else Request(where="violation < 0")
    return "".join(answer(directory, asked, "csv"))


# --- full reports ----------------------------------------------------------------------------------------------------


def _chosen(found: OptimisationResult, store: Store, reports: Sequence[str]) -> Chosen:
    """The machines that get a full report: those of the command, and those of the study's own key."""
    own = _of_study(found, store)
    numbers = list(dict.fromkeys(number for name in reports for number in _named(found, name)))
    if not numbers:
        return own
    reports_of = replace(found.study.reports, which="ids", ids=tuple(numbers))
    asked = wanted(replace(found.study, reports=reports_of), store)
    return Chosen(tuple(sorted({*own.variants, *asked.variants})), (*own.notes, *asked.notes))


def _of_study(found: OptimisationResult, store: Store) -> Chosen:
    """The machines that the study asks reports of; the best ones are those of the front."""
    reports, front = found.study.reports, found.front
    if reports.which != "best":
        return wanted(found.study, store)
    columns = {goal.column.name: front.values[:, n] for n, goal in enumerate(front.objectives)}
    goals = [(goal.column.name, goal.is_less) for goal in front.objectives]
    if not len(front.variants):
        return Chosen(())
    rows = best({"status": front.status, **columns}, goals, reports.best)
    return Chosen(tuple(sorted(int(front.variants[row]) for row in rows)))


def _named(found: OptimisationResult, name: str) -> Iterable[int]:
    """The machines that a word or a number stands for."""
    if name == FRONT:
        return found.front.numbers()
    if name != SUGGESTED:
        return [int(name)]
    place = found.front.suggested
    return [] if place is None else [int(found.front.variants[place])]
