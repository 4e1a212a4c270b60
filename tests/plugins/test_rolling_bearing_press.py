"""Bearings of a press under the curves of its shaft and drive: numbers of the method, references, studies, what is refused."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.machine.calculation import Impossible
from diecut_report.press import Press
from diecut_report.quantities.plausible import Plausible
from diecut_report.results.mechanism import mechanism_results
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows, columns_of
from tests.configs import DISCOVERY, HEAD, loaded, problems, saved
from tests.machines import checks, statuses
from tests.plugins.bearings import ANGULAR, BALL, ROLLER, SOUGHT, SOUGHT_ROLLER, SWINGING, Over, bearings, one, value
from tests.plugins.test_shaft_of_a_press import DRIVE, SHAFT

BEARINGS = """
  bearings:
    kind: rolling_bearing
    bearings:
      - {name: main_a, type: deep_groove, dynamic_rating: 35.1 kN, static_rating: 21.6 kN, radial_force: "${crankshaft.reaction_a}",
         speed: "${drive.crank_speed}"}
      - {name: main_b, type: deep_groove, dynamic_rating: 55.3 kN, static_rating: 36 kN, radial_force: "${crankshaft.reaction_b}",
         speed: "${drive.crank_speed}"}
      - {name: crank_pin, type: roller, dynamic_rating: 81.5 kN, static_rating: 75 kN, radial_force: "${drive.coupler_force}",
         speed: "${drive.crank_speed}"}
      - {name: rocker_pin, type: roller, dynamic_rating: 81.5 kN, static_rating: 75 kN, radial_force: "${drive.coupler_force}",
         relative_angle: "${drive.transmission_angle}", cycle_speed: "${drive.crank_speed}"}
"""
PRESS = HEAD + DRIVE + SHAFT + BEARINGS
HOUR = 3600.0


@pytest.fixture(scope="module", autouse=True)
def plausible_sizes() -> Iterator[None]:
    """Sizes are judged here as for a user."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Plausible, "holds", Plausible.holds)
        yield


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The results of the press."""
    return Press.read(saved(tmp_path_factory.mktemp("press"), PRESS), DISCOVERY).calculate().results


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("main_a_equivalent_load", 2675.4), ("main_a_life", 752700 * HOUR), ("main_a_static_safety", 4.52),
        ("main_b_equivalent_load", 6879.5), ("main_b_life", 173140 * HOUR), ("main_b_static_safety", 2.461),
        ("crank_pin_equivalent_load", 4951.5), ("crank_pin_life", 3.781e6 * HOUR), ("crank_pin_static_safety", 7.50),
        ("rocker_pin_equivalent_load", 4352.8), ("rocker_pin_life", 1.759e7 * HOUR), ("rocker_pin_turns_per_cycle", 0.33032),
        ("rocker_pin_swing", np.radians(59.46)),
    ],
)  # fmt: skip
def test_the_bearings_of_the_press_have_the_numbers_of_the_method(results: Any, name: str, expected: float) -> None:
    """The method samples a turn at 720 places; both limits at the jumps of the drive's forces add up to 0.3 %."""
    assert results.mechanisms["bearings"].outputs[name].value == pytest.approx(expected, rel=3e-3)


def test_only_the_joint_that_swings_is_warned_of(results: Any) -> None:
    found = {check.id: check for check in results.mechanisms["bearings"].checks}
    assert [name for name, check in found.items() if check.status not in ("pass", "not_checked")] == [
        "rocker_pin_oscillation"
    ]
    assert "fretting" in found["rocker_pin_oscillation"].message
    assert {"main_a_life", "main_a_static", "main_a_min_load", "main_a_load_level", "rocker_pin_dwell"} <= set(found)
    assert "main_a_oscillation" not in found


def test_each_bearing_has_its_curves(results: Any) -> None:
    curves = results.mechanisms["bearings"].curves
    for name in ("main_a", "main_b", "crank_pin", "rocker_pin"):
        assert {f"{name}_load", f"{name}_speed"} <= set(curves)
    reaction = results.mechanisms["crankshaft"].curves["reaction_b"]
    np.testing.assert_allclose(curves["main_b_load"].values, reaction.values, rtol=1e-9)
    swing = np.array(results.mechanisms["drive"].curves["transmission_angle"].values)
    turned = np.cumsum(curves["rocker_pin_speed"].values) * 2 * np.pi / 360 / (50 * 2 * np.pi / 60)
    np.testing.assert_allclose(np.ptp(turned), np.ptp(swing), rtol=1e-3)


def test_results_and_curves_of_a_bearing_are_referred_to_by_its_name(tmp_path: Path) -> None:
    hook = """
  again:
    kind: rolling_bearing
    required_life: ${bearings.main_b_life} / 10
    bearings:
      - {name: same, type: deep_groove, dynamic_rating: "${bearings.main_b_dynamic_rating}", static_rating: 36 kN,
         radial_force: "${bearings.main_b_load}", speed: "${bearings.main_b_mean_speed}"}
"""
    found = Press.read(saved(tmp_path, PRESS + hook), DISCOVERY).calculate().results.mechanisms
    assert found["again"].outputs["same_life"].value == pytest.approx(
        found["bearings"].outputs["main_b_life"].value, rel=1e-9
    )
    (told,) = problems(tmp_path, PRESS + hook.replace("main_b_life", "main_c_life"))
    assert "main_c_life" in told and "main_b_life" in told
    (told,) = problems(tmp_path, PRESS + hook.replace("bearings.main_b_life", "bearings.life"))
    assert "a value for each" in told


# --- what is refused, and what is told ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("parts", "key", "words"),
    [
        ([], "bearings", "empty"),
        ([BALL, BALL], "bearings.1.name", "as is that of part 1 of bearings"),
        ([BALL | {"name": "left bearing"}], "bearings.0.name", "letters, digits and underscores"),
        ([BALL | {"name": "system"}], "bearings.0.name", "called as another one"),
        ([BALL | {"radial_force": 0}], "bearings.0.radial_force", "give the force"),
        ([BALL, ROLLER | {"axial_force": 100}], "bearings.1.axial_force", "cylindrical rollers bear no axial force"),
        ([{**BALL, "f0": None} | {"axial_force": 100}], "bearings.0.axial_force", "f0 of a deep groove"),
        ([SWINGING | {"relative_angle": 30}], "bearings.0.relative_angle", "refer to the curve"),
        (
            [SWINGING | {"relative_angle": Over(np.sin, rate=np.array([[5.0]]))}],
            "bearings.0.cycle_speed",
            "is not the 47.75",
        ),
        ([SWINGING | {"radial_force": Over(np.sin, cycle="disc_angle")}], "bearings.0.relative_angle", "another cycle"),
        ([SOUGHT | {"radial_force": 90000}], "bearings.0.series", "heavier series"),
        (
            [BALL | {"designation": "6209", "dynamic_rating": 351}],
            "bearings.0.dynamic_rating",
            "times that of the table",
        ),
        (
            [ROLLER, BALL | {"designation": "6209", "static_rating": 9.9}],
            "bearings.1.static_rating",
            "times that of the table",
        ),
        (
            [ROLLER | {"designation": "NU 2208", "dynamic_rating": 8.15}],
            "bearings.0.dynamic_rating",
            "times that of the table",
        ),
        ([SOUGHT | {"designation": "7209"}], "bearings.0.designation", "not in the table"),
        ([SOUGHT | {"type": "ball", "axial_force": 0}], "bearings.0.dynamic_rating", "maker's catalogue"),
        ([SOUGHT_ROLLER | {"series": "62"}], "bearings.0.series", "NU2, NU22, NU3, NU23"),
        ([SOUGHT | {"series": "NU3"}], "bearings.0.series", "60, 62, 63"),
        ([SOUGHT_ROLLER | {"designation": "NU 208"}], "bearings.0.designation", "NU208E if it is that one"),
        ([SOUGHT_ROLLER | {"designation": "NU 240 E"}], "bearings.0.designation", "NU204E to NU2320E"),
        ([SOUGHT_ROLLER | {"axial_force": 100}], "bearings.0.axial_force", "bear no axial force"),
    ],
)
def test_bearings_that_cannot_be_are_refused_in_words(parts: list[dict[str, Any]], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        bearings(*parts)
    assert (refused.value.key, words in refused.value.message) == (key, True)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("speed: 50 rpm, relative_angle: \"${drive.transmission_angle}\", cycle_speed: 50 rpm", "both given"),
        ("name: pin", "speed"),
        ("relative_angle: \"${drive.transmission_angle}\"", "cycle_speed"),
        ("speed: 50 rpm, x: 0.5", "y"),
        ("speed: 50 rpm, rolling_elements: 4", "≥ 5"),
        ("speed: 50 rpm, a_iso: 60", "≤ 50"),
    ],
)  # fmt: skip
def test_keys_that_do_not_fit_together_are_told(text: str, words: str, tmp_path: Path) -> None:
    part = f"{{type: ball, dynamic_rating: 30 kN, static_rating: 20 kN, radial_force: 1 kN, {text}}}"
    named = part if "name:" in text else part.replace("{type", "{name: pin, type")
    told = problems(tmp_path, HEAD + DRIVE + f"  bearings: {{kind: rolling_bearing, bearings: [{named}]}}\n")
    assert words in " ".join(told)


def test_a_small_swing_is_told_that_a_rating_life_does_not_apply() -> None:
    calc = one(SWINGING, relative_angle=Over(lambda phi: np.radians(9.9) * np.sin(phi)))
    found = checks(calc)
    assert found["swinging_dwell"].status == found["swinging_oscillation"].status == "warn"
    assert "does not apply" in found["swinging_dwell"].message
    wide = checks(one(SWINGING, relative_angle=Over(lambda phi: np.radians(40) * np.sin(phi))))
    assert wide["swinging_dwell"].status == wide["swinging_oscillation"].status == "pass"


@pytest.mark.parametrize(
    "parts",
    [[ROLLER | {"speed": 0}], [BALL | {"speed": 0, "f0": 13.0, "axial_force": 100}, BALL | {"name": "turning"}]],
)
def test_bearings_that_stand_are_reported_with_their_static_safety(parts: list[dict[str, Any]]) -> None:
    """Without a life of any, nothing is printed in the place of lives."""
    found = mechanism_results(bearings(*parts), {})
    judged = {check.id for check in found.checks}
    assert f"{parts[0]['name']}_static" in judged and f"{parts[0]['name']}_life" not in judged
    assert ("life_min" in found.outputs) is (len(parts) > 1)


def test_an_angle_that_goes_on_turns_and_does_not_swing() -> None:
    calc = one(SWINGING, relative_angle=Over(lambda phi: phi + 0.3 * np.sin(phi)))
    assert value(calc, "turns_per_cycle") == pytest.approx(1, rel=1e-9)
    assert "swinging_oscillation" not in checks(calc)


def test_a_bearing_that_bears_too_little_or_too_much_is_warned_of() -> None:
    light, heavy = checks(one(ROLLER, radial_force=1500)), checks(one(ROLLER, radial_force=42000))
    assert light["roller_min_load"].status == "warn" and heavy["roller_min_load"].status == "pass"
    assert light["roller_load_level"].status == "pass" and heavy["roller_load_level"].status == "warn"
    assert statuses(one(ROLLER, radial_force=52000))["roller_static"] == "fail"
    assert statuses(one(BALL, axial_force=12000, radial_force=1000))["ball_axial"] == "warn"


def test_speeds_are_held_against_the_makers_limit_where_it_is_known() -> None:
    found = checks(bearings(BALL, ANGULAR | {"speed": 9500}, ROLLER))
    assert {name: found[f"{name}_speed"].status for name in ("ball", "angular", "roller")} == {
        "ball": "not_checked", "angular": "warn", "roller": "not_checked",
    }  # fmt: skip


def test_a_bearing_whose_tilt_is_not_given_is_not_checked_though_others_hold() -> None:
    found = checks(bearings(BALL | {"tilt": 0.5}, ROLLER, ANGULAR | {"tilt": 0.6}))
    assert {name: found[f"{name}_tilt"].status for name in ("ball", "roller", "angular")} == {
        "ball": "pass", "roller": "not_checked", "angular": "warn",
    }  # fmt: skip
    unknown = found["roller_tilt"]
    assert unknown.missing == ["bearings.tilt"] and "0.29 mrad" in str(unknown.message)


@pytest.mark.parametrize(
    ("designation", "permitted"),
    [("NU 2208", 0.87), ("n208e", 0.87), ("NJ 208", 0.87), ("NUP 208", 0.29), ("NA 4908", 0.29), ("", 0.29)],
)
def test_of_rollers_those_are_allowed_the_tilt_of_cylindrical_ones_that_are_known_to_be(
    designation: str, permitted: float
) -> None:
    """By the makers: 3′ of N and NU, 2′ of NUP, 1′ of needles; what it is is known by the designation alone."""
    found = checks(one(ROLLER | ({"designation": designation} if designation else {}), tilt=0.28))["roller_tilt"]
    assert found.limit * 1e3 == pytest.approx(permitted) and found.status == "pass"
    assert statuses(one(ROLLER, tilt=0.59))["roller_tilt"] == "fail"  # beyond twice what is permitted


def test_variants_of_a_press_are_each_press_alone(tmp_path: Path) -> None:
    base = loaded(tmp_path, PRESS)
    varied = {"mechanisms.drive.cutting_force_per_length": np.array([1e4, 2.5e4, 4e4, 6e4]),
              "mechanisms.bearings.bearings.1.dynamic_rating": np.array([3e4, 5e4, 6e4, 7e4])}  # fmt: skip
    rows = calculate_rows(base, {find_input(base, path): values for path, values in varied.items()}, 4)
    assert not rows.slow
    assert set(rows.columns) <= {column.name for column in columns_of(base)}
    text = PRESS.replace("cutting_force_per_length: 25 N/mm", "cutting_force_per_length: 40 N/mm").replace(
        "55.3 kN", "60 kN"
    )
    alone = Press.read(saved(tmp_path, text), DISCOVERY).calculate().results.mechanisms["bearings"].outputs
    for name in ("main_b_life", "crank_pin_equivalent_load", "rocker_pin_turns_per_cycle", "life_min", "system_life"):
        assert rows.columns[f"bearings.{name}"][2] == pytest.approx(alone[name].value, rel=1e-9)
