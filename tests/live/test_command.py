"""The command of the live page: what it refuses before it serves, and the language of its page."""

from __future__ import annotations

import json
import stat
from collections.abc import Callable
from pathlib import Path
from threading import Event
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

from diecut_report.live.page import page_data
from diecut_report.live.server import LiveApplication
from diecut_report.text.translation import spoken_language
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


def test_the_address_stands_on_no_command_line_and_the_page_waits_for_no_browser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Capture
) -> None:
    opened: list[str] = []
    address, is_opened, is_closed = "http://127.0.0.1:1/secret/", Event(), Event()

    def browser(url: str) -> bool:
        opened.append(url)
        is_opened.set()
        assert is_closed.wait(20), (
            "the page waits for the browser"
        )  # which comes back when it is closed, as one in a terminal does
        return True

    def serve(_application: object, _port: int, ready: Callable[[str], None]) -> None:
        ready(address)
        assert is_opened.wait(60) and not is_closed.is_set()
        is_closed.set()
        page = Path(url2pathname(urlsplit(opened[0]).path))
        assert stat.S_IMODE(page.stat().st_mode) == 0o600 and address in page.read_text("utf-8")

    monkeypatch.setattr("webbrowser.open", browser)
    monkeypatch.setattr("diecut_report.live.server.serve", serve)
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    assert run("live", file) == 0
    assert "secret" not in opened[0] and opened[0].startswith("file:")
    assert not Path(url2pathname(urlsplit(opened[0]).path)).exists()


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
