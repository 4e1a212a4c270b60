"""Curves that others ask of a machine at the same places share what they have in common, and give the same values as each alone."""

from __future__ import annotations

import numpy as np

from diecut_report.machine.calculation import CurveHandle
from diecut_report.machine.numerics.domain import RecentPlaces
from tests.machine.test_switches import FORMULAS, run, wheel

X = np.linspace(0, 1, 5)[None, :]
MOST = 3


def test_what_is_known_at_places_is_made_once_and_only_for_these_places() -> None:
    recent, made = RecentPlaces[int](MOST), list[int]()

    def make() -> int:
        made.append(len(made))
        return made[-1]

    assert [recent.at("angle", (X, X, None), make), recent.at("angle", (X.copy(), X, None), make)] == [0, 0]
    assert recent.at("time", (X, X, None), make) == 1
    assert recent.at("angle", (X + 1, X, None), make) == 2
    assert recent.at("angle", (X, X + 1, None), make) == 3
    assert recent.at("angle", (X.T, X.T, None), make) == 4
    assert recent.at("angle", (X.T, X.T, np.array([0])), make) == 5


def test_no_more_places_are_kept_than_the_last_ones() -> None:
    recent = RecentPlaces[float](MOST)
    for first in range(MOST + 1):
        recent.at("angle", (X + first, X), lambda first=first: first)  # type: ignore[misc]
    assert recent.at("angle", (X + MOST, X), lambda: -1.0) == MOST
    assert recent.at("angle", (X, X), lambda: -1.0) == -1


def test_a_curve_taken_over_is_that_of_its_own_piece_and_of_no_other_curve() -> None:
    calc = run(wheel(FORMULAS["a narrow window"], "start", "end"))
    lift, torque = (CurveHandle(calc, name) for name in ("lift", "torque"))
    share, edge = np.array([[0.1, 0.25]]), np.full((1, 2), 100 / 360)
    for _ in range(2):
        assert np.allclose(lift.values(share, share, None), np.cos(share * 2 * np.pi - 1))
        assert np.allclose(torque.values(share, share, None), 81)
    before, within = (torque.values(edge, edge + step / 360, None)[0, 0] for step in (-1, 1))
    assert (before, within) == (81, 81), "at the very edge the condition does not hold"
    inside = edge + 0.5 / 360
    assert torque.values(inside, inside, None)[0, 0] == 3 * 81
