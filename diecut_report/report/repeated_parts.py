"""Quantities of repeated parts (``gears.0.driver_teeth``, ``shaft_3_speed``) gathered, to be printed with a line for each part."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

Data = Mapping[str, Any]
FEWEST = 3  # parts of results that make a table; fewer stay single lines
FEWEST_GIVEN = 2  # parts of a list of the inputs


@dataclass
class Parts:
    """A table: for each part (counted as in print) its quantities by their ids in the results; a ``listed`` family is a list."""

    family: str
    numbers: list[int]
    listed: bool = True
    columns: dict[str, dict[int, tuple[str, Data]]] = field(default_factory=dict)

    @property
    def heads(self) -> Iterator[tuple[str, Data]]:
        """Each column's quantity, and a row of the results that says what it is."""
        return ((quantity, next(iter(rows.values()))[1]) for quantity, rows in self.columns.items())

    def without(self, quantities: Collection[str]) -> Parts:
        """The table without some of its quantities."""
        left = {quantity: rows for quantity, rows in self.columns.items() if quantity not in quantities}
        return Parts(self.family, self.numbers, self.listed, left)

    def add(self, name: str, row: Data) -> None:
        """Put a row of the results into its place."""
        number = number_of(row)
        quantity = row["part"].get("quantity", row["part"]["family"])
        self.columns.setdefault(quantity, {})[number] = (name, row)
        self.numbers = sorted({*self.numbers, number})


def number_of(row: Data) -> int:
    """Return the number of a row's part in print: the one in its name, or of a list counted from 1."""
    part = row["part"]
    return int(part.get("number", part["index"] + 1))


def gathered(rows: Data, fewest: int = FEWEST) -> tuple[dict[str, Data], list[Parts]]:
    """Return the lone quantities, and tables of those of at least so many repeated parts, of a single quantity of at least three."""
    tables = [table for table in _tables(rows) if len(table.numbers) >= (fewest if len(table.columns) > 1 else FEWEST)]
    told = {name for table in tables for column in table.columns.values() for name, _ in column.values()}
    return {name: row for name, row in rows.items() if name not in told}, tables


def _tables(rows: Data) -> list[Parts]:
    """Return the quantities of each family in one table."""
    tables: dict[tuple[str, bool], Parts] = {}
    for name, row in rows.items():
        if "part" not in row:
            continue
        family, listed = row["part"]["family"], "number" not in row["part"]
        is_alone = listed and "quantity" not in row["part"]  # a path of its own, not in a list that could be named
        table = tables.setdefault((family, listed), Parts("" if is_alone else family, [], listed))
        table.add(name, row)
    return list(tables.values())


def counted(rows: Data) -> dict[str, int]:
    """Return the numbers of the parts, as in print, of all quantities that share their description with another one."""
    said = Counter(row["description"] for row in rows.values())
    return {name: number_of(row) for name, row in rows.items() if "part" in row and said[row["description"]] > 1}
