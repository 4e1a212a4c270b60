"""The commands of plugin authors: ``new-plugin`` writes a mechanism that runs, ``check-plugin`` judges one."""

from __future__ import annotations

import json
import webbrowser
from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import mkdtemp
from typing import TYPE_CHECKING

import click

from diecut_report.cli import exit_codes
from diecut_report.cli.language import asked_language
from diecut_report.cli.output import (
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    common,
    emit,
    emit_lines,
    tell,
    tell_written,
    without_output,
)
from diecut_report.languages.phrases import Counted, Phrase, joined, phrase
from diecut_report.languages.speech import said, say, spoken_language

if TYPE_CHECKING:
    from diecut_report.kit.checking import CheckedPlugin

STATES = {
    "pass": phrase("holds"),
    "note": phrase("note"),
    "not_tried": phrase("not tried"),
    "fail": phrase("fails"),
    "broke": phrase("broke"),
}

path_of = click.Path(path_type=Path)


@click.command("new-plugin", cls=HelpfulCommand)
@click.argument("name")
@click.option(
    "--package", "as_package", is_flag=True, help="As a package that can be installed, not a folder for --plugins."
)
@click.option(
    "--like",
    default="parts",
    type=click.Choice(["parts", "motion", "selection"]),
    help="What to begin with: parts (default; a list of springs), motion (curves over a turn), selection (a size of a table).",
)
@click.option("-o", "folder", metavar="DIR", type=path_of, help="The folder to make (default: NAME, here).")
@common
def new_plugin(
    name: str, as_package: bool, like: str, folder: Path | None, folders: tuple[Path, ...], quiet: bool
) -> int:
    """Write a new mechanism of the kind NAME that runs: plugin, tests, example, study, words."""
    from diecut_report.kit.scaffold import scaffold

    home = folder or Path(name)
    written = scaffold(name, home, as_package=as_package, like=like)
    if not quiet:
        tell_written(written)
        tell([Phrase("next: read {file}", file=home / "README.md")])
    return PASSED


@click.command("check-plugin", cls=HelpfulCommand, epilog=exit_codes.OF_PLUGIN)
@click.argument("plugin", metavar="NAME|DIR")
@click.option("--config", "configs", metavar="FILE", multiple=True, type=path_of,
              help="A configuration with machines to try it on (default: those that lie beside the plugin).")  # fmt: skip
@click.option("--format", "form", default="text", type=click.Choice(["text", "json"]), help="text (default) or json.")
@click.option(
    "-o",
    "page",
    metavar="FILE",
    type=path_of,
    help="Write the rendered chapter; of several plugins, or into a folder, each as NAME.html.",
)
@click.option(
    "--write-po",
    is_flag=True,
    help="Write the texts that its catalogues lack into them, to be translated, and mark those that nothing says any more.",
)
@click.option(
    "--open",
    "is_shown",
    is_flag=True,
    help="Show the rendered chapter in the browser; without -o from a folder for what is temporary.",
)
@common
def check_plugin(
    plugin: str, configs: tuple[Path, ...], form: str, page: Path | None, write_po: bool, is_shown: bool, folders: tuple[Path, ...],
    quiet: bool,
) -> int:  # fmt: skip
    """Try a plugin on the rules of its contract; with -o set its chapter as HTML. Ends with 1 where a rule is broken."""
    from diecut_report.kit.checking import CheckedPlugin, checked, meant

    known, kinds = meant(plugin, folders)
    if page is not None and len(kinds) > 1 and page.suffix:
        words = "{folder} has {n} plugins; name one of them, or give a folder with -o."
        raise click.UsageError(say(words, folder=plugin, n=len(kinds)))
    found: list[CheckedPlugin] = []
    for kind in kinds:
        with without_output():
            for each in checked(known, kind, configs, asked_language() or spoken_language(), write_po=write_po):
                if isinstance(each, CheckedPlugin):
                    found.append(each)
    if form == "json":
        emit(json.dumps([each.data for each in found], indent=2, ensure_ascii=False) + "\n")
    else:
        emit_lines(line for each in found for line in _lines(each))
    for each in found:
        _tell_changed(each, quiet)
    pages = {each.kind: each.page.encode() for each in found if each.page}
    if page or is_shown:
        _write_pages(_places(pages, page, is_single=len(kinds) == 1), configs, quiet, is_shown)
    elif pages and not quiet and form == "text":
        tell([Phrase("-o FILE writes the chapter as it stands in a report, --open shows it")])
    states = {each.status for each in found}
    return PLUGIN_BROKE if "broke" in states else CHECK_FAILED if "fail" in states else PASSED


def _lines(found: CheckedPlugin) -> Iterator[str]:
    """What was found, a line for each rule, below it its faults."""
    version = f" {found.mechanism.version}" if found.mechanism else ""
    yield say("{kind}{version}, from {origin}", kind=found.kind, version=version, origin=found.told)
    if found.error:
        yield f"  {say('broke')}: {said(found.error)}"
    for rule in found.rules:
        told = f": {said(rule.told)}" if rule.told else ""
        yield f"  {said(STATES[rule.status])}  {said(rule.title)}{told}"
        yield from (f"      {said(fault)}" for fault in rule.short_list)


def _tell_changed(found: CheckedPlugin, quiet: bool) -> None:
    """Which texts wait for their translation, and how many are obsolete."""
    for file, made in found.changed.items() if not quiet else ():
        told = [
            *([Counted(made.added, "{n} text to be translated", "{n} texts to be translated")] if made.added else []),
            *([Counted(made.obsolete, "{n} text is obsolete", "{n} texts are obsolete")] if made.obsolete else []),
        ]
        tell([Phrase("written: {file}: {told}", file=file, told=joined(told, ", "))])


def _places(pages: Mapping[str, bytes], asked: Path | None, *, is_single: bool) -> dict[Path, bytes]:
    """Where each chapter is written: the file that is named, a file of its own in a folder; where none is named a temporary folder."""
    place = asked or Path(mkdtemp(prefix="diecut-report-"))
    is_file = asked and is_single and not asked.is_dir()
    return {place if is_file else place / f"{kind}.html": page for kind, page in pages.items()}


def _write_pages(pages: Mapping[Path, bytes], configs: tuple[Path, ...], quiet: bool, is_shown: bool) -> None:
    from diecut_report.files import write_all

    write_all(pages, keep=configs[0] if configs else None)
    if not quiet:
        tell_written(pages)
    for page in pages if is_shown else ():
        webbrowser.open(page.resolve().as_uri())
