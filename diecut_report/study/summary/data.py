"""What the stored variants say as a whole: counts, failures, utilisations, ranges. DuckDB counts; Python sees sums and samples."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Sequence
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
from diecut_report.study.analysis.answers import reason_text
from diecut_report.study.analysis.variants import UTILISATION, Stored, StoredColumn, text
from diecut_report.study.storage.description import JUDGED, STATUSES
from diecut_report.text.phrases import phrase, worded
from diecut_report.text.translation import decimal_sign, localised, said, say, say_counted

# How the summary calls quantities and prints their sizes.


DIGITS = 4
WORST = StoredColumn("maximum utilisation", title=phrase("Utilisation of the governing check (where it has one)"))
WORDS = {"pass": phrase("pass"), "warn": phrase("warning"), "fail": phrase("fail"), "error": phrase("error")}


def named(column: StoredColumn) -> str:
    """Return a quantity as people call it: ``Radius of the bore (cylinder)``."""
    return said(column.label)


def titled(column: StoredColumn) -> str:
    """Return a quantity with the unit that people read."""
    return ", ".join(filter(None, [named(column), pretty(column.display)]))


def wrapped(words: str, wide: float, size: float, most: int) -> str:
    """Return a name for matplotlib on lines of a width, broken at its spaces; a word that is too long behind dots and underscores.

    Of what does not fit on so many lines the last line stays, with the mechanism and the unit.
    """

    def fits(line: str) -> bool:
        return text_size(plain(line.rstrip()), size)[0] <= wide

    lines = [""]
    for word in re.findall(r"[^ ]+ ?| ", words):
        for part in [word] if fits(word) else re.findall(r"[^._]*[._]|[^._]+", word):
            if lines[-1] and not fits(lines[-1] + part):
                lines.append("")
            lines[-1] += part
    if len(lines) > most:
        rest = " ".join(line.strip() for line in lines[most - 1 :])
        head, bracket, tail = rest.rpartition(" (")  # as much of the beginning as fits before the end in brackets
        head, tail = (head, f"… ({tail}") if bracket else (rest, "…")
        while head and not fits(head.rstrip() + tail):
            head = head[:-1]
        lines = [*lines[: most - 1], head.rstrip() + tail]
    return plain("\n".join(line.rstrip() for line in lines))


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


def value_text(value: Any) -> str:
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


def counted(one: str, many: str, count: int, **more: object) -> str:
    """Return what a template says of a number of things."""
    return say_counted(count, one, many, n=number(str(count)), **more)


def variants(count: int) -> str:
    return say_counted(count, "{n} variant", "{n} variants", n=number(str(count)))


def percent(part: float, whole: float) -> str:
    """Return a share; a small one that is not none does not print as 0."""
    share = 100.0 * part / whole if whole else 0.0
    text = "< 0.1 %" if 0 < share < 0.1 else f"{share:.3g} %" if share < 99.95 or part == whole else "> 99.9 %"
    return localised(text)


# --- all variants ----------------------------------------------------------------------------------------------------

Array = NDArray[Any]
FAILING = '"failing checks"'  # SQL: how many checks of a variant fail
SOUND = "status IN ('pass', 'warn')"  # SQL: no check fails
BANDS = (0.5, 0.8, 1.0, 1.25)  # limits between the classes of utilisation
MAX_BINS, MIN_BINS = 24, 6  # classes of a histogram
CELLS = (52, 34)  # across and upwards, in a chart of where variants lie
AT_ONCE, EXACT = 16, 100_000  # columns in a query; rows up to which the median is exact
MAX_REASONS = 15


class Spread(NamedTuple):
    """Hold the range of a quantity in SI: least, 5 %, median, 95 %, greatest, and how many variants have it."""

    column: StoredColumn
    values: tuple[float, ...]
    present: int

    @property
    def varies(self) -> bool:
        """Return whether its values differ by more than rounding."""
        least, greatest = self.values[0], self.values[-1]
        return greatest - least > 1e-9 * max(abs(least), abs(greatest))

    @property
    def reach(self) -> float:
        """Return up to where a chart shows it."""
        return reach(self.values[0], *self.values[3:])


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

    text: str
    variants: int
    example: int


@dataclass(frozen=True)
class SampledVariants:
    """Hold some variants with some quantities (SI, NaN where absent; words as their number in ``words``)."""

    variants: Array
    status: Array
    values: dict[str, Array]
    words: dict[str, list[str]]

    def thinned(self, most: int) -> SampledVariants:
        """Return every so many of them, as they are in no order of sizes."""
        step = max(1, -(-len(self.variants) // most))
        values = {name: column[::step] for name, column in self.values.items()}
        return SampledVariants(self.variants[::step], self.status[::step], values, self.words)


def prepare(stored: Stored) -> None:
    """Name ``w``: the variants with the utilisation of the check that governs each, none where that has none.

    And with the number of checks that fail.
    """
    own = " ".join(f"WHEN {text(check)} THEN {value.sql}" for check, (value, _) in stored.checks.items())
    worst = f"CASE governing {own} END" if own else "NULL"
    lost = (f"CASE WHEN {status.sql} = 'fail' THEN 1 ELSE 0 END" for _, status in stored.checks.values())
    failing = " + ".join(lost) or "0"
    asked = f"*, CAST({worst} AS DOUBLE) AS {WORST.sql}, {failing} AS {FAILING}"
    stored.connection.execute(f"CREATE VIEW w AS SELECT {asked} FROM v")


def statuses(stored: Stored) -> dict[str, int]:
    """Return how many variants have each status."""
    found = dict(stored.rows("SELECT status, count(*) FROM v GROUP BY status"))
    return {status: int(found.get(status, 0)) for status in STATUSES}


def proved(stored: Stored) -> int:
    """Return the verdict on how many variants is pass; none of results of before the three verdicts, which leave open what they rest on."""
    if JUDGED.name not in stored.columns:
        return 0
    return int(stored.rows("SELECT count(*) FROM v WHERE verdict = 'pass'")[0][0])


def _of_each(
    stored: Stored, items: Sequence[Any], asked: Callable[[Any], Sequence[str]], table: str
) -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """Yield each of many items with what a query over all variants gives for it, some items a query."""
    for start in range(0, len(items), AT_ONCE):
        part = [(item, asked(item)) for item in items[start : start + AT_ONCE]]
        row = stored.rows(f"SELECT {', '.join(each for _, terms in part for each in terms)} FROM {table}")[0]
        for item, terms in part:
            yield item, row[: len(terms)]
            row = row[len(terms) :]


def spreads(stored: Stored, columns: Sequence[StoredColumn], total: int) -> dict[str, Spread]:
    """Return the range of each quantity; those that no variant has are left out."""
    quantile = "quantile_cont" if total <= EXACT else "approx_quantile"

    def asked(column: StoredColumn) -> list[str]:
        name = column.sql
        middle = [f"{quantile}({name}, {share})" for share in (0.05, 0.5, 0.95)]
        return [f"min({name})", *middle, f"max({name})", f"count({name})"]

    each = _of_each(stored, [column for column in columns if column.is_number], asked, "w")
    return {column.name: Spread(column, tuple(map(float, values)), count) for column, (*values, count) in each if count}


def histogram(stored: Stored, spread: Spread) -> Histogram:
    """Return the distribution of a quantity, by status; of a utilisation no class lies on both sides of 1."""
    column, low, high = spread.column, spread.values[0], spread.reach
    bins = int(np.clip(2 * spread.present**0.5, MIN_BINS, MAX_BINS))
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
    places = f"{_place(x.column, x.values[0], x.reach, across)} AS i, {_place(y.column, y.values[0], y.reach, up)} AS j"
    there = f"{x.column.sql} IS NOT NULL AND {y.column.sql} IS NOT NULL"
    sql = f"SELECT {places}, count(*), count(*) FILTER ({SOUND}) FROM w WHERE {there} GROUP BY ALL"
    counts, sound = np.zeros((2, up, across), dtype=int)
    for i, j, all_, good in stored.rows(sql):
        counts[j, i], sound[j, i] = all_, good
    edges = np.linspace(x.values[0], x.reach, across + 1), np.linspace(y.values[0], y.reach, up + 1)
    return Density(x.column, y.column, *edges, counts, sound)


def reach(low: float, most: float, high: float) -> float:
    """Return up to where a chart shows a quantity: its greatest value, or a little over 95 % of them where a few lie far above."""
    return most + 0.25 * (most - low) if most > low and high - most > 2 * (most - low) else high


def _place(column: StoredColumn, low: float, high: float, cells: int) -> str:
    """Return SQL for the cell of a quantity, from 0; what lies outside counts in the outermost ones."""
    at = f"floor(({column.sql} - {low!r}) / {high - low!r} * {cells})"
    return f"CAST(greatest(0, least({at}, {cells - 1})) AS BIGINT)"


def reasons(stored: Stored, discovery: Discovery) -> list[Reason]:
    """Return why variants are in error, without the numbers that differ, the most frequent first, in the language that is spoken."""
    alike = r"regexp_replace(error, '[-+]?[0-9]+[.]?[0-9]*([eE][-+]?[0-9]+)?', '…', 'g')"
    sql = (
        f"SELECT arg_min(error, variant), count(*) AS n, min(variant) FROM v WHERE status = 'error' "
        f"GROUP BY {alike} ORDER BY n DESC, 3 LIMIT {MAX_REASONS}"
    )
    return [
        Reason(reason_text(stored, example, why, discovery) if why else say("no reason was given"), count, example)
        for why, count, example in stored.rows(sql)
    ]


def sample(stored: Stored, columns: Sequence[StoredColumn], most: int) -> SampledVariants:
    """Return so many variants drawn without regard to their values, the same ones each time, in the order of the sample."""
    words = {column.name: _words(stored, column) for column in columns if column.kind == "text"}
    known = ", ".join(map(text, STATUSES))
    asked = ["variant", f"list_position([{known}], status) - 1", *(_number(each, words) for each in columns)]
    inside = f"variant IN (SELECT variant FROM v ORDER BY hash(variant), variant LIMIT {most})"
    found = stored.rows(f"SELECT {', '.join(asked)} FROM w WHERE {inside} ORDER BY variant")
    rows = np.array(found, dtype=float).reshape(-1, len(asked))
    values = {column.name: rows[:, index + 2] for index, column in enumerate(columns)}
    return SampledVariants(rows[:, 0].astype(int), rows[:, 1].astype(int), values, words)


def _words(stored: Stored, column: StoredColumn) -> list[str]:
    sql = f"SELECT DISTINCT {column.sql} FROM v WHERE {column.sql} IS NOT NULL ORDER BY 1 LIMIT 50"
    return [word for (word,) in stored.rows(sql)]


def _number(column: StoredColumn, words: dict[str, list[str]]) -> str:
    """Return a quantity as a float: a text by its place among the words, yes as one."""
    if column.kind == "text":
        return f"CAST(list_position([{', '.join(map(text, words[column.name]))}], {column.sql}) - 1 AS DOUBLE)"
    return f"CAST({column.sql} AS DOUBLE)"


def number_of(stored: Stored, column: StoredColumn) -> str:
    """Return SQL that gives a column as a float, words by their number."""
    return _number(column, {column.name: _words(stored, column)} if column.kind == "text" else {})


# --- which values pass: the share of the variants that do not fail, by value or class of each varied input ------------

CLASSES, MAX_NUMBERS, MAX_WORDS = 5, 8, 12  # of a range; values that stand one by one, of numbers and of words
MAX_INPUTS = 12


class PassingValue(NamedTuple):
    """Hold a value or class of an input: how many variants have it, and how many of them do not fail."""

    text: str
    variants: int
    passing: int


class PassingValues(NamedTuple):
    """Hold an input with its values or classes, and how many values are left out."""

    column: StoredColumn
    rows: list[PassingValue]
    more: int = 0

    @property
    def range(self) -> float:
        """Return how far the shares of its values lie apart."""
        shares = [row.passing / row.variants for row in self.rows if row.variants]
        return max(shares) - min(shares)


def passing_values(stored: Stored) -> list[PassingValues]:
    """Return the varied inputs that have more than one value, in the study's order; of many those whose values differ most."""
    found = [each for column in stored.varied if len((each := _passing(stored, column)).rows) > 1]
    kept = sorted(found, key=lambda each: -each.range)[:MAX_INPUTS]
    return [each for each in found if each in kept]


def _passing(stored: Stored, column: StoredColumn) -> PassingValues:
    def counted(by: str, order: str) -> list[tuple[Any, int, int]]:
        return stored.rows(
            f"SELECT {by} AS place, count(*) AS n, count(*) FILTER ({SOUND}) AS good FROM v "
            f"WHERE {column.sql} IS NOT NULL GROUP BY place ORDER BY {order}"
        )

    if not column.is_number:
        known = counted(column.sql, "good / n DESC, n DESC, place")
        rows = [PassingValue(value_text(value), *counts) for value, *counts in known]
        return PassingValues(column, rows[:MAX_WORDS], max(0, len(rows) - MAX_WORDS))
    sql = f"SELECT min({column.sql}), max({column.sql}), count(DISTINCT {column.sql}) FROM v"
    low, high, count = stored.rows(sql)[0]
    if count <= MAX_NUMBERS:
        rows = [PassingValue(display(float(value), column), *counts) for value, *counts in counted(column.sql, "place")]
        return PassingValues(column, rows)
    wide = (high - low) / CLASSES  # a value at a limit belongs to the class above it
    at = f"CAST(least(floor(({column.sql} - {low!r}) / {wide!r}), {CLASSES - 1}) AS BIGINT)"
    classes = {int(place): counts for place, *counts in counted(at, "place")}
    edges = [display(low + wide * index, column) for index in range(CLASSES + 1)]
    named_ = enumerate(f"{one} … {other}" for one, other in pairwise(edges))
    return PassingValues(column, [PassingValue(told, *classes.get(index, (0, 0))) for index, told in named_])


# --- what fails and what holds ---------------------------------------------------------------------------------------

SAME_MARGIN = 1e-6  # relative difference up to which two margins are shared


class Utilisation(NamedTuple):
    """Hold a check over all variants: how many in each class of utilisation, without one, its statuses, and its greatest value.

    Of one that fails or warns also in how many variants it governs the failure, and is the only failing one.
    """

    check: str
    bands: tuple[int, ...]
    without: int
    passing: int
    warning: int
    failing: int
    unchecked: int  # as a limit or another key is not given
    greatest: float | None
    governing: int = 0
    only: int = 0

    @property
    def is_made(self) -> bool:
        """Return whether any variant has this check."""
        return self.passing + self.warning + self.failing > 0


class Governing(NamedTuple):
    """Hold a check that governs variants which pass: how many, their least and greatest utilisation, and whether its own one varies at all."""

    check: str
    variants: int
    least: float | None
    greatest: float | None
    varies: bool = True


def utilisations(stored: Stored) -> list[Utilisation]:
    """Return each check over all variants, those with the most failures first."""

    def asked(check: str) -> list[str]:
        value, status = (column.sql for column in stored.checks[check])
        inner = (f"{value} > {low!r} AND {value} <= {high!r}" for low, high in pairwise(BANDS))
        bands = [f"{value} <= {BANDS[0]!r}", *inner, f"{value} > {BANDS[-1]!r}"]
        states = [f"{status} = {text(known)}" for known in ("pass", "warn", "fail", "not_checked")]
        conditions = [*bands, f"{value} IS NULL AND {status} IS NOT NULL", *states]
        return [*(f"count(*) FILTER ({each})" for each in conditions), f"max({value})"]

    each = _of_each(stored, list(stored.checks), asked, "v")
    found = [Utilisation(check, row[: len(BANDS) + 1], *row[len(BANDS) + 1 :]) for check, row in each]
    return sorted(found, key=lambda row: (-row.failing, -row.warning, -(row.greatest or 0.0), row.check))


def failures(stored: Stored, used: Sequence[Utilisation]) -> list[Utilisation]:
    """Return the checks that fail or warn in any variant, those with the most failures first."""
    sql = "SELECT governing, count(*) FROM v WHERE status = 'fail' AND governing IS NOT NULL GROUP BY governing"
    governed = dict(stored.rows(sql))

    def asked(row: Utilisation) -> list[str]:
        return [f"count(*) FILTER ({stored.checks[row.check][1].sql} = 'fail')"]

    rows = _of_each(stored, [row for row in used if row.failing or row.warning], asked, f"w WHERE {FAILING} = 1")
    found = [row._replace(governing=governed.get(row.check, 0), only=only) for row, (only,) in rows]
    return sorted(found, key=lambda row: (-row.failing, -row.governing, -row.warning, row.check))


def governing(stored: Stored, still: Collection[str] = ()) -> list[Governing]:
    """Return what governs the variants that pass, the most frequent first; checks whose utilisation stands ``still`` come last."""
    sql = (
        f"SELECT governing, count(*) AS n, min({WORST.sql}), max({WORST.sql}) FROM w "
        f"WHERE {SOUND} AND governing IS NOT NULL GROUP BY governing ORDER BY n DESC, governing"
    )
    found = [Governing(*row)._replace(varies=row[0] not in still) for row in stored.rows(sql)]
    return sorted(found, key=lambda row: not row.varies)


def margin(stored: Stored) -> tuple[int, float, str, int] | None:
    """Return which of the variants that do not fail keeps most from its limits: variant, utilisation, check, how many share it."""
    there = f"FROM w WHERE {SOUND} AND {WORST.sql} IS NOT NULL"
    least = stored.rows(f"SELECT min({WORST.sql}) {there}")[0][0]
    if least is None:
        return None
    alike = f"{there} AND {WORST.sql} <= {least * (1 + SAME_MARGIN)!r}"
    one, check, shared = stored.rows(f"SELECT min(variant), arg_min(governing, variant), count(*) {alike}")[0]
    return one, least, check, shared
