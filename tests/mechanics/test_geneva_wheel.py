"""The body of a Geneva wheel against a count of the points of a grid that lie in it, and against the method's numbers."""

from __future__ import annotations

from math import cos, hypot, pi, sin

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.mechanics.geneva_wheel import area_and_polar
from tests.examples import every


def counted(slots: int, center: float, roller: float, locking: float, bore: float, cells: int) -> tuple[float, float]:
    """Area and polar second moment by the cells of a grid that lie in the wheel, as a drawing has it: a disc less slots, arcs and bore."""
    crank, rim = center * sin(pi / slots), hypot(center * cos(pi / slots), roller)
    line = (np.arange(cells) + 0.5) / cells * 2 * rim - rim
    x, y = np.meshgrid(line, line)
    x, y = _along(x, y, 0.1), _across(x, y, 0.1)  # no slot lies along the rows of cells
    radius, inside = np.hypot(x, y), np.ones_like(x, dtype=bool)
    for slot in range(slots):
        along, across = (f(x, y, 2 * pi * slot / slots) for f in (_along, _across))
        inside &= ~((along > center - crank) & (np.abs(across) < roller)) & (
            np.hypot(along - center + crank, across) > roller
        )
        between = 2 * pi * (slot + 0.5) / slots
        inside &= np.hypot(_along(x, y, between) - center, _across(x, y, between)) > locking
    inside &= (radius < rim) & (radius > bore / 2)
    cell = (2 * rim / cells) ** 2
    return float(inside.sum() * cell), float((radius[inside] ** 2).sum() * cell)


def _along(x: Array, y: Array, angle: float) -> Array:
    found: Array = x * cos(angle) + y * sin(angle)
    return found


def _across(x: Array, y: Array, angle: float) -> Array:
    found: Array = y * cos(angle) - x * sin(angle)
    return found


@pytest.mark.parametrize(
    ("slots", "center", "roller", "locking", "bore"),
    every(
        2,
        [
            (6, 0.24, 0.016, 0.072, 0.045),
            (8, 0.3, 0.01, 0.08, 0),
            (3, 0.15, 0.01, 0.09, 0.02),
            (4, 0.2, 0.012, 0.1, 0.03),
        ],
    ),
)
def test_a_geneva_wheel_has_the_area_that_a_drawing_of_it_has(
    slots: int, center: float, roller: float, locking: float, bore: float
) -> None:
    found = area_and_polar(slots, center, roller, locking, bore)
    assert found == pytest.approx(counted(slots, center, roller, locking, bore, 1500), rel=5e-4)


def test_the_wheel_of_the_press_weighs_what_the_method_says() -> None:
    area, polar = area_and_polar(6, 0.24, 0.016, None, 0.045)
    assert 7850 * 0.035 * area == pytest.approx(26.21, abs=5e-3)
    assert 7850 * 0.035 * polar == pytest.approx(0.4724, abs=5e-5)
