"""The JSON Schema takes what the program takes, and catches what an editor should mark."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import jsonschema
import pytest
import yaml

from diecut_report.config.schema import config_schema, kind_schema
from tests.configs import DISCOVERY, EXAMPLES, LEVER


@cache
def schema() -> dict[str, Any]:
    """Return the schema of all kinds."""
    return config_schema({kind: DISCOVERY.mechanism(kind) for kind in DISCOVERY.origins}, {"broken": "it fell over"})


def validator() -> jsonschema.Draft202012Validator:
    """Return what holds a config against it."""
    return jsonschema.Draft202012Validator(schema())


def faults(text: str) -> list[str]:
    """The key paths at which the schema is not met."""
    return sorted({".".join(map(str, error.absolute_path)) for error in validator().iter_errors(yaml.safe_load(text))})


def test_the_schema_is_one() -> None:
    """Of some kinds; that of all is long."""
    some = config_schema({kind: DISCOVERY.mechanism(kind) for kind in ("lever", "clutch")}, {"broken": "it fell over"})
    jsonschema.Draft202012Validator.check_schema(some)
    json.dumps(some, allow_nan=False)


@pytest.mark.nightly
def test_the_schema_of_all_kinds_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(schema())
    json.dumps(schema(), allow_nan=False)


MACHINES = sorted((EXAMPLES[0].parent / "machines").glob("*.yaml"))


@pytest.mark.parametrize("path", [*EXAMPLES, *MACHINES], ids=lambda path: str(path.name))
def test_the_examples_meet_the_schema(path: Any) -> None:
    assert faults(path.read_text("utf-8")) == []


def test_what_the_program_takes_the_schema_takes() -> None:
    inner = (
        "force: ${a.force}, arm: 1e2, grade: coarse, remark: 12, width: 0.3 cm, speed: 50 rpm, teeth: '20', hard: true, "
        "parts: [{length: '${a.arm}'}], spring: {stiffness: 3 N/mm}, load: [1, 2 N*m, '${a.moment}', 4]"
    ).replace("${a.force}", "'${a.force}'")
    assert faults(LEVER + f"  b: {{kind: lever, {inner}}}\n") == []


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ("schema_version: 1", "schema_version: 2", "schema_version"),
        ("title: Test", "titel: Test", "project"),
        ("name: P", "name: P, colour: red", "press"),
        ("6000 1/h", "fast", "press.productivity"),
        ("600", "-600", ""),
        ("kind: lever", "kind: levr", "mechanisms.a.kind"),
        ("kind: lever, ", "", "mechanisms.a"),
        ("  a:", "  press:", "mechanisms"),
        ("  a:", "  1st:", "mechanisms"),
        ("force: 2 kN", "", "mechanisms.a"),
        ("force: 2 kN", "force: 2 kN, forc: 1", "mechanisms.a"),
        ("force: 2 kN", "force: -2", "mechanisms.a.force"),
        ("force: 2 kN", "force: '1,500 kN'", "mechanisms.a.force"),
        ("force: 2 kN", "force: [1]", "mechanisms.a.force"),
        ("force: 2 kN", "force: 1, arm: 1001", "mechanisms.a.arm"),
        ("title: Test", f"title: {'T' * 501}", "project.title"),
        ("force: 2 kN", f"force: 2{'0' * 501} kN", "mechanisms.a.force"),
        ("force: 2 kN", f"force: 1, load: [{'1, ' * 10_001}]", "mechanisms.a.load"),
        ("force: 2 kN", "force: 1, teeth: 20.5", "mechanisms.a.teeth"),
        ("force: 2 kN", "force: 1, grade: medium", "mechanisms.a.grade"),
        ("force: 2 kN", "force: 1, hard: 3", "mechanisms.a.hard"),
        ("force: 2 kN", "force: 1, load: [1, 2]", "mechanisms.a.load"),
        ("force: 2 kN", "force: 1, parts: [{size: 1}]", "mechanisms.a.parts.0"),
        ("force: 2 kN", "force: 'about ${a.arm}'", "mechanisms.a.force"),
        ("force: 2 kN", "force: {value: 2 kN, basis: guessed}", "mechanisms.a.force"),
        ("force: 2 kN", "force: {basis: assumed}", "mechanisms.a.force"),
        ("force: 2 kN", "force: '2 * ${a.arm} + 3 apples and pears'", "mechanisms.a.force"),
        ("force: 2 kN", "force: {value: '2 * sqrt(${a.moment}**2) / 1.5 N*m/kN + 3 kN', basis: assumed, note: n}", ""),
    ],
)
def test_a_mistake_is_caught(old: str, new: str, where: str) -> None:
    if where:
        assert where in faults(LEVER.replace(old, new, 1))
    else:  # bounds of a text with a unit are beyond a schema: the program itself tells
        assert faults(LEVER.replace(old, new, 1)) == []


def test_descriptions_tell_unit_range_and_default() -> None:
    keys = kind_schema(DISCOVERY.mechanism("lever"))["properties"]
    assert (
        keys["arm"]["description"]
        == "Arm. Unit: mm. Allowed: > 0 mm, ≤ 1000 mm. Plausible: 1 µm to 100 m. Default: 100 mm."
    )
    plausible = "Plausible: 0.0001 r/min to 1000000 r/min"
    told = f"Speed. Unit: r/min. Allowed: > 0 r/min. {plausible}. Default: from press.productivity."
    assert keys["speed"]["description"] == told
    told = "Teeth. Unit: none (a pure number). Allowed: ≥ 12. Plausible: 1e-06 to 1000000. Default: 20."
    assert keys["teeth"]["description"] == told


def test_the_schema_of_a_kind_is_that_of_its_block() -> None:
    validator = jsonschema.Draft202012Validator(kind_schema(DISCOVERY.mechanism("lever")))
    assert validator.is_valid({"kind": "lever", "force": 1})
    assert not validator.is_valid({"kind": "cylinder_drive", "force": 1})


def test_of_a_broken_plugin_only_the_kind_is_known() -> None:
    assert faults(LEVER + "  b: {kind: broken, any: key}\n") == []
