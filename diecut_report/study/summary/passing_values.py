"""Which values pass: the share of the variants that do not fail, by value or class of each varied input."""

from __future__ import annotations

from typing import Any, NamedTuple

from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.summary.data import SOUND
from diecut_report.study.summary.quantity_names import display, value_told

CLASSES, FEW, MOST = 5, 8, 12  # of a range; values that stand one by one, of numbers and of words
INPUTS = 12


class PassingValue(NamedTuple):
    """Hold a value or class of an input: how many variants have it, and how many of them do not fail."""

    told: str
    variants: int
    passing: int


class PassingValues(NamedTuple):
    """Hold an input with its values or classes, and how many values are left out."""

    column: StoredColumn
    rows: list[PassingValue]
    more: int = 0

    @property
    def reach(self) -> float:
        """Return how far the shares of its values lie apart."""
        shares = [row.passing / row.variants for row in self.rows if row.variants]
        return max(shares) - min(shares)


def values(stored: Stored) -> list[PassingValues]:
    """Return the varied inputs that have more than one value, in the study's order; of many those whose values differ most."""
    found = [each for column in stored.varied for each in [_values(stored, column)] if len(each.rows) > 1]
    kept = sorted(found, key=lambda each: -each.reach)[:INPUTS]
    return [each for each in found if each in kept]


def _values(stored: Stored, column: StoredColumn) -> PassingValues:
    if not column.is_number:
        return _words(stored, column)
    low, high, count = stored.rows(f"SELECT min({column.sql}), max({column.sql}), count(DISTINCT {column.sql}) FROM v")[
        0
    ]
    if count < 2:
        return PassingValues(column, [])
    return _one_by_one(stored, column) if count <= FEW else _classes(stored, column, float(low), float(high))


def _counted(stored: Stored, column: StoredColumn, by: str, order: str) -> list[tuple[Any, int, int]]:
    return stored.rows(
        f"SELECT {by} AS place, count(*) AS n, count(*) FILTER ({SOUND}) AS good FROM v WHERE {column.sql} IS NOT NULL "
        f"GROUP BY place ORDER BY {order}"
    )


def _words(stored: Stored, column: StoredColumn) -> PassingValues:
    rows = _counted(stored, column, column.sql, "good / n DESC, n DESC, place")
    told = [PassingValue(value_told(value), count, good) for value, count, good in rows]
    return PassingValues(column, told[:MOST], max(0, len(told) - MOST))


def _one_by_one(stored: Stored, column: StoredColumn) -> PassingValues:
    rows = _counted(stored, column, column.sql, "place")
    return PassingValues(
        column, [PassingValue(display(float(value), column), count, good) for value, count, good in rows]
    )


def _classes(stored: Stored, column: StoredColumn, low: float, high: float) -> PassingValues:
    """Classes of equal width; a value at a limit belongs to the class above it."""
    wide = (high - low) / CLASSES
    at = f"CAST(least(floor(({column.sql} - {low!r}) / {wide!r}), {CLASSES - 1}) AS BIGINT)"
    known = {int(place): (count, good) for place, count, good in _counted(stored, column, at, "place")}
    edges = [display(low + wide * index, column) for index in range(CLASSES + 1)]
    told = [f"{edges[index]} … {edges[index + 1]}" for index in range(CLASSES)]
    return PassingValues(column, [PassingValue(told[index], *known.get(index, (0, 0))) for index in range(CLASSES)])
