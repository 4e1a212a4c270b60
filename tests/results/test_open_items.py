"""What is left open of a machine: assumed and default values, forces that no part takes, each with its owner."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.press import Press
from diecut_report.results.model import OpenRecord
from tests.configs import EXAMPLE, GOOD, HEAD, saved

KEY = """\
  k: {kind: parallel_key, torque: 300 N*m, application_factor: 1.4, shaft_diameter: 50 mm, key_length: 50 mm,
      yield_shaft: 650 MPa, yield_hub: %s}
"""


def left(folder: Path, text: str) -> list[OpenRecord]:
    return Press.read(saved(folder, text), Discovery([GOOD])).calculate().results.summary.open


def values(folder: Path, text: str) -> dict[str, str]:
    """What is open of the inputs, by their paths."""
    return {each.path: each.what for each in left(folder, text) if each.what in ("assumed", "default")}


@pytest.mark.parametrize(
    ("arm", "what"),
    [
        ("", "default"),
        (", arm: 100 mm", "default"),  # typed
        (", arm: {value: 0.1 m, basis: standard, note: DIN 1}", "default"),  # typed and marked
        (", arm: 110 mm", None),  # given
        (", arm: {value: 110 mm, basis: assumed}", "assumed"),
        (", arm: {value: 110 mm, basis: measured}", None),
    ],
)
def test_what_a_value_rests_on(tmp_path: Path, arm: str, what: str | None) -> None:
    found = values(tmp_path, HEAD + f"  a: {{kind: lever, force: 2 kN{arm}}}\n")
    assert found.get("mechanisms.a.arm") == what


@pytest.mark.parametrize(
    ("hub", "what"),
    [
        ("370 MPa", "assumed"),  # nobody says from where, and its range asks for that
        ("{value: 370 MPa, basis: drawing}", None),
        ("{value: 370 MPa, basis: catalogue}", "assumed"),  # which one?
        ("{value: 370 MPa, basis: catalogue, note: EN 10083-2 C45}", None),
    ],
)
def test_a_given_value_that_asks_for_a_basis_counts_as_assumed(tmp_path: Path, hub: str, what: str | None) -> None:
    assert values(tmp_path, HEAD + KEY % hub).get("mechanisms.k.yield_hub") == what


@pytest.mark.parametrize(("allowed", "what"), [("0.4 MPa", None), ("1.5 MPa", "assumed")])
def test_what_is_allowed_beyond_its_usual_range_is_never_founded(
    tmp_path: Path, allowed: str, what: str | None
) -> None:
    limit = f"allowable_pressure: {{value: {allowed}, basis: measured}}"
    text = HEAD + f"  c: {{kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg, {limit}}}\n"
    assert values(tmp_path, text).get("mechanisms.c.allowable_pressure") == what


def test_a_reference_rests_on_what_it_refers_to(tmp_path: Path) -> None:
    text = (
        HEAD
        + "  a: {kind: lever, force: 2 kN, arm: {value: 110 mm, basis: assumed}}\n  b: {kind: lever, force: 1 kN, arm: '${a.arm}'}\n"
    )
    assert "mechanisms.b.arm" not in values(tmp_path, text)


def test_each_item_has_the_owner_of_the_project(tmp_path: Path) -> None:
    text = HEAD.replace("title: Test", "title: Test, prepared_by: Designer") + "  a: {kind: lever, force: 2 kN}\n"
    assert {each.owner for each in left(tmp_path, text)} == {"Designer"}
    assert {each.owner for each in left(tmp_path, text.replace(", prepared_by: Designer", ""))} == {""}


def test_forces_that_no_part_takes_are_named_by_the_mechanism_that_makes_them() -> None:
    found = Press.read(EXAMPLE, Discovery()).calculate().results.summary.open
    unrated = {each.path: str(each.why) for each in found if each.what == "not_rated"}
    assert unrated.keys() == {f"mechanisms.{name}" for name in ("drive", "feeder", "cross", "gripper_chain")}
    assert unrated["mechanisms.cross"] == "no part takes torque, roller_force"
    assert "coupler_force" not in unrated["mechanisms.drive"]  # a pin takes it


def test_a_mechanism_alone_belongs_to_no_drive_line(tmp_path: Path) -> None:
    one = HEAD + "  a: {kind: lever, force: 2 kN}\n"
    assert not [each for each in left(tmp_path, one) if each.what == "not_rated"]
    two = left(tmp_path, one + "  b: {kind: lever, force: 1 kN}\n")
    assert [each.path for each in two if each.what == "not_rated"] == ["mechanisms.a", "mechanisms.b"]
