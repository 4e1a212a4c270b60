"""The tutorial is true: what it builds step by step calculates, is sound, and prints what it shows."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from diecut_report.testing.contract import TITLES
from tests.docs.pages import ROOT, PageRun, alike

PAGE = ROOT / "docs" / "tutorial.md"
SLOW = tuple(f"diecut-report {name}" for name in ("report", "check-plugin", "batch", "variants"))


def test_the_tutorial_is_true(tmp_path: Path) -> None:
    assert PageRun(PAGE, tmp_path, skipped=SLOW).execute() > 15


@pytest.mark.nightly
def test_the_tutorial_is_true_to_its_report_and_its_study(tmp_path: Path) -> None:
    PageRun(PAGE, tmp_path).execute()
    assert (tmp_path / "build" / "pusher.pdf").stat().st_size > 50_000


def test_the_pages_name_the_rules_of_check_plugin() -> None:
    """The command itself is run at night."""
    titles, text = list(map(str, TITLES.values())), PAGE.read_text("utf-8")
    shown = re.findall(r"^  (?:holds|note)  ([A-Z][^:\n]*)", text, re.MULTILINE)
    assert shown and shown == titles[: len(shown)]
    table = (ROOT / "docs" / "plugins.md").read_text("utf-8").partition("| rule |")[2].partition("\n\n")[0]
    assert [name for row in table.splitlines()[2:] for name in row.split(" | ")[0].strip("| ").split(", ")] == titles


@pytest.mark.parametrize(
    ("shown", "told", "expected"),
    [
        (["a", "…"], ["a", "b", "c"], True),
        (["a", "…", "c"], ["a", "c"], True),
        (["…", "b"], ["a"], False),
        (["a"], ["a", "b"], False),
    ],
)
def test_an_ellipsis_stands_for_any_lines(shown: list[str], told: list[str], expected: bool) -> None:
    assert alike(shown, told) is expected
