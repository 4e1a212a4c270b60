"""Any question to any small machine is answered truly or refused in words, with the exit codes of the help; and single odd ones."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from tests.configs import GOOD, HEAD, PLUGINS, saved
from tests.design.odd_questions import Questions, configs, faults
from tests.examples import few

Capture = pytest.CaptureFixture[str]
MANY, TOGETHER = 300, 12  # questions to each machine at night, and of one test
ROUNDS = [(name, first) for name in configs() for first in range(0, MANY, TOGETHER)]
PRESS = (
    HEAD
    + """\
  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 250 N*m}
  b: {kind: lever, force: 5 kN, arm: 100 mm, allowable_moment: 250 N*m}
  c: {kind: lever, force: 1 kN, arm: "${a.arm} + 20 mm"}
"""
)


@pytest.mark.parametrize(("name", "first"), few(ROUNDS, lambda each: each in [("levers", 0), ("circular_knife", 0)]))
def test_any_question_is_answered_or_refused_in_words(name: str, first: int, tmp_path: Path, capfdbinary: Any) -> None:
    text = configs()[name]
    file = saved(tmp_path, text if isinstance(text, str) else text.read_text("utf-8"), f"{name}.yaml")
    before, questions = file.read_bytes(), Questions(file)
    for seed in range(first, first + TOGETHER):
        command, options = questions.options(random.Random(seed))
        code = main([command, str(file), *options, "--format", "json", "--plugins", str(GOOD)])
        out, err = (stream.decode() for stream in capfdbinary.readouterr())
        assert list(faults(command, code, out, err)) == [], f"seed {seed}: {command} {options}\n{err}"
    assert file.read_bytes() == before and list(tmp_path.iterdir()) == [file]


def test_no_value_with_which_all_passes_is_an_answer_that_names_what_always_fails(
    tmp_path: Path, capfd: Capture
) -> None:
    question = ["--vary", "a.arm", "--for", "max a.arm", "--passing"]
    asked = ["solve", str(saved(tmp_path, PRESS)), *question, "--plugins", str(GOOD)]
    assert main(asked) == 1
    out = capfd.readouterr().out
    assert "no value of a.arm from 33.3333 mm to 300 mm satisfies it" in out
    assert "at any value, b.moment fails: change another input first" in out
    assert main([*asked, "--format", "json"]) == 1
    answer = json.loads(capfd.readouterr().out)
    assert answer["always"] == ["b.moment"] and answer["nearest"]["typed"] == "100 mm"


REFUSED = [  # the command, what it is given, and what is told
    *(("solve", ["--vary", vary, "--for", asked, *more], words) for vary, asked, more, words in [
        ("a.arn", "a.moment = 1 N*m", [], "'arn' is not an input of a (did you mean 'arm'?)"),
        ("a.arm", "a.momemt = 1 N*m", [], "a.momemt is neither a number that a gives nor an input of it (did you mean 'moment'?)"),
        ("a.arm", "d.moment = 1 N*m", [], "there is no mechanism 'd'"),
        ("a.arm", "a.moment = 1 kg", [], "a.moment: 1 kg is a mass"),
        ("a.arm", "a.moment 1", [], "'a.moment 1' is not a question"),
        ("a.arm", "b.moment = 1 N*m", [], "b.moment does not vary with a.arm: it is 500 N·m in the whole range"),
        ("a.arm", "a.moment = 1 N*m", ["--from", "2 m"], "2 m is out of range"),
        ("a.arm", "a.moment = 1 N*m", ["--from", "9 mm", "--to", "8 mm"], "the range from 9 mm to 8 mm is empty"),
        ("a.width", "a.moment = 1 N*m", [], "a.width has no value at present; give the range to search"),
        ("a.grade", "a.moment = 1 N*m", [], "a.moment does not vary with a.grade: it is 200 N·m in the whole range"),
        ("a.grade", "a.moment = 1 N*m", ["--from", "1"], "a.grade: is a text; name those that are to be tried with --among"),
        ("a.arm", "a.moment = 1 N*m", ["--among", "2 g"], "a.arm: 2 g is a mass"),
        ("a.spring.stiffness", "max a.moment", [], "a.spring.stiffness has no value at present"),
        ("a.n_points", "max a.moment", [], "a.n_points only sets how densely curves are listed"),
    ]),
    *(("advise", [each for name in free for each in ("--free", name)] + more, words) for free, more, words in [
        (["a.arm"], ["--keep", "a.arm"], "nothing is free to be changed"),
        (["a.arn"], [], "did you mean 'arm'?"),
        (["c.arm"], [], "c.arm follows from an expression"),
        (["a.width"], [], "a.width has no value at present, or is zero"),
        (["a.remark"], [], "nothing is free to be changed"),
        (["a.n_points"], [], "a.n_points only sets how densely curves are listed"),
    ]),
    *(("influence", more, words) for more, words in [
        (["--of", "a.momemt"], "did you mean 'moment'?"),
        (["--of", "a.width"], "a.width has no value at present"),
        (["--by", "0"], "--by"),
        (["--by", "nan"], "nan is not a number of percent"),
        (["--tolerance", "a.arm"], "'a.arm' is not INPUT=SIZE"),
        (["--tolerance", "a.arm=1 kg"], "a.arm: 1 kg is a mass"),
        (["--tolerance", "a.arm=-1 mm"], "-1 mm is not above zero"),
        (["--tolerance", "a.arm=1 mm", "--tolerance", "mechanisms.a.arm=2 mm"], "a.arm is given more than one tolerance; leave one of them"),
        (["--tolerance", "a.teeth=1"], "a.teeth is a whole number"),
        (["--tolerance", "a.width=1 mm"], "a.width is a whole number or has no value at present"),
    ]),
]  # fmt: skip


@pytest.mark.parametrize(("command", "options", "words"), REFUSED)
def test_bad_input_is_told_and_ends_with_2(
    tmp_path: Path, capfd: Capture, command: str, options: list[str], words: str
) -> None:
    assert main([command, str(saved(tmp_path, PRESS)), *options, "--plugins", str(GOOD)]) == 2
    out, err = capfd.readouterr()
    assert out == "" and words in err


@pytest.mark.parametrize("target", ["press.yaml", "link.yaml", "folder", "press.yaml/new.yaml"])
@pytest.mark.parametrize(
    "command",
    [["solve", "--vary", "b.arm", "--for", "b.moment = 240 N*m"], ["advise"], ["influence"]],
    ids=lambda each: each[0],
)
def test_what_stands_there_is_not_written_over(tmp_path: Path, capfd: Capture, command: list[str], target: str) -> None:
    file = saved(tmp_path, PRESS)
    (tmp_path / "link.yaml").symlink_to(file)
    (tmp_path / "folder").mkdir()
    name, *options = command
    assert main([name, str(file), *options, "-o", str(tmp_path / target), "--plugins", str(GOOD)]) == 2
    out, err = capfd.readouterr()
    assert "Choose another place with -o" in err and out == ""
    assert file.read_text("utf-8") == PRESS
    assert len(list(tmp_path.iterdir())) == 3 and not list((tmp_path / "folder").iterdir())


@pytest.mark.parametrize(
    "command", [["solve", "--vary", "a.length", "--for", "max a.length"], ["advise"], ["influence"]]
)
def test_a_plugin_that_breaks_is_told(tmp_path: Path, capfd: Capture, command: list[str]) -> None:
    file = saved(tmp_path, HEAD + "  a: {kind: breaks_in_calculation, length: 10 mm}\n")
    name, *options = command
    assert main([name, str(file), *options, "--plugins", str(PLUGINS / "broken")]) == 3
    out, err = capfd.readouterr()
    assert out == "" and "breaks_in_calculation" in err


def test_inputs_that_are_not_numbers_may_be_kept(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, PRESS)
    assert main(["advise", str(file), "--keep", "b.hard", "--keep", "a.grade", "--plugins", str(GOOD)]) == 0
    assert "b.arm  100 mm → 50 mm" in capfd.readouterr().out
