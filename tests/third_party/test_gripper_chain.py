"""The gripper chain of ``examples/`` serves whoever installs it: it is found, calculates, reports, and proves itself."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from tests.cli.test_cli import run
from tests.shared import once
from tests.third_party.installed import EXAMPLES, install, run_with

PACKAGE = EXAMPLES / "gripper-chain"
CONFIG = PACKAGE / "configs" / "sheet_transport.yaml"


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return once(tmp_path_factory, "gripper_chain", lambda made: install(PACKAGE, made / "site")) / "site"


def command(folder: Path, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return run_with(folder, "-m", "diecut_report", *arguments)


@pytest.mark.nightly
def test_it_calculates_where_it_is_installed(folder: Path, tmp_path: Path) -> None:
    done = command(folder, "calc", CONFIG, "-o", tmp_path / "results.json")
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "results.json").read_text("utf-8"))["mechanisms"]["transport"]
    assert found["outputs"]["chain_speed"]["value"] == pytest.approx(6000 / 3600 * 48 * 0.01905)
    assert {check["class"] for check in found["checks"]} == {"function", "strength", "practice", "numerical"}
    assert set(found["phases"]) == {"picking", "carrying"} and len(found["figures"]) == 5


@pytest.mark.nightly
def test_its_own_tests_pass(folder: Path) -> None:
    done = run_with(folder, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests", cwd=PACKAGE)
    assert done.returncode == 0, done.stdout


@pytest.mark.nightly
def test_it_keeps_all_rules_of_the_contract(folder: Path, tmp_path: Path) -> None:
    done = command(folder, "check-plugin", "gripper_chain", "--config", CONFIG, "-o", tmp_path / "chapter.html")
    told = done.stdout.splitlines()[1:]
    assert done.returncode == 0 and all(line.startswith("  holds  ") for line in told) and len(told) >= 9, done.stdout


@pytest.mark.nightly
@pytest.mark.parametrize(("language", "title"), [("en", "Slack strand"), ("uk", "Ведена вітка")])
def test_it_is_reported_in_both_languages(folder: Path, tmp_path: Path, language: str, title: str) -> None:
    done = command(folder, "report", CONFIG, "-o", tmp_path, "--language", language, "--detail", "full")
    assert done.returncode == 0 and (tmp_path / "sheet_transport.pdf").stat().st_size > 50_000, done.stderr
    text = (tmp_path / "sheet_transport.html").read_text("utf-8")
    assert title in text and text.count("<figure") >= 5
    assert ("bracketed root search" in text) is (language == "en")
    assert (tmp_path / "sheet_transport.transport.tooth.csv").is_file()


@pytest.mark.nightly
def test_its_study_runs_and_is_told_of(folder: Path, tmp_path: Path) -> None:
    done = command(folder, "batch", PACKAGE / "configs" / "rates_and_teeth.yaml", "-o", tmp_path / "study")
    assert done.returncode in (0, 1), done.stderr
    state = json.loads((tmp_path / "study" / "study.json").read_text("utf-8"))
    assert state["counts"]["variants"] == 30 and "error" not in state["counts"] and not state["slow"]
    assert "gripper_chain" in command(folder, "plugins").stdout


def test_its_project_folder_serves_without_being_installed(capfd: pytest.CaptureFixture[str]) -> None:
    assert run("calc", CONFIG, "--plugins", PACKAGE) == 0
    assert json.loads(capfd.readouterr().out)["mechanisms"]["transport"]["kind"] == "gripper_chain"
