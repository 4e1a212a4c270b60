"""The server of the live page: on the loopback alone, behind an address that nobody else knows."""

from __future__ import annotations

import asyncio
import errno
import gc
import secrets
import socket
from collections.abc import Callable

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.live.application import LiveApplication
from diecut_report.live.guard import Guard

HOST = "127.0.0.1"
ENDING = 2  # seconds that open answers have at the end
IDLE = 10.0  # seconds after which a connection that asks nothing, or not to the end, is closed
CONNECTIONS = 100  # at a time


def serve(application: LiveApplication, port: int, ready: Callable[[str], None]) -> None:
    """Serve a session until Ctrl-C; ``ready`` is called with the address. UserError where the port cannot be had."""
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

    def __init__(self, settings: uvicorn.Config, application: LiveApplication) -> None:
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
        why = phrase("another program has it") if is_taken else (error.strerror or f"{error.errno}")
        words = "The port {port} of this machine cannot be had: {why}. Leave --port out, and a free one is taken."
        raise UserError(Problem(Phrase(words, port=port, why=why))) from error
    return found
