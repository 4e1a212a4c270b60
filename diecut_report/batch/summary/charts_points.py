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

from diecut_report.batch.stored import STATUSES, Column
from diecut_report.batch.summary.charts import COLOURS, HEAD, ORDER, chart, panel
from diecut_report.batch.summary.data import Density, Sample, reach
from diecut_report.batch.summary.names import display, factor, titled, wrapped
from diecut_report.batch.summary.pareto import Front
from diecut_report.report.charts_diagram import WIDTH
from diecut_report.report.figures import INK, Svg, canvas, plain

SHADES = LinearSegmentedColormap.from_list("shares", [COLOURS["fail"], "#c9c2c0", "#2f6f9e"])
MARKERS = {"pass": "o", "warn": "^", "fail": "x"}


def scatter(
    drawn_from: Sample, pairs: Sequence[tuple[Column, Column]], told: str, key: str, front: Front | None = None
) -> Svg:
    """Two quantities of each variant, by status; one pair large, several in rows of three."""
    return chart(partial(_scatter, drawn_from, pairs, front), told, key)


def _scatter(drawn_from: Sample, pairs: Sequence[tuple[Column, Column]], front: Front | None) -> Figure:
    across = 1 if len(pairs) == 1 else 3
    wide, high = (WIDTH - 60, 230.0) if across == 1 else ((WIDTH - 3 * 44) / 3 - 4, 96.0)
    rows, pitch = -(-len(pairs) // across), high + 46 + HEAD
    sheet = canvas(WIDTH, rows * pitch)
    for index, (x, y) in enumerate(pairs):
        row, column = divmod(index, across)
        axes = panel(sheet, 44 + column * (wide + 44), (rows - row - 1) * pitch + 40, wide, high)
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
        handles, names = axes.get_legend_handles_labels()
        axes.legend(handles, names, loc="best", frameon=True, framealpha=0.85, edgecolor="none")
    return sheet


def _points(axes: Axes, drawn_from: Sample, x: Column, y: Column, size: float) -> None:
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
                label=status,
                alpha=0.75,
            )


def cells(found: Density, told: str, key: str, front: Front | None = None) -> Svg:
    """Where all variants of a large study lie over two quantities: a square for each cell that has some."""
    return chart(partial(_cells, found, front), told, key)


def _cells(found: Density, front: Front | None) -> Figure:
    wide, high, foot = WIDTH - 60, 230.0, 40.0
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
    for told, part in (("none passes", 0.0), ("half pass", 0.5), ("all pass", 1.0)):
        axes.plot([], [], "s", color=shade(part), markersize=5, label=told)
    axes.legend(loc="best", frameon=True, framealpha=0.85, edgecolor="none")
    return sheet


def shade(share: float) -> Any:
    """From red, where no variant passes, over grey to blue, where all do."""
    return SHADES(share)


def near(values: NDArray[Any]) -> NDArray[Any]:
    """Values of which a few lie far above the others, with these at the edge."""
    there = values[np.isfinite(values)]
    if not len(there):
        return values
    found: NDArray[Any] = np.minimum(values, reach(there.min(), np.quantile(there, 0.95), there.max()))
    return found


def _spread(drawn_from: Sample, column: Column, here: NDArray[Any]) -> NDArray[Any]:
    """Values of some variants; words a little to both sides of their place, so that points do not cover each other."""
    values: NDArray[Any] = near(drawn_from.values[column.name])
    if column.name in drawn_from.words:
        values = values + 0.5 * (np.arange(len(values)) * 0.618 % 1 - 0.5)
    found: NDArray[Any] = values[here]
    return found


def _front(axes: Axes, front: Front | None, x: Column, y: Column) -> None:
    names = [objective.column.name for objective in front.objectives] if front else []
    if front is None or x.name not in names or y.name not in names:
        return
    values = front.values[:, [names.index(x.name), names.index(y.name)]] * (factor(x), factor(y))
    values = values[np.argsort(values[:, 0])]
    line = "-" if len(names) == 2 else "none"
    axes.plot(
        *values.T,
        linestyle=line,
        marker="D",
        color=INK,
        markersize=3.4 if len(values) < 60 else 1.2,
        linewidth=0.9,
        label="Pareto front",
    )


def _named(axes: Axes, drawn_from: Sample, x: Column, y: Column, wide: float) -> None:
    _titles(axes, x, y, wide)
    for column, axis, limits in ((x, axes.xaxis, axes.set_xlim), (y, axes.yaxis, axes.set_ylim)):
        words = drawn_from.words.get(column.name)
        if words:
            axis.set_ticks(range(len(words)), [plain(word) for word in words], size=7)
            limits(-0.6, len(words) - 0.4)
        else:
            axis.set_major_locator(MaxNLocator(4))


def _titles(axes: Axes, x: Column, y: Column, wide: float) -> None:
    axes.set_title(wrapped(titled(y), wide, 7.5, 2), pad=3, size=7.5, linespacing=1.05)
    axes.set_xlabel(wrapped(titled(x), wide, 7.5, 2), labelpad=1.5, size=7.5, linespacing=1.05)


def parallel(drawn_from: Sample, columns: Sequence[Column], told: str) -> Svg:
    """A line for each variant over an upright axis for each quantity; those that fail behind those that pass."""
    return chart(partial(_parallel, drawn_from, columns), told, "parallel")


def _parallel(drawn_from: Sample, columns: Sequence[Column]) -> Figure:
    pitch = (WIDTH - 76) / (len(columns) - 1)
    names = [wrapped(titled(column), min(pitch, 100) - 6, 6.5, 6) for column in columns]
    foot = 16 + 8.0 * max(name.count("\n") + 1 for name in names)
    sheet = canvas(WIDTH, 204 + foot)
    axes = panel(sheet, 38, foot, WIDTH - 76, 190)
    raw = np.column_stack([drawn_from.values[column.name] for column in columns])
    shown = np.column_stack([near(values) for values in raw.T])
    low, top, high = np.nanmin(raw, axis=0), np.nanmax(shown, axis=0), np.nanmax(raw, axis=0)
    scaled = (shown - low) / np.where(top > low, top - low, 1.0)
    alpha = float(np.clip(60 / max(len(raw), 1), 0.15, 0.9))
    for status in ("fail", "warn", "pass"):
        lines = scaled[drawn_from.status == STATUSES.index(status)]
        axes.plot(np.arange(len(columns)), lines.T, "-", color=COLOURS[status], linewidth=0.7, alpha=alpha)
    for place, column in enumerate(columns):
        axes.axvline(place, color=INK, linewidth=0.8)
        lower, upper = _ends(drawn_from, column, low[place], top[place])
        upper = f"≥ {upper}" if top[place] < high[place] else upper
        _text(axes, lower, (place, 0), -3, 7)
        _text(axes, upper, (place, 1), 3, 7)
        _text(axes, names[place], (place, 0), -13, 6.5)
    axes.set_ylim(-0.01, 1.01)
    axes.set_xlim(0, len(columns) - 1)
    axes.set_axis_off()
    return sheet


def _text(axes: Axes, text: str, place: tuple[float, float], above: float, size: float) -> None:
    """A text above or below a place, some points away."""
    side = "bottom" if above > 0 else "top"
    axes.annotate(
        text, place, (0, above), textcoords="offset points", ha="center", va=side, size=size, linespacing=1.05
    )


def _ends(drawn_from: Sample, column: Column, low: float, high: float) -> tuple[str, str]:
    words = drawn_from.words.get(column.name)
    if words:
        return plain(words[int(low)]), plain(words[int(high)])
    return display(low, column), display(high, column)
