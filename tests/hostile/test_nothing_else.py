"""A report is made without the network, without another program, and without unpickling anything: Python itself tells of each."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import diecut_report
from tests.configs import SMALL, saved
from tests.hostile.bounded import run

EVENTS = ("socket.connect", "socket.getaddrinfo", "socket.bind", "subprocess.Popen", "os.system", "os.exec", "os.posix_spawn", "pickle.find_class",
          "urllib.Request", "webbrowser.open")  # fmt: skip
ALLOWED = (
    "data:",
    "fc-list",
    "system_profiler",
)  # what lies in the page; where matplotlib looks for fonts, the first time for a user
WATCHED = f"""
import sys
told = []
def note(event, arguments):
    if event in {EVENTS!r} and not any(word in str(arguments)[:60] for word in {ALLOWED!r}):
        told.append((event, str(arguments)[:80]))
sys.addaudithook(note)
from diecut_report.cli.main import main
code = main(["report", sys.argv[1], "-o", sys.argv[2], "--format", "html,pdf,json", "--quiet"])
print(code, *(f"{{event}}{{arguments}}" for event, arguments in told))
"""
UNPACKING = {"pickle", "cPickle", "dill", "cloudpickle", "joblib", "shelve", "marshal", "dbm"}


@pytest.mark.nightly
def test_a_report_needs_nothing_else(tmp_path: Path) -> None:
    config = saved(tmp_path, SMALL)
    assert run(WATCHED, config, tmp_path / "out", memory=6_000_000_000).strip() == "0"


def test_no_module_can_unpickle() -> None:
    folder = Path(diecut_report.__file__).parent
    for file in folder.rglob("*.py"):
        if not any(name in file.read_text("utf-8") for name in ("allow_pickle", *UNPACKING)):
            continue
        for node in ast.walk(ast.parse(file.read_bytes())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            assert not UNPACKING.intersection(name.partition(".")[0] for name in names), file
            assert not (isinstance(node, ast.keyword) and node.arg == "allow_pickle"), file
