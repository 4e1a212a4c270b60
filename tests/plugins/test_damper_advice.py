"""The advice of the rubber damper: what a failing check tells to change makes all checks pass when it is typed in."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.formulas import Array
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.damper import MECHANISM
from diecut_report.quantities.formatting import outward
from tests.examples import examples
from tests.machines import inputs
from tests.plugins.dampers import calculated, checks, passing, told
from tests.validation.rows_damper import damper

AT = r" with adopted_length: (?P<at>[\d.]+ mm)"
SET = re.compile(
    r"set (?P<key>\w+) to (?:between )?(?P<low>[\d.]+(?: mm| MPa)?)(?: and (?P<high>[\d.]+(?: mm| MPa)?))?"
    rf"(?:(?P<out> and leave adopted_length out)|{AT})?"
)
DAMPERS = re.compile(r"take (?P<count>\d+) dampers of this pad" + AT)
PAD = re.compile(r"take a pad of at least (?P<side>[\d.]+ mm) by [\d.]+ mm" + AT)


def advised(message: str) -> list[dict[str, Any]]:
    """Each change that a message names, as the keys to type; None for a key to leave out."""
    found: list[dict[str, Any]] = []
    for part in SET.finditer(message):
        beside = {"adopted_length": part["at"]} if part["at"] or part["out"] else {}
        found += [{part["key"]: end, **beside} for end in (part["low"], part["high"]) if end]
    found += [{"damper_count": int(m["count"]), "adopted_length": m["at"]} for m in DAMPERS.finditer(message)]
    found += [
        {"ring_width": m["side"], "pad_height": m["side"], "adopted_length": m["at"]} for m in PAD.finditer(message)
    ]
    return found + ([{"adopted_length": None}] if ", or leave adopted_length out" in message else [])


def fits(keys: dict[str, Any], **varied: Array) -> Array:
    """Whether all that is checked keeps its limits (to 1e-9), for each of several values of an input."""
    count = len(next(iter(varied.values()))) if varied else 1
    calc = calculate(MECHANISM, inputs(MECHANISM, keys) | varied, variants=count)
    limits = {"stress": "allowable_stress", "strain": "max_strain", "driven_stress": "allowable_stress",
              "driven_strain": "max_strain"}  # fmt: skip
    good = calc["adopted_length"] <= 3 * np.minimum(calc["ring_width"], calc["pad_height"]) * (1 + 1e-9)
    for name, limit in limits.items():
        if name in calc.values:
            good = good & (calc[name] <= calc[limit] * (1 + 1e-9))
    return np.broadcast_to(good[:, 0], count)


BLOCKS = st.fixed_dictionaries(
    {
        "kinetic_energy": st.floats(1, 500),
        "allowable_stress": st.floats(0.3, 3),
        "ring_width": st.floats(10, 150),
        "pad_height": st.floats(10, 150),
        "damper_count": st.integers(1, 6),
        "max_strain": st.floats(0.05, 0.4),
        "length_step": st.sampled_from([5, 1, 2.5, 0.3, 40]),
    },
    optional={
        "adopted_length": st.floats(10, 600),
        "drive": st.fixed_dictionaries({"force": st.floats(10, 5000)}),
        "dynamic_stiffness_factor": st.floats(1, 3),
    },
)
RUBBERS = st.one_of(
    st.fixed_dictionaries({"elastic_modulus": st.floats(0.5, 30)}),
    st.fixed_dictionaries({"shore_hardness": st.floats(20, 80)}),
)
LENGTHS = np.geomspace(1e-3, 3, 800)


@examples(50)
@given(block=BLOCKS, rubber=RUBBERS)
def test_every_advice_makes_all_checks_pass_and_what_does_not_help_does_not(
    block: dict[str, Any], rubber: dict[str, Any]
) -> None:
    keys = block | rubber
    for message in failing(keys):
        for change in advised(message):
            again = {key: value for key, value in (keys | change).items() if value is not None}
            assert len(passing(calculated(again))) == len(checks(calculated(again))), (message, change)
            assert change.get("damper_count", 1 + block["damper_count"]) > block["damper_count"]
        assert ("no adopted_length" in message) is not any(set(c) == {"adopted_length"} for c in advised(message))
        if "no adopted_length" in message:
            assert not fits(keys | {"adopted_length": 1}, adopted_length=LENGTHS).any()
        if re.search(r"no .*(elastic_modulus|shore_hardness)", message):
            assert not fits(keys, **swept(*rubber)).any()


def swept(key: str) -> dict[str, Array]:
    """Rubbers of all kinds, by the key that is given."""
    return {key: np.linspace(20, 80, 400) if key == "shore_hardness" else np.geomspace(1e4, 1e9, 800)}


@given(block=BLOCKS, modulus=st.floats(0.5, 30))
def test_the_lengths_the_number_and_the_pad_that_are_told_are_the_least(block: dict[str, Any], modulus: float) -> None:
    keys = block | {"elastic_modulus": modulus}
    for change in advised(next(iter(failing(keys)), "")):
        free = keys | {"adopted_length": 1}
        match change:
            case {"damper_count": count}:
                shorter = min(block["ring_width"], block["pad_height"]) * 3e-3 * np.linspace(0.01, 1 - 1e-3, 500)
                assert not fits(free | {"damper_count": count - 1}, adopted_length=shorter).any()
            case {"ring_width": side}:
                smaller = (float(side.split()[0]) - block["length_step"]) * (1 - 0.01)
                pad = {"ring_width": smaller, "pad_height": smaller}
                assert smaller <= 0 or not fits(free | pad, adopted_length=LENGTHS).any()


@given(block=BLOCKS, modulus=st.floats(0.5, 30))
def test_the_lengths_and_moduli_that_are_told_are_the_limits(block: dict[str, Any], modulus: float) -> None:
    keys = block | {"elastic_modulus": modulus}
    for message in failing(keys):
        for part in SET.finditer(message):
            low, high = (float((part[end] or part["low"]).split()[0]) for end in ("low", "high"))
            if part["key"] == "adopted_length":
                assert not fits(keys | {"adopted_length": 1}, adopted_length=np.array([low / 1e3 * 0.999]))[0]
                assert high == pytest.approx(3 * min(block["ring_width"], block["pad_height"]), rel=1e-3)
            elif "adopted_length" in block and not part["out"] and not part["at"]:
                assert not fits(keys, elastic_modulus=np.array([low * 0.98, high * 1.02]) * 1e6).any()


def failing(keys: dict[str, Any]) -> list[str]:
    """What the failing checks of a damper say is to be changed."""
    return sorted({c["message"].split("; ", 1)[1] for c in checks(calculated(keys)).values() if c["status"] == "fail"})


SOFT: dict[str, Any] = {
    "mass": "80 kg", "inertia": "0.973 kg*m**2", "rolling_radius": "105 mm", "velocity": "0.6 m/s",
    "ring_width": "60 mm", "pad_height": "60 mm", "carriage_mass": "0 kg", "static_unbalance": "0 kg*m", "contact_distance": "0 mm",
}  # fmt: skip


def test_a_hardness_is_told_where_a_hardness_is_given() -> None:
    """Sized again the block strains by [σ]/E, which asks for 5 MPa: 67.6 Shore A."""
    for hardness in (20, 50):
        message = told(calculated(SOFT | {"shore_hardness": hardness}), "strain")
        assert "set shore_hardness to between 68 and 80" in message
        assert "elastic_modulus" not in message


def test_the_rubber_that_is_told_is_that_of_the_length_sized_again() -> None:
    message = told(calculated(SOFT | {"elastic_modulus": "2.7 MPa"}), "strain")
    energy = (80 + 0.973 / 0.105**2) * 0.6**2 / 2
    stiffest = 0.18 * 2 * 0.06**2 * 1e12 / (2 * energy)  # the sized length is then three sides
    assert f"set elastic_modulus to between 5 MPa and {np.floor(stiffest / 1e5) / 10} MPa" in message


def test_where_the_given_length_serves_no_rubber_it_is_to_be_left_out() -> None:
    message = told(calculated(SOFT | {"shore_hardness": 20, "adopted_length": "292 mm"}), "slenderness")
    assert "set shore_hardness to between 68 and 80 and leave adopted_length out" in message


@pytest.mark.parametrize(
    "changes", [{"pad_height": "1e-9 mm"}, {"kinetic_energy": "1e40 J"}, {"elastic_modulus": 1e90}]
)
def test_an_absurd_damper_gets_no_absurd_advice(changes: dict[str, Any]) -> None:
    message = told(damper(**changes), "slenderness")
    assert not re.search(r"\d{5}", message.split("; ", 1)[1])


def test_what_no_damper_takes_up_is_told_so() -> None:
    message = told(damper(kinetic_energy="1e40 J"), "slenderness")
    assert "check kinetic_energy and allowable_stress: no adopted_length or elastic_modulus helps" in message
    assert not advised(message)


@given(value=st.floats(1e-9, 1e9))
def test_advice_is_rounded_to_the_safe_side(value: float) -> None:
    assert value * 0.989 <= outward(value, up=False) <= value * (1 + 1e-8)
    assert value * (1 - 1e-8) <= outward(value, up=True) <= value * 1.011
