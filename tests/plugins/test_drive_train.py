"""The drive train: ratios, torque and power at its shafts, the motor, the V-belt, against brute force, balances of power and Euler's equation."""

from __future__ import annotations

import re
from itertools import pairwise
from math import cos, pi, prod, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.spatial import ConvexHull

from diecut_report.api import standard_series, standard_series_by, standard_table
from diecut_report.machine.calculation import CurveHandle, Impossible
from diecut_report.plugins.drive_train import MECHANISM
from diecut_report.plugins.drive_train.figures import _pair
from diecut_report.plugins.drive_train.inputs import Section
from diecut_report.quantities.units import unit as parsed
from diecut_report.results.checks import verdicts
from diecut_report.results.mechanism import mechanism_results
from tests.examples import examples, few
from tests.machines import UNBALANCED, advised, drive, made_possible, number
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
    assert number(calc, "power_missing") < 1e-12


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


def hull_length(first: float, second: float, apart: float) -> float:
    """Length of a string around two discs: the convex hull of many points on their rims."""
    phi = np.linspace(0, 2 * pi, 50_000, endpoint=False)
    rims = [np.column_stack([x + r * np.cos(phi), r * np.sin(phi)]) for x, r in ((0, first), (apart, second))]
    return float(ConvexHull(np.concatenate(rims)).area)  # in the plane: the circumference


@pytest.mark.parametrize(
    ("driver", "apart", "speed"),
    few([(125, 600, 50), (125, 900, 75), (180, 450, 145), (200, 430, 290)], keep=lambda one: one[0] in (180, 200)),
)
def test_the_belt_is_as_long_as_a_string_around_the_pulleys(driver: float, apart: float, speed: float) -> None:
    calc = train(output_speed=speed, vbelt={"driver_diameter": driver, "center_distance": apart})
    radii = driver / 2e3, number(calc, "driven_diameter") / 2
    assert number(calc, "vbelt_length") == pytest.approx(hull_length(*radii, apart / 1e3), rel=1e-8)
    lengths = standard_series_by("iso_4184_lengths")["SPA"].values
    nearest = min(lengths, key=lambda length: abs(length / 1e3 - number(calc, "vbelt_length")))
    assert number(calc, "vbelt_standard_length") == pytest.approx(nearest / 1e3, rel=1e-12)
    assert hull_length(*radii, number(calc, "center_distance")) == pytest.approx(nearest / 1e3, rel=1e-8)


def test_a_pulley_that_is_given_is_taken_and_turns_the_press_as_fast_as_it_does() -> None:
    sized = train()
    own = {"driver_diameter": 125, "driven_diameter": 368, "center_distance": 600}
    calc = train(vbelt=own)
    assert number(calc, "driven_diameter") == pytest.approx(0.368) != number(sized, "driven_diameter")
    assert number(calc, "shaft_2_speed") == pytest.approx(number(calc, "motor_speed") * 125 / 368)


def test_the_wrap_is_what_the_tangents_leave() -> None:
    calc = train()
    small, large, apart = 0.0625, number(calc, "driven_diameter") / 2, number(calc, "center_distance")
    half = number(calc, "vbelt_wrap") / 2
    on_small = small * np.array([cos(pi - half), sin(pi - half)])
    on_large = np.array([apart, 0]) + large * np.array([cos(pi - half), sin(pi - half)])
    run = on_large - on_small
    assert run @ on_small == pytest.approx(0, abs=1e-12)  # the run leaves both rims square to the radius
    assert run @ (on_large - np.array([apart, 0])) == pytest.approx(0, abs=1e-12)


def test_the_tensions_grow_along_the_wrap_as_friction_allows_and_load_the_shaft_together() -> None:
    calc = train(power_per_belt="3.5 kW")
    wrap, slack, tight = (number(calc, n) for n in ("vbelt_wrap", "slack_tension", "tight_tension"))
    grown = solve_ivp(lambda _, tension: 0.5123 * tension, (0, wrap), [slack], rtol=1e-11, atol=1e-9)
    assert grown.y[0, -1] == pytest.approx(tight, rel=1e-8)
    breakdown = 2.2 * number(calc, "motor_power") / number(calc, "shaft_1_speed")
    assert (tight - slack) * 0.125 / 2 == pytest.approx(breakdown, rel=1e-12)
    thrown = number(calc, "vbelt_count") * 0.12 * number(calc, "vbelt_speed") ** 2  # m v² of a metre of belt
    at_rest = (tight + slack) / 2 + thrown
    assert number(calc, "vbelt_tension") * number(calc, "vbelt_count") == pytest.approx(at_rest, rel=1e-12)
    runs = at_rest * np.array([[np.cos(lean), np.sin(lean)] for lean in ((pi - wrap) / 2, -(pi - wrap) / 2)])
    assert number(calc, "shaft_load") == pytest.approx(np.linalg.norm(runs.sum(axis=0)), rel=1e-12)


PRESS = {
    "motor_speed": "1450 rpm", "output_speed": "100 rpm", "torque_mean": 76, "torque_peak": 100, "reserve_factor": 1.3, "power_per_belt": "3.5 kW",
    "gears": [{"driver_teeth": 18, "driven_teeth": 87}], "vbelt": {"section": "SPA", "driver_diameter": "125 mm", "center_distance": "600 mm"},
}  # fmt: skip


def test_the_belt_of_the_press_is_tensioned_for_the_breakdown_torque() -> None:
    """By hand, of the press as it was (1.5 kW, 125/375 mm, 2000 mm): 2 · 2.2 · 9.878 N·m/0.125 m = 347.7 N; c₁ 0.9394, c₃ 0.9606."""
    calc = train(**PRESS)
    assert number(calc, "motor_power") == 1500 and number(calc, "vbelt_standard_length") == pytest.approx(2)
    found = [
        number(calc, name)
        for name in ("wrap_factor", "length_factor", "vbelt_pull", "vbelt_tension_needed", "shaft_load")
    ]
    assert found == pytest.approx([0.9394, 0.9606, 347.7, 299.7, 586], rel=2e-4)
    assert number(calc, "vbelt_count") == 1
    iso = 1.25 * (1 - 5 ** (-number(calc, "vbelt_wrap") / pi))
    assert number(calc, "wrap_factor") == pytest.approx(iso, rel=1e-9)
    rough = train(**PRESS | {"vbelt": PRESS["vbelt"] | {"groove_friction": 0.8}})  # type: ignore[operator]
    assert number(rough, "wrap_factor") == number(
        calc, "wrap_factor"
    )  # the maker's power holds for the friction that he reckons with
    by_makers = 347.726 * (2.5 - iso) / (2 * iso) + 0.12 * 9.4902**2  # in the form of the makers' catalogues
    assert number(calc, "vbelt_tension_needed") == pytest.approx(by_makers, rel=1e-4)
    heavy = train(**PRESS | {"breakdown_ratio": 1})
    assert number(heavy, "vbelt_pull") == pytest.approx(
        205.5, abs=0.05
    )  # the rated power with the service factor of 1.3


@pytest.mark.parametrize(
    ("tension", "status"), [(None, "not_checked"), (124, "fail"), (299.6, "fail"), (299.7, "pass"), (350, "pass")]
)
def test_a_belt_slips_that_is_tensioned_for_less_than_the_greatest_pull(tension: float | None, status: str) -> None:
    calc = train(**PRESS | {"vbelt": PRESS["vbelt"] | ({} if tension is None else {"tension": tension})})  # type: ignore[operator]
    found = next(each for each in mechanism_results(calc, {}).checks if each.id == "vbelt_slip")
    assert found.status == status
    assert status != "fail" or "299.7 N" in found.message


@pytest.mark.parametrize(("allowed", "status"), [(None, "not_checked"), ("0.5 kN", "fail"), ("800 N", "pass")])
def test_the_load_of_the_belts_is_held_against_what_the_maker_of_the_motor_allows(
    allowed: str | None, status: str
) -> None:
    calc = train(**PRESS | ({} if allowed is None else {"allowable_radial_force": allowed}))
    found = next(each for each in mechanism_results(calc, {}).checks if each.id == "motor_radial_force")
    assert (found.status, found.check_class) == (status, "strength")
    if allowed is None:
        assert "allowable_radial_force" in found.message
    else:
        limit = {"0.5 kN": 500, "800 N": 800}[allowed]
        assert found.utilisation == pytest.approx(number(calc, "shaft_load") / limit)
        assert found.demand == pytest.approx(586, abs=1)  # § 6.2 of the method's sheet


def test_fewer_belts_than_are_needed_fail() -> None:
    few = train(**PRESS | {"power_per_belt": "0.5 kW", "vbelt": PRESS["vbelt"] | {"count": 2}})  # type: ignore[operator]
    assert number(few, "vbelt_count_needed") == 5  # 1.3 · 1.5 kW/(0.5 kW · 0.9394 · 0.9606) = 4.32
    found = next(each for each in mechanism_results(few, {}).checks if each.id == "vbelt_count")
    assert found.status == "fail" and "5" in found.message


def test_the_number_of_belts_carries_the_motors_power() -> None:
    assert "vbelt_count" not in train().values
    calc = train(power_per_belt="0.3 kW")
    one = 300 * number(calc, "wrap_factor") * number(calc, "length_factor")
    count, needed = number(calc, "vbelt_count"), 1.3 * number(calc, "motor_power") / one
    assert count == int(count) and count - 1 < needed <= count
    assert number(train(power_per_belt="50 kW", torque_mean=0), "vbelt_count") == 1


@pytest.mark.parametrize(
    ("vbelt", "key", "words"),
    [
        ({"driver_diameter": "80 mm"}, "vbelt.driver_diameter", ("80 mm", "SPA", "90 mm")),
        ({"center_distance": "300 mm"}, "vbelt.center_distance", ("300 mm", "125 mm", "710 mm", "417.5 mm")),
        ({"center_distance": "3 m"}, "vbelt.center_distance", ("3000 mm", "SPA", "800 mm", "4500 mm")),
        ({"driver_diameter": "119 mm", "center_distance": "416 mm"}, "vbelt.center_distance", ("416 mm", "2240 mm")),
    ],
)
def test_a_belt_that_cannot_be_is_refused_in_words(vbelt: dict[str, str], key: str, words: tuple[str, ...]) -> None:
    with pytest.raises(Impossible) as refused:
        train(vbelt=EXAMPLE["vbelt"] | vbelt)
    assert refused.value.key == key
    assert all(word in refused.value.message for word in words), refused.value.message


def test_the_sections_are_those_with_standard_lengths_and_a_least_diameter() -> None:
    assert set(Section) == set(standard_series_by("iso_4184_lengths")) & set(
        standard_table("vbelt_least_diameter").values
    )


def test_all_reasons_against_a_belt_are_told_at_once() -> None:
    with pytest.raises(Impossible) as refused:
        train(vbelt={"driver_diameter": "60 mm", "center_distance": "100 mm"})
    assert [key for key, _ in refused.value.reasons] == ["vbelt.driver_diameter", "vbelt.center_distance"]


@pytest.mark.parametrize(("apart", "status"), [("600 mm", "pass"), ("430 mm", "fail")])
def test_a_wrap_below_120_degrees_fails(apart: str, status: str) -> None:
    assert check(train(vbelt=EXAMPLE["vbelt"] | {"center_distance": apart}), "vbelt_wrap").status == status


def test_a_belt_faster_than_30_metres_a_second_fails() -> None:
    fast = {"motor_speed": "2900 rpm", "output_speed": "290 rpm", "gears": PAIRS}
    slow = train(**fast, vbelt={"driver_diameter": 197, "center_distance": 700})
    assert number(slow, "vbelt_speed") == pytest.approx(pi * 0.197 * 2900 / 60, rel=1e-12)
    assert check(slow, "vbelt_speed").status == "pass"
    assert check(train(**fast, vbelt={"driver_diameter": 198, "center_distance": 700}), "vbelt_speed").status == "fail"


@pytest.mark.parametrize(("teeth", "status"), [(16, "warn"), (17, "pass")])
def test_few_teeth_are_a_warning(teeth: int, status: str) -> None:
    for pair in ({"driver_teeth": teeth, "driven_teeth": 80}, {"driver_teeth": 20, "driven_teeth": teeth}):
        calc = train(gears=[pair], output_speed=1450 / 5 / (pair["driven_teeth"] / pair["driver_teeth"]))
        assert check(calc, "gear_teeth").status == status


def test_where_no_standard_pulley_meets_the_speed_one_turned_to_measure_is_named() -> None:
    """A ratio of 1.0225 lies between equal pulleys and neighbours of R40."""
    vbelt = {"driver_diameter": 100.0, "center_distance": 1200}
    told = advised(train(gears=[], output_speed=1450 / 1.0225, vbelt=vbelt))["output_speed_error"]
    assert told.status == "fail"
    ((change,),) = told.advice
    assert (change.key, change.relation) == (
        "vbelt.driver_diameter",
        "between",
    )  # greater ones hold here and there only
    low, high = change.value
    assert f"Set vbelt.driver_diameter to between {low} mm and {high} mm." in told.message
    assert not any(low <= each <= high for each in standard_series("renard_r40_lengths").values)
    for driver in np.linspace(low, high, 11):
        calc = train(gears=[], output_speed=1450 / 1.0225, vbelt=vbelt | {"driver_diameter": driver})
        assert check(calc, "output_speed_error").status == "pass"


def test_the_cones_of_a_bevel_pair_touch_and_taper_and_its_label_says_so() -> None:
    *cones, words = _pair(10.0, 40.0, 0.0, (20, 40), "bevel")
    driver, driven = (list(each["points"]) for each in cones)
    heights = [[y for _, y in each] for each in (driver, driven)]
    assert min(heights[0]) == max(heights[1])  # they touch between the shafts
    for each in (driver, driven):
        wide, narrow = (
            sorted(y for x, y in each if x == at) for at in (min(x for x, _ in each), max(x for x, _ in each))
        )
        assert narrow[1] - narrow[0] < wide[1] - wide[0]  # each is wider on one side
    assert str(words["text"]) == "bevel, z = 20 : 40"
    spur = _pair(10.0, 40.0, 0.0, (20, 40), "spur")
    assert str(spur[-1]["text"]) == "z = 20 : 40"
    assert len({y for _, y in spur[0]["points"]}) == 2


def test_without_backflow_each_shaft_passes_on_what_its_efficiency_leaves() -> None:
    calc = train(gears=PAIRS)
    powers = [number(calc, "shaft_1_power"), number(calc, "shaft_2_power"), *calc["gear_shaft_power"][0]]
    shares = [after / before for before, after in pairwise(powers)]
    assert shares == pytest.approx([0.95, 0.96, 0.98], rel=1e-12)
    assert number(calc, "efficiency_total") == pytest.approx(0.95 * 0.96 * 0.98, rel=1e-12)
