"""Tables that plain code makes: their rows, checked, as numbers and as they are printed."""

from __future__ import annotations

import math
from typing import Any

from diecut_report.contract.listings import Cell, Listing
from diecut_report.contract.place import Misdeclared
from diecut_report.engine.calculation import Calculation
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.formatting import listed_text
from diecut_report.quantities.units import unit

Data = dict[str, Any]


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
            found[step.id] = {"description": step.description, "columns": columns, "rows": rows(calc, step)}
    return {"listings": found} if found else {}


def printed(calc: Calculation, step: Listing) -> list[Data]:
    """Return a listing as a table of the calculation; none where it has no rows."""
    columns = [{"title": each.description, "symbol": each.symbol, "unit": each.unit} for each in step.heads]
    units = [each.unit for each in step.heads]
    lines = [[_text(cell, display) for cell, display in zip(row, units, strict=True)] for row in rows(calc, step)]
    return [{"type": "table", "title": step.description, "columns": columns, "rows": lines}] if lines else []


def _text(cell: Cell, display: str) -> str:
    if cell is None:
        return "–"
    return cell if isinstance(cell, str) else listed_text(cell, display)
