"""Chapters: lists as tables, numbers from tables and series, comparisons, files beside the report."""

from __future__ import annotations

import re
from html import unescape
from typing import Any

import pytest

from diecut_report.report.model import Item, PrintedChapter
from diecut_report.report.profile_files import CENTER, PITCH_CURVE, PROFILE, written
from diecut_report.report.rendering import Rendering
from tests.report.made_results import SOURCE, check, export, mechanism, sample, typed

Data = dict[str, Any]


@pytest.fixture(scope="session")
def chapters(rendering: Rendering) -> dict[str, PrintedChapter]:
    """The sample's chapters by their name."""
    return {chapter.name: chapter for chapter in rendering.document.chapters}


def _words(html: str) -> str:
    return re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]*>", "", html)))


def _items(chapters: dict[str, PrintedChapter]) -> dict[str, Item]:
    return {item.description: item for item in chapters["train"].sections[0].items}


def test_what_is_absent_does_not_say_the_words_of_its_heading_again() -> None:
    found = sample()
    absent = [{"title": "Bending", "text": "not calculated: bearing_span is not given"}]
    found["mechanisms"] = {"first": mechanism("Shaft", absent=absent)}
    found |= {"comparisons": {}, "governing": None}
    [part] = Rendering(typed(found)).document.chapters
    assert [told.text for told in part.absent] == ["bearing_span is not given"]


# lists
def test_list_of_parts_is_a_table_with_its_keys(chapters: dict[str, PrintedChapter]) -> None:
    [table] = chapters["train"].input_parts
    assert (table.number, table.family) == ("E.1", "belt.pulleys")
    assert [(c.title, c.unit, c.key) for c in table.columns] == [
        ("Radius of the pulley", "mm", "radius"), ("Side of the loop", "", "side"), ("Mass", "kg", "mass"),
    ]  # fmt: skip
    assert [number for number, _ in table.lines] == ["1", "2", "3", "4", "5"]


def test_cell_says_where_its_value_comes_from(chapters: dict[str, PrintedChapter]) -> None:
    [table] = chapters["train"].input_parts
    radius, side, mass = zip(*(cells for _, cells in table.lines), strict=True)
    assert [cell.note for cell in radius] == ["0.1 m", "${drive.radius}", "", "", ""]
    assert {cell.note for cell in side} == {"default"}
    assert [(cell.text, cell.note) for cell in mass] == [("–", ""), ("–", ""), ("–", ""), ("2", ""), ("–", "")]


def test_short_list_and_block_stay_lines(chapters: dict[str, PrintedChapter]) -> None:
    assert [row.key for row in chapters["train"].inputs] == [
        "vbelt.section",
        "law",
        "speed",
        "gears.0.teeth",
        "gears.1.teeth",
    ]


def test_word_with_digits_is_a_word_and_no_number(chapters: dict[str, PrintedChapter]) -> None:
    rows = {row.key: row for row in chapters["train"].inputs}
    assert rows["law"].wordy and rows["law"].value == "polynomial 3-4-5"
    assert not rows["speed"].wordy


def test_reference_without_a_text_shows_its_path(chapters: dict[str, PrintedChapter]) -> None:
    row = next(row for row in chapters["train"].inputs if row.key == "speed")
    assert (row.typed, row.origin) == ("drive.crank_speed", "reference")


def test_results_of_repeated_parts_are_tables_others_are_counted(chapters: dict[str, PrintedChapter]) -> None:
    train = chapters["train"]
    assert [row.description for row in train.outputs] == [
        "Radius",
        "Ratio of the pair, no. 1",
        "Ratio of the pair, no. 2",
    ]
    rows, shafts = train.output_parts
    assert (rows.family, shafts.family) == ("belt.pulleys", "shaft_3 … 6")
    assert [cell.text for cell in shafts.lines[0][1]] == ["93.49", "30.00"]
    assert [row.description for row in train.key_results] == [
        "Radius",
        "Ratio of the pair, no. 1",
        "Ratio of the pair, no. 2",
    ]


def test_tables_of_a_chapter_count_up(chapters: dict[str, PrintedChapter]) -> None:
    train = chapters["train"]
    calculated = [item.table.number for section in train.sections for item in section.items if item.table]
    told = [
        *(t.number for t in train.input_parts),
        *calculated,
        *(t.number for t in train.output_parts),
        *(t.number for t in train.curves),
    ]
    assert told == [f"E.{n}" for n in range(1, 6)]


# standards
def test_number_from_a_table_tells_table_and_key(chapters: dict[str, PrintedChapter]) -> None:
    item = _items(chapters)["Least diameter"]
    assert item.equation is not None and item.equation.text == "d_min = 90 mm"
    assert item.notes == ("From “Least diameters by section” for SPA", f"Source: {SOURCE}")
    assert item.source == "" and item.text == ""


def test_number_from_a_table_without_a_title_tells_what_chose_it(chapters: dict[str, PrintedChapter]) -> None:
    item = _items(chapters)["Density"]
    assert item.notes == ("Material: steel",)
    assert item.source == "material"


def test_pick_names_its_series(chapters: dict[str, PrintedChapter]) -> None:
    item = _items(chapters)["Rating"]
    assert item.notes[0] == "Series: Ratings of motors"
    assert "adjacent values not chosen: 0.75 kW, 1.5 kW" in item.notes[1]


def test_series_is_named_once_where_a_note_tells_its_sources(plain: Data) -> None:
    pick = next(item for item in plain["mechanisms"]["train"]["sections"][0]["items"] if item.get("series"))
    pick["note"] = f"{pick['series']}: a standard; a catalogue"
    section = Rendering(typed(plain)).document.chapters[4].sections[0]
    notes = next(item.notes for item in section.items if item.description == "Rating")
    assert sum("Ratings of motors" in note for note in notes) == 1


def test_last_of_a_row_and_running_integral(chapters: dict[str, PrintedChapter]) -> None:
    last, energy = (_items(chapters)[name].equation for name in ("Speed of the last shaft", "Energy"))
    assert last is not None and last.text == "n = last ω_k = 49.32 r/min"
    assert energy is not None and energy.text == "A = ∫ M dφ from 0 to φ = −6.804 J at φ = 45°"


# comparisons
@pytest.mark.nightly
def test_comparison_is_a_chapter_of_its_own_after_the_mechanisms(
    chapters: dict[str, PrintedChapter], html: str
) -> None:
    names = list(chapters)
    assert names[-1] == "compared-cylinder-train"
    compared = chapters[names[-1]]
    assert compared.letter == "F"
    assert [other.letter for other in compared.between] == ["A", "E"]
    section = html[html.index('<h2 id="m-F">') :]
    heading = section[: section.index("</p>", section.index("between"))]
    assert _words(heading).endswith("Comparison of A Impression cylinder and E Drive train")
    assert 'href="#m-A"' in heading and 'href="#m-E"' in heading


def test_comparison_stands_in_contents_sources_and_checks(rendering: Rendering) -> None:
    document = rendering.document
    assert ("m-F", "F", "Both drives compared", 1) in document.contents
    assert ("[3]", "A source of the comparison alone.") in document.sources
    assert ("F", "compared") in [(row.chapter, row.id) for row in document.checks]


def test_check_of_a_comparison_may_govern(plain: Data) -> None:
    plain["governing"] = {"mechanism": "compared-cylinder-train", "check": "compared"}
    governing = Rendering(typed(plain)).document.governing
    assert governing is not None and governing.chapter == "F"


def test_comparison_without_checks_has_no_chapter_of_them(plain: Data) -> None:
    plain["comparisons"]["compared-cylinder-train"]["checks"] = []
    page = Rendering(typed(plain)).html()
    last = page[page.index('<h2 id="m-F">') :]
    assert "There are no checks." not in last and "Checks" not in _words(last)


def test_mechanism_without_checks_says_so(html: str) -> None:
    assert "There are no checks." in html[html.index('<h2 id="m-E">') : html.index('<h2 id="m-F">')]


def test_comparison_between_three(plain: Data) -> None:
    plain["comparisons"]["compared-cylinder-train"]["between"] = ["cylinder", "drive", "train"]
    assert "Comparison of A Impression cylinder, B Cylinder drive and E Drive train" in _words(
        Rendering(typed(plain)).html()
    )


def test_figures_of_a_comparison_are_drawn(rendering: Rendering) -> None:
    assert "F.1" in rendering.figures


def test_results_without_comparisons_have_none(plain: Data) -> None:
    del plain["comparisons"]
    plain["mechanisms"]["cylinder"]["checks"].append(check("more"))
    page = Rendering(typed(plain)).html()
    assert 'id="m-E"' in page and 'id="m-F"' not in page and "Comparison of" not in page


# files
def test_files_beside_the_report_are_named(chapters: dict[str, PrintedChapter], results: Data, html: str) -> None:
    files = chapters["train"].files
    assert {file.name for file in files} == {f"press.{suffix}" for suffix in written(typed(results))[0]}
    drawing, table = files
    assert all(layer in drawing.content for layer in (PROFILE, PITCH_CURVE, CENTER)) and "72 points" in drawing.content
    assert table.content == "Cam 1 as a table of 72 rows: disc_angle, cam_1_x, cam_1_y, cam_1_pitch_x, cam_1_pitch_y"
    assert "Accompanying files" in html and "press.train.cam_1.dxf" in html


def test_profile_without_a_pitch_curve_names_no_layer_of_it(plain: Data) -> None:
    plain["mechanisms"]["train"]["exports"] = [export("cam_1_x", "cam_1_y")]
    files = Rendering(typed(plain)).document.chapters[4].files
    assert PITCH_CURVE not in files[0].content and PROFILE in files[0].content


def test_chapter_without_exports_says_nothing_of_files(chapters: dict[str, PrintedChapter]) -> None:
    assert chapters["cylinder"].files == [] and "files" not in chapters["cylinder"].parts


def test_sources_stand_by_the_alphabet_whatever_their_capitals(plain: Data) -> None:
    plain["mechanisms"]["cylinder"]["sources"] = [
        {"id": name, "citation": name} for name in ("Shigley", "iwis", "Hertz")
    ]
    names = [name for name, _ in Rendering(typed(plain)).document.sources]
    assert [name for name in names if name in ("Hertz", "iwis", "Shigley")] == ["Hertz", "iwis", "Shigley"]
