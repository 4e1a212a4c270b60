"""Quantities of like parts (``gears.0.driver_teeth``, ``shaft_3_speed``) gathered, to be printed with a line for each part."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

Data = Mapping[str, Any]
FEWEST = 3  # parts that make a table; fewer stay single lines
_LISTED = re.compile(r"(?P<family>.+?)\.(?P<number>\d+)(?:\.(?P<quantity>.+))?")
_NUMBERED = re.compile(r"(?P<family>.*?)_(?P<number>\d+)(?:_(?P<quantity>.+))?")


class PartPlace(NamedTuple):
    """What an id says: the list or the kind of part, which part, which quantity of it, and how its parts are counted."""

    family: str
    number: int
    quantity: str
    first: int  # 0: the results count the list's parts from 0


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


def place(name: str) -> PartPlace | None:
    """Where a quantity stands among like parts; None for a lone one."""
    listed = _LISTED.fullmatch(name)
    found = listed or _NUMBERED.fullmatch(name)
    if found is None:
        return None
    return PartPlace(found["family"], int(found["number"]), found["quantity"] or "", 0 if listed else 1)


def gathered(rows: Data) -> tuple[dict[str, Data], list[Parts]]:
    """The lone quantities, and tables of those of at least three like parts."""
    columns: dict[tuple[str, str, int], dict[int, str]] = {}
    for name in rows:
        found = place(name)
        if found:
            columns.setdefault((found.family, found.quantity, found.first), {})[found.number] = name
    columns = {key: names for key, names in columns.items() if _alike([rows[name] for name in names.values()])}
    tables = [table for table in _tables(columns, rows) if len(table.numbers) >= FEWEST]
    told = {name for table in tables for column in table.columns.values() for name, _ in column.values()}
    return {name: row for name, row in rows.items() if name not in told}, tables


def _alike(rows: list[Data]) -> bool:
    """Whether rows say the same quantity of several parts."""
    return len({(row["description"], row["symbol"], row["display"]["unit"]) for row in rows}) == 1


def _tables(columns: dict[tuple[str, str, int], dict[int, str]], rows: Data) -> Iterator[Parts]:
    """Columns of one family in one table; rows of numbers without one (``wraps.0``) beside their neighbours of equal length."""
    tables: dict[tuple[Any, ...], Parts] = {}
    for (family, quantity, first), names in columns.items():
        lone = first == 0 and not quantity
        home = rows[next(iter(names.values()))].get("list", "") if lone else family
        table = tables.setdefault((home, tuple(names) if lone else first), Parts(home, [], listed=first == 0))
        table.numbers = sorted({*table.numbers, *(number + 1 - first for number in names)})
        column = family if lone else quantity
        table.columns[column] = {number + 1 - first: (name, rows[name]) for number, name in names.items()}
    yield from tables.values()


def counted(rows: Data) -> dict[str, int]:
    """The numbers of the parts, counted from 1, of all quantities that share their description with another one."""
    said = Counter(row["description"] for row in rows.values())
    places = {name: place(name) for name, row in rows.items() if said[row["description"]] > 1}
    return {name: found.number + 1 - found.first for name, found in places.items() if found}
