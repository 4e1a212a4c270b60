"""Figures of the results as pictures of points (PNG), for programs that show no other ones reliably."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import Any, NamedTuple

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg

from diecut_report.report.figures.by_type import build
from diecut_report.report.figures.sizes import Size
from diecut_report.report.figures.style import load_fonts, style
from diecut_report.report.i18n import Catalogue

DENSITY = 200  # points an inch


class Raster(NamedTuple):
    """A figure as PNG, and its natural size in points of print."""

    content: bytes
    width: float
    height: float


def raster(
    figure: Mapping[str, Any], curves: Mapping[str, Any], words: Catalogue, key: str, size: Size = Size.LARGE
) -> Raster:
    """A figure of the results, drawn as ``by_type.render`` draws it; the same bytes for the same figure."""
    load_fonts()
    with mpl.rc_context(style(key)):  # type: ignore[arg-type]  # a plain dictionary is one too
        drawn = build(figure, curves, words, size)
        FigureCanvasAgg(drawn)
        content = io.BytesIO()
        drawn.savefig(content, format="png", dpi=DENSITY, metadata={"Software": None}, facecolor="white")
        width, height = (float(side) * 72 for side in drawn.get_size_inches())
    return Raster(content.getvalue(), width, height)
