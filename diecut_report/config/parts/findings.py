"""What a rule finds wrong with the parts of a machine."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from diecut_report.config.parts.model import MachineParts, MachineShaft, ShaftPart
from diecut_report.config.yaml import KeyPath
from diecut_report.quantities.units import unit
from diecut_report.standards import standard_table
from diecut_report.text.phrases import Phrase

Level = Literal["error", "fail", "warning"]


@dataclass(frozen=True)
class Finding:
    """Hold what a rule found: the rule, how grave it is, where it stands, against what, and what is said of it."""

    rule: str
    level: Level
    path: KeyPath
    message: str


def mm(value: float) -> str:
    """Return a length in mm as messages show it."""
    return f"{value * 1e3:.6g} mm"


def finding(
    parts: MachineParts,
    rule: str,
    level: Level,
    path: KeyPath,
    template: str,
    against: KeyPath | None = None,
    **values: Any,
) -> Finding:
    text = Phrase(template, **values)
    if against is None:
        return Finding(rule, level, path, text)
    place = parts.where(against) if level == "error" else parts.line(against)
    return Finding(rule, level, path, Phrase("{text} (against {place})", text=text, place=place))


def hubs(parts: MachineParts) -> Iterator[tuple[MachineShaft, ShaftPart]]:
    for shaft in parts.shafts.values():
        yield from ((shaft, part) for part in shaft.parts if shaft.sections and part.kind != "load")


def table_row(table: str, value: float) -> dict[str, float]:
    """Return the first row of a table of sizes whose first column is not below a value, m, else the last; SI by column."""
    columns = standard_table(table).columns
    rows = [[value * unit(column.unit).factor for value in column.values] for column in columns]
    index = next((i for i, first in enumerate(rows[0]) if value <= first * (1 + 1e-9)), -1)
    return {column.name: row[index] for column, row in zip(columns, rows, strict=True)}
