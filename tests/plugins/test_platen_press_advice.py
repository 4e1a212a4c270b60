"""The platen press's advice: typed in as it is printed it makes its check pass, and breaks no other one."""

from __future__ import annotations

import re
from typing import Any

from hypothesis import assume, given
from hypothesis import strategies as st

from diecut_report.machine.calculation import Impossible
from tests.examples import examples
from tests.plugins.platens import GUIDED, checks, platen

SET = re.compile(r"set (\w+) to at (?:least|most) ([\d.]+(?:e-?\d+)? (?:mm²|mm|kN))")
STRETCH = st.one_of(
    st.fixed_dictionaries({"drive_deformation": st.floats(0.05, 3)}),
    st.fixed_dictionaries({"rod_area": st.floats(200, 5000), "elastic_modulus": st.floats(70, 220)}),
)
KEYS = st.fixed_dictionaries(
    {
        "cycles_per_hour": st.floats(100, 6000),
        "platen_mass": st.floats(0, 2000),
        "material_thickness": st.floats(0.1, 3),
        "rod_length": st.floats(130, 1500),
        "cutting_force_max": st.floats(50, 1500),
        "friction": st.floats(0.005, 0.3),
        "allowable_torque": st.floats(50, 20_000),
        "allowable_pin_pressure": st.floats(2, 60),
        "journal_length": st.floats(40, 200),
        "crank_pin_length": st.floats(40, 200),
        "platen_pin_length": st.floats(40, 200),
    }
)


def advised(message: str) -> dict[str, str]:
    """What a message tells to type."""
    return {key: value.replace("mm²", "mm**2") for key, value in SET.findall(message)}


@given(keys=KEYS, stretch=STRETCH, guides=st.sampled_from([{}, GUIDED, GUIDED | {"offset_weight": "300 mm"}]))
@examples(30)
def test_what_is_advised_makes_the_check_pass_and_breaks_no_other(
    keys: dict[str, Any], stretch: dict[str, Any], guides: dict[str, Any]
) -> None:
    machine = {**keys, **stretch, **guides}
    try:
        before = checks(platen(**machine))
    except Impossible:
        assume(False)
    for name, check in before.items():
        change = advised(check["message"])
        if not change:
            continue
        after = checks(platen(**(machine | change)))
        assert after[name]["status"] == "pass"
        broken = {
            other for other, found in after.items() if found["status"] != "pass" and before[other]["status"] == "pass"
        }
        assert not broken


def test_each_failing_check_names_what_to_type() -> None:
    lengths = {"journal_length": 50, "crank_pin_length": 50, "platen_pin_length": 50, "allowable_pin_pressure": 10}
    found = checks(platen(allowable_torque=5000, drive_deformation=0.6, **lengths))
    named = {name: set(advised(check["message"])) for name, check in found.items() if check["status"] == "fail"}
    assert named == {
        "torque_sign": {"drive_deformation"}, "torque_max": {"cutting_force_max"}, "contact_stress_journal": {"journal_length"},
        "contact_stress_crank_pin": {"crank_pin_length"}, "contact_stress_platen_pin": {"platen_pin_length"}}  # fmt: skip
    rods = checks(platen(rod_area=300, elastic_modulus=210))["torque_sign"]
    assert set(advised(rods["message"])) == {"rod_area"}


def test_no_number_is_advised_where_none_helps() -> None:
    idle = checks(platen(cycles_per_hour=70_000, allowable_torque=3000))["torque_max"]["message"]
    assert not advised(idle) and "slower machine" in idle
    loose = checks(platen(friction=0))["torque_sign"]["message"]
    assert not advised(loose) and "check friction" in loose
