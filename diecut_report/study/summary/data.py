"""What the stored variants say as a whole: counts, failures, utilisations, ranges. DuckDB counts; Python sees sums and samples."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.config.discovery import Discovery
from diecut_report.languages.speech import say
from diecut_report.study.analysis.stored_variants import STATUSES, Stored, StoredColumn, text
from diecut_report.study.analysis.told_reasons import told_reason
from diecut_report.study.summary.quantity_names import WORST, is_utilisation

Array = NDArray[Any]
FAILING = '"failing checks"'  # SQL: how many checks of a variant fail
SOUND = "status IN ('pass', 'warn')"  # SQL: no check fails
BANDS = (0.5, 0.8, 1.0, 1.25)  # limits between the classes of utilisation
BINS, FEWEST = 24, 6  # classes of a histogram
CELLS = (52, 34)  # across and upwards, in a chart of where variants lie
AT_ONCE, EXACT = 16, 100_000  # columns in a query; rows up to which the median is exact
REASONS = 15


class Utilisation(NamedTuple):
    """Hold a check over all variants: how many in each class of utilisation, without one, its statuses, and its greatest value."""

    check: str
    bands: tuple[int, ...]
    without: int
    passing: int
    warning: int
    failing: int
    greatest: float | None

    @property
    def is_made(self) -> bool:
        """Return whether any variant has this check."""
        return self.passing + self.warning + self.failing > 0


class Spread(NamedTuple):
    """Hold the range of a quantity in SI: least, 5 %, median, 95 %, greatest, and how many variants have it."""

    column: StoredColumn
    values: tuple[float, float, float, float, float]
    present: int

    @property
    def varies(self) -> bool:
        """Return whether its values differ by more than rounding."""
        least, greatest = self.values[0], self.values[-1]
        return greatest - least > 1e-9 * max(abs(least), abs(greatest))


class Histogram(NamedTuple):
    """Hold how many variants of each status (rows) lie in each class (columns) between the edges (SI).

    ``is_open`` says that the last class holds all greater values too.
    """

    column: StoredColumn
    edges: Array
    counts: Array
    is_open: bool


class Density(NamedTuple):
    """Hold how many variants lie in each cell over two quantities, and how many of them do not fail: shape (cells of y, cells of x)."""

    x: StoredColumn
    y: StoredColumn
    x_edges: Array
    y_edges: Array
    counts: Array
    sound: Array


class Reason(NamedTuple):
    """Hold why variants could not be calculated, how many, and one of them."""

    told: str
    variants: int
    example: int


@dataclass(frozen=True)
class SampledVariants:
    """Hold some variants with some quantities (SI, NaN where absent; words as their number in ``words``)."""

    variants: Array
    status: Array
    values: dict[str, Array]
    words: dict[str, list[str]]


def prepare(stored: Stored) -> None:
    """Name ``w``: the variants with the utilisation of the check that governs each, none where that has none.

    And with the number of checks that fail.
    """
    own = " ".join(f"WHEN {text(check)} THEN {value.sql}" for check, (value, _) in stored.checks.items())
    worst = f"CASE governing {own} END" if own else "NULL"
    lost = (f"CASE WHEN {status.sql} = 'fail' THEN 1 ELSE 0 END" for _, status in stored.checks.values())
    failing = " + ".join(lost) or "0"
    stored.connection.execute(
        f"CREATE VIEW w AS SELECT *, CAST({worst} AS DOUBLE) AS {WORST.sql}, {failing} AS {FAILING} FROM v"
    )


def statuses(stored: Stored) -> dict[str, int]:
    """Return how many variants have each status."""
    found = dict(stored.rows("SELECT status, count(*) FROM v GROUP BY status"))
    return {status: int(found.get(status, 0)) for status in STATUSES}


def utilisations(stored: Stored) -> list[Utilisation]:
    """Return each check over all variants, those with the most failures first."""
    found = [part for names in chunks(list(stored.checks)) for part in _utilisations(stored, names)]
    return sorted(found, key=lambda row: (-row.failing, -row.warning, -(row.greatest or 0.0), row.check))


def _utilisations(stored: Stored, names: Sequence[str]) -> Iterator[Utilisation]:
    asked = [part for name in names for part in _asked(*stored.checks[name])]
    row = stored.rows(f"SELECT {', '.join(asked)} FROM v")[0]
    size = len(asked) // len(names)
    for index, name in enumerate(names):
        part = row[index * size : (index + 1) * size]
        yield Utilisation(name, tuple(part[:-5]), *part[-5:])


def _asked(value: StoredColumn, status: StoredColumn) -> Iterator[str]:
    edges = [None, *BANDS, None]
    for low, high in pairwise(edges):
        limits = ([f"{value.sql} > {low!r}"] if low else []) + ([f"{value.sql} <= {high!r}"] if high else [])
        yield f"count(*) FILTER ({' AND '.join(limits)})"
    yield f"count(*) FILTER ({value.sql} IS NULL AND {status.sql} IS NOT NULL)"
    for known in ("pass", "warn", "fail"):
        yield f"count(*) FILTER ({status.sql} = {text(known)})"
    yield f"max({value.sql})"


def chunks(items: list[Any]) -> Iterator[list[Any]]:
    """Yield as many columns at a time as a query asks for."""
    for start in range(0, len(items), AT_ONCE):
        yield items[start : start + AT_ONCE]


def spreads(stored: Stored, columns: Sequence[StoredColumn], total: int) -> dict[str, Spread]:
    """Return the range of each quantity; those that no variant has are left out."""
    quantile = "quantile_cont" if total <= EXACT else "approx_quantile"
    found = {}
    for part in chunks([column for column in columns if column.is_number]):
        asked = ", ".join(
            f"min({c.sql}), {quantile}({c.sql}, 0.05), {quantile}({c.sql}, 0.5), {quantile}({c.sql}, 0.95), max({c.sql}), count({c.sql})"
            for c in part
        )
        row = stored.rows(f"SELECT {asked} FROM w")[0]
        for index, column in enumerate(part):
            *values, count = row[6 * index : 6 * index + 6]
            if count:
                found[column.name] = Spread(column, tuple(map(float, values)), count)  # type: ignore[arg-type]  # five of them
    return found


def histogram(stored: Stored, spread: Spread) -> Histogram:
    """Return the distribution of a quantity, by status; of a utilisation no class lies on both sides of 1."""
    column, low, high = spread.column, spread.values[0], reach(spread.values[0], spread.values[3], spread.values[-1])
    bins = int(np.clip(2 * spread.present**0.5, FEWEST, BINS))
    is_open, at = high < spread.values[-1], ""
    if is_utilisation(column) and low < 1 < high:
        below = max(1, round((1 - low) / (high - low) * bins))
        wide = max((1 - low) / below, (high - 1) / max(1, bins - below))
        low, above = 1 - below * wide, math.ceil((high - 1) / wide)
        high, bins = 1 + above * wide, below + above
        place = _place(column, low, high, bins)
        at = f"CASE WHEN {column.sql} <= 1 THEN least({place}, {below - 1}) ELSE greatest({place}, {below}) END"
    edges = np.linspace(low, high, bins + 1)
    at = at or _place(column, low, high, bins)
    sql = f"SELECT status, {at} AS place, count(*) FROM w WHERE {column.sql} IS NOT NULL GROUP BY ALL"
    counts = np.zeros((len(STATUSES), bins), dtype=int)
    for status, index, count in stored.rows(sql):
        counts[STATUSES.index(status), index] += count
    return Histogram(column, edges, counts, is_open)


def density(stored: Stored, x: Spread, y: Spread) -> Density:
    """Return all variants over two quantities, counted in cells."""
    across, up = CELLS
    (left, right), (low, high) = ((each.values[0], reach(each.values[0], *each.values[3:])) for each in (x, y))
    places = f"{_place(x.column, left, right, across)} AS i, {_place(y.column, low, high, up)} AS j"
    there = f"{x.column.sql} IS NOT NULL AND {y.column.sql} IS NOT NULL"
    sql = f"SELECT {places}, count(*), count(*) FILTER ({SOUND}) FROM w WHERE {there} GROUP BY ALL"
    counts, sound = np.zeros((2, up, across), dtype=int)
    for i, j, all_, good in stored.rows(sql):
        counts[j, i], sound[j, i] = all_, good
    edges = np.linspace(left, right, across + 1), np.linspace(low, high, up + 1)
    return Density(x.column, y.column, *edges, counts, sound)


def reach(low: float, most: float, high: float) -> float:
    """Return up to where a chart shows a quantity: its greatest value, or a little over 95 % of them where a few lie far above."""
    return most + 0.25 * (most - low) if most > low and high - most > 2 * (most - low) else high


def _place(column: StoredColumn, low: float, high: float, cells: int) -> str:
    """SQL for the cell of a quantity, from 0; what lies outside counts in the outermost ones."""
    at = f"floor(({column.sql} - {low!r}) / {high - low!r} * {cells})"
    return f"CAST(greatest(0, least({at}, {cells - 1})) AS BIGINT)"


def reasons(stored: Stored, discovery: Discovery) -> list[Reason]:
    """Return why variants are in error, without the numbers that differ, the most frequent first, in the language that is spoken."""
    alike = r"regexp_replace(error, '[-+]?[0-9]+[.]?[0-9]*([eE][-+]?[0-9]+)?', '…', 'g')"
    sql = (
        f"SELECT arg_min(error, variant), count(*) AS n, min(variant) FROM v WHERE status = 'error' "
        f"GROUP BY {alike} ORDER BY n DESC, 3 LIMIT {REASONS}"
    )
    return [
        Reason(told_reason(stored, example, told, discovery) if told else say("no reason was given"), count, example)
        for told, count, example in stored.rows(sql)
    ]


def sample(stored: Stored, columns: Sequence[StoredColumn], most: int) -> SampledVariants:
    """Return so many variants drawn without regard to their values, the same ones each time, in the order of the sample."""
    words = {column.name: _words(stored, column) for column in columns if column.kind == "text"}
    asked = [_number(column, words) for column in columns]
    known = ", ".join(map(text, STATUSES))
    inside = f"variant IN (SELECT variant FROM v ORDER BY hash(variant), variant LIMIT {most})"
    sql = f"SELECT {', '.join(['variant', f'list_position([{known}], status) - 1', *asked])} FROM w WHERE {inside} ORDER BY variant"
    rows = np.array(stored.rows(sql), dtype=float).reshape(-1, len(columns) + 2)
    values = {column.name: rows[:, index + 2] for index, column in enumerate(columns)}
    return SampledVariants(rows[:, 0].astype(int), rows[:, 1].astype(int), values, words)


def _words(stored: Stored, column: StoredColumn) -> list[str]:
    return [
        row[0]
        for row in stored.rows(
            f"SELECT DISTINCT {column.sql} FROM v WHERE {column.sql} IS NOT NULL ORDER BY 1 LIMIT 50"
        )
    ]


def _number(column: StoredColumn, words: dict[str, list[str]]) -> str:
    """A quantity as a float: a text by its place among the words, yes as one."""
    if column.kind == "text":
        return f"CAST(list_position([{', '.join(map(text, words[column.name]))}], {column.sql}) - 1 AS DOUBLE)"
    return f"CAST({column.sql} AS DOUBLE)"


def number_of(stored: Stored, column: StoredColumn) -> str:
    """Return SQL that gives a column as a float, words by their number."""
    return _number(column, {column.name: _words(stored, column)} if column.kind == "text" else {})
