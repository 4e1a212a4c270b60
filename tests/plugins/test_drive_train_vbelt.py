"""The V-belt of the drive train against a string around discs, Euler's equation, and what its messages promise."""

from __future__ import annotations

import re
from math import cos, pi, sin
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy.integrate import solve_ivp
from scipy.spatial import ConvexHull

from diecut_report.api import standard_series, standard_series_by, standard_table
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.plugins.drive_train.inputs import Section
from diecut_report.results.mechanism import mechanism_results
from tests.examples import examples, few
from tests.machines import number
from tests.plugins.drive_trains import EXAMPLE, PAIRS, check, train


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


def test_the_usual_reserve_against_slip_makes_the_tensions_five_to_one_at_half_a_turn() -> None:
    calc = train(output_speed="290 rpm")
    assert number(calc, "tension_ratio") == pytest.approx(5, rel=0.01)


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
    assert set(get_args(Section)) == set(standard_series_by("iso_4184_lengths")) & set(
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


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"speed_fluctuation": 1}, "< 1"),
        ({"speed_fluctuation": 0}, "> 0"),
        ({"reserve_factor": 0.9}, "≥ 1"),
        ({"torque_mean": -1}, "≥ 0"),
        ({"gears": [{"driver_teeth": 11, "driven_teeth": 50}]}, "≥ 12"),
        ({"power_per_belt": 0}, "> 0"),
        ({"motor_speed": "0 rpm"}, "> 0"),
        ({"output_speed": "50 1/min"}, "rpm"),
        ({"vbelt": {"driver_diameter": 125}}, "center_distance"),
        ({"vbelt": EXAMPLE["vbelt"] | {"section": "SPX"}}, "SPA"),
        ({"flywheel_material": "wood"}, "cast_iron"),
        ({"torque_curve": [1, 2]}, "at least 4"),
    ],
)
def test_inputs_out_of_range_are_refused(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=re.escape(words)):
        train(**changes)


@pytest.mark.parametrize(("teeth", "status"), [(16, "warn"), (17, "pass")])
def test_few_teeth_are_a_warning(teeth: int, status: str) -> None:
    for pair in ({"driver_teeth": teeth, "driven_teeth": 80}, {"driver_teeth": 20, "driven_teeth": teeth}):
        calc = train(gears=[pair], output_speed=1450 / 5 / (pair["driven_teeth"] / pair["driver_teeth"]))
        assert check(calc, "gear_teeth").status == status


@examples(30)
@given(ratio=st.floats(1.2, 4.5), diameter=st.sampled_from([90, 100, 112, 118, 125, 127.5, 140, 160]))
@pytest.mark.nightly
def test_the_pulleys_that_the_message_names_meet_the_speed(ratio: float, diameter: float) -> None:
    def made(driver: float) -> Calculation:
        vbelt = {"driver_diameter": driver, "center_distance": 850}
        return train(gears=[], output_speed=1450 / ratio, vbelt=vbelt)

    told = check(made(diameter), "output_speed_error")
    assume(told.status == "fail")
    ((change,),) = told.advice
    named = change.value if isinstance(change.value, list) else [change.value]
    assert change.key == "vbelt.driver_diameter" and change.unit == "mm"
    assert named and min(named) >= 90
    standard = set(standard_series("renard_r40_lengths").values)
    if not set(named) <= standard:  # turned to measure, as no standard one of a usual size does
        usual = [each for each in standard if 90 <= each <= 160]
        assert all(check(made(each), "output_speed_error").status == "fail" for each in usual)
    for driver in named:
        assert check(made(driver), "output_speed_error").status == "pass"


def test_where_no_standard_pulley_meets_the_speed_one_turned_to_measure_is_named() -> None:
    """A ratio of 1.0225 lies between equal pulleys and neighbours of R40."""
    vbelt = {"driver_diameter": 100.0, "center_distance": 1200}
    told = check(train(gears=[], output_speed=1450 / 1.0225, vbelt=vbelt), "output_speed_error")
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
