"""Constraints between inputs: what they hold on arrays, what they may say, in words what they may not; expressions of the base in a study."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.formulas.condition_parts import Name
from diecut_report.formulas.conditions import ConditionError
from diecut_report.formulas.tree import Node
from diecut_report.study.definition.constraints import Constraint, parse
from diecut_report.study.execution.press_batch import CalculatedVariants, calculated
from tests.configs import HEAD
from tests.study.studies import study, varied

UNITS: dict[str, str | None] = {
    "mechanisms.a.bore": "m", "mechanisms.a.height": "m", "mechanisms.a.speed": "rad/s", "mechanisms.a.law": None,
    "mechanisms.my-drive.gears.0.teeth": "1", "press.productivity": "1/s",
}  # fmt: skip
FIXED = {"mechanisms.a.fixed": ("m", 0.2), "mechanisms.a.grade": (None, "fine")}
ROWS: dict[str, Any] = {
    "mechanisms.a.bore": np.array([0.05, 0.06, 0.07]),
    "mechanisms.a.height": np.array([0.1, 0.09, 0.08]),
    "mechanisms.a.speed": np.array([4.0, 9.0, 11.0]),
    "mechanisms.a.law": ["cycloidal", "harmonic", "cycloidal"],
    "mechanisms.my-drive.gears.0.teeth": np.array([18.0, 20.0, 22.0]),
    "press.productivity": np.array([1.0, 2.0, 3.0]),
}


def find(path: str) -> tuple[Name, Node]:
    if path in UNITS:
        return named(path, UNITS[path]), Node("sym", (path,))
    if path in FIXED:
        si, value = FIXED[path]
        return named(path, si), Node("qty", (value,))
    raise ConditionError(f"“{path}” is unknown")


def named(path: str, si: str | None) -> Name:
    return Name(path, "text") if si is None else Name(path, "number", si)


def read(text: str) -> Constraint:
    return parse(text.replace("bore", "mechanisms.a.bore").replace("height", "mechanisms.a.height")
                 .replace("speed", "mechanisms.a.speed").replace("law", "mechanisms.a.law"), find)  # fmt: skip


HELD = [  # text, and the rows above by hand; what the language means is held in test_conditions
    ("bore <= 0.7 * height", [True, True, False]),
    ("bore < '60 mm'", [True, False, False]),
    ("bore > '55 mm' and speed < '90 rpm'", [False, True, False]),  # 90 rpm are 9.42 rad/s
    ("bore * height > '52 cm**2'", [False, True, True]),
    (
        "speed ** 2 * bore < '6 m/s**2'",
        [True, True, False],
    ),  # the angle of an angular speed may be left out in a product
    ("law == 'cycloidal'", [True, False, True]),
    ("mechanisms.my-drive.gears.0.teeth >= 20", [False, True, True]),
    ("mechanisms.my-drive.gears.0.teeth-2 == 18", [False, True, False]),
    ("press.productivity < '9000 1/h'", [True, True, False]),
    ("bore < 0.3 * mechanisms.a.fixed", [True, False, False]),
    ("bore / (height - '90 mm') < 1 or bore > '65 mm'", [False, False, True]),  # divided by zero is not a value
    ("bore <= '0.06'", [True, True, False]),  # nothing says in which unit people read it, so SI
]


@pytest.mark.parametrize(("text", "held"), HELD, ids=[text for text, _ in HELD])
def test_a_constraint_holds_row_by_row(text: str, held: list[bool]) -> None:
    assert read(text).judged(ROWS).holds.tolist() == held


def test_a_constraint_that_names_one_text_gives_a_value_for_each_row() -> None:
    assert read("law == mechanisms.a.grade").judged(ROWS).holds.tolist() == [False] * 3


def test_the_varied_paths_of_a_constraint_are_told_once() -> None:
    assert read("bore < height * 2 and bore > '1 mm'").paths == ("mechanisms.a.bore", "mechanisms.a.height")


def test_a_constraint_goes_to_another_process() -> None:
    there: Constraint = pickle.loads(pickle.dumps(read("bore <= 0.7 * height")))
    assert there.judged(ROWS).holds.tolist() == [True, True, False]


WRONG = [
    ("bore < 90", "mechanisms.a.bore is a length and 90 is a pure number; < needs the same kind on both sides. "
     "Quote the quantity with its unit."),
    ("bore + speed < '1 m'", "mechanisms.a.bore is a length and mechanisms.a.speed is an angular speed; + needs"),
    ("min(bore, '3 kg') < height", "mechanisms.a.bore is a length and '3 kg' is a mass; min needs the same kind"),
    ("bore < 'wide'", "'wide' does not begin with a finite number; a length is needed, for example"),
    ("bore", "mechanisms.a.bore is not a condition; a comparison is needed, such as mechanisms.NAME.KEY <= '90 mm'."),
    ("law and bore < height", "mechanisms.a.law stands alone; compare it with a text in quotes."),
    ("1 < 2", "“1 < 2” names no varied path, so it would keep all variants or none; name one of vary."),
    ("mechanisms.a.fixed < '1 m'", "names no varied path"),
    ("(bore < height) + 1 < 2", "the calculated side is a condition; a quantity is needed"),
    ("mechanisms.a.nothing < 3", "“mechanisms.a.nothing” is unknown"),
    ("heigth < '3 mm'", "“heigth” is not a path of an input; write the whole path of an input, such as mechanisms.NAME.KEY"),
    ("bore % height < height", "'%' is not allowed here; allowed: names, numbers, quantities and texts in quotes"),
    ("bore.real < height", "“mechanisms.a.bore.real” is unknown"),
    ("abs(x=bore) < height", "“x” is not a path of an input"),
    ("bore < True", "true is a condition; a quantity is needed"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "words"), WRONG, ids=[text[:40] for text, _ in WRONG])
def test_what_a_constraint_may_not_say_is_told_in_words(text: str, words: str) -> None:
    with pytest.raises(ConditionError) as raised:
        read(text)
    assert words in str(raised.value)


BASE = HEAD + (
    "  a: {kind: lever, force: 2 kN, arm: 200 mm}\n"
    "  b: {kind: lever, force: '2 * ${a.force}', arm: '${a.moment} / ${a.force} / 2 + ${press.sheet.length} / 10 - 70 mm', \n"
    "      width: '10 mm * 5 kN / (${a.force} - 3 kN)'}\n"
)
FORCES = np.array([1e3, 2e3, 3e3, 5e3])


def variants(folder: Path) -> CalculatedVariants:
    made = study(folder, varied("[1, 2, 3, 5]"), BASE)
    return calculated(made.base, {made.inputs["mechanisms.a.force"]: FORCES}, len(FORCES))


def test_an_expression_is_calculated_for_all_variants_at_once(tmp_path: Path) -> None:
    moment = variants(tmp_path).calculations["b"].values["moment"][:, 0]
    assert moment[3] == pytest.approx(2 * FORCES[3] * 0.1)


def test_a_variant_without_a_value_is_told_and_leaves_its_neighbours_alone(tmp_path: Path) -> None:
    found = variants(tmp_path).reasons
    assert sorted(found) == [0, 1, 2]
    assert "is out of range" in found[0]  # a width below zero
    template = "mechanisms.b.width: “10 mm * 5 kN / (${a.force} - 3 kN)” has no value: a division by zero"
    assert found[2].startswith(template)


def test_a_constraint_may_name_an_input_that_is_an_expression(tmp_path: Path) -> None:
    base = BASE.replace("2 * ${a.force}", "max(2 * ${a.force}, 4 kN, 1 N)**2 / 4 kN")
    made = study(tmp_path, varied("[1, 2, 3]", rest="constraints: [mechanisms.b.force > '4 kN']\n"), base)
    holds = made.constraints[0].judged({"mechanisms.a.force": np.array([1e3, 2e3, 3e3])}).holds  # 4, 4, 9 kN
    assert holds.tolist() == [False, False, True]
