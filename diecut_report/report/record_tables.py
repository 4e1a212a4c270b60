"""Inputs of a few repeated parts: a line for each quantity and a column for each part, so that what is said of a quantity has room."""

from __future__ import annotations

from collections.abc import Callable, Mapping
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


@dataclass(frozen=True)
class RecordRow:
    """A quantity of all parts; ``note`` is what is to be said of each of them alike."""

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
    heads, rows = [str(number) for number in parts.numbers], []
    for quantity, first in parts.heads:
        given = [parts.columns[quantity].get(number) for number in parts.numbers]
        names = {str(each[1]["value"]): None for each in given if each} if quantity in NAMING else {}
        if len(names) == len(given):
            heads = list(names)
            continue
        cells = [cell(each[1], told) if each else TableCell(DASH) for each in given]
        rows.append(_row(quantity, first, cells, len([each for each in given if each])))
    return heads, rows


def _row(quantity: str, first: Data, cells: list[TableCell], given: int) -> RecordRow:
    """A line; what is said of all its values alike is said once."""
    notes = {cell.note for cell in cells if cell.text != DASH}
    shared = notes.pop() if len(notes) == 1 and given else ""
    kept = [TableCell(cell.text, "", cell.wordy, cell.changed) for cell in cells] if shared else cells
    unit = pretty(first["display"]["unit"])
    return RecordRow(first["description"], symbol(first["symbol"]), unit, quantity, kept, shared)
