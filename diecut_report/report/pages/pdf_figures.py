"""A figure's SVG, as matplotlib writes it, as PDF operators: drawn once, given to WeasyPrint as an image that it need not read.

Letters come as outlines. What a figure may hold beyond the elements below (a pattern) is left to WeasyPrint.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from math import cos, radians, sin
from textwrap import wrap
from typing import Any, NamedTuple
from xml.etree import ElementTree

from diecut_report.report.mathematics import OperatorPen
from diecut_report.report.pages.pdf_math import unseen
from diecut_report.report.symbols import font

SVG, HREF = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
PIXELS = 4 / 3  # to a point
LETTERS = 300  # in a line of a figure's texts as searches find them
WAYS = {"M": ("m", 2), "L": ("l", 2), "C": ("c", 6), "z": ("h", 0)}  # operator, numbers
CAPS = {"butt": 0, "round": 1, "square": 2}
JOINS = {"miter": 0, "round": 1, "bevel": 2}
FONTS = {"Report Sans": "report-sans-regular", "Report Symbols": "report-symbols"}
STYLE = {"fill": "#000000", "stroke": "none", "stroke-width": "1", "stroke-linecap": "butt", "stroke-linejoin": "round",
         "stroke-dasharray": "none", "stroke-dashoffset": "0", "opacity": "1"}  # fmt: skip
_COMMAND = re.compile(r"([A-Za-z])\s*((?:-?[\d.]+(?:e-?\d+)?\s+)*)")
_STEP = re.compile(r"(\w+)\(([^)]*)\)")

Style = Mapping[str, str]
Piece = str | float  # operators, or an opacity from there on


class NotDrawn(Exception):
    """A figure that holds what is not drawn here."""


class FigurePicture:
    """An image as WeasyPrint wants it (``get_intrinsic_size``, ``draw``) of a figure, with its texts under it for searches."""

    def __init__(self, svg: str, width: float, height: float) -> None:
        self.width, self.height = width, height
        drawn = _SvgOperators(ElementTree.fromstring(svg))
        self.pieces, self.texts = drawn.pieces, drawn.texts

    def get_intrinsic_size(self, _resolution: float, _font_size: float) -> tuple[float, float, float]:
        """Width, height and their ratio."""
        return self.width * PIXELS, self.height * PIXELS, self.width / self.height

    def draw(self, stream: Any, width: float, height: float, _style: Any) -> None:
        """Draw the figure into a box of a page (y downwards)."""
        stream.stream.append(unseen(wrap(" · ".join(self.texts), LETTERS), width))
        stream.transform(width / self.width, 0, 0, height / self.height)
        for piece in self.pieces:
            if isinstance(piece, str):
                stream.stream.append(piece)
            else:
                stream.set_alpha(piece, stroke=True)
                stream.set_alpha(piece, stroke=False)


class _Glyph(NamedTuple):
    """A letter's outline in the units of its font, and its width."""

    outline: str
    width: float
    units: int


class _SvgOperators:
    """Turns the elements of a drawing into operators, in their order."""

    def __init__(self, root: ElementTree.Element) -> None:
        self.pieces: list[Piece] = []
        self.texts: list[str] = []
        self.named = {node.get("id"): node for node in root.iter() if node.get("id")}
        self.children(root, STYLE)

    def children(self, node: ElementTree.Element, style: Style) -> None:
        """Draw what an element holds."""
        for child in node:
            own = _styled(child, style)
            match child.tag.removeprefix(SVG):
                case "g" | "a":
                    self.group(child, own)
                case "path":
                    self.path(child, own)
                case "use":
                    self.use(child, own)
                case "text":
                    self.text(child, own)
                case "title" | "defs":
                    pass  # what is named is drawn where it is used
                case tag:
                    raise NotDrawn(tag)

    def group(self, node: ElementTree.Element, style: Style) -> None:
        """Draw a group within its clip and transform."""
        around = self._clip(node) + _transform(node)
        if around:
            self.pieces.append("q " + around)
        self.children(node, style)
        if around:
            self.pieces.append("Q")

    def path(self, node: ElementTree.Element, style: Style, moved: str = "") -> None:
        """Draw a path as its style says."""
        painting = _painting(style)
        if not painting or not node.get("d"):
            return
        self._paint(f"{self._clip(node)}{moved}{_state(style)}{_route(node.get('d', ''))} {painting}", style)

    def use(self, node: ElementTree.Element, style: Style) -> None:
        """Draw a named path at another place."""
        named = self.named[node.get(HREF, "").removeprefix("#")]
        moved = f"1 0 0 1 {node.get('x', '0')} {node.get('y', '0')} cm "
        self.path(named, _styled(named, style), self._clip(node) + moved)

    def text(self, node: ElementTree.Element, style: Style) -> None:
        """Draw a line of text, or the letters of a formula, each at its place."""
        letters = list(_placed(node, style))
        self.texts.append("".join(part.text or "" for part in _parts(node)))
        self._paint(_transform(node) + _fill(style) + " ".join(letters), style)

    def _paint(self, operators: str, style: Style) -> None:
        opacity = float(style["opacity"])
        self.pieces += [f"q {operators} Q"] if opacity == 1 else ["q", opacity, operators, "Q"]

    def _clip(self, node: ElementTree.Element) -> str:
        if not node.get("clip-path"):
            return ""
        [shape] = self.named[node.get("clip-path", "")[5:-1]]
        if shape.tag == f"{SVG}path":
            return f"{_route(shape.get('d', ''))} W n "
        return " ".join(shape.get(key, "0") for key in ("x", "y", "width", "height")) + " re W n "


def _styled(node: ElementTree.Element, style: Style) -> Style:
    given = node.get("style")
    if not given:
        return style
    pairs = (part.split(":", 1) for part in given.split(";") if part.strip())
    found = {key.strip(): value.strip() for key, value in pairs}
    if "url(" in given:
        raise NotDrawn(given)
    return {**style, **found}


def _route(path: str) -> str:
    steps = []
    for way, places in _COMMAND.findall(path):
        if way not in WAYS or len(places.split()) != WAYS[way][1]:
            raise NotDrawn(f"{way} {places}")
        steps.append(f"{places}{WAYS[way][0]}")
    return "\n".join(steps)


def _painting(style: Style) -> str:
    filled, stroked = style["fill"] != "none", style["stroke"] != "none"
    return {(True, True): "B", (True, False): "f", (False, True): "S", (False, False): ""}[filled, stroked]


def _state(style: Style) -> str:
    dashes = style["stroke-dasharray"].replace(",", " ")
    line = f"{_colour(style['stroke'])} RG {style['stroke-width']} w {CAPS[style['stroke-linecap']]} J {JOINS[style['stroke-linejoin']]} j "
    line += f"[{dashes}] {style['stroke-dashoffset']} d " if dashes != "none" else ""
    return _fill(style) + (line if style["stroke"] != "none" else "")


def _fill(style: Style) -> str:
    return f"{_colour(style['fill'])} rg " if style["fill"] != "none" else ""


@cache
def _colour(name: str) -> str:
    if not re.fullmatch("#[0-9a-f]{6}", name):
        if name == "none":
            return "0 0 0"
        raise NotDrawn(name)
    return " ".join(f"{int(name[k : k + 2], 16) / 255:.3g}" for k in (1, 3, 5))


def _transform(node: ElementTree.Element) -> str:
    found = ""
    for name, numbers in _STEP.findall(node.get("transform") or ""):
        values = [float(each) for each in numbers.replace(",", " ").split()]
        match name, values:
            case "translate", [x, y]:
                found += f"1 0 0 1 {x:g} {y:g} cm "
            case "scale", [x, y]:
                found += f"{x:g} 0 0 {y:g} 0 0 cm "
            case "rotate", [turn, *place]:
                found += _turned(turn, *place)
            case _:
                raise NotDrawn(name)
    return found


def _turned(turn: float, x: float = 0.0, y: float = 0.0) -> str:
    if turn == 0:
        return ""
    c, s = cos(radians(turn)), sin(radians(turn))
    return f"{c:.6g} {s:.6g} {-s:.6g} {c:.6g} {x - c * x + s * y:.6g} {y - s * x - c * y:.6g} cm "


def _parts(node: ElementTree.Element) -> Iterable[ElementTree.Element]:
    """What holds the letters of a text: itself, or elements within it."""
    return [node] if node.text and node.text.strip() else node


def _placed(node: ElementTree.Element, style: Style) -> Iterator[str]:
    for part in _parts(node):
        look = _styled(part, style)
        size, letters = float(look["font-size"].removesuffix("px")), part.text or ""
        glyphs = [_glyph(letter, look["font-family"].strip("'\"")) for letter in letters]
        steps = [glyph.width * size / glyph.units for glyph in glyphs]
        places = [float(x) for x in part.get("x", "0").split()]
        if len(places) == 1:
            start = places[0] - {"start": 0.0, "middle": 0.5, "end": 1.0}[look.get("text-anchor", "start")] * sum(steps)
            places = [start + sum(steps[:k]) for k in range(len(steps))]
        y = float(part.get("y", "0").split()[0])
        for glyph, x in zip(glyphs, places, strict=True):
            scale = size / glyph.units
            if glyph.outline:
                yield f"q {scale:.5g} 0 0 {-scale:.5g} {x:.2f} {y:.2f} cm {glyph.outline} f Q"


@cache
def _glyph(letter: str, family: str) -> _Glyph:
    """A letter of a family, or of another one that has it."""
    for name in (family, *FONTS):
        if name in FONTS and ord(letter) in font(FONTS[name]).getBestCmap():
            glyphs, called = font(FONTS[name]).getGlyphSet(), font(FONTS[name]).getBestCmap()[ord(letter)]
            pen = OperatorPen(glyphs)
            glyphs[called].draw(pen)
            return _Glyph(" ".join(pen.operators), glyphs[called].width, font(FONTS[name])["head"].unitsPerEm)
    raise NotDrawn(letter)
