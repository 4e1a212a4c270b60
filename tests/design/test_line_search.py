"""Roots, limits and extremes along one number: found with few calls, held against closed forms and scipy."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.optimize import brentq

from diecut_report.design.line_search import crossings, greatest, looked_closer, roots
from diecut_report.formulas import Array

X = np.linspace(0.1, 4.0, 20)


class Counted:
    """A function that counts how often it is called."""

    def __init__(self, function: object) -> None:
        self.function, self.calls = function, 0

    def __call__(self, x: Array) -> Array:
        self.calls += 1
        with np.errstate(all="ignore"):
            return np.asarray(self.function(x), dtype=float)  # type: ignore[operator]


def test_all_roots_are_found_with_few_calls() -> None:
    def wave(x: Array) -> Array:
        return np.sin(3 * x) + 0.1 * x

    counted = Counted(wave)
    found = crossings(counted, X, wave(X))
    brackets = [(low, high) for low, high in itertools.pairwise(X) if wave(low) * wave(high) < 0]
    assert [each.at for each in found] == pytest.approx([brentq(wave, *each) for each in brackets], rel=1e-12)
    assert len(found) == 3 and not any(each.is_jump for each in found) and counted.calls <= 5


def test_a_jump_is_not_a_root() -> None:
    def step(x: Array) -> Array:
        return np.where(x < np.sqrt(2), 1 + 0.1 * x, -1 - x)

    (found,) = crossings(step, X, step(X))
    assert found.is_jump and found.inside == pytest.approx(np.sqrt(2), rel=2e-9) and found.inside < np.sqrt(2)


def test_the_end_of_what_exists_is_a_limit_from_inside() -> None:
    counted = Counted(lambda x: np.sqrt(np.pi - x))
    (found,) = crossings(counted, X, counted(X))
    assert found.is_jump and np.pi * (1 - 2e-9) <= found.inside <= np.pi


def test_a_pair_of_roots_between_two_points_is_found() -> None:
    def parabola(x: Array) -> Array:
        return (x - 2.0) ** 2 - 1e-4  # roots at 1.99 and 2.01

    x, values = looked_closer(parabola, X, parabola(X))
    assert [each.at for each in crossings(parabola, x, values)] == pytest.approx([1.99, 2.01])


@pytest.mark.parametrize(
    ("function", "place"), [(lambda x: -((x - 1.7) ** 2), 1.7), (lambda x: x, 4.0), (np.sin, np.pi / 2)]
)
def test_the_greatest_value_is_found_inside_and_at_an_end(function: object, place: float) -> None:
    counted = Counted(function)
    at, value = greatest(counted, X, counted(X))
    assert at == pytest.approx(place, rel=1e-4) and value == pytest.approx(
        float(counted(np.array([place]))[0]), abs=1e-8
    )
    assert counted.calls <= 9


def test_roots_beside_the_end_of_what_exists_are_found() -> None:
    def pole(x: Array) -> Array:
        return np.where((x > 1.9), np.log(np.maximum(x - 1.9, 1e-300)) + 7.0, np.nan)  # zero at 1.9 + e⁻⁷

    places, jumps = roots(Counted(pole), X, pole(X), None, np.isfinite)
    assert places == pytest.approx([1.9 + np.exp(-7)]) and jumps == []


def test_a_root_of_machines_that_exist_between_two_points_alone_is_found() -> None:
    def island(x: Array) -> Array:
        return np.where(np.abs(x - 2.0) < 4e-3, x - 2.003, np.nan)

    x = np.sort(np.append(X, 2.0))  # today's value exists
    assert roots(Counted(island), x, island(x), 2.0, np.isfinite)[0] == pytest.approx([2.003])


def test_a_value_that_is_kept_is_told_by_its_ends() -> None:
    def steps(x: Array) -> Array:
        return np.floor(x) - 2.0

    counted = Counted(steps)
    places, jumps = roots(counted, X, steps(X), 0.5, np.isfinite)
    assert places == pytest.approx([2.0, 3.0], rel=1e-8) and jumps == [] and counted.calls < 30
    assert steps(np.array(places)).tolist() == [0.0, 0.0]


def test_the_nearest_of_many_roots_is_found() -> None:
    def saw(x: Array) -> Array:
        return x * 40 % 1.0 - 0.4

    places, _ = roots(Counted(saw), X, saw(X), 2.0, np.isfinite)
    assert min(places, key=lambda each: abs(each - 2.0)) == pytest.approx(2.01)
