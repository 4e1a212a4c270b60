"""Roots in many brackets against those of SciPy, one by one."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from diecut_report.mechanics.numerics import narrowed, root


def test_each_bracket_has_its_root() -> None:
    draw = np.random.default_rng(3)
    slope, place = draw.uniform(0.1, 9, 40), draw.uniform(-2, 2, 40)
    low, high = place - draw.uniform(0.1, 3, 40), place + draw.uniform(0.1, 3, 40)
    found = root(lambda x, row: np.tanh(slope[row] * (x - place[row])) * np.exp(x), low, high)
    for i, each in enumerate(found):
        expected = brentq(lambda x, i=i: math.tanh(slope[i] * (x - place[i])), low[i], high[i], xtol=1e-15)
        assert abs(each - expected) <= 4e-15 * max(1, abs(expected))


def test_a_root_at_an_end_is_found_and_brackets_of_whole_numbers_are_numbers() -> None:
    found = root(lambda x, _: x - 2.0, np.array([2, 0, 1]), np.array([5, 2, 4]))
    np.testing.assert_array_equal(found, [2.0, 2.0, 2.0])


def test_nothing_is_found_where_the_sign_does_not_change_or_there_is_no_value() -> None:
    with np.errstate(invalid="ignore"):
        found = root(lambda x, _: np.sqrt(x) - 1, np.array([2.0, -1.0, 0.0]), np.array([3.0, 4.0, 3.0]))
    assert np.isnan(found[:2]).all() and abs(found[2] - 1) < 4e-16


def test_where_there_is_no_bracket_nothing_is_evaluated() -> None:
    looks: list[int] = []
    place, left = narrowed(lambda x, _: looks.append(len(x)) or x, np.empty(0), np.empty(0), np.empty((2, 0)))
    assert len(place) == len(left) == len(looks) == 0


def test_a_root_is_known_as_near_as_is_asked() -> None:
    looks: list[int] = []

    def function(x: np.ndarray, row: np.ndarray) -> np.ndarray:
        looks.append(len(x))
        return x**3 - 1e-3 * (row + 1)

    rough = root(function, np.zeros(2), np.ones(2), 1e-3)
    few, exact = len(looks), root(function, np.zeros(2), np.ones(2))
    np.testing.assert_allclose(rough, exact, atol=1e-3)
    np.testing.assert_allclose(exact, np.cbrt([1e-3, 2e-3]), rtol=1e-15)
    assert few < len(looks) - few
