"""What lies behind each sheet's text: the frame, and words across a report that may not be released. Pictures, no text to be read."""

from __future__ import annotations

from math import cos, radians, sin
from typing import Any

from diecut_report.report.letters import BOLD, drawn, measured
from diecut_report.report.title_block import DSTU, ISO

WIDTH, HEIGHT = 210, 297  # millimetres
FRAMES = {ISO: (20, 10, 10, 10), DSTU: (20, 5, 5, 5)}  # margins in millimetres: left, top, right, bottom
ACROSS = 0.66  # of the diagonal
HIGHEST = 34.0  # millimetres of an em
SLOPE = radians(54.7)
LINE, STAMP = "0.082 0.11 0.149 RG 0.5 w", "0.957 0.871 0.871 rg"  # ink and width
RULE = '@page {{ background: url("{}") no-repeat fixed; background-size: 210mm 297mm }}'


class Backdrop:
    """An image as WeasyPrint wants it (``get_intrinsic_size``, ``draw``) of what lies behind a sheet; false where that is nothing."""

    def __init__(self, frame: str, across: str) -> None:
        self.operators = " ".join(filter(None, (_across(across), _frame(frame))))

    def __bool__(self) -> bool:
        return bool(self.operators)

    def get_intrinsic_size(self, _resolution: float, _font_size: float) -> tuple[float, float, float]:
        """Width, height and their ratio; the style gives the size on the sheet."""
        return WIDTH, HEIGHT, WIDTH / HEIGHT

    def draw(self, stream: Any, width: float, height: float, _style: Any) -> None:
        """Draw it into a sheet (y downwards)."""
        stream.transform(width / WIDTH, 0, 0, -height / HEIGHT, 0, height)
        stream.stream.append(self.operators)


def _frame(frame: str) -> str:
    if frame not in FRAMES:
        return ""
    left, top, right, bottom = FRAMES[frame]
    return f"{LINE} {left} {bottom} {WIDTH - left - right} {HEIGHT - top - bottom} re S"


def _across(text: str) -> str:
    """The words along the sheet's diagonal, as outlines."""
    if not text:
        return ""
    width = measured(text, BOLD)
    size = min(ACROSS * (WIDTH**2 + HEIGHT**2) ** 0.5 / width, HIGHEST)
    along, up = size * cos(SLOPE), size * sin(SLOPE)
    start = f"1 0 0 1 {-width / 2:.4g} -0.36 cm"
    return f"q {STAMP} {along:.5g} {up:.5g} {-up:.5g} {along:.5g} {WIDTH / 2:g} {HEIGHT / 2:g} cm {start} {drawn(text, BOLD)} Q"
