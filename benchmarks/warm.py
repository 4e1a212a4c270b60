"""How long a change of the full press takes on the live page, in one process, against ``calc`` of the same in the same process:
the calculation (at most 0.12 s is asked), and then what the page gets.

    python benchmarks/warm.py [ROUNDS [FILE INPUT ...]]

FILE is another machine, of which each INPUT is changed. Of the full press that is one that all mechanisms take (the productivity), one that
others follow (the crank's length), and one of a mechanism alone (a friction). Processor seconds are compared, the least of the rounds;
they run in turns, so that the machine's state counts alike.
"""

from __future__ import annotations

import gc
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path

from diecut_report.__main__ import COLLECTED
from diecut_report.config.plugins import Discovery
from diecut_report.live.page import page_data
from diecut_report.live.session import LiveSession
from diecut_report.press import Press
from diecut_report.study.execution.engines import one_thread

CONFIGS = Path(import_module("diecut_report.configs").__path__[0])
CHANGED = ("press.productivity", "drive.crank_length", "clutch.shoe_friction")


@contextmanager
def copied(machine: Path) -> Iterator[Path]:
    """Give a machine as a file of its own, with what may be named beside it."""
    with tempfile.TemporaryDirectory() as name:
        for file in machine.parent.glob("*.yaml"):
            shutil.copy(file, name)
        yield Path(name) / machine.name


def seconds(work: Callable[[], object]) -> float:
    """Processor time of this process."""
    start = time.process_time()
    work()
    return time.process_time() - start


def updated(session: LiveSession, name: str, share: float) -> tuple[float, float]:
    """Change an input by a share, and make what the page gets: the seconds of both."""
    first = session.machine.inputs[name] if session.machine else None
    assert first is not None and first.present is not None, "the full press gives it as a number"
    calculated = seconds(partial(session.change, {name: first.typed(first.present * (1 + share))}))
    if session.faults:
        raise SystemExit(str(session.faults[0]))
    return calculated, seconds(partial(page_data, session))


def main(rounds: int = 8, machine: str = str(CONFIGS / "flat_cylinder_press.yaml"), *changed: str) -> None:
    """Run all in turns and print the least times and their ratios."""
    changed = changed or CHANGED
    gc.set_threshold(COLLECTED)
    with copied(Path(machine)) as file, one_thread():  # as the program's own processes
        session = LiveSession(file, Discovery([]))
        gc.collect()
        gc.freeze()  # as the server of the page does
        calc, least = float("inf"), dict.fromkeys(changed, (float("inf"), float("inf")))
        for number in range(rounds + 1):
            taken = seconds(lambda: Press.read(file, Discovery([])).calculate())
            times = {name: updated(session, name, 1e-3 * (number + 1)) for name in changed}
            if number:  # the first one fills what is kept from run to run
                calc = min(calc, taken)
                least = {name: min(value, times[name], key=sum) for name, value in least.items()}
    print(f"{'calc':22} {calc:.3f} s")
    for name, (calculated, shown) in least.items():
        print(f"{name:22} {calculated:.3f} s + {shown:.3f} s for the page  {(calculated + shown) / calc:.2f} of calc")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]), *sys.argv[2:])
