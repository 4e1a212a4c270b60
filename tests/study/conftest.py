"""What tests of studies share."""

from __future__ import annotations

import pytest

from diecut_report.study.storage import store


@pytest.fixture(autouse=True)
def _without_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing of a test stays in the user's cache."""
    monkeypatch.setattr(store, "REMEMBERED_SIZE", float("inf"))
