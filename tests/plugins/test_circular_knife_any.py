"""Circular knives of any size: whether they are calculated and drawn, their likeness, many at once."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.circular_knife import MECHANISM
from diecut_report.results.mechanism import mechanism_results
from tests.examples import examples
from tests.machines import inputs, number
from tests.plugins.knives import at, in_cut
from tests.validation.rows_circular_knife import KEYS

SHARE = st.floats(0.05, 0.95)


def any_knife(radius: float, ecc: float, low: float, board: float, cut: float, thin: float) -> dict[str, Any]:
    """Inputs (SI) of a knife that can cut: each size as a share of its range."""
    r = radius * ecc
    depth = radius + r * (2 * low - 1)
    reach = np.sqrt((radius + r) ** 2 - depth**2)
    thickness = 0.01 * thin * r
    heights = np.array([depth, depth - thickness]) - radius
    least = np.sqrt(np.maximum(r**2 - heights**2, 0)).max()
    front = least + board * (reach - least)
    sized = {"eccentricity": r, "edge_radius": radius, "depth": depth, "front_distance": front, "thickness": thickness,
             "cut_length": cut * (reach - front)}  # fmt: skip
    return inputs(MECHANISM, KEYS) | {name: float(value) for name, value in sized.items()}


@given(radius=st.floats(0.02, 2), ecc=SHARE, low=SHARE, board=SHARE, cut=SHARE, thin=SHARE)
def test_any_knife_that_can_cut_is_calculated(
    radius: float, ecc: float, low: float, board: float, cut: float, thin: float
) -> None:
    base = any_knife(radius, ecc, low, board, cut, thin)
    calc = calculate(MECHANISM, base)
    angles = in_cut(calc, 101)
    x = at(calc, "cut_position", angles)
    assert (np.diff(x) > 0).all()
    assert x[0] == pytest.approx(base["front_distance"], rel=1e-3) and x[-1] == pytest.approx(
        number(calc, "cut_end"), rel=1e-3
    )
    assert (np.diff(at(calc, "shear_angle", angles)) > 0).all()
    assert (at(calc, "force", angles) >= at(calc, "working_force", angles)).all()
    r, center = base["eccentricity"], np.exp(1j * np.array([number(calc, "angle_start"), number(calc, "angle_end")]))
    points = np.array([base["front_distance"], number(calc, "cut_end")]) + 1j * base["depth"]
    np.testing.assert_allclose(abs(points - r * center), radius, rtol=1e-12)


@given(ecc=SHARE, low=SHARE, board=SHARE, cut=SHARE, thin=SHARE, scale=st.floats(0.1, 10))
def test_a_knife_of_another_size_has_the_same_angles_and_its_force_grows_with_the_square(
    ecc: float, low: float, board: float, cut: float, thin: float, scale: float
) -> None:
    one, other = (calculate(MECHANISM, any_knife(0.1 * size, ecc, low, board, cut, thin)) for size in (1.0, scale))
    for name, power in (
        ("angle_start", 0),
        ("shear_angle_max", 0),
        ("cut_speed_max", 1),
        ("force_max", 2),
        ("work", 3),
    ):
        assert number(other, name) == pytest.approx(number(one, name) * scale**power, rel=1e-7, abs=1e-12), name


@examples(25)
@given(board=SHARE, cut=SHARE, low=SHARE)
@pytest.mark.nightly
def test_the_figures_of_any_knife_are_drawn_and_its_three_positions_beside_one_another(
    board: float, cut: float, low: float
) -> None:
    calc = calculate(MECHANISM, any_knife(0.1, 0.2, low, board, cut, 0.5))
    figures = {figure.id: figure for figure in mechanism_results(calc, {}).figures}
    assert list(figures) == ["positions", "front", "motion", "load", "placement"]
    marks = [shape.at for shape in figures["positions"].shapes if shape.shape == "point" and shape.role == "mark"]
    pivots = [shape.at for shape in figures["positions"].shapes if shape.shape == "point" and shape.role == "pivot"]
    reached = [mark[0] - pivot[0] for mark, pivot in zip(marks, pivots, strict=True)]
    assert reached[0] == pytest.approx(number(calc, "front_distance"), rel=1e-9)
    assert reached[2] == pytest.approx(number(calc, "cut_end"), rel=1e-9)
    assert {mark[1] for mark in marks} == {-number(calc, "depth")}
    blades = [
        np.array(shape.points)[:, 0]
        for shape in figures["positions"].shapes
        if shape.shape == "polyline" and shape.role == "body"
    ]
    assert len(blades) == 3
    for left, right in pairwise(blades):
        assert left.max() < right.min()
