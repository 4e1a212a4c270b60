"""Judges the built site: ``python -m tools.site.built_links FOLDER``.

Each page, picture, style and part of a page that a page names must be in the folder, and nothing may be loaded from elsewhere.
Links that lead out of the site are listed, and not followed.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from os.path import normpath
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

LOADED = {("link", "href"), ("script", "src"), ("img", "src"), ("source", "src"), ("iframe", "src"), ("image", "href")}
NOT_LOADED = {"canonical", "index", "search", "next", "prev"}  # what a link element names without loading it
CARRIED = ("data:", "blob:", "mailto:")


class Named(NamedTuple):
    """What a page names: the address, whether a browser loads it by itself, and the line."""

    address: str
    is_loaded: bool
    line: int


class Page(HTMLParser):
    """What one page names, and the places in it that may be named."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.names: list[Named] = []
        self.places: set[str] = set()
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note the addresses and the places of an element."""
        given = {name: value or "" for name, value in attrs}
        self.places.update(given[name] for name in ("id", "name") if name in given)
        for name in ("href", "src", "xlink:href"):
            if name in given:
                loaded = (tag, name.removeprefix("xlink:")) in LOADED and given.get("rel") not in NOT_LOADED
                self.names.append(Named(given[name], loaded, self.getpos()[0]))


class Found(NamedTuple):
    """What is wrong, in words, and the addresses that lead out of the site."""

    faults: list[str]
    outside: set[str]


def judged(folder: Path) -> Found:
    """Return what is wrong with the links of a site, and where it leads to."""
    folder = folder.resolve()
    pages = {file: Page(file) for file in sorted(folder.rglob("*.html"))}
    found = Found([], set())
    if not pages:
        found.faults.append(f"{folder} holds no pages; build the site first: sh scripts/site.sh")
    for file, page in pages.items():
        for named in page.names:
            fault = _fault(file, named, pages, found.outside)
            if fault:
                found.faults.append(f"{file.relative_to(folder)}:{named.line}: {named.address}: {fault}")
    found.faults.extend(_fetching(folder))
    return found


def _fault(file: Path, named: Named, pages: dict[Path, Page], outside: set[str]) -> str:
    if named.address.startswith(CARRIED):
        return ""
    parted = urlsplit(named.address)
    if parted.scheme or parted.netloc:
        outside.add(named.address)
        return "a browser would load this from elsewhere; put it into the site" if named.is_loaded else ""
    target = Path(normpath(file.parent / unquote(parted.path))) if parted.path else file
    if target not in pages and not target.is_file():
        return "there is no such file in the site"
    place = unquote(parted.fragment)
    if place and target in pages and place not in pages[target].places | {"top"}:
        return "there is no such place on that page"
    return ""


def _fetching(folder: Path) -> Iterator[str]:
    """Style sheets that load something from elsewhere."""
    for file in sorted(folder.rglob("*.css")):
        text = file.read_text(encoding="utf-8")
        if "url(http" in text or 'url("http' in text or "url(//" in text or "@import url" in text:
            yield f"{file.relative_to(folder)}: it loads something from elsewhere; put it into the site"


def main() -> None:
    """Print what is found; exit with 1 where something is wrong."""
    found = judged(Path(sys.argv[1]))
    for address in sorted(found.outside):
        print(f"leads out of the site, not followed: {address}")
    print(*found.faults, sep="\n", file=sys.stderr)
    sys.exit(1 if found.faults else 0)


if __name__ == "__main__":
    main()
