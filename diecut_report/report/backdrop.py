"""What lies behind each sheet's text: the frame, and words across a report that may not be released. Pictures, no text to be read."""

from __future__ import annotations

import base64

from diecut_report.report.letters import outline
from diecut_report.report.title_block import DSTU, ISO

WIDTH, HEIGHT = 210, 297  # millimetres
FRAMES = {ISO: (20, 10, 10, 10), DSTU: (20, 5, 5, 5)}  # margins in millimetres: left, top, right, bottom
ACROSS = 0.66  # of the diagonal
HIGHEST = 34.0  # millimetres of an em
LINE, STAMP = "#151c26", "#f4dede"


def page_rule(frame: str, across: str) -> str:
    """Return the style of the sheets' background; nothing where it is empty."""
    drawn = _frame(frame) + _across(across)
    if not drawn:
        return ""
    size = f'viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}mm" height="{HEIGHT}mm"'
    svg = base64.b64encode(f'<svg xmlns="http://www.w3.org/2000/svg" {size}>{drawn}</svg>'.encode()).decode()
    return f'@page {{ background: url("data:image/svg+xml;base64,{svg}") no-repeat fixed; background-size: {WIDTH}mm {HEIGHT}mm; }}'


def _frame(frame: str) -> str:
    if frame not in FRAMES:
        return ""
    left, top, right, bottom = FRAMES[frame]
    place = f'x="{left}" y="{top}" width="{WIDTH - left - right}" height="{HEIGHT - top - bottom}"'
    return f'<rect {place} fill="none" stroke="{LINE}" stroke-width="0.5"/>'


def _across(text: str) -> str:
    """The words along the sheet's diagonal, as outlines."""
    if not text:
        return ""
    path, width = outline(text)
    size = min(ACROSS * (WIDTH**2 + HEIGHT**2) ** 0.5 / width, HIGHEST)
    turned = f"translate({WIDTH / 2} {HEIGHT / 2}) rotate(-54.7) scale({size:.4g}) translate({-width / 2:.4g} 0.36)"
    return f'<path fill="{STAMP}" transform="{turned}" d="{path}"/>'
