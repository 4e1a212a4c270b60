"""Horizontal bars of quantities, in groups."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.figures.panel_data import limits_of
from diecut_report.report.figures.sizes import WIDTHS, Size
from diecut_report.report.figures.style import ACCENT, INK, canvas, plain, text_size
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import displayed, number, significant

Data = Mapping[str, Any]
TALL, BESIDE, LEAST = 17.0, 14.0, 56.0  # of a bar with its room, beside a group, and the least width for bars, points


def bars(figure: Data, _curves: Data, words: Catalogue, size: Size = Size.LARGE) -> Figure:
    """Horizontal bars in groups side by side, in rows where they have no room; what is subtracted is hatched."""
    groups, width = figure["groups"], WIDTHS[size]
    rows = _rows(groups, figure.get("unit", ""), width)
    below = 8 if all("range" not in group for group in groups) else 20
    heights = [26 + TALL * max(len(group["bars"]) for group in row) + below for row in rows]
    height = 4 + sum(heights)
    sheet, top = canvas(width, height), height - 2
    names = [max(map(_names, column)) for column in zip_longest(*rows, fillvalue=rows[0][0])]
    for row, step in zip(rows, heights, strict=True):
        left = 0.0
        for group, named in zip(row, names, strict=False):
            room, tall = _room(names, width), TALL * len(group["bars"])
            box = (left + named + 4) / width, (top - 22 - tall) / height, room / width, tall / height
            _group(sheet.add_axes(box), width, group, group.get("unit") or figure["unit"], words)
            left += named + room + BESIDE
        top -= step
    return sheet


def _rows(groups: Sequence[Data], shown: str, width: float) -> list[list[Data]]:
    """The groups in as few rows as leave room for their bars and their titles."""
    for columns in range(len(groups), 1, -1):
        rows = [list(groups[start : start + columns]) for start in range(0, len(groups), columns)]
        room = _room([max(map(_names, column)) for column in zip_longest(*rows, fillvalue=groups[0])], width)
        if all(max(LEAST, text_size(_title(group, group.get("unit") or shown))[0]) <= room for group in groups):
            return rows
    return [[group] for group in groups]


def _names(group: Data) -> float:
    """How wide the names of a group's bars are, points."""
    return max(text_size(plain(bar["label"]))[0] for bar in group["bars"]) + 8


def _room(names: Sequence[float], width: float) -> float:
    """How wide the bars of each group in a row are beside names of these widths, points."""
    return (width - sum(names) - BESIDE * len(names)) / len(names)


def _title(group: Data, shown: str) -> str:
    return plain(group["label"]) + (f", {pretty(shown)}" if pretty(shown) else "")


def _group(axes: Axes, width: float, group: Data, shown: str, words: Catalogue) -> None:
    values = [bar["value"] / unit(shown).factor for bar in group["bars"]]
    rows = np.arange(len(values))[::-1]
    last = len(values) - 1
    for index, (row, value) in enumerate(zip(rows, values, strict=True)):
        colour = "white" if value < 0 else ACCENT if index == last else "#9fb4c4"
        axes.barh(
            row, value, 0.62, edgecolor=INK, linewidth=0.6, facecolor=colour, hatch="/////" if value < 0 else None
        )
        text = displayed(group["bars"][index]["value"], shown, words["decimal"])
        axes.annotate(text, (max(value, 0), row), (3, 0), textcoords="offset points", va="center_baseline", size=8)
    _across(axes, width, values, limits_of(group, shown), words)
    axes.set_yticks(rows, [plain(bar["label"]) for bar in group["bars"]], va="center_baseline")
    axes.set_ylim(-0.6, len(values) - 0.4)
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.set_title(_title(group, shown), pad=5)
    axes.grid(visible=False)
    axes.tick_params(axis="y", length=0)
    for side in ("top", "right", "bottom", "left"):
        axes.spines[side].set_visible(False)


def _across(
    axes: Axes,
    width: float,
    values: Sequence[float],
    limits: tuple[float | None, float | None] | None,
    words: Catalogue,
) -> None:
    """Lay out the axis of the bars on a sheet of a width, with room for their numbers; where its range is declared its ends are named."""
    room = max(text_size(number(significant(value)))[0] for value in values) + 6
    points = axes.get_position().width * width
    own = min([0.0, *values]), max([0.0, *values])
    low, high = (each if end is None else end for each, end in zip(own, limits or (None, None), strict=True))
    margin = 0.0 if limits and limits[0] is not None else 0.02 * (max(map(abs, values)) or 1.0)
    axes.set_xlim(low - margin, high + room * (high - low) / max(points - room, 1))
    axes.tick_params(axis="x", bottom=limits is not None, labelbottom=limits is not None)
    if limits:
        axes.set_xticks([low, high], [number(number_text(end), words["decimal"]) for end in (low, high)])
