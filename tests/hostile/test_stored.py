"""What stands in the folder of a stored study that no run has put there, and names that are unusual."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from diecut_report.cli.main import main
from tests.configs import GOOD, saved
from tests.study.studies import BASE, STUDY

pytestmark = pytest.mark.usefixtures("without_summary")
Capture = pytest.CaptureFixture[str]


def run(*arguments: object) -> int:
    return main([*map(str, arguments), "--plugins", str(GOOD), "--quiet"])


KINDS, NAMES = ("folder", "pipe", "link"), ("variants/part-00000.parquet", "variants/part-00001.parquet", "study.json")
READ = [(kind, name, ["variants"]) for kind in KINDS for name in NAMES]
RESUMED = [(kind, name, ["batch", "--resume"]) for kind, name in zip(KINDS, NAMES, strict=True)]


@pytest.mark.parametrize(("kind", "name", "command"), [*READ, *RESUMED])
def test_a_part_or_a_state_that_is_no_file_is_refused(
    stored: Path, capfd: Capture, kind: str, name: str, command: list[str]
) -> None:
    file = stored / name
    file.unlink(missing_ok=True)
    {"folder": Path.mkdir, "pipe": os.mkfifo, "link": lambda path: path.symlink_to("/dev/zero")}[kind](file)
    assert run(*command, stored) == 2
    told = "device" if (kind, name) == ("link", "study.json") else kind
    assert f"{file}: This is a {told}" in capfd.readouterr().err


FEW, MORE = ["a\\b", "a[1]"], ["a'b", 'a"b', "a*?", "a#1", "-a", "a\nb", "ä 日", "\x1b[2J"]


@pytest.mark.parametrize("name", [*FEW, *(pytest.param(name, marks=pytest.mark.nightly) for name in MORE)])
def test_a_folder_may_have_any_name(tmp_path: Path, capfd: Capture, name: str) -> None:
    folder = tmp_path / name
    folder.mkdir()
    saved(folder, BASE)
    out = folder / "out"
    assert run("batch", saved(folder, STUDY, "study.yaml"), "-o", out, "--format", "csv,xlsx", "--jobs", 1) == 0
    assert run("variants", out, "--sort", "-a.moment") == 0
    assert "6 variants" in capfd.readouterr().out
    assert run("batch", "--resume", out) == 0
    assert run("calc", f"{out}#1") == 0


def test_a_folder_that_is_not_utf_8_is_refused(tmp_path: Path, capfd: Capture) -> None:
    folder = tmp_path / os.fsdecode(b"a\xffb")
    folder.mkdir()
    saved(folder, BASE)
    assert run("batch", saved(folder, STUDY, "study.yaml"), "-o", folder / "out") == 2
    assert run("variants", folder) == 2
    told = capfd.readouterr().err.splitlines()
    assert len(told) == 2 and all("The name of this folder, or of one above it, is not UTF-8" in line for line in told)


@pytest.mark.parametrize("name", ["a\\b.yaml", "a\nb.yaml", os.fsdecode(b"a\xffb.yaml"), "\x1b[2J.yaml"])
def test_a_configuration_may_have_any_name(tmp_path: Path, capfd: Capture, name: str) -> None:
    assert run("report", saved(tmp_path, BASE, name), "-o", tmp_path / "out", "--format", "html,json") == 0
    assert run("calc", saved(tmp_path, BASE, name)) == 0
    assert capfd.readouterr().out.startswith("{\n")


@pytest.mark.parametrize("now", [0.0, 5e9])
def test_a_clock_that_is_wrong_does_not_hinder_a_workbook(stored: Path, monkeypatch: Any, now: float) -> None:
    monkeypatch.setattr(time, "time", lambda: now)
    assert run("batch", "--resume", stored, "--format", "xlsx") == 0
    sheet = openpyxl.load_workbook(stored / "variants.xlsx").worksheets[0]
    assert sheet.max_row == 7
