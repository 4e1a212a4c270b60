"""What tests of studies share."""

from __future__ import annotations

import pytest

from diecut_report.study import command
from diecut_report.study.storage import verified_parts
from diecut_report.study.summary import summarise


@pytest.fixture(autouse=True)
def _without_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing of a test stays in the user's cache."""
    monkeypatch.setattr(verified_parts, "LARGE", float("inf"))


@pytest.fixture
def with_html_summary(monkeypatch: pytest.MonkeyPatch) -> None:
    """Studies get their summary as HTML alone."""
    monkeypatch.setattr(command, "summarise", lambda folder: summarise(folder, ["html"]))
