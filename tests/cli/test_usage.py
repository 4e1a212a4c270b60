"""What click says of wrong usage is said in the language that is spoken."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from diecut_report.cli.main import main, program, worded
from diecut_report.text.phrases import Phrase
from tests.configs import EXAMPLE, GOOD

KNIFE = EXAMPLE.with_name("circular_knife.yaml")
WRONG = {
    ("calc",): "Помилка: Бракує аргументу `CONFIG`.",
    ("solve", "x.yaml"): "Помилка: Бракує параметра `--vary`.",
    ("calc", "x.yaml", "--colour"): "Помилка: Параметра `--colour` немає.",
    ("foo",): "Помилка: Команди `foo` немає.",
    ("calc", "x.yaml", "-o"): "Помилка: Параметр `-o` потребує значення.",
    ("calc", "x.yaml", "y.yaml"): "Помилка: Зайві аргументи (y.yaml).",
    ("variants", "x", "--format", "doc"): "Помилка: Хибне значення '--format': `doc` — не одне з: 'table', 'csv', 'json', 'xlsx'.",
    ("variants", "x", "--top", "many"): "Помилка: Хибне значення '--top': `many` — не ціле число.",
    ("influence", "KNIFE", "--tolerance", "knife.depth=-1"): "Помилка: Хибне значення --tolerance: knife.depth: -1 не більше за нуль",
    ("variants", "x", "--top", "0"): "Помилка: Хибне значення '--top': 0 поза межами x>=1.",
}  # fmt: skip


@pytest.mark.parametrize("given", WRONG)
def test_wrong_usage_is_told_in_ukrainian(given: tuple[str, ...], capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["--language", "uk", *(each.replace("KNIFE", str(KNIFE)) for each in given)]) == 2
    said = capfd.readouterr().err.splitlines()
    assert said[-1] == WRONG[given]
    if len(said) > 1:
        assert said[0].startswith("Виклик: diecut-report") and said[1].startswith("Довідка: `diecut-report")
    assert not re.search(r"\b(Try|Error|Missing|Invalid|No such)\b", "\n".join(said))


def test_another_sentence_of_click_stands_as_it_is() -> None:
    assert worded("Something new of click.") == "Something new of click."
    assert isinstance(worded("No such option '-x'."), Phrase)


# The help of each command tells with which codes it ends, in both languages.


COMMANDS = [[], *([name] for name in sorted(program.commands))]
Capture = pytest.CaptureFixture[str]


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: "".join(command) or "program")
def test_the_help_of_a_command_tells_its_exit_codes(command: list[str], capfd: Capture) -> None:
    assert main([*command, "--help"]) == 0
    english = capfd.readouterr().out
    assert main([*command, "--language", "uk", "--help"]) == 0
    ukrainian = capfd.readouterr().out
    words = " ".join(english.split())
    assert words.count("Exit codes") == 1 and ("2 bad" in words or "; 2 " in words or ", 2 " in words)
    assert "Exit codes" not in ukrainian and "Коди завершення" in " ".join(ukrainian.split())


def test_the_help_of_the_program_tells_all_codes(capfd: Capture) -> None:
    assert main(["--help"]) == 0
    told = " ".join(capfd.readouterr().out.partition("Exit codes: ")[2].split())
    assert all(f"{code} " in told for code in (0, 1, 2, 3, 70, 74, 130))


# A shell completes commands, kinds, files, mechanisms and inputs.


KNIFE_FILE = str(EXAMPLE.with_name("circular_knife.yaml"))


@pytest.fixture
def completed(monkeypatch: pytest.MonkeyPatch, capfd: Capture) -> object:
    """What the program gives a shell for words, the last of which is being typed."""

    def asked(*words: str) -> list[str]:
        monkeypatch.setenv("_DIECUT_REPORT_COMPLETE", "bash_complete")
        monkeypatch.setenv("COMP_WORDS", " ".join(["diecut-report", *words]))
        monkeypatch.setenv("COMP_CWORD", str(len(words)))
        with pytest.raises(SystemExit) as end:
            main()
        out, err = capfd.readouterr()
        assert (end.value.code, err) == (0, "")
        return [line.removeprefix("plain,") for line in out.splitlines() if line]

    return asked


@pytest.mark.parametrize(
    ("words", "found"),
    [
        (["inf"], ["influence"]),
        (["new", "clutch", "geneva"], ["geneva_transport"]),
        (["new", "--plugins", str(GOOD), "le"], ["lever"]),
        (["schema", "ge"], ["gear_pair", "geneva_transport"]),
        (["report", KNIFE_FILE, "--only", "kn"], ["knife"]),
        (["report", KNIFE_FILE, "--only", "knife,kn"], ["knife,knife"]),
        (["report", "--detail", "b"], ["brief"]),
        (["calc", "--language", "u"], ["uk"]),
        (["solve", KNIFE_FILE, "--vary", "knife.e"], ["knife.eccentricity", "knife.edge_radius"]),
        (["solve", KNIFE_FILE, "--vary", "press.sheet.t"], ["press.sheet.thickness"]),
        (["advise", KNIFE_FILE, "--keep", "knife.d"], ["knife.depth"]),
        (["influence", KNIFE_FILE, "--tolerance", "knife.f"], ["knife.front_distance", "knife.friction"]),
        (["solve", "nothing.yaml", "--vary", "knife"], []),
        (["report", "conf"], ["file,conf"]),  # which the shell completes itself
    ],
)
def test_words_are_completed(completed: object, words: list[str], found: list[str]) -> None:
    assert callable(completed)
    assert completed(*words) == found


def test_a_file_with_faults_gives_what_can_be_read_of_it_and_no_message(completed: object, tmp_path: Path) -> None:
    file = tmp_path / "press.yaml"
    file.write_text(Path(KNIFE_FILE).read_text("utf-8").replace("cut_length:", "cat_length:"), "utf-8")
    assert callable(completed)
    assert completed("solve", str(file), "--vary", "knife.e") == ["knife.eccentricity", "knife.edge_radius"]
    file.write_text("a: [", "utf-8")
    assert completed("solve", str(file), "--vary", "knife.e") == []


@pytest.mark.nightly
def test_bash_takes_the_script_of_the_documents() -> None:
    folder = Path(sys.executable).parent
    script = (
        'eval "$(_DIECUT_REPORT_COMPLETE=bash_source diecut-report)"\n'
        'COMP_WORDS=(diecut-report new drive_t); COMP_CWORD=2; _diecut_report_completion diecut-report; echo "${COMPREPLY[@]}"'
    )
    commands = (Path(__file__).parents[2] / "docs/commands.md").read_text("utf-8")
    assert script.splitlines()[0] in commands
    done = subprocess.run(
        ["bash", "-c", script],
        env={"PATH": f"{folder}:/usr/bin:/bin"},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert (done.stdout, done.stderr) == ("drive_train\n", "")
