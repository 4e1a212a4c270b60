"""Machines to try a plugin on: of the configurations that are named, or of those that lie beside the plugin."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from importlib.resources import as_file, files
from pathlib import Path

from diecut_report.config.discovery import Discovery, Origin
from diecut_report.config.loader import Config, load_config
from diecut_report.errors import Problem, UserError

FOLDERS = (".", "examples", "configs")
Machine = tuple[Config, str]
LEVELS = 3  # folders above a plugin in which its examples are sought
INSTALLED = "site-packages"
LARGEST = 1_000_000  # bytes of a file that is looked through


def named_machines(files: Iterable[Path], kind: str, discovery: Discovery) -> list[Machine]:
    """Return all machines of a kind in these configurations with their names; UserError where one of them is wrong."""
    return [
        (config, name)
        for config in (load_config(file, discovery) for file in files)
        for name, own in config.kinds.items()
        if own == kind
    ]


def machines_beside(origin: Origin, discovery: Discovery) -> tuple[list[Machine], list[Problem]]:
    """Return all machines of a kind in sound configurations beside its plugin; where there are none, why others are not sound."""
    found: list[Machine] = []
    refused: list[Problem] = []
    for file in _files(origin):
        try:
            found += named_machines([file], origin.kind, discovery)
        except UserError as error:  # of something else, which its user knows, if there is a sound one
            refused += error.problems
    return found, [] if found else refused


def _files(origin: Origin) -> Iterator[Path]:
    """The configurations near a plugin that name its kind."""
    kind = re.compile(rf"\bkind:\s*[\"']?{re.escape(origin.kind)}\b")
    for folder in _folders(origin):
        for file in sorted(folder.glob("*.yaml")):
            if file.is_file() and file.stat().st_size < LARGEST and kind.search(file.read_text("utf-8", "replace")):
                yield file


def _folders(origin: Origin) -> Iterator[Path]:
    if origin.is_own:
        with as_file(files("diecut_report.configs")) as examples:
            yield examples
        return
    for level, home in enumerate(origin.file().resolve().parents):
        if level >= LEVELS or home.name == INSTALLED:
            return
        yield from (home / name for name in FOLDERS if (home / name).is_dir())
