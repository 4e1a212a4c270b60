"""Figures of rolling bearings."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chart, Shape, View, chart_panel, level, line
from diecut_report.plugins.rolling_bearing.bearings import Bearings

POINTS = 361


def loads_over_cycle(view: View) -> list[Shape]:
    """The equivalent load of each bearing over the cycle, with its mean and greatest value."""
    known: Bearings = view.prepared("all_bearings")
    share = (np.arange(POINTS - 1) + 0.5)[None, :] / (POINTS - 1)
    panels: list[Shape] = []
    for index, name in enumerate(known.names):
        load = known.load(index, share, share, None)[0]
        mean, most = view.row("equivalent_load")[index], view.row("equivalent_load_max")[index]
        levels = [level(most, "greatest"), *([level(mean, "equivalent")] if np.isfinite(mean) else [])]
        panels.append(
            chart_panel(f"Load of {name}", "kN", "Angle of the cycle", "φ", "deg",
                        lines=[line(2 * np.pi * share[0], load, "equivalent load")], levels=levels, range=(0, None))
        )  # fmt: skip
    return panels


FIGURES = (
    Chart(
        id="loads",
        title="Equivalent load over the cycle",
        caption="Of each bearing, with its greatest value and the equivalent load of the life.",
        build=loads_over_cycle,
    ),
)
