"""The command that begins a configuration."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from diecut_report.cli import completion
from diecut_report.cli.given import output_file
from diecut_report.cli.output import (
    BAD_INPUT,
    CHECK_FAILED,
    PASSED,
    PLUGIN_BROKE,
    HelpfulCommand,
    common,
    emit,
    emit_lines,
    tell,
    tell_problems,
    without_output,
)
from diecut_report.config.catalogues import spoken_catalogues
from diecut_report.config.discovery import Discovery, DuplicateKind
from diecut_report.errors import PluginError, Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import said, say, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.drafting.draft import Draft

SHOWN = "<stdout>"


@click.command("new", cls=HelpfulCommand)
@click.argument("kinds", metavar="[KIND[:NAME] …]", nargs=-1, shell_complete=completion.kinds)
@click.option("-o", "file", metavar="FILE", type=output_file, help="Where to write (default: standard output).")
@click.option("--force", is_flag=True, help="Write over a file that is there.")
@common
def new(kinds: tuple[str, ...], file: Path | None, force: bool, folders: tuple[Path, ...], quiet: bool) -> int:
    """Begin a configuration with mechanisms of these kinds: example values, wired to each other, each key explained.

    Without a KIND the kinds are listed. `clutch:main` names a mechanism; a kind may be given several times.

    Exit codes: 0 written or listed, 1 written, but values are left for you to give, 2 bad input, 3 a plugin broke.
    """
    discovery = Discovery(folders)
    with speaking(spoken_language(), spoken_catalogues(discovery)):
        if not kinds:
            return _list(discovery)
        if file is not None and not force:
            _refuse_existing(file)
        from diecut_report.drafting.draft import draft

        with without_output():
            made = draft(kinds, discovery, file.name if file else "my_press.yaml")
            problems = _problems(made, str(file or SHOWN), discovery)
        _give(made, file)
        tell(_told(made, None if quiet else file))
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
        words = phrase("This is there already; it is not written over. Choose another name, or give --force.")
        raise UserError(Problem(words, str(file)))


def _problems(made: Draft, file: str, discovery: Discovery) -> Sequence[Problem]:
    """Return what is wrong with the text; whether such machines can exist is asked where no example gives their values."""
    from diecut_report import pipeline
    from diecut_report.config import yaml_tree
    from diecut_report.config.loader import load_config

    tree = yaml_tree.parse(made.text, file)
    try:
        guessed = made.guessed or made.open
        for error in pipeline.validate(tree, discovery) if guessed else load_config(tree, discovery).broken.values():
            raise error
    except UserError as error:
        return error.problems
    return ()


def _give(made: Draft, file: Path | None) -> None:
    if file is None:
        emit(made.text)
        return
    from diecut_report.files import write_all

    write_all({file: made.text.encode()}, keep=file.parent, through=True)


def _told(made: Draft, file: Path | None) -> Iterator[str]:
    """Say what was added, and what no example tells."""
    if file is not None:
        yield Phrase("written: {path}", path=file)
    for new_one, asking in made.added:
        words = "added: {name} ({kind}), which {asking} cannot be without"
        yield say(words, name=new_one.name, kind=new_one.kind, asking=asking.name)
    if made.guessed:
        words = "no example tells these; put in your own: {keys}"
        yield say(words, keys=", ".join(made.guessed))
    if made.open:
        words = "these take a reference that only you can give: {keys}"
        yield say(words, keys=", ".join(made.open))
