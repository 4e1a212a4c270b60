"""Parallel keys against the sheet's numbers, moments of pressures summed up, brute force over lengths, and bad input."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.parallel_key import MECHANISM
from diecut_report.plugins.parallel_key.steps import KEYS, LENGTHS
from tests.examples import examples
from tests.machines import advised, checks, inputs, number, statuses
from tests.plugins.bearings import Over
from tests.plugins.keys import KEY, OWN, SIZED, TURNING, key

STRENGTH = ("pressure_shaft", "pressure_hub", "pressure_key", "pressure_peak", "shear")
DRAWN = st.fixed_dictionaries(
    {
        "shaft_diameter": st.floats(10.5, 200),
        "form": st.sampled_from(["A", "B"]),
        "key_count": st.sampled_from([1, 2]),
        "torque": st.floats(1, 3000),
        "application_factor": st.floats(1, 2),
        "yield_shaft": st.floats(200, 900),
        "yield_hub": st.floats(150, 900),
        "yield_key": st.floats(300, 600),
        "load_direction_factor": st.floats(0.5, 1),
        "load_peak_factor": st.floats(1, 1.5),
        "load_distribution_factor": st.floats(1, 2),
    }
)


# --- the sheet's numbers ---------------------------------------------------------------------------------------------


def test_a_second_key_takes_three_quarters_as_much_and_nine_tenths_at_the_peak() -> None:
    one, two = key(), key(key_count=2)
    for name, share in (
        ("pressure_shaft", 1.5),
        ("pressure_hub", 1.5),
        ("pressure_key_peak", 1.8),
        ("shear_stress", 1.8),
    ):
        assert number(two, name) == pytest.approx(number(one, name) / share, rel=1e-14)


def test_two_keys_of_43_mm_press_as_the_public_code_says() -> None:
    keys = {"shaft_diameter": 30, "form": "A", "key_length": 43, "key_count": 2, "torque": 535.93, "application_factor": 1.75,
            "yield_shaft": 900, "yield_hub": 900, "yield_key": 900, "load_distribution_factor": 1}  # fmt: skip
    assert number(key(keys), "pressure_hub") == pytest.approx(396.985e6, rel=1e-6)
    assert statuses(key(keys | {"yield_hub": 264.7}))["pressure_hub"] == "pass"  # 396.985 MPa / 1.5
    assert statuses(key(keys | {"yield_hub": 264.6}))["pressure_hub"] == "fail"
    assert statuses(key(keys | {"yield_key": 360.9}))["pressure_key"] == "pass"  # 396.985 MPa / 1.1
    assert statuses(key(keys | {"yield_key": 360.8}))["pressure_key"] == "fail"


# --- changes of flank ------------------------------------------------------------------------------------------------

LIFE = {"required_life": "20000 h", "cycle_speed": "50 rpm"}


@pytest.mark.parametrize(("changed", "factor"), [(0, 1), (1024, 1), (1025, 0.99990), (1e5, 0.63246), (1e10, 0.2)])
def test_seldom_changes_of_flank_do_not_count(changed: float, factor: float) -> None:
    assert number(key(flank_changes=changed), "direction_factor") == pytest.approx(factor, rel=1e-5)


def test_a_torque_that_keeps_its_sign_keeps_its_flank() -> None:
    calc = key(TURNING | {"torque_curve": [494, 100, 20, 300]} | LIFE)
    assert number(calc, "changes_of_flank") == 0 and number(calc, "direction_factor") == 1
    assert number(key(**LIFE), "direction_factor") == 1


def turning_with(rate: float, **more: Any) -> Calculation:
    """A key under a torque that changes its sign twice in each turn, of a shaft of this speed in rpm."""
    torque = Over(lambda angle: 494 * np.cos(angle), rate=np.array([[rate * np.pi / 30]]))
    return calculate(MECHANISM, inputs(MECHANISM, TURNING | {"torque_curve": torque} | more))


@pytest.mark.parametrize(
    ("rate", "typed", "words"),
    [
        (50, {"required_life": "20000 h", "cycle_speed": "0.001 rpm"}, "comes again with 50"),
        (50, {"required_life": "20000 h", "cycle_speed": "50.1 rpm"}, "comes again with 50"),
        (50, {"flank_changes": 0}, "2 times a cycle"),
        (50, {"flank_changes": 1.19e7}, "1.2e7 times"),  # 2 · 50/min · 2000 h
        (0, {"flank_changes": 1}, "at least 2 times"),
    ],
)
def test_what_is_typed_does_not_contradict_the_curve(rate: float, typed: dict[str, Any], words: str) -> None:
    with pytest.raises(Impossible) as refused:
        turning_with(rate, **typed)
    assert refused.value.key == list(typed)[-1] and words in refused.value.message


@pytest.mark.parametrize("typed", [LIFE, {"flank_changes": 1.2e7}, {"flank_changes": 1e9}], ids=str)
def test_what_agrees_with_the_curve_is_taken(typed: dict[str, Any]) -> None:
    assert number(turning_with(50, **typed), "changes_of_flank") >= 1.2e7


@pytest.mark.parametrize(("factor", "status"), [(0.3922, "warn"), (0.3916, "pass")])
def test_a_factor_beyond_that_of_the_curve_is_told(factor: float, status: str) -> None:
    """By hand: 2 · (1.2·10⁷)^−0.1 = 0.3920."""
    assert statuses(turning_with(50, load_direction_factor=factor))["reversing"] == status


def test_life_and_a_factor_of_its_own_exclude_each_other() -> None:
    faults = [rule.fault((*KEY, *LIFE, "load_direction_factor")) for rule in MECHANISM.inputs.one_of]
    assert any("load_direction_factor" in fault and "required_life" in fault for fault in faults)


def test_an_uneven_load_presses_as_much_more() -> None:
    assert number(key(), "pressure_hub") == pytest.approx(1.2 * number(key(load_distribution_factor=1), "pressure_hub"))
    assert number(key(), "shear_stress") == number(key(load_distribution_factor=1), "shear_stress")


def test_in_every_row_the_hub_bears_less_than_the_shaft_and_the_key_has_play() -> None:
    for d, b, h, t1, t2 in zip(*(KEYS.column(name).values for name in ("d", "b", "h", "t1", "t2")), strict=True):
        assert h - t1 < t1 and 0.2 - 1e-9 <= t1 + t2 - h <= 0.4 + 1e-9 and b < d


@pytest.mark.parametrize(("diameter", "width"), [(10.01, 4), (12, 4), (12.001, 5), (38, 10), (38.1, 12), (200, 45)])
def test_a_diameter_at_the_end_of_a_row_belongs_to_it(diameter: float, width: float) -> None:
    assert number(key(shaft_diameter=diameter, key_length=100), "width") == pytest.approx(width / 1e3)


# --- by other ways ---------------------------------------------------------------------------------------------------


@given(keys=DRAWN)
@examples(25)
def test_pressures_summed_over_the_key_carry_the_torque(keys: dict[str, Any]) -> None:
    """Slices of the bearing length, each with its force at half the diameter; two keys together carry one and a half."""
    calc = key(KEY | keys | {"key_length": 140})
    slices = np.full(1000, number(calc, "bearing_length") / 1000)
    shared = {1: 1.0, 2: 1.5}[keys["key_count"]]
    for part, height in (("shaft", "height_shaft"), ("hub", "height_hub")):
        moment = (
            np.sum(number(calc, f"pressure_{part}") / keys["load_distribution_factor"] * number(calc, height) * slices)
            * keys["shaft_diameter"]
            / 2e3
            * shared
        )
        assert moment == pytest.approx(keys["torque"] * keys["application_factor"], rel=1e-9)
    force = number(calc, "shear_stress") * number(calc, "width") * number(calc, "bearing_length")
    assert force * keys["shaft_diameter"] / 2e3 * {1: 1.0, 2: 1.8}[keys["key_count"]] == pytest.approx(
        keys["torque"], rel=1e-9
    )


@given(keys=DRAWN)
@examples(12)
def test_the_length_is_the_least_standard_one_that_holds(keys: dict[str, Any]) -> None:
    given_keys = {name: value for name, value in KEY.items() if name != "key_length"} | keys
    try:
        sized = key(given_keys)
    except Impossible:
        assert not _holds(given_keys, 280)
        return
    length = number(sized, "key_length") * 1e3
    assert _holds(given_keys, length)
    shorter = [each for each in LENGTHS.values if each < length - 1e-6]
    assert not shorter or not _holds(given_keys, shorter[-1])


def _holds(keys: dict[str, Any], length: float) -> bool:
    """Whether a key of this length passes, by the pressures as a sheet writes them."""
    row = int(np.searchsorted(KEYS.column("d").values, keys["shaft_diameter"]))
    b, h, t1 = (KEYS.column(name).values[row] for name in ("b", "h", "t1"))
    bearing = length - b if keys["form"] == "A" else length
    if bearing <= 0:
        return False
    one = 2e3 * keys["torque"] / keys["shaft_diameter"]
    regular_force, peak = (one / (1 if keys["key_count"] == 1 else share) for share in (1.5, 1.8))
    spread = keys["load_distribution_factor"]
    limits = [
        (t1, 1.3 * keys["yield_shaft"]),
        (h - t1, 1.5 * keys["yield_hub"]),
        (min(t1, h - t1), 1.1 * keys["yield_key"]),
    ]
    regular = all(
        spread * keys["application_factor"] * regular_force / (height * bearing)
        <= keys["load_direction_factor"] * limit
        for height, limit in limits
    )
    rare = all(spread * peak / (height * bearing) <= keys["load_peak_factor"] * limit for height, limit in limits)
    return regular and rare and peak / (b * bearing) <= keys["yield_key"] / sqrt(3)


# --- load, own dimensions, checks ------------------------------------------------------------------------------------


def test_a_curve_counts_with_its_greatest_size_and_no_factor() -> None:
    calc = key(TURNING)
    assert number(calc, "torque_equivalent") == pytest.approx(494.11) and bool(calc["reversing"][0, 0])
    assert statuses(calc)["two_keys"] == "warn"
    assert statuses(key(TURNING, load_direction_factor=0.9))["reversing"] == "pass"
    assert "two_keys" not in checks(key(key_count=2))


def test_a_rare_peak_presses_against_its_own_limit() -> None:
    calc = key(KEY | {"torque_peak": 900, "load_peak_factor": 1.5})
    assert number(calc, "pressure_hub_peak") == pytest.approx(900 / 494 * number(calc, "pressure_hub"))
    assert number(calc, "safety_hub_peak") == pytest.approx(1.5 * 1.5 * 370e6 / number(calc, "pressure_hub_peak"))


def test_a_peak_that_is_the_torque_itself_is_taken() -> None:
    assert number(key(torque_peak=494), "key_force_peak") == pytest.approx(number(key(), "key_force"), rel=1e-14)


@pytest.mark.parametrize(("diameter", "length", "pressure"), [(50, 50, 238.8), (55, 70, 126.7)])
def test_an_engagement_of_the_clutch_presses_as_the_sheet_says(diameter: float, length: float, pressure: float) -> None:
    calc = key(
        KEY, shaft_diameter=diameter, key_length=length, load_distribution_factor=1, load_cases=[{"name": "engage", "torque": 752.3}]
    )  # fmt: skip
    assert number(calc, "pressure_key_peak") / 1e6 == pytest.approx(pressure, abs=0.1)
    assert number(calc, "allowed_key_peak") / 1e6 == pytest.approx(368.5)
    assert number(calc, "pressure_key") == pytest.approx(494 / 752.3 * number(calc, "pressure_key_peak"))


CASES = [{"name": "start", "torque": 600}, {"name": "engage", "torque": 4000}]


def test_the_load_case_with_the_greatest_torque_governs_and_is_named() -> None:
    assert number(key(load_cases=CASES), "torque_peak") == 4000
    check = checks(key(load_cases=CASES))["pressure_peak"]
    assert check.status == "fail" and "governing load case: engagement of the clutch" in check.message
    assert number(key(load_cases=CASES[:1], torque_peak=3000), "torque_peak") == 3000
    assert number(key(load_cases=[{"name": "stop", "torque": 10}]), "torque_peak") == 494
    assert key(load_cases=[{"name": "stop", "torque": 10}])["peak_case"][0, 0] == "run"


@pytest.mark.parametrize(
    "case", [{"name": "brake", "torque": 10}, {"name": "stop", "torque": -10}, {"name": "stop"}, {"torque": 10}, "stop"]
)
def test_a_load_case_that_is_none_is_refused(case: Any) -> None:
    with pytest.raises(ValidationError):
        key(load_cases=[case])


def test_own_dimensions_and_a_chamfer_are_taken() -> None:
    calc = key(OWN)
    assert number(calc, "bearing_length") == pytest.approx(0.063)
    assert number(calc, "height_shaft") == pytest.approx(0.005) and number(calc, "height_hub") == pytest.approx(0.004)


def test_a_key_that_fails_is_told_the_length_that_holds() -> None:
    keys = KEY | {"key_length": 25}
    for name in ("pressure_hub", "pressure_key"):
        check = advised(key(keys, yield_hub=300))[name]
        assert check.status == "fail" and "Set key_length to" in check.message
    told = number(key(keys, yield_hub=300), "required_key_length") * 1e3
    again = checks(key(keys, yield_hub=300, key_length=told))
    assert {again[name].status for name in STRENGTH} == {"pass"}


def test_a_key_that_no_standard_length_saves_is_told_so() -> None:
    check = checks(key(torque=9000))["pressure_hub"]
    assert check.status == "fail" and "a thicker shaft" in check.message
    assert "required_key_length" not in key(torque=9000).values or np.isnan(
        key(torque=9000)["required_key_length"][0, 0]
    )


def test_practice_is_watched() -> None:
    found = checks(key(key_length=95, hub_length=80))
    assert [found[name].status for name in ("length_ratio", "standard_length", "hub_length")] == ["warn"] * 3
    assert statuses(key(SIZED))["standard_length"] == "pass"
    assert statuses(key())["hub_length"] == "not_checked"


@pytest.mark.parametrize("length", LENGTHS.values)
def test_each_standard_length_is_one(length: float) -> None:
    """36 mm as the series has them are the 36 mm that somebody types: no rounding lies between them."""
    assert statuses(key(key_length=length, form="B"))["standard_length"] == "pass"


@pytest.mark.parametrize(
    ("changes", "name", "words"),
    [
        ({"shaft_diameter": 10}, "shaft_diameter", "give width, height, depth_shaft and depth_hub"),
        ({"shaft_diameter": 201}, "shaft_diameter", "has no key"),
        ({"key_length": 14}, "key_length", "take a longer key, or form B"),
        ({"torque": 0}, "torque", "give the torque"),
        ({"torque_peak": 400}, "torque_peak", "less than the torque"),
        ({"chamfer": 4}, "chamfer", "leaves no height to bear"),
        ({"width": 15, "height": 5, "depth_shaft": 5.5, "depth_hub": 4}, "depth_shaft", "sinks whole"),
        ({"key_length": None, "torque": 9000}, "shaft_diameter", "the longest standard key"),
    ],
)
def test_what_no_key_can_be_is_refused_in_words(changes: dict[str, Any], name: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        key({each: value for each, value in (KEY | changes).items() if value is not None})
    assert refused.value.key == name and words in refused.value.message


@pytest.mark.parametrize(
    ("keys", "left_out"),
    [(KEY, 0), (TURNING, 1), (TURNING | {"load_direction_factor": 0.8}, 0), (TURNING | {"flank_changes": 1e6}, 0)],
    ids=["steady", "reversing", "given", "counted"],
)
def test_a_reversal_that_nothing_counts_is_told_and_only_that(keys: dict[str, Any], left_out: int) -> None:
    calc = key(keys)
    assert number(calc, "reversal_left_out") == left_out
    assert statuses(calc)["reversing"] == ("warn" if left_out else "pass")


REGULAR = ("pressure_shaft", "pressure_hub", "pressure_key")


def test_a_reversing_torque_without_a_life_gives_no_verdict_on_the_regular_pressures() -> None:
    """Judged as steady this key passes; so often as a press reverses it fails."""
    found = checks(key(TURNING, key_count=1))
    assert {found[name].status for name in REGULAR} == {"not_checked"}
    assert all(found[name].missing == ["required_life", "cycle_speed"] for name in REGULAR)
    assert found["pressure_peak"].status == found["shear"].status == "pass"  # no factor of reversals is in them
    assert {statuses(key(TURNING | LIFE, key_count=1))[name] for name in REGULAR} >= {"fail"}
    steady = checks(key(TURNING | {"torque_curve": [494.11, 130, 20, 50]}, key_count=1))
    assert {steady[name].status for name in REGULAR} == {"pass"}


def test_what_is_printed_of_a_reversing_torque_without_a_life_is_on_the_safe_side() -> None:
    assert number(key(TURNING), "direction_factor") == 0.2
    assert number(key(TURNING), "safety") < number(key(TURNING | LIFE), "safety")
    sized = {name: value for name, value in TURNING.items() if name != "key_length"}
    assert number(key(sized), "key_length") >= number(key(sized | LIFE), "key_length")


@pytest.mark.parametrize(
    "more", [LIFE, {"flank_changes": 1e6}, {"load_direction_factor": 0.4}], ids=lambda more: min(more)
)
def test_each_way_to_tell_the_reversals_makes_the_verdict(more: dict[str, Any]) -> None:
    found = checks(key(TURNING | more))
    assert {found[name].status for name in REGULAR} <= {"pass", "fail"}


@pytest.mark.parametrize("form", ["A", "B"])
def test_what_stands_out_of_the_hub_does_not_bear(form: str) -> None:
    """A key of 70 mm in a hub of 36 mm is pressed as one that bears on 36 mm: by hand K_λ·2·T/(d·h·l)."""
    within, short = key(key_length=70, hub_length=70, form=form), key(key_length=70, hub_length=36, form=form)
    assert number(short, "bearing_length") == pytest.approx(0.036)
    assert number(within, "bearing_length") == number(key(key_length=70, form=form), "bearing_length")
    ratio = number(within, "bearing_length") / 0.036
    for name in ("pressure_shaft", "pressure_hub", "pressure_key", "shear_stress"):
        assert number(short, name) == pytest.approx(number(within, name) * ratio)
    sized = checks(key(SIZED, hub_length=12))
    assert sized["pressure_key"].status == "fail" and sized["hub_length"].status == "warn"
