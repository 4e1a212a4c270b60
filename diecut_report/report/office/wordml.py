"""The XML of a DOCX in small pieces: runs of text, paragraphs, tables, fields, bookmarks, pictures."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple
from xml.sax.saxutils import escape, quoteattr

from markupsafe import Markup

from diecut_report.report.office.archive import holdable

SPACES = {
    "w": "http://schemas.openxmlformats.org/wordprocessingml/2006/main",
    "m": "http://schemas.openxmlformats.org/officeDocument/2006/math",
    "r": "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
    "wp": "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing",
    "a": "http://schemas.openxmlformats.org/drawingml/2006/main",
    "pic": "http://schemas.openxmlformats.org/drawingml/2006/picture",
}
SVG_SPACE, SVG_EXTENSION = (
    "http://schemas.microsoft.com/office/drawing/2016/SVG/main",
    "{96DAC541-7B7A-43D3-8B79-37D633B846F1}",
)
TEXT_WIDTH = 9638  # twentieths of a point: A4 with margins of 20 mm
EMU = 12700  # to a point
WIDEST, HIGHEST = TEXT_WIDTH / 20, 620.0  # of a picture, points
FIELD_END = '<w:r><w:fldChar w:fldCharType="end"/></w:r>'
_TAG = re.compile(r"(<i class=sy>|</i>|<sub>|</sub>)")

Inline = str  # runs and what else stands in a line, as XML


def attribute(text: str) -> str:
    """A text as the value of an attribute, with its quotes."""
    return quoteattr(holdable(text))


def run(text: str, style: str = "", form: str = "") -> Inline:
    """A run of text in a character style, or with a form of its own."""
    named = f'<w:rStyle w:val="{style}"/>' if style else ""
    properties = f"<w:rPr>{named}{form}</w:rPr>" if named or form else ""
    return f'<w:r>{properties}<w:t xml:space="preserve">{escape(holdable(text))}</w:t></w:r>' if text else ""


def bold(text: str) -> Inline:
    """A bold text."""
    return run(text, "Strong")


def key(text: str) -> Inline:
    """A name of the configuration, in letters of equal width."""
    return run(text, "Key")


def small(text: str | Markup) -> Inline:
    """What is said beside."""
    return rich(text, "Small")


def rich(text: str | Markup, style: str = "") -> Inline:
    """A text of the report with its symbols (``symbol``, ``prose``): letters italic, indices lowered; any other text as it is."""
    if not isinstance(text, Markup):
        return run(text, style)
    found, italic, lowered = [], False, False
    for part in _TAG.split(text):
        if part.startswith("<") and _TAG.fullmatch(part):
            italic = part.startswith("<i") or (italic and part != "</i>")
            lowered = part == "<sub>" or (lowered and part != "</sub>")
            continue
        form = ("<w:i/>" if italic else "") + ('<w:vertAlign w:val="subscript"/>' if lowered else "")
        found.append(run(Markup(part).unescape(), style, form))
    return "".join(found)


def new_line() -> Inline:
    """The begin of another line."""
    return "<w:r><w:br/></w:r>"


def field(instruction: str, shown: str = "", style: str = "", *, is_dirty: bool = False) -> Inline:
    """A field that the word processor fills; ``shown`` stands there until it does."""
    dirty = ' w:dirty="true"' if is_dirty else ""
    properties = f'<w:rPr><w:rStyle w:val="{style}"/></w:rPr>' if style else ""
    return (
        f'<w:r>{properties}<w:fldChar w:fldCharType="begin"{dirty}/></w:r>'
        f'<w:r>{properties}<w:instrText xml:space="preserve"> {escape(instruction)} </w:instrText></w:r>'
        f'<w:r>{properties}<w:fldChar w:fldCharType="separate"/></w:r>{run(shown, style)}{FIELD_END}'
    )


def link(anchor: str, inner: Inline) -> Inline:
    """What leads to a bookmark."""
    return f'<w:hyperlink w:anchor={attribute(anchor)} w:history="1">{inner}</w:hyperlink>'


def bookmark(number: int, name: str, inner: Inline) -> Inline:
    """A place that links lead to."""
    return f'<w:bookmarkStart w:id="{number}" w:name={attribute(name)}/>{inner}<w:bookmarkEnd w:id="{number}"/>'


def paragraph(inner: Inline, style: str = "", *, keep: bool = False, align: str = "") -> str:
    """A paragraph in a style; ``keep`` holds it together with the next one."""
    parts = (
        f'<w:pStyle w:val="{style}"/>' if style else "",
        "<w:keepNext/>" if keep else "",
        f'<w:jc w:val="{align}"/>' if align else "",
    )
    properties = "".join(parts)
    return f"<w:p><w:pPr>{properties}</w:pPr>{inner}</w:p>" if properties else f"<w:p>{inner}</w:p>"


class TableColumn(NamedTuple):
    """A column of a table: its head, its share of the width, and whether its texts stand right."""

    head: Inline
    share: float
    right: bool = False


def table(
    columns: Sequence[TableColumn], rows: Iterable[Sequence[Inline]], *, style: str = "ReportTable", headed: bool = True
) -> str:
    """A table across the page; its heads are repeated on each sheet, its rows are not broken."""
    whole = sum(column.share for column in columns)
    widths = [round(TEXT_WIDTH * column.share / whole) for column in columns]
    grid = "".join(f'<w:gridCol w:w="{width}"/>' for width in widths)
    first = f'w:val="{"0620" if headed else "0600"}" w:firstRow="{int(headed)}"'
    look = f'<w:tblLook {first} w:lastRow="0" w:firstColumn="0" w:lastColumn="0" w:noHBand="1" w:noVBand="1"/>'
    form = f'<w:tblStyle w:val="{style}"/><w:tblW w:w="{sum(widths)}" w:type="dxa"/><w:tblLayout w:type="fixed"/>{look}'
    aligns = ["right" if column.right else "" for column in columns]
    head = [_row([column.head for column in columns], widths, aligns, is_head=True)] if headed else []
    lines = [_row(row, widths, aligns) for row in rows]
    return f"<w:tbl><w:tblPr>{form}</w:tblPr><w:tblGrid>{grid}</w:tblGrid>{''.join([*head, *lines])}</w:tbl>"


def _row(cells: Sequence[Inline], widths: Sequence[int], aligns: Sequence[str], *, is_head: bool = False) -> str:
    """A row; where it has fewer cells than the table the last one spans the rest."""
    rest = len(widths) - len(cells) + 1
    made = []
    for index, cell in enumerate(cells):
        spans = rest if index == len(cells) - 1 else 1
        width = sum(widths[index : index + spans])
        span = f'<w:gridSpan w:val="{spans}"/>' if spans > 1 else ""
        align = aligns[index] if spans == 1 else ""
        inner = paragraph(cell, "TableText", align=align)
        made.append(f'<w:tc><w:tcPr><w:tcW w:w="{width}" w:type="dxa"/>{span}</w:tcPr>{inner}</w:tc>')
    head = "<w:tblHeader/>" if is_head else ""
    return f"<w:tr><w:trPr><w:cantSplit/>{head}</w:trPr>{''.join(made)}</w:tr>"


def picture(number: int, relation: str, width: float, height: float, told: str, vector: str = "") -> Inline:
    """A picture of a size in points, bounded by the page; ``told`` is what it says to those who do not see it.

    ``vector`` names the same as SVG, which programs show that know it.
    """
    scale = min(1.0, WIDEST / width, HIGHEST / height)
    extent = f'cx="{round(width * scale * EMU)}" cy="{round(height * scale * EMU)}"'
    named = f'id="{number}" name="Figure {number}" descr={attribute(told)}'
    return (
        f'<w:r><w:drawing><wp:inline distT="0" distB="0" distL="0" distR="0"><wp:extent {extent}/><wp:docPr {named}/>'
        '<wp:cNvGraphicFramePr><a:graphicFrameLocks noChangeAspect="1"/></wp:cNvGraphicFramePr>'
        f'<a:graphic><a:graphicData uri="{SPACES["pic"]}"><pic:pic><pic:nvPicPr><pic:cNvPr {named}/><pic:cNvPicPr/></pic:nvPicPr>'
        f'<pic:blipFill><a:blip r:embed="{relation}">{_vector(vector)}</a:blip><a:stretch><a:fillRect/></a:stretch></pic:blipFill>'
        f'<pic:spPr><a:xfrm><a:off x="0" y="0"/><a:ext {extent}/></a:xfrm><a:prstGeom prst="rect"><a:avLst/></a:prstGeom></pic:spPr>'
        "</pic:pic></a:graphicData></a:graphic></wp:inline></w:drawing></w:r>"
    )


def _vector(relation: str) -> str:
    """What names an SVG beside the picture of points (Microsoft's extension of 2016)."""
    if not relation:
        return ""
    named = f'<asvg:svgBlip xmlns:asvg="{SVG_SPACE}" r:embed="{relation}"/>'
    return f'<a:extLst><a:ext uri="{SVG_EXTENSION}">{named}</a:ext></a:extLst>'
