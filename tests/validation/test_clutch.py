"""Each number of the clutch's worked example: reproduced to its last digit."""

from __future__ import annotations

from math import atan, radians, tan

import pytest

from tests.validation.rows import Row
from tests.validation.rows_clutch import ROWS, clutch


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.place}: {row.quantity}")
def test_the_number_is_ours(row: Row) -> None:
    assert row.reproduces(row.ours())


def test_both_forms_of_equation_15_agree() -> None:
    """The wedge through the angle of friction, beside the source's formula of sines and cosines."""
    expected = clutch("pressing_force") * tan(radians(10) + atan(0.1))
    assert clutch("engagement_force") == pytest.approx(expected, rel=1e-14)
