"""The commands ``validate`` and ``check``, which look at many files, and the verdict with the exit code that follows from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli import output
from diecut_report.cli.options import (
    DASH,
    form_option,
    formats_option,
    from_standard_input,
    jobs_option,
    path_of,
    path_option,
    strict_option,
)
from diecut_report.cli.output import (
    BAD_INPUT,
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    Line,
    Progress,
    asked_language,
    coloured,
    common,
    emit_json,
    emit_lines,
    in_line,
    inform,
    tell,
    tell_problems,
    tell_written,
    without_output,
)
from diecut_report.config import yaml
from diecut_report.config.catalogues import catalogues_for, spoken_catalogues
from diecut_report.config.loader import SHOWN, is_study
from diecut_report.config.plugins import Discovery
from diecut_report.errors import MAX_SHOWN, PluginError, Problem, UserError, refusal
from diecut_report.results.conclusion import conclusion, doubtful_kinds, is_open
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Counted, Phrase, cell, phrase
from diecut_report.text.translation import localised, said, say, say_counted, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.config.yaml import Tree
    from diecut_report.study.execution.dry_run import DryRun
    from diecut_report.study.machines import CheckedMachine, Verdict


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


@click.command(cls=HelpfulCommand, epilog=output.OF_FILES)
@click.argument("files", metavar="FILE…", nargs=-1, required=True, type=path_of)
@click.option(
    "--dry-run", "tries", is_flag=True,
    help="For a study also report its size, columns and first variant, what the constraints exclude, and the time and disk space measured on a "
         "few variants.",
)  # fmt: skip
@form_option("text", "json")
@common
def validate(files: tuple[Path, ...], tries: bool, form: str, discovery: Discovery) -> int:
    """Validate configurations and studies without calculating; all problems of all files are reported."""
    judged = []
    for file in files:
        found = _judged(file, discovery, tries)
        judged.append(found)
        if form == "text":
            _tell(found, alone=len(files) == 1)
    if form == "json":
        emit_json([_data(each) for each in judged])
    codes = [each.code for each in judged]
    return BAD_INPUT if BAD_INPUT in codes else max(codes)


def _judged(file: Path, discovery: Discovery, tries: bool) -> JudgedFile:
    shown = SHOWN if file == DASH else str(file)
    try:
        with without_output():
            tree = from_standard_input() if file == DASH else yaml.read(file)
            if not is_study(tree):
                from diecut_report.design.influence import misnamed
                from diecut_report.press import Press

                return JudgedFile(shown, broken=Press.validate(tree, discovery, misnamed))
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
    from diecut_report.study.execution.dry_run import data, dry_run
    from diecut_report.study.execution.study_run import refuse_empty

    refuse_empty(study)
    found = dry_run(study)
    broken = tuple(PluginError(why, kind) for kind, why in found.measured.broken.items())
    return JudgedFile(shown, broken=broken, tried=found, data=data(found))


def _tell(found: JudgedFile, *, alone: bool) -> None:
    tell_problems(found.problems)
    tell(str(error) if alone else f"{found.shown}: " + phrase(str(error)) for error in found.broken)
    if found.code == PASSED:
        inform([Phrase("{file}: valid", file=in_line(found.shown))])
    if found.tried is not None:
        from diecut_report.study.execution.dry_run import lines

        emit_lines(lines(found.tried))


def _data(found: JudgedFile) -> dict[str, Any]:
    problems = [asdict(problem) | {"message": str(problem.message)} for problem in found.problems]
    told = {"file": found.shown, "status": STATES[found.code], "problems": problems}
    return told | {"broken": [str(error) for error in found.broken]} | ({"study": found.data} if found.data else {})


ORDER = ("fail", "warn", "not_checked")
COLOURED = {"bad": "error", "incomplete": "warn"}  # states with the colour of another one
WORDS = {
    "pass": phrase("pass"),
    "incomplete": phrase("conditional"),
    "warn": phrase("warn"),
    "fail": phrase("fail"),
    "error": phrase("error"),
    "skipped": phrase("skipped"),
    "not_checked": phrase("not checked"),
    "bad": phrase("bad file"),
}


def exit_code(results: ResultsRecord, *, is_broken: bool, is_strict: bool) -> int:
    """Return 3 where something broke, 1 where a check fails or something is skipped, or, strict, where one warns or is not made."""
    if is_broken:
        return PLUGIN_BROKE
    found = results.summary
    counted = ORDER if is_strict else ORDER[:1]
    is_whole = not any(data.status == "skipped" for data in results.mechanisms.values())
    is_doubtful = is_strict and doubtful_kinds(results)
    return PASSED if is_whole and not is_doubtful and not any(found.of(status) for status in counted) else CHECK_FAILED


def verdict_lines(results: ResultsRecord, discovery: Discovery | None = None) -> list[Line]:
    """Return the checks that do not pass, in words, the worst first, and the verdict on all; in the language that is spoken.

    ``discovery`` knows where plugins of others have their words.
    """
    if spoken_language() != SOURCE_LANGUAGE:
        from diecut_report.report.text import translated  # with what makes reports, which English does not need

        results = translated(results, spoken_catalogues(discovery))
    left_out = {name: data.error for name, data in results.mechanisms.items() if data.status == "skipped"}
    skipped = [(marked("skipped"), f" {name}: {why}") for name, why in left_out.items()]
    lines = [*_checks(results, "fail"), *skipped, *_checks(results, "warn"), *_checks(results, "not_checked")]
    note = [results.comparisons_left_out.message] if results.comparisons_left_out else []
    return [*lines, *note, _whole(results)]


def _checks(results: ResultsRecord, status: str) -> Iterator[Line]:
    for name, data in results.mechanisms.items():
        for made in data.checks:
            if made.status == status and made.check_class != "numerical":
                yield marked(status), f" {name}: {made.title}. {_message(made)}"


def marked(status: str) -> str:
    """Return a status in words, in its colour."""
    return coloured(said(WORDS.get(status, status)), COLOURED.get(status, status))


def _message(made: CheckRecord) -> str:
    """A check's message; the line of one that is not made begins with these words."""
    message = str(made.message).removeprefix(say("Not checked: "))
    is_key = made.status == "not_checked" and message.startswith(made.missing[0])
    return message if is_key else message[0].upper() + message[1:]


def _whole(results: ResultsRecord) -> Line:
    found = results.summary
    state = "fail" if found.fail else "warn" if is_open(results) else "pass"
    parts = [coloured(said(conclusion(results)), state)]
    if found.governing:
        parts.append(say("Governing: {check}.", check=found.governing))
    if held := found.numerical.passing:
        words = "{n} self-test of the calculation holds.", "{n} self-tests of the calculation hold."
        parts.append(say_counted(held, *words))
    return tuple(part for each in parts for part in (" ", each))[1:]


FORMATS = ("html", "pdf", "xlsx", "csv", "json")
HEADS = (phrase("machine"), phrase("verdict"), phrase("governing check"), phrase("utilisation"), phrase("failed"), phrase("not checked"),
         phrase("warnings"), phrase("assumed"))  # fmt: skip


@click.command(cls=HelpfulCommand, epilog=output.OF_CHECKS)
@click.argument("given", metavar="CONFIG|FOLDER…", nargs=-1, required=True, type=path_of)
@path_option("-o", "folder", metavar="DIR", help="Also write a summary of all machines there.")
@strict_option
@formats_option(lambda: FORMATS, ",".join(FORMATS), "Formats of the summary: html,pdf,xlsx,csv,json or some of them.")
@jobs_option
@common
def check(given: tuple[Path, ...], folder: Path | None, strict: bool, formats: list[str], jobs: int | None,
          discovery: Discovery) -> int:  # fmt: skip
    """Calculate many machines and show a table of their verdicts; folders are searched for configurations."""
    from diecut_report.study.machines import compared, configurations, in_language

    known = configurations(given)
    files = known.files
    read = [from_standard_input() if file == DASH else file for file in files]
    with Progress() as progress, without_output():
        found = _calculated(read, discovery, jobs, progress)
    made = compared(in_language(found, spoken_catalogues(discovery)))
    for verdict in made.verdicts:
        tell(f"{verdict.machine}: " + phrase(line) if verdict.status != "bad" else line for line in verdict.words)
    emit_lines(_table(made.verdicts))
    if folder is not None:
        _write(found, discovery, folder, formats, files)
    inform([*_passed_over(known.passed_over), _counts(made.verdicts)])
    return _code(made.verdicts, strict)


def _calculated(
    files: Sequence[Path | Tree], discovery: Discovery, jobs: int | None, progress: Progress
) -> list[CheckedMachine]:
    from diecut_report.study.machines import machines

    found: dict[int, CheckedMachine] = {}
    progress(Counted(len(files), "calculating {n} machine", "calculating {n} machines"))
    for number, machine in machines(files, discovery.paths, jobs):
        found[number] = machine
        progress(Phrase("calculated {n} of {total} machines", n=len(found), total=len(files)))
    return [found[number] for number in range(len(files))]


def _table(verdicts: Sequence[Verdict]) -> Iterator[str]:
    rows: list[tuple[str, ...]] = [tuple(map(said, HEADS)), *map(_row, verdicts)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(each.ljust(width) for each, width in zip(row, widths, strict=True)).rstrip()


def _row(verdict: Verdict) -> tuple[str, ...]:
    is_stdin = verdict.machine == SHOWN
    machine = verdict.machine if is_stdin else in_line(cell(verdict.machine))  # before its width is taken
    if verdict.status == "bad":
        return machine, said(WORDS["bad"]), "", "", "", "", "", ""
    share = "" if verdict.utilisation is None else localised(f"{100 * verdict.utilisation:.1f} %")
    counts = (verdict.failed, verdict.not_checked, verdict.warnings, verdict.assumed)
    told = said(WORDS[verdict.face])
    told = say("{status}, formulas with faults", status=told) if verdict.formulas_with_faults else told
    return machine, told, verdict.governing, share, *map(str, counts)


def _write(
    found: Sequence[CheckedMachine], discovery: Discovery, folder: Path, formats: list[str], files: Sequence[Path]
) -> None:  # fmt: skip
    """Write the summary, in the language that is asked for, else in that of all projects."""
    from diecut_report.files import write_all
    from diecut_report.study import machine_pages as pages
    from diecut_report.study.machines import compared, in_language, language_of

    language = asked_language() or language_of(found)
    with speaking(language, catalogues_for(language, (), discovery)):
        made = compared(in_language(found, spoken_catalogues(discovery)))
        contents = pages.files(made, folder, formats, compared(found))
    if kept := set(contents) & set(files):
        raise refusal("{file} is one of the configurations, and is not overwritten.", file=min(kept))
    write_all(contents, keep=files[0])
    tell_written(contents)


def _counts(verdicts: Sequence[Verdict]) -> Line:
    states = ("pass", "incomplete", "warn", "fail", "error", "bad")
    found = counted({status: sum(verdict.face == status for verdict in verdicts) for status in states})
    return (Counted(len(verdicts), "{n} machine: ", "{n} machines: "), *found, ".")


def counted(counts: Mapping[str, int]) -> list[str]:
    """Return how many there are of each status, in words and colours: ``3 pass, 1 fail``; of which there are none is not told."""
    there = {status: count for status, count in counts.items() if count}
    return [part for status, count in there.items() for part in (", ", f"{count} ", marked(status))][1:]


def _passed_over(files: Mapping[Path, str]) -> Iterator[str]:
    """Tell which files of folders are not configurations, the first of many."""
    for path, why in islice(files.items(), MAX_SHOWN):
        yield Phrase("{file}: skipped: {why}", file=path, why=why)
    if len(files) > MAX_SHOWN:
        yield Counted(len(files) - MAX_SHOWN, "and {n} more file is skipped", "and {n} more files are skipped")


def _code(verdicts: Sequence[Verdict], strict: bool) -> int:
    states = {verdict.status for verdict in verdicts}
    if "bad" in states:
        return BAD_INPUT
    if "error" in states:
        return PLUGIN_BROKE
    doubtful = any(each.warnings or each.not_checked or each.formulas_with_faults for each in verdicts)
    return CHECK_FAILED if "fail" in states or (strict and doubtful) else PASSED
