"""Charts of a study's summary, in the style of the report's; each with a text that says what it shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from diecut_report.languages.speech import decimal_sign, localised, said
from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.style import ACCENT, FONT_SIZE, INK, SOFT, Svg, canvas, drawn, text_size
from diecut_report.report.number_format import number
from diecut_report.study.analysis.stored_variants import STATUSES, StoredColumn
from diecut_report.study.summary.data import Histogram
from diecut_report.study.summary.influence import Influence, Share
from diecut_report.study.summary.quantity_names import WORDS, factor, is_utilisation, named, titled, wrapped

COLOURS = {"pass": "#6f9fc0", "warn": "#d9a13a", "fail": "#a3161a", "error": "#9aa4ae"}
ORDER = ("pass", "warn", "fail")  # from the back to the front
FOOT, HEAD = 24.0, 22.0  # points below and above a small diagram
SCALE = 24.0  # points of the numbers beside a small diagram
LABEL = 240.0  # points of a name beside a bar
MOST_BARS = 15  # inputs of an influence


def chart(build: Callable[[], Figure], told: str, key: str) -> Svg:
    """Return a drawn chart, named by its text alternative."""
    return drawn(build, told, key)


def panel(sheet: Figure, left: float, bottom: float, wide: float, high: float) -> Axes:
    """Return axes at a place in points."""
    width, height = (float(side) * 72 for side in sheet.get_size_inches())
    axes = sheet.add_axes((left / width, bottom / height, wide / width, high / height))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: number(f"{value:.10g}", decimal_sign())))
    return axes


# --- bars ------------------------------------------------------------------------------------------------------------


def shares(counts: dict[str, int], told: str) -> Svg:
    """Return one bar: the variants by status."""
    return chart(partial(_shares, counts), told, "counts")


def _shares(counts: dict[str, int]) -> Figure:
    sheet = canvas(WIDTH, 34)
    axes = panel(sheet, 1, 4, WIDTH - 2, 26)
    total, start = sum(counts.values()) or 1, 0.0
    for status, count in counts.items():
        share = count / total
        axes.barh(0, share, 1, start, color=COLOURS[status], edgecolor="white", linewidth=0.8)
        words = localised(f"{said(WORDS[status])} {100 * share:.3g} %")
        if text_size(words)[0] + 8 < share * WIDTH:
            axes.text(
                start + share / 2,
                0,
                words,
                ha="center",
                va="center_baseline",
                color="white" if status == "fail" else INK,
            )
        start += share
    axes.set_xlim(0, 1)
    axes.set_axis_off()
    return sheet


class Bar(NamedTuple):
    """Hold a bar of counts: its name, its parts, and what stands behind it."""

    name: str
    parts: Sequence[float]
    told: str


def stacked(rows: Sequence[Bar], colours: Sequence[str], told: str, key: str) -> Svg:
    """Return horizontal bars of counts, each of several parts."""
    return chart(partial(_stacked, rows, colours), told, key)


def _stacked(rows: Sequence[Bar], colours: Sequence[str]) -> Figure:
    labels = [wrapped(row.name, LABEL, FONT_SIZE, 1) for row in rows]
    sheet, names = canvas(WIDTH, 17.0 * len(rows) + 8), max(text_size(label)[0] for label in labels) + 10
    behind = max(text_size(row.told, 8)[0] for row in rows) + 10
    axes = panel(sheet, names, 4, WIDTH - names - behind, 17.0 * len(rows))
    for place, row in zip(range(len(rows))[::-1], rows, strict=True):
        start = 0.0
        for part, colour in zip(row.parts, colours, strict=True):
            axes.barh(place, part, 0.66, start, color=colour)
            start += part
        axes.annotate(row.told, (start, place), (4, 0), textcoords="offset points", va="center_baseline", size=8)
    axes.set_yticks(range(len(rows))[::-1], labels, va="center_baseline")
    _bare(axes, len(rows))
    axes.set_xlim(0, max(sum(row.parts) for row in rows) or 1)
    return sheet


def _bare(axes: Axes, rows: int) -> None:
    axes.set_ylim(-0.6, rows - 0.4)
    axes.grid(visible=False)
    axes.tick_params(axis="y", length=0)
    axes.tick_params(axis="x", bottom=False, labelbottom=False)
    axes.axvline(0, color=INK, linewidth=0.8)
    for side in axes.spines.values():
        side.set_visible(False)


def influence(found: Influence, told: str, key: str) -> Svg:
    """Return the inputs of an influence, as bars; for Sobol indices the total behind the first."""
    return chart(partial(_influence, found), told, key)


def _influence(found: Influence) -> Figure:
    rows = found.telling[:MOST_BARS]
    sheet = canvas(WIDTH, 17.0 * len(rows) + 26)
    labels = [wrapped(named(share.column), LABEL, FONT_SIZE, 1) for share in rows]
    names = max(text_size(label)[0] for label in labels) + 10
    axes = panel(sheet, names, 18, WIDTH - names - 12, 17.0 * len(rows))
    for place, share in zip(range(len(rows))[::-1], rows, strict=True):
        if share.total is not None:
            axes.barh(place, share.total, 0.66, color="#c3d4e0", xerr=share.total_error, error_kw=_whisker(SOFT))
        axes.barh(place, share.first, 0.66 if share.total is None else 0.34, color=_colour(share),
                  xerr=share.first_error, error_kw=_whisker(INK))  # fmt: skip
    axes.set_yticks(range(len(rows))[::-1], labels, va="center_baseline")
    _bare(axes, len(rows))
    axes.tick_params(axis="x", bottom=True, labelbottom=True)
    axes.grid(visible=True, axis="x")
    axes.set_axisbelow(True)
    axes.set_xlim(*((0, 1.05) if found.is_sobol else (-1, 1)))
    return sheet


def _colour(share: Share) -> str:
    return ACCENT if share.first >= 0 else "#b06a2c"


def _whisker(colour: str) -> dict[str, Any]:
    return {"ecolor": colour, "elinewidth": 0.7, "capsize": 1.5}


# --- distributions ---------------------------------------------------------------------------------------------------


def distributions(found: Sequence[Histogram], told: str) -> Svg:
    """Return histograms three in a row, each by status."""
    return chart(partial(_distributions, found), told, "distributions")


def _distributions(found: Sequence[Histogram]) -> Figure:
    rows, high = -(-len(found) // 3), 74.0
    wide = (WIDTH - 2 * 16) / 3
    sheet = canvas(WIDTH, rows * (high + FOOT + HEAD))
    for index, each in enumerate(found):
        row, column = divmod(index, 3)
        left, below = column * (wide + 16) + SCALE, (rows - row - 1) * (high + FOOT + HEAD) + FOOT
        axes = panel(sheet, left, below, wide - SCALE - 12, high)
        _bars(axes, each)
        _title(axes, each.column, wide - SCALE)
    return sheet


def _bars(axes: Axes, each: Histogram) -> None:
    edges, start = each.edges * factor(each.column), np.zeros(len(each.edges) - 1)
    for status in ORDER:
        counts = each.counts[STATUSES.index(status)]
        axes.bar(edges[:-1], counts, np.diff(edges), start, align="edge", color=COLOURS[status], linewidth=0)
        start = start + counts
    other = each.counts.sum(axis=0) - start
    axes.bar(edges[:-1], other, np.diff(edges), start, align="edge", color=COLOURS["error"], linewidth=0)
    axes.set_xlim(edges[0], edges[-1])
    most = int(each.counts.sum(axis=0).max())
    axes.set_ylim(0, max(1, most * 1.05))
    axes.set_yticks([most], [number(str(most))], size=6.5)
    axes.tick_params(axis="y", length=2, pad=1)
    if is_utilisation(each.column) and edges[0] < 1 < edges[-1]:
        axes.axvline(1, color=INK, linewidth=0.6, linestyle=(0, (2, 2)))
    axes.locator_params(axis="x", nbins=4)
    if each.is_open:
        axes.text(1, 0.3, "≥", transform=axes.transAxes, ha="right", va="bottom", size=8)
    axes.grid(visible=False)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)


def _title(axes: Axes, column: StoredColumn, wide: float) -> None:
    """The quantity above a diagram, on two lines where it is long."""
    axes.set_title(wrapped(titled(column), wide - 12, 7.5, 2), pad=3, size=7.5, linespacing=1.05)
