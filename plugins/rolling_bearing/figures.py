"""Figures of rolling bearings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from diecut_report.api import Cell, Chart, ListedColumn, Phrase, Shape, View, chart_panel, level, line, mark
from diecut_report.plugins.rolling_bearing.bearings import Bearings

CHOICE = (
    ListedColumn("name", "Bearing"), ListedColumn("designation", "Designation"), ListedColumn("taken", "taken"),
    ListedColumn("bore", "Bore", "d", "mm"), ListedColumn("outside", "Outside diameter", "D", "mm"), ListedColumn("width", "Width", "B", "mm"),
    ListedColumn("dynamic", "Dynamic load rating", "C", "kN"), ListedColumn("static", "Static load rating", "C_0", "kN"),
)  # fmt: skip

SHOWN = ("d", "D", "B", "C", "C0")


def neighbours(given: Mapping[str, Any]) -> Iterator[tuple[Cell, ...]]:
    """Yield each bearing of the table that is taken, between the next smaller and the next larger one of its series."""
    known: Bearings = given["all_bearings"]
    for name, taken in zip(known.names, known.taken, strict=True):
        if taken.catalogue is not None:
            own = taken.designations[0]
            for each in taken.catalogue.beside(own):
                yield name, each, "yes" if each == own else "no", *(taken.catalogue.size(key, each) for key in SHOWN)


POINTS = 361


def loads_over_cycle(view: View) -> list[Shape]:
    """The equivalent load of each bearing over the cycle, with its mean and greatest value."""
    known: Bearings = view.prepared("all_bearings")
    share = (np.arange(POINTS - 1) + 0.5)[None, :] / (POINTS - 1)
    panels: list[Shape] = []
    for index, name in enumerate(known.names):
        load = known.load(index, share, share, None)[0]
        mean, most = view.row("equivalent_load")[index], view.row("equivalent_load_max")[index]
        levels = [level(most, "maximum"), *([level(mean, "equivalent")] if np.isfinite(mean) else [])]
        panels.append(chart_panel(Phrase("Load of {name}", name=name), "kN", "Cycle angle", "φ", "deg",
                lines=[line(2 * np.pi * share[0], load, "equivalent load")], levels=levels, range=(0, None)))  # fmt: skip
    return panels


def lives(view: View) -> list[Shape]:
    """The life of each bearing against the required one, in powers of ten."""
    names, found = view.words("bearings.name"), np.array(view.row("life_modified"))
    decades = np.log10(found / view["required_life"])
    known = [
        (index + 1.0, height, name)
        for index, (height, name) in enumerate(zip(decades, names, strict=True))
        if np.isfinite(height)
    ]
    if not known:
        return []
    stems = np.array([end for place, height, _ in known for end in ((place, 0.0), (place, height), (place, np.nan))])
    return [
        chart_panel(
            "Ratio of life to the required one, as a power of ten", "1", "Number of the bearing", "", "1",
            lines=[
                line(stems[:, 0], stems[:, 1], "modified rating life"),
                line([0.5, len(names) + 0.5], [0, 0], "required life"),
            ],
            marks=[mark(place, height, name) for place, height, name in known],
        )
    ]  # fmt: skip


FIGURES = (
    Chart(
        "loads",
        "Equivalent load over the cycle",
        "Values of each bearing, with the maximum and the equivalent load of the life.",
        build=loads_over_cycle,
    ),
    Chart(
        "lives",
        "Life compared with the required life",
        "Logarithmic: 0 is the required life, 1 ten times that. A bearing that stands has no life.",
        build=lives,
    ),
)
