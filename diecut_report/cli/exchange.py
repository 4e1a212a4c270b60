"""The commands for a report that carries its calculation: take it out, verify it, render it again, compare it with another."""

from __future__ import annotations

import json
import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

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
    as_lines,
    common,
    emit,
    emit_lines,
    tell,
    tell_written,
    without_output,
)
from diecut_report.cli.progress import Progress
from diecut_report.cli.template import template_option
from diecut_report.cli.verification_lines import verification_lines
from diecut_report.config.catalogues import spoken_catalogues
from diecut_report.config.discovery import Discovery
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.speech import speaking

if TYPE_CHECKING:
    from diecut_report.exchange.carried_results import CarriedResults
    from diecut_report.exchange.verification import Verification
    from diecut_report.report.house_style import HouseStyle

Data = dict[str, Any]
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


previous_option = click.option(
    "--previous",
    metavar="FILE",
    type=path_of,
    help="The former report, results, configuration or variant, since which the report shows changes.",
)


class HeldAgainst(NamedTuple):
    """What a report is held against beside its configuration."""

    house: HouseStyle | None = None
    previous: Path | None = None
    trusted: Path | None = None
    pages: bool = True


@click.command(cls=HelpfulCommand)
@click.argument("report", metavar="REPORT", type=path_of)
@click.option("--numbers", is_flag=True, help="Hold the results alone against it, not the pages, which takes longer.")
@click.option("--trust", metavar="FILE", type=path_of, help="Certificates (PEM) to which signatures must lead.")
@previous_option
@template_option
@common
def verify(
    report: Path, numbers: bool, trust: Path | None, previous: Path | None, house: HouseStyle | None, folders: tuple[Path, ...],
    quiet: bool,
) -> int:  # fmt: skip
    """Calculate a REPORT (PDF, HTML or results) again; tell whether all that it shows comes out again, and who has signed it.

    Exit codes: 0 everything agrees, 1 something does not or is not proved, 2 the report cannot be read, 3 a plugin broke.
    """
    carried, found = verified(report, HeldAgainst(house, previous, trust, not numbers), Discovery(folders), quiet)
    tell(str(error) for error in found.broken)
    emit_lines(verification_lines(carried, found))
    return PLUGIN_BROKE if found.broken else PASSED if found.holds else CHECK_FAILED


def verified(
    report: Path, asked: HeldAgainst, discovery: Discovery, quiet: bool
) -> tuple[CarriedResults, Verification]:  # fmt: skip
    """Return what a report carries, and what was found of it."""
    from diecut_report.design.followed_advice import followed
    from diecut_report.design.report_influence import influenced
    from diecut_report.exchange.carried_results import carried_results
    from diecut_report.exchange.recalculation import ReportParts
    from diecut_report.exchange.sides import side
    from diecut_report.exchange.verification import verify as judged
    from diecut_report.study.analysis.assumed import moves

    carried, parts = carried_results(report), ReportParts(moves, followed, influenced)
    with Progress(quiet) as progress, without_output():
        given = None if asked.previous is None else source(asked.previous, discovery)
        former = None if given is None else side(given, discovery, progress)[0]
        found = judged(carried, discovery, progress, parts, pages=asked.pages, trusted=asked.trusted, house=asked.house,
                       previous=former)  # fmt: skip
    return carried, found


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
    return as_lines(lines(told, all_rows=all_rows))
