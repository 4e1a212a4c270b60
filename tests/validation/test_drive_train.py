"""Each number of the worked examples of the drive train."""

from __future__ import annotations

import pytest

from tests.validation.rows import Row
from tests.validation.rows_drive_train import ROWS


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.place}: {row.quantity}")
def test_the_number_is_reproduced(row: Row) -> None:
    assert row.verdict == "agrees"
    assert row.reproduces(row.ours())
