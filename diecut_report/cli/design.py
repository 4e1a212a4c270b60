"""The commands that lead from a question to a machine: solve for one input."""

from __future__ import annotations

import json
import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli.output import CHECK_FAILED, PASSED, HelpfulCommand, common, emit, tell
from diecut_report.cli.progress import Progress
from diecut_report.cli.study import source
from diecut_report.config.discovery import Discovery

if TYPE_CHECKING:
    from diecut_report.config.loader import Config
    from diecut_report.design.design_inputs import DesignInput
    from diecut_report.design.proved_machine import ProvedMachine

path_of = click.Path(path_type=Path)
form_option = click.option(
    "--format", "form", default="text", type=click.Choice(["text", "json"]), help="text (default) or json."
)
target_option = click.option(
    "-o", "target", metavar="FILE", type=path_of,
    help="Write the configuration with what was found: all else in it stays as it is, byte for byte.",
)  # fmt: skip


@click.command(cls=HelpfulCommand)
@click.argument("config", type=path_of)
@click.option("--vary", required=True, metavar="INPUT", help="The input to solve for, such as drive.crank_length.")
@click.option(
    "--for", "asked", required=True, metavar="QUESTION",
    help='"drive.crank_torque_peak = 400 N*m", with = <= or >=; or "max press.productivity", "min cylinder.mass".',
)  # fmt: skip
@click.option("--from", "low", metavar="VALUE", help="Where the range begins (default: a third of today's value).")
@click.option("--to", "high", metavar="VALUE", help="Where it ends (default: three times today's value).")
@click.option("--passing", is_flag=True, help="Only values with which no check fails.")
@target_option
@form_option
@common
def solve(
    config: Path, vary: str, asked: str, low: str | None, high: str | None, passing: bool, target: Path | None,
    form: str, folders: tuple[Path, ...], quiet: bool,
) -> int:  # fmt: skip
    """Find the values of one input with which a machine does what is asked, the nearest to today's first.

    Exit codes: 0 found, 1 out of reach (the nearest value is told), 2 bad input, 3 a plugin broke.
    """
    from diecut_report.design.answers import data, lines
    from diecut_report.design.design_inputs import design_input, with_input
    from diecut_report.design.questions import question
    from diecut_report.design.solving import solved

    with Progress(quiet) as progress, redirect_stdout(sys.stderr):
        discovery = Discovery(folders)
        progress("reading the configuration")
        loaded = _loaded(config, discovery)
        design = design_input(loaded, vary)
        ends = (_end(design, low, "--from"), _end(design, high, "--to"))
        is_new = design.today is None and ends[0] is not None
        what = question(with_input(loaded, design, ends[0] or 0.0) if is_new else loaded, asked)
        progress(f"solving for {design.name}")
        answer = solved(loaded, discovery, what, design, passing=passing, low=ends[0], high=ends[1])
        if target is not None and answer.machine is not None:
            _write(loaded, answer.machine, target)
    emit(_json(data(answer)) if form == "json" else "".join(f"{line}\n" for line in lines(answer)))
    if target is not None and not quiet:
        tell([f"written: {target}" if answer.machine is not None else f"not written: {target}"])
    return PASSED if answer.found else CHECK_FAILED


def _loaded(config: Path, discovery: Discovery) -> Config:
    """The configuration; PluginError where one of its plugins is broken."""
    from diecut_report.config.loader import load_config

    loaded = load_config(source(config, discovery), discovery)
    for error in loaded.broken.values():
        raise error
    return loaded


def _end(design: DesignInput, given: str | None, option: str) -> float | None:
    if given is None:
        return None
    try:
        return design.read(given)
    except ValueError as fault:
        raise click.BadParameter(f"{design.name}: {fault}", param_hint=option) from None


def _write(config: Config, machine: ProvedMachine, target: Path) -> None:
    from diecut_report.design.proved_machine import write_config

    write_config(config.tree, machine, target)


def _json(found: dict[str, Any]) -> str:
    return json.dumps(found, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
