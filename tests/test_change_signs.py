"""What changes the program to try its tests finds tests for each plugin and each module of mechanics."""

from __future__ import annotations

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_each_plugin_and_each_module_has_tests_that_are_there() -> None:
    found = runpy.run_path(str(ROOT / "scripts" / "unit_tests.py"))
    for unit in found["units"]():
        files = [part for asked in found["tests_asked"](unit) for part in asked if part.endswith(".py")]
        assert files and all((ROOT / file).is_file() for file in files), unit
