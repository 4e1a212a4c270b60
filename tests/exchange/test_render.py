"""The report of a results file is the report; results of strangers are data, and what cannot be made of them is told in words."""

from __future__ import annotations

import base64
import json
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from diecut_report.errors import UserError
from diecut_report.exchange.carried import results_of
from tests.configs import EXAMPLES, HEAD, SMALL, problems, saved
from tests.examples import few
from tests.exchange.reports import changed, removed_at, run, set_at
from tests.shared import once
from tests.test_pictures import png, svg

Capture = pytest.CaptureFixture[str]
Data = dict[str, Any]


@pytest.mark.parametrize("ending", few(["html", "pdf"], keep=lambda ending: ending == "html"))
def test_a_rendered_report_is_the_report_byte_for_byte(small_report: Path, tmp_path: Path, ending: str) -> None:
    assert run("render", small_report / "small.json", "-o", tmp_path, "--format", ending, "--quiet") == 0
    assert (tmp_path / f"small.{ending}").read_bytes() == (small_report / f"small.{ending}").read_bytes()
    assert run("render", small_report / "small.json", "-o", tmp_path, "--format", ending, "--strict") == 1


def test_a_page_of_a_calculation_verifies(tmp_path: Path, capfd: Capture) -> None:
    """Its values were not tried as a report tries them, which it says of each."""
    knife = next(path for path in EXAMPLES if path.stem == "circular_knife")
    assert run("calc", knife, "-o", tmp_path / "knife.json") == 0
    assert run("render", tmp_path / "knife.json", "-o", tmp_path, "--format", "html", "--quiet") == 0
    capfd.readouterr()
    assert run("verify", tmp_path / "knife.html") == 0
    assert "Everything agrees." in capfd.readouterr().out


def way_out(data: Data) -> None:
    data["mechanisms"]["../../up"] = data["mechanisms"].pop("clutch")


SHAFT = {"name": "s", "axis": [0.0, 0.0], "left": 0.0, "sections": [], "parts": [], "rating": {"state": "none"}}


def endless_wheel(data: Data) -> None:
    """A Geneva wheel whose slots nobody could draw."""
    place = {"start": 0.0, "end": 0.03, "seat": 0.05, "radius": 0.2}
    part = {"name": "s.w", "kind": "geneva_wheel", **place, "slots": 10**9, "rating": {"state": "none"}}
    data["drive_line"] = {"shafts": [SHAFT | {"parts": [part]}], "joins": []}


def endless_shafts(data: Data) -> None:
    data["drive_line"] = {"shafts": 61 * [SHAFT], "joins": []}


SECTION = {"title": "T", "items": [{"type": "value", "symbol": 3}]}
NONSENSE = {
    "a wheel without an end": endless_wheel,
    "shafts without an end": endless_shafts,
    "no sections": removed_at("mechanisms/clutch", "sections"),
    "a section of nonsense": set_at("mechanisms/clutch/sections", [SECTION]),
    "a way out": way_out,
    "an export that leads out": set_at(
        "mechanisms/clutch/exports", [{"id": "../../up", "type": "profile", "title": "T"}]
    ),
    "a hidden letter": set_at("project/title", "A\u202e"),
    "an unknown language": set_at("project/language", "xx"),
}


@pytest.mark.parametrize("change", NONSENSE.values(), ids=NONSENSE)
def test_results_that_are_not_the_programs_are_refused_in_words(
    small_report: Path, tmp_path: Path, capfd: Capture, change: Callable[[Data], None]
) -> None:
    (tmp_path / "in").mkdir()
    file = changed(small_report / "small.json", tmp_path / "in" / "a.json", change)
    assert run("render", file, "-o", tmp_path / "in" / "out", "--format", "html") == 2
    told = capfd.readouterr().err
    assert "Traceback" not in told and str(file) in told
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["a.json"]


def test_a_figure_that_cannot_be_drawn_is_told_and_the_rest_is_written(
    small_report: Path, tmp_path: Path, capfd: Capture
) -> None:
    change = set_at("mechanisms/clutch/figures", [{"id": "f", "type": "chart", "title": "T", "caption": ""}])
    file = changed(small_report / "small.json", tmp_path / "a.json", change)
    assert run("render", file, "-o", tmp_path, "--format", "html") == 3
    assert "figure 'f' of mechanism 'clutch' cannot be drawn" in capfd.readouterr().err
    assert (tmp_path / "a.html").exists()


MARKED = "</title><script>alert(1)</script><img src=x onerror=alert(1)>"


def test_texts_of_a_stranger_are_texts_in_the_page(small_report: Path, tmp_path: Path) -> None:
    def change(data: Data) -> None:
        data["project"]["title"] = data["press"]["name"] = data["mechanisms"]["clutch"]["title"] = MARKED
        for group in ("inputs", "outputs"):
            for row in data["mechanisms"]["clutch"][group].values():
                row["symbol"] = row["description"] = MARKED
        for check in data["mechanisms"]["clutch"]["checks"]:
            check["title"] = check["message"] = MARKED

    file = changed(small_report / "small.json", tmp_path / "a.json", change)
    assert run("render", file, "-o", tmp_path, "--format", "html", "--quiet") == 0
    page = (tmp_path / "a.html").read_text("utf-8")
    assert "<script>alert" not in page and "<img" not in page and "&lt;script&gt;" in page


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"[]", "does not hold results"),
        (b'{"a": NaN}', "NaN"),
        (b'{"a": 1e999}', "beyond the range"),
        (b'{"a": ' + 5000 * b"9" + b"}", "too many digits"),
        (b'{"a": ' + 200_000 * b"[" + 200_000 * b"]" + b"}", "nested too deeply"),
        (b'{"a": "\xff"}', "not UTF-8"),
        (b'{"schema_version": 1}', "program: is missing"),
        (b'{"a": [' + 10_000_001 * b"0," + b"0]}", "more than 10,000,000 values"),
    ],
    ids=["list", "nan", "overflow", "digits", "deep", "not UTF-8", "keys", "many"],
)
def test_a_json_file_that_holds_no_results_is_refused_in_words(content: bytes, words: str) -> None:
    with pytest.raises(UserError, match=words):
        results_of(content, "a.json")


# A logo beside the configuration comes into each format, goes with the report, and comes back out of it.


LOGO = svg('<circle cx="2" cy="2" r="2" fill="#0b5c8f"/>')


def with_logo(name: str) -> str:
    return HEAD.replace("press:", f"report: {{logo: {name}}}\npress:") + SMALL.removeprefix(HEAD)


@pytest.fixture
def reported(tmp_path_factory: pytest.TempPathFactory, tmp_path: Path) -> Path:
    """A copy of the folder with a report that has a logo."""

    def make(folder: Path) -> None:
        (folder / "pictures").mkdir()
        (folder / "pictures" / "a.svg").write_bytes(LOGO)
        config = saved(folder, with_logo("pictures/a.svg"))
        assert run("report", config, "-o", folder, "--format", "html,json", "--quiet") == 0

    return shutil.copytree(once(tmp_path_factory, "report_with_a_logo", make), tmp_path, dirs_exist_ok=True)


def test_a_logo_is_in_the_page_goes_with_the_report_and_comes_back(reported: Path, capfd: Capture) -> None:
    data = base64.b64encode(LOGO).decode()
    assert f'src="data:image/svg+xml;base64,{data}"' in (reported / "press.html").read_text("utf-8")
    assert run("extract", reported / "press.html", "-o", reported / "back", "--quiet") == 0
    assert (reported / "back" / "pictures" / "a.svg").read_bytes() == LOGO
    (reported / "alone").mkdir()
    alone = (reported / "press.html").rename(reported / "alone" / "press.html")
    assert run("verify", alone) == 0
    assert "pictures/a.svg" in capfd.readouterr().out
    assert run("render", reported / "press.json", "-o", reported / "again", "--format", "html", "--quiet") == 0
    assert (reported / "again" / "press.html").read_bytes() == alone.read_bytes()


def test_a_logo_that_was_exchanged_in_a_report_is_told(reported: Path, capfd: Capture) -> None:
    change = set_at("config/logo/base64", base64.b64encode(svg("")).decode())
    assert run("verify", changed(reported / "press.json", reported / "a.json", change)) == 1
    assert "✗ configuration  pictures/a.svg is not the one that the report names" in capfd.readouterr().out


HOSTILE = [
    ({"base64": base64.b64encode(svg("<script/>")).decode()}, "holds <script>"),
    ({"base64": "§"}, "config.logo"),
    ({"base64": base64.b64encode(png()).decode()}, "the logo is not image/svg+xml"),
    ({"media_type": "text/html"}, "the logo is not text/html"),
    ({"file": "../a.svg"}, "The name of the logo is “../a.svg”; a logo lies beside"),
    ({"file": ".bash_aliases"}, "a name that begins with a dot is hidden"),
    ({"file": ".ssh/a.svg"}, "a name that begins with a dot is hidden"),
    ({"file": "a.desktop"}, "the name of a PNG or SVG file is needed"),
]


@pytest.mark.parametrize(("change", "words"), HOSTILE, ids=[words for _, words in HOSTILE])
def test_a_strangers_logo_is_judged_as_ones_own(
    reported: Path, capfd: Capture, change: dict[str, str], words: str
) -> None:
    path = changed(reported / "press.json", reported / "a.json", lambda data: data["config"]["logo"].update(change))
    assert run("render", path, "-o", reported / "out", "--format", "html") == 2
    assert words in capfd.readouterr().err and not (reported / "out").exists()


def test_a_wrong_logo_is_told_with_its_place(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"GIF89a")
    (tmp_path / "folder.png").mkdir()
    told = {
        name: problems(tmp_path, with_logo(name))
        for name in ("a.png", "b.png", "a.sh", ".a.svg", "folder.png", "../a.png", "[1]", "''")
    }
    assert told["a.png"] == [
        "3:16: report.logo: “a.png” is neither a PNG nor an SVG picture, whatever its name ends in"
    ]
    assert "there is no file" in told["b.png"][0] and "3:16: report.logo" in told["b.png"][0]
    assert told["folder.png"] == [f"{tmp_path / 'folder.png'}: This is a folder. Give a PNG or SVG picture."]
    assert "the name of a PNG or SVG file is needed" in told["a.sh"][0] and "hidden" in told[".a.svg"][0]
    assert "without a folder above" in told["../a.png"][0]
    assert "the name of a PNG or SVG file is needed" in " ".join(told["[1]"])
    assert "the name of a PNG or SVG file is needed" in told["''"][0]


def test_a_png_stands_in_the_results_with_its_type(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_bytes(png())  # what it is, its bytes tell, not its name
    assert run("calc", saved(tmp_path, with_logo("a.svg")), "-o", tmp_path / "a.json", "--quiet") == 0
    logo = json.loads((tmp_path / "a.json").read_text("utf-8"))["config"]["logo"]
    assert (logo["file"], logo["media_type"]) == ("a.svg", "image/png")


# A report beside its former revision: what changed is told on a page and marked in the margin, and nothing else is.


REVISED = HEAD.replace("title: Test", "title: Test, revision: A")
OLD = (
    REVISED
    + "  a: {kind: lever, force: 2 kN, arm: 100 mm, width: 20 mm, allowable_moment: 250 N*m}\n  b: {kind: lever, force: 1 kN}\n"
)
NEW = OLD.replace("revision: A", "revision: B").replace("2 kN", "3 kN")
CHANGED_MARK = re.compile(r'<span class="mark" title="changed, before: ([^"]*)"></span>')


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
    of = {row: CHANGED_MARK.findall(row) for row in rows if CHANGED_MARK.search(row)}
    (force,) = (row for row in of if "Force" in row and ">3</td>" in row)
    assert [" ".join(text.split()) for text in of[force]] == ["2 kN"]
    (check,) = (row for row in of if 'id="c-A-moment"' in row)
    assert " ".join(of[check][0].split()) == "pass 80.0 %"
    unchanged = [row for row in rows if 'class="orig"' in row and ("Width; with it" in row or ">100</td>" in row)]
    assert unchanged and not any(CHANGED_MARK.search(row) for row in unchanged)


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
