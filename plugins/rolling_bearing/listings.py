"""The table of the bearings that are taken out of the table, with their neighbours."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.api import Cell, ListedColumn
from diecut_report.plugins.rolling_bearing.bearings import CATALOGUE, SIZES, Bearings

CHOICE = (
    ListedColumn("name", "Bearing"), ListedColumn("designation", "Designation"), ListedColumn("taken", "taken"), ListedColumn("bore", "Bore", "d", "mm"),
    ListedColumn("outside", "Outside", "D", "mm"), ListedColumn("width", "Width", "B", "mm"), ListedColumn("dynamic", "Dynamic rating", "C", "kN"),
    ListedColumn("static", "Static rating", "C_0", "kN"),
)  # fmt: skip


def choice(given: Mapping[str, Any]) -> Iterator[tuple[Cell, ...]]:
    """Yield each bearing of the table that is taken, between the next smaller and the next larger one of its series."""
    known: Bearings = given["all_bearings"]
    for index, (name, designations) in enumerate(zip(known.names, known.designations, strict=True)):
        taken = designations[0]
        if known.is_of_table(index):
            place = CATALOGUE.names.index(taken)
            beside = (each for each in CATALOGUE.names[max(place - 1, 0) : place + 2] if each[:2] == taken[:2])
            yield from ((name, each, "yes" if each == taken else "no", *(SIZES[key][each] for key in ("d", "D", "B", "C", "C0"))) for each in beside)
