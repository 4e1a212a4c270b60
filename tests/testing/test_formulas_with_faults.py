"""What a foreign plugin with faults in its formulas calculates is told with them, wherever its verdict stands."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from tests.testing.test_check_plugin import toggle

Capture = pytest.CaptureFixture[str]
WRONG = ("wire**4 / (8", "wire**5 / (8")  # springs that are too soft, so that no check fails
SAID = "The formulas of the plugin of 'toggle' have faults; do not rely on its results."
FAULT = "  toggle.py:59: spring_rate: "


def run(home: Path, *arguments: str) -> int:
    """The exit code of a command with the plugins of a project."""
    return main([*arguments, "--plugins", str(home / "plugins")])


def text(page: Path) -> str:
    """A page without its marks."""
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", page.read_text("utf-8")))


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """The project of a new mechanism that has a wrong formula, and no failing check."""
    return toggle(tmp_path, WRONG)


def test_a_report_tells_the_faults_and_is_not_whole(tmp_path: Path, home: Path, capfd: Capture) -> None:
    asked = ("report", str(home / "examples" / "toggle.yaml"), "--format", "html,json", "-o", str(tmp_path))
    assert run(home, *asked) == 0
    told = capfd.readouterr().err
    assert SAID in told and FAULT in told and "No check fails, but formulas of a plugin have faults." in told
    results = json.loads((tmp_path / "toggle.json").read_text("utf-8"))
    page = text(tmp_path / "toggle.html")
    assert results["mechanisms"]["toggle"]["plugin_check"] == "failed"
    assert "The formulas of the plugin of toggle have faults" in page
    assert "? conditional" in page and "formulas of a plugin have faults" in page
    assert "All checks pass" not in page and "NOT RELEASED" in page
    assert run(home, *asked, "--strict") == 1


def test_check_and_calc_are_strict_and_tell_it(tmp_path: Path, home: Path, capfd: Capture) -> None:
    config = home / "examples" / "toggle.yaml"
    assert run(home, "check", str(config), "-o", str(tmp_path), "--format", "html") == 0
    told = capfd.readouterr()
    assert "conditional, formulas with faults" in told.out and SAID in told.err and FAULT in told.err
    assert SAID in text(tmp_path / "machines.html").replace("&#39;", "'")
    for command in ("check", "calc"):
        assert run(home, command, str(config)) == 0
        assert run(home, command, str(config), "--strict") == 1
        capfd.readouterr()


@pytest.mark.usefixtures("with_html_summary")
def test_a_study_tells_it_at_its_end_and_on_its_page(tmp_path: Path, home: Path, capfd: Capture) -> None:
    assert run(home, "batch", str(home / "examples" / "toggle_study.yaml"), "-o", str(tmp_path / "s")) in (0, 1)
    told = capfd.readouterr().err
    assert SAID in told and FAULT in told
    assert "The formulas of the plugin of toggle have faults" in text(tmp_path / "s" / "summary.html")


def test_a_search_tells_it_at_its_end_and_on_its_page(tmp_path: Path, home: Path, capfd: Capture) -> None:
    study = home / "examples" / "toggle_study.yaml"
    head = study.read_text("utf-8").partition("sample:")[0]
    search = "optimise: {objectives: [{minimise: toggle.force}], evaluations: 8, population: 4}\n"
    study.write_text(head + "vary: {mechanisms.toggle.travel: {from: 6 mm, to: 18 mm}}\n" + search, "utf-8")
    assert run(home, "optimise", str(study), "-o", str(tmp_path / "o"), "--jobs", "1") == 0
    told = capfd.readouterr().err
    assert SAID in told and FAULT in told
    assert "The formulas of the plugin of toggle have faults" in text(tmp_path / "o" / "optimisation.html")
