"""The files that a page carries in its links."""

from __future__ import annotations

import base64
from html.parser import HTMLParser


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: dict[str, bytes] = {}

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        if tag == "a" and given.get("download"):
            self.found[str(given["download"])] = base64.b64decode(str(given["href"]).partition(";base64,")[2])


def links(page: str) -> dict[str, bytes]:
    """The content of each file that the page offers to be saved, by its name."""
    reader = _Links()
    reader.feed(page)
    return reader.found
