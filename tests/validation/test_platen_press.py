"""The torque that 001 prints, and where the two formulas leave it."""

from __future__ import annotations

from math import degrees, pi

import numpy as np
import pytest

from tests.machines import at, number
from tests.validation.rows_platen_press import eq_14, press


def above(curve: str, level: float) -> tuple[float, float]:
    """The first and the last angle (°) before the dead centre at which a curve is above a level."""
    before = np.linspace(1e-4, number(press(), "cutting_start_angle"), 40_001)
    high = before[at(press(), curve, 2 * pi - before) > level]
    return degrees(high[-1]), degrees(high[0])


def test_where_both_formulas_pass_the_printed_torque() -> None:
    """As the report says: eq. 14 is above it from 4.02° to 0.27°, the corrected torque from 5.62° to 0.13°."""
    assert above("torque_source", 5100) == pytest.approx((4.02, 0.27), abs=0.006)
    assert above("torque", 5100) == pytest.approx((5.62, 0.13), abs=0.006)


def test_the_printed_torque_leaves_the_cutting_force_next_to_no_arm() -> None:
    rest = 5100 - number(press(), "torque_relaxing")
    assert rest / 500e3 == pytest.approx(0.21e-3, abs=0.005e-3)
    assert 5100 / number(press(), "torque_relaxing") == pytest.approx(1.02, abs=0.005)
    assert eq_14(0) == 0  # just after the dead centre eq. 14 has no say
    assert eq_14(1e-6) == pytest.approx(number(press(), "torque_dead_center"), rel=1e-6)


def test_a_thicker_board_raises_the_peak_against_conclusion_2() -> None:
    thin, thick = press(), press(material_thickness=1)
    assert [round(number(c, "torque_max")) for c in (thin, thick)] == [6409, 6923]
    assert [round(number(c, "torque_max_source")) for c in (thin, thick)] == [5496, 6102]
    assert number(thick, "cutting_work") == pytest.approx(2 * number(thin, "cutting_work"), rel=1e-14)
