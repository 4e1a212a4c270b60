"""The commands for a report that carries its calculation: take it out, verify it, render it again, compare it with another."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING

import click

from diecut_report.cli import checking, output
from diecut_report.cli.options import (
    flag,
    form_option,
    formats_option,
    here_option,
    path_of,
    path_option,
    report_formats,
    source,
    strict_option,
    target_option,
    template_option,
)
from diecut_report.cli.output import (
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    Progress,
    as_json,
    as_lines,
    asked_language,
    emit_lines,
    emit_or_write,
    inform,
    tell,
    tell_written,
    without_output,
)
from diecut_report.config.plugins import Discovery, spoken_catalogues
from diecut_report.errors import Problem, UserError, refusal
from diecut_report.results.model import ChangesRecord, ResultsRecord
from diecut_report.text.phrases import Counted, Phrase, cell, phrase
from diecut_report.text.translation import said, say, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.exchange.carried import CarriedResults
    from diecut_report.exchange.verification import Agreement, Found, Verification
    from diecut_report.report.pages.firm_templates import HouseStyle


SHOWN = 20  # differences that are told


def verification_lines(carried: CarriedResults, found: Verification) -> Iterator[str]:
    """Give what was found of a report line by line, and last whether everything agrees."""
    project = carried.results.project
    named = (project.title, project.document_number, project.revision)
    yield f"{carried.path}: {', '.join(map(cell, filter(None, named)))}"
    yield _line(say("program"), found.program)
    yield from (_line(say("plugins"), told) for told in found.plugins)
    yield _line(say("configuration"), found.config)
    yield from (_line(say("options"), each) for each in found.options)
    yield _line(say("numbers"), (_numbers(found.agreement), not found.agreement.differences))
    for each in found.agreement.differences[:SHOWN]:
        yield f"    {each.path}: {_value(each.first)} → {_value(each.second)}"
    if len(found.agreement.differences) > SHOWN:
        yield say("    and {n} more", n=len(found.agreement.differences) - SHOWN)
    if found.pages:
        yield _line(say("pages"), found.pages)
    elif carried.form != "json":
        yield f"– {say('pages'):13}  {say('not compared, since --numbers asks for the results alone')}"
    yield from (_line(say("signature"), (each.words, each.holds)) for each in found.signatures)
    if carried.form == "pdf" and not found.signatures:
        yield _line(say("signature"), (phrase("none: the report is not signed"), True))
    if not found.holds:
        yield say("Not everything agrees.")
    elif found.pages is None and carried.form != "json":
        yield say("The results agree; the contents of the pages were not compared.")
    else:
        yield say("Everything agrees.")


def _line(what: str, told: Found) -> str:
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
    template = "{n} of {total} agree{texts}; in the report, and calculated now:"
    return Phrase(template, n=max(agreeing, 0), total=found.numbers, texts=texts)


def _value(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, dict | list):
        return say("a block of keys") if isinstance(value, dict) else say("a list of {n}", n=len(value))
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return text if len(text) <= 80 else f"{text[:80]}…"


@click.command(cls=HelpfulCommand)
@click.argument("report", metavar="REPORT", type=path_of)
@here_option
def extract(report: Path, folder: Path, discovery: Discovery) -> int:
    """Extract the configuration and the results from a REPORT (PDF or HTML), as NAME.yaml and NAME.json."""
    from diecut_report.exchange.carried import extract as taken

    files = taken(report, folder)
    tell_written(files)
    return PASSED


previous_option = path_option(
    "--previous",
    help="The previous report, results, configuration or variant to which the changes shown in the report refer.",
)


@click.command(cls=HelpfulCommand)
@click.argument("report", metavar="REPORT", type=path_of)
@flag("--numbers", help="Compare only the results, not the pages, which takes longer.")
@path_option("--trust", help="Certificates (PEM) to which signatures must lead.")
@previous_option
@template_option
def verify(
    report: Path, numbers: bool, trust: Path | None, previous: Path | None, house: HouseStyle | None, discovery: Discovery
) -> int:  # fmt: skip
    """Recalculate a REPORT (PDF, HTML or results); report whether everything it shows is reproduced, and who has signed it.

    Exit codes: 0 everything agrees, 1 something does not or is not proved, 2 the report cannot be read, 3 a plugin broke.
    """
    carried, found = verified(report, discovery, house, previous, trust, pages=not numbers)
    tell(str(error) for error in found.broken)
    emit_lines(verification_lines(carried, found))
    return PLUGIN_BROKE if found.broken else PASSED if found.holds else CHECK_FAILED


def verified(
    report: Path, discovery: Discovery, house: HouseStyle | None, previous: Path | None,
    trusted: Path | None = None, *, pages: bool = True,
) -> tuple[CarriedResults, Verification]:  # fmt: skip
    """Return what a report carries, and what was found of it."""
    from diecut_report.exchange.carried import carried_results
    from diecut_report.exchange.rendering import side
    from diecut_report.exchange.verification import verify as judged

    carried = carried_results(report)
    with Progress() as progress, without_output():
        former = None if previous is None else side(source(previous, discovery), discovery, progress)[0]
        found = judged(carried, discovery, progress, pages=pages, trusted=trusted, house=house, previous=former)
    return carried, found


@click.command(cls=HelpfulCommand, epilog=output.OF_CHECKS)
@click.argument("results", metavar="RESULTS.json", type=path_of)
@here_option
@formats_option(lambda: report_formats()[:-1], "html,pdf", "html,pdf (default), also docx,xlsx.")
@template_option
@strict_option
def render(results: Path, folder: Path, formats: list[str], house: HouseStyle | None, strict: bool, discovery: Discovery) -> int:  # fmt: skip
    """Regenerate the report from a results file, without calculating."""
    from diecut_report.exchange.rendering import render as rendered
    from diecut_report.exchange.rendering import told

    with Progress() as progress, redirect_stdout(sys.stderr):
        outcome, lost = rendered(results, folder, formats, progress, discovery, asked_language(), house)
    tell((*told(lost), *outcome.warnings))
    tell_written(outcome.written)
    inform(checking.verdict_lines(outcome.results, discovery))
    is_broken = bool(lost) or outcome.results.status == "error"
    return checking.exit_code(outcome.results, is_broken=is_broken, is_strict=strict)


@click.command(cls=HelpfulCommand)
@click.argument("old", metavar="OLD", type=path_of)
@click.argument("new", metavar="NEW", type=path_of)
@form_option("text", "json", "html", help="text, json or html.")
@target_option
@flag("--all", "all_rows", help="As text, show all changes, not only the most important ones.")
def diff(old: Path, new: Path, form: str, target: Path | None, all_rows: bool, discovery: Discovery) -> int:
    """Report what changed from OLD to NEW: each a configuration, a results file, a report, or a variant of a study (DIR#N).

    Exit codes are those of NEW: 0 no check fails, 1 a check fails, 3 a plugin broke; 2 where one of the two cannot be read.
    """
    from diecut_report.exchange.rendering import side
    from diecut_report.results.changes import changes

    with Progress() as progress, without_output():
        sides = [side(source(given, discovery), discovery, progress) for given in (old, new)]
        found = changes(sides[0][0], sides[1][0])
        text = _changes(found, [results for results, _ in sides], discovery, form, all_rows)
    tell(str(error) for _, broken in sides for error in broken)
    emit_or_write(text, target, old, new)
    is_broken = any(broken for _, broken in sides) or sides[1][0].status == "error"
    return checking.exit_code(sides[1][0], is_broken=is_broken, is_strict=False)


def _changes(found: ChangesRecord, sides: list[ResultsRecord], discovery: Discovery, form: str, all_rows: bool) -> str:
    """The changes in a format: as JSON neutral, as a page in the language that is asked for, else in that of the new project."""
    if form == "json":
        return as_json(found.data(), indent=1)
    from diecut_report.exchange.rendering import lines, page, said_changes

    document_language = asked_language() or sides[1].project.language
    with speaking(document_language if form == "html" else spoken_language()):
        told = said_changes(found, sides[0], sides[1], spoken_catalogues(discovery))
        return page(told) if form == "html" else as_lines(lines(told, all_rows=all_rows))


# The command that signs a report. A password comes from a prompt or from the environment, never from the command line.


PASSWORD = "DIECUT_REPORT_KEY_PASSWORD"  # the name of a variable of the environment


@click.command(cls=HelpfulCommand)
@click.argument("report", metavar="REPORT.pdf", type=path_of)
@path_option("--key", required=True, help="Your private key: PKCS #12 (.p12, .pfx) or PEM.")
@path_option("--cert", help="Its certificate (PEM), where it is not in the same file.")
@click.option(
    "--field", metavar="NAME", help="prepared, checked, norm_checked or approved; required if several are free."
)
@click.option("--reason", metavar="TEXT", help="Reason for signing, as stored in the signature.")
@path_option("-o", "target", help="Write to another file (default: REPORT.pdf itself).")
@previous_option
@template_option
def sign(
    report: Path, key: Path, cert: Path | None, field: str | None, reason: str | None, target: Path | None, previous: Path | None,
    house: HouseStyle | None, discovery: Discovery
) -> int:  # fmt: skip
    """Sign a report in one of its fields. Existing content is preserved byte for byte, so that others can sign it too.

    The report is verified first: one that differs from what this program produces is not signed.
    The key's password is asked for, or taken from the variable DIECUT_REPORT_KEY_PASSWORD.
    """
    from diecut_report.exchange.signatures import sign as signed
    from diecut_report.exchange.signatures import signing_key

    out = target or (report.resolve() if report.is_symlink() else report)  # signed where it stands
    for given in filter(None, (key, cert)):
        if out.exists() and given.exists() and out.samefile(given):
            words = "This is the key or its certificate and would be overwritten. Choose another file with -o."
            raise refusal(words, out)

    def require_as_made() -> None:
        carried, found = verified(report, discovery, house, previous)
        if not found.holds:
            faults = [line for line in verification_lines(carried, found) if line.startswith(("✗", " "))]
            words = phrase(
                "The report differs from what this program produces, and was not signed. Findings of `diecut-report verify`:"
            )
            raise UserError([Problem(words, str(report)), *map(Problem, faults)])

    def told(words: str) -> None:
        inform([f"{out}: " + phrase(words)])

    signed(report, out, signing_key(key, cert, _password), told, require_as_made, field, reason)
    return PASSED


def _password() -> bytes:
    given = os.environ.get(PASSWORD)
    if given is not None:
        return given.encode()
    if not sys.stdin or not sys.stdin.isatty():
        template = (
            "The key has a password. Set the variable {password}, or run the command on a terminal, which asks for it."
        )
        raise refusal(template, password=PASSWORD)
    asked: str = click.prompt(say("Password of the key"), hide_input=True, err=True)
    return asked.encode()
