"""The figures of the results by their type, as SVG and as pictures of points (PNG), for programs that show no other ones reliably."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from diecut_report.report.chapters.drive_line import DriveLineFigure
from diecut_report.report.figures.charts import bars, chart, polar, tornado
from diecut_report.report.figures.drawing import drawing
from diecut_report.report.figures.drive_line import linked, view
from diecut_report.report.figures.kept import kept
from diecut_report.report.figures.style import SizesSize, Svg, canvas, drawn, plain, styled, text_size
from diecut_report.report.model import Drawn
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import FigureRecord, PlotPanelRecord
from diecut_report.results.mechanism_record import CurveRecord

DRAW: dict[str, Callable[..., Figure]] = {
    "plot": chart, "chart": chart, "polar": polar, "bars": bars, "drawing": drawing, "tornado": tornado,
    "front_view": view, "side_view": view,
}  # fmt: skip
DENSITY = 200  # points an inch
MARGIN, LARGEST = 0.9, 14.0  # share of a picture that a text may fill, points of its letters


def render(
    figure: Drawn | DriveLineFigure,
    curves: Mapping[str, CurveRecord],
    words: Catalogue,
    key: str,
    size: SizesSize = SizesSize.LARGE,
) -> Svg:
    """A figure of the results, so large as its place lets it be; ``key`` keeps its ids apart from those of the report's others."""
    shown = {name: curves[name] for name in _shown_curves(figure)}

    def draw() -> Svg:
        made = drawn(partial(DRAW[figure.type], figure, shown, words, size), figure.title, key)
        return linked(made, figure) if isinstance(figure, DriveLineFigure) else made

    return kept((figure, shown, words.language, key, size), draw)


def _shown_curves(figure: Drawn | DriveLineFigure) -> list[str]:
    """The curves that a figure shows, with their abscissa."""
    if not isinstance(figure, FigureRecord) or not figure.abscissa:
        return []
    panels = (panel.series for panel in figure.panels if isinstance(panel, PlotPanelRecord))
    return [figure.abscissa, *(each.curve for series in (*panels, figure.series) for each in series)]


class Raster(NamedTuple):
    """A figure as PNG, and its natural size in points of print."""

    content: bytes
    width: float
    height: float


def raster(
    figure: Drawn | DriveLineFigure,
    curves: Mapping[str, CurveRecord],
    words: Catalogue,
    key: str,
    size: SizesSize = SizesSize.LARGE,
) -> Raster:
    """The same figure as a picture of points; the same bytes for the same figure."""
    with styled(key):
        return _raster(DRAW[figure.type](figure, curves, words, size))


def _raster(drawn: Figure) -> Raster:
    FigureCanvasAgg(drawn)
    content = io.BytesIO()
    drawn.savefig(content, format="png", dpi=DENSITY, metadata={"Software": None}, facecolor="white")
    width, height = (float(side) * 72 for side in drawn.get_size_inches())
    return Raster(content.getvalue(), width, height)


def raster_of_text(text: str, width: float, height: float) -> Raster:
    """Return a line of text as a picture of a size in points, its letters as large as fit."""
    with styled("text"):
        drawn = canvas(width, height)
        wide, high = text_size(plain(text), LARGEST)
        size = LARGEST * min(1.0, MARGIN * width / max(wide, 1.0), MARGIN * height / max(high, 1.0))
        drawn.text(0.5, 0.5, plain(text), size=size, ha="center", va="center")
        return _raster(drawn)
