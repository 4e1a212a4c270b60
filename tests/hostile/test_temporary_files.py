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
from tests.examples import few
from tests.hostile.test_surroundings import PROGRAM, ran


# `report` and `render` set pages by the same call; `verify` has them set beside its own files
@pytest.mark.nightly
@pytest.mark.parametrize("command", few(["render", "verify"], keep=lambda command: command == "render"))
def test_a_pdf_leaves_nothing_among_the_temporary_files(tmp_path: Path, small_report: Path, command: str) -> None:
    """By the program itself, which ends at once and lets no library put its things in order."""
    (tmp_path / "tmp").mkdir()
    given = {
        "render": [small_report / "small.json", "--format", "pdf", "-o", "out"],
        "verify": [small_report / "small.pdf"],
    }[command]
    ran(tmp_path, [*PROGRAM, command, *map(str, given), "--quiet"], TMPDIR=str(tmp_path / "tmp"))
    assert [*(tmp_path / "tmp").iterdir()] == [] and (tmp_path / "out").exists() == (command == "render")


@pytest.mark.parametrize("command", few(["report", "render", "verify"], keep=lambda command: command == "report"))
@pytest.mark.nightly
def test_no_room_for_the_files_of_fonts_is_told(
    tmp_path: Path, small_report: Path, command: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    write_bytes = Path.write_bytes

    def full(path: Path, content: Any) -> int:
        if "weasyprint-" in str(path):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write_bytes(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    out = ["-o", tmp_path / "out", "--format", "pdf"]
    given = {"report": [saved(tmp_path, SMALL), *out], "render": [small_report / "small.json", *out],
             "verify": [small_report / "small.pdf"]}[command]  # fmt: skip
    assert main([command, *map(str, given), "--quiet"]) == UNWRITABLE
    said, words = (
        capfd.readouterr().err,
        "the disk is full. Nothing was written; free disk space, or name another folder",
    )
    assert f"{words} in the variable TMPDIR." in said and "Traceback" not in said and not (tmp_path / "out").exists()


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


@pytest.mark.nightly
@pytest.mark.parametrize(
    "variables", few([["HOME"], ["XDG_CACHE_HOME", "MPLCONFIGDIR"]], keep=lambda each: len(each) > 1), ids=" ".join
)
def test_folders_of_the_user_that_cannot_be_written_are_done_without_in_silence(
    tmp_path: Path, variables: list[str]
) -> None:
    (tmp_path / "tmp").mkdir()
    config = saved(tmp_path, SMALL)
    own = ("XDG_CACHE_HOME", "XDG_CONFIG_HOME", "MPLCONFIGDIR")
    surroundings = {key: value for key, value in os.environ.items() if key not in own}
    surroundings |= {"TMPDIR": str(tmp_path / "tmp")} | dict.fromkeys(variables, "/dev/null")
    command = [*PROGRAM, "report", str(config), "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]
    done = subprocess.run(command, env=surroundings, capture_output=True, text=True, check=False, timeout=120)
    told = [line for line in done.stderr.splitlines() if not line.startswith("not checked")]
    assert (done.returncode, told, [*(tmp_path / "tmp").iterdir()]) == (0, [], [])
