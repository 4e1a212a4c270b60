"""What the search for the smallest chain is made of: places of the cycle, greatest tensions, room between sprockets."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.plugins.roller_chain import sizing


class JumpingCurve:
    """A curve that jumps at three tenths of its cycle."""

    breakpoints = np.array([[0.3]])

    def values(self, share: Any, middle: Any, rows: Any) -> Any:
        """One before the jump, five behind it."""
        return np.where(middle < 0.3, 1.0, 5.0)


def test_places_of_the_cycle_lie_in_the_smooth_pieces_of_a_curve() -> None:
    places, middles = sizing._places([JumpingCurve()])  # type: ignore[list-item]
    assert np.unique(middles) == pytest.approx([0.15, 0.65])
    assert (places.min(), places.max()) == (0, 1)
    assert ((places <= 0.3) == (middles < 0.3)).sum() == places.size - 1  # the second piece begins where the first ends


def test_only_what_is_sampled_is_taken_a_little_greater() -> None:
    fits = np.array([[True]])
    assert sizing._greatest(np.array([[7.0]]), fits) == 7.0
    assert 7.0 < sizing._greatest(np.array([[3.0, 7.0]]), fits) < 7.01
    assert np.isnan(sizing._greatest(np.array([[7.0]]), ~fits))


def test_links_a_little_too_few_to_go_round_have_no_distance() -> None:
    teeth = 20.0, 62.0  # 2·√2·(62 − 20)/2π = 18.907 links must be free of the sprockets, which hold 41

    def distance(links: float) -> Any:
        known = {"distance_wanted": np.array([[0.0]]), "links_wanted": np.array([[links]])}
        return sizing._loop(known, 0.019, teeth)[0]

    assert np.isnan([distance(50.0), distance(59.0), distance(59.9)]).all()
    assert distance(59.92) > 0
