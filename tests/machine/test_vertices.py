"""Vertices of curves by the polynomial about points of the search grid, against curves whose extremes are known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.machine.numerics.domain import shares
from diecut_report.machine.numerics.extremes import Spots, around, vertices
from tests.examples import few

INTERVALS = 32
Curve = Callable[[Array], Array]


def told(curve: Curve, left: float, width: float, k: int | None = None) -> tuple[float, float, bool]:
    """The vertex of a curve in one piece about its greatest value on the grid (or a given point of it)."""
    values = curve(left + width * shares(INTERVALS))[None, :]
    spot = np.array([values.argmax() if k is None else k])
    spots = Spots(spot, around(values, np.array([0]), spot), np.array([left]), np.array([width]), INTERVALS)
    place, height, holds = vertices(lambda x, _: curve(x), spots)
    return float(place[0]), float(height[0]), bool(holds[0])


@pytest.mark.parametrize("seed", few(range(200), keep=lambda seed: seed % 5 == 0))
def test_a_peak_between_points_is_found_to_rounding(seed: int) -> None:
    random = np.random.default_rng(seed)
    top, left, width, size = (
        random.uniform(-2, 2),
        random.uniform(-5, 5),
        random.uniform(0.3, 2.5),
        10 ** random.uniform(-6, 6),
    )
    peak = left + width * random.uniform(0.05, 0.95)
    place, height, holds = told(lambda x: size * (top + np.cos(1.3 * (x - peak))), left, width)
    assert holds
    assert abs(place - peak) < 1e-7 * width
    assert abs(height - size * (top + 1)) < 1e-14 * size * (abs(top) + 1)


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_curve_that_falls_from_the_end_has_its_top_there(side: str) -> None:
    curve: Curve = np.exp if side == "right" else lambda x: np.exp(-x)
    place, height, holds = told(curve, 1.0, 2.0)
    assert holds
    assert height == (curve(np.array([3.0 if side == "right" else 1.0])))[0]
    assert abs(place - (3.0 if side == "right" else 1.0)) < 1e-15


@pytest.mark.parametrize("side", [1, -1])
def test_a_peak_between_the_end_and_the_next_point_is_found(side: int) -> None:
    first = shares(INTERVALS)[1]
    peak = side * (1 - 0.9 * first)  # in a piece from -1 to 1, nearer to its end than the first point
    curve: Curve = lambda x: 3 - (x - peak) ** 2  # noqa: E731
    place, height, holds = told(curve, -1.0, 2.0, INTERVALS if side > 0 else 0)
    assert holds
    assert abs(place - peak) < 1e-7
    assert abs(height - 3) < 1e-15


@pytest.mark.parametrize(
    "curve",
    [
        lambda x: -np.abs(x - 0.3),  # a corner
        lambda x: np.where(x < 0.3, x, x - 1),  # a jump
        lambda x: np.cos(3 * x) + 0.2 * np.cos(120 * x),  # more waves than points
        lambda x: np.sqrt(np.abs(x - 0.99)),  # an endless slope
        lambda x: np.where(np.abs(x - 0.3) < 0.001, 2.0, np.cos(x - 0.3)),  # a spike that the points do not show
    ],
    ids=["corner", "jump", "waves", "root", "spike"],
)
def test_a_curve_that_does_not_follow_the_polynomial_is_left_to_the_search(curve: Curve) -> None:
    values = curve(-1 + 2 * shares(INTERVALS))
    inner = 1 + int(np.argmax(values[1:-1]))
    assert not told(curve, -1.0, 2.0, inner)[2]


def test_nothing_holds_where_the_curve_is_no_number() -> None:
    assert not told(lambda x: np.full_like(x, np.nan), 0.0, 1.0, 4)[2]


def test_a_straight_line_has_no_vertex_inside() -> None:
    assert not told(lambda x: 2 * x, 0.0, 1.0, 5)[2]
