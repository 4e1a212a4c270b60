"""The commands that lead from a question to a machine: solve for one input, mend what fails, see what matters."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli.options import (
    DASH,
    RESULTS,
    changeable_source,
    config_argument,
    count_option,
    dask_option,
    flag,
    form_option,
    input_option,
    jobs_option,
    path_of,
    path_option,
    results_folder,
    split,
    study_folder_option,
    target_option,
)
from diecut_report.cli.output import (
    CHECK_FAILED,
    INTERRUPTED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    Progress,
    as_json,
    as_lines,
    asked_language,
    emit,
    emit_or_write,
    inform,
    is_quiet,
    tell,
    tell_written,
    without_output,
)
from diecut_report.cli.study import told_broken, told_slow
from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery
from diecut_report.config.references import as_file
from diecut_report.quantities.units import UnitError, parse_quantity
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import said, say

if TYPE_CHECKING:
    from diecut_report.design.inputs import DesignInput
    from diecut_report.design.machines import ProvedMachine
    from diecut_report.press import Press


corrected_option = path_option(
    "-o", "target", help="Write the configuration with the result: everything else in it is preserved byte for byte."
)


@click.command(cls=HelpfulCommand)
@config_argument
@input_option("--vary", required=True, help="The input to solve for, such as drive.crank_length.")
@click.option(
    "--for", "asked", required=True, metavar="QUESTION",
    help='`drive.crank_torque_peak = 400 N*m`, with = <= or >=; or `max press.productivity`, `min cylinder.mass`.',
)  # fmt: skip
@click.option("--from", "low", metavar="VALUE", help="Lower end of the range (default: a third of the present value).")
@click.option("--to", "high", metavar="VALUE", help="Upper end of the range (default: three times the present value).")
@click.option(
    "--among",
    metavar="VALUE",
    multiple=True,
    help="A value to try, such as a size of a series or a bearing; may be given several times, or several with semicolons.",
)
@flag("--passing", help="Only values for which no check fails.")
@corrected_option
@form_option("text", "json")
def solve(
    config: Path, vary: str, asked: str, low: str | None, high: str | None, among: tuple[str, ...], passing: bool, target: Path | None,
    form: str, discovery: Discovery
) -> int:  # fmt: skip
    """Find the values of one input that satisfy a requirement, the nearest to the present value first.

    Exit codes: 0 found, 1 out of reach (the nearest value is reported), 2 bad input, 3 a plugin broke.
    """
    from diecut_report.design.answers import data, lines
    from diecut_report.design.inputs import solved_input
    from diecut_report.design.solving import solved

    with Progress() as progress, without_output():
        press = _read(config, discovery, progress)
        design = solved_input(press.config, vary, split(";".join(among), ";"))
        ends = (_end(design, low, "--from"), _end(design, high, "--to"))
        answer = solved(press, asked, design, passing=passing, low=ends[0], high=ends[1])
    _give(as_json(data(answer)) if form == "json" else _text(lines(answer)), press, answer.machine, target)
    return PASSED if answer.found else CHECK_FAILED


@click.command(cls=HelpfulCommand)
@config_argument
@input_option(
    "--free",
    multiple=True,
    help="An input that may be changed; may be given several times (default: sizes, angles and ratios).",
)
@input_option("--keep", multiple=True, help="An input to keep unchanged.")
@count_option("--most", least=1, default=10_000, help="Maximum number of machines to calculate (default: 10000).")
@corrected_option
@form_option("text", "json")
def advise(
    config: Path, free: tuple[str, ...], keep: tuple[str, ...], most: int, target: Path | None, form: str,
    discovery: Discovery
) -> int:  # fmt: skip
    """Find the smallest changes for which no check fails: the advice of all checks is tried together, then reduced.

    Ctrl-C ends the search with the best machine so far.

    Exit codes: 0 a machine that passes was found (or passes already), 1 none was found, 2 bad input, 3 a plugin broke, 130 stopped.
    """
    from diecut_report.design.advice import data, lines, mended

    with Progress() as progress, without_output():
        press = _read(config, discovery, progress)
        found = mended(press, free=free, keep=keep, most=most)
    _give(as_json(data(found)) if form == "json" else _text(lines(found)), press, found.machine, target)
    if found.ended == "stopped":
        return INTERRUPTED
    return CHECK_FAILED if found.before.failing and found.machine is None else PASSED


def _share(_context: click.Context, _option: click.Parameter, percent: float) -> float:
    """A share of a number that is given in percent; NaN, which passes any bound, is none."""
    if percent != percent:
        raise click.BadParameter(say("{given} is not a number of percent", given=repr(percent)))
    return percent / 100


@click.command(cls=HelpfulCommand)
@config_argument
@click.option(
    "--of",
    "names",
    metavar="NUMBER",
    multiple=True,
    help="An output or a check, such as drive.crank_torque_peak (default: the checks that govern).",
)
@click.option(
    "--by",
    "share",
    metavar="PERCENT",
    type=click.FloatRange(0, 100, min_open=True),
    callback=_share,
    default=10.0,
    help="Percentage by which each input is decreased and increased (default: 10).",
)
@flag("--defaults", help="Also vary inputs that have their default values.")
@input_option(
    "--tolerance",
    "tolerances",
    metavar="INPUT=SIZE",
    multiple=True,
    help="drive.crank_length=0.1 mm: symmetric tolerance of an input; may be given several times.",
)
@click.option(
    "--distribution",
    type=click.Choice(["normal", "uniform"]),
    default="normal",
    help="Distribution within the tolerances: normal (the tolerance is three standard deviations) or uniform.",
)
@count_option("--count", least=10, most=1_000_000, default=1000, help="Number of random machines (default: 1000).")
@count_option("--seed", least=0, default=1, help="Random seed; equal seeds give equal machines (default: 1).")
@target_option
@form_option("text", "json", "html", help="text (default), json or html with figures.")
def influence(
    config: Path, names: tuple[str, ...], share: float, defaults: bool, tolerances: tuple[str, ...], distribution: Any, count: int, seed: int,
    target: Path | None, form: str, discovery: Discovery
) -> int:  # fmt: skip
    """Report how strongly each input affects the governing checks, and the probability that checks pass within tolerances.

    Exit codes: 0 reported, 2 bad input, 3 a plugin broke.
    """
    from diecut_report.design.influence import by_input, data, lines, page, tornados, within_tolerances

    with Progress() as progress, without_output():
        loaded = _read(config, discovery, progress).config
        sizes = by_input(_tolerance(loaded, each) for each in tolerances)
        progress(phrase("varying one input at a time"))
        found = tornados(loaded, names, share, sizes, defaults=defaults)
        progress(phrase("drawing machines within tolerances"))
        drawn = within_tolerances(loaded, sizes, distribution, count, seed) if sizes else None
    told = {"text": lambda: _text(lines(found, drawn)), "json": lambda: as_json(data(found, drawn, sizes)),
            "html": lambda: page(found, drawn, Path(loaded.tree.name).name)}[form]()  # fmt: skip
    emit_or_write(told, target, config)
    tell_written([target] if target else [])
    return PASSED


def _tolerance(config: Config, given: str) -> tuple[DesignInput, float]:
    from diecut_report.design.inputs import free_input

    def wrong(words: str) -> click.BadParameter:
        return click.BadParameter(words, param_hint="--tolerance")

    name, _, size = given.partition("=")
    if not size.strip():
        raise wrong(say("{given} is not INPUT=SIZE, such as drive.crank_length=0.1 mm", given=repr(given)))
    design = free_input(config, name.strip())
    try:
        value = parse_quantity(size, design.meta.unit)
    except UnitError as fault:
        raise wrong(say("{name}: {fault}", name=name, fault=fault)) from None
    if value <= 0:
        raise wrong(say("{name}: {size} is not above zero", name=name, size=size))
    return design, value


@click.command(cls=HelpfulCommand)
@click.argument("name", metavar="MECHANISM.NAME")
@config_argument
@form_option("text", "json")
def where(name: str, config: Path, form: str, discovery: Discovery) -> int:
    """Show where a number comes from: file and line of its formula, its inputs, its source, and the checks that use it.

    NAME is an output or value of the results file, `inputs.KEY` or `checks.ID`.

    Exit codes: 0 found, 2 bad input or no such name, 3 a plugin broke.
    """
    from diecut_report.results.warm_press import WarmPress
    from diecut_report.results.where import data, lines
    from diecut_report.results.where import where as place_of

    with Progress() as progress, without_output():
        loaded = _read(config, discovery, progress).config
        progress(phrase("calculating"))
        found = place_of(WarmPress(is_advised=False).calculate(loaded), name)
    emit(as_json(data(found)) if form == "json" else _text(lines(found)))
    return PASSED


def _read(config: Path, discovery: Discovery, progress: Progress) -> Press:
    """The press whose text can be changed; PluginError where one of its plugins is broken."""
    from diecut_report.press import Press

    return Press.read(changeable_source(config, discovery), discovery, progress).usable()


def _end(design: DesignInput, given: str | None, option: str) -> float | None:
    if given is None:
        return None
    try:
        return design.read(given)
    except ValueError as fault:
        words = say("{name}: {fault}", name=design.name, fault=fault)
        raise click.BadParameter(words, param_hint=option) from None


def _give(told: str, press: Press, machine: ProvedMachine | None, target: Path | None) -> None:
    """Write the machine that was found, and tell of it: to standard error where ``-`` sends the machine to standard output."""
    from diecut_report.design.machines import write_config

    if target == DASH:
        tell(told.splitlines())
        if machine is not None:
            emit(as_file(press.config.tree, machine.press.config.tree.text).decode())
        return
    if target is not None and machine is not None:
        write_config(press.config.tree, machine, target)
    emit(told)
    if target is not None:
        tell_written([target]) if machine else inform([Phrase("not written: {path}", path=target)])


def _text(lines: Iterable[str]) -> str:
    return as_lines(map(said, lines))


WORDS = ("suggested", "front")


def _machines(_context: click.Context, _option: click.Parameter, given: str) -> list[str]:
    parts = split(given)
    if strange := [part for part in parts if part not in WORDS and not part.isdecimal()]:
        template = "{given} is neither the number of a machine nor one of: {words}."
        raise click.BadParameter(say(template, given=repr(strange[0]), words=", ".join(WORDS)))
    return parts


@click.command(cls=HelpfulCommand)
@click.argument("study", required=False, type=path_of)
@study_folder_option
@path_option("--resume", metavar="DIR", help="Resume the search of a folder where it stopped.")
@click.option(
    "--report",
    "reports",
    metavar="LIST",
    default="",
    callback=_machines,
    help="Full reports of these machines: `3,17`, `suggested`, `front` (those that are listed).",
)
@jobs_option
@dask_option
@flag("--yes", help="Allow a very large number of machines or reports.")
@form_option("text", "json", "csv", help="Output format: text (default), json, or csv of the whole front.")
def optimise(study: Path | None, folder: Path | None, resume: Path | None, reports: list[str], jobs: int | None, dask: str | None, yes: bool,
             form: str, discovery: Discovery) -> int:  # fmt: skip
    """Find the best machines of a STUDY by its objectives: a search over its varied inputs, within its constraints.

    Exit codes: 0 found, 1 no machine is feasible (conflicts are reported), 2 bad input, 3 a plugin broke, 130 stopped by Ctrl-C.
    """
    from diecut_report.design.optimisation import command
    from diecut_report.study.command import Shown
    from diecut_report.study.execution.study_run import Where

    target = results_folder(study, folder, resume)
    where = Where(jobs, dask, discovery.paths, asked_language())
    try:
        with without_output(), Shown(is_quiet()) as shown:
            outcome = command.run(
                study, target, where, resume=resume is not None, agreed=yes, reports=reports, shown=shown
            )
    except KeyboardInterrupt:
        template = "stopped; what is finished is kept. Continue with: diecut-report optimise --resume {folder}"
        is_kept = (target / RESULTS).exists()
        tell([Phrase(template, folder=target) if is_kept else phrase("stopped; nothing was written.")])
        return INTERRUPTED
    emit({"text": lambda: as_lines(map(said, outcome.lines)), "csv": lambda: outcome.csv,
          "json": lambda: as_json(outcome.data)}[form]())  # fmt: skip
    tell_written(outcome.written)
    inform(outcome.notes)
    search = outcome.search
    tell(told_slow(search.slow, search.broken))
    tell(told_broken(search.broken, search.store.state.get("doubtful") or {}, outcome.broken_reports))
    return PLUGIN_BROKE if outcome.is_broken else PASSED if outcome.is_found else CHECK_FAILED
