"""The files that a plugin is written in, and what stands in them as syntax."""

from __future__ import annotations

import ast
from functools import lru_cache
from pathlib import Path

from diecut_report.contract.mechanism import Mechanism


def parsed(file: Path) -> ast.Module:
    """Return a file as syntax; without a statement where it is none, a file of the package that is never imported."""
    return _parsed(file, file.stat().st_mtime_ns)


@lru_cache(maxsize=512)
def _parsed(file: Path, changed: int) -> ast.Module:
    """The file as it is since it was changed."""
    try:
        return ast.parse(file.read_bytes())
    except (SyntaxError, ValueError):
        return ast.Module([], [])


def own_files(mechanism: Mechanism) -> list[Path]:
    """Return the file that declares a mechanism; of a folder that is the plugin all files, but for its tests."""
    file = Path(mechanism.at.rpartition(":")[0])
    if not file.is_file():  # made without a file
        return []
    return [each for each in _in_folder(file.parent) if not _is_test(each)] if file.name == "__init__.py" else [file]


def files_around(mechanism: Mechanism) -> list[Path]:
    """Return the files that may import what a mechanism's files define: those, and all of their package."""
    file = Path(mechanism.at.rpartition(":")[0])
    return _in_folder(file.parent) if (file.parent / "__init__.py").is_file() else own_files(mechanism)


def _in_folder(folder: Path) -> list[Path]:
    return sorted(file for file in folder.rglob("*.py") if file.is_file())


def _is_test(file: Path) -> bool:
    return file.name.startswith(("test_", "conftest")) or "tests" in file.parts
