"""Single wrong values in the published press: each is refused with its place, or fails or warns, and none is passed over."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from diecut_report.config.loader import Config, load_config
from diecut_report.errors import UserError
from tests.configs import DISCOVERY, EXAMPLE, WARM, saved

BLUNDERS = [  # what is typed in place of what, and words of the refusal
    ("a crank pin of 45 mm in a bearing of bore 40", ("40 mm, basis: assumed, note: bore", "45 mm, basis: assumed, note: bore"),
     "names a bearing with the bore 40 mm, but its seat on the shaft crank_pin is 45 mm thick"),
    ("a pin of 45 mm in a bearing of another name that names it",
     ("- name: rocker_pin", "- name: rocker_end\n        on: crankshaft"), "names a bearing with the bore 40 mm"),
    ("a bearing on what is no shaft", ("- name: rocker_pin", "- name: rocker_pin\n        on: rocker_pn"), "did you mean 'rocker_pin'"),
    ("a bearing 6210 on a seat of 45 mm", ('designation: "6209"', 'designation: "6210"'), "names a bearing with the bore 50 mm"),
    ("gears of module 4 beside a shaft that keeps pitch radius 120", ("module: {value: 5 mm", "module: {value: 4 mm"),
     "is 120 mm, but the pair main_gears, which takes the same torque, has the pitch radius 96 mm there"),
    ("σ_Hlim ten times", ("sigma_h_lim_1: {value: 767 MPa", "sigma_h_lim_1: {value: 7670 MPa"), "gives sigma_h_lim_1 = 7670 MPa, which no machine"),
    ("a moving mass of 0.96 kg", ("moving_mass: {value: 9.6 kg", "moving_mass: {value: 0.96 kg"), "gives moving_mass / (press.sheet.length"),
    ("an efficiency of 0.097", ("path_efficiency: {value: 0.97", "path_efficiency: {value: 0.097"), "gives lines.0.path_efficiency = 0.097"),
    ("35 kW per belt", ("power_per_belt: {value: 3.5 kW", "power_per_belt: {value: 35 kW"), "gives power_per_belt / (motor_speed"),
    ("a dynamic rating ten times", ("rating: {value: 35.1 kN", "rating: {value: 351 kN"), "is 11.15 times that of the table"),
    ("a yield strength of a tenth", ("strength: {value: 650 MPa", "strength: {value: 65 MPa"), "gives yield_strength / tensile_strength = 0.07222"),
    ("a keyseat at 13 mm", ("{value: 130 mm, basis: assumed}, type", "{value: 13 mm, basis: assumed}, type"),
     "puts a torque into the shaft at 130 mm, but the nearest keyseat or press fit is at 13 mm"),
    ("a gear of 120 kg", ("mass: {value: 12 kg", "mass: {value: 120 kg"), "gives loads.mass / (7850 kg/m**3"),
    ("a key longer than its seat", ("key_length: {value: 50 mm", "key_length: {value: 80 mm"), "crankshaft that it sits on is only 60 mm long"),
    ("a shaft at another speed than its loads", ("speed: ${drive.crank_speed}\n    loads", "speed: 500 rpm\n    loads"),
     "is 500 r/min, but the curves that load it come from drive, at 50 r/min"),
    ("a key at another speed than its torque", ("cycle_speed: ${drive.crank_speed} #", "cycle_speed: 5 rpm #"), "is 5 r/min, but"),
    ("a bearing at another speed than its shaft", ("reaction_a}\n        speed: ${drive.crank_speed}", "reaction_a}\n        speed: 500 rpm"),
     "is 500 r/min, but the shaft crankshaft, whose reaction it bears, turns at 50 r/min"),
    ("a helical gear whose axial force no bearing takes", ("mesh_angle: {value: 0 deg, basis: assumed}}", "mesh_angle: 0 deg, helix_angle: 30 deg}"),
     "is at most 0 N, but the shaft crankshaft, which this bearing locates, is pushed along its axis by up to"),
    ("a helical gear of a straight pair", ("mesh_angle: {value: 0 deg, basis: assumed}}", "mesh_angle: 0 deg, helix_angle: 30 deg}"),
     "is 30°, but the pair main_gears, which takes the same torque, has the helix angle 0°"),
    ("a chain of another sprocket", ("teeth_1: ${feeder.sprocket_teeth}", "teeth_1: 20"), "gives 20, but the sprocket of feeder"),
    ("a chain of another pitch", ("chain: 12B", "chain: 08B"), "gives 12.7 mm, but the sprocket of feeder"),
    ("a torque curve over too few turns", ("torque_curve_turns: ${timing.torque_curve_turns}", "torque_curve_turns: 1"),
     "is 1, but the torque curve of timing spans 2 revolutions of the main shaft"),
    ("a torque curve of a faster shaft", ("output_speed: ${timing.main_shaft_speed}", "output_speed: 50 rpm"),
     "is 50 r/min, but the curves that load it come from timing, at 100 r/min"),
    ("a pinion of another module", ("pinion_radius: {value: 70 mm", "pinion_radius: {value: 7 mm"), "the pair sector, which takes the same torque"),
]  # fmt: skip


def changed(folder: Path, old: str, new: str) -> Path:
    """The published press with its first such text changed."""
    text = EXAMPLE.read_text(encoding="utf-8")
    assert old in text
    return saved(folder, text.replace(old, new, 1))


@cache
def published() -> Config:
    """The press without a blunder."""
    return load_config(EXAMPLE, DISCOVERY)


def read(file: Path) -> Config:
    """A press of which only what is unlike the published one is judged anew."""
    return load_config(file, DISCOVERY, former=published())


@pytest.mark.parametrize(("change", "words"), [each[1:] for each in BLUNDERS], ids=[each[0] for each in BLUNDERS])
def test_a_blunder_is_refused_with_its_place(tmp_path: Path, change: tuple[str, str], words: str) -> None:
    file = changed(tmp_path, *change)
    with pytest.raises(UserError) as refused:
        WARM.calculate(read(file))
    told = [each for each in refused.value.problems if words in each.message]
    assert len(told) == 1
    assert (told[0].line or 0) > 1
    text, key = file.read_text(encoding="utf-8"), str(told[0].path).replace(".value", "").split(".")[-1]
    line = text.splitlines()[(told[0].line or 0) - 1]
    assert told[0].file == str(file) and (key in line or f"{key}:" not in text)


def test_a_contradiction_names_both_places(tmp_path: Path) -> None:
    file = changed(tmp_path, "module: {value: 5 mm", "module: {value: 4 mm")
    with pytest.raises(UserError) as refused:
        WARM.calculate(read(file))
    lines = file.read_text(encoding="utf-8").splitlines()
    (told,) = refused.value.problems
    assert "pitch_radius: {value: 120 mm" in lines[(told.line or 0) - 1]
    other = re.search(r"mechanisms\.main_gears\.module[.\w]*, line (\d+)", told.message)
    assert other and "module: {value: 4 mm" in lines[int(other[1]) - 1]
    assert file.name not in told.message  # results keep it as what advice leads to, the same wherever the file stands


BALANCED = (
    ("torque: ${drive.crank_torque}\n        gear:", "torque: balance\n        gear:"),
    ("torque: balance\n        mass: {value: 8 kg", "torque: ${drive.crank_torque}\n        mass: {value: 8 kg"),
)
TOOTHED = ("mass: {value: 8 kg", "gear: {pitch_radius: 96 mm, mesh_angle: 90 deg}\n        mass: {value: 8 kg")
CUT_SMALLER = ("module: {value: 5 mm", "module: {value: 4 mm")


@pytest.mark.parametrize(
    ("changes", "is_refused"),
    [((), False), ((CUT_SMALLER,), True), ((CUT_SMALLER, TOOTHED), False)],
    ids=["the pair's radius", "another one", "as the other load has teeth, whose pair it may be"],
)
def test_the_teeth_that_balance_a_torque_are_those_of_its_pair(
    tmp_path: Path, changes: tuple[tuple[str, str], ...], is_refused: bool
) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    for old, new in (*BALANCED, *changes):
        assert old in text
        text = text.replace(old, new, 1)
    config = read(saved(tmp_path, text))
    if not is_refused:
        WARM.calculate(config)
        return
    with pytest.raises(UserError) as refused:
        WARM.calculate(config)
    (told,) = refused.value.problems
    assert "loads.0.gear.pitch_radius" in str(told.path)
    assert re.search(r"is 120 mm, but the pair main_gears, .* mechanisms\.main_gears\.module", told.message)


@pytest.mark.parametrize(
    ("change", "place"),
    [
        (("moving_mass: {value: 9.6 kg", "moving_mass: {value: 30 kg"), "gripper_chain"),
        (("allowable_stress: {value: 1 MPa", "allowable_stress: {value: 9 MPa"), "damper"),
    ],
)
def test_what_is_only_unusual_warns(tmp_path: Path, change: tuple[str, str], place: str) -> None:
    run = WARM.calculate(read(changed(tmp_path, *change)))
    check = next(each for each in run.checks[place] if each.id == "usual_values")
    assert (check.status, check.check_class) == ("warn", "practice")
    assert "usual: " in check.message and "possible: " in check.message
    assert run.summary.warn


def test_what_is_usual_has_no_check_of_it() -> None:
    run = WARM.calculate(published())
    assert not [each.id for own in run.checks.values() for each in own if each.id == "usual_values"]
