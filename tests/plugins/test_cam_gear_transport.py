"""The cam-gear stepper against integration, finite differences, vectors in the plane, and bad input."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad

from diecut_report.api import formula
from diecut_report.api import number as exact
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.mechanics.motion_laws import LAWS, MotionLaw, register
from diecut_report.plugins.cam_gear_transport import MECHANISM, figures
from diecut_report.results.figure_views import MachineView, laid_out
from diecut_report.results.mechanism import mechanism_results
from tests.examples import examples
from tests.machines import advised, at, checks, made_possible, number, statuses
from tests.plugins.steppers import CAMS, CONVEYOR, LOADED, PUBLISHED, RATE, slope, smooth_places, stepper

BY_LAW = pytest.mark.parametrize("law", list(LAWS))
MACHINES = st.fixed_dictionaries(
    {"motion_law": st.sampled_from(list(LAWS)), "dwell_angle": st.floats(5, 300), "sector_dwell_sweep": st.floats(5, 150),
     "sector_stop_sweep": st.floats(0.5, 60)}
)  # fmt: skip


def possible(machine: dict[str, Any]) -> Calculation:
    """A random machine, if its return has some time."""
    wide = LAWS[machine["motion_law"]].B * machine["sector_stop_sweep"] / machine["sector_dwell_sweep"]
    assume(machine["dwell_angle"] / 360 * (1 + wide) < 0.97)
    return stepper(**machine)


# --- phases and motion -----------------------------------------------------------------------------------------------


@given(machine=MACHINES)
@examples(40)
def test_the_gear_makes_exactly_one_turn_a_cycle(machine: dict[str, Any]) -> None:
    calc = possible(machine)
    edges = np.unique(calc.domains["disc_angle"].edges[0])
    turn = sum(
        quad(lambda phi: at(calc, "gear_speed", phi)[0] / (2 * np.pi), low + 1e-12, high - 1e-12, epsabs=1e-10)[0]
        for low, high in pairwise(edges)
    )
    assert turn == pytest.approx(2 * np.pi, rel=1e-9)
    assert number(calc, "gear_rotation_per_cycle") == pytest.approx(2 * np.pi, rel=1e-12)
    assert at(calc, "gear_angle", 2 * np.pi - 1e-9)[0] == pytest.approx(2 * np.pi, abs=1e-6)
    assert statuses(calc)["gear_turn"] == "pass"


@given(machine=MACHINES)
@examples(40)
def test_sector_and_gear_go_through_their_phases(machine: dict[str, Any]) -> None:
    calc = possible(machine)
    dwell, stop, start = (number(calc, n) for n in ("dwell_angle", "angle_stop", "angle_start"))
    sweep, half = number(calc, "sector_dwell_sweep"), number(calc, "sector_stop_sweep") / 2
    phi = np.linspace(0, dwell, 50, endpoint=False)
    top = number(calc, "gear_speed_peak")
    np.testing.assert_allclose(at(calc, "gear_angle", phi), 0, atol=1e-12)
    np.testing.assert_allclose(at(calc, "gear_speed", phi), 0, atol=1e-12 * top)
    np.testing.assert_allclose(at(calc, "gear_acceleration", phi), 0, atol=1e-12)
    angles = dict.fromkeys((0.0,), 0.0) | {dwell: sweep, stop: sweep + half, start: -half, 2 * np.pi - 1e-12: 0.0}
    for place, angle in angles.items():
        for side in (-1e-11, 1e-11):
            assert at(calc, "sector_angle", place + side)[0] == pytest.approx(angle, abs=1e-8)
    for place in (stop, start):
        assert at(calc, "sector_speed", place)[0] == pytest.approx(0, abs=1e-9 * top)
    turn = np.linspace(0, 2 * np.pi, 4001)
    assert at(calc, "sector_angle", turn).min() == pytest.approx(-half, abs=2e-5)
    assert at(calc, "sector_angle", turn).max() == pytest.approx(sweep + half, abs=2e-5)
    assert number(calc, "time_dwell") + number(calc, "time_stop") + number(calc, "time_return") == pytest.approx(1)


@pytest.mark.parametrize("changes", [{}, {"dwell_angle": "100 deg", "sector_stop_sweep": "7 deg"}])
@BY_LAW
def test_each_curve_is_the_derivative_of_the_one_before(law: str, changes: dict[str, Any]) -> None:
    calc = stepper(motion_law=law, **CONVEYOR, **changes)
    phi = smooth_places(calc)
    turns, seconds = 2 * np.pi, 2 * np.pi * RATE  # from radians of the disc to turns of it, to seconds
    pairs = [("sector_angle", "sector_speed", turns), ("gear_angle", "gear_speed", turns),
             ("sector_speed", "sector_acceleration", seconds * RATE), ("gear_speed", "gear_acceleration", seconds * RATE),
             ("sheet_position", "sheet_velocity", seconds), ("sheet_velocity", "sheet_acceleration", seconds)]  # fmt: skip
    for curve, rate, factor in pairs:
        analytic = at(calc, rate, phi)
        np.testing.assert_allclose(
            slope(calc, curve, phi) * factor, analytic, atol=1e-6 * np.abs(analytic).max(), err_msg=rate
        )


@BY_LAW
def test_speeds_join_without_a_jump(law: str) -> None:
    calc = stepper(motion_law=law)
    for place in (0.0, *(number(calc, n) for n in ("dwell_angle", "angle_stop", "angle_start"))):
        before, behind = at(calc, "sector_speed", [place - 1e-9, place + 1e-9])
        assert before == pytest.approx(behind, abs=1e-5)


@BY_LAW
def test_the_peaks_are_those_of_dense_sampling(law: str) -> None:
    calc = stepper(motion_law=law, **LOADED)
    edges = calc.domains["disc_angle"].edges[0]
    phi = np.sort(np.concatenate([np.linspace(0, 2 * np.pi, 200_001), edges - 1e-12, edges + 1e-12]))
    for peak, curve in (("gear_speed_peak", "gear_speed"), ("gear_acceleration_peak", "gear_acceleration"),
                        ("sheet_velocity_max", "sheet_velocity"), ("sheet_acceleration_max", "sheet_acceleration"),
                        ("torque_peak", "drive_torque"), ("cam_1_roller_force_peak", "roller_force_1"),
                        ("cam_2_roller_force_peak", "roller_force_2")):  # fmt: skip
        assert number(calc, peak) == pytest.approx(np.abs(at(calc, curve, phi)).max(), rel=1e-8)
    assert number(calc, "sector_speed_return_peak") == pytest.approx(-at(calc, "sector_speed", phi).min(), rel=1e-8)


@pytest.mark.parametrize("changes", [{}, {"motion_law": "modified_sine", "dwell_angle": "120 deg"}, {"module": "5 mm"}])
def test_sector_and_gear_roll_on_each_other_without_slip(changes: dict[str, Any]) -> None:
    """Velocities in the plane of the two points that touch, from differences of the bodies' angles."""
    calc = stepper(**changes)
    phi = smooth_places(calc)
    disc = 1.0
    gear = slope(calc, "gear_angle", phi)
    sector = disc + slope(calc, "sector_angle", phi)  # absolute
    pin = 0.3 * np.exp(1j * phi)
    contact = number(calc, "gear_radius") * np.exp(1j * phi)
    of_gear = 1j * gear * contact
    of_sector = 1j * disc * pin + 1j * sector * (contact - pin)
    assert number(calc, "gear_radius") + number(calc, "sector_radius") == pytest.approx(0.3, rel=1e-14)
    np.testing.assert_allclose(of_sector, of_gear, atol=1e-9)
    rolled = np.abs(slope(calc, "sector_angle", phi)) * number(calc, "sector_radius")
    np.testing.assert_allclose(np.abs(gear - disc) * number(calc, "gear_radius"), rolled, atol=1e-9)


# --- teeth -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("module, total", [(5, 120), (4, 150), (2.5, 240)])
def test_whole_teeth_keep_the_dwell_and_correct_the_sweep(module: float, total: int) -> None:
    calc = stepper(module=f"{module} mm")
    z1, z3 = number(calc, "gear_teeth"), number(calc, "sector_wheel_teeth")
    assert (z1, z3) == (round(total * 60 / 220), total - round(total * 60 / 220))
    assert number(calc, "gear_radius") == pytest.approx(module * z1 / 2000, rel=1e-12)
    assert number(calc, "sector_radius") == pytest.approx(module * z3 / 2000, rel=1e-12)
    assert number(calc, "sector_dwell_sweep") == pytest.approx(np.radians(160) * z1 / z3)
    np.testing.assert_allclose(at(calc, "gear_angle", np.linspace(0, np.radians(160), 50)), 0, atol=1e-12)
    swept = z3 * (number(calc, "sector_dwell_sweep") + np.radians(20)) / (2 * np.pi)
    assert swept + 2 <= number(calc, "sector_teeth") < swept + 3


def test_a_centre_distance_without_whole_teeth_is_refused_with_the_nearest_one() -> None:
    with pytest.raises(Impossible) as refused:
        stepper(module="4 mm", center_distance="301.3 mm")
    assert refused.value.key == "center_distance"
    assert "150.65" in refused.value.message
    nearest = re.search(r"nearest center_distance is ([\d.]+ mm)", refused.value.message)
    assert nearest is not None
    assert number(stepper(module="4 mm", center_distance=nearest[1]), "teeth_together") == 151


def test_a_module_that_leaves_the_gear_no_tooth_is_refused() -> None:
    sweeps = {"sector_dwell_sweep": "10 deg", "sector_stop_sweep": "3 deg"}
    coarse = sweeps | {"module": "300 mm"}
    with pytest.raises(Impossible, match="have 0 and") as refused:
        stepper(**coarse)
    assert refused.value.key == "module"
    module, *others = made_possible(MECHANISM, PUBLISHED | coarse, "module")
    finer = re.fullmatch(r"set module to at most ([\d.]+) mm", module)
    assert finer is not None
    assert statuses(stepper(module=float(finer[1]), **sweeps))["tooth_undercut"] == "pass"
    assert [way.split()[1] for way in others] == ["sector_dwell_sweep", "dwell_angle"]


def test_few_teeth_are_a_warning() -> None:
    few = advised(stepper(module="12 mm"))["tooth_undercut"]
    assert few.status == "warn"
    assert few.message.endswith("Set module to at most 8 mm.")
    assert statuses(stepper(module="8 mm"))["tooth_undercut"] == "pass"
    assert statuses(stepper(module="5 mm"))["tooth_undercut"] == "pass"
    assert checks(stepper())["tooth_undercut"].missing == ["module"]


# --- sheet, torque, forces -------------------------------------------------------------------------------------------


def test_a_cycle_moves_the_sheet_by_one_step() -> None:
    calc = stepper(**CONVEYOR)
    assert number(calc, "sheet_step") == pytest.approx(20 * 0.0254 * 1.5)
    edges = np.unique(calc.domains["disc_angle"].edges[0])
    way = sum(quad(lambda phi: at(calc, "sheet_velocity", phi)[0], low, high)[0]
              for low, high in pairwise(edges))  # fmt: skip
    assert way / (2 * np.pi * RATE) == pytest.approx(number(calc, "sheet_step"), rel=1e-9)


def test_the_disc_is_in_balance_under_teeth_and_rollers() -> None:
    """Moments about O₁ of the forces on disc, sector and rocker, as vectors: a way that the power was not found by."""
    calc = stepper(**LOADED)
    phi = smooth_places(calc)
    pin, omega = 0.3 * np.exp(1j * phi), 2 * np.pi * RATE
    contact = number(calc, "gear_radius") * np.exp(1j * phi)
    teeth = -1j * np.exp(1j * phi) * at(calc, "tooth_force", phi)  # on the sector
    forces: list[tuple[Any, Any]] = [(contact, teeth)]
    for n in "12":
        center = at(calc, f"cam_{n}_pitch_x", phi) + 1j * at(calc, f"cam_{n}_pitch_y", phi)
        outwards = center - (at(calc, f"cam_{n}_x", phi) + 1j * at(calc, f"cam_{n}_y", phi))
        assert at(calc, f"roller_force_{n}", phi).min() >= 0
        forces.append((center, outwards / 0.025 * at(calc, f"roller_force_{n}", phi)))
    angular = 0.3 * at(calc, "sector_acceleration", phi)

    def moment(about: Any) -> Any:
        return sum((np.conj(place - about) * force).imag for place, force in forces)

    scale = np.abs(angular).max()
    np.testing.assert_allclose(moment(pin), angular, atol=1e-9 * scale)
    np.testing.assert_allclose(at(calc, "drive_torque", phi) + moment(0), angular, atol=1e-9 * scale)
    assert np.minimum(at(calc, "roller_force_1", phi), at(calc, "roller_force_2", phi)).max() == 0
    torque = at(calc, "gear_torque", phi)
    np.testing.assert_allclose(torque * slope(calc, "gear_angle", phi) * omega, 20 * at(calc, "sheet_acceleration", phi)
                               * at(calc, "sheet_velocity", phi), atol=1e-6 * np.abs(torque).max() * omega)  # fmt: skip


def test_the_contact_pressure_is_that_of_roller_and_profile_as_cylinders() -> None:
    calc = stepper(**LOADED)
    for n in "12":
        place = number(calc, f"cam_{n}_contact_pressure_max_at")
        h = 1e-4
        before, here, behind = (
            np.array([at(calc, f"cam_{n}_{c}", place + side)[0] for c in "xy"]) for side in (-h, 0, h)
        )
        first, second = (behind - before) / (2 * h), (behind - 2 * here + before) / h**2
        profile = np.hypot(*first) ** 3 / (first[0] * second[1] - first[1] * second[0])
        effective = 1 / (1 / 0.025 + 1 / profile)
        modulus = 210e9 / (2 * (1 - 0.3**2))
        force = at(calc, f"roller_force_{n}", place)[0]
        expected = np.sqrt(force * modulus / (np.pi * effective * 0.025))
        assert number(calc, f"cam_{n}_contact_pressure_max") == pytest.approx(expected, rel=1e-5)
    low, high = (checks(stepper(**LOADED, allowable_contact_pressure=f"{p} MPa")) for p in (500, 3000))
    assert low["contact_pressure"].status == "fail"
    assert high["contact_pressure"].status == "pass"


def test_the_sheets_acceleration_is_judged_where_a_limit_is_given() -> None:
    assert checks(stepper(**CONVEYOR))["sheet_acceleration"].missing == ["allowable_sheet_acceleration"]
    made = checks(stepper(allowable_sheet_acceleration="1 m/s**2"))
    assert made["sheet_acceleration"].missing == ["sprocket_teeth", "chain_pitch"]
    for allowed, status in ((117, "fail"), (118, "pass")):
        assert (
            statuses(stepper(**CONVEYOR, allowable_sheet_acceleration=f"{allowed} m/s**2"))["sheet_acceleration"]
            == status
        )


# --- bad input -------------------------------------------------------------------------------------------------------


@given(machine=MACHINES)
@examples(60)
def test_without_time_for_a_return_the_message_tells_what_leaves_one(machine: dict[str, Any]) -> None:
    wide = LAWS[machine["motion_law"]].B * machine["sector_stop_sweep"] / machine["sector_dwell_sweep"]
    assume(machine["dwell_angle"] / 360 * (1 + wide) > 1.001)
    with pytest.raises(Impossible) as refused:
        stepper(**machine)
    assert refused.value.key == "dwell_angle"


@pytest.mark.parametrize("rounding", [-1e-12, 0, 1e-12])
def test_a_return_of_just_the_time_that_it_needs_passes(rounding: float) -> None:
    left = number(stepper(dwell_angle="205 deg"), "time_return")
    assert statuses(stepper(dwell_angle="205 deg", min_return_time=left * (1 + rounding)))["return_time"] == "pass"


@pytest.mark.parametrize(
    "changes, key, words",
    [
        ({"arm_angle_1": "120 deg"}, "arm_angle_1", "from 110° to 190° across"),
        ({"arm_angle_2": "170 deg"}, "arm_angle_2", "from 160° to 240° across"),
        ({"arm_angle_2": "80 deg"}, "arm_angle_2", "both arms"),
        ({"sector_dwell_sweep": "165 deg", "dwell_angle": "90 deg"}, "sector_dwell_sweep", "less than 180°"),
    ],
)
def test_arms_that_cannot_drive_both_ways_are_refused(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        stepper(**CAMS | changes)
    assert key in [k for k, _ in refused.value.reasons]
    assert words in dict(refused.value.reasons)[key]


def test_the_arms_may_stand_either_way_round_and_be_counted_backwards() -> None:
    swapped = stepper(**CAMS | {"arm_angle_1": "232 deg", "arm_angle_2": "72 deg"})
    back = stepper(**CAMS | {"arm_angle_2": "-128 deg"})
    plain = stepper(**CAMS)
    for name in ("pressure_angle_max", "curvature_min"):
        assert number(swapped, f"cam_1_{name}") == pytest.approx(number(plain, f"cam_2_{name}"))
        assert number(back, f"cam_2_{name}") == pytest.approx(number(plain, f"cam_2_{name}"))


lopsided_position = formula(lambda k: k**2 * (3 - 2 * k) + k**2 * (1 - k) ** 2)
lopsided_velocity = formula(lambda k: 6 * k * (1 - k) + 2 * k * (1 - k) * (1 - 2 * k))
lopsided_acceleration = formula(lambda k: 6 - 12 * k + 2 - 12 * k + 12 * k**2)
cubic_position = formula(lambda k: k**2 * (3 - 2 * k))
cubic_velocity = formula(lambda k: 6 * k * (1 - k))
cubic_acceleration = formula(lambda k: 6 - 12 * k)
cubic_jerk = formula(lambda k: -12 + 0 * k)
three_halves = formula(lambda: exact(3) / 2)
six = formula(lambda: 6)


@pytest.fixture
def more_laws() -> Iterator[None]:
    """Two further laws, taken back after the test."""
    known = dict(LAWS)
    register(MotionLaw(name="cubic", title="Cubic", position=cubic_position, velocity=cubic_velocity, acceleration=cubic_acceleration,
                       jerk=cubic_jerk, peak_velocity=three_halves, peak_acceleration=six))  # fmt: skip
    register(MotionLaw(name="lopsided", title="Lopsided", position=lopsided_position, velocity=lopsided_velocity,
                       acceleration=lopsided_acceleration, jerk=cubic_jerk, peak_velocity=three_halves, peak_acceleration=six))  # fmt: skip
    yield
    LAWS.clear()
    LAWS.update(known)


@pytest.mark.usefixtures("more_laws")
def test_a_registered_law_drives_the_stepper_at_once() -> None:
    calc = stepper(motion_law="cubic")
    assert number(calc, "time_stop") == pytest.approx(1.5 * np.radians(20) / (np.radians(60) * 9 / 4))
    assert number(calc, "gear_rotation_per_cycle") == pytest.approx(2 * np.pi, rel=1e-12)
    phi = smooth_places(calc)
    np.testing.assert_allclose(slope(calc, "gear_angle", phi) * 2 * np.pi, at(calc, "gear_speed", phi), atol=1e-7)


@pytest.mark.usefixtures("more_laws")
def test_the_comparison_takes_in_new_laws_and_leaves_out_those_that_do_not_suit() -> None:
    speeds, accelerations = figures.laws_compared(MachineView(stepper()))
    for panel in (speeds, accelerations):
        assert [line["label"].split(",")[0].replace(" ", "_").replace("-", "") for line in panel["lines"]] == [
            *list(LAWS)[:-2],
            "cubic",
        ]


@pytest.mark.usefixtures("more_laws")
def test_a_law_that_is_not_fastest_in_the_middle_is_refused() -> None:
    with pytest.raises(Impossible, match="lopsided") as refused:
        stepper(motion_law="lopsided")
    assert refused.value.key == "motion_law"


# --- many at once, figures, declaration ------------------------------------------------------------------------------


def test_the_comparison_of_the_laws_shows_each_law_as_if_it_were_chosen() -> None:
    speeds, accelerations = figures.laws_compared(MachineView(stepper()))
    assert [line["label"].split(",")[0].replace(" ", "_").replace("-", "") for line in speeds["lines"]] == list(LAWS)
    for law, speed, acceleration in zip(LAWS, speeds["lines"], accelerations["lines"], strict=True):
        alone = stepper(motion_law=law)
        np.testing.assert_allclose(
            np.array(speed["y"]) * 2 * np.pi, at(alone, "gear_speed", np.minimum(speed["x"], 6.28318530)), atol=1e-5
        )
        assert float(acceleration["label"].split(", ")[1]) == round(number(alone, "gear_acceleration_peak"))
        assert float(speed["label"].split(", ")[1]) == round(number(alone, "gear_speed_ratio_peak"), 2)


def test_laws_that_leave_no_return_are_left_out_of_the_comparison() -> None:
    speeds, _ = figures.laws_compared(MachineView(stepper(motion_law="harmonic", dwell_angle="225 deg")))
    slow_enough = [name for name, law in LAWS.items() if law.B * 20 / 60 * 225 / 360 < 1 - 225 / 360]
    assert slow_enough == ["harmonic", "modified_sine"]
    assert [line["label"].split(",")[0].replace(" ", "_").replace("-", "") for line in speeds["lines"]] == slow_enough


def test_the_drawn_sector_touches_the_gear_and_the_drawn_cams_are_closed() -> None:
    view = MachineView(stepper(**LOADED))
    bodies = [shape for shape in laid_out(figures.rolling(view)) if shape["shape"] == "polyline" and shape["closed"]]
    assert len(bodies) == 2
    for body in bodies:
        rim = np.hypot(*np.array(body["points"][1:]).T)
        assert rim.min() == pytest.approx(view["gear_radius"], rel=1e-3)
    for cam in "12":
        shapes = figures.one_cam(view, cam)
        pitch, profile = (np.array(s["points"]) for s in shapes if s["shape"] == "polyline" and s["closed"])
        np.testing.assert_allclose(np.hypot(*(pitch - profile).T), 0.025, rtol=1e-9)


def test_without_further_keys_nothing_of_sheet_and_cams_is_said() -> None:
    results = mechanism_results(stepper(), {})
    assert not any(name.startswith(("sheet_", "cam_", "torque")) for name in (*results.outputs, *results.curves))
    assert [check.id for check in results.checks if check.status != "not_checked"] == [
        "return_time",
        "gear_turn",
    ]
    assert results.exports == []


@pytest.mark.parametrize("dwell, sweep", [(216, 20), (120, 60), (240, 15)])
def test_a_return_of_no_time_is_refused_also_where_rounding_leaves_some(dwell: float, sweep: float) -> None:
    with pytest.raises(Impossible, match="take the whole turn"):
        stepper(dwell_angle=f"{dwell} deg", sector_stop_sweep=f"{sweep} deg")


@pytest.mark.parametrize("sweep", [20, 1, 0.1, 0.01, 0.001])
def test_peaks_of_short_phases_are_those_of_the_law(sweep: float) -> None:
    calc = stepper(sector_stop_sweep=f"{sweep} deg", motion_law="polynomial_345")
    rate = number(calc, "inputs.cycles_per_hour")
    law = LAWS["polynomial_345"]
    rises = (
        (np.radians(sweep), number(calc, "time_stop")),
        (number(calc, "sector_sweep"), number(calc, "time_return")),
    )
    top = max(law.A * angle * (rate / time) ** 2 for angle, time in rises)
    ratio = number(calc, "sector_radius") / number(calc, "gear_radius")
    assert number(calc, "gear_acceleration_peak") == pytest.approx(ratio * top, rel=1e-9)


def test_jumping_laws_print_at_all_dwells() -> None:
    for dwell in range(40, 200, 21):
        mechanism_results(stepper(dwell_angle=f"{dwell} deg", sector_stop_sweep="5 deg", motion_law="parabolic"), {})


def test_teeth_are_counted_in_whole_numbers() -> None:
    outputs = mechanism_results(stepper(module="2 mm"), {}).outputs
    assert isinstance(outputs["gear_teeth"].value, int)


@pytest.mark.parametrize("law", ["cycloidal", "modified_trapezoidal"])
def test_the_discs_power_is_the_rate_of_the_energy_of_conveyor_and_sector(law: str) -> None:
    calc = stepper(**LOADED, motion_law=law)
    phi, omega = smooth_places(calc, clear=4e-3), 2 * np.pi * RATE

    def energy(place: Any) -> Any:
        sector = omega * (1 + at(calc, "sector_speed", place) / (2 * np.pi))
        return 20 * at(calc, "sheet_velocity", place) ** 2 / 2 + 0.3 * sector**2 / 2

    step = 4e-4
    rate = (8 * (energy(phi + step) - energy(phi - step)) - energy(phi + 2 * step) + energy(phi - 2 * step)) / (
        12 * step
    )
    torque = at(calc, "drive_torque", phi)
    np.testing.assert_allclose(torque, rate, atol=1e-6 * np.abs(torque).max())
    assert number(calc, "energy_residual") < 1e-9
    assert checks(calc)["energy_balance"].status == "pass"
