"""A shell completes commands, kinds, files, mechanisms and inputs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.configs import EXAMPLE, GOOD

KNIFE = str(EXAMPLE.with_name("circular_knife.yaml"))
Capture = pytest.CaptureFixture[str]


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
        (["report", KNIFE, "--only", "kn"], ["knife"]),
        (["report", KNIFE, "--only", "knife,kn"], ["knife,knife"]),
        (["report", "--detail", "b"], ["brief"]),
        (["calc", "--language", "u"], ["uk"]),
        (["solve", KNIFE, "--vary", "knife.e"], ["knife.eccentricity", "knife.edge_radius"]),
        (["solve", KNIFE, "--vary", "press.sheet.t"], ["press.sheet.thickness"]),
        (["advise", KNIFE, "--keep", "knife.d"], ["knife.depth"]),
        (["influence", KNIFE, "--tolerance", "knife.f"], ["knife.front_distance", "knife.friction"]),
        (["solve", "nothing.yaml", "--vary", "knife"], []),
        (["report", "conf"], ["file,conf"]),  # which the shell completes itself
    ],
)
def test_words_are_completed(completed: object, words: list[str], found: list[str]) -> None:
    assert callable(completed)
    assert completed(*words) == found


def test_a_file_with_faults_gives_what_can_be_read_of_it_and_no_message(completed: object, tmp_path: Path) -> None:
    file = tmp_path / "press.yaml"
    file.write_text(Path(KNIFE).read_text("utf-8").replace("cut_length:", "cat_length:"), "utf-8")
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
