"""The consistency of the press: the printed numbers of the example, and what each check says of mechanisms that do not belong together."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.optimize import brentq

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.source_hashes import plugin_hash
from diecut_report.config.yaml import load, parse
from diecut_report.machine.calculation import Calculation, CurveHandle, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.drive_train import MECHANISM as DRIVE_TRAIN
from diecut_report.plugins.press_consistency import MECHANISM
from diecut_report.plugins.press_consistency.relations import listed
from diecut_report.press import Press
from diecut_report.results import checks
from diecut_report.results.warm_press import WarmPress
from diecut_report.text.phrases import Phrase
from tests.configs import DISCOVERY, EXAMPLE
from tests.machines import drive, inputs, number
from tests.mechanics.timing.example_press import calculations
from tests.plugins.drive_trains import EXAMPLE as TRAIN
from tests.plugins.drive_trains import WORKING
from tests.plugins.presses import OF_DRIVE, OF_TRAIN, TYPED, taken, whole_press

OF_CLUTCH = {
    "clutch_torque": "design_torque",
    "clutch_speed": "inputs.speed",
    "clutch_inertia": "inputs.driven_inertia",
}
OF_CROSS = {
    "sheet_step": "sheet_step",
    "travel_radius": "travel_radius",
    "wheel_inertia": "inputs.driven_inertia",
}


@cache
def train_of_the_crank() -> Calculation:
    """A drive train that the cylinder's drive alone loads, down to the crank, as the derivation has it."""
    drive, keys = calculations()["drive"], yaml.safe_load(EXAMPLE.read_text("utf-8"))["mechanisms"]["train"]
    keys = {key: value for key, value in keys.items() if key not in ("kind", "torque_curve_turns")} | {
        "gears": [{"driver_teeth": 20, "driven_teeth": 98}, {"driver_teeth": 24, "driven_teeth": 48}],
        "torque_curve": CurveHandle(drive, "crank_torque"),
        "output_speed": "50 rpm", "torque_mean": number(drive, "crank_torque_mean"), "torque_peak": number(drive, "crank_torque_peak"),
    }  # fmt: skip
    return calculate(DRIVE_TRAIN, inputs(DRIVE_TRAIN, {key: plain(value) for key, value in keys.items()}))


def plain(value: Any) -> Any:
    """Values without what they rest on."""
    if isinstance(value, list):
        return [plain(each) for each in value]
    if not isinstance(value, dict):
        return value
    return value["value"] if "value" in value else {key: plain(each) for key, each in value.items()}


@cache
def example_keys() -> dict[str, Any]:
    """What the check takes from the example press."""
    found = calculations() | {"train": train_of_the_crank()}
    parts = (("drive", OF_DRIVE), ("train", OF_TRAIN), ("clutch", OF_CLUTCH), ("cross", OF_CROSS))
    typed = {key: TYPED[key] for key in ("productivity", "sheet_length", "sheet_width", "working_length", "generatrix_length",
                                         "chain_pitch", "sprocket_teeth", "conveyor_mass",
                                         "sheet_play", "damper_velocity", "belt_efficiency")}  # fmt: skip
    return typed | {key: value for name, names in parts for key, value in taken(found[name], names).items()}


@cache
def the_example() -> Calculation:
    """The check of the example press."""
    return consistency(example_keys())


@cache
def verdicts_of_the_whole() -> dict[str, str]:
    """The verdicts on the whole press without a change."""
    return verdicts(consistency(whole_press()))


def consistency(keys: dict[str, Any], **changes: Any) -> Calculation:
    """The check with changes; a key that is None is left out."""
    given = {key: value for key, value in (keys | changes).items() if value is not None}
    return calculate(MECHANISM, inputs(MECHANISM, given))


def verdicts(calculation: Calculation) -> dict[str, str]:
    """The status of each check that is made."""
    return {check.id: check.status for check in checks.verdicts(calculation) if check.status != "not_checked"}


@pytest.mark.parametrize(("mass", "status"), [(80, "warn"), (119.9, "warn"), (120, "pass")])
def test_carriages_at_the_dampers_are_moved_by_the_drive_too(mass: float, status: str) -> None:
    own = {"damper_mass": "80 kg", "carriage_mass": "40 kg", "cylinder_mass": f"{mass} kg"}
    assert verdicts(consistency(example_keys() | own))["carriages"] == status


PRINTED = {  # SI, of the derivation
    "step_room": (0.1008, 1e-9), "actual_rate": (5918.367 / 3600, 1e-6), "rate_error": (-0.0136, 1e-4),
    "crank_inertia_mean": (7.18859, 1e-5), "crank_inertia_max": (15.34397, 1e-5), "crank_inertia_max_at": (np.radians(328.928), 1e-4),
    "equal_inertia": (15.0834, 1e-4), "slip_heat": (201.173, 1e-3), "lag_angle": (np.radians(15.5516), 1e-5),
    "way_inner": (0.02503, 1e-5), "way_outer": (0.01342, 1e-5), "conveyor_inertia": (3.5740, 1e-4),
    "time_constant": (0.09725, 1e-5), "motor_torque_max": (13.834, 1e-3), "speed_swing": (0.07489, 1e-5),
    "motor_torque_rms": (0.90629 * 1100 / (1450 * np.pi / 30), 1e-4), "play_total": (0.2743e-3, 1e-7), "pitches": (30, 1e-12),
    "speed_ripple": (0.00548, 1e-5),
}  # fmt: skip


@pytest.mark.parametrize("name", PRINTED)
def test_the_numbers_of_the_example_press_are_the_printed_ones(name: str) -> None:
    value, within = PRINTED[name]
    assert number(the_example(), name) == pytest.approx(value, abs=within)


def test_the_shafts_of_pinion_and_rocker_count_at_the_crank_and_in_the_clutch() -> None:
    """As if the cylinder alone had their inertia; they have no unbalance."""
    own = 0.3
    bare = the_example()
    within = consistency(example_keys(), shafts_inertia=own)
    heavier = consistency(example_keys(), cylinder_inertia=number(bare, "inputs.cylinder_inertia") + own)
    for name in ("crank_inertia_mean", "crank_inertia_max", "equal_inertia", "slip_heat"):
        assert number(within, name) == pytest.approx(number(heavier, name), rel=1e-9)
        assert number(within, name) > 1.05 * number(bare, name)


@pytest.mark.parametrize(("share", "sheets"), [(1, 1), (0.5, 0.5), (0.97, 0.97), (2, 1)])
def test_sheets_are_those_of_whole_half_turns_of_the_crank(share: float, sheets: float) -> None:
    """At half its speed it makes half the sheets; one that turns twice as often as at two sheets a turn makes one."""
    bare = the_example()
    slower = {key: share * number(bare, f"inputs.{key}") for key in ("crank_speed", "output_speed")}
    turned = consistency(example_keys() | {key: f"{speed} rad/s" for key, speed in slower.items()})
    assert number(turned, "actual_rate") == pytest.approx(sheets * number(bare, "actual_rate"), rel=1e-9)


@pytest.mark.parametrize("ratio", [2, 9.7])
def test_a_clutch_on_a_faster_shaft_makes_the_same_heat_with_as_much_less_torque(ratio: float) -> None:
    """Its inertia of equal heat is less by the square of the ratio."""
    torque, speed = (number(the_example(), f"inputs.{key}") for key in ("clutch_torque", "crank_speed"))
    slow = consistency(example_keys(), clutch_speed=f"{speed} rad/s")
    fast = consistency(example_keys(), clutch_torque=torque / ratio, clutch_speed=f"{speed * ratio} rad/s")
    for name in ("slip_heat", "slip_time", "start_angle", "lag_angle", "driven_angle", "net_torque"):
        assert number(fast, name) == pytest.approx(number(slow, name), rel=1e-9), name
    assert number(fast, "equal_inertia") == pytest.approx(number(slow, "equal_inertia") / ratio**2, rel=1e-9)


def test_a_clutch_on_the_trains_output_is_one_at_the_crank_by_the_exact_ratio() -> None:
    """The output is 1.3 % slow: its clutch turns twice as fast as the crank really does, not 1.973 times as fast as it should."""
    crank = number(the_example(), "inputs.crank_speed")
    keys = example_keys() | {"output_turns_per_sheet": 1, "output_speed": f"{1.974 * crank} rad/s"}
    slow = consistency(keys, clutch_torque=400, clutch_speed=f"{0.987 * crank} rad/s")
    fast = consistency(keys, clutch_torque=200, clutch_speed=f"{1.974 * crank} rad/s")
    given = consistency(keys, clutch_torque=200, clutch_speed=f"{1.9 * crank} rad/s", clutch_turns=2)
    assert number(fast, "clutch_ratio") == pytest.approx(2, rel=1e-9) and number(given, "clutch_ratio") == 2
    assert number(fast, "slip_heat") == pytest.approx(number(slow, "slip_heat"), rel=1e-9)
    assert number(fast, "equal_inertia") == pytest.approx(number(slow, "equal_inertia") / 4, rel=1e-9)


@pytest.mark.parametrize(
    ("drives", "expected", "inertia"),
    [(["drive"], "pass", True), (["drive", "cross"], "warn", True), (["cross"], "warn", False)],
)
def test_lines_whose_inertia_nobody_compares_are_told(drives: list[str], expected: str, inertia: bool) -> None:
    found = mended(consistency={"clutch_drives": drives})
    assert found["consistency.coupled_inertia"] == expected
    assert ("consistency.driven_inertia" in found) == inertia


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ({"clutch_turns": 2}, "but the clutch turns at"),
        ({"engagement_angle": "0 deg"}, "a friction clutch engages at any angle"),
    ],
)
def test_no_word_makes_an_engagement_mild(typed: dict[str, Any], words: str) -> None:
    """A clutch on the crank's shaft turned half as fast by a typed ratio, and began to slip where that makes least heat."""
    with pytest.raises(Impossible, match=words):
        consistency(example_keys(), **typed)
    pinned = consistency(example_keys(), engagement_angle="0 deg", single_position=True)
    assert number(pinned, "slip_heat") < number(the_example(), "slip_heat")


def test_the_drive_gives_all_that_its_crank_moves() -> None:
    """The greatest kinetic energy that the drive tells is that of the inertia at the crank, where nothing is out of balance."""
    moved = drive(pinion_inertia="0.3 kg*m**2", rocker_inertia="6 kg*m**2", static_unbalance=0)
    keys = (
        example_keys()
        | taken(moved, OF_DRIVE)
        | {"shafts_inertia": number(moved, "shafts_inertia"), "static_unbalance": 0}
    )
    energy = number(consistency(keys), "crank_inertia_max") * number(moved, "inputs.crank_speed") ** 2 / 2
    assert energy == pytest.approx(number(moved, "kinetic_energy_max"), rel=1e-6)


def test_a_brake_stops_the_shafts_too() -> None:
    stopped = {
        "brake_torque": 150,
        "shaft_torque_mean": 90,
        "lines_energy": 270,
        "flywheel_inertia": 3.4,
        "flywheel_speed": "50 rad/s",
    }
    angles = [
        number(consistency(example_keys(), **stopped, shafts_energy=energy), "stopping_angle") for energy in (0, 1600)
    ]
    energies = [3.4 * 50**2 / 2 + 270 + energy for energy in (0, 1600)]
    assert angles == pytest.approx([energy / 240 for energy in energies], rel=1e-9)


def test_the_example_press_is_judged_as_printed_with_the_inertia_that_was_typed() -> None:
    found = verdicts(consistency(example_keys(), clutch_inertia="0.8 kg*m**2"))
    assert {name for name, status in found.items() if status == "fail"} == {"driven_inertia"}
    assert {name for name, status in found.items() if status == "warn"} == {"actual_rate"}
    assert found["format_rolled"] == found["motor_thermal"] == found["conveyor_inertia"] == "pass"
    assert "sheet_gap" not in found
    assert "register" not in found


CHANGED = [  # what passes in the whole press, and a change with which it does not
    ("timing", {"timing_slack": "-1 deg"}, "fail"),
    ("format_rolled", {"working_length": "400 mm"}, "fail"),
    ("format_rolled", {"sheet_width": "480 mm", "sheet_gap": None}, "fail"),
    ("format_generatrix", {"generatrix_length": "690 mm"}, "fail"),
    ("format_generatrix", {"feed_side": "length", "sheet_width": "720 mm", "sheet_gap": None}, "fail"),
    ("step", {"sheet_width": "750 mm", "sheet_gap": None}, "fail"),
    ("sheet_gap", {"sheet_gap": "101 mm"}, "fail"),
    ("actual_rate", {"output_turns_per_sheet": 0.505}, "warn"),
    ("actual_rate", {"output_turns_per_sheet": 0.515}, "fail"),
    ("actual_rate", {"required_rate": "6100 1/h"}, "warn"),
    ("true_rate", {"productivity": "5980 1/h", "output_turns_per_sheet": 0.5}, "warn"),
    ("true_rate", {"loaded_output_speed": "52 rpm"}, "fail"),
    ("wheel_side", {"wheel_side_inertia": "1 kg*m**2"}, "fail"),
    ("driven_inertia", {"clutch_inertia": "0.8 kg*m**2"}, "fail"),
    ("damper_velocity", {"contact_distance": "100 mm"}, "warn"),
    ("damper_impacts", {"damper_impacts": "2990 1/h"}, "fail"),
    ("conveyor_mass", {"conveyor_mass": "11 kg"}, "fail"),
    ("conveyor_inertia", {"wheel_inertia": "1.5 kg*m**2"}, "warn"),
    ("motor_thermal", {"motor_rated_torque": "3 N*m"}, "fail"),
    ("motor_peak", {"breakdown_ratio": 1.0}, "fail"),
    ("speed_swing", {"speed_fluctuation": 0.001}, "warn"),
    ("register", {"backlash": "0.1 mm"}, "fail"),
    ("whole_pitches", {"chain_pitch": "19 mm"}, "fail"),
    ("whole_steps", {"chain_links": 200}, "fail"),
]


@pytest.mark.parametrize("check, change, status", CHANGED)
def test_mechanisms_that_do_not_belong_together_are_told_apart(check: str, change: dict[str, Any], status: str) -> None:
    assert verdicts_of_the_whole()[check] == "pass"
    assert verdicts(consistency(whole_press(), **change))[check] == status


BESIDE = {
    "crankshaft",
    "cross_shaft",
    "crank_pin",
    "rocker_pin",
    "bearings",
    "gear_key",
    "crank_key",
    "main_gears",
    "gripper_chain",
}
"""Elements of the mended press, of which neither timing nor consistency takes anything."""

MENDED = WarmPress(is_advised=False)
"""Calculates anew only the mechanisms that another machine changes."""


def mended(text: str = "", **changes: dict[str, Any]) -> dict[str, str]:
    """The statuses of the checks of the mended press, or of a text, without its elements, with other inputs of its mechanisms."""
    tree = parse(text, "press.yaml") if text else load(EXAMPLE.with_stem("flat_cylinder_press_mended"))
    tree.data["mechanisms"] = {
        name: {key: value for key, value in (block | changes.get(name, {})).items() if value is not None}
        for name, block in tree.data["mechanisms"].items()
        if name not in BESIDE
    }
    run = MENDED.calculate(load_config(tree, DISCOVERY))
    assert not run.errors
    return {f"{name}.{each.id}": each.status for name, made in run.checks.items() for each in made}


@pytest.mark.parametrize(
    ("typed", "status"),
    [(True, "not_checked"), ({"value": True, "basis": "drawing"}, "pass"), (False, "fail")],
)
def test_a_clutch_of_one_position_does_not_pass_by_a_word(typed: Any, status: str) -> None:
    assert mended(consistency={"single_position": typed})["consistency.clutch_position"] == status


def test_the_play_of_the_wheel_is_calculated_for_what_the_timing_leaves() -> None:
    for cover, clearance, margin, play in (
        (10.9, "0.025 mm", "pass", "pass"),
        (11.2, "0.025 mm", "fail", "pass"),
        (10.9, "0.1 mm", "pass", "fail"),
    ):
        told = mended(cross={"cover_angle": f"{cover} deg", "locking_clearance": clearance})
        assert told["consistency.cover_angle"] == margin
        assert told["consistency.register"] == told["cross.sheet_play"] == play
    told = mended(cross={"cover_angle": None})
    assert told["consistency.register"] == told["cross.sheet_play"] == told["consistency.cover_angle"] == "not_checked"


@pytest.mark.parametrize(
    ("held", "margin", "is_held"),
    [
        ("phase: drive.contact, within: cross.dwell", "fail", "pass"),
        ("phase: drive.contact, within: cross.dwell.0", "fail", "pass"),
        ("phase: drive.contact, apart_from: cross.moving", "fail", "pass"),
        ("phase: cross.moving, apart_from: drive.contact", "fail", "pass"),
        ("phase: drive.contact, within: drive.contact", "", "warn"),  # says nothing of what rests
    ],
)
def test_what_must_rest_may_be_said_in_any_way(held: str, margin: str, is_held: str) -> None:
    text = EXAMPLE.with_stem("flat_cylinder_press_mended").read_text("utf-8")
    for old, new in (
        ("phase: drive.contact, within: cross.dwell", held),
        ("cover_angle: {value: 10.9", "cover_angle: {value: 11.2"),
    ):
        assert text.count(old) == 1
        text = text.replace(old, new)
    told = mended(text)
    assert told.get("consistency.cover_angle", "") == margin and told["consistency.held_in_dwell"] == is_held


@pytest.mark.parametrize(
    ("changes", "statuses"),
    [
        ({}, ("pass", "pass")),
        ({"drive": {"segment_height": "30 mm"}}, ("fail", "pass")),
        ({"drive": {"cylinder_radius": "95 mm"}}, ("fail", "pass")),
        ({"damper": {"rolling_radius": "95 mm"}}, ("fail", "pass")),
        ({"drive": {"static_unbalance": "0.5 kg*m"}}, ("pass", "warn")),
        ({"drive": {"cutting_arc_fraction": 0.5}}, ("pass", "warn")),
        ({"damper": {"static_unbalance": "0.5 kg*m", "mass": "90 kg"}}, ("pass", "warn")),
        (
            {"drive": {"cylinder_mass": "150 kg"}, "damper": {"mass": "150 kg"}},
            ("pass", "pass"),
        ),  # other masses move with it
    ],
)
def test_drive_and_dampers_move_the_cylinder_that_is_sized(changes: dict[str, Any], statuses: tuple[str, str]) -> None:
    told = mended(**changes)
    assert (told["consistency.cylinder_sizes"], told["consistency.cylinder_loads"]) == statuses


def test_the_mended_press_is_calculated_for_its_true_rate_and_all_that_its_wheel_moves() -> None:
    told = mended(consistency={"wheel_side_inertia": "2.2 kg*m**2"})
    assert told["consistency.wheel_side"] == "pass"  # the wheel takes its inertia from there
    told = mended(cross={"driven_inertia": "6.731 kg*m**2"})
    assert told["consistency.wheel_side"] == "fail"


def test_the_motor_turns_as_fast_as_its_load_lets_it() -> None:
    """Mean torque over the torque for each radian a second of slip, by the motor's two speeds; the output turns with it."""
    train = calculate(DRIVE_TRAIN, inputs(DRIVE_TRAIN, TRAIN | WORKING))
    rated, synchronous = 1450 * np.pi / 30, 1500 * np.pi / 30
    slip = number(train, "shaft_1_torque") * (synchronous - rated) / number(train, "motor_rated_torque")
    assert 0 < slip < synchronous - rated
    assert number(train, "loaded_motor_speed") == pytest.approx(synchronous - slip, rel=1e-12)
    shares = (number(train, name) for name in ("loaded_output_speed", "output_speed"))
    assert np.divide(*shares) == pytest.approx((synchronous - slip) / rated, rel=1e-12)


def test_a_step_across_the_other_side_needs_the_other_room() -> None:
    keys = whole_press() | {"feed_side": "length", "sheet_gap": None}
    found = consistency(keys)
    assert (number(found, "side_in_feed"), number(found, "side_across")) == pytest.approx((0.7, 0.4707))


@pytest.mark.parametrize("distance", [2.0, 10.0, 60.0, 300.0])
def test_the_speed_at_contact_is_that_at_a_root_of_the_displacement(distance: float) -> None:
    drive = calculations()["drive"]
    found = consistency(example_keys(), contact_distance=distance)
    ends = number(drive, "dead_center_outer"), number(drive, "dead_center_inner")
    place, speed = (CurveHandle(drive, name) for name in ("displacement", "velocity"))

    def at(curve: CurveHandle, angle: float) -> float:
        share = np.array([[angle / (2 * np.pi) % 1]])
        return float(curve.values(share, share, None)[0, 0])

    strokes = {
        "inner": (*ends, number(drive, "stroke") - distance / 1e3),
        "outer": (ends[1], ends[0] + 2 * np.pi, distance / 1e3),
    }
    speeds = []
    for end, (low, high, where) in strokes.items():
        angle = brentq(lambda x, where=where: at(place, x) - where, low, high, xtol=1e-13)
        speeds.append(abs(at(speed, angle)))
        assert number(found, f"contact_speed_{end}") == pytest.approx(speeds[-1], rel=1e-7)
    assert number(found, "contact_speed") == pytest.approx(max(speeds))


def test_dampers_that_stand_at_the_ends_are_met_in_no_stroke() -> None:
    found = consistency(whole_press(), contact_distance="0 mm", damper_impacts="60 1/h")
    assert number(found, "contact_speed") == pytest.approx(0, abs=1e-6) and number(found, "end_impacts") == 0
    assert verdicts(found)["damper_impacts"] == "pass"


def test_at_the_ways_that_are_told_the_cylinder_has_the_speed_of_the_dampers() -> None:
    found = consistency(example_keys())
    for end in ("inner", "outer"):
        again = consistency(example_keys(), contact_distance=number(found, f"way_{end}") * 1e3)
        assert number(again, f"contact_speed_{end}") == pytest.approx(0.6, rel=1e-6)


def test_where_the_drive_is_always_slower_the_way_is_the_stroke() -> None:
    found = consistency(example_keys(), damper_velocity="50 m/s")
    assert number(found, "way_inner") == pytest.approx(number(found, "inputs.stroke"))


def test_an_engagement_angle_that_is_given_is_taken() -> None:
    found = consistency(example_keys(), engagement_angle="90 deg", single_position=True)
    assert number(found, "start_angle") == pytest.approx(np.pi / 2)
    assert number(found, "slip_heat") < number(consistency(example_keys()), "slip_heat")


@pytest.mark.parametrize(
    "change, key, words",
    [
        ({"clutch_load": "800 N*m"}, "clutch_load", "the driven side never comes up to speed"),
        ({"motor_speed": "1600 rpm"}, "motor_speed", "a motor under load turns slower than its synchronous speed"),
        ({"contact_distance": "700 mm"}, "contact_distance", "the whole stroke is"),
    ],
)
def test_a_press_that_cannot_be_is_told_in_words(change: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible, match=words) as refused:
        consistency(example_keys(), **change)
    assert refused.value.key == key


def test_without_any_mechanism_nothing_is_claimed() -> None:
    found = consistency({})
    assert verdicts(found) == {}
    assert not found.values


def test_lines_are_no_words_of_their_own_which_would_be_translated() -> None:
    """“drive” is a word of a catalogue, too; what a phrase is filled with stands as it is."""
    found = listed(("drive",))
    assert found == "drive" and isinstance(found, Phrase) and found.template != found
    assert not any(isinstance(value, Phrase) for value in found.values.values())


@pytest.mark.parametrize(
    ("kinds", "absent", "left"),
    [
        (("platen_press", "geneva_transport", "drive_train"), {"format_rolled", "driven_inertia", "damper_impacts", "conveyor_inertia"},
         {"sheet_gap"}),
        (("cylinder_sizing", "cylinder_drive", "geneva_transport"), {"wheel_side", "clutch_position", "damper_velocity"}, {"timing", "register"}),
    ],
)  # fmt: skip
def test_what_needs_a_mechanism_that_the_press_does_not_have_is_not_among_its_checks(
    kinds: tuple[str, ...], absent: set[str], left: set[str], tmp_path: Path
) -> None:
    file = tmp_path / "new.yaml"
    assert main(["new", *kinds, "-o", str(file), "--quiet"]) == 0
    made = Press.read(file, DISCOVERY).calculate().results.mechanisms["press_consistency"]
    told = {check.id: check.status for check in made.checks}
    assert not absent & told.keys() and {told[each] for each in left} == {"not_checked"}
    assert not any(
        "There is no c" in str(check.message) and "cyclogram" not in str(check.message) for check in made.checks
    )
    assert made.plugin_sha256 == plugin_hash(MECHANISM)
