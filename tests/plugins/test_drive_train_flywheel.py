"""The flywheel and the run-up of the motor against brute-force integration and equations of motion."""

from __future__ import annotations

from math import pi, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid, solve_ivp

from diecut_report.formulas import Array
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.drive_train import MECHANISM
from diecut_report.results.mechanism import mechanism_results
from tests.examples import examples
from tests.machines import inputs, number
from tests.plugins.drive_trains import (
    EXAMPLE,
    RPM,
    UNEVEN,
    WORKING,
    at_flywheel,
    check,
    checked,
    over_a_turn,
    sine_load,
    train,
)


def test_energy_fluctuation_is_that_of_brute_force() -> None:
    calc = train(**WORKING)
    phi, torque = over_a_turn(UNEVEN, 1_200_001)
    torque = at_flywheel(torque, 6, 0.96 * 0.98)
    energy = cumulative_trapezoid((torque - torque[:-1].mean()) * 6, phi, initial=0)
    assert number(calc, "energy_fluctuation") == pytest.approx(np.ptp(energy), rel=1e-7)
    assert number(calc, "excess_energy_max") == pytest.approx(energy.max(), rel=1e-7)
    assert number(calc, "excess_energy_max_at") == pytest.approx(phi[np.argmax(energy)], abs=1e-4)


def test_a_torque_over_two_turns_is_that_of_both_turns() -> None:
    """The list is laid over two turns: brute force over twice the angle, and the same list twice over is as good as once."""
    calc = train(**WORKING, torque_curve_turns=2)
    phi, torque = over_a_turn(UNEVEN, 1_200_001)
    torque = at_flywheel(torque, 6, 0.96 * 0.98)
    energy = cumulative_trapezoid((torque - torque[:-1].mean()) * 6, 2 * phi, initial=0)
    assert number(calc, "energy_fluctuation") == pytest.approx(np.ptp(energy), rel=1e-7)
    assert number(calc, "flywheel_torque_mean") == pytest.approx(
        number(train(**WORKING), "flywheel_torque_mean"), rel=1e-9
    )
    sines = {"torque_curve_turns": 2, "torque_peak": 400}
    once, twice = (
        train(torque_curve=list(np.tile([200, 400, 200, 0], n)), **(sines if n == 2 else {"torque_peak": 400}))
        for n in (1, 2)
    )
    assert number(twice, "energy_fluctuation") == pytest.approx(number(once, "energy_fluctuation"), rel=1e-9)


@pytest.mark.parametrize(
    ("speed", "synchronous"), [("1450 rpm", 1500), ("940 rpm", 1000), ("2880 rpm", 3000), ("705 rpm", 750)]
)
def test_the_swing_of_the_speed_is_held_against_the_motors_slip(speed: str, synchronous: float) -> None:
    calc = train(**WORKING | {"motor_speed": speed, "output_speed": f"{float(speed.split()[0]) / 24} rpm"})
    loaded = float(speed.split()[0])
    assert number(calc, "synchronous_speed") == pytest.approx(synchronous * RPM, rel=1e-12)
    assert number(calc, "swing_to_slip") == pytest.approx(0.1 * loaded / (synchronous - loaded), rel=1e-9)
    given_speed = train(
        **WORKING | {"synchronous_speed": "1800 rpm", "motor_speed": "1740 rpm", "output_speed": "60 rpm"}
    )
    assert number(given_speed, "swing_to_slip") == pytest.approx(2.9, rel=1e-9)


def test_a_steady_torque_needs_no_flywheel() -> None:
    calc = train(torque_curve=[200.0] * 12, torque_peak=200)
    assert number(calc, "energy_fluctuation") == pytest.approx(0, abs=1e-9)
    assert number(calc, "flywheel_mass") == pytest.approx(0, abs=1e-6)
    assert check(calc, "flywheel_rim_speed").status == "pass"


@pytest.mark.parametrize("fluctuation", [0.02, 0.1, 0.3])
def test_the_flywheels_speed_swings_as_the_equation_of_motion_says(fluctuation: float) -> None:
    """J·dω/dt = M_mean − M(φ): the mean of the extreme speeds squared times the swing is what the wheel is sized for."""
    calc = train(
        gears=[], output_speed="290 rpm", torque_curve=sine_load(mean=100, swing=400), speed_fluctuation=fluctuation
    )
    wheel, speed = number(calc, "flywheel_inertia"), number(calc, "shaft_2_speed")

    def motion(_: float, state: Array) -> list[float]:
        return [state[1], -400 * sin(state[0]) / wheel]  # without gears nothing is lost behind the flywheel

    times = np.linspace(0, 6 * pi / speed, 30_001)
    run = solve_ivp(motion, (0, times[-1]), [0.0, speed], t_eval=times, method="DOP853", rtol=1e-11, atol=1e-11)
    fast, slow = run.y[1].max(), run.y[1].min()
    mean = (fast + slow) / 2
    assert (fast - slow) / mean * (mean / speed) ** 2 == pytest.approx(fluctuation, rel=1e-6)


@pytest.mark.parametrize(("material", "density", "limit"), [("steel", 7850, 60), ("cast_iron", 7200, 35)])
def test_the_disc_has_the_inertia_and_the_materials_limit(material: str, density: float, limit: float) -> None:
    calc = train(**WORKING, flywheel_material=material)
    diameter, mass = number(calc, "flywheel_diameter"), number(calc, "flywheel_mass")
    assert mass * diameter**2 / 8 == pytest.approx(number(calc, "flywheel_inertia"), rel=1e-12)
    assert mass == pytest.approx(density * pi / 4 * diameter**2 * 0.2 * diameter, rel=1e-12)
    assert number(calc, "flywheel_rim_speed") == pytest.approx(number(calc, "shaft_2_speed") * diameter / 2, rel=1e-12)
    assert check(calc, "flywheel_rim_speed").limit == limit


def test_a_rim_too_fast_for_cast_iron_fails() -> None:
    fast = WORKING | {
        "gears": [{"driver_teeth": 17, "driven_teeth": 200}],
        "output_speed": "90 rpm",
        "speed_fluctuation": 0.005,
    }
    vbelt = {"driver_diameter": 160, "center_distance": 700}
    limits = {
        m: check(train(**fast, vbelt=vbelt, flywheel_material=m), "flywheel_rim_speed").status
        for m in ("steel", "cast_iron")
    }
    assert limits == {"steel": "pass", "cast_iron": "fail"}


def test_the_run_up_takes_as_long_as_the_coupled_equations_of_motion_say() -> None:
    """Motor, flywheel and load as three bodies; the belt and the gears pass on torque less their losses."""
    calc = train(**WORKING, motor_inertia=0.05, load_inertia=3, run_up_load=0.6)
    belt, gears, wheel = number(calc, "vbelt_ratio_actual"), 6.0, number(calc, "flywheel_inertia")
    rated = number(calc, "motor_power") / (1450 * RPM)
    driving = 1.6 * rated - 0.6 * number(calc, "shaft_1_torque")
    # unknown: accelerations of motor, flywheel, load; torque into the belt, torque into the gears
    balance = np.array([
        [0.05, 0, 0, 1, 0],
        [0, wheel, 0, -belt * 0.95, 1],
        [0, 0, 3, 0, -gears * 0.96 * 0.98],
        [1, -belt, 0, 0, 0],
        [0, 1, -gears, 0, 0],
    ])  # fmt: skip

    def motion(_: float, state: Array) -> list[float]:
        return [float(np.linalg.solve(balance, [driving, 0, 0, 0, 0])[0])]

    def there(_: float, state: Array) -> float:
        return float(state[0] - 1450 * RPM)

    run = solve_ivp(motion, (0, 1000), [0.0], events=there, rtol=1e-10)
    assert run.t_events is not None
    assert number(calc, "run_up_time") == pytest.approx(run.t_events[0][0], rel=1e-8)


def test_without_a_flywheel_and_inertias_the_run_up_is_not_checked() -> None:
    keys = {key: value for key, value in EXAMPLE.items() if not key.endswith("inertia")}
    assert check(calculate(MECHANISM, inputs(MECHANISM, keys)), "run_up_time").status == "not_checked"


def test_a_motor_that_does_not_overcome_the_load_never_runs_up() -> None:
    calc = train(**WORKING, run_up_load=2.5)
    assert check(calc, "run_up_torque").status == "fail"
    assert "run_up_time" not in mechanism_results(calc, {}).outputs
    assert "run_up_time" not in checked(calc)


@pytest.mark.parametrize(
    "values", [[100.0, 100, 100, 100 + 1e-8], [100.00000000000001, 100, 99.99999999999999, 100, 100, 99.99999999999999]]
)
def test_a_torque_that_varies_by_rounding_alone_needs_hardly_a_flywheel(values: list[float]) -> None:
    calc = train(torque_curve=values, torque_mean=100, torque_peak=100)
    assert 0 <= number(calc, "energy_fluctuation") < 1e-6
    assert mechanism_results(calc, {}).status != "error"


@examples(40)
@given(values=st.lists(st.integers(-500, 1500), min_size=4, max_size=24))
def test_energy_fluctuation_of_any_list_is_that_of_brute_force(values: list[int]) -> None:
    phi, torque = over_a_turn(values, 40_001)
    torque = at_flywheel(torque, 5, 0.97)
    mean = float((torque[1:] + torque[:-1]).mean() / 2)
    assume(mean > 0)
    found = number(train(torque_curve=values), "energy_fluctuation")
    energy = cumulative_trapezoid((torque - mean) * 5, phi, initial=0)
    assert found == pytest.approx(np.ptp(energy), rel=1e-4, abs=1e-3)
