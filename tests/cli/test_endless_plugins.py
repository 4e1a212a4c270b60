"""A plugin that never comes back is told with its place by each command, and costs its mechanism alone."""

from __future__ import annotations

import signal
import time
from pathlib import Path

import pytest

from diecut_report import time_limit
from diecut_report.cli.main import main
from diecut_report.time_limit import TooLong, in_time, limited
from tests.configs import saved
from tests.examples import few

PLUGIN = """\
from typing import Annotated

from diecut_report.api import Chapter, Drawing, Inputs, Mechanism, Quantity


class Arm(Inputs):
    arm: Annotated[float, Quantity("a", "mm", "Arm", gt=0)] = 10


def found(arm):
    return 2 * arm


def drawn(view):
    return []


chapter = Chapter("All")
chapter.computed("reach", "r", "mm", "Reach", found, takes=("arm",), method="a search")
MECHANISM = Mechanism(
    kind="endless", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,),
    figures=(Drawing(id="arm_drawn", title="Arm", caption="The arm.", build=drawn),),
)
"""
CONFIG = """\
schema_version: 1
project: {title: Endless}
press: {name: P}
mechanisms: {a: {kind: endless}}
"""
LOOP = "while True:\n        pass\n"
PLACES = {
    "at import": ("class Arm(Inputs):", f"if True:\n    {LOOP}\n\nclass Arm(Inputs):"),
    "in plain code": ("    return 2 * arm", f"    {LOOP}"),
    "in a drawing": ("    return []", f"    {LOOP}"),
}
COMMANDS = {
    "calc": ("calc", "press.yaml", "-o", "press.json"),
    "report": ("report", "press.yaml", "-o", "out", "--format", "html"),
    "check": ("check", "press.yaml"),
}


@pytest.mark.usefixtures("without_summary")
@pytest.mark.parametrize("command", few(COMMANDS, lambda command: command == "calc"))
@pytest.mark.parametrize("place", PLACES)
def test_an_endless_loop_is_ended(
    place: str, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    old, new = PLACES[place]
    assert PLUGIN.count(old) == 1
    file = saved(tmp_path, PLUGIN.replace(old, new), "endless.py")
    saved(tmp_path, CONFIG, "press.yaml")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(time_limit, "MECHANISM_SECONDS", 0.5)
    assert main([*COMMANDS[command], "--plugins", "."]) == 3
    lines = file.read_text("utf-8").splitlines()
    line = 1 + next(i for i, text in enumerate(lines) if "while True" in text)
    told = capfd.readouterr().err
    assert "it did not come back within 0.5 s; let its loops end" in told
    assert any(f"(endless.py:{each})" in told for each in (line, line + 1)), told


def test_who_waits_already_waits_as_long_as_he_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time_limit, "MECHANISM_SECONDS", 0.05)
    with limited(30), in_time():
        time.sleep(0.2)
    with pytest.raises(TooLong), in_time():
        time.sleep(0.2)


def test_the_alarm_of_a_program_around_rings_in_its_time() -> None:
    rung: list[int] = []
    before = signal.signal(signal.SIGALRM, lambda number, _: rung.append(number))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with in_time():
            pass
        assert 0 < signal.getitimer(signal.ITIMER_REAL)[0] <= 0.1
        time.sleep(0.2)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert rung == [signal.SIGALRM]
