"""The help of each command tells with which codes it ends, in both languages."""

from __future__ import annotations

import pytest

from diecut_report.cli.main import main, program

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
