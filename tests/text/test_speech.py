"""What is said in the language that is spoken: phrases, numbers of things, messages of the command line."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.errors import PluginError, Problem, nearest
from diecut_report.text.phrases import Counted, Phrase
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted, speaking, spoken_language
from tests.cli.test_cli import Capture, run

VARIANTS = ("{n} variant", "{n} variants")
BAD = "schema_version: 1\npress: {name: P}\nmechanisms:\n  a: {kind: circular_knife, depth: 5 kg}\n"


@pytest.mark.parametrize(
    ("count", "words"), [(1, "1 варіант"), (3, "3 варіанти"), (5, "5 варіантів"), (21, "21 варіант")]
)
def test_a_number_of_things_has_the_form_that_its_language_wants(count: int, words: str) -> None:
    assert say_counted(count, *VARIANTS) == f"{count} variant{'s' * (count != 1)}"
    with speaking("uk"):
        assert say_counted(count, *VARIANTS) == words


def test_a_counted_phrase_keeps_its_number_through_pickle() -> None:
    copy = pickle.loads(pickle.dumps(Counted(3, *VARIANTS)))
    with speaking("uk"):
        assert said(copy) == "3 варіанти"


def test_a_language_holds_within_its_block_alone() -> None:
    with speaking("uk"):
        assert (spoken_language(), decimal_sign(), say("Everything agrees.")) == ("uk", ",", "Усе збігається.")
        assert localised("0.5 … 1.25") == "0,5 … 1,25"
        with speaking("en"):
            assert say("Everything agrees.") == "Everything agrees."
    assert (spoken_language(), localised("0.5")) == ("en", "0.5")


def test_a_problem_is_said_with_its_place_and_what_was_typed_as_it_stands() -> None:
    message = Phrase(
        "is {given}{near}; allowed: {choices}", given="1.5", near=nearest("masss", ["mass"]), choices="mass"
    )
    problem = Problem(message, "press.2.yaml", 3, 5, "a.b")
    assert str(problem) == "press.2.yaml:3:5: a.b: is 1.5 (did you mean 'mass'?); allowed: mass"
    with speaking("uk"):
        assert said(str(problem)) == "press.2.yaml:3:5: a.b: задано 1.5 (можливо, 'mass'?); допустимі: mass"
        assert said(str(PluginError("oh", "clutch", "a"))) == "механізм 'a', плагін 'clutch': oh"


def test_errors_name_file_line_and_key_in_ukrainian(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "bad.yaml"
    file.write_text(BAD, "utf-8")
    assert run("validate", file, "--language", "uk") == 2
    told = capfd.readouterr().err.splitlines()
    assert f"{file}:4:36: mechanisms.a.depth: 5 kg — це маса; потрібно: довжина, наприклад" in "\n".join(told)
    assert any(line.endswith("edge_radius: не задано. Задати в mm (> 0 mm): Радіус леза відносно його центра (більший за ексцентриситет).")
               for line in told)  # fmt: skip


@pytest.mark.parametrize(
    ("variable", "value", "words"),
    [
        ("DIECUT_REPORT_LANGUAGE", "uk", "помилок немає"),
        ("LC_ALL", "uk_UA.UTF-8", "помилок немає"),
        ("LANG", "de_DE", "valid"),
    ],
)
def test_the_environment_chooses_the_language_of_messages(
    variable: str, value: str, words: str, monkeypatch: pytest.MonkeyPatch, capfd: Capture
) -> None:
    for name in ("DIECUT_REPORT_LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv(variable, value)
    assert run("validate", Path(__file__).parents[2] / "configs" / "circular_knife.yaml") == 0
    assert words in capfd.readouterr().err
    assert spoken_language() == "en"


def test_a_variable_that_names_no_known_language_is_told(monkeypatch: pytest.MonkeyPatch, capfd: Capture) -> None:
    monkeypatch.setenv("DIECUT_REPORT_LANGUAGE", "de")
    assert run("plugins") == 2
    assert (
        "DIECUT_REPORT_LANGUAGE: The language is 'de', of which the program has no catalogue" in capfd.readouterr().err
    )


def test_help_is_ukrainian(capfd: Capture) -> None:
    assert main(["--language", "uk", "--help"]) == 0
    said_there = capfd.readouterr().out
    assert "Виклик:" in said_there and "Команди:" in said_there and "Порівн" not in said_there.split("Команди:")[0]
    assert "Options" not in said_there and "Show" not in said_there
