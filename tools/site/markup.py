"""Markdown as MyST reads it: texts without meaning of their own, tables, and HTML that stands as it is."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from diecut_report.report.symbols import symbol

_MEANT = re.compile(r"([\\`*_\[\]<>|{}#~$])")


def plain(text: str) -> str:
    """Return a text in which no character means anything to Markdown."""
    return _MEANT.sub(r"\\\1", " ".join(text.split()))


def code(text: str) -> str:
    """Return a text in the letters of code, also within a table."""
    return f"`{text}`".replace("|", "\\|") if text else ""


def symbols(name: str) -> str:
    """Return a symbol with its letter in italics and its subscript below."""
    return str(symbol(name)).replace("|", "&#124;").replace("_", "&#95;").replace("*", "&#42;")


def table(head: Sequence[str], rows: Iterable[Sequence[str]], name: str = "") -> Iterator[str]:
    """Yield a table of Markdown; nothing where there are no rows. Its cells are Markdown already."""
    found = list(rows)
    if not found:
        return
    yield from ("", f"{{.{name}}}") if name else ("",)
    yield f"| {' | '.join(head)} |"
    yield f"| {' | '.join('---' for _ in head)} |"
    yield from (f"| {' | '.join(cell or ' ' for cell in row)} |" for row in found)
    yield ""


def html(*lines: str) -> Iterator[str]:
    """Yield HTML that stands in the page as it is."""
    yield from ("", "``````{raw} html", *lines, "``````", "")


def fenced(language: str, text: str) -> Iterator[str]:
    """Yield a block of code."""
    yield from ("", f"``````{language}", text.strip("\n"), "``````", "")


def contents(caption: str, pages: Iterable[str]) -> Iterator[str]:
    """Yield a table of contents, by the names of pages without their ending: it stands at the side, not in the page."""
    yield from ("", "```{toctree}", ":hidden:", ":maxdepth: 1")
    yield from (f":caption: {caption}",) if caption else ()
    yield from ("", *pages, "```", "")


def bullets(texts: Iterable[str]) -> Iterator[str]:
    """Yield a list, of texts that are Markdown already."""
    yield from ("", *(f"- {text}" for text in texts), "")


def section(title: str, body: Iterable[str], level: int = 2) -> Iterator[str]:
    """Yield a part of a page under its title; nothing where it is empty."""
    found = list(body)
    if any(line.strip() for line in found):
        yield from ("", f"{'#' * level} {title}", "", *found)
