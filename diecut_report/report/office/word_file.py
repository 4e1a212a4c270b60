"""A report as DOCX by python-docx, which is imported only when one is made: the content is that of HTML and PDF."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from io import BytesIO
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

from diecut_report.pictures import SVG
from diecut_report.report.chapters.front import DATE
from diecut_report.report.context import Material
from diecut_report.report.document import ReportDocument
from diecut_report.report.office import word_document as word
from diecut_report.report.office.word_body import WordBody, logo
from diecut_report.report.office.wordml import SPACES, TEXT_WIDTH, field, paragraph, small
from diecut_report.report.office.workbook import holdable, undated
from diecut_report.report.scope import BRIEF, FULL
from diecut_report.report.symbols import letters_declared

if TYPE_CHECKING:
    from docx.document import Document


# The look of a DOCX: page, language, styles, and the head and foot of each sheet.


FONT, MONO = "Arial", "Courier New"
ACCENT, SOFT, PALE = "0B5C8F", "66717D", "E9EDF1"
LANGUAGES = {"en": "en-GB", "uk": "uk-UA"}
HEADINGS = (15, 12.5, 11, 10)  # points
_BORDERS = "".join(
    f'<w:{side} w:val="single" w:sz="4" w:space="0" w:color="C3CAD1"/>' for side in ("top", "bottom", "insideH")
)
_MARGINS = "".join(
    f'<w:{side} w:w="{width}" w:type="dxa"/>'
    for side, width in (("top", 20), ("left", 70), ("bottom", 20), ("right", 70))
)
_FIRST = f'<w:rPr><w:b/></w:rPr><w:tcPr><w:shd w:val="clear" w:color="auto" w:fill="{PALE}"/></w:tcPr>'
_TABLE = (
    '<w:style w:type="table" w:customStyle="1" w:styleId="ReportTable"><w:name w:val="Report Table"/><w:basedOn w:val="TableNormal"/>'
    f'<w:uiPriority w:val="59"/><w:tblPr><w:tblBorders>{_BORDERS}</w:tblBorders><w:tblCellMar>{_MARGINS}</w:tblCellMar></w:tblPr>'
    f'<w:tblStylePr w:type="firstRow">{_FIRST}</w:tblStylePr></w:style>'
)
_MONO = f'<w:rFonts w:ascii="{MONO}" w:hAnsi="{MONO}" w:cs="{MONO}"/>'
_PARAGRAPHS = {  # style: its name, what it is based on, its paragraph, its letters
    "TableText": ("Table Text", "Normal", '<w:spacing w:before="0" w:after="0"/>', '<w:sz w:val="17"/>'),
    "Formula": ("Formula", "Normal", '<w:keepLines/><w:spacing w:before="40" w:after="60"/><w:ind w:left="454"/>', ""),
    "FormulaRow": ("Formula Row", "Formula", '<w:spacing w:before="0" w:after="60"/>', ""),
    "Lead": ("Formula Lead", "Normal", '<w:keepNext/><w:keepLines/><w:spacing w:before="120" w:after="20"/>', ""),
    "Why": ("Formula Note", "Normal", '<w:spacing w:before="0" w:after="60"/><w:ind w:left="454"/>', f'<w:color w:val="{SOFT}"/><w:sz w:val="18"/>'),
    "Listing": ("Listing", "Normal", '<w:spacing w:before="0" w:after="0"/>', f'{_MONO}<w:sz w:val="15"/>'),
    "TOC1": ("toc 1", "Normal", '<w:spacing w:before="60" w:after="0"/>', "<w:b/>"),
    "TOC2": ("toc 2", "Normal", '<w:spacing w:before="0" w:after="0"/><w:ind w:left="340"/>', '<w:sz w:val="18"/>'),
}  # fmt: skip
_LETTERS = {
    "Key": ("Key", f'{_MONO}<w:noProof/><w:sz w:val="16"/>'),
    "Small": ("Small", f'<w:color w:val="{SOFT}"/><w:sz w:val="15"/>'),
}


def set_styles(made: Document, language: str) -> None:
    """Set language, fonts and styles; the headings keep their names, by which a firm's own styles find them."""
    for lang in made.styles.element.iter(f"{{{SPACES['w']}}}lang"):
        lang.set(f"{{{SPACES['w']}}}val", LANGUAGES.get(language, language))
    _set_letters(made.styles["Normal"], 10)
    for level, size in enumerate(HEADINGS, 1):
        _set_letters(made.styles[f"Heading {level}"], size, ACCENT)
    _set_letters(made.styles["Title"], 22, ACCENT)
    _set_letters(made.styles["Caption"], 9, SOFT)
    made.styles["Caption"].font.bold = made.styles["Heading 4"].font.italic = False
    for style in list(parsed(_TABLE + "".join(_styles()))):
        made.styles.element.append(style)


def _set_letters(style: Any, size: float, colour: str = "") -> None:
    from docx.shared import Pt, RGBColor

    for fonts in style.element.xpath("./w:rPr/w:rFonts"):
        fonts.getparent().remove(fonts)
    style.font.name, style.font.size = FONT, Pt(size)
    style.element.rPr.rFonts.set(f"{{{SPACES['w']}}}cs", FONT)
    if colour:
        style.font.color.rgb = RGBColor.from_string(colour)


def _styles() -> Iterator[str]:
    for key, (name, base, form, letters) in _PARAGRAPHS.items():
        head = f'<w:style w:type="paragraph" w:customStyle="1" w:styleId="{key}"><w:name w:val="{name}"/>'
        yield f'{head}<w:basedOn w:val="{base}"/><w:qFormat/><w:pPr>{form}</w:pPr><w:rPr>{letters}</w:rPr></w:style>'
    for key, (name, letters) in _LETTERS.items():
        head = f'<w:style w:type="character" w:customStyle="1" w:styleId="{key}"><w:name w:val="{name}"/>'
        yield f"{head}<w:rPr>{letters}</w:rPr></w:style>"


def set_page(made: Document, document: ReportDocument) -> None:
    """Set the size of the page, and what stands at the head and foot of each: document, revision, sheet n of m."""
    from docx.shared import Mm

    section = made.sections[0]
    section.page_width, section.page_height = Mm(210), Mm(297)
    section.left_margin = section.right_margin = Mm(20)
    section.top_margin, section.bottom_margin = Mm(24), Mm(20)
    section.header_distance = section.footer_distance = Mm(10)
    words, project = document.words, document.project
    left = " · ".join(filter(None, (project["organisation"] or document.press.name, document.title)))
    number, revision = (f"{words[name]} {project[of] or '–'}" for name, of in word.FACTS[:2])
    status = words["across"] if document.block.is_held else document.block.status
    right = small("   ".join(filter(None, (number, revision, project["date"], status))))
    _replace(section.header._element, small(left), right)
    page, pages = field("PAGE", "1", "Small"), field("NUMPAGES", "1", "Small")
    sheet = small(f"{words['sheet']} ") + page + small(f" {words['of']} ") + pages
    _replace(section.footer._element, small(f"{document.program.name} {document.program.version}"), sheet)


def _replace(story: Any, left: str, right: str) -> None:
    """Put one line with a tab at the right margin into a header or a footer."""
    for child in list(story):
        story.remove(child)
    tabs = f'<w:tabs><w:tab w:val="clear" w:pos="4320"/><w:tab w:val="clear" w:pos="8640"/><w:tab w:val="right" w:pos="{TEXT_WIDTH}"/></w:tabs>'
    line = paragraph(f"{left}<w:r><w:tab/></w:r>{right}").replace("<w:p>", f"<w:p><w:pPr>{tabs}</w:pPr>", 1)
    story.append(parsed(line)[0])


def parsed(fragment: str) -> Any:
    """Read XML with the names of the spaces that a document uses, by python-docx's parser; what it holds are the children."""
    from docx.oxml import parse_xml

    spaces = " ".join(f'xmlns:{name}="{escape(space)}"' for name, space in SPACES.items())
    return parse_xml(f"<w:body {spaces}>{fragment}</w:body>")


def describe(made: Document, document: ReportDocument, when: Any) -> None:
    """Say whose it is and what it holds, where programs and archives look for it."""
    told, project = made.core_properties, document.project
    told.title, told.subject = (holdable(text)[:255] for text in (document.title, project["document_number"]))
    told.author = told.last_modified_by = holdable(project["prepared_by"] or document.program.name)[:255]
    told.comments = f"{document.program.name} {document.program.version}"[:255]
    told.language, told.version = document.words.language, holdable(project["revision"])[:255]
    told.created = told.modified = when
    told.revision, told.keywords = 1, ""


def word_file(material: Material) -> bytes:
    """Return the report as DOCX; the same bytes for the same results."""
    from docx import Document

    document = material.document
    made = Document()
    set_styles(made, document.words.language)
    set_page(made, document)
    describe(made, document, DATE)
    for name in [name for name, each in made.part.package.rels.items() if each.reltype.endswith("/thumbnail")]:
        del made.part.package.rels[name]  # the picture of another document, which python-docx's template has

    def embed(picture: bytes) -> str:
        return made.part.get_or_add_image(BytesIO(picture))[0]

    body = WordBody(document.words, material.rasters, material.why_not_drawn, embed)
    if found := material.results.config.logo:
        logo(body, found, document.project["organisation"], partial(_embedded_svg, made))
    with letters_declared(*material.letters):
        _write(body, material)
    page = made.element.body.sectPr  # what says how the page is, which comes last
    for child in list(parsed("".join(body.parts))):
        page.addprevious(child)
    content = BytesIO()
    made.save(content)
    return undated(content.getvalue())


def _write(body: WordBody, material: Material) -> None:
    document = material.document
    word.title_block(body, document)
    if document.detail != BRIEF:
        word.contents(body, document)
    word.summary(body, document)
    if material.changes:
        word.changes(body, document, material.changes)
    if document.detail == BRIEF:
        word.key_results(body, document)
        return
    word.influence(body, document)
    word.press_data(body, document)
    for part in document.chapters:
        word.chapter(body, part, document)
    word.closing(body, document, material.carried[1].digest)
    if document.detail == FULL:
        word.appendix(body, document)


def _embedded_svg(made: Document, content: bytes) -> str:
    """Put an SVG into the file, of which python-docx knows nothing; return what names it there."""
    from docx.opc.constants import RELATIONSHIP_TYPE
    from docx.opc.packuri import PackURI
    from docx.opc.part import Part

    part = Part(PackURI("/word/media/logo.svg"), SVG, content, made.part.package)
    return made.part.relate_to(part, RELATIONSHIP_TYPE.IMAGE)
