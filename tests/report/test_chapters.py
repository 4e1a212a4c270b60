"""Chapters: lists as tables, numbers from tables and series, comparisons, files beside the report; what a standard report prints once."""

from __future__ import annotations

import copy
import re
from html import unescape
from typing import Any

import pytest

from diecut_report.report.chapters.repetition import Reference, ToldBefore
from diecut_report.report.chapters.steps import Place, Placed, rows_of
from diecut_report.report.chapters.tables import brought_together, is_in_line
from diecut_report.report.model import Item, PrintedChapter, gathered_notes, under_heading
from diecut_report.report.profile_files import CENTER, PITCH_CURVE, PROFILE, written
from diecut_report.report.rendering import Rendering
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import AbsentRecord, ItemRecord, SectionRecord
from tests.records import filled
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


def tree(*letters: str) -> list[Any]:
    """The square root of a sum of two squares, less a product."""
    a, b = (["sym", letter] for letter in letters)
    return ["-", ["call", "sqrt", ["+", ["^", a, ["num", "2"]], ["^", b, ["num", "2"]]]], ["*", a, b]]


def step(name: str, symbol: str, equation: Any, **more: Any) -> ItemRecord:
    """A formula of the results."""
    found = {"id": name, "type": "formula", "symbol": symbol, "description": name, "equation": equation,
             "result": {"text": "1", "unit": "mm"}} | more  # fmt: skip
    return ItemRecord.model_validate(found)


def told(*steps: ItemRecord) -> ToldBefore:
    """What is known after steps with the numbers A.1, A.2 …"""
    known = ToldBefore()
    for number, each in enumerate(steps, 1):
        known.keep(each, f"A.{number}")
    return known


def test_a_formula_with_other_letters_is_named_with_those_that_differ() -> None:
    known = told(step("one", "c", tree("a", "b")))
    assert known.find(step("two", "f", tree("d", "b"))) == Reference("A.1", (("d", "a"),))


def test_letters_that_change_places_are_printed_not_named() -> None:
    assert told(step("one", "c", tree("a", "b"))).find(step("two", "f", tree("b", "a"))) is None


def test_another_number_in_it_makes_another_formula() -> None:
    other = copy.deepcopy(tree("d", "b"))
    other[1][2][1][2] = ["num", "3"]
    assert told(step("one", "c", tree("a", "b"))).find(step("two", "f", other)) is None


def test_a_short_formula_is_printed_again() -> None:
    short = ["*", ["sym", "a"], ["sym", "b"]]
    assert told(step("one", "c", short)).find(step("two", "f", ["*", ["sym", "d"], ["sym", "b"]])) is None


def test_a_short_formula_that_fills_a_section_is_printed_once() -> None:
    ratios = [step(f"ratio_{n}", f"q_{n}", ["/", ["sym", f"H_{n}"], ["sym", "H_best"]]) for n in range(8)]
    known = ToldBefore()
    known.begin(ratios)
    known.keep(ratios[0], "A.1")
    assert known.find(ratios[1]) == Reference("A.1", (("H_1", "H_0"),))
    known.begin(ratios[:3])
    assert known.find(ratios[1]) is None


def test_the_next_chapter_of_a_kind_knows_the_steps_of_the_first_but_not_those_with_another_branch() -> None:
    short = ["*", ["sym", "a"], ["sym", "b"]]
    known = told(step("one", "c", short), step("branch", "x", short, words="a ≤ b")).next("A")
    assert known.letter == "A"
    assert known.find(step("one", "c", short, result={"text": "7", "unit": "mm"})) == Reference("A.1")
    assert known.find(step("branch", "x", short, words="a > b")) is None


def test_a_chapter_of_a_kind_that_stood_before_has_values_with_the_places_of_their_formulas(plain: Data) -> None:
    plain["report"] = {"detail": "standard"}
    twin = copy.deepcopy(plain["mechanisms"]["cylinder"])
    plain["mechanisms"]["second"] = twin
    chapters = {part.name: part for part in Rendering(typed(plain)).document.chapters}
    first, second = chapters["cylinder"], chapters["second"]
    numbers = [number for item in _again(first) for number in _numbers(item)]
    again = [row for item in _again(second) for row in item.rows]
    assert second.told_in == first.letter and not any(item.equation for item in _again(second))
    assert again and all(row.refers in numbers for row in again if row.number)
    assert len([row for row in again if row.number]) == len(numbers)
    assert {row.value for row in again if row.number} and not second.assumptions


def test_a_full_report_prints_every_formula(plain: Data) -> None:
    plain["report"] = {"detail": "full"}
    plain["mechanisms"]["second"] = copy.deepcopy(plain["mechanisms"]["cylinder"])
    chapters = {part.name: part for part in Rendering(typed(plain)).document.chapters}
    one, two = ([item.equation for item in _again(chapters[name])] for name in ("cylinder", "second"))
    assert one == two and not any(item.rows or item.pair for item in _again(chapters["second"]))


def _again(part: PrintedChapter) -> list[Item]:
    return [item for section in part.sections for item in section.items]


def _numbers(item: Item) -> list[str]:
    if item.rows:
        return [row.number for row in item.rows if row.number]
    return [item.number] if item.number and item.type not in ("figure", "table") else []


# tables
def table(title: str, rows: list[list[str]], *symbols: str) -> ItemRecord:
    """A table of parts with a column for each symbol."""
    columns = [
        {"title": "No.", "symbol": "", "unit": "1"},
        *({"title": title, "symbol": s, "unit": "mm"} for s in symbols),
    ]
    return ItemRecord.model_validate({"type": "table", "title": title, "columns": columns, "rows": rows})


def section(title: str, items: list[ItemRecord]) -> SectionRecord:
    """A section of steps and tables."""
    return SectionRecord(title=title, text="", items=items)


def test_tables_of_the_same_parts_are_one_where_the_last_of_them_stood() -> None:
    length = step("length", "l", ["*", ["sym", "a"], ["sym", "b"]])
    items = [table("Width", [["1", "5"], ["2", "6"]], "b"), length, table("Length", [["1", "7"], ["2", "8"]], "l")]
    found = brought_together(section("Sizes", items), set())
    assert found[0] is None and found[1] is length and found[2] is not None
    assert found[2].rows == [["1", "5", "7"], ["2", "6", "8"]] and found[2].title == "Sizes"


def test_a_column_that_a_full_table_tells_is_not_told_again() -> None:
    first = table("Sizes", [["1", *"abcdefg"], ["2", *"hijklmn"]], *"tuvwxyz")
    later = table("Sizes", [["1", "a", "5"], ["2", "h", "6"]], "t", "s")
    third = table("Sizes", [["1", "a"], ["2", "h"]], "t")
    told = brought_together(section("", [first, later, third]), set())
    assert told[0] == first and told[2] is None and told[1] is not None and is_in_line(told[1])
    assert [column.symbol for column in told[1].columns] == ["", "s"]
    assert told[1].rows == [["1", "5"], ["2", "6"]]


def test_tables_of_other_parts_stay_apart() -> None:
    items = [table("Width", [["a", "5"]], "b"), table("Length", [["b", "7"]], "l")]
    assert brought_together(section("Sizes", items), set()) == items


def test_a_table_of_the_one_part_that_the_formula_shows_is_left_out() -> None:
    length = step("Length", "l", ["*", ["sym", "a"], ["sym", "b"]])
    assert brought_together(section("", [length, table("Length", [["1", "7"]], "l")]), set()) == [
        length,
        None,
    ]


def test_one_quantity_of_numbered_parts_stands_in_a_line() -> None:
    [found] = brought_together(section("", [table("Length", [["1", "7"], ["2", "8"]], "l")]), set())
    assert found is not None and is_in_line(found)


def test_a_table_holds_no_column_that_an_earlier_one_of_the_same_lines_has() -> None:
    told: set[Any] = set()
    first = table("Width", [["1", "5"], ["2", "6"]], "b")
    again = table("Width", [["1", "5", "9"], ["2", "6", "8"]], "b", "c")
    brought_together(section("", [first]), told)
    [found] = brought_together(section("", [again]), told)
    assert found is not None and is_in_line(found)
    assert [column.symbol for column in found.columns] == ["", "c"]
    assert found.rows == [["1", "9"], ["2", "8"]]
    assert brought_together(section("", [again]), told) == [None]


def test_a_column_of_other_lines_or_numbers_is_another_one() -> None:
    told: set[Any] = set()
    brought_together(section("", [table("Width", [["a", "5"]], "b")]), told)
    for other in (table("Width", [["b", "5"]], "b"), table("Width", [["a", "6"]], "b")):
        assert brought_together(section("", [other]), told) == [other]


def test_of_a_single_part_its_quantity_stands_in_a_line() -> None:
    so_far = table("Ratio so far", [["1", "3", "3"]], "i", "Πi")
    head, ratio, product = so_far.columns
    so_far = so_far.with_(columns=[head, ratio.with_(title="Ratio"), product])
    [found] = brought_together(section("", [so_far]), set())
    assert found is not None and is_in_line(found) and found.rows == [["1", "3"]]


# figures
def placed(at: int, **more: Any) -> Placed:
    """A figure of a section."""
    figure = {"type": "plot", "title": "T", "caption": "", "panels": []} | more
    return Placed(Place(at, 0), f"A.{at}", filled(FigureRecord, figure))


def test_two_figures_near_each_other_stand_side_by_side_at_the_second() -> None:
    one, two, far = placed(0), placed(1), placed(9)
    rows = rows_of([one, two, far], paired=True)
    assert [(row[-1].place.section, len(row)) for row in rows] == [(1, 2), (9, 1)]
    assert [len(row) for row in rows_of([one, two], paired=False)] == [1, 1]


def test_bars_schemes_and_long_legends_have_the_whole_width() -> None:
    wide = (placed(1, type="bars"), placed(1, schematic=True), placed(1, panels=[{"lines": [{"label": "x" * 200}]}]))
    for each in wide:
        assert [len(row) for row in rows_of([placed(0), each], paired=True)] == [1, 1]


def test_what_only_names_its_formula_is_named_alike_in_the_next_chapter() -> None:
    known = told(step("one", "c", tree("a", "b")))
    second = step("two", "f", tree("d", "b"))
    reference = known.find(second)
    assert reference is not None
    known.keep_named(second, reference)
    assert known.next("A").find(second) == Reference("A.1", (("d", "a"),))


def test_defaults_and_symbols_of_an_earlier_chapter_are_not_told_again(plain: Data) -> None:
    plain["report"] = {"detail": "standard"}
    plain["mechanisms"]["second"] = copy.deepcopy(plain["mechanisms"]["cylinder"])
    chapters = {part.name: part for part in Rendering(typed(plain)).document.chapters}
    first, second = chapters["cylinder"], chapters["second"]
    assert first.symbols and not second.symbols
    assert not second.defaults and second.are_defaults_told == bool(first.defaults)


def test_chapters_of_one_title_are_told_apart_by_their_names(plain: Data) -> None:
    plain["mechanisms"]["second"] = copy.deepcopy(plain["mechanisms"]["cylinder"])
    chapters = {part.name: part for part in Rendering(typed(plain)).document.chapters}
    assert chapters["second"].title.endswith(": second") and chapters["cylinder"].title.endswith(": cylinder")
    assert chapters["drive"].title == plain["mechanisms"]["drive"]["title"]


# Steps that do not apply to a machine: told once for all that follow each other.


def _note(name: str, said: str = "does not apply to this machine.") -> ItemRecord:
    return ItemRecord(type="note", id=name, description=name, text=f"{name}: {said}")


def test_what_does_not_apply_stands_in_one_sentence() -> None:
    formula = ItemRecord(type="formula", description="Its square root")
    found = gathered_notes([_note("Step"), _note("Root"), formula, _note("Share")])
    assert found[0] == ItemRecord(type="note", text="Does not apply to this machine: Step; Root.")
    assert found[1:] == [None, formula, _note("Share")]  # each step keeps its place, by which figures stand


def test_notes_of_another_kind_stay_as_they_are() -> None:
    notes = [_note("Angle", "there is none."), _note("Step"), ItemRecord(type="note", text="A remark."), None]
    assert gathered_notes(notes) == notes


def test_what_is_left_out_for_one_reason_stands_in_one_line() -> None:
    reasons = [
        ("Cam 1", "arm_length not given"),
        ("Torque", "conveyor_mass not given"),
        ("Cam 2", "arm_length not given"),
    ]
    absent = [AbsentRecord(title=title, text=f"not calculated: {text}") for title, text in reasons]
    found = [(part.title, part.text) for part in under_heading(absent, "Not calculated")]
    assert found == [("Cam 1; Cam 2", "arm_length not given"), ("Torque", "conveyor_mass not given")]
