"""The toothed belt: numbers of the method, layouts that cannot be, and the pulleys in its list against the drive."""

from __future__ import annotations

import re
from math import pi
from typing import Any

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.api import Inputs, Mechanism, Source, block
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.drive_train.figures import TOOTHED_BELT_FIGURES, layout
from diecut_report.plugins.drive_train.toothed_belt import (
    TOOTHED_BELT,
    TOOTHED_BELT_ASSUMPTIONS,
    TOOTHED_BELT_CHECKS,
    TOOTHED_BELT_ERRATA,
    ToothedBelt,
)
from diecut_report.results.mechanism import mechanism_results
from tests.configs import EXAMPLES
from tests.examples import examples
from tests.machines import inputs, number
from tests.plugins.drive_trains import check, checked, train


class BeltDrive(Inputs):
    toothed_belt = block(ToothedBelt, "Toothed belt", optional=True)


MECHANISM = Mechanism(
    kind="belt_drive",
    version="1.0",
    title="Toothed belt",
    summary="The toothed belt alone.",
    inputs=BeltDrive,
    chapters=TOOTHED_BELT,
    checks=TOOTHED_BELT_CHECKS,
    figures=TOOTHED_BELT_FIGURES,
    assumptions=TOOTHED_BELT_ASSUMPTIONS,
    sources=(Source("002", "Flat-cylinder die-cutting press."),),
    errata=TOOTHED_BELT_ERRATA,
)

SHEET: dict[str, Any] = {
    "cylinder_radius": "105 mm",
    "driven_radius": "60 mm",
    "cylinder_velocity": "1 m/s",
    "shaft_speed": "150 rpm",
    "pitch": "8 mm",
}
Pulleys = list[tuple[float, float, float, str]]
IDLER: Pulleys = [(0, 0, 100, "inside"), (600, 0, 100, "inside"), (300, 70, 50, "outside")]


def listed(pulleys: Pulleys) -> list[dict[str, Any]]:
    return [dict(zip(("x", "y", "radius", "side"), pulley, strict=True)) for pulley in pulleys]


def belt(pulleys: Pulleys | None = None, **changes: Any) -> Calculation:
    keys = SHEET | changes | ({} if pulleys is None else {"pulleys": listed(pulleys)})
    return calculate(MECHANISM, inputs(MECHANISM, {"toothed_belt": keys}))


def refused(pulleys: Pulleys | None = None, **changes: Any) -> Impossible:
    with pytest.raises(Impossible) as caught:
        belt(pulleys, **changes)
    return caught.value


# --- speed -----------------------------------------------------------------------------------------------------------


@given(
    radius=st.floats(30, 300),
    share=st.floats(0.1, 0.95),
    velocity=st.floats(0.05, 5),
    rpm=st.floats(20, 600),
    side=st.sampled_from(["away", "die"]),
)
@examples(60)
def test_the_pulley_pays_out_what_the_rolling_cylinder_takes_up(
    radius: float, share: float, velocity: float, rpm: float, side: str
) -> None:
    keys = {"cylinder_radius": radius, "driven_radius": share * radius, "cylinder_velocity": velocity}
    calc = belt(**keys, shaft_speed=rpm, pitch=0.01, engagement=side)
    turn = 2 * pi * radius / 1e3  # the carriage's way while the cylinder rolls once
    wound = 2 * pi * share * radius / 1e3  # and what its pulley lays on the belt meanwhile
    taken = turn + wound if side == "away" else turn - wound
    paid_out = 2 * pi * number(calc, "driving_pulley_radius") * (rpm / 60) * (turn / velocity)
    assert paid_out == pytest.approx(taken, rel=1e-12)


def test_whole_teeth_change_the_speed_by_the_error_that_is_told() -> None:
    calc = belt(pitch="20 mm")
    teeth = number(calc, "driving_pulley_teeth")
    assert teeth == 31  # 2π·100.04 mm / 20 mm = 31.43
    speed = teeth * 0.020 * 150 / 60
    assert number(calc, "driving_pulley_speed_error") == pytest.approx(speed / (11 / 7) - 1, rel=1e-12)


def test_a_driven_pulley_as_large_as_the_cylinder_cannot_engage_on_the_die_s_side() -> None:
    told = refused(engagement="die", driven_radius="105 mm")
    assert told.key == "toothed_belt.driven_radius"
    assert "0 m/s" in told.message and "smaller than the cylinder" in told.message


def test_a_pitch_beyond_the_pulley_is_refused() -> None:
    told = refused(pitch="2 m")
    assert told.key == "toothed_belt.pitch"
    assert "100.040 mm" in told.message


# --- path ------------------------------------------------------------------------------------------------------------


def test_the_take_up_is_what_whole_teeth_leave() -> None:
    calc = belt(IDLER)
    assert number(calc, "toothed_belt_teeth") == 231
    assert number(calc, "toothed_belt_take_up") == pytest.approx(231 * 0.008 - 1.850262, abs=5e-7)


def test_teeth_in_mesh_count_on_inside_pulleys_only() -> None:
    calc = belt(IDLER, pitch="25 mm")
    mesh = calc["teeth_in_mesh"][0]
    assert mesh == pytest.approx([100 * np.radians(196.0044) / 25] * 2 + [50 * np.radians(32.0087) / 25], rel=1e-6)
    assert number(calc, "teeth_in_mesh_min") == pytest.approx(mesh[0], rel=1e-12)


@pytest.mark.parametrize("pitch, status", [("57 mm", "pass"), ("58 mm", "fail")])
def test_fewer_than_six_teeth_in_mesh_fail(pitch: str, status: str) -> None:
    check = mechanism_results(belt(IDLER, pitch=pitch), {}).checks[0]  # 342.1 mm of belt on each inside pulley
    assert (check.id, check.status) == ("teeth_in_mesh", status)
    assert check.utilisation == pytest.approx(6 * float(pitch[:2]) / (100 * np.radians(196.0044)), rel=1e-6)


def test_without_pulleys_there_is_a_driving_pulley_and_no_length() -> None:
    results = mechanism_results(belt(), {})
    assert "driving_pulley_teeth" in results.outputs and "toothed_belt_length" not in results.outputs
    assert results.checks == []
    assert [figure.id for figure in results.figures] == ["toothed_belt_rolling"]
    assert {told.title for told in results.absent} == {section.title for section in TOOTHED_BELT[1:]}


def test_the_drawn_belt_is_a_closed_line_of_the_belt_s_length() -> None:
    calc = belt(IDLER)
    figures = {figure.id: figure.shapes for figure in mechanism_results(calc, {}).figures}
    lines = [s for s in figures["toothed_belt_layout"] if getattr(s, "role", "") == "link"]
    runs = [np.array(s.points) for s in lines if s.shape == "polyline"]
    arcs = [s for s in lines if s.shape == "arc"]
    drawn = sum(float(np.hypot(*(b - a))) for a, b in runs) + sum(s.radius * (s.end - s.start) for s in arcs)
    assert drawn == pytest.approx(number(calc, "toothed_belt_length"), rel=1e-12)
    rims = [np.add(s.center, s.radius * np.array([np.cos(a), np.sin(a)])) for s in arcs for a in (s.start, s.end)]
    ends = np.concatenate(runs)
    for rim in rims:
        assert np.min(np.hypot(*(ends - rim).T)) < 1e-12


def test_the_pulleys_are_drawn_with_their_numbers_and_wraps() -> None:
    figures = {figure.id: figure.shapes for figure in mechanism_results(belt(IDLER), {}).figures}
    labels = [shape.text for shape in figures["toothed_belt_layout"] if shape.shape == "point"]
    assert labels == ["1: 196.0°, driving", "2: 196.0°", "3: 32.01°"]


# --- layouts that cannot be ------------------------------------------------------------------------------------------

CORNERS: Pulleys = [(0, 0, 50, "inside"), (400, 0, 50, "inside"), (400, 400, 50, "inside"), (0, 400, 50, "inside")]
HOOK: Pulleys = [  # the belt bends back over pulley 6, in which its own run from pulley 4 to pulley 5 stands
    (0, 0, 40, "inside"), (600, 0, 40, "inside"), (600, 440, 40, "inside"), (510, 440, 30, "inside"),
    (200, 250, 50, "outside"), (380, 400, 50, "outside"), (620, 620, 40, "inside"), (0, 620, 40, "inside"),
]  # fmt: skip
IMPOSSIBLE: dict[str, tuple[Pulleys, str, list[str]]] = {
    "one pulley": ([(0, 0, 100, "inside")], "", ["one pulley", "at least two"]),
    "one within the other": (
        [(0, 0, 100, "inside"), (30, 0, 60, "inside"), (600, 0, 50, "inside")],
        ".0",
        ["pulleys 1 and 2", "no common tangent", "30 mm apart"],
    ),
    "no tangent behind the last": (
        [(0, 0, 100, "inside"), (600, 0, 100, "inside"), (100, 70, 50, "outside")],
        ".2",
        ["pulleys 3 and 1", "no common tangent", "touch or overlap"],
    ),
    "overlap of pulleys that are no neighbours": (
        [*CORNERS[:2], (60, 60, 50, "inside"), CORNERS[3]],
        ".0",
        ["pulleys 1 and 3 overlap"],
    ),
    "overlap of neighbours": (
        [(0, 0, 100, "inside"), (150, 0, 100, "inside")],
        ".0",
        ["pulleys 1 and 2 overlap"],
    ),
    "idler that does not touch": (
        [*IDLER[:2], (300, 155, 50, "outside")],
        ".2",
        ["do not sum to 360°", "to 0 turns", "around pulley 3, which it does not touch"],
    ),
    "inside pulley that does not touch": (
        [CORNERS[0], CORNERS[1], (300, 150, 20, "inside"), CORNERS[2], CORNERS[3]],
        ".2",
        ["do not sum to 360°", "to 2 turns", "around pulley 3, which it does not touch"],
    ),
    "wrong order": (
        [CORNERS[0], CORNERS[2], CORNERS[1], CORNERS[3]],
        ".1",
        ["do not sum to 360°", "in the order in which the belt meets them"],
    ),
    "clockwise": (CORNERS[::-1], "", ["pulleys 1 to 4", "clockwise", "reverse"]),
    "runs that cross": (
        [*IDLER[:2], (300, -220, 50, "outside")],
        ".0",
        ["straight runs behind pulleys 1 and 2 cross"],
    ),
    "clockwise with an idler": ([IDLER[2], *IDLER[1::-1]], "", ["pulleys 1 to 3", "clockwise", "reverse"]),
    "a run through a pulley": (HOOK, ".5", ["straight run behind pulley 4 passes through pulley 6"]),
}


@pytest.mark.parametrize("case", IMPOSSIBLE)
def test_an_impossible_layout_names_its_pulleys(case: str) -> None:
    pulleys, place, words = IMPOSSIBLE[case]
    told = refused(pulleys)
    assert told.key == f"toothed_belt.pulleys{place}"
    for part in words:
        assert part in told.message
    assert len(told.reasons) == 1


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


def listed_belt(pulleys: list[Pulley], **changes: Any) -> Calculation:
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
    calc = listed_belt(OVER)
    assert set(statuses(calc).values()) == {"pass"}
    assert number(calc, "driving_pulley_pitch_radius") * 1e3 == pytest.approx(whole(79), rel=1e-12)


def test_the_belt_on_the_other_side_than_engagement_fails() -> None:
    slow = listed_belt(UNDER, engagement="die", shaft_speed=75)
    assert check(slow, "belt_engagement").status == "pass"
    assert check(listed_belt(UNDER), "belt_engagement").status == "fail"
    assert check(listed_belt(OVER, engagement="die"), "belt_engagement").status == "fail"
    assert check(listed_belt(UNDER), "belt_engagement").demand == pytest.approx(pi)


def test_mirrored_about_the_cylinder_the_engagement_angle_turns_round() -> None:
    leaning = [*OVER[:2], (1000, 190, 50, "outside", "other"), *OVER[3:]]
    below = listed_belt(leaning, engagement="die")
    angle = check(listed_belt(leaning), "belt_engagement").demand
    assert 0.01 < angle < pi / 2
    assert check(below, "belt_engagement").demand == pytest.approx(pi - angle, rel=1e-12)
    # the wrap's middle lies between the normals at which the two runs touch the pulley
    first, second = below["run_direction"][0, 2:4]
    across, up = np.sin(first) + np.sin(second), -np.cos(first) - np.cos(second)
    assert angle == pytest.approx(abs(np.arctan2(across, up)), rel=1e-9)


def test_a_belt_of_unmarked_pulleys_is_not_compared_with_the_cylinder() -> None:
    calc = listed_belt([(*pulley[:4], "other") for pulley in OVER])
    assert checked(calc).isdisjoint({"belt_engagement", "cylinder_pulley_listed"})
    assert check(calc, "driving_pulley_listed").status == "pass"
    assert mechanism_results(calc, {}).status != "error"


def test_only_one_pulley_is_fixed_to_the_cylinder() -> None:
    with pytest.raises(Impossible, match="pulleys 2 and 4 both have role: cylinder") as refused:
        listed_belt([OVER[0], (*OVER[1][:4], "cylinder"), *OVER[2:]])
    assert refused.value.key == "toothed_belt.pulleys"


@pytest.mark.parametrize(("index", "radius"), [(1, 100.0), (3, 60.0)])
def test_a_pulley_without_whole_teeth_is_told_and_the_advised_radius_has_them(index: int, radius: float) -> None:
    told = check(listed_belt(replaced(OVER, index, radius)), "pulley_teeth_whole")
    teeth = 2 * pi * radius / 8
    assert told.status == "fail" and told.demand == pytest.approx(abs(teeth - round(teeth)), rel=1e-9)
    assert f"radius {radius:.0f} mm" in told.message and f"have {teeth:.4f} teeth" in told.message
    advised = re.search(r"give it a radius of (\d+\.\d+) mm", told.message)
    assert advised
    fixed = listed_belt(replaced(OVER, index, float(advised[1])))
    assert check(fixed, "pulley_teeth_whole").status == "pass"


def test_a_smooth_pulley_on_the_back_needs_no_whole_teeth() -> None:
    for radius in (47.0, 50.0, 52.3):
        assert check(listed_belt(replaced(OVER, 2, radius)), "pulley_teeth_whole").status == "pass"


def test_another_driving_pulley_in_the_list_is_told_and_the_advised_one_passes() -> None:
    told = check(listed_belt(replaced(OVER, 0, whole(70))), "driving_pulley_listed")
    assert told.status == "fail" and told.demand == pytest.approx(9, rel=1e-9)
    advised = re.search(r"radius of (\d+\.\d+) mm, (\d+) teeth", told.message)
    assert advised and int(advised[2]) == 79
    assert check(listed_belt(replaced(OVER, 0, float(advised[1]))), "driving_pulley_listed").status == "pass"


@pytest.mark.parametrize("driven", [60.0, 66.0])
def test_the_cylinder_s_pulley_in_the_list_is_the_driven_one(driven: float) -> None:
    told = check(listed_belt(OVER, driven_radius=driven), "cylinder_pulley_listed")
    assert told.status == "fail" and told.demand == pytest.approx(abs(2 * pi * driven / 8 - 48), rel=1e-9)
    advised = re.search(r"give both (\d+\.\d+) mm", told.message)
    assert advised
    fixed = listed_belt(replaced(OVER, 3, float(advised[1])), driven_radius=float(advised[1]))
    assert {check(fixed, n).status for n in ("cylinder_pulley_listed", "pulley_teeth_whole")} == {"pass"}


def test_a_loaded_pulley_outside_has_teeth_in_mesh_too() -> None:
    pressed = (850, whole(40) + whole(48) - 30, whole(48), "outside", "cylinder")
    calc = listed_belt([*UNDER[:2], pressed], engagement="die", shaft_speed=75)
    assert check(calc, "teeth_in_mesh").limit == pytest.approx(calc["teeth_in_mesh"][0, 2], rel=1e-12)
    assert calc["teeth_in_mesh"][0, 2] < 6 < calc["teeth_in_mesh"][0, 0]


def test_the_driving_pulley_has_teeth_in_mesh_wherever_it_lies() -> None:
    """On the back of a belt with teeth on both sides it is wrapped least."""
    driving = (300, whole(126) + whole(40) - 6, whole(40), "outside", "other")
    calc = listed_belt([driving, (0, 0, whole(126), "inside", "other"), (600, 0, whole(126), "inside", "other")])
    assert check(calc, "teeth_in_mesh").limit == pytest.approx(calc["teeth_in_mesh"][0, 0], rel=1e-12)
    assert check(calc, "teeth_in_mesh").status == "fail" and calc["teeth_in_mesh"][0, 0] < 1


def test_the_figure_draws_the_cylinder_on_the_die_below() -> None:
    figures = {figure.id: figure.shapes for figure in mechanism_results(listed_belt(OVER), {}).figures}
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
