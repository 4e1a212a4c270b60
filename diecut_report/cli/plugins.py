"""The command that begins a configuration."""

from __future__ import annotations

import os
import webbrowser
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import mkdtemp
from typing import TYPE_CHECKING

import click

from diecut_report.cli import output
from diecut_report.cli.options import json_option, output_file, path_of
from diecut_report.cli.output import (
    BAD_INPUT,
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    asked_language,
    common,
    emit_json,
    emit_lines,
    emit_or_write,
    tell,
    tell_problems,
    tell_written,
    without_output,
)
from diecut_report.config.catalogues import spoken_catalogues
from diecut_report.config.plugins import Discovery, DuplicateKind
from diecut_report.errors import PluginError, Problem, UserError, refusal
from diecut_report.text.phrases import Counted, Phrase, joined, phrase
from diecut_report.text.translation import said, say, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.config.drafting import Draft
    from diecut_report.testing.plugin_page import CheckedPlugin


SHOWN = "<stdout>"


@click.command("new", cls=HelpfulCommand)
@click.argument("kinds", metavar="[KIND[:NAME] …]", nargs=-1, shell_complete=output.kinds)
@click.option("-o", "file", metavar="FILE", type=output_file, help="Where to write (default: standard output).")
@click.option("--force", is_flag=True, help="Overwrite an existing file.")
@common
def new(kinds: tuple[str, ...], file: Path | None, force: bool, folders: tuple[Path, ...], quiet: bool) -> int:
    """Start a configuration with mechanisms of these kinds: example values, linked to each other, with each key explained.

    Without a KIND the kinds are listed. `clutch:main` names a mechanism; a kind may be given several times.

    Exit codes: 0 written or listed, 1 written, but values are left for you to give, 2 bad input, 3 a plugin broke.
    """
    discovery = Discovery(folders)
    with speaking(spoken_language(), spoken_catalogues(discovery)):
        if not kinds:
            return _list(discovery)
        if file is not None and not force:
            _refuse_existing(file)
        from diecut_report.config.drafting import draft

        with without_output():
            made = draft(kinds, discovery, file.name if file else "my_press.yaml")
            problems = _problems(made, str(file or SHOWN), discovery)
        emit_or_write(made.text, file)
        tell(_draft_messages(made, None if quiet else file))
    tell_problems(problems)
    return CHECK_FAILED if problems else PASSED


def _list(discovery: Discovery) -> int:
    """List the kinds, each in a line."""
    codes, width = [PASSED], max(map(len, discovery.origins))
    for kind in discovery.origins:
        try:
            with without_output():
                title = said(discovery.mechanism(kind).title, kind)
            emit_lines([f"{kind:{width}}  {title}"])
        except (DuplicateKind, PluginError) as fault:
            tell([str(fault)])
            codes.append(BAD_INPUT if isinstance(fault, DuplicateKind) else PLUGIN_BROKE)
    return BAD_INPUT if BAD_INPUT in codes else max(codes)


def _refuse_existing(file: Path) -> None:
    """Refuse a file that is there; a device or a pipe is written into."""
    if os.path.lexists(file) and (file.is_file() or file.is_symlink() or file.is_dir()):
        raise refusal("This already exists and is not overwritten. Choose another name, or give --force.", file)


def _problems(made: Draft, file: str, discovery: Discovery) -> Sequence[Problem]:
    """Return what is wrong with the text; whether such machines can exist is asked where no example gives their values."""
    from diecut_report.config import yaml as yaml_tree
    from diecut_report.press import Press

    tree = yaml_tree.parse(made.text, file)
    try:
        guessed = made.guessed or made.open
        for error in Press.validate(tree, discovery) if guessed else Press.read(tree, discovery).config.broken.values():
            raise error
    except UserError as error:
        return error.problems
    return ()


def _draft_messages(made: Draft, file: Path | None) -> Iterator[str]:
    """Say what was added, and what no example tells."""
    if file is not None:
        yield Phrase("written: {path}", path=file)
    words = "added: {name} ({kind}), required by {asking}"
    yield from (say(words, name=new.name, kind=new.kind, asking=asking.name) for new, asking in made.added)
    if made.guessed:
        yield say("no example values exist for these; enter your own: {keys}", keys=", ".join(made.guessed))
    if made.open:
        yield say("these need a reference that you must provide: {keys}", keys=", ".join(made.open))


# The commands of plugin authors: ``new-plugin`` writes a mechanism that runs, ``check-plugin`` judges one.


STATES = {
    "pass": phrase("holds"),
    "note": phrase("note"),
    "not_tried": phrase("not tried"),
    "fail": phrase("fails"),
    "broke": phrase("broke"),
}


@click.command("new-plugin", cls=HelpfulCommand)
@click.argument("name")
@click.option(
    "--package", "as_package", is_flag=True, help="Create an installable package instead of a folder for --plugins."
)
@click.option(
    "--like",
    default="parts",
    type=click.Choice(["parts", "motion", "selection"]),
    help="Template: parts (default; a list of springs), motion (curves over a turn), selection (a size from a table).",
)
@click.option("-o", "folder", metavar="DIR", type=path_of, help="Folder to create (default: NAME, here).")
@common
def new_plugin(
    name: str, as_package: bool, like: str, folder: Path | None, folders: tuple[Path, ...], quiet: bool
) -> int:
    """Create a working mechanism of the kind NAME: plugin, tests, example, study, translations."""
    from diecut_report.testing.scaffold import scaffold

    home = folder or Path(name)
    written = scaffold(name, home, as_package=as_package, like=like)
    if not quiet:
        tell_written(written)
        tell([Phrase("next: read {file}", file=home / "README.md")])
    return PASSED


@click.command("check-plugin", cls=HelpfulCommand, epilog=output.OF_PLUGIN)
@click.argument("plugin", metavar="NAME|DIR")
@click.option("--config", "configs", metavar="FILE", multiple=True, type=path_of,
              help="A configuration with machines to test it on (default: those beside the plugin).")  # fmt: skip
@json_option
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
    help="Add missing texts to its catalogues for translation, and mark unused ones as obsolete.",
)
@click.option(
    "--open",
    "is_shown",
    is_flag=True,
    help="Show the rendered chapter in the browser; without -o from a temporary folder.",
)
@common
def check_plugin(
    plugin: str, configs: tuple[Path, ...], form: str, page: Path | None, write_po: bool, is_shown: bool, folders: tuple[Path, ...],
    quiet: bool,
) -> int:  # fmt: skip
    """Test a plugin against the rules of its contract; with -o render its chapter as HTML. Ends with 1 where a rule is broken."""
    from diecut_report.testing.plugin_page import CheckedPlugin, checked, meant

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
        emit_json([each.data for each in found])
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
    yield say("{kind}{version}, from {origin}", kind=found.kind, version=version, origin=found.origin)
    if found.error:
        first, *more = said(found.error).split("\n")
        yield f"  {say('broke')}: {first}"
        yield from (f"    {each}" for each in more)
    for rule in found.rules:
        told = f": {said(rule.summary)}" if rule.summary else ""
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
