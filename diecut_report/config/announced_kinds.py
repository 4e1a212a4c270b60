"""The kinds that a package announces in its project file, as they lie in its sources."""

from __future__ import annotations

import tomllib
from pathlib import Path

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase

PROJECT = "pyproject.toml"
SOURCES = "src"


def announced(folder: Path, group: str) -> dict[str, tuple[str, str]]:
    """Return the kinds that the project of a package announces, each with its module's place and the attribute that is named.

    It need not be installed. There are none where the folder is no such project.
    """
    project = folder / PROJECT
    if not project.is_file():
        return {}
    try:
        told = tomllib.loads(project.read_text("utf-8", "replace")).get("project", {})
        found = told.get("entry-points", {}).get(group, {})
        places = {kind: str(place).partition(":") for kind, place in found.items()}
    except (tomllib.TOMLDecodeError, AttributeError) as error:
        raise UserError(
            Problem(Phrase("This project of a package cannot be read: {error}", error=error), str(project))
        ) from None
    return {kind: (_source(folder, module), attribute) for kind, (module, _, attribute) in places.items()}


def source_of(folder: Path, place: str) -> Path:
    """Return the folder of a project in which its packages stand, of a kind's place in it."""
    return folder / SOURCES if place.startswith(f"{SOURCES}/") else folder


def _source(folder: Path, module: str) -> str:
    """Where a module of a package stands in its project."""
    name = module.replace(".", "/")
    found = folder / SOURCES / name
    return f"{SOURCES}/{name}" if found.exists() or found.with_name(f"{found.name}.py").exists() else name
