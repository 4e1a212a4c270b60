"""A phase is not longer than its period: ends that plain code gives in degrees would make it all of the turn."""

from __future__ import annotations

from typing import Annotated

import numpy as np
import pytest

from diecut_report.api import POINTS, Chapter, Inputs, Mechanism, Quantity
from diecut_report.machine.calculation import Calculation, Unproven
from diecut_report.machine.steps.run import calculate
from diecut_report.results.mechanism import phases


class Cam(Inputs):
    rise: Annotated[float, Quantity("φ_r", "deg", "Rise", gt=0)]
    n_points: Annotated[int, POINTS] = 36


def cam(rise: float | list[float], start: float, way: float = 1.0) -> Calculation:
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    chapter.computed("start", "φ_1", "deg", "Start", lambda rise: 0 * rise + start, ("rise",), "it is so")
    chapter.value("end", "φ_2", "deg", "End", lambda start, rise: start + way * rise)
    chapter.phase("rising", "working", "The follower rises", "angle", ("start", "end"))
    mechanism = Mechanism(kind="cam", version="1", title="Cam", summary="", inputs=Cam, chapters=(chapter,))
    count = len(rise) if isinstance(rise, list) else 1
    return calculate(mechanism, {"rise": np.array(rise) if isinstance(rise, list) else rise, "n_points": 36}, count)


@pytest.mark.parametrize("rise", [0.5, np.pi, 2 * np.pi])
@pytest.mark.parametrize("start", [0.0, 1.0, 100.0])
def test_a_phase_up_to_a_whole_turn_is_one(rise: float, start: float) -> None:
    ((begin, end),) = phases(cam(rise, start))["rising"].intervals
    assert end - begin == pytest.approx(rise) and 0 <= begin < 2 * np.pi


def test_a_longer_one_is_refused() -> None:
    with pytest.raises(
        Unproven,
        match=r"The follower rises \(rising\) has ends 8594° apart, more than its period of 360°; ends that plain code gives are in SI",
    ):
        cam(150.0, 0.0)
    made = cam([1.0, 150.0, 2.0, 40.0], 0.0)
    assert sorted(made.flaws) == [1, 3] and "2292° apart" in made.flaws[3][1]


def test_ends_in_degrees_over_the_seam_are_refused_as_well() -> None:
    """From 350 to 10 it would have no length at all, and be no phase."""
    with pytest.raises(Unproven, match="has ends 19481° apart"):
        cam(340.0, 350.0, -1.0)
    ((begin, end),) = phases(cam(np.radians(340), np.radians(350), -1.0))["rising"].intervals
    assert np.degrees([begin, end]) == pytest.approx([350, 370])
