"""A stored study that hostile hands change."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.configs import GOOD, saved
from tests.shared import once
from tests.study.studies import BASE, STUDY


@pytest.fixture
def stored(tmp_path: Path, tmp_path_factory: pytest.TempPathFactory, without_summary: None) -> Path:
    """A copy of a stored study of six variants."""

    def make(folder: Path) -> None:
        saved(folder, BASE)
        command = ["batch", saved(folder, STUDY, "study.yaml"), "-o", folder / "out", "--jobs", 1]
        assert main([*map(str, command), "--plugins", str(GOOD), "--quiet"]) == 0

    return Path(shutil.copytree(once(tmp_path_factory, "stored_study", make) / "out", tmp_path / "out"))
