"""Charts of the results: curves over an angle, polar diagrams, bars."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator, MultipleLocator
from matplotlib.transforms import blended_transform_factory
from numpy.typing import NDArray

from diecut_report.report.curves import continuous, period_of, through_pole
from diecut_report.report.figures import (
    ACCENT,
    INK,
    MM,
    PALE,
    SOFT,
    Labels,
    canvas,
    marked,
    plain,
    sampled,
    text_size,
)
from diecut_report.report.i18n import Words
from diecut_report.report.numbers import displayed, joined, number, significant
from diecut_report.units import pretty, to_display, unit

Data = Mapping[str, Any]
Array = NDArray[Any]
WIDTH = 172 * MM
LEFT, RIGHT, TOP, BOTTOM, GAP = 46.0, 10.0, 26.0, 34.0, 30.0  # points
STROKES: tuple[tuple[str, Any, float], ...] = (
    (ACCENT, "-", 1.4),
    (INK, (0, (5, 2)), 1.1),
    (SOFT, (0, (6, 1.5, 1.2, 1.5)), 1.1),
    (INK, (0, (1.2, 1.4)), 1.1),
)
LEVELS: tuple[Any, ...] = ((0, (8, 3)), (0, (2, 2)), (0, (8, 2, 1.5, 2)))
TURN = 360.0
HEIGHTS = {1: 205.0, 2: 150.0}  # of a panel, by the number of panels; more share a page
MARKS = "os^Dv"


def plot(figure: Data, curves: Data, words: Words) -> Figure:
    """Panels one below the other over a common abscissa."""
    panels, over = figure["panels"], curves[figure["abscissa"]]
    height = HEIGHTS.get(len(panels), 118.0)
    total = TOP + len(panels) * height + (len(panels) - 1) * GAP + BOTTOM
    sheet = canvas(WIDTH, total)
    for index, panel in enumerate(panels):
        bottom = total - TOP - (index + 1) * height - index * GAP
        axes = sheet.add_axes((LEFT / WIDTH, bottom / total, (WIDTH - LEFT - RIGHT) / WIDTH, height / total))
        _panel(axes, panel, curves, over, words)
        _abscissa(axes, over, last=index == len(panels) - 1)
    return sheet


def _abscissa(axes: Axes, over: Data, *, last: bool) -> None:
    shown = over["display_unit"]
    low, high = to_display(over["values"][0], shown), to_display(over["values"][-1], shown)
    period = period_of(over)
    axes.set_xlim(low, to_display(over["values"][0] + period, shown) if period else high)
    if shown == "deg":
        axes.xaxis.set_major_locator(MultipleLocator(60 if high > 200 else 30))
        axes.xaxis.set_minor_locator(MultipleLocator(30 if high > 200 else 10))
    axes.tick_params(labelbottom=last)
    if last:
        axes.set_xlabel(titled(over["description"], over["symbol"], shown), labelpad=2)


def titled(words: str, symbol: str, shown: str) -> str:
    """Quantity, symbol and unit as the title of an axis: ``Crank angle φ, °``."""
    parts = [plain(words)] + ([marked(symbol)] if symbol else [])
    return " ".join(parts) + (f", {pretty(shown)}" if pretty(shown) else "")


def _panel(axes: Axes, panel: Data, curves: Data, over: Data, words: Words) -> None:
    shown, across = panel["unit"], over["display_unit"]
    drawn = []
    for index, series in enumerate(panel["series"]):
        x, y = continuous(curves[series["curve"]], over, period_of(over))
        colour, dashes, width = STROKES[index % len(STROKES)]
        x, y = x / unit(across).factor, y / unit(shown).factor
        axes.plot(
            x, y, color=colour, linestyle=dashes, linewidth=width, label=marked(series["label"]), zorder=3 - 0.1 * index
        )
        drawn.append(np.column_stack([x, y]))
    axes.axhline(0, color=INK, linewidth=0.6, zorder=1)
    axes.margins(y=0.16 if panel["marks"] else 0.08)
    axes.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda v, _: number(f"{v:.10g}", words["decimal"])))
    _head(axes, panel)
    _spans(axes, panel["spans"], across)
    axes.set_xlim(drawn[0][0, 0], drawn[0][-1, 0])
    low, high = axes.get_ylim()
    axes.set_ylim(low, high)
    _labels(axes, panel, drawn, across, words)


def _head(axes: Axes, panel: Data) -> None:
    title = plain(panel["title"]) + (f", {pretty(panel['unit'])}" if pretty(panel["unit"]) else "")
    several = len(panel["series"]) > 1
    if not several and panel["series"] and "$" in marked(panel["series"][0]["label"]):
        label = marked(panel["series"][0]["label"])
        title = (
            titled(panel["title"], "", "1")
            + f" {label}"
            + (f", {pretty(panel['unit'])}" if pretty(panel["unit"]) else "")
        )
    axes.set_title(title, pad=4)
    if several:
        axes.legend(
            loc="lower right", bbox_to_anchor=(1.01, 1.0), ncols=4, borderaxespad=0, borderpad=0.25, columnspacing=1.6
        )


def _spans(axes: Axes, spans: Sequence[Data], across: str) -> None:
    """Ranges as pale bands, their names at the bottom edge."""
    for span in spans:
        start, end = span["from"] / unit(across).factor, span["to"] / unit(across).factor
        axes.axvspan(start, end, color=PALE, linewidth=0, zorder=0)
        below = blended_transform_factory(axes.transData, axes.transAxes)
        axes.text(
            (start + end) / 2,
            0.015,
            plain(span["label"]),
            transform=below,
            ha="center",
            va="bottom",
            size=7,
            color=SOFT,
            zorder=1,
        )


def _labels(axes: Axes, panel: Data, drawn: Sequence[Array], across: str, words: Words) -> None:
    """Levels and marks with their values, clear of the curves and of each other."""
    to_points = axes.transData.transform
    edges = (
        to_points([(axes.get_xlim()[0], axes.get_ylim()[0]), (axes.get_xlim()[1], axes.get_ylim()[1])])
        * 72
        / _dpi(axes)
    )
    lines = [sampled(to_points(line) * 72 / _dpi(axes)) for line in drawn]
    heights = [level["value"] / unit(panel["unit"]).factor for level in panel["levels"]]
    levels = [sampled(to_points([(axes.get_xlim()[0], y), (axes.get_xlim()[1], y)]) * 72 / _dpi(axes)) for y in heights]
    labels = Labels(
        np.concatenate([*lines, *levels]), (edges[0][0] + 2, edges[0][1] + 2, edges[1][0] - 2, edges[1][1] - 2)
    )
    for span in panel["spans"]:
        width, height = text_size(plain(span["label"]), 7)
        middle = to_points(((span["from"] + span["to"]) / 2 / unit(across).factor, 0))[0] * 72 / _dpi(axes)
        labels.take((middle, edges[0][1] + height / 2 + 2), (width, height))
    for index, (level, y) in enumerate(zip(panel["levels"], heights, strict=True)):
        axes.axhline(y, color=INK, linewidth=0.7, linestyle=LEVELS[index % len(LEVELS)], zorder=2)
        text = f"{plain(level['label'])} {_value(level['value'], panel['unit'], words)}"
        _write(axes, labels, text, _beside(to_points((0, y))[1] * 72 / _dpi(axes), edges))
    for index, mark in enumerate(panel["marks"]):
        x, y = mark["x"] / unit(across).factor, mark["y"] / unit(panel["unit"]).factor
        axes.plot(
            [x], [y], MARKS[index % len(MARKS)], markersize=4.5, markerfacecolor="white", markeredgecolor=INK, zorder=5
        )
        at = _value(mark["x"], across, words)
        text = f"{plain(mark['label'])} {_value(mark['y'], panel['unit'], words)} ({at})"
        _write(axes, labels, text, _around(to_points((x, y)) * 72 / _dpi(axes)))


def _dpi(axes: Axes) -> float:
    return float(axes.figure.dpi)


def _value(value: float, shown: str, words: Words) -> str:
    return joined(displayed(value, shown, 4, words["decimal"]), pretty(shown))


def _beside(y: float, edges: Array) -> Iterator[tuple[float, float]]:
    """Places for the name of a level: above or below its line, from the right to the left."""
    for x in np.linspace(edges[1][0] - 40, edges[0][0] + 40, 24):
        yield from ((x, y + 7.0), (x, y - 7.0))


def _around(at: Array) -> Iterator[tuple[float, float]]:
    """Places for the name of a mark, near ones first."""
    for away in (9.0, 16.0, 26.0, 40.0):
        for aside in (0.0, 48.0, -48.0, 75.0, -75.0, 110.0, -110.0):
            yield from ((at[0] + aside, at[1] + away), (at[0] + aside, at[1] - away))


def _write(axes: Axes, labels: Labels, text: str, places: Iterator[tuple[float, float]]) -> None:
    size = 8.0
    x, y = labels.place(text_size(text, size), places)
    sheet = axes.get_figure(root=True)
    assert sheet is not None
    wide, high = (side * 72 for side in sheet.get_size_inches())
    halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6}
    axes.text(
        x / wide, y / high, text, transform=sheet.transFigure, ha="center", va="center", size=size, zorder=6, bbox=halo
    )


def polar(figure: Data, curves: Data, words: Words) -> Figure:
    """Size of curves as distance from the pole over an angle; what is negative has another line."""
    over = curves[figure["abscissa"]]
    side = 100 * MM
    sheet = canvas(WIDTH, side + 16)
    axes = sheet.add_axes(
        ((WIDTH - side + 40) / 2 / WIDTH, 30 / (side + 16), (side - 40) / WIDTH, (side - 30) / (side + 16)),
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
    axes.set_ylim(0)
    greatest = max(tick for tick in axes.get_yticks() if tick <= axes.get_ylim()[1])
    axes.yaxis.set_major_formatter(FuncFormatter(lambda v, _: _radial(v, greatest, figure["unit"], words)))
    sheet.text(0.02, 1 - 14 / (side + 16), titled(over["description"], over["symbol"], over["display_unit"]))
    sheet.legend(*axes.get_legend_handles_labels(), loc="lower center", ncols=2, borderaxespad=0.1)
    return sheet


def _emptiest(axes: Axes) -> float:
    """The direction, in degrees, in which the curves stay nearest to the pole: there the circles are named."""
    drawn = np.concatenate([np.column_stack(line.get_data()) for line in axes.lines])
    angles, sizes = np.degrees(drawn[:, 0]) % TURN, np.nan_to_num(drawn[:, 1])
    directions = np.arange(15.0, TURN, 30.0)
    return float(min(directions, key=lambda d: sizes[np.abs((angles - d + 180) % TURN - 180) < 14].max(initial=0.0)))


def _radial(value: float, greatest: float, shown: str, words: Words) -> str:
    """The number at a circle, at the greatest one with its unit."""
    text = number(f"{value:.10g}", words["decimal"])
    return "" if value == 0 else joined(text, pretty(shown)) if value == greatest else text


def bars(figure: Data, _curves: Data, words: Words) -> Figure:
    """Horizontal bars in groups side by side, each group with its unit; what is subtracted is hatched."""
    groups = figure["groups"]
    rows = max(len(group["bars"]) for group in groups)
    height = 30 + 17.0 * rows + 8
    sheet = canvas(WIDTH, height)
    share = WIDTH / len(groups)
    for index, group in enumerate(groups):
        names = max(text_size(plain(bar["label"]))[0] for bar in group["bars"]) + 8
        left, tall = index * share + names + 4, 17.0 * len(group["bars"])
        axes = sheet.add_axes(
            (left / WIDTH, (height - 24 - tall) / height, (share - names - 14) / WIDTH, tall / height)
        )
        _group(axes, group, group.get("unit") or figure["unit"], words)
    return sheet


def _group(axes: Axes, group: Data, shown: str, words: Words) -> None:
    values = [bar["value"] / unit(shown).factor for bar in group["bars"]]
    reach = max(map(abs, values)) or 1.0
    points = axes.get_window_extent().width * 72 / _dpi(axes)
    rows = np.arange(len(values))[::-1]
    last = len(values) - 1
    for row, value, index in zip(rows, values, range(len(values)), strict=True):
        colour = "white" if value < 0 else ACCENT if index == last else "#9fb4c4"
        axes.barh(
            row, value, 0.62, edgecolor=INK, linewidth=0.6, facecolor=colour, hatch="/////" if value < 0 else None
        )
        text = number(significant(value, 4), words["decimal"])
        axes.annotate(text, (max(value, 0), row), (3, 0), textcoords="offset points", va="center_baseline", size=8)
    room = max(text_size(number(significant(value)))[0] for value in values) + 6
    low, high = min([0.0, *values]), max([0.0, *values])
    scale = (high - low) / max(points - room, 1)
    axes.set_xlim(low - 0.02 * reach, high + room * scale)
    axes.set_yticks(rows, [plain(bar["label"]) for bar in group["bars"]], va="center_baseline")
    axes.set_ylim(-0.6, len(values) - 0.4)
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.set_title(plain(group["label"]) + (f", {pretty(shown)}" if pretty(shown) else ""), pad=5)
    axes.grid(visible=False)
    axes.tick_params(axis="y", length=0)
    axes.tick_params(axis="x", bottom=False, labelbottom=False)
    for side in ("top", "right", "bottom", "left"):
        axes.spines[side].set_visible(False)
