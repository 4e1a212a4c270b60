"""Full reports of some variants of a study."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config.plugins import Discovery
from diecut_report.formulas import Array
from diecut_report.press import AskedReport, CalculatedPress, Press
from diecut_report.study.analysis.answers import rounded
from diecut_report.study.analysis.variant_config import variant_config
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.engines import WorkerSetup, local_engine, results
from diecut_report.study.execution.study_run import Where
from diecut_report.study.storage.description import continuing
from diecut_report.study.storage.store import Store
from diecut_report.text.phrases import Phrase, phrase

FOLDER = "reports"
FORMATS = ("html", "pdf", "json")
MANY = 200  # reports that are made without being asked for twice; each takes some seconds
Tell = Callable[[str], None]
Finish = Callable[[CalculatedPress], CalculatedPress]
"""What adds to a calculation what its report has besides."""


@dataclass(frozen=True)
class Chosen:
    """Hold the variants that are to have a full report, ascending, and what stands against others that were asked for."""

    variants: tuple[int, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class VariantReport:
    variant: int

    def __str__(self) -> str:
        return Phrase("the full report of variant {number}", number=self.variant)


def write_chosen(
    chosen: Chosen, store: Store, where: Where, finish: Finish, *, agreed: bool, tell: Tell
) -> tuple[tuple[str, ...], dict[str, str]]:
    """Write full reports, as ``reports/ID.html`` and so on; those that are there already are kept.

    ``finish`` adds to each calculation what its report has besides, as the command ``report`` does. Return what was not done, and
    the plugins that broke, with their faults. ``tell`` hears how far it is. They are made side by side in processes of this machine.
    """
    folder = store.directory / FOLDER
    missing = [v for v in chosen.variants if not all((folder / f"{v}.{ending}").exists() for ending in FORMATS)]
    if len(missing) > MANY and not agreed:
        template = (
            "{count} variants are to get a full report, each of which takes some seconds; none was made. "
            "Make them all with: {continuing} --yes; or one: report {folder}#{first}"
        )
        command = continuing(store.directory, store.state["columns"])
        count = f"{len(missing):,}"
        note = Phrase(template, count=count, continuing=command, folder=store.directory, first=missing[0])
        return (*chosen.notes, note), {}
    broken: dict[str, str] = {}
    if missing:
        setup = WorkerSetup(
            "\n".join(["reports", *where.plugins]), Discovery, ([Path(each) for each in where.plugins],)
        )
        write = partial(_write, directory=store.directory, language=where.language, finish=finish)
        with local_engine(where.jobs, len(missing), setup) as engine:
            tell(Phrase("full reports: {n} of {total}", n=0, total=len(missing)))
            for done, (report, faults) in enumerate(results(engine, write, map(VariantReport, missing)), 1):
                template = "in the full report of variant {number}: {why}"
                broken |= {
                    kind: Phrase(template, number=report.variant, why=phrase(why)) for kind, why in faults.items()
                }
                tell(Phrase("full reports: {n} of {total}", n=done, total=len(missing)))
    return chosen.notes, broken


def _write(
    discovery: Discovery, report: VariantReport, directory: Path, language: str | None, finish: Finish
) -> dict[str, str]:
    config = variant_config(directory, report.variant, discovery, f"{report.variant}.yaml")
    press = Press.read(config, discovery)
    press.require_reportable(FORMATS)
    outcome = finish(press.calculate()).report(directory / FOLDER, FORMATS, AskedReport(language))
    return {error.kind: error.message for error in outcome.broken}


def wanted(study: Study, store: Store) -> Chosen:
    """Return which variants get a full report; those that cannot exist get none."""
    asked = study.reports
    if asked.which == "none":
        return Chosen(())
    objectives = [(each.output, each.minimise) for each in study.objectives] if asked.which == "best" else []
    names = dict.fromkeys(["variant", "status", *(name for name, _ in objectives)])
    table: Any = store.read(list(names)).to_table()
    columns = {name: table.column(name).to_numpy(zero_copy_only=False) for name in names}
    status, variant = columns["status"], columns["variant"].astype(int)
    if asked.which == "ids":
        possible = set(variant[status != "error"].tolist())
        return Chosen(tuple(sorted(possible & set(asked.ids))), tuple(_refused(asked.ids, possible, variant)))
    rows = np.flatnonzero(status == "fail" if asked.which == "failed" else status != "error")
    if asked.which == "best":
        rows = best(columns, objectives, asked.best)
    return Chosen(tuple(sorted(variant[rows].tolist())))


def _refused(ids: Sequence[int], possible: set[int], stored: Array) -> Iterator[str]:
    known = set(stored.tolist())
    for number in sorted(set(ids) - possible):
        impossible = "it cannot exist; its reason stands in the column error"
        why = phrase(impossible if number in known else "a constraint excludes it")
        yield Phrase("variant {number} gets no full report: {why}.", number=number, why=why)


def best(columns: dict[str, Array], objectives: Sequence[tuple[str, bool]], count: int) -> Array:
    """Return rows of the best variants: of those that pass (of all that exist where none does) the least sums of ranks.

    What is alike to ten digits has one rank, so none of them is worse than another in all objectives.
    """
    from scipy.stats import rankdata

    status = columns["status"]
    sound = np.isin(status, ("pass", "warn"))
    among = np.flatnonzero(sound if sound.any() else status != "error")
    total = np.zeros(len(among))
    for name, minimise in objectives:
        values = np.nan_to_num(columns[name][among].astype(float) * (1 if minimise else -1), nan=np.inf)
        total += rankdata(rounded(values), method="min")
    return np.asarray(among[np.argsort(total, kind="stable")[:count]])
