"""The benchmarks run: what they compare with must not rot."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def test_the_practical_route_sets_a_report(small_report: Path, tmp_path: Path) -> None:
    results, target = small_report / "small.json", tmp_path / "practical.pdf"
    command = [sys.executable, str(BENCHMARKS / "practical_route.py"), str(results), str(target)]
    subprocess.run(command, check=True, capture_output=True)
    assert target.read_bytes().startswith(b"%PDF")
