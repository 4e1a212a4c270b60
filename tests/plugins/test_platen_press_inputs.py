"""What the platen press takes: stretch or rods, one friction or a list, references, and what must be refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from diecut_report.config.plugins import Discovery
from diecut_report.config.schema import kind_schema
from diecut_report.errors import UserError
from diecut_report.machine.calculation import Impossible
from diecut_report.plugins.platen_press import MECHANISM
from diecut_report.press import Press
from tests.configs import HEAD, problems, saved
from tests.machines import number
from tests.plugins.platens import platen

R, ROD = 0.11, 0.635


def test_the_stretch_follows_from_two_rods() -> None:
    calc = platen(rod_area="3000 mm**2", elastic_modulus="210 GPa")
    assert number(calc, "drive_deformation") == pytest.approx(5e5 / 2 * 0.635 / (210e9 * 0.003), rel=1e-14)


def test_four_frictions_act_each_in_its_place() -> None:
    calc = platen(friction=[0.5, 0.02, 0.03, 0.05])
    lam = R / ROD
    arm = 0.02 * 0.06 * lam + 0.03 * 0.0475 * (1 - lam) + 0.05 * 0.05025
    assert number(calc, "friction_arm") == pytest.approx(arm, rel=1e-14)
    single = platen(friction=0.02, friction_guide=0.5, friction_crank_pin=0.03, friction_journal=0.05)
    assert number(single, "torque_max") == number(calc, "torque_max")
    assert number(platen(friction=[0.1] * 4), "torque_max") == number(platen(), "torque_max")
    assert "friction_limit" in platen().values and "friction_limit" not in calc.values


@pytest.mark.nightly
def test_a_list_of_frictions_may_hold_references_and_be_referred_to(tmp_path: Path) -> None:
    config = saved(tmp_path, HEAD + "  a: {kind: platen_press, friction: [0.1, 0.02, '${b.friction}', 0.05]}\n"
                   "  b: {kind: platen_press, friction: 0.03}\n  c: {kind: platen_press, friction: [0.1, 0.02, 0.03, 0.05]}\n"
                   "  d: {kind: platen_press, friction: ['${a.friction_guide}', '${c.friction_platen_pin}', 0.03, 0.05]}\n")  # fmt: skip
    found = Press.read(config, Discovery([])).calculate().results.mechanisms
    expected = number(platen(friction=[0.1, 0.02, 0.03, 0.05]), "friction_arm")
    assert [found[name].outputs["friction_arm"].value for name in "acd"] == [expected] * 3
    of_a = found["a"].inputs
    assert (
        of_a["friction_crank_pin"].with_(origin="reference", path="b.friction", text="${b.friction}")
        == of_a["friction_crank_pin"]
    )
    assert (of_a["friction_guide"].origin, of_a["friction_guide"].text) == ("given", "0.1")


@pytest.mark.parametrize(
    "value, words",
    [
        ("[0.1, '${b.nope}', 0.1, 0.1]", "p.friction.1: ${b.nope}: b has no 'nope'"),
        (
            "[0.1, '${b.rod_length}', 0.1, 0.1]",
            "p.friction.1: ${b.rod_length} is in m; a quantity in 1 is needed",
        ),
        ("[0.1, '${p.friction_journal}', 0.1, 0.1]", "p.friction.1: refers to itself"),
    ],
)
def test_a_wrong_reference_in_a_list_of_frictions_is_told_once(tmp_path: Path, value: str, words: str) -> None:
    blocks = f"  b: {{kind: platen_press}}\n  p: {{kind: platen_press, friction: {value}}}\n"
    found = problems(tmp_path, HEAD + blocks, Discovery([]))
    assert len(found) == 1 and words in found[0]


def test_a_list_with_references_is_referred_to_by_its_single_keys(tmp_path: Path) -> None:
    blocks = "  a: {kind: platen_press, friction: [0.1, '${b.friction}', 0.2, 0.3]}\n  b: {kind: platen_press, friction: 0.05}\n"
    single = saved(tmp_path, HEAD + blocks + "  c: {kind: platen_press, friction: '${a.friction_platen_pin}'}\n")
    found = Press.read(single, Discovery([])).calculate().results.mechanisms
    assert found["c"].inputs["friction"].value == 0.05
    whole = saved(tmp_path, HEAD + blocks + "  c: {kind: platen_press, friction: '${a.friction}'}\n")
    with pytest.raises(UserError, match=r"is a list; refer to one of its values \(friction_guide, friction_platen_pin"):
        Press.read(whole, Discovery([])).calculate()


def test_keys_without_a_value_and_four_single_frictions_leave_the_defaults_their_place() -> None:
    assert number(platen(drive_deformation=None, rod_area=None), "drive_deformation") == 4.5e-4
    single = {f"friction_{place}": 0.1 for place in ("guide", "platen_pin", "crank_pin", "journal")}
    calc = platen(**single)
    assert "friction" not in calc.inputs and number(calc, "torque_max") == number(platen(), "torque_max")


def test_the_schema_for_editors_takes_what_the_program_takes() -> None:
    known = Draft202012Validator(kind_schema(MECHANISM))
    for keys in ({}, {"drive_deformation": 0.3}, {"rod_area": 3000, "elastic_modulus": "210 GPa"}, {"friction": 0.2},
                 {"friction": [0.1, "0.2", "${b.friction}", 0]}):  # fmt: skip
        assert known.is_valid({"kind": "platen_press"} | keys)


@pytest.mark.parametrize(
    "keys, words",
    [
        (
            "rod_area: 3000",
            "elastic_modulus is missing beside rod_area; give drive_deformation, or rod_area and elastic_modulus",
        ),
        ("elastic_modulus: 210, rod_area: null", "rod_area is missing beside elastic_modulus"),
        (
            "rod_area: 3000, elastic_modulus: 210, drive_deformation: 0.4",
            "drive_deformation and rod_area are both given, but only one can hold",
        ),
        ("friction: [0.1]", "friction: has 1 value; give one for all, or 4"),
        ("friction: [0.1, 0.1, 2 mm, 0.1]", "friction.2: 2 mm is a length"),
        (
            "friction: [0.1, 0.1, 0.1, 0.1], friction_guide: 0.2",
            "friction: is a list for all of them, but friction_guide is given",
        ),
        ("friction: [0.1, 0.1, 0.1]", "friction: has 3 values; give one for all, or 4"),
        ("friction: [0.1, 0.1, -0.2, 0.1]", "friction.2: -0.2 is out of range; allowed: ≥ 0, ≤ 1"),
        ("friction: []", "friction: has no values; give one for all, or 4"),
        ("friction_guide: [0.1, 0.1, 0.1, 0.1]", "friction_guide: is a list; a number"),
    ],
)
def test_inputs_out_of_range_are_refused(tmp_path: Path, keys: str, words: str) -> None:
    found = problems(tmp_path, HEAD + f"  p: {{kind: platen_press, {keys}}}\n", Discovery([]))
    assert len(found) == 1 and words in found[0]


@pytest.mark.parametrize(
    "changes, key, words",
    [
        ({"rod_length": "100 mm"}, "rod_length", "longer than the crank's radius 110 mm"),
        ({"rod_length": "110 mm"}, "rod_length", "longer than the crank's radius"),
        ({"rod_length": "110.05 mm"}, "rod_length", "by a thousandth of it"),
        ({"material_thickness": "219.6 mm"}, "material_thickness", "less than the platen's stroke 220 mm"),
        ({"drive_deformation": "120 mm"}, "drive_deformation", "less than the crank_radius 110 mm"),
        ({"rod_area": "1 mm**2", "elastic_modulus": "210 GPa"}, "rod_area", "the rods stretch by 756.0 mm"),
        ({"offset_force": "5 mm"}, "guide_length", "presses on its guides"),
        ({"offset_weight": "-5 mm"}, "guide_length", "offset_weight = -5 mm"),
    ],
)
def test_an_impossible_press_is_refused_in_words(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        platen(**changes)
    assert refused.value.key == key
    assert words in refused.value.message.replace("−", "-")


def test_carriages_that_need_all_that_the_platen_opens_have_no_window() -> None:
    sizes = {
        "crank_radius": "0.125 m",
        "drive_deformation": "0.0078125 m",
    }  # 2r less the stretch: 0.2421875 m, exact in binary
    calc = platen(**sizes, carriage_clearance="0.242 m")
    assert number(calc, "window_start") < np.pi < number(calc, "window_end")
    with pytest.raises(Impossible, match="less than what the platen"):
        platen(**sizes, carriage_clearance="0.2421875 m")
