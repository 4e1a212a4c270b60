"""Configurations calculated side by side on all cores: of each its results, or what is wrong with it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Any

from diecut_report.config import yaml_tree
from diecut_report.config.discovery import Discovery
from diecut_report.config.study_files import is_study
from diecut_report.config.yaml_tree import Tree
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.execution.engines import Engine, InProcess, Pool, Warm, results
from diecut_report.study.execution.process_settings import settle

ENDINGS = (".yaml", ".yml")
MOST = 10_000  # machines of one check
UNUSED = ("curves", "sections", "figures", "exports", "values", "assumptions", "sources", "errata", "absent", "lists")
BAD, BROKEN = "bad", "error"  # states beside pass, warn and fail: the file is bad, a plugin broke


@dataclass
class CheckedMachine:
    """Hold what came out of a configuration: its results without curves and print, and the words of what is wrong with it."""

    file: str
    status: str
    results: dict[str, Any] = field(default_factory=dict)
    words: list[str] = field(default_factory=list)

    @property
    def mechanisms(self) -> Mapping[str, Any]:
        """Return the results of its mechanisms."""
        found: Mapping[str, Any] = self.results.get("mechanisms", {})
        return found


@dataclass
class FoundFiles:
    """Hold the files to calculate, and those of folders that are passed over, each with why."""

    files: list[Path] = field(default_factory=list)
    passed_over: dict[Path, str] = field(default_factory=dict)

    def look_into(self, folder: Path) -> None:
        """Take all configurations of a folder, by name; studies and other YAML files are passed over."""
        for path in sorted(path for path in folder.rglob("*") if path.suffix in ENDINGS and path.is_file()):
            why = _why_no_configuration(path)
            if why:
                self.passed_over[path] = why
            else:
                self.files.append(path)


def configurations(given: Sequence[Path]) -> FoundFiles:
    """Return the files to calculate: those named, and of folders all configurations; UserError where there are none."""
    made = FoundFiles()
    for path in given:
        if os.path.isdir(path):
            made.look_into(path)
        else:
            made.files.append(path)
    found = made.files = list(dict.fromkeys(made.files))
    if not found:
        words = Phrase(
            "There is no configuration in {given}. Name files, or folders with .yaml files.",
            given=", ".join(map(str, given)),
        )
        others = [Problem(Phrase("passed over: {why}", why=why), str(path)) for path, why in made.passed_over.items()]
        raise UserError([Problem(words), *others])
    if len(found) > MOST:
        words = Phrase(
            "These are {count} configurations; at most {most} are checked at once.", count=len(found), most=MOST
        )
        raise UserError(Problem(words))
    return made


def _why_no_configuration(path: Path) -> str:
    """Why a file of a folder is not meant, empty where it is: also one that cannot be read, so that its fault is told."""
    try:
        tree = yaml_tree.load(path)
    except UserError:
        return ""
    if isinstance(tree.data, dict) and "mechanisms" in tree.data:
        return ""
    if is_study(tree):
        return phrase("it is a study, which batch calculates")
    return phrase("it has no key mechanisms, and so is not a configuration")


def machines(
    files: Sequence[Path | Tree], folders: Sequence[str], jobs: int | None = None
) -> Iterator[tuple[int, CheckedMachine]]:
    """Yield each configuration's number and what came out, in the order in which they are ready."""
    warm = Warm(sha256(repr((folders, os.getcwd())).encode()).hexdigest(), _loaded, (tuple(folders),))
    count = min(jobs or os.cpu_count() or 1, len(files))
    engine: Engine = Pool(count, warm) if count > 1 else InProcess(warm)
    chunks = [(number, given if isinstance(given, Tree) else str(given)) for number, given in enumerate(files)]
    with engine:
        for (number, _), made in results(engine, calculated, chunks):
            yield number, made


def _loaded(folders: tuple[str, ...]) -> Discovery:
    settle()
    return Discovery(tuple(map(Path, folders)))


def calculated(discovery: Discovery, chunk: tuple[int, str | Tree]) -> CheckedMachine:
    """Return what comes out of a file, or of what was read of it."""
    from diecut_report import pipeline

    given = chunk[1] if isinstance(chunk[1], Tree) else Path(chunk[1])
    file = given.file if isinstance(given, Tree) else str(given)
    try:
        with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere):  # a plugin may print
            outcome, _ = pipeline.calc(given, discovery, lambda _: None)
    except UserError as error:
        return CheckedMachine(file, BAD, {}, [str(problem) for problem in _all_faults(given, discovery, error)])
    status = BROKEN if outcome.broken else str(outcome.results["status"])
    return CheckedMachine(file, status, _lean(outcome.results), [*map(str, outcome.broken), *outcome.warnings])


def _all_faults(given: Path | Tree, discovery: Discovery, error: UserError) -> Sequence[Problem]:
    """All that is wrong with a file: calculating stops at the first kind of it."""
    from diecut_report import pipeline

    try:
        pipeline.validate(given, discovery)
    except UserError as more:
        return more.problems
    return error.problems


def _lean(whole: dict[str, Any]) -> dict[str, Any]:
    """Results without what a comparison does not show, so that they travel fast between processes."""
    kept = {
        name: {key: part for key, part in data.items() if key not in UNUSED}
        for name, data in whole["mechanisms"].items()
    }
    config = {key: part for key, part in whole["config"].items() if key in ("file", "sha256")}
    return {**whole, "config": config, "mechanisms": kept, "comparisons": {}}
