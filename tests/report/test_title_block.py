"""What each sheet says of the document, in which frame, and when a report says that it may not be released."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader

from diecut_report.report.document import TitleBlock, machine_named, title_block
from diecut_report.report.pages.frames import Cell, sheet_blocks
from diecut_report.report.rendering import Rendering
from diecut_report.report.symbols import BOLD, LINE, MILLIMETRE, drawn, fitted, measured
from diecut_report.report.text import Catalogue
from diecut_report.results.model import ResultsRecord
from tests.configs import HEAD, SMALL, problems, saved
from tests.examples import few
from tests.exchange.reports import run
from tests.report.made_results import typed

Data = dict[str, Any]
WORDS = Catalogue("en")
SIZES = {"plain": (174, 9, 174, 9), "iso7200": (180, 34, 180, 10), "dstu2104": (185, 40, 185, 15)}
LONG = "Calculation of the drive of the pressing cylinder with its gear train, clutch, flywheel and of all that belongs to them"


def block(results: Data, **asked: str) -> TitleBlock:
    results["report"] = asked
    return title_block(typed(results), WORDS)


def passing(results: Data) -> Data:
    """The sample as one whose checks are all made and pass."""
    results["status"] = "pass"
    for data in (*results["mechanisms"].values(), *results["comparisons"].values()):
        data["checks"] = [check | {"status": "pass"} for check in data.get("checks", ())]
    return results


# --- the boxes -------------------------------------------------------------------------------------------------------


def overlap(a: Cell, b: Cell) -> float:
    across = min(a.x + a.width, b.x + b.width) - max(a.x, b.x)
    down = min(a.y + a.height, b.y + b.height) - max(a.y, b.y)
    return max(across, 0) * max(down, 0)


@pytest.mark.parametrize("logo", [True, False])
@pytest.mark.parametrize("frame", SIZES)
def test_the_boxes_of_a_title_block_fill_it_and_do_not_overlap(results: Data, frame: str, logo: bool) -> None:
    blocks = sheet_blocks(block(results, frame=frame), WORDS, has_logo=logo)
    assert (blocks.first.width, blocks.first.height, blocks.next.width, blocks.next.height) == SIZES[frame]
    for sheet in blocks:
        cells = sheet.cells
        assert sum(cell.width * cell.height for cell in cells) == pytest.approx(sheet.width * sheet.height)
        assert all(overlap(a, b) < 1e-9 for n, a in enumerate(cells) for b in cells[:n])


@pytest.mark.parametrize("frame", SIZES)
def test_the_texts_of_a_title_block_fit_into_their_boxes(results: Data, frame: str) -> None:
    keys = ("title", "document_number", "organisation", "department", "prepared_by", "approved_by", "revision", "date")
    results["project"] |= dict.fromkeys(keys, LONG)
    for sheet in sheet_blocks(block(results, frame=frame), WORDS, has_logo=True):
        for cell in sheet.cells:
            found = re.search(r"font-size:([\d.]+)pt", cell.style)
            assert found
            size = float(found[1])
            assert len(cell.shown) * size * LINE / MILLIMETRE <= cell.height
            face = {"face": BOLD} if cell.bold else {}
            assert all(measured(line, **face) * size / MILLIMETRE <= cell.width for line in cell.shown)


@pytest.mark.parametrize("date", ["2026-11-22", "22.11.2026"])
def test_the_line_of_changes_has_its_date_in_each_language(results: Data, date: str) -> None:
    results["project"]["date"] = date
    blocks = sheet_blocks(block(results, frame="dstu2104"), WORDS, has_logo=False)
    assert all(["22.11.26"] in [cell.shown for cell in sheet.cells] for sheet in blocks)


@pytest.mark.parametrize("frame", SIZES)
def test_a_status_is_broken_between_words_alone(results: Data, frame: str) -> None:
    words = Catalogue("uk")
    results["report"] = {"frame": frame}
    made = title_block(typed(passing(results)), words)
    for sheet in sheet_blocks(made, words, has_logo=True):
        shown = [cell.shown for cell in sheet.cells if cell.label == words["status"]]
        assert all(list(lines) == [made.status] for lines in shown)


def test_a_title_that_has_room_is_not_cut(results: Data) -> None:
    results["project"]["title"] = LONG
    shown = [cell.shown for cell in sheet_blocks(block(results, frame="dstu2104"), WORDS, has_logo=False).first.cells]
    assert LONG in [" ".join(lines) for lines in shown]


def test_a_text_without_room_at_its_smallest_ends_in_an_ellipsis() -> None:
    [line], size = fitted(LONG, 20, 3, 8, 4.5)
    assert line.endswith("…") and size == 4.5


def test_a_letter_that_the_font_lacks_is_measured_too() -> None:
    assert measured("\u4e2d") > 0 and drawn("\u4e2d").endswith(" f")


# --- status ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("status", ["draft", "for check", "released"])
def test_a_calculation_that_holds_is_called_what_its_configuration_says(results: Data, status: str) -> None:
    found = block(passing(results), status=status)
    assert found.status == status and not found.is_held


def test_a_calculation_that_fails_is_not_released_whatever_its_configuration_says(results: Data) -> None:
    passing(results)["status"] = "fail"
    found = block(results, status="released")
    assert found.status == "not released" and found.is_held
    assert block(results, status="for check").status == "for check"


def test_a_check_that_is_not_made_keeps_a_report_from_its_release(results: Data) -> None:
    next(iter(passing(results)["mechanisms"].values()))["checks"][0]["status"] = "not_checked"
    assert block(results, status="released").status == "not released"


def test_a_warning_does_not_keep_a_report_from_its_release(results: Data) -> None:
    passing(results)["status"] = "warn"
    assert not block(results, status="released").is_held


def test_a_report_without_a_status_is_a_draft(small_report: Path) -> None:
    results = ResultsRecord.model_validate_json((small_report / "small.json").read_bytes())
    assert "status:" not in results.config.source_text
    assert title_block(results, WORDS).status == "draft"


def test_the_page_says_that_it_is_not_released(plain: Data) -> None:
    assert '<p class="held">NOT RELEASED</p>' in Rendering(typed(plain)).html()
    assert "NOT RELEASED" not in Rendering(typed(passing(plain))).html()


def test_wrong_settings_are_refused_in_words(tmp_path: Path) -> None:
    told = problems(tmp_path, SMALL.replace("press:", "report: {status: checked, frame: iso}\npress:"))
    assert [line.split(":", 2)[2] for line in told] == [
        " report.status: is “checked” (did you mean 'for check'?); allowed: draft, for check, released",
        " report.frame: is “iso” (did you mean 'iso7200'?); allowed: plain, iso7200, dstu2104",
    ]


@pytest.mark.parametrize("given", ["", "report: {status: for check, frame: iso7200}\n"])
def test_the_results_hold_what_was_asked_so_that_they_are_rendered_again(tmp_path: Path, given: str) -> None:
    config = saved(tmp_path, HEAD.replace("press:", f"{given}press:") + SMALL.removeprefix(HEAD))
    assert run("report", config, "-o", tmp_path, "--format", "html,json", "--quiet") == 0
    told = json.loads((tmp_path / "press.json").read_text("utf-8"))["report"]
    assert (told["status"], told["frame"]) == (("for check", "iso7200") if given else ("draft", "plain"))
    assert run("render", tmp_path / "press.json", "-o", tmp_path / "again", "--format", "html", "--quiet") == 0
    page = (tmp_path / "again" / "press.html").read_bytes()
    assert page == (tmp_path / "press.html").read_bytes()
    assert f"<strong>{told['status']}</strong>".encode() in page


# --- sheets ----------------------------------------------------------------------------------------------------------


def words_of(pdf: Path) -> list[list[tuple[float, float, float, float, str]]]:
    """The words of each sheet with their boxes in millimetres."""
    told = subprocess.run(["pdftotext", "-bbox", str(pdf), "-"], capture_output=True, text=True, check=True).stdout
    form = r'<word xMin="([\d.]+)" yMin="([\d.]+)" xMax="([\d.]+)" yMax="([\d.]+)">(.*?)</word>'
    return [
        [(*(float(each) / MILLIMETRE for each in found[:4]), found[4]) for found in re.findall(form, page)]  # type: ignore[misc]
        for page in told.split("</page>")[:-1]
    ]


FRAMED = {"dstu2104": (20, 5, 205, 292), "iso7200": (20, 10, 200, 287)}


@pytest.mark.nightly
@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="pdftotext is not installed")
@pytest.mark.parametrize("frame", few(list(FRAMED), keep=lambda frame: frame == "dstu2104"))
def test_framed_sheets_keep_text_and_title_block_apart(plain: Data, tmp_path: Path, frame: str) -> None:
    plain["project"] |= {"date": "2026-11-22", "revision": "B", "norm_checked_by": "Normcontroller"}
    plain["report"] = {"frame": frame, "status": "for check"}
    (tmp_path / "a.pdf").write_bytes(Rendering(typed(plain)).pdf())
    left, top, right, bottom = FRAMED[frame]
    first, following = SIZES[frame][1], SIZES[frame][3]
    for number, words in enumerate(words_of(tmp_path / "a.pdf"), 1):
        line = bottom - (first if number == 1 else following)
        assert all(left < x1 and x2 < right and top < y1 and y2 < bottom for x1, y1, x2, y2, _ in words)
        assert not [word for word in words if word[1] < line < word[3]]
        told = " ".join(word[4] for word in words if word[1] > line)
        assert all(part in told for part in ("DOC-1", "B", "2026-11-22", "for check", f"{number}"))
        assert max(word[3] for word in words if word[3] < line) < line - 3
        if number == 1:
            assert "Normcontroller" in told or frame == "iso7200"
    assert (
        "NOT RELEASED" not in PdfReader(tmp_path / "a.pdf").pages[0].extract_text()
    )  # it is a picture behind the text


@pytest.mark.parametrize(
    ("name", "said"),
    [("DCP-700", "Press DCP-700"), ("Bobst SP 104", "Press Bobst SP 104"), ("Web press, folder", "Web press, folder"),
     ("Blank-cutting unit", "Blank-cutting unit"), ("Press 7", "Press 7"), ("Мій прес", "Мій прес")],
)  # fmt: skip
def test_a_name_in_words_is_not_called_a_press_before_it(name: str, said: str) -> None:
    assert machine_named(name, Catalogue("en")) == said
