"""Curves of many machines on their smooth pieces: each machine's figures are its own."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.mechanics.numerics import vertex
from diecut_report.mechanics.timing.shaft_curves import PieceRows


def test_a_machine_without_values_leaves_those_behind_it_alone() -> None:
    sizes = np.array([1.0, np.nan, 3.0, np.inf, 2.0])

    def wave(places: Array, middles: Array, machine: Array) -> Array:
        with np.errstate(invalid="ignore"):
            return np.asarray(sizes[machine][:, None] * np.sin(2 * np.pi * places))

    with np.errstate(invalid="ignore"):
        found = PieceRows.of(wave, np.full((5, 1), np.nan), 8).excess.range
    assert found[[0, 2, 4]] == pytest.approx(np.array([1.0, 3.0, 2.0]) / np.pi, rel=1e-12)  # ∫ sin is (1 − cos)/2π
    assert not np.isfinite(found[[1, 3]]).any()


@pytest.mark.parametrize("bend", [0.3, 1.0, 40.0])
def test_the_vertex_of_a_parabola_is_found_between_its_samples(bend: float) -> None:
    places = np.tile(np.arange(9.0), (3, 1))
    lows = np.array([[3.4], [2.7], [5.0]])
    assert vertex(places, bend * (places - lows) ** 2) == pytest.approx(lows[:, 0], abs=1e-12)
    ends = bend * (places[:2] - np.array([[-1.2], [9.3]])) ** 2
    assert vertex(places[:2], ends).tolist() == [0, 8]  # the least is the first or the last
