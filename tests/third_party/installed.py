"""Packages of others, installed as they would install them, but without the network."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

EXAMPLES = Path(__file__).parents[2] / "examples"
MADE = shutil.ignore_patterns("build", "*.egg-info", "__pycache__", ".*_cache")


def install(package: Path, folder: Path) -> None:
    """Install a package into a folder, from a copy: building leaves its traces in what it builds."""
    copy = folder.with_name(f"{folder.name}_source")
    shutil.copytree(package, copy, ignore=MADE)
    pip = [sys.executable, "-m", "pip", "install", "-qq", "--no-deps", "--no-build-isolation", "--no-index"]
    done = subprocess.run(
        [*pip, "--no-compile", "--disable-pip-version-check", "--target", str(folder), str(copy)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr


def run_with(folder: Path, *arguments: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run Python with what is installed in a folder."""
    return subprocess.run(
        [sys.executable, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=cwd,
        env=os.environ | {"PYTHONPATH": str(folder)},
    )  # fmt: skip
