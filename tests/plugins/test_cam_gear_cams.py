"""The stepper's cams: rollers tangent to the profiles, undercut, pressure angles, hollow flanks.

In CI each cam runs with a law of many joints and one that jumps; at night with all.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.mechanics.motion_laws import LAWS
from tests.examples import examples, few
from tests.machines import number
from tests.plugins.steppers import CAMS, at, checks, slope, smooth_places, stepper

TURN = np.linspace(0, 2 * np.pi, 721)[:-1]


def on_profile(calc: Calculation, n: str, phi: Any) -> Array:
    return at(calc, f"cam_{n}_x", phi) + 1j * at(calc, f"cam_{n}_y", phi)


def center(calc: Calculation, n: str, phi: Any) -> Array:
    return at(calc, f"cam_{n}_pitch_x", phi) + 1j * at(calc, f"cam_{n}_pitch_y", phi)


def nearest(calc: Calculation, n: str, phi: float) -> float:
    """Least distance of the roller's centre from the whole profile, by search on the profile's function."""
    roller = center(calc, n, phi)[0]
    distances = np.abs(on_profile(calc, n, TURN) - roller)
    local = (
        (distances <= np.roll(distances, 1)) & (distances <= np.roll(distances, -1)) & (distances < 2 * distances.min())
    )
    found = (
        minimize_scalar(lambda x: abs(on_profile(calc, n, x)[0] - roller), method="bounded", bounds=(place - 0.01, place + 0.01),
                        options={"xatol": 1e-12}).fun
        for place in TURN[local]
    )  # fmt: skip
    return float(min(found))


@pytest.mark.parametrize("law", few(LAWS, keep=lambda law: law in ("modified_trapezoidal", "parabolic")))
@pytest.mark.parametrize("n", ["1", "2"])
def test_the_rollers_stay_tangent_to_their_profiles(n: str, law: str) -> None:
    calc = stepper(**CAMS, motion_law=law, n_points=36)
    for phi in np.linspace(0.05, 6.2, 7):
        assert nearest(calc, n, phi) == pytest.approx(0.025, abs=1e-9 * 0.025)


@given(
    arm=st.floats(40, 160),
    roller=st.floats(5, 150),
    one=st.floats(40, 100),
    other=st.floats(200, 270),
    phi=st.floats(0, 6.28),
    dwell=st.floats(60, 190),
)
@example(arm=150.0, roller=5.0, one=40.0, other=200.0, phi=0.0, dwell=60.0)  # a roller that stands still on its cam
@examples(25)
@pytest.mark.nightly
def test_the_checks_tell_whether_the_rollers_touch_their_profiles_once(
    arm: float, roller: float, one: float, other: float, phi: float, dwell: float
) -> None:
    calc = stepper(
        arm_length=arm, roller_radius=roller, arm_angle_1=one, arm_angle_2=other, dwell_angle=dwell, n_points=36
    )
    sharp, turns = (checks(calc)[name].status == "pass" for name in ("curvature", "profile_turns"))
    if sharp and turns:
        for n in "12":
            assert nearest(calc, n, phi) == pytest.approx(roller / 1000, rel=1e-9)
        return
    assume(not sharp and number(calc, "curvature_min") < 0.95 * roller / 1000)
    n = "1" if number(calc, "cam_1_curvature_min") <= number(calc, "cam_2_curvature_min") else "2"
    assert nearest(calc, n, number(calc, f"cam_{n}_curvature_greatest_at")) < roller / 1000 * (1 - 1e-9)


def test_an_undercut_cam_fails_and_the_message_tells_the_greatest_roller() -> None:
    least = number(stepper(**CAMS), "curvature_min")
    for share, status in ((0.999, "pass"), (1.001, "fail")):
        check = checks(stepper(**CAMS | {"roller_radius": f"{share * least!r} m"}))["curvature"]
        assert check.status == status
    told = re.search(r"roller_radius to at most ([\d.]+) mm", check.message)
    assert told is not None
    assert 0.999 * least < float(told[1]) / 1000 < least


def test_a_roller_that_runs_back_around_the_shaft_fails() -> None:
    """A long arm and a quick return: the centre's polar angle about O₁ turns back."""
    calc = stepper(**CAMS | {"arm_length": "230 mm"}, dwell_angle="195 deg")
    angle = np.unwrap(np.angle(center(calc, "1", np.linspace(0, 2 * np.pi, 5001)[:-1])))
    assert np.diff(angle).min() < 0
    assert number(calc, "cam_1_tangent_min") < 0
    check = checks(calc)["profile_turns"]
    assert (check.status, check.utilisation) == ("fail", None)
    assert number(stepper(**CAMS), "tangent_distance_min") > 0
    assert np.diff(np.unwrap(np.angle(center(stepper(**CAMS), "1", TURN)))).min() > 0


def test_the_published_arms_have_pressure_angles_of_about_43_and_45_degrees() -> None:
    calc = stepper(**CAMS)
    for n, degrees in (("1", 43), ("2", 45)):
        phi = smooth_places(calc)
        roller = slope(calc, f"cam_{n}_pitch_x", phi) + 1j * slope(calc, f"cam_{n}_pitch_y", phi)
        pin = 0.3 * np.exp(1j * phi)
        moved = 1j * (center(calc, n, phi) - pin)  # square to the arm: how the roller moves as seen from the disc
        force = center(calc, n, phi) - on_profile(calc, n, phi)
        assert np.abs((np.conj(force) * roller).real).max() < 1e-9  # the force is square to the path
        angles = np.degrees(np.arccos(np.abs((np.conj(force) * moved).real) / np.abs(force * moved)))
        assert np.abs(angles - np.degrees(at(calc, f"cam_{n}_pressure_angle", phi))).max() < 1e-5
        assert angles.max() == pytest.approx(degrees, abs=0.5)
        assert np.degrees(number(calc, f"cam_{n}_pressure_angle_max")) == pytest.approx(angles.max(), abs=1e-3)
    assert checks(calc)["pressure_angle"].status == "pass"
    assert checks(stepper(**CAMS, max_pressure_angle="44 deg"))["pressure_angle"].status == "fail"


def test_the_least_radius_of_curvature_is_that_of_three_neighbouring_points() -> None:
    calc = stepper(**CAMS)
    for n in "12":
        place = number(calc, f"cam_{n}_curvature_greatest_at")
        a, b, c = (center(calc, n, place + side)[0] for side in (-1e-4, 0.0, 1e-4))
        area = ((b - a).real * (c - a).imag - (b - a).imag * (c - a).real) / 2
        radius = abs(a - b) * abs(b - c) * abs(c - a) / (4 * area)
        assert number(calc, f"cam_{n}_curvature_min") == pytest.approx(radius, rel=1e-4)
        assert number(calc, f"cam_{n}_profile_radius_min") == pytest.approx(radius - 0.025, rel=1e-4)


def test_hollow_flanks_are_told_with_the_radius_that_no_wheel_may_exceed() -> None:
    flat = stepper(**CAMS)
    assert np.isnan(flat["cam_1_hollow_radius_min"][0, 0])
    calc = stepper(**CAMS | {"arm_length": "140 mm"})
    assert number(calc, "cam_2_curvature_least") < 0
    place = number(calc, "cam_2_curvature_least_at")
    points = [on_profile(calc, "2", place + side)[0] for side in (-1e-4, 0.0, 1e-4)]
    a, b, c = points
    area = ((b - a).real * (c - a).imag - (b - a).imag * (c - a).real) / 2
    radius = abs(a - b) * abs(b - c) * abs(c - a) / (4 * area)
    assert radius < 0
    assert number(calc, "cam_2_hollow_radius_min") == pytest.approx(-radius, rel=1e-4)


@given(one=st.floats(-360, 360), other=st.floats(-360, 360))
@examples(60)
def test_arms_are_accepted_where_one_stays_left_and_the_other_right_of_the_pin(one: float, other: float) -> None:
    swing = np.radians(np.linspace(-10, 70, 2001))
    signs = [np.sign(np.sin(np.radians(angle) + swing)) for angle in (one, other)]
    assume(all(np.abs(np.sin(np.radians(angle) + swing[[0, -1]])).min() > 1e-9 for angle in (one, other)))
    accepted = all(abs(sign.sum()) == len(sign) for sign in signs) and bool((signs[0] * signs[1] < 0).all())
    try:
        stepper(**CAMS | {"arm_angle_1": one, "arm_angle_2": other})
    except Impossible as refused:
        assert not accepted
        assert {key for key, _ in refused.reasons} <= {"arm_angle_1", "arm_angle_2"}
    else:
        assert accepted
