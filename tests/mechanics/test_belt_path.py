"""The belt's path, by convex hulls, tangents found numerically, discretised paths, and what must not change it."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, degrees, hypot, pi
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import brentq
from scipy.spatial import ConvexHull

from diecut_report.formulas import Array
from diecut_report.mechanics import belt_path
from tests.examples import examples


class Layout(NamedTuple):
    """Pulleys of one layout: centres and signed radii."""

    x: Array
    y: Array
    signed: Array

    @property
    def rows(self) -> tuple[Array, Array, Array]:
        return self.x[None, :], self.y[None, :], self.signed[None, :]


def layout(*pulleys: tuple[float, float, float]) -> Layout:
    return Layout(*np.array(pulleys, dtype=float).T)


def is_possible(belt: Layout) -> bool:
    """Whether nothing is found against a layout."""
    return bool(belt_path.is_possible(*belt.rows)[0])


def is_clockwise(belt: Layout) -> bool:
    return bool(belt_path.clockwise(*belt.rows)[0, 0] == len(belt.x) - 1)


def total(belt: Layout) -> float:
    return float(belt_path.length(belt_path.path(*belt), belt.signed))


# --- the belt, drawn by other means ----------------------------------------------------------------------------------


def turn(angle: float) -> Array:
    return np.array([np.cos(angle), np.sin(angle)])


def left_of(heading: Array, spoke: Array) -> float:
    """Positive where a spoke points to the left of a heading."""
    return float(heading[0] * spoke[1] - heading[1] * spoke[0])


def tangent(one: Array, r1: float, other: Array, r2: float) -> tuple[Array, Array]:
    """Feet of the common tangent: the belt that leaves the first rim at an angle, searched round the rim, meets the second."""

    def leaving(angle: float) -> tuple[Array, Array]:
        return one + abs(r1) * turn(angle), np.sign(r1) * turn(angle + pi / 2)

    def miss(angle: float) -> float:
        foot, heading = leaving(angle)
        return left_of(heading, other - foot) - r2

    for start, end in pairwise(np.linspace(0, 2 * pi, 241)):
        if miss(start) * miss(end) <= 0:
            foot, heading = leaving(float(brentq(miss, start, end, xtol=1e-15)))
            reach = float(heading @ (other - foot))
            if reach > 0:
                return foot, foot + reach * heading
    raise AssertionError("no tangent found")


def drawn(belt: Layout, steps: int) -> Array:
    """The belt as a polygon: numeric tangents, and arcs of so many chords each."""
    centers = np.column_stack(belt[:2])
    behind = [(*c, r) for c, r in zip(np.roll(centers, -1, axis=0), np.roll(belt.signed, -1), strict=True)]
    runs = [tangent(c, r, np.array(n[:2]), n[2]) for c, r, n in zip(centers, belt.signed, behind, strict=True)]
    points = []
    for i, (center, r) in enumerate(zip(centers, belt.signed, strict=True)):
        start, end = runs[i - 1][1] - center, runs[i][0] - center
        swept = np.sign(r) * ((np.sign(r) * (atan2(end[1], end[0]) - atan2(start[1], start[0]))) % (2 * pi))
        angles = atan2(start[1], start[0]) + swept * np.linspace(0, 1, steps + 1)
        points += [center + abs(r) * turn(a) for a in angles]
    return np.array(points)


def perimeter(polygon: Array) -> float:
    return float(np.sum(np.hypot(*(np.roll(polygon, -1, axis=0) - polygon).T)))


def extrapolated(coarse: float, fine: float) -> float:
    """Richardson: the polygon's error falls with the square of the chord."""
    return (4 * fine - coarse) / 3


def drawn_length(belt: Layout) -> float:
    return extrapolated(perimeter(drawn(belt, 200)), perimeter(drawn(belt, 400)))


def rubber_band(belt: Layout, points: int) -> float:
    """Perimeter of the convex hull of points on all pulleys."""
    angles = np.arange(points) * (2 * pi / points)
    rims = [np.column_stack([x + r * np.cos(angles), y + r * np.sin(angles)]) for x, y, r in zip(*belt, strict=True)]
    return float(ConvexHull(np.concatenate(rims)).area)


def winding_number(polygon: Array, point: Array) -> int:
    spokes = (polygon - point) @ np.array([1, 1j])
    return round(float(np.sum(np.angle(np.roll(spokes, -1) / spokes))) / (2 * pi))


def area(polygon: Array) -> float:
    """Positive where the polygon runs counter-clockwise."""
    points = polygon @ np.array([1, 1j])
    return float(np.sum(np.imag(np.conj(points) * np.roll(points, -1)))) / 2


def is_simple(polygon: Array) -> bool:
    """Whether no two sides of a polygon cross, each side tried with each other."""
    a = polygon @ np.array([1, 1j])
    b = np.roll(a, -1)

    def side(p: Array, q: Array, of: Array) -> Array:
        return np.sign(np.imag(np.conj(q - p)[:, None] * (of[None, :] - p[:, None])))

    parted = side(a, b, a) * side(a, b, b) < 0
    return not bool(np.any(parted & parted.T))


# --- layouts ---------------------------------------------------------------------------------------------------------

SHEET = layout((0, 0, 0.1), (0.6, 0, 0.1), (0.3, 0.07, -0.05))
TWO = layout((0, 0, 0.1), (0.5, 0, 0.2))
SERPENTINE = layout((0, 0, 60), (500, -40, 90), (330, 90, -30), (420, 400, 50), (180, 230, -45), (30, 350, 40))
SQUARE = layout((0, 0, 50), (400, 0, 50), (400, 400, 50), (0, 400, 50))


@st.composite
def hulls(draw: st.DrawFn) -> Layout:
    """Pulleys inside the loop, all of which the belt meets: on a wide ring, in the order of their angles."""
    count, reach = draw(st.integers(2, 6)), draw(st.floats(80, 400))
    angles = [2 * pi * (i + draw(st.floats(0, 0.3))) / count for i in range(count)]
    widest = 0.9 * reach * np.sin(0.7 * pi / count)
    belt = layout(*[(*(reach * turn(a)), widest * draw(st.floats(0.2, 1))) for a in angles])
    assume(bool(belt_path.is_loop(*belt)))
    return belt


@st.composite
def mixed(draw: st.DrawFn) -> Layout:
    """The same with an idler outside that presses one of the runs inwards."""
    belt = draw(hulls())
    path = belt_path.path(*belt)
    run = draw(st.integers(0, len(belt.x) - 1))
    along, inwards = turn(float(path.directions[run])), turn(float(path.directions[run]) + pi / 2)
    foot = np.array([path.leave_x[run], path.leave_y[run]]) + draw(st.floats(0.4, 0.6)) * path.runs[run] * along
    radius, depth = (draw(st.floats(0.01, 0.25)) * path.runs[run] for _ in range(2))
    pulleys = [*zip(*belt, strict=True)]
    pulleys.insert(run + 1, (*(foot + (depth - radius) * inwards), -radius))
    found = layout(*pulleys)
    assume(is_possible(found))
    return found


@st.composite
def scattered(draw: st.DrawFn) -> Layout:
    """Pulleys inside the loop on a ring, and others outside it or in it, anywhere and in any place of the order."""
    pulleys = [*zip(*draw(hulls()), strict=True)]
    for _ in range(draw(st.integers(0, 2))):
        place, radius, side = st.floats(-300, 300), draw(st.floats(5, 40)), draw(st.sampled_from([-1, -1, 1]))
        pulleys.insert(draw(st.integers(0, len(pulleys))), (draw(place), draw(place), side * radius))
    belt = layout(*pulleys)
    assume(np.isfinite(belt_path.path(*belt).runs).all() and np.all(belt_path.overlapping(*belt.rows) == -1))
    return belt


# --- length and wraps ------------------------------------------------------------------------------------------------


def test_the_length_and_wraps_of_two_pulleys() -> None:
    assert total(TWO) == pytest.approx(1.962545, abs=5e-7)
    assert [degrees(a) for a in belt_path.path(*TWO).wraps] == pytest.approx([156.926, 203.074], abs=5e-4)


def test_the_length_and_wraps_with_an_idler_outside() -> None:
    assert total(SHEET) == pytest.approx(1.850262, abs=5e-7)
    assert [degrees(a) for a in belt_path.path(*SHEET).wraps] == pytest.approx([196.0044, 196.0044, 32.0087], abs=5e-5)


@pytest.mark.parametrize("belt", [TWO, SHEET, SERPENTINE], ids=["two", "idler", "serpentine"])
def test_the_length_is_that_of_the_drawn_path(belt: Layout) -> None:
    assert is_possible(belt)
    assert total(belt) == pytest.approx(drawn_length(belt), rel=1e-9)


@given(belt=hulls())
@examples(60)
def test_a_belt_around_inside_pulleys_is_a_rubber_band(belt: Layout) -> None:
    fine = extrapolated(rubber_band(belt, 2000), rubber_band(belt, 4000))
    assert total(belt) == pytest.approx(fine, rel=1e-5)


@given(belt=mixed())
@examples(30)
def test_a_belt_with_an_idler_has_the_length_of_the_drawn_path(belt: Layout) -> None:
    assert total(belt) == pytest.approx(drawn_length(belt), rel=1e-8)


@given(belt=mixed())
@examples(40)
def test_an_idler_that_presses_on_the_belt_lengthens_it(belt: Layout) -> None:
    outside = int(np.argmin(belt.signed))
    without = Layout(*(np.delete(row, outside) for row in belt))
    assert total(belt) > total(without)


@given(belt=mixed())
@examples(40)
def test_the_ends_of_runs_and_arcs_meet(belt: Layout) -> None:
    path = belt_path.path(*belt)
    for i in range(len(belt.x)):
        rim = np.array([path.leave_x[i] - belt.x[i], path.leave_y[i] - belt.y[i]])
        met = np.array([path.meet_x[i - 1] - belt.x[i], path.meet_y[i - 1] - belt.y[i]])
        angle = np.sign(belt.signed[i]) * path.wraps[i]
        turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) @ met
        assert hypot(*rim) == pytest.approx(abs(belt.signed[i]), rel=1e-12)
        assert turned == pytest.approx(rim, abs=1e-9)
        run = (path.meet_x[i] - path.leave_x[i], path.meet_y[i] - path.leave_y[i])
        assert run == pytest.approx(path.runs[i] * turn(float(path.directions[i])), abs=1e-9)


# --- what does not change it -----------------------------------------------------------------------------------------


@given(belt=mixed(), angle=st.floats(-4, 4), dx=st.floats(-500, 500), dy=st.floats(-500, 500), by=st.integers(0, 6))
@examples(60)
def test_turning_moving_and_counting_from_another_pulley_change_nothing(
    belt: Layout, angle: float, dx: float, dy: float, by: int
) -> None:
    place = (belt.x + 1j * belt.y) * np.exp(1j * angle) + dx + 1j * dy
    moved = Layout(*(np.roll(row, by) for row in (place.real, place.imag, belt.signed)))
    assert total(moved) == pytest.approx(total(belt), rel=1e-11)
    wraps = np.roll(belt_path.path(*belt).wraps, by)
    assert belt_path.path(*moved).wraps == pytest.approx(wraps, abs=1e-9)
    assert is_possible(moved)


@given(belt=mixed())
@examples(40)
def test_a_mirrored_layout_in_reversed_order_is_the_same_belt(belt: Layout) -> None:
    mirrored = Layout(-belt.x[::-1], belt.y[::-1], belt.signed[::-1])
    assert total(mirrored) == pytest.approx(total(belt), rel=1e-11)
    assert belt_path.path(*mirrored).wraps[::-1] == pytest.approx(belt_path.path(*belt).wraps, abs=1e-9)
    assert not is_clockwise(belt)
    unturned = Layout(-belt.x, belt.y, belt.signed)
    assert is_clockwise(unturned) != is_possible(unturned)


PLACE, RADIUS = st.floats(-300, 300), st.floats(10, 80)
FOUR = st.lists(st.tuples(PLACE, PLACE, RADIUS | RADIUS.map(lambda r: -r)), min_size=4, max_size=4)


@given(listed=st.lists(FOUR, min_size=2, max_size=5))
@examples(40)
def test_layouts_together_are_the_layouts_alone(listed: list[list[tuple[float, float, float]]]) -> None:
    belts = [SQUARE, *(layout(*pulleys) for pulleys in listed)]
    together = Layout(*(np.array([getattr(b, row) for b in belts]) for row in Layout._fields))
    for quantity in (lambda b: belt_path.length(belt_path.path(*b), b.signed), lambda b: belt_path.path(*b).wraps):
        alone = np.concatenate([quantity(Layout(*b.rows)) for b in belts])
        assert np.allclose(quantity(together), alone, rtol=1e-13, equal_nan=True)
    for rule in (belt_path.overlapping, belt_path.crossing, belt_path.pierced, belt_path.clockwise):
        assert np.array_equal(rule(*together), np.concatenate([rule(*b.rows) for b in belts]))


# --- impossible layouts ----------------------------------------------------------------------------------------------


@given(belt=scattered())
@examples(150)
@pytest.mark.nightly
def test_a_layout_is_possible_where_its_drawn_belt_is_simple_and_clear_of_the_pulleys(belt: Layout) -> None:
    polygon = drawn(belt, 90)
    centers = np.column_stack(belt[:2])
    places = np.concatenate(
        [a + np.linspace(0, 1, 400)[:, None] * (b - a) for a, b in pairwise([*polygon, polygon[0]])]
    )
    depth = min(float(np.min(np.hypot(*(places - c).T))) - abs(r) for c, r in zip(centers, belt.signed, strict=True))
    assume(abs(depth + 0.25) > 0.2)  # neither just touching nor just cut, as a polygon of chords shows it
    assert is_possible(belt) == (is_simple(polygon) and depth > -0.25 and area(polygon) > 0)


@given(belt=mixed())
@examples(30)
def test_a_possible_belt_goes_once_round_the_inside_pulleys_and_not_round_the_others(belt: Layout) -> None:
    polygon = drawn(belt, 60)
    found = [winding_number(polygon, center) for center in np.column_stack(belt[:2])]
    assert found == [1 if r > 0 else 0 for r in belt.signed]


def test_pulleys_that_overlap_are_named_and_pulleys_that_touch_are_not() -> None:
    overlap = layout((0, 0, 50), (400, 0, 50), (400, 300, 50), (60, 60, 50))
    assert belt_path.overlapping(*overlap.rows).tolist() == [[3, -1, -1, 0]]
    touching = layout((0, 0, 50), (400, 0, 50), (400, 300, 50), (60, 80, 50))
    assert belt_path.overlapping(*touching.rows).tolist() == [[-1, -1, -1, -1]]


def test_neighbours_one_within_the_other_have_no_tangent() -> None:
    nested = layout((0, 0, 100), (30, 0, 60), (500, 0, 50))
    path = belt_path.path(*nested)
    assert np.isnan(path.runs).tolist() == [True, False, False]
    assert belt_path.overlapping(*nested.rows).tolist() == [[-1, -1, -1]]
    assert not belt_path.has_tangent(0.03, 0.1, 0.06) and belt_path.has_tangent(0.05, 0.1, 0.06)
    assert not belt_path.has_tangent(0.15, 0.1, -0.05) and belt_path.has_tangent(0.16, 0.1, -0.05)


def test_an_idler_that_does_not_touch_is_no_loop() -> None:
    above = layout((0, 0, 100), (600, 0, 100), (300, 151, -50))
    assert not belt_path.is_loop(*above)
    within = layout((0, 0, 100), (600, 0, 100), (300, 20, 50))
    assert not belt_path.is_loop(*within)
    assert belt_path.is_loop(*layout((0, 0, 100), (600, 0, 100), (300, 149, -50)))


def test_an_idler_that_just_touches_has_no_wrap() -> None:
    for touching in (layout((0, 0, 100), (600, 0, 100), (300, 150, -50)), layout((0, 0, 9), (5, 0, 4), (40, 0, 9))):
        assert belt_path.is_loop(*touching) == (touching.signed[2] < 0)
    flush = layout((0, 0, 30), (300, 0, 30), (700, 0, 30))
    assert belt_path.is_loop(*flush)
    assert belt_path.path(*flush).wraps[1] == pytest.approx(0, abs=1e-8)


def test_pulleys_in_another_order_are_no_loop_and_clockwise_ones_are_told_apart() -> None:
    crossed = Layout(*(row[[0, 2, 1, 3]] for row in SQUARE))
    clockwise = Layout(*(row[::-1] for row in SQUARE))
    assert belt_path.is_loop(*SQUARE)
    assert not belt_path.is_loop(*crossed) and not is_clockwise(crossed)
    assert not belt_path.is_loop(*clockwise) and is_clockwise(clockwise)


def test_an_idler_that_presses_one_run_through_the_other_makes_them_cross() -> None:
    through = layout((0, 0, 100), (600, 0, 100), (300, -220, -50))
    assert belt_path.is_loop(*through)
    assert belt_path.crossing(*through.rows).tolist() == [[1, 0, 0]]
    assert belt_path.pierced(*through.rows).tolist() == [[-1, -1, -1]]


def test_a_run_that_passes_through_a_pulley_is_named() -> None:
    hook = layout((0, 0, 40), (600, 0, 40), (600, 440, 40), (510, 440, 30), (200, 250, -50), (380, 400, -50), (620, 620, 40),
                  (0, 620, 40))  # fmt: skip
    assert belt_path.is_loop(*hook) and np.all(belt_path.crossing(*hook.rows) == -1)
    assert belt_path.pierced(*hook.rows).tolist() == [[-1, -1, -1, -1, -1, 3, -1, -1]]


# --- two pulleys -----------------------------------------------------------------------------------------------------


@given(distance=st.floats(0.05, 3), small=st.floats(0.01, 0.5), ratio=st.floats(1, 8))
@examples(100)
def test_the_open_belt_in_both_forms_is_the_path_of_two_pulleys(distance: float, small: float, ratio: float) -> None:
    large = small * ratio
    assume(distance > 1.001 * (small + large))
    belt = layout((0, 0, small), (distance, 0, large))
    wrap = belt_path.wrap_small(distance, small, large)
    assert belt_path.open_belt_length(distance, small, large) == pytest.approx(total(belt), rel=1e-12)
    by_the_wrap = 2 * distance * np.sin(wrap / 2) + small * wrap + large * (2 * np.pi - wrap)
    assert by_the_wrap == pytest.approx(total(belt), rel=1e-11)
    run = np.sqrt(distance**2 - (large - small) ** 2)
    assert 2 * np.arctan2(run, large - small) == pytest.approx(wrap, abs=1e-9)
    assert [wrap, belt_path.wrap_large(wrap)] == pytest.approx(belt_path.path(*belt).wraps, abs=1e-9)


def test_the_open_belt_is_the_drawn_path() -> None:
    assert belt_path.open_belt_length(0.5, 0.1, 0.2) == pytest.approx(drawn_length(TWO), rel=1e-9)


def test_what_lies_outside_the_loop_counts_negative() -> None:
    assert [float(belt_path.signed(side, 0.2)) for side in (1, -1)] == [0.2, -0.2]
