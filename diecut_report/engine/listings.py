"""Tables that plain code makes: their rows, checked, as numbers and as they are printed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from diecut_report.contract.listings import Cell, ListedColumn, Listing
from diecut_report.contract.place import Misdeclared
from diecut_report.engine.calculation import Calculation
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import listed_text, number_text
from diecut_report.quantities.units import unit

Data = dict[str, Any]
SAME = 1e-9  # relative difference within which a number is that of a row
TAKEN, MARK = phrase("taken"), "→"


def rows(calc: Calculation, step: Listing) -> list[list[Cell]]:
    """Return the rows of a listing, SI; Misdeclared where they are none."""
    known = {name: calc[name] for name in step.holds if name in calc.values or name in calc.inputs}
    found = [[_plain(cell) for cell in row] for row in step.function(known)]
    for row in found:
        if len(row) != len(step.heads) or any(isinstance(cell, float) and not math.isfinite(cell) for cell in row):
            words = Phrase(
                "step {id}: its function gives the row {row}; {count} texts and finite numbers are wanted",
                id=step.id,
                row=row,
                count=len(step.heads),
            )
            raise Misdeclared(words, step.at)
    return found


def _plain(cell: Any) -> Cell:
    return cell if cell is None or isinstance(cell, str) else float(cell)


def results(calc: Calculation) -> Data:
    """Return all listings of a machine by id, as the results hold them; nothing where there is none."""
    found: Data = {}
    for step in calc.steps.values():
        if isinstance(step, Listing):
            columns = [
                {"id": each.id, "description": each.description, "unit": unit(each.unit).si} for each in step.heads
            ]
            lines = rows(calc, step)
            marked = {"taken": taken} if (taken := _taken(calc, step, lines)) else {}
            found[step.id] = {"description": step.description, "columns": columns, "rows": lines} | marked
    return {"listings": found} if found else {}


def _taken(calc: Calculation, step: Listing, lines: list[list[Cell]]) -> list[int]:
    """The rows that begin with what was taken."""
    name = step.taken.removeprefix("inputs.")
    if not name or (name not in calc.values and name not in calc.inputs):
        return []
    own: Any = calc[name]
    value = own[0, 0] if isinstance(own, np.ndarray) else own
    return [number for number, row in enumerate(lines) if _is_same(row[0], value)]


def _is_same(cell: Cell, value: Any) -> bool:
    if isinstance(cell, float) and not isinstance(value, str):
        return math.isclose(cell, value, rel_tol=SAME)
    return bool(cell == value)


def printed(calc: Calculation, step: Listing) -> list[Data]:
    """Return a listing as a table of the calculation, the rows that were taken marked in a column of their own; none where it has no rows."""
    columns = [
        {"title": each.description, "symbol": each.symbol, "unit": each.unit} for each in step.heads if each.printed
    ]
    found = rows(calc, step)
    lines = [[_text(cell, head) for cell, head in zip(row, step.heads, strict=True) if head.printed] for row in found]
    if taken := _taken(calc, step, found):
        columns = [{"title": TAKEN, "symbol": "", "unit": "1"}, *columns]
        lines = [[MARK if number in taken else "", *line] for number, line in enumerate(lines)]
    return [{"type": "table", "title": step.description, "columns": columns, "rows": lines}] if lines else []


def _text(cell: Cell, head: ListedColumn) -> str:
    if cell is None:
        return "–"
    if isinstance(cell, str):
        return cell
    return number_text(cell / unit(head.unit).factor, head.digits) if head.digits else listed_text(cell, head.unit)
