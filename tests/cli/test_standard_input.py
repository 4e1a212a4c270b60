"""A configuration may come from standard input: - in the place of a file."""

from __future__ import annotations

import codecs
import io
import json
from collections.abc import Callable
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config import yaml
from tests.configs import GOOD, HEAD

Capture = pytest.CaptureFixture[str]
Give = Callable[[bytes], None]
PLUGINS = ("--plugins", str(GOOD))
PRESS = (HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 250 N*m}\n").encode()


@pytest.fixture
def give(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Give:
    """Put bytes on standard input, in a folder of one's own."""
    monkeypatch.chdir(tmp_path)

    def given(content: bytes) -> None:
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(content)))

    return given


def test_calc_gives_the_numbers_of_the_same_file(give: Give, tmp_path: Path, capfd: Capture) -> None:
    (tmp_path / "press.yaml").write_bytes(PRESS)
    assert main(["calc", "press.yaml", *PLUGINS]) == 0
    of_file = json.loads(capfd.readouterr().out)
    give(PRESS)
    assert main(["calc", "-", *PLUGINS]) == 0
    found = json.loads(capfd.readouterr().out)
    assert found["config"] == of_file["config"] | {"file": "stdin.yaml"}
    assert found["mechanisms"] == of_file["mechanisms"]


def test_a_report_is_called_stdin(give: Give, tmp_path: Path) -> None:
    give(PRESS)
    assert main(["report", "-", "-o", "out", "--format", "json", *PLUGINS]) == 0
    assert [file.name for file in (tmp_path / "out").iterdir()] == ["stdin.json"]


@pytest.mark.parametrize("command", ["calc", "validate", "report", "check", "advise"])
def test_errors_name_it_with_line_and_column(give: Give, command: str, capfd: Capture) -> None:
    give(PRESS.replace(b"2 kN", b"2 mm"))
    assert main([command, "-", *PLUGINS]) == 2
    assert "<stdin>:5:27: mechanisms.a.force: " in capfd.readouterr().err


@pytest.mark.nightly
def test_it_is_validated_and_checked_beside_files(give: Give, tmp_path: Path, capfd: Capture) -> None:
    give(PRESS)
    assert main(["validate", "-", *PLUGINS]) == 0
    assert capfd.readouterr().err == "<stdin>: valid\n"
    (tmp_path / "other.yaml").write_bytes(PRESS)
    give(PRESS)
    assert main(["check", "-", "other.yaml", "--jobs", "2", *PLUGINS]) == 0
    lines = capfd.readouterr().out.splitlines()
    assert [line.split()[:2] for line in lines[1:]] == [["<stdin>", "pass"], ["other", "pass"]]


def test_a_study_of_standard_input_is_validated_from_the_current_folder_and_not_run(
    give: Give, tmp_path: Path, capfd: Capture
) -> None:
    (tmp_path / "press.yaml").write_bytes(PRESS)
    study = b"schema_version: 1\nbase: press.yaml\nsample: {method: grid}\nvary: {mechanisms.a.arm: [90 mm, 100 mm]}\n"
    give(study)
    assert main(["validate", "-", *PLUGINS]) == 0
    give(study.replace(b"a.arm", b"a.harm"))
    assert main(["validate", "-", *PLUGINS]) == 2
    assert "<stdin>:4:" in capfd.readouterr().err
    give(study)
    for command in ("batch", "optimise"):
        assert main([command, "-", *PLUGINS]) == 2
        assert "A study is read from a file" in capfd.readouterr().err
    give(codecs.BOM_UTF8 + study.replace(b"\n", b"\r\n"))
    assert main(["validate", "-", "--dry-run", *PLUGINS]) == 0
    assert capfd.readouterr().out.startswith("<stdin>: 2 variants")


def test_solve_writes_what_it_read_with_the_value_alone(give: Give, tmp_path: Path) -> None:
    give(b"\xef\xbb\xbf" + PRESS)
    asked = ["--vary", "a.arm", "--for", "a.moment = 240 N*m", "-o", "new.yaml"]
    assert main(["solve", "-", *asked, *PLUGINS]) == 0
    assert (tmp_path / "new.yaml").read_bytes() == b"\xef\xbb\xbf" + PRESS.replace(b"100 mm", b"120 mm")


def test_relative_files_are_sought_from_the_current_folder(give: Give, tmp_path: Path, capfd: Capture) -> None:
    with_tables = PRESS.replace(b"press:", b"materials: data/own.yaml\npress:")
    give(with_tables)
    assert main(["validate", "-", *PLUGINS]) == 2
    assert "data/own.yaml" in capfd.readouterr().err
    (tmp_path / "data").mkdir()
    entry = "source: Works standard\ngear_materials: {own: {sigma_h_lim: 1500 MPa, sigma_f_lim: 500 MPa}}\n"
    (tmp_path / "data" / "own.yaml").write_text(entry, "utf-8")
    give(with_tables)
    assert main(["validate", "-", *PLUGINS]) == 0


def test_what_is_too_much_closed_or_asked_for_twice_is_refused(
    give: Give, monkeypatch: pytest.MonkeyPatch, capfd: Capture
) -> None:
    give(b"#" * (yaml.MAX_BYTES + 1))
    assert main(["calc", "-"]) == 2
    give(PRESS)
    assert main(["diff", "-", "-", *PLUGINS]) == 2
    monkeypatch.setattr("sys.stdin", None)
    assert main(["calc", "-"]) == 2
    assert capfd.readouterr().err.splitlines() == [
        "<stdin>: Standard input holds more than 5 MB, which is the most that is read.",
        "<stdin>: Standard input has already been read; give - only once, with files beside it.",
        "<stdin>: Standard input is closed. Name a file.",
    ]


@pytest.mark.parametrize(
    ("command", "begins"),
    [
        (["calc", "press.yaml"], "{"),
        (["diff", "press.yaml", "press.yaml"], "old  press.yaml"),
        (["influence", "press.yaml"], "a.checks.moment.utilisation, at present"),
        (
            ["solve", "press.yaml", "--vary", "a.arm", "--for", "a.moment = 240 N*m"],
            PRESS.decode().replace("100 mm", "120 mm"),
        ),
        (["advise", "press.yaml", "--free", "a.arm"], PRESS.decode().replace("100 mm", "83 mm")),
    ],
)
def test_a_dash_as_output_is_standard_output(
    command: list[str], begins: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Capture
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "press.yaml").write_bytes(PRESS.replace(b"2 kN", b"3 kN") if command[0] == "advise" else PRESS)
    begins = begins.replace("2 kN", "3 kN") if command[0] == "advise" else begins
    assert main([*command, "-o", "-", *PLUGINS]) == 0
    out, err = capfd.readouterr()
    assert out.startswith(begins) and [file.name for file in tmp_path.iterdir()] == ["press.yaml"]
    if command[0] in ("solve", "advise"):
        assert out == begins and "recalculated as a single machine" in err
