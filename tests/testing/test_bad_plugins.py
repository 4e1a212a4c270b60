"""Whatever a plugin does wrong is told with plugin, file and line; the others' results stand, and the exit code is 3."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.configs import GOOD, LEVER, saved
from tests.examples import few

Capture = pytest.CaptureFixture[str]
PLUGIN = """\
import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, computed, m


class Bad(Inputs):
    x = Quantity("x", "mm", "Length", gt=0, default=10)


def code(x):
    {code}


chapter = Chapter("Only")
chapter.a = 2 * m.x, "a", "mm", "A"
{step}

{head}
MECHANISM = Mechanism(kind="faulty", version="1", title="T", summary="", inputs=Bad, chapters=(chapter,))
"""
COMPUTED = 'chapter.b = computed(code, ("x",), "by code"), "b", "mm", "B"'
BAD = {  # what stands where in the plugin, and what is told of it
    "missing library": ({"head": "import no_such_library"}, "ModuleNotFoundError: No module named 'no_such_library' (faulty.py:18)"),
    "newer contract": ({"head": "CONTRACT = 7"}, "it is written for contract 7, this program (1.0.0) has contract 2; install a newer version"),
    "older contract": ({"head": "CONTRACT = 0"}, "has contract 2; use a newer version of the plugin"),
    "name of another version": (
        {"head": "from diecut_report.api import Wormhole"},
        "diecut_report.api of this version (1.0.0) has no 'Wormhole'; the plugin is written for another version (faulty.py:18)",
    ),
    "exception": ({"code": "raise RuntimeError('fell over')"}, "RuntimeError: fell over (faulty.py:11)"),
    "end of the program": ({"code": "raise SystemExit(0)"}, "SystemExit: 0 (faulty.py:11)"),
    "not a number": ({"code": "return x * np.nan"}, "B (b) has no value with these inputs (faulty.py:16)"),
    "infinite": ({"code": "return x * np.inf"}, "B (b) has no value with these inputs (faulty.py:16)"),
    "wrong shape": ({"code": "return np.ones((3, 4))"}, "faulty.py:16: step b: its function code gives an array of shape (3, 4)"),
    "nothing": ({"code": "pass"}, "faulty.py:16: step b: its function code gives None; it must return a number"),
    "output that is not declared": (
        {"step": 'chapter.b = m.q, "b", "mm", "B"'}, "faulty.py:16: step b: takes q, which nothing gives",
    ),
    "message that names nothing": (
        {"step": 'chapter.require("r", m.x > 0, key="x", message="is {nope}")'}, "faulty.py:16: step r: the message names nope",
    ),
    "prepared without what is taken": (
        {"code": "return {}", "step": 'chapter.prepared("p", code, ("x",))\nchapter.b = computed(lambda p: p["q"], ("p",), "m"), "b", "mm", "B"'},
        "KeyError: 'q' (faulty.py:17)",
    ),
}  # fmt: skip
TWO = 'chapter.b = m.q, "b", "mm", "B"\nchapter.c = m.r, "c", "mm", "C"'
LATER = {"code": "return x", "step": COMPUTED, "head": ""}


def plugin(folder: Path, **parts: str) -> str:
    """A folder with a bad plugin."""
    (folder / "plugins").mkdir(exist_ok=True)
    text = PLUGIN
    for key, part in {**LATER, **parts}.items():
        text = text.replace(f"{{{key}}}", part)
    saved(folder / "plugins", text, "faulty.py")
    return str(folder / "plugins")


def reported(folder: Path, capfd: Capture, **parts: str) -> tuple[str, dict[str, dict[str, object]]]:
    """What is told of a press with a lever and a bad mechanism, and the mechanisms of its results."""
    folders = ("--plugins", plugin(folder, **parts), "--plugins", str(GOOD))
    config = saved(folder, LEVER + "  faulty: {kind: faulty}\n")
    assert main(["report", str(config), *folders, "-o", str(folder), "--format", "json", "--quiet"]) == 3
    return capfd.readouterr().err, json.loads((folder / "press.json").read_text("utf-8"))["mechanisms"]


@pytest.mark.parametrize("name", BAD)
def test_a_plugin_that_is_bad_costs_its_mechanism_alone(tmp_path: Path, capfd: Capture, name: str) -> None:
    parts, words = BAD[name]
    told, results = reported(tmp_path, capfd, **parts)
    assert told.startswith("mechanism 'faulty' of plugin 'faulty': ") and words in told and "Traceback" not in told
    assert re.search(r"faulty\.py", told)
    assert results["a"]["status"] == "pass" and results["faulty"]["status"] == "error"


def test_each_invalid_declaration_has_its_line(tmp_path: Path, capfd: Capture) -> None:
    assert main(["check-plugin", "faulty", "--plugins", plugin(tmp_path, step=TWO)]) == 3
    *_, head, first, second = capfd.readouterr().out.splitlines()
    assert head.endswith("faulty.py has invalid declarations:") and "\\n" not in head
    assert re.search(r"^ {6}\S*faulty\.py:16: step b: takes q", first) and "faulty.py:17: step c: takes r" in second


def test_two_plugins_of_one_kind_are_both_told_and_the_others_stand(tmp_path: Path, capfd: Capture) -> None:
    other = tmp_path / "other"
    other.mkdir()
    folders = ("--plugins", plugin(tmp_path), "--plugins", plugin(other), "--plugins", str(GOOD))
    config = saved(tmp_path, LEVER + "  faulty: {kind: faulty}\n")
    assert main(["calc", str(config), *folders]) == 3
    out, err = capfd.readouterr()
    files = f"{tmp_path / 'plugins' / 'faulty.py'} and from {other / 'plugins' / 'faulty.py'}"
    assert (
        f"mechanism 'faulty' of plugin 'faulty': The kind 'faulty' comes from {files}. Remove or rename one of them."
        in err
    )
    assert json.loads(out)["mechanisms"]["a"]["status"] == "pass"


WRITES = "print('by-print'); import os, subprocess; os.write(1, b'by-write'); subprocess.run(['echo', 'by-process']); return x"


@pytest.mark.parametrize(
    "command",
    few([
        ["calc", "CONFIG"], ["plugins"], ["schema", "faulty"], ["check-plugin", "faulty", "--format", "json"],
        ["influence", "CONFIG", "--of", "faulty.b", "--format", "json"], ["advise", "CONFIG", "--format", "json"],
        ["solve", "CONFIG", "--vary", "faulty.x", "--for", "faulty.a = 30 mm", "--format", "json"],
    ], keep=lambda each: each[0] in ("calc", "schema", "solve")),
)  # fmt: skip
def test_what_a_plugin_writes_does_not_spoil_what_is_asked_for(
    tmp_path: Path, capfd: Capture, command: list[str]
) -> None:
    folders = (
        "--plugins",
        plugin(tmp_path, code=WRITES, head=f"\n{WRITES.removesuffix('; return x')}\n"),
        "--plugins",
        str(GOOD),
    )
    config = saved(tmp_path, LEVER + "  faulty: {kind: faulty, x: 10 mm}\n")
    assert main([*[str(config) if part == "CONFIG" else part for part in command], *folders, "--quiet"]) in (0, 1)
    out, err = capfd.readouterr()
    assert not re.search("by-", out) and all(w in err for w in ("by-print", "by-write", "by-process"))
    if command != ["plugins"]:
        json.loads(out)
