"""The numbered tables of a chapter: those of its calculation, of its curves, of quantities of repeated parts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import zip_longest
from types import MappingProxyType
from typing import Any, TypeVar

from markupsafe import Markup

from diecut_report.quantities.formatting import place_shown
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.curves import CurvePlace, table_places
from diecut_report.report.given_names import value_in_words
from diecut_report.report.i18n import Catalogue
from diecut_report.report.model import rests, utilisation
from diecut_report.report.number_format import displayed, is_words, number
from diecut_report.report.printed_tables import PartsTable, PrintedColumn, PrintedTable, TableCell
from diecut_report.report.record_tables import MOST_PARTS, RecordTable, record_rows
from diecut_report.report.repeated_parts import Parts
from diecut_report.report.symbols import symbol

Data = Mapping[str, Any]
Column = tuple[str, Markup, str]
Columns = TypeVar("Columns")
ROUNDING = 2e-6  # of a curve's greatest value: what is less is the root of rounding, and printed as zero
NARROW, TALL = 3, 16  # columns and lines of a table that is set in two halves
MOST_COLUMNS = 7  # beside the first one


class Tables:
    """Makes a chapter's tables; they count up as they are made."""

    def __init__(
        self, letter: str, words: Catalogue, lists: Mapping[str, str] = MappingProxyType({}), names: frozenset[str] = frozenset()
    ) -> None:  # fmt: skip
        self.letter, self.words, self.lists, self.names = letter, words, lists, names
        self.decimal = words["decimal"]
        self.count = 0

    def of_item(self, item: Data) -> PrintedTable:
        """A table of the calculation."""
        columns = [(_head(c["title"]), symbol(c["symbol"]), pretty(c["unit"])) for c in item["columns"]]
        rows = [[number(text, self.decimal) for text in row] for row in item["rows"]]
        return PrintedTable(item["title"], *in_halves(columns, rows), self._number())

    def of_curves(self, curves: Data) -> list[PrintedTable]:
        """Some rows of all curves, by their abscissa, so many columns a table as the page holds."""
        groups: dict[str, list[Data]] = {}
        for curve in curves.values():
            if "abscissa" in curve and not curve.get("is_spectrum"):
                groups.setdefault(curve["abscissa"], []).append(curve)
        return [
            self._curves(curves[axis], columns) for axis, members in groups.items() for columns in shared_out(members)
        ]

    def _curves(self, axis: Data, members: list[Data]) -> PrintedTable:
        columns = [(_head(c["description"]), symbol(c["symbol"]), pretty(c["display_unit"])) for c in (axis, *members)]
        rows = [
            [self._abscissa(axis, place.x), *(self._sample(curve, place) for curve in members)]
            for place in table_places(axis, members)
        ]
        return PrintedTable(self.words.say("curves_over", axis=axis["description"]), columns, rows, self._number())

    def of_phases(self, phases: Data) -> list[PrintedTable]:
        """When a mechanism does what: a line for each interval, a table for each abscissa."""
        groups: dict[str, list[Data]] = {}
        for phase in (each for each in phases.values() if not each.get("parts")):  # what is but others together
            groups.setdefault(phase["abscissa"], []).append(phase)
        return [self._phases(members) for members in groups.values()]

    def _phases(self, members: list[Data]) -> PrintedTable:
        display = members[0]["display"]["unit"]
        keys = ("from", "to", "length")
        texts = [(self.words[key], Markup(""), "") for key in ("phase", "role")]
        columns = texts + [(self.words[key], Markup(""), pretty(display)) for key in keys]
        is_time = unit(display).kind == unit("ms").kind
        timed = not is_time and any(
            "time" in interval for phase in members for interval in phase["display"]["intervals"]
        )
        columns += [(self.words["time"], Markup(""), "ms")] if timed else []
        rows = [
            [phase["description"], self.words[f"role_{phase['role']}"]]
            + [number(interval[key], self.decimal) for key in (*keys, *(["time"] if timed else []))]
            for phase in members
            for interval in phase["display"]["intervals"]
        ]
        return PrintedTable(self.words["phases"], columns, rows, self._number())

    def _abscissa(self, axis: Data, x: float) -> str:
        return number(place_shown(x, axis["display_unit"])["text"], self.decimal)

    def _sample(self, curve: Data, place: CurvePlace) -> str:
        value = curve[place.values][place.number]
        scale = max(abs(v) for v in curve["values"])
        return displayed(value if abs(value) > ROUNDING * scale else 0.0, curve["display_unit"], self.decimal)

    def of_records(self, parts: Parts) -> list[PartsTable | RecordTable]:
        """Inputs of repeated parts: of a few the parts side by side, of many a line for each."""
        if len(parts.numbers) > MOST_PARTS or not parts.listed:
            return [*self.of_parts(parts, given=True)]
        heads, rows = record_rows(parts, self._cell, self._origin)
        title = self.lists.get(parts.family, "")
        return [RecordTable(self._number(), title, parts.family, heads, rows)] if rows else []

    def of_parts(self, parts: Parts, *, given: bool) -> list[PartsTable]:
        """Quantities of repeated parts: inputs (``given``) tell their keys and where they come from, results their sources."""
        told = self._origin if given else lambda _: ""
        return [self._parts(parts, columns, told, given) for columns in shared_out(list(parts.heads))]

    def _parts(
        self, parts: Parts, heads: list[tuple[str, Data]], told: Callable[[Data], str], given: bool
    ) -> PartsTable:
        columns = [
            PrintedColumn(row["description"], symbol(row["symbol"]), pretty(row["display"]["unit"]),
                   key=quantity if given else "", source=row.get("source", ""))
            for quantity, row in heads
        ]  # fmt: skip
        lines = []
        for part in parts.numbers:
            rows = [parts.columns[quantity].get(part) for quantity, _ in heads]
            lines.append((str(part), [self._cell(row[1], told) if row else TableCell("–") for row in rows]))
        family = parts.family if parts.listed else f"{parts.family}_{parts.numbers[0]} … {parts.numbers[-1]}"
        title = self.lists.get(parts.family, columns[0].title if len(columns) == 1 else "")
        return PartsTable(self._number(), title, family, columns, lines)

    def of_check(self, check: Data) -> PartsTable:
        """A check on a row over repeated parts: how each part fares."""
        parts = list(enumerate(check["parts"], 1))
        columns = [self._side(check, side) for side in ("demand", "limit")]
        columns += [PrintedColumn(self.words[key], Markup(""), "", "", "") for key in ("utilisation", "verdict")]
        lines = [(part.get("name", str(number)), self._judged(check, part)) for number, part in parts]
        return PartsTable(self._number(), check["title"], "", columns, lines)

    def _side(self, check: Data, side: str) -> PrintedColumn:
        """The head of a side's column: its own words where all parts share them."""
        labels = {part[f"{side}_label"] for part in check["parts"] if part["status"]}
        title = labels.pop() if len(labels) == 1 else self.words[side]
        return PrintedColumn(title, Markup(""), pretty(check[f"{side}_display"]["unit"]), "", "")

    def _judged(self, check: Data, part: Data) -> list[TableCell]:
        """Both sides of a part, its utilisation and its verdict; a part that has no such quantity has none."""
        if part["status"] is None:
            return [TableCell("–")] * 4
        mixed = len({other.get("demand_label") for other in check["parts"] if other["status"]}) > 1
        sides = [
            TableCell(number(part[f"{side}_display"]["text"], self.decimal), part[f"{side}_label"] if mixed else "")
            for side in ("demand", "limit")
        ]
        share = utilisation(part["utilisation"], part["status"], self.decimal)
        return [*sides, TableCell(share), TableCell(self.words[part["status"]], wordy=True)]

    def _cell(self, row: Data, told: Callable[[Data], str]) -> TableCell:
        text = row["display"]["text"]
        return TableCell(number(value_in_words(row), self.decimal), told(row), is_words(text), row.get("changed", ""))

    def _origin(self, row: Data) -> str:
        """What is to be said of an input: where it comes from, and what it rests on."""
        return "; ".join(filter(None, (self._from(row), *rests(row, self.words))))

    def _from(self, row: Data) -> str:
        """Where it comes from: that it is a default, what it refers to, how it was typed in another unit."""
        if row["origin"] == "default":
            return self.words.say("from_press", path=row["path"]) if row.get("path") else self.words["default"]
        typed, shown = str(row.get("text") or row.get("path") or ""), row["display"]
        plain = {shown["text"].replace(" ", ""), shown["text"].replace(" ", "") + shown["unit"]}
        return "" if typed.replace(" ", "") in plain or _is_choice(row) else typed

    def _number(self) -> str:
        self.count += 1
        return f"{self.letter}.{self.count}"


def _is_choice(row: Data) -> bool:
    """Whether what was typed is a word of the contract, which the shown one says in words."""
    typed = str(row.get("text") or "")
    return row["value"] == typed and typed.replace("_", "").isalnum() and typed.islower() and not typed.isdigit()


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
