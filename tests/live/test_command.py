"""The command of the live page: what it refuses before it serves, and the language of its page."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from diecut_report.languages.speech import spoken_language
from diecut_report.live.application import LiveApplication
from diecut_report.live.page_data import page_data
from tests.cli.test_cli import Capture, run
from tests.configs import EXAMPLES

KNIFE = next(path for path in EXAMPLES if path.stem == "circular_knife")
STUDIES = sorted(KNIFE.parent.glob("*_study.yaml"))


@pytest.mark.parametrize("study", STUDIES, ids=lambda path: path.stem)
def test_a_study_ends_it_at_once_with_what_to_give(study: Path, capfd: Capture) -> None:
    assert run("live", study, "--no-open") == 2
    told = capfd.readouterr()
    command = "optimise" if "knife" in study.stem else "batch"
    assert (
        f"This is a study: calculate it with diecut-report {command} {study}, or give its base, {study.parent}"
        in told.err
    )
    assert told.out == ""


@pytest.mark.parametrize(
    ("given", "options", "language"),
    [("uk", (), "uk"), ("uk", ("--language", "en"), "en"), ("en", ("--language", "uk"), "uk"), ("en", (), "en")],
)
def test_the_page_has_the_language_that_is_asked_for_else_that_of_the_project(
    given: str, options: tuple[str, ...], language: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "knife.yaml"
    file.write_text(KNIFE.read_text("utf-8").replace("language: en", f"language: {given}"), "utf-8")
    found: list[str] = []

    def serve(application: LiveApplication, *_: object) -> None:
        found.extend((spoken_language(), json.dumps(page_data(application.session), ensure_ascii=False)))

    monkeypatch.setattr("diecut_report.live.server.serve", serve)
    assert run("live", file, "--no-open", "--quiet", *options) == 0
    assert found[0] == language
    assert ("Тривалість розрізу" in found[1]) == (language == "uk")
    assert ("Time of the cut" in found[1]) == (language == "en")
