"""The notebooks of the examples as pages: their texts and cells as they stand, and each file itself."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import PurePosixPath

from tools.site.links import Links
from tools.site.markup import contents, fenced, html
from tools.site.reports import EXTRA
from tools.site.sources import ROOT, Sources

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
