"""Each number of the damper's worked example, and its failing check."""

from __future__ import annotations

import pytest

from diecut_report.results import mechanism_results
from tests.validation.rows import Row
from tests.validation.rows_damper import ROWS, damper


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.quantity)
def test_the_number_of_the_worked_example_is_ours(row: Row) -> None:
    assert row.verdict == "agrees"
    assert row.reproduces(row.ours())


def test_the_block_that_the_formula_alone_gives_would_buckle() -> None:
    checks = {check["id"]: check for check in mechanism_results(damper(), {})["checks"]}
    assert checks["slenderness"]["status"] == "fail"
    assert checks["slenderness"]["demand"] == pytest.approx(560 / 30, rel=1e-12)
    assert (checks["strain"]["status"], checks["stress"]["status"]) == ("pass", "pass")
