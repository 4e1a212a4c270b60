"""The pages' Content-Security-Policy: nothing but what a page brings itself is loaded or run, and it is not in the page's way."""

from __future__ import annotations

import base64
import re
import shutil
import subprocess
from hashlib import sha256
from html import unescape
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.report.pages.html import SCRIPTS
from diecut_report.study import command as study_command
from diecut_report.study.summary import summarise
from tests.configs import GOOD, saved
from tests.shared import once
from tests.study.studies import BASE, STUDY

META = re.compile(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">')
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PICTURES = 4
PROBE = "<script>document.title = 'run'</script><img src=x onerror=\"document.title = 'run'\">"


@pytest.fixture(scope="module")
def summary(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The page of a small study's summary, without its paper."""

    def make(folder: Path) -> None:
        saved(folder, BASE)
        study = saved(folder, STUDY, "study.yaml")
        command = ["batch", study, "-o", folder / "out", "--jobs", "1", "--plugins", GOOD, "--quiet"]
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(study_command, "summarise", lambda out, discovery: summarise(out, ["html"], discovery))
            assert main([*map(str, command)]) == 0

    return (once(tmp_path_factory, "small_summary", make) / "out" / "summary.html").read_text("utf-8")


@pytest.fixture
def report(small_report: Path) -> str:
    """The page of a small report."""
    return next(small_report.glob("*.html")).read_text("utf-8")


def policy(page: str) -> dict[str, str]:
    """The directives, which must stand before anything that they are to hold for."""
    found = META.search(page)
    assert found and not re.search(r"<(style|script|img|link)\b", page[: found.start()])
    return dict(part.strip().split(" ", 1) for part in unescape(found[1]).split(";"))


def test_a_report_allows_its_own_scripts_alone_and_nothing_from_elsewhere(report: str) -> None:
    own = re.findall(r"<script>(.*?)</script>", report, re.DOTALL)
    hashes = [base64.b64encode(sha256(each.encode()).digest()).decode() for each in own]
    assert policy(report) == {
        "script-src": " ".join(f"'sha256-{each}'" for each in hashes),
        "default-src": "'none'",
        "style-src": "'unsafe-inline'",
        "font-src": "data:",
        "img-src": "data:",
        "base-uri": "'none'",
        "form-action": "'none'",
    }
    assert len(own) == len(SCRIPTS) and report.count("<script") == len(own) + 1  # and data, which is not run


def test_a_summary_allows_its_own_script_alone(summary: str) -> None:
    (own,) = re.findall(r"<script>(.*?)</script>", summary, re.DOTALL)
    expected = base64.b64encode(sha256(own.encode()).digest()).decode()
    assert policy(summary)["script-src"] == f"'sha256-{expected}'"
    assert policy(summary)["default-src"] == "'none'"


def test_paper_needs_no_policy(small_report: Path) -> None:
    assert b"Content-Security-Policy" not in next(small_report.glob("*.pdf")).read_bytes()


def browsed(folder: Path, page: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """What headless Chromium makes of a page."""
    path = folder / "page.html"
    path.write_text(page, "utf-8")
    command = [str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", f"--user-data-dir={folder}/profile",
               "--virtual-time-budget=5000", *arguments, path.as_uri()]  # fmt: skip
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


@pytest.mark.nightly
@pytest.mark.skipif(CHROMIUM is None, reason="needs Chromium")
@pytest.mark.parametrize("name", ["report", "summary"])
def test_a_browser_shows_the_same_with_it_and_blocks_what_is_not_the_pages_own(
    tmp_path: Path, request: pytest.FixtureRequest, name: str
) -> None:
    page: str = request.getfixturevalue(name)
    shown: list[set[bytes]] = [set(), set()]
    for _ in range(PICTURES):  # one page is not always painted alike, so that several pictures are taken of each
        for pictures, text in zip(shown, (page, META.sub("", page)), strict=True):
            done = browsed(tmp_path, text, f"--screenshot={tmp_path}/shot.png", "--window-size=1200,4000")
            picture = (tmp_path / "shot.png").read_bytes()
            assert "Content Security Policy" not in done.stderr and len(picture) > 10_000
            pictures.add(picture)
        if shown[0] & shown[1]:
            break
    assert shown[0] & shown[1]
    if name == "summary":
        assert 'class="p0"' in browsed(tmp_path, page, "--dump-dom").stdout  # its script has drawn
    harmed = page.replace("<main>", f"<main>{PROBE}")
    done = browsed(tmp_path, harmed, "--dump-dom")
    assert "<title>run</title>" not in done.stdout and "Content Security Policy" in done.stderr
    assert "<title>run</title>" in browsed(tmp_path, META.sub("", harmed), "--dump-dom").stdout
