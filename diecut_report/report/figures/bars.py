"""Horizontal bars of quantities, in groups."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diecut_report.quantities.units import pretty, unit
from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.style import ACCENT, INK, canvas, plain, text_size
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import number, significant

Data = Mapping[str, Any]


def bars(figure: Data, _curves: Data, words: Catalogue) -> Figure:
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


def _group(axes: Axes, group: Data, shown: str, words: Catalogue) -> None:
    values = [bar["value"] / unit(shown).factor for bar in group["bars"]]
    reach = max(map(abs, values)) or 1.0
    points = axes.get_position().width * WIDTH
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
