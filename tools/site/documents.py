"""The documents of the repository as pages, in the order of the contents at the side."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fnmatch import fnmatch
from pathlib import PurePosixPath
from typing import NamedTuple

from tools.site.links import Links
from tools.site.markup import contents
from tools.site.notebooks import notebooks
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
