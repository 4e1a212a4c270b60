"""Polar diagrams: curves of the results over an angle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from diecut_report.quantities.units import pretty, unit
from diecut_report.report.curves import continuous, period_of, through_pole
from diecut_report.report.figures.diagram import STROKES, titled
from diecut_report.report.figures.panel_data import limits_of
from diecut_report.report.figures.sizes import WIDTHS, Size
from diecut_report.report.figures.style import MM, canvas, marked
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import joined, number

Data = Mapping[str, Any]
TURN = 360.0
SIDES = {Size.LARGE: 100 * MM, Size.LOW: 74 * MM, Size.HALF: 74 * MM}  # of the square about the circles
HEADS = {Size.LARGE: 16.0, Size.HALF: 30.0}  # above it: beside the uppermost angle, or higher


def polar(figure: Data, curves: Data, words: Catalogue, size: Size = Size.LARGE) -> Figure:
    """Size of curves as distance from the pole over an angle; what is negative has another line."""
    over = curves[figure["abscissa"]]
    side, width = SIDES.get(size, SIDES[Size.LOW]), WIDTHS[size]
    total = side + HEADS.get(size, HEADS[Size.HALF])
    sheet = canvas(width, total)
    axes = sheet.add_axes(
        ((width - side + 40) / 2 / width, 30 / total, (side - 40) / width, (side - 30) / total),
        projection="polar",
    )
    for index, series in enumerate(figure["series"]):
        x, y = through_pole(*continuous(curves[series["curve"]], over, period_of(over)))
        y = y / unit(figure["unit"]).factor
        for sign, shade in ((1, 0), (-1, 1)):
            colour, dashes, width = STROKES[(2 * index + shade) % len(STROKES)]
            said = f"{marked(series['label'])}, {words['positive' if sign > 0 else 'negative']}"
            axes.plot(
                x,
                np.where(sign * y >= 0, np.abs(y), np.nan),
                color=colour,
                linestyle=dashes,
                linewidth=width,
                label=said,
            )
    axes.set_rlabel_position(_emptiest(axes))  # type: ignore[attr-defined]
    axes.set_xticks(np.radians(np.arange(0, TURN, 30)))
    axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))
    axes.tick_params(pad=1)
    low, high = limits_of(figure, figure["unit"]) or (None, None)
    axes.set_ylim(low or 0, high)
    greatest = max(tick for tick in axes.get_yticks() if tick <= axes.get_ylim()[1])
    axes.yaxis.set_major_formatter(FuncFormatter(lambda v, _: _radial(v, greatest, figure["unit"], words)))
    sheet.text(0.02, 1 - 14 / total, titled(over["description"], over["symbol"], over["display_unit"]))
    sheet.legend(*axes.get_legend_handles_labels(), loc="lower center", ncols=2, borderaxespad=0.1)
    return sheet


def _emptiest(axes: Axes) -> float:
    """The direction, in degrees, in which the curves stay nearest to the pole: there the circles are named."""
    drawn = np.concatenate([np.column_stack(line.get_data()) for line in axes.lines])
    angles, sizes = np.degrees(drawn[:, 0]) % TURN, np.nan_to_num(drawn[:, 1])
    directions = np.arange(15.0, TURN, 30.0)
    return float(min(directions, key=lambda d: sizes[np.abs((angles - d + 180) % TURN - 180) < 14].max(initial=0.0)))


def _radial(value: float, greatest: float, shown: str, words: Catalogue) -> str:
    """The number at a circle, at the greatest one with its unit."""
    text = number(f"{value:.10g}", words["decimal"])
    return "" if value == 0 else joined(text, pretty(shown)) if value == greatest else text
