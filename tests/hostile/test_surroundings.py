"""Nothing that lies in the current folder, in HOME or in the variables of a notebook is run, or changes a report."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from tests.configs import SMALL, saved

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
    assert ran(folder, command, PYTHONHASHSEED="4711", **notebook) == ""
    for ending in ("html", "pdf", "json"):
        assert (folder / f"noted/small.{ending}").read_bytes() == (small_report / f"small.{ending}").read_bytes()


@pytest.mark.nightly
def test_nor_do_the_processes_and_the_summary_of_a_study_obey_them(folder: Path, notebook: dict[str, str]) -> None:
    saved(folder, "text.usetex: True\n", "matplotlibrc")
    script = shutil.which("diecut-report", path=str(Path(sys.executable).parent))
    assert script is not None
    assert ran(folder, [script, "batch", "study.yaml", "-o", "out", "--jobs", "2", "--quiet"], **notebook) == ""
    assert (folder / "out/summary.pdf").stat().st_size > 10_000
