"""The live page itself and what it is made of: a template, a style sheet and scripts, all of the program's own folder."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from diecut_report.report.html import filled_page, folder

FILES = {
    "live.css": "text/css; charset=utf-8",
    "live.js": "text/javascript; charset=utf-8",
    "uPlot.min.css": "text/css; charset=utf-8",
    "uPlot.iife.min.js": "text/javascript; charset=utf-8",
}


class Asset(NamedTuple):
    """Hold a file that the page loads."""

    content: bytes
    media_type: str


@cache
def assets() -> dict[str, Asset]:
    """Return all that the page may load, by name."""
    home = folder()
    places = {name: home / ("uplot" if name.startswith("uPlot") else "live") / name for name in FILES}
    return {name: Asset(places[name].read_bytes(), media_type) for name, media_type in FILES.items()}


def page(file: str) -> bytes:
    """Return the page for a file of this name."""
    return filled_page("live/live.html.j2", file=file).encode()
