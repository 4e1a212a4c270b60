"""Arithmetic between values of a configuration: what it gives, and every mistake in it."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from diecut_report.errors import UserError
from diecut_report.press import Press
from tests.config.test_references import inputs, results
from tests.configs import DISCOVERY, EXAMPLE, LEVER, loaded, problems, saved

# what stands at the key arm of a second lever, and its length in metres; the sheet is 700 mm, the first lever's arm 100 mm
GIVES = [
    ("${press.sheet.length} + 110 mm", 0.81),
    ("110 mm+${press.sheet.length}", 0.81),
    ("(${press.sheet.length} - 10 cm) / 2", 0.3),
    ("${press.sheet.length} - 10 cm / 2", 0.65),
    ("-2**2 * ${a.arm} + 500 mm", 0.1),  # as in Python: -4
    ("2**3**2 * ${press.sheet.thickness}", 0.3072),  # 2**(3**2)
    ("${a.arm} / 2 / 5", 0.01),
    ("${a.arm} ^ 2 / 20 mm", 0.5),
    ("max(${a.arm}, 2 cm, 120 mm)", 0.12),
    ("min(${a.arm}, 2 cm)", 0.02),
    ("sqrt(${a.arm}**2 + (240 mm)**2)", 0.26),
    ("abs(2 cm - ${a.arm})", 0.08),
    ("${a.moment} / ${a.force}", 0.1),  # N·m over N
    ("${a.moment} / 25 N/mm / 1 m", 0.008),  # 200 N·m over a force per length, the unit whole
    ("2 mm*${a.teeth}", 0.04),
    ("1e3 mm * 50 % / ${a.teeth}", 0.025),
    ("${a.speed} * 1 s * 1 mm / 1 rad", 100 / 60 * 2 * math.pi / 1000),
    ("${a.speed} * 1 s * 1 mm", 100 / 60 * 2 * math.pi / 1000),  # beside a length the radian drops, as in formulas
]


@pytest.mark.parametrize(("text", "metres"), GIVES, ids=[text for text, _ in GIVES])
def test_an_expression_gives_its_value(tmp_path: Path, text: str, metres: float) -> None:
    assert inputs(tmp_path, LEVER + f"  b: {{kind: lever, force: 1, arm: '{text}'}}\n")["arm"] == pytest.approx(metres)


def test_the_energy_and_the_speed_give_an_inertia_without_radians(tmp_path: Path) -> None:
    asked = "2 * ${a.moment} * (1 rad)**2 / (${a.speed} * 1 s)**2"
    text = LEVER + f"  b: {{kind: lever, force: 1, allowable_moment: '{asked}'}}\n"
    assert inputs(tmp_path, text)["allowable_moment"] == pytest.approx(2 * 200 / (100 / 60 * 2 * math.pi) ** 2)


def test_expressions_follow_each_other_whatever_their_order(tmp_path: Path) -> None:
    later = "  c: {kind: lever, force: 1, arm: '${a.moment} / ${a.force} * 4'}\n"
    text = LEVER + "  b: {kind: lever, force: 1, arm: '${c.arm} / 2'}\n" + later
    assert inputs(tmp_path, text)["arm"] == pytest.approx(0.2)


def test_the_results_keep_an_expression_beside_its_value(tmp_path: Path) -> None:
    text = LEVER + "  b: {kind: lever, force: 1, arm: '${press.sheet.length} - ${a.arm}'}\n"
    found = results(tmp_path, text).mechanisms["b"].inputs["arm"]
    assert (found.origin, found.text) == ("expression", "${press.sheet.length} - ${a.arm}")
    assert found.paths == ["press.sheet.length", "a.arm"]
    assert found.value == pytest.approx(0.6)


def test_the_resolved_config_holds_the_value_exactly(tmp_path: Path) -> None:
    text = LEVER + "  b: {kind: lever, force: 1, arm: '${press.sheet.length} / 3'}\n"
    found = results(tmp_path, text)
    path = saved(tmp_path, json.dumps(found.config.resolved), "again.yaml")
    again = Press.read(path, DISCOVERY).calculate().results
    assert again.mechanisms["b"].inputs["arm"].value == found.mechanisms["b"].inputs["arm"].value


def test_the_press_may_calculate_and_lists_and_blocks_may_too(tmp_path: Path) -> None:
    text = LEVER.replace("thickness: 0.6 mm", "width: '${press.sheet.length} * 2/3'") + (
        "  b: {kind: lever, force: 1, arm: '${press.sheet.width}', parts: [{length: '${a.arm} / 4'}], "
        "load: [1, '${a.moment} / 2', 3, 4]}\n"
    )
    found = results(tmp_path, text).mechanisms["b"]
    assert found.inputs["arm"].value == pytest.approx(0.7 * 2 / 3)
    assert found.inputs["parts.0.length"].value == pytest.approx(0.025)
    assert found.outputs["taken_max"].value == pytest.approx(100)


# each: the inner part of a second lever, and the problem with its place
WRONG = [
    ("arm: '${a.arm} + 110'", "6:47: mechanisms.b.arm: ${a.arm} is a length and 110 is a pure number; the number 110 beside"),
    ("arm: '${a.arm} + ${a.force}'", "6:47: mechanisms.b.arm: ${a.arm} is a length and ${a.force} is a force; + needs"),
    ("arm: '${a.arm} * 2 mm'", "6:35: mechanisms.b.arm: “${a.arm} * 2 mm” gives an area; a length in mm is needed here"),
    ("speed: '${press.productivity} * 2'",
     "6:37: mechanisms.b.speed: “${press.productivity} * 2” gives a frequency; an angular speed in rpm is needed here"),
    ("arm: '${a.arm} + ${a.ar}'", "6:47: mechanisms.b.arm: ${a.ar}: a has no 'ar' (did you mean 'arm'?)."),
    ("arm: '${a.arm} + ${c.arm}'", "6:47: mechanisms.b.arm: ${c.arm}: there is no mechanism 'c'."),
    ("arm: '${a.arm} / 0'", "6:35: mechanisms.b.arm: “${a.arm} / 0” divides by zero"),
    ("arm: '2 mm + ${a.arm} * (${a.teeth} - 20) / (${a.teeth} - 20)'", "divides by zero, where (in SI) ${a.arm} is 0.1, ${a.teeth} is 20."),
    ("arm: 'sqrt(${a.arm} * -2 m)'", "takes the root of a number below zero"),
    ("arm: '${a.arm} * 9**400'", "gives a number that is too large to calculate with"),
    ("arm: '${a.arm} * 200'", "6:35: mechanisms.b.arm: 20000 mm (from ${a.arm} * 200) is out of range; allowed: > 0 mm, ≤ 1000 mm"),
    ("arm: '${a.arm} * 1e-9'", "is not plausible"),
    ("arm: '${a.arm} + 0,5 mm'", "6:47: mechanisms.b.arm: “0,5” holds a comma; write a decimal point"),
    ("arm: 'max(${a.arm}, 0,5 mm)'", "“0,5” holds a comma"),
    ("arm: '${a.arm} + 5 mn'", "'mn' is not a known unit"),
    ("arm: '(${a.arm} + 5 mm'", "')' is missing before the end."),
    ("arm: '${a.arm} +'", "is missing before the end."),
    ("arm: '${a.arm} */ 2'", "a reference, a number or a quantity is missing before '/'."),
    ("arm: '${a.arm}" + "**1" * 120 + "'", "the expression is nested deeper than 100 levels"),
    ("arm: '${a.arm} mm'", "'mm' is not expected here"),
    ("arm: '${a.arm} < 3'", "is not allowed here; allowed: references, numbers"),
    ("arm: '${a.arm} and ${a.arm}'", "'and' is not expected here"),
    ("arm: 'cbrt(${a.arm})'", "there is no function 'cbrt'"),
    ("arm: '${a.arm}**0.5'", "the exponent 0.5 is not a whole number"),
    ("arm: '${a.arm} * 2**${a.teeth}'", "is not a whole number that is written here"),
    ("arm: '${a.torque} * 2'", "${a.torque} is a curve; single numbers are needed to calculate with."),
    ("arm: '${press.name} * 2'", "${press.name} is not a number"),
    ("load: '${a.torque} * 2'", "“${a.torque} * 2” calculates a number; a curve is needed here"),
    ("teeth: '${a.teeth} / 16 * 21'", "is not a whole number"),
    ("arm: '${a.arm} + ${b.arm}'", "mechanisms.b.arm: refers to itself: b.arm → b.arm."),
    ("arm: '${a.arm} + ${b.moment} / 1 N'", "refers to itself: b.arm → b.moment → b.arm."),
    ("grade: '${a.grade} + ${a.arm}'", "mixes a reference with text"),
    ("armm: '${a.arm} + 2 mm'", "is an unknown key"),
    (f"arm: '{'(' * 50}${{a.arm}}{')' * 50}'", "brackets stand too deep in each other. Write it in a simpler way."),
    (f"arm: '${{a.arm}}{' + 1 mm' * 100}'", "has 708 characters; at most 500 are allowed"),
]  # fmt: skip


@pytest.mark.parametrize(("inner", "message"), WRONG, ids=[message for _, message in WRONG])
def test_a_wrong_expression_is_told_with_its_place(tmp_path: Path, inner: str, message: str) -> None:
    text = LEVER + f"  b: {{kind: lever, force: 1, {inner}}}\n"
    with pytest.raises(UserError) as caught:
        Press.read(saved(tmp_path, text), DISCOVERY).calculate()
    told = "\n".join(map(str, caught.value.problems))
    assert message in told.replace(f"{tmp_path / 'press.yaml'}:", "")


def test_the_place_in_an_expression_counts_without_quotes_too(tmp_path: Path) -> None:
    text = LEVER + "  b:\n    kind: lever\n    force: 1\n    arm: ${a.arm} / 2 + 3\n"
    assert problems(tmp_path, text)[0].startswith("9:25: mechanisms.b.arm: ")  # the 3


def test_a_reference_alone_keeps_its_type(tmp_path: Path) -> None:
    config = loaded(tmp_path, LEVER + "  b: {kind: lever, force: 1, load: ' ${a.torque} '}\n")
    assert config.links["b", "load"].is_curve


def test_a_reference_without_quotes_within_braces_is_told(tmp_path: Path) -> None:
    found = problems(tmp_path, LEVER + "  b: {kind: lever, force: ${a.force}}\n")
    assert "YAML reads its brace as a map. Quote it" in found[0]


@pytest.mark.nightly
def test_lengths_are_typed_in_place_of_the_ratios_of_a_linkage(tmp_path: Path) -> None:
    file = EXAMPLE.with_name("flat_cylinder_mechanisms.yaml")
    text = file.read_text("utf-8")
    for name, ratio, length in (("frame", "5", 500), ("coupler", "5", 500), ("rocker", "2.05", 205)):
        assert f"{name}_ratio: {ratio}\n" in text
        text = text.replace(f"{name}_ratio: {ratio}\n", f"{name}_ratio: {length} mm / ${{drive.crank_length}}\n")
    given, typed = (
        Press.read(each, DISCOVERY).calculate().results.mechanisms["drive"].outputs
        for each in (file, saved(tmp_path, text))
    )
    assert typed.keys() == given.keys()
    for name, each in given.items():
        assert typed[name].value == (
            pytest.approx(each.value, rel=1e-9) if isinstance(each.value, float) else each.value
        ), name
