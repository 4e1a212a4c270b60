"""The commands ``validate`` and ``check``, which look at many files, and the verdict with the exit code that follows from it."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli import output
from diecut_report.cli.options import (
    DASH,
    flag,
    form_option,
    formats_option,
    from_standard_input,
    jobs_option,
    names_option,
    path_of,
    path_option,
    strict_option,
)
from diecut_report.cli.output import (
    BAD_INPUT,
    CHECK_FAILED,
    FAULT,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    Line,
    Progress,
    asked_language,
    coloured,
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
from diecut_report.config.loader import SHOWN, is_study
from diecut_report.config.plugins import Discovery, catalogues_for, spoken_catalogues
from diecut_report.config.yaml import Tree
from diecut_report.errors import MAX_SHOWN, PluginError, Problem, UserError, own_fault
from diecut_report.files import write_all
from diecut_report.results.conclusion import summary_of
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Counted, Phrase, cell, phrase
from diecut_report.text.translation import localised, said, say, say_counted, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.study.comparison import AskedResults, MachineComparison, Verdict
    from diecut_report.study.execution.dry_run import DryRun
    from diecut_report.study.machines import CheckedMachine


STATES = {PASSED: "valid", BAD_INPUT: "bad", PLUGIN_BROKE: "broken", FAULT: "fault"}


@dataclass
class JudgedFile:
    """Hold what is wrong with a file; of a study that was tried also what it would be."""

    shown: str
    problems: tuple[Problem, ...] = ()
    is_fault: bool = False  # of the program, which its problem says
    broken: tuple[PluginError, ...] = ()
    tried: DryRun | None = None

    @property
    def code(self) -> int:
        """Return the exit code of this file alone."""
        if self.is_fault:
            return FAULT
        return BAD_INPUT if self.problems else PLUGIN_BROKE if self.broken else PASSED


@click.command(cls=HelpfulCommand, epilog=output.OF_FILES)
@click.argument("files", metavar="FILE…", nargs=-1, required=True, type=path_of)
@flag(
    "--dry-run", "tries",
    help="For a study also report its size, columns and first variant, what the constraints exclude, and the time and disk space measured on a "
         "few variants.",
)  # fmt: skip
@form_option("text", "json")
def validate(files: tuple[Path, ...], tries: bool, form: str, discovery: Discovery) -> int:
    """Validate configurations and studies without calculating; all problems of all files are reported."""
    judged = []
    for file in files:
        found = _judged(file, discovery, tries) if len(files) == 1 else _beside_others(file, discovery, tries)
        judged.append(found)
        if form == "text":
            _tell(found, alone=len(files) == 1)
    if form == "json":
        emit_json([_data(each) for each in judged])
    codes = [each.code for each in judged]
    return next((code for code in (FAULT, BAD_INPUT) if code in codes), max(codes))


def _beside_others(file: Path, discovery: Discovery, tries: bool) -> JudgedFile:
    """Judge one of several files: a fault of the program hides none of the others."""
    try:
        return _judged(file, discovery, tries)
    except PluginError:
        raise
    except Exception as fault:
        return JudgedFile(str(file), (Problem(own_fault(fault), str(file)),), is_fault=True)


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
    from diecut_report.study.execution.dry_run import dry_run
    from diecut_report.study.execution.study_run import refuse_empty

    refuse_empty(study)
    found = dry_run(study)
    broken = tuple(PluginError(why, kind) for kind, why in found.measured.broken.items())
    return JudgedFile(shown, broken=broken, tried=found)


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
    told: dict[str, Any] = {"file": found.shown, "status": STATES[found.code], "problems": problems}
    told["broken"] = [str(error) for error in found.broken]
    if found.tried is not None:
        from diecut_report.study.execution.dry_run import data

        told["study"] = data(found.tried)
    return told


WITHOUT_RESULTS = ("bad", "impossible", "fault")
# states with the colour of another one
COLOURED = {"bad": "error", "impossible": "error", "fault": "error", "conditional": "warn"}
WORDS = {
    "pass": phrase("pass"),
    "conditional": phrase("conditional"),
    "warn": phrase("warn"),
    "fail": phrase("fail"),
    "error": phrase("error"),
    "skipped": phrase("skipped"),
    "not_checked": phrase("not checked"),
    "bad": phrase("bad file"),
    "impossible": phrase("impossible machine"),
    "fault": phrase("fault of the program"),
}


def exit_code(results: ResultsRecord, *, is_broken: bool, is_strict: bool) -> int:
    """Return 3 where something broke, 1 where the verdict is fail or, strict, conditional."""
    return PLUGIN_BROKE if is_broken else _exit_code([str(summary_of(results).verdict)], is_strict)


def _exit_code(verdicts: Sequence[str], is_strict: bool) -> int:
    """The exit code of machines by their verdicts, none of which is broken or bad."""
    return CHECK_FAILED if "fail" in verdicts or (is_strict and "conditional" in verdicts) else PASSED


def verdict_lines(results: ResultsRecord, discovery: Discovery) -> list[Line]:
    """Return the checks that do not pass, in words, the worst first, and the verdict on all; in the language that is spoken.

    ``discovery`` knows where plugins of others have their words.
    """
    results = _spoken(results, discovery)
    left_out = {name: data.error for name, data in results.mechanisms.items() if data.status == "skipped"}
    skipped = [(marked("skipped"), f" {name}: {why}") for name, why in left_out.items()]
    lines = [*_checks(results, "fail"), *skipped, *_checks(results, "warn"), *_checks(results, "not_checked")]
    note = [results.comparisons_left_out.message] if results.comparisons_left_out else []
    return [*lines, *note, _whole(results)]


def _spoken(results: ResultsRecord, discovery: Discovery) -> ResultsRecord:
    """Results in the language that is spoken."""
    if spoken_language() == SOURCE_LANGUAGE:
        return results
    from diecut_report.report.text import translated  # with what makes reports, which English does not need

    return translated(results, spoken_catalogues(discovery))


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
    found = summary_of(results)
    verdict = str(found.verdict)
    parts = [coloured(said(found.conclusion), COLOURED.get(verdict, verdict))]
    if found.governing:
        parts.append(say("Governing: {check}.", check=found.governing))
    if held := found.numerical.passing:
        words = "{n} self-test of the calculation holds.", "{n} self-tests of the calculation hold."
        parts.append(say_counted(held, *words))
    return tuple(part for each in parts for part in (" ", each))[1:]


FORMATS = ("html", "pdf", "xlsx", "csv", "json")
HEADS = (phrase("machine"), phrase("verdict"), phrase("governing check"), phrase("utilisation"), phrase("failed"), phrase("not checked"),
         phrase("warnings"), phrase("assumed"))  # fmt: skip
NONE_NAMED = phrase("nothing is named; give names with commas between them.")
given_machines = click.argument("given", metavar="CONFIG|DIR#N|FOLDER…", nargs=-1, required=True, type=path_of)
table_formats = formats_option(
    lambda: FORMATS, ",".join(FORMATS), "Formats of the table: html,pdf,xlsx,csv,json or some of them."
)


@click.command(cls=HelpfulCommand, epilog=output.OF_CHECKS)
@given_machines
@path_option(
    "-o", "folder", metavar="DIR", help="Also write a comparison of all machines there: machines.html and so on."
)
@strict_option
@table_formats
@jobs_option
def check(given: tuple[Path, ...], folder: Path | None, strict: bool, formats: list[str], jobs: int | None,
          discovery: Discovery) -> int:  # fmt: skip
    """Calculate many machines and show a table of their verdicts; folders are searched for configurations."""
    from diecut_report.study.comparison import AskedResults

    found = _found(given, discovery, jobs, AskedResults())
    emit_lines(_table(found.spoken.machines))
    return found.finished(folder, "machines", formats, strict=strict)


@click.command(cls=HelpfulCommand, epilog=output.OF_CHECKS)
@given_machines
@names_option(
    "--show", metavar="OUTPUTS", none=NONE_NAMED,
    help="The results to show, by output, by INSTANCE.OUTPUT, or by the words rate, mass, torque_max, motor, strength, function "
         "(default: these words).",
)  # fmt: skip
@names_option(
    "--units", metavar="LIST", none=NONE_NAMED, help="Units for quantities of their dimensions, such as kN,mm."
)
@path_option("-o", "folder", metavar="DIR", help="Also write the comparison there: comparison.html and so on.")
@table_formats
@jobs_option
def compare(given: tuple[Path, ...], show: tuple[str, ...], units: tuple[str, ...], folder: Path | None,
            formats: list[str], jobs: int | None, discovery: Discovery) -> int:  # fmt: skip
    """Compare machines in one table: verdicts, chosen results, and the inputs that were typed differently.

    Each is a configuration, a variant of a study (DIR#N), or a folder of configurations or of a study's results.
    """
    from diecut_report.study.comparison import SHOWN_WORDS, AskedResults, refuse_units, refuse_unused_units

    refuse_units(units)
    found = _found(given, discovery, jobs, AskedResults(show or tuple(SHOWN_WORDS), units))
    refuse_unused_units(units, [*found.spoken.results, *found.spoken.changes])
    emit_lines(_side_by_side(found.spoken))
    return found.finished(folder, "comparison", formats)


def _side_by_side(made: MachineComparison) -> Iterator[str]:
    from diecut_report.study.comparison import text_table

    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else None
    yield from text_table(made, list(map(_called, made.machines)), width).splitlines()
    yield from [said(made.omitted)] if made.omitted else []


def _called(verdict: Verdict) -> str:
    """Return what a machine is called, as a part of a line; the number of a variant stays outside of quotes."""
    if verdict.machine == SHOWN:
        return SHOWN
    name, mark, number = verdict.machine.rpartition("#")
    return in_line(f"{cell(name)}#{number}" if mark and number.isdecimal() else cell(verdict.machine))


@dataclass
class NamedMachines:
    """Hold what came out of the machines that a command names, and what is asked of them."""

    files: list[Path]
    passed_over: Mapping[Path, str]
    machines: list[CheckedMachine]
    asked: AskedResults
    discovery: Discovery

    @cached_property
    def spoken(self) -> MachineComparison:
        """Return them side by side in the language that is spoken first."""
        return self._compared()

    def _compared(self) -> MachineComparison:
        from diecut_report.study.comparison import compared
        from diecut_report.study.machines import in_language

        machines = in_language(self.machines, spoken_catalogues(self.discovery))
        return compared(machines, self.asked.rows(machines), self.asked.units)

    def finished(self, folder: Path | None, name: str, formats: Sequence[str], *, strict: bool = False) -> int:
        """Write the comparison, if a folder is named, report how many machines there are of each verdict, and return the exit code."""
        if folder is not None:
            self._write(folder, name, formats)
        inform([*_passed_over(self.passed_over), *self._broken_checks(), _counts(self.spoken.machines)])
        return _code(self.spoken.machines, strict)

    def _broken_checks(self) -> Iterator[Line]:
        """The checks of a machine alone that fail or warn, in words: in a table of many they would be lost."""
        if len(self.machines) == 1 and self.machines[0].results:
            results = _spoken(self.machines[0].results, self.discovery)
            yield from (line for status in ("fail", "warn") for line in _checks(results, status))

    def _write(self, folder: Path, name: str, formats: Sequence[str]) -> None:
        """Write the comparison in the language that is asked for, else in that of all projects."""
        from diecut_report.study import comparison_pages as pages
        from diecut_report.study.machines import language_of

        language = asked_language() or language_of(self.machines)
        with speaking(SOURCE_LANGUAGE):
            neutral = self._compared()
        with speaking(language, catalogues_for(language, (), self.discovery)):
            contents = pages.files(self._compared(), folder, name, formats, neutral)
        write_all(contents, keep=self.files)
        tell_written(contents)


def _found(given: Sequence[Path], discovery: Discovery, jobs: int | None, asked: AskedResults) -> NamedMachines:
    """Calculate the machines; what is wrong with one is reported, and the others go on."""
    from diecut_report.study.machines import configurations

    known = configurations(given)
    read = [from_standard_input() if file == DASH else file for file in known.files]
    with Progress() as progress, without_output():
        machines = _calculated(read, discovery, jobs, progress)
    found = NamedMachines(known.files, known.passed_over, machines, asked, discovery)
    for verdict in found.spoken.machines:
        is_bad = verdict.status in WITHOUT_RESULTS  # its messages name the file
        tell(line if is_bad else f"{verdict.machine}: " + phrase(line) for line in verdict.messages)
    return found


def _calculated(
    files: Sequence[Path | Tree], discovery: Discovery, jobs: int | None, progress: Progress
) -> list[CheckedMachine]:
    from diecut_report.design.findings import decided
    from diecut_report.study.machines import machines

    found: dict[int, CheckedMachine] = {}
    progress(Counted(len(files), "calculating {n} machine", "calculating {n} machines"))
    for number, machine in machines(files, discovery.paths, jobs, decided):
        found[number] = machine
        progress(Phrase("calculated {n} of {total} machines", n=len(found), total=len(files)))
    return [found[number] for number in range(len(files))]


def _table(verdicts: Sequence[Verdict]) -> Iterator[str]:
    rows: list[tuple[str, ...]] = [tuple(map(said, HEADS)), *map(_row, verdicts)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(each.ljust(width) for each, width in zip(row, widths, strict=True)).rstrip()


def _row(verdict: Verdict) -> tuple[str, ...]:
    machine = _called(verdict)  # before its width is taken
    if verdict.status in WITHOUT_RESULTS:
        return machine, said(WORDS[verdict.status]), "", "", "", "", "", ""
    share = "" if verdict.utilisation is None else localised(f"{100 * verdict.utilisation:.1f} %")
    counts = (verdict.failed, verdict.not_checked, verdict.warnings, verdict.assumed)
    told = said(WORDS[verdict.verdict])
    told = say("{status}, formulas with faults", status=told) if verdict.formulas_with_faults else told
    return machine, told, verdict.governing, share, *map(str, counts)


def _counts(verdicts: Sequence[Verdict]) -> Line:
    states = ("pass", "conditional", "fail", "error", "impossible", "bad", "fault")
    found = counted({status: sum(verdict.verdict == status for verdict in verdicts) for status in states})
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
    if "fault" in states:
        return FAULT
    if not states.isdisjoint(WITHOUT_RESULTS):
        return BAD_INPUT
    return PLUGIN_BROKE if "error" in states else _exit_code([verdict.verdict for verdict in verdicts], strict)
