"""Checks of roller chains, the advice in them, and what is refused in which words."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from diecut_report.config.schema import config_schema
from diecut_report.errors import UserError
from diecut_report.machine.calculation import Impossible
from diecut_report.machine.steps.run import recalculated
from diecut_report.plugins.roller_chain import MECHANISM
from diecut_report.results.press_run import compute
from tests.configs import HEAD, loaded, problems
from tests.machines import number
from tests.plugins.chains import CUSTOM, DRIVE, GRIPPERS, RATED, UNEVEN, chain, checks, without

SET = re.compile(r"[Ss]et (\w+) to (?:at least |between )?(\d+(?:\.\d+)?)")


def told(keys: dict[str, Any], check: str) -> str:
    """What a check that does not hold says."""
    found = checks(chain(keys))[check]
    assert found.status in ("fail", "warn"), found
    return str(found.message)


@pytest.mark.parametrize(
    ("keys", "check", "status"),
    [
        (DRIVE | {"torque": 400}, "safety_dynamic", "fail"),
        (DRIVE | {"torque": 280}, "safety_static", "fail"),
        (DRIVE | {"allowable_bearing_pressure": 20}, "bearing_pressure", "fail"),
        (DRIVE, "bearing_pressure", "not_checked"),
        (without(DRIVE, "center_distance") | {"links": 91}, "links_even", "warn"),
        (DRIVE | {"teeth_1": 16}, "teeth", "warn"),
        (DRIVE | {"teeth_1": 15}, "speed_unevenness", "warn"),
        (DRIVE | {"center_distance": 1000}, "center_distance", "warn"),
        (DRIVE | {"center_distance": 500}, "center_distance", "warn"),
        (DRIVE | {"teeth_2": 120, "center_distance": 600}, "wrap", "warn"),
        (RATED | {"power": 12, "chain": "10B", "allowable_bearing_pressure": 99}, "power_rating", "warn"),
        (GRIPPERS, "slack_side", "warn"),
        (DRIVE | {"teeth_1": 11, "teeth_2": 120, "center_distance": 440}, "length_formula", "warn"),
    ],
)
def test_a_check_says_what_does_not_hold(keys: dict[str, Any], check: str, status: str) -> None:
    assert checks(chain(keys))[check].status == status


def test_the_grippers_of_the_method_pass_all_but_the_slack_side() -> None:
    found = checks(chain(GRIPPERS))
    assert {name for name, check in found.items() if check.status not in ("pass", "not_checked")} == {"slack_side"}


@pytest.mark.parametrize(("check", "torque", "safety"), [("safety_static", 285.0, 7), ("safety_dynamic", 285.0, 6)])
def test_the_safeties_that_are_required_without_a_key_are_those_of_published_guides(
    check: str, torque: float, safety: int
) -> None:
    """iwis takes a seventh of the breaking load by rule of thumb, Diamond Chain a sixth as the greatest working load."""
    made = checks(chain(DRIVE | {"torque": torque}))[check]
    assert made.demand == safety
    assert made.source in {source.id for source in MECHANISM.sources}


def test_checks_of_the_other_use_are_left_out() -> None:
    assert {"slack_side"}.isdisjoint(checks(chain()))
    assert {"center_distance", "power_rating"}.isdisjoint(checks(chain(GRIPPERS)))


# --- advice ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "check"),
    [
        (without(DRIVE, "center_distance") | {"links": 91}, "links_even"),
        (DRIVE | {"teeth_1": 8}, "speed_unevenness"),
        (DRIVE | {"center_distance": 1000}, "center_distance"),
        (DRIVE | {"center_distance": 400}, "center_distance"),
        (GRIPPERS, "slack_side"),
    ],
)
def test_a_key_that_is_set_as_advised_passes(keys: dict[str, Any], check: str) -> None:
    found = SET.search(told(keys, check))
    assert found is not None
    key, value = found.groups()
    assert checks(chain(keys, **{key: float(value)}))[check].status == "pass"


# --- what is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        (without(DRIVE, "center_distance") | {"links": 12}, "is 12, too few to go round sprockets of 19 and 19 teeth"),
        (without(DRIVE, "center_distance") | {"links": 24}, "with which the sprockets overlap"),
        (DRIVE | {"center_distance": 100}, "at which sprockets of 115.739 mm and 115.739 mm overlap"),
        (without(DRIVE, "chain") | {"torque": 50_000}, "is left out, and no chain from 08B to 24B is enough"),
        (without(DRIVE, "chain") | {"pitch": 20}, "has no use without a chain"),
        (DRIVE | {"moving_mass": 5}, "has no use beside use: drive"),
        (GRIPPERS | {"speed": 100}, "has no use beside use: conveyor"),
        (RATED | {"teeth_1": 9}, "leaves the smaller sprocket 9 teeth"),
    ],
)
def test_an_impossible_chain_is_told_in_words(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(Impossible, match=re.escape(words)):
        chain(keys)


ROW = {
    "pitch": 19.05,
    "pin_diameter": 5.72,
    "bearing_area": 5.72 * (11.68 + 2 * 1.85),
    "breaking_load": 28.9,
    "mass_per_length": 1.15,
}
"""Of 12B, in the units of the keys."""


@pytest.mark.parametrize(
    ("key", "held", "refused"),
    [
        ("pitch", (0.9991, 1.0009), (0.998, 1.002)),
        ("pin_diameter", (0.81, 1.24), (0.79, 1.26)),
        *((key, (0.51, 1.24), (0.49, 1.26)) for key in ("bearing_area", "breaking_load", "mass_per_length")),
    ],
)
def test_a_value_of_a_chain_is_held_against_the_row_of_its_designation(
    key: str, held: tuple[float, float], refused: tuple[float, float]
) -> None:
    for share in held:
        chain(DRIVE | {key: share * ROW[key]})
    for share in refused:
        with pytest.raises(Impossible, match="for this designation") as found:
            chain(DRIVE | {key: share * ROW[key]})
        assert found.value.key == key
        chain(CUSTOM | {key: share * CUSTOM[key]})  # of nobody's row


def test_only_the_machines_of_a_study_with_a_value_of_another_chain_are_refused() -> None:
    made = recalculated(chain(bearing_area=88), {"bearing_area": np.array([45e-6, 900e-6, 88e-6])}, 3)
    assert made is not None
    assert {variant: key for variant, (key, _) in made.flaws.items()} == {1: "bearing_area"}


@pytest.mark.parametrize("area", ["900 mm**2", "'${other.bearing_area} * 10'"])
def test_a_value_of_another_chain_is_refused_typed_and_as_a_formula(tmp_path: Path, area: str) -> None:
    other = f"  other: {{kind: roller_chain, teeth_1: 19, chain: 12B, {TORQUE}}}\n"
    text = HEAD + other + BLOCK.format(f"chain: 12B, {TORQUE}, bearing_area: {area}")
    with pytest.raises(UserError, match=r"the table has 87\.97 mm² for this designation"):
        compute(loaded(tmp_path, text), lambda _: None)


BLOCK = "  c: {{kind: roller_chain, teeth_1: 19, {}}}\n"
TORQUE = "speed: 300 rpm, torque: 200 N*m, application_factor: 1, center_distance: 600 mm"


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        (
            "chain: 12B, speed: 300 rpm, center_distance: 600 mm",
            "torque and application_factor, or torque_curve, or power",
        ),
        (
            "chain: 12B, speed: 300 rpm, center_distance: 600 mm, torque: 3 N*m",
            "application_factor is missing beside torque",
        ),
        (
            "chain: 12B, torque: 3 N*m, application_factor: 1, center_distance: 600 mm",
            "speed is needed with use: drive",
        ),
        (f"chain: 12B, links: 90, {TORQUE}", "center_distance and links are both given"),
        ("chain: 12B, speed: 9 rpm, torque: 3 N*m, application_factor: 1", "center_distance, or links is needed"),
        ("chain: 12B, speed: 9 rpm, torque: 3 N*m, application_factor: 1, links: 90.5", "90.5 is not a whole number"),
        (f"chain: 12C, {TORQUE}", "12C"),
        (f"chain: custom, pitch: 20 mm, {TORQUE}", "breaking_load and mass_per_length is missing beside pitch"),
        (f"chain: custom, {TORQUE}", "breaking_load and mass_per_length is needed"),
        ("chain: 12B, use: conveyor, links: 90, velocity: 1 m/s, acceleration: 2 m/s**2", "moving_mass is needed"),
        (
            "chain: 12B, use: conveyor, links: 90, velocity: 1 m/s, moving_mass: 2 kg",
            "acceleration, or acceleration_curve is needed",
        ),
        (f"chain: 12B, strands: 5, {TORQUE}", "5 is out of range"),
    ],
)
def test_what_cannot_be_meant_is_told_in_words(tmp_path: Path, keys: str, words: str) -> None:
    found = problems(tmp_path, HEAD + BLOCK.format(keys))
    assert any(words in line for line in found), found


# --- curves by reference, and editors --------------------------------------------------------------------------------

STEPPER = """\
  t: {kind: cam_gear_transport, dwell_angle: 160 deg, center_distance: 300 mm, sprocket_teeth: 30, chain_pitch: 19.05 mm}
"""
REFERRED = """\
  c: {kind: roller_chain, chain: 12B, use: conveyor, strands: 2, teeth_1: "${t.sprocket_teeth}", links: 240, moving_mass: 9.6 kg,
      velocity: "${t.sheet_velocity}", acceleration: "${t.sheet_acceleration}"}
"""


def test_keys_of_numbers_take_the_curves_of_another_mechanism(tmp_path: Path) -> None:
    run = compute(loaded(tmp_path, HEAD + STEPPER + REFERRED), lambda _: None)
    found, stepper = run.calculations["c"], run.calculations["t"]
    top = number(stepper, "sheet_acceleration_max")
    mass = 9.6 + 2 * 1.15 * 240 * 0.01905
    assert number(found, "useful_tension") == pytest.approx((mass * top + 0.1 * mass * 9.80665) / 2, rel=1e-6)


def test_curves_over_two_cycles_are_refused(tmp_path: Path) -> None:
    keys = "slots: 6, center_distance: 240 mm, roller_radius: 16 mm, gear_ratio: 6, sprocket_teeth: 30, chain_pitch: 19.05 mm"
    cross = f"  g: {{kind: geneva_transport, {keys}}}\n"
    mixed = REFERRED.replace("t.sheet_velocity", "g.sheet_velocity")
    with pytest.raises(UserError, match="runs over another cycle than acceleration"):
        compute(loaded(tmp_path, HEAD + STEPPER + cross + mixed), lambda _: None)


@pytest.mark.parametrize("keys", [DRIVE, CUSTOM, UNEVEN, RATED, GRIPPERS])
def test_editors_take_what_the_program_takes(keys: dict[str, Any]) -> None:
    assert schema_faults(keys) == []


@pytest.mark.parametrize(
    "keys",
    [without(DRIVE, "speed"), without(DRIVE, "torque"), without(CUSTOM, "pitch"), without(GRIPPERS, "moving_mass")],
)
def test_editors_see_what_a_use_lacks(keys: dict[str, Any]) -> None:
    assert schema_faults(keys)


def test_editors_take_a_curve_under_the_key_of_a_number() -> None:
    assert schema_faults(without(DRIVE, "application_factor") | {"torque": "${drive.crank_torque}"}) == []


def schema_faults(keys: dict[str, Any]) -> list[str]:
    """What an editor finds wrong with a chain."""
    schema = config_schema({"roller_chain": MECHANISM}, {})
    press = {
        "schema_version": 1,
        "project": {"title": "T"},
        "press": {"name": "P"},
        "mechanisms": {"c": {"kind": "roller_chain", **keys}},
    }
    return [error.message for error in Draft202012Validator(schema).iter_errors(press)]
