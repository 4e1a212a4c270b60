"""Advice on a key that follows from another one says where that one begins."""

from __future__ import annotations

from pathlib import Path

from diecut_report.press import Press
from tests.configs import DISCOVERY, saved

STEPPER = """
    kind: geneva_transport
    center_distance: 240 mm
    roller_radius: 16 mm
    gear_ratio: 6
    sprocket_teeth: 30
    chain_pitch: 19.05 mm
    allowable_sheet_acceleration: 10 m/s**2
"""
HEAD = """schema_version: 1
project: {title: T}
press: {name: P, productivity: 6000 1/h, sheet: {length: 700 mm, width: 470 mm, thickness: 0.6 mm}}
mechanisms:
"""


def told(tmp_path: Path, speed: str, first: str = "") -> str:
    """The failing check of a second stepper, whose crank's speed is given so."""
    text = f"{HEAD}  cross:{STEPPER}{first}  next:{STEPPER}    crank_speed: {speed}\n"
    results = Press.read(saved(tmp_path, text), DISCOVERY).calculate().results
    (check,) = (c for c in results.mechanisms["next"].checks if c.status == "fail")
    return check.message


def test_a_chain_of_references_is_followed_to_its_beginning(tmp_path: Path) -> None:
    assert "crank_speed follows from press.productivity" in told(tmp_path, "${cross.crank_speed}")


def test_a_key_of_another_mechanism_is_where_a_reference_begins(tmp_path: Path) -> None:
    """The first stepper's own speed is typed: the second one's begins there."""
    text = told(tmp_path, "${cross.crank_speed}", first="    crank_speed: 90 rpm\n")
    assert "crank_speed follows from cross.crank_speed; change it there" in text


def test_a_typed_key_follows_from_nothing(tmp_path: Path) -> None:
    assert "follows from" not in told(tmp_path, "100 rpm")


def test_a_key_that_is_only_spoken_of_is_not_traced(tmp_path: Path) -> None:
    """The roller's width is a reference too; the advice on the acceleration does not ask to change it."""
    found = told(tmp_path, "${cross.crank_speed}\n    roller_width: ${cross.roller_radius}")
    assert "crank_speed follows" in found and "roller_width follows" not in found
