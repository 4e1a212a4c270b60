"""How long a change of the full press takes on the live page, in one process, against ``calc`` of the same in the same process.

    python benchmarks/warm.py [ROUNDS]

What is changed is taken by all mechanisms (the productivity), by one that others follow (the crank's length), and by one alone
(a friction). Processor seconds are compared, the least of the rounds; they run in turns, so that the machine's state counts alike.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.live.page_data import page_data
from diecut_report.live.session import LiveSession
from diecut_report.study.execution.process_settings import one_thread

CONFIGS = Path(import_module("diecut_report.configs").__path__[0])
CHANGED = ("press.productivity", "drive.crank_length", "clutch.shoe_friction")


@contextmanager
def copied() -> Iterator[Path]:
    """Give the full press as a file of its own, with what it names beside it."""
    with tempfile.TemporaryDirectory() as name:
        for file in CONFIGS.glob("*.yaml"):
            shutil.copy(file, name)
        yield Path(name) / "flat_cylinder_press.yaml"


def seconds(work: Callable[[], object]) -> float:
    """Processor time of this process."""
    start = time.process_time()
    work()
    return time.process_time() - start


def updated(session: LiveSession, name: str, share: float) -> None:
    """Change an input by a share, and make what the page gets."""
    first = session.start.inputs[name] if session.start else None
    assert first is not None and first.today is not None, "the full press gives it as a number"
    session.change({name: first.typed(first.today * (1 + share))})
    page_data(session)
    if session.faults:
        raise SystemExit(str(session.faults[0]))


def main(rounds: int) -> None:
    """Run all in turns and print the least times and their ratios."""
    with copied() as file, one_thread():  # as the program's own processes
        session = LiveSession(file, Discovery([]))
        least = dict.fromkeys(("calc", *CHANGED), float("inf"))
        for number in range(rounds + 1):
            times = {"calc": seconds(lambda: pipeline.calc(file, Discovery([]), lambda _: None))}
            for name in CHANGED:
                times[name] = seconds(partial(updated, session, name, 1e-3 * (number + 1)))
            if number:  # the first one fills what is kept from run to run
                least = {name: min(value, times[name]) for name, value in least.items()}
    for name, value in least.items():
        print(f"{name:22} {value:.3f} s  {value / least['calc']:.2f} of calc")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 8)
