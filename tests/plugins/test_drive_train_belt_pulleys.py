"""The pulleys in the list of the toothed belt against the drive: whole teeth, radii, the side of the cylinder's pulley."""

from __future__ import annotations

import re
from math import pi
from typing import Any

import numpy as np
import pytest
import yaml

from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.plugins.drive_train.figures import layout
from diecut_report.results.mechanism import mechanism_results
from tests.configs import EXAMPLES
from tests.machines import number
from tests.plugins.drive_trains import check, checked, train

EXAMPLE = next(path for path in EXAMPLES if path.name == "flat_cylinder_belt_press.yaml")
LISTED_CHECKS = ("belt_engagement", "driving_pulley_listed", "pulley_teeth_whole", "cylinder_pulley_listed")
Pulley = tuple[float, float, float, str, str]


def whole(teeth: int) -> float:
    """Pitch radius of so many teeth of 8 mm, mm."""
    return teeth * 8 / (2 * pi)


OVER: list[Pulley] = [  # the upper run passes over the cylinder's pulley, between two smooth guides on its back
    (0, 0, whole(79), "inside", "other"),
    (1700, 0, whole(79), "inside", "other"),
    (1000, 150, 50, "outside", "other"),
    (850, 150, whole(48), "inside", "cylinder"),
    (700, 150, 50, "outside", "other"),
]
UNDER: list[Pulley] = [  # the upper run dips under the cylinder's pulley, between two toothed guides
    (0, 0, whole(40), "inside", "other"),
    (1700, 0, whole(40), "inside", "other"),
    (1000, 40, whole(48), "inside", "other"),
    (850, 40, whole(48), "outside", "cylinder"),
    (700, 40, whole(48), "inside", "other"),
]


def belt(pulleys: list[Pulley], **changes: Any) -> Calculation:
    keys: dict[str, Any] = {
        "cylinder_radius": 105,
        "driven_radius": whole(48),
        "cylinder_velocity": 1,
        "shaft_speed": 150,
    }
    named = [dict(zip(("x", "y", "radius", "side", "role"), pulley, strict=True)) for pulley in pulleys]
    return train(toothed_belt=keys | {"pitch": 8, "pulleys": named} | changes)


def statuses(calc: Calculation) -> dict[str, str]:
    return {name: check(calc, name).status for name in LISTED_CHECKS}


def replaced(pulleys: list[Pulley], index: int, radius: float) -> list[Pulley]:
    x, y, _, side, role = pulleys[index]
    return [*pulleys[:index], (x, y, radius, side, role), *pulleys[index + 1 :]]


def test_a_layout_that_fits_the_drive_passes() -> None:
    calc = belt(OVER)
    assert set(statuses(calc).values()) == {"pass"}
    assert number(calc, "driving_pulley_pitch_radius") * 1e3 == pytest.approx(whole(79), rel=1e-12)


def test_the_belt_on_the_other_side_than_engagement_fails() -> None:
    slow = belt(UNDER, engagement="die", shaft_speed=75)
    assert check(slow, "belt_engagement").status == "pass"
    assert check(belt(UNDER), "belt_engagement").status == "fail"
    assert check(belt(OVER, engagement="die"), "belt_engagement").status == "fail"
    assert check(belt(UNDER), "belt_engagement").demand == pytest.approx(pi)


def test_mirrored_about_the_cylinder_the_engagement_angle_turns_round() -> None:
    leaning = [*OVER[:2], (1000, 190, 50, "outside", "other"), *OVER[3:]]
    below = belt(leaning, engagement="die")
    angle = check(belt(leaning), "belt_engagement").demand
    assert 0.01 < angle < pi / 2
    assert check(below, "belt_engagement").demand == pytest.approx(pi - angle, rel=1e-12)
    # the wrap's middle lies between the normals at which the two runs touch the pulley
    first, second = below["run_direction"][0, 2:4]
    across, up = np.sin(first) + np.sin(second), -np.cos(first) - np.cos(second)
    assert angle == pytest.approx(abs(np.arctan2(across, up)), rel=1e-9)


def test_a_belt_of_unmarked_pulleys_is_not_compared_with_the_cylinder() -> None:
    calc = belt([(*pulley[:4], "other") for pulley in OVER])
    assert checked(calc).isdisjoint({"belt_engagement", "cylinder_pulley_listed"})
    assert check(calc, "driving_pulley_listed").status == "pass"
    assert mechanism_results(calc, {}).status != "error"


def test_only_one_pulley_is_fixed_to_the_cylinder() -> None:
    with pytest.raises(Impossible, match="pulleys 2 and 4 both have role: cylinder") as refused:
        belt([OVER[0], (*OVER[1][:4], "cylinder"), *OVER[2:]])
    assert refused.value.key == "toothed_belt.pulleys"


@pytest.mark.parametrize(("index", "radius"), [(1, 100.0), (3, 60.0)])
def test_a_pulley_without_whole_teeth_is_told_and_the_advised_radius_has_them(index: int, radius: float) -> None:
    told = check(belt(replaced(OVER, index, radius)), "pulley_teeth_whole")
    teeth = 2 * pi * radius / 8
    assert told.status == "fail" and told.demand == pytest.approx(abs(teeth - round(teeth)), rel=1e-9)
    assert f"radius {radius:.0f} mm" in told.message and f"have {teeth:.4f} teeth" in told.message
    advised = re.search(r"give it a radius of (\d+\.\d+) mm", told.message)
    assert advised
    fixed = belt(replaced(OVER, index, float(advised[1])))
    assert check(fixed, "pulley_teeth_whole").status == "pass"


def test_a_smooth_pulley_on_the_back_needs_no_whole_teeth() -> None:
    for radius in (47.0, 50.0, 52.3):
        assert check(belt(replaced(OVER, 2, radius)), "pulley_teeth_whole").status == "pass"


def test_another_driving_pulley_in_the_list_is_told_and_the_advised_one_passes() -> None:
    told = check(belt(replaced(OVER, 0, whole(70))), "driving_pulley_listed")
    assert told.status == "fail" and told.demand == pytest.approx(9, rel=1e-9)
    advised = re.search(r"radius of (\d+\.\d+) mm, (\d+) teeth", told.message)
    assert advised and int(advised[2]) == 79
    assert check(belt(replaced(OVER, 0, float(advised[1]))), "driving_pulley_listed").status == "pass"


@pytest.mark.parametrize("driven", [60.0, 66.0])
def test_the_cylinder_s_pulley_in_the_list_is_the_driven_one(driven: float) -> None:
    told = check(belt(OVER, driven_radius=driven), "cylinder_pulley_listed")
    assert told.status == "fail" and told.demand == pytest.approx(abs(2 * pi * driven / 8 - 48), rel=1e-9)
    advised = re.search(r"give both (\d+\.\d+) mm", told.message)
    assert advised
    fixed = belt(replaced(OVER, 3, float(advised[1])), driven_radius=float(advised[1]))
    assert {check(fixed, n).status for n in ("cylinder_pulley_listed", "pulley_teeth_whole")} == {"pass"}


def test_a_loaded_pulley_outside_has_teeth_in_mesh_too() -> None:
    pressed = (850, whole(40) + whole(48) - 30, whole(48), "outside", "cylinder")
    calc = belt([*UNDER[:2], pressed], engagement="die", shaft_speed=75)
    assert check(calc, "teeth_in_mesh").limit == pytest.approx(calc["teeth_in_mesh"][0, 2], rel=1e-12)
    assert calc["teeth_in_mesh"][0, 2] < 6 < calc["teeth_in_mesh"][0, 0]


def test_the_driving_pulley_has_teeth_in_mesh_wherever_it_lies() -> None:
    """On the back of a belt with teeth on both sides it is wrapped least."""
    driving = (300, whole(126) + whole(40) - 6, whole(40), "outside", "other")
    calc = belt([driving, (0, 0, whole(126), "inside", "other"), (600, 0, whole(126), "inside", "other")])
    assert check(calc, "teeth_in_mesh").limit == pytest.approx(calc["teeth_in_mesh"][0, 0], rel=1e-12)
    assert check(calc, "teeth_in_mesh").status == "fail" and calc["teeth_in_mesh"][0, 0] < 1


def test_the_advised_pitch_puts_six_teeth_into_mesh() -> None:
    told = check(belt(OVER, pitch=20), "teeth_in_mesh")
    advised = re.search(r"toothed_belt.pitch to at most (\d+(?:\.\d+)?) mm", told.message)
    assert told.status == "fail" and advised
    assert check(belt(OVER, pitch=float(advised[1])), "teeth_in_mesh").status == "pass"


def test_the_figure_draws_the_cylinder_on_the_die_below() -> None:
    figures = {figure.id: figure.shapes for figure in mechanism_results(belt(OVER), {}).figures}
    shapes = figures["toothed_belt_layout"]
    ground = next(s for s in shapes if getattr(s, "role", "") == "ground")
    assert [y for _, y in ground.points] == pytest.approx([0.150 - 0.105] * 2)
    assert {"die", "cylinder, on pulley 4"} <= {getattr(s, "text", "") for s in shapes}


def test_the_example_wraps_its_pulley_on_the_side_away_from_the_die() -> None:
    block = yaml.safe_load(EXAMPLE.read_text(encoding="utf-8"))["mechanisms"]["train"]["toothed_belt"]
    values = {key: given["value"] if isinstance(given, dict) else given for key, given in block.items()}
    calc = train(toothed_belt=values | {"cylinder_radius": "105 mm"})
    assert block["engagement"] == "away"
    assert set(statuses(calc).values()) == {"pass"}
    assert number(calc, "teeth_in_mesh_min") >= 6
    assert calc["wraps"][0, 0] == pytest.approx(
        pi, abs=1e-9
    )  # level runs: the carriage's place does not change the length


def test_the_arrow_of_a_belt_stands_outside_its_longest_run() -> None:
    """Three like pulleys, counter-clockwise; the belt comes down from the third to the first, upright and longest."""
    shapes = layout([0, 0.3, 0], [0, 0.5, 1], [0.05] * 3, [1, 1, 1])
    start, end = next((shape["from"], shape["to"]) for shape in shapes if shape["shape"] == "arrow")
    assert (start[0], end[0]) == pytest.approx((-0.05 - 0.06,) * 2)
    assert (start[1], end[1]) == pytest.approx((0.6, 0.4))
