"""The command line: commands, exit codes, streams, and each bad input told in words with nothing written."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import click
import pytest

from diecut_report import __version__, plugins
from diecut_report.cli import output
from diecut_report.cli.main import main
from diecut_report.cli.output import QUIET, Progress
from tests.configs import BROKEN, GOOD, HEAD, LEVER, LISTED, SMALL, saved
from tests.processes import Example, in_another_process

FAILS = LEVER.replace("force: 2 kN", "force: 2 kN, allowable_moment: 150")
Capture = pytest.CaptureFixture[str]


def run(*arguments: object) -> int:
    """The exit code of a command, with the kinds for tests."""
    return main([*map(str, arguments), "--plugins", str(GOOD)])


def program(*arguments: object, **options: object) -> subprocess.CompletedProcess[bytes]:
    """A command in a process of its own."""
    command = [sys.executable, "-m", "diecut_report", *map(str, arguments)]
    return subprocess.run(command, capture_output="stdout" not in options, **options)  # type: ignore[call-overload, no-any-return]


# --- exit codes and streams ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("text", "code"), [(LEVER, 0), (FAILS, 1), (LEVER.replace("2 kN", "2 kg"), 2)])
@pytest.mark.parametrize("command", ["calc", "report"])
@pytest.mark.wheel
def test_exit_codes(tmp_path: Path, command: str, text: str, code: int) -> None:
    out = tmp_path / "out"
    where = ["-o", out, "--format", "json"] if command == "report" else ["-o", out / "press.json"]
    assert run(command, saved(tmp_path, text), *where) == code
    assert (out / "press.json").exists() == out.exists() == (code < 2)


@pytest.mark.wheel
def test_calc_prints_the_results_alone_on_standard_output(tmp_path: Path, capfd: Capture) -> None:
    assert run("calc", saved(tmp_path, FAILS)) == 1
    out, err = capfd.readouterr()
    assert json.loads(out)["status"] == "fail" and err == ""


def test_calc_to_a_file_is_what_it_prints_and_tells_the_failing_checks(tmp_path: Path, capfd: Capture) -> None:
    config, file = saved(tmp_path, FAILS), tmp_path / "r.json"
    assert run("calc", config) == run("calc", config, "-o", file) == run("calc", config, "-o", "-") == 1
    out, err = capfd.readouterr()
    assert out == 2 * file.read_text("utf-8") and err.count("1 of 1 checks fails; 2 default values are open.") == 1
    assert run("calc", config, "-o", file, "--quiet") == 1
    assert capfd.readouterr() == ("", "")


@pytest.mark.wheel
def test_a_plugin_that_prints_does_not_spoil_the_output(tmp_path: Path) -> None:
    done = program("calc", saved(tmp_path, HEAD + "  a: {kind: first_kind}\n"), "--plugins", LISTED)
    assert done.returncode == 0 and json.loads(done.stdout)["status"] == "pass"
    assert done.stderr == b"hello from a plugin\n"


def test_errors_go_to_standard_error_only(tmp_path: Path, capfd: Capture) -> None:
    config = saved(tmp_path, LEVER.replace("2 kN", "2 kg"))
    for command in ("calc", "report", "validate"):
        assert run(command, config, *(["-o", tmp_path / "out"] if command == "report" else [])) == 2
        out, err = capfd.readouterr()
        assert out == "" and err.startswith(f"{config}:5:27: mechanisms.a.force: 2 kg is a mass; a force is needed")
    assert not (tmp_path / "out").exists()


@pytest.mark.wheel
def test_report_tells_what_it_wrote_and_what_fails(tmp_path: Path, capfd: Capture) -> None:
    assert run("report", saved(tmp_path, FAILS), "-o", tmp_path, "--format", "json") == 1
    out, err = capfd.readouterr()
    assert out == ""
    assert err.splitlines() == [
        f"written: {tmp_path / 'press.json'}",
        "fail a: Moment. Moment 200 N·m, allowed 150 N·m: shorten the arm.",
        "1 of 1 checks fails; 2 default values are open. Governing: a.moment.",
    ]


def test_quiet_tells_errors_only(tmp_path: Path, capfd: Capture) -> None:
    assert run("report", saved(tmp_path, FAILS), "-o", tmp_path, "--format", "json", "--quiet") == 1
    assert run("validate", saved(tmp_path, LEVER), "--quiet") == 0
    assert capfd.readouterr() == ("", "")
    lost = tmp_path / "lost.yaml"
    assert run("calc", lost, "--quiet") == 2
    assert capfd.readouterr().err == f"{lost}: There is no such file. Check the name and the folder.\n"


@pytest.mark.wheel
def test_validate_reports_all_problems_of_all_files(tmp_path: Path, capfd: Capture) -> None:
    one = saved(tmp_path, LEVER.replace("2 kN", "2 kg, arm: -1"), "one.yaml")
    two, three = saved(tmp_path, LEVER, "two.yaml"), saved(tmp_path, "a: [", "three.yaml")
    assert run("validate", one, two, three) == 2
    out, err = capfd.readouterr()
    assert out == ""
    places = [line.split(" ")[0] for line in err.splitlines()]
    assert places == [f"{one}:5:27:", f"{one}:5:38:", f"{two}:", f"{three}:2:1:"]


@pytest.mark.wheel
def test_a_broken_plugin_gives_3_and_the_results_of_the_others(tmp_path: Path, capfd: Capture) -> None:
    config = saved(tmp_path, FAILS + "  x: {kind: breaks_in_calculation}\n")
    assert run("calc", config, "--plugins", BROKEN) == 3
    out, err = capfd.readouterr()
    assert json.loads(out)["mechanisms"]["a"]["outputs"]["moment"]["value"] == 200
    assert err.startswith(
        "mechanism 'x' of plugin 'breaks_in_calculation': RuntimeError: the plugin fell over (breaks_in_calculation.py:"
    )
    assert run("report", config, "--plugins", BROKEN, "-o", tmp_path, "--format", "json") == 3
    assert json.loads((tmp_path / "press.json").read_text("utf-8"))["status"] == "error"


def test_a_broken_comparison_gives_3_and_is_told(tmp_path: Path, capfd: Capture) -> None:
    config = saved(tmp_path, LEVER + "  x: {kind: breaks_in_comparison}\n")
    assert run("report", config, "--plugins", GOOD, "--plugins", BROKEN, "-o", tmp_path, "--format", "json") == 3
    err = capfd.readouterr().err
    assert "RuntimeError: the comparison fell over (breaks_in_comparison.py:" in err
    assert "1 of 3 mechanisms and comparisons were not calculated." in err and "No check fails." not in err


def test_validate_finds_a_plugin_that_cannot_be_loaded(tmp_path: Path, capfd: Capture) -> None:
    config = saved(tmp_path, LEVER + "  x: {kind: breaks_at_import}\n")
    assert run("validate", config, "--plugins", BROKEN) == 3
    assert capfd.readouterr().err.startswith("mechanism 'x' of plugin 'breaks_at_import': it cannot be loaded from")


@pytest.mark.wheel
def test_plugins_lists_kinds_sources_and_origins(capfd: Capture) -> None:
    assert run("plugins") == 0
    out, err = capfd.readouterr()
    assert err == ""
    assert "cylinder_sizing 1.0: Impression cylinder" in out and "    source 002: Loizyk" in out
    assert f"lever 0.1: Lever\n    from {GOOD / 'lever.py'}\n" in out


def test_plugins_tells_broken_and_doubled_ones(tmp_path: Path, capfd: Capture) -> None:
    assert run("plugins", "--plugins", BROKEN) == 3
    out, err = capfd.readouterr()
    assert "lever 0.1" in out and "breaks_at_import" not in out
    assert [line.split("'")[1] for line in err.splitlines()] == ["breaks_at_import", "no_mechanism", "other_name"]
    (tmp_path / "lever.py").touch()
    assert run("plugins", "--plugins", tmp_path) == 3
    assert f"comes from {tmp_path / 'lever.py'} and from {GOOD / 'lever.py'}" in capfd.readouterr().err


@pytest.mark.wheel
def test_schema_of_all_and_of_one_kind(capfd: Capture) -> None:
    assert run("schema") == 0
    assert "lever" in json.loads(capfd.readouterr().out)["$defs"]
    assert run("schema", "lever") == 0
    assert json.loads(capfd.readouterr().out)["properties"]["kind"] == {"const": "lever"}
    assert run("schema", "levre") == 2
    own = [entry.parent.name for entry in Path(str(plugins.__file__)).parent.glob("*/__init__.py")]
    known = ", ".join(sorted(["lever", *own]))
    assert capfd.readouterr() == ("", f"'levre' is not a known kind (did you mean 'lever'?). Known: {known}.\n")
    assert run("schema", "--plugins", BROKEN) == 3
    assert "breaks_at_import" in capfd.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["report", "x.yaml", "--format", "html,pfd"], "'pfd' is not a format (did you mean 'pdf'?); known: html, pdf, docx, xlsx, json."),
        (["report", "x.yaml", "--format", ","], "no format is named"),
        (["report", "x.yaml", "--language", "xx"], "is 'xx', of which the program has no catalogue; allowed: en, uk"),
        (["calc"], "Missing argument 'CONFIG'"),
        (["check"], "Missing argument"),
        (["validate"], "Missing argument"),
        (["repotr", "x.yaml"], "No such command 'repotr'"),
        (["calc", "x.yaml", "--colour"], "No such option"),
        (["plugins", "--plugins", "/nowhere"], "/nowhere: There is no such folder of plugins."),
        ([], "Usage: diecut-report"),
    ],
)  # fmt: skip
@pytest.mark.wheel
def test_wrong_usage_gives_2_with_words(arguments: list[str], words: str, capfd: Capture) -> None:
    assert main(arguments) == 2
    out, err = capfd.readouterr()
    assert out == "" and words in err


@pytest.mark.wheel
def test_help_and_version_go_to_standard_output(capfd: Capture) -> None:
    assert main(["--version"]) == main(["report", "--help"]) == 0
    out, err = capfd.readouterr()
    assert __version__ in out and "--plugins DIR" in out and err == ""


# --- bad input -------------------------------------------------------------------------------------------------------

BAD: dict[str, tuple[str | bytes, str]] = {
    "wrong unit": (LEVER.replace("2 kN", "2 mm"), "2 mm is a length; a force is needed"),
    "impossible machine": (LEVER.replace("2 kN", "2, teeth: 120"), "a hundred at most"),
    "exploding anchors": (
        "a0: &a0 [x, x]\n" + "".join(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]\n" for i in range(1, 12)),
        "200000 values",
    ),
    "not utf-8": (b"\xff\xfe\x00\x01", "not UTF-8"),
    "binary junk": (bytes(range(256)) * 8, ""),
    "binary zeros": (b"schema_version: 1\n\0\0\0", "control character"),
}  # fmt: skip


@pytest.mark.parametrize("command", ["report", "calc", "validate"])
@pytest.mark.parametrize("name", BAD)
@pytest.mark.wheel
def test_bad_input_is_told_and_nothing_is_written(tmp_path: Path, capfd: Capture, name: str, command: str) -> None:
    content, words = BAD[name]
    config = tmp_path / "press.yaml"
    config.write_bytes(content if isinstance(content, bytes) else content.encode())
    where = {"report": ["-o", tmp_path / "out"], "calc": ["-o", tmp_path / "out" / "r.json"], "validate": []}[command]
    code = run(command, config, *where)
    out, err = capfd.readouterr()
    assert (code, out) == (2, "")
    assert err.startswith(f"{config}:") and words in err and "Traceback" not in err
    assert list(tmp_path.iterdir()) == [config]


@pytest.mark.parametrize("target", ["press.yaml/out", "/proc/self/fdinfo", "/dev/null/out"])
def test_an_unwritable_output_folder_is_told(tmp_path: Path, capfd: Capture, target: str) -> None:
    config = saved(tmp_path, LEVER)
    assert run("report", config, "-o", tmp_path / target, "--format", "json") == 2
    assert "This cannot be written: " in capfd.readouterr().err
    assert run("calc", config, "-o", tmp_path / target / "r.json") == 2
    assert "This cannot be written: " in capfd.readouterr().err
    assert list(tmp_path.iterdir()) == [config]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_a_full_disk_is_told(tmp_path: Path, capfd: Capture) -> None:
    config = saved(tmp_path, LEVER)
    assert run("calc", config, "-o", "/dev/full") == 74
    assert "the disk is full" in capfd.readouterr().err
    with Path("/dev/full").open("wb") as stream:
        done = program("calc", config, "--plugins", GOOD, stdout=stream, stderr=subprocess.PIPE)
    assert done.returncode == 74
    assert done.stderr.startswith(b"Standard output cannot be written: the disk is full.")
    assert b"Traceback" not in done.stderr


def test_what_is_no_file_is_written_into_and_not_replaced(tmp_path: Path) -> None:
    assert run("calc", saved(tmp_path, LEVER), "-o", os.devnull) == 0
    assert not Path(os.devnull).is_file()


@pytest.mark.nightly
def test_a_reader_that_closes_early_is_no_error() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as stream:
        done = program("schema", stdout=stream, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (0, b"")


def test_a_fault_of_the_program_is_neither_a_failing_check_nor_bad_input(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("diecut_report.press.results_text", lambda results: 1 / 0)
    assert run("calc", saved(tmp_path, LEVER)) == 70
    out, err = capfd.readouterr()
    assert out == "" and "ZeroDivisionError" in err and "a fault of diecut-report itself" in err


# --- terminal --------------------------------------------------------------------------------------------------------


def on_terminal(*arguments: object, **environment: str) -> str:
    """What a command shows on standard error when that is a terminal."""
    try:
        parent, child = pty.openpty()
    except OSError as error:
        pytest.skip(f"this machine has no pseudo-terminals: {error}")
    command = [sys.executable, "-m", "diecut_report", *map(str, arguments)]
    plain = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")}
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=child, env=plain | {"TERM": "xterm"} | environment)
    os.close(child)
    shown = b""
    while chunk := _read(parent):
        shown += chunk
    os.close(parent)
    return shown.decode()


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 65536)
    except OSError:  # the other end is closed: all has been read
        return b""


SLOW = "import time\nfrom diecut_report.api import Inputs, Mechanism\ntime.sleep(2)\n" + (
    "MECHANISM = Mechanism(kind='slow', version='1', title='Slow', summary='', inputs=Inputs, chapters=())\n"
)


@pytest.mark.nightly
def test_colours_and_what_it_does_are_shown_only_on_a_terminal_that_wants_them(tmp_path: Path) -> None:
    """What it does is shown when that takes longer than a second."""
    saved(tmp_path, SLOW, "slow.py")
    kinds = ["--plugins", GOOD, "--plugins", tmp_path]
    call = ["calc", saved(tmp_path, FAILS + "  x: {kind: slow}\n"), "-o", tmp_path / "out.json", *kinds]
    unwanted = ({"NO_COLOR": "1"}, {"TERM": "dumb"})
    with ThreadPoolExecutor() as together:  # each waits most of its time
        wanted, piped = together.submit(on_terminal, *call), together.submit(program, *call)
        plain = [told.result() for told in [together.submit(on_terminal, *call, **variables) for variables in unwanted]]
    shown = wanted.result()
    assert "reading the configuration" in shown and "\x1b[31mfail\x1b[0m a: Moment." in shown
    for told in (*plain, piped.result().stderr.decode()):
        assert "fail a: Moment." in told and "\x1b" not in told


@pytest.mark.nightly
def test_an_interrupted_run_ends_at_once_and_writes_nothing(tmp_path: Path) -> None:
    (tmp_path / "slow.py").write_text(
        SLOW.replace("sleep(2)", "sleep(60)").replace("import time\n", "import time, sys\nprint('here')\n", 1)
    )
    config = saved(tmp_path, HEAD + "  a: {kind: slow}\n")
    program = [sys.executable, "-u", "-m", "diecut_report"]
    command = [*program, "calc", str(config), "--plugins", str(tmp_path), "-o", str(tmp_path / "r.json")]
    attended = partial(
        signal.signal, signal.SIGINT, signal.SIG_DFL
    )  # what a background job ignores is ignored here too
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=attended) as running:
        assert running.stderr is not None
        assert running.stderr.readline() == b"here\n"
        running.send_signal(signal.SIGINT)
        _, told = running.communicate(timeout=30)
    assert (running.returncode, told.strip()) == (130, b"")
    assert not (tmp_path / "r.json").exists()


def test_progress_is_not_shown_when_it_is_quick(capfd: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("diecut_report.cli.output.SECONDS_UNSHOWN", 60)
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    with Progress() as progress:
        progress("doing")
        assert progress.timer.is_alive()
    progress.timer.join(10)
    assert not progress.timer.is_alive() and capfd.readouterr() == ("", "")


def test_where_there_is_no_terminal_a_line_tells_now_and_then_what_is_done(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.stderr.isatty", lambda: False, raising=False)
    monkeypatch.setattr(output, "SECONDS_BETWEEN", 0.05)
    with Progress() as progress:
        progress("doing this")
        time.sleep(0.3)
        progress("doing that")
        time.sleep(0.3)
    told = capfd.readouterr().err.splitlines()
    assert {"doing this …", "doing that …"} == set(told) and 4 <= len(told) <= 14


@pytest.mark.parametrize(("quiet", "terminal"), [(True, False), (True, True)])
def test_progress_keeps_quiet_where_it_is_told_to(quiet: bool, terminal: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stderr.isatty", lambda: terminal, raising=False)
    with click.Context(click.Command("calc")) as context:
        context.meta.update({QUIET: True} if quiet else {})
        progress = Progress()
    with progress:
        progress("doing")
        assert not progress.timer.is_alive()


# --- what is imported ------------------------------------------------------------------------------------------------


SLOW_TO_IMPORT = ("matplotlib", "jinja2", "weasyprint", "pint", "rich", "ezdxf", "scipy.stats", "diecut_report.report")


@pytest.mark.nightly
def test_calc_imports_nothing_that_draws_or_is_slow(example: Example) -> None:
    assert example.imported.isdisjoint(SLOW_TO_IMPORT)


def test_validate_imports_nothing_that_draws_or_is_slow(tmp_path: Path) -> None:
    imported = in_another_process("validate", saved(tmp_path, SMALL)).imported
    assert "diecut_report.config" in imported
    assert imported.isdisjoint({*SLOW_TO_IMPORT, "scipy.integrate", "scipy.optimize"})


@pytest.mark.wheel
def test_the_example_is_calculated_with_its_failing_checks(example: Example) -> None:
    assert example.code == 1
    found = json.loads(example.told)
    failing = [c["id"] for data in found["mechanisms"].values() for c in data["checks"] if c["status"] == "fail"]
    assert failing[:3] == ["wall_at_flat", "radius", "closed_section"] and "timing" in failing
    assert found["governing"] == {"mechanism": "cylinder", "check": "wall_at_flat"}
