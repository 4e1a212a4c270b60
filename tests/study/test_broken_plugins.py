"""A plugin that breaks in a study, or never comes back: it is named, the variants that it leaves are kept, and without any the study ends with 3."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from diecut_report.cli.main import main
from diecut_report.errors import PluginError
from diecut_report.press import CalculatedPress, ReportOutcome
from diecut_report.study.execution import study_run
from diecut_report.study.execution.worker import ChunkClock
from diecut_report.time_limit import Overran, limited
from tests.configs import saved
from tests.examples import every, few

Capture = pytest.CaptureFixture[str]
pytestmark = pytest.mark.usefixtures("without_summary")
PLUGIN = """
from typing import Any, Literal

import numpy as np
from pydantic import field_validator

from diecut_report.api import Chapter, FromPress, Inputs, Mechanism, Quantity, abscissa, computed, formula, samples


class Breaking(Inputs):
    x = Quantity("x", "mm", "Length", gt=0, default=1.0)
    y = Quantity("y", "1/h", "Rate", gt=0, optional=True)
    n_points = samples(36)
    # inputs


@formula
def twice(x: Any) -> Any:
    return 2 * x


@formula
def unprintable(x: Any) -> Any:
    return [x, x]


@formula
def missing(x: Any) -> Any:
    return x * {{}}["nothing"]


@formula
def wave(angle: Any, a: Any) -> Any:
    return a * np.sin(angle)


def small(x: Any) -> Any:
    if np.any(x > 2.5e-3):
        raise LookupError("too long for the table")
    return 2 * x


def never(x: Any) -> Any:
    raise LookupError("no table")


chapter = Chapter("S")
chapter.a = twice, "a", "mm", "A"
{step}
MECHANISM = Mechanism(kind="breaking", version="1", title="T", summary="S.", inputs=Breaking, chapters=(chapter,))
"""
VALUE = 'chapter.b = {}, "b", "mm", "B"'
COMPUTED = 'chapter.b = computed(small, takes=("x",), method="table"), "b", "mm", "B", "s"'
BASE = """\
schema_version: 1
project: {title: Test}
press: {name: P, productivity: 6000 1/h}
mechanisms: {m: {kind: breaking, x: 1 mm}}
"""
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary: {mechanisms.m.x: [1 mm, 2 mm, 3 mm, 4 mm]}
"""


def written(folder: Path, text: str) -> list[str]:
    """A folder with a plugin of this text, a base and a study of it; the command's options that find the plugin."""
    (folder / "plugins").mkdir()
    saved(folder / "plugins", text, "breaking.py")
    saved(folder, BASE)
    saved(folder, STUDY, "study.yaml")
    return ["--plugins", str(folder / "plugins")]


def ran(folder: Path, step: str, capfd: Capture, inputs: str = "", rest: str = "", helper: str = "") -> tuple[int, str]:
    """The exit code of the study with this step in the plugin, and what it tells."""
    text = PLUGIN.format(step=step).replace("# inputs", inputs).replace("class Breaking", f"{helper}class Breaking")
    plugins = written(folder, text)
    study = saved(folder, STUDY + rest, "study.yaml")
    code = main(["batch", str(study), "-o", str(folder / "out"), *plugins])
    return code, capfd.readouterr().err


def rows(folder: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = pq.read_table(folder / "out" / "variants").to_pylist()
    return found


DECLARED = {
    "a formula that cannot be printed": (
        VALUE.format("unprintable"),
        "formula unprintable gives [<x>, <x>], no expression",
    ),
    "a unit that nobody knows": (VALUE.format("twice").replace("mm", "parsnip"), "'parsnip' is not a known unit"),
    "a plugin that cannot be loaded": (VALUE.format("nobody"), "name 'nobody' is not defined"),
}


@pytest.mark.parametrize("name", DECLARED)
def test_what_cannot_be_declared_is_told_before_anything_is_written(tmp_path: Path, capfd: Capture, name: str) -> None:
    step, words = DECLARED[name]
    code, told = ran(tmp_path, step, capfd)
    assert code == 3 and "Traceback" not in told
    assert told.startswith("mechanism 'm' of plugin 'breaking': ") and words in told
    assert not (tmp_path / "out").exists()


def test_variants_that_a_plugin_breaks_for_are_in_error_and_the_others_are_kept(tmp_path: Path, capfd: Capture) -> None:
    code, told = ran(tmp_path, COMPUTED, capfd)
    assert code == 0  # variants in error do not change it
    assert [row["status"] for row in rows(tmp_path)] == ["pass", "pass", "error", "error"]
    assert [row["m.b"] for row in rows(tmp_path)] == [pytest.approx(0.002), pytest.approx(0.004), None, None]
    assert "4 variants: 2 pass, 2 error." in told
    assert (
        "plugin 'breaking' broke; variants that it broke for are in error, the others are kept: LookupError: too long"
        in told
    )
    assert rows(tmp_path)[2]["error"].startswith("plugin 'breaking': LookupError: too long for the table (breaking.py:")


LEAVES = {  # what a plugin raises to leave the program, and what is told of it
    "sys.exit": ("exit(0)", "SystemExit: 0"),
    "the end of a generator": ("raise GeneratorExit('over')", "GeneratorExit: over"),
    "one of its own": ("raise type('Odd', (BaseException,), {})('no')", "Odd: no"),
    "one that has no words": ("raise type('Mute', (BaseException,), {'__str__': lambda self: 1 / 0})", "Mute"),
    "one with far too many": ("raise Exception('a\\x1b\\u202e' + 100_000 * 'x')", "Exception: a\ufffd\ufffdxxx"),
}
COMMANDS = {  # those that calculate many machines at once, and one
    "batch": ["batch", "study.yaml", "-o", "out", "--jobs", "1"],
    "influence": ["influence", "press.yaml"],
    "solve": ["solve", "press.yaml", "--vary", "m.x", "--for", "m.a = 5 mm"],
    "calc": ["calc", "press.yaml"],
}


@pytest.mark.parametrize("raised", LEAVES)
@pytest.mark.parametrize("command", every(3, COMMANDS))
def test_code_cannot_leave_the_program(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch, command: str, raised: str
) -> None:
    code, words = LEAVES[raised]
    text = PLUGIN.format(step=COMPUTED.replace("small", "never")).replace('raise LookupError("no table")', code)
    plugins = written(tmp_path, text)
    monkeypatch.chdir(tmp_path)
    assert main([*COMMANDS[command], *plugins]) == 3
    out, told = capfd.readouterr()
    assert words in told and "(breaking.py:" in told and "Traceback" not in told
    assert len(told) + len(out) < 10_000 and not {*"\x1b\u202e"} & {*told, *out}


def test_a_continued_run_tells_it_again(tmp_path: Path, capfd: Capture) -> None:
    assert ran(tmp_path, COMPUTED.replace("small", "never"), capfd)[0] == 3  # no variant is left
    assert main(["batch", "--resume", str(tmp_path / "out"), "--plugins", str(tmp_path / "plugins")]) == 3
    assert "plugin 'breaking' broke" in capfd.readouterr().err


def test_a_default_of_the_press_that_breaks_leaves_no_mechanism_out_in_silence(tmp_path: Path, capfd: Capture) -> None:
    press = 'z = Quantity("z", "1/h", "Z", gt=0, press=FromPress("press.productivity", strange))'
    helper = '@formula\ndef strange(x: Any) -> Any:\n    return x * {}["nothing"]\n\n\n'
    assert ran(tmp_path, VALUE.format("twice"), capfd, press, helper=helper)[0] == 3
    assert {row["status"] for row in rows(tmp_path)} == {"error"}
    assert "'nothing'" in rows(tmp_path)[0]["error"]


def test_code_of_the_inputs_is_a_fault_of_the_plugin(tmp_path: Path, capfd: Capture) -> None:
    validator = (
        '@field_validator("x")\n    @classmethod\n    def checked(cls, given: Any) -> Any:\n        return given\n'
    )
    code, told = ran(tmp_path, VALUE.format("twice"), capfd, validator)
    assert code == 3 and "class Breaking: reads its inputs by code of its own (checked)" in told


@pytest.mark.nightly
def test_a_plugin_that_breaks_in_a_full_report_alone_is_told(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = CalculatedPress.report

    def broken(*given: Any) -> ReportOutcome:
        return replace(made(*given), broken=(PluginError("KeyError: 'figure'", "breaking", "m"),))

    monkeypatch.setattr(CalculatedPress, "report", broken)
    code, told = ran(tmp_path, VALUE.format("twice"), capfd, rest="reports: [0]\n")
    assert code == 3 and "plugin 'breaking' broke in the full report of variant 0: KeyError: 'figure'" in told


LONG_STUDY = """\
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


def ran_long(folder: Path, loop: str, monkeypatch: pytest.MonkeyPatch, *options: str) -> int:
    """The exit code of a study in chunks of two variants, whose last two never come back."""
    text = PLUGIN.format(step=COMPUTED).replace("def small(x: Any) -> Any:", f"def small(x: Any) -> Any:{loop}")
    text = text.replace('    if np.any(x > 2.5e-3):\n        raise LookupError("too long for the table")\n', "")
    plugins = written(folder, "import time\n\nheld: list[int] = []\n" + text)
    monkeypatch.setattr(study_run, "PART", (2, 2))
    study = saved(folder, LONG_STUDY, "study.yaml")
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
    assert ran_long(tmp_path, loop, monkeypatch, "--chunk-limit", limit, *options) == 3
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
