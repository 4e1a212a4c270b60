"""The benchmarks run: what they compare with must not rot."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.configs import saved

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.mark.nightly
def test_the_practical_route_sets_a_report(small_report: Path, tmp_path: Path) -> None:
    whole = json.loads((small_report / "small.json").read_text("utf-8"))
    clutch = whole["mechanisms"]["clutch"]  # its first section and figure
    clutch |= {"sections": clutch["sections"][:1], "figures": clutch["figures"][:1]}
    results, target = saved(tmp_path, json.dumps(whole), "small.json"), tmp_path / "practical.pdf"
    command = [sys.executable, str(BENCHMARKS / "practical_route.py"), str(results), str(target)]
    subprocess.run(command, check=True, capture_output=True)
    assert target.read_bytes().startswith(b"%PDF")
