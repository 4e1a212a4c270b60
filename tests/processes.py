"""What tests of several processes share."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Self

COMMAND = """
import gc, sys
gc.set_threshold(1_000_000)  # as diecut_report.__main__
from diecut_report.cli.main import main
code = main(sys.argv[1:])
print(*sys.modules, file=sys.stderr)
sys.exit(code)
"""


@dataclass(frozen=True)
class Example:
    """What a command says in a process whose strings have other hashes: its exit code, its output, the modules it imports."""

    code: int
    told: str
    modules: tuple[str, ...]

    @property
    def imported(self) -> frozenset[str]:
        """The modules."""
        return frozenset(self.modules)

    def store(self, folder: Path) -> None:
        """Keep it for other workers."""
        (folder / "example.json").write_text(json.dumps(asdict(self)), "utf-8")

    @classmethod
    def stored(cls, folder: Path) -> Self:
        """Return what was kept there."""
        return cls(**json.loads((folder / "example.json").read_text("utf-8")))


def in_another_process(*arguments: str | Path) -> Example:
    """Run a command there."""
    asked = [sys.executable, "-c", COMMAND, *map(str, arguments)]
    done = subprocess.run(
        asked, capture_output=True, text=True, check=False, env=os.environ | {"PYTHONHASHSEED": "4711"}
    )
    return Example(done.returncode, done.stdout, tuple(done.stderr.splitlines()[-1].split()))


def until(condition: Callable[[], object], seconds: float = 30) -> None:
    """Wait for it; a condition that does not come true fails the test."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "this took too long"
        time.sleep(0.02)


@contextmanager
def at_most(seconds: int) -> Iterator[None]:
    """What takes longer fails, instead of holding all other tests for ever."""

    def stop(*_: Any) -> None:
        raise TimeoutError(f"this took more than {seconds} seconds")

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
