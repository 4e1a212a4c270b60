"""Details of a report: what each holds, in which order, on how many sheets, how often; and reports of some mechanisms alone."""

from __future__ import annotations

import json
import re
import subprocess
from collections import Counter
from collections.abc import Iterator
from html import unescape
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from PIL import Image
from pypdf import PdfReader

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.press import AskedReport, Press
from diecut_report.report.chapters.steps import BEFORE, Place, placed, sketch
from diecut_report.report.context import Material
from diecut_report.report.document import ReportDocument
from diecut_report.report.figures.style import SizesSize
from diecut_report.report.model import Item, PrintedChapter
from diecut_report.report.pages import html
from diecut_report.report.rendering import Rendering
from diecut_report.report.scope import scope
from diecut_report.report.text import number
from diecut_report.results.document import document
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import MechanismRecord, ShownRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.results.press_run import compute
from diecut_report.text.phrases import message_data, worded
from tests.configs import DISCOVERY, EXAMPLE, EXAMPLES, GOOD, HEAD, LEVER, SMALL, problems, saved
from tests.examples import few
from tests.processes import Example
from tests.records import filled
from tests.report.made_results import typed
from tests.shared import once

Data = dict[str, Any]
DETAILS = ("brief", "standard", "full")


@pytest.fixture(scope="module")
def pages() -> dict[str, str]:
    """The sample without its figures as HTML in each detail."""
    from tests.report.made_results import sample

    found = {}
    for detail in DETAILS:
        results = sample() | {"report": {"detail": detail}}
        for mechanism in (*results["mechanisms"].values(), *results["comparisons"].values()):
            mechanism["figures"] = []
        found[detail] = Rendering(typed(results)).html()
    return found


def _words(page: str) -> str:
    return re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]*>", "", page[page.index("<main>") :])))


def _headings(page: str) -> list[str]:
    return [_words("<main>" + found) for found in re.findall(r"<h[23][^>]*>(.*?)</h[23]>", page)]


def _shown(text: str) -> str:
    return re.sub(r"\s+", " ", number(worded(text)))


def _dense(text: str) -> str:
    return re.sub(r"\s+", "", text).replace("×", "·")


# what each detail holds
def test_without_a_word_the_report_is_standard(tmp_path: Path) -> None:
    results = Press.read(saved(tmp_path, SMALL), DISCOVERY).calculate().results
    assert "report" not in SMALL and results.report.detail == "standard"


def test_brief_has_the_verdict_what_fails_and_key_results_but_no_calculation(
    pages: dict[str, str], plain: Data
) -> None:
    words = _words(pages["brief"])
    failing = [c for m in plain["mechanisms"].values() for c in m.get("checks", ()) if c["status"] == "fail"]
    assert failing and all(check["title"] in words for check in failing)
    assert "Worst strength check" in words and "Key results" in words
    assert "<math" not in pages["brief"] and "Inputs" not in words and "Configuration as given" not in words


@pytest.mark.parametrize("detail", ["standard", "full"])
def test_every_output_is_in_the_text(pages: dict[str, str], plain: Data, detail: str) -> None:
    words = _words(pages[detail])
    for data in (*plain["mechanisms"].values(), *plain["comparisons"].values()):
        for name, row in data.get("outputs", {}).items():
            assert _shown(row["display"]["text"]) in words, name
            assert row["description"] in words, name


@pytest.mark.parametrize("detail", ["standard", "full"])
def test_a_value_of_a_series_says_why_it_was_taken(pages: dict[str, str], detail: str) -> None:
    assert "the next standard value at or above 0.93 kW; adjacent values not chosen" in _shown(_words(pages[detail]))


def test_a_size_that_was_sought_says_how_what_else_is_computed_says_so_in_full_alone(pages: dict[str, str]) -> None:
    words = {detail: _words(pages[detail]) for detail in ("standard", "full")}
    assert all("Method: the least module that is enough" in text for text in words.values())
    assert [detail for detail, text in words.items() if "Method: the sum of all" in text] == ["full"]


def test_standard_has_each_check_of_a_chapter_once_and_full_has_all(pages: dict[str, str], plain: Data) -> None:
    title = plain["mechanisms"]["cylinder"]["checks"][0]["title"]
    of_a = {detail: page[page.index('id="m-A"') : page.index('id="m-B"')] for detail, page in pages.items()}
    chapter = {detail: _words("<main>" + page) for detail, page in of_a.items()}
    assert chapter["standard"].count(title) == 1
    assert "Configuration as given" in _headings(pages["full"])[-1]
    assert not {"5 Appendix", "5.3 Configuration as given"} & set(_headings(pages["standard"]))
    assert {"5 Appendix", "5.2 Curves"} <= set(_headings(pages["full"]))


@pytest.mark.usefixtures("without_advice")
@pytest.mark.parametrize(
    "file",
    few(EXAMPLES, lambda file: file.stem in ("circular_knife", "flat_cylinder_belt_press")),
    ids=lambda file: str(file.stem),
)
def test_what_was_found_wrong_in_the_sources_is_printed_in_every_report_that_cites_them(file: Path) -> None:
    run = compute(load_config(file, DISCOVERY), lambda _: None)
    for detail in DETAILS[1:]:  # a brief report cites nothing
        results = document(run)
        results = results.with_(report=results.report.with_(detail=detail))
        printed = Material(results).document
        errata = {each.text for part in results.mechanisms.values() for each in part.errata}
        assert errata <= {text for _, text, _ in printed.errata}
        assert "erratum" not in " ".join(row.source for part in printed.chapters for row in part.checks)


@pytest.mark.parametrize("kind", Discovery().origins)
def test_what_is_said_to_be_corrected_is_touched_by_an_erratum_that_says_how(kind: str) -> None:
    mechanism = Discovery().mechanism(kind)
    corrected = {step.id for _, step in mechanism.steps if "corrected" in step.source}
    assert corrected <= {name for erratum in mechanism.errata for name in erratum.touches}


def test_formulas_have_the_same_numbers_in_standard_and_full(pages: dict[str, str]) -> None:
    steps = {detail: re.findall(r'id="eq-([A-Z.\d]+)"', pages[detail]) for detail in DETAILS[1:]}
    assert steps["standard"] == steps["full"] and len(steps["full"]) > 5


def test_a_result_that_its_step_prints_stands_in_no_table_of_standard(plain: Data) -> None:
    plain["report"] = {"detail": "standard"}
    chapters = {part.name: part for part in Rendering(typed(plain)).document.chapters}
    items = [item for s in plain["mechanisms"]["cylinder"]["sections"] for item in s["items"]]
    steps = {item["id"]: item["result"]["text"] for item in items if "result" in item and "id" in item}
    outputs = plain["mechanisms"]["cylinder"]["outputs"]
    left = [row["description"] for name, row in outputs.items() if steps.get(name) != row["display"]["text"]]
    assert [row.description for row in chapters["cylinder"].outputs] == left


def test_contents_come_before_the_summary_on_paper(plain: Data) -> None:
    from diecut_report.report.pages.pdf import Paper

    material = Rendering(typed(plain))
    page = html.filled(material, Paper(material), "print")
    assert page.index("toc-title") < page.index('id="summary"') < page.index('id="press"') < page.index('id="m-A"')


def test_keys_that_checks_miss_are_said_on_paper_in_the_summary_alone(plain: Data) -> None:
    from diecut_report.report.pages.pdf import Paper

    plain["report"] = {"detail": "standard"}
    plain["mechanisms"]["cylinder"]["checks"][0] |= {"status": "not_checked", "missing": ["allowable_load"]}
    material = Rendering(typed(plain))
    missing = {key for row in material.document.unchecked for key in row.missing}
    said = {kind: re.findall(r'(?s)class="left-out">.*?</p>', page) for kind, page in
            (("print", html.filled(material, Paper(material), "print")), ("screen", html.page(material)))}  # fmt: skip
    assert missing and said["print"] and said["screen"]
    assert not any(key in line for line in said["print"] for key in missing)
    assert all(any(key in line for key in missing) for line in said["screen"])


def test_nothing_in_any_detail_leads_to_what_is_not_there(pages: dict[str, str]) -> None:
    for detail, page in pages.items():
        targets = set(re.findall(r' id="([^"]+)"', page))
        assert {link for link in re.findall(r'href="#([^"]+)"', page) if link not in targets} == set(), detail


def test_tokens_are_words_in_print() -> None:
    tokens = ("cast_iron", "modified_trapezoidal", "polynomial_345", "stainless_304", "SPA", "1.2e-05", "a_B c")
    assert [worded(text) for text in tokens] == [
        "cast iron", "modified trapezoidal", "polynomial 3-4-5", "stainless 304", "SPA", "1.2e-05", "a_B c",
    ]  # fmt: skip


def test_unknown_details_are_refused_in_words(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text = LEVER.replace("press:", "report: {detail: breif}\npress:", 1)
    assert problems(tmp_path, text) == [
        "3:18: report.detail: is “breif” (did you mean 'brief'?); allowed: brief, standard, full"
    ]
    assert main(["report", str(saved(tmp_path, LEVER)), "--detail", "ful"]) == 2
    assert "'ful' is not a detail (did you mean 'full'?); known: brief, standard, full." in capfd.readouterr().err


# mechanisms alone
def test_a_report_of_one_mechanism_keeps_its_letter_and_has_a_verdict_of_its_own(plain: Data) -> None:
    plain["report"]["only"] = ["drive"]
    document = Rendering(typed(plain)).document
    assert [(part.name, part.letter) for part in document.chapters] == [("drive", "B")]
    assert {row.mechanism for row in document.checks} <= {"drive"}
    assert document.status == plain["mechanisms"]["drive"]["status"]
    assert any(f"1 of the {len(plain['mechanisms'])} mechanisms" in note for note in document.notes)


def test_a_comparison_is_told_where_all_that_it_compares_is(plain: Data) -> None:
    between = plain["comparisons"]["compared-cylinder-train"]["between"]
    for names, told in ((between, 1), (between[:1], 0)):
        whole = scope(typed(plain | {"report": {"detail": "full", "only": names}}))
        assert len(whole.results.comparisons) == told


def test_what_a_left_out_mechanism_assumes_is_left_out(plain: Data) -> None:
    paths = ["press.productivity", "mechanisms.drive.force", "mechanisms.train.speed"]
    left = [{"what": "assumed", "path": path, "owner": "", "why": message_data("why")} for path in paths]
    plain["summary"] = {"assumed": paths, "verdict": "conditional", "open": left}
    whole = scope(typed(plain | {"report": {"only": ["drive"]}}))
    assert (whole.results.summary.assumed, [each.path for each in whole.results.summary.open]) == (paths[:2], paths[:2])


def test_only_names_that_the_configuration_has(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    config = saved(tmp_path, SMALL)
    assert main(["report", str(config), "--only", "b", "-o", str(tmp_path / "out")]) == 2
    assert "--only 'b' is not a mechanism; the mechanisms: clutch." in capfd.readouterr().err
    assert main(["report", str(config), "--only", " , "]) == 2
    assert "no mechanism is named" in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_results_tell_how_the_report_was_asked_for(tmp_path: Path) -> None:
    config = saved(tmp_path, SMALL)
    asked = AskedReport(detail="brief", only=("clutch",))
    Press.read(config, Discovery([])).calculate().report(tmp_path, ("json",), asked)
    told = json.loads((tmp_path / "press.json").read_text("utf-8"))["report"]
    assert (told["detail"], told["only"]) == ("brief", ["clutch"])


# figures
def _mechanism(*figures: FigureRecord) -> MechanismRecord:
    sections = [
        {"items": [{"id": "a"}, {"id": "b"}]},
        {"items": [{"id": "c"}, {"type": "note"}, {"id": "d"}, {"id": "e"}]},
    ]
    return filled(MechanismRecord, {"sections": sections, "figures": list(figures)})


def _figure(kind: str, *shows: str, **more: Any) -> FigureRecord:
    return filled(FigureRecord, {"type": kind, "shows": list(shows)} | more)


def test_a_figure_follows_the_last_step_of_the_section_that_gives_most_of_what_it_shows() -> None:
    plot, early = _figure("plot", "a", "c", "d"), _figure("bars", "b", "input")
    found = placed("A", _mechanism(plot, early))
    assert [(each.place, each.number, each.figure) for each in found] == [
        (Place(0, 1), "A.1", early),
        (Place(1, 2), "A.2", plot),
    ]


def test_a_drawing_of_inputs_opens_the_calculation_and_a_chart_of_them_closes_it() -> None:
    found = placed("A", _mechanism(_figure("chart", "x"), _figure("drawing", "x")))
    assert [each.place for each in found] == [Place(0, BEFORE), Place(1, 3)]
    assert placed("A", filled(MechanismRecord, {"figures": [_figure("plot")]}))[0].place == Place(0, BEFORE)


def test_the_sketch_is_a_drawing_to_scale_where_there_is_one() -> None:
    figures = placed(
        "A", _mechanism(_figure("plot", "a"), _figure("drawing", "b", schematic=True), _figure("drawing", "c"))
    )
    assert [each.number for each in sketch(figures)] == ["A.3"] and [each.number for each in sketch(figures[:2])] == [
        "A.2"
    ]
    assert sketch(figures[:1]) == []


def test_figures_stand_among_the_steps(html: str) -> None:
    numbers = re.findall(r'<figure id="fig-([A-Z.\d]+)"', html)
    assert numbers and sorted(numbers, key=lambda n: (n[0], int(n[2:]))) == numbers
    assert "Figures" not in _headings(html)


def test_calculated_figures_tell_what_they_show(small_report: Path) -> None:
    results = json.loads((small_report / "small.json").read_text("utf-8"))
    for figure in results["mechanisms"]["clutch"]["figures"]:
        assert figure["shows"], figure["id"]


def test_a_machine_that_is_drawn_to_scale_has_a_brief_report_too(tmp_path: Path) -> None:
    knife = next(path for path in EXAMPLES if path.stem == "circular_knife")
    asked = AskedReport(detail="brief")
    Press.read(knife, Discovery([])).calculate().report(tmp_path, ("html",), asked)
    page = (tmp_path / "circular_knife.html").read_text("utf-8")
    assert "Knife, board and counter-knife" in page and "<svg" in page


# sheets
def test_brief_is_short_on_paper(plain: Data, tmp_path: Path) -> None:
    begun: list[int] = []
    (tmp_path / "brief.pdf").write_bytes(Rendering(typed(plain | {"report": {"detail": "brief"}})).pdf(begun.append))
    assert max(begun) == len(PdfReader(tmp_path / "brief.pdf").pages) and begun[0] == 1  # progress tells each sheet
    assert len(PdfReader(tmp_path / "brief.pdf").pages) <= 3


@pytest.fixture(scope="session")
def press_sheets(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The PDFs of the example press in each detail."""

    def make(folder: Path) -> None:
        Press.read(EXAMPLE, Discovery([])).calculate().report(folder, ("json",))
        results = ResultsRecord.model_validate_json((folder / f"{EXAMPLE.stem}.json").read_bytes())
        for detail in DETAILS:
            asked = results.with_(report=results.report.with_(detail=detail))
            (folder / f"{detail}.pdf").write_bytes(Rendering(asked).pdf())

    return once(tmp_path_factory, "press_sheets", make)


@pytest.mark.nightly
def test_the_press_is_short_in_brief_and_much_shorter_in_standard_than_in_full(press_sheets: Path) -> None:
    count = {detail: len(PdfReader(press_sheets / f"{detail}.pdf").pages) for detail in DETAILS}
    assert count["brief"] <= 4  # 18 mechanisms
    assert count["standard"] <= 118
    assert count["standard"] < 0.65 * count["full"]


@pytest.mark.nightly
def test_a_ukrainian_press_has_its_verdict_on_the_first_sheet_and_is_as_short_in_brief(press_sheets: Path) -> None:
    """Its words are longer."""
    results = ResultsRecord.model_validate_json((press_sheets / f"{EXAMPLE.stem}.json").read_bytes())
    results = results.with_(project=results.project.with_(language="uk"))
    sheets = {}
    for detail in DETAILS[:2]:
        file = press_sheets / f"{detail}.uk.pdf"
        asked = results.with_(report=results.report.with_(detail=detail))
        file.write_bytes(Rendering(asked).pdf())
        sheets[detail] = PdfReader(file).pages
    assert len(sheets["brief"]) <= 4
    assert re.search(r"Спирається на \d+ прийнят.* і\s+ще\s+\d+\.", sheets["standard"][0].extract_text(), re.DOTALL)


@pytest.mark.nightly
def test_every_output_of_the_press_is_on_paper(press_sheets: Path) -> None:
    results = ResultsRecord.model_validate_json((press_sheets / f"{EXAMPLE.stem}.json").read_bytes())
    for detail in DETAILS[1:]:
        command = ["pdftotext", "-raw", str(press_sheets / f"{detail}.pdf"), "-"]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        words = _dense(text)  # formulas set their spaces otherwise
        for data in results.mechanisms.values():
            told = _told(data)
            forms = {name: {_dense(_shown(text)), _dense(text)} for name, text in told.items()}  # main_b is called so
            missing = [name for name, texts in forms.items() if not any(text in words for text in texts)]
            assert missing == [], detail


def _told(data: MechanismRecord) -> dict[str, str]:
    """What is printed of each output: its text, or where it is one of several its cell, which has the decimals of its column."""
    items = [item for section in data.sections for item in section.items]
    tables = {item.id: {row[0]: row[1] for row in item.rows} for item in items if item.type == "table"}
    found = {}
    for name, row in data.outputs.items():
        part, text = row.part, row.display.text
        cell = tables.get(part.family, {}).get(str(part.number), text) if part else text
        if cell != text:  # but not another number
            assert abs(float(cell) - float(text)) <= 0.5000001 * 10.0 ** -len(text.partition(".")[2])
        found[name] = cell
    return found


@pytest.mark.nightly
@pytest.mark.parametrize("detail", DETAILS)
def test_no_sheet_is_under_two_thirds_full_but_the_last_of_a_chapter(
    press_sheets: Path, tmp_path: Path, detail: str
) -> None:
    """How far down a sheet its ink reaches, measured on the drawn sheet."""
    file = press_sheets / f"{detail}.pdf"
    subprocess.run(["pdftoppm", "-r", "20", "-gray", str(file), str(tmp_path / "p")], check=True)
    sheets = sorted(tmp_path.glob("*.pgm"))
    lasts = _before_chapters(file) if detail == "full" else {len(sheets)}
    assert [n for n, sheet in enumerate(sheets, 1) if n not in lasts and _reach(sheet) < 2 / 3] == []


def _before_chapters(file: Path) -> set[int]:
    """The last sheets of the chapters: those before a sheet on which one begins, and the last one."""
    reader = PdfReader(file)
    begun = [reader.get_destination_page_number(entry) for entry in reader.outline if not isinstance(entry, list)]
    return {*begun, len(reader.pages)} - {0}


def _reach(sheet: Path) -> float:
    """How much of the room for text, from below the title block, is used."""
    image = Image.open(sheet)
    top = round(image.height * 22 / 297)
    body = image.crop((0, top, image.width, image.height)).point(lambda grey: 255 * (grey < 200))
    box = body.getbbox()
    return 0.0 if box is None else box[3] / body.height


def test_of_a_pair_without_room_beside_each_other_each_has_the_whole_width(results: Data) -> None:
    material = Rendering(typed(results))
    chapter = next(part for part in material.document.chapters if len(part.figures) > 1)
    first, second = (number for number, _ in chapter.figures[:2])
    chapter.pairs = ((first, second),)

    def draw(figure: FigureRecord, curves: Any, words: Any, number: str, size: SizesSize) -> Any:
        return SimpleNamespace(width=400.0 if number == second else 200.0, size=size)

    drawn = material._drawn(draw)
    assert drawn[first].size is drawn[second].size is SizesSize.LARGE


@pytest.mark.parametrize(
    ("names", "said"),
    [
        ("b", "No check fails, but parts of 1 mechanism are not modelled and 1 assumed value is open."),
        ("a,b", "No check fails, but parts of 2 mechanisms are not modelled and 1 assumed value is open."),
        ("c", "No check fails, but parts of 1 mechanism are not modelled."),
    ],
)
def test_a_part_rests_on_what_is_assumed_of_mechanisms_that_are_left_out(tmp_path: Path, names: str, said: str) -> None:
    own = "arm: 90 mm, allowable_moment: 190 N*m"
    text = HEAD + f"  a: {{kind: lever, force: {{value: 2 kN, basis: assumed}}, {own}}}\n"
    text += f"  b: {{kind: lever, force: '${{a.force}} * 1', {own}}}\n  c: {{kind: lever, force: 1 kN, {own}}}\n"
    config = saved(tmp_path, text)
    assert (
        main(["report", str(config), "--only", names, "-o", str(tmp_path), "--format", "html", "--plugins", str(GOOD)])
        == 0
    )
    page = (tmp_path / "press.html").read_text("utf-8")
    assert said in page and "All checks pass" not in page


@pytest.fixture(scope="module", params=["en", "uk"])
def printed(request: pytest.FixtureRequest, example: Example) -> ReportDocument:
    """The content of the report, without its figures."""
    results = ResultsRecord.model_validate_json(example.told)
    results = results.with_(
        project=results.project.with_(language=request.param),
        report=results.report.with_(detail="standard"),
        mechanisms={name: data.with_(figures=[]) for name, data in results.mechanisms.items()},
    )
    return Rendering(results).document


def items(chapter: PrintedChapter) -> Iterator[Item]:
    """The steps of a chapter."""
    return (item for section in chapter.sections for item in section.items)


def test_no_result_that_a_list_of_the_calculation_gives_is_printed_again(printed: ReportDocument) -> None:
    chapters = {part.name: part for part in printed.chapters}
    for name in ("drive", "train"):
        assert not chapters[name].outputs and not chapters[name].output_parts


def test_the_source_of_a_series_is_said_once(printed: ReportDocument) -> None:
    for chapter in printed.chapters:
        notes = Counter(note for item in items(chapter) for note in item.notes if len(note) > 120)
        assert not [note for note, count in notes.items() if count > 1]


def test_numbers_of_clauses_keep_their_point(printed: ReportDocument) -> None:
    told = " ".join(note for chapter in printed.chapters for item in items(chapter) for note in item.notes)
    assert "clause 2.2" in told or "п. 2.2" in told


def test_parts_with_names_stand_under_them(printed: ReportDocument) -> None:
    timing = next(part for part in printed.chapters if part.name == "timing")
    lines, interlocks = timing.input_parts
    assert interlocks.heads == ["sheet_rests", "carriage_passes"]  # type: ignore[union-attr]
    assert lines.heads == ["drive", "feeder"]  # type: ignore[union-attr]
    firsts = [[row[0] for row in item.table.rows] for item in items(timing) if item.table]
    assert ["sheet_rests", "carriage_passes"] in firsts and ["1", "2"] not in firsts


def test_every_source_is_listed_as_the_formulas_name_it(printed: ReportDocument) -> None:
    listed = {name for ids, _ in printed.sources for name in ids.split(", ")}
    bearings = next(part for part in printed.chapters if part.name == "bearings")
    named = {item.source for item in items(bearings)} | {row.source for item in items(bearings) for row in item.rows}
    assert any(source.startswith("Lundberg") for source in named)
    assert {source for source in named if source.startswith("Lundberg")} <= listed


def test_a_comparison_names_its_sources_in_the_language_of_the_report(printed: ReportDocument) -> None:
    comparison = next(part for part in printed.chapters if part.between)
    told = {item.source for item in items(comparison)}
    assert ("kinematics" in told) == (printed.words["and"] == "and")


def test_chapters_can_be_told_apart_by_their_titles(printed: ReportDocument) -> None:
    titles = Counter(part.title for part in printed.chapters)
    assert not [title for title, count in titles.items() if count > 1]


def test_every_symbol_of_the_list_has_a_letter(printed: ReportDocument) -> None:
    assert all(any(map(str.isalpha, row.name)) for part in printed.chapters for row in part.symbols)


def test_what_is_but_rounding_is_said_so(example: Example) -> None:
    results = ResultsRecord.model_validate_json(example.told)
    noted = set()
    for name, data in results.mechanisms.items():
        for item in (item for section in data.sections for item in section.items):
            text, told = item.result.text if item.result else "", data.outputs.get(item.id)
            assert "e-" not in text or float(text) > 1e-12, (name, item.id)
            if text == "0" and "machine precision" in item.note:
                noted.add((name, item.id))
            assert not (text == "0" and told and told.value) or (name, item.id) in noted
    assert ("drive", "energy_residual") in noted


def test_what_a_mechanism_takes_by_itself_is_said_in_short(printed: ReportDocument) -> None:
    chapters = {part.name: part for part in printed.chapters}
    found = chapters["consistency"]
    assert len(found.inputs) < 8 and {"drive", "train"} <= {row.key for row in found.partners}
    assert {"timing", "drive", "clutch"} <= {group.home for group in found.taken}
    told = {(group.home, row.key) for group in found.taken for row in group.rows}
    assert ("drive", "stroke") in told and len(told) > 30
    assert not any(part.taken or part.partners for part in printed.chapters if not part.between and part is not found)


def test_a_phase_that_is_others_together_is_told_in_one_line(printed: ReportDocument) -> None:
    drive = next(part for part in printed.chapters if part.name == "drive")
    (table,) = drive.phases
    places = [tuple(row[2:4]) for row in table.rows]
    assert len(places) == len(set(places)) > 8
    assert len([text for text in drive.phases_absent if "combined" in text or "разом" in text]) == 2


def test_a_number_is_told_alike_in_all_chapters_that_hand_it_on(example: Example) -> None:
    mechanisms = ResultsRecord.model_validate_json(example.told).mechanisms
    told = {f"{name}.{key}": row.display for name, data in mechanisms.items() for key, row in data.outputs.items()}
    for data in mechanisms.values():
        for row in data.inputs.values():
            there = told.get(row.path, row.display)
            assert row.origin != "reference" or there.unit != row.display.unit or there == row.display
    forces: dict[float, set[str]] = {}
    for data in mechanisms.values():
        for row in data.outputs.values():
            if row.unit == "N":
                forces.setdefault(round(float(row.value), 6), set()).add(row.display.unit)  # type: ignore[arg-type]
    assert all(len(units) == 1 for units in forces.values())
    assert mechanisms["sector"].outputs["tangential_force"].display == ShownRecord(text="3.548", unit="kN")
