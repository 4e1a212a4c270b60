"""The documentation says what the code says."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.repository
def test_the_mechanism_pages_are_made_from_the_declarations() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_mechanism_pages.py"))
    for file, text in tool["pages"]().items():
        assert file.read_text(encoding="utf-8") == text, "run: python tools/make_mechanism_pages.py"
