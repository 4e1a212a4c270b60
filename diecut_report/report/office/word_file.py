"""A report as DOCX by python-docx, which is imported only when one is made: the content is that of HTML and PDF."""

from __future__ import annotations

from functools import partial
from io import BytesIO
from typing import TYPE_CHECKING

from diecut_report.pictures import SVG
from diecut_report.report.carried import DATE
from diecut_report.report.context import Material
from diecut_report.report.office import word_chapters as chapters
from diecut_report.report.office import word_front as front
from diecut_report.report.office.archive import undated
from diecut_report.report.office.word_body import WordBody
from diecut_report.report.office.word_logo import logo
from diecut_report.report.office.word_styles import describe, parsed, set_page, set_styles
from diecut_report.report.scope import BRIEF, FULL
from diecut_report.report.symbols import letters_declared

if TYPE_CHECKING:
    from docx.document import Document as WordDocument


def word_file(material: Material) -> bytes:
    """Return the report as DOCX; the same bytes for the same results."""
    from docx import Document

    document = material.document
    made = Document()
    set_styles(made, document.words.language)
    set_page(made, document)
    describe(made, document, DATE)
    _without_thumbnail(made)
    body = WordBody(document.words, material.rasters, material.why_not_drawn, partial(_embedded, made))
    if found := material.results["config"].get("logo"):
        logo(body, found, document.project["organisation"], partial(_embedded_svg, made))
    with letters_declared(*material.letters):
        _write(body, material)
    _fill(made, body)
    content = BytesIO()
    made.save(content)
    return undated(content.getvalue())


def _write(body: WordBody, material: Material) -> None:
    """Write all parts in the order of the printed report."""
    document = material.document
    front.title_block(body, document)
    if document.detail != BRIEF:
        front.contents(body, document)
    front.summary(body, document)
    if material.changes:
        front.changes(body, document, material.changes)
    if document.detail == BRIEF:
        chapters.key_results(body, document)
        return
    front.influence(body, document)
    chapters.press_data(body, document)
    for part in document.chapters:
        chapters.chapter(body, part, document)
    chapters.closing(body, document, material.carried[1].digest)
    if document.detail == FULL:
        chapters.appendix(body, document)


def _embedded(made: WordDocument, picture: bytes) -> str:
    """Put a picture into the file; return what names it there."""
    relation, _ = made.part.get_or_add_image(BytesIO(picture))
    return relation


def _embedded_svg(made: WordDocument, content: bytes) -> str:
    """Put an SVG into the file, of which python-docx knows nothing; return what names it there."""
    from docx.opc.constants import RELATIONSHIP_TYPE
    from docx.opc.packuri import PackURI
    from docx.opc.part import Part

    part = Part(PackURI("/word/media/logo.svg"), SVG, content, made.part.package)
    return made.part.relate_to(part, RELATIONSHIP_TYPE.IMAGE)


def _fill(made: WordDocument, body: WordBody) -> None:
    """Put the parts before what says how the page is."""
    into = made.element.body
    page = into.sectPr
    for child in list(parsed("".join(body.parts))):
        page.addprevious(child)


def _without_thumbnail(made: WordDocument) -> None:
    """Leave out the picture of another document that python-docx's template has."""
    relations = made.part.package.rels
    for name in [name for name, relation in relations.items() if relation.reltype.endswith("/thumbnail")]:
        del relations[name]
