"""The questions of docs/questions.md, asked again: each command gives what stands there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.configs import EXAMPLES, STUDIES
from tests.examples import few

GUIDE = Path(__file__).parents[1] / "docs" / "questions.md"
ASKED = re.compile(r"```sh\ndiecut-report ([^\n]*)\n```\n```text\n(.*?)```", re.DOTALL)
QUESTIONS = [(command, answer) for command, answer in ASKED.findall(GUIDE.read_text("utf-8"))]


@pytest.mark.parametrize(("command", "answer"), few(QUESTIONS, lambda each: "press" not in each[0]))
def test_each_question_has_its_true_answer(
    command: str, answer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    (own,) = re.findall(r"`(\w+\.yaml)`, whose.*?```yaml\n(.*?)```", GUIDE.read_text("utf-8"), re.DOTALL)
    (tmp_path / own[0]).write_text(own[1], "utf-8")
    (tmp_path / "configs").mkdir()
    for config in [*EXAMPLES, *STUDIES]:
        (tmp_path / "configs" / config.name).write_bytes(config.read_bytes())
    monkeypatch.setattr("diecut_report.optimisation.command._files", lambda *_: {})  # the page has a test of its own
    monkeypatch.chdir(tmp_path)
    assert main(shlex.split(command)) == (1 if "\n  no value of" in answer else 0)
    assert capfd.readouterr().out == answer


def test_all_commands_of_the_loop_are_asked() -> None:
    assert {command.split()[0] for command, _ in QUESTIONS} == {"solve", "advise", "influence", "optimise"} and len(
        QUESTIONS
    ) >= 7
