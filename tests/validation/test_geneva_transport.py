"""The step of 000's Maltese cross, and each number of the worked examples."""

from __future__ import annotations

import pytest

from tests.machines import number
from tests.validation.rows import Row
from tests.validation.rows_geneva_transport import ROWS, with_slots


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.place}: {row.quantity}")
def test_the_number_of_the_worked_example_is_ours(row: Row) -> None:
    assert row.verdict == "agrees"
    assert row.reproduces(row.ours())


@pytest.mark.parametrize("slots", [4, 6, 8])
def test_the_wheel_dwells_for_more_than_half_of_the_cycle(slots: int) -> None:
    assert number(with_slots(slots), "dwell_fraction") == pytest.approx((slots + 2) / (2 * slots), rel=1e-15)
    assert number(with_slots(slots), "dwell_fraction") > 0.5
