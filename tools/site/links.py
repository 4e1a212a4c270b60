"""Links of the repository's documents, made links of the site: to its pages, to the repository on the web, or plain words."""

from __future__ import annotations

import posixpath
import re
import tomllib
from collections.abc import Mapping
from functools import cache

from tools.site.sources import ROOT

PICTURES = (".png", ".svg", ".jpg", ".jpeg", ".gif")
REPOSITORY = ("Repository", "Source", "Homepage")  # what projects call its address, the best first
_TOKEN = re.compile(
    r"(?P<fence>^(?P<mark>`{3,}|~{3,}).*?^(?P=mark)[`~]*$)"
    r"|(?P<picture>!?)\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<target>[^()\s]+)\)"
    r"|(?P<ticks>`+)(?!`).*?(?<!`)(?P=ticks)(?!`)",
    re.DOTALL | re.MULTILINE,
)


class Links:
    """Where the documents of the repository stand on the site: ``docs/trust.md`` → ``trust.md``; a folder may stand for a page too."""

    def __init__(self, pages: Mapping[str, str]) -> None:
        self.pages = pages
        self.pictures: set[str] = set()  # files of the repository that pages show

    def rewritten(self, text: str, file: str) -> str:
        """Return a document of the repository as a page of the site; FileNotFoundError where a link leads nowhere."""
        return _TOKEN.sub(lambda found: self._said(found, file), text)

    def _said(self, found: re.Match[str], file: str) -> str:
        target = found["target"]
        if not target or re.match(r"[a-z][a-z+.-]*:|#", target):
            return found[0]
        path, mark, part = target.partition("#")
        meant = posixpath.normpath(posixpath.join(posixpath.dirname(file), path))
        if not (ROOT / meant).exists():
            raise FileNotFoundError(f"{file}: the link to {target} leads to nothing; there is no {meant}")
        here = posixpath.dirname(self.pages[file]) or "."
        if meant in self.pages:
            return f"{found['picture']}[{found['text']}]({posixpath.relpath(self.pages[meant], here)}{mark}{part})"
        if meant.endswith(PICTURES):
            self.pictures.add(meant)
            return f"{found['picture']}[{found['text']}]({posixpath.relpath(meant, here)})"
        return _elsewhere(found["text"], meant)


def _elsewhere(text: str, meant: str) -> str:
    """A file that is not part of the site: a link to the repository where it has an address, else its words and its name."""
    address = repository()
    if address:
        return f"[{text}]({address}/blob/main/{meant})"
    return text if meant in text else f"{text} (`{meant}`)"


@cache
def repository() -> str:
    """Return the repository's address on the web; nothing where the project tells none."""
    urls = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"].get("urls", {})
    return str(next((urls[name] for name in REPOSITORY if name in urls), "")).rstrip("/")
