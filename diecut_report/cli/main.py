"""The command line: commands, exit codes, and all that is printed.

Exit codes: 0 no check fails, 1 a check fails (with --strict also a warning, or a check that is not made), 2 bad input or
usage (nothing is written), 3 a plugin broke, 74 what was asked for could not be written, 130 interrupted, 70 a fault of the
program itself. Messages that standard error does not take are lost; that changes no code.
"""

from __future__ import annotations

import gc
import json
import os
import sys
import traceback
from collections.abc import Sequence
from contextlib import redirect_stdout, suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import click

from diecut_report import __version__
from diecut_report.cli import completion, exit_codes, verdict
from diecut_report.cli.checking import check
from diecut_report.cli.design import advise, influence, solve
from diecut_report.cli.drafting import new
from diecut_report.cli.exchange import diff, extract, render, verify
from diecut_report.cli.file_schemas import OF_FILES, schema_of_file
from diecut_report.cli.formats import formats_of
from diecut_report.cli.given import output_file, source
from diecut_report.cli.kit import check_plugin, new_plugin
from diecut_report.cli.language import asked_language, language_option, of_environment
from diecut_report.cli.live import live
from diecut_report.cli.optimise import optimise
from diecut_report.cli.output import (
    BAD_INPUT,
    FAULT,
    INTERRUPTED,
    PASSED,
    PLUGIN_BROKE,
    UNWRITABLE,
    HelpfulGroup,
    common,
    emit,
    emit_lines,
    open_streams,
    tell,
    tell_problems,
    tell_written,
    without_output,
)
from diecut_report.cli.progress import Progress
from diecut_report.cli.report_options import detail_given, only_given, report_formats
from diecut_report.cli.signing import sign
from diecut_report.cli.study import batch, take, variants
from diecut_report.cli.template import template_option
from diecut_report.cli.usage import usage
from diecut_report.cli.validating import validate
from diecut_report.config.discovery import Discovery, DuplicateKind, UnknownKind
from diecut_report.errors import PluginError, Problem, Unwritable, UserError
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.phrases import phrase
from diecut_report.languages.speech import said, say, speak, speaking

if TYPE_CHECKING:
    from diecut_report.pipeline import ReportOutcome
    from diecut_report.report.house_style import HouseStyle

# objects made before garbage is looked for: starting makes many lasting ones, among which to look costs a tenth of a run
COLLECTED = 1_000_000


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
    gc.set_threshold(COLLECTED)
    with speaking(SOURCE_LANGUAGE):  # what a command chooses holds for it alone
        return _run(arguments)


def _run(arguments: Sequence[str] | None) -> int:
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
        tell(traceback.format_exc().splitlines())
        tell(
            [
                phrase(
                    "This is a fault of diecut-report itself. Please report it with the lines above and the configuration."
                )
            ]
        )
        return FAULT


# --- options ---------------------------------------------------------------------------------------------------------


def _version(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked and not context.resilient_parsing:
        emit(f"diecut-report, version {__version__}\n")
        context.exit()


@click.group(cls=HelpfulGroup, context_settings={"help_option_names": ["-h", "--help"]}, epilog=exit_codes.OF_PROGRAM)
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_version, help="Show the version and exit."
)
@language_option
def program() -> None:
    """Design reports for die-cutting presses, from a YAML description to a checked calculation document."""


config_argument = click.argument("config", type=click.Path(path_type=Path))


# --- commands --------------------------------------------------------------------------------------------------------


@program.command(epilog=exit_codes.OF_CHECKS)
@config_argument
@click.option(
    "-o", "folder", metavar="DIR", default=".", type=click.Path(path_type=Path), help="Where to write (default: here)."
)
@click.option(
    "--format",
    "formats",
    metavar="LIST",
    default="html,pdf,json",
    callback=formats_of(report_formats),
    help="html,pdf,json (default), also docx,xlsx.",
)
@click.option(
    "--previous",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="A former report, results, configuration or variant: mark what changed since, and add a page of it.",
)
@click.option(
    "--detail",
    metavar="DETAIL",
    shell_complete=completion.details,
    callback=detail_given,
    help="brief, standard or full, in place of the configuration's (standard).",
)
@click.option(
    "--only",
    metavar="NAMES",
    shell_complete=completion.mechanisms,
    callback=only_given,
    help="Report these mechanisms alone: drive,clutch.",
)
@template_option
@verdict.strict_option
@common
def report(
    config: Path, folder: Path, formats: list[str], previous: Path | None, detail: str | None, only: tuple[str, ...],
    house: HouseStyle | None, strict: bool, folders: tuple[Path, ...], quiet: bool,
) -> int:  # fmt: skip
    """Calculate and write NAME.html, NAME.pdf and NAME.json; on demand NAME.docx and NAME.xlsx."""
    from diecut_report import pipeline
    from diecut_report.design.followed_advice import followed
    from diecut_report.design.report_influence import influenced
    from diecut_report.exchange.sides import side
    from diecut_report.study.analysis.assumed import moves

    with Progress(quiet) as progress, redirect_stdout(sys.stderr):
        discovery = Discovery(folders)
        former = None if previous is None else side(source(previous, discovery), discovery, progress)[0]
        given, asked = source(config, discovery), pipeline.AskedReport(asked_language(), detail, only, house)
        outcome = pipeline.report(
            given, discovery, progress, folder, formats, asked, moves, former, followed, influenced
        )
    if not quiet:
        tell_written(outcome.written)
    return _verdict(outcome, discovery, quiet, strict)


@program.command(epilog=exit_codes.OF_CHECKS)
@config_argument
@click.option("-o", "target", metavar="FILE", type=output_file, help="Write to a file, not to standard output.")
@verdict.strict_option
@common
def calc(config: Path, target: Path | None, strict: bool, folders: tuple[Path, ...], quiet: bool) -> int:
    """Calculate, and give the results file alone."""
    from diecut_report import pipeline

    # a plugin that prints does not spoil the JSON
    with Progress(quiet) as progress, without_output() if target is None else redirect_stdout(sys.stderr):
        discovery = Discovery(folders)
        outcome, text = pipeline.calc(source(config, discovery), discovery, progress, target)
    if target is None:
        emit(text)
    return _verdict(outcome, discovery, quiet or target is None, strict)


@program.command()
@common
def plugins(folders: tuple[Path, ...], quiet: bool) -> int:
    """List the kinds, their sources and where each comes from."""
    discovery, codes, lines = Discovery(folders), [PASSED], []
    for kind, origins in discovery.origins.items():
        try:
            with without_output():
                mechanism = discovery.mechanism(kind)
            title = said(mechanism.title, kind)
            lines += [f"{kind} {mechanism.version}: {title}", say("    from {origin}", origin=origins[0].told)]
            lines += [
                say("    source {id}: {citation}", id=source.id, citation=phrase(source.citation))
                for source in mechanism.sources
            ]
        except (DuplicateKind, PluginError) as error:
            tell([str(error)])
            codes.append(PLUGIN_BROKE)
    emit_lines(lines)
    return max(codes)


@program.command()
@click.argument("kind", required=False, shell_complete=completion.kinds)
@common
def schema(kind: str | None, folders: tuple[Path, ...], quiet: bool) -> int:
    """JSON Schema of the config, of one KIND's block, of a study file (KIND study), or of the results file (KIND results)."""
    from diecut_report.config.schema import config_schema, kind_schema

    if kind in OF_FILES:
        emit(json.dumps(schema_of_file(kind), indent=2, ensure_ascii=False) + "\n")
        return PASSED
    discovery = Discovery(folders)
    found, broken = {}, {}
    for name in [kind] if kind else discovery.origins:
        try:
            with without_output():
                found[name] = discovery.mechanism(name)
        except (UnknownKind, DuplicateKind) as fault:
            raise UserError(Problem(str(fault))) from None
        except PluginError as error:
            tell([str(error)])
            broken[name] = error.message
    if kind is None or kind in found:
        whole = kind_schema(found[kind]) if kind else config_schema(found, broken)
        emit(json.dumps(whole, indent=2, ensure_ascii=False) + "\n")
    return PLUGIN_BROKE if broken else PASSED


OTHERS = (new, validate, check, batch, variants, take, extract, verify, render, diff, sign, live, solve, advise, influence, optimise, new_plugin,
          check_plugin)  # fmt: skip
for _command in OTHERS:
    program.add_command(_command)


# --- verdict ---------------------------------------------------------------------------------------------------------


def _verdict(outcome: ReportOutcome, discovery: Discovery, quiet: bool, strict: bool) -> int:
    tell(str(error) for error in outcome.broken)
    tell(outcome.warnings)
    if not quiet:
        tell(verdict.told(outcome.results, discovery))
    return verdict.exit_code(outcome.results, is_broken=bool(outcome.broken), is_strict=strict)
