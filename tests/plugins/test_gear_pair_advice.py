"""The gear pair's advice: typed in as it is printed it makes its check pass."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.machine.calculation import Impossible
from tests.examples import examples
from tests.machines import number
from tests.plugins.gears import HELICAL, SECTOR, SPUR, STEEL, checks, pair

SET = re.compile(r"set (?P<key>[\w.]+) to (?:at least |at most )?(?P<value>-?\d+(?:\.\d+)?(?: MPa| mm)?|true)")
KEYS = st.fixed_dictionaries(
    {
        "module": st.sampled_from([2, 3, 4]),
        "teeth_1": st.integers(12, 30),
        "teeth_2": st.integers(31, 90),
        "helix_angle": st.sampled_from([0, 12, 20]),
        "shift_1": st.floats(-0.4, 0.4),
        "face_width": st.floats(10, 60),
        "torque": st.floats(5, 900),
        "dedendum": st.sampled_from([1.05, 1.25]),
        "shift_2": st.floats(-0.3, 0.5),
    }
)


def advised(message: str) -> list[dict[str, Any]]:
    """Each change that a message names, as the key to type; those joined by "and" together."""
    return [{part["key"]: part["value"] == "true" or part["value"] for part in SET.finditer(each)} for each in message.split(", or ")
            if SET.search(each)]  # fmt: skip


@pytest.mark.nightly
@given(keys=KEYS)
@examples(15)
def test_every_advice_makes_its_check_pass(keys: dict[str, Any]) -> None:
    keys = STEEL | keys
    try:
        found = checks(pair(keys))
    except Impossible:
        return
    for name, check in found.items():
        for change in advised(check["message"]) if check["status"] in ("fail", "warn") else []:
            again = checks(pair(keys | change))
            assert again[name]["status"] == "pass", (check["message"], change)


def test_a_flank_that_fails_is_told_steel_width_and_module() -> None:
    keys = HELICAL | {"torque": 420}
    message = checks(pair(keys))["pitting_1"]["message"]
    assert [set(change) for change in advised(message)] == [{"sigma_h_lim_1"}, {"face_width"}, {"module"}]
    sized = pair({key: value for key, value in keys.items() if key != "module"})
    assert f"set module to {number(sized, 'module') * 1e3:g} mm" in message


def test_roots_that_fail_are_told_what_holds() -> None:
    keys = SPUR | {"sigma_f_lim_1": 60, "sigma_f_lim_2": 55}
    for gear in (1, 2):
        message = checks(pair(keys))[f"root_{gear}"]["message"]
        assert len(advised(message)) == 3
        for change in advised(message):
            assert checks(pair(keys | change))[f"root_{gear}"]["status"] == "pass", change


def test_a_sector_with_too_few_teeth_is_told_how_many_it_needs() -> None:
    keys = SECTOR | {"sector": {"swing": "59.4576 deg", "teeth_present": 37}}
    check = checks(pair(keys))["sector_teeth"]
    assert check["status"] == "fail" and "set sector.teeth_present to at least 38" in check["message"]
    assert (
        checks(pair(SECTOR, sector={"swing": "59.4576 deg", "teeth_present": 38}))["sector_teeth"]["status"] == "pass"
    )
    assert checks(pair(SECTOR, sector={"swing": "59.4576 deg"}))["sector_teeth"]["status"] == "not_checked"


@pytest.mark.parametrize("distance", [176, 171.5])
def test_at_a_given_distance_the_pinion_s_shift_is_advised(distance: float) -> None:
    keys = STEEL | {
        "module": 4,
        "teeth_1": 16,
        "teeth_2": 70,
        "face_width": 40,
        "torque": 100,
        "center_distance": distance,
        "shift_1": -0.2,
    }
    check = checks(pair(keys))["undercut"]
    assert check["status"] == "warn" and "set shift_1 to at least" in check["message"]
    [change] = advised(check["message"])
    assert checks(pair(keys | change))["undercut"]["status"] == "pass"


@pytest.mark.parametrize(
    ("change", "raises"),
    [({"teeth_2": 80}, True), ({"addendum": 1.1}, True), ({"shift_1": 0.3}, True), ({"shift_1": 0.8}, False)],
)
def test_what_the_contact_ratio_s_advice_names_raises_it(change: dict[str, Any], raises: bool) -> None:
    keys = STEEL | {
        "module": 4,
        "teeth_1": 14,
        "teeth_2": 30,
        "face_width": 40,
        "torque": 100,
        "shift_1": 0.6,
        "shift_2": 0.6,
    }
    assert (number(pair(keys | change), "contact_ratio") > number(pair(keys), "contact_ratio")) is raises


def test_a_notch_that_is_too_sharp_is_told_the_radius() -> None:
    keys = SPUR | {"root_radius": 0.05, "teeth_1": 60, "teeth_2": 80, "shift_1": 1.1}
    check = checks(pair(keys))["notch_parameter"]
    assert check["status"] == "warn" and "a greater root_radius lowers" in check["message"]
    assert checks(pair(keys | {"root_radius": 0.3}))["notch_parameter"]["status"] == "pass"
