"""The commands for a report that carries its calculation: take it out, verify it, render it again, compare it with another."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli import exit_codes, verdict
from diecut_report.cli.formats import formats_of
from diecut_report.cli.given import output_file, source
from diecut_report.cli.language import asked_language
from diecut_report.cli.output import (
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    common,
    emit,
    tell,
    tell_written,
    without_output,
)
from diecut_report.cli.progress import Progress
from diecut_report.cli.template import template_option
from diecut_report.config.catalogues import spoken_catalogues
from diecut_report.config.discovery import Discovery
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.phrases import Counted, Phrase, phrase
from diecut_report.languages.speech import said, say, speaking

if TYPE_CHECKING:
    from diecut_report.exchange.agreement import Agreement, Difference
    from diecut_report.exchange.carried_results import CarriedResults
    from diecut_report.exchange.verification import Told, Verification
    from diecut_report.report.house_style import HouseStyle

Data = dict[str, Any]
SHOWN = 20  # differences that are told
path_of = click.Path(path_type=Path)


def _drawn() -> tuple[str, ...]:
    from diecut_report.pipeline import DRAWN

    return DRAWN


@click.command(cls=HelpfulCommand)
@click.argument("report", metavar="REPORT", type=path_of)
@click.option("-o", "folder", metavar="DIR", default=".", type=path_of, help="Where to write (default: here).")
@common
def extract(report: Path, folder: Path, folders: tuple[Path, ...], quiet: bool) -> int:
    """Take the configuration and the results out of a REPORT (PDF or HTML), as NAME.yaml and NAME.json."""
    from diecut_report.exchange.extraction import extract as taken

    files = taken(report, folder)
    if not quiet:
        tell_written(files)
    return PASSED


@click.command(cls=HelpfulCommand)
@click.argument("report", metavar="REPORT", type=path_of)
@click.option("--numbers", is_flag=True, help="Hold the numbers alone against it, not the pages, which takes longer.")
@click.option("--trust", metavar="FILE", type=path_of, help="Certificates (PEM) to which signatures must lead.")
@template_option
@common
def verify(
    report: Path, numbers: bool, trust: Path | None, house: HouseStyle | None, folders: tuple[Path, ...], quiet: bool
) -> int:
    """Calculate a REPORT (PDF, HTML or results) again; tell whether program, plugins and every number agree, and who has signed it.

    Exit codes: 0 everything agrees, 1 something does not, 2 the report cannot be read, 3 a plugin broke.
    """
    from diecut_report.design.followed_advice import followed
    from diecut_report.design.report_influence import influenced
    from diecut_report.exchange.carried_results import carried_results
    from diecut_report.exchange.verification import verify as judged
    from diecut_report.study.analysis.assumed import moves

    carried = carried_results(report)
    with Progress(quiet) as progress, without_output():
        found = judged(
            carried,
            Discovery(folders),
            progress,
            moves,
            pages=not numbers,
            trusted=trust,
            house=house,
            follow=followed,
            matter=influenced,
        )
    tell(str(error) for error in found.broken)
    emit("".join(f"{line}\n" for line in _lines(carried, found)))
    return PLUGIN_BROKE if found.broken else PASSED if found.holds else CHECK_FAILED


def _lines(carried: CarriedResults, found: Verification) -> Iterator[str]:
    project = carried.results["project"]
    named = [str(project.get(key) or "") for key in ("title", "document_number", "revision")]
    yield f"{carried.path}: {', '.join(filter(None, named))}"
    yield _line(say("program"), found.program)
    yield from (_line(say("plugins"), told) for told in found.plugins)
    yield _line(say("configuration"), found.config)
    yield _line(say("numbers"), (_numbers(found.agreement), not found.agreement.differences))
    yield from (f"    {_difference(each)}" for each in found.agreement.differences[:SHOWN])
    if len(found.agreement.differences) > SHOWN:
        yield say("    and {n} more", n=len(found.agreement.differences) - SHOWN)
    if found.pages:
        yield _line(say("pages"), found.pages)
    yield from (_line(say("signature"), (each.words, each.holds)) for each in found.signatures)
    if carried.form == "pdf" and not found.signatures:
        yield _line(say("signature"), (phrase("none: the report is not signed"), True))
    yield say("Everything agrees.") if found.holds else say("Not everything agrees.")


def _line(what: str, told: Told) -> str:
    words, good = told
    return f"{'✓' if good else '✗'} {what:13}  {said(words)}"


def _numbers(found: Agreement) -> str:
    agreeing = found.numbers - found.differing
    some = Phrase("{n} of them exactly", n=found.exact)
    exactly = phrase("all of them exactly") if found.exact == found.numbers else some
    if not found.differences:
        return Phrase("{n} of {total} agree, {exactly}", n=found.numbers, total=found.numbers, exactly=exactly)
    others = len(found.differences) - found.differing
    texts = Counted(others, ", and {n} other value differs", ", and {n} other values differ") if others else ""
    words = "{n} of {total} agree{texts}; in the report, and calculated now:"
    return Phrase(words, n=max(agreeing, 0), total=found.numbers, texts=texts)


def _difference(each: Difference) -> str:
    return f"{each.path}: {_value(each.first)} → {_value(each.second)}"


def _value(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, dict | list):
        return say("a block of keys") if isinstance(value, dict) else say("a list of {n}", n=len(value))
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return text if len(text) <= 80 else f"{text[:80]}…"


@click.command(cls=HelpfulCommand, epilog=exit_codes.OF_CHECKS)
@click.argument("results", metavar="RESULTS.json", type=path_of)
@click.option("-o", "folder", metavar="DIR", default=".", type=path_of, help="Where to write (default: here).")
@click.option(
    "--format",
    "formats",
    metavar="LIST",
    default="html,pdf",
    callback=formats_of(_drawn),
    help="html,pdf (default), also docx,xlsx.",
)
@template_option
@verdict.strict_option
@common
def render(
    results: Path,
    folder: Path,
    formats: list[str],
    house: HouseStyle | None,
    strict: bool,
    folders: tuple[Path, ...],
    quiet: bool,
) -> int:
    """Make the report of a results file again, without calculating."""
    from diecut_report.exchange.rendering import render as rendered
    from diecut_report.exchange.rendering import told

    with Progress(quiet) as progress, redirect_stdout(sys.stderr):
        discovery = Discovery(folders)
        outcome, lost = rendered(results, folder, formats, progress, discovery, asked_language(), house)
    tell((*told(lost), *outcome.warnings))
    if not quiet:
        tell_written(outcome.written)
        tell(verdict.told(outcome.results, discovery))
    is_broken = bool(lost) or outcome.results["status"] == "error"
    return verdict.exit_code(outcome.results, is_broken=is_broken, is_strict=strict)


@click.command(cls=HelpfulCommand)
@click.argument("old", metavar="OLD", type=path_of)
@click.argument("new", metavar="NEW", type=path_of)
@click.option(
    "--format", "form", default="text", type=click.Choice(["text", "json", "html"]), help="text, json or html."
)
@click.option("-o", "target", metavar="FILE", type=output_file, help="Write to a file, not to standard output.")
@click.option("--all", "all_rows", is_flag=True, help="Show as text all that changed, not the most important alone.")
@common
def diff(
    old: Path, new: Path, form: str, target: Path | None, all_rows: bool, folders: tuple[Path, ...], quiet: bool
) -> int:
    """Tell what changed from OLD to NEW: each a configuration, a results file, a report, or a variant of a study (DIR#N).

    Exit codes are those of NEW: 0 no check fails, 1 a check fails, 3 a plugin broke; 2 where one of the two cannot be read.
    """
    from diecut_report.exchange.sides import side
    from diecut_report.results.changes import changes

    with Progress(quiet) as progress, without_output():
        discovery = Discovery(folders)
        sides = [side(source(given, discovery), discovery, progress) for given in (old, new)]
        found = changes(sides[0][0], sides[1][0])
        text = _changes(found, [results for results, _ in sides], discovery, form, all_rows)
    tell(str(error) for _, broken in sides for error in broken)
    if target is None:
        emit(text)
    else:
        from diecut_report.files import write_all

        write_all({target: text.encode(errors="backslashreplace")}, keep=new)
    is_broken = any(broken for _, broken in sides) or sides[1][0]["status"] == "error"
    return verdict.exit_code(sides[1][0], is_broken=is_broken, is_strict=False)


def _changes(found: Data, sides: list[Data], discovery: Discovery, form: str, all_rows: bool) -> str:
    """The changes in a format: as JSON neutral, as a page in the language that is asked for, else in that of the new project."""
    old, new = sides
    if form == "json":
        return json.dumps(found, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    from diecut_report.exchange.changes_text import lines, said_changes

    if form == "html":
        from diecut_report.exchange.changes_page import page

        with speaking(asked_language() or new["project"].get("language") or SOURCE_LANGUAGE):
            return page(said_changes(found, old, new, spoken_catalogues(discovery)))
    told = said_changes(found, old, new, spoken_catalogues(discovery))
    return "".join(f"{line}\n" for line in lines(told, all_rows=all_rows))
