"""Widths and outlines of letters in the report's own fonts: what must fit into a box is measured before it is set."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from fontTools.pens.transformPen import TransformPen
from fontTools.ttLib import TTFont

from diecut_report.report.operator_pen import OperatorPen

MILLIMETRE = 72 / 25.4  # in points
LINE = 1.2  # of a line's letters
ROOM = 1.02  # what a line may come out wider than it is measured
STEP = 0.25  # points
REGULAR, BOLD = "report-sans-regular", "report-sans-bold"
MISSING = ".notdef"


class FittedText(NamedTuple):
    """A text in lines that fit into a box, and the size of its letters in points."""

    lines: tuple[str, ...]
    size: float


def fitted(text: str, width: float, height: float, largest: float, smallest: float, face: str = REGULAR) -> FittedText:
    """Return a text as large as it may be in a box of so many millimetres; at its smallest it is cut where it still has no room."""
    size = largest
    while True:
        lines = list(_lines(text, width * MILLIMETRE / size / ROOM, face))
        most = max(int(height * MILLIMETRE / (LINE * size) + 1e-6), 1)
        if len(lines) <= most:
            return FittedText(tuple(lines), size)
        if size <= smallest:
            kept = lines[:most]
            kept[-1] = f"{kept[-1][: max(len(kept[-1]) - 2, 0)].rstrip()}…"
            return FittedText(tuple(kept), size)
        size = max(size - STEP, smallest)


def measured(text: str, face: str = REGULAR) -> float:
    """Return the width of a text in em."""
    return float(sum(map(_widths(face), text)))


def drawn(text: str, face: str = REGULAR) -> str:
    """Return the operators that draw a text in a PDF, in em from its baseline's start, y upwards."""
    glyphs, x, scale = _font(face).getGlyphSet(), 0.0, 1 / _font(face)["head"].unitsPerEm
    pen = OperatorPen(glyphs)
    for letter in text:
        glyphs[_named(letter, face)].draw(TransformPen(pen, (scale, 0, 0, scale, x, 0)))
        x += _widths(face)(letter)
    return " ".join([*pen.operators, "f"]) if pen.operators else ""


def _lines(text: str, width: float, face: str) -> Iterator[str]:
    """A text in lines of so many em; a word that is longer is parted."""
    line = ""
    for word in text.split():
        longer = f"{line} {word}".lstrip()
        if measured(longer, face) <= width:
            line = longer
            continue
        if line:
            yield line
        *full, line = _parts(word, width, face)
        yield from full
    if line:
        yield line


def _parts(word: str, width: float, face: str) -> list[str]:
    parts = [""]
    for letter in word:
        if parts[-1] and measured(parts[-1] + letter, face) > width:
            parts.append("")
        parts[-1] += letter
    return parts


@cache
def _font(face: str) -> TTFont:
    return TTFont(Path(import_module("diecut_report.templates").__path__[0]) / "fonts" / f"{face}.ttf")


def _named(letter: str, face: str) -> str:
    """What the font calls a letter; another font's letter counts as the one for what is missing."""
    name: str = _letters(face).get(ord(letter), MISSING)
    return name


@cache
def _letters(face: str) -> dict[int, str]:
    found: dict[int, str] = _font(face).getBestCmap()
    return found


@cache
def _widths(face: str) -> Any:
    font = _font(face)
    metrics, units = font["hmtx"], font["head"].unitsPerEm
    return cache(lambda letter: metrics[_named(letter, face)][0] / units)
