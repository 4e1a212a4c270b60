"""What the live page asks for and is told: an application of Starlette around one session, which one thread works on."""

from __future__ import annotations

import asyncio
import json
import threading
from collections.abc import AsyncIterator, Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager, suppress
from contextvars import copy_context
from pathlib import Path
from typing import Any, TypeVar

from starlette.applications import Starlette
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Route
from watchfiles import awatch

from diecut_report.errors import PluginError, UserError
from diecut_report.languages.speech import said, say
from diecut_report.live.effects import effect
from diecut_report.live.page import assets, page
from diecut_report.live.page_data import page_data
from diecut_report.live.pictures_of_run import Pictures
from diecut_report.live.reports import LiveReports
from diecut_report.live.session import LiveMachine, LiveSession, in_time

Found = TypeVar("Found")
SETTLED, STEP = 60, 20  # milliseconds: an editor may write a file in several steps
ALIVE = 15.0  # seconds after which a silent stream says that it is there
LOOK = 0.1  # seconds between looks whether a page still waits for what is calculated
AGAIN = 1.0  # seconds between looks at the files beside what the watch tells


class _GivesWay(Exception):
    """End what nobody waits for as long as for what has come meanwhile."""


class LiveApplication:
    """Serve a session. ``folders`` are those of foreign plugins, which a report is made with; ``language`` is asked for it."""

    def __init__(self, session: LiveSession, folders: tuple[Path, ...], language: str | None) -> None:
        self.session = session
        self.pictures, self.reports = Pictures(), LiveReports(folders, language)
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="live")
        self._streams: set[asyncio.Event] = (
            set()
        )  # one of each: a condition that streams share hangs where one is cancelled
        self._told = -1, b""
        self._is_reading = False
        self._waiting = 0  # how much is to be done that a hand waits for
        self._is_ending = asyncio.Event()
        routes = [
            Route("/", self._page), Route("/assets/{name}", self._asset), Route("/events", self._events),
            Route("/figure/{mechanism}/{index:int}", self._figure), Route("/effect", self._effect),
            Route("/report/{form}", self._report),
            Route("/change", self._change, methods=["POST"]), Route("/back", self._back, methods=["POST"]),
            Route("/write", self._write, methods=["POST"]),
        ]  # fmt: skip
        self.starlette = Starlette(
            routes=routes, lifespan=self._lifespan, exception_handlers={UserError: _refused, PluginError: _refused}
        )

    @asynccontextmanager
    async def _lifespan(self, _app: Starlette) -> AsyncIterator[None]:
        watching = asyncio.create_task(self._watch())
        try:
            yield
        finally:
            self.end()
            watching.cancel()
            with suppress(asyncio.CancelledError):
                await watching
            self._worker.shutdown(wait=False, cancel_futures=True)

    def end(self) -> None:
        """End all streams, so that the server can end."""
        self._is_ending.set()
        self._tell()

    async def _done(self, work: Callable[[], Found]) -> Found:
        """Let the one thread do it: the session and the figures know only one."""
        self._waiting += 1
        try:
            return await self._begun(work)
        finally:
            self._waiting -= 1

    def _begun(self, work: Callable[[], Found]) -> asyncio.Future[Found]:
        spoken = copy_context()  # with the language that is spoken
        return asyncio.get_running_loop().run_in_executor(self._worker, spoken.run, work)

    # --- what changes ------------------------------------------------------------------------------------------------

    async def _watch(self) -> None:
        """Read the file again whenever it, or what it names, is another than what was read.

        What a watch of the folder does not tell (a save before it began, a table elsewhere, a folder that is gone and comes
        back, a disk of the network) is seen by a look now and then.
        """
        while not self._is_ending.is_set():
            with suppress(OSError):  # the folder is gone, or cannot be watched: it is looked at again below
                async for _ in awatch(
                    self.session.file.parent, debounce=SETTLED, step=STEP, rust_timeout=round(AGAIN * 1000),
                    yield_on_timeout=True, stop_event=self._is_ending, recursive=False,
                ):  # fmt: skip
                    await self._read_where_changed()
            await asyncio.sleep(AGAIN)
            await self._read_where_changed()

    async def _read_where_changed(self) -> None:
        # beside the one thread, on which an effect would give way to each look
        if await asyncio.to_thread(self.session.is_stale):
            self._is_reading = True
            self._tell()
            try:
                await self._done(self.session.read)
            finally:
                self._is_reading = False
                self._tell()

    def _tell(self) -> None:
        for changed in self._streams:
            changed.set()

    async def _state(self) -> tuple[int, bytes]:
        """The state as the page gets it; made once for all pages that look."""

        def made() -> tuple[int, bytes]:
            if self._told[0] != self.session.serial:
                text = json.dumps(page_data(self.session), ensure_ascii=False, allow_nan=False, default=str)
                self._told = self.session.serial, text.encode()
            return self._told

        return self._told if self._told[0] == self.session.serial else await self._done(made)

    async def _events(self, _request: Request) -> Response:
        return StreamingResponse(self._stream(), media_type="text/event-stream")

    async def _stream(self) -> AsyncIterator[bytes]:
        """The state now, and again whenever it changes."""
        serial, changed = -1, asyncio.Event()
        self._streams.add(changed)
        try:
            while not self._is_ending.is_set():
                changed.clear()
                now, text = await self._state()
                if now != serial:
                    serial = now
                    yield b"data: " + text + b"\n\n"
                    continue
                with suppress(TimeoutError):
                    await asyncio.wait_for(changed.wait(), ALIVE)
                yield b"event: busy\ndata: 1\n\n" if self._is_reading else b": still here\n\n"
        finally:
            self._streams.discard(changed)

    # --- what is asked -----------------------------------------------------------------------------------------------

    async def _page(self, _request: Request) -> Response:
        return Response(page(self.session.file.name), media_type="text/html; charset=utf-8")

    async def _asset(self, request: Request) -> Response:
        found = assets().get(request.path_params["name"])
        return Response(status_code=404) if found is None else Response(found.content, media_type=found.media_type)

    async def _figure(self, request: Request) -> Response:
        mechanism, index = request.path_params["mechanism"], request.path_params["index"]
        return await self._of_machine(lambda machine: self.pictures.figure(machine, mechanism, index))

    async def _effect(self, request: Request) -> Response:
        """An effect is a whole run of many machines: it gives way to all else, and ends where its page looks at another."""
        name, has_gone = request.query_params.get("input", ""), threading.Event()

        def give_way(_mechanism: str) -> None:
            if self._waiting or has_gone.is_set():
                raise _GivesWay

        while not has_gone.is_set():
            found = self._begun(self._of_last(lambda machine: effect(machine, name, give_way)))
            while not (await asyncio.wait([found], timeout=LOOK))[0]:
                if self._is_ending.is_set() or await request.is_disconnected():
                    has_gone.set()
            with suppress(_GivesWay):
                return JSONResponse(found.result())
        return Response(status_code=503)

    async def _of_machine(self, make: Callable[[LiveMachine], dict[str, Any]]) -> Response:
        return JSONResponse(await self._done(self._of_last(make)))

    def _of_last(self, make: Callable[[LiveMachine], dict[str, Any]]) -> Callable[[], dict[str, Any]]:
        """What is made of the last machine that could be calculated."""

        def made() -> dict[str, Any]:
            machine = self.session.machine
            with in_time(self.session.file):
                return {"none": True} if machine is None else make(machine)

        return made

    async def _report(self, request: Request) -> Response:
        machine = self.session.machine
        if machine is None:
            return Response(say("There is no machine to report of yet; see the faults of the file."), 409)
        results = await self._done(self._of_last(lambda last: last.run.document()))
        made = await self.reports.made(results, request.path_params["form"])
        return Response(made.content, media_type=made.media_type, headers=made.headers)

    async def _change(self, request: Request) -> Response:
        given = await _sent(request)
        changes = given.get("changes")
        if not isinstance(changes, dict) or not all(isinstance(typed, str) for typed in changes.values()):
            return Response(status_code=400)
        return await self._acted(lambda: self.session.change(changes))

    async def _back(self, request: Request) -> Response:
        names = (await _sent(request)).get("names")
        if names is not None and not (isinstance(names, list) and all(isinstance(name, str) for name in names)):
            return Response(status_code=400)
        return await self._acted(lambda: self.session.take_back(names))

    async def _write(self, _request: Request) -> Response:
        return await self._acted(self.session.write)

    async def _acted(self, act: Callable[[], None]) -> Response:
        try:
            await self._done(act)
        finally:
            self._tell()  # what is refused may have read the file again
        return JSONResponse({"serial": self.session.serial})


async def _sent(request: Request) -> dict[str, Any]:
    try:
        found = json.loads(await request.body())
    except (ValueError, RecursionError, ClientDisconnect):
        return {}
    return found if isinstance(found, dict) else {}


async def _refused(_request: Request, error: Exception) -> Response:
    """Tell in words what a user can mend, or which plugin broke."""
    problem = error.problems[0] if isinstance(error, UserError) else None
    told = {"refused": said(problem.message if problem else str(error)), "path": problem.path if problem else ""}
    return JSONResponse(told, status_code=422)
