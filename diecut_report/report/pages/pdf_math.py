"""A formula's outlines as PDF operators: each letter drawn once in a document. WeasyPrint takes it as an image that it need not read."""

from __future__ import annotations

import re
from functools import cache
from io import BytesIO
from typing import Any

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.boundsPen import ControlBoundsPen
from fontTools.svgLib.path import parse_path
from fontTools.ttLib.tables._g_l_y_f import Glyph

from diecut_report.report.equations import Outline
from diecut_report.report.mathematics import OperatorPen
from diecut_report.report.pages.page_engine import Array, Dictionary, Stream, String

# Text under a picture that readers and searches find, but nobody sees: in a font whose one letter is empty.


NAME = "Unseen"  # of the font in the pages' resources
SIZE = 8 / 3  # of the letters, pixels
UNITS, WIDTH = 1000, 500  # of an em, and of each letter in it
THIN = dict.fromkeys(map(ord, "\u2009\u200a\u202f"))  # within a number: it is found as it is typed
INVISIBLE = 3  # the way of showing text that shows none
CODES = 0x10000
BLOCK, MOST_RANGES = 0x100, 100  # of codes with one first byte; of ranges in one part of a table


def unseen(lines: list[str], width: float) -> str:
    """Return the operators of lines of text at the upper left corner of a picture that is ``width`` pixels wide (y downwards)."""
    lines = [line.translate(THIN) for line in lines]
    longest = max(map(len, lines), default=0) * SIZE * WIDTH / UNITS
    narrower = min(100.0, 100 * width / longest) if longest else 100.0
    shown = " T* ".join(f"<{line.encode('utf-16-be').hex()}> Tj" for line in lines)
    font = f"/{NAME} {SIZE:.4g} Tf {INVISIBLE} Tr {narrower:.4g} Tz {SIZE:.4g} TL"
    return f"BT {font} 1 0 0 -1 0 {SIZE:.4g} Tm {shown} ET"


def add_font(pdf: Any, fonts: Any) -> None:
    """Put the font among those of a document's pages."""

    def added(made: Any) -> Any:
        pdf.add_object(made)
        return made.reference

    file = added(Stream([_file()], {"Length1": len(_file())}, compress=True))
    glyphs = added(Stream([b"\x00\x01" * CODES], compress=True))
    letters = added(Stream([_letters()], compress=True))
    described = added(Dictionary({
        "Type": "/FontDescriptor", "FontName": f"/{NAME}", "Flags": 4, "FontBBox": Array((0, 0, WIDTH, UNITS)), "ItalicAngle": 0,
        "Ascent": UNITS, "Descent": 0, "CapHeight": UNITS, "StemV": 80, "FontFile2": file,
    }))  # fmt: skip
    system = Dictionary({"Registry": String("Adobe"), "Ordering": String("Identity"), "Supplement": 0})
    descendant = added(Dictionary({
        "Type": "/Font", "Subtype": "/CIDFontType2", "BaseFont": f"/{NAME}", "CIDSystemInfo": system, "DW": WIDTH,
        "CIDToGIDMap": glyphs, "FontDescriptor": described,
    }))  # fmt: skip
    fonts[NAME] = added(Dictionary({
        "Type": "/Font", "Subtype": "/Type0", "BaseFont": f"/{NAME}", "Encoding": "/Identity-H", "ToUnicode": letters,
        "DescendantFonts": Array([descendant]),
    }))  # fmt: skip


def _letters() -> bytes:
    """The table of letters: the code of each is its number in Unicode."""
    ranges = [f"<{first:04x}> <{first + BLOCK - 1:04x}> <{first:04x}>" for first in range(0, CODES, BLOCK)]
    parts = [ranges[start : start + MOST_RANGES] for start in range(0, len(ranges), MOST_RANGES)]
    told = [f"{len(part)} beginbfrange\n" + "\n".join(part) + "\nendbfrange" for part in parts]
    return "\n".join([
        "/CIDInit /ProcSet findresource begin", "12 dict begin", "begincmap",
        "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def",
        "/CMapName /Adobe-Identity-UCS def", "/CMapType 2 def",
        "1 begincodespacerange", "<0000> <ffff>", "endcodespacerange", *told,
        "endcmap", "CMapName currentdict /CMap defineresource pop", "end", "end",
    ]).encode()  # fmt: skip


@cache
def _file() -> bytes:
    """The font's file: nothing for what is missing, and the empty letter."""
    names = [".notdef", "empty"]
    font = FontBuilder(UNITS, isTTF=True)
    font.setupGlyphOrder(names)
    font.setupCharacterMap({ord(" "): "empty"})
    font.setupGlyf({name: Glyph() for name in names})
    font.setupHorizontalMetrics(dict.fromkeys(names, (WIDTH, 0)))
    font.setupHorizontalHeader(ascent=UNITS, descent=0)
    font.setupNameTable({"familyName": NAME, "styleName": "Regular"})
    font.setupOS2()
    font.setupPost()
    font.font["head"].created = font.font["head"].modified = 0  # equal reports have equal bytes
    font.font.recalcTimestamp = False
    content = BytesIO()
    font.font.save(content)
    return content.getvalue()


AIR = 100  # about a letter, in thousandths of an em
_GLYPH = re.compile(r'<path id="[^"]*?-(g\d+)" d="([^"]*)"/>')
_PLACED = re.compile(
    r'<use href="#[^"]*?-(?P<glyph>g\d+)" (?:x="(?P<x>[-\d.]+)" y="(?P<y>[-\d.]+)"'
    r'|transform="translate\((?P<left>[-\d.]+) (?P<up>[-\d.]+)\) scale\((?P<scale>[-\d.]+)\)")/>'
    r'|<rect x="(?P<rx>[-\d.]+)" y="(?P<ry>[-\d.]+)" width="(?P<rw>[-\d.]+)" height="(?P<rh>[-\d.]+)"/>'
)
_DRAWN = re.compile(r"<(?:use|rect|path|line|polygon|circle|ellipse|polyline)\b")


class Letters:
    """The letters of a document's formulas, each drawn once as a form of its own."""

    def __init__(self) -> None:
        self.paths: dict[str, str] = {}  # and their names

    def name(self, path: str) -> str:
        """What the form of a letter's path is called."""
        return self.paths.setdefault(path, f"L{len(self.paths)}")

    def add_forms(self, pdf: Any, forms: Any) -> None:
        """Put the forms among those of a document's pages."""
        for path, name in self.paths.items():
            outline, bounds = OperatorPen(), ControlBoundsPen(None)
            parse_path(path, outline)
            parse_path(path, bounds)
            left, bottom, right, top = bounds.bounds
            form = Stream(
                [*outline.operators, "f"],
                {"Type": "/XObject", "Subtype": "/Form", "BBox": Array((left - AIR, bottom - AIR, right + AIR, top + AIR)),
                 "Resources": Dictionary()},
                compress=True,
            )  # fmt: skip
            pdf.add_object(form)
            forms[name] = form.reference


class Picture:
    """An image as WeasyPrint wants it (``get_intrinsic_size``, ``draw``) of a formula, with its text under it for searches."""

    def __init__(self, outline: Outline, text: str, letters: Letters) -> None:
        self.outline, self.lines = outline, text.split("\n")
        self.operators = operators(outline.svg, letters)

    def get_intrinsic_size(self, _resolution: float, font_size: float) -> tuple[float, float, float]:
        """Width, height and their ratio at a font size."""
        width, height = self.outline.width / 1000 * font_size, self.outline.height / 1000 * font_size
        return width, height, width / height

    def draw(self, stream: Any, width: float, height: float, style: Any) -> None:
        """Draw the formula into a box of a page (y downwards)."""
        stream.stream.append(unseen(self.lines, width))
        across, down = width / self.outline.width, height / self.outline.height
        stream.transform(across, 0, 0, -down, -self.outline.left * across, -self.outline.top * down)
        stream.set_color(style["color"])
        stream.stream.append(self.operators)


def operators(svg: str, letters: Letters) -> str:
    """The PDF operators of a formula's SVG (y upwards, 1000 units an em); SVG of another build is refused."""
    body = svg[svg.index("</defs>") :] if "</defs>" in svg else ""
    paths = dict(_GLYPH.findall(svg))
    placed = list(_PLACED.finditer(body))
    if len(placed) != len(_DRAWN.findall(body)):
        raise ValueError("a typeset formula holds shapes that cannot be drawn")
    return "\n".join(filter(None, (_operator(found, paths, letters) for found in placed)))


def _operator(found: re.Match[str], paths: dict[str, str], letters: Letters) -> str:
    if found["glyph"] is None:
        return f"{found['rx']} {found['ry']} {found['rw']} {found['rh']} re f"
    path, scale = paths[found["glyph"]], found["scale"] or "1"
    place = f"{found['x'] or found['left']} {found['y'] or found['up']}"
    return path and f"q {scale} 0 0 {scale} {place} cm /{letters.name(path)} Do Q"
