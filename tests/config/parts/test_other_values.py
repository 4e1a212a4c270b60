"""Other values in a machine of parts: its parts are made anew with them, and each variant is the file with its values."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report import ConfigError, load
from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.parts.expansion import retyped
from diecut_report.config.parts.reading import SECTION
from diecut_report.config.yaml import parse
from diecut_report.design.inputs import free_input, given_numbers, untied
from diecut_report.design.machines import varied
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.study.analysis.variant_config import variant_config
from diecut_report.study.definition.base_inputs import (
    UnknownPath,
    is_of_parts,
    present_value,
    typed_data,
    typed_place,
    varied_input,
)
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.variant_rows import calculate_rows
from tests.config.parts.machines import CORRECTED, DISCOVERY, FILE, Change, machine
from tests.examples import few

WHOLE = FILE.with_stem("flat_cylinder_corrected")
FOLLOWS = "follows from the parts of the machine"
MADE_WITH = (
    "drive.crank_length", "drive.frame_ratio", "cross.roller_width", "cross.roller_radius", "cross.locking_radius", "clutch.shoe_radius",
    "timing.lines.0.turns_per_sheet",
)  # fmt: skip
FOLLOWING = "drive.pinion_radius", "train.vbelt.count", "shafts_main.sections.0.diameter", "meshes_sector.module"


@cache
def press() -> Press:
    return Press.read(WHOLE, DISCOVERY)


@pytest.mark.parametrize("name", MADE_WITH)
def test_the_parts_follow_what_they_are_made_with(name: str) -> None:
    assert is_of_parts(press().config, varied_input(press().config, f"mechanisms.{name}"))


@pytest.mark.parametrize("name", FOLLOWING)
def test_what_follows_from_the_parts_is_not_varied(name: str) -> None:
    with pytest.raises(UnknownPath, match=FOLLOWS):
        varied_input(press().config, f"mechanisms.{name}")
    if name != "drive.pinion_radius":  # which refers
        with pytest.raises(UserError, match=FOLLOWS):
            free_input(press().config, name)


def test_what_follows_says_where_it_is_typed() -> None:
    with pytest.raises(UnknownPath, match=r"vary shafts\.main\.sections\.0\.diameter in its place"):
        varied_input(press().config, "mechanisms.shafts_main.sections.0.diameter")


def test_a_place_in_a_list_is_the_same_with_a_leading_zero() -> None:
    path = 'of: cross.crank, at: "${timing.lines.01.path_efficiency} / 0.95 * 52 mm"'
    config = machine(("of: cross.crank, at: 52", path), text=CORRECTED).config
    assert is_of_parts(config, varied_input(config, "mechanisms.timing.lines.1.path_efficiency"))


# What stands at the parts themselves.

PLACES = [
    ("shafts.main.sections.2.diameter", "m"), ("shafts.main.sections.2.bore", "m"), ("shafts.main.parts.wheel.hub", "m"),
    ("shafts.main.parts.2.hub", "m"), ("shafts.rocker.parts.arm.pin.span_end", "m"), ("shafts.main.parts.a.designation", None),
    ("shafts.main.parts.a.limiting_speed", "rad/s"), ("shafts.main.allowable_twist", "rad/m"), ("meshes.sector.teeth_2", "1"),
    ("meshes.sector.application_factor", "1"), ("chains.grippers.links", "1"), ("belts.motor.diameter_2", "m"), ("belts.motor.section", None),
    ("machine.required_life", "s"), ("machine.gears.sigma_h_lim", "Pa"), ("machine.frame.motor.1", "m"), ("shafts.motor.motor.speed", "rad/s"),
]  # fmt: skip
NOTHING = "is not a number or text"
NO_PLACES = [
    ("shafts.nope.left", "names no part"), ("shafts", "names no part"), ("shafts.main.sections.4.diameter", "its list is shorter"),
    ("shafts.main.parts.wheel", NOTHING), ("shafts.main.sections", NOTHING), ("machine", NOTHING),
    ("machine.frame.nope.0", "its list is shorter"), ("meshes.sector.nope", NOTHING), ("machine.frame.motor.2", "its list is shorter"),
    ("shafts.main.parts.nope.hub", NOTHING), ("shafts.main.allowable_slope", NOTHING),
]  # fmt: skip


@pytest.mark.parametrize(("path", "unit"), PLACES, ids=[path for path, _ in PLACES])
def test_a_number_or_text_of_a_part_is_varied_by_its_place(path: str, unit: str | None) -> None:
    found = varied_input(press().config, path)
    assert found.unit == unit and is_of_parts(press().config, found)
    assert present_value(press().config, found) is not None or path.endswith("bore")


@pytest.mark.parametrize(("path", "why"), NO_PLACES, ids=[path for path, _ in NO_PLACES])
def test_what_is_no_place_of_a_part_is_told(path: str, why: str) -> None:
    with pytest.raises(UnknownPath, match=why):
        varied_input(press().config, path)


def changed(*changes: Change) -> Press:
    text = CORRECTED
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return Press.read(parse(text, str(FILE)), DISCOVERY)


@pytest.fixture
def study(tmp_path: Path) -> Callable[[str], Path]:
    """What writes a study of the machine into a folder that holds it."""
    (tmp_path / "press.yaml").write_text(CORRECTED, "utf-8")

    def written(text: str) -> Path:
        (tmp_path / "study.yaml").write_text(text, "utf-8")
        return tmp_path / "study.yaml"

    return written


@pytest.mark.nightly
def test_each_machine_of_other_parts_is_the_file_with_these_parts() -> None:
    """Numbers are calculated together, another bearing or what the parts make otherwise by itself; what contradicts itself says so."""
    values: dict[str, list[Any]] = {
        "shafts.main.sections.2.diameter": [0.09, 0.092, 0.092, 0.09],
        "shafts.main.parts.b.designation": ["6217", "6217", "6317", "6217"],
        "meshes.crank_drive.teeth_1": [24, 24, 24, 20],
        "chains.grippers.pretension": [1000, 1200, 1000, 1000],
        "mechanisms.clutch.shoe_radius": [0.14, 0.138, 0.14, 0.14],
        "mechanisms.clutch.wedge_friction": [0.1, 0.1, 0.11, 0.1],
    }
    given = {varied_input(press().config, path): numbers for path, numbers in values.items()}
    arrays = {asked: np.array(numbers, dtype=None if asked.unit else object) for asked, numbers in given.items()}
    rows = calculate_rows(press().config, arrays, 4)
    assert [*rows.errors[:3]] == [None] * 3 and rows.status[3] == "error"
    assert "puts the axes 204 mm apart" in rows.errors[3]
    thick = ("90x330", "92x330")
    files = (
        (thick, ("pretension: 1000", "pretension: 1200"), ("shoe_radius: {value: 140 mm", "shoe_radius: {value: 138 mm")),
        (thick, ('at: 497, designation: "6217"', 'at: 497, designation: "6317"'), ("wedge_friction: 0.1", "wedge_friction: 0.11")),
    )  # fmt: skip
    for row, file in enumerate(files, 1):
        alone = calculate_rows(changed(*file).config, {}, 1)
        assert alone.columns.keys() == rows.columns.keys() and alone.verdict[0] == rows.verdict[row]
        for name, column in alone.columns.items():
            own, there = column[0], rows.columns[name][row]
            if own is None or isinstance(own, str | bool):
                assert own == there, name
            else:
                np.testing.assert_allclose(own, there, rtol=1e-9, atol=1e-12, err_msg=name)


@pytest.mark.nightly
def test_what_is_doubtful_of_the_parts_is_told_of_each_machine() -> None:
    """An odd number of links warns; of the file alone the same."""
    links = varied_input(press().config, "chains.cylinder.links")
    rows = calculate_rows(press().config, {links: np.array([120.0, 121.0, 120.0])}, 3)
    status = "drive_line.checks.parts_fit.status"
    assert list(rows.columns[status]) == [None, "warn", None]
    odd = changed(("teeth: 27, chain: 16B, links: 120", "teeth: 27, chain: 16B, links: 121")).config
    alone = calculate_rows(odd, {}, 1)
    assert alone.columns[status][0] == "warn"


def test_a_script_changes_the_parts_by_their_places() -> None:
    machine = load(WHOLE)
    changes = {
        "shafts.main.sections.2.diameter": "9.2 cm",
        "shafts.main.parts.b.designation": "6317",
        "meshes.main_drive.width": 48,
    }
    other = machine.with_values(changes)
    typed = (
        ("90x330", "92x330"),
        ('"6217", limiting', '"6317", limiting'),
        ("module: 5, width: 50", "module: 5, width: 48"),
    )
    assert other.text == changed(*typed).config.tree.text
    with pytest.raises(ConfigError, match="names no part of the machine"):
        machine.with_values({"shafts.nope.left": 3})
    with pytest.raises(ConfigError, match="has a bore of 85 mm, but sits on a diameter of 86 mm"):
        machine.with_values({"shafts.main.sections.1.diameter": 86})


@pytest.mark.parametrize(
    ("path", "typed", "words"),
    [
        ("shafts.main.sections.2.diameter", "92 g", "92 g is a mass; a length is needed"),
        ("shafts.main.sections.2.diameter", "5.3 deg", "5.3 deg is an angle; a length is needed"),
        ("shafts.main.sections.2.length", "95 mmm", "'mmm' is not a known unit"),
        ("meshes.main_drive.teeth_1", "18 mm", "18 mm is a length; a pure number is needed"),
        ("belts.motor.diameter_1", "125 g", "125 g is a mass; a length is needed"),
    ],
)
def test_a_value_of_another_dimension_is_refused_within_a_text_too(path: str, typed: str, words: str) -> None:
    with pytest.raises(ConfigError, match=re.escape(words)) as refused:
        load(WHOLE).with_values({path: typed, "press.nope": 1})
    assert len(refused.value.problems) == 2  # all that is wrong is told at once


def test_a_number_in_quotes_is_a_number_within_a_text_too() -> None:
    machine = load(WHOLE)
    changes = {"shafts.main.sections.2.diameter": "92", "meshes.main_drive.teeth_1": "18"}
    assert "92x330" in (made := machine.with_values(changes)).text and "teeth: 18/87" in made.text


STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: zip}
vary:
  shafts.main.sections.2.diameter: [90 mm, 92 mm]
  shafts.main.parts.wheel.key: [90 mm, 80 mm]
  meshes.main_drive.teeth_2: [87, 86]
outputs: [shafts_main_body.mass]
"""


@pytest.mark.nightly
def test_a_variant_of_parts_is_taken_as_a_file_that_differs_where_they_are_typed(
    tmp_path: Path, study: Callable[[str], Path]
) -> None:
    file = study(STUDY.replace("teeth_2: [87, 86]", "width: [50 mm, 48 mm]"))
    assert main(["batch", str(file), "-o", str(tmp_path / "out"), "--quiet"]) == 1
    assert main(["take", str(tmp_path / "out#1"), "-o", str(tmp_path / "own.yaml"), "--quiet"]) == 0
    before, after = CORRECTED.splitlines(), (tmp_path / "own.yaml").read_text("utf-8").splitlines()[1:]
    lines = [new for old, new in zip(before, after, strict=True) if old != new]
    assert [re.search("92x330|key: 80 mm|width: 48 mm", line) is not None for line in lines] == [True] * 3
    tree = variant_config(tmp_path / "out", 1, DISCOVERY, "v")
    variant, own = (load_config(each, DISCOVERY).tree.data["mechanisms"] for each in (tree, tmp_path / "own.yaml"))
    assert variant == own


def test_a_part_of_a_measured_machine_that_is_changed_is_not_measured() -> None:
    """Its basis is that of all parts, of which one is another now."""
    measured = changed(("basis: drawing # of the dimensions", "basis: measured # of the dimensions"))
    same = measured.with_values({("shafts", "main", "parts", 2, "at"): "200 mm"})
    other = measured.with_values({("shafts", "main", "parts", 2, "key"): "80 mm"})
    assert [each.config.parts.keys.basis for each in (same, other) if each.config.parts] == ["measured", "assumed"]


def test_the_reason_of_a_machine_names_no_place_of_the_disk() -> None:
    """Where the base is read from is not of the study: equal studies have equal bytes."""
    teeth = varied_input(press().config, "meshes.crank_drive.teeth_1")
    reason = calculate_rows(press().config, {teeth: np.array([20.0])}, 1).errors[0]
    assert "(against base:" in reason and "/" not in reason


DRAWN = """\
schema_version: 1
base: press.yaml
sample: {method: latin_hypercube, count: 6, seed: 2}
vary:
  shafts.main.sections.2.diameter: {from: 90 mm, to: 96 mm}
  shafts.main.sections.2.bore: {from: 0 mm, to: 20 mm}
constraints: ["shafts.main.sections.2.diameter > '91 mm'"]
"""


def test_drawn_numbers_of_one_section_stand_in_its_text_and_a_condition_on_them_is_judged_before(
    study: Callable[[str], Path],
) -> None:
    """Not every millimetre reads back as the metre that it was drawn as; and a path of the parts is no result."""
    drawn = load_study(study(DRAWN), DISCOVERY)
    assert drawn.constraints[0].outputs == ()
    given = drawn.sample.rows(0, 6)
    parts = drawn.base.parts
    assert parts is not None
    for row in range(6):
        drawn_here = ((drawn.inputs[path], float(values[row])) for path, values in given.items())
        own = {typed_place(drawn.base, asked): typed_data(asked, value) for asked, value in drawn_here}
        text = retyped(parts.reader.tree, own).data["shafts"]["main"]["sections"].split(", ")[2]
        matched = SECTION.fullmatch(text)
        assert matched is not None, text
        for name, values in zip(("diameter", "bore"), given.values(), strict=True):
            assert float(matched[name]) / 1e3 == pytest.approx(float(values[row]), rel=1e-15)


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ("{shafts.main.parts.wheel.key: [90 mm], shafts.main.parts.2.key: [80 mm]}", "is the same place as shafts.main.parts.wheel.key"),
        ("{shafts.main.sections.2.diameter: [90 mm], shafts.main.sections.02.diameter: [91 mm]}", "is the same place as"),
    ],
)  # fmt: skip
def test_one_place_is_varied_once(study: Callable[[str], Path], vary: str, words: str) -> None:
    file = study(f"schema_version: 1\nbase: press.yaml\nsample: {{method: zip}}\nvary: {vary}\n")
    with pytest.raises(UserError, match=words):
        load_study(file, DISCOVERY)


def test_a_text_that_is_none_of_those_allowed_is_the_reason_of_its_machine() -> None:
    steel = varied_input(press().config, "machine.shaft_material")
    reason = calculate_rows(press().config, {steel: np.array(["C45+N"], dtype=object)}, 1).errors[0]
    assert "did you mean 'C45E+N'" in reason


def test_a_condition_names_what_is_typed_and_not_what_follows_from_it(study: Callable[[str], Path]) -> None:
    condition = "constraints: [\"{} < '91 mm'\"]\n"
    load_study(study(STUDY + condition.format("shafts.main.sections.2.diameter")), DISCOVERY)
    file = study(STUDY + condition.format("mechanisms.shafts_main.sections.1.diameter"))
    with pytest.raises(UserError, match="follows from the parts of the machine, which vary"):
        load_study(file, DISCOVERY)


@pytest.mark.nightly
def test_a_number_that_parts_are_made_with_makes_them_anew_where_it_is_typed() -> None:
    """The roller of the Geneva drive cuts its wheel: the inertia of the wheel's shaft is that of the changed file."""
    before, place = press(), ("mechanisms", "cross", "roller_radius", "value")
    after = before.with_values({place: "20 mm"})
    inertias = [varied(each.config, {}, 1).columns["shafts_geneva_body.inertia"][0] for each in (before, after)]
    assert inertias[1] > inertias[0] * 1.02
    with pytest.raises(UserError, match="wants the axes of crank and rocker 600 mm apart"):
        before.with_values({("mechanisms", "drive", "crank_length", "value"): "120 mm"})
    with pytest.raises(UserError, match=FOLLOWS):
        before.with_values({("mechanisms", "shafts_main", "sections", 0, "diameter"): "90 mm"})


@pytest.mark.parametrize("file", few([WHOLE, FILE.parents[1] / "flat_cylinder_press_mended.yaml"],
    keep=lambda file: "mended" in file.stem), ids=["parts", "blocks"])  # fmt: skip
def test_a_variant_is_the_file_with_its_value(file: Path) -> None:
    """The linkage moves the timing, and that the play of the Geneva wheel, which plain code asks of the cyclogram."""
    found = Press.read(file, DISCOVERY)
    designs = untied(found.config, given_numbers(found.config))
    design = next(each for each in designs if each.name == "drive.coupler_ratio")
    values = np.array([5.0, 5.1, 5.2])
    rows = varied(found.config, {design.asked: values}, 3)
    for row, value in enumerate(values):
        alone = varied(found.with_values({design.stands: str(value)}).config, {}, 1)
        assert alone.exists[0] and rows.exists[row]
        assert rows.columns.keys() == alone.columns.keys()
        for name, column in rows.columns.items():
            own, other = column[row], alone.columns[name][0]
            if own is None or isinstance(own, str):
                assert own == other, name
            elif name != "timing.clearance_angle":  # which is a place where a curve is flat; residuals are rounding
                assert own == pytest.approx(other, rel=1e-9, abs=1e-9, nan_ok=True), name
