"""Each number that 003 prints for the cam-gear stepper: reproduced, or its mistake shown by following the source."""

from __future__ import annotations

import pytest

from diecut_report.engine import Impossible
from tests.plugins.steppers import stepper
from tests.validation.rows import Row
from tests.validation.rows_cam_gear_transport import ROWS


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.place}: {row.quantity}")
def test_the_printed_number_is_ours_or_its_mistake_is_known(row: Row) -> None:
    if row.verdict == "agrees":
        assert row.reproduces(row.ours())
        return
    assert not row.reproduces(row.ours())
    assert row.by_source is not None and row.reproduces(row.by_source())
    assert row.why


def test_the_sources_longest_dwell_leaves_no_return_with_its_sweeps() -> None:
    with pytest.raises(Impossible, match=r"= -0\.04"):
        stepper(dwell_angle="225 deg")
