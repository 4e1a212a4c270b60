"""The numbered tables of a chapter: those of its calculation, of its curves, of quantities of repeated parts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import zip_longest
from typing import Any, Literal, NamedTuple, TypeVar

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from diecut_report.quantities.formatting import place_shown
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.chapters.printed_tables import PartsTable, PrintedColumn, PrintedTable, TableCell
from diecut_report.report.chapters.repetition import Parts
from diecut_report.report.chapters.value_tables import MOST_PARTS, RecordTable, record_rows
from diecut_report.report.model import QuantityRow, basis_of, utilisation
from diecut_report.report.symbols import symbol
from diecut_report.report.text import Catalogue, displayed, is_words, number, value_in_words
from diecut_report.results.mechanism_record import (
    CheckPartRecord,
    CheckRecord,
    CurveRecord,
    ItemRecord,
    PhaseRecord,
    QuantityRecord,
    SectionRecord,
)

# The tables of a section, brought together: those of the same parts in one, none that a formula has said already, and no column twice.


SectionTablesColumn = tuple[Any, ...]  # the names of its lines, its title, symbol and unit, its texts
MOST = 8  # columns of a table that is put together, the first one among them
LONGEST_LIST = 12  # numbers in a line


def brought_together(section: SectionRecord, told: set[SectionTablesColumn]) -> list[ItemRecord | None]:
    """Return the steps of a section in their places; none where a table went into a later one, or says nothing new.

    ``told`` are the columns that the chapter has printed already, each with the lines that it stands beside; those that follow are put to them.
    """
    items: list[ItemRecord | None] = list(section.items)
    tables = [place for place, item in enumerate(section.items) if item.type == "table"]
    for place in tables:
        item = section.items[place]
        items[place] = None if _is_said(item, section.items[:place]) else _with_new_columns(item, told)
    for place in tables:
        _move_on(items, place, section.title)
    return items


def _with_new_columns(table: ItemRecord, told: set[SectionTablesColumn]) -> ItemRecord | None:
    """A table without the columns that stand in an earlier one beside the same lines; none where all do. One that is declared stays whole."""
    if table.id:
        return table
    texts = [*zip(*table.rows, strict=True)]
    columns = [(texts[0], c.title, c.symbol, c.unit, text) for c, text in zip(table.columns, texts, strict=True)]
    is_single = texts[0] == ("1",)  # what it follows from stands in the formula before it
    new = [k for k, c in enumerate(columns) if not k or (c not in told and (not is_single or c[1] == table.title))]
    told.update(columns)
    if len(new) == 1:
        return None
    return table.with_(columns=[table.columns[k] for k in new], rows=[[row[k] for k in new] for row in table.rows])


def _is_said(table: ItemRecord, before: Sequence[ItemRecord]) -> bool:
    """Whether a table is of one part, whose numbers stand in the formula before it."""
    last = next((item for item in reversed(before) if item.type != "table"), None)
    return len(table.rows) == 1 and bool(last and last.equation) and table.title == (last.description if last else "")


def _move_on(items: list[ItemRecord | None], place: int, title: str) -> None:
    """Put a table into the next one of the same parts, where both have room in one."""
    if (one := items[place]) is None:
        return
    heads = [row[0] for row in one.rows]
    for later, other in enumerate(items[place + 1 :], place + 1):
        if other is None or other.type != "table" or len(set(heads)) < len(heads):
            continue
        if (other.columns[0], [row[0] for row in other.rows]) == (one.columns[0], heads):
            both = _joined(one, other, title)
            if len(both.columns) <= MOST:
                items[place], items[later] = None, both
            return


def _joined(one: ItemRecord, other: ItemRecord, title: str) -> ItemRecord:
    known = [(column.title, column.symbol) for column in one.columns]
    new = [k for k, column in enumerate(other.columns) if (column.title, column.symbol) not in known]
    columns = [*one.columns, *(other.columns[k] for k in new)]
    rows = [[*left, *(right[k] for k in new)] for left, right in zip(one.rows, other.rows, strict=True)]
    return ItemRecord(type="table", title=title, columns=columns, rows=rows)


def is_in_line(table: ItemRecord) -> bool:
    """Return whether a table is of one quantity of parts that have numbers alone, which is set in a line."""
    numbers = [str(number) for number in range(1, len(table.rows) + 1)]
    is_plain = len(table.columns) == 2 and [row[0] for row in table.rows] == numbers and len(numbers) <= LONGEST_LIST
    return is_plain and table.title == table.columns[1].title


# Inputs that a mechanism takes from others by itself: nobody typed them, and each stands in the chapter that gives it.


class TakenGroup(NamedTuple):
    """What is taken from one mechanism, the id there as key of each row; ``basis`` is what all of it rests on."""

    home: str
    basis: str
    rows: list[QuantityRow]


def is_taken(row: QuantityRecord) -> bool:
    """Return whether an input is a number or a curve of another mechanism that nobody asked for by a reference."""
    return row.origin == "reference" and not row.text and "." in row.path


def is_partner(row: QuantityRecord) -> bool:
    """Return whether an input is a mechanism that was found, not typed."""
    is_name = isinstance(row.value, str) and not row.text and not row.part
    return is_name and (row.origin == "given" or row.path == row.value)


def taken_groups(rows: Iterable[tuple[str, QuantityRow]]) -> list[TakenGroup]:
    """Return the rows, given with the paths that they are taken from, by the mechanisms that give them."""
    found: dict[str, list[QuantityRow]] = {}
    for path, row in rows:
        home, _, name = path.partition(".")
        found.setdefault(home, []).append(replace(row, key=name))
    groups = []
    for home, own in found.items():
        bases = {row.origin for row in own}
        basis = bases.pop() if len(bases) == 1 else ""
        groups.append(TakenGroup(home, basis, [replace(row, origin="") for row in own] if basis else own))
    return groups


# Curves of the results as they are drawn and tabled: jumps at their true place, closed over a turn (all SI).


Array = NDArray[Any]
CURVE_ROWS = 18  # of a table of curves: of a turn each twentieth degree
MOST_JUMPS = 8  # of which a table tells: with more it would grow too long
SIDES: tuple[Literal["left", "right"], ...] = ("left", "right")

CURVES_ROUNDING = 1e-5  # of a curve's greatest value; where a root is taken of rounding, it grows to about a millionth


class CurvePlace(NamedTuple):
    """Where a row of a table is taken: x, and the list of a curve's results and the number in it (from 0) of the value."""

    x: float
    values: Literal["values", "left", "right"]
    number: int


def continuous(curve: CurveRecord, over: CurveRecord, period: float | None) -> tuple[Array, Array]:
    """Samples of a curve over its abscissa, a jump as two points at its true place, led to the end of a full period (SI)."""
    x, y = np.asarray(over.values, dtype=float), np.asarray(curve.values, dtype=float)
    places = np.asarray(curve.breakpoints, dtype=float)
    if period:
        x, y = np.append(x, x[0] + period), np.append(y, _end(y))
    if not len(places):
        return x, y
    clear = (np.abs(x[:, None] - places) > 1e-12 * max(1.0, float(np.abs(x).max()))).all(axis=1)
    x, y, order = x[clear], y[clear], np.full(int(clear.sum()), 0)
    x = np.concatenate([x, places, places])
    y = np.concatenate([y, curve.left, curve.right])
    order = np.concatenate([order, np.full(len(places), 0), np.full(len(places), 1)])
    sorting = np.lexsort((order, x))
    return x[sorting], y[sorting]


def _end(y: Array) -> float:
    """A curve's value at the end of a period: its first one, or where it leads to if it does not close (a growing angle)."""
    ahead = 2 * y[-1] - y[-2]
    bends = np.abs(np.diff(np.concatenate([y[:4], y[-4:]]), 2))[[0, 1, -2, -1]]
    closes = abs(y[0] - ahead) <= max(10 * float(bends.max()), 0.02 * float(np.ptp(y)))
    return float(y[0] if closes else ahead)


def period_of(over: CurveRecord) -> float | None:
    """A full turn, where the abscissa is an angle that runs over one."""
    values = over.values
    if over.unit != "rad" or len(values) < 3:
        return None
    step = values[1] - values[0]
    return 2 * np.pi if abs(values[-1] + step - values[0] - 2 * np.pi) < 0.5 * step else None


def through_pole(x: Array, y: Array) -> tuple[Array, Array]:
    """A change of sign passes through the pole: a jump by a radial line, a crossing at its interpolated place."""
    change = np.nonzero(np.sign(y[:-1]) * np.sign(y[1:]) < 0)[0]
    places = x[change] - y[change] * (x[change + 1] - x[change]) / (y[change + 1] - y[change])
    return np.insert(x, change + 1, places), np.insert(y, change + 1, 0.0)


def table_places(over: CurveRecord, members: Sequence[CurveRecord]) -> list[CurvePlace]:
    """Rows of a table of curves: at even steps of the samples; a jump adds two, before and after it.

    Of curves that jump at many places, or at different ones, no jump is told.
    """
    x, breaks = over.values, members[0].breakpoints
    if len(breaks) >= MOST_JUMPS or any(curve.breakpoints != breaks for curve in members):
        breaks = []
    least = [CURVES_ROUNDING * max(map(abs, curve.values)) for curve in members]  # of jumps
    jumps = [
        index for index in range(len(breaks))
        if any(abs(each.right[index] - each.left[index]) > jump for each, jump in zip(members, least, strict=True))
    ]  # fmt: skip
    sides = [CurvePlace(breaks[index], side, index) for index in jumps for side in SIDES]
    even = [CurvePlace(float(x[number]), "values", number) for number in range(0, len(x), max(1, len(x) // CURVE_ROWS))]
    margin = 1e-9 * float(np.ptp(x))
    clear = [each for each in even if all(abs(each.x - breaks[index]) > margin for index in jumps)]
    return sorted(clear + sides, key=lambda place: place.x)  # of equal ones the left side stays the first


Column = tuple[str, Markup, str]
Columns = TypeVar("Columns")
ROUNDING = 2e-6  # of a curve's greatest value: what is less is the root of rounding, and printed as zero
NARROW, TALL = 3, 16  # columns and lines of a table that is set in two halves
MOST_COLUMNS = 7  # beside the first one


class Tables:
    """Makes a chapter's tables; they count up as they are made."""

    def __init__(
        self, letter: str, words: Catalogue, lists: Mapping[str, str] | None = None, names: frozenset[str] = frozenset()
    ) -> None:
        self.letter, self.words, self.lists, self.names = letter, words, lists or {}, names
        self.decimal = words["decimal"]
        self.count = 0

    def of_item(self, item: ItemRecord) -> PrintedTable:
        """A table of the calculation."""
        columns = [(_head(c.title), symbol(c.symbol), pretty(c.unit)) for c in item.columns]
        rows = [[number(text, self.decimal) for text in row] for row in item.rows]
        return PrintedTable(item.title, *in_halves(columns, rows), self._number())

    def of_curves(self, curves: Mapping[str, CurveRecord]) -> list[PrintedTable]:
        """Some rows of all curves, by their abscissa, so many columns a table as the page holds."""
        groups: dict[str, list[CurveRecord]] = {}
        for curve in curves.values():
            if curve.abscissa and not curve.is_spectrum:
                groups.setdefault(curve.abscissa, []).append(curve)
        shared = [(curves[axis], columns) for axis, members in groups.items() for columns in shared_out(members)]
        return [self._curves(axis, columns) for axis, columns in shared]

    def _curves(self, axis: CurveRecord, members: list[CurveRecord]) -> PrintedTable:
        columns = [(_head(c.description), symbol(c.symbol), pretty(c.display_unit)) for c in (axis, *members)]
        rows = []
        for place in table_places(axis, members):
            shown = number(place_shown(place.x, axis.display_unit)["text"], self.decimal)
            rows.append([shown, *(self._sample(curve, place) for curve in members)])
        return PrintedTable(self.words.say("curves_over", axis=axis.description), columns, rows, self._number())

    def of_phases(self, phases: Mapping[str, PhaseRecord]) -> list[PrintedTable]:
        """When a mechanism does what: a line for each interval, a table for each abscissa."""
        groups: dict[str, list[PhaseRecord]] = {}
        for phase in (each for each in phases.values() if not each.parts):  # what is but others together
            groups.setdefault(phase.abscissa, []).append(phase)
        return [self._phases(members) for members in groups.values()]

    def _phases(self, members: list[PhaseRecord]) -> PrintedTable:
        display = members[0].display.unit
        every = [(phase, interval) for phase in members for interval in phase.display.intervals]
        is_timed = unit(display).kind != unit("ms").kind and any(interval.time for _, interval in every)
        heads = {"phase": "", "role": "", "from": pretty(display), "to": pretty(display), "length": pretty(display)}
        heads |= {"time": "ms"} if is_timed else {}
        columns = [(self.words[key], Markup(""), shown) for key, shown in heads.items()]
        rows = []
        for phase, each in every:
            ends = [each.begin, each.to, each.length, *([each.time] if is_timed else [])]
            texts = [phase.description, self.words[f"role_{phase.role}"]]
            rows.append([*texts, *(number(end, self.decimal) for end in ends)])
        return PrintedTable(self.words["phases"], columns, rows, self._number())

    def _sample(self, curve: CurveRecord, place: CurvePlace) -> str:
        value = getattr(curve, place.values)[place.number]
        scale = max(abs(v) for v in curve.values)
        return displayed(value if abs(value) > ROUNDING * scale else 0.0, curve.display_unit, self.decimal)

    def of_records(self, parts: Parts) -> list[PartsTable | RecordTable]:
        """Inputs of repeated parts: of a few the parts side by side, of many a line for each."""
        if len(parts.numbers) > MOST_PARTS or not parts.listed:
            return [*self.of_parts(parts, given=True)]
        heads, rows = record_rows(parts, partial(self._cell, given=True))
        title = self.lists.get(parts.family, "")
        return [RecordTable(self._number(), title, parts.family, heads, rows)] if rows else []

    def of_parts(self, parts: Parts, *, given: bool) -> list[PartsTable]:
        """Quantities of repeated parts: inputs (``given``) tell their keys and where they come from, results their sources."""
        return [self._parts(parts, columns, given) for columns in shared_out(list(parts.heads))]

    def _parts(self, parts: Parts, heads: list[tuple[str, QuantityRecord]], given: bool) -> PartsTable:
        columns = [
            PrintedColumn(row.description, symbol(row.symbol), pretty(row.display.unit),
                   key=quantity if given else "", source=row.source)
            for quantity, row in heads
        ]  # fmt: skip
        lines = []
        for part in parts.numbers:
            rows = [parts.columns[quantity].get(part) for quantity, _ in heads]
            lines.append((str(part), [self._cell(row[1], given) if row else TableCell("–") for row in rows]))
        family = parts.family if parts.listed else f"{parts.family}_{parts.numbers[0]} … {parts.numbers[-1]}"
        title = self.lists.get(parts.family, columns[0].title if len(columns) == 1 else "")
        return PartsTable(self._number(), title, family, columns, lines)

    def of_check(self, check: CheckRecord) -> PartsTable:
        """A check on a row over repeated parts: how each part fares."""
        parts = list(enumerate(check.parts, 1))
        columns = [self._side(check, side) for side in ("demand", "limit")]
        columns += [PrintedColumn(self.words[key], Markup(""), "", "", "") for key in ("utilisation", "verdict")]
        lines = [((part.name or str(number)), self._judged(check, part)) for number, part in parts]
        return PartsTable(self._number(), check.title, "", columns, lines)

    def _side(self, check: CheckRecord, side: str) -> PrintedColumn:
        labels = {getattr(part, f"{side}_label") for part in check.parts if part.status}
        title = labels.pop() if len(labels) == 1 else self.words[side]
        return PrintedColumn(title, Markup(""), pretty(getattr(check, f"{side}_display").unit), "", "")

    def _judged(self, check: CheckRecord, part: CheckPartRecord) -> list[TableCell]:
        if part.status is None:
            return [TableCell("–")] * 4
        mixed = len({other.demand_label for other in check.parts if other.status}) > 1
        sides = [
            TableCell(number(display.text, self.decimal), label if mixed else "")
            for display, label in ((part.demand_display, part.demand_label), (part.limit_display, part.limit_label))
            if display
        ]
        share = utilisation(part.utilisation, part.status, self.decimal)
        return [*sides, TableCell(share), TableCell(self.words[part.status], wordy=True)]

    def _cell(self, row: QuantityRecord, given: bool) -> TableCell:
        text, note = number(value_in_words(row), self.decimal), self._origin(row) if given else ""
        return TableCell(text, note, is_words(row.display.text), row.before)

    def _origin(self, row: QuantityRecord) -> str:
        """What is to be said of an input: where it comes from, and what it rests on."""
        return "; ".join(filter(None, (self._from(row), basis_of(row, self.words), row.note)))

    def _from(self, row: QuantityRecord) -> str:
        """Where it comes from: that it is a default, what it refers to, how it was typed in another unit."""
        if row.origin == "default":
            return self.words.say("from_press", path=row.path) if row.path else self.words["default"]
        typed, shown = str(row.text or row.path or ""), row.display.text.replace(" ", "")
        word = str(row.text or "")  # of the contract, which the shown one says in words
        is_choice = row.value == word and word.replace("_", "").isalnum() and word.islower() and not word.isdigit()
        return "" if typed.replace(" ", "") in (shown, shown + row.display.unit) or is_choice else typed

    def _number(self) -> str:
        self.count += 1
        return f"{self.letter}.{self.count}"


def _head(description: str) -> str:
    """A description as the head of a column: what it explains behind a semicolon stands where the quantity is given."""
    return description.partition(";")[0]


def in_halves(columns: list[Column], rows: list[list[str]]) -> tuple[list[Column], list[list[str]]]:
    """A long table of few columns as two halves side by side."""
    if len(columns) > NARROW or len(rows) < TALL:
        return columns, rows
    half = -(-len(rows) // 2)
    empty = [""] * len(columns)
    return columns * 2, [[*one, *other] for one, other in zip_longest(rows[:half], rows[half:], fillvalue=empty)]


def shared_out(columns: Sequence[Columns]) -> Iterator[list[Columns]]:
    """Columns for as many tables as they need, of about equal width."""
    tables = -(-len(columns) // MOST_COLUMNS)
    size = -(-len(columns) // max(tables, 1))
    for start in range(0, len(columns), max(size, 1)):
        yield list(columns[start : start + size])
