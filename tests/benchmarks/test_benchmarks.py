"""The benchmarks run: what they take of the program is there, and their commands are those of the program as it is."""

from __future__ import annotations

import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from tests.configs import EXAMPLE

BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "report.py"


@pytest.mark.parametrize("name", ["batch", "calc", "drive_kernel", "report", "same_results", "warm"])
def test_a_benchmark_finds_what_it_takes_of_the_program(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(BENCHMARK.parent)
    runpy.run_path(str(BENCHMARK.with_stem(name)))


@pytest.mark.nightly
def test_the_benchmark_of_reports_tells_times_memory_sheets_and_ratios() -> None:
    small = str(EXAMPLE.with_name("circular_knife.yaml"))
    command = [sys.executable, str(BENCHMARK), "1", sys.executable, small]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    assert [line.split(" ")[0] for line in told[:8]] == [
        "calc", "empty", "brief", "standard", "standard", "standard", "full", "landed",
    ]  # fmt: skip
    assert all(
        line.endswith("sheets") == ("html" not in line and "calc" not in line and "page" not in line)
        for line in told[:8]
    )
    assert [line.rsplit("(aim ", 1)[1] for line in told[8:]] == ["2.5)", "0.2)", "0.45)"]
