"""What is left open of a machine: assumed and default values, forces that no part takes, each with its owner."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.plugins.cyclogram.kinds import TORQUES
from diecut_report.results.model import OpenRecord
from diecut_report.results.open_items import DRIVEN, unrated_forces
from diecut_report.results.press_run import compute
from tests.config.parts.machines import FILE
from tests.configs import DISCOVERY, EXAMPLE, HEAD, WARM, loaded, saved
from tests.examples import every

LEVER = "  a: {kind: lever, force: 2 kN VALUE}\n"
KEY = """\
  k: {kind: parallel_key, torque: 300 N*m, application_factor: 1.4, shaft_diameter: 50 mm, key_length: 50 mm,
      yield_shaft: 650 MPa, yield_hub: VALUE}
"""
STRONG = "sigma_h_lim_1: 767 MPa, sigma_h_lim_2: 767 MPa, sigma_f_lim_1: 314 MPa, sigma_f_lim_2: 314 MPa"
GEARS = (
    f"  g: {{kind: gear_pair, module: 4 mm, teeth_1: 24, teeth_2: 61, face_width: 40 mm, {STRONG}, torque: VALUE}}\n"
)
DRIVE = """\
  d: {kind: cylinder_drive, cylinder_radius: 105.5 mm, cylinder_length: 700 mm, cylinder_mass: 104 kg, cylinder_inertia: 0.74 kg*m**2,
      crank_length: 100 mm, pinion_radius: 70 mm VALUE}
"""
CLUTCH = "  c: {kind: clutch, torque: 300 N*m, shoe_radius: 120 mm, wedge_angle: 10 deg, allowable_pressure: {value: VALUE, basis: measured}}\n"
RUNNING_IN = ", grade: 8, speed: 500 rpm"
CUTTING = Discovery().mechanism("circular_knife").example.inputs | {
    "kind": "circular_knife",
    "thickness": "0.5 mm",
    "speed": "60 rpm",
}
KNIFE = f"  k: {CUTTING | {'allowable_torque': 'VALUE'}!r}\n".replace("'VALUE'", "VALUE")
TURNING = """\
  s: {kind: shaft, sections: [{length: 300 mm, diameter: 60 mm}], bearing_a: 25 mm, bearing_b: 250 mm, material: 42CrMo4+QT, rotation: VALUE,
      loads: [{name: disc, position: 150 mm, force_y: 1 kN}]}
"""
LOADED = """\
  s:
    kind: shaft
    sections: [{length: 300 mm, diameter: 60 mm}]
    bearing_a: 20 mm
    bearing_b: 200 mm
    material: 42CrMo4+QT
    allowable_deflection: 0.1 mm
    allowable_twist: 0.5 deg/m
    speed: 50 rpm
    notches: [{position: 100 mm, type: NOTCH}]
    loads: [{name: gear, position: 100 mm, torque: balance, gear: {pitch_radius: 60 mm, mesh_angle: 0 deg}},
            {name: crank, position: 130 mm, torque: 300 N*m, LOAD}]
"""
FACTORS = {"life_factor_h_1": 1.1, "life_factor_f_2": 2, "alternating_factor": 0.9, "film_factor": 1.05, "grade": 6}
FIRST_LOAD, LOAD = "s.loads.0.force_y", "s.loads.1.force_y"
OPEN: dict[tuple[str, str, str], dict[str, str | None]] = {  # by a sentence, a path and a text what is open there, by the value in it
    ("a default is open, typed or not, and marked or not", "a.arm", LEVER): {
        "": "default", ", arm: 100 mm": "default", ", arm: {value: 0.1 m, basis: standard, note: DIN 1}": "default", ", arm: 110 mm": None,
        ", arm: {value: 110 mm, basis: assumed}": "assumed", ", arm: {value: 110 mm, basis: measured}": None},
    ("a reference rests on what it refers to", "b.arm", LEVER): {
        ", arm: {value: 110 mm, basis: assumed}}\n  b: {kind: lever, force: 1 kN, arm: '${a.arm}'": None},
    ("a given value counts as assumed where nobody says, or names, from where it is", "k.yield_hub", KEY): {
        "370 MPa": "assumed", "{value: 370 MPa, basis: drawing}": None, "{value: 370 MPa, basis: catalogue}": "assumed",
        "{value: 370 MPa, basis: catalogue, note: EN 10083-2 C45}": None},
    ("a formula founds nothing, as what it refers to is of something else", "k.yield_hub", KEY): {
        "'900 MPa + 0 * ${k.yield_shaft}'": "assumed", "{value: '900 MPa + 0 * ${k.yield_shaft}', basis: drawing}": None},
    **{("a factor in place of that of the method asks for a basis", f"g.{key}", GEARS.replace("VALUE", f"200 N*m, {key}: VALUE")): {
        str(value): "assumed", f"{{value: {value}, basis: drawing}}": None} for key, value in FACTORS.items()},
    ("flanks run in where the load factors are calculated, until somebody draws them", "g.flanks_1", GEARS): {
        "50 N*m": None, f"50 N*m{RUNNING_IN}": "assumed", f"50 N*m{RUNNING_IN}, flanks_1: through_hardened": "assumed",
        f"50 N*m{RUNNING_IN}, flanks_1: {{value: through_hardened, basis: drawing}}": None,
        f"50 N*m{RUNNING_IN}, flanks_1: case_hardened": None},
    ("a load beside other mechanisms asks for more than a drawing or a number of nobody", "g.torque", GEARS + DRIVE.replace(" VALUE", "")): {
        "200 N*m": "assumed", "{value: 1 N*m, basis: drawing}": "assumed", "{value: 200 N*m, basis: measured}": None,
        "'${d.crank_torque}'": None, "'0.5 * ${d.crank_length} * 4 kN'": "assumed"},
    ("of a load that is one number of a curve how it changes is left out", "g.torque", GEARS + DRIVE.replace(" VALUE", "")): {
        "'${d.crank_torque_peak}'": "assumed", "'2 * ${d.crank_torque_peak}'": "assumed"},
    ("a load is what a mechanism alone is calculated for", "g.torque", GEARS): {
        "200 N*m": None, "{value: 1 N*m, basis: drawing}": None, "{value: 200 N*m, basis: measured}": None},
    ("an unbalance that is left out makes forces smaller", "d.static_unbalance", DRIVE): {"": "default", ", static_unbalance: 2 kg*m": None},
    ("what is allowed beyond its usual range is never founded", "c.allowable_pressure", CLUTCH): {"0.4 MPa": None, "1.5 MPa": "assumed"},
    ("a limit without a usual range is open unless a note says who sets it", "k.allowable_torque", KNIFE): {
        "1e9 N*m": "assumed", "{value: 1e9 N*m, basis: measured}": "assumed", "{value: 50 N*m, basis: drawing}": "assumed",
        "{value: 50 N*m, basis: catalogue, note: gearbox K 47}": None,
        "{value: 50 N*m, basis: measured, note: test 7 of the gearbox}": None},
    ("that a shaft does not turn asks for a basis", "s.rotation", TURNING): {
        "turning": None, "none": "assumed", "{value: none, basis: assumed}": "assumed", "{value: none, basis: drawing}": None},
    ("nothing says that the key of a keyseat is rated", "s.notches.0.type", LOADED.replace("LOAD", "force_y: 3 kN").replace("NOTCH", "VALUE")): {
        "keyseat_end_mill": "assumed", "{value: keyseat_pair, basis: drawing}": None, "press_fit": None},
    ("the plane of a load that is left out is open", "s.loads.1.offset", LOADED.replace("NOTCH", "keyseat_end_mill").replace("LOAD", "VALUE")): {
        "force_y: 3 kN": "default", "force_y: 3 kN, offset: {value: 45 mm, basis: drawing}": None},
    ("a load without a force is open", LOAD, LOADED.replace("NOTCH", "press_fit").replace("LOAD", "VALUE")): {
        "offset: 1 mm": "default", "mass: 8 kg": "default", "force_y: 3 kN": None, "force_z: 3 kN": None, "axial_force: 1 kN": None},
    ("a gear has its force by its torque", FIRST_LOAD, LOADED.replace("NOTCH", "press_fit").replace("LOAD", "VALUE")): {"mass: 8 kg": None},
}  # fmt: skip
ROWS = [
    pytest.param(path, text.replace("VALUE", value), what, id=f"{sentence}: {value}")
    for (sentence, path, text), values in OPEN.items()
    for value, what in values.items()
]


def left(folder: Path, text: str) -> list[OpenRecord]:
    return WARM.calculate(loaded(folder, text)).summary.open


def values(folder: Path, text: str) -> dict[str, str]:
    """What is open of the inputs, by their paths."""
    return {each.path: each.what for each in left(folder, text) if each.what in ("assumed", "default")}


@pytest.mark.parametrize(("path", "text", "what"), ROWS)
def test_what_of_the_inputs_is_open(path: str, text: str, what: str | None, tmp_path: Path) -> None:
    assert values(tmp_path, HEAD + text).get(f"mechanisms.{path}") == what


BEARING = """\
  b:
    kind: rolling_bearing
    bearings:
      - {name: one, type: %s, designation: "%s",%s radial_force: 2 kN, speed: 50 rpm, %s}
      - {name: two, type: roller, designation: NU210E, radial_force: 2 kN, speed: 50 rpm}
"""


def of_bearing(folder: Path, keys: str, type_: str = "deep_groove", designation: str = "6209") -> list[OpenRecord]:
    ratings = (
        "" if designation.startswith("NU") else " dynamic_rating: 35 kN, static_rating: 21 kN,"
    )  # of others there is no table
    return left(folder, HEAD + BEARING % (type_, designation, ratings, keys))


@pytest.mark.parametrize(
    ("type_", "designation", "mrad", "is_usual"),
    [
        ("deep_groove", "6209", 2.9, True), ("deep_groove", "6209", 3.0, False), ("deep_groove", "6209", 50, False),
        ("ball", "7208", 1.0, False), ("ball", "1208", 35, True), ("ball", "1208", 40, False),
        ("roller", "NU208E", 1.1, True), ("roller", "NU208E", 1.2, False), ("roller", "NU2208E", 0.87, True), ("roller", "NU2208E", 1.0, False),
        ("roller", "NA4909", 0.5, False), ("roller", "22212", 26, True), ("roller", "22212", 30, False),
    ],
)  # fmt: skip
def test_a_permitted_tilt_is_held_against_what_bearings_of_its_type_take(
    type_: str, designation: str, mrad: float, is_usual: bool, tmp_path: Path
) -> None:
    typed = f"tilt: {{value: 0.5 mrad, basis: measured}}, permitted_tilt: {{value: {mrad} mrad, basis: catalogue, note: the maker's}}"
    warned = [each for each in of_bearing(tmp_path, typed, type_, designation) if each.what == "warning"]
    assert ([each.path for each in warned] == []) == is_usual
    if not is_usual:
        assert warned[0].path == "mechanisms.b.checks.usual_values"
        assert "bearings.permitted_tilt / type_tilt = " in str(warned[0].why)


@pytest.mark.parametrize(
    ("type_", "designation", "rpm", "found"),
    [  # d_m of 6209 and of all of its diameter series: 65 mm
        ("deep_groove", "6209", 5000, "usual"), ("deep_groove", "6209", 1000, "warning"), ("deep_groove", "6209", 20_000, "warning"),
        ("deep_groove", "6209", 100_000, "refused"), ("deep_groove", "6209", 500, "refused"), ("ball", "7209", 100_000, "refused"),
        ("roller", "NU209E", 100_000, "refused"), ("roller", "NJ 2209", 100_000, "refused"), ("roller", "22209", 5000, "usual"),
        ("ball", "7224", 5000, "assumed"), ("roller", "NA4909", 100_000, "assumed"), ("roller", "own make", 5000, "assumed"),
    ],
)  # fmt: skip
def test_a_limiting_speed_is_held_against_the_mean_diameter_of_its_bearing(
    type_: str, designation: str, rpm: float, found: str, tmp_path: Path
) -> None:
    typed = f"dynamic_rating: 60 kN, static_rating: 50 kN, limiting_speed: {rpm:g} rpm"
    typed = typed if designation not in ("6209", "NU209E") else f"limiting_speed: {rpm:g} rpm"
    text = HEAD + BEARING % (type_, designation, "", typed)
    if found == "refused":
        with pytest.raises(
            UserError, match=r"gives bearings.limiting_speed \* mean_diameter / \(1 revolution\) = "
        ) as refused:
            left(tmp_path, text)
        (problem,) = refused.value.problems
        assert str(problem.path) == "mechanisms.b.bearings.0.limiting_speed"
        return
    own = [each for each in left(tmp_path, text) if each.path in (LIMITING, "mechanisms.b.checks.usual_values")]
    assert [each.what for each in own] == ([] if found == "usual" else [found])


@pytest.mark.parametrize("unknown", ["own make", "7224"])
def test_the_ratings_and_factors_of_a_bearing_that_no_table_has_need_a_basis(unknown: str, tmp_path: Path) -> None:
    keys = {"dynamic_rating": "500 kN", "static_rating": "400 kN", "x": "0.35", "y": "0.57", "e": "1.14", "x0": "0.5", "y0": "0.26"}  # fmt: skip
    typed = {basis: ", ".join(f"{key}: {{value: {value}, basis: {basis}, note: SKF 7224 BM}}" for key, value in keys.items())
             for basis in ("given", "catalogue")}  # fmt: skip
    found = [{each.path.rpartition(".")[2] for each in left(tmp_path, HEAD + BEARING % ("ball", unknown, "", text)) if each.what == "assumed"}
             for text in typed.values()]  # fmt: skip
    assert found[0] >= keys.keys() and not found[1] & keys.keys()


OWN_CHAIN = """\
  c: {kind: roller_chain, chain: custom, teeth_1: 19, links: 100, speed: 100 rpm, torque: 50 N*m, application_factor: 1.3, KEYS}
"""


@pytest.mark.parametrize(("basis", "is_open"), [("given", True), ("catalogue", False)])
def test_the_values_of_a_chain_of_ones_own_need_a_basis(basis: str, is_open: bool, tmp_path: Path) -> None:
    keys = {"pitch": "19.05 mm", "pin_diameter": "5.72 mm", "bearing_area": "900 mm**2", "breaking_load": "28.9 kN",
            "mass_per_length": "1.15 kg/m"}  # fmt: skip
    typed = (f"{key}: {{value: {value}, basis: {basis}, note: the maker's}}" for key, value in keys.items())
    text = OWN_CHAIN.replace("KEYS", ", ".join(typed))
    assumed = {each.path.rpartition(".")[2] for each in left(tmp_path, HEAD + text) if each.what == "assumed"}
    assert (keys.keys() <= assumed) == is_open and bool(keys.keys() & assumed) == is_open


@pytest.mark.parametrize(("basis", "is_open"), [("given", True), ("measured", False)])
def test_a_property_that_no_range_bounds_needs_a_basis(basis: str, is_open: bool, tmp_path: Path) -> None:
    text = EXAMPLE.with_name("circular_knife.yaml").read_text("utf-8")
    given = re.sub(r"shear_resistance: .*", f"shear_resistance: {{value: 42 N/mm**2, basis: {basis}}}", text)
    found = {path for path, what in values(tmp_path, given).items() if what == "assumed"}
    assert given != text and any(path.endswith(".shear_resistance") for path in found) == is_open


LIMITING = "mechanisms.b.bearings.0.limiting_speed"


@pytest.mark.parametrize("unknown", ["own make", "7224"])
def test_a_limiting_speed_that_nothing_bounds_needs_a_basis(unknown: str, tmp_path: Path) -> None:
    ratings, typed = "dynamic_rating: 60 kN, static_rating: 50 kN", "limiting_speed: {value: 5000 rpm, basis: %s}"
    said = {basis: left(tmp_path, HEAD + BEARING % ("ball", unknown, "", f"{ratings}, {typed % basis}"))
            for basis in ("given", "'catalogue', note: SKF 7224 BM")}  # fmt: skip
    (given,), none = ([each for each in own if each.path == LIMITING] for own in said.values())
    assert none == []
    assert "nothing tells what it is held against" in str(given.why)


def test_the_limiting_speed_of_a_part_is_judged_by_its_own_diameter(tmp_path: Path) -> None:
    large = "      - {name: three, type: roller, designation: NU220E, radial_force: 2 kN, speed: 50 rpm, limiting_speed: %s rpm}\n"
    typed = HEAD + BEARING % ("deep_groove", "6200", "", "limiting_speed: 35000 rpm")  # 0.7e6 mm/min, 4.9e6 of NU220E
    assert not [each for each in left(tmp_path, typed + large % 4000) if "usual_values" in each.path]
    with pytest.raises(UserError) as refused:
        left(tmp_path, typed + large % 35_000)
    assert [str(each.path) for each in refused.value.problems] == ["mechanisms.b.bearings.2.limiting_speed"]


@pytest.mark.parametrize(
    ("tilt", "what"),
    [
        ("0 mrad", "assumed"),
        ("{value: 0.1 mrad, basis: given}", "assumed"),
        ("{value: 0.1 mrad, basis: measured}", None),
    ],
)
def test_a_tilt_that_is_only_typed_is_open(tilt: str, what: str | None, tmp_path: Path) -> None:
    (found,) = [
        each for each in of_bearing(tmp_path, f"tilt: {tilt}") if each.path == "mechanisms.b.bearings.0.tilt"
    ] or [None]
    assert (found and found.what) == what
    assert found is None or "nothing says where it comes from" in str(found.why)


SHAFT = """\
  s:
    kind: shaft
    sections: [{length: 300 mm, diameter: 50 mm}]
    bearing_a: 20 mm
    bearing_b: 280 mm
    material: C45E+QT
    loads: [{name: gear, position: 150 mm, force_y: 3 kN, torque: 100 N*m, seat: %s}, {name: end, position: 290 mm, torque: -100 N*m, seat: none}]
    notches: [{position: 150 mm, type: custom, k_f: %s, k_fs: 1.3}]
    seat_a: %s
"""
DRAWN = "{value: %s, basis: drawing}"


def of_shaft(folder: Path, load: str = "tight", k_f: str = DRAWN % "1.5", seat: str = "tight") -> dict[str, str]:
    found = left(folder, HEAD + SHAFT % (load, k_f, seat))
    return {each.path.removeprefix("mechanisms.s."): str(each.why) for each in found if each.what == "assumed"}


def test_a_loose_seat_is_a_choice_that_is_open_until_somebody_draws_it(tmp_path: Path) -> None:
    kept = of_shaft(tmp_path)
    loose = of_shaft(tmp_path, load="loose", seat="loose")
    assert loose.keys() - kept.keys() == {"seat_a", "loads.0.seat"}
    assert "loose seat" in loose["seat_a"]
    assert of_shaft(tmp_path, load=DRAWN % "loose", seat=DRAWN % "loose").keys() == kept.keys()
    named = "{value: loose, basis: standard, note: h6 of ISO 286-2}"
    assert of_shaft(tmp_path, seat=named).keys() == kept.keys()


def test_the_factor_of_a_custom_notch_asks_for_its_basis(tmp_path: Path) -> None:
    assert "notches.0.k_f" in of_shaft(tmp_path, k_f="1")
    assert "notches.0.k_f" not in of_shaft(tmp_path)
    assert "in place of that of the method" in of_shaft(tmp_path)["notches.0.k_fs"]


@pytest.mark.parametrize(
    ("rate", "is_open"), every(2, [("1000 1/h", True), ("{value: 1000 1/h, basis: drawing}", False)])
)
def test_a_required_rate_that_is_only_typed_is_open(rate: str, is_open: bool, tmp_path: Path) -> None:
    kind = "    kind: press_consistency\n"
    found = values(tmp_path, EXAMPLE.read_text("utf-8").replace(kind, f"{kind}    required_rate: {rate}\n"))
    assert ("mechanisms.consistency.required_rate" in found) == is_open


def test_each_item_has_the_owner_of_the_project(tmp_path: Path) -> None:
    text = HEAD.replace("title: Test", "title: Test, prepared_by: Designer") + "  a: {kind: lever, force: 2 kN}\n"
    assert {each.owner for each in left(tmp_path, text)} == {"Designer"}
    assert {each.owner for each in left(tmp_path, text.replace(", prepared_by: Designer", ""))} == {""}


def test_forces_that_no_part_takes_are_named_by_the_mechanism_that_makes_them() -> None:
    found = WARM.calculate(load_config(EXAMPLE, DISCOVERY)).summary.open
    unrated = {each.path: str(each.why) for each in found if each.what == "not_rated"}
    names = ("drive", "feeder", "cross", "gripper_chain", "crank_pin", "rocker_pin")
    assert unrated.keys() == {f"mechanisms.{name}" for name in names}  # bearings take the reactions of the crankshaft
    assert unrated["mechanisms.crank_pin"] == "no part takes reaction_a, reaction_b"
    crosses = [str(each.why) for each in found if each.path == "mechanisms.cross"]
    assert crosses == [
        "no part takes torque, roller_force",
        "it is not a line of timing, so that motor and flywheel are calculated without its torque",
    ]
    assert "coupler_force" not in unrated["mechanisms.drive"]  # a pin takes it


def test_a_mechanism_alone_belongs_to_no_drive_line(tmp_path: Path) -> None:
    one = HEAD + "  a: {kind: lever, force: 2 kN}\n"
    assert not [each for each in left(tmp_path, one) if each.what == "not_rated"]
    two = left(tmp_path, one + "  b: {kind: lever, force: 1 kN}\n")
    assert [each.path for each in two if each.what == "not_rated"] == ["mechanisms.a", "mechanisms.b"]


@pytest.mark.parametrize(
    ("force", "is_left"),
    [
        ("force_y: '${d.crank_bearing_force_x}'", True),
        ("force_y: '${d.crank_bearing_force_x}', force_z: '${d.crank_bearing_force_y}'", False),
        ("force_y: '${d.coupler_force}'", False),  # the whole of it, along the coupler
    ],
)
def test_a_load_that_takes_one_component_of_a_force_is_named(force: str, is_left: bool, tmp_path: Path) -> None:
    found = left(
        tmp_path, HEAD + LOADED.replace("NOTCH", "press_fit").replace("LOAD", force) + DRIVE.replace("VALUE", "")
    )
    why = [str(each.why) for each in found if each.path == "mechanisms.s.loads.1"]
    assert why == (["takes no crank_bearing_force_y of d"] if is_left else [])


@pytest.mark.nightly
def test_a_shaft_that_no_bearing_holds_along_its_axis_is_open(tmp_path: Path) -> None:
    """Two NU do not; one of them as a ball bearing does."""
    text = EXAMPLE.with_stem("flat_cylinder_elements").read_text("utf-8")
    assert text.count('"6209"') == 1 and text.count('"6212"') == 1

    def unlocated(changed: str) -> list[str]:
        return [each.path for each in left(tmp_path, changed) if "along its axis" in str(each.why)]

    one = text.replace('"6209"', "NU209E")
    assert unlocated(one) == []
    assert unlocated(one.replace('"6212"', "nu 212 e")) == ["mechanisms.crankshaft"]


@pytest.mark.nightly
def test_a_mechanism_that_is_no_line_is_open_in_a_machine_of_parts_too(tmp_path: Path) -> None:
    """The Geneva drive stands on shafts of the machine, and the motor does not know it."""
    text = FILE.with_stem("flat_cylinder_corrected").read_text("utf-8")
    lines = text.splitlines(keepends=True)
    cross = [line for line in lines if line.lstrip().startswith("- mechanism: cross")]
    assert len(cross) == 1

    def open_at(changed: str) -> list[str]:
        config = load_config(saved(tmp_path, changed), Discovery([]))
        run = compute(config, lambda _: None)
        return [each.path for each in unrated_forces(run) if "is not a line of timing" in str(each.why)]

    start, end = text.index("    interlocks:"), text.index("\n\n", text.index("    interlocks:"))
    held = "    interlocks: [{name: a, phase: drive.contact, within: drive.contact}]"
    whole = text[:start] + held + text[end:]
    at = whole.index(cross[0])
    without = whole[:at] + whole[whole.index("    interlocks:") :]
    assert open_at(without) == ["mechanisms.cross"]


def test_what_a_main_shaft_drives_is_what_the_cyclogram_takes_a_torque_of() -> None:
    assert set(DRIVEN) == set(TORQUES)
