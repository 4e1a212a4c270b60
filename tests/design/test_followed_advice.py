"""The line of page 1 on the advice of all failing checks together, and that a report with it can be verified."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.report.chapters.front import followed_line
from diecut_report.report.text import Catalogue
from diecut_report.results.model import ResultsRecord
from tests.configs import HEAD, saved
from tests.records import filled

CLUTCH = (
    HEAD
    + """\
  clutch: {kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg, shoe_width: 30 mm, allowable_pressure: 0.2 MPa}
"""
)


def test_a_report_says_that_its_advice_gives_a_pass(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    config = saved(tmp_path, CLUTCH)
    assert main(["report", str(config), "-o", str(tmp_path), "--format", "html,json"]) == 1
    results = ResultsRecord.model_validate_json((tmp_path / "press.json").read_bytes())
    advice = results.summary.advice
    assert advice is not None and advice.failing == [] and advice.error is None
    assert [each.path for each in advice.changes] == ["clutch.shoe_width"]
    (line,) = followed_line(results, Catalogue("en"))
    assert line.startswith("Applying the advice of all failing checks together gives a pass: clutch.shoe_width ")
    assert line.rstrip(".") in (tmp_path / "press.html").read_text("utf-8")
    assert main(["verify", str(tmp_path / "press.html"), "--numbers"]) == 0


def test_other_outcomes_are_told_in_words() -> None:
    changes = [{"path": "a.b", "value": "5 mm"}]
    results = filled(ResultsRecord, {"summary": {"advice": {"changes": changes, "failing": ["c.d"], "error": None}}})
    assert list(followed_line(results, Catalogue("en"))) == [
        "Applying the advice of all failing checks together (a.b 5 mm) leaves other checks failing: c.d."
    ]
    results = filled(ResultsRecord, {"summary": {"advice": {"changes": changes, "failing": [], "error": "no"}}})
    assert "gives a machine that cannot be built" in next(followed_line(results, Catalogue("en")))
    assert list(followed_line(filled(ResultsRecord, {}), Catalogue("en"))) == []
