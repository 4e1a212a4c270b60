"""The documentation's validation page is what the tests' rows say."""

from __future__ import annotations

from tests.validation.page import PAGE, page


def test_the_page_is_made_from_the_rows() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run: python -m tests.validation.page"
