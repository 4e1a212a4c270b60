"""The folding knife's drives against geometry, finite differences, dense sampling and integration."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics import four_bar
from diecut_report.plugins.knife_drive import MECHANISM
from diecut_report.results.checks import verdicts
from tests.machines import inputs, number

OMEGA = 2 * np.pi * 50000 / 3600
DRIVES = ("planetary", "crank_slider", "crank_rocker")
LINKAGE: dict[str, Any] = {"crank": 20, "coupler": 110, "rocker": 80, "frame": 120, "knife_arm": 107}
PLANETARY: dict[str, Any] = {"planetary": {"carrier_radius": 65.656}}
SLIDER: dict[str, Any] = {"crank_slider": {"crank_radius": 35, "rod_length": 140}}
OUTER: dict[str, Any] = {"crank_rocker": LINKAGE}
INNER: dict[str, Any] = {"crank_rocker": LINKAGE | {"lowest_dead_center": "inner"}}
MACHINES = [("planetary", PLANETARY), ("crank_slider", SLIDER), ("crank_rocker", OUTER), ("crank_rocker", INNER)]
each_drive = pytest.mark.parametrize(
    "drive, keys", MACHINES, ids=["planetary", "slider", "rocker outer", "rocker inner"]
)


def knife(**keys: Any) -> Calculation:
    """A knife with 40 mm below the table unless said otherwise."""
    return calculate(MECHANISM, inputs(MECHANISM, {"working_depth": 40} | keys))


def at(calc: Calculation, curve: str, phi: Array) -> Array:
    """A curve at crank angles of any turn."""
    places = np.mod(np.atleast_1d(phi), 2 * np.pi)[None, :]
    return calc.sample(curve, places, calc.domains["crank_angle"].middle_of(places))[0]


def heights(calc: Calculation, drive: str, points: int = 400_001) -> tuple[Array, Array]:
    """Crank angles of two turns, and the edge above its lowest point."""
    phi = np.linspace(0, 4 * np.pi, points)
    s = at(calc, f"{drive}_displacement", phi)
    return phi, s - s.min()


@each_drive
def test_velocity_and_acceleration_are_the_derivatives_of_the_displacement(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    phi, step = np.linspace(0, 2 * np.pi, 1441), 1e-4
    s, v, w = (lambda x, n=name: at(calc, f"{drive}_{n}", x) for name in ("displacement", "velocity", "acceleration"))
    slope, bend = ((f(phi + step) - f(phi - step)) / (2 * step) * OMEGA for f in (s, v))
    np.testing.assert_allclose(slope, v(phi), atol=1e-6 * np.abs(v(phi)).max())
    np.testing.assert_allclose(bend, w(phi), atol=1e-6 * np.abs(w(phi)).max())


def test_the_planetary_edge_goes_straight_on_carrier_and_arm_of_equal_length() -> None:
    """Carrier at φ, arm at π − φ: the planet turns back by twice the carrier's angle inside a circle of twice its size."""
    phi = np.linspace(0, 2 * np.pi, 73)
    edge = 0.065656 * (np.exp(1j * phi) + np.exp(1j * (np.pi - phi)))
    np.testing.assert_allclose(edge.real, 0, atol=1e-15)
    np.testing.assert_allclose(at(knife(**PLANETARY), "planetary_displacement", phi), edge.imag, atol=1e-15)


def test_the_slider_stands_where_the_rod_reaches() -> None:
    phi = np.linspace(0, 2 * np.pi, 73)
    reach = 0.035 * np.cos(phi) + np.sqrt(0.14**2 - (0.035 * np.sin(phi)) ** 2)
    np.testing.assert_allclose(at(knife(**SLIDER), "crank_slider_displacement", phi), 0.175 - reach, atol=1e-15)


@pytest.mark.parametrize("ratio", [1.5, 4.0, 8.0])
def test_the_first_order_form_of_the_slider_and_its_differences_are_reported(ratio: float) -> None:
    """The series of Pythagoras, cut after r/l, its slopes by the series itself."""
    calc = knife(crank_slider={"crank_radius": 35, "rod_length": 35 * ratio})
    phi = np.linspace(0, 2 * np.pi, 20_001)
    cut = {
        "displacement": 0.035 * (1 - np.cos(phi) + (1 - np.cos(2 * phi)) / (4 * ratio)),
        "velocity": 0.035 * OMEGA * (np.sin(phi) + np.sin(2 * phi) / (2 * ratio)),
        "acceleration": 0.035 * OMEGA**2 * (np.cos(phi) + np.cos(2 * phi) / ratio),
    }
    for name, approximate in cut.items():
        found = at(calc, f"crank_slider_{name}_first_order", phi)
        np.testing.assert_allclose(found, approximate, atol=1e-13 * np.abs(approximate).max())
        greatest = np.abs(at(calc, f"crank_slider_{name}", phi) - approximate).max()
        assert number(calc, f"crank_slider_{name}_difference") == pytest.approx(greatest, rel=1e-5)
    share = number(calc, "crank_slider_acceleration_difference") / (0.035 * OMEGA**2 * (1 + 1 / ratio))
    assert number(calc, "crank_slider_acceleration_difference_share") == pytest.approx(share, rel=1e-12)


@each_drive
def test_a_tiny_depth_keeps_its_digits(drive: str, keys: dict[str, Any]) -> None:
    """Near its lowest point the edge rises by W·t²/2; the next term is of third order, absent where the drive is symmetrical."""
    calc = knife(**keys, working_depth="1e-6 mm", grip_angle=1e-6)
    end, time = number(calc, f"{drive}_acceleration_end"), number(calc, f"{drive}_working_time")
    assert end * time**2 / 2 == pytest.approx(1e-9, rel=1e-7 if drive != "crank_rocker" else 1e-3)


def rocker_direction(phi: Array) -> Array:
    """Direction of the rocker from the crossing of two circles, that of the coupler about the pin and that of the rocker."""
    pin = 0.02 * np.exp(1j * phi)
    span = pin - 0.12
    distance = np.abs(span)
    along = (0.08**2 - 0.11**2 + distance**2) / (2 * distance)
    joint = span / distance * (along - 1j * np.sqrt(0.08**2 - along**2))
    return np.angle(joint)


@pytest.mark.parametrize("keys, sign", [(OUTER, 1), (INNER, -1)])
def test_the_rocker_stands_where_two_circles_cross(keys: dict[str, Any], sign: int) -> None:
    phi = np.linspace(0, 2 * np.pi, 20_001)
    beta = rocker_direction(phi)
    dead = beta.min() if sign > 0 else beta.max()
    found = at(knife(**keys), "crank_rocker_displacement", phi)
    np.testing.assert_allclose(found, 0.107 * sign * (beta - dead), atol=1e-9)


@pytest.mark.parametrize("keys, sign", [(OUTER, 1), (INNER, -1)])
def test_the_rocker_moves_as_the_four_bar(keys: dict[str, Any], sign: int) -> None:
    phi = np.linspace(0, 2 * np.pi, 361)
    calc, linkage = knife(**keys), four_bar.motion(phi, 6.0, 5.5, 4.0)
    np.testing.assert_allclose(
        at(calc, "crank_rocker_velocity", phi), sign * linkage.rocker_speed_ratio * OMEGA * 0.107, atol=1e-12
    )
    np.testing.assert_allclose(
        at(calc, "crank_rocker_acceleration", phi),
        sign * linkage.rocker_acceleration_ratio * OMEGA**2 * 0.107,
        atol=1e-9,
    )


@each_drive
def test_contact_and_lowest_point_are_those_of_dense_sampling(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    phi, height = heights(calc, drive)
    turn = len(phi) // 2
    lowest = int(np.argmin(height[turn // 2 : turn // 2 + turn])) + turn // 2
    before = np.arange(lowest, 0, -1)
    contact = before[np.argmax(height[before] > 0.04)]
    step = phi[1]
    lowest_angle = number(calc, f"{drive}_lowest_angle")
    assert np.mod(phi[lowest] - lowest_angle + 1, 2 * np.pi) - 1 == pytest.approx(0, abs=2 * step)
    assert number(calc, f"{drive}_working_angle") == pytest.approx(phi[lowest] - phi[contact], abs=3 * step)
    assert number(calc, f"{drive}_stroke") == pytest.approx(height.max(), rel=1e-9)
    assert number(calc, f"{drive}_working_time") == pytest.approx(number(calc, f"{drive}_working_angle") / OMEGA)


@each_drive
def test_at_contact_the_edge_is_at_the_table_and_goes_down(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    contact, lowest = (np.array([number(calc, f"{drive}_{name}_angle")]) for name in ("contact", "lowest"))
    above = at(calc, f"{drive}_displacement", contact) - at(calc, f"{drive}_displacement", lowest)
    assert above[0] == pytest.approx(0.04, rel=1e-12)
    assert at(calc, f"{drive}_velocity", contact)[0] == pytest.approx(
        -number(calc, f"{drive}_contact_velocity"), rel=1e-12
    )
    assert at(calc, f"{drive}_velocity", lowest)[0] == pytest.approx(0, abs=1e-12)


@each_drive
def test_peak_and_end_are_those_of_the_acceleration_in_the_working_stroke(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    lowest, angle = number(calc, f"{drive}_lowest_angle"), number(calc, f"{drive}_working_angle")
    within = np.abs(at(calc, f"{drive}_acceleration", lowest - np.linspace(angle, 0, 100_001)))
    assert number(calc, f"{drive}_acceleration_peak") == pytest.approx(within.max(), rel=1e-8)
    assert number(calc, f"{drive}_acceleration_end") == pytest.approx(within[-1], rel=1e-12)


def test_the_outer_dead_centre_has_its_peak_before_the_end() -> None:
    calc = knife(**OUTER)
    assert number(calc, "crank_rocker_acceleration_peak") > 1.01 * number(calc, "crank_rocker_acceleration_end")


def test_a_deep_stroke_may_have_its_peak_where_the_edge_is_still_speeding_up() -> None:
    """With a rod hardly longer than the crank the edge is thrown down from the top; the peak is no braking."""
    calc = knife(crank_slider={"crank_radius": 35, "rod_length": 36}, working_depth=69)
    place = np.array([number(calc, "crank_slider_acceleration_peak_at")])
    assert at(calc, "crank_slider_acceleration", place)[0] < -1.5 * number(calc, "crank_slider_acceleration_end")


@each_drive
def test_what_brakes_the_edge_is_its_speed_at_contact_and_its_way_the_depth(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    lowest, angle = number(calc, f"{drive}_lowest_angle"), number(calc, f"{drive}_working_angle")
    phi, time = lowest - angle / 2 + angle / 2 * nodes, angle / 2 * weights / OMEGA
    braked, way = (np.sum(at(calc, f"{drive}_{name}", phi) * time) for name in ("acceleration", "velocity"))
    assert braked == pytest.approx(number(calc, f"{drive}_contact_velocity"), rel=1e-12)
    assert way == pytest.approx(-0.04, rel=1e-12)


@each_drive
def test_the_grip_begins_with_the_knifes_speed(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys, grip_angle=7, roller_diameter=90, roller_ratio=1.5)
    begin = np.array([number(calc, f"{drive}_lowest_angle") - np.radians(7)])
    speed = -at(calc, f"{drive}_velocity", begin)[0]
    rollers, time = 0.045 * 1.5 * OMEGA, np.radians(7) / OMEGA
    assert number(calc, f"{drive}_grip_velocity") == pytest.approx(speed, rel=1e-12)
    assert number(calc, f"{drive}_grip_acceleration") == pytest.approx((rollers - speed) / time, rel=1e-12)
    given_speed = knife(**keys, grip_speed=0.2)
    assert number(given_speed, f"{drive}_grip_acceleration") == pytest.approx(
        (0.08 * OMEGA - 0.2) / (np.pi / 36 / OMEGA)
    )


def test_rollers_slower_than_the_knife_brake_the_signature_and_are_checked_by_size() -> None:
    calc = knife(**PLANETARY, roller_diameter=1)
    assert number(calc, "planetary_grip_acceleration") < 0
    assert number(calc, "planetary_grip_size") == -number(calc, "planetary_grip_acceleration")


@each_drive
def test_the_signature_leaves_the_table_when_its_trailing_edge_has_passed(drive: str, keys: dict[str, Any]) -> None:
    """The signature followed in small steps of time: with the knife to its lowest point, then with the rollers."""
    calc = knife(**keys, signature_length=273)
    step, angle, passed, time = 1e-5, number(calc, f"{drive}_working_angle"), 0.0, 0.0
    lowest = number(calc, f"{drive}_lowest_angle")
    phi = np.arange(lowest - angle, lowest, OMEGA * step) + OMEGA * step / 2
    speeds = iter(-at(calc, f"{drive}_velocity", phi))
    while passed < 0.273:
        passed += next(speeds, 0.08 * OMEGA) * step
        time += step
    assert number(calc, f"{drive}_table_time") == pytest.approx(time, abs=5e-5)
    assert number(calc, "signature_interval") == pytest.approx(3600 / 25000 / 2)


@each_drive
def test_results_do_not_depend_on_the_number_of_samples(drive: str, keys: dict[str, Any]) -> None:
    few, many = knife(**keys, n_points=36), knife(**keys, n_points=5000)
    peak = f"{drive}_acceleration_peak"
    assert number(few, peak) == pytest.approx(number(many, peak), rel=1e-10)


@pytest.mark.parametrize("ratio", [1.2, 3.0, 4.0, 8.0])
def test_at_equal_stroke_planetary_and_crank_slider_differ_by_one_and_the_ratio_of_crank_to_rod(ratio: float) -> None:
    radius = 65.656 * 2
    calc = knife(**PLANETARY, crank_slider={"crank_radius": radius, "rod_length": radius * ratio})
    assert number(calc, "planetary_stroke") == pytest.approx(number(calc, "crank_slider_stroke"))
    ends = number(calc, "planetary_acceleration_end") / number(calc, "crank_slider_acceleration_end")
    assert ends == pytest.approx(1 / (1 + 1 / ratio), rel=1e-12)
    assert number(calc, "factor_ratio_planetary") == pytest.approx(ends, rel=1e-12)


@each_drive
def test_the_edge_may_start_at_the_table(drive: str, keys: dict[str, Any]) -> None:
    stroke = number(knife(**keys), f"{drive}_stroke")
    calc = knife(**keys, working_depth=f"{stroke!r} m")
    assert number(calc, f"{drive}_contact_velocity") == pytest.approx(0, abs=1e-5)
    assert number(calc, f"{drive}_working_angle") > 1


@pytest.mark.parametrize(
    ("ratio", "status"), [(2, "pass"), (4, "fail"), (1, "fail"), (1.87, "fail"), (3, "fail"), (0.001, "fail")]
)
def test_a_knife_that_does_not_fold_each_signature_once_fails(ratio: float, status: str) -> None:
    """Counted over 200 signatures: those that no lowest point of the knife belongs to, and strokes that belong to none."""
    calc = knife(**SLIDER, drive_ratio=ratio, signature_length=273)
    interval, cycle = number(calc, "signature_interval"), number(calc, "cycle_time")
    missed = [each for each in range(200) if abs(each * interval / cycle - round(each * interval / cycle)) > 1e-9]
    idle = round(200 * interval / cycle) - 200
    assert (status == "pass") == (not missed and idle == 0)
    assert {each.id: each.status for each in verdicts(calc)}["in_step"] == status
