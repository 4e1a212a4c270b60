"""The report as DOCX: it opens, holds what HTML and PDF hold, with equations and logo, and is the same file again for the same results."""

from __future__ import annotations

import base64
import html
import io
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from zipfile import ZipFile

import docx
import pytest

from diecut_report.pictures import natural_size
from diecut_report.report.mathematics import WORDS
from diecut_report.report.office.wordml import SPACE, OfficeMath, office_math
from diecut_report.report.rendering import Rendering
from tests.report.made_results import sample, typed
from tests.test_pictures import png, svg

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


MATH = f"{{{SPACE}}}"
Element = ElementTree.Element


def read(element: Element) -> str:
    """What an element says, on one line; an element that is not known fails."""
    name = element.tag.removeprefix(MATH)
    inner = {child.tag.removeprefix(MATH): child for child in element}
    if name in ("rPr", "dPr", "radPr", "naryPr", "mPr", "oMathParaPr"):
        return ""
    if name == "t":
        return element.text or ""
    if name in SHAPES:
        return SHAPES[name](element, {key: read(child) for key, child in inner.items()})
    assert name in ("oMathPara", "oMath", "r", "e", "num", "den", "sub", "sup", "fName", "deg", "mr"), name
    assert not (element.text or "").strip() and not any((child.tail or "").strip() for child in element)
    return "".join(read(child) for child in element)


def _delimited(element: Element, inner: dict[str, str]) -> str:
    ends = [element.find(f"{MATH}dPr/{MATH}{end}") for end in ("begChr", "endChr")]
    left, right = (end.get(f"{MATH}val") for end in ends if end is not None)
    return f"{left}{inner['e']}{right}"


def _nary(element: Element, inner: dict[str, str]) -> str:
    sign = element.find(f"{MATH}naryPr/{MATH}chr")
    assert sign is not None
    return f"{sign.get(f'{MATH}val')}[{inner['sub']},{inner['sup']}]({inner['e']})"


def _matrix(element: Element, _: dict[str, str]) -> str:
    return "; ".join(" , ".join(map(read, row.findall(f"{MATH}e"))) for row in element.findall(f"{MATH}mr"))


SHAPES: dict[str, Callable[[Element, dict[str, str]], str]] = {
    "f": lambda _, inner: f"({inner['num']})/({inner['den']})",
    "rad": lambda _, inner: f"√({inner['e']})",
    "sSub": lambda _, inner: f"{inner['e']}_{inner['sub']}",
    "sSup": lambda _, inner: f"{inner['e']}^{inner['sup']}",
    "sSubSup": lambda _, inner: f"{inner['e']}_{inner['sub']}^{inner['sup']}",
    "func": lambda _, inner: f"{inner['fName']}<{inner['e']}>",
    "d": _delimited,
    "nary": _nary,
    "m": _matrix,
}


def printed(tree: list[Any], decimal: str = ".") -> str:
    """A tree as Office Math, read back; narrow spaces between factors as *."""
    from diecut_report.report.equations import Equation, EquationRow, Link

    equation = Equation("", "", (EquationRow(Link(), [Link(form=tree)], joint=":"),))
    (line,) = office_math(equation, OfficeMath(WORDS, decimal))
    root = ElementTree.fromstring(line.replace("<m:oMathPara>", f'<m:oMathPara xmlns:m="{SPACE}">', 1))
    return read(root).replace("\u2009", "*").replace("\u00a0", " ")


TREE, B, X = ["sym", "a"], ["sym", "b"], ["sym", "x_max"]
ONE, TWO = ["num", "1"], ["num", "2"]


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (["/", ["+", TREE, B], ["-", TREE, B]], "(a+b)/(a−b)"),
        (["*", ["+", TREE, B], TWO], "(a+b)·2"),
        (["^", X, TWO], "x_max^2"),
        (["^", ["+", TREE, B], ["/", ONE, TWO]], "(a+b)^1/2"),
        (["call", "sqrt", ["-", ["^", TREE, TWO], B]], "√(a^2−b)"),
        (["call", "sin", TREE], "sin<a>"),
        (["call", "arctan", ["/", TREE, B]], "arctan<((a)/(b))>"),
        (["call", "abs", ["-", TREE, B]], "|a−b|"),
        (["call", "ceil", TREE], "⌈a⌉"),
        (["call", "arctan2", TREE, B], "arctan2<(a,b)>"),
        (["cases", [TREE, ["cmp", "<=", TREE, B]], [B]], "{a , if a≤b; b , otherwise"),
        (["cmp", "<", TREE, B], "a<b"),
        (["apply", "k_t", TREE], "k_t(a)"),
        (["neg", TREE], "−a"),
        (["derivative", TREE, B], "(da)/(db)"),
        (["integral", TREE, B, B], "∫[0,b](a*db)"),
        (["nary", "∑", TREE], "∑[,](a)"),
        (["qty", "12500", "N*mm"], "12\u202f500 N·mm"),
        (["qty", "-1.2e-05", "m**2"], "−1.2*×*10^−5 m²"),
        (["qty", "51.75", "deg"], "51.75°"),
        (["sym", "|F_s|"], "|F_s|"),
        (["sym", "r′_a"], "r′_a"),
    ],
)
def test_a_tree_reads_back(tree: list[Any], text: str) -> None:
    assert printed(tree) == text


def test_the_decimal_sign_is_that_of_the_language() -> None:
    assert printed(["qty", "51.75", "mm"], decimal=",") == "51,75 mm"


def test_units_stand_upright_and_letters_do_not() -> None:
    printer = OfficeMath(WORDS)
    assert 'm:val="p"' in printer(["qty", "5", "mm"]) and 'm:val="i"' not in printer(["qty", "5", "mm"])
    assert 'm:val="i"' in printer(["sym", "a"])


def test_an_operator_that_begins_a_line_has_something_before_it(plain: dict[str, Any]) -> None:
    printer = OfficeMath(WORDS)
    items = [item for part in Rendering(typed(plain)).document.chapters for s in part.sections for item in s.items]
    lines = [line for item in items if item.equation for line in office_math(item.equation, printer)]
    texts = ["".join(t.text or "" for t in _parsed(line).iter(f"{MATH}t")) for line in lines]
    assert any(text.startswith("\u200b=") for text in texts)
    assert [text for text in texts if text[:1] in "=·+"] == []


def test_every_equation_has_its_rows_and_nothing_stands_outside_of_runs(plain: dict[str, Any]) -> None:
    document = Rendering(typed(plain)).document
    items = [item for part in document.chapters for section in part.sections for item in section.items]
    equations = [e for item in items for e in (item.equation, item.condition, *item.definitions) if e]
    assert len(equations) > 10
    for equation in equations:
        for line in office_math(equation, OfficeMath(WORDS)):
            assert read(_parsed(line))


def _parsed(line: str) -> Element:
    return ElementTree.fromstring(line.replace("<m:oMathPara>", f'<m:oMathPara xmlns:m="{SPACE}">', 1))


DRAWING = "{http://schemas.openxmlformats.org/drawingml/2006/main}"
ASVG = "{http://schemas.microsoft.com/office/drawing/2016/SVG/main}"
R = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"
WP = "{http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing}"
DRAWN = svg('<circle cx="2" cy="2" r="2" fill="#0b5c8f"/>')


def word(content: bytes, media_type: str) -> bytes:
    found = without_figures("brief")
    found["mechanisms"]["cylinder"]["figures"] = []
    found["config"]["logo"] = {
        "file": "logo",
        "sha256": "",
        "media_type": media_type,
        "base64": base64.b64encode(content).decode(),
    }
    found["project"]["organisation"] = "Works & Sons $x^2$"
    return Rendering(typed(found)).docx()


def media(file: bytes) -> dict[str, bytes]:
    with ZipFile(io.BytesIO(file)) as archive:
        return {name.rpartition("/")[2]: archive.read(name) for name in archive.namelist() if "/media/" in name}


def named(file: bytes, relation: str) -> bytes:
    """The part of the document that a relation names."""
    return docx.Document(io.BytesIO(file)).part.related_parts[relation].blob


def test_a_png_stands_above_the_title_as_it_is() -> None:
    file = word(png(), "image/png")
    assert list(media(file).values()) == [png()]
    (blip,) = part(file).iter(f"{DRAWING}blip")
    assert named(file, blip.attrib[f"{R}embed"]) == png() and len(blip) == 0
    first = docx.Document(io.BytesIO(file)).paragraphs[0]
    assert first._p.xpath(".//wp:docPr/@descr") == ["Works & Sons $x^2$"]


def test_an_svg_stands_beside_a_picture_for_older_programs() -> None:
    file = word(DRAWN, "image/svg+xml")
    (blip,) = part(file).iter(f"{DRAWING}blip")
    (vector,) = blip.iter(f"{ASVG}svgBlip")
    assert named(file, vector.attrib[f"{R}embed"]) == DRAWN
    assert named(file, blip.attrib[f"{R}embed"]).startswith(b"\x89PNG")
    with ZipFile(io.BytesIO(file)) as archive:
        assert '"/word/media/logo.svg" ContentType="image/svg+xml"' in archive.read("[Content_Types].xml").decode()
    assert word(DRAWN, "image/svg+xml") == file


@pytest.mark.parametrize(
    ("content", "kind"), [(png(2000, 100), "image/png"), (DRAWN, "image/svg+xml")], ids=["png", "svg"]
)
def test_it_keeps_its_shape_within_its_bounds(content: bytes, kind: str) -> None:
    (extent,) = part(word(content, kind)).iter(f"{WP}extent")
    width, height = (int(extent.attrib[side]) / 12700 for side in ("cx", "cy"))
    wide, high = natural_size(content)
    assert width <= 144.01 and height <= 48.01 and width / height == pytest.approx(wide / high, rel=1e-3)


@pytest.mark.parametrize(("width", "height"), [(1, 200), (3000, 1)])
def test_a_thin_one_is_shown_too(width: int, height: int) -> None:
    thin = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"><rect width="{width}" height="{height}"/></svg>'
    assert set(media(word(thin.encode(), "image/svg+xml"))) >= {"logo.svg"}
