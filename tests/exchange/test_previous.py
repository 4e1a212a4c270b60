"""A report beside its former revision: what changed is told on a page and marked in the margin, and nothing else is."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest

from tests.configs import HEAD, saved
from tests.examples import few
from tests.exchange.reports import run

REVISED = HEAD.replace("title: Test", "title: Test, revision: A")
OLD = (
    REVISED
    + "  a: {kind: lever, force: 2 kN, arm: 100 mm, width: 20 mm, allowable_moment: 250 N*m}\n  b: {kind: lever, force: 1 kN}\n"
)
NEW = OLD.replace("revision: A", "revision: B").replace("2 kN", "3 kN")
MARKED = re.compile(r'<span class="mark" title="changed, before: ([^"]*)"></span>')


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The reports of a lever in two revisions, the second one beside the first."""
    made = tmp_path_factory.mktemp("revisions")
    old, new = saved(made, OLD, "old.yaml"), saved(made, NEW, "new.yaml")
    assert run("report", old, "-o", made, "--format", "html,json", "--quiet") == 0
    assert run("report", new, "-o", made, "--format", "html,json", "--previous", made / "old.html", "--quiet") == 1
    return made


@pytest.mark.parametrize("form", ["html", "json"])
def test_the_previous_report_is_not_written_over(
    folder: Path, tmp_path: Path, form: str, capfd: pytest.CaptureFixture[str]
) -> None:
    former = tmp_path / f"new.{form}"
    former.write_bytes((folder / f"old.{form}").read_bytes())
    before = former.read_bytes()
    assert run("report", folder / "new.yaml", "-o", tmp_path, "--format", "html,json", "--previous", former) == 2
    assert f"new.{form}: This is the previous report itself and would be overwritten" in capfd.readouterr().err
    assert former.read_bytes() == before and list(tmp_path.iterdir()) == [former]


def test_what_changed_is_told_and_marked(folder: Path) -> None:
    page = (folder / "new.html").read_text("utf-8")
    assert '<h2 id="changes">Changes since revision A</h2>' in page and 'href="#changes"' in page
    rows = re.findall(r"<tr.*?</tr>|<div class=\"(?:check|eq)[^>]*>.*?</div>", page, re.DOTALL)
    of = {row: MARKED.findall(row) for row in rows if MARKED.search(row)}
    (force,) = (row for row in of if "Force" in row and ">3</td>" in row)
    assert [" ".join(text.split()) for text in of[force]] == ["2 kN"]
    (check,) = (row for row in of if 'id="c-A-moment"' in row)
    assert " ".join(of[check][0].split()) == "pass 80.0 %"
    unchanged = [row for row in rows if 'class="orig"' in row and ("Width; with it" in row or ">100</td>" in row)]
    assert unchanged and not any(MARKED.search(row) for row in unchanged)


def test_the_governing_checks_are_told_by_their_titles(folder: Path) -> None:
    page = (folder / "new.html").read_text("utf-8")
    assert page.count('<td>Moment<span class="sub key">a.moment</span></td>') == 2


def test_a_report_without_a_former_one_has_neither(folder: Path) -> None:
    page = (folder / "old.html").read_text("utf-8")
    assert 'class="mark"' not in page and 'id="changes"' not in page
    assert "changes" not in json.loads((folder / "old.json").read_text("utf-8"))


def test_such_a_report_is_verified_and_made_again_from_its_results(folder: Path, tmp_path: Path) -> None:
    assert run("verify", folder / "new.html") == 0
    assert run("render", folder / "new.json", "-o", tmp_path, "--format", "html", "--quiet") == 1
    assert (tmp_path / "new.html").read_bytes() == (folder / "new.html").read_bytes()


def test_a_former_report_that_cannot_be_read_is_bad_input(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "a.pdf").write_bytes(b"%PDF-1.7\n")
    assert run("report", folder / "new.yaml", "-o", tmp_path / "out", "--previous", tmp_path / "a.pdf") == 2
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("ending", few(["pdf"], keep=lambda _: False))
def test_the_sheets_tell_it_too(folder: Path, tmp_path: Path, ending: str) -> None:
    command = ["report", folder / "new.yaml", "-o", tmp_path, "--format", ending, "--previous", folder / "old.json"]
    assert run(*command, "--quiet") == 1
    text = subprocess.run(
        ["pdftotext", "-layout", tmp_path / "new.pdf", "-"], capture_output=True, text=True, check=True
    )
    assert "Changes since revision A" in text.stdout and "+50" in text.stdout
