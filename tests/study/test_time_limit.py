"""A plugin that never comes back costs its chunk: its variants are in error with plugin, file and line, the others are kept."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.study.execution import study_run
from diecut_report.study.execution.worker import ChunkClock
from diecut_report.time_limit import Overran, limited
from tests.configs import saved
from tests.examples import few
from tests.study.test_broken_plugins import COMPUTED, PLUGIN, rows, written

Capture = pytest.CaptureFixture[str]
pytestmark = pytest.mark.usefixtures("without_summary")
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary: {mechanisms.m.x: {from: 1 mm, to: 4 mm, count: 8}}
"""
LOOP = """
    while np.any(x > 3e-3):
        pass
"""
HELD_BACK = """
    while np.any(x > 3e-3):
        try:
            time.sleep(0.01)
        except BaseException:
            held.append(1)
            if len(held) > 1:
                raise
"""


def ran(folder: Path, loop: str, monkeypatch: pytest.MonkeyPatch, *options: str) -> int:
    """The exit code of a study in chunks of two variants, whose last two never come back."""
    text = PLUGIN.format(step=COMPUTED).replace("def small(x: Any) -> Any:", f"def small(x: Any) -> Any:{loop}")
    text = text.replace('    if np.any(x > 2.5e-3):\n        raise LookupError("too long for the table")\n', "")
    plugins = written(folder, "import time\n\nheld: list[int] = []\n" + text)
    monkeypatch.setattr(study_run, "PART", (2, 2))
    study = saved(folder, STUDY, "study.yaml")
    return main(["batch", str(study), "-o", str(folder / "out"), *plugins, *options])


@pytest.mark.parametrize(
    ("loop", "options"),
    few([(LOOP, ()), (HELD_BACK, ()), (LOOP, ("--jobs", "2"))], keep=lambda each: each == (HELD_BACK, ())),
    ids=["loop", "held back", "pool"],
)
def test_a_chunk_that_never_ends_is_ended_and_the_others_are_kept(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch, loop: str, options: tuple[str, ...]
) -> None:
    limit = "3" if options else "0.3"  # a process first loads the program, which counts for nothing
    assert ran(tmp_path, loop, monkeypatch, "--chunk-limit", limit, *options) == 3
    assert [row["status"] for row in rows(tmp_path)] == ["pass"] * 4 + ["error"] * 4
    words = f"it took longer than {limit} s for 2 variants, and was ended (breaking.py:"
    assert rows(tmp_path)[7]["error"].startswith(f"plugin 'breaking': {words}")
    told = capfd.readouterr().err
    assert "8 variants: 4 pass, 4 error." in told
    assert f"plugin 'breaking' broke; variants that it broke for are in error, the others are kept: {words}" in told
    assert "--chunk-limit sets how long it may take" in told


def test_a_limit_follows_from_the_slowest_chunk_before() -> None:
    clock = ChunkClock()
    assert clock.limit(100) == 120 + 5 * 100  # nothing is known: generous
    clock.measure(100, 2.0)
    clock.measure(100, 1.0)
    assert clock.limit(50) == 120 + 30 * 0.02 * 50
    assert ChunkClock(7).limit(5) == 7 and ChunkClock(0).limit(5) is None


def test_a_thread_that_is_not_the_main_one_is_interrupted_too() -> None:
    ended: list[bool] = []

    def work() -> None:
        try:
            with limited(0.1):
                while True:
                    time.sleep(0.001)
        except Overran:
            ended.append(True)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join(10)
    assert ended == [True]


def test_what_ends_in_time_is_left_alone() -> None:
    with limited(0.05):
        pass
    with limited(None):
        time.sleep(0.06)
    time.sleep(0.06)  # no alarm rings afterwards


TRACED = """
import sys, threading, time
from diecut_report.time_limit import Overran, limited

def wait():  # a function of its own: Python 3.13 leaves the jump back of a loop out of the "with" around it
    time.sleep(0)
    while time.monotonic() < end:
        pass

def work(seconds):
    try:
        with limited(seconds):
            wait()
    except Overran:
        print("overran")

for seconds, lasts in ((0.05, 50), (30, 0.2)):
    end = time.monotonic() + lasts
    thread = threading.Thread(target=work, args=(seconds,))
    thread.start()
    thread.join()
sys.settrace(lambda *_: None)
print(sum(abs(number) for number in range(1000)), [len(text) for text in "abc"], (lambda: "goes on")())
"""


def test_a_thread_that_was_interrupted_leaves_nothing_behind_that_stops_a_debugger() -> None:
    """On Python 3.11 an interruption that was asked for and withdrawn let the first traced call stand still for ever."""
    made = subprocess.run([sys.executable, "-c", TRACED], capture_output=True, text=True, timeout=60, check=True)
    assert made.stdout.split() == ["overran", "499500", "[1,", "1,", "1]", "goes", "on"]
