"""The height below the cylinder, against the printed numbers, dense samples and the outline of the cylinder itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from diecut_report.formulas import Array
from diecut_report.mechanics.timing import clearance
from tests.examples import examples
from tests.mechanics.timing.example_press import PERIOD, displacement, rotation, station


def least(at: clearance.Station, transport: str, offset: float) -> clearance.LeastClearance:
    """The least height of one press with a transport at an offset."""

    def height(angle: Array, _: Array) -> Array:
        flat = np.ravel(angle)
        found = clearance.carriage_clearance(at, rotation(flat), displacement(transport, offset, flat))
        return found.reshape(angle.shape)

    return clearance.least_clearance(height, np.array([PERIOD]))


ROWS = [
    ("geneva", 48.0, True, 28.9877),
    ("geneva", 38.1164, True, 23.5725),
    ("geneva", 38.1164, False, 23.7585),
    ("cam", 141.0056, True, 14.7183),
    ("cam", 141.0056, False, 11.6557),
]


@pytest.mark.parametrize("transport, offset, with_feed, expected", ROWS)
def test_the_least_heights_are_the_printed_ones_and_those_of_dense_samples(
    transport: str, offset: float, with_feed: bool, expected: float
) -> None:
    at = station(0.285, with_feed=with_feed)
    found = least(at, transport, offset)
    assert found.height[0] * 1e3 == pytest.approx(expected, abs=1e-4)
    angle = np.linspace(0, PERIOD, 20_001)
    dense = clearance.carriage_clearance(at, rotation(angle), displacement(transport, offset, angle)).min()
    assert found.height[0] == pytest.approx(dense, abs=5e-6)
    assert found.height[0] <= dense + 1e-12
    here = found.angle
    there = clearance.carriage_clearance(at, rotation(here), displacement(transport, offset, here))
    assert there[0] == pytest.approx(found.height[0], rel=1e-9)


def test_the_least_height_is_where_it_is_printed() -> None:
    found = least(station(0.285), "geneva", 48.0)
    assert np.degrees(found.angle[0]) == pytest.approx(340.967, abs=1e-3)


def outline(radius: float, half_angle: float, tilt: float) -> Array:
    """Points of the cylinder's outline about its axis, the flat turned clockwise by the tilt: shape (points, 2), x along the feed, y up."""
    arc = np.linspace(half_angle, 2 * np.pi - half_angle, 20_001)
    flat = np.linspace(-half_angle, half_angle, 2)
    corners = radius * np.stack([np.sin(flat), -np.cos(flat)], axis=1)
    chord = corners[0] + np.linspace(0, 1, 20_001)[:, None] * (corners[1] - corners[0])
    points = np.concatenate([radius * np.stack([np.sin(arc), -np.cos(arc)], axis=1), chord])
    clockwise = np.array([[np.cos(tilt), -np.sin(tilt)], [np.sin(tilt), np.cos(tilt)]])
    return points @ clockwise


@given(
    turned=st.floats(0, 2 * np.pi),
    way=st.floats(-3, 3),
    stop=st.floats(-1, 1),
    with_feed=st.booleans(),
    width=st.floats(0.01, 0.2),
)
@example(
    turned=4.5, way=2.875, stop=0.875, with_feed=False, width=0.03125
)  # the flat faces upwards, the carriage stands beyond it
@examples(60)
def test_the_height_over_the_carriages_is_that_of_the_outline(
    turned: float, way: float, stop: float, with_feed: bool, width: float
) -> None:
    at = replace(station(stop, with_feed=with_feed), carriage_width=width)
    direction = 1 if with_feed else -1
    tilt = direction * (turned if turned <= np.pi else turned - 2 * np.pi)
    # A cylinder that rolls along +x turns clockwise, so that its flat, down at the start, swings towards −x.
    axis = np.array([direction * (at.radius * turned - at.stroke / 2), at.radius])
    points = outline(at.radius, at.half_angle, tilt) + axis
    middles = stop + way + at.step * np.arange(-12, 13)
    below = [points[abs(points[:, 0] - middle) <= width / 2, 1] for middle in middles]
    expected = min((each.min() for each in below if len(each)), default=np.inf)
    found = clearance.carriage_clearance(at, np.array([turned]), np.array([way]))[0]
    high = 0.9 * at.radius  # above it the side is so steep that points of an outline do not tell the height
    assert min(found, high) == pytest.approx(min(expected, high), abs=5e-4 if expected > 0.3 * at.radius else 5e-5)


@given(tilt=st.floats(-np.pi, np.pi))
@examples(60)
def test_the_lowest_point_of_the_profile_is_where_it_is_said(tilt: float) -> None:
    at = station(0.0)
    distance = np.linspace(-at.radius, at.radius, 20_001)[1:-1]
    heights = clearance.profile_height(at, np.array(tilt), distance)
    lowest = clearance.profile_height(at, np.array(tilt), clearance.lowest_distance(at, np.array(tilt)))
    assert heights.min() == pytest.approx(float(lowest), abs=2e-5)  # beside the corner a sample is up to a step away
    assert heights.min() >= lowest - 1e-12


def test_no_carriage_below_the_cylinder_is_no_limit() -> None:
    far = replace(station(10.0), step=100.0)
    still = clearance.least_clearance(
        lambda angle, _: clearance.carriage_clearance(far, rotation(angle), np.zeros_like(angle)), np.array([PERIOD])
    )
    assert still.height == np.inf


def test_the_least_heights_of_many_stations_are_those_of_each() -> None:
    stops = np.linspace(0.1, 0.5, 40)[:, None]
    many = station(stops)

    def height(angle: Array, machine: Array) -> Array:
        flat = np.ravel(angle)
        turned, way = (each.reshape(angle.shape) for each in (rotation(flat), displacement("geneva", 48.0, flat)))
        return clearance.carriage_clearance(many.of(machine), turned, way)

    found = clearance.least_clearance(height, np.full(40, PERIOD))
    for index in (0, 17, 39):
        alone = least(station(float(stops[index, 0])), "geneva", 48.0)
        assert found.height[index] == pytest.approx(alone.height[0], rel=1e-9)


def test_machines_without_a_period_leave_the_others_theirs() -> None:
    def height(angle: Array, _: Array) -> Array:
        return 2 + np.cos(angle)

    found = clearance.least_clearance(height, np.array([np.nan, 2 * np.pi]))
    assert found.height[0] == np.inf and found.height[1] == pytest.approx(1)
    assert clearance.least_clearance(height, np.array([np.nan])).height == np.inf


def test_of_some_machines_come_their_own_numbers_and_those_that_all_share() -> None:
    column = np.array([[0.3], [0.4], [0.5]])
    some = clearance.Station(column, np.array([[0.7]]), 0.2, True, 0.1, column / 2, 0.02).of(np.array([2, 0]))
    assert some.radius.tolist() == [[0.5], [0.3]] and some.step.tolist() == [[0.25], [0.15]]
    assert (some.half_angle.tolist(), some.stroke, some.with_feed) == ([[0.7]], 0.2, True)


@pytest.mark.parametrize("way", [-0.07, -0.02, 0.03, 0.08])
@pytest.mark.parametrize("turned", [0.3, 2.0, 4.5])
def test_of_carriages_that_follow_closely_those_on_both_sides_of_the_axis_count(turned: float, way: float) -> None:
    at = replace(station(0.0, with_feed=True), carriage_width=0.01, step=0.15)  # less than the cylinder is wide
    tilt = turned if turned <= np.pi else turned - 2 * np.pi
    axis = np.array([at.radius * turned - at.stroke / 2, at.radius])
    points = outline(at.radius, at.half_angle, tilt) + axis
    middles = axis[0] + way + at.step * np.arange(-3, 4)
    expected = min(each.min() for m in middles if len(each := points[abs(points[:, 0] - m) <= 0.005, 1]))
    found = clearance.carriage_clearance(at, np.array([turned]), middles[:1])[0]
    high = 0.9 * at.radius  # above it points of an outline do not tell the height
    assert min(found, high) == pytest.approx(min(expected, high), abs=5e-4)
