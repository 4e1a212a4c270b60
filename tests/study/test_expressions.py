"""Expressions of the base in a study: held on arrays, in constraints too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from diecut_report.study.execution.press_batch import CalculatedVariants, calculated
from tests.configs import HEAD
from tests.study.studies import study, varied

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
