"""The configuration and the results of a report as files again. Their names are the report's own, whatever stands in it."""

from __future__ import annotations

import os
from pathlib import Path

from diecut_report.errors import Problem, UserError
from diecut_report.exchange.carried_results import carried_results
from diecut_report.files import write_all
from diecut_report.given_files import content


def extract(report: Path, folder: Path) -> list[Path]:
    """Write ``STEM.yaml`` and ``STEM.json`` of a report into a folder; the files. One that is there with another content is kept.

    UserError where the report carries nothing that can be read, or where it would write over something.
    """
    found = carried_results(report)
    contents = {".yaml": found.config_content, ".json": found.results_content}
    files = {folder / f"{report.stem}{ending}": each for ending, each in contents.items()}
    others = [path for path, each in files.items() if os.path.lexists(path) and not _is_same(path, each)]
    if others:
        words = "There is another file of this name. It is not written over: choose another folder with -o."
        raise UserError([Problem(words, str(path)) for path in others])
    write_all({path: each for path, each in files.items() if not os.path.lexists(path)}, keep=report)
    return list(files)


def _is_same(path: Path, wanted: bytes) -> bool:
    return path.is_file() and path.stat().st_size == len(wanted) and content(path, len(wanted), "a file") == wanted
