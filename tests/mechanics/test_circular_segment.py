"""The segment of a circle against its chord and its arc."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.mechanics import circular_segment


@pytest.mark.parametrize("half", [0.05, 0.4, 1.0, 1.5])
def test_huygens_arc_is_that_of_the_chord_and_the_height_and_near_the_true_one(half: float) -> None:
    radius = 0.3
    ends = radius * np.array([[-np.sin(half), np.cos(half)], [np.sin(half), np.cos(half)]])
    chord, height = np.hypot(*(ends[1] - ends[0])), radius - ends[0, 1]
    found = circular_segment.arc_length_huygens(radius, height)
    assert found == pytest.approx(np.sqrt(chord**2 + 16 / 3 * height**2), rel=1e-12)
    assert found == pytest.approx(2 * half * radius, rel=half**4 / 90)  # the series of both agree up to the third power
