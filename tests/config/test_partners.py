"""What a kind takes from its partners by itself, and when it runs without being asked."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from diecut_report.config.model import texts
from diecut_report.config.plugins import Discovery
from diecut_report.mechanism.mechanism import Partner
from diecut_report.plugins.press_consistency import MECHANISM
from diecut_report.press import Press
from diecut_report.results.mechanism_record import MechanismRecord
from diecut_report.study.definition.base_inputs import find_input, with_values
from diecut_report.testing.contract import ContractTest
from tests.configs import DISCOVERY, HEAD, loaded, problems, saved
from tests.processes import Example

DRIVE = """\
  drive: {kind: cylinder_drive, cylinder_radius: 105 mm, cylinder_length: 700 mm, cylinder_mass: 80 kg, cylinder_inertia: 0.973 kg*m**2,
          material_thickness: 0.6 mm, cutting_force_per_length: 25 N/mm, ejection_force_per_length: 5 N/mm}
"""
CLUTCH = "  clutch: {kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg}\n"
CROSS = """\
  NAME: {kind: geneva_transport, center_distance: 240 mm, roller_radius: 16 mm, gear_ratio: 6, sprocket_teeth: 30, chain_pitch: 19.05 mm}
"""
TWO = CROSS.replace("NAME", "one") + CROSS.replace("NAME", "two").replace("gear_ratio: 6", "gear_ratio: 4")


def references(folder: Path, text: str, name: str = "press_consistency") -> dict[str, str]:
    """What the consistency takes, by its keys."""
    instance = loaded(folder, text).instances[name]
    assert instance is not None
    return {str(key[0]): taken for key, taken in texts(instance.data)}


def results(folder: Path, text: str) -> MechanismRecord:
    """The results of the consistency."""
    outcome = Press.read(saved(folder, text), DISCOVERY).calculate()
    return outcome.results.mechanisms["press_consistency"]


def test_two_partners_run_the_consistency_with_what_they_have(tmp_path: Path) -> None:
    taken = references(tmp_path, HEAD + DRIVE + CLUTCH)
    assert taken["drive"] == "drive"
    assert taken["cylinder_mass"] == "${drive.cylinder_mass}"
    assert taken["clutch_torque"] == "${clutch.design_torque}"
    assert "clutch_speed" not in taken, "the clutch has none"
    assert "sheet_step" not in taken


@pytest.mark.parametrize("text", [HEAD + CLUTCH, HEAD + DRIVE])
def test_a_single_mechanism_contradicts_no_other(tmp_path: Path, text: str) -> None:
    assert "press_consistency" not in loaded(tmp_path, text).instances


def test_a_block_of_the_kind_takes_the_place_of_the_one_that_runs_by_itself(tmp_path: Path) -> None:
    text = HEAD + "  whole: {kind: press_consistency, sheet_gap: 20 mm}\n" + DRIVE + CLUTCH
    assert "press_consistency" not in loaded(tmp_path, text).instances
    taken = references(tmp_path, text, "whole")
    assert taken["sheet_gap"] == "20 mm", "what no other has is given"
    assert taken["stroke"] == "${drive.stroke}"


@pytest.mark.parametrize("typed", ["90 kg", "{value: 90 kg, basis: measured}", "'${drive.cylinder_mass} + 1 kg'", "1"])
def test_what_is_compared_with_the_others_is_not_typed_beside_them(tmp_path: Path, typed: str) -> None:
    text = HEAD + f"  whole: {{kind: press_consistency, cylinder_mass: {typed}}}\n" + DRIVE + CLUTCH
    (found,) = problems(tmp_path, text)
    assert "mechanisms.whole.cylinder_mass" in found
    assert "is given here, but ${drive.cylinder_mass} already provides it" in found
    own = text.replace(f": {typed}}}", ": '${drive.cylinder_mass}'}")
    assert references(tmp_path, own, "whole")["cylinder_mass"] == "${drive.cylinder_mass}"


@pytest.mark.parametrize("key", ["cylinder_mass", "stroke"])
def test_a_study_does_not_vary_what_is_compared_with_the_others(tmp_path: Path, key: str) -> None:
    config = loaded(tmp_path, HEAD + DRIVE + CLUTCH)
    asked = find_input(config, f"mechanisms.press_consistency.{key}")
    found = [str(each) for each in with_values(config, {asked: 1.0})[1]]
    assert any(f"is given here, but ${{drive.{key}}} already provides it" in each for each in found), found


def test_the_resolved_configuration_leaves_out_what_is_taken_again(tmp_path: Path) -> None:
    text = HEAD + DRIVE + CLUTCH
    made = Press.read(saved(tmp_path, text), DISCOVERY).calculate().results
    again = Press.read(saved(tmp_path, json.dumps(made.config.resolved)), DISCOVERY).calculate().results
    name = "press_consistency"
    assert made.config.resolved["mechanisms"][name].keys().isdisjoint({"cylinder_mass", "drive", "stroke"})
    assert again.mechanisms[name].checks == made.mechanisms[name].checks


def test_of_several_partners_none_is_taken_unless_it_is_named(tmp_path: Path) -> None:
    assert "sheet_step" not in references(tmp_path, HEAD + DRIVE + TWO)
    text = HEAD + "  whole: {kind: press_consistency, transport: two}\n" + DRIVE + TWO
    assert references(tmp_path, text, "whole")["sheet_step"] == "${two.sheet_step}"


@pytest.mark.parametrize(
    "name, words",
    [
        ("tow", "is “tow”; the name of a mechanism of kind cam_gear_transport or geneva_transport is needed"),
        ("drive", "is drive, of kind cylinder_drive; the name of a mechanism of kind cam_gear_transport or geneva"),
        ("3", "is “3”; the name of a mechanism"),
    ],
)
def test_a_partner_that_is_none_is_told_with_its_place(tmp_path: Path, name: str, words: str) -> None:
    text = HEAD + f"  whole: {{kind: press_consistency, transport: {name}}}\n" + DRIVE + TWO
    (found,) = problems(tmp_path, text)
    assert f"mechanisms.whole.transport: {words}" in found


def test_a_name_that_is_taken_gets_a_number(tmp_path: Path) -> None:
    named = CLUTCH.replace("clutch:", "press_consistency:", 1)
    config = loaded(tmp_path, HEAD + DRIVE + named)
    assert config.kinds["press_consistency_2"] == "press_consistency"


def test_what_is_not_checked_says_where_it_would_come_from(tmp_path: Path) -> None:
    found = {check.id: check for check in results(tmp_path, HEAD + DRIVE + TWO).checks}
    assert found["step"].status == "not_checked"
    assert found["step"].message.endswith(
        "There is no cam_gear_transport or geneva_transport, or there are several: select one with transport."
    )
    found = {check.id: check for check in results(tmp_path, HEAD + DRIVE + CLUTCH).checks}
    assert "clutch.speed and clutch.driven_inertia are not there." in found["driven_inertia"].message


def test_what_a_partner_does_not_have_in_this_machine_is_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A flat that never arrives at its lower end has no window there; what else is taken is checked all the same."""
    ends = Partner(
        key="drive", kinds=("cylinder_drive",), takes={"dead_center_inner": "clearance_inner_start", "stroke": "stroke"}
    )
    found = replace(DISCOVERY.mechanism("press_consistency"), partners=(*MECHANISM.partners, ends))
    own = Discovery.mechanism
    monkeypatch.setattr(Discovery, "mechanism", lambda self, kind: found if kind == found.kind else own(self, kind))
    turning = DRIVE.replace("{kind", "{segment_height: 40 mm, carriage_clearance: 30 mm, sector_ratio: 3, kind")
    inputs = results(tmp_path, HEAD + turning + CLUTCH).inputs
    assert inputs["stroke"].path == "drive.stroke"
    assert "dead_center_inner" not in inputs


def test_the_example_press_is_held_against_itself(example: Example) -> None:
    mechanisms = json.loads(example.told)["mechanisms"].values()
    (found,) = (data for data in mechanisms if data["kind"] == "press_consistency")
    checks = {check["id"]: check["status"] for check in found["checks"]}
    assert checks["actual_rate"] == "warn"
    assert checks["format_rolled"] == "pass"
    assert checks["damper_velocity"] == "pass"


@pytest.mark.parametrize(
    ("partner", "words"),
    [
        (Partner(key="drive", kinds=("cylinder_driv",), takes={"stroke": "stroke"}), ["no plugin has the kind cylinder_driv;"]),
        (Partner(key="drive", kinds=("cylinder_drive",), takes={"stroke": "strok"}), ["no partner of kind cylinder_drive has strok;"]),
        (Partner(key="chain", kinds=("roller_chain",), takes={}, unless={"aceleration": "cylinder_drv"}),
         ["no plugin has the kind cylinder_drv", "no partner of kind roller_chain has aceleration;"]),
    ],
)  # fmt: skip
def test_what_no_plugin_has_of_a_partner_is_noted(partner: Partner, words: list[str]) -> None:
    """Its checks would vanish without a word; what the program itself declares is known."""
    for partners, expected in ((MECHANISM.partners, []), ((partner,), words)):
        doubts = ContractTest(replace(MECHANISM, partners=partners), DISCOVERY).doubts()
        found = [text for text in map(str, doubts.faults) if "look at its name" in text]
        assert len(found) == len(expected) and all(part in text for part, text in zip(expected, found, strict=True))
