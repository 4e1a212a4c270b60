"""A tornado: what each input does to a number, lowered and raised, as bars beside today's value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from diecut_report.quantities.formatting import number_text
from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.sizes import Size
from diecut_report.report.figures.style import ACCENT, INK, Svg, canvas, drawn, text_size
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import number

ROW, HEAD, FOOT = 17.0, 14.0, 24.0  # points
LOWERED = "#b06a2c"


def tornado(today: float, bars: Sequence[Mapping[str, Any]], told: str, key: str, decimal: str) -> Svg:
    """Return the bars (``label``, ``low``, ``high`` with the input lowered and raised, None without a machine) about today's value."""
    return drawn(partial(_tornado, today, bars, decimal), told, key)


def tornado_of(figure: Mapping[str, Any], _curves: Any, words: Catalogue, size: Size = Size.LARGE) -> Figure:
    """Draw a figure of a report's chapter on influence."""
    return _tornado(figure["today"], figure["bars"], words["decimal"])


def _tornado(today: float, bars: Sequence[Mapping[str, Any]], decimal: str) -> Figure:
    height = HEAD + FOOT + ROW * len(bars)
    sheet = canvas(WIDTH, height)
    names = max(text_size(str(bar["label"]))[0] for bar in bars) + 10
    axes = sheet.add_axes((names / WIDTH, FOOT / height, (WIDTH - names - 12) / WIDTH, ROW * len(bars) / height))
    places = np.arange(len(bars))[::-1]
    for place, bar in zip(places, bars, strict=True):
        for side, colour in (("low", LOWERED), ("high", ACCENT)):
            if bar[side] is not None:
                axes.barh(place, bar[side] - today, 0.62, left=today, color=colour, alpha=0.85)
            else:
                axes.plot(today, place, "x", color=colour)
    axes.set_yticks(places, [str(bar["label"]) for bar in bars], va="center_baseline")
    axes.xaxis.set_major_formatter(lambda value, _: number(number_text(value), decimal))
    axes.set_ylim(-0.6, len(bars) - 0.4)
    axes.axvline(today, color=INK, linewidth=0.8)
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    axes.set_axisbelow(True)
    return sheet
