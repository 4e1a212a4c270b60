"""Nothing that lies in the current folder, in HOME or in variables is run or changes a report, and a report leaves and needs nothing else."""

from __future__ import annotations

import ast
import errno
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import diecut_report
from diecut_report.cli.main import main
from diecut_report.cli.output import UNWRITABLE
from tests.configs import SMALL, saved
from tests.examples import few
from tests.hostile.bounded import run

STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary:
  mechanisms.clutch.shoe_radius: [120 mm, 130 mm]
"""
MODULES = sorted(
    {name for name in sys.stdlib_module_names if not name.startswith("_")}
    | {"click", "duckdb", "jinja2", "matplotlib", "numpy", "pyarrow", "pydantic", "rich", "scipy", "weasyprint", "yaml"}
)
TRAP = "import os\nos.write(os.open(os.environ['TRAPS'], os.O_WRONLY | os.O_CREAT | os.O_APPEND), {name!r}.encode() + b'\\n')\n"
COMPILERS = ("gcc", "cc", "ld", "objdump", "latex", "pdflatex", "dvipng", "kpsewhich")
PROGRAM = [sys.executable, "-P", "-m", "diecut_report"]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Give a folder with a config, a study, and a trap by the name of each module that the program could import."""
    place = tmp_path / "press"
    place.mkdir()
    saved(place, SMALL)
    saved(place, STUDY, "study.yaml")
    for name in MODULES:
        saved(place, TRAP.format(name=name), f"{name}.py")
    return place


def ran(folder: Path, command: list[str], **variables: str) -> str:
    """Run a command in the folder, which it must end well; what fell into a trap."""
    told = folder.parent / "trapped.txt"
    told.unlink(missing_ok=True)
    surroundings: Mapping[str, str] = {**os.environ, "TRAPS": str(told), **variables}
    clean = {name: value for name, value in surroundings.items() if name != "PYTHONSAFEPATH"}
    done = subprocess.run(command, cwd=folder, env=clean, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    return told.read_text() if told.exists() else ""


def test_a_shadowing_module_is_reported_where_it_would_run(tmp_path: Path) -> None:
    """In a folder of its own: among all traps there are modules that newer interpreters import before the command."""
    for name in ("yaml", "colorsys"):
        saved(tmp_path, TRAP.format(name=name), f"{name}.py")
    assert ran(tmp_path, [sys.executable, "-c", "import yaml, colorsys"]) == "yaml\ncolorsys\n"


@pytest.mark.nightly
def test_nor_as_a_module_where_python_itself_leaves_the_choice(folder: Path) -> None:
    (folder / "pkgutil.py").unlink(missing_ok=True)  # Python's own -m imports it before the program begins
    assert ran(folder, [sys.executable, "-m", "diecut_report", "calc", "press.yaml", "-o", "out.json"]) == ""


@pytest.fixture
def notebook(tmp_path: Path) -> dict[str, str]:
    """Give the variables of a notebook with settings of its own, and with programs that tell when they are started."""
    home, programs = tmp_path / "home", tmp_path / "bin"
    (home / "matplotlib").mkdir(parents=True)
    saved(home / "matplotlib", "font.size: 31\nlines.linewidth: 9\n", "matplotlibrc")
    programs.mkdir()
    for name in COMPILERS:
        path = saved(programs, f'#!/bin/sh\necho {name} >>"$TRAPS"\nexit 1\n', name)
        path.chmod(0o755)
    return {
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "MPLCONFIGDIR": str(home / "matplotlib"),
        "PATH": f"{programs}:{os.environ['PATH']}",
    }


@pytest.mark.nightly
def test_a_report_is_the_same_in_all_surroundings(folder: Path, notebook: dict[str, str], small_report: Path) -> None:
    """The same as in the clean ones of the tests, whose strings have other hashes too."""
    saved(folder, SMALL, "small.yaml")
    saved(folder, "text.usetex: True\naxes.formatter.use_locale: True\nsavefig.dpi: 7\n", "matplotlibrc")
    command = [*PROGRAM, "report", "small.yaml", "--format", "html,pdf,json", "-o", "noted"]
    apart = {"PYTHONHASHSEED": "4711", "XDG_CACHE_HOME": str(folder / "cache")}  # where no figure is kept
    assert ran(folder, command, **apart, **notebook) == ""
    for ending in ("html", "pdf", "json"):
        assert (folder / f"noted/small.{ending}").read_bytes() == (small_report / f"small.{ending}").read_bytes()


@pytest.mark.nightly
def test_nor_do_the_processes_and_the_summary_of_a_study_obey_them(folder: Path, notebook: dict[str, str]) -> None:
    saved(folder, "text.usetex: True\n", "matplotlibrc")
    script = shutil.which("diecut-report", path=str(Path(sys.executable).parent))
    assert script is not None
    assert ran(folder, [script, "batch", "study.yaml", "-o", "out", "--jobs", "2", "--quiet"], **notebook) == ""
    assert (folder / "out/summary.pdf").stat().st_size > 10_000


# `report` and `render` set pages by the same call; `verify` has them set beside its own files
@pytest.mark.nightly
@pytest.mark.parametrize("command", few(["render", "verify"], keep=lambda command: command == "render"))
def test_a_pdf_leaves_nothing_among_the_temporary_files(tmp_path: Path, small_report: Path, command: str) -> None:
    """By the program itself, which ends at once and lets no library put its things in order."""
    (tmp_path / "tmp").mkdir()
    given = {
        "render": [small_report / "small.json", "--format", "pdf", "-o", "out"],
        "verify": [small_report / "small.pdf"],
    }[command]
    ran(tmp_path, [*PROGRAM, command, *map(str, given), "--quiet"], TMPDIR=str(tmp_path / "tmp"))
    assert [*(tmp_path / "tmp").iterdir()] == [] and (tmp_path / "out").exists() == (command == "render")


@pytest.mark.parametrize("command", few(["report", "render", "verify"], keep=lambda command: command == "report"))
@pytest.mark.nightly
def test_no_room_for_the_files_of_fonts_is_told(
    tmp_path: Path, small_report: Path, command: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    write_bytes = Path.write_bytes

    def full(path: Path, content: Any) -> int:
        if "weasyprint-" in str(path):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write_bytes(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    out = ["-o", tmp_path / "out", "--format", "pdf"]
    given = {"report": [saved(tmp_path, SMALL), *out], "render": [small_report / "small.json", *out],
             "verify": [small_report / "small.pdf"]}[command]  # fmt: skip
    assert main([command, *map(str, given), "--quiet"]) == UNWRITABLE
    said, words = (
        capfd.readouterr().err,
        "the disk is full. Nothing was written; free disk space, or name another folder",
    )
    assert f"{words} in the variable TMPDIR." in said and "Traceback" not in said and not (tmp_path / "out").exists()


def test_no_folder_for_temporary_files_is_told(
    small_report: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def none() -> str:
        raise FileNotFoundError(errno.ENOENT, "No usable temporary directory found in ['/tmp']")

    command = ["render", small_report / "small.json", "-o", tmp_path / "out", "--format", "pdf", "--quiet"]
    with monkeypatch.context() as patch:
        patch.setattr(tempfile, "gettempdir", none)
        assert main([*map(str, command)]) == UNWRITABLE
    assert "No folder for temporary files has enough free space." in capfd.readouterr().err


@pytest.mark.nightly
@pytest.mark.parametrize(
    "variables", few([["HOME"], ["XDG_CACHE_HOME", "MPLCONFIGDIR"]], keep=lambda each: len(each) > 1), ids=" ".join
)
def test_folders_of_the_user_that_cannot_be_written_are_done_without_in_silence(
    tmp_path: Path, variables: list[str]
) -> None:
    (tmp_path / "tmp").mkdir()
    config = saved(tmp_path, SMALL)
    own = ("XDG_CACHE_HOME", "XDG_CONFIG_HOME", "MPLCONFIGDIR")
    surroundings = {key: value for key, value in os.environ.items() if key not in own}
    surroundings |= {"TMPDIR": str(tmp_path / "tmp")} | dict.fromkeys(variables, "/dev/null")
    command = [*PROGRAM, "report", str(config), "-o", str(tmp_path / "out"), "--format", "html", "--quiet"]
    done = subprocess.run(command, env=surroundings, capture_output=True, text=True, check=False, timeout=120)
    told = [line for line in done.stderr.splitlines() if not line.startswith("not checked")]
    assert (done.returncode, told, [*(tmp_path / "tmp").iterdir()]) == (0, [], [])


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
