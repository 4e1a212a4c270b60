"""Places of a bearing's cycle: neighbours within a piece, both ends of an angle, the side of a jump."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.plugins.rolling_bearing.duty import Duty
from diecut_report.plugins.rolling_bearing.loads import speed_over


class AngleOfTwoLines:
    """A relative angle that is two straight lines, each of which goes on beyond its piece."""

    breakpoints = joints = np.array([[0.5]])

    def values(self, share: Any, middle: Any, rows: Any) -> Any:
        """Up with 2 in the first half, down with 1 in the second."""
        return np.where(middle < 0.5, 2 * share, 1.5 - share)


def duty(**changes: Any) -> Duty:
    """A bearing of a single machine under a constant force."""
    one = np.ones((1, 1))
    return Duty(
        **(
            {"radial": one, "axial": 0 * one, "speed": None, "angle": AngleOfTwoLines(), "factor": one, "variants": 1}
            | changes
        )
    )


def test_the_angle_at_the_end_of_the_cycle_is_that_of_its_last_piece() -> None:
    found = [duty()._angle_at(np.full((1, 1), share))[0, 0] for share in (0.0, 1.0)]
    assert found == pytest.approx([0.0, 0.5], abs=1e-12)  # by the first piece's line the end would be 2


def test_all_peaks_of_a_curve_are_looked_at_together() -> None:
    """Each look at a curve costs about the same, be it at one place or at many."""
    looks: list[tuple[int, ...]] = []

    class Waves:
        breakpoints = joints = np.empty((1, 0))

        def values(self, share: Any, middle: Any, rows: Any) -> Any:
            looks.append(share.shape)
            return 2 + np.sin(10 * np.pi * share) + 0.1 * np.sin(2 * np.pi * share - 0.2)

    of_waves = duty(radial=Waves(), speed=np.ones((1, 1)), angle=None)
    first = of_waves.first
    looks.clear()
    radial, _ = of_waves.greatest(lambda radial, _: radial, first)
    assert len(looks) <= 5
    fine = np.linspace(0, 1, 200_001)
    expected = np.max(2 + np.sin(10 * np.pi * fine) + 0.1 * np.sin(2 * np.pi * fine - 0.2))
    assert radial[0, 0] == pytest.approx(expected, rel=1e-9)


def test_the_neighbours_of_a_place_lie_in_its_own_piece() -> None:
    share = np.array([[[0.0, 0.1, 0.2], [0.2, 0.6, 1.0]]])
    for index, expected in (
        (0, (0.0, 0.0, 0.1, 0.1)),
        (2, (0.2, 0.1, 0.2, 0.1)),
        (3, (0.2, 0.2, 0.6, 0.6)),
        (4, (0.6, 0.2, 1.0, 0.6)),
    ):
        found = duty()._about(np.array([0]), np.array([index]), share)
        assert [each[0, 0] for each in found] == pytest.approx(expected)


def test_the_speed_of_a_bearing_is_asked_for_at_shares_of_its_cycle() -> None:
    asked: list[Any] = []

    class NotedSpeeds:
        """Notes what it is asked for."""

        def speed(self, *given: Any) -> Any:
            asked.append(given)
            return 0

    speed_over(3, NotedSpeeds(), np.array([[np.pi]]), np.array([[3 * np.pi / 2]]), None)  # type: ignore[arg-type]
    assert asked == [(3, 0.5, 0.75, None)]
