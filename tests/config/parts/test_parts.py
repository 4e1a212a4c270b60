"""The parts of a machine: the numbers of the method's sheet, what each rule refuses, and what references to parts stand for."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from math import pi
from types import SimpleNamespace
from typing import Any

import pytest

from diecut_report.config.loader import Config, load_config
from diecut_report.config.parts.model import MachineParts
from diecut_report.config.validation import Basis
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.report.chapters.front import not_covered
from diecut_report.report.scope import scope
from diecut_report.report.text import Catalogue
from diecut_report.results.drive_line import CarryingPart, accepted, carrying_parts, is_rated, unrated
from diecut_report.results.open_items import is_formula, unrated_forces
from diecut_report.results.press_run import Run
from diecut_report.results.results_file import results_text
from diecut_report.results.warm_press import WarmPress
from diecut_report.time_limit import limited
from tests.config.parts.machines import DISCOVERY, FILE, PRESS, TEXT, Machine, machine, run_of, sound, whole
from tests.examples import every, few

MM = 1e-3


def made() -> dict[str, Any]:
    """Its mechanisms and the calculations of its parts."""
    return dict(whole().tree.data["mechanisms"])


def parts() -> MachineParts:
    """Its parts."""
    found = whole().parts
    assert found is not None
    return found


@cache
def calculated(*kinds: str) -> Run:
    """Only the calculations of some kinds, which follow from numbers of the file alone."""
    config = whole()
    names = {
        name
        for name, instance in config.instances.items()
        if instance and instance.mechanism and instance.mechanism.kind in kinds
    }
    order = tuple(node for node in config.order if node[0] in names or len(node) > 1 or node == ("press",))
    return Run(replace(config, order=order), lambda _: None)


def test_places_and_distances_are_those_of_the_sheet() -> None:
    wanted = {"main": 0, "crank": 200, "flywheel": -263, "rocker": 380, "pinion": 345, "geneva": -290}
    assert {name: pytest.approx(parts().lefts[name] / MM) for name in wanted} == wanted
    meshes = {join.name: join.center_distance for join in parts().joins if join.word == "meshes"}
    assert meshes == pytest.approx({"main_drive": 0.21, "crank_drive": 0.18, "sector": 0.494, "step_up": 0.28})


@pytest.mark.parametrize(
    ("shaft", "mass", "inertia"),
    [
        ("main", "57.76", "0.5759"), ("crank", "36.88", "0.1297"), ("pinion", "12.52", "0.03467"), ("geneva", "57.87", "1.223"),
        ("conveyor", "15.34", "0.0226"), ("far", "14.62", "0.0218"),
    ],
)  # fmt: skip
def test_masses_and_inertias_are_those_of_the_sheet(shaft: str, mass: str, inertia: str) -> None:
    body = calculated("shaft_body", "drive_line", "cylinder_sizing").calculations[f"shafts_{shaft}_body"]
    assert f"{float(body['mass'][0, 0]):.4g}" == f"{float(mass):.4g}"
    assert f"{float(body['inertia'][0, 0]):.4g}" == f"{float(inertia):.4g}"


def test_the_speed_of_a_shaft_is_that_of_the_anchor_times_the_ratios_of_the_teeth() -> None:
    line = calculated("shaft_body", "drive_line", "cylinder_sizing").calculations["drive_line"]
    speeds = dict(zip(line.inputs["shafts.name"], line["speed"][0], strict=True))
    assert speeds["crank"] == pytest.approx(speeds["main"] * 24 / 48)
    assert speeds["flywheel"] == pytest.approx(speeds["main"] * 87 / 18)
    assert speeds["motor"] == pytest.approx(speeds["flywheel"] * 3 / 0.99)


def test_what_is_found_in_the_example_is_the_clutch_in_the_plane_of_the_main_shaft() -> None:
    assert [(each.rule, each.level) for each in parts().findings] == [("planes", "warning")]
    (text,) = (str(each.message) for each in parts().findings)
    assert "180 mm" in text and "crank.clutch" in text


def test_the_travel_of_the_chain_differs_from_the_radius_of_the_cylinder_as_the_sheet_says() -> None:
    line = calculated("shaft_body", "drive_line", "cylinder_sizing").calculations["drive_line"]
    assert line["rolling_travel"][0, 0] == pytest.approx(0.105106, abs=5e-7)
    assert line["rolling_error"][0, 0] == pytest.approx(1 - 105.106 / 105.5, abs=1e-5)


BROKEN = [
    ("key: 40}\n      - {bearing: a, at: 91", "key: 41}\n      - {bearing: a, at: 91", "not a length of DIN 6885-1"),
    ("{gear: wheel, at: 155, hub: 60, key: 50}", "{gear: wheel, at: 155, hub: 45, key: 50}", "is 50 mm long, but its hub is 45 mm long"),
    ("at: 100, designation: \"6210\"", "at: 100, designation: \"6212\"", "has a bore of 60 mm, but sits on a diameter of 50 mm"),
    ("pin: {diameter: 40, held: 50, plane: 15, bearing: NU2208E}", "pin: {diameter: 45, held: 50, plane: 15, bearing: NU2208E}",
     "has a bore of 40 mm, but sits on a pin of 45 mm"),
    ("{gear: wheel, at: 155,", "{gear: wheel, at: 120,", "begins at 90 mm, but a ends at 110 mm"),
    ("{crank: disc, of: cross.crank, at: 35,", "{crank: disc, of: cross.crank, at: 20,", "the shaft goes from 0 to"),
    ("designation: NU210E, floating: true", "designation: NU210E", "exactly one is needed"),
    ("50x40 r1, 60x320 r1, 50x40", "50x40 r1.1, 60x320 r1, 50x40", "with a fillet of 1.1 mm, too large for its ring with corners from 1.1 mm"),
    ("conveyor: [180, 520]", "conveyor: [180, 521]", "puts the axes 280 mm apart"),
    (", far: [2180.254, 520]}", "}", "joins far, which has no axis in machine.frame"),
    ("rocker: [500, 0]", "rocker: [501, 0]", "wants the axes of crank and rocker 500 mm apart"),
    ("teeth: 24/48", "teeth: 24/47", "by the teeth, but drive turns 1/2 times a sheet"),
    ("teeth_present: 39}", "teeth_present: 150}", "more than two thirds of the 212 teeth"),
    ("pair: [main.pinion, crank.wheel]", "pair: [main.pinion, crank.whel]", "there is no such gear (did you mean"),
    ("anchor: main ", "anchor: mian ", "is mian, which is not one of the shafts"),
    ("sections: 45x70 r1, 50x40 r1, 60x320 r1, 50x40", "sections: 45*70 r1, 50x40", "section 1 “45*70 r1”, which cannot be read"),
    ("at: 100, designation", "at: 100 kg, designation", "at: "),
    ("frame: {crank: [0, 0]", "frame: {crank: [0]", "two numbers in mm are needed"),
    ("  drive:\n    kind: cylinder_drive\n", "  drive:\n    kind: cylinder_drive\n    sector_ratio: 6\n", "follows from the parts; remove the key"),
    ("length: 2000, count: 1}}", "length: 2000, count: 1}, fan: {pulleys: [motor.small, flywheel.large], section: SPA, diameters: 125/375, "
     "length: 2000, count: 1}}", "belts.fan: is a second belt; one alone is calculated"),
    ("length: 2000, count: 1}}", "length: 1000, count: 1}}", "length: is too short for its pulleys of 125 mm / 375 mm"),
    ("diameters: 125/375, length", "diameters: 125/750, length", "is too short for its pulleys"),
    ("length: 2000, count: 1}}", "length: 1, count: 1}}", "is too short for its pulleys"),
    # how a part is joined to its shaft, and where its force acts
    ("{gear: wheel, at: 155, hub: 60, key: 50}", "{gear: wheel, at: 155, hub: 60, key: 50, integral: true}", "by key, integral, of which one"),
    ("{gear: wheel, at: 155, hub: 60, key: 50}", "{gear: wheel, at: 155, hub: 60, integral: true}", "no such shaft is turned"),
    ("at: 35, hub: 60, key: 50, plane: 20, mass", "at: 35, key: 50, plane: 20, mass", "has no hub, so that it is not known where its face is"),
    ("at: 310, hub: 60, key: 50, mass", "at: 310, key: 50, mass", "has no hub, so that it is not known where its face is"),
    ("key: 50, plane: 20, mass", "key: 50, pin: {diameter: 40, held: 50, plane: 1}, mass", "is a key that cross.crank has no force for"),
    ("key: 50, plane: 20, mass", "key: 50, mass", "has neither a pin nor a plane"),
    ("key: 50, plane: 20, mass", "key: 50, plane: 12, mass", "is 12 mm beyond the disc, but the roller is 25 mm wide"),
    ("key: 50, plane: 20, mass", "key: 50, plane: -20, mass", "is -20 mm beyond the disc, but the roller is 25 mm wide"),
    # the bearing of a pin stands beyond its disc or between its supports, and on the pin
    ("held: 50, plane: 15,", "held: 50, plane: 3,", "has its middle 3 mm off the disc's face, but NU2208E is 23 mm wide"),
    ("held: 50, plane: 15,", "held: 50, plane: 0,", "has its middle 0 mm off the disc's face, but NU2208E is 23 mm wide"),
    ("span: [15, 75], plane: 45,", "span: [15, 75], plane: 25,", "has its middle 10 mm off the support at 15 mm, but NU2208E is 23 mm wide"),
    ("span: [15, 75], plane: 45,", "span: [15, 75], plane: 65,", "has its middle 10 mm off the support at 75 mm, but NU2208E is 23 mm wide"),
    ("span: [15, 75], plane: 45,", "span: [20, 50], plane: 65,", "reaches from 53.5 mm to 76.5 mm, but the pin from 0 mm to 70 mm"),
    ("span: [15, 75], plane: 45,", "span: [30, 75], plane: 10,", "reaches from -1.5 mm to 21.5 mm, but the pin from 0 mm to 105 mm"),
    ("span: [15, 75], plane: 45, bearing: NU2208E", "span: [15, 75], plane: 120", "reaches from 120 mm to 120 mm, but the pin from 0 mm to 90 mm"),
    # what would make a shaft, or a part, vanish
    ("sections: 45x70 r1, 50x40 r1, 60x320 r1, 50x40", "sections: []", "shafts.main: has no sections"),
    ("  far:\n", "  far:\n    motor: {speed: 3 rpm}\n", "but the shaft has sections; remove one of them"),
    ("  far:\n    sections: 40x30 r1, 50x640 r1, 40x30\n", "  far:\n    motor: {speed: 3 rpm}\n", "stands on a shaft that grippers drives"),
    ("  far:\n    sections: 40x30 r1, 50x640 r1, 40x30\n", "  far:\n    motor: {speed: 3 rpm}\n", "whose shaft carries no bearing"),
    ("{gear: wheel, at: 130, rides_on: clutch}", "{gear: wheel, at: 130, rides_on: wheel}", "that this shaft carries; they are clutch"),
    ("{gear: wheel, at: 130, rides_on: clutch}", "{gear: wheel, at: 130, rides_on: clutsch}", "which is not a clutch or coupling"),
    ("{gear: wheel, at: 130, rides_on: clutch}", "{gear: wheel, at: 12, rides_on: clutch}",
     "stands at 12 mm, but clutch, which it rides on, goes from 90 mm to 170 mm"),
    ("50x40 r1, 60x320 r1, 50x40", "50x40 r1, 60/48x320 r1, 50x40", "keyseat 7 mm deep, but the wall around the bore of 48 mm"),
    ("{crank: disc, of: cross.crank, at: 35,", "{crank: disc, of: cross.crank, at: '${cylinder.segment_height} / 0',",
     "divides by zero, where (in SI)"),
    ("{clutch: clutch, at: 130, hub: 80, key: 70, mass", "{clutch: clutch, at: 130, rides_on: clutch, mass", "which is not a clutch or coupling"),
    ("{gear: sector, at: 85, hub: 60, key: 50,", "{gear: sector, at: 85, hub: 60, rides_on: arm,", "they are none; what is fixed to another hub"),
    ("{gear: wheel, at: 155, hub: 60, key: 50}", "{gear: wheel, at: 155, hub: 60, rides_on: a}", "which is not a clutch or coupling"),
    ("key: 63, mass: 26 kg}", "key: 63, mass: 0}", "mass: is zero, as nothing is that turns"),
    ("key: 63, mass: 26 kg}", "key: 63, mass: 26 kg, inertia: 0}", "inertia: is zero, as nothing is that turns"),
    ("key: 63, mass: 26 kg}", "key: 63, mass: 26 kg, inertia: 0.01 kg*m**2}", "but the full steel body of its dimensions has"),
    (", inertia: \"${train.flywheel_inertia}\"}", ", inertia: \"${train.flywheel_inertia}\", mass: 0 kg}", "mass: is zero"),
    ("key: 50, width: 35}", "key: 50, width: 35, mass: 0}", "mass: is zero"),
    ("key: 50, width: 35}", "key: 50, width: 0.1}", "is 0.1 mm wide, less than half of the roller of 25 mm"),
    ("{geneva_wheel: cross, of: cross.wheel,", "{cam: cross, of: cross.wheel,", "parts that it acts on are geneva_wheel"),
    ("{crank: disc, of: cross.crank, at: 35, hub: 60, key: 50, plane: 20,", "{cam: disc, of: cross.crank, at: 35, hub: 60, key: 50,",
     "has neither a pin"),
    ("key: 63, mass: 26 kg}", "key: 63, mass: '${cylinder.overlap_mass}'}", "mass: is of what is calculated"),
    ("key: 63, mass: 26 kg}", "key: 63, mass: '0 * ${cylinder.mass}'}", "mass: is of what is calculated"),
    ("key: 63, mass: 26 kg}", "key: 63, mass: 26 kg, inertia: '0.001 * ${cylinder.inertia}'}", "inertia: is of what is calculated"),
    ("key: 50, width: 35}", "key: 50, width: 35, fill: 0.1}", "is a key that a geneva wheel does not have"),
    ("key: 50, width: 35}", "key: 50, width: 35, inertia: 1e-6 kg*m**2}", "but the full steel body of its dimensions has"),
    ("key: 63, mass: 26 kg}", "key: 63, fill: 0.01}", "leaves by fill, bore and width 0.01 of its full steel disc"),
    ("key: 63, mass: 26 kg}", "key: 63, width: 0.1}", "of its full steel disc"),
    ("{rocker: arm, of: drive.rocker,", "{load: arm, of: drive.rocker,", "does not act on; parts that it acts on are crank, rocker"),
    ("at: 130, hub: 80, key: 70, mass: 6 kg}", "at: 130, hub: 80, integral: true, mass: 6 kg}", "is not made in one piece with a shaft"),
    ("at: 275, hub: 60, key: 50, width: 35}", "at: 275, hub: 60, integral: true, width: 35}", "is not made in one piece with a shaft"),
    (", moves: drive.cylinder}", "}", "drives no shaft and moves nothing"),
    ("{bearing: a, at: 100,", "{bearing: a, at: 100, hub: 20,", "is a key that a bearing does not have"),
    ("{gear: wheel, at: 155,", "{gear: wheel, designation: \"6210\", at: 155,", "is a key that a gear does not have"),
    # joins that do not match
    ("to: [far.left, far.right]", "to: [far.left, far.left]", "joins far.left, which is joined already"),
    ("to: [far.left, far.right]", "to: [far.left]", "leads from 2 sprockets to 1"),
    ("sprockets: [pinion.left, pinion.right]", "sprockets: [pinion.left, conveyor.left]", "side by side on pinion and conveyor"),
    ("pair: [main.pinion, crank.wheel]", "pair: [main.wheel, crank.wheel]", "joins main.wheel, which is joined already"),
    # what follows from the parts
    ("    reserve_factor: 1.2\n", "    reserve_factor: 1.2\n    allowable_radial_force: 1 kN\n",
     "train.allowable_radial_force: is given here, but follows"),
    ("belts: {motor: {pulleys: [motor.small, flywheel.large], section: SPA, diameters: 125/375, length: 2000, count: 1}}", "",
     "motor.radial_force: is compared with the load of no V-belt; remove the key"),
    ("teeth: 18/87, module: 4, width: 50}", "teeth: 18/87, module: 4, width: 50, torque: 3 N*m}", "main_drive.torque: is given here, but follows"),
    ("teeth: 18/87, module: 4, width: 50}", "teeth: 18/87, module: 4, width: 50, torque_on: wheel}", "torque_on: is given here, but follows"),
    ("teeth: 18/87, module: 4, width: 50}", "teeth: 18/87, module: 4, width: 50, center_distance: 250 mm}", "center_distance: is given here"),
    ("moves: drive.cylinder}", "moves: drive.cylinder, pitch: 9 mm}", "chains.cylinder.pitch: is given here, but follows"),
    ("moves: drive.cylinder}", "moves: drive.cylinder, moving_mass: 9 kg}", "chains.cylinder.moving_mass: is given here, but follows"),
    ("count: 1}", "count: 1, center_distance: 300 mm}", "belts.motor.center_distance: is given here, but follows"),
    ("  far:\n", "  far:\n    loads: []\n", "shafts.far.loads: is given here, but follows"),
    ("  far:\n", "  far:\n    bearing_a: 50 mm\n", "shafts.far.bearing_a: is given here, but follows"),
    ("  far:\n", "  far:\n    rotation: none\n", "shafts.far.rotation: is given here, but follows"),
    ("{gear: wheel, at: 155,", "{gear: wheel, torque: 1 N*m, at: 155,", "parts.2.torque: is given here, but follows"),
    ("{gear: wheel, at: 155,", "{gear: wheel, force_y: 1 N, at: 155,", "parts.2.force_y: is given here, but follows"),
    ("{gear: wheel, at: 155,", "{gear: wheel, seat: loose, at: 155,", "parts.2.seat: is given here, but follows"),
    ("{gear: wheel, at: 155,", "{gear: wheel, inertia: 1 kg*m**2, at: 155,", "parts.2.inertia: goes into no calculation"),
    ("{bearing: a, at: 100,", "{bearing: a, at: 100, tilt: 0 mrad,", "parts.1.tilt: is given here, but follows"),
    ("{bearing: a, at: 100,", "{bearing: a, at: 100, type: roller,", "parts.1.type: is given here, but follows"),
    ("  cylinder:\n    kind: cylinder_sizing", "  shafts:\n    kind: cylinder_sizing", "the name 'shafts' is reserved"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "told"),
    few(BROKEN, keep=lambda each: BROKEN.index(each) % 2 == 0),
    ids=[new[:40] for _, new, _ in BROKEN],
)
def test_what_contradicts_itself_is_refused_at_its_place(old: str, new: str, told: str) -> None:
    problems = machine((old, new)).problems
    assert [problem for problem in problems if told in problem], problems
    assert all(str(FILE) in problem for problem in problems)


DOUBTFUL = [
    ("50x40 r1, 60x320 r1, 50x40", "50x40 r1, 56x320 r1, 50x40", "shoulder", "a shoulder of 56 mm; its rings want 56.5 mm to 83.5 mm"),
    ("50x40 r1, 60x320 r1, 50x40", "50x40 r1, 84x320 r1, 50x40", "shoulder", "a shoulder of 84 mm; its rings want 56.5 mm to 83.5 mm"),
    ("{sprocket: left, at: 55, hub: 40, key: 36}", "{sprocket: left, at: 55, hub: 40, key: 36, stop: shoulder}", "stop",
     "is stopped by a shoulder, but touches no thicker section"),
    ("teeth: 18/87, module: 4,", "teeth: 15/90, module: 4,", "wall", "is 50 mm thick below its teeth, less than 1.5 times its seat of 35 mm"),
    ("hub_yield: 370 MPa", "hub_yield: 320 MPa", "steel", "is 767 MPa, but through-hardened steel with hubs of 320 MPa has 750.7 MPa at most"),
    ("\nmechanisms:\n", "\nmechanisms:\n  extra: {kind: parallel_key, shaft_diameter: 40 mm, key_length: 36 mm}\n",
     "untied", "is a parallel_key, as they are calculated of the parts"),
]  # fmt: skip


@pytest.mark.parametrize("given", ["", "5", "true", "main", "[]", "{}"])
def test_shafts_that_are_none_end_in_words_also_where_something_joins_them(given: str) -> None:
    start, end = TEXT.index("shafts:\n"), TEXT.index("meshes:\n")
    problems = machine(text=f"{TEXT[:start]}shafts: {given}\n{TEXT[end:]}").problems
    told = "names flywheel.pinion, but there is no such gear" if given in ("", "{}") else "a block of names is needed"
    assert told in problems[0], problems


@pytest.mark.parametrize(("old", "new", "rule", "told"), DOUBTFUL, ids=[each[2:][1][:30] for each in DOUBTFUL])
def test_what_is_doubtful_warns(old: str, new: str, rule: str, told: str) -> None:
    found = machine((old, new)).found(rule)
    assert [each for each in found if each.level == "warning" and told in each.message], found


@pytest.mark.parametrize(
    ("corner", "level", "told"),
    [
        ("", "warning", "rests on a shoulder, but its ring's corner is not known"), (", corner: 1.1", "", ""),
        (", corner: 0.9", "error", "a fillet of 1 mm, too large for its ring with corners from 0.9 mm; take less than 0.85 mm"),
        (", corner: 3", "warning", "a shoulder of 50 mm; its rings want"),
    ],
)  # fmt: skip
def test_a_bearing_whose_sizes_are_typed_rests_on_its_shoulder_as_one_of_the_tables(
    corner: str, level: str, told: str
) -> None:
    typed = "type: deep_groove, bore: 40, outside: 80, width: 18, dynamic_rating: 30.7 kN, static_rating: 19 kN, f0: 14, limiting_speed: 8500 rpm"
    old = 'parts: [{bearing: a, at: 21, designation: "6208"}'
    found = machine((old, f"parts: [{{bearing: a, at: 21, {typed}{corner}}}"))
    told_of = [(each.level, each.message) for each in found.found("shoulder")]
    told_of += [("error", each) for each in found.problems]
    assert [of for of, _ in told_of] == [level] * bool(level), told_of
    assert not told or told in told_of[0][1]


def test_a_shoulder_within_its_bounds_and_a_block_that_refers_to_a_part_are_not_doubtful() -> None:
    block = "  extra:\n    {kind: parallel_key, shaft_diameter: 40 mm, key_length: 36 mm, torque: '${shafts.far.parts.left.torque}'}\n"
    for old, new in (
        ("50x40 r1, 60x320 r1, 50x40", "50x40 r1, 57x320 r1, 50x40"),
        ("50x40 r1, 60x320 r1, 50x40", "50x40 r1.04, 60x320 r1, 50x40"),
        ("hub_yield: 370 MPa", "flanks: case_hardened, hub_yield: 320 MPa"),
        ("\nmechanisms:\n", f"\nmechanisms:\n{block}"),
    ):
        assert {each.rule for each in machine((old, new)).parts.findings} <= {"planes", "wall"}, new


def test_what_nothing_holds_along_its_shaft_warns_by_its_side() -> None:
    """The bearings of the main shaft touch its thick section, the parts beside them touch nothing."""
    without = ("  stop: sleeve     # where no shoulder holds a part\n", "")
    told = {each.path[1]: each.message for each in sound(without).found("stop")}
    assert told.keys() == {"flywheel", "main", "crank", "rocker", "pinion", "geneva", "conveyor", "far"}
    assert told["main"].startswith(
        "nothing holds along the shaft: disc on both sides, a on the left, wheel on both sides, pinion on both sides, b on the right;"
    )
    held = ("{crank: disc, of: cross.crank, at: 35,", "{crank: disc, of: cross.crank, at: 35, stop: ring,")
    (told_of_main,) = (each.message for each in machine(without, held).found("stop") if "main" in each.path)
    assert "a on the left, wheel" in told_of_main and "disc" not in told_of_main


def test_the_bearing_of_a_pin_may_touch_its_disc_or_its_supports() -> None:
    for old, new in (
        ("held: 50, plane: 15,", "held: 50, plane: 11.5,"),
        ("span: [15, 75], plane: 45,", "span: [15, 75], plane: 63.5,"),
    ):
        sound((old, new))
    (problem,) = machine(("held: 50, plane: 15,", "held: 50, plane: 11.4,")).problems
    assert re.search(r"pin\.plane: .* \(against .*:\d+:\d+\)", problem), problem


def test_the_shaft_of_the_motor_is_held_against_the_load_of_the_belt() -> None:
    bases = {}
    for name in ("flat_cylinder", "flat_cylinder_corrected"):
        config = load_config(FILE.with_stem(name), DISCOVERY)
        train = config.instances["train"]
        assert train is not None and train.value(("allowable_radial_force",)) == 800
        bases[name] = train.bases[("allowable_radial_force",)].basis
    assert bases == {"flat_cylinder": "assumed", "flat_cylinder_corrected": "catalogue"}
    assert "allowable_radial_force" not in sound((", radial_force: 800 N", "")).made["train"]


def test_a_derived_key_is_refused_with_the_place_that_it_follows_from() -> None:
    for old, new, there in (
        ("count: 1}", "count: 1, driver_diameter: 90 mm}", "diameters: 125/375"),
        ("{gear: wheel, at: 155,", "{gear: wheel, torque: 1 N*m, at: 155,", "main_drive:"),
        ("    kind: cylinder_drive\n", "    kind: cylinder_drive\n    pinion_radius: 70 mm\n", "motor: {motor:"),  # the first of the shafts
    ):  # fmt: skip
        (place,) = re.findall(rf"against {re.escape(str(FILE))}:(\d+):", machine((old, new)).told)
        assert there in TEXT.replace(old, new, 1).splitlines()[int(place) - 1], new


def test_what_the_machine_gives_all_parts_a_part_may_have_for_itself() -> None:
    text = "width: 50, application_factor: 1.3, sigma_h_lim_1: 800 MPa}"
    own = sound(("width: 50}", text)).made["meshes_main_drive"]
    assert own["application_factor"]["value"] == 1.3 and own["sigma_h_lim_1"]["value"] == "800 MPa"


def test_typed_notches_stand_beside_those_of_the_keys() -> None:
    typed = "  far:\n    notches: [{position: 300 mm, type: groove_ring, radius: 1 mm}]\n"
    notches = sound(("  far:\n", typed)).made["shafts_far"]["notches"]
    assert [each["type"] for each in notches] == 4 * ["keyseat_end_mill"] + ["groove_ring"]


def test_a_shaft_that_nothing_turns_is_doubtful() -> None:
    (found,) = sound(("to: [far.left, far.right], ", "")).found("described")
    assert found.level == "warning" and found.path == ("shafts", "far") and "is turned by nothing" in found.message


def test_two_parts_whose_calculations_would_have_one_name_are_refused() -> None:
    (found,) = machine(text=re.sub(r"\bfar\b", "main_body", TEXT)).problems
    assert "shafts.main_body: makes the calculation shafts_main_body, as another part does by its name" in found


def test_a_part_that_nothing_joins_to_its_shaft_fails() -> None:
    found = sound(("{gear: wheel, at: 155, hub: 60, key: 50}", "{gear: wheel, at: 155, hub: 60}"))
    assert [each.rule for each in found.parts.findings if each.level == "fail"] == ["torque_carried"]


@pytest.mark.parametrize(
    ("reference", "stands_for"),
    every(4, [
        ("${shafts.crank.speed}", "${drive_line.crank_speed}"),
        ("${shafts.crank.inertia}", "${shafts_crank_body.inertia}"),
        ("${shafts.crank.bearings.a.reaction}", "${shafts_crank.reaction_a}"),
        ("${shafts.crank.bearings.a.bore}", "45 mm"),
        ("${shafts.crank.parts.disc.position}", "510 mm"),
        ("${shafts.crank.sections.1.diameter}", "${shafts_crank.sections.1.diameter}"),
        ("2 * ${meshes.sector.center_distance}", "2 * ${drive_line.sector_center_distance}"),
        ("${chains.grippers.mass}", "${drive_line.grippers_chain_mass}"),
        ("${belts.motor.ratio}", "${drive_line.motor_belt_ratio}"),
        ("${machine.inertia}", "${machine_inertia.inertia}"),
    ]),
)  # fmt: skip
def test_a_reference_to_a_part_stands_for_what_is_calculated_of_it(reference: str, stands_for: str) -> None:
    found = machine(("allowable_torque: {value: 800 N*m, basis: assumed}", f"allowable_torque: {reference!r}"))
    assert found.made["drive"]["allowable_torque"] == stands_for


def test_what_swings_or_steps_counts_with_its_inertia() -> None:
    """The drive gets the inertias of both shafts; each shaft's own takes its torque, and what is before it carries what is behind.

    The chains that roll the cylinder run as fast as the pinion's sprockets.
    """
    data = made()
    chain = "${drive_line.cylinder_chain_mass} * (${drive_line.cylinder_chain_travel} / 1 rad)**2"
    assert data["drive"]["pinion_inertia"] == f"${{shafts_pinion_body.inertia}} + {chain}"
    assert data["drive"]["rocker_inertia"] == "${shafts_rocker_body.inertia}"
    loads = {shaft: data[f"shafts_{shaft}_loads"]["torques"] for shaft in ("pinion", "rocker", "geneva")}
    torques = {shaft: {each["name"]: each["curve"] for each in rows} for shaft, rows in loads.items()}
    inertias = ("left_inertia", "pinion_inertia", "right_inertia", "inertia")
    moments = {"left": "cylinder_moment", "right": "cylinder_moment"}
    assert torques["pinion"] == moments | dict.fromkeys(inertias, "rocker_acceleration")
    assert torques["rocker"] == {"sector": "rocker_torque"}  # with the inertias and losses behind it
    assert torques["geneva"]["inertia"] == "wheel_acceleration"
    drive = calculated("shaft_body", "drive_line", "cylinder_sizing", "cylinder_drive").calculations["drive"]
    moved = 2 * 240 * 12.7 * MM * 0.69 * (52 * 12.7 * MM / (2 * pi)) ** 2  # two chains of 240 links
    assert drive["pinion_inertia"].item() == pytest.approx(0.03467 + moved, rel=1e-3)
    arm = 10 * 0.205**2 / 2  # with its pin at 205 mm
    assert drive["rocker_inertia"].item() == pytest.approx(1.2609 + arm, rel=1e-3)


@pytest.mark.parametrize(
    ("beside", "part", "is_refused"),
    [
        ("bearing: b, at: 230", "mass: 5 kg", True), ("bearing: b, at: 230", "mass: 5 kg, outside: 200", False),
        ("bearing: b, at: 230", "mass: 5 kg, inertia: 0.02 kg*m**2", False), ("bearing: b, at: 250", "mass: 5 kg", False),
    ],
)  # fmt: skip
def test_a_mass_without_inertia_is_refused_on_a_shaft_that_does_not_turn_steadily(
    beside: str, part: str, is_refused: bool
) -> None:
    found = machine((f"      - {{{beside},", f"      - {{load: balance, at: 60, {part}}}\n      - {{{beside},"))
    assert is_refused == ("has a mass and no inertia" in found.told)


BEHIND = """  behind:
    sections: 40x30 r1, 50x260 r1, 40x30
    parts: [{bearing: a, at: 21, designation: "6208"}, {gear: wheel, at: 190, hub: 50, key: 45},
            {bearing: b, at: 299, designation: "6208", floating: true}]
"""
STEP_UP, SECTOR = "module: 4, width: 30", "teeth_present: 39"


def test_the_losses_of_a_mesh_behind_a_wheel_that_steps_enter_its_torque_and_that_of_its_crank() -> None:
    data = sound((STEP_UP, f"{STEP_UP}, efficiency: 0.9")).made
    torques = {each["name"]: each.get("efficiency", {}) for each in data["shafts_geneva_loads"]["torques"]}
    assert torques["large"]["value"] == data["cross"]["efficiency"]["value"] == 0.9
    assert torques["inertia"] == {} and data["cross"]["own_inertia"] == "${shafts_geneva_body.inertia}"
    assert made()["cross"]["efficiency"] == 0.97  # that of a mesh of which none is typed


@pytest.mark.nightly
def test_the_losses_of_the_sector_stand_at_its_mesh_alone() -> None:
    drive = sound((SECTOR, f"{SECTOR}, efficiency: 0.9")).made["drive"]
    assert drive["efficiency_sector"]["value"] == 0.9
    twice = machine(("    kind: cylinder_drive\n", "    kind: cylinder_drive\n    efficiency_sector: 0.9\n"))
    assert "efficiency_sector: is given here, but follows" in twice.told


@pytest.mark.nightly
def test_losses_that_go_into_no_torque_are_refused() -> None:
    """Behind a shaft that swings the sign of a torque does not tell which way the power flows."""
    pinion = "at: 120, hub: 50, key: 45}"
    behind = (
        ("  geneva:\n    sections", f"{BEHIND}  geneva:\n    sections"),
        (pinion, f"{pinion}\n      - {{gear: more, at: 190, hub: 50, key: 45}}"),
        ("geneva: [180, 240],", "geneva: [180, 240], behind: [500, -694],"),
    )
    for more, refused in (("", False), (", efficiency: 0.9", True)):
        mesh = f"meshes:\n  on: {{pair: [pinion.more, behind.wheel], teeth: 50/50, module: 4, width: 30{more}}}\n"
        found = machine(*behind, ("meshes:\n", mesh))
        assert len(found.problems) == refused
        assert ("meshes.on.efficiency: goes into no calculation" in found.told) == refused


WHEEL = "of: cross.wheel, at: 275, hub: 60, key: 50, width: 35}"


@pytest.mark.parametrize(
    ("typed", "mass", "inertia"),
    [("width: 35", "26.21", 0.4724), ("mass: 26.21 kg", "26.21", 0.4724), ("mass: 13.107 kg", "13.107", 0.2362)],
)
def test_a_geneva_wheel_has_the_inertia_of_its_mass_and_its_weight_loads_its_shaft(
    typed: str, mass: str, inertia: float
) -> None:
    data = sound((WHEEL, WHEEL.replace("width: 35", typed))).made
    body = next(each for each in data["shafts_geneva_body"]["bodies"] if each["name"] == "cross")
    load = next(each for each in data["shafts_geneva"]["loads"] if each["name"] == "cross")
    assert body["mass"]["value"].startswith(mass) and load["mass"] == body["mass"]
    factor = re.fullmatch(r"\$\{shafts_geneva_body\.bodies\.1\.mass\} \* ([\d.]+) mm\*\*2", body["inertia"])
    assert factor is not None
    own = float(factor[1]) * 1e-6 * float(body["mass"]["value"].removesuffix(" kg"))
    assert own == pytest.approx(inertia, abs=1e-4)


@pytest.mark.parametrize(
    ("typed", "missing"),
    [
        (WHEEL.replace(", width: 35", ""), "give width or mass"),
        (WHEEL.replace("width: 35", "inertia: 0.4 kg*m**2"), "give width or mass"),
        (WHEEL.replace("width: 35", "inertia: 0.4 kg*m**2, width: 35"), ""),
    ],
)
def test_a_geneva_wheel_without_what_its_mass_follows_from_is_refused(typed: str, missing: str) -> None:
    found = machine((WHEEL, typed))
    assert len(found.problems) == bool(missing) and missing in found.told


SIZED = 'inertia: "${train.flywheel_inertia}"}'


@pytest.mark.parametrize(
    ("inertia", "status"), few([("2.6", "fail"), ("2.95", "pass"), ("3.5", "warn")], lambda each: each[1] != "warn")
)
def test_the_flywheel_that_is_mounted_has_the_inertia_which_the_drive_train_asks_for(inertia: str, status: str) -> None:
    run = run_of((SIZED, f"inertia: {inertia} kg*m**2, mass: 80 kg}}"))
    light, heavy = (each for each in run.checks["train"] if each.id in ("flywheel", "heavy_flywheel"))
    needed = float(run.calculations["train"]["flywheel_inertia"][0, 0])
    train, consistency = run.calculations["train"], run.calculations["consistency"]
    assert train["own_inertia"][0, 0] > float(inertia)
    assert train["motor_time_constant"][0, 0] == pytest.approx(consistency["time_constant"][0, 0], rel=1e-6)
    assert not light.sized_to_limit  # it is typed
    assert light.status == ("fail" if float(inertia) < needed else "pass")
    assert heavy.status == ("warn" if float(inertia) > 1.1 * needed else "pass")
    assert status in (light.status, heavy.status)


@pytest.mark.nightly
@pytest.mark.parametrize("inertia", few(["0.01", "30"], keep=lambda inertia: inertia == "0.01"))
def test_a_flywheel_of_quite_another_inertia_is_refused(inertia: str) -> None:
    config = sound((SIZED, f"inertia: {inertia} kg*m**2, mass: 80 kg}}")).config
    with pytest.raises(UserError, match="is less than half or more than twice") as refused:
        PRESS.calculate(config)
    assert f"{FILE}:54:" in str(refused.value)


def test_the_flywheel_that_the_drive_train_sizes_is_compared_with_nothing() -> None:
    assert "mounted_inertia" not in made()["train"]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("plane: 15, bearing: NU2208E}", "plane: 15, bearing: NU2208E, limiting_speed: 50000 rpm}",
         "bearings.limiting_speed * mean_diameter / (1 revolution) = 3000000 mm/min"),
        ("chain: 12B,", "chain: 12B, bearing_area: 900 mm**2,", "is 900 mm², but the table has 87.97 mm² for this designation"),
    ],
)  # fmt: skip
def test_values_of_a_maker_are_refused_where_a_part_has_them(old: str, new: str, words: str) -> None:
    config = sound((old, new)).config
    with pytest.raises(UserError, match=re.escape(words)) as refused:
        PRESS.calculate(config)
    line = TEXT[: TEXT.index(old)].count("\n") + 1
    assert f"{FILE}:{line}:" in str(refused.value)


@pytest.mark.parametrize(
    ("typed", "missing"),
    [("mass: 80 kg}", "has no inertia"), ("inertia: 2.8 kg*m**2}", "has no mass"), ("bore: 50}", "has no inertia")],
)
def test_a_flywheel_without_inertia_or_mass_is_refused(typed: str, missing: str) -> None:
    assert missing in machine((SIZED, typed)).told


MASSES = {
    "sector": ("mass: 14 kg", 32.62),  # 39 of 212 teeth
    "large": ("mass: 26 kg", 42.6),
    "crank": ("mass: 8 kg", 14.8),
    "roller crank": ("mass: 9 kg", 21.3),
    "arm": ("mass: 10 kg", 11.59),  # 205 mm long, 120 mm high, 60 mm wide
    "clutch": ("mass: 6 kg", 63.9),
}


@pytest.mark.parametrize("part", MASSES)
@pytest.mark.parametrize(
    ("share", "level"),
    few(
        [(0.01, "error"), (0.2, "warning"), (0.6, ""), (1.2, "warning"), (1.6, "error"), (100, "error")],
        keep=lambda each: each[0] in (0.2, 1.6),
    ),
)
def test_a_mass_is_held_against_the_full_steel_body_of_the_part(part: str, share: float, level: str) -> None:
    typed, full = MASSES[part]
    level = "" if (part, share) == ("clutch", 0.2) else level  # it has shoes in place of a disc
    found = machine((typed, f"mass: {full * share:.4g} kg"))
    assert [each.level for each in found.found("massive")] == (["warning"] if level == "warning" else [])
    is_refused = level == "error"
    assert len(found.problems) == is_refused and ("the full steel body" in found.told) == is_refused


@pytest.mark.parametrize(("width", "level"), [("", "warning"), (", width: 35", ""), (", width: 1000", "error")])
def test_the_mass_of_a_geneva_wheel_is_held_against_its_width(width: str, level: str) -> None:
    found = machine((WHEEL, WHEEL.replace("width: 35", f"mass: {13 if not width else 26.2} kg{width}")))
    assert bool(found.problems) == (level == "error")
    assert [each.level for each in found.found("massive")] == (["warning"] if level == "warning" else [])


def cases(name: str) -> list[str]:
    """The load cases of a calculation with their torques, as the file of mechanisms has them."""
    return [f"{case['name']} {case['torque']}" for case in made()[name].get("load_cases", [])]


ENGAGE = "engage ${clutch.design_torque}"
TO_MAIN = f"{ENGAGE} * (${{drive_line.meshes.1.teeth_1}} / ${{drive_line.meshes.1.teeth_2}}) / 0.97"
TO_FLYWHEEL = f"{TO_MAIN} * (${{drive_line.meshes.0.teeth_1}} / ${{drive_line.meshes.0.teeth_2}}) / 0.97"
START = "start ${train.vbelt_peak_torque} * ${drive_line.motor_belt_ratio}"


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("shafts_crank", [ENGAGE]), ("shafts_crank_clutch_key", [ENGAGE]), ("shafts_crank_disc_key", [ENGAGE]),
        ("meshes_crank_drive", [TO_MAIN]), ("shafts_main", [TO_MAIN]), ("shafts_main_pinion_key", [TO_MAIN]), ("shafts_main_wheel_key", [TO_MAIN]),
        ("meshes_main_drive", [TO_FLYWHEEL]), ("shafts_flywheel", [TO_FLYWHEEL, START]), ("shafts_flywheel_pinion_key", [TO_FLYWHEEL]),
        ("shafts_flywheel_large_key", [START]), ("shafts_main_disc_key", []), ("shafts_geneva", []), ("meshes_step_up", []),
    ],
)  # fmt: skip
def test_the_clutch_loads_both_its_sides_and_the_motor_all_up_to_the_flywheel(name: str, expected: list[str]) -> None:
    assert cases(name) == expected


def test_a_load_case_passes_the_shaft_from_the_part_that_drives_to_the_one_that_takes() -> None:
    data = made()
    assert [(case["enters"], case["leaves"]) for case in data["shafts_crank"]["load_cases"]] == [("wheel", "disc")]
    of_flywheel = [(case["enters"], case["leaves"]) for case in data["shafts_flywheel"]["load_cases"]]
    assert of_flywheel == [("rim", "pinion"), ("large", "rim")]
    assert data["meshes_crank_drive"]["load_cases"][0]["cycles"] == "${clutch.engagements_per_hour} * 20000 h"


def test_engagements_whose_number_is_not_known_are_frequent() -> None:
    pair = sound(("  required_life: 20000 h\n", "")).made["meshes_crank_drive"]
    assert pair["load_cases"][0]["cycles"] == "1e6"


def test_a_pair_of_gears_gets_what_its_load_factors_follow_from() -> None:
    data = made()
    pair, swinging = data["meshes_crank_drive"], data["meshes_sector"]
    assert pair["grade"]["value"] == 8 and pair["speed"] == "${drive_line.main_speed}" and "crowned" not in pair
    assert pair["slope"] == "${shafts_main.pinion_mesh_slope} + ${shafts_crank.wheel_mesh_slope}"
    assert swinging["speed"] == "${shafts_pinion_bearings.a_speed_max}"
    assert sound(("grade: 8,", "grade: 8, crowned: true,")).made["meshes_sector"]["crowned"] is True
    own = sound(("teeth: 120/20, module: 4, width: 30}", "teeth: 120/20, module: 4, width: 30, grade: 6}"))
    assert own.made["meshes_step_up"]["grade"]["value"] == 6


def test_a_pair_without_a_grade_has_none_and_its_factors_stay_open() -> None:
    assert "grade" not in sound(("grade: 8, ", "")).made["meshes_crank_drive"]


@pytest.mark.parametrize("grade", ["12", "2", "fine", "7.5"])
def test_a_grade_that_is_none_is_refused_at_its_place(grade: str) -> None:
    problems = machine(("grade: 8,", f"grade: {grade},")).problems
    assert problems and all(str(FILE) in problem for problem in problems)


def test_a_number_of_a_part_has_the_basis_of_the_machine_and_stands_where_it_is_typed() -> None:
    config = whole()
    hub = config.instances["shafts_crank_disc_key"]
    assert hub is not None and hub.bases[("hub_length",)].basis == "assumed"
    line, column = config.tree.position(("mechanisms", "shafts_crank_disc_key", "hub_length"))
    assert TEXT.splitlines()[line - 1][column - 1 :].startswith("60,")


def test_a_mass_counts_in_its_unit_for_the_inertia_of_the_part() -> None:
    large = "{gear: large, at: 120, hub: 70, key: 63, mass: "
    body = sound((f"{large}26 kg}}", f"{large}26000 g}}")).made["shafts_geneva_body"]["bodies"][0]
    assert body["inertia"] == "${shafts_geneva_body.bodies.0.mass} * (240 mm)**2 / 2"


FOUNDED = {
    "meshes_main_drive": (("face_width",), ("face_load_factor", "transverse_load_factor", "dynamic_factor", "film_factor", "notch_size_factor",
                                            "alternating_factor", "life_factor_h_1", "life_factor_f_2", "grade", "sigma_h_lim_1", "sigma_f_lim_2")),
    "train": (("vbelt", "driver_diameter"), ("vbelt.groove_friction", "vbelt.service_factor", "power_per_belt")),
    "shafts_main": (("sections", 0, "diameter"), ("reliability", "required_fatigue_safety")),
    "shafts_main_bearings": ((), ("bearings.0.a_iso",)),
    "shafts_main_wheel_key": (("hub_length",), ("yield_hub", "required_life")),
}  # fmt: skip
"""What a drawing founds, and what asks for a basis of its own, by the calculation that it goes to."""


def drawn_machine() -> Config:
    """The example with factors, strengths and dimensions that all rest on one drawing."""
    factors = "face_load_factor: 1.05, transverse_load_factor: 1.1, dynamic_factor: 1.05, film_factor: 1.05, notch_size_factor: 1.1, "
    factors += "alternating_factor: 0.9, life_factor_h_1: 1.1, life_factor_f_2: 2, "
    return sound(
        ("basis: assumed  # of every", "basis: drawing\n  note: layout A  # of every"),
        ("teeth: 18/87, ", "teeth: 18/87, " + factors),
        ("length: 2000, ", "length: 2000, groove_friction: 0.6, service_factor: 1.1, power_per_belt: 5 kW, "),
        ("  main:\n", "  main:\n    reliability: 90 %\n    required_fatigue_safety: 1.2\n"),
        ('at: 100, designation: "6210"', 'at: 100, designation: "6210", a_iso: 5'),
    ).config


def test_a_drawing_of_the_machine_founds_its_dimensions_alone() -> None:
    config = drawn_machine()
    for name, (dimension, others) in FOUNDED.items():
        instance = config.instances[name]
        assert instance is not None
        assert not dimension or instance.bases[dimension] == Basis("drawing", "layout A")
        for key in others:
            path = tuple(int(part) if part.isdigit() else part for part in key.split("."))
            assert instance.value(path) is not None
            assert path not in instance.bases, (name, key)


@pytest.mark.parametrize(
    ("service", "run_up", "factor"),
    every(3, [
        ("service: light\n  hours_per_day: 10", "1.8", 1.1),
        ("service: light\n  hours_per_day: 24", "1.9", 1.3),
        ("service: medium", "1.6", 1.2),
        ("service: medium\n  hours_per_day: 16.5", "1.6", 1.3),
        ("service: heavy\n  hours_per_day: 24", "1.6", 1.4),
        ("service: heavy\n  hours_per_day: 24", "{value: 1.85, basis: assumed}", 1.6),
        ("service: heavy\n  hours_per_day: 8", "${train.breakdown_ratio}", 1.4),
        ("hours_per_day: 24", "1.6", 1.4),
    ]),
)  # fmt: skip
def test_the_service_of_the_machine_gives_the_service_factor_of_its_belts(
    service: str, run_up: str, factor: float
) -> None:
    kind = "    kind: drive_train\n"
    found = sound(
        ("  stop: sleeve", f"  {service}\n  stop: sleeve"), (kind, f"{kind}    run_up_torque_ratio: {run_up}\n")
    )
    train = found.config.instances["train"]
    assert train is not None
    assert train.value(("vbelt", "service_factor")) == factor


def test_a_service_that_goes_into_no_belt_is_refused_at_its_place() -> None:
    (problem,) = machine(("  stop: sleeve", "  hours_per_day: 25\n  stop: sleeve")).problems
    assert "hours_per_day" in problem
    light = ("  stop: sleeve", "  service: light\n  stop: sleeve")
    (problem,) = machine(light, ("length: 2000, ", "length: 2000, service_factor: 1.2, ")).problems
    assert "belts.motor.service_factor" in problem and "follows from the parts" in problem
    (belt,) = re.findall(r"^belts: .*\n", TEXT, re.MULTILINE)
    told = machine(light, (belt, "")).told
    assert "machine.service: goes into no calculation, since no V-belt is calculated" in told


@pytest.mark.parametrize("mass", ["heavy", "26,5 kg", "${train.flywheel_mass}", "{value: 26 kg, basis: drawing}"])
def test_any_mass_is_read_or_refused_in_words(mass: str) -> None:
    typed = mass if mass.startswith("{") else repr(mass)
    problems = machine(("key: 63, mass: 26 kg}", f"key: 63, mass: {typed}}}")).problems
    assert all(str(FILE) in problem for problem in problems)
    assert bool(problems) == (mass == "heavy" or mass.startswith("$"))


def test_a_shaft_of_more_sections_than_can_be_drawn_is_refused() -> None:
    short = ", ".join(61 * ["{length: 5, diameter: 50}"])
    told = machine(("sections: 40x30 r1, 50x640 r1, 40x30", f"sections: [{short}]")).told
    assert "has 61 shafts, joins, sections or parts; at most 60" in told


@pytest.mark.parametrize("slots", ["six", "{value: 6, basis: drawing}", "0"])
def test_slots_of_any_kind_end_in_words(slots: str) -> None:
    assert bool(machine(("    slots: 6\n", f"    slots: {slots}\n")).problems) == (not slots.startswith("{"))


@pytest.mark.parametrize("both", ["", " + ${m%d.bore_radius} - ${m%d.bore_radius}"], ids=["one", "many"])
def test_a_dimension_is_worked_out_through_many_references_each_once(both: str) -> None:
    """Each of 50 values refers to the next one, or to it and twice to another one beside it."""
    rest = "kind: cylinder_sizing, generatrix_length: 700 mm, working_length: 400 mm"
    blocks = "".join(
        f"  m{i}: {{{rest}, segment_height: '${{m{i + 1}.segment_height}}{both.replace('%d', str(i + 1))}', "
        f"bore_radius: '${{m{i + 1}.bore_radius}}'}}\n"
        for i in range(50)
    )
    last = f"  m50: {{{rest}, segment_height: 35 mm, bore_radius: 9 mm}}\n"
    place = ("{crank: disc, of: cross.crank, at: 35,", "{crank: disc, of: cross.crank, at: '${m0.segment_height}',")
    with limited(30):
        found = sound(place, text=f"{TEXT}{blocks}{last}")
    assert found.parts.shafts["main"].parts[0].keys.at == pytest.approx(0.035)


def test_references_that_go_round_end_in_words() -> None:
    onward = ("    frame_ratio: 5\n", "    frame_ratio: ${drive.coupler_ratio}\n")
    sound(onward)
    assert "itself" in machine(onward, ("    coupler_ratio: 5\n", "    coupler_ratio: ${drive.frame_ratio}\n")).told


def test_a_designation_may_be_written_small() -> None:
    found = sound(("designation: NU210E", "designation: nu210e"))
    assert found.made["shafts_rocker_bearings"]["bearings"][1]["type"] == "roller"


def test_54_parts_carry_load_and_each_has_a_calculation() -> None:
    every = list(carrying_parts(parts(), whole().named("drive_train")))
    assert len(every) == 54
    assert not [part.name for part in every if part.calculation not in whole().kinds]


def without_keys() -> Machine:
    """The example with a wheel that is bolted, and a clutch that is pressed on."""
    pinion = "\n      - {gear: pinion, at: 330"
    wheel = (f"hub: 60, key: 50}}{pinion}", f"hub: 60, bolted: true}}{pinion}")
    clutch = "at: 130, hub: 80, {}, mass: 6 kg"
    return sound(wheel, (clutch.format("key: 70"), clutch.format("interference: 0.05")))


def test_what_carries_load_without_a_method_is_not_rated() -> None:
    found = without_keys()
    told = {str(each.why) for each in unrated(found.parts, found.config.named("drive_train"), {}, "")}
    assert {
        "main.wheel: no method rates its bolts",
        "crank.clutch: no method rates its press fit",
        "crank.disc: no method rates the press fit of its pin",
        "rocker.arm: no method rates its body",
    } <= told


@pytest.mark.nightly
def test_what_is_found_of_the_parts_is_shown_as_long_as_it_is_so() -> None:
    """A clutch that nothing joins to its shaft, and that carries a wheel; a port for which no part stands."""
    press = WarmPress(is_advised=False)
    unkeyed = TEXT.replace("hub: 80, key: 70, mass", "hub: 80, mass", 1)
    without = re.sub(r"      - {crank: disc, of: cross.crank.*\n", "", TEXT)
    texts = (TEXT, unkeyed, TEXT, unkeyed, without)
    runs = [press.calculate(machine(text=text).config) for text in texts]
    found = [{check.id: check.status for check in run.checks["drive_line"]}.get("torque_carried") for run in runs]
    assert found == [None, "fail", None, "fail", None]
    assert [{each.path: str(each.why) for each in unrated_forces(run)} for run in (runs[0], runs[-1])] == [
        {},
        {"mechanisms.cross": "no part stands for crank"},
    ]


@pytest.mark.parametrize(
    ("old", "new", "why"),
    every(2, [
        ("at: 175, hub: 60, key: 50,", "at: 175, hub: 60, integral: true,", "rocker.arm: no method rates where it passes into its shaft"),
        ("plane: 15, bearing: NU2208E}", "plane: 15}", "crank.disc: the bearing of its pin is not given"),
        ("{flywheel: rim,", "{load: rim,", "it sizes a flywheel, and no part of the shaft that it drives is that"),
        ("  clutch:\n    kind: clutch", "  kupplung:\n    kind: clutch", "crank.clutch: no mechanism of its name calculates how it engages"),
        ("  clutch:\n    kind: clutch", "  kupplung:\n    kind: clutch",
         "no part of the machine is this clutch, so that its engagement loads nothing"),
        ("moves: drive.cylinder", "moves: drive.cylinder", "main.disc: no calculation rates its pin"),
        (re.search(r"  clutch:\n    kind: clutch\n(    .*\n)*", TEXT)[0], "", "crank.clutch: no mechanism of its name calculates how it engages"),  # type: ignore[index]
    ]),
)  # fmt: skip
def test_what_is_left_out_of_a_part_is_not_rated(old: str, new: str, why: str) -> None:
    found = machine((old, new))
    assert why in {str(each.why) for each in unrated(found.parts, found.config.named("drive_train"), {}, "")}


def test_the_shaft_of_a_motor_whose_force_nothing_compares_is_not_rated() -> None:
    """Where there is no drive train, and where the motor drives by a gear."""
    why = "motor: no method compares the force on its shaft with that which its maker allows"
    belt = re.findall(r"(?m)^belts: .*$", TEXT)[0]
    mesh = "meshes:\n  motor: {pair: [motor.small, flywheel.large], teeth: 20/60, module: 5, width: 30}\n"
    by_gear = machine(
        ("pulley: small", "gear: small"), ("pulley: large", "gear: large"), (", radial_force: 800 N", ""), (belt, ""), ("meshes:\n", mesh)
    ).parts  # fmt: skip
    for own, train, is_open in ((parts(), "train", False), (parts(), None, True), (by_gear, "train", True)):
        assert (why in {str(each.why) for each in unrated(own, train, {}, "")}) == is_open


@pytest.mark.parametrize(
    "typed", ["'0.6 * {}'", "' 0.6 * {}'", '"\\x30.6 * {}"', "&limit '0.6 * {}'", "'0.6\n    * {}'"]
)
def test_a_formula_of_the_file_is_told_from_one_that_the_parts_make(typed: str) -> None:
    limit = "${cross.allowable_contact_pressure}"
    limits = f"sigma_h_lim_1: {typed.replace('{}', limit)}, sigma_h_lim_2: '{limit}'"
    config = sound(("  crank_drive: {", f"  crank_drive: {{{limits}, ")).config
    found = {
        (instance.name, *slot.key)
        for instance in config.instances.values()
        if instance is not None and instance.name in ("meshes_crank_drive", "shafts_crank_bearings")
        for slot in instance.slots
        if is_formula(config.parts, instance, slot)
    }
    assert found == {("meshes_crank_drive", "sigma_h_lim_1")}


@pytest.mark.nightly
def test_what_is_bolted_or_pressed_on_needs_no_keyseat_near() -> None:
    assert not [str(problem) for problem in Run(without_keys().config, lambda _: None).problems]


def test_what_is_doubtful_is_told_by_path_and_line_as_results_say_the_same_wherever_the_file_stands() -> None:
    (found,) = parts().findings
    told = f"{parts().line(found.path)}: {found.message}"
    assert told.startswith("shafts.") and "(against shafts." in told and ", line " in told
    assert FILE.name not in told


def test_each_calculation_knows_the_part_that_it_is_made_of() -> None:
    made = parts().calculations
    assert made["shafts_crank_disc_key"] == made["shafts_crank"] == "shafts.crank"
    assert made["meshes_step_up"] == "meshes.step_up" and "drive" not in made


def test_a_part_is_rated_by_checks_of_strength_that_are_all_made() -> None:
    made: Any = SimpleNamespace(check_class="strength", status="fail")
    left: Any = SimpleNamespace(check_class="strength", status="not_checked")
    other: Any = SimpleNamespace(check_class="function", status="pass")
    checks = {"sound": [made, other], "partly": [made, left], "light": [other]}
    every = [CarryingPart("wheel", "", name) for name in (*checks, "nobody")]
    assert [is_rated(part, checks) for part in every] == [True, False, False, False]
    left.id, made.id = "motor_radial_force", "vbelt_count"  # of the motor's shaft, and of the belt
    assert is_rated(CarryingPart("belt", "", "partly", is_own=lambda check: check.id.startswith("vbelt")), checks)


@pytest.mark.nightly
def test_the_whole_machine_is_calculated_and_fails_where_the_sheet_says() -> None:
    results = Press.read(FILE, DISCOVERY).calculate().results
    assert results.summary.verdict == "fail" and results.summary.parts is not None
    assert str(FILE) not in results_text(results)
    assert results.summary.parts.carrying == 54
    assert not [name for name, each in results.mechanisms.items() if each.error]
    checks = [(name, check) for name, each in results.mechanisms.items() for check in each.checks]
    failing = {f"{name}.{check.id}" for name, check in checks if check.status == "fail"}
    assert {"shafts_crank_disc_key.pressure_key", "meshes_step_up.pitting_1"} <= failing
    inertia = results.mechanisms["cross"].inputs["driven_inertia"].value
    assert inertia == pytest.approx(8.813, abs=1e-3)
    asked = results.with_(report=results.report.with_(only=["shafts_main", "drive_line"]))
    told = [each.text for each in not_covered(scope(asked).results, Catalogue("en"))]
    assert any("main.disc" in text for text in told) and not any("are not modelled" in text for text in told)


def test_what_is_accepted_of_a_part_stands_there_with_who_accepts_it_and_why() -> None:
    """Its body and its pin both, also where all that has a method is rated."""
    old = "cross.crank, at: 35, hub: 60, key: 50, plane: 20, mass: 9 kg}"
    by = "accepted: {by: Chief engineer, reason: finite elements of its maker}"
    changed = machine((old, f"{old[:-1]}, {by}}}")).parts
    assert not list(accepted(parts(), None, {}))
    found = [each for each in accepted(changed, None, {}) if each.path == "shafts.main.parts.0"]
    reason = "; accepted: finite elements of its maker"
    left = ("main.disc.key: not all of its checks of strength are made", "main.disc: no method rates its body",
            "main.disc: no calculation rates its pin")  # fmt: skip
    assert {str(each.why): each.owner for each in found} == {f"{each}{reason}": "Chief engineer" for each in left}
