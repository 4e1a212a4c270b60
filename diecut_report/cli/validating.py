"""The command ``validate``: what is wrong with configurations and studies, and how a study would run."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli import exit_codes
from diecut_report.cli.given import DASH, from_standard_input
from diecut_report.cli.output import (
    BAD_INPUT,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    common,
    emit,
    emit_lines,
    in_line,
    tell,
    tell_problems,
    without_output,
)
from diecut_report.config import yaml_tree
from diecut_report.config.discovery import Discovery
from diecut_report.config.standard_input import SHOWN
from diecut_report.config.study_files import is_study
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase

if TYPE_CHECKING:
    from diecut_report.config.yaml_tree import Tree
    from diecut_report.study.execution.dry_run import DryRun

STATES = {PASSED: "valid", BAD_INPUT: "bad", PLUGIN_BROKE: "broken"}


@dataclass
class JudgedFile:
    """Hold what is wrong with a file; of a study that was tried also what it would be."""

    shown: str
    problems: tuple[Problem, ...] = ()
    broken: tuple[PluginError, ...] = ()
    tried: DryRun | None = None
    data: dict[str, Any] = field(default_factory=dict)

    @property
    def code(self) -> int:
        """Return the exit code of this file alone."""
        return BAD_INPUT if self.problems else PLUGIN_BROKE if self.broken else PASSED


@click.command(cls=HelpfulCommand, epilog=exit_codes.OF_FILES)
@click.argument("files", metavar="FILE…", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "--dry-run", "tries", is_flag=True,
    help="Of a study also its size, columns and first variant, what the constraints drop, and the time and room that a few variants take.",
)  # fmt: skip
@click.option("--format", "form", default="text", type=click.Choice(["text", "json"]), help="text (default) or json.")
@common
def validate(files: tuple[Path, ...], tries: bool, form: str, folders: tuple[Path, ...], quiet: bool) -> int:
    """Judge configurations and studies without their results; all problems of all files are reported."""
    discovery, judged = Discovery(folders), []
    for file in files:
        found = _judged(file, discovery, tries)
        judged.append(found)
        if form == "text":
            _tell(found, alone=len(files) == 1, quiet=quiet)
    if form == "json":
        emit(json.dumps([_data(each) for each in judged], indent=2, ensure_ascii=False, allow_nan=False) + "\n")
    codes = [each.code for each in judged]
    return BAD_INPUT if BAD_INPUT in codes else max(codes)


def _judged(file: Path, discovery: Discovery, tries: bool) -> JudgedFile:
    shown = SHOWN if file == DASH else str(file)
    try:
        with without_output():
            tree = from_standard_input() if file == DASH else yaml_tree.read(file)
            if not is_study(tree):
                from diecut_report import pipeline
                from diecut_report.design.report_influence import misnamed

                return JudgedFile(shown, broken=pipeline.validate(tree, discovery, misnamed))
            return _study(shown, tree, discovery, tries)
    except UserError as error:
        return JudgedFile(shown, problems=error.problems)


def _study(shown: str, tree: Tree, discovery: Discovery, tries: bool) -> JudgedFile:
    from diecut_report.study.definition.study_file import load_study

    try:
        study = load_study(tree, discovery)
    except PluginError as error:
        return JudgedFile(shown, broken=(error,))
    if not tries:
        return JudgedFile(shown)
    from diecut_report.study.execution.dry_run import dry_run
    from diecut_report.study.execution.dry_run_text import data
    from diecut_report.study.execution.refusals import refuse_empty

    refuse_empty(study)
    found = dry_run(study)
    broken = tuple(PluginError(why, kind) for kind, why in found.measured.broken.items())
    return JudgedFile(shown, broken=broken, tried=found, data=data(found))


def _tell(found: JudgedFile, *, alone: bool, quiet: bool) -> None:
    tell_problems(found.problems)
    tell(str(error) if alone else f"{found.shown}: " + phrase(str(error)) for error in found.broken)
    if found.code == PASSED and not quiet:
        tell([Phrase("{file}: valid", file=in_line(found.shown))])
    if found.tried is not None:
        from diecut_report.study.execution.dry_run_text import lines

        emit_lines(lines(found.tried))


def _data(found: JudgedFile) -> dict[str, Any]:
    problems = [asdict(problem) | {"message": str(problem.message)} for problem in found.problems]
    told = {"file": found.shown, "status": STATES[found.code], "problems": problems}
    return told | {"broken": [str(error) for error in found.broken]} | ({"study": found.data} if found.data else {})
