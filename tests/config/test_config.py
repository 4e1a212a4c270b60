"""The config file: its fixed part, the mechanisms' inputs, and every mistake told in words with its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.model import Project
from diecut_report.config.plugins import Discovery
from tests.configs import BROKEN, DISCOVERY, EXAMPLES, GOOD, HEAD, LEVER, MECHANISMS, loaded, problems


def test_texts_are_kept_as_typed(tmp_path: Path) -> None:
    text = LEVER.replace("title: Test", "title: 12.50, document_number: 0012, date: 2026-11-21, revision: 1e5")
    project = loaded(tmp_path, text).project
    kept = (project.title, project.document_number, project.date, project.revision)
    assert kept == ("12.50", "0012", "2026-11-21", "1e5")


def test_project_texts_left_empty_count_as_not_given(tmp_path: Path) -> None:
    project = loaded(tmp_path, LEVER.replace("title: Test", "title: Test, checked_by: ~")).project
    assert project == Project.model_validate({"title": "Test", "revisions": []})


def test_mechanisms_stay_in_the_order_of_the_file(tmp_path: Path) -> None:
    text = HEAD + "  z: {kind: lever, force: 1}\n  a: {kind: lever, force: 1}\n"
    assert list(loaded(tmp_path, text).kinds) == ["z", "a"]


# each: what stands in the lever's braces, and the whole message with its place
INPUTS = [
    ("force: 1, speeed: 50 rpm", "5:30: mechanisms.a.speeed: is an unknown key (did you mean 'speed'?). Known keys: kind, force,"),
    ("force: 1, qqq: 50 rpm", "5:30: mechanisms.a.qqq: is an unknown key. Known keys: kind, force, arm"),
    ("force: 12 kg", "5:27: mechanisms.a.force: 12 kg is a mass; a force is needed, for example"),
    ("force: 1, speed: 50 1/min", "5:37: mechanisms.a.speed: 50 1/min is a frequency; an angular speed is needed, for example"),
    ("force: -3", "5:27: mechanisms.a.force: -3 kN is out of range; allowed: > 0 kN"),
    ("force: 1, arm: 2 m", "5:35: mechanisms.a.arm: 2 m is out of range; allowed: > 0 mm, ≤ 1000 mm"),
    ("force: '1,500 kN'", "5:27: mechanisms.a.force: '1,500 kN' may be 1500 kN or 1.500 kN; write the one that is meant"),
    ("force: .nan", "5:27: mechanisms.a.force: '.nan' does not begin with a finite number; a force is needed"),
    ("force: [1]", "5:27: mechanisms.a.force: is a list; a number or a text such as “10 kN” is needed"),
    ("force: ", "5:27: mechanisms.a.force: has no value; give a number in kN or remove the key"),
    ("arm: 10", "5:3: mechanisms.a.force: is missing. Give it in kN (> 0 kN): Force."),
    ("force: 1, teeth: 20.5", "5:37: mechanisms.a.teeth: 20.5 is not a whole number"),
    ("force: 1, grade: fin", "5:37: mechanisms.a.grade: is “fin” (did you mean 'fine'?); allowed: fine, coarse"),
    ("force: 1, hard: 7", "5:36: mechanisms.a.hard: is 7; true or false is needed"),
    ("force: 1, hard: ", "5:36: mechanisms.a.hard: has no value; true or false is needed, or remove the key"),
    ("force: 1, remark: [x]", "5:38: mechanisms.a.remark: is a list; a text is needed"),
    ("force: 1, parts: 3", "5:37: mechanisms.a.parts: is 3; a list is needed"),
    ("force: 1, parts: [{}]", "5:38: mechanisms.a.parts.0.length: is missing. Give it in mm (> 0 mm): Length of the part."),
    ("force: 1, parts: [{length: 1, lenght: 2}]", "5:50: mechanisms.a.parts.0.lenght: is an unknown key (did you mean 'length'?)"),
    ("force: 1, parts: [{length: 3 s}]", "5:47: mechanisms.a.parts.0.length: 3 s is a time; a length is needed"),
    ("force: 1, spring: 4", "5:38: mechanisms.a.spring: is 4; a block of keys is needed"),
    ("force: 1, spring: {stiffness: 1 mm}", "5:50: mechanisms.a.spring.stiffness: 1 mm is a length;"),
    ("force: 1, load: [1, 2]", "5:36: mechanisms.a.load: has 2 values; a curve needs at least 4 over its period"),
    ("force: 1, n_points: 3", "5:40: mechanisms.a.n_points: 3 is out of range; allowed: ≥ 36, ≤ 100000"),
]  # fmt: skip


@pytest.mark.parametrize(("inner", "message"), INPUTS, ids=[inner for inner, _ in INPUTS])
def test_a_wrong_input_is_told_with_its_place(tmp_path: Path, inner: str, message: str) -> None:
    found = problems(tmp_path, HEAD + f"  a: {{kind: lever, {inner}}}\n")
    assert [line[: len(message)] for line in found] == [message]


# each: a replacement in the text of LEVER, and the message with its place
FIXED = [
    ("schema_version: 1\n", "", "1:1: schema_version: is missing; it is required."),
    ("schema_version: 1", "schema_version: 2", "1:17: schema_version: is 2; allowed: 1"),
    ("schema_version: 1", "schema_version: '1'", "1:17: schema_version: is “1”; the number 1 is needed, without quotes"),
    ("schema_version: 1", "schema_version: true", "1:17: schema_version: is true; the number 1 is needed, without quotes"),
    ("title: Test", "title: '${press.name}'", "2:18: project.title: is “${press.name}”; references stand in press and mechanisms"),
    ("title: Test", "title: T, prepared_by: 'by ${a.x}'", "2:34: project.prepared_by: is “by ${a.x}”; references stand in"),
    ("{length: 700 mm, thickness: 0.6 mm}", "[1, 2]", "3:49: press.sheet: is a list; a block of keys is needed"),
    ("kind: lever", "kind: zzz", f"5:13: mechanisms.a.kind: 'zzz' is not a known kind. Known: {', '.join(DISCOVERY.origins)}."),
    ("title: Test", "revision: A", "2:1: project.title: is missing; it is required: Title of the document."),
    ("title: Test", "title: ''", "2:18: project.title: is empty; give a text"),
    ("title: Test", "title: Test, titel: x", "2:24: project.titel: is an unknown key (did you mean 'title'?). Known keys: title,"),
    ("title: Test", "title: [a]", "2:18: project.title: is a list; a text is needed"),
    ("title: Test", "title: T, language: ukr", "2:31: project.language: is “ukr” (did you mean 'uk'?); allowed: en, uk"),
    ("title: Test", "title: T, revisions: [{by: x}]", "2:33: project.revisions.0.revision: is missing; it is required"),
    ("project: {title: Test}", "project: 5", "2:10: project: is 5; a block of keys is needed"),
    ("name: P, ", "", "3:1: press.name: is missing; it is required: Name of the press."),
    ("6000 1/h", "6000 rpm", "3:32: press.productivity: 6000 rpm is an angular speed; a frequency is needed"),
    ("6000 1/h", "0", "3:32: press.productivity: 0 1/h is out of range; allowed: > 0 1/h"),
    ("thickness", "thicknes", "3:66: press.sheet.thicknes: is an unknown key (did you mean 'thickness'?)"),
    ("mechanisms:", "mechanism:", "4:1: mechanism: is an unknown key (did you mean 'mechanisms'?)"),
    ("kind: lever", "kind: levr", "5:13: mechanisms.a.kind: 'levr' is not a known kind (did you mean 'lever'?). Known: cam_gear_transport,"),
    ("kind: lever, ", "", f"5:3: mechanisms.a.kind: is missing. Give one of: {', '.join(DISCOVERY.origins)}."),
    ("kind: lever", "kind: [lever]", "5:13: mechanisms.a.kind: is a list; the name of a kind is needed"),
    ("  a: {kind: lever, force: 2 kN}", "  a: lever", "5:6: mechanisms.a: is “lever”; a block of keys with its kind is needed"),
    ("  a: {", "  press: {", "5:3: mechanisms.press: the name 'press' is reserved. Choose another one."),
    ("  a: {", "  project: {", "5:3: mechanisms.project: the name 'project' is reserved."),
    ("  a: {", "  2nd: {", "5:3: mechanisms.2nd: “2nd” is not a name: a letter, then letters, digits, _ and - are allowed."),
    ("  a: {", "  a.b: {", "5:3: mechanisms.a.b: “a.b” is not a name"),
    ("\n  a: {kind: lever, force: 2 kN}", " {}", "4:13: mechanisms: has 0 entries; at least 1 needed"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "message"), FIXED, ids=[f"{old.strip()}→{new.strip()}" for old, new, _ in FIXED]
)
def test_a_wrong_fixed_part_is_told_with_its_place(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert LEVER.count(old) == 1
    found = problems(tmp_path, LEVER.replace(old, new))
    assert message in [line[: len(message)] for line in found]


@pytest.mark.parametrize("text", ["[1, 2]", "just a text", "5"])
def test_a_file_that_is_no_block_is_told(tmp_path: Path, text: str) -> None:
    assert [line[:5] for line in problems(tmp_path, text)] == ["1:1: "]
    assert "a block of keys is needed" in problems(tmp_path, text)[0]


def test_all_problems_are_told_at_once_in_the_order_of_the_file(tmp_path: Path) -> None:
    text = (
        LEVER.replace("title: Test", "titel: Test").replace("6000 1/h", "6 kg")
        + "  b: {kind: lever, force: '${a.x}', arm: -1}\n  c: {kind: x}\n"
    )
    places = [line.split(" ")[0] for line in problems(tmp_path, text)]
    assert places == ["2:1:", "2:11:", "3:32:", "6:27:", "6:42:", "7:13:"]


def test_a_default_of_the_press_is_asked_for_in_words(tmp_path: Path) -> None:
    found = problems(tmp_path, LEVER.replace("productivity: 6000 1/h, ", ""))
    assert found == [
        "5:3: mechanisms.a.speed: speed is not given and the press gives no productivity to derive it from; "
        "give speed (r/min) or press.productivity."
    ]


def test_a_broken_plugin_hurts_only_the_configs_that_use_it(tmp_path: Path) -> None:
    discovery = Discovery([GOOD, BROKEN])
    assert not loaded(tmp_path, LEVER, discovery).broken
    config = loaded(
        tmp_path, LEVER + "  b: {kind: breaks_at_import, any: key}\n  c: {kind: lever, force: '${b.x}'}\n", discovery
    )
    assert list(config.broken) == ["b"]
    assert str(config.broken["b"]).startswith("mechanism 'b' of plugin 'breaks_at_import': it cannot be loaded from ")


def test_a_broken_plugin_is_told_beside_the_problems_of_the_file(tmp_path: Path) -> None:
    found = problems(
        tmp_path, LEVER.replace("2 kN", "2 kg") + "  b: {kind: breaks_at_import}\n", Discovery([GOOD, BROKEN])
    )
    assert len(found) == 2 and "mechanism 'b' of plugin 'breaks_at_import'" in found[1]


def test_a_config_without_a_press_is_told_so_also_where_its_mechanisms_have_defaults_from_it(tmp_path: Path) -> None:
    damper = "{kind: damper, kinetic_energy: 150, elastic_modulus: 8, ring_width: 50, pad_height: 30}"
    found = problems(tmp_path, f"schema_version: 1\nproject: {{title: T}}\nmechanisms:\n  a: {damper}\n")
    assert any(": press: is missing" in problem for problem in found)


# Bare numbers that are absurd in their key's unit and usual in another one are asked about; with its unit a number is taken as it is.


TEXT = MECHANISMS.read_text("utf-8")
CRANK, SPAN = "{value: 100 mm, basis: assumed}", "{value: 600 mm, basis: assumed}"
BELT = "{value: 3.5 kW, basis: assumed"


@pytest.mark.parametrize(
    ("typed", "instead", "question"),
    [
        (CRANK, "0.16", "crank_length: is 0.16 without a unit, which is 0.16 mm here; 0.16 m is usual. Write the one that is meant"),
        (CRANK, "'0,16'", "crank_length: is 0.16 without a unit, which is 0.16 mm here; 0.16 m is usual"),
        (CRANK, "{value: 0.16, basis: drawing}", "crank_length.value: is 0.16 without a unit"),
        ("segment_height: 40 mm", "segment_height: 0.04", "segment_height: is 0.04 without a unit, which is 0.04 mm here; 0.04 m is usual"),
        (SPAN, "0.6", "train.vbelt.center_distance: is 0.6 without a unit, which is 0.6 mm here; 0.6 m is usual"),
        (BELT, "{value: 3500, basis: assumed", "power_per_belt.value: is 3500 without a unit, which is 3500 kW here; 3500 W is usual"),
        ("{value: 210 GPa, basis: assumed", "{value: 210000, basis: assumed",
         "is 210000 without a unit, which is 210000 GPa here; 210000 MPa is usual"),
    ],
)  # fmt: skip
def test_a_bare_number_of_another_unit_is_asked_about(typed: str, instead: str, question: str, tmp_path: Path) -> None:
    (told,) = problems(tmp_path, TEXT.replace(typed, instead, 1))
    assert question in told


@pytest.mark.parametrize("instead", ["0.16 mm", "16", "1000", "${cylinder.radius} / 600"])
def test_a_number_with_its_unit_or_near_what_is_usual_is_not(instead: str, tmp_path: Path) -> None:
    loaded(tmp_path, TEXT.replace(CRANK, instead, 1), Discovery())


def test_a_question_hides_no_other_fault_of_the_file(tmp_path: Path) -> None:
    told = problems(tmp_path, TEXT.replace(CRANK, "0.16", 1).replace("bore_radius: 70 mm", "bore_radius: 70 kg", 1))
    assert len(told) == 2 and "is a mass" in told[0] and "0.16 m is usual" in told[1]


def test_a_kind_without_example_and_default_is_not_asked(tmp_path: Path) -> None:
    loaded(tmp_path, TEXT.partition("mechanisms:")[0] + "mechanisms:\n  a: {kind: lever, force: 0.0001}\n", DISCOVERY)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_no_example_is_asked(example: Path) -> None:
    load_config(example, Discovery())
