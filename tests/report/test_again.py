"""A report can be made again from a results file alone.

The PDF is set from the HTML's parts, and takes long: it is made again at night; tests/hostile/test_surroundings.py has two of the
same results.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ResultsRecord
from tests.examples import few


@pytest.mark.parametrize("ending", few(["html", "pdf"], keep=lambda ending: ending == "html"))
def test_the_report_of_a_results_file_is_the_report(small_report: Path, ending: str) -> None:
    file = small_report / "small.json"
    again = Rendering(ResultsRecord.model_validate_json(file.read_bytes()))
    made = again.html().encode() if ending == "html" else again.pdf()
    assert made == file.with_suffix(f".{ending}").read_bytes()


@pytest.mark.wheel
def test_a_report_is_made_with_all_that_is_installed(small_report: Path) -> None:
    assert {path.suffix for path in small_report.iterdir()} == {".html", ".pdf", ".json"}
    assert "<svg" in (small_report / "small.html").read_text(encoding="utf-8")
