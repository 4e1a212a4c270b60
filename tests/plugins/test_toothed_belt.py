"""The toothed belt as a chapter of a machine of its own: numbers of the method, statics of motion, layouts that cannot be."""

from __future__ import annotations

from math import degrees, pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.api import Annotated, Inputs, Mechanism, Source, Text
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.drive_train.figures import TOOTHED_BELT_FIGURES
from diecut_report.plugins.drive_train.toothed_belt import (
    TOOTHED_BELT,
    TOOTHED_BELT_ASSUMPTIONS,
    TOOTHED_BELT_CHECKS,
    TOOTHED_BELT_ERRATA,
    ToothedBelt,
)
from diecut_report.results.mechanism import mechanism_results
from tests.examples import examples
from tests.machines import inputs, number


class BeltDrive(Inputs):
    toothed_belt: Annotated[ToothedBelt | None, Text("Toothed belt")] = None


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


def test_the_declaration_keeps_the_plugin_contract() -> None:
    check_mechanism(MECHANISM)


# --- speed -----------------------------------------------------------------------------------------------------------


def test_the_driving_pulley_of_the_method() -> None:
    calc = belt()
    assert number(calc, "belt_speed") == pytest.approx(11 / 7, rel=1e-12)
    assert number(calc, "driving_pulley_radius") == pytest.approx(0.1000402, abs=5e-8)


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


def test_the_layout_of_the_method() -> None:
    calc = belt(IDLER)
    assert number(calc, "toothed_belt_length") == pytest.approx(1.850262, abs=5e-7)
    assert [degrees(a) for a in calc["wraps"][0]] == pytest.approx([196.0044, 196.0044, 32.0087], abs=5e-5)
    assert number(calc, "toothed_belt_teeth") == 231
    assert number(calc, "toothed_belt_take_up") == pytest.approx(231 * 0.008 - 1.850262, abs=5e-7)


def test_two_pulleys_are_an_open_belt() -> None:
    calc = belt([(0, 0, 100, "inside"), (500, 0, 200, "inside")])
    assert number(calc, "toothed_belt_length") == pytest.approx(1.962545, abs=5e-7)
    assert [degrees(a) for a in calc["wraps"][0]] == pytest.approx([156.926, 203.074], abs=5e-4)
    runs = np.sqrt(0.5**2 - 0.1**2)
    assert calc["straight_runs"][0] == pytest.approx([runs, runs], rel=1e-12)


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


def test_the_outputs_of_the_method_are_there() -> None:
    outputs = mechanism_results(belt(IDLER), {}).outputs
    names = {"belt_speed", "driving_pulley_radius", "driving_pulley_teeth", "toothed_belt_length", "toothed_belt_teeth"}
    assert set(outputs) >= names | {
        f"{row}.{i}" for row in ("wraps", "straight_runs", "teeth_in_mesh") for i in range(3)
    }


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
