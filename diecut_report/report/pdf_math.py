"""A formula's outlines as PDF operators: each letter drawn once in a document. WeasyPrint takes it as an image that it need not read."""

from __future__ import annotations

import re
from typing import Any

from fontTools.pens.boundsPen import ControlBoundsPen
from fontTools.svgLib.path import parse_path

from diecut_report.report.operator_pen import OperatorPen
from diecut_report.report.page_engine import Array, Dictionary, Stream
from diecut_report.report.pdf_search import unseen
from diecut_report.report.typeset import Outline

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
    if not path:
        return ""
    return (
        f"q {scale} 0 0 {scale} {found['x'] or found['left']} {found['y'] or found['up']} cm /{letters.name(path)} Do Q"
    )
