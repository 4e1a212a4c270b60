"""Each row of a study is judged as its machine is alone: what stands at its default, what is open, what a basis is of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from diecut_report.cli.main import main
from diecut_report.config import yaml
from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery
from diecut_report.design.inputs import design_input, given_numbers
from diecut_report.errors import UserError
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.press import Press
from diecut_report.results.warm_press import WarmPress
from diecut_report.study.analysis.variant_config import taken_config, variant_config
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution import press_batch
from diecut_report.study.execution.variant_rows import Rows, calculate_rows
from tests.configs import DISCOVERY, EXAMPLES, HEAD, saved
from tests.examples import every, few
from tests.study.studies import varied

PLATEN, KNIFE, MENDED = (
    next(path for path in EXAMPLES if path.stem == stem)
    for stem in ("platen_press_zppt30", "circular_knife", "flat_cylinder_press_mended")
)
SHAFT = """
  bent:
    kind: shaft
    sections: [{length: 500 mm, diameter: 40 mm}]
    bearing_a: 50 mm
    bearing_b: 450 mm
    tensile_strength: 900 MPa
    yield_strength: 650 MPa
    loads: [{name: knife, position: 250 mm, force_y: "${knife.force}"}]
"""


def rows(config: Config, path: str, *values: float) -> Rows:
    """A study of one number, SI."""
    return calculate_rows(config, {find_input(config, f"mechanisms.{path}"): np.array(values)}, len(values))


def config_of(folder: Path, text: str) -> Config:
    return Press.read(saved(folder, text), DISCOVERY).config


def require_as_alone(press: Press, path: str, *values: float) -> Rows:
    """Hold each row against the file with its value."""
    found, asked = rows(press.config, path, *values), design_input(press.config, path)
    for row, value in enumerate(values):
        try:
            alone = press.with_values({asked.stands: asked.typed(value)}).calculate().results
        except UserError:
            assert found.status[row] == "error"
            continue
        assert found.verdict[row] == alone.summary.verdict, (row, path)
        for name, mechanism in alone.mechanisms.items():
            for check in mechanism.checks:
                column = found.columns.get(f"{name}.checks.{check.id}.status")
                assert column is None or column[row] == check.status, (row, name, check.id)
    return found


@pytest.mark.parametrize(
    ("path", "values"),
    [
        ("crank.reliability", (0.90, 0.99)),
        pytest.param("wheel_key.load_distribution_factor", (1.2, 1.3), marks=pytest.mark.nightly),
        pytest.param("wheel_key.load_distribution_factor", (1.3, 1.1, 1.2), marks=pytest.mark.nightly),
    ],
)
def test_a_row_at_its_default_is_checked_whatever_stands_beside_it(path: str, values: tuple[float, ...]) -> None:
    require_as_alone(Press.read(PLATEN, DISCOVERY), path, *values)


def knife(folder: Path, friction: str) -> Press:
    """The circular knife, all but its friction on a drawing, with limits."""
    text = KNIFE.read_text("utf-8").replace("basis: assumed", "basis: drawing")
    head, _, rest = text.partition("    friction: ")
    limits = "".join(
        f'    {key}: {{value: {value}, basis: drawing, note: "drawing 12-345, strength of the knife holder"}}\n'
        for key, value in (("allowable_force", "100 N"), ("allowable_torque", "5 N*m"))
    )
    return Press.read(saved(folder, f"{head}    friction: {friction}\n{limits}{rest.partition(chr(10))[2]}"), DISCOVERY)


@pytest.mark.parametrize(
    ("friction", "verdicts"),
    [
        ("0.28", ["conditional", "conditional", "conditional"]),  # nothing says where it comes from; 0.3 is the default
        (
            '{value: 0.28, basis: measured, note: "protocol 17"}',
            ["pass", "conditional", "conditional"],
        ),  # one value was measured
        ("{value: 0.28, basis: drawing}", ["pass", "conditional", "pass"]),  # a drawing is the designer's own
    ],
)
def test_what_is_open_is_so_in_each_row(tmp_path: Path, friction: str, verdicts: list[str]) -> None:
    press = knife(tmp_path, friction)
    found = require_as_alone(press, "knife.friction", 0.28, 0.3, 0.27)
    assert found.verdict.tolist() == verdicts


def test_a_number_in_place_of_a_measured_one_is_assumed_in_the_file(tmp_path: Path) -> None:
    press = knife(tmp_path, '{value: 0.28, basis: measured, note: "protocol 17"}')
    asked = design_input(press.config, "knife.friction")
    after = press.with_values({asked.stands: "0.29"})
    assert '{value: 0.29, basis: assumed, note: "protocol 17"}' in after.config.tree.text
    assert press.with_values({asked.stands: "0.28"}).config.tree.text == press.config.tree.text
    drawn = knife(tmp_path, "{value: 0.28, basis: drawing}")
    assert "{value: 0.29, basis: drawing}" in drawn.with_values({asked.stands: "0.29"}).config.tree.text


# A torque of a load and the place of a notch, among other rows.

CRANKSHAFT = """\
schema_version: 1
project: {title: T}
press: {name: P, productivity: 6000 1/h, sheet: {length: 700 mm, width: 470 mm, thickness: 0.6 mm}}
mechanisms:
  crankshaft:
    kind: shaft
    sections: [{length: 100 mm, diameter: 50 mm}, {length: 300 mm, diameter: 55 mm}]
    bearing_a: 20 mm
    bearing_b: 380 mm
    loads:
      - {name: wheel, position: 130 mm, torque: 0 N*m, force_y: 1 kN}
      - {name: disc, position: 320 mm, torque: balance}
    notches: [{position: 240 mm, type: keyseat_end_mill}, {position: 305 mm, type: keyseat_end_mill}]
    tensile_strength: 900 MPa
    yield_strength: 650 MPa
    speed: 100 rpm
"""


LOADED = ("position: 130 mm, torque: 0 N*m", "position: 230 mm, torque: 90 N*m")
SHAFTS = [  # what differs from the shaft above, what is varied, which rows cannot exist, and why the first of them
    (("", ""), "loads.0.torque", (0.0, 500.0, 0.0), [1], "the nearest keyseat or press fit is at 240 mm"),
    (LOADED, "notches.1.position", (0.305, 0.310, 0.385), [2], ""),
    (("    speed: 100 rpm\n", "    rotation: 5 deg\n"), "rotation", (0.0, 0.2), [], ""),
]


@pytest.mark.parametrize(("change", "path", "values", "impossible", "why"), SHAFTS, ids=[each[1] for each in SHAFTS])
def test_a_shaft_of_one_row_is_another_in_the_next(
    tmp_path: Path, change: tuple[str, str], path: str, values: tuple[float, ...], impossible: list[int], why: str
) -> None:
    """A torque is none, the place of a notch leaves the shaft, its rotation is varied."""
    found = rows(config_of(tmp_path, CRANKSHAFT.replace(*change)), f"crankshaft.{path}", *values)
    assert np.flatnonzero(found.status == "error").tolist() == impossible
    assert all(why in str(found.errors[row]) for row in impossible)


def test_a_text_that_a_machine_does_not_have_is_none(tmp_path: Path) -> None:
    """Of a shaft that stands still the verdict on its speed."""
    config = config_of(tmp_path, CRANKSHAFT + "    rotation: none\n")
    found = rows(config, "crankshaft.bearing_a", 0.02, 0.021)
    assert found.columns["crankshaft.speed_verdict"].tolist() == [None, None]
    assert found.status.tolist() == ["fail", "fail"]


BEARING = """\
schema_version: 1
project: {title: T}
press: {name: P, productivity: {value: 6000 1/h, basis: drawing}}
mechanisms:
  bearings:
    kind: rolling_bearing
    bearings:
      - name: a
        type: deep_groove
        designation: X209
        dynamic_rating: {value: 35.1 kN, basis: drawing}
        static_rating: {value: 21.6 kN, basis: drawing}
        radial_force: {value: 3 kN, basis: drawing}
        speed: {value: 100 rpm, basis: drawing}
        limiting_speed: 3000 rpm
"""


def test_what_nothing_bounds_is_open_in_each_row(tmp_path: Path) -> None:
    name, founded = "bearings.bearings.0.limiting_speed", "{value: 3000 rpm, basis: drawing}"
    for text, is_open in ((BEARING.replace("3000 rpm", founded), False), (BEARING, True)):
        press = Press.read(saved(tmp_path, text), DISCOVERY)
        paths = {each.path for each in press.calculate().results.summary.open}
        assert (f"mechanisms.{name}" in paths) is is_open
    assert rows(press.config, name, 314.0, 419.0).verdict.tolist() == ["conditional", "conditional"]


def test_rows_of_a_plugin_with_faults_in_its_formulas_are_conditional(tmp_path: Path) -> None:
    builder = Path(__file__).parents[2] / "examples" / "machine-builder"
    plugin = (builder / "plugins" / "sheet_stop.py").read_text("utf-8")
    assert "m.stiffness * m.way" in plugin
    saved(tmp_path, plugin.replace("m.stiffness * m.way", "m.stiffness * m.way + 1", 1), "sheet_stop.py")
    config = Press.read(next(builder.rglob("*.yaml")), Discovery([tmp_path])).config
    names = [name for name, kind in config.kinds.items() if kind == "sheet_stop"]
    design = next(each for each in given_numbers(config) if each.asked.instance == names[0])
    found = calculate_rows(config, {design.asked: np.array([design.present, design.present])}, 2)
    assert found.verdict.tolist() == ["conditional", "conditional"]


def test_a_mechanism_that_is_calculated_once_for_those_that_are_the_same_to_it_gives_what_each_would(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A grid of two numbers of two mechanisms: the drive sees two unlike machines of eight. Curves too."""
    config = Press.read(MENDED, DISCOVERY).config
    first, last = np.meshgrid([20e3, 30e3], [0.15, 0.2, 0.25, 0.3], indexing="ij")
    varied = {"drive.cutting_force_per_length": first.ravel(), "clutch.shoe_friction": last.ravel()}
    given = {find_input(config, f"mechanisms.{path}"): values for path, values in varied.items()}
    curves = ["drive.crank_torque", "timing.main_shaft_torque", "crankshaft.reaction_b", "drive.crank_angle"]
    counts: list[int] = []

    def calculated(*asked: object) -> Calculation:
        counts.append(asked[2] if isinstance(asked[2], int) else 0)
        return calculate(*asked)  # type: ignore[arg-type]

    monkeypatch.setattr(press_batch, "calculate", calculated)
    shared = calculate_rows(config, given, 8, curves)
    assert not shared.slow and set(counts) == {2, 8}
    monkeypatch.setattr(press_batch, "MOSTLY", 0.0)
    whole = calculate_rows(config, given, 8, curves)
    assert shared.columns.keys() == whole.columns.keys()
    for name, column in shared.columns.items():
        for value, other in zip(column, whole.columns[name], strict=True):
            if isinstance(value, str | None):
                assert value == other, name
            else:
                flat = name == "timing.clearance_angle"  # the place of an extreme of a curve that is flat there
                np.testing.assert_allclose(value, other, rtol=1e-5 if flat else 1e-9, atol=1e-12, err_msg=name)
    assert shared.verdict.tolist() == whole.verdict.tolist() and shared.governing.tolist() == whole.governing.tolist()


def test_shafts_that_turn_unlike_often_in_a_cycle_are_as_each_alone(tmp_path: Path) -> None:
    """Each has so many instants of its cycle as alone; loads are those of a curve."""
    config = config_of(tmp_path, KNIFE.read_text("utf-8") + SHAFT)
    turns = 1, 100, 720
    found = rows(config, "bent.turns_per_cycle", *turns)
    for row, count in enumerate(turns):
        alone = rows(config, "bent.turns_per_cycle", count)
        for name in ("fatigue_safety", "deflection_max", "yield_safety", "reaction_b_max"):
            assert found.columns[f"bent.{name}"][row] == pytest.approx(alone.columns[f"bent.{name}"][0], rel=1e-12)
    assert len(set(found.columns["bent.fatigue_safety"])) == 3


MARGIN = "mechanisms.timing.interlocks.0.margin"


@pytest.mark.nightly
def test_a_margin_in_milliseconds_is_varied_as_it_is_typed() -> None:
    """It may be an angle or a time; the rate that it leaves room for goes with its inverse where it governs."""
    press = Press.read(MENDED, DISCOVERY)
    asked = find_input(press.config, MARGIN)
    assert (asked.unit, asked.display) == ("s", "ms") and design_input(press.config, MARGIN).present == 0.005
    found = require_as_alone(press, "timing.interlocks.0.margin", 0.005, 0.006)
    limits = found.columns["timing.productivity_limit"]
    assert limits[0] * 5 == pytest.approx(limits[1] * 6, rel=1e-6)
    angle = Press.read(MENDED, DISCOVERY).with_values({design_input(press.config, MARGIN).stands: "1 deg"})
    assert find_input(angle.config, MARGIN).unit == "rad"


def test_a_constraint_may_name_a_margin_in_milliseconds(tmp_path: Path) -> None:
    text = f"""schema_version: 1
base: {MENDED}
vary: {{{MARGIN}: {{from: 5 ms, to: 7 ms, count: 3}}}}
sample: {{method: grid}}
constraints: ["{MARGIN} < '6.5 ms'"]
outputs: [timing.productivity_limit]
"""
    study = load_study(saved(tmp_path, text, "study.yaml"), DISCOVERY)
    rows = study.sample.rows(0, 3)
    assert rows[MARGIN].tolist() == pytest.approx([0.005, 0.006, 0.007])
    assert [each.judged(rows).holds.tolist() for each in study.constraints] == [[True, True, False]]


@pytest.mark.parametrize(
    "values", ["[5 ms, 60 ms]", "{from: 5 ms, to: 60 ms, count: 3}", "{distribution: uniform, low: 5 ms, high: 60 ms}"]
)
def test_a_margin_that_the_file_has_as_an_angle_is_varied_as_one(tmp_path: Path, values: str) -> None:
    """A time was taken as so many radians, 60 ms as 3.4° where it is 36°."""
    saved(tmp_path, margins("3 deg"), "press.yaml")
    text = f"schema_version: 1\nbase: press.yaml\nvary: {{{MARGIN}: {values}}}\nsample: {{method: sobol, count: 2}}\n"
    text = text.replace("sobol, count: 2", "grid") if "[" in values or "count: 3" in values else text
    with pytest.raises(UserError, match="5 ms is a time; an angle is needed"):
        load_study(saved(tmp_path, text, "study.yaml"), DISCOVERY)


def margins(first: str, second: str = "5 ms") -> str:
    """The mended press with other margins."""
    text, old = MENDED.read_text("utf-8"), "margin: {value: 5 ms,"
    assert text.count(old) == 2
    return text.replace(old, f'margin: {{value: "{first}",', 1).replace(old, f'margin: {{value: "{second}",', 1)


@pytest.mark.parametrize(
    ("second", "angle"),
    every(2, [("2 * ${timing.interlocks.0.margin}", 10), ("${timing.interlocks.0.margin}", 5), ("${timing.interlocks.0.margin} + 1 ms", 6),
              ("1 / ${press.productivity} / 100", 1e5 / 6090 * 0.36), ("${drive.swing_angle} / 10", None)]),
)  # fmt: skip
def test_a_margin_may_follow_from_what_is_a_time_or_an_angle(tmp_path: Path, second: str, angle: float | None) -> None:
    press = Press.read(saved(tmp_path, margins("5 ms", second), "press.yaml"), DISCOVERY)
    run = WarmPress(is_advised=False).calculate(press.config).calculations
    asked = run["timing"]["margin_required"][0, 1]
    expected = run["drive"]["swing_angle"].item() / 10 if angle is None else angle * 1e-3 * 2 * np.pi * 6090 / 3600
    assert asked == pytest.approx(expected, rel=1e-9)
    # it takes the place of a reference, in its unit
    first, twice = rows(press.config, "timing.interlocks.1.margin", 0.002, 0.004).columns["timing.margin_required.1"]
    assert twice == pytest.approx(2 * first)


FOUNDED = """
  key:
    kind: parallel_key
    shaft_diameter: {value: 50 mm, basis: drawing}
    key_length: {value: 63 mm, basis: drawing}
    torque: {value: 494 N*m, basis: drawing}
    application_factor: {value: 1, basis: drawing}
    yield_shaft: {value: 650 MPa, basis: drawing}
    yield_hub: {value: %s, basis: measured, note: "protocol 17"}
    brittle_hub: {value: true, basis: measured, note: "protocol 18"}
"""


@pytest.mark.parametrize("first", few(["370 MPa", "370", "0.37 GPa", "370.0 MPa"], keep=lambda first: first == "370"))
@pytest.mark.nightly
def test_a_stored_variant_says_what_its_values_rest_on(tmp_path: Path, first: str) -> None:
    """A certificate is of the value that was measured: the report of another variant does not name it, and `take` says the same."""
    saved(tmp_path, HEAD + FOUNDED % first)
    hubs = "  mechanisms.key.brittle_hub: [true, false]\n"
    text = varied("[370 MPa, 380 MPa]", sample="{method: zip}", path="mechanisms.key.yield_hub", rest=hubs)
    main(["batch", str(saved(tmp_path, text, "study.yaml")), "-o", str(tmp_path / "out"), "--quiet"])
    for variant, basis in enumerate(["measured", "assumed"]):
        tree = variant_config(tmp_path / "out", variant, DISCOVERY, "v")
        taken = yaml.parse(taken_config(tmp_path / "out", variant, DISCOVERY)[0].decode(), "v")
        for key in ("yield_hub", "brittle_hub"):
            place = ("mechanisms", "key", key, "basis")
            assert (tree.typed(place), taken.typed(place)) == (basis, basis), key


@pytest.mark.parametrize(
    ("typed", "basis"),
    [("370 MPa", "measured"), ("0.37 GPa", "measured"), ("371 MPa", "assumed"), ("370 kPa", "assumed")],
)
def test_the_same_number_typed_otherwise_rests_on_what_it_did(tmp_path: Path, typed: str, basis: str) -> None:
    press = Press.read(saved(tmp_path, HEAD + FOUNDED % "370"), DISCOVERY)
    place = ("mechanisms", "key", "yield_hub")
    assert press.with_values({(*place, "value"): typed}).config.tree.typed((*place, "basis")) == basis


def test_a_coefficient_for_all_joints_but_one_is_varied(tmp_path: Path) -> None:
    """It is that of the joints that have none of their own: not theirs alone may be changed."""
    text, common = PLATEN.read_text("utf-8"), "    friction: 0.1 "
    assert text.count(common) == 1
    file = saved(tmp_path, text.replace(common, f"    friction_journal: 0.05\n{common}"), "press.yaml")
    found = require_as_alone(Press.read(file, DISCOVERY), "platen.friction", 0.09, 0.11)
    assert np.diff(found.columns["platen.friction_work"]) > 0
