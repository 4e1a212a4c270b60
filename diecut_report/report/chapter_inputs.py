"""The inputs of a chapter: in lines, in tables of repeated parts, and those at their defaults or taken from others in paragraphs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from diecut_report.report.i18n import Catalogue
from diecut_report.report.model import QuantityRow, quantity_row, rested
from diecut_report.report.printed_tables import PartsTable
from diecut_report.report.record_tables import RecordTable
from diecut_report.report.repeated_parts import FEWEST_GIVEN, gathered
from diecut_report.report.tables import Tables
from diecut_report.report.taken_inputs import TakenGroup, is_partner, is_taken, taken_groups
from diecut_report.report.told_before import ToldBefore

Data = Mapping[str, Any]


class ChapterInputs:
    """Prints inputs; without ``told`` each with all that is known of it. ``are_told``: some defaults are those of an earlier chapter."""

    def __init__(self, words: Catalogue, tables: Tables, told: ToldBefore | None) -> None:
        self.words, self.tables, self.told = words, tables, told
        self.is_full, self.decimal = told is None, words["decimal"]
        self.are_told = False
        self.partners: list[QuantityRow] = []
        self.taken: list[TakenGroup] = []

    def of(self, inputs: Data) -> tuple[list[QuantityRow], list[QuantityRow], list[PartsTable | RecordTable]]:
        """Return the inputs line by line, what is left at its default, and tables of those of repeated parts."""
        single, lists = gathered(inputs, FEWEST_GIVEN)
        left = set() if self.is_full else {key for key, row in single.items() if _is_left_alone(row)}
        for place, parts in enumerate([] if self.is_full else lists):
            alone = [
                name for name, rows in parts.columns.items() if all(_is_left_alone(row) for _, row in rows.values())
            ]
            left |= {key for name in alone for key, _ in parts.columns[name].values()}
            lists[place] = parts.without(alone)
        taken = set() if self.is_full else self._take(single)
        return (
            [self._input(key, row) for key, row in single.items() if key not in left | taken],
            self._defaults(_each_once(self._input(key, row) for key, row in inputs.items() if key in left)),
            [table for parts in lists if parts.columns for table in self.tables.of_records(parts)],
        )

    def _take(self, inputs: Data) -> set[str]:
        """Gather what nobody typed: mechanisms that were found, and what is taken from them. Return their keys."""
        found = {key: row for key, row in inputs.items() if is_partner(row)}
        given = {key: row for key, row in inputs.items() if is_taken(row)}
        self.partners = [self._input(key, row) for key, row in found.items()]
        self.taken = taken_groups((row["path"], self._input(key, row)) for key, row in given.items())
        return found.keys() | given.keys()

    def _defaults(self, rows: list[QuantityRow]) -> list[QuantityRow]:
        """Inputs that are left alone: those that an earlier chapter of the kind does not tell with the same value."""
        texts = [f"{row.description} {row.value} {row.unit}" for row in rows]
        new = set(texts if self.told is None else self.told.new(texts))
        self.are_told = len(new) < len(rows)
        return [row for row, text in zip(rows, texts, strict=True) if text in new]

    def _input(self, key: str, row: Data) -> QuantityRow:
        shown, path = quantity_row(row, self.decimal), row.get("path", "")
        typed = str(row.get("text") or (path if row["origin"] == "reference" else ""))
        origin = self._origin(row["origin"], path, typed)
        if not self.is_full and row["origin"] == "given":
            plain, origin = row["display"]["text"] + row["display"]["unit"], ""
            typed = "" if typed.replace(" ", "") in (plain, row["display"]["text"]) else typed
        row_of = replace(shown, typed=typed, origin=origin, key=key)
        return rested(row_of, row, self.words)

    def _origin(self, origin: str, path: str, typed: str) -> str:
        """Where an input comes from; the path of a reference stands in what was typed."""
        is_seen = "${" in typed or (path and path in typed)
        if is_seen and not self.is_full:
            return ""  # what was typed says it
        if not path:
            return self.words[origin]
        if path in typed:
            return self.words["reference"]
        return self.words.say("refers" if origin == "reference" else "from_press", path=path)


def _each_once(rows: Iterator[QuantityRow]) -> list[QuantityRow]:
    """Inputs of which something is to be said: those of repeated parts that say the same once, and none that has no value."""
    found = {(row.description, row.value, row.unit): row for row in rows if row.value}
    return list(found.values())


def _is_left_alone(row: Data) -> bool:
    """Whether an input is a default of the program's own, of which nothing is said."""
    return (
        row["origin"] == "default"
        and not row.get("path")
        and row.get("basis", "given") == "given"
        and not row.get("note")
    )
