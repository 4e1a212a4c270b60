"""Which files the code of a plugin or of the program is: its modules and its tables."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

DATA = (".json", ".yaml", ".yml", ".csv")  # tables
CODE = (".py", *DATA)


def code_of(module: Path) -> Iterator[tuple[str, str]]:
    """Give the files of a module by their names: a package with all in it, a single file with the tables beside it that it names."""
    if module.name == "__init__.py":
        yield from code_below(str(module.parent))
        return
    yield "module", str(module)
    text = module.read_text("utf-8", "replace")
    tables = (path for path in module.parent.iterdir() if path.suffix in DATA and path.name in text and path.is_file())
    yield from ((path.name, str(path)) for path in tables)


def code_below(folder: str, name: str = "", without: Sequence[str] = ()) -> Iterator[tuple[str, str]]:
    """Give the code and the tables below a folder, by their names in it; what is hidden or compiled is none."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.startswith("."):
                continue
            if entry.name.endswith(CODE) and entry.is_file():  # a pipe would be waited for
                yield name + entry.name, entry.path
            elif entry.is_dir(follow_symlinks=False) and entry.name not in ("__pycache__", *without):
                yield from code_below(entry.path, f"{name}{entry.name}/")
