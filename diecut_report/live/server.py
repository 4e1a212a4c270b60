"""The server of the live page: on the loopback alone, behind an address that nobody else knows."""

from __future__ import annotations

import asyncio
import errno
import gc
import json
import re
import secrets
import socket
import threading
from collections.abc import AsyncIterator, Awaitable, Callable, Coroutine, MutableMapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager, suppress
from contextvars import copy_context
from hmac import compare_digest
from pathlib import Path
from typing import Any, Protocol, TypeVar

import uvicorn
from starlette.applications import Starlette
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Route
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle
from watchfiles import awatch

from diecut_report.errors import PluginError, UserError, refusal
from diecut_report.live.page import Pictures, advice, assets, effect, page, page_data
from diecut_report.live.session import MEDIA_TYPES, NAME, LiveMachine, LiveReports, LiveSession, in_time
from diecut_report.results.press_run import Tell
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import said, say

# What the live page asks for and is told: an application of Starlette around one session, which one thread works on.


Found = TypeVar("Found")
SETTLED, STEP = 60, 20  # milliseconds: an editor may write a file in several steps
MAX_LOOKS = 20  # at a file that is written all the time, before it is read as it is
ALIVE = 15.0  # seconds after which a silent stream says that it is there
LOOK = 0.1  # seconds between looks whether a page still waits for what is calculated
AGAIN = 1.0  # seconds between looks at the files beside what the watch tells


class _GivesWay(Exception):
    """End what nobody waits for as long as for what has come meanwhile."""


@asynccontextmanager
async def watching(watch: Coroutine[Any, Any, None], end: Callable[[], None]) -> AsyncIterator[None]:
    """Watch as long as a server lives, and end what hangs on it."""
    task = asyncio.create_task(watch)
    try:
        yield
    finally:
        end()
        task.cancel()
        with suppress(asyncio.CancelledError):
            await task


class LiveApplication:
    """Serve a session. ``folders`` are those of foreign plugins, which a report is made with; ``language`` is asked for it."""

    def __init__(self, session: LiveSession, folders: tuple[Path, ...], language: str | None) -> None:
        self.session = session
        self.pictures, self.reports = Pictures(), LiveReports(folders, language)
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="live")
        # one event of each stream: a condition that streams share hangs where one is cancelled
        self._streams: set[asyncio.Event] = set()
        self._told = -1, b""
        self._is_reading = False
        self._waiting = 0  # how much is to be done that a hand waits for
        self._is_ending = asyncio.Event()
        routes = [
            Route("/", self._page), Route("/assets/{name}", self._asset), Route("/events", self._events),
            Route("/figure/{mechanism}/{index}", self._figure), Route("/effect", self._effect),
            Route("/advice", self._advice),
            Route("/view/{index}", self._view),
            Route("/report/{form}", self._report), Route("/comparison", self._comparison),
            Route("/change", self._change, methods=["POST"]), Route("/back", self._back, methods=["POST"]),
            Route("/write", self._write, methods=["POST"]), Route("/undo", self._undo, methods=["POST"]),
            Route("/redo", self._redo, methods=["POST"]), Route("/state/{act}", self._state_act, methods=["POST"]),
        ]  # fmt: skip
        self.starlette = Starlette(
            routes=routes, lifespan=self._lifespan, exception_handlers={UserError: _refused, PluginError: _refused}
        )

    @asynccontextmanager
    async def _lifespan(self, _app: Starlette) -> AsyncIterator[None]:
        try:
            async with watching(self._watch(), self.end):
                yield
        finally:
            self._worker.shutdown(wait=False, cancel_futures=True)

    def end(self) -> None:
        """End all streams, so that the server can end."""
        self._is_ending.set()
        self._tell()

    async def _done(self, work: Callable[[], Found]) -> Found:
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
            await self._settled()
            self._is_reading = True
            self._tell()
            try:
                await self._done(self.session.read)
            finally:
                self._is_reading = False
                self._tell()

    async def _settled(self) -> None:
        """Wait until what is being written is written: a look now and then may meet a file between emptied and filled."""
        seen = None
        for _ in range(MAX_LOOKS):
            if seen == (seen := await asyncio.to_thread(self.session.marks)):
                break
            await asyncio.sleep(SETTLED / 1000)

    def _tell(self) -> None:
        for changed in self._streams:
            changed.set()

    async def _state(self) -> tuple[int, bytes]:

        def made() -> tuple[int, bytes]:
            if self._told[0] != self.session.serial:
                text = json.dumps(page_data(self.session), ensure_ascii=False, allow_nan=False, default=str)
                self._told = self.session.serial, text.encode()
            return self._told

        return self._told if self._told[0] == self.session.serial else await self._done(made)

    async def _events(self, _request: Request) -> Response:
        return StreamingResponse(self._stream(), media_type="text/event-stream")

    async def _stream(self) -> AsyncIterator[bytes]:
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

    async def _view(self, request: Request) -> Response:
        return await self._picture(request, self.pictures.view)

    async def _figure(self, request: Request) -> Response:
        mechanism = request.path_params["mechanism"]
        return await self._picture(request, lambda machine, index: self.pictures.figure(machine, mechanism, index))

    async def _picture(self, request: Request, draw: Callable[[LiveMachine, int], dict[str, Any]]) -> Response:
        index = request.path_params["index"]
        if not re.fullmatch("[0-9]{1,9}", index):
            return Response(status_code=404)
        return JSONResponse(await self._done(self._of_last(lambda machine: draw(machine, int(index)))))

    async def _effect(self, request: Request) -> Response:
        name = request.query_params.get("input", "")
        return await self._giving_way(request, lambda machine, tell: effect(machine, name, tell))

    async def _advice(self, request: Request) -> Response:
        name = request.query_params.get("mechanism", "")
        return await self._giving_way(request, lambda machine, tell: advice(machine, name, tell))

    async def _giving_way(self, request: Request, make: Callable[[LiveMachine, Tell], dict[str, Any]]) -> Response:
        """What is a run of many machines gives way to all else, and ends where its page looks at another."""
        has_gone = threading.Event()

        def give_way(_mechanism: str) -> None:
            if self._waiting or has_gone.is_set():
                raise _GivesWay

        while not has_gone.is_set():
            found = self._begun(self._of_last(lambda machine: make(machine, give_way)))
            while not (await asyncio.wait([found], timeout=LOOK))[0]:
                if self._is_ending.is_set() or await request.is_disconnected():
                    has_gone.set()
            with suppress(_GivesWay):
                return JSONResponse(found.result())
        return Response(status_code=503)

    def _of_last(self, make: Callable[[LiveMachine], dict[str, Any]]) -> Callable[[], dict[str, Any]]:

        def made() -> dict[str, Any]:
            machine = self.session.machine
            with in_time(self.session.file):
                return {"none": True} if machine is None else make(machine)

        return made

    async def _report(self, request: Request) -> Response:
        machine = self.session.machine
        if machine is None:
            return Response(say("There is no machine to report yet; see the errors in the file."), 409)

        form = request.path_params["form"]
        content = await self.reports.made(machine.config, form)
        headers = {"content-disposition": f'inline; filename="{NAME}.{form}"'}
        return Response(content, media_type=MEDIA_TYPES[form], headers=headers)

    async def _comparison(self, request: Request) -> Response:
        machines = self.session.machines
        chosen = {name: machines[name].config for name in request.query_params.getlist("state") if name in machines}
        if not chosen:
            return Response(say("Choose the states to be compared."), 409)
        content = await self.reports.compared(chosen)
        return Response(content, media_type=MEDIA_TYPES["html"])

    async def _change(self, request: Request) -> Response:
        given = await _sent(request)
        changes, stroke = given.get("changes"), given.get("stroke", "")
        if not isinstance(changes, dict) or not all(isinstance(text, str) for text in (stroke, *changes.values())):
            return Response(status_code=400)
        return await self._acted(lambda: self.session.change(changes, stroke))

    async def _back(self, request: Request) -> Response:
        names = (await _sent(request)).get("names")
        if names is not None and not (isinstance(names, list) and all(isinstance(name, str) for name in names)):
            return Response(status_code=400)
        return await self._acted(lambda: self.session.take_back(names))

    async def _write(self, _request: Request) -> Response:
        return await self._acted(self.session.write)

    async def _undo(self, _request: Request) -> Response:
        return await self._acted(self.session.undo)

    async def _redo(self, _request: Request) -> Response:
        return await self._acted(self.session.redo)

    async def _state_act(self, request: Request) -> Response:
        session = self.session
        acts: dict[str, Callable[[str], object]]
        acts = {"keep": session.keep, "forget": session.forget, "return": session.return_to, "save": session.save}
        act, name = acts.get(request.path_params["act"]), (await _sent(request)).get("name")
        if act is None or not isinstance(name, str):
            return Response(status_code=400)
        return await self._acted(lambda: act(name))

    async def _acted(self, act: Callable[[], object]) -> Response:
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


# Who may speak with the live page's server: this machine, by an address with its token, from a page of its own.


Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
App = Callable[[Message, Receive, Send], Awaitable[None]]

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; font-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",  # the address holds the token
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}
MAX_BODY_BYTES = 200_000  # bytes of what a page sends
READING = ("GET", "HEAD")
BODY_SECONDS = 10.0  # within which each part of what a page sends has to come


class Guard:
    """Let through requests whose host is this machine, whose path begins with the token and whose origin, if any, is the page's own.

    A name that leads here from elsewhere (DNS rebinding) is another host; a page of another origin may send, but is refused.
    """

    def __init__(self, app: App, port: int, token: str) -> None:
        self.app, self.token = app, token
        self.hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}

    async def __call__(self, scope: Message, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        status = self._refusal(scope)
        if status:
            await send({"type": "http.response.start", "status": status, "headers": [(b"content-length", b"0")]})
            await send({"type": "http.response.body", "body": b""})
            return
        inner = {**scope, "path": scope["path"][len(self.token) + 1 :] or "/", "raw_path": None}
        body = _BoundedBody(receive, scope["method"])
        await self.app(inner, body, _with_headers(send, body))

    def _refusal(self, scope: Message) -> int:
        if scope["type"] != "http":
            return 403
        headers = {name.decode("latin-1"): value.decode("latin-1") for name, value in scope["headers"]}
        first = scope["path"].split("/")[1] if scope["path"].startswith("/") else ""
        if headers.get("host", "") not in self.hosts:
            return 421
        if not compare_digest(first.encode(), self.token.encode()):
            return 404
        origin = headers.get("origin")
        if origin is None:
            is_own = headers.get("sec-fetch-site", "none") in ("none", "same-origin")
            is_opened = headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
            return 0 if scope["method"] in READING and (is_own or is_opened) else 403
        if origin not in {f"http://{host}" for host in self.hosts}:
            return 403
        return 413 if int(headers.get("content-length") or 0) > MAX_BODY_BYTES else 0


class _BoundedBody:
    """Read a body of bounded size, whatever length it announces, that comes in bounded time; else it counts as broken off."""

    def __init__(self, receive: Receive, method: str) -> None:
        self.receive, self.taken, self.is_whole, self.is_broken_off = receive, 0, method in READING, False

    async def __call__(self) -> Message:
        if self.is_whole:
            return await self.receive()  # which waits until the page has gone
        try:
            message = await asyncio.wait_for(self.receive(), BODY_SECONDS)
        except TimeoutError:
            return self._broken_off()
        self.taken += len(message.get("body", b""))
        self.is_whole = not message.get("more_body", False)
        return self._broken_off() if self.taken > MAX_BODY_BYTES else message

    def _broken_off(self) -> Message:
        self.is_whole = self.is_broken_off = True
        return {"type": "http.disconnect"}


def _with_headers(send: Send, body: _BoundedBody) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            given = list(message.get("headers", ()))
            given += [(b"connection", b"close")] if body.is_broken_off else []  # what is still sent is not read
            message = {
                **message,
                "headers": [*given, *((name.encode(), text.encode()) for name, text in HEADERS.items())],
            }
        await send(message)

    return sent


HOST = "127.0.0.1"
ENDING = 2  # seconds that open answers have at the end
IDLE = 10.0  # seconds after which a connection that asks nothing, or not to the end, is closed
CONNECTIONS = 100  # at a time


class Application(Protocol):
    """Answer what a page asks, until it is to end."""

    starlette: Starlette

    def end(self) -> None:
        """End what a page waits for."""


def serve(application: Application, port: int, ready: Callable[[str], None]) -> None:
    """Serve a page until Ctrl-C; ``ready`` is called with the address. UserError where the port cannot be had."""
    with _bound(port) as listening:
        own, token = int(listening.getsockname()[1]), secrets.token_urlsafe(24)
        guarded = Guard(application.starlette, own, token)
        settings = uvicorn.Config(guarded, log_level="critical", access_log=False, server_header=False, date_header=False,
                                  timeout_graceful_shutdown=ENDING, lifespan="on", ws="none",
                                  http=_Connection, limit_concurrency=CONNECTIONS)  # fmt: skip
        gc.collect()
        gc.freeze()  # program and first machine stay to the end: each full pass over them would stop the page
        listening.listen()
        ready(f"http://{HOST}:{own}/{token}/")
        _Server(settings, application).run(sockets=[listening])


class _Connection(H11Protocol):
    """A connection that is closed where nobody asks anything on it: uvicorn itself waits for ever for the end of a first request."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._was_idle = False
        self._look_again()

    def _look_again(self) -> None:
        self._look = self.loop.call_later(IDLE / 2, self._close_where_idle)

    def _close_where_idle(self) -> None:
        cycle: RequestResponseCycle | None = self.cycle  # uvicorn says that it is never None
        is_idle = cycle is None or cycle.response_complete
        if is_idle and self._was_idle:
            self.transport.close()
            return
        self._was_idle = is_idle
        self._look_again()

    def connection_lost(self, exc: Exception | None) -> None:
        self._look.cancel()
        super().connection_lost(exc)


class _Server(uvicorn.Server):
    """A server that lets the streams of its pages end before it waits for them."""

    def __init__(self, settings: uvicorn.Config, application: Application) -> None:
        super().__init__(settings)
        self.application = application

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self.application.end()
        await super().shutdown(sockets)


def _bound(port: int) -> socket.socket:
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        found.bind((HOST, port))
    except OSError as error:
        found.close()
        is_taken = error.errno == errno.EADDRINUSE
        why = phrase("another program is using it") if is_taken else (error.strerror or f"{error.errno}")
        template = "Port {port} of this machine is not available: {why}. Omit --port to use a free one."
        raise refusal(template, port=port, why=why) from error
    return found
