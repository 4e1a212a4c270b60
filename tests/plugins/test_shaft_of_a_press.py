"""A crankshaft under the curves of a press's drive: numbers of the method, references in lists, what the results say of them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from diecut_report.press import Press
from diecut_report.quantities.plausible import Plausible
from diecut_report.results.mechanism_record import ShownRecord
from tests.configs import DISCOVERY, HEAD, problems, saved

DRIVE = """
  drive:
    kind: cylinder_drive
    frame_ratio: 5
    coupler_ratio: 5
    rocker_ratio: 2.05
    cylinder_radius: 105 mm
    cylinder_length: 700 mm
    cylinder_mass: 80.9077 kg
    cylinder_inertia: 0.63623 kg*m**2
    static_unbalance: 1.97727 kg*m
    cutting_arc_fraction: 0.712481
    cutting_force_per_length: 25 N/mm
    ejection_force_per_length: 5 N/mm
    crank_length: 100 mm
    pinion_radius: 70 mm
    n_points: 720
"""
SHAFT = """
  crankshaft:
    kind: shaft
    sections:
      - {length: 50 mm, diameter: 45 mm, fillet_radius: 1.5 mm}
      - {length: 170 mm, diameter: 55 mm, fillet_radius: 2 mm}
      - {length: 60 mm, diameter: 60 mm, fillet_radius: 2 mm}
      - {length: 60 mm, diameter: 50 mm}
    notches: [{position: 130 mm, type: keyseat_end_mill}, {position: 310 mm, type: keyseat_end_mill}]
    bearing_a: 25 mm
    bearing_b: 250 mm
    seat_a: loose  # as the method calculates its example
    seat_b: loose
    tensile_strength: 900 MPa
    yield_strength: 650 MPa
    speed: ${drive.crank_speed}
    loads:
      - {name: gear, position: 130 mm, torque: "${drive.crank_torque}", gear: {pitch_radius: 120 mm, mesh_angle: 0 deg}, mass: 12 kg}
      - {name: crank, position: 310 mm, offset: 45 mm, force_y: "${drive.crank_bearing_force_x}",
         force_z: "${drive.crank_bearing_force_y}", torque: balance, mass: 8 kg}
"""
PRESS = HEAD + DRIVE + SHAFT


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


def value(results: Any, name: str) -> float:
    """A number of the crankshaft."""
    own = results.mechanisms["crankshaft"]
    return float((own.outputs | own.values)[name].value)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("reaction_a_max", 4780.0),
        ("reaction_b_max", 14626.3),
        ("bending_moment_max", 1047.1),
        ("fatigue_safety", 2.2916),
        ("yield_safety", 10.665),
        ("yield_safety_notch", 5.475),
        ("slope_b", 0.763e-3),
        ("slope_a", 0.436e-3),
        ("deflection_end", 97.40e-6),
        ("place_safety.2", 2.2916),
        ("place_safety.1", 2.8315),
        ("place_safety.0", 10.344),
    ],
)
def test_the_crankshaft_of_the_press_has_the_numbers_of_the_method(results: Any, name: str, expected: float) -> None:
    """The method samples a turn at 720 places; both limits at the jumps of the drive's forces add up to 0.3 %."""
    assert value(results, name) == pytest.approx(expected, rel=4e-3)


def test_the_shoulder_beside_the_crank_governs(results: Any) -> None:
    own = results.mechanisms["crankshaft"]
    assert own.outputs["fatigue_place"].value == "shoulder 3"
    fatigue = next(check for check in own.checks if check.id == "fatigue")
    assert "at shoulder 3" in fatigue.message
    assert fatigue.part_name == "shoulder 3"
    assert [part.name for part in fatigue.parts][:2] == ["shoulder 1", "shoulder 2"]


def test_reactions_are_curves_that_others_may_refer_to(results: Any) -> None:
    curve = results.mechanisms["crankshaft"].curves["reaction_b"]
    assert curve.abscissa == "cycle_angle"
    assert len(curve.values) == 360
    assert max([*curve.values, *curve.left, *curve.right]) == pytest.approx(value(results, "reaction_b_max"), rel=1e-3)


def test_what_varies_is_told_among_the_inputs_and_kept_in_the_resolved_config(results: Any) -> None:
    own = results.mechanisms["crankshaft"].inputs
    assert own["loads.0.torque"].value == "a curve"
    assert own["loads.1.torque"].value == "balance"
    assert own["loads.1.force_y"].path == "drive.crank_bearing_force_x"
    assert "sections.3.fillet_radius" not in own
    loads = results.config.resolved["mechanisms"]["crankshaft"]["loads"]
    assert loads[0]["torque"] == "${drive.crank_torque}"
    assert loads[1]["torque"] == "balance"


def test_extremes_are_read_in_units_and_kept(tmp_path: Path) -> None:
    text = HEAD + SHAFT.replace(
        '"${drive.crank_torque}", gear: {pitch_radius: 120 mm, mesh_angle: 0 deg}', "{min: -0.3 kN*m, max: 494}"
    )
    text = text.replace('"${drive.crank_bearing_force_x}"', "-9.994 kN").replace(
        '"${drive.crank_bearing_force_y}"', "0"
    )
    found: Any = (
        Press.read(saved(tmp_path, text.replace("${drive.crank_speed}", "50 rpm")), DISCOVERY).calculate().results
    )
    own = found.mechanisms["crankshaft"]
    assert own.inputs["loads.0.torque"].display == ShownRecord(text="-300 … 494", unit="N*m")
    assert found.config.resolved["mechanisms"]["crankshaft"]["loads"][0]["torque"] == {
        "min": "-300.0 N*m",
        "max": "494.0 N*m",
    }
    assert own.outputs["torque_min"].value == -300


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('torque: "${drive.crank_torque}"', 'torque: "${drive.swing}"', "drive"),
        ('torque: "${drive.crank_torque}"', 'torque: "${drive.coupler_force}"', "is not a curve in N·m"),
        ("speed: ${drive.crank_speed}", "speed: ${drive.crank_torque}", "is a curve"),
        ("bearing_a: 25 mm", "bearing_a: ${crankshaft.place_x}", "refer to one"),
        ("bearing_a: 25 mm", "bearing_a: ${crankshaft.loads.0.torque}", "may vary over a cycle"),
        ("torque: balance", "torque: rest", "balance"),
        ("yield_strength: 650 MPa", "yield_strength: 650 MPa\n    material: C45E+N", "only one can hold"),
        ("tensile_strength: 900 MPa", "material: C45", "allowed: 42CrMo4+QT, C45E+QT, C45E+N"),
    ],
)
def test_a_wrong_reference_is_told_where_it_stands(tmp_path: Path, old: str, new: str, words: str) -> None:
    found = problems(tmp_path, PRESS.replace(old, new))
    assert any(words in problem for problem in found), found
