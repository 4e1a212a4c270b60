"""A folder of plugins may hold pipes: none is waited for, and none is a kind or a part of one."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.configs import GOOD, LEVER, saved


def calculated(tmp_path: Path) -> subprocess.CompletedProcess[str]:
    """What becomes of a lever with the plugins of a folder; one that waits fails the test."""
    command = [
        sys.executable,
        "-P",
        "-m",
        "diecut_report",
        "validate",
        saved(tmp_path, LEVER),
        "--plugins",
        tmp_path / "plugins",
    ]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=60)


@pytest.mark.nightly
def test_pipes_beside_a_plugin_are_no_part_of_it(tmp_path: Path) -> None:
    folder = tmp_path / "plugins" / "lever"
    folder.mkdir(parents=True)
    shutil.copy(GOOD / "lever.py", folder / "__init__.py")
    for name in ("data.json", "other.py", "../data.json", "../other.py"):
        os.mkfifo(folder / name)
    assert calculated(tmp_path).returncode == 0


@pytest.mark.nightly
def test_a_pipe_is_not_a_plugin(tmp_path: Path) -> None:
    (tmp_path / "plugins").mkdir()
    os.mkfifo(tmp_path / "plugins" / "lever.py")
    done = calculated(tmp_path)
    assert done.returncode == 2 and "'lever' is not a known kind" in done.stderr
    (tmp_path / "plugins" / "kinds.yaml").write_text("lever: lever.py", "utf-8")
    done = calculated(tmp_path)
    assert done.returncode == 3 and "it is not a regular file" in done.stderr
