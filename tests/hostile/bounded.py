"""Runs Python in a process of its own with bounded memory and time, so that what fails cannot eat the machine."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

MEMORY = 2_000_000_000  # bytes of addresses; NumPy and Arrow take half of it before they hold anything
SECONDS = 60


def bounded(memory: int = MEMORY) -> Any:
    """What a child process does before it runs."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    return limit


def run(code: str, *arguments: object, seconds: float = SECONDS, memory: int = MEMORY) -> str:
    """What the code prints; an exception in it, or one that takes too much, fails the test."""
    command = [sys.executable, "-c", code, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, preexec_fn=bounded(memory))
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout


PEAK = """
from pathlib import Path

def memory():  # not ru_maxrss, which counts what the test's own process held when it began this one
    lines = Path("/proc/self/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith("VmHWM")).split()[1]) * 1024
"""
READ = f"""
import json, sys, time
{PEAK}
from diecut_report.errors import UserError
from diecut_report.study.tables.reading import read_table

read_table(Path(sys.argv[1]))  # what the libraries take themselves
began = memory()
for name in sys.argv[2:]:
    start = time.process_time()
    try:
        table = read_table(Path(name))
        told = [f"{{len(next(iter(table.columns.values())).cells)}} rows of {{len(table.columns)}}"]
        for column in table.columns.values():
            try:
                column.si("mm")
                column.texts()
            except UserError as error:
                told += [str(problem) for problem in error.problems][:30]
    except UserError as error:
        told = [str(problem) for problem in error.problems][:300]
    more = memory() - began
    print(json.dumps([name, told, time.process_time() - start, more]), flush=True)
"""


def read(plain: Path, tables: Iterable[Path]) -> dict[str, tuple[list[str], float, int]]:
    """What is told of each table, by its name: in words, in how many seconds of work, and by how much memory had grown by then."""
    lines = run(READ, plain, *tables, seconds=600).splitlines()
    return {Path(name).name: (told, seconds, more) for name, told, seconds, more in map(json.loads, lines)}
