"""What loads a part of a machine is known in full, or what it carries is not rated; and a machine that cannot be is refused in words."""

from __future__ import annotations

from typing import Any

import pytest

from diecut_report.config.loader import examined
from diecut_report.config.yaml import parse
from tests.config.parts.test_parts import DISCOVERY, FILE

TEXT = FILE.with_stem("flat_cylinder_corrected").read_text("utf-8")
CONVEYOR = "60x40 r1.4, 70x120 r2, 75x520 r1.4, 60x40"


def read(*changes: tuple[str, str]) -> tuple[dict[str, Any], list[str]]:
    """The corrected machine with other texts: its mechanisms and the calculations of its parts, and what is wrong with it."""
    text = TEXT
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    config, problems = examined(parse(text, str(FILE)), DISCOVERY)
    return config.tree.data["mechanisms"], [str(each) for each in problems]


def told(*changes: tuple[str, str]) -> str:
    """What is wrong with a changed machine."""
    return "\n".join(read(*changes)[1])


def names(rows: list[dict[str, Any]]) -> list[str]:
    return [row["name"] for row in rows]


def test_the_corrected_machine_is_sound() -> None:
    assert told() == ""


# The type of a bearing that is not in the tables is typed: no letter of its name tells it.


@pytest.mark.parametrize("designation", ["2211", "1211", "HK5525", "32211", "7211B", "NKI55/25"])
def test_the_type_of_a_bearing_without_a_row_is_asked_for(designation: str) -> None:
    other = f'{{bearing: a, at: 29, designation: "{designation}", bore: 55, outside: 100, width: 21, dynamic_rating: 40 kN, static_rating: 30 kN'
    old = 'parts: [{bearing: a, at: 29, designation: "6211"'
    assert f"is {designation}, which is not in the tables; give its type" in told((old, f"parts: [{other}"))
    made, problems = read((old, f"parts: [{other}, type: ball"))
    assert problems == [] and made["shafts_far_bearings"]["bearings"][0]["type"] == "ball"


def test_the_type_of_a_bearing_of_the_tables_is_that_of_its_table() -> None:
    made, _ = read()
    types = {
        row["designation"]: row["type"] for each in made if each.endswith("_bearings") for row in made[each]["bearings"]
    }
    assert {types["6015"], types["6211"], types["6212"]} == {"deep_groove"} and {types["NU218E"], types["NU217E"]} == {
        "roller"
    }


# The pull of a chain.

CHAIN_DRIVE = (
    ("main: [216, 0], flywheel: [216, -262.5], motor: [216, -856.602]", "main: [-450, 0], flywheel: [-450, -262.5], motor: [-450, -856.602]"),
    ("geneva: [216, 240], conveyor: [216, 520], far: [2216.254, 520]", "geneva: [-450, 240], conveyor: [-450, 520], far: [1550.254, 520]"),
    ("- {gear: pinion, at: 360, integral: true}", "- {sprocket: pinion, at: 360, hub: 60, key: 50}"),
    ("{gear: wheel, at: 130, rides_on: clutch}", "{sprocket: wheel, at: 130, rides_on: clutch}"),
    ('  crank_drive: {pair: [main.pinion, crank.wheel], teeth: 24/48, module: 6, width: 50,\n'
     '    application_factor: {value: 1, basis: standard, note: "ISO 6336-6: the torque is that of the whole cycle"}}\n', ""),
    ("chains:\n", "chains:\n  crank_drive: {sprockets: [main.pinion], to: [crank.wheel], teeth: 19/38, chain: 16B, links: 64, pretension: 3000 N}\n"),
)  # fmt: skip


def test_a_chain_between_two_shafts_loads_both() -> None:
    """The torque of its driving sprocket over that one's radius, and twice its pretension, along the frame's x."""
    made, problems = read(*CHAIN_DRIVE)
    assert problems == []
    for shaft, part, sign in (("main", "pinion", 1), ("crank", "wheel", -1)):
        [force] = [row for row in made[f"shafts_{shaft}_loads"]["forces"] if row["name"] == f"{part}_y"]
        assert force["lever"] == "${drive_line.crank_drive_chain_travel} / 1 rad" and force["absolute"]
        assert force["constant"].startswith("2 * ${drive_line.chains.") and float(
            force["constant"].rpartition("* ")[2]
        ) == pytest.approx(sign)
        load = next(row for row in made[f"shafts_{shaft}"]["loads"] if row["name"] == part)
        assert load["force_y"] == f"${{shafts_{shaft}_loads.{part}_y_force}}"
    torque = next(row for row in made["shafts_main_loads"]["torques"] if row["name"] == "pinion")
    force = next(row for row in made["shafts_main_loads"]["forces"] if row["name"] == "pinion_y")
    assert (force["mechanism"], force["curve"]) == (torque["mechanism"], torque["curve"])


def test_what_chains_move_is_named() -> None:
    text = told(("moves: cross.conveyor, moving_mass", "moving_mass"))
    assert "chains.grippers.moving_mass: is moved by chains that say what they move; give moves" in text


def test_who_accepts_a_chain_without_a_rating_is_said_at_it() -> None:
    accepted = 'accepted: {by: Designer, reason: "rated by its maker for this torque"}'
    assert (
        told(*CHAIN_DRIVE[:-1], (CHAIN_DRIVE[-1][0], CHAIN_DRIVE[-1][1].replace("3000 N}", f"3000 N, {accepted}}}")))
        == ""
    )


# What is not known of a torque.

TWO_SECTORS = (
    ("- {gear: sector, at: 105, hub: 100, key: 90, key_count: 2, mass: 18 kg}",
     "- {gear: sector, at: 95, hub: 60, key: 50, key_count: 2, mass: 18 kg}\n"
     "      - {gear: sector2, at: 156, hub: 41, key: 40, key_count: 2, mass: 18 kg}"),
    ("of: drive.rocker, at: 215,", "of: drive.rocker, at: 227,"),
    ("- {gear: pinion, at: 150, hub: 70, key: 63}",
     "- {gear: pinion, at: 150, hub: 60, key: 56}\n      - {gear: pinion2, at: 211, hub: 60, key: 50}"),
    ("  step_up: {pair",
     "  sector2: {pair: [rocker.sector2, pinion.pinion2], teeth: 212/35, module: 4, width: 40, teeth_present: 39}\n  step_up: {pair"),
)  # fmt: skip


def test_a_shaft_on_which_a_torque_is_not_known_is_not_rated() -> None:
    """Two sectors share the rocker's torque in parts that nobody knows: its keys were held against the little that was."""
    made, problems = read(*TWO_SECTORS)
    assert problems == []
    assert (
        not {"shafts_rocker", "shafts_rocker_loads", "shafts_rocker_arm_key", "shafts_rocker_sector_key"} & made.keys()
    )
    assert {"shafts_rocker", "shafts_rocker_arm_key"} <= read()[0].keys()


def test_all_chains_of_a_conveyor_count_in_its_inertia() -> None:
    made, problems = read(
        ("sprockets: [conveyor.left, conveyor.right], to: [far.left, far.right], teeth: 30/30, chain: 12B, links: 240,\n"
         "             moves: cross.conveyor, moving_mass: 9.6 kg, pretension: 1000 N, allowable_bearing_pressure: 25 MPa}",
         "sprockets: [conveyor.left], to: [far.left], teeth: 30/30, chain: 12B, links: 240, moves: cross.conveyor, moving_mass: 4.8 kg}\n"
         "  more: {sprockets: [conveyor.right], to: [far.right], teeth: 30/30, chain: 12B, links: 240, moves: cross.conveyor, moving_mass: 4.8 kg}"),
    )  # fmt: skip
    assert problems == []
    inertia = made["cross"]["driven_inertia"]
    assert "grippers_chain_mass" in inertia and "more_chain_mass" in inertia
    assert inertia.count("shafts_far_body.inertia") == 1


def test_a_clutch_beside_the_flywheel_is_engaged_by_the_flywheel() -> None:
    made, problems = read(
        (
            "- {bearing: b, at: 387.5,",
            "- {clutch: clutch, at: 300, hub: 80, key: 70, mass: 6 kg}\n      - {bearing: b, at: 387.5,",
        ),
        ("- {clutch: clutch, at: 130, hub: 80,", "- {coupling: sleeve, at: 130, hub: 80,"),
        ("rides_on: clutch}", "rides_on: sleeve}"),
    )
    assert problems == []
    cases = [(each["name"], each["enters"], each["leaves"]) for each in made["shafts_flywheel"]["load_cases"]]
    assert cases == [("engage", "rim", "pinion"), ("start", "large", "rim")]
    assert names(made["shafts_flywheel_rim_key"]["load_cases"]) == ["engage", "start"]


def test_a_clutch_on_a_shaft_that_drives_two_parts_is_engaged_through_both() -> None:
    made, problems = read(
        ("- {gear: wheel, at: 200, hub: 100, key: 90}", "- {clutch: clutch, at: 200, hub: 100, key: 90, mass: 6 kg}\n"
         "      - {gear: wheel, at: 200, rides_on: clutch}"),
        ("- {clutch: clutch, at: 130, hub: 80,", "- {coupling: sleeve, at: 130, hub: 80,"),
        ("- {gear: wheel, at: 130, rides_on: clutch}", "- {gear: wheel, at: 130, rides_on: sleeve}"),
    )  # fmt: skip
    assert problems == []
    cases = [(each["name"], each["enters"], each["leaves"]) for each in made["shafts_main"]["load_cases"]]
    assert cases == [("engage", "wheel", "disc"), ("engage_2", "wheel", "pinion")]


# Teeth and shafts.


def test_a_sprocket_has_a_hub_around_its_shaft() -> None:
    text = told(("teeth: 30/30, chain: 12B, links: 240", "teeth: 30/12, chain: 12B, links: 230"))
    assert text.count("is 61.5335 mm thick below its teeth, less than 1.5 times its seat of 65 mm") == 2


def test_teeth_are_not_cut_into_a_thicker_shaft() -> None:
    text = told((CONVEYOR, "60x40 r1.4, 75x640 r1.4, 60x40"))
    assert (
        "shafts.conveyor.parts.2.integral: is 70 mm thick below its teeth, which are cut into a shaft of 75 mm" in text
    )


# The driving part is named first.


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("pair: [rocker.sector, pinion.pinion], teeth: 212/35", "pair: [pinion.pinion, rocker.sector], teeth: 35/212",
         "drives rocker, which drive.rocker moves; name the part of rocker first"),
        ("pair: [rocker.sector, pinion.pinion]", "pair: [pinion.pinion, rocker.sector]", "drives rocker, which drive.rocker moves"),
        ("pair: [geneva.large, conveyor.small], teeth: 120/20", "pair: [conveyor.small, geneva.large], teeth: 20/120",
         "drives geneva, which cross.wheel moves; name the part of geneva first"),
        ("pair: [flywheel.pinion, main.wheel], teeth: 18/87", "pair: [main.wheel, flywheel.pinion], teeth: 87/18",
         "drives flywheel, which main_drive drives too; name the driving part of each join first"),
        ("sprockets: [conveyor.left, conveyor.right], to: [far.left, far.right]",
         "sprockets: [far.left, far.right], to: [conveyor.left, conveyor.right]", "is driven by no other shaft, though cross.wheel moves it"),
        ("to: [far.left, far.right]", "to: [pinion.left, pinion.right]", "drives"),
    ],
)  # fmt: skip
def test_a_join_the_wrong_way_round_is_refused(old: str, new: str, words: str) -> None:
    assert words in told((old, new))
