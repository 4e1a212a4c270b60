"""The command ``optimise``: from a study to its best machines."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from diecut_report.cli.given import results_folder
from diecut_report.cli.language import asked_language
from diecut_report.cli.output import (
    CHECK_FAILED,
    INTERRUPTED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    as_lines,
    common,
    emit,
    tell,
    tell_written,
    without_output,
)
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import said, say
from diecut_report.results.doubtful_plugins import told_faults

if TYPE_CHECKING:
    from diecut_report.optimisation.command import OptimiseOutcome

WORDS = ("suggested", "front")
path_of = click.Path(path_type=Path)


def _machines(_context: click.Context, _option: click.Parameter, given: str) -> list[str]:
    parts = [part.strip() for part in given.split(",") if part.strip()]
    if strange := [part for part in parts if part not in WORDS and not part.isdecimal()]:
        words = "{given} is neither the number of a machine nor one of: {words}."
        raise click.BadParameter(say(words, given=repr(strange[0]), words=", ".join(WORDS)))
    return parts


@click.command(cls=HelpfulCommand)
@click.argument("study", required=False, type=path_of)
@click.option("-o", "folder", metavar="DIR", type=path_of, help="Where to write (default: the study's name, here).")
@click.option("--resume", metavar="DIR", type=path_of, help="Go on with the search of a folder where it ended.")
@click.option(
    "--report",
    "reports",
    metavar="LIST",
    default="",
    callback=_machines,
    help="Full reports of these machines: `3,17`, `suggested`, `front` (those that are listed).",
)
@click.option("--jobs", metavar="N", type=click.IntRange(1), help="Processes (default: one for each core).")
@click.option(
    "--dask", metavar="ADDRESS", help="Calculate on the cluster of this Dask scheduler, such as tcp://host:8786."
)
@click.option("--yes", is_flag=True, help="Calculate also a very large number of machines or reports.")
@click.option(
    "--format",
    "form",
    default="text",
    type=click.Choice(["text", "json", "csv"]),
    help="Of what is shown: text (default), json, or csv of the whole front.",
)
@common
def optimise(study: Path | None, folder: Path | None, resume: Path | None, reports: list[str], jobs: int | None, dask: str | None, yes: bool,
             form: str, folders: tuple[Path, ...], quiet: bool) -> int:  # fmt: skip
    """Find the best machines of a STUDY by its objectives: a search through what it varies, within its constraints.

    Exit codes: 0 found, 1 no machine is allowed (what conflicts is told), 2 bad input, 3 a plugin broke, 130 stopped by Ctrl-C.
    """
    from diecut_report.optimisation import command
    from diecut_report.study.command import Shown, Where

    target = results_folder(study, folder, resume)
    where = Where(jobs, dask, tuple(str(path.absolute()) for path in folders), asked_language())
    try:
        with without_output(), Shown(quiet) as shown:
            outcome = command.run(
                study, target, where, resume=resume is not None, agreed=yes, reports=reports, shown=shown
            )
    except KeyboardInterrupt:
        if not (target / "study.json").exists():
            tell([phrase("stopped; nothing was written.")])
            return INTERRUPTED
        words = "stopped; what is finished is kept. Continue with: diecut-report optimise --resume {folder}"
        tell([Phrase(words, folder=target)])
        return INTERRUPTED
    emit({"text": lambda: as_lines(map(said, outcome.lines)), "csv": lambda: outcome.csv,
          "json": lambda: json.dumps(outcome.data, indent=2, ensure_ascii=False, allow_nan=False) + "\n"}[form]())  # fmt: skip
    if not quiet:
        tell_written(outcome.written)
        tell(outcome.notes)
    tell(_faults(outcome))
    return PLUGIN_BROKE if outcome.is_broken else PASSED if outcome.is_found else CHECK_FAILED


def _faults(outcome: OptimiseOutcome) -> Iterator[str]:
    """Which plugins broke, were slow, or have faults in their formulas."""
    slow = "{kind} cannot take arrays and was calculated variant by variant, which is slow: {why}"
    broke = "plugin {kind} broke; variants that it broke for are in error, the others are kept: {why}"
    search = outcome.search
    yield from (
        Phrase(slow, kind=kind, why=phrase(why)) for kind, why in search.slow.items() if kind not in search.broken
    )
    yield from (Phrase(broke, kind=repr(kind), why=phrase(why)) for kind, why in search.broken.items())
    for kind, faults in (search.store.state.get("doubtful") or {}).items():
        yield from told_faults(kind, faults)
    for kind, why in outcome.broken_reports.items():
        yield Phrase("plugin {kind} broke {why}", kind=repr(kind), why=phrase(why))
