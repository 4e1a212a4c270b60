"""The command ``batch``: a study from its file to its folder, with progress, reports of some variants, and the summary."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diecut_report.batch.description import Source
from diecut_report.batch.export import export
from diecut_report.batch.refusals import refuse_empty, refuse_huge
from diecut_report.batch.reports import write_reports
from diecut_report.batch.run import Counts, Outcome, Where, run_study
from diecut_report.batch.store import Store
from diecut_report.batch.study import Study, load_study
from diecut_report.batch.summary import summarise
from diecut_report.discovery import Discovery
from diecut_report.errors import Problem, UserError

if TYPE_CHECKING:
    from rich.progress import Progress

__all__ = ["Shown", "Where", "run"]


class Shown:
    """How far a run is, on a terminal: done and all, rate, time left, failures so far; silent in pipes."""

    def __init__(self, quiet: bool) -> None:
        self.is_quiet = quiet or not sys.stderr.isatty()
        self.bar: Progress | None = None
        self.task: Any = None

    def __enter__(self) -> Shown:
        if not self.is_quiet:
            self.bar = _bar()
            self.bar.start()
            self.task = self.bar.add_task("variants", total=None, told="")
        return self

    def __exit__(self, *_: object) -> None:
        if self.bar is not None:
            self.bar.stop()

    def __call__(self, counts: Counts) -> None:
        if self.bar is not None:
            told = f"{counts.failed} fail" + (f", {counts.errors} in error" if counts.errors else "")
            self.bar.update(self.task, total=counts.rows, completed=counts.before + counts.done, told=told)

    def doing(self, what: str) -> None:
        """What is done after the variants."""
        if self.bar is not None:
            self.bar.update(self.task, told=what)


def _bar() -> Progress:
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        ProgressColumn,
        Task,
        TextColumn,
        TimeRemainingColumn,
    )
    from rich.text import Text

    class Rate(ProgressColumn):
        """Variants a second."""

        def render(self, task: Task) -> Text:
            return Text(f"{task.speed:.0f}/s" if task.speed else "")

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), Rate(), TimeRemainingColumn())
    return Progress(*columns, TextColumn("{task.fields[told]}"), console=Console(stderr=True))


def run(
    study: Path | None,
    directory: Path,
    where: Where,
    *,
    resume: bool,
    agreed: bool,
    formats: Sequence[str],
    shown: Shown,
) -> Outcome:
    """Run a study, or continue the one of a folder; then reports, summary and the other formats."""
    with _loaded(study, directory, where) as known:
        refuse_huge(known, agreed)
        refuse_empty(known)
        outcome = run_study(known, directory, where, resume=resume, tell=shown)
        told = write_reports(known, outcome.store, where.plugins, agreed=agreed, tell=shown.doing)
    shown.doing("summary")
    with outcome.store.lock():
        export(outcome.store, formats)
        summarise(directory)
    return replace(outcome, notes=(*filter(None, [known.sample.note]), *told))


@contextmanager
def _loaded(study: Path | None, directory: Path, where: Where) -> Iterator[Study]:
    """The study of a file, or as it was when the run of the folder was begun."""
    discovery = Discovery([Path(folder) for folder in where.plugins])
    if study is not None:
        yield load_study(study, discovery)
        return
    kept = Store.open(directory).description
    with tempfile.TemporaryDirectory() as place:
        for source in (kept.study, kept.base, *kept.tables):
            copy = Path(place) / source.file
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(_content(source, directory))
        yield load_study(Path(place) / kept.study.file, discovery)


def _content(source: Source, directory: Path) -> bytes:
    if source.content is None:
        words = f"The copy of {source.file} is missing or has changed; continue with the study itself: batch STUDY --resume {directory}."
        raise UserError(Problem(words, str(directory)))
    return source.content
