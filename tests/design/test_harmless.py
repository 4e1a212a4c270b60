"""Which assumed and default values are harmless: tried at both ends of what is usual, alone and together."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.design.findings import decided, with_findings
from diecut_report.design.harmless import (
    NO_NUMBER,
    STANDS_ALONE,
    Effects,
    Trial,
    TriedOpenValues,
    UsualEnds,
    apart,
    without_harmless,
)
from diecut_report.design.inputs import design_input
from diecut_report.press import Press
from diecut_report.results.model import OpenRecord
from tests.configs import EXAMPLE, GOOD, HEAD, saved

FORCE, ARM, TEETH = "mechanisms.a.force", "mechanisms.a.arm", "mechanisms.a.teeth"
MOMENT = "the check a.moment turns from pass to fail"
HOLDS = "the check a.moment turns from fail to pass"


def press(folder: Path, allowed: str, more: str = "") -> Press:
    """A lever of 2 kN, assumed, on its default arm of 100 mm: 200 N·m."""
    force = "{value: 2 kN, basis: assumed}"
    text = HEAD + f"  a: {{kind: lever, force: {force}, allowable_moment: {allowed}{more}}}\n"
    return Press.read(saved(folder, text), Discovery([GOOD]))


def left(made: Press) -> dict[str, str]:
    return {each.path: str(each.why) for each in without_harmless(made.config, made.calculate().results)}


@pytest.mark.parametrize(
    ("allowed", "more", "found"),
    [
        ("250 N*m", "", {}),  # 200 · 1.1 · 1.1 = 242
        ("210 N*m", "", {FORCE: f"with 2.2 kN {MOMENT}", ARM: f"with 110 mm {MOMENT}"}),
        ("190 N*m", "", {FORCE: f"with 1.8 kN {HOLDS}", ARM: f"with 90 mm {HOLDS}"}),  # an end makes it hold
        ("900 N*m", ", teeth: {value: 95, basis: assumed}", {TEETH: "with 104 the machine cannot exist"}),  # a hundred at most
        ("900 N*m", ", width: {value: '${press.sheet.thickness} * 9', basis: assumed}", {"mechanisms.a.width": str(NO_NUMBER)}),
    ],
)  # fmt: skip
def test_values_are_open_where_a_check_changes_with_them(
    tmp_path: Path, allowed: str, more: str, found: dict[str, str]
) -> None:
    assert left(press(tmp_path, allowed, more)) == found


def test_of_values_that_change_a_check_together_one_is_enough(tmp_path: Path) -> None:
    known = left(press(tmp_path, "230 N*m"))  # each alone 220, together 242
    assert len(known) == 1 and known.keys() < {FORCE, ARM}
    assert set(known.values()) == {"together with other assumed and default values it changes the check a.moment"}


@pytest.mark.parametrize(
    ("count", "is_open"), [("{value: 2, basis: assumed}", True), ("{value: 2, basis: drawing}", False), ("1", False)]
)
def test_an_assumed_number_of_keys_stays_open(tmp_path: Path, count: str, is_open: bool) -> None:
    """A tenth of two is none; of one key nobody need say anything."""
    sizes = "shaft_diameter: 50 mm, key_length: 50 mm, hub_length: 60 mm, torque: 400 N*m, application_factor: 1.25"
    yields = "yield_key: 450 MPa, yield_shaft: 650 MPa, yield_hub: 370 MPa"
    text = HEAD + f"  k: {{kind: parallel_key, {sizes}, {yields}, key_count: {count}}}\n"
    known = left(Press.read(saved(tmp_path, text), Discovery()))
    assert (known.get("mechanisms.k.key_count") == str(STANDS_ALONE)) is is_open


def strong_shaft(folder: Path, tensile: str, yields: str, fatigue: str) -> Press:
    """A shaft with these strengths, each a value in MPa with its basis."""
    text = (
        HEAD
        + f"""\
  shaft:
    kind: shaft
    sections:
      - {{length: 50 mm, diameter: 45 mm, fillet_radius: 1.5 mm}}
      - {{length: 170 mm, diameter: 55 mm, fillet_radius: 2 mm}}
      - {{length: 60 mm, diameter: 60 mm, fillet_radius: 2 mm}}
      - {{length: 60 mm, diameter: 50 mm}}
    bearing_a: 25 mm
    bearing_b: 250 mm
    loads:
      - {{name: gear, position: 130 mm, torque: {{value: 500 N*m, basis: drawing}}, gear: {{pitch_radius: 120 mm, mesh_angle: 0 deg}}}}
      - {{name: crank, position: 310 mm, force_y: {{value: 15 kN, basis: drawing}}, force_z: {{value: 5 kN, basis: drawing}}, torque: balance}}
    tensile_strength: {{value: {tensile}}}
    yield_strength: {{value: {yields}}}
    fatigue_strength: {{value: {fatigue}}}
    speed: 50 rpm
"""
    )
    return Press.read(saved(folder, text), Discovery())


KNOWN, ASSUMED = " MPa, basis: standard, note: EN 10083-3", " MPa, basis: assumed"


def test_a_value_that_a_ratio_bounds_is_tried_at_the_ends_of_that(tmp_path: Path) -> None:
    """Usual are 35 to 55 % of the tensile strength: n_f is 1.64 with 450 MPa, 1.146 with 315 MPa, and 1.2 is required."""
    found = left(strong_shaft(tmp_path, f"900{KNOWN}", f"650{KNOWN}", f"450{ASSUMED}"))
    assert found["mechanisms.shaft.fatigue_strength"] == "with 315 MPa the check shaft.fatigue turns from pass to fail"


def test_a_strength_is_tried_with_the_tensile_strength_that_bounds_it(tmp_path: Path) -> None:
    """With 450 for 900 MPa the yield strength is 325 MPa: the shaft is safe against it alone, and not with 225 MPa against fatigue."""
    found = left(strong_shaft(tmp_path, f"900{ASSUMED}", f"650{ASSUMED}", f"450{ASSUMED}"))
    follow = "with 450 MPa (and shaft.yield_strength, shaft.fatigue_strength with it)"
    assert found["mechanisms.shaft.tensile_strength"] == f"{follow} the check shaft.fatigue turns from pass to fail"


def test_a_value_that_the_press_states_too_is_tried_with_that(tmp_path: Path) -> None:
    """A tenth of a per cent of 0.5 mm is harmless; both at 0.2 mm are not."""
    text = EXAMPLE.with_name("circular_knife.yaml").read_text("utf-8").replace("42 N/mm**2", "46 N/mm**2")
    text = re.sub(r"basis: assumed.*}", "basis: drawing, note: D1}", text)
    text = re.sub(r"(  +thickness:) .*", r"\1 {value: 0.5 mm, basis: assumed}", text)
    known = left(Press.read(saved(tmp_path, text), Discovery()))
    with_both = "with 0.2 mm (and knife.thickness with it) the check knife.shear_resistance turns from pass to warn"
    assert known["press.sheet.thickness"] == with_both and "mechanisms.knife.thickness" not in known


def test_what_a_ratio_bounds_follows_the_powers_of_what_is_open_beside_it(tmp_path: Path) -> None:
    """A cylinder's inertia is a share of m·r²; the angle of a mesh is none of anything."""
    body = "mass: 300 kg, rolling_radius: 150 mm, inertia: 5 kg*m**2, velocity: 1 m/s"
    text = HEAD + f"  d: {{kind: damper, {body}, shore_hardness: 70, ring_width: 60 mm, pad_height: 60 mm}}\n"
    config = Press.read(saved(tmp_path, text), Discovery()).config
    trials = [
        Trial(OpenRecord(what="assumed", path=f"mechanisms.d.{key}", owner="", why=""), design_input(config, f"d.{key}"), 1.0, 2.0, frozenset())
        for key in ("inertia", "mass", "rolling_radius", "velocity")
    ]  # fmt: skip
    inertia, mass, radius, velocity = UsualEnds(config).following(trials)
    assert inertia.follows == pytest.approx({mass.item.path: 1, radius.item.path: 2})
    assert not (mass.follows or radius.follows or velocity.follows)


def test_an_end_that_may_not_be_typed_gives_way_to_the_nearest_that_may(tmp_path: Path) -> None:
    """Usual are 0.5 to 50 µm, a hundred-thousandth to a thousandth of the span; 1 µm and more may be typed; the pin bends by 2.6 µm."""
    pin = (
        "sections: [{length: 70 mm, diameter: 30 mm}], bearing_a: 10 mm, bearing_b: 60 mm, speed: 50 rpm, material: 42CrMo4+QT, "
        "loads: [{name: pull, position: 35 mm, force_y: 8 kN, seat: none}], allowable_deflection: {value: 0.05 mm, basis: assumed}"
    )
    found = left(Press.read(saved(tmp_path, HEAD + f"  pin: {{kind: shaft, {pin}}}\n"), Discovery()))
    told = found["mechanisms.pin.allowable_deflection"]
    assert re.fullmatch(r"with (1|0\.001) .?m+ the check pin.deflection turns from pass to fail", told), told


def test_values_whose_partners_are_usual_and_places_on_a_shaft_are_harmless_where_no_check_depends_on_them(
    tmp_path: Path,
) -> None:
    """Poisson's number of 215 GPa beside 79.3 GPa is above its range; a twelfth of the diameter to twelve of them is no place of a bearing."""
    pin = (
        "sections: [{length: 180 mm, diameter: 60 mm}], bearing_a: 20 mm, bearing_b: {value: 160 mm, basis: assumed}, speed: 50 rpm, "
        "material: 42CrMo4+QT, loads: [{name: pull, position: 90 mm, force_y: 2 kN, seat: none}]"
    )
    found = left(Press.read(saved(tmp_path, HEAD + f"  pin: {{kind: shaft, {pin}}}\n"), Discovery()))
    assert not {f"mechanisms.pin.{key}" for key in ("elastic_modulus", "shear_modulus", "bearing_b")} & found.keys()


def test_an_assumed_direction_stays_open(tmp_path: Path) -> None:
    """Of nothing a tenth is nothing; the deflection is 73 % of what is allowed at 0°, and 120 % at 90°."""
    part = "{value: %s, basis: drawing, note: D1}"
    shaft = {
        "kind": "shaft", "material": "C45E+QT", "sections": [{"length": part % "400 mm", "diameter": part % "60 mm"}],
        "bearing_a": part % "20 mm", "bearing_b": part % "320 mm", "speed": part % "100 rpm", "allowable_deflection": part % "0.025 mm",
        "loads": [
            {"name": "wheel", "position": part % "150 mm", "torque": "balance",
             "gear": {"pitch_radius": part % "60 mm", "mesh_angle": "{value: 0 deg, basis: assumed}"}},
            {"name": "arm", "position": part % "190 mm", "torque": part % "250 N*m", "force_y": part % "3 kN"},
        ],
    }  # fmt: skip
    text = HEAD + f"  s: {shaft!r}\n".replace("'{", "{").replace("}'", "}")
    known = left(Press.read(saved(tmp_path, text), Discovery()))
    assert known["mechanisms.s.loads.0.gear.mesh_angle"] == str(STANDS_ALONE)


def test_a_limit_of_which_nobody_knows_what_is_usual_is_not_proved_harmless(tmp_path: Path) -> None:
    """A tenth more or less of a limit a million times the load changes no check, and says nothing."""
    own = Discovery().mechanism("circular_knife").example.inputs | {
        "kind": "circular_knife",
        "allowable_torque": "1e9 N*m",
    }
    text = HEAD + f"  k: {own | {'thickness': '0.5 mm', 'speed': '60 rpm'}!r}\n"
    known = left(Press.read(saved(tmp_path, text), Discovery()))
    assert "nothing but its note says who sets it" in known["mechanisms.k.allowable_torque"]


def test_the_verdict_is_proved_where_nothing_else_is_open(tmp_path: Path) -> None:
    for allowed, verdict, line in (
        ("250 N*m", "pass", "All checks pass."),
        ("210 N*m", "conditional", "No check fails, but 1 assumed value is open and 1 default value is open."),
    ):
        made = press(tmp_path, allowed).calculate()
        assert made.results.summary.verdict == "conditional"
        summary = decided(made).results.summary
        assert (summary.verdict, str(summary.conclusion)) == (verdict, line)


def test_values_are_tried_once(tmp_path: Path) -> None:
    """The second of two values that together change a check would be called harmless with the first alone."""
    once = decided(press(tmp_path, "230 N*m").calculate())
    assert with_findings(once).results.summary.open == once.results.summary.open != []


def test_a_failing_machine_is_not_tried_with_other_values(tmp_path: Path) -> None:
    made = press(tmp_path, "190 N*m").calculate()
    assert decided(made) is made


def test_sets_with_an_element_in_common_stand_in_different_groups() -> None:
    found = apart([frozenset("ab"), frozenset("c"), frozenset("bc"), frozenset(), frozenset("d")])
    assert sorted(sorted(group) for group in found) == [[0, 1, 3, 4], [2]]


def test_a_check_with_nothing_for_a_limit_is_brought_nearer_to_it_by_what_takes_its_margin(tmp_path: Path) -> None:
    """As a share of the greater side nothing would: that is the margin itself."""
    made, name = press(tmp_path, "250 N*m"), "a.checks.slack"
    item, design = OpenRecord(what="assumed", path=FORCE, owner="", why=""), design_input(made.config, "a.force")
    trials = [Trial(item, design, 1800.0, 2200.0, frozenset(["a"])), Trial(item, design, 1.0, 2.0, frozenset(["a"]))]
    today = {name: np.array([0.3])}
    effects = Effects(TriedOpenValues({name: np.array([1])}, today, today), len(trials))
    effects.margins = {name: np.array([[0.5, 0.05], [0.3, 0.3]])}
    corner = effects.corner(name, trials)
    assert list(corner.order) == [0] and corner.worse[0] == 2200.0


SERIES = """\
schema_version: 1
project: {title: train}
press: {name: p, productivity: 6000 1/h, sheet: {length: 700 mm, width: 470 mm, thickness: 0.6 mm}}
mechanisms:
  train:
    kind: drive_train
    gears: [{driver_teeth: 18, driven_teeth: 87}]
    vbelt: {section: SPA, driver_diameter: 125 mm, center_distance: 600 mm, tension: 350 N, groove_friction: FOUND(0.5)EFFICIENCY}
    flywheel_material: cast_iron
    motor_speed: FOUND(1450 rpm)
    output_speed: FOUND(100 rpm)
    torque_mean: FOUND(76.4 N*m)
    torque_peak: FOUND(150 N*m)
    power_per_belt: FOUND(3.5 kW)
    allowable_radial_force: FOUND(900 N)
    reserve_factor: FOUND(1.3)
    speed_fluctuation: FOUND(0.09)
    breakdown_ratio: FOUND(2.3)
    run_up_torque_ratio: FOUND(1.7)
    motor_inertia: FOUND(0.01 kg*m**2)
    load_inertia: FOUND(83 kg*m**2)
"""


def of_series(folder: Path, efficiency: str = "", more: str = "") -> Press:
    """A drive train whose motor is the next one of a series; what it is given is measured."""
    text = SERIES.replace("EFFICIENCY", efficiency) + more
    return Press.read(
        saved(folder, re.sub(r"FOUND\((.*?)\)", r"{value: \1, basis: measured, note: test 12}", text)), Discovery()
    )


def test_values_that_fail_together_within_the_worst_corner_are_not_harmless(tmp_path: Path) -> None:
    """A belt that loses less asks for a smaller motor, which runs up too slowly; in the corner the gears lose more, and ask for the greater."""
    made = of_series(tmp_path)
    results = made.calculate().results
    assert {each.status for each in results.mechanisms["train"].checks} <= {"pass", "warn", "not_checked"}
    ends = of_series(tmp_path, ", efficiency: 0.98", "    allowable_run_up_time: 9 s\n").calculate().results
    assert [each.id for each in ends.mechanisms["train"].checks if each.status == "fail"] == ["run_up_time"]
    known = left(made)
    assert {*known} & {"mechanisms.train.vbelt.efficiency", "mechanisms.train.allowable_run_up_time"}
    assert all("together" in words for path, words in known.items() if path.endswith(("efficiency", "run_up_time")))
