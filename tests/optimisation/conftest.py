"""What tests of searches share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from diecut_report.optimisation import page
from diecut_report.study.storage import verified_parts


@pytest.fixture(autouse=True)
def _without_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing of a test stays in the user's cache."""
    monkeypatch.setattr(verified_parts, "LARGE", float("inf"))


@pytest.fixture
def without_page(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Searches get no page: it takes seconds, and has a test of its own."""
    monkeypatch.setattr(page, "page", lambda _: "")
    monkeypatch.setattr(page, "sheets", lambda _: b"")
    yield
