"""Charts of single variants: points over two quantities, lines over many."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from diecut_report.languages.speech import said, say
from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.style import INK, Svg, canvas, plain
from diecut_report.study.analysis.stored_variants import STATUSES, StoredColumn
from diecut_report.study.summary.charts import COLOURS, HEAD, ORDER, chart, panel
from diecut_report.study.summary.data import Density, SampledVariants, reach
from diecut_report.study.summary.pareto import Front
from diecut_report.study.summary.quantity_names import WORDS, factor, titled, wrapped

SHADES = LinearSegmentedColormap.from_list("shares", [COLOURS["fail"], "#c9c2c0", "#2f6f9e"])
LEGEND = 16.0  # points of a legend below a chart
MARKERS = {"pass": "o", "warn": "^", "fail": "x"}


def scatter(
    drawn_from: SampledVariants,
    pairs: Sequence[tuple[StoredColumn, StoredColumn]],
    told: str,
    key: str,
    front: Front | None = None,
) -> Svg:
    """Return two quantities of each variant, by status; one pair large, several in rows of three."""
    return chart(partial(_scatter, drawn_from, pairs, front), told, key)


def _scatter(
    drawn_from: SampledVariants, pairs: Sequence[tuple[StoredColumn, StoredColumn]], front: Front | None
) -> Figure:
    across = 1 if len(pairs) == 1 else 3
    wide, high = (WIDTH - 60, 230.0) if across == 1 else ((WIDTH - 3 * 44) / 3 - 4, 96.0)
    under = LEGEND if across == 1 else 0.0
    rows, pitch = -(-len(pairs) // across), high + 46 + HEAD + under
    sheet = canvas(WIDTH, rows * pitch)
    for index, (x, y) in enumerate(pairs):
        row, column = divmod(index, across)
        axes = panel(sheet, 44 + column * (wide + 44), (rows - row - 1) * pitch + 40 + under, wide, high)
        _points(
            axes,
            drawn_from,
            x,
            y,
            float(np.clip((9000 if across == 1 else 2500) / len(drawn_from.status), 3 if across > 1 else 7, 24)),
        )
        _front(axes, front, x, y)
        _named(axes, drawn_from, x, y, wide)
    if across == 1:
        _legend(sheet, axes)
    return sheet


def _points(axes: Axes, drawn_from: SampledVariants, x: StoredColumn, y: StoredColumn, size: float) -> None:
    for status in reversed(ORDER):
        here = drawn_from.status == STATUSES.index(status)
        if here.any():
            across, up = (_spread(drawn_from, column, here) * factor(column) for column in (x, y))
            width = 0.8 if status == "fail" else 0
            axes.scatter(
                across,
                up,
                s=size,
                c=COLOURS[status],
                marker=MARKERS[status],
                linewidths=width,
                label=said(WORDS[status]),
                alpha=0.75,
            )


def cells(found: Density, told: str, key: str, front: Front | None = None) -> Svg:
    """Return where all variants of a large study lie over two quantities: a square for each cell that has some."""
    return chart(partial(_cells, found, front), told, key)


def _cells(found: Density, front: Front | None) -> Figure:
    wide, high, foot = WIDTH - 60, 230.0, 40.0 + LEGEND
    sheet = canvas(WIDTH, high + foot + HEAD)
    axes = panel(sheet, 44, foot, wide, high)
    j, i = np.nonzero(found.counts)
    counts, share = found.counts[j, i], found.sound[j, i] / found.counts[j, i]
    x, y = (
        (edges[:-1] + edges[1:]) / 2 * factor(each)
        for edges, each in ((found.x_edges, found.x), (found.y_edges, found.y))
    )
    most = min(wide / len(x), high / len(y)) - 0.6
    side = most * (0.3 + 0.7 * np.log1p(counts) / np.log1p(counts.max()))
    order = np.argsort(share, kind="stable")
    axes.scatter(
        x[i][order], y[j][order], s=side[order] ** 2, c=[shade(each) for each in share[order]], marker="s", linewidths=0
    )
    _front(axes, front, found.x, found.y)
    _titles(axes, found.x, found.y, wide)
    for told, part in ((say("none passes"), 0.0), (say("half pass"), 0.5), (say("all pass"), 1.0)):
        axes.plot([], [], "s", color=shade(part), markersize=5, label=told)
    _legend(sheet, axes)
    return sheet


def _legend(sheet: Figure, axes: Axes) -> None:
    """The legend below the chart, where no point lies."""
    handles, names = axes.get_legend_handles_labels()
    left = axes.get_position().x0
    sheet.legend(handles, names, loc="lower left", bbox_to_anchor=(left, 0), ncols=len(names), borderaxespad=0)


def shade(share: float) -> Any:
    """Return a colour from red, where no variant passes, over grey to blue, where all do."""
    return SHADES(share)


def near(values: NDArray[Any]) -> NDArray[Any]:
    """Return values of which a few lie far above the others, with these at the edge."""
    there = values[np.isfinite(values)]
    if not len(there):
        return values
    found: NDArray[Any] = np.minimum(values, reach(there.min(), np.quantile(there, 0.95), there.max()))
    return found


def _spread(drawn_from: SampledVariants, column: StoredColumn, here: NDArray[Any]) -> NDArray[Any]:
    """Values of some variants; words a little to both sides of their place, so that points do not cover each other."""
    values: NDArray[Any] = near(drawn_from.values[column.name])
    if column.name in drawn_from.words:
        values = values + 0.5 * (np.arange(len(values)) * 0.618 % 1 - 0.5)
    found: NDArray[Any] = values[here]
    return found


def _front(axes: Axes, front: Front | None, x: StoredColumn, y: StoredColumn) -> None:
    names = [objective.column.name for objective in front.objectives] if front else []
    if front is None or x.name not in names or y.name not in names:
        return
    values = front.values[:, [names.index(x.name), names.index(y.name)]] * (factor(x), factor(y))
    values = values[np.argsort(values[:, 0])]
    step = (
        "steps-post" if front.objectives[names.index(x.name)].is_less else "steps-pre"
    )  # round what the front betters
    line = "-" if len(names) == 2 else "none"
    axes.plot(
        *values.T,
        linestyle=line,
        drawstyle=step,
        marker="D",
        color=INK,
        markersize=3.4 if len(values) < 60 else 1.2,
        linewidth=0.9,
        label=say("Pareto front"),
    )


def _named(axes: Axes, drawn_from: SampledVariants, x: StoredColumn, y: StoredColumn, wide: float) -> None:
    _titles(axes, x, y, wide)
    for column, axis, limits in ((x, axes.xaxis, axes.set_xlim), (y, axes.yaxis, axes.set_ylim)):
        words = drawn_from.words.get(column.name)
        if words:
            axis.set_ticks(range(len(words)), [plain(word) for word in words], size=7)
            limits(-0.6, len(words) - 0.4)
        else:
            axis.set_major_locator(MaxNLocator(4))


def _titles(axes: Axes, x: StoredColumn, y: StoredColumn, wide: float) -> None:
    axes.set_title(wrapped(titled(y), wide, 7.5, 2), pad=3, size=7.5, linespacing=1.05)
    axes.set_xlabel(wrapped(titled(x), wide, 7.5, 2), labelpad=1.5, size=7.5, linespacing=1.05)
