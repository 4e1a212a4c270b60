"""The command line: commands, exit codes, and all that is printed.

Exit codes: 0 pass or conditional, 1 fail (with --strict also conditional), 2 bad input or
usage (nothing is written), 3 a plugin broke, 74 what was asked for could not be written, 130 interrupted, 70 a fault of the
program itself. Messages that standard error does not take are lost; that changes no code.
"""

from __future__ import annotations

import io
import os
import re
import sys
import traceback
from collections.abc import Mapping, Sequence
from contextlib import redirect_stdout, suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import click

from diecut_report import __version__
from diecut_report.cli import checking, output
from diecut_report.cli.checking import check, compare, validate
from diecut_report.cli.design import advise, influence, optimise, solve, where
from diecut_report.cli.exchange import diff, extract, render, sign, verify
from diecut_report.cli.live import live
from diecut_report.cli.options import (
    config_argument,
    formats_option,
    here_option,
    names_option,
    path_option,
    read_detail,
    report_formats,
    source,
    strict_option,
    target_option,
    template_option,
)
from diecut_report.cli.output import (
    BAD_INPUT,
    FAULT,
    INTERRUPTED,
    PASSED,
    PLUGIN_BROKE,
    UNWRITABLE,
    HelpfulGroup,
    Progress,
    asked_language,
    emit,
    emit_json,
    emit_lines,
    inform,
    of_environment,
    open_streams,
    tell,
    tell_problems,
    tell_written,
    without_output,
)
from diecut_report.cli.plugins import check_plugin, new, new_plugin
from diecut_report.cli.study import batch, take, variants
from diecut_report.config.model import DETAILS
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind
from diecut_report.errors import PluginError, Unwritable, UserError, refusal
from diecut_report.results.model import results_schema
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import said, say, speak, speaking

if TYPE_CHECKING:
    from diecut_report.press import CalculatedPress, ReportOutcome
    from diecut_report.report.pages.firm_templates import HouseStyle


# What click says of wrong usage, in the language that is spoken: it has no catalogues of its own.
#
# Its own way, ``gettext`` with the domain "messages", was looked at and is not taken. It reads compiled catalogues of the language
# that ``os.environ`` names, for the whole process: argparse and all processes that are started would follow, while a language here
# holds within ``speaking`` alone. It translates a sentence where it is raised, which may be before ``--language`` is read. And a
# sentence that another version of click words otherwise stays English there too; here `tests/cli/test_usage.py` tells of it.


SENTENCES: Mapping[re.Pattern[str], str] = {
    re.compile(pattern): template
    for pattern, template in (
        (r"Try '(?P<command>[^']*)' for help\.", phrase("Try '{command}' for help.")),
        (r"Missing argument '(?P<name>[^']*)'\.(?P<more>.*)", phrase("Missing argument '{name}'.{more}")),
        (r"Missing option '(?P<name>[^']*)'\.(?P<more>.*)", phrase("Missing option '{name}'.{more}")),
        (r"No such option '?(?P<name>[^'\s]+?)'?\.", phrase("No such option '{name}'.")),
        (r"No such option '?(?P<name>[^'\s]+?)'?\. (?:Did you mean|\(Possible options:) (?P<near>[^?)]*)[?)]\.?",
         phrase("No such option '{name}' (did you mean {near}?).")),
        (r"No such command '(?P<name>[^']*)'\.", phrase("No such command '{name}'.")),
        (r"No such command '(?P<name>[^']*)'\. (?:Did you mean|\(Possible commands:) (?P<near>[^?)]*)[?)]\.?",
         phrase("No such command '{name}' (did you mean {near}?).")),
        (r"Missing command\.", phrase("Missing command.")),
        (r"Invalid value for (?P<name>'[^']*'(?: / '[^']*')*|-[\w-]+): (?P<why>.*)", phrase("Invalid value for {name}: {why}")),
        (r"Option '(?P<name>[^']*)' requires an argument\.", phrase("Option '{name}' requires an argument.")),
        (r"Option '(?P<name>[^']*)' does not take a value\.", phrase("Option '{name}' does not take a value.")),
        (r"Got unexpected extra arguments? \((?P<given>.*)\)\.?", phrase("Got unexpected extra arguments ({given}).")),
        (r"'(?P<given>.*)' is not one of (?P<known>.*)\.", phrase("'{given}' is not one of {known}.")),
        (r"'(?P<given>.*)' is not a valid (?:integer|integer range)\.", phrase("'{given}' is not a whole number.")),
        (r"'(?P<given>.*)' is not a valid (?:float|float range|number)\.", phrase("'{given}' is not a number.")),
        (r"(?P<given>\S+) is not in the range (?P<range>.*)\.", phrase("{given} is not in the range {range}.")),
    )
}  # fmt: skip
"""The sentences of click, each with the words of a phrase."""


def usage(error: click.ClickException) -> list[str]:
    """Return what click says of wrong usage; of its last part, which repeats what was given, no line stands for itself."""
    shown = io.StringIO()
    error.show(shown)
    head, found, _ = f"\n{shown.getvalue()}".partition("\nError: ")
    told = [Phrase("Error: {message}", message=worded(error.format_message()))] if found else []
    return [*(worded(line) for line in head[1:].splitlines()), *told]


def worded(sentence: str) -> str:
    """Return a sentence of click as a phrase; another one as it is."""
    for pattern, template in SENTENCES.items():
        if found := pattern.fullmatch(sentence):
            parts = found.groupdict("")
            return Phrase(template, parts | ({"why": worded(parts["why"])} if "why" in parts else {}))
    return sentence


def run() -> NoReturn:
    """The program: ``main``, and then out at once, for to tear the interpreter down costs a fifth of a short run.

    Nothing is left to do then: files are closed, output is flushed, no thread has work.
    """
    open_streams()
    try:
        code = main()
    except KeyboardInterrupt:  # while an error was told
        code = INTERRUPTED
    for stream in filter(None, (sys.stdout, sys.stderr)):  # a stream may be closed from outside
        with suppress(OSError):  # whoever read it has gone
            stream.flush()
    os._exit(code)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; its exit code. What a user can fix is reported on standard error."""
    with speaking(SOURCE_LANGUAGE):  # what a command chooses holds for it alone
        try:
            speak(of_environment())
            return int(program.main(arguments, prog_name="diecut-report", standalone_mode=False) or PASSED)
        except click.Abort:
            return INTERRUPTED
        except click.ClickException as error:
            tell(usage(error))
            return BAD_INPUT
        except UserError as error:
            tell_problems(error.problems)
            return UNWRITABLE if isinstance(error, Unwritable) else BAD_INPUT
        except PluginError as error:
            tell([str(error)])
            return PLUGIN_BROKE
        except Exception:
            template = (
                "This is a fault of diecut-report itself. Please report it with the lines above and the configuration."
            )
            tell([*traceback.format_exc().splitlines(), phrase(template)])
            return FAULT


def _version(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked and not context.resilient_parsing:
        emit(f"diecut-report, version {__version__}\n")
        context.exit()


@click.group(cls=HelpfulGroup, context_settings={"help_option_names": ["-h", "--help"]}, epilog=output.OF_PROGRAM)
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_version, help="Show the version and exit."
)
def program() -> None:
    """Design reports for die-cutting presses, from a YAML description to a checked calculation document."""


@program.command(epilog=output.OF_CHECKS)
@config_argument
@here_option
@formats_option(report_formats, "html,pdf,json", "html,pdf,json (default), also docx,xlsx.")
@path_option(
    "--previous",
    help="A previous report, results file, configuration or variant: mark changes since then and add a page of changes.",
)
@click.option(
    "--detail",
    metavar="DETAIL",
    shell_complete=output.one_of(lambda: DETAILS),
    callback=read_detail,
    help="brief, standard or full, overriding the configuration (standard).",
)
@names_option(
    "--only",
    metavar="NAMES",
    none=phrase("no mechanism is named; give names of the configuration, with commas: drive,clutch."),
    help="Report only these mechanisms: drive,clutch.",
    shell_complete=output.mechanisms,
)
@template_option
@strict_option
def report(
    config: Path, folder: Path, formats: list[str], previous: Path | None, detail: str | None, only: tuple[str, ...],
    house: HouseStyle | None, strict: bool, discovery: Discovery
) -> int:  # fmt: skip
    """Calculate and write NAME.html, NAME.pdf and NAME.json; on demand NAME.docx and NAME.xlsx."""
    from diecut_report.design.findings import with_findings
    from diecut_report.exchange.rendering import side
    from diecut_report.press import AskedReport, Press

    with Progress() as progress, redirect_stdout(sys.stderr):
        former = None if previous is None else side(source(previous, discovery), discovery, progress)[0]
        press = Press.read(source(config, discovery), discovery, progress)
        press.require_reportable(formats, only)
        for path in [folder / f"{Path(press.config.tree.name).stem}.{form}" for form in formats]:
            if previous is not None and path.exists() and previous.exists() and path.samefile(previous):
                template = "This is the previous report itself and would be overwritten. Choose another place with -o."
                raise refusal(template, path)
        asked = AskedReport(asked_language(), detail, only, house)
        outcome = with_findings(press.calculate()).report(folder, formats, asked, former)
    tell_written(outcome.written)
    return _verdict(outcome, discovery, strict)


@program.command(epilog=output.OF_CHECKS)
@config_argument
@target_option
@strict_option
def calc(config: Path, target: Path | None, strict: bool, discovery: Discovery) -> int:
    """Calculate and write only the results file."""
    from diecut_report.design.findings import decided
    from diecut_report.press import Press

    # a plugin that prints does not spoil the JSON
    with Progress() as progress, without_output() if target is None else redirect_stdout(sys.stderr):
        made = decided(Press.read(source(config, discovery), discovery, progress).calculate())
        text = made.text
        if target is not None:
            made.save(target)
    if target is None:
        emit(text)
    return _verdict(made, discovery, strict, is_shown=target is not None)


@program.command()
def plugins(discovery: Discovery) -> int:
    """List the kinds, their sources and where each comes from."""
    codes, lines = [PASSED], list[str]()
    for kind, origins in discovery.origins.items():
        try:
            with without_output():
                mechanism = discovery.mechanism(kind)
            title = said(mechanism.title, kind)
            lines += [f"{kind} {mechanism.version}: {title}", say("    from {origin}", origin=origins[0].label)]
            template = "    source {id}: {citation}"
            lines += [say(template, id=source.id, citation=phrase(source.citation)) for source in mechanism.sources]
        except (DuplicateKind, PluginError) as error:
            tell([str(error)])
            codes.append(PLUGIN_BROKE)
    emit_lines(lines)
    return max(codes)


@program.command()
@click.argument("kind", required=False, shell_complete=output.kinds)
def schema(kind: str | None, discovery: Discovery) -> int:
    """JSON Schema of the config, of one KIND's block, of a study file (KIND study), or of the results file (KIND results)."""
    from diecut_report.config.schema import config_schema, kind_schema

    if kind == "study":
        from diecut_report.study.definition.schema import study_schema

        emit_json(study_schema())
        return PASSED
    if kind == "results":
        emit_json(results_schema())
        return PASSED
    found, broken = {}, {}
    for name in [kind] if kind else discovery.origins:
        try:
            with without_output():
                found[name] = discovery.mechanism(name)
        except (UnknownKind, DuplicateKind) as fault:
            raise refusal(str(fault)) from None
        except PluginError as error:
            tell([str(error)])
            broken[name] = error.message
    if kind is None or kind in found:
        emit_json(kind_schema(found[kind]) if kind else config_schema(found, broken))
    return PLUGIN_BROKE if broken else PASSED


OTHERS = (new, validate, check, compare, batch, variants, take, extract, verify, render, diff, sign, live, solve, advise, influence, optimise, where,
          new_plugin, check_plugin)  # fmt: skip
for _command in OTHERS:
    program.add_command(_command)


def _verdict(
    outcome: CalculatedPress | ReportOutcome, discovery: Discovery, strict: bool, *, is_shown: bool = True
) -> int:
    tell(str(error) for error in outcome.broken)
    tell(outcome.warnings)
    if is_shown:
        inform(checking.verdict_lines(outcome.results, discovery))
    return checking.exit_code(outcome.results, is_broken=bool(outcome.broken), is_strict=strict)
