"""What tests of searches share."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import pytest

from diecut_report.study.storage import store

NO_PAGE = SimpleNamespace(page=lambda _: "", sheets=lambda _: b"")


@pytest.fixture(autouse=True)
def _without_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing of a test stays in the user's cache."""
    monkeypatch.setattr(store, "REMEMBERED_SIZE", float("inf"))


@pytest.fixture
def without_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """Searches get no page: it takes seconds with what draws it, and has a test of its own."""
    monkeypatch.setitem(sys.modules, "diecut_report.design.optimisation.page", NO_PAGE)  # type: ignore[arg-type]
