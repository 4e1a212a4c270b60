"""The commands that begin a configuration or a plugin, and that judge a plugin."""

from __future__ import annotations

import os
import sys
import webbrowser
from collections.abc import Iterator, Mapping, Sequence
from importlib import resources
from pathlib import Path
from tempfile import mkdtemp
from typing import TYPE_CHECKING

import click

from diecut_report.cli import output
from diecut_report.cli.options import flag, form_option, output_file, path_option
from diecut_report.cli.output import (
    BAD_INPUT,
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    asked_language,
    emit_json,
    emit_lines,
    emit_or_write,
    inform,
    is_quiet,
    tell,
    tell_problems,
    tell_written,
    without_output,
)
from diecut_report.config import yaml
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.plugins import Discovery, DuplicateKind, spoken_catalogues
from diecut_report.errors import PluginError, Problem, UserError, nearest, refusal
from diecut_report.files import write_all
from diecut_report.text.phrases import Counted, Phrase, joined, phrase
from diecut_report.text.translation import said, say, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.config.drafting import Draft
    from diecut_report.testing.plugin_page import CheckedPlugin


@click.command("new", cls=HelpfulCommand)
@click.argument("kinds", metavar="[KIND[:NAME] …]", nargs=-1, shell_complete=output.kinds)
@click.option("-o", "file", metavar="FILE", type=output_file, help="Where to write (default: standard output).")
@flag("--force", help="Overwrite an existing file.")
@click.option("--machine", metavar="NAME", help="A whole machine, described by its parts: flat_cylinder.")
def new(kinds: tuple[str, ...], file: Path | None, force: bool, machine: str | None, discovery: Discovery) -> int:
    """Start a configuration with mechanisms of these kinds: example values, linked to each other, with each key explained.

    Without a KIND the kinds are listed. `clutch:main` names a mechanism; a kind may be given several times. Of the parts of a machine
    (machine, shafts, meshes, chains, belts) all keys are shown.

    Exit codes: 0 written or listed, 1 written, but values are left for you to give, 2 bad input, 3 a plugin broke.
    """
    with speaking(spoken_language(), spoken_catalogues(discovery)):
        if machine and kinds:
            raise refusal("A whole machine is asked for, and kinds beside it. Give --machine alone, or kinds.")
        if not kinds and not machine:
            return _list(discovery)
        # a device or a pipe that is there is written into
        if file and not force and os.path.lexists(file) and (file.is_file() or file.is_symlink() or file.is_dir()):
            raise refusal("This already exists and is not overwritten. Choose another name, or give --force.", file)
        if machine:
            emit_or_write(_machine(machine), file)
            return PASSED
        if words := [word for word in kinds if word in WORDS]:
            from diecut_report.config.part_forms import part_forms

            if len(words) < len(kinds):
                raise refusal(
                    "Keys of parts are asked for ({words}), and kinds beside them. Ask for each alone.",
                    words=", ".join(words),
                )
            emit_or_write(part_forms(words), file)
            return PASSED
        from diecut_report.config.drafting import draft

        with without_output():
            made = draft(kinds, discovery, file.name if file else "my_press.yaml")
            problems = _problems(made, str(file or "<stdout>"), discovery)
        emit_or_write(made.text, file)
        tell(_draft_messages(made, None if is_quiet() else file))
    tell_problems(problems)
    return CHECK_FAILED if problems else PASSED


def _machine(name: str) -> str:
    """The text of a whole machine; UserError where there is none of this name."""
    folder = resources.files("diecut_report.configs") / "machines"
    known = sorted(each.name.removesuffix(".yaml") for each in folder.iterdir() if each.name.endswith(".yaml"))
    if name not in known:
        template = "There is no machine {name}{near}. Known: {known}."
        raise refusal(template, name=repr(name), near=nearest(name, known), known=", ".join(known))
    return (folder / f"{name}.yaml").read_text("utf-8")


def _list(discovery: Discovery) -> int:
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


def _problems(made: Draft, file: str, discovery: Discovery) -> Sequence[Problem]:
    """Return what is wrong with the text; whether such machines can exist is asked where no example gives their values."""
    from diecut_report.press import Press

    tree = yaml.parse(made.text, file)
    try:
        guessed = made.guessed or made.open
        for error in Press.validate(tree, discovery) if guessed else Press.read(tree, discovery).config.broken.values():
            raise error
    except UserError as error:
        return error.problems
    return ()


def _draft_messages(made: Draft, file: Path | None) -> Iterator[str]:
    if file is not None:
        yield Phrase("written: {path}", path=file)
    template = "added: {name} ({kind}), required by {asking}"
    yield from (say(template, name=new.name, kind=new.kind, asking=asking.name) for new, asking in made.added)
    if made.guessed:
        yield say("no example values exist for these; enter your own: {keys}", keys=", ".join(made.guessed))
    if made.open:
        yield say("these need a reference that you must provide: {keys}", keys=", ".join(made.open))


STATES = {
    "pass": phrase("holds"),
    "note": phrase("note"),
    "not_tried": phrase("not tried"),
    "fail": phrase("fails"),
    "broke": phrase("broke"),
}


@click.command("new-plugin", cls=HelpfulCommand)
@click.argument("name")
@flag("--package", "as_package", help="Create an installable package instead of a folder for --plugins.")
@click.option(
    "--like",
    default="parts",
    type=click.Choice(["parts", "motion", "selection"]),
    help="Template: parts (default; a list of springs), motion (curves over a turn), selection (a size from a table).",
)
@path_option("-o", "folder", metavar="DIR", help="Folder to create (default: NAME, here).")
def new_plugin(name: str, as_package: bool, like: str, folder: Path | None, discovery: Discovery) -> int:
    """Create a working mechanism of the kind NAME: plugin, tests, example, study, translations."""
    from diecut_report.testing.scaffold import scaffold

    home = folder or Path(name)
    written = scaffold(name, home, as_package=as_package, like=like)
    tell_written(written)
    inform([Phrase("next: read {file}", file=home / "README.md")])
    return PASSED


@click.command("check-plugin", cls=HelpfulCommand, epilog=output.OF_PLUGIN)
@click.argument("plugin", metavar="NAME|DIR")
@path_option("--config", "configs", multiple=True,
             help="A configuration with machines to test it on (default: those beside the plugin).")  # fmt: skip
@form_option("text", "json")
@path_option("-o", "page", help="Write the rendered chapter; of several plugins, or into a folder, each as NAME.html.")
@flag("--write-po", help="Add missing texts to its catalogues for translation, and mark unused ones as obsolete.")
@flag("--open", "is_shown", help="Show the rendered chapter in the browser; without -o from a temporary folder.")
@flag(
    "--watch",
    "is_watched",
    help="Show chapter and faults in the browser, again after each change of the plugin's files; end with Ctrl-C.",
)
@click.option(
    "--part", "is_part", is_flag=True, hidden=True
)  # the chapter is to stand within the page that --watch shows
def check_plugin(
    plugin: str, configs: tuple[Path, ...], form: str, page: Path | None, write_po: bool, is_shown: bool, is_watched: bool, is_part: bool,
    discovery: Discovery,
) -> int:  # fmt: skip
    """Test a plugin against the rules of its contract; with -o render its chapter as HTML. Ends with 1 where a rule is broken."""
    from diecut_report.testing.plugin_page import checked, meant

    if is_watched:
        return _watched(plugin, configs, discovery)
    known, kinds = meant(plugin, discovery.folders)
    if page is not None and len(kinds) > 1 and page.suffix:
        template = "{folder} has {n} plugins; name one of them, or give a folder with -o."
        raise click.UsageError(say(template, folder=plugin, n=len(kinds)))
    with without_output():
        language = asked_language() or spoken_language()
        found = [checked(known, kind, configs, language, write_po=write_po, is_part=is_part) for kind in kinds]
    if form == "json":
        emit_json([each.data for each in found])
    else:
        emit_lines(line for each in found for line in _lines(each))
    for each in found:
        _tell_changed(each)
    pages = {each.kind: each.page.encode() for each in found if each.page}
    if page or is_shown:
        _write_pages(pages, page, configs, is_single=len(kinds) == 1, is_shown=is_shown)
    elif pages and form == "text":
        inform([Phrase("-o FILE writes the chapter as it stands in a report, --open shows it")])
    states = {each.status for each in found}
    return PLUGIN_BROKE if "broke" in states else CHECK_FAILED if "fail" in states else PASSED


def _watched(plugin: str, configs: Sequence[Path], discovery: Discovery) -> int:
    """Show a plugin's chapter in the browser until Ctrl-C; what is asked for otherwise is done by the process that judges it."""
    from diecut_report.cli.live import shown_page
    from diecut_report.live.server import serve
    from diecut_report.live.watched_plugin import WatchedPlugin
    from diecut_report.testing.plugin_page import home_of

    home = home_of(plugin, discovery.folders)
    command = [sys.executable, "-m", "diecut_report", "check-plugin", plugin, "--format", "json", "--part"]
    command += [text for file in configs for text in ("--config", str(file))]
    command += [text for folder in discovery.folders for text in ("--plugins", str(folder))]
    command += ["--language", asked_language() or spoken_language()]
    with shown_page(is_opened=True) as ready:
        serve(WatchedPlugin(command, home), 0, ready)
    return PASSED


def _lines(found: CheckedPlugin) -> Iterator[str]:
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


def _tell_changed(found: CheckedPlugin) -> None:
    for file, made in found.changed.items():
        added = Counted(made.added, "{n} text to be translated", "{n} texts to be translated")
        obsolete = Counted(made.obsolete, "{n} text is obsolete", "{n} texts are obsolete")
        returned = Counted(
            made.returned, "{n} text has its translation again", "{n} texts have their translations again"
        )
        told = joined([each for each in (added, obsolete, returned) if each.number], ", ")
        inform([Phrase("written: {file}: {told}", file=file, told=told)])


def _write_pages(
    pages: Mapping[str, bytes], asked: Path | None, configs: tuple[Path, ...], *, is_single: bool, is_shown: bool
) -> None:  # fmt: skip
    """Write each chapter into the file that is named, or into one of its own in a folder; where none is named a temporary folder."""
    place = asked or Path(mkdtemp(prefix="diecut-report-"))
    is_file = asked and is_single and not asked.is_dir()
    files = {place if is_file else place / f"{kind}.html": page for kind, page in pages.items()}
    write_all(files, keep=configs)
    tell_written(files)
    for page in files if is_shown else ():
        webbrowser.open(page.resolve().as_uri())
