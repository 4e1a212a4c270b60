"""The configuration and the results of a report as files again. Their names are the report's own, whatever stands in it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from diecut_report.errors import Problem, UserError
from diecut_report.exchange.carried_results import carried_results
from diecut_report.files import write_all
from diecut_report.given_files import content
from diecut_report.languages.phrases import Phrase, phrase


def extract(report: Path, folder: Path) -> list[Path]:
    """Write ``STEM.yaml`` and ``STEM.json`` of a report into a folder, and the tables and the logo that the configuration names; the files.

    One that is there already stays as it is. UserError where it has another content, or where the report carries nothing that can
    be read.
    """
    found = carried_results(report)
    contents = {f"{report.stem}.yaml": found.config_content, f"{report.stem}.json": found.results_content}
    if doubled := sorted(contents.keys() & found.tables.keys()):
        words = Phrase(
            "The configuration names a file {doubled}, and would be called so itself. Rename the report.",
            doubled=doubled[0],
        )
        raise UserError(Problem(words, str(report)))
    files = {folder / name: each for name, each in (contents | found.tables).items()}
    if problems := list(_refused(files, folder)):
        raise UserError(problems)
    write_all({path: each for path, each in files.items() if not os.path.lexists(path)}, keep=report)
    return list(files)


def _refused(files: Mapping[Path, bytes], folder: Path) -> Iterator[Problem]:
    for path, wanted in files.items():
        if os.path.lexists(path) and not _is_same(path, wanted):
            words = phrase("There is another file of this name. It is not written over: choose another folder with -o.")
            yield Problem(words, str(path))
        elif not Path(os.path.realpath(path.parent)).is_relative_to(os.path.realpath(folder)):
            words = phrase("A link leads out of the folder here, and is not followed: choose another folder with -o.")
            yield Problem(words, str(path))


def _is_same(path: Path, wanted: bytes) -> bool:
    return path.is_file() and path.stat().st_size == len(wanted) and content(path, len(wanted), "a file") == wanted
