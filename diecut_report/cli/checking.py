"""The command ``check``, which calculates many machines."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

import click

from diecut_report.cli import exit_codes
from diecut_report.cli.formats import formats_of
from diecut_report.cli.given import DASH, from_standard_input
from diecut_report.cli.language import asked_language
from diecut_report.cli.output import (
    BAD_INPUT,
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    Line,
    coloured,
    common,
    emit_lines,
    in_line,
    tell,
    tell_written,
    without_output,
)
from diecut_report.cli.progress import Progress
from diecut_report.cli.verdict import WORDS
from diecut_report.config.catalogues import catalogues_for, spoken_catalogues
from diecut_report.config.discovery import Discovery
from diecut_report.config.standard_input import SHOWN as STANDARD_INPUT
from diecut_report.errors import TOLD, Problem, UserError
from diecut_report.languages.phrases import Counted, Phrase, cell, phrase
from diecut_report.languages.speech import localised, said, say, speaking

if TYPE_CHECKING:
    from diecut_report.config.yaml_tree import Tree
    from diecut_report.study.machines.calculation import CheckedMachine
    from diecut_report.study.machines.verdicts import Verdict

FORMATS = ("html", "pdf", "xlsx", "csv", "json")
COLOURED = {"bad": "error", "incomplete": "warn"}  # states with the colour of another one
HEADS = (
    phrase("machine"),
    phrase("verdict"),
    phrase("governing check"),
    phrase("utilisation"),
    phrase("failed"),
    phrase("not checked"),
    phrase("warnings"),
    phrase("assumed"),
)
path_of = click.Path(path_type=Path)


@click.command(cls=HelpfulCommand, epilog=exit_codes.OF_CHECKS)
@click.argument("given", metavar="CONFIG|FOLDER…", nargs=-1, required=True, type=path_of)
@click.option("-o", "folder", metavar="DIR", type=path_of, help="Also write a summary of all machines there.")
@click.option(
    "--strict", is_flag=True, help="Warnings, checks without a limit and plugins with faults count as failed."
)
@click.option(
    "--format",
    "formats",
    metavar="LIST",
    default="html,pdf,xlsx,csv,json",
    callback=formats_of(lambda: FORMATS),
    help="Of the summary: html,pdf,xlsx,csv,json or some of them.",
)
@click.option("--jobs", metavar="N", type=click.IntRange(1), help="Processes (default: one for each core).")
@common
def check(given: tuple[Path, ...], folder: Path | None, strict: bool, formats: list[str], jobs: int | None,
          folders: tuple[Path, ...], quiet: bool) -> int:  # fmt: skip
    """Calculate many machines, side by side, and show a table of their verdicts; folders are searched for configurations."""
    from diecut_report.study.machines.calculation import configurations
    from diecut_report.study.machines.verdicts import compared, in_language

    known = configurations(given)
    files = known.files
    read = [from_standard_input() if file == DASH else file for file in files]
    discovery = Discovery(folders)
    with Progress(quiet) as progress, without_output():
        found = _calculated(read, folders, jobs, progress)
    made = compared(in_language(found, spoken_catalogues(discovery)))
    for verdict in made.verdicts:
        tell(f"{verdict.machine}: " + phrase(line) if verdict.status != "bad" else line for line in verdict.words)
    emit_lines(_table(made.verdicts))
    if folder is not None:
        _write(found, discovery, folder, formats, quiet, files)
    if not quiet:
        tell(_passed_over(known.passed_over))
        tell(_counts(made.verdicts))
    return _code(made.verdicts, strict)


def _calculated(
    files: Sequence[Path | Tree], folders: Sequence[Path], jobs: int | None, progress: Progress
) -> list[CheckedMachine]:
    """What came out of each file, in their order."""
    from diecut_report.study.machines.calculation import machines

    found: dict[int, CheckedMachine] = {}
    progress(Counted(len(files), "calculating {n} machine", "calculating {n} machines"))
    for number, machine in machines(files, [str(path.absolute()) for path in folders], jobs):
        found[number] = machine
        progress(Phrase("calculated {n} of {total} machines", n=len(found), total=len(files)))
    return [found[number] for number in range(len(files))]


def _table(verdicts: Sequence[Verdict]) -> Iterator[str]:
    """The table of verdicts, its columns as wide as they need."""
    rows: list[tuple[str, ...]] = [tuple(map(said, HEADS)), *map(_row, verdicts)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(each.ljust(width) for each, width in zip(row, widths, strict=True)).rstrip()


def _row(verdict: Verdict) -> tuple[str, ...]:
    is_stdin = verdict.machine == STANDARD_INPUT
    machine = verdict.machine if is_stdin else in_line(cell(verdict.machine))  # before its width is taken
    if verdict.status == "bad":
        return machine, said(WORDS["bad"]), "", "", "", "", "", ""
    share = "" if verdict.utilisation is None else localised(f"{100 * verdict.utilisation:.1f} %")
    counts = (verdict.failed, verdict.not_checked, verdict.warnings, verdict.assumed)
    return machine, _status(verdict), verdict.governing, share, *map(str, counts)


def _status(verdict: Verdict) -> str:
    """The verdict in words; one that formulas with faults gave says so."""
    told = said(WORDS[verdict.face])
    return say("{status}, formulas with faults", status=told) if verdict.formulas_with_faults else told


def _write(
    found: Sequence[CheckedMachine], discovery: Discovery, folder: Path, formats: list[str], quiet: bool, files: Sequence[Path]
) -> None:  # fmt: skip
    """Write the summary, in the language that is asked for, else in that of all projects."""
    from diecut_report.files import write_all
    from diecut_report.study.machines import pages
    from diecut_report.study.machines.verdicts import compared, in_language, language_of

    language = asked_language() or language_of(found)
    with speaking(language, catalogues_for(language, (), discovery)):
        made = compared(in_language(found, spoken_catalogues(discovery)))
        contents = dict(pages.files(made, folder, formats, compared(found)))
    if kept := set(contents) & set(files):
        words = Phrase("{file} is one of the configurations, and is not overwritten.", file=min(kept))
        raise UserError(Problem(words))
    write_all(contents, keep=files[0])
    if not quiet:
        tell_written(contents)


def _counts(verdicts: Sequence[Verdict]) -> list[Line]:
    found = [
        (status, sum(v.face == status for v in verdicts))
        for status in ("pass", "incomplete", "warn", "fail", "error", "bad")
    ]
    named = [
        part
        for status, count in found
        if count
        for part in (
            ", ",
            f"{count} ",
            coloured(said(WORDS[status]), COLOURED.get(status, status)),
        )
    ]
    return [(Counted(len(verdicts), "{n} machine: ", "{n} machines: "), *named[1:], ".")]


def _passed_over(files: Mapping[Path, str]) -> Iterator[str]:
    """Tell which files of folders are not configurations, the first of many."""
    for path, why in islice(files.items(), TOLD):
        yield Phrase("{file}: passed over: {why}", file=path, why=why)
    if len(files) > TOLD:
        yield Counted(len(files) - TOLD, "and {n} more file is passed over", "and {n} more files are passed over")


def _code(verdicts: Sequence[Verdict], strict: bool) -> int:
    states = {verdict.status for verdict in verdicts}
    if "bad" in states:
        return BAD_INPUT
    if "error" in states:
        return PLUGIN_BROKE
    doubtful = strict and any(
        verdict.warnings or verdict.not_checked or verdict.formulas_with_faults for verdict in verdicts
    )
    return CHECK_FAILED if "fail" in states or doubtful else PASSED
