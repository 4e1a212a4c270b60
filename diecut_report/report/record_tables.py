"""Inputs of a few repeated parts: a line for each quantity and a column for each part, so that what is said of a quantity has room."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from diecut_report.languages.tokens import NAMING
from diecut_report.quantities.units import pretty
from diecut_report.report.printed_tables import DASH, TableCell
from diecut_report.report.repeated_parts import Parts
from diecut_report.report.symbols import symbol

Data = Mapping[str, Any]
MOST_PARTS = 4  # that have room beside each other
SHORT = 18  # letters of a note that has room below a value


@dataclass(frozen=True)
class RecordRow:
    """A quantity of all parts; ``note`` is what is to be said of them, in lines."""

    description: str
    symbol: Markup
    unit: str
    key: str
    cells: list[TableCell]
    note: str = ""


@dataclass(frozen=True)
class RecordTable:
    """Quantities of repeated parts, the parts side by side under their names or numbers."""

    number: str
    title: str
    family: str
    heads: list[str]
    rows: list[RecordRow]

    @property
    def has_notes(self) -> bool:
        """Whether something is to be said of a whole line."""
        return any(row.note for row in self.rows)


def record_rows(
    parts: Parts, cell: Callable[[Data, Callable[[Data], str]], TableCell], told: Callable[[Data], str]
) -> tuple[list[str], list[RecordRow]]:
    """Return the heads of the columns and the lines; ``told`` says where a value comes from."""
    heads = [str(number) for number in parts.numbers]
    lines = []
    for quantity, first in parts.heads:
        given = [parts.columns[quantity].get(number) for number in parts.numbers]
        names = {str(each[1]["value"]): None for each in given if each} if quantity in NAMING else {}
        if len(names) == len(given):
            heads = list(names)
        else:
            lines.append((quantity, first, [cell(each[1], told) if each else TableCell(DASH) for each in given]))
    return heads, [_row(*line, heads) for line in lines]


def _row(quantity: str, first: Data, cells: list[TableCell], heads: list[str]) -> RecordRow:
    """A line, and behind it what is to be said of its values: of all alike once, at length of each with its name."""
    said = [(head, cell.note) for head, cell in zip(heads, cells, strict=True) if cell.text != DASH]
    notes = {note for _, note in said}
    if len(notes) == 1:
        note = notes.pop()
    else:
        is_long = any(len(note) > SHORT for note in notes)
        note = "\n".join(_named(said)) if is_long else ""
    kept = [TableCell(cell.text, "", cell.wordy, cell.changed) for cell in cells] if note else cells
    unit = pretty(first["display"]["unit"])
    return RecordRow(first["description"], symbol(first["symbol"]), unit, quantity, kept, note)


def _named(said: Sequence[tuple[str, str]]) -> Iterator[str]:
    """What is said of each value behind the names of those of which it is said."""
    for note in dict.fromkeys(note for _, note in said if note):
        yield f"{', '.join(head for head, other in said if other == note)}: {note}"
