"""The guide to studies says what the program does: its study can be read, its questions can be asked."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.study.analysis.answers import condition
from diecut_report.study.analysis.variants import columns_of
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.study_run import described
from tests.configs import MECHANISMS, STUDIES, saved

GUIDE = Path(__file__).parents[2] / "docs" / "studies.md"
OF_PRESS = next(path for path in STUDIES if path.stem == "flat_cylinder_study")


@pytest.fixture(scope="module")
def guide() -> str:
    return GUIDE.read_text("utf-8")


def test_its_study_is_valid(tmp_path: Path, guide: str) -> None:
    shutil.copy(MECHANISMS, tmp_path)
    text = guide.split("```yaml\n")[1].partition("```")[0]
    example = load_study(saved(tmp_path, text, "study.yaml"), Discovery([]))
    assert (example.sample.count, len(example.inputs)) == (2000, 5)
    assert example.curves == ("drive.crank_torque", "drive.crank_angle")


def test_its_questions_can_be_asked(guide: str) -> None:
    columns = columns_of(described(load_study(OF_PRESS, Discovery([]))))
    questions = re.findall(r"""`"([^`]*)"`""", guide)
    assert len(questions) == 3
    for question in questions:
        assert condition(question, columns)[0].text


def test_its_commands_are_those_of_the_program(guide: str) -> None:
    commands = re.findall(r"^diecut-report (\w+)", guide, re.MULTILINE)
    assert set(commands) == {"batch", "variants", "report"}
