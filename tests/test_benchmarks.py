"""The benchmarks run: what they compare with must not rot."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from tests.configs import EXAMPLE

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


@pytest.mark.slow
@pytest.mark.repository
def test_the_practical_route_sets_the_example(tmp_path: Path) -> None:
    pipeline.report(EXAMPLE, Discovery([]), lambda _: None, tmp_path, ("json",))
    target = tmp_path / "practical.pdf"
    command = [
        sys.executable,
        str(BENCHMARKS / "practical_route.py"),
        str(tmp_path / f"{EXAMPLE.stem}.json"),
        str(target),
    ]
    subprocess.run(command, check=True, capture_output=True)
    assert target.read_bytes().startswith(b"%PDF")
