"""The commands of studies: run one, ask its results, and take one of its variants for a configuration."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from contextlib import closing, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli import output
from diecut_report.cli.checking import WORDS, counted
from diecut_report.cli.options import (
    DASH,
    RESULTS,
    count_option,
    dask_option,
    flag,
    form_option,
    formats_option,
    jobs_option,
    output_file,
    path_of,
    path_option,
    results_folder,
    split,
    study_folder_option,
)
from diecut_report.cli.output import (
    CHECK_FAILED,
    INTERRUPTED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    Line,
    asked_language,
    emit,
    inform,
    is_quiet,
    tell,
)
from diecut_report.config.plugins import Discovery
from diecut_report.files import write_all
from diecut_report.results.conclusion import told_faults
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import say

if TYPE_CHECKING:
    from diecut_report.study.execution.study_run import StudyOutcome

SEPARATORS, DECIMALS, UNITS = ("comma", "semicolon", "tab"), ("point", "comma"), ("si", "display")


def _numbers(_context: click.Context, _option: click.Parameter, given: str) -> list[int]:
    parts = split(given)
    if strange := [part for part in parts if not part.isdecimal()]:
        raise click.BadParameter(say("{given} is not the number of a variant.", given=repr(strange[0])))
    return list(dict.fromkeys(map(int, parts)))


@click.command(cls=HelpfulCommand, epilog=output.OF_STUDY)
@click.argument("study", required=False, type=path_of)
@study_folder_option
@path_option("--resume", metavar="DIR", help="Continue the run in a folder; finished parts are kept.")
@jobs_option
@dask_option
@formats_option(lambda: ("csv", "xlsx"), "", "Also write all variants as csv,xlsx.", may_be_none=True)
@click.option(
    "--chunk-limit",
    "chunk_limit",
    metavar="SECONDS",
    type=click.FloatRange(0),
    help="Time limit for a part of the study, after which it is ended as an error; 0 for none (default: many times the duration of other parts).",
)
@flag("--yes", help="Calculate even a very large sample without confirmation.")
@flag(
    "--strict",
    help="Exit with 1 also where a variant warns, or a check of one is not performed because a key is not given.",
)
def batch(study: Path | None, folder: Path | None, resume: Path | None, jobs: int | None, dask: str | None, formats: list[str],
          chunk_limit: float | None, yes: bool, strict: bool, discovery: Discovery) -> int:  # fmt: skip
    """Calculate all variants of a STUDY, and write them with a summary and full reports of some."""
    from diecut_report.design.findings import with_findings
    from diecut_report.study import command
    from diecut_report.study.analysis.answers import is_doubtful

    target = results_folder(study, folder, resume)
    where = command.Where(jobs, dask, discovery.paths, asked_language(), chunk_limit)
    try:
        with redirect_stdout(sys.stderr), command.Shown(is_quiet()) as shown:
            outcome = command.run(
                study,
                target,
                where,
                resume=resume is not None,
                agreed=yes,
                formats=formats,
                shown=shown,
                finish=with_findings,
            )
    except KeyboardInterrupt:
        template = "stopped; what is finished is kept. Continue with: diecut-report batch --resume {folder}"
        tell([Phrase(template, folder=target)])
        return INTERRUPTED
    inform(_outcome_lines(outcome, target))
    tell(told_broken(outcome.broken, outcome.doubtful, outcome.broken_reports))
    is_failed = outcome.is_failed or (strict and (bool(outcome.doubtful) or is_doubtful(target)))
    return PLUGIN_BROKE if outcome.is_broken else CHECK_FAILED if is_failed else PASSED


def _outcome_lines(outcome: StudyOutcome, target: Path) -> Iterator[Line]:
    from diecut_report.study.definition.constraints import why_dropped

    counts = outcome.counts
    made = len(list((target / "reports").glob("*.pdf")))
    reports = Counted(made, ", and {n} full report in reports/", ", and {n} full reports in reports/")
    written = Phrase("written: {path}, with summary.html and summary.pdf", path=target)
    yield written + reports if made else written
    named = counted({status: counts.get(status, 0) for status in ("pass", "warn", "fail", "error")})
    more = "; the constraints exclude {n} more of the sample{why}"
    dropped = Phrase(more, n=counts["dropped"], why=why_dropped(counts)) if counts.get("dropped") else ""
    count = counts.get("variants", 0)
    yield (Counted(count, "{n} variant: ", "{n} variants: "), *(named or [phrase("none")]), dropped, ".")
    if outcome.has_none:
        yield phrase("No variant can exist; the summary gives the reasons. Vary other inputs, or within other limits.")
    yield from told_slow(outcome.slow, outcome.broken if outcome.is_broken else {})
    yield from outcome.notes


def told_slow(slow: Mapping[str, str], broken: Mapping[str, str]) -> Iterator[str]:
    """Tell by their kinds which plugins were slow, but for those that broke."""
    template = "{kind} does not support arrays and was calculated variant by variant, which is slow: {why}"
    yield from (Phrase(template, kind=kind, why=phrase(why)) for kind, why in slow.items() if kind not in broken)


def told_broken(
    broken: Mapping[str, str], doubtful: Mapping[str, Any], broken_reports: Mapping[str, str]
) -> Iterator[str]:
    """Tell by their kinds which plugins broke, and which have faults in their formulas."""
    broke = "plugin {kind} broke; variants that it broke for are in error, the others are kept: {why}"
    yield from (Phrase(broke, kind=repr(kind), why=phrase(why)) for kind, why in broken.items())
    yield from (line for kind, faults in doubtful.items() for line in told_faults(kind, faults))
    for kind, why in broken_reports.items():
        yield Phrase("plugin {kind} broke {why}", kind=repr(kind), why=phrase(why))


@click.command(cls=HelpfulCommand)
@click.argument("folder", metavar="DIR", type=path_of)
@click.option(
    "--where", metavar="CONDITION", help="Such as \"drive.crank_torque_peak < '40 N*m' and status = 'pass'\"."
)
@click.option("--sort", metavar="COLUMN", help="Sort by a column; -COLUMN for descending order.")
@count_option("--top", least=1, help="Number of variants (default: 20 in a table, otherwise all).")
@click.option("--pick", metavar="LIST", callback=_numbers, default="", help="Only these variants, such as 3, 17, 205.")
@click.option(
    "--columns",
    metavar="LIST",
    callback=lambda _, __, given: split(given) or None,
    default="",
    help="Only these columns, separated by commas.",
)
@flag("--transpose", help="Compare variants: one row per quantity, one column per variant.")
@form_option("table", "csv", "json", "xlsx", help="table, csv, json or xlsx.")
@click.option("-o", "file", metavar="FILE", type=output_file, help="Where to write (default: standard output).")
@click.option(
    "--units", type=click.Choice(UNITS), help="Units in csv, json and xlsx: si (default), or display as in a table."
)
@click.option("--separator", type=click.Choice(SEPARATORS), help="Separator of the values in csv.")
@click.option("--decimal", type=click.Choice(DECIMALS), help="Decimal sign in csv; comma requires another --separator.")
def variants(folder: Path, where: str | None, sort: str | None, top: int | None, pick: list[int], columns: list[str] | None,
             transpose: bool, form: str, file: Path | None, units: str | None, separator: str | None, decimal: str | None,
             discovery: Discovery) -> int:  # fmt: skip
    """Query the stored variants of a study."""
    from diecut_report.study.analysis.answers import Notation, Request, answer, answer_workbook, unfinished
    from diecut_report.study.storage.description import refuse_sources

    _refuse_idle(form, file, {"--units": units, "--separator": separator, "--decimal": decimal})
    asked = Request(where, sort, top, columns, pick)
    notation = Notation(units or "si", separator or "comma", decimal or "point")
    inform(unfinished(folder))
    if file is not None:
        refuse_sources(folder, file)
    if form == "xlsx":
        write_all({Path(str(file)): answer_workbook(folder, asked, notation, transposed=transpose)}, folder / RESULTS)
        return PASSED
    with closing(answer(folder, asked, form, notation, transposed=transpose)) as pieces:
        if file is not None:
            write_all({file: "".join(pieces).encode()}, folder / RESULTS, through=True)
            return PASSED
        for piece in pieces:
            if not emit(piece):  # the reader has seen enough
                break
    return PASSED


def _refuse_idle(form: str, file: Path | None, given: Mapping[str, str | None]) -> None:
    """Refuse options that would do nothing: a user who gives one expects something of it."""
    takes = {"csv": tuple(given), "json": ("--units",), "xlsx": ("--units",), "table": ()}[form]
    for option, value in given.items():
        if value is not None and option not in takes:
            raise click.UsageError(say("{option} does not apply to {form}.", option=option, form=form))
    if form == "xlsx" and file is None:
        raise click.UsageError(say("A workbook is written to a file; name it with -o FILE."))


@click.command(cls=HelpfulCommand)
@click.argument("variant", metavar="DIR#N")
@path_option("-o", "file", required=True, help="Where to write the configuration.")
@count_option("--digits", least=1, most=15, help="Round its values to this number of digits.")
def take(variant: str, file: Path, digits: int | None, discovery: Discovery) -> int:
    """Write a variant of a study as a configuration: the study's base with that variant's values, comments kept."""
    from diecut_report.study.analysis.variant_config import taken_config
    from diecut_report.study.storage.description import refuse_sources

    folder, _, number = variant.rpartition("#")
    if not folder or not number.isdecimal():
        template = "{variant} names no variant; give the folder of a study and a number, as in build/study#17."
        raise click.UsageError(say(template, variant=repr(variant)))
    refuse_sources(Path(folder), file)
    content, found = taken_config(Path(folder), int(number), discovery, digits)
    if file == DASH:
        emit(content.decode())
    else:
        write_all({file: content}, Path(folder) / RESULTS, through=True)
    if not is_quiet():
        judged = {"status": phrase(WORDS[found.status]), "check": found.governing or "–"}
        place = "<stdout>" if file == DASH else file
        tell([say("written: {file}; in the study: {status}, governed by {check}", file=place, **judged)])
        missing = {name: copy for name, copy in found.beside.values() if not (file.parent / name).exists()}
        template = "it names {name}, which is looked up beside it; the study keeps a copy: {copy}"
        tell(say(template, name=name, copy=copy) for name, copy in missing.items())
    return PASSED
