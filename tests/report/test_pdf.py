"""The PDF report: sheets, search, outline, figures as outlines, nothing from outside, the same bytes again, bounded memory."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import subprocess
import sys
from functools import cache
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import fromstring

import numpy as np
import pytest
import tinyhtml5
from page import validate_pdf
from PIL import Image
from pypdf import PdfReader
from weasyprint.urls import URLFetcher

from diecut_report.report.equations import Typesetter
from diecut_report.report.figures.style import Svg
from diecut_report.report.pages.html import filled
from diecut_report.report.pages.page_engine import HTML, read_page, well_formed
from diecut_report.report.pages.pdf import Paper
from diecut_report.report.pages.pdf_figures import FigurePicture, NotDrawn
from diecut_report.report.pages.pdf_math import Letters, operators
from diecut_report.report.rendering import Rendering
from diecut_report.results.results_file import results_text
from tests.configs import HEAD, saved
from tests.hostile import bounded
from tests.report.conftest import Printed
from tests.report.made_results import typed

AGAIN = """
import sys
from functools import cache
from hashlib import sha256
from pathlib import Path
from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ResultsRecord
report = Rendering(ResultsRecord.model_validate_json(Path(sys.argv[1]).read_bytes()))
contents = [report.html().encode(), *([report.pdf()] if sys.argv[2] == "pdf" else [])]
print(*(sha256(content).hexdigest() for content in contents))
"""


@cache
def _texts(pdf: Path) -> list[str]:
    text = subprocess.run(["pdftotext", "-raw", str(pdf), "-"], capture_output=True, text=True, check=True).stdout
    return text.removesuffix("\f").split("\f")


def test_each_sheet_says_its_number_and_document(pdf: Path) -> None:
    texts = _texts(pdf)
    assert len(texts) > 5
    for number, text in enumerate(texts, 1):
        found = re.sub(r"\s+", "", text)  # how much of a gap is a space differs between versions of pdftotext
        assert re.search(rf"(?<!\d){number}of{len(texts)}(?!\d)", found)
        assert "DOC-1" in found and "Samplepress" in found and "Designoffice" in found


def test_title_block_is_in_the_metadata_without_dates(pdf: Path) -> None:
    found = PdfReader(pdf).metadata
    assert found is not None
    assert found.title == "Sample press – DOC-1"
    assert found.author == "Designer"
    assert "/CreationDate" not in found and "/ModDate" not in found


def test_outline_names_chapters_and_sections(pdf: Path) -> None:
    outline: list[Any] = PdfReader(pdf).outline
    chapters = [entry.title for entry in outline if not isinstance(entry, list)]
    sections = [entry.title for group in outline if isinstance(group, list) for entry in group]
    assert chapters[:3] == ["1 Summary", "2 Press data", "A Impression cylinder"]
    assert "A.3 Geometry of the flat" in sections


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="pdftotext is not installed")
def test_formulas_are_found_by_search(pdf: Path) -> None:
    text = subprocess.run(["pdftotext", "-raw", str(pdf), "-"], capture_output=True, text=True, check=True).stdout
    assert "c = 2·√(2·h·R − h²) = 2·√(2 · 40 mm · 105 mm − (40 mm)²) = 164.9 mm" in text
    assert "R_b > R − h: 70 mm > 105 mm − 40 mm" in text


def test_formulas_and_figures_are_tagged_as_what_they_are_with_alternative_texts(pdf: Path) -> None:

    alternatives = set(_alternatives(PdfReader(pdf).trailer["/Root"]["/StructTreeRoot"]))  # type: ignore[index]
    assert ("/Figure", "Cross-section") in alternatives
    assert any(tag == "/Formula" and text.startswith("c = 2·√(2·h·R − h²)") for tag, text in alternatives)
    assert not any(tag == "/Figure" and " = " in text for tag, text in alternatives)


def _alternatives(node: Any) -> list[tuple[str, str]]:
    node = node.get_object() if hasattr(node, "get_object") else node
    if isinstance(node, list):
        return [text for part in node for text in _alternatives(part)]
    if not isinstance(node, dict) or node.get("/Type") == "/OBJR":
        return []
    return ([(str(node["/S"]), str(node["/Alt"]))] if "/Alt" in node else []) + _alternatives(node.get("/K", []))


def test_no_link_leads_outside(pdf: Path) -> None:
    for page in PdfReader(pdf).pages:
        for link in page.get("/Annots", []):
            action = link.get_object().get("/A", {})
            assert "/URI" not in action and "/F" not in action


def test_weasyprint_has_nothing_to_complain_of(printed: Printed) -> None:
    assert printed.path.read_bytes().startswith(b"%PDF-1.7")
    assert printed.warnings == []


@pytest.mark.parametrize("profile", ["3a", "ua1"])
def test_a_validator_finds_it_fit_for_archives_and_for_all_readers(pdf: Path, profile: str) -> None:
    found = validate_pdf(pdf, profile=profile)
    # of a stream whose last byte is CR the validator takes the end of line that follows it for one with it; qpdf does not
    assert {f.message for f in found.failures if "/Length does not match" not in f.message} == set()


def test_configuration_and_results_are_attached_as_what_they_are(pdf: Path) -> None:
    root: Any = PdfReader(pdf).trailer["/Root"]
    found = {spec.get_object()["/UF"]: spec.get_object()["/AFRelationship"] for spec in root["/AF"]}
    assert found == {"config.yaml": "/Source", "results.json": "/Data"} and len(root["/AF"]) == 2


def test_each_signer_has_a_field_in_the_box_for_his_signature(pdf: Path) -> None:
    first: Any = PdfReader(pdf).pages[0]
    fields = {
        field["/T"]: field
        for field in (each.get_object() for each in first["/Annots"])
        if field["/Subtype"] == "/Widget"
    }
    assert list(fields) == ["prepared", "checked", "approved"]
    assert all(field["/FT"] == "/Sig" and "/V" not in field for field in fields.values())
    assert fields["checked"]["/TU"] == "Signature: Checked"
    boxes = [[float(each) for each in field["/Rect"]] for field in fields.values()]
    assert all(x2 - x1 > 100 and 10 < y2 - y1 < 25 for x1, y1, x2, y2 in boxes)
    assert all(upper[1] > lower[3] for upper, lower in pairwise(boxes))


def test_a_picture_from_outside_stops_the_rendering(results: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    from diecut_report.report.pages import pdf as module

    monkeypatch.setattr(
        module, "filled", lambda *_: '<html lang="en"><title>x</title><img alt="" src="http://localhost/x.png">'
    )
    with pytest.raises(RuntimeError, match="localhost"):
        Rendering(typed(results)).pdf()


@pytest.mark.nightly
@pytest.mark.parametrize("ending", ["html", "pdf"])
def test_equal_results_give_equal_bytes_in_another_process(
    results: dict[str, Any], html: str, request: pytest.FixtureRequest, tmp_path: Path, ending: str
) -> None:
    """Each kind of item and figure; tests/hostile/test_surroundings.py has a small report."""
    file = tmp_path / "results.json"
    file.write_text(results_text(typed(results)), encoding="utf-8")
    command, environment = [sys.executable, "-c", AGAIN, str(file), ending], os.environ | {"PYTHONHASHSEED": "4711"}
    there = subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout
    here = [html.encode(), *([request.getfixturevalue("pdf").read_bytes()] if ending == "pdf" else [])]
    assert there.split() == [sha256(content).hexdigest() for content in here]


def test_a_formula_is_the_same_in_both_formats_of_one_report(printed: Printed) -> None:
    assert printed.set_anew < 0.1 * printed.set_for_html  # but for those that the PDF alone has


def test_wide_formula_is_not_cut_off(pdf: Path) -> None:
    text = "".join(_texts(pdf))
    assert all(f"{k}.25 kg·m²" in text.replace("\u00a0", " ") for k in range(1, 9))


@pytest.mark.skipif(shutil.which("qpdf") is None, reason="qpdf is not installed")
def test_qpdf_finds_no_fault(pdf: Path) -> None:
    assert subprocess.run(["qpdf", "--check", str(pdf)], capture_output=True, check=False).returncode == 0


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="pdftotext is not installed")
def test_all_words_stand_within_the_margins(pdf: Path) -> None:
    boxes = subprocess.run(["pdftotext", "-bbox", str(pdf), "-"], capture_output=True, text=True, check=True).stdout
    found = re.findall(r'xMin="([\d.]+)" yMin="([\d.]+)" xMax="([\d.]+)" yMax="([\d.]+)"', boxes)
    left, top, right, bottom = (pick(float(box[i]) for box in found) for i, pick in enumerate((min, min, max, max)))
    millimetre = 72 / 25.4
    assert left >= 17.9 * millimetre and right <= (210 - 17.9) * millimetre
    assert top >= 5 * millimetre and bottom <= (297 - 11.8) * millimetre


# the outlines of formulas
def test_outline_of_a_bar_is_a_rectangle_of_its_size() -> None:
    drawn = operators(Typesetter().outline(r"\frac{a}{b}").svg, Letters())
    assert len(re.findall(r" re f$", drawn, re.MULTILINE)) == 1
    assert drawn.count(" cm ") == 2


def test_same_letter_is_drawn_once() -> None:
    letters = Letters()
    first, second = (operators(Typesetter().outline(latex).svg, letters) for latex in ("a", "a + a"))
    assert second.count(first.split(" cm ")[1]) == 2 and len(letters.paths) == 2


def test_unknown_shapes_are_refused() -> None:
    with pytest.raises(ValueError, match="cannot be drawn"):
        operators('<svg><defs></defs><g><circle r="3"/></g></svg>', Letters())


# reading the print page
def _same(one: Any, other: Any) -> bool:
    """Whether elements say the same; blanks at the ends of the page count for nothing."""
    alike = one.tag == other.tag and one.attrib == other.attrib and len(one) == len(other)
    alike = alike and (one.tag == "html" or (one.text or "") == (other.text or ""))
    alike = alike and (one.tag in ("body", "main") or (one.tail or "") == (other.tail or ""))
    return alike and all(map(_same, one, other))


@pytest.mark.parametrize("detail", ["brief", "full"])
def test_the_print_page_reads_the_same_as_xml_and_as_html(plain: dict[str, Any], detail: str) -> None:
    rendering = Rendering(typed(plain | {"report": {"detail": detail}}))
    source = filled(rendering, Paper(rendering), "print")
    assert _same(fromstring(well_formed(source)), tinyhtml5.parse(source, namespace_html_elements=False))


def test_a_page_that_is_not_xml_is_read_as_html() -> None:
    page = read_page("<html><p>a<p>b \x01", URLFetcher(), is_own=True)
    assert [node.tag for node in page.etree_element.iter("p")] == ["p", "p"]


def test_the_space_before_a_symbol_stands_for_itself() -> None:
    """Else the page engine breaks the text at its first place where only that space has no room."""
    page = read_page("<html><p>pressed with <i class=sy>P</i> there</p></html>", URLFetcher(), is_own=True)
    (paragraph,) = page.etree_element.iter("p")
    assert (paragraph.text, [(part.tag, part.text) for part in paragraph]) == (
        "pressed with",
        [("span", " "), ("i", "P")],
    )


SVG_HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 100 50">'
PAGE = '<html lang="en"><style>@page {{ size: 200mm 120mm; margin: 5mm }} img {{ display: block }}</style><img alt="" src="{}">'


def _svg(body: str) -> str:
    return f"{SVG_HEAD}{body}</svg>"


def _drawn(tmp_path: Path, source: str, cache: dict[str, Any]) -> Any:
    """The sheet with an image as an array of greys."""
    (tmp_path / "x.pdf").write_bytes(HTML(string=PAGE.format(source)).write_pdf(cache=cache))
    subprocess.run(
        ["pdftoppm", "-r", "60", "-gray", "-singlefile", str(tmp_path / "x.pdf"), str(tmp_path / "x")], check=True
    )
    return np.asarray(Image.open(tmp_path / "x.pgm"), dtype=float)


def _chosen(rendering: Rendering) -> list[Svg]:
    """A plot with a legend, marks and shades, and a drawing with hatching, dimensions and symbols."""
    kinds = {number: figure.type for part in rendering.document.chapters for number, figure in part.figures}
    figures = rendering.figures
    return [
        next(figures[number] for number in figures if kinds[number] == kind) for kind in ("plot", "drawing", "polar")
    ]


def test_the_outlines_look_as_the_page_engine_draws_the_svg(rendering: Rendering, tmp_path: Path) -> None:
    for figure in _chosen(rendering):
        ours = _drawn(tmp_path, "data:formula,0", {"data:formula,0": FigurePicture(*figure)})
        data = base64.b64encode(figure.text.encode()).decode()
        theirs = _drawn(tmp_path, f"data:image/svg+xml;base64,{data}", {})
        ink = np.abs(theirs - 255).sum()
        assert ink > 0 and abs(np.abs(ours - 255).sum() - ink) < 0.12 * ink
        near = np.abs(ours - theirs) < 100
        assert near.mean() > 0.985


def test_words_of_a_figure_are_told() -> None:
    style = "font-size: 8px; font-family: 'Report Sans'; text-anchor: middle; fill: #1b232c"
    parts = f'<tspan x="0 4" y="0" style="{style}">ab</tspan><tspan x="8" y="0" style="{style}">c</tspan>'
    picture = FigurePicture(
        _svg(
            f'<text style="{style}" x="5" y="9" transform="rotate(-90 5 9)">crank pin</text><g><text>\n{parts}</text></g>'
        ),
        100,
        50,
    )
    assert picture.texts == ["crank pin", "abc"]


@pytest.mark.parametrize("body", [
    '<path d="M 0 0 L 9 9 z" style="fill: url(#h1)"/>', '<path d="M 0 0 Q 1 1 2 2 " style="fill: #000000"/>', '<circle r="3"/>',
    '<path d="M 0 0 L 9 9 " style="fill: red"/>', '<g transform="skewX(3)"/>',
    '<text style="font-size: 8px; font-family: \'Report Sans\'" x="0" y="0">\U0001f600</text>',
])  # fmt: skip
def test_what_cannot_be_drawn_is_left_to_the_page_engine(body: str, plain: dict[str, Any]) -> None:
    with pytest.raises(NotDrawn):
        FigurePicture(_svg(body), 100, 50)
    material = Rendering(typed(plain))
    material.__dict__["figures"] = {"A.1": Svg(_svg(body), 100, 50)}
    assert 'src="data:image/svg+xml;base64,' in Paper(material).figure("A.1", "Title")


def test_opacity_is_set_and_taken_back() -> None:
    picture = FigurePicture(_svg('<path d="M 0 0 L 9 9 " style="fill: #ffffff; opacity: 0.8"/>'), 100, 50)
    assert picture.pieces[0] == "q" and picture.pieces[1] == 0.8 and picture.pieces[-1] == "Q"


MOST_OF_A_SHEET = 10e6  # bytes; 5 MB were measured between 10 and 50 cylinders
MADE = f"""
import json, sys
{bounded.PEAK}
from io import BytesIO
import pikepdf
from diecut_report.report.rendering import Rendering
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from diecut_report.config.plugins import Discovery
from diecut_report.config.loader import load_config

path = Path(sys.argv[1])
config = load_config(path, Discovery())
made = Rendering(document(compute(config, lambda _: None))).pdf()
with pikepdf.open(BytesIO(made)) as opened:
    print(json.dumps([len(opened.pages), memory()]))
"""
CYLINDER = """\
  cylinder_{number}:
    kind: cylinder_sizing
    working_length: {length} mm
    segment_height: 40 mm
    generatrix_length: 700 mm
    bore_radius: 60 mm
"""


def made(folder: Path, count: int) -> tuple[int, int]:
    """Sheets of the report of so many cylinders, and the bytes that the process had at most."""
    cylinders = "".join(CYLINDER.format(number=number, length=470 + number) for number in range(count))
    path = saved(folder, HEAD + cylinders, f"{count}.yaml")
    sheets, peak = json.loads(bounded.run(MADE, path, seconds=900, memory=6_000_000_000))
    return sheets, peak


@pytest.mark.nightly
def test_each_further_sheet_of_a_pdf_takes_a_bounded_share_of_memory(tmp_path: Path) -> None:
    few, many = made(tmp_path, 2), made(tmp_path, 8)
    assert many[0] >= few[0] + 6
    assert many[1] - few[1] <= MOST_OF_A_SHEET * (many[0] - few[0])
