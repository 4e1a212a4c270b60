"""Who may speak with the live page's server: this machine, by an address with its token, from a page of its own."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, MutableMapping
from hmac import compare_digest
from typing import Any

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
LARGEST = 200_000  # bytes of what a page sends
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
            await _refused(send, status)
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
        return 413 if int(headers.get("content-length") or 0) > LARGEST else 0


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
        return self._broken_off() if self.taken > LARGEST else message

    def _broken_off(self) -> Message:
        self.is_whole = self.is_broken_off = True
        return {"type": "http.disconnect"}


async def _refused(send: Send, status: int) -> None:
    await send({"type": "http.response.start", "status": status, "headers": [(b"content-length", b"0")]})
    await send({"type": "http.response.body", "body": b""})


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
