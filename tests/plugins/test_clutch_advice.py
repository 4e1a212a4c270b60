"""The clutch's advice: typed in as it is printed it makes its check pass, and breaks no other one."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.machine.calculation import Impossible
from tests.machines import number
from tests.plugins.clutches import BASE, checks, clutch

NUMBER = r"\d+(?:\.\d+)?(?:e-?\d+)?(?:°| 1/h| r/min| mm)?"
SET = re.compile(
    rf"set (?P<key>\w+) to (?:at least|at most|between) (?P<low>{NUMBER})(?: and (?P<high>{NUMBER}))?"
    rf"(?: with shoe_width: (?P<width>{NUMBER}))?"
)
KEYS = st.fixed_dictionaries(
    {
        "service_factor": st.just(1),
        "shoe_radius": st.floats(20, 300),
        "shoe_friction": st.floats(0.1, 0.8),
        "wedge_angle": st.floats(1, 40),
        "wedge_friction": st.floats(0, 0.6),
        "shoe_coverage": st.floats(0.3, 1),
        "engagements_per_hour": st.floats(1, 2000),
        "driven_inertia": st.floats(0.01, 10),
        "wear_allowance": st.floats(0, 3),
    },
    optional={
        "shoe_width": st.floats(5, 400),
        "radial_gap": st.floats(0.1, 3),
        "available_travel": st.floats(1, 50),
        "allowable_power_density": st.floats(0.05, 5),
        "allowable_pv": st.floats(0.1, 10),
        "allowable_temperature_rise": st.floats(1, 300),
    },
)
TORQUES = st.one_of(
    st.fixed_dictionaries({"torque": st.floats(10, 3000)}, optional={"speed": st.floats(20, 1500)}),
    st.fixed_dictionaries({"power": st.floats(1, 50), "speed": st.floats(20, 1500)}),
)


def advised(message: str) -> list[dict[str, Any]]:
    """Each change that a message names, as the keys to type."""
    found = []
    for part in SET.finditer(message):
        beside = {"shoe_width": part["width"]} if part["width"] else {}
        found += [{part["key"]: end, **beside} for end in (part["low"], part["high"]) if end]
    return [{key: str(value).replace("°", " deg") for key, value in change.items()} for change in found]


def good(found: dict[str, dict[str, Any]]) -> set[str]:
    """The checks that pass."""
    return {name for name, check in found.items() if check["status"] == "pass"}


@given(keys=KEYS, torque=TORQUES)
def test_every_advice_makes_its_check_pass_and_breaks_no_other(keys: dict[str, Any], torque: dict[str, Any]) -> None:
    found = checks(clutch(keys | torque))
    for name, check in found.items():
        for change in advised(check["message"]) if check["status"] == "fail" else []:
            again = checks(clutch(keys | torque | change))
            assert again[name]["status"] == "pass", (check["message"], change)
            broken = good(found) - good(again)
            assert not broken, (check["message"], change, {b: again[b]["message"] for b in broken})


@given(alpha=st.floats(46, 89.9), friction=st.floats(0.01, 0.99))
def test_a_wedge_that_jams_lifts_with_what_is_told(alpha: float, friction: float) -> None:
    keys = {"torque": 300, "shoe_radius": 120, "wedge_angle": alpha, "wedge_friction": friction}
    try:
        clutch(keys)
    except Impossible as refused:
        changes = advised(refused.message)
        assert [set(change) for change in changes] == [{"wedge_angle"}, {"wedge_friction"}]
        for change in changes:
            clutch(keys | change)


@pytest.mark.parametrize("friction", [0.05, 0.1, 0.123, 0.2])
def test_a_self_locking_wedge_is_told_what_to_change(friction: float) -> None:
    message = checks(clutch(wedge_angle="2.3 deg", wedge_friction=friction))["releases"]["message"]
    changes = advised(message)
    assert [set(change) for change in changes] == [{"wedge_angle"}, {"wedge_friction"}]
    for change in changes:
        again = clutch(BASE | {"wedge_angle": "2.3 deg", "wedge_friction": friction} | change)
        assert checks(again)["releases"]["status"] == "pass"
        assert number(again, "wedge_slope") == pytest.approx(number(again, "wedge_friction"), rel=3e-3)


def test_a_limit_that_rounding_would_miss_is_rounded_up() -> None:
    """Two millimetres in 8.695: 12.9533 degrees, which 12.95 is below."""
    keys = {"radial_gap": "0.4 mm", "wear_allowance": "1.6 mm", "available_travel": "8.695 mm"}
    message = checks(clutch(BASE | keys))["axial_travel"]["message"]
    assert "set wedge_angle to at least 12.96°" in message


def test_a_travel_that_no_wedge_makes_short_enough_is_told_so() -> None:
    keys = {"radial_gap": "2 mm", "wear_allowance": "2 mm", "available_travel": "0.1 mm"}
    message = checks(clutch(BASE | keys))["axial_travel"]["message"]
    assert "no angle alone helps" in message and "wedge_angle to" not in message and "wear_allowance to" not in message


def test_the_speed_is_no_advice_where_the_power_is_given() -> None:
    """The torque of a power grows as the speed falls: pressure times speed stays."""
    keys = {"shoe_radius": 120, "wedge_angle": 10, "speed": 600, "allowable_pv": 0.2}
    assert "set speed" in checks(clutch(keys | {"torque": 300}))["pv"]["message"]
    assert "set speed" not in checks(clutch(keys | {"power": 15}))["pv"]["message"]


def test_shoes_that_nobody_builds_are_no_advice() -> None:
    keys = {"shoe_radius": 50, "wedge_angle": 10, "speed": 600, "torque": 3e6, "allowable_pv": 0.2}
    found = checks(clutch(keys))
    for name in ("width_ratio", "pv"):
        assert "design for less torque" in found[name]["message"]
        assert not [change for change in advised(found[name]["message"]) if "shoe_radius" in change]
