"""Packaging and set-up: what is in the repository is in the wheel, and the locks fit the project."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
SETUPTOOLS = PROJECT["tool"]["setuptools"]
FOLDERS = {folder: package for package, folder in SETUPTOOLS["package-dir"].items()}
LOCKS = ["requirements.lock", "requirements-dev.lock", "requirements-cluster.lock"]


def pins(lock: str) -> dict[str, str]:
    """The locked versions by name."""
    return dict(re.findall(r"^([\w.-]+)==(\S+) \\$", (ROOT / lock).read_text("utf-8"), re.MULTILINE))


def files(folder: str) -> list[Path]:
    return [path for path in (ROOT / folder).rglob("*") if path.is_file() and "__pycache__" not in path.parts]


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_folder_with_python_is_a_listed_package(folder: str) -> None:
    parts = {path.parent.relative_to(ROOT / folder).parts for path in files(folder) if path.suffix == ".py"}
    assert {".".join([FOLDERS[folder], *part]) for part in parts} <= set(SETUPTOOLS["packages"])


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_data_file_is_package_data(folder: str) -> None:
    patterns = SETUPTOOLS["package-data"][FOLDERS[folder]]
    listed = {path for pattern in patterns for path in (ROOT / folder).glob(pattern)}
    assert [path for path in files(folder) if path.suffix != ".py" and path not in listed] == []


@pytest.mark.parametrize(
    ("lock", "requirements"),
    [
        (LOCKS[0], PROJECT["project"]["dependencies"]),
        (LOCKS[0], PROJECT["build-system"]["requires"]),
        (LOCKS[1], PROJECT["project"]["optional-dependencies"]["dev"]),
        (LOCKS[2], PROJECT["project"]["dependencies"]),
        (LOCKS[2], PROJECT["project"]["optional-dependencies"]["cluster"]),
    ],
)
def test_a_lock_meets_what_the_project_asks_for(lock: str, requirements: list[str]) -> None:
    locked = {canonicalize_name(name): version for name, version in pins(lock).items()}
    asked = [Requirement(text) for text in requirements]
    assert [r for r in asked if not r.specifier.contains(locked.get(canonicalize_name(r.name), "0"))] == []


def test_the_tests_run_with_the_versions_that_a_report_is_made_with() -> None:
    assert pins(LOCKS[0]).items() <= pins(LOCKS[1]).items()


def test_a_cluster_runs_with_the_versions_that_the_tests_run_with() -> None:
    assert pins(LOCKS[2]).items() <= pins(LOCKS[1]).items()
    assert pins(LOCKS[0]).items() - pins(LOCKS[2]).items() <= {("setuptools", pins(LOCKS[0])["setuptools"])}


@pytest.mark.parametrize("lock", LOCKS)
def test_a_lock_has_a_hash_for_each_pin_and_names_no_host(lock: str) -> None:
    text = (ROOT / lock).read_text("utf-8")
    entries = re.findall(r"^\S+==\S+ \\\n    --hash=sha256:[0-9a-f]{64}", text, re.MULTILINE)
    assert len(entries) == text.count("==") > 0
    assert re.findall(r"://|^\s*--(?!hash)\S+|^\S+ @", text, re.MULTILINE) == []


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A copy of what the set-up needs, in a path with a space, without an environment."""
    folder = tmp_path / "a checkout"
    shutil.copytree(ROOT / "scripts", folder / "scripts")
    for name in ("pyproject.toml", *LOCKS):
        shutil.copy(ROOT / name, folder)
    return folder


def set_up(checkout: Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    command = ["sh", str(checkout / "scripts" / "setup.sh"), *arguments]
    return subprocess.run(
        command, env=os.environ | environment, capture_output=True, text=True, timeout=60, cwd="/", check=False
    )


def test_an_unknown_purpose_is_refused(checkout: Path) -> None:
    done = set_up(checkout, "everything")
    assert (done.returncode, done.stdout) == (2, "")
    assert 'unknown purpose "everything"' in done.stderr


def test_a_python_that_is_not_there_is_named_and_nothing_is_made(checkout: Path) -> None:
    done = set_up(checkout, PYTHON="/nowhere/python3")
    assert done.returncode == 2
    assert "Python 3.11 or newer is needed" in done.stderr and "/nowhere/python3" in done.stderr
    assert not (checkout / ".venv").exists()


def test_an_old_python_is_named_with_its_version_and_nothing_is_made(checkout: Path) -> None:
    old = checkout / "old python"
    old.write_text('#!/bin/sh\n[ "$1" = --version ] && { echo Python 3.9.2; exit; }\nexit 1\n', "utf-8")
    old.chmod(0o755)
    done = set_up(checkout, PYTHON=str(old))
    assert done.returncode == 2
    assert "Python 3.9.2" in done.stderr
    assert not (checkout / ".venv").exists()


@pytest.fixture
def ready(checkout: Path) -> Path:
    """A checkout that is set up, with a program that says where it was started and with what."""
    shutil.copy(ROOT / "make-report", checkout)
    (checkout / "scripts" / "setup.sh").write_text("exit 0\n", "utf-8")
    program = checkout / ".venv" / "bin" / "python"
    program.parent.mkdir(parents=True)
    program.write_text('#!/bin/sh\necho "$PWD: $*"\n', "utf-8")
    program.chmod(0o755)
    return checkout


def make_report(ready: Path, folder: Path, *arguments: str) -> str:
    command = ["sh", str(ready / "make-report"), *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=True).stdout


def test_a_report_of_ones_own_goes_to_build_of_the_current_folder_unless_told_otherwise(
    ready: Path, tmp_path: Path
) -> None:
    own = "-P -m diecut_report report -o build"
    assert make_report(ready, tmp_path, "my press.yaml") == f"{tmp_path}: {own} my press.yaml\n"
    assert (
        make_report(ready, tmp_path, "a.yaml", "-o", "out") == f"{tmp_path}: {own} a.yaml -o out\n"
    )  # the last one holds


def test_the_example_goes_to_build_of_the_checkout(ready: Path, tmp_path: Path) -> None:
    first, last = make_report(ready, tmp_path).splitlines()
    assert first == f"{ready}: -P -m diecut_report report configs/flat_cylinder_press.yaml -o build"
    assert f"{ready}/build/flat_cylinder_press.pdf" in last
