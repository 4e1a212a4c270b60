"""The questions of docs/questions.md, asked again: each command gives what stands there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.config.parts.machines import FILE
from tests.configs import EXAMPLES, STUDIES
from tests.examples import few

GUIDE = Path(__file__).parents[1] / "docs" / "questions.md"
ASKED = re.compile(r"```sh\ndiecut-report ([^\n]*)\n```\n```text\n(.*?)```", re.DOTALL)
QUESTIONS = [(command, answer) for command, answer in ASKED.findall(GUIDE.read_text("utf-8"))]


ADDRESS = "http://127.0.0.1:PORT/SECRET/"
SEARCHED = "optimise"  # what is asked of its folder is asked after it
TIMES = re.compile(r"(?m)^  time: .*")


def after_search(command: str) -> bool:
    return command.startswith((SEARCHED, "variants", "take"))


ALONE = [each for each in QUESTIONS if not after_search(each[0])]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the example configurations, and those that the guide shows."""
    (own,) = re.findall(r"`(\w+\.yaml)`, whose.*?```yaml\n(.*?)```", GUIDE.read_text("utf-8"), re.DOTALL)
    (tmp_path / own[0]).write_text(own[1], "utf-8")
    (tmp_path / "configs" / "machines").mkdir(parents=True)
    for config in [*EXAMPLES, *STUDIES]:
        (tmp_path / "configs" / config.name).write_bytes(config.read_bytes())
    for machine in FILE.parent.glob("*.yaml"):
        (tmp_path / "configs" / "machines" / machine.name).write_bytes(machine.read_bytes())
    monkeypatch.setattr(
        "diecut_report.design.optimisation.command._files", lambda *_: {}
    )  # the page has a test of its own
    monkeypatch.setattr("diecut_report.live.server.serve", lambda _app, _port, ready: ready(ADDRESS))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def asked(command: str, answer: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(shlex.split(command)) == (1 if "\n  no value of" in answer else 0)
    told = capfd.readouterr()
    assert TIMES.sub("", answer) in (TIMES.sub("", told.out.lstrip("\n")), told.err)


@pytest.mark.parametrize(
    ("command", "answer"), few(ALONE, lambda each: "press" not in each[0] and "corrected" not in each[0])
)
def test_each_question_has_its_true_answer(
    command: str, answer: str, folder: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    if command.startswith("live"):
        (folder / command.split()[1]).write_bytes((folder / "configs" / "circular_knife.yaml").read_bytes())
    asked(command, answer, capfd)


def test_what_is_asked_of_a_search_has_its_true_answer(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    for command, answer in QUESTIONS:
        if after_search(command):
            asked(command, answer, capfd)


def test_all_commands_of_the_loop_are_asked() -> None:
    known = {command.split()[0] for command, _ in QUESTIONS}
    assert known == {"new", "live", "solve", "advise", "optimise", "validate", "variants", "take", "influence"}
    kinds = [re.search(r'--for "(.*?)"', command) for command, _ in QUESTIONS if command.startswith("solve")]
    told = " ".join(kind[1] for kind in kinds if kind)
    assert all(sign in told for sign in (" = ", " <= ", "max ", "min "))
