"""What a report concludes, a chief engineer can sign: it says what it holds for, and no number says more than is known."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

from diecut_report.machine.printing.page import section_items
from diecut_report.plugins.press_consistency import CHECKS
from diecut_report.results.mechanism import mechanism_results
from tests.machines import number
from tests.plugins.cases import MECHANISMS
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
