"""The bearings of the tables: ratings by designation, and the series, in which each next bearing is larger."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property

from diecut_report.api import StandardTable, si, standard_table

BORE = 2  # digits of a designation that tell the bore


@dataclass(frozen=True)
class BearingTable:
    """Hold the bearings of one kind: their table, what follows the bore in a designation, and the series that is usual."""

    table: StandardTable
    suffix: str
    usual: str

    @cached_property
    def sizes(self) -> dict[str, dict[str, float]]:
        """Return each column by its name: SI values by designation."""
        return {
            column.name: dict(zip(self.table.names, (si(value, column.unit) for value in column.values), strict=True))
            for column in self.table.columns
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Return all designations, those of a series in ascending size."""
        return self.table.names

    def size(self, column: str, name: str) -> float:
        """Return a value of a bearing in SI; 0 of a column that bearings of this kind do not have."""
        return self.sizes[column][name] if column in self.sizes else 0.0

    def series_of(self, name: str) -> str:
        """Return the series of a bearing, such as 62 of 6209."""
        return name.removesuffix(self.suffix)[:-BORE]

    @property
    def series(self) -> tuple[str, ...]:
        """Return all series."""
        return tuple(dict.fromkeys(map(self.series_of, self.names)))

    def of_series(self, series: str) -> tuple[str, ...]:
        """Return the bearings of a series, the smallest first."""
        return tuple(name for name in self.names if self.series_of(name) == series)

    def beside(self, name: str) -> tuple[str, ...]:
        """Return a bearing between the next smaller and the next larger one of its series."""
        own = self.of_series(self.series_of(name))
        place = own.index(name)
        return own[max(place - 1, 0) : place + 2]


DEEP_GROOVE, ROLLER = "deep_groove", "roller"
CATALOGUES = {
    DEEP_GROOVE: BearingTable(standard_table("ball_bearings"), "", "62"),
    ROLLER: BearingTable(standard_table("roller_bearings"), "E", "NU2"),
}


def written(designation: str) -> str:
    """Return a designation as the tables write it, without blanks."""
    return "".join(designation.split()).upper()


SMALL_BORES = {"00": 10, "01": 12, "02": 15, "03": 17}  # mm; from 04 on the number is a fifth of the bore (ISO 15)
CODED = re.compile(
    "(6[0-4]|7[0-4]|16[01]|1[23]|2[23]|2[123][0-4]|(?:NU|NJ|NUP|N)(?:10|2|3|4|22|23))([0-9]{2})(?![0-9])"
)  # up to the diameter series, and the bore


def row_of(kind: str, designation: str | None) -> str | None:
    """Return the row of the tables with which a bearing is compared: its own, or that of the reinforced design; None where there is none."""
    known, name = CATALOGUES.get(kind), written(designation or "")
    return next((each for each in (name, name + known.suffix) if each in known.names), None) if known else None


def bore_of(designation: str | None) -> float:
    """Return the bore that a designation tells, m; 0 where it tells none."""
    found = CODED.match(written(designation or ""))
    return si(SMALL_BORES.get(found[2], 5 * int(found[2])), "mm") if found else 0.0


def outside_of(designation: str | None) -> float:
    """Return the outside diameter that a designation tells by its diameter series, m; 0 where it tells none.

    A bearing of any type has that of the deep groove ball bearing of the same diameter series and bore (ISO 15).
    """
    found, table = CODED.match(written(designation or "")), CATALOGUES[DEEP_GROOVE]
    name = f"6{found[1][-1]}{found[2]}" if found else ""
    return table.size("D", name) if name in table.names else 0.0
