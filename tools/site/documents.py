"""The documents of the repository as pages, in the order of the contents at the side."""

from __future__ import annotations

import json
import posixpath
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatch
from functools import cache
from pathlib import PurePosixPath
from typing import NamedTuple

from tools.site.examples import EXTRA
from tools.site.markup import contents, fenced, html
from tools.site.sources import ROOT, Sources

AT_ROOT = ("README", "ARCHITECTURE", "CONTRIBUTING", "DECISIONS", "CHANGELOG", "SECURITY")
START = "index"
GALLERY = "docs/mechanisms"  # its pages are those of the gallery, which tell more
OWN_FOLDERS = ("docs/mechanisms", "docs/site")


class Part(NamedTuple):
    """A part of the contents: names of pages in their order; a pattern with a star takes what no other name takes, or nothing."""

    title: str
    names: tuple[str, ...]


PARTS = (
    Part("Using it", ("configuration", "commands", "comparing-machines", "questions", "live", "studies", "results", "results-file",
                      "reports-and-revisions", "office-files", "house-style", "own-tables", "limits", "mending-a-press",
                      "correcting-a-drive-line", "python", "own-repository")),
    Part("Examples", ("gallery/index", "notebooks/index", "reports")),
    Part("Writing a mechanism", ("tutorial", "how-to/index", "plugins", "reference/index")),
    Part("Whether to trust it", ("need-and-field", "trust", "validation", "standards", "plausible-values")),
    Part("The project", ("architecture", "contributing", "decisions", "changelog", "security", "glossary")),
    Part("More", ("*",)),
)  # fmt: skip


def documents() -> dict[str, str]:
    """Return the documents of the repository, each with its page; a new one in docs/ is found by itself."""
    found = {f"{name}.md": f"{START if name == 'README' else name.lower()}.md" for name in AT_ROOT}
    for file in sorted((ROOT / "docs").rglob("*.md")):
        path = file.relative_to(ROOT).as_posix()
        if not path.startswith(tuple(f"{folder}/" for folder in OWN_FOLDERS)):
            own = PurePosixPath(path).relative_to("docs")
            found[path] = str(own.with_name("index.md") if own.name == "README.md" else own)
    return found


def places() -> dict[str, str]:
    """Return the page of each path of the repository to which documents may link."""
    own = {file.relative_to(ROOT).as_posix(): f"gallery/{file.name}" for file in (ROOT / GALLERY).glob("*.md")}
    return documents() | notebooks() | own | {GALLERY: "gallery/index.md"}


def add_documents(sources: Sources) -> None:
    """Add the documents, and on the first page the contents of the whole site; what is there already has its place in them too."""
    links, pages = Links(places()), documents()
    for file, page in pages.items():
        text = links.rewritten((ROOT / file).read_text(encoding="utf-8"), file)
        if page != f"{START}.md":
            sources.page(page, [*text.splitlines(), *_below(page, pages.values())])
    known = [path.removesuffix(".md") for path in sources.files if path.endswith(".md")]
    start = links.rewritten((ROOT / "README.md").read_text(encoding="utf-8"), "README.md")
    sources.page(f"{START}.md", [*start.splitlines(), *_contents(known)])
    for picture in sorted(links.pictures):
        sources.add(picture, (ROOT / picture).read_bytes())


def _below(page: str, pages: Iterable[str]) -> Iterator[str]:
    """The contents of a folder, in the page that is its index."""
    own = PurePosixPath(page)
    if own.stem == START:
        beside = sorted(
            PurePosixPath(each) for each in pages if PurePosixPath(each).parent == own.parent and each != page
        )
        yield from contents("", (each.stem for each in beside))


def _contents(known: list[str]) -> Iterator[str]:
    """The parts of the contents. A page that is named here and is not there, or is there and in no part, fails in Sphinx."""
    exact = {name for part in PARTS for name in part.names if "*" not in name}
    indexed = {f"{PurePosixPath(name).parent}/" for name in known if name.endswith(f"/{START}")}
    left = [name for name in sorted(known) if name not in exact and not name.startswith(tuple(indexed))]
    for part in PARTS:
        names: list[str] = []
        for pattern in part.names:
            found = [pattern] if pattern in exact else [name for name in left if fnmatch(name, pattern)]
            left = [name for name in left if name not in found]
            names += found
        if names:
            yield from contents(part.title, names)


# Links of the repository's documents, made links of the site: to its pages, to the repository on the web, or plain words.


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


# The notebooks of the examples as pages: their texts and cells as they stand, and each file itself.


LISTED = "docs/python.md"  # names them all, in the order in which they are read


def notebooks() -> dict[str, str]:
    """Return the notebooks, each with its page."""
    found = re.findall(r"\(\.\./(examples/\w+\.ipynb)\)", (ROOT / LISTED).read_text(encoding="utf-8"))
    return {path: f"notebooks/{PurePosixPath(path).stem}.md" for path in found}


def add_notebooks(sources: Sources, links: Links) -> None:
    """Add a page of each notebook, its file, and the list of all."""
    texts = {path: _text(path, links) for path in notebooks()}
    for path, page in notebooks().items():
        sources.add(f"{EXTRA}/notebooks/{PurePosixPath(path).name}", (ROOT / path).read_bytes())
        sources.page(page, texts[path])
    sources.page("notebooks/index.md", _list(texts))


def _text(path: str, links: Links) -> list[str]:
    """Its cells; what they give is not kept in the file."""
    found: list[str] = []
    for cell in json.loads((ROOT / path).read_text(encoding="utf-8"))["cells"]:
        text = "".join(cell["source"])
        is_text = cell["cell_type"] == "markdown"
        found += ["", *links.rewritten(text, path).splitlines()] if is_text else fenced("python", text)
    name = PurePosixPath(path).name
    return [*found, *html(f'<p><a href="{name}" download>{name}</a></p>')]


def _list(texts: dict[str, list[str]]) -> Iterator[str]:
    yield from ("# Notebooks", "")
    yield f"As they lie in `examples/`, without what their cells give; [the page on Python](../{PurePosixPath(LISTED).name}) has the rest."
    yield ""
    for path, lines in texts.items():
        title = next(line for line in lines if line.startswith("# ")).removeprefix("# ")
        yield f"- [{title}]({PurePosixPath(path).stem}.md)"
    yield from contents("", (PurePosixPath(path).stem for path in texts))
