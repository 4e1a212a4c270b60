"""Presses and results from files, texts and mappings."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import yaml

from diecut_report.config.discovery import Discovery
from diecut_report.config.loader import load_config
from diecut_report.config.yaml_tree import Tree, parse, read_text
from diecut_report.exchange.carried_results import carried_results
from diecut_report.scripting.loaded_press import LoadedPress
from diecut_report.scripting.results import Results
from diecut_report.scripting.spoken import known_language, told_in
from diecut_report.scripting.typed_values import plain

Folder = str | os.PathLike[str]
GIVEN = "press.yaml"  # what documents call a configuration that has no file


def load(
    source: Folder | Mapping[str, Any], *, plugins: Iterable[Folder] = (), language: str | None = None
) -> LoadedPress:
    """Return the press of a configuration: of its file, or of a mapping with the same keys, whose values may be quantities.

    ``plugins`` are folders with plugins, which run with your rights; ``language`` is that of messages and
    documents (``en``, ``uk``; without it messages are English, and documents as the project has them). ConfigError with
    file, line, column, key and what is allowed for all that is wrong with it.
    """
    if isinstance(source, Mapping):
        text = yaml.safe_dump(plain(source, ""), allow_unicode=True, sort_keys=False)
        return _press(parse(text, GIVEN), plugins, known_language(language), without_places=True)
    return _press(Path(source), plugins, known_language(language))


def loads(text: str, *, plugins: Iterable[Folder] = (), language: str | None = None) -> LoadedPress:
    """Return the press of a configuration that is given as text; tables that it names are sought in the current folder."""
    spoken = known_language(language)
    with told_in(spoken):
        return _press(read_text(text, GIVEN), plugins, spoken)


def load_results(file: Folder, *, plugins: Iterable[Folder] = (), language: str | None = None) -> Results:
    """Return the results that a results file, or a report (PDF, HTML), holds; nothing is calculated. ConfigError where it holds none."""
    spoken = known_language(language)
    with told_in(spoken):
        return Results(carried_results(Path(file)).results, _discovery(plugins), spoken)


def _press(
    source: Path | Tree, plugins: Iterable[Folder], language: str | None, *, without_places: bool = False
) -> LoadedPress:
    with told_in(language, without_places=without_places):
        discovery = _discovery(plugins)
        return LoadedPress(load_config(source, discovery), discovery, language)


def _discovery(plugins: Iterable[Folder]) -> Discovery:
    if isinstance(plugins, str | os.PathLike):
        plugins = (plugins,)
    return Discovery([Path(folder) for folder in plugins])
