"""The command solve: closed forms of a lever, jumps, ranges, what is out of reach, and what is bad input."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.design.inputs import design_input
from diecut_report.design.machines import proved, varied
from diecut_report.press import Press
from tests.config.parts.machines import FILE
from tests.configs import DISCOVERY, EXAMPLE, GOOD, HEAD, saved

PARTS = FILE.with_stem("flat_cylinder_corrected")
KNIFE = EXAMPLE.with_name("circular_knife.yaml")
Capture = pytest.CaptureFixture[str]
TEXT = (
    HEAD
    + """\
  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 250 N*m}  # the lever
  b: {kind: lever, force: 1 kN, arm: 200 mm, teeth: 20}
"""
)


@pytest.fixture
def press(tmp_path: Path) -> Path:
    return saved(tmp_path, TEXT)


def solve(press: Path, vary: str, asked: str, *more: object) -> int:
    return main(["solve", str(press), "--vary", vary, "--for", asked, *map(str, more), "--plugins", str(GOOD)])


def found(capfd: Capture, code: int) -> dict[str, Any]:
    assert code in (0, 1)
    answer: dict[str, Any] = json.loads(capfd.readouterr().out)
    return answer


def test_a_linear_quantity_is_solved_exactly_and_told(press: Path, capfd: Capture) -> None:
    assert solve(press, "a.arm", "a.moment = 240 N*m") == 0
    assert capfd.readouterr().out.splitlines() == [
        "a.moment = 240 N·m, by a.arm (at present 100 mm, a.moment 200 N·m)",
        "  a.arm = 120 mm: a.moment is 240 N·m",
        "  recalculated as a single machine: no check fails; governing: a.moment",
    ]


def test_the_configuration_is_written_with_the_value_alone(press: Path, tmp_path: Path, capfd: Capture) -> None:
    assert solve(press, "mechanisms.a.arm", "a.moment = 0.3 kN*m", "-o", tmp_path / "new.yaml") == 0
    assert (tmp_path / "new.yaml").read_text() == TEXT.replace("100 mm", "150 mm")
    out, err = capfd.readouterr()
    assert "1 check fails: a.moment" in out and err == f"written: {tmp_path / 'new.yaml'}\n"


@pytest.mark.parametrize(
    ("vary", "asked", "more", "typed", "role"),
    [
        ("a.arm", "a.moment <= 150 N*m", (), "75 mm", "upper"),
        ("a.arm", "a.moment >= 260 N*m", (), "130 mm", "lower"),
        ("a.arm", "a.moment <= 210 N*m", (), "100 mm", "today"),
        ("a.arm", "max a.moment", (), "300 mm", "extreme"),
        ("a.arm", "min a.moment", (), "33.333 mm", "extreme"),
        ("a.arm", "max a.arm", (), "300 mm", "extreme"),
        ("a.arm", "a.checks.moment <= 0.5", (), "62.5 mm", "upper"),
        ("a.arm", "a.moment = 700 N*m", ("--to", "0.4 m"), "350 mm", "root"),
        ("b.teeth", "max b.teeth", ("--to", "33.0"), "33", "extreme"),  # whole numbers are all tried
        ("b.teeth", "b.teeth >= 25", (), "25", "lower"),
    ],
)
def test_limits_and_extremes_of_a_lever(
    press: Path, capfd: Capture, vary: str, asked: str, more: tuple[str, ...], typed: str, role: str
) -> None:
    answer = found(capfd, solve(press, vary, asked, *more, "--format", "json"))
    assert (answer["solutions"][0]["typed"], answer["solutions"][0]["role"]) == (typed, role)
    assert vary == "a.arm" or answer["vary"]["from"] == 12  # the least that is allowed


def test_the_greatest_with_which_all_passes(press: Path, capfd: Capture) -> None:
    answer = found(capfd, solve(press, "a.arm", "max a.arm", "--passing", "--format", "json"))
    first = answer["solutions"][0]
    assert (first["typed"], first["beyond"]) == ("125 mm", ["a.moment"]) and answer["machine"]["failing"] == []


def test_out_of_reach_tells_the_nearest(press: Path, capfd: Capture, tmp_path: Path) -> None:
    assert solve(press, "a.arm", "a.moment = 700 N*m", "-o", tmp_path / "new.yaml") == 1
    out, err = capfd.readouterr()
    assert "no value of a.arm from 33.3333 mm to 300 mm satisfies it" in out
    assert "nearest: a.arm = 300 mm, where a.moment is 600 N·m, at the end of the search range" in out
    assert err == f"not written: {tmp_path / 'new.yaml'}\n" and not (tmp_path / "new.yaml").exists()


@pytest.mark.parametrize(
    ("asked", "first", "last"),
    [("knife.reach_greatest <= 42 mm", 99.269, 99.616), ("knife.cut_angle >= 23.69 deg", 99.269, 99.347)],
)
def test_values_close_to_the_end_of_what_can_be_built_are_found(
    asked: str, first: float, last: float, capfd: Capture
) -> None:
    assert main(["solve", str(KNIFE), "--vary", "knife.edge_radius", "--for", asked, "--format", "json"]) == 0
    (found,) = json.loads(capfd.readouterr().out)["ranges"]
    assert [1e3 * each["value"] for each in found] == pytest.approx([first, last], abs=1e-3)


@pytest.mark.nightly
def test_where_only_the_present_value_can_be_nothing_is_said_of_others(capfd: Capture) -> None:
    asked = "meshes_main_drive.pitting_safety_1 >= 2"
    assert main(["solve", str(PARTS), "--vary", "meshes.main_drive.module", "--for", asked]) == 1
    told = capfd.readouterr().out
    assert "does not vary" not in told and "nearest: meshes.main_drive.module = 5 mm" in told


BENDING = """\
schema_version: 1
project: {title: Test}
press: {name: P, productivity: 6000 1/h, sheet: {length: 700 mm, width: 470.7 mm, thickness: 0.6 mm}}
mechanisms:
  cylinder:
    {kind: cylinder_sizing, working_length: 470.7 mm, segment_height: 40 mm, generatrix_length: 700 mm, bore_radius: 70 mm, radius: 105 mm,
     density: 7800 kg/m**3, bearing_span: 860 mm, elastic_modulus: 210 GPa, line_load: 25 N/mm, allowable_deflection: 0.05 mm}
"""


@pytest.mark.parametrize("vary", ["bore_radius", "radius", "elastic_modulus", "bearing_span"])
def test_a_value_at_the_limit_of_a_check_lies_on_its_side(vary: str, tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, BENDING)
    asked = ["--vary", f"cylinder.{vary}", "--for", "cylinder.deflection = 50 um", "--format", "json", "--quiet"]
    assert main(["solve", str(file), *asked]) == 0, capfd.readouterr().err
    found = json.loads(capfd.readouterr().out)
    assert found["solutions"][0]["reached"] == pytest.approx(50e-6, rel=1e-5)
    assert "cylinder.deflection" not in found["machine"]["failing"]


def test_an_input_that_is_not_given_is_put_into_the_file(press: Path, tmp_path: Path) -> None:
    made = tmp_path / "new.yaml"
    assert solve(press, "a.width", "a.pressure = 0.5 MPa", "--from", "10 mm", "--to", "90 mm", "-o", made) == 0
    assert made.read_text() == TEXT.replace("kind: lever, force: 2 kN", "kind: lever, width: 40 mm, force: 2 kN")


def test_a_knife_is_solved_as_by_machines_calculated_one_by_one(capfd: Capture) -> None:
    press = Press.read(KNIFE, DISCOVERY)
    radius = design_input(press.config, "knife.edge_radius")

    def over(value: float) -> float:
        return proved(press.with_values({radius.stands: radius.typed(value, 15)})).outputs["knife.edge_length"] - 0.04

    answer = found(capfd, solve(KNIFE, "knife.edge_radius", "knife.edge_length = 40 mm", "--format", "json"))
    places = [each["value"] for each in answer["solutions"]]
    assert places == pytest.approx([brentq(over, place * 0.99, place * 1.01, xtol=1e-9) for place in places], rel=1e-6)
    assert places


@pytest.mark.parametrize(("asked", "first"), [("<= 60 ms", 0.11198), ("= 52 ms", 0.114002)])
def test_one_machine_alone_among_those_tried_is_no_constant(
    tmp_path: Path, capfd: Capture, asked: str, first: float
) -> None:
    knife = saved(
        tmp_path, KNIFE.read_text("utf-8").replace("eccentricity: {value: 20 mm", "eccentricity: {value: 10 mm")
    )
    answer = found(capfd, solve(knife, "knife.edge_radius", f"knife.cut_time {asked}", "--format", "json"))
    assert answer["solutions"][0]["value"] == pytest.approx(first, rel=1e-5)


@pytest.mark.parametrize(
    "command", [["solve", "--vary", "knife.speed", "--for", "knife.cut_time = 1 s"], ["influence"]]
)
def test_what_no_machine_can_be_is_told_with_its_line(tmp_path: Path, capfd: Capture, command: list[str]) -> None:
    text = KNIFE.read_text("utf-8").replace("eccentricity: {value: 20 mm", "eccentricity: {value: 1 mm")
    line = 1 + next(n for n, each in enumerate(text.splitlines()) if "depth:" in each)
    assert main([command[0], str(saved(tmp_path, text)), *command[1:]]) == 2
    told = capfd.readouterr().err
    assert re.search(rf":{line}:\d+: .*mechanisms\.knife\.depth\.value: is 112 mm, but the edge never", told)


DAMPER = (
    HEAD
    + """\
  damper: {kind: damper, mass: 104 kg, inertia: 0.74 kg*m**2, rolling_radius: 105.5 mm, velocity: 0.6 m/s, shore_hardness: 70,
           dynamic_stiffness_factor: 1.5, ring_width: 60 mm, pad_height: 60 mm, loss_tangent: 0.15}
"""
)


def test_the_end_of_a_step_is_typed_so_that_it_answers(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, DAMPER)  # the length is rounded up to steps, between which it jumps
    answer = found(capfd, solve(press, "damper.shore_hardness", "damper.adopted_length = 60 mm", "--format", "json"))
    assert [each["reached"] for each in answer["solutions"]] == [0.06] * len(answer["solutions"])
    longer = f"{answer['solutions'][0]['value'] + 1e-6} "
    beyond = proved(Press.read(press, DISCOVERY).with_values({("mechanisms", "damper", "shore_hardness"): longer}))
    assert beyond.outputs["damper.adopted_length"] > 0.06
    assert solve(press, "damper.shore_hardness", "damper.adopted_length = 75 mm") == 0
    assert "is already satisfied: damper.adopted_length is 75 mm" in capfd.readouterr().out


def test_what_does_not_hold_between_two_machines_of_the_search_is_no_range(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, DAMPER)
    more = ("--from", "60 kg", "--to", "2000 kg", "--format", "json")
    answer = found(capfd, solve(press, "damper.mass", "damper.peak_force <= 3500 N", *more))
    config = load_config(press, DISCOVERY)
    mass = design_input(config, "damper.mass").asked
    for low, high in answer["ranges"]:
        x = np.linspace(low["value"], high["value"], 200)
        assert (varied(config, {mass: x}, 200).values("damper.peak_force") <= 3500 * (1 + 1e-9)).all()


def test_a_text_names_the_nearest_of_many_values(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, DAMPER)
    assert solve(press, "damper.shore_hardness", "damper.peak_force = 3562 N", "--from", "40") == 0
    out = capfd.readouterr().out.splitlines()
    assert len([line for line in out if line.startswith("  also")]) <= 12


def test_whole_numbers_with_which_it_holds_are_told_from_first_to_last(press: Path, capfd: Capture) -> None:
    assert solve(press, "b.teeth", "b.teeth <= 30") == 0
    assert "  satisfied from 12 (end of the search range) to 30" in capfd.readouterr().out.splitlines()


BEARING = (
    HEAD
    + """\
  bearing: {kind: rolling_bearing, required_life: 20000 h, reliability: 95 %, bearings: [{name: a, type: deep_groove,
            dynamic_rating: 35.1 kN, static_rating: 21.6 kN, radial_force: 3 kN, speed: 100 rpm}]}
"""
)


def test_the_numbers_of_a_list_are_all_tried_and_no_others(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, BEARING)
    asked = ("bearing.reliability", "bearing.reliability_factor <= 0.5")  # 0.47 at 97 %, by ISO 281 table 12
    assert solve(press, *asked) == 0
    out = capfd.readouterr().out
    assert "(at present 95 %, bearing.reliability_factor 0.64)" in out and "bearing.reliability = 97 %: " in out
    assert "satisfied from 97 % to 99 % (end of the search range)" in out
    assert solve(press, "bearing.reliability", "bearing.reliability_factor = 0.6") == 1
    assert "nearest: bearing.reliability = 95 %" in capfd.readouterr().out


CYLINDER = (
    HEAD
    + """\
  cylinder: {kind: cylinder_sizing, working_length: 470.7 mm, generatrix_length: 700 mm, segment_height: 40 mm, bore_radius: 58 mm}
"""
)


def test_the_greatest_lies_beyond_what_fails_where_sizes_are_rounded(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, CYLINDER)  # the radius is rounded up by steps, with which it passes again
    asked = ("cylinder.segment_height", "max cylinder.segment_height", "--passing", "--format", "json")
    answer = found(capfd, solve(press, *asked))
    config, x = load_config(press, DISCOVERY), np.linspace(40e-3, 46e-3, 601)
    made = varied(config, {design_input(config, "cylinder.segment_height").asked: x}, len(x))
    best = x[np.isin(made.status.astype(str), ["pass", "warn"])].max()
    assert answer["solutions"][0]["value"] >= best - 1e-5


def test_what_is_told_in_ukrainian_has_decimal_commas_and_what_is_typed_points(tmp_path: Path, capfd: Capture) -> None:
    press = saved(tmp_path, TEXT)
    assert solve(press, "a.arm", "a.moment = 240.5 N*m", "--language", "uk") == 0
    out = capfd.readouterr().out
    assert "a.moment = 240.5 N·m" in out and "a.arm = 120.25 mm: a.moment дорівнює 240,5 N·m" in out


@pytest.mark.parametrize(
    ("question", "typed", "others"),
    [
        ("a.moment >= 230 N*m", "120 mm", ["120 mm", "150 mm"]),
        ("a.moment = 300 N*m", "150 mm", ["150 mm"]),
        ("min a.moment", "90 mm", ["90 mm"]),
        ("a.moment >= 400 N*m", "", ["150 mm"]),  # the nearest
    ],
)
def test_one_size_of_a_series_is_found(
    press: Path, capfd: Capture, question: str, typed: str, others: list[str]
) -> None:
    code = solve(press, "a.arm", question, "--among", "150 mm; 90 mm", "--among", "120 mm", "--format", "json")
    answer = found(capfd, code)
    solutions = [each["typed"] for each in answer["solutions"]]
    ends = [end["typed"] for each in answer["ranges"] for end in each]
    assert solutions[:1] == [typed][: bool(typed)] and (ends or solutions or [answer["nearest"]["typed"]]) == others
    assert answer["vary"]["among"] == ["150 mm", "90 mm", "120 mm"]


def test_of_sizes_that_no_machine_can_have_it_is_said_why(capfd: Capture) -> None:
    knife = Path("configs/circular_knife.yaml")
    asked = ("knife.eccentricity", "knife.force_max <= 5 kN", "--among", "20 mm; 60 mm")
    refused = found(capfd, solve(knife, *asked, "--format", "json"))["vary"]["refused"]
    assert refused.keys() == {"60 mm"} and "front_distance" in refused["60 mm"]
    solve(knife, *asked)
    assert "knife.eccentricity = 60 mm cannot be: mechanisms.knife.front_distance" in capfd.readouterr().out


def test_where_no_size_of_a_series_will_do_it_is_said(press: Path, capfd: Capture) -> None:
    assert solve(press, "a.arm", "a.moment >= 400 N*m", "--among", "90 mm;120 mm") == 1
    lines = capfd.readouterr().out.splitlines()
    assert lines[1:] == [
        "  none of these satisfies it: a.arm = 90 mm or 120 mm",
        "  nearest: a.arm = 120 mm, where a.moment is 240 N·m",
    ]


@pytest.mark.parametrize(("limit", "nearest"), [("10 deg", "104.6"), ("-20 deg", "")])
def test_the_nearest_value_is_that_on_the_way_to_the_limit_beyond_zero(
    capfd: Capture, limit: str, nearest: str
) -> None:
    """Of a margin below zero the greater one is nearer to a limit above zero."""
    question = f"timing.best_margin >= {limit}"
    code = main(["solve", str(EXAMPLE), "--vary", "cylinder.segment_height", "--for", question, "--format", "json"])
    answer = found(capfd, code)
    assert bool(answer["solutions"]) is not bool(nearest)
    assert nearest == "" or answer["nearest"]["typed"].startswith(nearest)


@pytest.mark.nightly
def test_a_size_and_a_bearing_of_a_shaft_are_solved_for_where_they_are_typed(tmp_path: Path, capfd: Capture) -> None:
    """All that is made of the parts follows: a thicker shaft is heavier for the chain that drives it, and a bearing must fit its seat."""
    series = "65 mm; 60 mm; 70 mm; 75 mm; 80 mm"
    asked = ("shafts.far.sections.1.diameter", "shafts_far.checks.deflection <= 0.1", "--among", series)
    assert solve(PARTS, *asked, "-o", tmp_path / "far.yaml") == 0
    assert "shafts.far.sections.1.diameter = 75 mm: " in (told := capfd.readouterr().out)
    assert "satisfied from 75 mm to 80 mm" in told and "chains_grippers.bearing_pressure" in told
    assert (tmp_path / "far.yaml").read_text("utf-8") == PARTS.read_text("utf-8").replace("65x640", "75x640")
    asked = (
        "shafts.far.parts.a.designation",
        "shafts_far_bearings.checks.a_life <= 0.2",
        "--among",
        "6011; 6211; 6311; 6212",
    )
    answer = found(capfd, solve(PARTS, *asked, "--format", "json"))
    assert [each["typed"] for each in answer["solutions"]] == ["6211", "6011"] and answer["vary"]["today"] == "6211"
    assert list(answer["vary"]["refused"]) == ["6311", "6212"] and "bore of 60 mm" in answer["vary"]["refused"]["6212"]
