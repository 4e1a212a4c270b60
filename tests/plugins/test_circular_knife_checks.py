"""What a circular knife cannot do, and what its checks say."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.machine.calculation import Impossible
from diecut_report.press import Press
from tests.configs import EXAMPLES, HEAD, problems
from tests.machines import number
from tests.plugins.knives import checks, knife
from tests.validation.rows_circular_knife import KEYS


@pytest.mark.parametrize(
    "changes, key, words",
    [
        ({"edge_radius": "20 mm"}, "edge_radius", "R > r = 20 mm"),
        ({"depth": "80 mm"}, "depth", "R − r = 80 mm"),
        ({"depth": "120 mm"}, "depth", "R + r = 120 mm"),
        ({"thickness": "112 mm"}, "thickness", "h < H = 112 mm"),
        ({"thickness": "1e-9 mm"}, "thickness", "a millionth of the edge's radius R = 100 mm"),
        ({"front_distance": "44 mm"}, "front_distance", "cannot reach the board"),
        ({"cut_length": "18 mm"}, "cut_length", "b + L = 44 mm"),
        ({"front_distance": "16.2 mm"}, "front_distance", "16.36 mm from the axis"),
        (
            {"depth": "95 mm", "front_distance": "19.364 mm", "thickness": "6 mm"},
            "front_distance",
            "19.36 mm from the axis",
        ),
    ],
)
def test_a_knife_that_cannot_cut_is_refused_in_words(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        knife(**changes)
    assert refused.value.key == key
    assert words in refused.value.message


@pytest.mark.parametrize(
    "limit, changed",
    [
        ("front_distance", lambda v: 0.01636 + v),
        ("cut_length", lambda v: 0.0170813 - v),
        ("depth", lambda v: 0.1127786 - v),
    ],
)
def test_within_the_limits_of_the_geometry_a_knife_is_calculated(limit: str, changed: Any) -> None:
    """b ≥ √(20² − 11.5²) = 16.363 mm; b + L ≤ √(120² − 112²) = 43.081 mm; H ≤ √(120² − 41²) = 112.7786 mm."""
    value = changed(5e-6)
    calc = knife(**{limit: f"{value} m"})
    assert number(calc, "work") > 0


def test_a_sound_knife_passes_all_checks() -> None:
    found = checks(knife())
    assert list(found) == [
        "reach",
        "shear_angle",
        "expulsion",
        "monotonic",
        "entry",
        "shear_resistance",
        "force",
        "torque",
    ]
    missing = [found.pop(name).missing for name in ("shear_resistance", "force", "torque")]
    assert missing == [["rule_force"], ["allowable_force"], ["allowable_torque"]]
    assert {check.status for check in found.values()} == {"pass"}
    assert found["reach"].utilisation == pytest.approx(41 / (120**2 - 112**2) ** 0.5, rel=1e-12)


def test_the_governing_side_of_the_shear_angle_is_shown() -> None:
    upper, lower = (
        checks(knife())["shear_angle"],
        checks(knife(front_distance="20 mm", cut_length="1 mm"))["shear_angle"],
    )
    assert upper.demand == pytest.approx(number(knife(), "shear_angle_max")) and "20°" in upper.message
    assert "2°" in lower.message and lower.utilisation == pytest.approx(lower.demand / lower.limit)
    assert lower.limit == number(knife(front_distance="20 mm", cut_length="1 mm"), "shear_angle_min")


@pytest.mark.parametrize(
    "changes, name, words",
    [
        ({"front_distance": "18 mm"}, "shear_angle", "below 2°"),
        ({"front_distance": "29 mm", "cut_length": "14 mm"}, "shear_angle", "beyond 20°"),
        ({"friction": 0.1}, "expulsion", "clamped"),
        ({"friction": 0}, "expulsion", "clamped"),
        ({"friction": 0}, "expulsion", "Set friction to"),
        ({"thickness": "3 mm", "cut_length": "17 mm"}, "monotonic", "runs back"),
        ({"depth": "80.3 mm", "front_distance": "4 mm"}, "entry", "from above"),
    ],
)
def test_a_check_fails_in_words_that_tell_what_to_change(changes: dict[str, Any], name: str, words: str) -> None:
    found = checks(knife(**changes))[name]
    assert found.status == "fail"
    assert words in found.message


@pytest.mark.parametrize(
    "changed", [{"front_distance": "44"}, {"front_distance": "0"}, {"depth": "95", "front_distance": "10"}]
)
def test_a_knife_that_cannot_cut_is_told_of_once(tmp_path: Path, changed: dict[str, str]) -> None:
    """A place out of reach, or in the blade's way, is one mistake and one message."""
    file = tmp_path / "press.yaml"
    file.write_text(
        HEAD + f"  k: {{kind: circular_knife, {', '.join(f'{k}: {v}' for k, v in (KEYS | changed).items())}}}\n"
    )
    with pytest.raises(UserError) as refused:
        Press.read(file, Discovery([])).calculate()
    assert len(refused.value.problems) == 1


@pytest.mark.parametrize("changed", [{"thickness": "1 mm"}, {"edge_radius": "101 mm"}, {"eccentricity": "21 mm"}])
def test_what_is_advised_where_no_place_suits_keeps_the_edge_from_running_back(changed: dict[str, Any]) -> None:
    start = {"thickness": "3 mm", "cut_length": "17 mm"}
    before, after = (checks(knife(**start | change))["monotonic"].utilisation for change in ({}, changed))
    assert after < before


@pytest.mark.parametrize(
    "change, words",
    [
        ("eccentricity: 0", "> 0 mm"),
        ("sharpening_angle: 90 deg", "< 90 °"),
        ("friction: -0.1", "≥ 0"),
        ("speed: 60 1/min", "rpm"),
        ("knife_radius: 3 mm", "knife_radius"),
    ],
)
def test_inputs_out_of_range_are_refused(tmp_path: Path, change: str, words: str) -> None:
    keys = {"eccentricity": "20", "edge_radius": "100", "depth": "112", "front_distance": "26", "thickness": "0.5",
            "cut_length": "15", "sharpening_angle": "20", "speed": "60"}  # fmt: skip
    key, _, value = change.partition(": ")
    text = ", ".join(f"{name}: {given}" for name, given in (keys | {key: value}).items())
    found = problems(tmp_path, HEAD + f"  k: {{kind: circular_knife, {text}}}\n", Discovery([]))
    assert len(found) == 1 and words in found[0]


def test_the_example_is_the_worked_example_and_passes() -> None:
    config = next(path for path in EXAMPLES if path.name == "circular_knife.yaml")
    results = Press.read(config, Discovery([])).calculate().results
    found = results.mechanisms["knife"]
    assert results.status == "pass"
    assert found.outputs["force_max"].value == pytest.approx(4.2 * 10.5276, rel=5e-6)  # of 42, not 10 N/mm²
    for name in ("cut_position", "shear_angle", "cut_speed", "sliding_ratio", "force", "torque"):
        assert found.curves[name].abscissa == "knife_angle"


def test_a_resistance_too_small_for_the_force_of_a_rule_is_told() -> None:
    """25 N/mm over 0.6 mm are 41.67 N/mm²: the advised resistance passes, a little less does not."""
    board = {"thickness": "0.6 mm", "rule_force": "25 N/mm"}
    found = checks(knife(**board))["shear_resistance"]
    assert found.status == "warn"
    assert found.utilisation == pytest.approx(25 / (10 * 0.6), rel=1e-12)
    told = re.search(r"shear_resistance to at least ([\d.]+) N/mm²", found.message)
    assert told and float(told[1]) == pytest.approx(41.67, rel=1e-3)
    for factor, status in ((1, "pass"), (0.999, "warn")):
        again = board | {"shear_resistance": f"{float(told[1]) * factor} N/mm**2"}
        assert checks(knife(**again))["shear_resistance"].status == status
