"""The documentation's validation page is what the tests' rows say."""

from __future__ import annotations

import re

from tests.validation.page import PAGE, TRUST, page, trusted


def test_the_page_is_made_from_the_rows() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run: python -m tests.validation.page"


def test_the_page_on_trust_counts_the_rows_of_today() -> None:
    text = TRUST.read_text(encoding="utf-8")
    rows = [line.split(" | ")[5] for line in page().splitlines() if line.startswith("| ") and line.count(" | ") >= 6]
    said = [int(number) for number in re.findall(r"lists (\d+) numbers[^:]*:\s*(\d+) agree, in (\d+)", text)[0]]
    assert said == [len(rows) - rows.count("verdict") - rows.count("---"), rows.count("agrees"), rows.count("mistake")]
    assert text == trusted(text), "run: python -m tests.validation.page"
