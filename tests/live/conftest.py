"""A small configuration of its own for each test of the live page, and a session of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.live.session import LiveSession
from tests.configs import EXAMPLES

KNIFE = next(path for path in EXAMPLES if path.stem == "circular_knife")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A copy of the example of the knife, which may be changed."""
    copy = tmp_path / "knife.yaml"
    copy.write_bytes(KNIFE.read_bytes())
    return copy


@pytest.fixture
def session(file: Path) -> LiveSession:
    """A session of that file."""
    return LiveSession(file, Discovery([]))
