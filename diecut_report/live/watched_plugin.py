"""The chapter of a plugin in the browser, made anew whenever its files change, with each fault beside the line that it is of."""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import Iterator, Sequence
from contextlib import AbstractAsyncContextManager
from glob import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from markupsafe import Markup
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route
from watchfiles import awatch

from diecut_report.live.page import assets
from diecut_report.live.server import watching
from diecut_report.report.pages.html import filled_page
from diecut_report.text.translation import say, spoken_language

AROUND = 2  # lines shown before and behind that of a fault
SETTLED = 100  # milliseconds: an editor may write a file in several steps
PLACE = re.compile(r"(?P<file>[^:]+):(?P<line>\d+)")


class PlacedLine(NamedTuple):
    """Hold a line of a plugin's file: its number, its text, and whether it is that of the fault."""

    number: int
    text: str
    is_meant: bool


class ShownFault(NamedTuple):
    """Hold a fault, or a note, with the lines around it; without these where it is of no line of the plugin's own."""

    status: str
    text: str
    lines: list[PlacedLine]


class WatchedPlugin:
    """Serve the chapter of a plugin.

    ``command`` judges it, with ``-o FILE`` behind it for the chapter as a part of a page; ``home`` is the folder of its files.
    """

    def __init__(self, command: Sequence[str], home: Path) -> None:
        self.command, self.home = command, home
        self.serial, self.is_judging = 0, True
        self.content = self._shown([], "")
        self._is_ending = asyncio.Event()
        routes = [Route("/", self._page), Route("/serial", self._told), Route("/plugin.js", self._script)]
        self.starlette = Starlette(routes=routes, lifespan=self._lifespan)

    def end(self) -> None:
        """Watch no more, so that the server can end."""
        self._is_ending.set()

    def _lifespan(self, _app: Starlette) -> AbstractAsyncContextManager[None]:
        return watching(self._watch(), self.end)

    async def _watch(self) -> None:
        """Judge the plugin at once, and after each change of its files; what is begun then is of files that are no more."""
        judging = asyncio.create_task(self.judge())
        try:
            async for _ in awatch(self.home, debounce=SETTLED, stop_event=self._is_ending):
                judging.cancel()
                judging = asyncio.create_task(self.judge())
        finally:
            judging.cancel()

    async def judge(self) -> None:
        """Judge the plugin in a process of its own, as its modules are loaded once in each, and keep what is to be shown."""
        self.is_judging = True
        with TemporaryDirectory() as place:
            chapter = Path(place) / "chapter.html"
            given = (*self.command, "-o", str(chapter))
            process = await asyncio.create_subprocess_exec(
                *given, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE
            )
            try:
                out, err = await process.communicate()
            finally:
                if process.returncode is None:
                    process.kill()
                    await process.wait()
            made = chapter.read_text("utf-8") if chapter.is_file() else ""
        try:
            judged: list[dict[str, Any]] = json.loads(out)
        except ValueError:  # it ended before it could answer
            judged = [{"error": (err or out).decode("utf-8", "replace"), "rules": []}]
        self.serial += 1
        self.content, self.is_judging = self._shown([*self._faults(judged)], made), False

    def _faults(self, judged: Sequence[dict[str, Any]]) -> Iterator[ShownFault]:
        for plugin in judged:
            if "error" in plugin:
                yield ShownFault("fail", plugin["error"], [])
            for rule in plugin["rules"]:
                if rule["status"] in ("fail", "broke", "note"):
                    for text, place in zip(rule["faults"], rule["places"], strict=True):
                        yield ShownFault(rule["status"], text, [*self._lines(place)])

    def _lines(self, place: str) -> Iterator[PlacedLine]:
        """The lines around a place ``NAME.py:LINE``; none where no file of the plugin, or several, are called so."""
        found = PLACE.fullmatch(place)
        files = [*self.home.rglob(escape(Path(found["file"]).name))] if found else []
        if found and len(files) == 1:
            meant, lines = int(found["line"]), files[0].read_text("utf-8", "replace").splitlines()
            for number in range(max(1, meant - AROUND), min(len(lines), meant + AROUND) + 1):
                yield PlacedLine(number, lines[number - 1], number == meant)

    def _shown(self, faults: list[ShownFault], chapter: str) -> bytes:
        """The page: what is wrong, and below it the chapter."""
        return filled_page(
            "live/plugin.html.j2", language=spoken_language(), say=say, name=self.home.name, serial=self.serial,
            faults=faults, chapter=Markup(chapter),
        ).encode()  # fmt: skip

    # --- what the page asks ------------------------------------------------------------------------------------------

    async def _page(self, _request: Request) -> Response:
        return Response(self.content, media_type="text/html; charset=utf-8")

    async def _told(self, _request: Request) -> Response:
        return Response(json.dumps([self.serial, self.is_judging]), media_type="application/json")

    async def _script(self, _request: Request) -> Response:
        script = assets()["plugin.js"]
        return Response(script.content, media_type=script.media_type)
