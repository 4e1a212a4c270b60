"""Whether a plugin was found sound is asked in one place."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import diecut_report
from diecut_report.results.checks import found_check, is_doubtful

ROOT = Path(diecut_report.__file__).parent


@pytest.mark.parametrize(
    ("mechanism", "found", "doubt"),
    [({"plugin_check": "failed"}, "failed", True), ({"plugin_check": "passed"}, "passed", False), ({}, "", False),
     ({"plugin_check": "of another version"}, "", False)],
)  # fmt: skip
def test_only_a_check_that_failed_is_a_doubt(mechanism: dict[str, str], found: str, doubt: bool) -> None:
    assert (found_check(mechanism), is_doubtful(mechanism)) == (found, doubt)


def test_nothing_else_reads_it() -> None:
    """But for where it is written."""
    reading = set()
    for file in ROOT.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Constant) and node.value == "plugin_check":
                reading.add(str(file.relative_to(ROOT)))
    assert reading == {"results/checks.py", "config/source_hashes.py"}
