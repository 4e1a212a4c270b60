"""The circular knife against a polygon that turns, differences, quadratures and swept areas; knives of any size; what it refuses and checks.

What goes through many places of a fine polygon is done in CI for a cut through angle zero and for a large knife, which have all
signs and sizes that the others have.
"""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate

from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.circular_knife import MECHANISM, steps
from diecut_report.press import Press
from diecut_report.results.mechanism import mechanism_results
from tests.configs import EXAMPLES, HEAD
from tests.examples import examples, few
from tests.machines import advised, at, checks, inputs, number, statuses
from tests.plugins.knives import SHAPES, crossing, edge_points, in_cut, knife
from tests.validation.rows_circular_knife import KEYS


def energy(calc: Calculation, angle: float, right: float = 0.0, down: float = 0.0) -> float:
    """Energy put into the board before the cutting point: each mm of it takes σ(h·p − p²/2) where the edge is p deep in it.

    That is a resistance of σ times the thickness left. The polygon is moved by ``right`` and ``down``.
    """
    depth, face, stress = sizes(calc)
    levels = np.linspace(face, depth, 100_001)
    x = crossing(calc, angle, levels - down) + right
    return float(stress * np.trapezoid((depth - levels) * x, levels))


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
    assert number(calc, "thrust") == pytest.approx(stress * number(calc, "thickness") ** 2 / 2, rel=1e-12)


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


def test_a_long_cut_takes_half_the_stress_for_each_unit_of_area() -> None:
    """With a thin board the ends of the cut do not matter: work per area σh/2."""
    calc = knife(thickness="0.01 mm")
    assert number(calc, "useful_work") == pytest.approx(number(calc, "guillotine_work"), rel=5e-3)
    assert number(calc, "guillotine_force") == pytest.approx(1e7 * 1e-5 * 0.015, rel=1e-14)
    assert number(calc, "guillotine_work") == pytest.approx(number(calc, "guillotine_force") * 1e-5 / 2, rel=1e-14)


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


@pytest.mark.parametrize(
    "changes, key, words",
    [
        ({"edge_radius": "20 mm"}, "edge_radius", "R > r = 20 mm"),
        ({"depth": "80 mm"}, "depth", "R − r = 80 mm"),
        ({"depth": "120 mm"}, "depth", "R + r = 120 mm"),
        ({"thickness": "112 mm"}, "thickness", "h < H = 112 mm"),
        ({"thickness": "1e-9 mm"}, "thickness", "a millionth of the edge's radius R = 100 mm"),
        ({"front_distance": "44 mm"}, "front_distance", "cannot reach the board"),
        ({"cut_length": "18 mm"}, "cut_length", "b + L = 44 mm"),
        ({"front_distance": "16.2 mm"}, "front_distance", "16.36 mm from the axis"),
        (
            {"depth": "95 mm", "front_distance": "19.364 mm", "thickness": "6 mm"},
            "front_distance",
            "19.36 mm from the axis",
        ),
    ],
)
def test_a_knife_that_cannot_cut_is_refused_in_words(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        knife(**changes)
    assert refused.value.key == key
    assert words in refused.value.message


@pytest.mark.parametrize(
    "limit, changed",
    [
        ("front_distance", lambda v: 0.01636 + v),
        ("cut_length", lambda v: 0.0170813 - v),
        ("depth", lambda v: 0.1127786 - v),
    ],
)
def test_within_the_limits_of_the_geometry_a_knife_is_calculated(limit: str, changed: Any) -> None:
    """b ≥ √(20² − 11.5²) = 16.363 mm; b + L ≤ √(120² − 112²) = 43.081 mm; H ≤ √(120² − 41²) = 112.7786 mm."""
    value = changed(5e-6)
    calc = knife(**{limit: f"{value} m"})
    assert number(calc, "work") > 0


def test_a_sound_knife_passes_all_checks() -> None:
    found = checks(knife())
    assert list(found) == [
        "reach",
        "shear_angle",
        "expulsion",
        "monotonic",
        "entry",
        "shear_resistance",
        "force",
        "torque",
    ]
    missing = [found.pop(name).missing for name in ("shear_resistance", "force", "torque")]
    assert missing == [["rule_force"], ["allowable_force"], ["allowable_torque"]]
    assert {check.status for check in found.values()} == {"pass"}
    assert found["reach"].utilisation == pytest.approx(41 / (120**2 - 112**2) ** 0.5, rel=1e-12)


def test_the_governing_side_of_the_shear_angle_is_shown() -> None:
    upper, lower = (
        checks(knife())["shear_angle"],
        checks(knife(front_distance="20 mm", cut_length="1 mm"))["shear_angle"],
    )
    assert upper.demand == pytest.approx(number(knife(), "shear_angle_max")) and "20°" in upper.message
    assert "2°" in lower.message and lower.utilisation == pytest.approx(lower.demand / lower.limit)
    assert lower.limit == number(knife(front_distance="20 mm", cut_length="1 mm"), "shear_angle_min")


@pytest.mark.parametrize(
    "changes, name, words",
    [
        ({"front_distance": "18 mm"}, "shear_angle", "below 2°"),
        ({"front_distance": "29 mm", "cut_length": "14 mm"}, "shear_angle", "beyond 20°"),
        ({"friction": 0.1}, "expulsion", "clamped"),
        ({"friction": 0}, "expulsion", "clamped"),
        ({"friction": 0}, "expulsion", "Set friction to"),
        ({"thickness": "3 mm", "cut_length": "17 mm"}, "monotonic", "runs back"),
        ({"depth": "80.3 mm", "front_distance": "4 mm"}, "entry", "from above"),
    ],
)
def test_a_check_fails_in_words_that_tell_what_to_change(changes: dict[str, Any], name: str, words: str) -> None:
    found = advised(knife(**changes))[name]
    assert found.status == "fail"
    assert words in found.message


@pytest.mark.parametrize(
    "changed", [{"front_distance": "44"}, {"front_distance": "0"}, {"depth": "95", "front_distance": "10"}]
)
def test_a_knife_that_cannot_cut_is_told_of_once(tmp_path: Path, changed: dict[str, str]) -> None:
    """A place out of reach, or in the blade's way, is one mistake and one message."""
    file = tmp_path / "press.yaml"
    file.write_text(
        HEAD + f"  k: {{kind: circular_knife, {', '.join(f'{k}: {v}' for k, v in (KEYS | changed).items())}}}\n"
    )
    with pytest.raises(UserError) as refused:
        Press.read(file, Discovery([])).calculate()
    assert len(refused.value.problems) == 1


@pytest.mark.parametrize("changed", [{"thickness": "1 mm"}, {"edge_radius": "101 mm"}, {"eccentricity": "21 mm"}])
def test_what_is_advised_where_no_place_suits_keeps_the_edge_from_running_back(changed: dict[str, Any]) -> None:
    start = {"thickness": "3 mm", "cut_length": "17 mm"}
    before, after = (checks(knife(**start | change))["monotonic"].utilisation for change in ({}, changed))
    assert after < before


def test_the_example_is_the_worked_example_and_passes() -> None:
    config = next(path for path in EXAMPLES if path.name == "circular_knife.yaml")
    results = Press.read(config, Discovery([])).calculate().results
    found = results.mechanisms["knife"]
    assert results.status == "pass"
    assert found.outputs["force_max"].value == pytest.approx(4.2 * 10.5276, rel=5e-6)  # of 42, not 10 N/mm²
    for name in ("cut_position", "shear_angle", "cut_speed", "sliding_ratio", "force", "torque"):
        assert found.curves[name].abscissa == "knife_angle"


def test_a_resistance_too_small_for_the_force_of_a_rule_is_told() -> None:
    """25 N/mm over 0.6 mm are 41.67 N/mm²: the advised resistance passes, a little less does not."""
    board = {"thickness": "0.6 mm", "rule_force": "25 N/mm"}
    found = advised(knife(**board))["shear_resistance"]
    assert found.status == "warn"
    assert found.utilisation == pytest.approx(25 / (10 * 0.6), rel=1e-12)
    told = re.search(r"shear_resistance to at least ([\d.]+) N/mm²", found.message)
    assert told and float(told[1]) == pytest.approx(41.67, rel=1e-3)
    for factor, status in ((1, "pass"), (0.999, "warn")):
        again = board | {"shear_resistance": f"{float(told[1]) * factor} N/mm**2"}
        assert statuses(knife(**again))["shear_resistance"] == status


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
def test_the_work_of_cutting_is_the_stress_over_the_area_that_the_edge_sweeps(shape: dict[str, Any]) -> None:
    """Each place (x, y) of the board that the edge passes takes σ(H − y): the energy between the edge's first and last position."""
    calc = knife(**shape)
    depth, face, stress = sizes(calc)
    levels = np.linspace(face, depth, 20_001)
    first, last = (crossing(calc, number(calc, name), levels) for name in ("angle_start", "angle_end"))
    swept = np.trapezoid((depth - levels) * (last - first), levels)
    assert number(calc, "useful_work") == pytest.approx(stress * float(swept), rel=1e-6)


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
