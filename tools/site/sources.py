"""The folder that Sphinx reads: pages by their names, and files beside them, written only where they changed."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).parents[2]


class Sources:
    """What the site is made of, by the path in the folder; a page is Markdown, ``gallery/shaft.md``."""

    def __init__(self) -> None:
        self.files: dict[str, bytes] = {}

    def page(self, path: str, lines: Iterable[str]) -> None:
        """Add a page; ValueError where two would stand at one path."""
        self.add(path, "\n".join(lines).rstrip("\n").encode() + b"\n")

    def add(self, path: str, content: bytes) -> None:
        """Add a file as it is."""
        if path in self.files:
            raise ValueError(f"two pages of the site are called {path}; rename one of them")
        self.files[path] = content

    def write(self, folder: Path) -> None:
        """Write all, and remove what is no longer part of it; what has not changed keeps its time, so that Sphinx leaves it."""
        for path, content in self.files.items():
            target = folder / path
            if not (target.is_file() and target.read_bytes() == content):
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
        for old in sorted(folder.rglob("*"), reverse=True):
            if old.is_file() and old.relative_to(folder).as_posix() not in self.files:
                old.unlink()
            elif old.is_dir() and not any(old.iterdir()):
                shutil.rmtree(old)


# What the pages stand in: the settings of Sphinx, the style, and the fonts of the reports, in which figures and formulas are set.


OWN = ROOT / "docs" / "site"
FONTS = ("report-sans-regular", "report-symbols", "report-math")


def add_frame(sources: Sources) -> None:
    """Add them: what stands in docs/site, and the fonts."""
    for file in sorted(OWN.rglob("*")):
        if file.is_file() and "__pycache__" not in file.parts:
            sources.add(file.relative_to(OWN).as_posix(), file.read_bytes())
    for name in FONTS:
        sources.add(f"_static/fonts/{name}.woff2", (ROOT / "templates" / "fonts" / f"{name}.woff2").read_bytes())
