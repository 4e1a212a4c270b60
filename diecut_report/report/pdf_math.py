"""A formula's outlines as PDF operators: drawn once, given to WeasyPrint as an image that it need not read."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from fontTools.svgLib.path import parse_path

from diecut_report.report.operator_pen import OperatorPen
from diecut_report.report.pdf_search import unseen
from diecut_report.report.typeset import Outline

_GLYPH = re.compile(r'<path id="[^"]*?-(g\d+)" d="([^"]*)"/>')
_PLACED = re.compile(
    r'<use href="#[^"]*?-(?P<glyph>g\d+)" (?:x="(?P<x>[-\d.]+)" y="(?P<y>[-\d.]+)"'
    r'|transform="translate\((?P<left>[-\d.]+) (?P<up>[-\d.]+)\) scale\((?P<scale>[-\d.]+)\)")/>'
    r'|<rect x="(?P<rx>[-\d.]+)" y="(?P<ry>[-\d.]+)" width="(?P<rw>[-\d.]+)" height="(?P<rh>[-\d.]+)"/>'
)
_DRAWN = re.compile(r"<(?:use|rect|path|line|polygon|circle|ellipse|polyline)\b")


class Picture:
    """An image as WeasyPrint wants it (``get_intrinsic_size``, ``draw``) of a formula, with its text under it for searches."""

    def __init__(self, outline: Outline, text: str) -> None:
        self.outline, self.lines = outline, text.split("\n")
        self.operators = operators(outline.svg)

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


def operators(svg: str) -> str:
    """The PDF operators of a formula's SVG (y upwards, 1000 units an em); SVG of another build is refused."""
    body = svg[svg.index("</defs>") :] if "</defs>" in svg else ""
    glyphs = {name: _outline(name, path) for name, path in _GLYPH.findall(svg)}
    placed = list(_PLACED.finditer(body))
    if len(placed) != len(_DRAWN.findall(body)):
        raise ValueError("a typeset formula holds shapes that cannot be drawn")
    return "\n".join(_operator(found, glyphs) for found in placed)


def _operator(found: re.Match[str], glyphs: dict[str, str]) -> str:
    if found["glyph"] is None:
        return f"{found['rx']} {found['ry']} {found['rw']} {found['rh']} re f"
    scale = found["scale"] or "1"
    return f"q {scale} 0 0 {scale} {found['x'] or found['left']} {found['y'] or found['up']} cm {glyphs[found['glyph']]} f Q"


@cache
def _outline(_name: str, path: str) -> str:
    pen = OperatorPen()
    parse_path(path, pen)
    return " ".join(pen.operators)
