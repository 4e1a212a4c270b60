"""What the steps of the worked examples of the Maltese cross have in common."""

from __future__ import annotations

import pytest

from tests.machines import number
from tests.validation.rows_geneva_transport import with_slots


@pytest.mark.parametrize("slots", [4, 6, 8])
def test_the_wheel_dwells_for_more_than_half_of_the_cycle(slots: int) -> None:
    assert number(with_slots(slots), "dwell_fraction") == pytest.approx((slots + 2) / (2 * slots), rel=1e-15)
    assert number(with_slots(slots), "dwell_fraction") > 0.5
