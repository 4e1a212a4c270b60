"""The clutch of the worked example by a second form of its formula."""

from __future__ import annotations

from math import atan, radians, tan

import pytest

from tests.validation.rows_clutch import clutch


def test_both_forms_of_equation_15_agree() -> None:
    """The wedge through the angle of friction, beside the source's formula of sines and cosines."""
    expected = clutch("pressing_force") * tan(radians(10) + atan(0.1))
    assert clutch("engagement_force") == pytest.approx(expected, rel=1e-14)
