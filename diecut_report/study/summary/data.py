"""What the stored variants say as a whole: counts, failures, utilisations, ranges. DuckDB counts; Python sees sums and samples."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.config.plugins import Discovery
from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.figures.style import plain, text_size
from diecut_report.report.text import joined, number
from diecut_report.study.analysis.answers import told_reason
from diecut_report.study.analysis.variants import STATUSES, UTILISATION, Stored, StoredColumn, text
from diecut_report.text.phrases import phrase, worded
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted

# How the summary calls quantities and prints their sizes.


DIGITS = 4
WORST = StoredColumn(
    "greatest utilisation", "float", title=phrase("Utilisation of the check that governs (where it has one)")
)
WORDS = {"pass": phrase("pass"), "warn": phrase("warning"), "fail": phrase("fail"), "error": phrase("error")}


def named(column: StoredColumn) -> str:
    """Return a quantity as people call it: ``Radius of the bore (cylinder)``."""
    return said(column.told)


def titled(column: StoredColumn) -> str:
    """Return a quantity with the unit that people read."""
    sign = pretty(column.display)
    return named(column) + (f", {sign}" if sign else "")


def wrapped(words: str, wide: float, size: float, most: int) -> str:
    """Return a name for matplotlib on lines of a width, broken at its spaces; a word that is too long behind dots and underscores.

    Of what does not fit on so many lines the last line stays, with the mechanism and the unit.
    """
    lines = [""]
    for part in _pieces(words, wide, size):
        if lines[-1] and text_size(plain((lines[-1] + part).rstrip()), size)[0] > wide:
            lines.append("")
        lines[-1] += part
    if len(lines) > most:
        kept = [line.rstrip() for line in lines[: most - 1]]
        lines = [*kept, _shortened(" ".join(line.strip() for line in lines[most - 1 :]), wide, size)]
    return plain("\n".join(line.rstrip() for line in lines))


def _pieces(words: str, wide: float, size: float) -> Iterator[str]:
    for word in re.findall(r"[^ ]+ ?| ", words):
        fits = text_size(plain(word), size)[0] <= wide
        yield from [word] if fits else re.findall(r"[^._]*[._]|[^._]+", word)


def _shortened(words: str, wide: float, size: float) -> str:
    """As much of the beginning of a name as fits on a line before its end in brackets."""
    head, bracket, tail = words.rpartition(" (")
    head, tail = (head, f"… ({tail}") if bracket else (words, "…")
    while head and text_size(plain(head.rstrip() + tail), size)[0] > wide:
        head = head[:-1]
    return head.rstrip() + tail


def factor(column: StoredColumn) -> float:
    """Return display units in an SI unit."""
    return 1.0 / unit(column.display).factor


def display(value: float, column: StoredColumn) -> str:
    """Return an SI value in the unit that people read, without the unit."""
    if not math.isfinite(value):
        return "–"
    if is_utilisation(column):
        return utilised(value)
    return number(number_text(unit(column.display).from_si(value), DIGITS), decimal_sign()) if value else "0"


def quantity(value: float, column: StoredColumn) -> str:
    """Return an SI value with the unit that people read."""
    return joined(display(value, column), pretty(column.display))


def value_told(value: Any) -> str:
    """Return a value that is not a number: the words of a choice, yes or no."""
    if isinstance(value, str):
        return said(worded(value))
    return say("yes") if value else say("no")


def is_utilisation(column: StoredColumn) -> bool:
    """Return whether 1 is the limit of a quantity."""
    return column.name == WORST.name or (".checks." in column.name and column.name.endswith(UTILISATION))


def utilised(value: float) -> str:
    """Return a utilisation; one that is next to 1 shows on which side it is, and a small one that is not none does not print as 0."""
    text = f"{value:.2f}"
    if text == "1.00" and value != 1:
        near = f"{value:.4f}"
        return localised(near) if near != "1.0000" else "< 1" if value < 1 else "> 1"
    if value >= 99.995:
        return number(f"{value:.3g}" if value >= 1e6 else f"{value:.0f}", decimal_sign())
    return localised("< 0.01" if text == "0.00" and value > 0 else text)


def variants(count: int) -> str:
    """Return how many variants."""
    return say_counted(count, "{n} variant", "{n} variants", n=number(str(count)))


def percent(part: float, whole: float) -> str:
    """Return a share; a small one that is not none does not print as 0."""
    share = 100.0 * part / whole if whole else 0.0
    text = "< 0.1 %" if 0 < share < 0.1 else f"{share:.3g} %" if share < 99.95 or part == whole else "> 99.9 %"
    return localised(text)


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


# Which values pass: the share of the variants that do not fail, by value or class of each varied input.


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
        return _passing_values_words(stored, column)
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


def _passing_values_words(stored: Stored, column: StoredColumn) -> PassingValues:
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


# What fails and what holds: in how many variants each check fails, governs, or is the only one; what governs those that pass.


SAME = 1e-6  # relative difference up to which two margins are shared


class Failure(NamedTuple):
    """Hold a check: in how many variants it fails, governs the failure, is the only failing one, and has a warning."""

    check: str
    failing: int
    governing: int
    only: int
    warning: int


class Governing(NamedTuple):
    """Hold a check that governs variants which pass: how many, their least and greatest utilisation, and whether its own one varies at all."""

    check: str
    variants: int
    least: float | None
    greatest: float | None
    varies: bool = True


class Margin(NamedTuple):
    """Hold least utilisation of all that pass: a variant, its governing check, and how many variants share it."""

    variant: int
    utilisation: float
    check: str
    shared: int


def failures(stored: Stored, used: Sequence[Utilisation]) -> list[Failure]:
    """Return the checks that fail or warn in any variant, those with the most failures first."""
    sql = "SELECT governing, count(*) FROM v WHERE status = 'fail' AND governing IS NOT NULL GROUP BY governing"
    governed = dict(stored.rows(sql))
    rows = [row for row in used if row.failing or row.warning]
    alone = _alone(stored, [row.check for row in rows])
    found = [Failure(row.check, row.failing, governed.get(row.check, 0), alone[row.check], row.warning) for row in rows]
    return sorted(found, key=lambda row: (-row.failing, -row.governing, -row.warning, row.check))


def _alone(stored: Stored, checks: list[str]) -> dict[str, int]:
    """In how many variants each check is the only one that fails."""
    found: dict[str, int] = {}
    for part in chunks(checks):
        asked = (f"count(*) FILTER ({stored.checks[check][1].sql} = 'fail')" for check in part)
        row = stored.rows(f"SELECT {', '.join(asked)} FROM w WHERE {FAILING} = 1")[0]
        found |= dict(zip(part, row, strict=True))
    return found


def unchecked(stored: Stored) -> list[str]:
    """Return the checks that are not made in some variant, as a limit or another key is not given."""
    found: list[str] = []
    for part in chunks(list(stored.checks)):
        asked = (f"count(*) FILTER ({stored.checks[check][1].sql} = 'not_checked')" for check in part)
        row = stored.rows(f"SELECT {', '.join(asked)} FROM v")[0]
        found += [check for check, count in zip(part, row, strict=True) if count]
    return found


def governing(stored: Stored, still: Collection[str] = ()) -> list[Governing]:
    """Return what governs the variants that pass, the most frequent first; checks whose utilisation stands ``still`` come last."""
    sql = (
        f"SELECT governing, count(*) AS n, min({WORST.sql}), max({WORST.sql}) FROM w "
        f"WHERE {SOUND} AND governing IS NOT NULL GROUP BY governing ORDER BY n DESC, governing"
    )
    found = [Governing(*row)._replace(varies=row[0] not in still) for row in stored.rows(sql)]
    return sorted(found, key=lambda row: not row.varies)


def margin(stored: Stored) -> Margin | None:
    """Return which of the variants that do not fail keeps most from its limits, and how many keep as much."""
    there = f"FROM w WHERE {SOUND} AND {WORST.sql} IS NOT NULL"
    least = stored.rows(f"SELECT min({WORST.sql}) {there}")[0][0]
    if least is None:
        return None
    alike = f"{there} AND {WORST.sql} <= {least * (1 + SAME)!r}"
    one, check, shared = stored.rows(f"SELECT min(variant), arg_min(governing, variant), count(*) {alike}")[0]
    return Margin(one, least, check, shared)
