"""What a report concludes, a chief engineer can sign: it says what it holds for, each key result has a limit, and what fails is told a remedy."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

import pytest
import yaml

from diecut_report.config.plugins import Discovery
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.printing.substitution import printed
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Choice
from diecut_report.plugins.cam_gear_transport import MECHANISM as CAM_GEAR
from diecut_report.plugins.cam_gear_transport import MECHANISM as STEPPER
from diecut_report.plugins.geneva_transport import MECHANISM as GENEVA
from diecut_report.plugins.press_consistency import CHECKS
from diecut_report.press import Press
from diecut_report.quantities.units import unit
from diecut_report.results.checks import check_results
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import ResultsRecord
from tests.configs import EXAMPLES, saved
from tests.machines import drive, inputs, number
from tests.plugins import gears, steppers
from tests.plugins.cases import FULL, MECHANISMS, OF_KINDS
from tests.plugins.dampers import calculated
from tests.plugins.followers import driven, follower
from tests.plugins.platens import platen
from tests.plugins.shafts import CRANKSHAFT, shaft
from tests.plugins.steppers import stepper
from tests.processes import Example
from tests.validation.rows_damper import WORKED

CONVEYOR = {"inertia": "0.0993 kg*m**2", "stiffness": "3300 N*m/rad", "damping_ratio": 0.05, "cycles_per_hour": 6000}
KEY_RESULT = "speed_verdict"


def recommendation(results: dict[str, Any]) -> tuple[str, str]:
    """The law that is named, and how."""
    named = results.outputs["recommended_law"]
    return named.value, named.description


@pytest.mark.usefixtures("without_advice")
def test_the_law_that_a_curve_is_told_is_said_to_be_that_of_a_single_rise() -> None:
    """For the gear of the cam-gear stepper it is not the gentlest: the law that makes the curve loads the link less."""
    peaks = {
        law: driven(stepper(motion_law=law), "gear_angle", **CONVEYOR) for law in ("cycloidal", "modified_trapezoidal")
    }
    law, words = recommendation(mechanism_results(peaks["cycloidal"], {}))
    assert law == "modified_trapezoidal" and "single rise" in words
    assert number(peaks[law], "acceleration_peak") > 1.1 * number(peaks["cycloidal"], "acceleration_peak")
    assert "single rise" not in recommendation(mechanism_results(follower(), {}))[1]


@pytest.mark.parametrize(
    ("speed", "words"),
    [(4056, "more than ten times"), (4058, "twice to ten times"), (20283, "twice to ten"), (20285, "less than twice")],
)
def test_the_critical_speed_is_told_beside_the_speed(speed: float, words: str) -> None:
    key = mechanism_results(shaft(CRANKSHAFT, speed=speed), {}).outputs[KEY_RESULT]
    assert words in key.value and key.key


@pytest.mark.parametrize("changes", [{}, {"speed": 50, "rotation": "none"}])
def test_a_shaft_without_a_speed_of_its_own_has_no_critical_speed_among_its_key_results(
    changes: dict[str, Any],
) -> None:
    outputs = mechanism_results(shaft(CRANKSHAFT, **changes), {}).outputs
    assert KEY_RESULT not in outputs and not outputs["critical_speed"].key


def products(tree: Any) -> Iterator[list[Any]]:
    """The products within a printed formula."""
    if isinstance(tree, list):
        if tree[:1] == ["*"]:
            yield tree
        for part in tree:
            yield from products(part)


def test_no_factor_of_one_stands_in_the_nominal_stress_of_a_shaft() -> None:
    items = [item for section in section_items(shaft(CRANKSHAFT)) for item in section["items"]]
    [stress] = [item for item in items if item.get("id") == "von_mises_max"]
    assert not [each for each in products(stress["equation"]) if ["num", "1"] in each]


def test_the_friction_on_which_a_platen_press_rests_is_a_key_result() -> None:
    assert mechanism_results(platen(), {}).outputs["friction_limit"].key


def test_a_press_whose_timing_fails_is_told_that_its_motor_is_not_yet_judged() -> None:
    [timing] = [check for check in CHECKS if check.id == "timing"]
    assert "motor and flywheel" in timing.consequence


def test_an_extreme_that_is_but_rounding_has_no_place() -> None:
    """The link of a curve begins at rest: its lowest position is 0 but for the rounding of two integrals."""
    calc = driven(stepper(), "gear_angle", **CONVEYOR)
    items = {item["id"]: item for section in section_items(calc) for item in section["items"] if "id" in item}
    assert 0 < abs(number(calc, "response_min")) < 1e-9 and "at" not in items["response_min"]
    assert "at" in items["response_max"]


def test_a_limit_that_is_used_is_not_told_to_be_idle() -> None:
    """Without a drive that pushes, the allowed force limits that of the impact alone."""
    told = mechanism_results(calculated(WORKED | {"allowable_force": "6 kN"}), {}).absent
    assert (
        "Drive still pushing" in (titles := {each.title for each in told})
        and "Force of a damper with the drive" not in titles
    )


def test_a_life_in_seconds_is_that_in_hours(example: Example) -> None:
    items = [item for each in json.loads(example.told)["mechanisms"]["bearings"]["sections"] for item in each["items"]]
    lives = [each for item in items for each in item.get("conversions", []) if each["shown"]["unit"] == "h"]
    assert len(lives) >= 3
    for life in lives:
        seconds = float(life["shown"]["text"]) * 3600
        assert float(life["converted"]["text"]) == pytest.approx(seconds, rel=6e-4)


def test_no_key_result_of_the_press_is_a_row_which_the_summary_could_not_tell(example: Example) -> None:
    for mechanism in json.loads(example.told)["mechanisms"].values():
        rows = {name.partition(".")[0] for name in mechanism["outputs"] if "." in name}
        assert not rows & set(MECHANISMS[mechanism["kind"]].key_results)


def test_the_offset_that_is_found_is_a_key_result(example: Example) -> None:
    timing = json.loads(example.told)["mechanisms"]["timing"]["outputs"]
    assert timing["offset_found"]["key"] and timing["offset_found"]["value"] == timing["line_offset.1"]["value"]


LIMITED = ("N", "N*m", "MPa", "m/s", "m/s**2", "K", "rad/s**2", "W")
"""Units of what a machine must be limited in: forces, torques, pressures, speeds, accelerations, temperatures, powers."""

ENERGIES = ("J", "kJ")  # of the kind of torques

WITHOUT = {
    "cam_gear_transport": {
        "sheet_velocity_max": "the sheet bears the acceleration or does not, at whatever speed",
        "gear_acceleration_peak": "judged as acceleration of the sheet, to which it is in proportion",
    },
    "circular_knife": {
        "cut_speed_max": "no limit of the cut is known that depends on it; the board's rate follows from the press"
    },
    "clutch": {
        "pressing_force": "judged as pressure of the lining",
        "release_force": "judged by whether the clutch releases by itself",
    },
    "cyclogram": dict.fromkeys(
        ("torque_mean", "torque_peak", "torque_rms", "power_peak"),
        "a demand on flywheel and motor, judged in the drive train and by the consistency of the press",
    ),
    "cylinder_drive": {
        "velocity_max": "follows from stroke and rate; the acceleration is judged",
        "cutting_moment": "a load, judged within the torque at the crank",
        "crank_torque_mean": "a demand on the motor, judged in the drive train",
        "crank_torque_rms": "a demand on the motor, judged in the drive train",
        "power_mean": "a demand on the motor, judged in the drive train",
        "power_peak": "a demand on the motor, judged in the drive train",
    },
    "damper": {"rebound_velocity": "what is left of the energy is taken up by the drive"},
    "drive_train": {},
    "elastic_follower": {
        "acceleration_peak": "judged as its ratio to the rigid one",
        "acceleration_rigid": "what the ratio is taken to",
    },
    "gear_pair": {"tangential_force": "judged as stress of flank and root"},
    "geneva_transport": {
        "sheet_velocity_max": "the sheet bears the acceleration or does not, at whatever speed",
        "roller_force_peak": "judged as pressure of the roller",
    },
    "knife_drive": {
        "roller_velocity": "follows from the rollers' diameter and rate; the grip's acceleration is judged"
    },
    "parallel_key": {"key_force": "judged as pressure and shear"},
    "platen_press": {
        "velocity_at_contact": "the cut bears any speed of a platen; its force is a load",
        "torque_max_source": "the greatest torque by the formula of the source, beside this one",
        "torque_dead_center": "judged within the greatest torque",
        "inertia_force_max": "judged where it matters, at the dead centre",
        "power_mean": "a demand on the motor",
    },
    "roller_chain": {
        "tension_peak": "judged as safety against breaking and as pressure of the joints",
        "velocity": "follows from teeth and speed; the pressure that a maker allows falls with it",
    },
    "shaft": {
        "bending_moment_max": "judged as stress, with the notches",
        "reaction_a_max": "a load of the bearing",
        "reaction_b_max": "a load of the bearing",
    },
}


def needing(mechanism: Mechanism) -> set[str]:
    """The key results in units of what a machine must be limited in."""
    steps = [step for _, step in mechanism.steps if hasattr(step, "unit")]
    texts = {step.id for step in steps if isinstance(step, Choice) and isinstance(step.cases[0].value, str)}
    declared = {step.id: step.unit for step in steps if step.unit not in ENERGIES and step.id not in texts}
    kinds = {unit(each).kind for each in LIMITED}
    return {name for name in mechanism.key_results if name in declared and unit(declared[name]).kind in kinds}


@pytest.mark.parametrize("kind", OF_KINDS)
def test_each_key_result_that_must_be_limited_has_a_check_or_a_reason(kind: str) -> None:
    mechanism = OF_KINDS[kind]
    judged = {name for check in mechanism.checks for name in check.named}
    assert needing(mechanism) - judged == set(WITHOUT.get(kind, {}))


@pytest.mark.parametrize("kind", OF_KINDS)
def test_each_check_has_a_class_and_self_tests_are_balances_alone(kind: str) -> None:
    classes = {check.id: check.check_class for check in OF_KINDS[kind].checks}
    assert set(classes.values()) <= {"function", "strength", "practice", "numerical"}
    own = {name for name, found in classes.items() if found == "numerical"}
    assert own <= {"energy_balance", "power_balance", "gear_turn", "energy", "critical_bounds", "mean_bounds"}


KINDS = [*Discovery().origins]
KEY_WITH_VALUE = re.compile(r"\b(\w+): (\w+)")


def prose(mechanism: Mechanism) -> Iterator[str]:
    """What stands in a report as sentences: texts of chapters and captions."""
    yield from (chapter.text for chapter in mechanism.chapters)
    yield from (figure.caption for figure in mechanism.figures)


@pytest.mark.parametrize("kind", KINDS)
def test_no_sentence_says_a_choice_as_it_is_typed(kind: str) -> None:
    typed = {("engagement", "away"), ("engagement", "die"), ("role", "cylinder"), ("role", "other")}
    assert not {pair for text in prose(Discovery().mechanism(kind)) for pair in KEY_WITH_VALUE.findall(text)} & typed


def compared(tree: Any) -> Iterator[list[Any]]:
    """The comparisons within a printed condition."""
    if isinstance(tree, list):
        if tree[:1] == ["cmp"]:
            yield tree
        for part in tree:
            yield from compared(part)


def test_a_share_that_is_held_against_a_plain_number_stands_as_a_share() -> None:
    items = [item for section in section_items(shaft(CRANKSHAFT, reliability="99 %")) for item in section["items"]]
    [reliability] = [item for item in items if item.get("words") == "99 %"]
    [[_, sign, left, right]] = compared(reliability["condition_substituted"])
    assert (sign, left, right) == ("<", ["qty", "0.99", "1"], ["num", "0.995"])


def test_only_the_keys_that_are_not_given_are_named_as_missing() -> None:
    calc = steppers.stepper(sprocket_teeth=30, chain_pitch="19.05 mm")
    told = {part.title: part.text for part in mechanism_results(calc, {}).absent}
    assert told["Torque"] == "not calculated: conveyor_mass not given"
    assert told["Rest of the sheet within a tolerance"] == "not calculated: rest_tolerance not given"


def test_no_length_of_a_gear_is_finer_than_it_can_be_made() -> None:
    outputs = mechanism_results(gears.pair(gears.HELICAL), {}).outputs
    lengths = [row.display.text for row in outputs.values() if row.display.unit == "mm"]
    assert len(lengths) > 10
    assert all(len(text.partition(".")[2]) <= 3 for text in lengths)


def test_a_work_that_only_left_out_steps_name_is_not_among_the_sources() -> None:
    without, rolled = (
        steppers.stepper(),
        calculate(CAM_GEAR, inputs(CAM_GEAR, next(iter(FULL["cam_gear_transport"].values())))),
    )
    told = [{source.id for source in mechanism_results(calc, {}).sources} for calc in (without, rolled)]
    assert told == [{"003"}, {"003", "Hertz"}]


def test_what_a_drawing_or_a_message_says_of_a_length_is_no_finer_either() -> None:
    number, unit = printed(gears.pair(gears.HELICAL), "root_chord_1").split(" ")
    assert unit == "mm" and len(number.partition(".")[2]) <= 3


def check(calc: Calculation, name: str) -> CheckRecord:
    return {found.id: found for found in check_results(calc)}[name]


def test_a_crank_of_five_millimetres_says_what_its_joints_bear_and_that_nobody_limits_it() -> None:
    calc = drive(crank_length="5 mm")
    found = check(calc, "joint_force")
    assert (found.status, found.missing) == ("not_checked", ["allowable_joint_force"])
    assert found.demand == pytest.approx(number(calc, "joint_force_max")) and found.demand > 100e3


ELEMENTS = next(path for path in EXAMPLES if path.stem == "flat_cylinder_elements").read_text(encoding="utf-8")
PINS = ("crank_pin", "rocker_pin")
LOADED = ("cylinder", "drive", *PINS)  # the pins, and what their forces come from
GIVEN = "diameter: {value: 40 mm, basis: assumed, note: bore of its bearing}"
BORED = "        designation: NU 2208\n"  # which a pin of another diameter contradicts


def press(tmp_path_factory: pytest.TempPathFactory, diameter: str, *only: str) -> ResultsRecord:
    """The press with pins of one diameter, or some mechanisms of it."""
    assert ELEMENTS.count(GIVEN) == len(PINS)
    assert ELEMENTS.count(BORED) == len(PINS)
    data = yaml.safe_load(ELEMENTS.replace(GIVEN, diameter).replace(BORED, ""))
    data["mechanisms"] = {name: data["mechanisms"][name] for name in only or data["mechanisms"]}
    file = saved(tmp_path_factory.mktemp("pins"), yaml.safe_dump(data, sort_keys=False))
    return Press.read(file, Discovery([])).calculate().results


@pytest.fixture(scope="module")
def thin(tmp_path_factory: pytest.TempPathFactory) -> ResultsRecord:
    return press(tmp_path_factory, "diameter: 5 mm")


def failed(results: ResultsRecord, name: str) -> dict[str, str]:
    """The messages of the checks that fail."""
    return {check.id: check.message for check in results.mechanisms[name].checks if check.status == "fail"}


@pytest.mark.nightly
def test_a_press_with_pins_of_five_millimetres_fails_for_its_pins(thin: ResultsRecord) -> None:
    elements = {
        name: data.status
        for name, data in thin.mechanisms.items()
        if data.kind in ("shaft", "gear_pair", "parallel_key")
    }
    faults = {name for name, status in elements.items() if status == "fail"}
    assert faults == {*PINS, "crank_key"}  # the published press's own key fails by its reversals
    assert all(set(failed(thin, name)) == {"fatigue", "yield"} for name in PINS)
    assert thin.status == "fail"


@pytest.mark.parametrize("name", PINS)
@pytest.mark.nightly
def test_the_stress_of_a_pin_is_that_of_a_beam_in_the_middle(thin: ResultsRecord, name: str) -> None:
    force = 9994.35  # N, the greatest of the coupler, as the method's worked example has it
    expected = force * 60e-3 / 4 * 32 / (3.141592653589793 * 5e-3**3)  # F l/4 over π d³/32
    assert thin.mechanisms[name].outputs["von_mises_max"].value == pytest.approx(expected, rel=1e-5)


@pytest.mark.nightly
def test_pins_without_a_diameter_get_the_least_that_holds(tmp_path_factory: pytest.TempPathFactory) -> None:
    sized = press(tmp_path_factory, "bore: 0 mm", *LOADED)
    sizes = [sized.mechanisms[name].outputs["section_diameter.0"].value for name in PINS]
    assert all(not failed(sized, name) for name in PINS) and all(0.015 < size < 0.032 for size in sizes)


CHAIN = {"sprocket_teeth": 30, "chain_pitch": "19.05 mm"}
SHEET = {"grammage": "450 g/m**2", "sheet_length": "700 mm", "sheet_width": "470 mm", "gripper_force": "5 N"}
MACHINES = {
    "crank_speed": (GENEVA, CHAIN | {"center_distance": "240 mm", "roller_radius": "16 mm", "gear_ratio": 6, "crank_speed": "100 rpm"}),
    "cycles_per_hour": (STEPPER, CHAIN | {"dwell_angle": "160 deg", "sector_dwell_sweep": "60 deg", "sector_stop_sweep": "20 deg",
                                          "center_distance": "300 mm", "cycles_per_hour": "6000 1/h"}),
}  # fmt: skip


@pytest.mark.parametrize("rate", MACHINES)
def test_the_grippers_hold_the_sheets_inertia(rate: str) -> None:
    mechanism, keys = MACHINES[rate]
    calc = calculate(mechanism, inputs(mechanism, keys | SHEET))
    assert number(calc, "sheet_mass") == pytest.approx(0.450 * 0.7 * 0.47, rel=1e-12)
    assert number(calc, "sheet_force") == pytest.approx(0.14805 * number(calc, "sheet_acceleration_max"), rel=1e-12)
