"""The figures of an optimisation, in the style of a study's summary: the front, how it was found, where it lies within the bounds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from diecut_report.expressions import Array
from diecut_report.languages.speech import say
from diecut_report.optimisation.bounds import InputPlace
from diecut_report.optimisation.front import FoundFront, TriedMachines
from diecut_report.optimisation.progress import SearchProgress
from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.style import ACCENT, FONT_SIZE, INK, SOFT, Svg, canvas, text_size
from diecut_report.study.analysis.stored_variants import StoredColumn
from diecut_report.study.summary.charts import COLOURS, HEAD, LABEL, chart, panel
from diecut_report.study.summary.pareto import StoredObjective
from diecut_report.study.summary.quantity_names import factor, quantity, titled, wrapped

LEGEND, MOST_PAIRS, MOST_POINTS = 16.0, 6, 3000
Pair = tuple[int, int]  # of objectives, by their places


@dataclass(frozen=True)
class Cloud:
    """Hold the machines behind a front: their objectives (SI) and which of them are allowed."""

    values: Array
    allowed: Array


def cloud(there: TriedMachines, goals: Sequence[StoredObjective]) -> Cloud:
    """Return the calculated machines, every so-manieth of very many."""
    signs = np.array([1.0 if goal.is_less else -1.0 for goal in goals])
    rows = np.flatnonzero(np.isfinite(there.costs).all(axis=1))
    rows = rows[:: max(1, -(-len(rows) // MOST_POINTS))]
    return Cloud(there.costs[rows] * signs, there.violations[rows] == 0)


def front(found: FoundFront, there: TriedMachines, told: str) -> Svg:
    """Return each pair of objectives: what was tried, the front, the suggested machine and today's."""
    pairs = list(combinations(range(len(found.objectives)), 2))[:MOST_PAIRS]
    return chart(partial(_front, found, there, pairs), told, "front")


def _front(found: FoundFront, there: TriedMachines, pairs: Sequence[Pair]) -> Figure:
    across = 1 if len(pairs) == 1 else 3
    wide, high = (WIDTH - 60, 230.0) if across == 1 else ((WIDTH - 3 * 44) / 3 - 4, 100.0)
    pitch, rows = high + 46 + HEAD, -(-len(pairs) // across)
    sheet = canvas(WIDTH, rows * pitch + LEGEND)
    behind = cloud(there, found.objectives)
    for index, pair in enumerate(pairs):
        row, column = divmod(index, across)
        axes = panel(sheet, 44 + column * (wide + 44), (rows - row - 1) * pitch + 40 + LEGEND, wide, high)
        _pair(axes, found, there, behind, pair, 24.0 if across == 1 else 9.0)
        x, y = (found.objectives[place].column for place in pair)
        axes.set_title(wrapped(titled(y), wide, 7.5, 2), pad=3, size=7.5, linespacing=1.05)
        axes.set_xlabel(wrapped(titled(x), wide, 7.5, 2), labelpad=1.5, size=7.5, linespacing=1.05)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(MaxNLocator(6 if across == 1 else 4))
    handles, names = axes.get_legend_handles_labels()
    sheet.legend(handles, names, loc="lower left", bbox_to_anchor=(44 / WIDTH, 0), ncols=len(names), borderaxespad=0)
    return sheet


def _pair(axes: Axes, found: FoundFront, there: TriedMachines, behind: Cloud, pair: Pair, size: float) -> None:
    x, y = pair
    columns = [found.objectives[place].column for place in pair]
    scale = np.array([factor(column) for column in columns])
    points = found.values[:, [x, y]] * scale
    for is_allowed, colour, words in (
        (False, "#dcc3c3", say("is not allowed")),
        (True, COLOURS["pass"], say("is allowed")),
    ):
        some = behind.values[behind.allowed == is_allowed][:, [x, y]] * scale
        axes.scatter(some[:, 0], some[:, 1], s=size / 3, c=colour, linewidths=0, alpha=0.7, label=words)
    line = "-" if len(found.objectives) == 2 else "none"
    step = "steps-post" if found.objectives[x].is_less else "steps-pre"  # round what the front betters
    order = np.argsort(points[:, 0], kind="stable")
    axes.plot(*points[order].T, linestyle=line, drawstyle=step, marker="D", color=INK, markersize=2.6, linewidth=0.8,
              label=say("Pareto front"))  # fmt: skip
    if found.suggested is not None:
        axes.plot(*points[[found.suggested]].T, "o", color="none", markeredgecolor=ACCENT, markeredgewidth=1.6,
                  markersize=9, label=say("suggestion"))  # fmt: skip
    if found.today is not None and np.isfinite(there.costs[0]).all():
        signs = np.array([1.0 if found.objectives[place].is_less else -1.0 for place in pair])
        now = there.costs[0, [x, y]] * signs * scale
        axes.plot([now[0]], [now[1]], "*", color="#b06a2c", markersize=9, label=say("today"))
    _limits(axes, points, behind.values[behind.allowed][:, [x, y]] * scale)


def _limits(axes: Axes, points: Array, allowed: Array) -> None:
    """Show the front and the allowed machines near it: what lies far off would press it into a corner."""
    low, high = points.min(axis=0), np.maximum(points.max(axis=0), np.quantile(allowed, 0.9, axis=0))
    low = np.minimum(low, np.quantile(allowed, 0.1, axis=0))
    room = 0.06 * np.where(high > low, high - low, np.maximum(np.abs(high), 1e-12))
    axes.set_xlim(low[0] - room[0], high[0] + room[0])
    axes.set_ylim(low[1] - room[1], high[1] + room[1])


def progress(found: SearchProgress, goals: Sequence[StoredObjective], told: str) -> Svg:
    """Return how far the search was after each generation."""
    return chart(partial(_progress, found, goals), told, "progress")


def _progress(found: SearchProgress, goals: Sequence[StoredObjective]) -> Figure:
    wide, high = WIDTH - 60, 120.0
    sheet = canvas(WIDTH, high + 40 + HEAD)
    axes = panel(sheet, 44, 36, wide, high)
    reached = np.array(found.reached)
    if len(goals) == 1:
        reached = reached * (1.0 if goals[0].is_less else -1.0) * factor(goals[0].column)
        title = titled(goals[0].column)
    else:
        reached, title = 100 * reached, say("Volume that the front dominates, % of that at the end")
    axes.plot(found.tried, reached, color=ACCENT, marker="o", markersize=2.4)
    axes.set_title(wrapped(title, wide, 7.5, 1), pad=3, size=7.5)
    axes.set_xlabel(say("machines tried"), labelpad=1.5, size=7.5)
    axes.set_xlim(0, max(found.tried))
    axes.yaxis.set_major_locator(MaxNLocator(5))
    return sheet


def bounds(found: Sequence[InputPlace], told: str) -> Svg:
    """Return where the front's points lie within the range of each number that varies."""
    return chart(partial(_bounds, found), told, "bounds")


def _bounds(found: Sequence[InputPlace]) -> Figure:
    labels = [wrapped(titled(each.column), LABEL, FONT_SIZE, 1) for each in found]
    ends = [(_bare(each.low, each.column), _bare(each.high, each.column)) for each in found]
    names = max(text_size(label)[0] for label in labels) + 14
    left, right = (max(text_size(each[side], 8)[0] for each in ends) + 10 for side in (0, 1))
    sheet = canvas(WIDTH, 20.0 * len(found) + 8)
    axes = panel(sheet, names + left, 4, WIDTH - names - left - right, 20.0 * len(found))
    for place, each, label, (low, high) in zip(range(len(found))[::-1], found, labels, ends, strict=True):
        axes.plot([0, 1], [place, place], color="#c3cbd3", linewidth=5, solid_capstyle="butt")
        for end, count in ((0, each.at_low), (1, each.at_high)):
            if count:
                axes.plot([end, end], [place - 0.33, place + 0.33], color=COLOURS["fail"], linewidth=2.2)
        axes.plot(each.shares, np.full(len(each.shares), place), "D", color=INK, markersize=2.6, linestyle="none")
        side: dict[str, Any] = {"textcoords": "offset points", "va": "center_baseline"}
        axes.annotate(low, (0, place), (-6, 0), ha="right", size=8, color=SOFT, **side)
        axes.annotate(high, (1, place), (6, 0), ha="left", size=8, color=SOFT, **side)
        axes.annotate(label, (0, place), (-left - 4, 0), ha="right", size=FONT_SIZE, **side)
    axes.set_xlim(-0.02, 1.02)
    axes.set_ylim(-0.6, len(found) - 0.4)
    axes.set_axis_off()
    return sheet


def _bare(value: float, column: StoredColumn) -> str:
    return quantity(value, column)
