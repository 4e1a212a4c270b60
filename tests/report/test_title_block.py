"""What each sheet says of the document, in which frame; page 1: what governs, what is not checked, what may not be released."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader

from diecut_report.report.chapters.front import followed_line, machine_facts, not_covered, open_groups
from diecut_report.report.document import TitleBlock, document, machine_named, title_block
from diecut_report.report.equations import Equations
from diecut_report.report.pages.frames import Cell, sheet_blocks
from diecut_report.report.rendering import Rendering
from diecut_report.report.symbols import BOLD, LINE, MILLIMETRE, drawn, fitted, measured
from diecut_report.report.text import Catalogue, sentence
from diecut_report.results.conclusion import governing, summary
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import PartCountRecord, ResultsRecord
from tests.configs import HEAD, SMALL, problems, saved
from tests.examples import few
from tests.exchange.reports import run
from tests.records import filled
from tests.report.made_results import check, mechanism, sample, typed

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


SHOWN = {"text": "16", "unit": "N"}


def judged(name: str, ratio: float | None, status: str = "pass", **more: Any) -> dict[str, Any]:
    return check(name) | {"status": status, "utilisation": ratio} | more


def unchecked(name: str, key: str) -> dict[str, Any]:
    return judged(
        name,
        None,
        "not_checked",
        limit=None,
        limit_display=None,
        margin_display=None,
        demand_display=SHOWN,
        missing=[key],
    )


def page(*checks: dict[str, Any]) -> Any:
    results = sample()
    ranks = [one["status"] for one in checks if one["status"] != "not_checked"]
    worst = next((status for status in ("fail", "warn") if status in ranks), "pass")
    judged_checks = [CheckRecord.model_validate(each) for each in checks]
    by_name = {"train": judged_checks}
    results["mechanisms"] = {"train": mechanism("Train", checks=judged_checks, status=worst)}
    results |= {
        "comparisons": {},
        "status": worst,
        "governing": governing(by_name),
        "summary": summary(by_name, []),
    }
    words = Catalogue("en")
    return document(typed(results), Equations(words, lambda _: 0.0), words)


def test_the_summary_is_sorted_by_utilisation_what_fails_first_and_what_was_sized_last() -> None:
    found = page(judged("low", 0.2), judged("high", 0.9), judged("sized", 0.99, sized_to_limit=True), judged("over", 1.5, "fail"),
                 judged("missed", None, "fail"), judged("odd", 1.01, "warn"), judged("own", 0.5, **{"class": "numerical"}))  # fmt: skip
    assert [row.id for row in found.checks] == ["missed", "over", "odd", "high", "low", "sized"]
    assert [row.id for row in found.sized] == ["sized"] and found.governing.id == "missed"
    assert found.counts == ["3 pass"] and found.verdict == "2 of 6 checks fail; 1 check warns."
    assert found.notes == ["1 self-test of the calculation holds."]


def test_checks_that_fail_in_spite_of_the_advice_are_called_as_in_the_lines_above() -> None:
    found = page(judged("wall", 1.5, "fail"))
    advice = {"changes": [{"path": "train.x", "value": "5 mm"}], "failing": ["train.wall", "gone.check"], "error": None}
    (line,) = followed_line(filled(ResultsRecord, {"summary": {"advice": advice}}), Catalogue("en"), found.checks)
    assert line.endswith(f"leaves other checks failing: A · {found.checks[0].title}, gone.check.")


def test_what_the_calculation_presumes_is_sorted_behind_what_has_a_reserve() -> None:
    found = page(judged("range", 0.99, presumed=True), judged("low", 0.2), judged("left", 1.2, "warn", presumed=True))
    assert [row.id for row in found.checks] == ["left", "low", "range"] and found.governing.id == "left"


def test_a_failure_without_a_utilisation_tells_by_how_much_in_words() -> None:
    found = page(judged("missed", None, "fail", margin_display={"text": "-10", "unit": "mm"}))
    assert (found.governing.utilisation, found.governing.used) == ("–", "10\N{NO-BREAK SPACE}mm beyond the limit")


@pytest.mark.parametrize(
    ("checks", "verdict", "face"),
    [
        ([judged("a", 0.5)], "All checks pass.", "pass"),
        ([judged("a", 0.5), unchecked("b", "rated")], "No check fails, but 1 check is not made.", "conditional"),
        ([unchecked("b", "rated")], "Nothing was checked, and 1 check is not made.", "conditional"),
        ([judged("a", 1.1, "warn"), unchecked("b", "rated")], "No check fails, but 1 check warns and 1 check is not made.", "conditional"),
        ([judged("a", 1.1, "fail"), unchecked("b", "rated")], "1 of 1 checks fails; 1 check is not made.", "fail"),
        ([], "There are no checks.", "conditional"),
    ],
)  # fmt: skip
def test_all_checks_pass_is_said_where_all_are_made_alone(
    checks: list[dict[str, Any]], verdict: str, face: str
) -> None:
    found = page(*checks)
    assert (found.verdict, found.face) == (verdict, face)


def test_what_is_not_checked_stands_apart_with_what_it_needs() -> None:
    found = page(judged("a", 0.5), unchecked("b", "rated"))
    assert [(row.id, row.missing, row.demand, row.limit) for row in found.unchecked] == [
        ("b", ("rated",), "16\N{NO-BREAK SPACE}N", "–")
    ]
    assert found.counts == ["1 passes"] and found.chapters[0].count("not_checked") == 1


# What stands on the page of the verdict: sentences, and what is assumed by the check that it moves.


def test_the_counts_begin_a_sentence() -> None:
    assert sentence("не виконано 6 перевірок з 135") == "Не виконано 6 перевірок з 135"
    assert sentence("6 of 135 checks fail") == "6 of 135 checks fail"


def test_open_values_stand_by_their_mechanism_those_with_the_same_reason_together() -> None:
    shown = {"interlocks.0.margin": "5 ms", "a": "3", "b": "4", "c": "7"}
    inputs: dict[str, Any] = {key: {"display": {"text": text, "unit": "1"}, "unit": "1"} for key, text in shown.items()}
    inputs["c"]["basis"] = "catalogue"
    items = [("interlocks.0.margin", "at 6 ms"), ("a", "together"), ("b", "together"), ("c", "together")]
    left = [{"what": "assumed", "path": f"mechanisms.timing.{key}", "why": why} for key, why in items]
    results = {
        "mechanisms": {"timing": {"inputs": inputs}},
        "press": {"fields": []},
        "summary": {"verdict": "conditional", "open": left},
    }
    (group,) = open_groups(filled(ResultsRecord, results), Catalogue("en"))
    assert group.reasons == [
        ([("interlocks.0.margin", "5\u00a0ms")], "assumed: at 6 ms"),
        ([("a", "3"), ("b", "4")], "assumed: together"),
        ([("c", "7")], "assumed, as no note names its standard or catalogue: together"),
    ]


def test_page_1_says_what_the_machine_is_as_far_as_the_results_hold_it() -> None:
    def row(text: str, unit: str, description: str) -> dict[str, Any]:
        return {"value": 1.0, "unit": "1", "description": description, "display": {"text": text, "unit": unit}}

    fields = [
        row("700", "mm", "Length") | {"path": "press.sheet.length"},
        row("470", "mm", "Width") | {"path": "press.sheet.width"},
    ]
    train = {"kind": "drive_train", "outputs": {"motor_power": row("1.1", "kW", "Rated power")}}
    asked = {"kind": "press_consistency", "inputs": {"required_rate": row("4500", "1/h", "Rate; default: another one")}}
    found = machine_facts(
        filled(ResultsRecord, {"press": {"fields": fields}, "mechanisms": {"train": train, "all": asked}}),
        Catalogue("en"),
    )
    assert found == [
        ("Required rate", "4500\u00a01/h"),
        ("Format", "700\u00a0mm × 470\u00a0mm"),
        ("Rated power (train)", "1.1\u00a0kW"),
    ]
    assert machine_facts(filled(ResultsRecord, {"press": {"fields": []}, "mechanisms": {}}), Catalogue("en")) == []


@pytest.mark.parametrize("owner", ["Designer", ""])
def test_page_1_names_what_is_not_covered_with_its_owner(owner: str) -> None:
    item = {"what": "not_rated", "path": "mechanisms.cross", "owner": owner, "why": "no part takes torque"}
    given = {"project": {"prepared_by": owner}, "summary": {"verdict": "conditional", "open": [item]}}
    found = not_covered(filled(ResultsRecord, given), Catalogue("en"))
    assert [each.text for each in found][:2] == [
        "Parts of the drive line are not modelled.",
        "cross: no part takes torque.",
    ]
    assert len(found) == 4 and {each.owner for each in found} == {owner}
    (alone,) = not_covered(filled(ResultsRecord, {"project": {"prepared_by": owner}}), Catalogue("en"))
    assert alone.text.endswith("beyond the methods.")


def test_each_mechanism_has_its_worst_strength_and_function_check() -> None:
    strength, practice = {"class": "strength"}, {"class": "practice"}
    found = page(judged("low", 0.2, **strength), judged("high", 0.9, **strength), judged("rule", 0.99, **practice))
    (row,) = found.judged_parts
    assert row.worst_strength.id == "high" and row.worst_function is None
    (hurt,) = page(judged("guard", 0.4, **{"class": "safety"})).checks
    assert (hurt.check_class, hurt.id) == ("safety", "guard")


def test_advice_has_the_numbers_of_the_language() -> None:
    changes = [{"path": "cylinder.radius", "value": "105.2 mm"}, {"path": "clutch.single_position", "value": "true"}]
    results = {"summary": {"advice": {"changes": changes, "failing": [], "error": None}}}
    (line,) = followed_line(filled(ResultsRecord, results), Catalogue("uk"))
    assert "cylinder.radius 105,2 mm, clutch.single_position true" in line


def test_calculations_of_one_part_are_one_row_with_the_worst_of_them() -> None:
    results = sample()
    results["mechanisms"] = {
        "train": mechanism("Train", checks=[judged("own", 0.2)]),
        "crank": mechanism("Shaft", part="shafts.crank", checks=[judged("low", 0.3, **{"class": "strength"})]),
        "key": mechanism("Key", part="shafts.crank", status="fail", checks=[judged("high", 1.2, "fail", **{"class": "strength"})]),
    }  # fmt: skip
    words = Catalogue("en")
    found = document(typed(results | {"comparisons": {}}), Equations(words, lambda _: 0.0), words)
    _, part = found.judged_parts
    assert (part.title, part.counts, part.face) == ("B–C shafts.crank", [1, 0, 1, 0], "fail")
    assert part.worst_strength is not None and part.worst_function is None
    assert (part.worst_strength.id, part.worst_strength.home) == ("high", "C key")
    assert found.judged_parts[0].title.startswith("A ")


def test_page_1_counts_the_parts_that_are_rated() -> None:
    results, words = typed(sample()), Catalogue("en")
    parts = PartCountRecord(carrying=54, rated=49, accepted=0, not_rated=5)
    counted = results.with_(summary=results.summary.with_(parts=parts))
    told = "49 of 54 parts with a method of calculation are rated"
    assert told in document(counted, Equations(words, lambda _: 0.0), words).counts
    assert told not in document(results, Equations(words, lambda _: 0.0), words).counts
