"""A PDF leaves nothing among the temporary files, and is told in words where there is no room for them."""

from __future__ import annotations

import errno
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from diecut_report.cli.output import UNWRITABLE
from tests.configs import SMALL, saved
from tests.hostile.test_surroundings import PROGRAM, ran


@pytest.mark.parametrize("command", ["report", "render", "verify"])
def test_a_pdf_leaves_nothing_among_the_temporary_files(tmp_path: Path, small_report: Path, command: str) -> None:
    """By the program itself, which ends at once and lets no library put its things in order."""
    (tmp_path / "tmp").mkdir()
    (tmp_path / "press").mkdir()
    config = saved(tmp_path / "press", SMALL)
    given = {"report": [config, "--format", "pdf"], "render": [small_report / "small.json", "--format", "pdf"],
             "verify": [small_report / "small.pdf"]}[command]  # fmt: skip
    written = [] if command == "verify" else ["-o", "out"]
    ran(tmp_path / "press", [*PROGRAM, command, *map(str, given), *written, "--quiet"], TMPDIR=str(tmp_path / "tmp"))
    assert [*(tmp_path / "tmp").iterdir()] == []


@pytest.mark.parametrize("command", ["report", "render", "verify"])
def test_no_room_for_the_files_of_fonts_is_told(
    tmp_path: Path, small_report: Path, command: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    write_bytes = Path.write_bytes

    def full(path: Path, content: Any) -> int:
        if "weasyprint-" in str(path):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write_bytes(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    given = {"report": [saved(tmp_path, SMALL), "-o", tmp_path / "out"], "render": [small_report / "small.json", "-o", tmp_path / "out"],
             "verify": [small_report / "small.pdf"]}[command]  # fmt: skip
    assert main([command, *map(str, given), "--quiet"]) == UNWRITABLE
    said = capfd.readouterr().err
    assert (
        "the disk is full. Nothing was written; free disk space, or name another folder in the variable TMPDIR." in said
    )
    assert "Traceback" not in said and not (tmp_path / "out").exists()


def test_no_folder_for_temporary_files_is_told(
    small_report: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def none() -> str:
        raise FileNotFoundError(errno.ENOENT, "No usable temporary directory found in ['/tmp']")

    command = ["render", small_report / "small.json", "-o", tmp_path / "out", "--format", "pdf", "--quiet"]
    with monkeypatch.context() as patch:
        patch.setattr(tempfile, "gettempdir", none)
        assert main([*map(str, command)]) == UNWRITABLE
    assert "No folder for temporary files has enough free space." in capfd.readouterr().err


@pytest.mark.parametrize("variable", ["HOME", "XDG_CACHE_HOME", "MPLCONFIGDIR"])
def test_folders_of_the_user_that_cannot_be_written_are_done_without_in_silence(tmp_path: Path, variable: str) -> None:
    (tmp_path / "tmp").mkdir()
    config = saved(tmp_path, SMALL)
    surroundings = {
        key: value
        for key, value in os.environ.items()
        if key not in ("XDG_CACHE_HOME", "XDG_CONFIG_HOME", "MPLCONFIGDIR")
    }
    surroundings |= {"TMPDIR": str(tmp_path / "tmp"), variable: "/dev/null"}
    command = [*PROGRAM, "report", str(config), "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]
    done = subprocess.run(command, env=surroundings, capture_output=True, text=True, check=False, timeout=120)
    told = [line for line in done.stderr.splitlines() if not line.startswith("not checked")]
    assert (done.returncode, told, [*(tmp_path / "tmp").iterdir()]) == (0, [], [])
