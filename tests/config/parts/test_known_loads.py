"""What loads a part of a machine is known in full, or what it carries is not rated; and a machine that cannot be is refused in words."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from diecut_report.config.parts.demands import Demands
from diecut_report.config.parts.load_cases import LoadCases, Passing
from diecut_report.mechanics.load_cases import called
from diecut_report.press import Press
from diecut_report.results.drive_line import unrated
from tests.config.parts.machines import CORRECTED, DISCOVERY, PRESS, Change, Machine, machine, run_of, sound
from tests.config.parts.test_parts import calculated
from tests.examples import every

CONVEYOR = "60x40 r1.4, 70x120 r2, 75x510 r2, 70x10 r1.4, 60x40"


def changed(*changes: Change) -> Machine:
    """The corrected machine with other texts."""
    return machine(*changes, text=CORRECTED)


def read(*changes: Change) -> dict[str, Any]:
    """The mechanisms and the calculations of the parts of a changed machine with which nothing is wrong."""
    return sound(*changes, text=CORRECTED).made


def told(*changes: Change) -> str:
    """What is wrong with a changed machine."""
    return changed(*changes).told


def names(rows: list[dict[str, Any]]) -> list[str]:
    return [row["name"] for row in rows]


def test_the_corrected_machine_is_sound() -> None:
    sound(text=CORRECTED)


# The type of a bearing that is not in the tables is typed: no letter of its name tells it.


@pytest.mark.parametrize("designation", every(3, ["2211", "1211", "HK5525", "32211", "7211B", "NKI55/25"]))
def test_the_type_of_a_bearing_without_a_row_is_asked_for(designation: str) -> None:
    other = f'{{bearing: a, at: 29, designation: "{designation}", bore: 55, outside: 100, width: 21, dynamic_rating: 40 kN, static_rating: 30 kN'
    old = 'parts: [{bearing: a, at: 29, designation: "6211"'
    assert f"is {designation}, which is not in the tables; give its type" in told((old, f"parts: [{other}"))
    made = read((old, f"parts: [{other}, type: ball"))
    assert made["shafts_far_bearings"]["bearings"][0]["type"] == "ball"


def test_the_type_of_a_bearing_of_the_tables_is_that_of_its_table() -> None:
    homes = [each["bearings"] for name, each in read().items() if name.endswith("_bearings")]
    types = {row["designation"]: row["type"] for rows in homes for row in rows}
    wanted = {
        "6015": "deep_groove",
        "6211": "deep_groove",
        "6212": "deep_groove",
        "NU218E": "roller",
        "NU217E": "roller",
    }
    assert {name: types[name] for name in wanted} == wanted


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
    made = read(*CHAIN_DRIVE)
    for shaft, part, sign in (("main", "pinion", 1), ("crank", "wheel", -1)):
        [force] = [row for row in made[f"shafts_{shaft}_loads"]["forces"] if row["name"] == f"{part}_y"]
        assert force["lever"] == "${drive_line.crank_drive_chain_travel} / 1 rad" and force["absolute"]
        text, _, share = force["constant"].rpartition("* ")
        assert text.startswith("2 * (${drive_line.chains.") and float(share) == pytest.approx(sign)
        load = next(row for row in made[f"shafts_{shaft}"]["loads"] if row["name"] == part)
        assert load["force_y"] == f"${{shafts_{shaft}_loads.{part}_y_force}}"
    torque = next(row for row in made["shafts_main_loads"]["torques"] if row["name"] == "pinion")
    force = next(row for row in made["shafts_main_loads"]["forces"] if row["name"] == "pinion_y")
    assert (force["mechanism"], force["curve"]) == (torque["mechanism"], torque["curve"])


def test_a_chain_pulls_its_sprockets_by_its_sag_too() -> None:
    """That of the grippers moves the carriages of the cross; of one that is not calculated no sag is known."""
    constants = {row["name"]: row["constant"] for row in read()["shafts_far_loads"]["forces"]}
    sag = "${chains_grippers.sag_tension}"
    assert constants.keys() == {"left_y", "right_y"}
    assert all(text.startswith("2 * (${drive_line.chains.") and sag in text for text in constants.values())
    without = read(("pretension: 1000 N, ", ""))
    assert without["shafts_far_loads"]["forces"][0]["constant"].startswith(f"2 * ({sag}) * ")


@pytest.mark.nightly
def test_the_chain_of_the_cylinder_moves_its_unbalance_too() -> None:
    """What the joints bear is no less than what accelerates the cylinder, by the drive."""
    terms = read()["chains_cylinder"]["moving_mass"]["value"].split(" / ")
    [moved] = [line for line in terms if "static_unbalance" in line]
    assert moved == "(${drive.reduced_inertia} + 2 * ${drive.cylinder_radius} * ${drive.static_unbalance})"
    drive = calculated("shaft_body", "drive_line", "cylinder_sizing", "cylinder_drive").calculations["drive"]
    radius, unbalance = drive["cylinder_radius"].item(), drive["static_unbalance"].item()
    tension = (drive["reduced_inertia"].item() + 2 * radius * unbalance) / radius**2 * drive["acceleration_max"].item()
    moments = [abs(drive[f"inertia_moment_{end}"].item()) for end in ("min", "max")]
    assert unbalance > 0 and tension >= max(moments) / radius


def test_the_drive_train_has_the_pulleys_of_the_machine() -> None:
    vbelt = read()["train"]["vbelt"]
    assert vbelt["driver_diameter"]["value"] == "125 mm" and vbelt["driven_diameter"]["value"] == "375 mm"


def test_who_accepts_a_chain_without_a_rating_is_said_at_it() -> None:
    accepted = 'accepted: {by: Designer, reason: "rated by its maker for this torque"}'
    *changes, (old, new) = CHAIN_DRIVE
    read(*changes, (old, new.replace("3000 N}", f"3000 N, {accepted}}}")))


# What is not known of a torque.

TWO_SECTORS = (
    ("- {gear: sector, at: 105, hub: 100, key: 100, key_count: 2, mass: 18 kg}",
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
    made = read(*TWO_SECTORS)
    rated = {"shafts_rocker", "shafts_rocker_arm_key", "shafts_rocker_loads", "shafts_rocker_sector_key"}
    assert not rated & made.keys() and rated <= read().keys()


def test_all_chains_of_a_conveyor_count_in_its_inertia() -> None:
    made = read(
        ("sprockets: [conveyor.left, conveyor.right], to: [far.left, far.right], teeth: 30/30, chain: 12B, links: 240,\n"
         "             moves: cross.conveyor, moving_mass: 9.6 kg, pretension: 1000 N, allowable_bearing_pressure: 25 MPa}",
         "sprockets: [conveyor.left], to: [far.left], teeth: 30/30, chain: 12B, links: 240, moves: cross.conveyor, moving_mass: 4.8 kg}\n"
         "  more: {sprockets: [conveyor.right], to: [far.right], teeth: 30/30, chain: 12B, links: 240, moves: cross.conveyor, moving_mass: 4.8 kg}"),
    )  # fmt: skip
    inertia = made["cross"]["driven_inertia"]
    assert "grippers_chain_mass" in inertia and "more_chain_mass" in inertia
    assert inertia.count("shafts_far_body.inertia") == 1


def test_a_clutch_beside_the_flywheel_is_engaged_by_the_flywheel() -> None:
    made = read(
        (
            "- {bearing: b, at: 387.5,",
            "- {clutch: clutch, at: 300, hub: 80, key: 70, mass: 6 kg}\n      - {bearing: b, at: 387.5,",
        ),
        ("- {clutch: clutch, at: 130, hub: 80,", "- {coupling: sleeve, at: 130, hub: 80,"),
        ("rides_on: clutch}", "rides_on: sleeve}"),
    )
    cases = [(each["name"], each["enters"], each["leaves"]) for each in made["shafts_flywheel"]["load_cases"]]
    assert cases == [("engage", "rim", "pinion"), ("start", "large", "rim")]
    assert names(made["shafts_flywheel_rim_key"]["load_cases"]) == ["engage", "start"]


def test_a_clutch_on_a_shaft_that_drives_two_parts_is_engaged_through_both() -> None:
    made = read(
        ("- {gear: wheel, at: 200, hub: 100, key: 90}", "- {clutch: clutch, at: 200, hub: 100, key: 90, mass: 6 kg}\n"
         "      - {gear: wheel, at: 200, rides_on: clutch}"),
        ("- {clutch: clutch, at: 130, hub: 80,", "- {coupling: sleeve, at: 130, hub: 80,"),
        ("- {gear: wheel, at: 130, rides_on: clutch}", "- {gear: wheel, at: 130, rides_on: sleeve}"),
        ("clutch_drives: [drive]", "clutch_drives: [drive, cross]"),
    )  # fmt: skip
    cases = [(each["name"], each["enters"], each["leaves"]) for each in made["shafts_main"]["load_cases"]]
    assert cases == [("engage", "wheel", "disc"), ("engage_2", "wheel", "pinion")]
    assert made["clutch"]["torque_curve"] == "${shafts_main_loads.balance}"
    assert read()["clutch"]["torque_curve"] == "${shafts_crank_loads.balance}"


# Other machines than the example: what is not known of them is not rated, and what is known counts.

PINION = "{sprocket: left, at: 75, hub: 60, key: 50}"
CYLINDER = "cylinder: {sprockets: [pinion.left, pinion.right], teeth: 27,"
SHAFT = """  {name}:
    sections: 50x40 r1.6, 60x290 r1.6, 50x40
    parts:
      - {{bearing: a, at: 27, designation: "6210"}}
{parts}
      - {{bearing: b, at: 343, designation: "6210", floating: true}}
  geneva:
    sections"""
MAIN = {"shafts_main", "shafts_main_bearings", "shafts_flywheel", "shafts_flywheel_bearings", "meshes_main_drive"}


def with_shaft(name: str, *parts: str) -> tuple[str, str]:
    """The change that puts a shaft into the file."""
    return "  geneva:\n    sections", SHAFT.format(name=name, parts="\n".join(f"      - {each}" for each in parts))


def test_an_idle_shaft_of_the_cylinders_chains_counts_in_its_inertia() -> None:
    """What it takes follows another curve than the cylinder's moment: neither shaft is rated, by the pretension alone or at all."""
    made = read(
        ("pinion: [500, -494],", "pinion: [500, -494], idle: [1681.1, -494],"),
        with_shaft("idle", PINION, "{sprocket: right, at: 285, hub: 60, key: 50}"),
        (CYLINDER, "cylinder: {sprockets: [pinion.left, pinion.right], to: [idle.left, idle.right], teeth: 27/27,"),
        ("direction: 0, ", ""),
    )
    assert not {f"shafts_{name}" for name in ("pinion", "pinion_bearings", "idle", "idle_bearings")} & made.keys()
    assert "${shafts_idle_body.inertia}" in made["drive"]["pinion_inertia"]


@pytest.mark.nightly
def test_what_a_geneva_wheel_moves_is_what_its_shafts_and_chains_have_at_it() -> None:
    """By hand: conveyor, far shaft (chains 30/18) and chains turn 120/20 times as fast as the wheel; its energy is theirs."""
    far = ("far: [2216.254, 520]", "far: [2273.084, 520]")
    results = (
        run_of(far, ("teeth: 30/30, chain: 12B", "teeth: 30/18, chain: 12B"), text=CORRECTED).document().mechanisms
    )

    def inertia(shaft: str) -> float:
        return float(results[f"shafts_{shaft}_body"].outputs["inertia"].value)

    chains = 2 * 240 * 19.05e-3 * 1.15 + 9.6  # kg
    conveyor = inertia("conveyor") + inertia("far") * (30 / 18) ** 2 + chains * (30 * 19.05e-3 / (2 * np.pi)) ** 2
    driven = results["cross"].inputs["driven_inertia"].value
    assert driven == pytest.approx(inertia("geneva") + conveyor * 6**2, rel=1e-9)


def test_two_stages_behind_a_wheel_are_its_gear_ratio() -> None:
    made = read(
        ("conveyor: [216, 520]", "lay: [216, 520], conveyor: [216, 700]"), ("far: [2216.254, 520]", "far: [2216.254, 700]"),
        with_shaft("lay", "{gear: small, at: 110, integral: true}", "{gear: large, at: 200, hub: 60, key: 50}"),
        ("step_up: {pair: [geneva.large, conveyor.small], teeth: 120/20",
         "second: {pair: [lay.large, conveyor.small], teeth: 60/30, module: 4, width: 40}\n"
         "  step_up: {pair: [geneva.large, lay.small], teeth: 120/20"),
        ("60x40 r1.4, 70x120 r2, 75x510 r2, 70x10 r1.4, 60x40", "60x40 r1.4, 75x640 r1.4, 60x40"),
    )  # fmt: skip
    ratio = made["cross"]["gear_ratio"]
    assert ratio.count("teeth_1") == 2 == ratio.count("teeth_2")


def test_a_cylinder_has_one_pair_behind_its_rocker() -> None:
    left, right = "{sprocket: left, at: 75, hub: 60, key: 50}", "{sprocket: right, at: 285, hub: 60, key: 50}"
    text = told(
        ("pinion: [500, -494],", "pinion: [500, -494], roll: [680, -494],"),
        with_shaft("roll", PINION, "{gear: wheel, at: 150, hub: 60, key: 50}", right),
        (f"- {left}\n      - {{gear: pinion", "- {gear: second, at: 220, hub: 50, key: 45}\n      - {gear: pinion"),
        (f"      - {right}\n      - {{bearing: b, at: 343", "      - {bearing: b, at: 343"),
        ("  step_up: {pair", "  second: {pair: [pinion.second, roll.wheel], teeth: 30/60, module: 4, width: 40}\n  step_up: {pair"),
        (CYLINDER, CYLINDER.replace("pinion.", "roll.")),
    )  # fmt: skip
    assert "moves the cylinder 2 joins behind rocker" in text


FRICTION = "  timing:\n    kind: cyclogram\n"


@pytest.mark.parametrize(
    "change",
    [(FRICTION, f"{FRICTION}    friction: [{{name: pumps, torque: 250 N*m}}]\n"), ("      - mechanism: cross #", "      - mechanism: cross2 #")],
    ids=["a torque that no part takes", "a mechanism without a line"],
)  # fmt: skip
def test_what_the_cyclogram_says_of_the_main_shaft_is_what_its_parts_take(change: Change) -> None:
    """Else neither the main shaft nor what drives it is rated."""
    found = changed(change)
    assert all("there is no mechanism 'cross2'" in each for each in found.problems)
    assert not MAIN & found.made.keys() and {"shafts_crank", "shafts_geneva"} <= found.made.keys()
    assert read().keys() >= MAIN


def test_a_mechanism_on_a_shaft_before_the_main_one_is_not_counted_twice() -> None:
    """A lay shaft drives the main shaft, and the crank's beside it."""
    made = read(
        ("main: [216, 0], flywheel: [216, -262.5], motor: [216, -856.602],",
         "main: [216, 0], lay: [123.407407, -177.275525], flywheel: [123.407407, -439.775525], motor: [123.407407, -1033.877525],"),
        with_shaft("lay", "{gear: in, at: 80, hub: 60, key: 50}",
         "{gear: one, at: 150, hub: 60, key: 50}", "{gear: two, at: 270, hub: 60, key: 50}"),
        ("      - {gear: pinion, at: 360, integral: true}\n      - {bearing: b, at: 497", "      - {bearing: b, at: 497"),
        ("main_drive: {pair: [flywheel.pinion, main.wheel]", "main_drive: {pair: [flywheel.pinion, lay.in]"),
        ("  crank_drive: {pair: [main.pinion,", "  one: {pair: [lay.one, main.wheel], teeth: 40/40, module: 5, width: 50}\n"
         "  crank_drive: {pair: [lay.two,"),
    )  # fmt: skip
    assert not {"shafts_main", "shafts_lay"} & made.keys()


def test_losses_that_the_cyclogram_does_not_know_of_warn() -> None:
    [found] = sound(("module: 6, width: 50,", "module: 6, width: 50, efficiency: 0.86,"), text=CORRECTED).found(
        "losses"
    )
    assert "has the efficiency 0.86, but the cyclogram calculates with 0.97 for drive" in found.message


def test_a_typed_torque_on_a_driven_shaft_makes_what_drives_it_unknown() -> None:
    made = read(
        ("main: [216, 0],", "main: [216, 0], pump: [396, 0],"),
        with_shaft("pump", "{gear: wheel, at: 100, hub: 60, key: 50}", "{load: pump, at: 200, torque: -300 N*m}"),
        ("      - {gear: pinion, at: 360, integral: true}\n",
         "      - {gear: pinion, at: 360, integral: true}\n      - {gear: aux, at: 440, hub: 40, key: 36}\n"),
        ("  crank_drive: {pair", "  pump: {pair: [main.aux, pump.wheel], teeth: 45/45, module: 4, width: 36}\n  crank_drive: {pair"),
    )  # fmt: skip
    assert "shafts_main" not in made


def test_a_key_below_two_riders_passes_what_the_only_other_part_takes() -> None:
    made = read(
        ("      - {pulley: large, at: 42, hub: 72, key: 63}\n", ""),
        ('- {flywheel: rim, at: 170, hub: 82, key: 70, inertia: "${train.flywheel_inertia}"}',
         "- {coupling: hub, at: 170, hub: 110, key: 70, mass: 6 kg}\n      - {pulley: large, at: 140, hub: 40, rides_on: hub}\n"
         '      - {flywheel: rim, at: 190, hub: 60, rides_on: hub, inertia: "${train.flywheel_inertia}"}'),
    )  # fmt: skip
    assert made["shafts_flywheel_hub_key"]["torque"] == "${shafts_flywheel_loads.pinion_torque}"


def test_sprockets_that_share_a_torque_are_not_rated_by_the_inertia_alone() -> None:
    made = read(
        ("conveyor: [216, 520]", "lay: [216, 520], conveyor: [216, 1015.3]"), ("far: [2216.254, 520]", "far: [2216.254, 1015.3]"),
        with_shaft("lay", "{gear: small, at: 85, integral: true}",
         "{sprocket: l, at: 160, hub: 60, key: 50}", "{sprocket: r, at: 270, hub: 60, key: 50}"),
        ("      - {gear: small, at: 140, integral: true}\n",
         "      - {sprocket: l, at: 130, hub: 50, key: 40}\n      - {sprocket: r, at: 240, hub: 50, key: 40}\n"),
        ("step_up: {pair: [geneva.large, conveyor.small]", "step_up: {pair: [geneva.large, lay.small]"),
        ("  grippers: {", "  up: {sprockets: [lay.l, lay.r], to: [conveyor.l, conveyor.r], teeth: 30/30, chain: 12B, links: 82}\n  grippers: {"),
    )  # fmt: skip
    assert not {"shafts_conveyor", "shafts_conveyor_r_key"} & made.keys()


def test_a_chain_before_the_main_shaft_is_a_pair_of_the_drive_train() -> None:
    found = changed(
        ("flywheel: [216, -262.5], motor: [216, -856.602]", "flywheel: [216, -862.5], motor: [216, -1456.602]"),
        ("- {gear: pinion, at: 445, integral: true}", "- {sprocket: pinion, at: 445, hub: 40, key: 36}"),
        ("- {gear: wheel, at: 200, hub: 100, key: 90}", "- {sprocket: wheel, at: 200, hub: 100, key: 90}"),
        ('  main_drive: {pair: [flywheel.pinion, main.wheel], teeth: 18/87, module: 5, width: 50,\n'
         '    application_factor: {value: 1, basis: standard, note: "ISO 6336-6: the torque is that of the whole cycle"}}\n', ""),
        ("chains:\n", "chains:\n  main_drive: {sprockets: [flywheel.pinion], to: [main.wheel], teeth: 18/87, chain: 12B, links: 146}\n"),
    )  # fmt: skip
    gears = found.made["train"]["gears"] if not found.problems else []
    assert [(each["driver_teeth"], each["driven_teeth"]) for each in gears] == [("18", "87")], found.problems


@pytest.mark.parametrize("where", ["main_drive", "crank_drive"])
def test_shafts_that_drive_each_other_are_refused_at_once(where: str) -> None:
    text = told((f"  {where}: {{pair", f"  back: {{pair: [crank.back, main.back], teeth: 30/30, module: 4, width: 30}}\n  {where}: {{pair"),
                ("      - {gear: wheel, at: 200,", "      - {gear: back, at: 270, hub: 30, key: 28}\n      - {gear: wheel, at: 200,"),
                ("      - {clutch: clutch, at: 130,", "      - {gear: back, at: 200, hub: 30, key: 28}\n"
         "      - {clutch: clutch, at: 130,"))  # fmt: skip
    assert ("drives" in text and "name the driving part of each join first" in text) or "closes a ring" in text


# Teeth and shafts.


def test_a_sprocket_has_a_hub_around_its_shaft() -> None:
    text = told(("teeth: 30/30, chain: 12B, links: 240", "teeth: 30/12, chain: 12B, links: 230"))
    assert text.count("is 61.5335 mm thick below its teeth, less than 1.5 times its seat of 65 mm") == 2


# What cannot be, and the driving part that is not named first.

STEPS = ("teeth: 30/30, chain: 12B, links: 240", "teeth: 30/28, chain: 12B, links: 120")
REFUSED: list[tuple[list[Change], str]] = [
    ([("moves: cross.conveyor, moving_mass", "moving_mass")], "chains.grippers.moving_mass: is moved by chains that say what they move; give moves"),
    ([("motor: [216, -856.602]", "motor: [216, -862.321]"), ("diameters: 125/375, length: 2000", "diameters: 125/500, length: 2240")],
     "belts.motor.diameters: makes 4455 sheets an hour of the motor's speed, but 6000 are asked for"),
    ([STEPS], "chains.grippers: puts the axes 866.754 mm apart"),
    ([(CONVEYOR, "60x40 r1.4, 75x640 r1.4, 60x40")],
     "shafts.conveyor.parts.2.integral: is 70 mm thick below its teeth, which are cut into a shaft of 75 mm"),
    ([("held: 60", "held: 150")], "a pin is held within its disc"),
    ([("to: [far.left, far.right],", "to: [far.left, far.right], direction: 0,")], "follows from the axes"),
    ([("pair: [rocker.sector, pinion.pinion], teeth: 212/35", "pair: [pinion.pinion, rocker.sector], teeth: 35/212")],
     "drives rocker, which drive.rocker moves; name the part of rocker first"),
    ([("pair: [rocker.sector, pinion.pinion]", "pair: [pinion.pinion, rocker.sector]")], "drives rocker, which drive.rocker moves"),
    ([("pair: [geneva.large, conveyor.small], teeth: 120/20", "pair: [conveyor.small, geneva.large], teeth: 20/120")],
     "drives geneva, which cross.wheel moves; name the part of geneva first"),
    ([("pair: [flywheel.pinion, main.wheel], teeth: 18/87", "pair: [main.wheel, flywheel.pinion], teeth: 87/18")],
     "drives flywheel, which main_drive drives too; name the driving part of each join first"),
    ([("sprockets: [conveyor.left, conveyor.right], to: [far.left, far.right]",
       "sprockets: [far.left, far.right], to: [conveyor.left, conveyor.right]")],
     "is driven by no other shaft, though cross.wheel moves it"),
    ([("to: [far.left, far.right]", "to: [pinion.left, pinion.right]")], "drives"),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "words"), REFUSED, ids=[words[:40] for _, words in REFUSED])
def test_what_cannot_be_is_refused(changes: list[Change], words: str) -> None:
    assert words in told(*changes)


# Where the inertia of a part acts: at the part, so that its joint with the shaft passes it.


@pytest.fixture(scope="module")
def run() -> Any:
    return run_of(text=CORRECTED).calculations


def of_cycle(calc: Any, name: str) -> Any:
    """A curve of loads at 4000 places of their cycle, none of them at an end of a smooth piece."""
    domain = next(iter(calc.domains.values()))
    places = np.atleast_2d((np.arange(4000) + 0.37) / 4000 * domain.period[0, 0])
    return calc.sample(name, places, domain.middle_of(places))[0]


@pytest.mark.nightly
def test_the_key_of_a_gear_on_a_stepping_shaft_passes_the_torque_of_its_inertia_too(run: Any) -> None:
    """By Newton for the gear alone: what its key passes accelerates it, and the rest of what is behind its teeth."""
    loads, cross = run["shafts_geneva_loads"], run["cross"]
    gear = 26 * (120 * 4 / 2 * 1e-3) ** 2 / 2  # a disc of its typed mass
    whole = run["shafts_geneva_body"]["inertia"].item()
    acceleration = -of_cycle(loads, "large_inertia_torque") / gear
    assert np.abs(acceleration).max() == pytest.approx(np.abs(cross["wheel_acceleration_max"]).item(), rel=1e-3)
    teeth, hub = of_cycle(loads, "large_torque"), of_cycle(loads, "large_hub")
    np.testing.assert_allclose(hub, teeth - gear * acceleration, rtol=0, atol=1e-9 * np.abs(hub).max())
    assert np.abs(hub).max() > 1.05 * np.abs(teeth).max()
    assert run["shafts_geneva_large_key"]["torque_peak"].item() == pytest.approx(np.abs(hub).max(), rel=1e-3)
    wheel = of_cycle(loads, "balance") + of_cycle(loads, "cross_inertia_torque")
    np.testing.assert_allclose(of_cycle(loads, "cross_hub"), wheel, rtol=0, atol=1e-9 * np.abs(wheel).max())
    every = sum(of_cycle(loads, f"{name}_torque") for name in ("large_inertia", "cross_inertia", "inertia"))
    np.testing.assert_allclose(every, -whole * acceleration, rtol=1e-9, atol=1e-9)


def test_a_sprocket_accelerates_its_chain_that_rolls_the_cylinder(run: Any) -> None:
    loads, line, body = run["shafts_pinion_loads"], run["drive_line"], run["shafts_pinion_body"]
    chain = line["chain_mass"][0, 0] * line["chain_travel"][0, 0] ** 2 / 2  # of both strands
    own = chain + body["disc_inertia"][0, list(body.inputs["discs.name"]).index("left")]
    assert loads["torques.inertia"][0, list(loads.inputs["torques.name"]).index("left_inertia")] == pytest.approx(own)
    assert np.abs(of_cycle(loads, "left_hub")).max() > 1.05 * np.abs(of_cycle(loads, "left_torque")).max()


def test_the_motor_runs_up_all_that_turns(run: Any) -> None:
    """The flywheel and its shaft, what is behind it by the ratio squared and with the losses, and the rotor."""
    train, lines = run["train"], run["train"]["moved_inertia"].item()
    second = train["flywheel_inertia"].item() + run["shafts_flywheel_body"]["inertia"].item()
    output = lines + run["shafts_main_body"]["inertia"].item() + run["shafts_crank_body"]["inertia"].item() / 4
    gears, belt = (87 / 18) ** 2 * 0.97, train["vbelt_ratio_actual"].item() ** 2 * train["vbelt.efficiency"].item()
    inertia = train["motor_inertia"].item() + (second + output / gears) / belt
    assert train["run_up_inertia"].item() == pytest.approx(inertia, rel=1e-6)
    time = inertia * train["shaft_1_speed"].item() / train["accelerating_torque"].item()
    assert train["run_up_time"].item() == pytest.approx(time, rel=1e-6)


def test_a_flywheel_that_follows_from_the_drive_train_counts_in_the_machine(run: Any) -> None:
    machine, train, body = run["machine_inertia"], run["train"], run["shafts_flywheel_body"]
    place = list(machine.inputs["shafts.name"]).index("flywheel")
    for what in ("mass", "inertia"):
        alone, wheel = body[what].item(), train[f"flywheel_{what}"].item()
        assert machine[f"shafts.{what}"][0, place] == pytest.approx(alone + wheel, rel=1e-12)
    assert train["flywheel_mass"].item() > 100


ROLL = (
    ("conveyor: [216, 520], far: [2216.254, 520]}", "conveyor: [216, 520], far: [2216.254, 520], roll: [2216.254, 680]}"),
    ("sprockets: [conveyor.left, conveyor.right], to: [far.left, far.right]", "sprockets: [conveyor.left], to: [far.left]"),
    ("            {sprocket: right, at: 635, hub: 50, key: 45}, {bearing: b, at: 691",
     "            {gear: out, at: 160, hub: 50, key: 45}, {bearing: b, at: 691"),
    ("meshes:\n", "  roll:\n    sections: 55x40 r1.5, 65x300 r1.5, 55x40\n    parts: [{bearing: a, at: 29, designation: \"6211\"}, "
     "{gear: in, at: 120, hub: 50, key: 45}, {load: roll, at: 240, mass: 40 kg, inertia: 0.3 kg*m**2}, "
     "{bearing: b, at: 351, designation: \"6211\", floating: true}]\nmeshes:\n"
     "  roll: {pair: [far.out, roll.in], teeth: 40/40, module: 4, width: 40}\n"),
)  # fmt: skip


@pytest.mark.nightly
def test_what_the_far_end_of_a_chain_drives_is_moved_by_all_before_it() -> None:
    """A roll behind the conveyor's far shaft: the driving sprocket pulls what the driven one takes, and moves the chain besides."""
    right = "      - {sprocket: right, at: 635, hub: 60, key: 50}\n"
    run = run_of(*ROLL, (right, ""), text=CORRECTED).calculations
    driving, driven, line = run["shafts_conveyor_loads"], run["shafts_far_loads"], run["drive_line"]
    chain = list(line.inputs["chains.name"]).index("grippers")
    mass = line["chain_mass"][0, chain] * line["chain_travel"][0, chain] ** 2
    acceleration = -of_cycle(driving, "inertia_torque") / driving["torques.inertia"][0, -1]
    both = mass * acceleration + of_cycle(driven, "balance")
    pulled = -of_cycle(driving, "left_torque")
    drives = both > 0  # where it brakes, losses help, and count against it here: safe
    np.testing.assert_allclose(pulled[drives], both[drives], atol=1e-6 * both.max())
    assert np.all(np.abs(pulled[~drives]) >= np.abs(both[~drives]) - 1e-6)
    inertia = run["shafts_far_body"]["inertia"].item() + run["shafts_roll_body"]["inertia"].item() / 0.97
    assert run["chains_grippers"]["inputs.driven_inertia"].item() == pytest.approx(inertia, rel=1e-9)


FAR_PUMP = (
    "{sprocket: right, at: 635, hub: 50, key: 45}",
    "{load: pump, at: 400, torque: -300 N*m}, {sprocket: right, at: 635, hub: 50, key: 45}",
)
BRANCH = (
    ("frame: {crank: [0, 0],", "frame: {lay: [0, 216], crank: [0, 0],"),
    ("      - {bearing: b, at: 270,", "      - {gear: out, at: 210, hub: 60, key: 50}\n      - {bearing: b, at: 270,"),
    ("meshes:\n", "  lay:\n    sections: 50x40 r1.6, 60x290 r1.6, 50x40\n    parts: [{bearing: a, at: 27, designation: \"6210\"}, "
     "{gear: g, at: 110, hub: 60, key: 50}, {load: pump, at: 250, torque: 300 N*m}, "
     "{bearing: b, at: 343, designation: \"6210\", floating: true}]\nmeshes:\n"
     "  lay: {pair: [crank.out, lay.g], teeth: 36/36, module: 6, width: 50}\n"),
)  # fmt: skip


def test_nothing_before_a_torque_that_no_mechanism_knows_is_rated() -> None:
    """Gear and key before the chain were rated with what was left: 309 N·m for 1408; a pump of the motor's power was free."""
    rated = {
        "shafts_geneva",
        "shafts_geneva_large_key",
        "meshes_step_up",
        "chains_grippers",
        "shafts_main",
        "meshes_main_drive",
    }
    assert rated < read().keys()
    made = read(FAR_PUMP)
    assert not rated & made.keys()
    made = read(*BRANCH)
    before = {"shafts_crank", "meshes_crank_drive", "shafts_main", "meshes_main_drive", "shafts_flywheel"}
    assert not before & made.keys() and {"shafts_geneva", "meshes_step_up"} < made.keys()


@pytest.mark.parametrize(("turns", "cycle"), [("1", 6), ("1/2", 12), ("1/3", 18), ("2", 3)])
def test_a_stepping_shaft_comes_back_after_all_its_steps_however_often_its_crank_turns(turns: str, cycle: int) -> None:
    found = changed(("- mechanism: cross #", f"- turns_per_sheet: {turns}\n        mechanism: cross #"))
    data = yaml.safe_load(found.config.tree.text)["mechanisms"]
    kinds = {kind: DISCOVERY.mechanism(kind) for kind in {block["kind"] for block in data.values()}}
    assert Demands(found.parts, data, kinds).turns("geneva") == Fraction(1, cycle)


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("outside", "status"), [("", "not_checked"), (", outside: 600", "pass"), (", outside: 1500", "fail")]
)
def test_the_rim_that_is_checked_is_that_of_the_mounted_wheel(outside: str, status: str) -> None:
    """One of a bore's mass passed by the diameter of the wheel that the drive train would have."""
    wheel = 'inertia: "${train.flywheel_inertia}"}'
    found = changed((wheel, f"inertia: 3.0 kg*m**2, mass: 66 kg{outside}}}"))
    if found.problems:  # a wheel of 1.5 m is heavier
        assert status == "fail" and "full steel body" in found.told
        return
    checks = PRESS.calculate(found.config).checks["train"]
    assert {each.id: each.status for each in checks if "rim" in each.id} == {"mounted_rim_speed": status}


def test_each_sprocket_side_by_side_has_its_share_where_the_clutch_engages() -> None:
    parts = changed().parts
    cases, shaft = LoadCases(parts, {}, {}), parts.shafts["conveyor"]
    left, right = (part for part in shaft.parts if part.kind == "sprocket")
    small = next(part for part in shaft.parts if part.kind == "gear")
    cases.__dict__["load_cases"] = [Passing("engage", "100 N*m", (small,), (left, right))]
    assert [cases.cases_of_key(part)[0]["torque"] for part in (left, right)] == ["(100 N*m) / 2"] * 2
    assert [(each["name"], each["leaves"], each["torque"]) for each in cases.cases_of_shaft(shaft)] == [
        ("engage", "left", "100 N*m"),  # all of it may pass one of them
        ("engage_2", "right", "100 N*m"),
    ]


@pytest.mark.parametrize("name", ["engage", "engage_2", "engage_6", "start", "stop", "stop_2"])
def test_a_load_case_has_words_whichever_number_it_has(name: str) -> None:
    assert called(1, (name,)) in ("engagement of the clutch", "start of the motor", "stop by the brake")


# A brake stops the flywheel: its torque passes all that is between them.

ON_MAIN = "      - {gear: pinion, at: 360, integral: true}"
BRAKE = "{brake: stop, at: 290, hub: 60, key: 50, brake_torque: 1300 N*m, mass: 9 kg, inertia: 0.05 kg*m**2"


def stops(*changes: tuple[str, str]) -> list[tuple[str, ...]]:
    """The load cases *stop* of a changed machine: shaft, where the torque enters and leaves, or the pair; and its torque."""
    parts = changed(*changes).parts
    cases = LoadCases(parts, parts.reader.data["mechanisms"], {})
    return [
        (each.shaft.name, each.enters[0].name, each.leaves[0].name, each.torque)
        if isinstance(each, Passing)
        else (each.join.name, each.torque)
        for each in cases._stops()
    ]


NOT_THERE = "stands neither between the flywheel and the main shaft"
TORQUE, RUN = "${drive_line.brakes.0.torque}", "${timing.torque_peak}"
TO_FLYWHEEL = "(${drive_line.meshes.0.teeth_1} / ${drive_line.meshes.0.teeth_2})"


def test_a_brake_on_the_main_shaft_loads_all_up_to_the_flywheel_with_what_the_lines_take() -> None:
    made = read((ON_MAIN, f"      - {BRAKE}, stops_per_hour: 10 1/h}}\n{ON_MAIN}"))
    before = f"{TORQUE} * {TO_FLYWHEEL} / 0.97 + {RUN} * {TO_FLYWHEEL} * 1 / 0.97"
    own = [each["torque"] for each in made["shafts_main"]["load_cases"] if each["name"] == "stop"]
    assert own == [f"{TORQUE} + {RUN}"]
    stop = next(each for each in made["meshes_main_drive"]["load_cases"] if each["name"] == "stop")
    assert stop["torque"] == before and stop["cycles"] == "200000"
    assert made["shafts_flywheel_rim_key"]["load_cases"][-1] == {"name": "stop", "torque": before}
    assert "stop" not in names(made["shafts_crank"]["load_cases"])
    assert made["shafts_main_stop_key"]["torque"] == TORQUE


def test_what_a_brake_loads_is_rated_for_it_and_the_way_to_rest_follows() -> None:
    """By hand (1300 + 1095.5) · 18/87/0.97 N·m at the pinion, where the stop comes when the lines take most."""
    machine = run_of((ON_MAIN, f"      - {BRAKE}}}\n{ON_MAIN}"), text=CORRECTED)
    values = {name: each.values for name, each in machine.calculations.items()}
    mean, peak = (values["timing"][name].item() for name in ("torque_mean", "torque_peak"))
    assert peak == pytest.approx(1095.5, abs=0.1)
    assert values["shafts_main_wheel_key"]["torque_peak"].item() == pytest.approx(1300 + peak)
    assert values["meshes_main_drive"]["torque_root"].item() == pytest.approx((1300 + peak) * 18 / 87 / 0.97)
    # so often, as nobody says how often
    assert values["meshes_main_drive"]["pitting_case"].item() == "stop by the brake"
    own = values["consistency"]
    assert own["stopping_angle"].item() == pytest.approx(own["energy_running"].item() / (1300 + mean))


def test_a_brake_beside_the_flywheel_and_one_behind_a_clutch() -> None:
    """Behind the clutch it holds what the clutch drives; the flywheel turns on, and nothing of its way to rest is said."""
    bearing, clutch = "      - {bearing: b, at: 387.5", "      - {clutch: clutch, at: 130"
    beside = stops((bearing, f"      - {BRAKE}}}\n{bearing}"))
    assert beside == [("flywheel", "rim", "stop", f"{TORQUE} + {RUN} * {TO_FLYWHEEL} * 1 / 0.97")]
    held = (clutch, f"      - {BRAKE.replace('at: 290, hub: 60, key: 50', 'at: 215, hub: 40, key: 36')}}}\n{clutch}")
    found = sound(held, text=CORRECTED)
    own = found.made["shafts_crank"]["load_cases"]
    torque = "${drive_line.clutch_brakes.0.torque}"
    assert {"name": "stop", "torque": torque, "enters": "stop", "leaves": "disc"} in own
    assert "stop" not in names(found.made["shafts_flywheel"]["load_cases"])
    line = found.made["drive_line"]
    assert "brakes" not in line and line["clutch_brakes"][0]["name"] == "crank_stop"
    consistency = found.config.instances["consistency"]
    assert consistency is not None and "brake_torque" not in consistency.data


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        (ON_MAIN, f"      - {BRAKE.replace('brake_torque: 1300 N*m, ', '')}}}\n{ON_MAIN}", "has no torque"),
        ("{gear: wheel, at: 200, hub: 100,", "{gear: wheel, at: 200, hub: 100, brake_torque: 5 N*m,", "is a key of a brake, and this is a gear"),
        ("{gear: wheel, at: 200, hub: 100,", "{gear: wheel, at: 200, hub: 100, stops_per_hour: 5 1/h,", "is a key of a brake"),
        ("      - {sprocket: left, at: 75, hub: 60, key: 50}\n      - {gear: pinion,",
         f"      - {{sprocket: left, at: 75, hub: 60, key: 50}}\n      - {BRAKE}}}\n      - {{gear: pinion,", NOT_THERE),
        ("[{pulley: small, at: 25}]", f"[{{pulley: small, at: 25}}, {BRAKE}}}]", NOT_THERE),
        (ON_MAIN, f"      - {BRAKE}}}\n      - {BRAKE.replace('stop', 'more').replace('290', '275')}}}\n{ON_MAIN}", "is a second brake"),
        ("    single_position:", "    brake_torque: 900 N*m\n    single_position:", "drive_line.brake_torque"),
    ],
)  # fmt: skip
def test_a_brake_that_cannot_be_is_refused(old: str, new: str, what: str) -> None:
    changes = [(old, new)]
    if old.startswith("    single"):
        changes.append((ON_MAIN, f"      - {BRAKE}}}\n{ON_MAIN}"))
    assert what in told(*changes)


def test_a_brake_beyond_the_main_shaft_stands_behind_a_clutch() -> None:
    """Elsewhere what the run takes of the shafts between is not known as one number."""
    brake = BRAKE.replace("at: 290, hub: 60, key: 50", "at: 215, hub: 40, key: 36")
    sleeve = "      - {coupling: sleeve, at: 130, hub: 80,"
    said = told(
        ("      - {clutch: clutch, at: 130, hub: 80,", f"      - {brake}}}\n{sleeve}"),
        ("rides_on: clutch}", "rides_on: sleeve}"),
    )
    assert NOT_THERE in said


def test_a_brake_of_which_no_part_is_known_is_open() -> None:
    parts = sound(("    single_position:", "    brake_torque: 900 N*m\n    single_position:"), text=CORRECTED).parts
    why = {each.path: str(each.why) for each in unrated(parts, "train", {}, "")}
    wanted = "no part of the machine is this brake, so that its torque loads nothing"
    assert why["mechanisms.consistency.brake_torque"] == wanted


# Joins side by side.


def test_pairs_of_unlike_ratio_between_the_same_shafts_are_refused() -> None:
    old = "  crank_drive: {pair: [main.pinion, crank.wheel], teeth: 24/48, module: 6, width: 50,"
    second = "  second: {pair: [main.pinion, crank.wheel], teeth: 30/42, module: 6, width: 50}"
    assert "so that neither can turn; give both one ratio" in told((old, f"{second}\n{old}"))
    made = changed((old, f"{second.replace('30/42', '24/48')}\n{old}")).made
    assert not {"shafts_main", "meshes_crank_drive", "meshes_second"} & made.keys()  # shares that nobody knows


MAIN_DRIVE = "  main_drive: {pair: [flywheel.pinion, main.wheel], teeth: 18/87, module: 5, width: 50,"


@pytest.mark.parametrize(("typed", "is_refused"), [("shift_1: 0.1,", True), ("shift_1: 0.3, shift_2: -0.3,", False)])
def test_profile_shifts_leave_the_axes_where_the_frame_has_them(typed: str, is_refused: bool) -> None:
    """By 0.1 the teeth of the drawing would be 0.36 mm too thick for their gaps."""
    assert ("do not add up to zero" in told((MAIN_DRIVE, f"{MAIN_DRIVE} {typed}"))) == is_refused


@pytest.mark.nightly
def test_the_material_of_a_pair_stands_before_that_of_all_gears(tmp_path: Path) -> None:
    """It was left out without a word: S_H 1.62 for 0.76."""
    table = "gear_materials:\n  soft: {sigma_h_lim: 700 MPa, sigma_f_lim: 280 MPa, source: maker}\n"
    (tmp_path / "own.yaml").write_text(table)
    text = CORRECTED.replace(MAIN_DRIVE, f"{MAIN_DRIVE} material_1: soft, material_2: soft,")
    text = text.replace("\nmachine:", "\nmaterials: own.yaml\nmachine:", 1)
    file = tmp_path / "press.yaml"
    file.write_text(text)
    press = Press.read(file, DISCOVERY)
    mesh = press.config.tree.data["mechanisms"]["meshes_main_drive"]
    assert not {"sigma_h_lim_1", "sigma_f_lim_2"} & mesh.keys() and mesh["material_1"] == "soft"
    run = PRESS.calculate(press.config).calculations
    assert run["meshes_main_drive"]["pitting_safety_1"].item() == pytest.approx(1.6244 * 700 / 1500, rel=1e-3)


@pytest.mark.parametrize(
    ("right", "wrong", "words"),
    [("meshes:", "mesh:", "mesh: is an unknown key (did you mean 'meshes'?)"), ("belts:", "belt:", "belt: is an unknown key (did you mean 'belts'?)"),
     ("machine:", "machin:", "machin: is an unknown key (did you mean 'machine'?)"), ("shafts:", "Shafts:", "(did you mean 'shafts'?)")],
)  # fmt: skip
def test_a_block_of_parts_whose_name_is_mistyped_is_told_alone(right: str, wrong: str, words: str) -> None:
    """What followed from its lack hid it: a radial force was to be removed, and right names were unknown."""
    problems = changed((f"\n{right}", f"\n{wrong}")).problems
    assert len(problems) == 1 and words in problems[0] and "machine, shafts, meshes, chains, belts" in problems[0]


def test_each_strand_runs_in_one_plane() -> None:
    before, _, after = CORRECTED.rpartition("{sprocket: right, at: 635")
    found = machine(text=before + "{sprocket: right, at: 560" + after)
    assert "stands 75 mm beside conveyor.right, with which it works" in found.told


# What is lost on the way to a mechanism.

LINE = "turns_per_sheet: 1/2, path_efficiency: {value: 0.97, basis: assumed, note: the pair u = 2}"


@pytest.mark.nightly
def test_what_the_cyclogram_loses_beyond_the_meshes_passes_the_main_shaft_too() -> None:
    """The wheel's key, the mesh on it and the cyclogram say one torque."""
    machine = run_of(text=CORRECTED)
    peak, least = (machine.calculations["timing"].values[name].item() for name in ("torque_peak", "torque_min"))
    key, mesh = (machine.calculations[name].values for name in ("shafts_main_wheel_key", "meshes_main_drive"))
    assert key["torque_peak"].item() == pytest.approx(peak, rel=1e-9)
    assert key["torque_least"].item() == pytest.approx(least, rel=1e-9)
    assert mesh["torque_run"].item() == pytest.approx(peak * 18 / 87 / 0.97, rel=1e-9)


def test_what_is_lost_before_a_mechanism_is_what_the_meshes_leave() -> None:
    made = read((LINE, "turns_per_sheet: 1/2, path_efficiency: 0.9"))
    rows = {each["name"]: each for each in made["shafts_crank_loads"]["torques"]}
    assert float(rows["disc"]["efficiency"]) == pytest.approx(0.9 / 0.97)
    assert "efficiency" not in read()["shafts_crank_loads"]["torques"][0]
    main = {each["name"]: each for each in made["shafts_main_loads"]["torques"]}
    assert float(main["pinion"]["efficiency"]) == pytest.approx(0.9) and float(main["disc"]["efficiency"]) == 0.95


def test_an_efficiency_counts_where_another_pair_follows() -> None:
    """Of two pairs one behind the other each may have its own."""
    mesh = ("teeth: 24/48, module: 6, width: 50,", "teeth: 24/48, module: 6, width: 50, efficiency: 0.96,")
    made = read(mesh, (LINE, "turns_per_sheet: 1/2, path_efficiency: 0.9"))
    rows = {each["name"]: each for each in made["shafts_main_loads"]["torques"]}
    assert float(rows["pinion"]["efficiency"]) == pytest.approx(0.9)


def test_the_chain_that_rolls_the_cylinder_is_not_the_conveyor_of_the_sheets() -> None:
    """Where it is the only chain: 287 kg of the cylinder were compared with the 22.6 kg of a feeder's conveyor."""
    consistency = changed().config.instances["consistency"]
    assert consistency is not None and consistency.data["chain"] == "chains_grippers"
    grippers = CORRECTED[CORRECTED.index("  grippers: {sprockets") : CORRECTED.index("belts:")]
    alone = changed((grippers, "")).config
    kinds = [name for name, kind in alone.kinds.items() if kind == "roller_chain"]
    rest = alone.instances["consistency"]
    assert rest is not None and kinds == ["chains_cylinder"] and "chain" not in rest.data


@pytest.mark.parametrize("path", ['"${clutch.wedge_friction} + 0.75"', "85 %", "0.85"])
def test_a_loss_counts_however_it_is_typed(path: str) -> None:
    made = read((LINE, f"turns_per_sheet: 1/2, path_efficiency: {path}"))
    rows = {each["name"]: each for each in made["shafts_crank_loads"]["torques"]}
    assert float(rows["disc"]["efficiency"]) == pytest.approx(0.85 / 0.97)


def test_a_loss_that_is_calculated_is_refused_and_one_that_is_too_small_told() -> None:
    calculated = (LINE, 'turns_per_sheet: 1/2, path_efficiency: "${drive.power_mean} / (2 kW)"')
    assert "refers to what is calculated" in told(calculated)
    assert len(changed((LINE, "turns_per_sheet: 1/2, path_efficiency: 99 %")).found("losses")) == 1


def test_flywheel_and_pulley_on_a_clutch_pass_it_what_the_pinion_takes() -> None:
    found = changed(
        ("- {pulley: large, at: 42, hub: 72, key: 63}",
         "- {clutch: clutch, at: 170, hub: 82, key: 70, mass: 6 kg}\n      - {pulley: large, at: 170, rides_on: clutch}"),
        ("- {flywheel: rim, at: 170, hub: 82, key: 70,", "- {flywheel: rim, at: 170, rides_on: clutch,"),
        ("- {clutch: clutch, at: 130, hub: 80,", "- {coupling: sleeve, at: 130, hub: 80,"),
        ("rides_on: clutch}\n      - {bearing: b, at: 270", "rides_on: sleeve}\n      - {bearing: b, at: 270"),
        ("clutch_drives: [drive]", "clutch_drives: [drive, cross]"),
    )  # fmt: skip
    assert found.made["clutch"]["torque_curve"] == "${shafts_flywheel_loads.pinion_torque}"


@pytest.mark.nightly
def test_a_chain_over_idlers_pulls_in_its_direction() -> None:
    """Without one it is told that the frame's x is taken."""
    for degrees, y, z in ((0, 1, 0), (90, 0, 1), (180, -1, 0)):
        made = changed(("moves: drive.cylinder, direction: 0,", f"moves: drive.cylinder, direction: {degrees},")).made
        rows = [each for each in made["shafts_pinion_loads"]["forces"] if each["name"].startswith("left_")]
        forces = {each["name"]: float(each["ratio"].split(" * ")[0]) for each in rows}
        assert np.sign(forces.get("left_y", 0)) == y and ("left_z" in forces) == bool(z)
        assert ("left_y" in forces) == bool(y)
    [found] = changed(("direction: 0, ", "")).found("chain")
    assert "along the frame's x is taken" in found.message


@pytest.mark.parametrize(("drives", "is_right"), [("[drive]", True), ("[cross]", False), ("[drive, cross]", False)])
def test_the_lines_of_a_clutch_are_those_behind_it(drives: str, is_right: bool) -> None:
    text = told(("clutch_drives: [drive]", f"clutch_drives: {drives}"))
    assert ("of the parts the clutch drives drive" in text) != is_right
