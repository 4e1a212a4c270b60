"""The report as DOCX: it opens, holds what HTML and PDF hold, and is the same file again for the same results."""

from __future__ import annotations

import html
import io
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from zipfile import ZipFile

import docx
import pytest

from diecut_report.report.rendering import Rendering
from tests.report.made_results import sample, typed

Data = dict[str, Any]
W = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"
M = "{http://schemas.openxmlformats.org/officeDocument/2006/math}"
ORDER = {  # of what a schema wants in order: the elements that these files use
    f"{W}pPr": ["pStyle", "keepNext", "keepLines", "tabs", "spacing", "ind", "jc"],
    f"{W}rPr": ["rStyle", "rFonts", "b", "i", "noProof", "color", "sz", "vertAlign"],
    f"{W}tblPr": ["tblStyle", "tblW", "tblBorders", "tblLayout", "tblCellMar", "tblLook"],
    f"{W}tcPr": ["tcW", "gridSpan", "shd"],
    f"{W}trPr": ["cantSplit", "tblHeader"],
}


def without_figures(detail: str) -> Data:
    """The sample at a detail, with one figure alone: figures take most of the time."""
    found = sample()
    found["report"]["detail"] = detail
    first = found["mechanisms"]["cylinder"]["figures"][:1]
    for mechanism in (*found["mechanisms"].values(), *found["comparisons"].values()):
        mechanism["figures"] = []
    found["mechanisms"]["cylinder"]["figures"] = first
    return found


@pytest.fixture(scope="module")
def rendering() -> Rendering:
    """The sample in full."""
    return Rendering(typed(without_figures("full")))


@pytest.fixture(scope="module")
def content(rendering: Rendering) -> bytes:
    """Its file."""
    return rendering.docx()


def part(content: bytes, name: str = "word/document.xml") -> ElementTree.Element:
    with ZipFile(io.BytesIO(content)) as archive:
        return ElementTree.fromstring(archive.read(name))


def texts(root: ElementTree.Element) -> str:
    """All that is read, formulas too."""
    return "\n".join(
        "".join(node.text or "" for node in each.iter() if node.tag in (f"{W}t", f"{M}t"))
        for each in root.iter(f"{W}p")
    )


def lines_of(content: bytes) -> Iterator[list[str]]:
    """The rows of all tables as their texts."""
    for table in docx.Document(io.BytesIO(content)).tables:
        for row in table.rows:
            yield [cell.text for cell in row.cells]


@pytest.mark.nightly
def test_every_result_stands_in_a_table_rightly_rounded(small_report: Path) -> None:
    results = json.loads((small_report / "small.json").read_text("utf-8"))
    results["report"]["detail"] = "full"
    for mechanism in results["mechanisms"].values():
        mechanism["figures"] = []
    rows = {
        (line[0], line[2].replace("\u202f", "")) for line in lines_of(Rendering(typed(results)).docx()) if len(line) > 2
    }
    outputs = results["mechanisms"]["clutch"]["outputs"].values()
    assert len(outputs) > 5
    assert {(row["description"], row["display"]["text"].replace("-", "−")) for row in outputs} <= rows


def test_every_formula_of_the_page_is_a_formula_that_can_be_edited(rendering: Rendering, content: bytes) -> None:
    root = part(content)
    styles = [style.get(f"{W}val") for style in root.iter(f"{W}pStyle")]
    assert styles.count("Formula") == rendering.html().count("<math ") > 20
    assert len(list(root.iter(f"{M}oMathPara"))) == styles.count("Formula") + styles.count("FormulaRow")


def test_headings_contents_and_links_are_those_of_the_report(rendering: Rendering, content: bytes) -> None:
    made, root = docx.Document(io.BytesIO(content)), part(content)
    headings = [p.text for p in made.paragraphs if p.style and p.style.name in ("Heading 1", "Heading 2")]
    listed = [p.text for p in made.paragraphs if p.style and str(p.style.name).startswith("toc ")]
    titles = [f"{number}\u2002{title}" for _, number, title, _ in rendering.document.contents]
    assert headings == listed == titles
    marks = {mark.get(f"{W}name") for mark in root.iter(f"{W}bookmarkStart")}
    assert {link.get(f"{W}anchor") for link in root.iter(f"{W}hyperlink")} <= marks
    assert all(re.fullmatch(r"r\d+", str(mark)) for mark in marks)


def test_each_sheet_has_document_revision_and_its_number(content: bytes) -> None:
    section = docx.Document(io.BytesIO(content)).sections[0]
    head, foot = section.header.paragraphs[0], section.footer.paragraphs[0]
    assert "DOC-1" in head.text and "Revision B" in head.text
    assert [node.text for node in foot._p.iter(f"{W}instrText")] == [" PAGE ", " NUMPAGES "]


def test_a_figure_has_words_for_those_who_do_not_see_it_and_fits_the_page(content: bytes) -> None:
    document = docx.Document(io.BytesIO(content))
    (shape,) = document.inline_shapes
    title = without_figures("full")["mechanisms"]["cylinder"]["figures"][0]["title"]
    assert str(shape._inline.docPr.get("descr")).startswith(title)
    assert 0 < shape.width.mm <= 170.1 and 0 < shape.height.mm < 220
    with ZipFile(io.BytesIO(content)) as archive:
        assert [name for name in archive.namelist() if name.startswith("word/media/")] == ["word/media/image1.png"]


def test_a_brief_report_has_key_results_and_no_formula() -> None:
    content = Rendering(typed(without_figures("brief"))).docx()
    root = part(content)
    assert not list(root.iter(f"{M}oMath")) and "Key results" in texts(root)
    headings = [
        p.text for p in docx.Document(io.BytesIO(content)).paragraphs if p.style and p.style.name == "Heading 1"
    ]
    assert headings == ["1\u2002Summary", "2\u2002Key results"]


def test_elements_stand_in_the_order_of_their_schema(content: bytes) -> None:
    for name in ("word/document.xml", "word/header1.xml", "word/footer1.xml"):
        for element in part(content, name).iter():
            if element.tag in ORDER:
                places = [ORDER[element.tag].index(child.tag.removeprefix(W)) for child in element]
                assert places == sorted(places), ElementTree.tostring(element)


def test_equal_results_give_equal_bytes_without_a_time(content: bytes) -> None:
    assert Rendering(typed(without_figures("full"))).docx() == content
    with ZipFile(io.BytesIO(content)) as archive:
        assert {member.date_time for member in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    told = docx.Document(io.BytesIO(content)).core_properties
    assert told.created == told.modified and told.created is not None and told.created.year == 1980


def test_a_hostile_title_is_a_text() -> None:
    results = without_figures("standard")
    hostile = 'a<w:t>&"\x00\x1b\ufffe</w:p>]]>{{ x }}'
    results["project"] |= {
        "title": hostile,
        "document_number": hostile,
        "organisation": hostile,
        "prepared_by": hostile,
    }
    results["mechanisms"]["cylinder"]["figures"] = []
    results["mechanisms"]["cylinder"] |= {"title": hostile, "summary": hostile}
    results["mechanisms"]["cylinder"]["sections"][0]["items"][0]["symbol"] = 'c<m:t>"_&'
    root = part(Rendering(typed(results)).docx())
    shown = 'a<w:t>&"\ufffd\ufffd\ufffd</w:p>]]>{{ x }}'
    assert texts(root).count(shown) >= 5 and 'c<m:t>"' in texts(root)


def test_the_language_is_told_to_the_word_processor(content: bytes) -> None:
    assert {lang.get(f"{W}val") for lang in part(content, "word/styles.xml").iter(f"{W}lang")} == {"en-GB"}


def test_inputs_left_at_their_default_stand_with_symbol_and_unit_as_on_the_page() -> None:
    rendering = Rendering(typed(without_figures("standard")))
    told = re.findall('<p class="run-in"><strong>Left at default</strong>(.*?)</p>', rendering.html())
    on_page = {"".join(html.unescape(re.sub(r"<[^>]*>", "", line)).split()) for line in told}
    lines = texts(part(rendering.docx())).splitlines()
    in_word = {"".join(line.split()) for line in lines if line.startswith("Left at default")}
    assert on_page and {f"Leftatdefault{line}" for line in on_page} == in_word
    assert any("=" in line for line in on_page)
