"""The command of the live page."""

from __future__ import annotations

import webbrowser
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click

from diecut_report.cli.given import DASH
from diecut_report.cli.language import asked_language
from diecut_report.cli.output import PASSED, HelpfulCommand, common, emit, tell, without_output
from diecut_report.config.catalogues import spoken_catalogues
from diecut_report.config.discovery import Discovery
from diecut_report.config.standard_input import SHOWN
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import say, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.live.session import LiveSession


@click.command(cls=HelpfulCommand)
@click.argument("config", type=click.Path(path_type=Path))
@click.option("--port", metavar="N", type=click.IntRange(0, 65535), default=0, help="The port (default: a free one).")
@click.option("--open/--no-open", "is_opened", default=True, help="Whether to open the page in the browser.")
@common
def live(config: Path, port: int, is_opened: bool, folders: tuple[Path, ...], quiet: bool) -> int:
    """Show CONFIG as a page that follows each change of the file, and change its numbers there. Ends with Ctrl-C.

    The page is for this machine alone: its address holds a secret.
    """
    _require_file(config)
    from diecut_report.live.application import LiveApplication
    from diecut_report.live.server import serve
    from diecut_report.live.session import LiveSession

    if not quiet:
        tell([say("reading and calculating {config} …", config=config)])
    discovery = Discovery(folders)
    with without_output():  # a plugin that prints does not spoil the address
        session = LiveSession(config.absolute(), discovery)

    def ready(address: str) -> None:
        emit(f"{address}\n")
        if not quiet:
            tell([say("The page follows the file; Ctrl-C ends it.")])
        if is_opened and not webbrowser.open(address):
            tell([say("No browser could be started; open the address by hand.")])

    words = speaking(spoken_language(), spoken_catalogues(discovery))
    with words, suppress(KeyboardInterrupt):  # how one ends it
        serve(LiveApplication(session, folders, asked_language()), port, ready)
    tell(_unwritten(session))
    return PASSED


def _require_file(config: Path) -> None:
    """Refuse what cannot be followed: standard input, a folder, a file that is not there."""
    if config == DASH:
        words = phrase(
            "The page follows a file that is saved again and again; standard input is read once. Name a file."
        )
        raise UserError(Problem(words, SHOWN))
    if config.is_dir():
        raise UserError(Problem(phrase("This is a folder. Name one configuration in it."), str(config)))
    folder, _, number = str(config).rpartition("#")
    if number.isdecimal() and Path(folder).is_dir() and not config.exists():
        words = Phrase(
            "A stored variant is not a file. Make it one: diecut-report take {variant} -o my_press.yaml", variant=config
        )
        raise UserError(Problem(words, str(config)))
    if not config.is_file():
        raise UserError(Problem(phrase("There is no such file. Check the name and the folder."), str(config)))


def _unwritten(session: LiveSession) -> Iterator[str]:
    """Return what was changed on the page and not written, so that nothing is lost."""
    for name, typed in session.edits.items():
        yield say("changed on the page and not written: {name}: {typed}", name=name, typed=typed)
