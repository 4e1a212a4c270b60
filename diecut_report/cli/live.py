"""The command of the live page."""

from __future__ import annotations

import os
import signal
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Thread
from typing import TYPE_CHECKING

import click

from diecut_report.cli.options import DASH, config_argument
from diecut_report.cli.output import PASSED, HelpfulCommand, asked_language, emit, inform, tell, without_output
from diecut_report.config import yaml
from diecut_report.config.loader import SHOWN, refuse_study
from diecut_report.config.plugins import Discovery, catalogues_of
from diecut_report.errors import UserError, refusal
from diecut_report.text.catalogues import languages
from diecut_report.text.translation import say, speaking, spoken_language

if TYPE_CHECKING:
    from diecut_report.live.session import LiveSession


@click.command(cls=HelpfulCommand)
@config_argument
@click.option("--port", metavar="N", type=click.IntRange(0, 65535), default=0, help="The port (default: a free one).")
@click.option("--open/--no-open", "is_opened", default=True, help="Whether to open the page in the browser.")
def live(config: Path, port: int, is_opened: bool, discovery: Discovery) -> int:
    """Show CONFIG as a live page that follows each change of the file and lets you edit its numbers. End with Ctrl-C.

    The page is only for this machine: its address contains a secret.
    """
    _require_file(config)
    from diecut_report.live.server import LiveApplication, serve
    from diecut_report.live.session import LiveSession

    inform([say("reading and calculating {config} …", config=config)])
    with without_output():  # a plugin that prints does not spoil the address
        session = LiveSession(config.absolute(), discovery)

    language = asked_language() or _of_project(session) or spoken_language()
    with shown_page(is_opened=is_opened) as ready, speaking(language, catalogues_of(language, discovery)):
        serve(LiveApplication(session, discovery.folders, asked_language()), port, ready)
    template = "changed on the page but not saved: {name}: {typed}"  # so that nothing is lost
    for state, edits in session.unsaved:
        tell([say("state not saved: {name}", name=state)] if state else [])
        tell(say(template, name=name, typed=typed) for name, typed in edits.items())
    return PASSED


@contextmanager
def shown_page(*, is_opened: bool) -> Iterator[Callable[[str], None]]:
    """Give what is called with the address of a page that is served within, until Ctrl-C: it is told, and opened in the browser."""
    follows, unopened = (  # said now: the page may have another language
        say("The page follows the file; Ctrl-C ends it."),
        say("No browser could be started; open the address by hand."),
    )

    def ready(address: str) -> None:
        emit(f"{address}\n")
        inform([follows])
        if is_opened:  # beside the server: a browser in a terminal comes back when it is closed, and waits for the page
            Thread(target=show, args=[_door(doors, address)], daemon=True).start()

    def show(door: str) -> None:
        tell([] if webbrowser.open(door) else [unopened])

    with TemporaryDirectory(prefix="diecut-report-") as doors, _until_ended():
        yield ready


@contextmanager
def _until_ended() -> Iterator[None]:
    """Let Ctrl-C, or the system (SIGTERM), end what runs within, and go on behind it."""
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        with suppress(KeyboardInterrupt):
            yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _door(folder: str, address: str) -> str:
    """Return the address of a page, readable for this user alone, that leads on to ``address``: a browser's command line is seen by all users."""
    page = Path(folder) / "live.html"
    page.touch(0o600)
    page.write_text(
        f'<!DOCTYPE html><meta name="referrer" content="no-referrer"><meta http-equiv="refresh" content="0;url={address}">',
        "utf-8",
    )
    return page.as_uri()


def _require_file(config: Path) -> None:
    """Refuse what cannot be followed: standard input, a folder, a file that is not there, a study."""
    if config == DASH:
        template = (
            "The live page follows a file that is saved repeatedly; standard input is read only once. Name a file."
        )
        raise refusal(template, SHOWN)
    if os.path.isdir(config):
        raise refusal("This is a folder. Name one configuration in it.", config)
    folder, _, number = str(config).rpartition("#")
    if number.isdecimal() and os.path.isdir(folder) and not os.path.exists(config):
        template = "A stored variant is not a file. Make it one: diecut-report take {variant} -o my_press.yaml"
        raise refusal(template, config, variant=config)
    if not os.path.isfile(config):
        raise refusal("There is no such file. Check the name and the folder.", config)
    try:
        tree = yaml.load(config)
    except UserError:  # the page tells what is wrong with it, until it is mended
        return
    refuse_study(tree)


def _of_project(session: LiveSession) -> str | None:
    data = session.tree.data if session.tree else None
    project = data.get("project") if isinstance(data, dict) else None
    given = project.get("language") if isinstance(project, dict) else None
    return given if given in languages() else None
