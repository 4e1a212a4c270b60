"""The live page itself and what it is made of: a template, a style sheet and scripts, all of the program's own folder."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from diecut_report.languages.speech import say, spoken_language
from diecut_report.live.words import words
from diecut_report.report.html import filled_page, folder

FONTS = ("report-sans-regular", "report-sans-bold", "report-sans-italic", "report-symbols")
FILES = {  # place in the folder of the templates: what it is
    "live/live.css": "text/css; charset=utf-8",
    "level_names.js": "text/javascript; charset=utf-8",
    "live/live.js": "text/javascript; charset=utf-8",
    "uplot/uPlot.min.css": "text/css; charset=utf-8",
    "uplot/uPlot.iife.min.js": "text/javascript; charset=utf-8",
    **{f"fonts/{name}.woff2": "font/woff2" for name in FONTS},
}


class Asset(NamedTuple):
    """Hold a file that the page loads."""

    content: bytes
    media_type: str


@cache
def assets() -> dict[str, Asset]:
    """Return all that the page may load, by name."""
    places = {folder() / place: media_type for place, media_type in FILES.items()}
    return {place.name: Asset(place.read_bytes(), media_type) for place, media_type in places.items()}


def page(file: str) -> bytes:
    """Return the page for a file of this name, in the language that is spoken."""
    return filled_page("live/live.html.j2", file=file, language=spoken_language(), say=say, words=words()).encode()
