"""Standard output and error that are closed, full, or not read to their end; texts that are endless or act on a terminal; Ctrl-C."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from diecut_report.cli import output
from diecut_report.cli.main import main
from diecut_report.errors import Problem
from tests.configs import GOOD, HEAD, LEVER, saved
from tests.examples import every, few

Capture = pytest.CaptureFixture[str]
FAILS = LEVER.replace("force: 2 kN", "force: 2 kN, allowable_moment: 150")
WRONG = LEVER.replace("2 kN", "2 kg")
PASSED, FAILED, BAD, UNWRITABLE, INTERRUPTED = 0, 1, 2, 74, 130


def shell(folder: Path, text: str, ending: str) -> subprocess.CompletedProcess[str]:
    """A command with streams as a shell gives them; $ME is the program, $CONFIG a config with this text."""
    own = {"ME": f"{sys.executable} -m diecut_report", "CONFIG": str(saved(folder, text)), "OWN": f"--plugins {GOOD}"}
    command, given = ["bash", "-c", ending], os.environ | own
    return subprocess.run(command, env=given, cwd=folder, capture_output=True, text=True, timeout=120)


QUICK = [
    (LEVER, "$ME calc $CONFIG $OWN >&-", UNWRITABLE),
    (FAILS, "$ME calc $CONFIG $OWN >/dev/full", UNWRITABLE),
    (WRONG, "$ME check $CONFIG $OWN 2>/dev/full", BAD),
    (FAILS, "set -o pipefail; $ME calc $CONFIG $OWN | true", FAILED),
]
REST = [
    (LEVER, "$ME --help >/dev/full", UNWRITABLE),
    (LEVER, "$ME calc $CONFIG $OWN >&- 2>&-", UNWRITABLE),
    (LEVER, "$ME calc $CONFIG $OWN -o /dev/full", UNWRITABLE),
    (LEVER, "$ME calc --help >&-", UNWRITABLE),
    (LEVER, "$ME --version >/dev/full", UNWRITABLE),
    (LEVER, "$ME plugins >/dev/full", UNWRITABLE),
    (LEVER, "$ME schema 2>&- >/dev/full", UNWRITABLE),
    (LEVER, "$ME check $CONFIG $OWN 2>&-", PASSED),
    (LEVER, "$ME check $CONFIG $OWN 2>/dev/full", PASSED),
    (LEVER, "$ME check $CONFIG $OWN >&- 2>&- <&-", UNWRITABLE),
    (WRONG, "$ME check $CONFIG $OWN 2>&-", BAD),
    (LEVER, "$ME check --nonsense 2>&-", BAD),
    (LEVER, "$ME check --nonsense 2>/dev/full", BAD),
    (LEVER, "$ME report $CONFIG $OWN --format json -o out >&- 2>&- <&-", PASSED),
    (LEVER, "$ME report $CONFIG $OWN --format json -o out 2>/dev/full", PASSED),
    (FAILS, "$ME report $CONFIG $OWN --format json -o out 2>/dev/full", FAILED),
    (LEVER, "set -o pipefail; $ME calc $CONFIG $OWN | true", PASSED),
    (LEVER, "set -o pipefail; $ME --help | true", PASSED),
    (LEVER, "set -o pipefail; $ME schema | head -1 >/dev/null", PASSED),
    (LEVER, "set -o pipefail; $ME check $CONFIG $OWN 2>&1 >/dev/null | true", PASSED),
    (WRONG, "set -o pipefail; $ME check $CONFIG $OWN 2>&1 >/dev/null | true", BAD),
]


@pytest.mark.parametrize(("text", "command", "code"), few([*QUICK, *REST], lambda each: each in QUICK))
def test_lost_streams_have_their_own_code(tmp_path: Path, text: str, command: str, code: int) -> None:
    done = shell(tmp_path, text, command)
    told = ("Traceback" in done.stderr, "fault of diecut-report" in done.stderr)
    assert (done.returncode, *told) == (code, False, False)
    if code == UNWRITABLE and "2>&-" not in command:
        assert "Standard output" in done.stderr or "This cannot be written: the disk is full" in done.stderr


def test_a_file_does_not_get_the_place_of_a_closed_stream(tmp_path: Path) -> None:
    (tmp_path / "prints.py").write_text("import os\nos.write(1, b'one')\nos.write(2, b'two')\nMECHANISM = None\n")
    config = HEAD + "  a: {kind: prints}\n"
    done = shell(tmp_path, config, "$ME check $CONFIG --plugins . >&- 2>&- <&-; sha256sum $CONFIG")
    (tmp_path / "again").mkdir()
    assert done.stdout.split()[0] in subprocess.getoutput(f"sha256sum {saved(tmp_path / 'again', config)}")


# --- Ctrl-C ----------------------------------------------------------------------------------------------------------


INTERRUPTS = """
import os, runpy, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)

wanted, sys.argv[1:2] = sys.argv[1], []

class Interrupts:
    def find_spec(self, name, path=None, target=None):
        if name == wanted:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupts())
runpy.run_module("diecut_report", run_name="__main__", alter_sys=True)
"""
MODULES = ["weasyprint", "click", "numpy", "diecut_report.cli", "yaml", "diecut_report.cli.main", "pydantic",
        "diecut_report.config.loader", "numpy.linalg", "jinja2",
        "diecut_report.results.document", "diecut_report.report"]  # fmt: skip


@pytest.mark.nightly
@pytest.mark.parametrize("module", every(len(MODULES), MODULES))
def test_ctrl_c_while_modules_are_loaded_leaves_no_traceback(tmp_path: Path, module: str) -> None:
    """Sent as a module is sought: a time after the start would be another place on each machine."""
    command = [sys.executable, "-c", INTERRUPTS, module, "report", str(saved(tmp_path, LEVER)), "--plugins", str(GOOD)]
    done = subprocess.run(command, capture_output=True, cwd=tmp_path, timeout=120)
    assert (done.returncode, done.stdout, done.stderr.strip()) == (INTERRUPTED, b"", b"")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["press.yaml"]


# --- texts -----------------------------------------------------------------------------------------------------------


def test_what_is_active_on_a_terminal_is_told_as_an_escape(tmp_path: Path, capfd: Capture) -> None:
    name = "\x1b]0;t\a\x9b31m\u202e\r\x7f\x85.yaml"
    assert main(["calc", str(tmp_path / name)]) == 2
    told = r"\x1b]0;t\x07\x9b31m\u202e\r\x7f\x85.yaml: There is no such file. Check the name and the folder."
    assert capfd.readouterr().err == f"{tmp_path}/{told}\n"
    assert main(["calc", "a", "\x1b[2J\npress.yaml: valid"]) == 2  # wrong usage
    told = capfd.readouterr().err
    assert "\x1b" not in told and r"\x1b[2J" in told and "\npress.yaml" not in told


FORGED = (
    r'2 kN="x\npress.yaml:1:1: project.title: forged"',
    r'2 kN="\nforged: valid"',
    r'force:="x\npress.yaml:1:1: all is well": 1, force:',
)


@pytest.mark.parametrize("forged", FORGED)
def test_neither_a_text_nor_a_key_begins_a_line_of_its_own(tmp_path: Path, capfd: Capture, forged: str) -> None:
    typed, _, instead = forged.partition("=")
    config = saved(tmp_path, LEVER.replace(typed, instead))
    assert main(["validate", str(config), "--plugins", str(GOOD)]) == 2
    lines = capfd.readouterr().err.splitlines()
    assert lines[0].startswith(f"{config}:5:")
    assert all(line.startswith(("    ", f"{config}:5:")[typed == "force:"]) for line in lines[1:])


def test_only_the_program_colours(monkeypatch: pytest.MonkeyPatch, capfd: Capture) -> None:
    monkeypatch.setattr(output, "is_styled", lambda: True)
    fail = output.coloured("fail", "fail")
    assert fail == "\x1b[31mfail\x1b[0m" and isinstance(fail, output.Coloured)
    output.tell([(fail, " a: \x1b[32mpass\x1b[0m")])
    assert r" a: \x1b[32mpass\x1b[0m" in capfd.readouterr().err


def test_what_is_asked_for_is_escaped_on_a_terminal_alone(monkeypatch: pytest.MonkeyPatch, capfd: Capture) -> None:
    output.emit("a\x9b2J\n")
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    output.emit("a\x9b2J\tb\n")
    assert capfd.readouterr().out == "a\x9b2J\na\\x9b2J\tb\n"


def with_keys(folder: Path, count: int) -> Path:
    """A config with so many unknown keys."""
    keys = ", ".join(f"k{number}: 1" for number in range(count))
    return saved(folder, LEVER.replace("force:", f"{keys}, force:"))


def test_a_long_text_is_cut_and_many_problems_are_counted(tmp_path: Path, capfd: Capture) -> None:
    output.tell([str(Problem("x" * 1_000_000, "press.yaml"))])
    told = capfd.readouterr().err
    assert len(told) < 3000 and told.startswith("press.yaml: xxx") and "more letters…]" in told
    assert main(["validate", str(with_keys(tmp_path, 3000)), "--plugins", str(GOOD)]) == 2
    lines = capfd.readouterr().err.splitlines()
    assert len(lines) == 21 and lines[-1].startswith("2980 more problems")


@pytest.mark.nightly
def test_90_000_unknown_keys_are_told_soon(tmp_path: Path, capfd: Capture) -> None:
    config, began = with_keys(tmp_path, 90_000), time.process_time()
    assert main(["validate", str(config), "--plugins", str(GOOD)]) == 2
    assert len(capfd.readouterr().err) < 50_000 and time.process_time() - began < 60


def test_a_problem_is_told_whole_where_it_is_not_long(capfd: Capture) -> None:
    output.tell_problems([Problem("x" * 1900)] * 20)
    assert capfd.readouterr().err == f"{'x' * 1900}\n" * 20
