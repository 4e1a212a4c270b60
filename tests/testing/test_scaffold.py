"""A new mechanism runs as it is written: its tests, its check, its report, its study; as a folder and as a package."""

from __future__ import annotations

import json
import os
import runpy
import subprocess
import sys
import venv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.testing.contract import ContractTest
from diecut_report.testing.scaffold import LIKE, contents
from diecut_report.text.catalogues import file_beside
from diecut_report.text.po_files import read

Capture = pytest.CaptureFixture[str]
FOLDER = {
    "plugins/toggle.py", "plugins/toggle.uk.po", "tests/test_toggle.py", "examples/toggle.yaml", "examples/toggle_study.yaml", "README.md",
}  # fmt: skip
PACKAGE = {
    "src/diecut_toggle/__init__.py", "src/diecut_toggle/locale/uk.po", "src/diecut_toggle/py.typed", "tests/test_toggle.py",
    "examples/toggle.yaml", "examples/toggle_study.yaml", "README.md", "pyproject.toml",
}  # fmt: skip


def made(folder: Path, *options: str) -> Path:
    """The folder of a new mechanism."""
    assert main(["new-plugin", "toggle", *options, "-o", str(folder / "toggle"), "--quiet"]) == 0
    return folder / "toggle"


def like_of(options: tuple[str, ...]) -> str:
    """What a new mechanism with these options is made like."""
    return options[1] if "--like" in options else LIKE[0]


def run_tests(file: Path) -> int:
    """Run the test functions of a file; how many there are."""
    found: dict[str, Callable[[], None]] = {n: f for n, f in runpy.run_path(str(file)).items() if n.startswith("test_")}
    for test in found.values():
        test()
    return len(found)


MOTION, SELECTION = ("--like", "motion"), ("--like", "selection")


@pytest.mark.wheel
@pytest.mark.parametrize(
    ("options", "files"),
    [
        ((), FOLDER),
        (("--package",), PACKAGE),
        (MOTION, FOLDER),
        (SELECTION, FOLDER | {"plugins/toggle_sizes.csv"}),
        ((*SELECTION, "--package"), PACKAGE | {"src/diecut_toggle/sizes.csv"}),
    ],
)
def test_all_files_are_written_and_told(
    tmp_path: Path, capfd: Capture, options: tuple[str, ...], files: set[str]
) -> None:
    home = tmp_path / "deep" / "toggle"
    assert main(["new-plugin", "toggle", *options, "-o", str(home)]) == 0
    assert {str(path.relative_to(home)) for path in home.rglob("*") if path.is_file()} == files
    told = capfd.readouterr().err.splitlines()
    assert told[:-1] == [
        f"written: {home / place}"
        for place in contents("toggle", as_package="--package" in options, like=like_of(options))
    ]
    assert told[-1] == f"next: read {home / 'README.md'}"
    assert not any("@" in path.read_text("utf-8") for path in home.rglob("*") if path.is_file())


@pytest.mark.wheel
@pytest.mark.usefixtures("without_summary")
def test_a_new_mechanism_runs_as_it_is(tmp_path: Path, capfd: Capture) -> None:
    home = made(tmp_path)
    plugins, config = ("--plugins", str(home / "plugins")), str(home / "examples" / "toggle.yaml")
    assert run_tests(home / "tests" / "test_toggle.py") == 4
    assert main(["report", config, *plugins, "-o", str(home / "build"), "--format", "html,json", "--strict"]) == 0
    assert "written: " in capfd.readouterr().err
    results = json.loads((home / "build" / "toggle.json").read_text("utf-8"))["mechanisms"]["toggle"]
    assert results["plugin_file"] == "toggle.py" and results["plugin_check"] == "passed"
    page = (home / "build" / "toggle.html").read_text("utf-8")
    assert '<span class="key">toggle.py</span>, declarations and formulas checked' in page
    study = str(home / "examples" / "toggle_study.yaml")
    assert (
        main(["batch", study, *plugins, "-o", str(home / "build" / "study"), "--quiet"]) == 1
    )  # the longest travel fails
    rows: list[dict[str, Any]] = pq.read_table(home / "build" / "study" / "variants").to_pylist()
    assert len(rows) == 39 and {row["status"] for row in rows} == {"pass", "fail"}
    assert "slow" not in capfd.readouterr().err


@pytest.mark.wheel
def test_a_package_runs_from_its_sources(tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    home = made(tmp_path, "--package")
    monkeypatch.syspath_prepend(str(home / "src"))
    assert run_tests(home / "tests" / "test_toggle.py") == 4
    sys.modules.pop("diecut_toggle")
    assert main(["validate", str(home / "examples" / "toggle.yaml"), "--plugins", str(home)]) == 0
    assert main(["plugins", "--plugins", str(home)]) == 0
    assert f"toggle 0.1: Springs of an ejector\n    from {home / 'src' / 'diecut_toggle'}" in capfd.readouterr().out


@pytest.mark.usefixtures("without_summary")
@pytest.mark.parametrize(
    ("options", "tests", "variants"), [pytest.param(MOTION, 5, 39, marks=pytest.mark.nightly), (SELECTION, 4, 39)]
)
def test_each_other_beginning_runs_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: tuple[str, ...], tests: int, variants: int
) -> None:
    monkeypatch.setattr("diecut_report.testing.extreme_inputs.EXTREMES", 6)  # all of them are tried at night
    home = made(tmp_path, *options)
    plugins, config = ("--plugins", str(home / "plugins")), str(home / "examples" / "toggle.yaml")
    assert run_tests(home / "tests" / "test_toggle.py") == tests
    assert main(["calc", config, *plugins, "-o", str(home / "toggle.json"), "--strict"]) == 0
    study = str(home / "examples" / "toggle_study.yaml")
    assert main(["batch", study, *plugins, "-o", str(home / "study"), "--quiet"]) == 1  # some fail
    rows: list[dict[str, Any]] = pq.read_table(home / "study" / "variants").to_pylist()
    assert len(rows) == variants and {row["status"] for row in rows} == {"pass", "fail"}


@pytest.mark.nightly
@pytest.mark.parametrize("options", [MOTION, SELECTION])
def test_each_other_beginning_holds_with_all_extremes(tmp_path: Path, options: tuple[str, ...]) -> None:
    assert run_tests(made(tmp_path, *options) / "tests" / "test_toggle.py") > 3


@pytest.mark.parametrize("like", LIKE)
def test_a_configuration_begins_with_its_example_and_calculates(tmp_path: Path, capfd: Capture, like: str) -> None:
    home = made(tmp_path, "--like", like)
    config = str(tmp_path / "press.yaml")
    assert main(["new", "toggle", "--plugins", str(home / "plugins"), "-o", config]) == 0
    assert main(["calc", config, "--plugins", str(home / "plugins"), "-o", str(tmp_path / "press.json")]) == 0
    assert "guess" not in capfd.readouterr().err


@pytest.mark.parametrize("like", LIKE)
def test_all_its_texts_are_translated(tmp_path: Path, like: str) -> None:
    home = made(tmp_path, "--like", like)
    known = Discovery([home / "plugins"])
    assert list(ContractTest(known.mechanism("toggle"), known).words.untranslated("uk")) == []
    found = read(file_beside(home / "plugins" / "toggle.py", "uk"), "uk")
    assert all(message.string for message in found if message.id)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Toggle", "'Toggle' cannot be the name of a kind: give small letters a to z, digits and underscores, a letter first"),
        ("2nd", "cannot be the name of a kind"),
        ("тигель", "cannot be the name of a kind"),
        ("../there", "cannot be the name of a kind"),
        ("a" * 41, "at most 40 in all"),
        ("clutch", "There is a kind 'clutch' already, from the program itself; choose another name."),
        ("lambda", "'lambda' is reserved and cannot be the name of a kind"),
        ("press", "'press' is reserved"),
        ("extend_laws", "'extend_laws' is reserved"),
    ],
)  # fmt: skip
def test_a_name_that_cannot_be_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Capture, name: str, words: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new-plugin", name]) == 2
    assert words in capfd.readouterr().err and not list(tmp_path.iterdir())


def test_what_is_there_is_not_written_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Capture) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "toggle").mkdir()
    assert main(["new-plugin", "toggle"]) == 2
    assert "toggle: This name already exists and is not overwritten." in capfd.readouterr().err
    assert not list((tmp_path / "toggle").iterdir())


@pytest.mark.nightly
@pytest.mark.parametrize("like", LIKE)
def test_a_package_is_installed_checked_run_reported_and_batched(tmp_path: Path, like: str) -> None:
    home, room = made(tmp_path, "--package", "--like", like), tmp_path / "room"
    venv.create(room, with_pip=True)
    here = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}

    def done(*command: str, code: int = 0) -> str:
        ran = subprocess.run(
            [str(room / "bin" / "python"), *command], cwd=home, env=here, capture_output=True, text=True
        )
        assert ran.returncode == code, ran.stdout + ran.stderr
        return ran.stdout + ran.stderr

    done("-m", "pip", "uninstall", "--yes", "setuptools")  # that of venv is older than packages want
    libraries = [path for path in sys.path if path.endswith("site-packages")]
    lines = [
        f"import site; site.addsitedir({path!r})" for path in libraries
    ]  # the program too, wherever it is installed
    (next((room / "lib").iterdir()) / "site-packages" / "libraries.pth").write_text("\n".join(lines))
    done("-m", "pip", "install", "--no-deps", "--no-build-isolation", "--no-index", ".")
    done("-P", "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests")
    told = done("-P", "-m", "diecut_report", "check-plugin", "toggle", "--config", "examples/toggle.yaml")
    assert told.startswith("toggle 0.1, from the package diecut-toggle 0.1.0") and "note" not in told
    done("-P", "-m", "diecut_report", "report", "examples/toggle.yaml", "-o", "build")
    done("-P", "-m", "diecut_report", "batch", "examples/toggle_study.yaml", "-o", "build/study", code=1)  # some fail
    assert (home / "build" / "toggle.pdf").stat().st_size > 10_000
    assert (home / "build" / "study" / "summary.html").is_file()
