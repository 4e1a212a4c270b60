"""A report can be made again from a results file alone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from diecut_report.report import Rendering


def test_the_report_of_a_results_file_is_the_report(small_report: Path) -> None:
    file = small_report / "small.json"
    again = Rendering(json.loads(file.read_text(encoding="utf-8")))
    assert again.html() == file.with_suffix(".html").read_text(encoding="utf-8")
    assert again.pdf() == file.with_suffix(".pdf").read_bytes()


@pytest.mark.wheel
def test_a_report_is_made_with_all_that_is_installed(small_report: Path) -> None:
    assert {path.suffix for path in small_report.iterdir()} == {".html", ".pdf", ".json"}
    assert "<svg" in (small_report / "small.html").read_text(encoding="utf-8")
