"""The command ``batch``: a study from its file to its folder, with progress, reports of some variants, and the summary."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diecut_report.config.plugins import Discovery, catalogues_for, lacking
from diecut_report.study.definition.study_file import Study, load_study
from diecut_report.study.execution.study_run import (
    Counts,
    StudyOutcome,
    Where,
    engine_for,
    refuse_empty,
    refuse_sample,
    run_study,
)
from diecut_report.study.execution.variant_reports import Finish, wanted, write_chosen
from diecut_report.study.storage.description import STUDY, kept
from diecut_report.study.storage.spreadsheets import export
from diecut_report.study.summary import summarise
from diecut_report.text.catalogues import Catalogues
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import said, say, speaking

if TYPE_CHECKING:
    from rich.progress import Progress

__all__ = ["Shown", "Where", "run"]


class Shown:
    """Show how far a run is, on a terminal: done and all, rate, time left, failures so far; silent in pipes."""

    def __init__(self, quiet: bool) -> None:
        self.is_quiet = quiet or not sys.stderr.isatty()
        self.bar: Progress | None = None
        self.task: Any = None
        self.after: Any = None

    def __enter__(self) -> Shown:
        if not self.is_quiet:
            self.bar = _bar()
            self.bar.start()
            self.task = self.bar.add_task(say("variants"), total=None, told="")
        return self

    def __exit__(self, *_: object) -> None:
        if self.bar is not None:
            self.bar.stop()

    def __call__(self, counts: Counts) -> None:
        if self.bar is not None:
            told = say("{n} of {total} fail", n=f"{counts.failed:,}", total=f"{counts.variants:,}")
            told += say(", {n} in error", n=f"{counts.errors:,}") if counts.errors else ""
            self.bar.update(self.task, total=counts.rows, completed=counts.before + counts.done, told=told)

    def doing(self, what: str) -> None:
        """Show what is done after the variants, on a line below."""
        if self.bar is None:
            return
        words = said(what)
        if self.after is None:
            self.after = self.bar.add_task(words, total=None, told="")
        self.bar.update(self.after, description=words)


def _bar() -> Progress:
    from rich import progress
    from rich.console import Console
    from rich.text import Text

    class Rate(progress.ProgressColumn):
        """Variants a second."""

        def render(self, task: progress.Task) -> Text:
            return Text(f"{task.speed:.0f}/s" if task.speed else "")

    text, told = progress.TextColumn("{task.description}"), progress.TextColumn("{task.fields[told]}")
    counted = (progress.BarColumn(), progress.MofNCompleteColumn(), Rate(), progress.TimeRemainingColumn())
    return progress.Progress(text, *counted, told, console=Console(stderr=True))


def run(
    study: Path | None, directory: Path, where: Where, *, resume: bool, agreed: bool, formats: Sequence[str], shown: Shown, finish: Finish
) -> StudyOutcome:  # fmt: skip
    """Run a study, or continue the one of a folder; then reports, summary and the other formats."""
    known = loaded(study, directory, where)
    refuse_sample(known, agreed)
    refuse_empty(known)
    if where.dask:
        with engine_for(known, where, 1):  # before anything is written: whether it can be reached
            pass
    outcome = run_study(known, directory, where, resume=resume, tell=shown)
    with outcome.store.lock():
        chosen = wanted(known, outcome.store)
        notes, outcome.broken_reports = write_chosen(
            chosen, outcome.store, where, finish, agreed=agreed, tell=shown.doing
        )
        shown.doing(phrase("summary"))
        files = export(outcome.store, formats)
        with in_its_language(known, where):
            summarise(directory, discovery=_discovery(where))
    outcome.notes = (*filter(None, [known.sample.note]), *notes, *files, *untranslated(known, where))
    return outcome


def in_its_language(study: Study, where: Where) -> AbstractContextManager[None]:
    """Use the language of the study's documents: the one that is asked for, else that of the base's project."""
    found = _catalogues(study, where)
    return speaking(found.language, found)


def untranslated(study: Study, where: Where) -> list[str]:
    """Return which foreign plugins have no texts, or not all, in the language of the study's documents."""
    return lacking(_catalogues(study, where), study.base.kinds.values())


def _catalogues(study: Study, where: Where) -> Catalogues:
    language = where.language or study.base.project.language
    return catalogues_for(language, dict.fromkeys(study.base.kinds.values()), _discovery(where))


def _discovery(where: Where) -> Discovery:
    return Discovery([Path(folder) for folder in where.plugins])


def loaded(study: Path | None, directory: Path, where: Where) -> Study:
    """Return the study of a file, or as it was when the run of the folder was begun."""
    discovery = _discovery(where)
    if study is not None:
        return load_study(study, discovery)
    return load_study(directory / STUDY, discovery, kept(directory))
