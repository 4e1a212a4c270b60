"""How much of the results a report holds, and of which mechanisms."""

from __future__ import annotations

import ctypes.util
import logging
import os
import sys
import tempfile
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from diecut_report.results.conclusion import RANK, governing, rejudged, summary, summary_of
from diecut_report.results.mechanism_record import ExportRecord, MechanismRecord
from diecut_report.results.model import OpenRecord, ResultsRecord
from diecut_report.text.phrases import phrase

BRIEF, STANDARD, FULL = "brief", "standard", "full"


@dataclass(frozen=True)
class Scope:
    """Hold what is reported, at which detail, under which letters; and what is told of the mechanisms that are left out."""

    results: ResultsRecord
    detail: str
    letters: Mapping[str, str]
    total: int
    verdict: str  # on the whole press

    @property
    def is_part(self) -> bool:
        """Whether mechanisms are left out."""
        return len(self.results.mechanisms) < self.total


def scope(results: ResultsRecord) -> Scope:
    """Return what the results ask to be reported (``report``: its detail, and the mechanisms that alone are shown)."""
    letters = {name: letter(index) for index, (name, _) in enumerate(parts(results))}
    known = results.with_(summary=summary_of(results))
    shown = _only(known, results.report.only) if results.report.only else known
    return Scope(shown, results.report.detail, letters, len(results.mechanisms), str(known.summary.verdict))


def parts(results: ResultsRecord) -> Iterator[tuple[str, MechanismRecord]]:
    """What the chapters are of, with their names: all mechanisms, then all comparisons between them."""
    yield from results.mechanisms.items()
    yield from results.comparisons.items()


def letter(index: int) -> str:
    """A chapter's letter: A … Z, AA …"""
    return ("" if index < 26 else letter(index // 26 - 1)) + chr(ord("A") + index % 26)


def _only(results: ResultsRecord, names: list[str]) -> ResultsRecord:
    """Return the results of some mechanisms, with a verdict of their own; comparisons stay where all their mechanisms do."""
    mechanisms = {name: data for name, data in results.mechanisms.items() if name in names}
    compared = results.comparisons
    comparisons = {name: data for name, data in compared.items() if set(data.between) <= mechanisms.keys()}
    checks, whole = {name: data.checks for name, data in mechanisms.items()}, results.summary
    assumed = [path for path in whole.assumed if _is_of(path, mechanisms)]
    taken, owner, why = [*_taken(mechanisms, assumed)], results.project.prepared_by, phrase("it is assumed")
    left = [each for each in whole.open if _is_of(each.path, mechanisms)]
    is_open = any(each.what == "assumed" for each in whole.open)  # else all that it rests on is harmless
    left += [OpenRecord(what="assumed", path=path, owner=owner, why=why) for path in taken if is_open]
    found = results.with_(
        mechanisms=mechanisms,
        comparisons=comparisons,
        comparisons_left_out=None,
        drive_line=None,
        governing=governing(checks),
        status=max((data.status for data in mechanisms.values()), key=RANK.__getitem__),
        summary=summary(checks, [*assumed, *taken]).with_(open=left, verdict=whole.verdict, parts=whole.parts),
    )
    return found.with_(summary=rejudged(found))


def _is_of(path: str, mechanisms: Collection[str]) -> bool:
    """Whether an input is of these mechanisms, or of the press."""
    return not path.startswith("mechanisms.") or path.split(".")[1] in mechanisms


def _taken(mechanisms: Mapping[str, MechanismRecord], assumed: list[str]) -> Iterator[str]:
    """The inputs that rest on what is assumed of mechanisms that are left out; of an expression, which names no giver, where nothing else is."""
    for name, data in mechanisms.items():
        for key, row in data.inputs.items():
            path, giver = f"mechanisms.{name}.{key}", row.path.split(".")[0]
            is_left_out = giver not in {"press", *mechanisms} if giver else not assumed
            if row.basis == "assumed" and path not in assumed and is_left_out:
                yield path


# Libraries imported apart from what surrounds the program: what lies in the current folder or is set for a notebook is not theirs.
#
# Matplotlib reads its settings while it is imported, those of the current folder first; a setting may start LaTeX, or make other
# figures. WeasyPrint's search for its libraries starts a compiler where a name is not found at once.


@contextmanager
def settings_of_its_own() -> Iterator[None]:
    """Import Matplotlib with nothing but the settings that it comes with; the user's backend, of a notebook too, stays for what they draw.

    It looks for a ``matplotlibrc`` in the current folder before all others, so that is the folder of its own meanwhile. Where it cannot write
    into the user's folders, it would tell that at each start, and leave one among the temporary files: the command line ends without its help.
    """
    spec = find_spec("matplotlib")
    assert spec is not None and spec.submodule_search_locations
    own = Path(spec.submodule_search_locations[0]) / "mpl-data"
    before = {name: os.environ.get(name) for name in ("MPLBACKEND", "MPLCONFIGDIR")}
    temporary = tempfile.tempdir
    logger = logging.getLogger("matplotlib")
    level = logger.level
    os.environ.pop("MPLBACKEND", None)  # nothing here needs one, and one that cannot be loaded ends the import
    logger.setLevel(logging.ERROR)
    try:
        with _inside(own), TemporaryDirectory(prefix="diecut-report-") as tempfile.tempdir:
            yield
        if "matplotlib" in sys.modules and before["MPLBACKEND"]:
            with suppress(ValueError):
                sys.modules["matplotlib"].rcParams["backend"] = before["MPLBACKEND"]
    finally:
        logger.setLevel(level)
        tempfile.tempdir = temporary
        for name, value in before.items():
            os.environ.pop(name, None)
            os.environ |= {} if value is None else {name: value}


@contextmanager
def _inside(folder: Path) -> Iterator[None]:
    """Make a folder the current one; the one before may have been deleted, or be closed to reading."""
    before = os.open(".", getattr(os, "O_PATH", os.O_RDONLY))
    try:
        os.chdir(folder)
        yield
    finally:
        os.fchdir(before)
        os.close(before)


@contextmanager
def no_compiler() -> Iterator[None]:
    """Import what loads system libraries without the search by ``gcc`` and ``ld``.

    On Linux the loader finds a library by its file name, which is among the names that are tried; elsewhere no compiler is asked.
    """
    search = ctypes.util.find_library
    if sys.platform == "linux":
        ctypes.util.find_library = lambda name: None
    try:
        yield
    finally:
        ctypes.util.find_library = search


# Files that are written beside a report, by what the results say of them.


def suffixes(instance: str, export: ExportRecord) -> dict[str, str]:
    """What follows the report's name in the names of an export's files, by their endings: ``feeder.cam_1.dxf``; a table has no drawing."""
    endings = ("csv",) if export.type == "table" else ("dxf", "csv")
    return {ending: f"{instance}.{export.id}.{ending}" for ending in endings}
