"""The failing check of the damper's worked example."""

from __future__ import annotations

import pytest

from diecut_report.results.mechanism import mechanism_results
from tests.validation.rows_damper import damper


def test_the_block_that_the_formula_alone_gives_would_buckle() -> None:
    checks = {check.id: check for check in mechanism_results(damper(), {}).checks}
    assert checks["slenderness"].status == "fail"
    assert checks["slenderness"].demand == pytest.approx(560 / 30, rel=1e-12)
    assert (checks["strain"].status, checks["stress"].status) == ("pass", "pass")
