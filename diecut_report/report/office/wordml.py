"""The XML of a DOCX in small pieces: runs of text, paragraphs, tables, fields, bookmarks, pictures."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

from markupsafe import Markup

from diecut_report.quantities.units import pretty
from diecut_report.report.equations import Equation, EquationRow
from diecut_report.report.mathematics import ATOM, NAMES, POWER, PRIMES, PRODUCT, SUM, Linear, Piece, Tree
from diecut_report.report.office.workbook import holdable
from diecut_report.report.text import MINUS, grouped, parts

SPACES = {
    "w": "http://schemas.openxmlformats.org/wordprocessingml/2006/main",
    "m": "http://schemas.openxmlformats.org/officeDocument/2006/math",
    "r": "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
    "wp": "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing",
    "a": "http://schemas.openxmlformats.org/drawingml/2006/main",
    "pic": "http://schemas.openxmlformats.org/drawingml/2006/picture",
}
SVG_SPACE = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"
SVG_EXTENSION = "{96DAC541-7B7A-43D3-8B79-37D633B846F1}"
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
    properties = (f'<w:pStyle w:val="{style}"/>' if style else "") + "<w:keepNext/>" * keep
    properties += f'<w:jc w:val="{align}"/>' if align else ""
    return f"<w:p><w:pPr>{properties}</w:pPr>{inner}</w:p>" if properties else f"<w:p>{inner}</w:p>"


class TableColumn(NamedTuple):
    """A column of a table: its head, its share of the width, and whether its texts stand right."""

    head: Inline
    share: float
    right: bool = False


def table(columns: Sequence[TableColumn], rows: Iterable[Sequence[Inline]], *, headed: bool = True) -> str:
    """A table across the page; its heads are repeated on each sheet, its rows are not broken."""
    whole = sum(column.share for column in columns)
    widths = [round(TEXT_WIDTH * column.share / whole) for column in columns]
    grid = "".join(f'<w:gridCol w:w="{width}"/>' for width in widths)
    first = f'w:val="{"0620" if headed else "0600"}" w:firstRow="{int(headed)}"'
    look = f'<w:tblLook {first} w:lastRow="0" w:firstColumn="0" w:lastColumn="0" w:noHBand="1" w:noVBand="1"/>'
    form = f'<w:tblStyle w:val="ReportTable"/><w:tblW w:w="{sum(widths)}" w:type="dxa"/><w:tblLayout w:type="fixed"/>{look}'
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


# Equations as Office Math, which is edited in a word processor: printed from the same trees, by the same rules of brackets, as LaTeX.
#
# A piece is XML in which operators stand as plain text between elements; at the end that text is put into runs.


SPACE = "http://schemas.openxmlformats.org/officeDocument/2006/math"
NARROW, WIDE, NOTHING = "\u2009", "\u2003", "\u200b"
_TEXT_HOLDERS = {f"{{{SPACE}}}{name}" for name in ("oMath", "e", "num", "den", "sub", "sup", "fName")}
ElementTree.register_namespace("m", SPACE)
_INDEXED = re.compile(r"<m:sSub><m:e>((?:(?!<m:sSub>).)*)</m:e><m:sub>((?:(?!<m:sSub>).)*)</m:sub></m:sSub>")


def omml_run(text: str, style: str = "p") -> str:
    """A text in mathematics, upright (``p``), italic (``i``), or as in a sentence (an empty style)."""
    form = f'<m:sty m:val="{style}"/>' if style else "<m:nor/>"
    return f'<m:r><m:rPr>{form}</m:rPr><m:t xml:space="preserve">{escape(holdable(text))}</m:t></m:r>'


class OfficeMath(Linear):
    """Expressions as Office Math."""

    times, dot, comma = NARROW, "·", ", "
    signs: Mapping[str, str] = {"<": "&lt;", "<=": "≤", ">": "&gt;", ">=": "≥", "==": "=", "!=": "≠"}

    def number(self, text: str) -> str:
        found = parts(text)
        if found is None:
            return omml_run(text, "")
        sign, whole, decimals, power = found
        body = (MINUS if sign == "-" else "") + grouped(whole) + (self.decimal + decimals if decimals else "")
        ten = f"<m:sSup><m:e>{omml_run('10')}</m:e><m:sup>{omml_run(str(power).replace('-', MINUS))}</m:sup></m:sSup>"
        return omml_run(f"{body}{NARROW}×{NARROW}") + ten if power else omml_run(body)

    def quantity(self, text: str, unit: str) -> str:
        printed = pretty(unit)
        space = "" if printed.startswith(("°", "′", "″")) else "\u00a0"
        return self.number(text) + (omml_run(space + printed) if printed else "")

    def symbol(self, name: str) -> str:
        if name[:1] == name[-1:] == "|" and len(name) > 2:
            return self.bracket(self.symbol(name[1:-1]), "|", "|")
        base, _, below = name.partition("_")
        if not base:
            return ""
        plain = below.rstrip(PRIMES)
        letter = omml_run(base + below[len(plain) :], "i")
        index = omml_run(plain.replace("_", NARROW))
        return f"<m:sSub><m:e>{letter}</m:e><m:sub>{index}</m:sub></m:sSub>" if plain else letter

    def bracket(self, text: str, left: str = "(", right: str = ")") -> str:
        ends = f"<m:begChr m:val={quoteattr(left)}/><m:endChr m:val={quoteattr(right)}/>"
        return f"<m:d><m:dPr>{ends}</m:dPr><m:e>{text}</m:e></m:d>"

    def name(self, function: str) -> str:
        return omml_run(NAMES.get(function, function))

    def word(self, text: str, before: str = " ", behind: str = " ") -> str:
        return omml_run(f"{before}{text}{behind}", "")

    def root(self, inner: Piece) -> Piece:
        form = '<m:radPr><m:degHide m:val="1"/></m:radPr><m:deg/>'
        return Piece(f"<m:rad>{form}<m:e>{inner.text}</m:e></m:rad>", POWER)

    def fraction(self, over: Piece, under: Piece) -> Piece:
        text = f"<m:f><m:num>{over.text}</m:num><m:den>{under.text}</m:den></m:f>"
        return Piece(text, PRODUCT, quantity=over.quantity and under.quantity, fraction=True)

    def power(self, base: str, exponent: Tree) -> str:
        """A base with its exponent, which stands above the index where it has one."""
        raised = f"<m:sup>{self._exponent(exponent)}</m:sup>"
        if found := _INDEXED.fullmatch(base):
            return f"<m:sSubSup><m:e>{found[1]}</m:e><m:sub>{found[2]}</m:sub>{raised}</m:sSubSup>"
        return f"<m:sSup><m:e>{base}</m:e>{raised}</m:sSup>"

    def cases(self, rows: list[tuple[str, str]]) -> str:
        """Values, each with its condition, in two columns behind a brace."""
        column = '<m:mc><m:mcPr><m:count m:val="2"/><m:mcJc m:val="left"/></m:mcPr></m:mc>'
        lines = "".join(f"<m:mr><m:e>{value}</m:e><m:e>{condition}</m:e></m:mr>" for value, condition in rows)
        return self.bracket(f"<m:m><m:mPr><m:mcs>{column}</m:mcs></m:mPr>{lines}</m:m>", "{", "")

    def called(self, function: str, argument: str) -> str:
        return f"<m:func><m:fName>{self.name(function)}</m:fName><m:e>{argument}</m:e></m:func>"

    def _logic(self, tree: Tree) -> Piece:
        match tree:
            case ["derivative", curve, by]:
                over, under = (Piece(omml_run("d") + self(each), PRODUCT) for each in (curve, by))
                return self.fraction(over, under)
            case ["integral", curve, by, end]:
                inner = f"{self(curve)}{NARROW}{omml_run('d')}{self(by)}"
                return Piece(_nary("∫", inner, omml_run("0"), self(end)), SUM)
            case ["nary", sign, of]:
                return Piece(_nary(sign, self(of)), SUM)
            case ["place", word, symbol, value]:
                return Piece(f"{omml_run(f'{WIDE}{word} ', '')}{self(symbol)} = {self(value)}", ATOM)
        return super()._logic(tree)


def _nary(sign: str, inner: str, below: str = "", above: str = "") -> str:
    hidden = "" if below or above else '<m:subHide m:val="1"/><m:supHide m:val="1"/>'
    form = f'<m:naryPr><m:chr m:val={quoteattr(sign)}/><m:limLoc m:val="subSup"/>{hidden}</m:naryPr>'
    return f"<m:nary>{form}<m:sub>{below}</m:sub><m:sup>{above}</m:sup><m:e>{inner}</m:e></m:nary>"


def office_math(equation: Equation, printer: OfficeMath) -> list[str]:
    """An equation as XML: a formula for each of its rows, each to stand in a paragraph of its own."""
    form = '<m:oMathParaPr><m:jc m:val="left"/></m:oMathParaPr>'
    rows = [_with_runs(_omml_row(row, printer)) for row in equation.rows]
    return [f"<m:oMathPara>{form}<m:oMath>{row}</m:oMath></m:oMathPara>" for row in rows]


def _omml_row(row: EquationRow, printer: OfficeMath) -> str:
    """A row; one that goes on with another begins with a sign, before which stands nothing that is seen."""
    links = [printer(link.form) for link in row.links]
    head = printer(row.head.form) or omml_run(NOTHING)
    start = "" if row.joint == ":" else f"{head} {row.joint} "
    return start + f" {row.joint}{WIDE if row.joint == ':' else ' '}".join(links) + printer(row.place.form)


def _with_runs(fragment: str) -> str:
    """The XML with the plain text between its elements in runs; spaces about operators are the editor's business."""
    root = ElementTree.fromstring(f'<m:oMath xmlns:m="{SPACE}">{fragment}</m:oMath>')
    for holder in [element for element in root.iter() if element.tag in _TEXT_HOLDERS]:
        for place, text in reversed(list(_loose(holder))):
            made = ElementTree.fromstring(f'<m:r xmlns:m="{SPACE}"><m:t xml:space="preserve"/></m:r>')
            made[0].text = text
            holder.insert(place, made)
    return "".join(ElementTree.tostring(child, "unicode") for child in root).replace(f' xmlns:m="{SPACE}"', "")


def _loose(holder: ElementTree.Element) -> Iterator[tuple[int, str]]:
    """Give the texts between the elements of a holder, taken out of it, with their places."""
    first, holder.text = (holder.text or "").strip(" "), None
    if first:
        yield 0, first
    for index, child in enumerate(holder, 1):
        text, child.tail = (child.tail or "").strip(" "), None
        if text:
            yield index, text
