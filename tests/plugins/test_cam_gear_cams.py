"""The stepper's cams: rollers tangent to their profiles, pressure angles, hollow flanks, and the arms that messages advise.

In CI each cam runs with a law of many joints and one that jumps, and a machine of each way in which arms, sweeps or laws fail; at
night all, whose messages are made by the same code from other numbers.
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
from diecut_report.plugins.cam_gear_transport import arms
from diecut_report.plugins.cam_gear_transport.steps import rolling
from tests.examples import examples, few
from tests.machines import advised, at, checks, number, statuses
from tests.plugins.steppers import CAMS, slope, smooth_places, stepper

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
    sharp, turns = (statuses(calc)[name] == "pass" for name in ("curvature", "profile_turns"))
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
        check = advised(stepper(**CAMS | {"roller_radius": f"{share * least!r} m"}))["curvature"]
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
    assert statuses(calc)["pressure_angle"] == "pass"
    assert statuses(stepper(**CAMS, max_pressure_angle="44 deg"))["pressure_angle"] == "fail"


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


NAMED = r"an? (arm_length|arm_angle_[12]|sector_dwell_sweep|sector_stop_sweep) of (-?[\d.]+)( mm|°)"
CAM_CHECKS = ("pressure_angle", "curvature", "profile_turns", "return_time")


def told(message: str) -> dict[str, float]:
    """Arms and sweeps that a message names."""
    return {key: float(value) for key, value, _ in re.findall(NAMED, message)}


MACHINES: list[dict[str, Any]] = [
     {"motion_law": "harmonic"}, {"motion_law": "harmonic", "arm_angle_2": "236 deg"}, {"dwell_angle": "194.3 deg"},
     {"dwell_angle": "194.3 deg", "arm_length": "5 mm", "roller_radius": "3 mm"}, {"max_pressure_angle": "44 deg"},
     {"max_pressure_angle": "30 deg"}, {"max_pressure_angle": "30 deg", "module": "2.5 mm"}, {"max_pressure_angle": "41 deg"},
     {"arm_angle_1": "40 deg", "arm_angle_2": "-150 deg"}, {"arm_angle_1": "250 deg", "arm_angle_2": "40 deg"},
     {"roller_radius": "100 mm", "arm_length": "140 mm"}, {"arm_length": "240 mm", "dwell_angle": "185 deg"},
]  # fmt: skip


@pytest.mark.parametrize("changes", few(MACHINES, keep=lambda changes: MACHINES.index(changes) in (1, 3, 6, 8, 10, 11)))
def test_the_named_arms_pass_all_checks_of_the_cams(changes: dict[str, Any]) -> None:
    machine = CAMS | changes
    failing = [
        check for check in checks(stepper(**machine)).values() if check.status == "fail" and check.id in CAM_CHECKS
    ]
    assert failing
    for check in failing:
        advised = told(check.message)
        assert advised
        again = checks(stepper(**machine | advised))
        assert {again[name].status for name in CAM_CHECKS} == {"pass"}, advised


@pytest.mark.parametrize(
    "changes", [{"arm_length": "9000 mm"}, {"max_pressure_angle": "30 deg"}, {"motion_law": "harmonic"}]
)
def test_a_search_that_is_spared_would_have_found_nothing(
    changes: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = stepper(**CAMS | changes | {"n_points": 36})
    rocker = [number(machine, name) for name in arms.TAKES]
    found = arms.arms_that_fit.__wrapped__(*rocker)
    monkeypatch.setattr(arms, "FACTORS", arms.FACTORS[::6])
    thin = arms.arms_that_fit.__wrapped__(*rocker)
    monkeypatch.setattr(arms, "_ends_allow", lambda *_: True)
    assert arms.arms_that_fit.__wrapped__(*rocker) == thin and found


def test_arms_that_are_far_too_long_are_judged_without_a_search(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = stepper(**CAMS | {"arm_length": "9000 mm", "n_points": 36})
    rocker = [number(machine, name) for name in arms.TAKES]
    tried: list[float] = []
    searched = arms.pressure_angles
    monkeypatch.setattr(arms, "pressure_angles", lambda *of: tried.append(of[2]) or searched(*of))
    assert arms.arms_that_fit.__wrapped__(*rocker) == "no arms pass with this dwell; take a shorter dwell_angle"
    assert len(tried) <= 400  # the arm as it is, for each length and each sweep; 7200 with the search


def test_where_narrower_sweeps_are_advised_no_arms_pass_as_the_sweeps_are() -> None:
    machine = CAMS | {"max_pressure_angle": "38 deg", "n_points": 36}
    message = checks(stepper(**machine))["pressure_angle"].message
    assert "no arms pass with this dwell and these sweeps" in message
    for length in (10, 40, 80, 120):
        for one in range(15, 110, 16):
            tried = stepper(**machine | {"arm_length": length, "roller_radius": 5, "arm_angle_1": one})
            assert np.degrees(number(tried, "cam_1_pressure_angle_max")) > 38


def test_without_a_return_the_arms_wait_for_it() -> None:
    assert "leave the return its time first" in checks(stepper(**CAMS, dwell_angle="212 deg"))["pressure_angle"].message


def test_arms_across_the_line_are_told_where_they_may_stand() -> None:
    with pytest.raises(Impossible) as refused:
        stepper(**CAMS | {"arm_angle_1": "120 deg"})
    best = re.search(r"take ([\d.]+)° and ([\d.]+)°", refused.value.message)
    assert best is not None
    arms = {"arm_angle_1": float(best[1]), "arm_angle_2": float(best[2])}
    assert statuses(stepper(**CAMS | arms))["pressure_angle"] == "pass"


DEGREE = np.pi / 180


def rocker(law: str, held: float = 40, stop: float = 15) -> arms.Rocker:
    """A sector with these sweeps in degrees."""
    return arms.Rocker(np.radians(200), np.radians(held), np.radians(stop), LAWS[law].B, LAWS[law].A, 0.01, 0.12, 0.06, 0.015,
                       1.5, 4.0, np.radians(45))  # fmt: skip


@pytest.mark.parametrize("law", ["cycloidal", "modified_sine"])
def test_speeds_and_accelerations_of_the_sector_are_those_of_its_angle(law: str) -> None:
    machine = rocker(law)
    cycle, count = arms.motion(machine), len(arms.PLACES)
    angle, speed, bend = cycle.angle[count:], cycle.turn[count:] - 1, cycle.bend[count:]
    middle = len(angle) // 2
    for part in (slice(0, middle), slice(middle, None)):  # stop and start, return
        dealt = np.concatenate([[0], np.cumsum((bend[part][1:] + bend[part][:-1]) / 2 * np.diff(angle[part]))])
        assert speed[part] ** 2 / 2 - speed[part][0] ** 2 / 2 == pytest.approx(dealt, abs=2e-3 * max(speed[part] ** 2))
    highest, lowest = machine.held + machine.stop / 2, -machine.stop / 2  # half a stop beyond each end of what is held
    assert angle[[0, middle - 1, middle, -1]] == pytest.approx([lowest, highest, highest, lowest], abs=1e-12)
    steady = cycle.turn[:count] - 1
    assert cycle.angle[count - 1] == pytest.approx(steady[0] * machine.dwell) and np.ptp(steady) == 0


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"arm_length": "80 mm", "arm_angle_1": "70°"},
         "take an arm_length of 80 mm, an arm_angle_1 of 70°: the greatest pressure angle is then 30° (shorter arms raise the roller forces)"),
        ({"sector_dwell_sweep": "20°", "arm_angle_1": "70°"},
         "take a sector_dwell_sweep of 20°, an arm_angle_1 of 70°: the greatest pressure angle is then 30°"),
    ],
)  # fmt: skip
def test_the_words_have_their_articles_and_warn_of_shorter_arms_alone(values: dict[str, str], words: str) -> None:
    assert str(arms._told(values, 30 * DEGREE)) == words


@pytest.mark.parametrize("place", [20, 80, 110, -80, -130])
def test_an_arm_that_passes_stays_where_it_is(place: float) -> None:
    machine = rocker("cycloidal", held=10, stop=3)._replace(accepted=np.radians(88))
    left, arm = place > 0, place * DEGREE
    assert arms._best(machine, arms.motion(machine), machine.arm_length, arm, left)[0] == pytest.approx(place)


def test_wheels_of_one_tooth_are_some_and_of_none_are_not() -> None:
    (rule,) = [step for step in rolling.steps if step.id == "some_teeth"]
    condition = rule.condition.function
    assert [bool(condition(one, other)) for one, other in ((1, 9), (9, 1), (0, 9), (9, 0))] == [
        True,
        True,
        False,
        False,
    ]


def test_where_no_whole_degree_passes_a_tenth_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stands for a machine whose pressure angle is the accepted one but at 37.3°, and by 0.2° to either side."""
    machine = rocker("cycloidal")
    accepted = machine.accepted - arms.CLEAR

    def steep(_: object, __: object, ___: float, places: np.ndarray) -> np.ndarray:
        return np.asarray(accepted + abs(places - 37.3 * DEGREE) - 0.2 * DEGREE)

    monkeypatch.setattr(arms, "pressure_angles", steep)
    found = arms._best(machine, arms.motion(machine), machine.arm_length, 100 * DEGREE, True)
    assert found == (37.3, pytest.approx(accepted - 0.2 * DEGREE, rel=1e-9))
