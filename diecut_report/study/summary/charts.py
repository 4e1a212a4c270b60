"""Charts of a study's summary, in the style of the report's; each with a text that says what it shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import FuncFormatter, MaxNLocator
from numpy.typing import NDArray

from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.style import ACCENT, FONT_SIZE, INK, SOFT, canvas, plain, text_size
from diecut_report.report.text import number
from diecut_report.study.analysis.variants import StoredColumn
from diecut_report.study.storage.description import STATUSES
from diecut_report.study.summary import data
from diecut_report.study.summary.best import Front, Influence
from diecut_report.text.translation import decimal_sign, localised, said, say

COLOURS = {"pass": "#6f9fc0", "warn": "#d9a13a", "fail": "#a3161a", "error": "#9aa4ae"}
ORDER = ("pass", "warn", "fail")  # from the back to the front
FOOT, HEAD = 24.0, 22.0  # points below and above a small diagram
SCALE = 24.0  # points of the numbers beside a small diagram
LABEL = 240.0  # points of a name beside a bar
MOST_BARS = 15  # inputs of an influence


def panel(sheet: Figure, left: float, bottom: float, wide: float, high: float) -> Axes:
    """Return axes at a place in points."""
    width, height = (float(side) * 72 for side in sheet.get_size_inches())
    axes = sheet.add_axes((left / width, bottom / height, wide / width, high / height))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: number(f"{value:.10g}", decimal_sign())))
    return axes


# --- bars ------------------------------------------------------------------------------------------------------------


def shares(counts: dict[str, int]) -> Figure:
    """Build one bar: the variants by status."""
    sheet = canvas(WIDTH, 34)
    axes = panel(sheet, 1, 4, WIDTH - 2, 26)
    total, start = sum(counts.values()) or 1, 0.0
    for status, count in counts.items():
        share = count / total
        axes.barh(0, share, 1, start, color=COLOURS[status], edgecolor="white", linewidth=0.8)
        words = localised(f"{said(data.WORDS[status])} {100 * share:.3g} %")
        if text_size(words)[0] + 8 < share * WIDTH:
            colour = "white" if status == "fail" else INK
            axes.text(start + share / 2, 0, words, ha="center", va="center_baseline", color=colour)
        start += share
    axes.set_xlim(0, 1)
    axes.set_axis_off()
    return sheet


def stacked(rows: Sequence[tuple[str, Sequence[float], str]], colours: Sequence[str]) -> Figure:
    """Build horizontal bars of counts, each with its name, its parts and what stands behind it."""
    labels = [data.wrapped(name, LABEL, FONT_SIZE, 1) for name, _, _ in rows]
    sheet, names = canvas(WIDTH, 17.0 * len(rows) + 8), max(text_size(label)[0] for label in labels) + 10
    behind = max(text_size(text, 8)[0] for _, _, text in rows) + 10
    axes = panel(sheet, names, 4, WIDTH - names - behind, 17.0 * len(rows))
    for place, (_, parts, text) in zip(range(len(rows))[::-1], rows, strict=True):
        start = 0.0
        for part, colour in zip(parts, colours, strict=True):
            axes.barh(place, part, 0.66, start, color=colour)
            start += part
        axes.annotate(text, (start, place), (4, 0), textcoords="offset points", va="center_baseline", size=8)
    axes.set_yticks(range(len(rows))[::-1], labels, va="center_baseline")
    _bare(axes, len(rows))
    axes.set_xlim(0, max(sum(parts) for _, parts, _ in rows) or 1)
    return sheet


def _bare(axes: Axes, rows: int) -> None:
    axes.set_ylim(-0.6, rows - 0.4)
    axes.grid(visible=False)
    axes.tick_params(axis="y", length=0)
    axes.tick_params(axis="x", bottom=False, labelbottom=False)
    axes.axvline(0, color=INK, linewidth=0.8)
    for side in axes.spines.values():
        side.set_visible(False)


def influence(found: Influence) -> Figure:
    """Build the inputs of an influence as bars; for Sobol indices the total behind the first."""
    rows = found.telling[:MOST_BARS]
    sheet = canvas(WIDTH, 17.0 * len(rows) + 26)
    labels = [data.wrapped(data.named(share.column), LABEL, FONT_SIZE, 1) for share in rows]
    names = max(text_size(label)[0] for label in labels) + 10
    axes = panel(sheet, names, 18, WIDTH - names - 12, 17.0 * len(rows))
    whisker: dict[str, Any] = {"elinewidth": 0.7, "capsize": 1.5}
    for place, share in zip(range(len(rows))[::-1], rows, strict=True):
        if share.total is not None:
            axes.barh(
                place, share.total, 0.66, color="#c3d4e0", xerr=share.total_error, error_kw=whisker | {"ecolor": SOFT}
            )
        colour, high = ACCENT if share.first >= 0 else "#b06a2c", 0.66 if share.total is None else 0.34
        axes.barh(place, share.first, high, color=colour, xerr=share.first_error, error_kw=whisker | {"ecolor": INK})
    axes.set_yticks(range(len(rows))[::-1], labels, va="center_baseline")
    _bare(axes, len(rows))
    axes.tick_params(axis="x", bottom=True, labelbottom=True)
    axes.grid(visible=True, axis="x")
    axes.set_axisbelow(True)
    axes.set_xlim(*((0, 1.05) if found.is_sobol else (-1, 1)))
    return sheet


# --- distributions ---------------------------------------------------------------------------------------------------


def distributions(found: Sequence[data.Histogram]) -> Figure:
    """Build histograms three in a row, each by status."""
    rows, high = -(-len(found) // 3), 74.0
    wide = (WIDTH - 2 * 16) / 3
    sheet = canvas(WIDTH, rows * (high + FOOT + HEAD))
    for index, each in enumerate(found):
        row, column = divmod(index, 3)
        left, below = column * (wide + 16) + SCALE, (rows - row - 1) * (high + FOOT + HEAD) + FOOT
        axes = panel(sheet, left, below, wide - SCALE - 12, high)
        _bars(axes, each)
        axes.set_title(
            data.wrapped(data.titled(each.column), wide - SCALE - 12, 7.5, 2), pad=3, size=7.5, linespacing=1.05
        )
    return sheet


def _bars(axes: Axes, each: data.Histogram) -> None:
    edges, start = each.edges * data.factor(each.column), np.zeros(len(each.edges) - 1)
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
    if data.is_utilisation(each.column) and edges[0] < 1 < edges[-1]:
        axes.axvline(1, color=INK, linewidth=0.6, linestyle=(0, (2, 2)))
    axes.locator_params(axis="x", nbins=4)
    if each.is_open:
        axes.text(1, 0.3, "≥", transform=axes.transAxes, ha="right", va="bottom", size=8)
    axes.grid(visible=False)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)


# Charts of single variants: points over two quantities, lines over many.


# from red, where no variant passes, over grey to blue, where all do
SHADES = LinearSegmentedColormap.from_list("shares", [COLOURS["fail"], "#c9c2c0", "#2f6f9e"])
LEGEND = 16.0  # points of a legend below a chart
MARKERS = {"pass": "o", "warn": "^", "fail": "x"}


def scatter(
    drawn_from: data.SampledVariants, pairs: Sequence[tuple[StoredColumn, StoredColumn]], front: Front | None = None
) -> Figure:
    """Build two quantities of each variant, by status; one pair large, several in rows of three."""
    across = 1 if len(pairs) == 1 else 3
    wide, high = (WIDTH - 60, 230.0) if across == 1 else ((WIDTH - 3 * 44) / 3 - 4, 96.0)
    under = LEGEND if across == 1 else 0.0
    rows, pitch = -(-len(pairs) // across), high + 46 + HEAD + under
    sheet = canvas(WIDTH, rows * pitch)
    for index, (x, y) in enumerate(pairs):
        row, column = divmod(index, across)
        axes = panel(sheet, 44 + column * (wide + 44), (rows - row - 1) * pitch + 40 + under, wide, high)
        most, least = (9000, 7) if across == 1 else (2500, 3)
        _points(axes, drawn_from, x, y, float(np.clip(most / len(drawn_from.status), least, 24)))
        _front(axes, front, x, y)
        _named(axes, drawn_from, x, y, wide)
    if across == 1:
        _legend(sheet, axes)
    return sheet


def _points(axes: Axes, drawn_from: data.SampledVariants, x: StoredColumn, y: StoredColumn, size: float) -> None:
    for status in reversed(ORDER):
        here = drawn_from.status == STATUSES.index(status)
        if here.any():
            across, up = (_spread(drawn_from, column, here) * data.factor(column) for column in (x, y))
            look: dict[str, Any] = {"c": COLOURS[status], "marker": MARKERS[status], "alpha": 0.75}
            width = 0.8 if status == "fail" else 0
            axes.scatter(across, up, s=size, linewidths=width, label=said(data.WORDS[status]), **look)


def cells(found: data.Density, front: Front | None = None) -> Figure:
    """Build where all variants of a large study lie over two quantities: a square for each cell that has some."""
    wide, high, foot = WIDTH - 60, 230.0, 40.0 + LEGEND
    sheet = canvas(WIDTH, high + foot + HEAD)
    axes = panel(sheet, 44, foot, wide, high)
    j, i = np.nonzero(found.counts)
    counts, share = found.counts[j, i], found.sound[j, i] / found.counts[j, i]
    across, up = (found.x_edges, found.x), (found.y_edges, found.y)
    x, y = ((edges[:-1] + edges[1:]) / 2 * data.factor(each) for edges, each in (across, up))
    most = min(wide / len(x), high / len(y)) - 0.6
    side = most * (0.3 + 0.7 * np.log1p(counts) / np.log1p(counts.max()))
    order = np.argsort(share, kind="stable")
    colours = [SHADES(each) for each in share[order]]
    axes.scatter(x[i][order], y[j][order], s=side[order] ** 2, c=colours, marker="s", linewidths=0)
    _front(axes, front, found.x, found.y)
    _titles(axes, found.x, found.y, wide)
    for told, part in ((say("none passes"), 0.0), (say("half pass"), 0.5), (say("all pass"), 1.0)):
        axes.plot([], [], "s", color=SHADES(part), markersize=5, label=told)
    _legend(sheet, axes)
    return sheet


def _legend(sheet: Figure, axes: Axes) -> None:
    handles, names = axes.get_legend_handles_labels()
    left = axes.get_position().x0
    sheet.legend(handles, names, loc="lower left", bbox_to_anchor=(left, 0), ncols=len(names), borderaxespad=0)


def near(values: NDArray[Any]) -> NDArray[Any]:
    """Return values of which a few lie far above the others, with these at the edge."""
    there = values[np.isfinite(values)]
    if not len(there):
        return values
    return np.asarray(np.minimum(values, data.reach(there.min(), np.quantile(there, 0.95), there.max())))


def _spread(drawn_from: data.SampledVariants, column: StoredColumn, here: NDArray[Any]) -> NDArray[Any]:
    """Return values of some variants; words a little to both sides of their place, so that points do not cover each other."""
    values: NDArray[Any] = near(drawn_from.values[column.name])
    if column.name in drawn_from.words:
        values = values + 0.5 * (np.arange(len(values)) * 0.618 % 1 - 0.5)
    return np.asarray(values[here])


def _front(axes: Axes, front: Front | None, x: StoredColumn, y: StoredColumn) -> None:
    names = [objective.column.name for objective in front.objectives] if front else []
    if front is None or x.name not in names or y.name not in names:
        return
    values = front.values[:, [names.index(x.name), names.index(y.name)]] * (data.factor(x), data.factor(y))
    values = values[np.argsort(values[:, 0])]
    is_less = front.objectives[names.index(x.name)].is_less
    look: dict[str, Any] = {
        "linestyle": "-" if len(names) == 2 else "none",
        "drawstyle": "steps-post" if is_less else "steps-pre",  # round what the front betters
        "markersize": 3.4 if len(values) < 60 else 1.2,
    }
    axes.plot(*values.T, marker="D", color=INK, linewidth=0.9, label=say("Pareto front"), **look)


def _named(axes: Axes, drawn_from: data.SampledVariants, x: StoredColumn, y: StoredColumn, wide: float) -> None:
    _titles(axes, x, y, wide)
    for column, axis, limits in ((x, axes.xaxis, axes.set_xlim), (y, axes.yaxis, axes.set_ylim)):
        words = drawn_from.words.get(column.name)
        if words:
            axis.set_ticks(range(len(words)), [plain(word) for word in words], size=7)
            limits(-0.6, len(words) - 0.4)
        else:
            axis.set_major_locator(MaxNLocator(4))


def _titles(axes: Axes, x: StoredColumn, y: StoredColumn, wide: float) -> None:
    axes.set_title(data.wrapped(data.titled(y), wide, 7.5, 2), pad=3, size=7.5, linespacing=1.05)
    axes.set_xlabel(data.wrapped(data.titled(x), wide, 7.5, 2), labelpad=1.5, size=7.5, linespacing=1.05)


# The chart of parallel coordinates: each variant a line from its inputs to its results, and where on each axis variants pass.


Array = NDArray[Any]
Ends = tuple[float, float, bool]  # of an axis, and whether greater values stand at its upper end
MOST = 120  # lines of those that do not fail, and of those that fail
MOST_WORDS = 16  # on an upright axis
FIELDS, FIELD = 12, 7.0  # of an axis, and how many points they are wide
SPREAD = 0.5  # of the distance between words, over which their lines are spread
HIGH, SIDE = 190.0, 38.0  # points of the axes, and beside the outermost ones
SMALL, LEAST = 6.5, 5.0  # points of letters
LOOKS: dict[str, dict[str, Any]] = {  # dark before pale, also in grey
    "fail": {"color": "#dca09d", "linewidth": 0.4, "alpha": 0.8, "zorder": 2.0},
    "warn": {"color": "#a8741a", "linewidth": 0.8, "alpha": 0.9, "zorder": 2.1, "linestyle": (0, (4, 1.5))},
    "pass": {"color": "#123f66", "linewidth": 0.8, "alpha": 0.75, "zorder": 2.2},
}
DARK = "#123f66"


def evenly(variants: Array) -> Array:
    """Return which variants are drawn as lines, by their place in the sample: of a mask of them at most so many, evenly taken."""
    places = np.flatnonzero(variants)
    return np.asarray(places[np.linspace(0, len(places) - 1, min(len(places), MOST)).round().astype(int)])


def parallel(
    sample: data.SampledVariants, lines: Array, columns: Sequence[StoredColumn], ends: Mapping[str, Ends]
) -> Figure:
    """Build the variants as lines over upright axes, passing ones in front; the darker a field of an axis, the more of it passes."""
    pitch = (WIDTH - 2 * SIDE) / (len(columns) - 1)
    names = [data.wrapped(data.titled(column), min(pitch, 100) - 6, SMALL, 6) for column in columns]
    foot = 18 + 8.8 * max(name.count("\n") + 1 for name in names)
    sheet = canvas(WIDTH, HIGH + 14 + foot)
    axes = panel(sheet, SIDE, foot, WIDTH - 2 * SIDE, HIGH)
    scaled = _scaled(sample, columns, ends)
    _lines(axes, sample, lines, scaled)
    room = min(pitch, 2 * SIDE) - 4
    for place, column in enumerate(columns):
        _fields(axes, place, scaled[:, place], sample.status, FIELD / pitch)
        axes.axvline(place, color=INK, linewidth=0.6, zorder=3)
        _scale(axes, place, column, ends[column.name], sample.words.get(column.name), room)
        _text(axes, names[place], (place, 0), -13, SMALL)
    axes.set_ylim(-0.01, 1.01)
    axes.set_xlim(0, len(columns) - 1)
    axes.set_axis_off()
    return sheet


def _scaled(sample: data.SampledVariants, columns: Sequence[StoredColumn], ends: Mapping[str, Ends]) -> Array:
    """Return the heights of all variants on all axes, from 0 to 1; words a little to both sides of their place."""
    found = []
    for column in columns:
        values, (low, top, _) = sample.values[column.name], ends[column.name]
        if column.name in sample.words:
            low, top = low - SPREAD, top + SPREAD
            values = values + SPREAD * (np.arange(len(values)) * 0.618 % 1 - 0.5)
        found.append((np.minimum(values, top) - low) / ((top - low) or 1.0))
    return np.asarray(np.column_stack(found))


def _lines(axes: Axes, sample: data.SampledVariants, lines: Array, scaled: Array) -> None:
    across = np.arange(scaled.shape[1])
    for status, look in LOOKS.items():
        here = lines[sample.status[lines] == STATUSES.index(status)]
        axes.plot(across, scaled[here].T, **{"linestyle": "-", "solid_joinstyle": "round", **look})


def _fields(axes: Axes, place: int, heights: Array, status: Array, wide: float) -> None:
    """Draw fields along an axis, the darker the larger the share of its variants that do not fail."""
    there = np.isfinite(heights) & (status != STATUSES.index("error"))
    edges = np.linspace(0, 1, FIELDS + 1)
    passing = there & (status < STATUSES.index("fail"))
    every, sound = (np.histogram(heights[chosen], edges)[0] for chosen in (there, passing))
    for low, high, count, good in zip(edges, edges[1:], every, sound, strict=False):
        if count:
            pale: dict[str, Any] = {"facecolor": "white", "edgecolor": "#9aa4ae", "linewidth": 0.4, "zorder": 2.6}
            dark: dict[str, Any] = {"facecolor": DARK, "alpha": float(good / count), "linewidth": 0, "zorder": 2.7}
            for look in (pale, dark):
                axes.add_patch(Rectangle((place - wide / 2, low), wide, high - low, clip_on=False, **look))


def _scale(axes: Axes, place: int, column: StoredColumn, ends: Ends, words: list[str] | None, room: float) -> None:
    low, top, is_cut = ends
    if words is None:
        _fitted(axes, data.display(low, column), (place, 0), -3, room)
        _fitted(axes, f"{'≥ ' if is_cut else ''}{data.display(top, column)}", (place, 1), 3, room)
        return
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.6}
    for index, word in list(enumerate(words))[:: -(-len(words) // MOST_WORDS)]:
        height = (index + SPREAD) / (top - low + 2 * SPREAD)
        said = data.wrapped(data.value_text(word), room, 6.0, 2)
        axes.annotate(said, (place, height), ha="center", va="center", size=6.0, bbox=box, zorder=4, linespacing=1.0)


def _fitted(axes: Axes, text: str, place: tuple[float, float], above: float, room: float) -> None:
    """Write a text in letters that are small enough to leave its neighbours their room."""
    size = 7.0
    while size > LEAST and text_size(text, size)[0] > room:
        size -= 0.5
    _text(axes, text, place, above, size)


def _text(axes: Axes, text: str, place: tuple[float, float], above: float, size: float) -> None:
    side = "bottom" if above > 0 else "top"
    look: dict[str, Any] = {"ha": "center", "va": side, "size": size, "linespacing": 1.05}
    axes.annotate(text, place, (0, above), textcoords="offset points", **look)
