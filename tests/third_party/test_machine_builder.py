"""The repository of a machine builder in ``examples/``: its script ends with 1 where a change makes a machine fail."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs.pages import ROOT, PageRun
from tests.third_party.installed import EXAMPLES, MADE

SCRIPTS = Path(sys.executable).parent


def repository(folder: Path) -> Path:
    """A clone of the example, under Git."""
    home = folder / "machines"
    shutil.copytree(EXAMPLES / "machine-builder", home, ignore=MADE)
    run(home, "git", "init", "-q")
    commit(home, "Begin")
    return home


def run(home: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run a command there, with the programs of this environment."""
    own = {"PATH": f"{SCRIPTS}{os.pathsep}{os.environ['PATH']}", "DIECUT_REPORT_LANGUAGE": "en", "OUT": "build"}
    return subprocess.run(command, cwd=home, capture_output=True, text=True, check=False, env=os.environ | own)


def commit(home: Path, message: str) -> None:
    run(home, "git", "add", "-A")
    done = run(
        home, "git", "-c", "user.name=Designer", "-c", "user.email=designer@example.org", "commit", "-qm", message
    )
    assert done.returncode == 0, done.stderr


def soften(home: Path) -> None:
    """Change the catcher, so that its bar strikes the frame."""
    config = home / "configs" / "catcher.yaml"
    changed = config.read_text("utf-8").replace("stiffness: 1 N/mm", "stiffness: 0.4 N/mm")
    config.write_text(changed, "utf-8")
    commit(home, "Take softer springs")


@pytest.mark.nightly
def test_a_change_that_makes_a_check_fail_ends_with_1(tmp_path: Path) -> None:
    home = repository(tmp_path)
    (home / "configs" / "cutter.yaml").unlink()
    soften(home)
    done = run(home, "./ci.sh", "check")
    assert done.returncode == 1, done.stderr
    assert "fail     stop.room" in done.stdout and (home / "build" / "check" / "machines.html").is_file()


@pytest.mark.nightly
def test_all_steps_hold_and_a_failing_machine_is_still_reported(tmp_path: Path) -> None:
    home = repository(tmp_path)
    assert run(home, "./release.sh", "catcher").returncode == 0
    commit(home, "Release the catcher")
    done = run(home, "./ci.sh")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Nothing changed." in done.stdout and (home / "build" / "reports" / "cutter.pdf").is_file()

    soften(home)
    done = run(home, "./ci.sh")
    assert done.returncode == 1 and "stop.room" in (home / "build" / "changes" / "catcher.txt").read_text("utf-8")
    assert "Changes since catcher.yaml" in (home / "build" / "reports" / "catcher.html").read_text("utf-8")
    assert run(home, "./release.sh", "catcher").returncode == 1 and run(home, "git", "status", "--short").stdout == ""


@pytest.mark.nightly
def test_a_wrong_file_ends_with_2(tmp_path: Path) -> None:
    home = repository(tmp_path)
    (home / "configs" / "cutter.yaml").write_text("schema_version: 1\nmechanism: {}\n", "utf-8")
    done = run(home, "./ci.sh", "check")
    assert done.returncode == 2, done.stdout + done.stderr


def test_the_recipe_shows_what_the_repository_holds(tmp_path: Path) -> None:
    page = ROOT / "docs" / "own-repository.md"
    assert PageRun(page, tmp_path).execute() >= 4 and page.read_text("utf-8").count("<!-- keep ") == 4
