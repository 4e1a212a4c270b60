"""The drive train: ratios, torque and power at its shafts, the motor, against brute force and balances of power."""

from __future__ import annotations

import re
from itertools import pairwise
from math import pi, prod

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid

from diecut_report.api import standard_series
from diecut_report.machine.calculation import CurveHandle, Impossible
from diecut_report.plugins.drive_train import MECHANISM
from diecut_report.quantities.units import unit as parsed
from diecut_report.results.checks import verdicts
from diecut_report.results.mechanism import mechanism_results
from tests.examples import examples
from tests.machines import UNBALANCED, drive, made_possible, number
from tests.plugins.drive_trains import (
    EXAMPLE,
    PAIRS,
    RPM,
    UNEVEN,
    WORKING,
    at_flywheel,
    check,
    checked,
    over_a_turn,
    train,
)


def test_speeds_follow_the_driven_pulley_of_the_standard_series() -> None:
    calc = train(gears=PAIRS, output_speed="62 rpm")
    ratio = 1450 / 62 / (50 / 20) / (60 / 25)
    series = standard_series("renard_r40_lengths").values
    driven = min(series, key=lambda diameter: abs(diameter - 125 * ratio))
    assert number(calc, "vbelt_ratio") == pytest.approx(ratio, rel=1e-12)
    assert number(calc, "driven_diameter") == pytest.approx(driven / 1000, rel=1e-12)
    second = 1450 * 125 / driven
    speeds = [number(calc, "shaft_1_speed"), number(calc, "shaft_2_speed"), *calc["gear_shaft_speed"][0]]
    assert speeds == pytest.approx([1450 * RPM, second * RPM, second / 2.5 * RPM, second / 6 * RPM], rel=1e-12)
    assert number(calc, "output_speed") == speeds[-1]
    assert number(calc, "output_speed_error") == pytest.approx(abs(second / 6 / 62 - 1), rel=1e-9)


def test_the_shafts_are_numbered_in_the_results() -> None:
    outputs = mechanism_results(train(gears=PAIRS), {}).outputs
    for quantity, unit in (("speed", "rpm"), ("torque", "N*m"), ("power", "kW")):
        known = [name for name in outputs if re.fullmatch(rf"shaft_\d_{quantity}", name)]
        assert sorted(known) == [f"shaft_{i}_{quantity}" for i in (1, 2, 3, 4)]
        assert {outputs[name].unit for name in known} == {parsed(unit).si}


def test_without_gears_the_flywheel_shaft_is_the_output() -> None:
    calc = train(gears=[], output_speed="300 rpm")
    assert number(calc, "output_speed") == number(calc, "shaft_2_speed")
    assert number(calc, "efficiency_total") == 0.95
    assert "gear_shaft_speed" not in calc.values
    assert number(calc, "shaft_2_torque") == pytest.approx(200, rel=1e-12)


def test_a_belt_that_would_have_to_speed_up_is_refused_in_words() -> None:
    with pytest.raises(Impossible) as refused:
        train(output_speed="300 rpm")
    assert refused.value.key == "output_speed"
    assert "300 r/min" in refused.value.message and "0.9667" in refused.value.message


def test_a_ratio_of_one_is_possible() -> None:
    calc = train(output_speed="290 rpm")
    assert number(calc, "vbelt_ratio") == pytest.approx(1, rel=1e-12)
    assert number(calc, "vbelt_wrap") == pytest.approx(pi, rel=1e-9)
    assert number(calc, "tight_tension") - number(calc, "slack_tension") == pytest.approx(number(calc, "vbelt_pull"))


def test_a_belt_ratio_above_seven_fails_its_check() -> None:
    assert (
        check(
            train(output_speed="40 rpm", vbelt=EXAMPLE["vbelt"] | {"center_distance": "900 mm"}), "vbelt_ratio"
        ).status
        == "fail"
    )
    assert check(train(), "vbelt_ratio").status == "pass"


def test_the_ratio_that_is_judged_is_that_of_the_pulleys_there_are() -> None:
    wide = EXAMPLE["vbelt"] | {"center_distance": "900 mm"}
    found = check(train(output_speed="41.2 rpm", vbelt=wide), "vbelt_ratio")
    assert found.demand == pytest.approx(number(train(output_speed="41.2 rpm", vbelt=wide), "driven_diameter") / 0.125)
    assert found.demand != pytest.approx(1450 / 41.2 / 5, rel=1e-4)


def test_torque_at_every_shaft_is_that_of_brute_force_over_the_turn() -> None:
    calc = train(**WORKING)
    _, torque = over_a_turn(UNEVEN, 2_000_001)
    wanted = []
    for k in range(3):
        ratio = prod(p["driven_teeth"] / p["driver_teeth"] for p in PAIRS[k:])
        wanted.append(at_flywheel(torque, ratio, prod(p["efficiency"] for p in PAIRS[k:]))[:-1].mean())
    found = [number(calc, "shaft_2_torque"), *calc["gear_shaft_torque"][0]]
    np.testing.assert_allclose(found, wanted, rtol=1e-8)
    belt = number(calc, "driven_diameter") / 0.125
    assert number(calc, "shaft_1_torque") == pytest.approx(wanted[0] / belt / 0.95, rel=1e-8)
    assert number(calc, "flywheel_torque_mean") == pytest.approx(number(calc, "shaft_2_torque"), rel=1e-10)


@examples(40)
@given(
    teeth=st.lists(st.tuples(st.integers(17, 40), st.integers(40, 90), st.floats(0.8, 1.0)), max_size=4),
    values=st.lists(st.integers(-500, 1500), min_size=4, max_size=16),
    belt=st.floats(0.8, 1.0),
)
def test_power_in_less_all_losses_is_power_out(
    teeth: list[tuple[int, int, float]], values: list[int], belt: float
) -> None:
    gears = [dict(zip(("driver_teeth", "driven_teeth", "efficiency"), pair, strict=True)) for pair in teeth]
    speed = 1450 / 3 / np.prod([pair[1] / pair[0] for pair in teeth])
    efficiency = float(np.prod([pair[2] for pair in teeth]))
    torque = over_a_turn(values, 20_001)[1]
    assume(at_flywheel(torque, 1, efficiency).mean() > 1)
    vbelt = {"driver_diameter": 140, "center_distance": 800, "efficiency": belt}
    calc = train(gears=gears, output_speed=speed, torque_curve=values, vbelt=vbelt, torque_peak=1500)
    assert check(calc, "power_balance").status == "pass"
    powers = [number(calc, "shaft_1_power"), number(calc, "shaft_2_power")]
    powers += list(calc["gear_shaft_power"][0]) if gears else []
    assert all(before >= after - 1e-9 * abs(before) for before, after in pairwise(powers))
    assert powers[-1] == pytest.approx(torque[:-1].mean() * number(calc, "output_speed"), rel=2e-3, abs=0.5)
    assert powers[0] - number(calc, "losses_total") == pytest.approx(powers[-1], rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("efficiency", [1e-6, 0.5])
def test_the_balance_bears_the_rounding_of_the_greatest_of_its_powers(efficiency: float) -> None:
    gears = [{"driver_teeth": 20, "driven_teeth": 57, "efficiency": efficiency}]
    calc = train(gears=gears, output_speed=150, torque_curve=[100, 730, 410, 260], torque_peak=1500)
    assert check(calc, "power_balance").status == "pass"
    assert number(calc, "power_rounding") < 1e-11 * number(calc, "shaft_1_power")


def test_without_backflow_each_shaft_passes_on_what_its_efficiency_leaves() -> None:
    calc = train(gears=PAIRS)
    powers = [number(calc, "shaft_1_power"), number(calc, "shaft_2_power"), *calc["gear_shaft_power"][0]]
    shares = [after / before for before, after in pairwise(powers)]
    assert shares == pytest.approx([0.95, 0.96, 0.98], rel=1e-12)
    assert number(calc, "efficiency_total") == pytest.approx(0.95 * 0.96 * 0.98, rel=1e-12)


def test_the_curve_of_another_mechanism_travels_with_its_jumps() -> None:
    source = drive(**UNBALANCED)
    calc = train(torque_curve=CurveHandle(source, "crank_torque"), torque_peak=3000, gears=PAIRS)
    phi = np.linspace(0, 2 * pi, 200_001)[None, :]
    domain = source.domains["crank_angle"]
    middle = np.concatenate([domain.middle_of(part) for part in np.array_split(phi, 50, axis=1)], axis=1)
    torque = at_flywheel(source.sample("crank_torque", phi, middle)[0], 6, 0.96 * 0.98)
    assert number(calc, "flywheel_torque_mean") == pytest.approx(torque[:-1].mean(), rel=1e-3)
    energy = cumulative_trapezoid((torque - torque[:-1].mean()) * 6, phi[0])
    assert number(calc, "energy_fluctuation") == pytest.approx(np.ptp(energy), rel=1e-3)
    assert number(calc, "output_speed_error") < 1


def test_a_curve_that_drives_the_motor_is_refused() -> None:
    with pytest.raises(Impossible) as refused:
        train(torque_curve=[-value for value in UNEVEN])
    assert refused.value.key == "torque_curve" and "sign" in refused.value.message


def test_mean_and_peak_that_do_not_belong_to_the_curve_are_told() -> None:
    fitting, off = train(**WORKING), train(torque_curve=UNEVEN)
    assert [check(fitting, f"torque_{n}").status for n in ("mean", "peak")] == ["pass", "pass"]
    assert [check(off, f"torque_{n}").status for n in ("mean", "peak")] == ["pass", "warn"]
    assert check(train(torque_curve=UNEVEN, torque_mean=100), "torque_mean").status == "warn"
    assert {"torque_mean", "torque_peak"}.isdisjoint(checked(train()))  # there is no curve to belong to


def test_a_peak_below_the_mean_is_refused_and_what_is_told_lies_on_the_limit() -> None:
    with pytest.raises(Impossible) as refused:
        train(torque_peak=199)
    least = re.search(r"torque_peak of at least (\d+)", refused.value.message)
    assert refused.value.key == "torque_peak" and least and int(least[1]) == 200
    train(torque_peak=200)


@examples(50)
@given(torque=st.floats(0, 30_000))
def test_the_motor_is_the_next_standard_one_and_fails_only_above_them_all(torque: float) -> None:
    calc = train(torque_mean=torque, torque_peak=torque)
    power = torque * number(calc, "output_speed") / 0.97 / 0.95 * 1.2 / 1e3
    assert number(calc, "power_required") == pytest.approx(power * 1e3, rel=1e-12, abs=1e-12)
    ratings = standard_series("iec_60072_ratings").values
    above = [rating for rating in ratings if rating >= power]
    assert number(calc, "motor_power") == pytest.approx((above or ratings[-1:])[0] * 1e3)
    assert check(calc, "motor_power").status == ("pass" if above else "fail")


def test_without_a_flywheel_the_peak_must_stay_below_the_breakdown_torque() -> None:
    calc = train()
    peak = 900 / (number(calc, "shaft_1_speed") / number(calc, "output_speed")) / (0.97 * 0.95)
    assert number(calc, "motor_peak_torque") == pytest.approx(peak, rel=1e-12)
    rated = number(calc, "motor_power") / (1450 * RPM)
    for ratio, status in ((peak / rated * 1.001, "pass"), (peak / rated * 0.999, "fail")):
        assert check(train(breakdown_ratio=ratio), "motor_overload").status == status
    assert "motor_overload" not in checked(train(**WORKING))


def test_without_a_curve_there_is_no_flywheel() -> None:
    results = mechanism_results(train(), {})
    assert not [name for name in results.outputs if name.startswith("flywheel") or "energy" in name]
    assert "torque_curve" in str(results.absent)
    assert not {"flywheel_rim_speed", "run_up_time"} & checked(train())


@pytest.mark.parametrize(
    ("given", "allowed", "status"),
    [
        ({}, 0.5, "fail"),  # of the flywheel alone it is too long already
        ({}, 60, "not_checked"),
        ({"motor_inertia": 0.05}, 60, "not_checked"),
        ({"motor_inertia": 0.05}, 0.5, "fail"),
        ({"motor_inertia": 0.05, "load_inertia": 3}, 60, "pass"),
        ({"motor_inertia": 0.05, "load_inertia": 3}, 0.5, "fail"),
    ],
)
def test_a_run_up_that_is_too_long_at_best_fails(given: dict[str, float], allowed: float, status: str) -> None:
    """Without an inertia the time is the least that it can be, so that a short one proves nothing."""
    calc = train(**WORKING, **{"motor_inertia": None, "load_inertia": None, **given}, allowable_run_up_time=allowed)
    [found] = [each for each in verdicts(calc) if each.id == "run_up_time"]
    assert found.status == status
    assert found.missing == (
        [each for each in ("motor_inertia", "load_inertia") if each not in given] if status == "not_checked" else []
    )


def test_results_do_not_depend_on_the_number_of_samples() -> None:
    few, many = train(**WORKING, n_points=36), train(**WORKING, n_points=3000)
    for name in ("energy_fluctuation", "flywheel_torque_mean", "run_up_time"):
        assert number(few, name) == pytest.approx(number(many, name), rel=1e-8)


@pytest.mark.parametrize("changes", [{"load_inertia": 40, "run_up_load": 0.5}, {"motor_inertia": 0.3}])
def test_the_run_up_without_a_flywheel_takes_what_the_energy_says(changes: dict[str, float]) -> None:
    """The work of the motor less the load's, with the losses of belt and gears, is the energy of rotor and load."""
    calc = train(**changes)
    speeds = 1450 * RPM, number(calc, "output_speed")
    energy = changes.get("motor_inertia", 0) * speeds[0] ** 2 / 2
    energy += changes.get("load_inertia", 0) * speeds[1] ** 2 / 2 / (0.95 * 0.97)
    rated = number(calc, "motor_power") / speeds[0]
    torque = 1.6 * rated - changes.get("run_up_load", 1) * number(calc, "shaft_1_torque")
    assert number(calc, "run_up_time") == pytest.approx(2 * energy / (torque * speeds[0]), rel=1e-12)
    assert "run_up_time" in checked(calc)


def test_labels_of_checks_are_short() -> None:
    labels = {label for c in MECHANISM.checks for label in (c.demand_label, c.limit_label)}
    assert labels and max(map(len, labels)) <= 30


def test_an_impossible_train_with_a_listed_torque_curve_gets_advice() -> None:
    keys = EXAMPLE | WORKING | {"motor_speed": "20000 rpm", "n_points": 36}
    assert made_possible(MECHANISM, keys, "gears")
