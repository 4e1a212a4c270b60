"""The table of the bearings that are taken out of the table, with their neighbours."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.api import Cell, ListedColumn
from diecut_report.plugins.rolling_bearing.bearings import Bearings

CHOICE = (
    ListedColumn("name", "Bearing"), ListedColumn("designation", "Designation"), ListedColumn("taken", "taken"), ListedColumn("bore", "Bore", "d",
    "mm"),
    ListedColumn("outside", "Outside diameter", "D", "mm"), ListedColumn("width", "Width", "B", "mm"), ListedColumn("dynamic", "Dynamic load rating",
                                                                                                                    "C", "kN"),
    ListedColumn("static", "Static load rating", "C_0", "kN"),
)  # fmt: skip

SHOWN = ("d", "D", "B", "C", "C0")


def choice(given: Mapping[str, Any]) -> Iterator[tuple[Cell, ...]]:
    """Yield each bearing of the table that is taken, between the next smaller and the next larger one of its series."""
    known: Bearings = given["all_bearings"]
    for name, taken in zip(known.names, known.taken, strict=True):
        if taken.catalogue is not None:
            own = taken.designations[0]
            for each in taken.catalogue.beside(own):
                yield name, each, "yes" if each == own else "no", *(taken.catalogue.size(key, each) for key in SHOWN)
