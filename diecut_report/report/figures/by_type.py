"""The figures of the results by their type."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from matplotlib.figure import Figure

from diecut_report.report.figures.bars import bars
from diecut_report.report.figures.charts import chart, plot
from diecut_report.report.figures.drawing import drawing
from diecut_report.report.figures.polar import polar
from diecut_report.report.figures.sizes import Size
from diecut_report.report.figures.style import Svg, drawn
from diecut_report.report.figures.tornado import tornado_of
from diecut_report.report.i18n import Catalogue

DRAW: dict[str, Callable[..., Any]] = {
    "plot": plot,
    "chart": chart,
    "polar": polar,
    "bars": bars,
    "drawing": drawing,
    "tornado": tornado_of,
}


def build(figure: Mapping[str, Any], curves: Mapping[str, Any], words: Catalogue, size: Size) -> Figure:
    """A figure of the results as matplotlib's, so large as its place on the page lets it be."""
    made: Figure = DRAW[figure["type"]](figure, curves, words, size)
    return made


def render(
    figure: Mapping[str, Any], curves: Mapping[str, Any], words: Catalogue, key: str, size: Size = Size.LARGE
) -> Svg:
    """A figure of the results; ``key`` keeps its ids apart from those of the report's other figures."""
    return drawn(partial(build, figure, curves, words, size), figure["title"], key)
