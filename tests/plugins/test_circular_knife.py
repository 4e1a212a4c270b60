"""The circular knife against a polygon that turns, finite differences, quadratures and swept areas.

What goes through many places of a fine polygon is done in CI for a cut through angle zero and for a large knife, which have all
signs and sizes that the others have.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import integrate

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.plugins.circular_knife import steps
from tests.examples import few
from tests.machines import number
from tests.plugins.knives import SHAPES, at, crossing, edge_points, in_cut, knife

shapes = pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
HARD = [SHAPES["through zero"], SHAPES["large"]]
hard_shapes = pytest.mark.parametrize("shape", few(SHAPES.values(), keep=lambda shape: shape in HARD), ids=SHAPES)


def sizes(calc: Calculation) -> tuple[float, ...]:
    """Depth, depth of the upper face, shear resistance."""
    return tuple(number(calc, name) for name in ("depth", "face_depth", "shear_resistance"))


def test_a_distance_is_below_another_by_more_than_a_millionth_of_the_radius_or_where_there_is_no_other() -> None:
    others = np.array([1 + 2e-6, 1 + 5e-7, 0.5, 0.01, np.nan])
    assert steps.is_clear_of(1.0, others, 1.0).tolist() == [True, False, False, False, True]


# --- geometry and motion ---------------------------------------------------------------------------------------------


@shapes
def test_the_cutting_point_is_where_the_turning_polygon_crosses_the_counter_knife(shape: dict[str, Any]) -> None:
    calc = knife(**shape)
    angles = in_cut(calc, 7)
    brute = [float(crossing(calc, angle, number(calc, "depth"))) for angle in angles]
    np.testing.assert_allclose(at(calc, "cut_position", angles), brute, rtol=1e-9)
    front, end = number(calc, "front_distance"), number(calc, "cut_end")
    for name, place in (("angle_start", front), ("angle_end", end)):
        assert float(crossing(calc, number(calc, name), number(calc, "depth"))) == pytest.approx(place, rel=1e-9)


@shapes
def test_the_shear_angle_is_the_slope_of_the_polygon(shape: dict[str, Any]) -> None:
    calc = knife(**shape)
    depth, step = number(calc, "depth"), 1e-6
    for angle in in_cut(calc, 7, inside=1e-3):
        around = crossing(calc, angle, np.array([depth - step, depth + step]))
        slope = np.arctan2(2 * step, around[0] - around[1])
        assert at(calc, "shear_angle", angle)[0] == pytest.approx(slope, rel=1e-4)


@shapes
def test_the_cutting_speed_is_the_derivative_of_the_cutting_point(shape: dict[str, Any]) -> None:
    calc = knife(**shape)
    angles, step = in_cut(calc, 201, inside=1e-2), 1e-5 * number(calc, "cut_angle")
    near, far = (
        at(calc, "cut_position", angles + n * step) - at(calc, "cut_position", angles - n * step) for n in (1, 2)
    )
    rate = (8 * near - far) / (12 * step) * number(calc, "speed")
    np.testing.assert_allclose(at(calc, "cut_speed", angles), rate, rtol=1e-7)
    start, end = map(float, in_cut(calc, 2, inside=1e-12))
    travelled = integrate.quad(lambda a: float(at(calc, "cut_speed", a)[0]), start, end, epsrel=1e-10, limit=400)[0]
    assert travelled == pytest.approx(number(calc, "cut_length") * number(calc, "speed"), rel=1e-8)


@shapes
def test_the_sliding_ratio_is_that_of_the_velocity_of_the_knife_where_it_cuts(shape: dict[str, Any]) -> None:
    """The velocity of a turning body is square to the way from its axis; it is split along and square to the polygon's edge."""
    calc = knife(**shape)
    depth = number(calc, "depth")
    for angle in in_cut(calc, 7, inside=1e-3):
        points = edge_points(calc, angle)
        k = int(np.searchsorted(points[:, 1], depth))
        edge = points[k] - points[k - 1]
        x, y = points[k]
        velocity = np.array([-y, x])  # clockwise, y down
        ratio = abs(velocity @ edge) / abs(velocity @ np.array([edge[1], -edge[0]]))
        assert at(calc, "sliding_ratio", angle)[0] == pytest.approx(ratio, rel=1e-3)


@shapes
def test_least_and_greatest_values_are_those_of_the_curves(shape: dict[str, Any]) -> None:
    calc = knife(**shape)
    angles = in_cut(calc, 20_001, inside=1e-9)
    for name, curve, extreme in (("shear_angle_min", "shear_angle", np.min), ("shear_angle_max", "shear_angle", np.max),
                                 ("cut_speed_max", "cut_speed", np.max), ("sliding_ratio_max", "sliding_ratio", np.max),
                                 ("force_max", "force", np.max), ("working_force_max", "working_force", np.max),
                                 ("torque_max", "torque", np.max)):  # fmt: skip
        assert number(calc, name) == pytest.approx(float(extreme(at(calc, curve, angles))), rel=1e-6), name
    way = np.array([1.0, number(calc, "sliding_ratio_max")])  # square to the edge, and along it
    height = way[0] * np.tan(np.radians(20))
    assert number(calc, "effective_sharpening_angle_min") == pytest.approx(
        np.arctan2(height, np.hypot(*way)), rel=1e-12
    )
    assert number(calc, "cut_time") == pytest.approx(number(calc, "cut_angle") / number(calc, "speed"), rel=1e-15)


@hard_shapes
def test_the_edge_that_cuts_is_as_long_as_the_places_that_pass_through_the_board(shape: dict[str, Any]) -> None:
    """Places on the knife's edge that are between the board's faces and behind its front edge, from the first touch to the cut's end."""
    calc = knife(**shape)
    depth, face, _ = sizes(calc)
    seen: list[Array] = []
    for angle in np.linspace(number(calc, "angle_entry") - 0.02, number(calc, "angle_end"), 601):
        points = edge_points(calc, float(angle), 20_001)
        in_board = (points[:, 1] <= depth) & (points[:, 1] >= face) & (points[:, 0] >= number(calc, "front_distance"))
        seen.append(np.linspace(-angle, np.pi / 2 - angle, 20_001)[in_board])
    places = np.concatenate(seen)
    assert number(calc, "edge_angle_first") == pytest.approx(places.max(), abs=2e-3)
    assert number(calc, "edge_angle_last") == pytest.approx(places.min(), abs=2e-4)
    assert number(calc, "edge_length") == pytest.approx(number(calc, "edge_radius") * np.ptp(places), rel=5e-3)


@shapes
def test_the_edge_meets_the_board_at_its_upper_front_edge_before_the_cut_begins(shape: dict[str, Any]) -> None:
    calc = knife(**shape)
    _, face, _ = sizes(calc)
    entry = number(calc, "angle_entry")
    assert float(crossing(calc, entry, face)) == pytest.approx(number(calc, "front_distance"), rel=1e-9)
    assert float(crossing(calc, entry + 1e-6, face)) > number(calc, "front_distance")
    assert entry < number(calc, "angle_start")


# --- force, torque, work ---------------------------------------------------------------------------------------------


@shapes
def test_the_force_is_the_stress_times_the_area_behind_the_polygon(shape: dict[str, Any]) -> None:
    calc = knife(**shape)
    depth, face, stress = sizes(calc)
    levels = np.linspace(face, depth, 4001)
    for angle in in_cut(calc, 5):
        x = crossing(calc, angle, levels)
        behind, before = np.trapezoid(x - x[-1], levels), np.trapezoid(x[0] - x, levels)
        assert at(calc, "force", angle)[0] == pytest.approx(stress * behind, rel=2e-6)
        assert at(calc, "working_force", angle)[0] == pytest.approx(stress * before, rel=2e-6)


def energy(calc: Calculation, angle: float, right: float = 0.0, down: float = 0.0) -> float:
    """Energy put into the board before the cutting point: each mm of it takes σ(h·p − p²/2) where the edge is p deep in it.

    That is a resistance of σ times the thickness left. The polygon is moved by ``right`` and ``down``.
    """
    depth, face, stress = sizes(calc)
    levels = np.linspace(face, depth, 100_001)
    x = crossing(calc, angle, levels - down) + right
    return float(stress * np.trapezoid((depth - levels) * x, levels))


@hard_shapes
def test_by_virtual_work_the_forces_are_those_of_the_thickness_left_and_the_torque_is_theirs(
    shape: dict[str, Any],
) -> None:
    """M_u, F_w and F_h are the derivatives of the energy; F_v, which counts the thickness passed, is not."""
    calc = knife(**shape)
    step = 1e-3 * number(calc, "thickness")
    for angle in map(float, in_cut(calc, 5, inside=0.05)):
        sinking, pushing = (
            (energy(calc, angle, **{way: step}) - energy(calc, angle, **{way: -step})) / (2 * step)
            for way in ("down", "right")
        )
        turning = (energy(calc, angle + 1e-5) - energy(calc, angle - 1e-5)) / 2e-5
        assert at(calc, "working_force", angle)[0] == pytest.approx(sinking, rel=1e-4)
        assert number(calc, "thrust") == pytest.approx(pushing, rel=1e-6)
        assert at(calc, "useful_torque", angle)[0] == pytest.approx(turning, rel=1e-4, abs=1e-6)
        bow = number(calc, "shear_resistance") * at(calc, "bow_area", angle)[0]
        assert at(calc, "force", angle)[0] - sinking == pytest.approx(2 * bow, rel=1e-2)


def entering(calc: Calculation) -> Array:
    """While the edge enters the board: force with the thickness passed, force and torque with the thickness left."""
    depth, face, stress = sizes(calc)
    front, found = number(calc, "front_distance"), []
    levels = np.linspace(face, depth, 20_001)
    for angle in np.linspace(number(calc, "angle_entry"), number(calc, "angle_start"), 16):
        x = crossing(calc, angle, levels, 40_001)
        within = np.maximum(x, front)
        rate = (crossing(calc, angle + 1e-6, levels, 40_001) - crossing(calc, angle - 1e-6, levels, 40_001)) / 2e-6
        left = np.sum((depth - (levels[1:] + levels[:-1]) / 2) * -np.diff(within))
        torque = np.trapezoid(np.where(x > front, (depth - levels) * rate, 0.0), levels)
        found.append((np.trapezoid(within - front, levels), left, torque))
    return stress * np.array(found)


@hard_shapes
def test_while_the_edge_enters_the_force_rises_but_not_the_torque_of_cutting(shape: dict[str, Any]) -> None:
    """As the assumptions say: F_v is greatest at φ_1, F_w and M_u before it; with friction above 0.1 the whole torque at φ_1."""
    calc = knife(**shape)
    passed, left, torque = entering(calc).T
    start = in_cut(calc, 1, inside=0.0)[0] + 1e-9
    assert (np.diff(passed) > 0).all() and passed[-1] == pytest.approx(at(calc, "force", start)[0], rel=1e-4)
    assert left[-1] == pytest.approx(at(calc, "working_force", start)[0], rel=1e-3)
    assert torque[-1] == pytest.approx(at(calc, "useful_torque", start)[0], rel=1e-3)
    assert torque.max() > 1.001 * torque[-1]
    assert left.max() < passed[-1]
    rubbed = at(calc, "friction_torque", start)[0] * passed / passed[-1] * 0.1 / number(calc, "friction")
    assert (torque + rubbed).max() == pytest.approx((torque + rubbed)[-1], rel=5e-3)


@shapes
def test_the_torque_is_that_of_stress_and_friction_on_each_piece_of_the_polygon(shape: dict[str, Any]) -> None:
    """σ(H − y) acts square to the edge on each unit of its length in the board; friction takes F_v, at the cutting point."""
    calc = knife(**shape)
    depth, face, stress = sizes(calc)
    for angle in in_cut(calc, 5):
        levels = np.linspace(face, depth, 4001)
        x = crossing(calc, angle, levels)
        middle = (levels[1:] + levels[:-1]) / 2
        dx, dy = np.diff(x), np.diff(levels)
        pressure = stress * (depth - middle)
        force_x, force_y = pressure * dy, -pressure * dx  # on the board; x falls with depth
        torque = np.sum((x[1:] + x[:-1]) / 2 * force_y - middle * force_x)
        assert at(calc, "useful_torque", angle)[0] == pytest.approx(float(torque), rel=1e-5)
        slope, pressed = at(calc, "shear_angle", angle)[0], at(calc, "force", angle)[0]
        center = number(calc, "eccentricity") * np.exp(1j * angle)  # y down, so clockwise
        contact = complex(at(calc, "cut_position", angle)[0], depth)
        along = (contact - center) / abs(contact - center) * 1j
        slid = abs(np.real(1j * contact * np.conj(along)))  # way of the contact along the edge for each radian
        friction = number(calc, "friction") * pressed / np.cos(slope) * slid
        assert at(calc, "friction_torque", angle)[0] == pytest.approx(friction, rel=1e-12)


@shapes
def test_the_work_is_the_integral_of_the_torque_and_that_of_the_forces_over_the_way(shape: dict[str, Any]) -> None:
    """∫M dφ; and ∫F dx: all forces of cutting pass through the edge's centre, so they work on its way."""
    calc = knife(**shape)
    start, end = map(float, in_cut(calc, 2, inside=1e-12))
    whole = integrate.quad(lambda a: float(at(calc, "torque", a)[0]), start, end, epsrel=1e-10, limit=400)[0]
    assert number(calc, "work") == pytest.approx(whole, rel=1e-9)
    angles = number(calc, "angle_start") + number(calc, "cut_angle") * np.linspace(1e-9, 1 - 1e-9, 200_001) ** 2
    x, down = number(calc, "eccentricity") * np.array([np.cos(angles), np.sin(angles)])
    thrust = number(calc, "shear_resistance") * number(calc, "thickness") ** 2 / 2
    by_forces = np.trapezoid(at(calc, "working_force", angles), down) + thrust * (x[-1] - x[0])
    assert number(calc, "useful_work") == pytest.approx(float(by_forces), rel=1e-7)


@shapes
def test_the_work_of_cutting_is_the_stress_over_the_area_that_the_edge_sweeps(shape: dict[str, Any]) -> None:
    """Each place (x, y) of the board that the edge passes takes σ(H − y): the energy between the edge's first and last position."""
    calc = knife(**shape)
    depth, face, stress = sizes(calc)
    levels = np.linspace(face, depth, 20_001)
    first, last = (crossing(calc, number(calc, name), levels) for name in ("angle_start", "angle_end"))
    swept = np.trapezoid((depth - levels) * (last - first), levels)
    assert number(calc, "useful_work") == pytest.approx(stress * float(swept), rel=1e-6)


def test_a_long_cut_takes_half_the_stress_for_each_unit_of_area() -> None:
    """With a thin board the ends of the cut do not matter: work per area σh/2."""
    calc = knife(thickness="0.01 mm")
    assert number(calc, "useful_work") == pytest.approx(number(calc, "guillotine_work"), rel=5e-3)
    assert number(calc, "guillotine_force") == pytest.approx(1e7 * 1e-5 * 0.015, rel=1e-14)
    assert number(calc, "guillotine_work") == pytest.approx(number(calc, "guillotine_force") * 1e-5 / 2, rel=1e-14)


@pytest.mark.parametrize("tau", [2.3, 12, 20])
def test_the_triangle_under_a_straight_edge_is_high_where_the_shear_angle_is_small(tau: float) -> None:
    """σh²/(2·tan τ) leaves out that the edge rises ever steeper: by the share h/(3R·sin²τ·cos τ) at first, by 60 % at 2.3°."""
    slope = np.radians(tau)
    face = np.arccos(np.cos(slope) - 0.5 / 100)
    area = integrate.quad(lambda t: 100 * (np.sin(t) - np.sin(slope)) * 100 * np.sin(t), slope, face)[0]
    excess = 0.60 if tau < 3 else 0.5 / (300 * np.sin(slope) ** 2 * np.cos(slope))
    assert 0.5**2 / (2 * np.tan(slope)) / area - 1 == pytest.approx(excess, rel=0.05)
    length = steps.front_length(0.1, face, slope)
    half = (face - slope) / 2
    bow = 0.1**2 * (half - np.sin(half) * np.cos(half))
    assert steps.force(1e7, 5e-4, length, bow) == pytest.approx(1e7 * area * 1e-6, rel=1e-10)


# --- curves over the turn --------------------------------------------------------------------------------------------


@shapes
def test_outside_the_cut_nothing_is_cut(shape: dict[str, Any]) -> None:
    calc = knife(**shape)
    start, end = number(calc, "angle_start"), number(calc, "angle_end")
    outside = np.linspace(end + 1e-9, start + 2 * np.pi - 1e-9, 501)
    for name in ("cut_speed", "sliding_ratio", "force", "torque"):
        assert not at(calc, name, outside).any(), name
        assert (at(calc, name, in_cut(calc)) > 0).all(), name
    np.testing.assert_allclose(at(calc, "cut_position", outside), number(calc, "front_distance"), rtol=1e-12)
    np.testing.assert_allclose(at(calc, "shear_angle", outside), number(calc, "shear_angle_min"), rtol=1e-12)
    assert number(calc, "power_mean") == pytest.approx(number(calc, "work") * number(calc, "speed") / (2 * np.pi))


def test_the_cut_may_lie_on_both_sides_of_the_turns_beginning() -> None:
    through, before = knife(**SHAPES["through zero"]), knife(**SHAPES["before zero"])
    assert number(through, "angle_start") < 0 < number(through, "angle_end")
    assert number(before, "angle_start") < number(before, "angle_end") < 0
