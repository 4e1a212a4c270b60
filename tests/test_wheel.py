"""What is in the sources is installed, and works there: every file of the packages, every kind of mechanism.

On the wheel the tests stand away from the checkout, beside a list of its files (.ci/run).
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from tests.configs import EXAMPLES
from tests.plugins.machine_parts import OF_PARTS

ROOT = Path(__file__).parents[1]
LISTED = ROOT / "files.txt"
PACKAGES = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["setuptools"]["package-dir"]


def sources() -> Iterator[tuple[str, Path]]:
    """The files of the packages as the checkout has them, each with its package and its place in it."""
    for package, folder in PACKAGES.items():
        if LISTED.exists():
            paths = [Path(line) for line in LISTED.read_text("utf-8").splitlines()]
        else:
            paths = [path.relative_to(ROOT) for path in (ROOT / folder).rglob("*") if path.is_file()]
        own = [path.relative_to(folder) for path in paths if path.is_relative_to(folder)]
        yield from ((package, path) for path in own if "__pycache__" not in path.parts)


@pytest.mark.wheel
def test_every_file_of_the_sources_is_installed() -> None:
    found = list(sources())
    assert {Path(path).suffix for _, path in found} >= {".py", ".j2", ".css", ".woff2", ".json", ".yaml"}
    missing = [(package, path) for package, path in found if not (home(package) / path).is_file()]
    assert missing == []


def home(package: str) -> Path:
    """Where a package is installed."""
    return Path(import_module(package).__path__[0])


@pytest.mark.wheel
def test_the_examples_have_every_kind() -> None:
    used = {
        kind for config in EXAMPLES for kind in Discovery([]).origins if f"kind: {kind}\n" in config.read_text("utf-8")
    }
    assert used == set(Discovery([]).origins) - OF_PARTS
