"""What a rule finds wrong with the parts of a machine."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

from diecut_report.config.parts.elements import Elements
from diecut_report.config.parts.model import MachineParts, ShaftPart
from diecut_report.config.yaml import KeyPath
from diecut_report.quantities.units import unit
from diecut_report.standards import standard_table
from diecut_report.text.phrases import Phrase

Level = Literal["error", "fail", "warning"]


@dataclass(frozen=True)
class Finding:
    """Hold what a rule found: how grave it is, where it stands, what is said of it, against what, and the name of the rule."""

    level: Level
    path: KeyPath
    message: str
    against: KeyPath | None = None
    rule: str = ""


Rule = Callable[[MachineParts], Iterator[Finding]]
ElementRule = Callable[[MachineParts, Elements], Iterator[Finding]]


def mm(value: float) -> str:
    """Return a length in mm as messages show it."""
    return f"{value * 1e3:.6g} mm"


def finding(
    path: KeyPath, template: str, against: KeyPath | None = None, /, *, level: Level = "error", **values: Any
) -> Finding:
    """Return what a rule found at a path, and the place that it contradicts; a value that is a float is a length, m, and shown in mm."""
    shown = {name: mm(value) if isinstance(value, float) else value for name, value in values.items()}
    return Finding(level, path, Phrase(template, shown), against)


def found_by(parts: MachineParts, rule: str, findings: Iterable[Finding]) -> Iterator[Finding]:
    """Yield what a rule found, with its name, and with the line of what each contradicts."""
    for each in findings:
        message = each.message
        if each.against is not None:
            place = parts.where(each.against) if each.level == "error" else parts.line(each.against)
            message = Phrase("{text} (against {place})", text=message, place=place)
        yield replace(each, message=message, rule=rule)


def hubs(parts: MachineParts) -> list[ShaftPart]:
    """Return the parts on modelled shafts but the free forces."""
    return [part for part in parts.every_part if part.shaft.sections and part.kind != "load"]


def table_row(table: str, value: float) -> dict[str, float]:
    """Return the first row of a table of sizes whose first column is not below a value, m, else the last; SI by column."""
    columns = standard_table(table).columns
    rows = [[value * unit(column.unit).factor for value in column.values] for column in columns]
    index = next((i for i, first in enumerate(rows[0]) if value <= first * (1 + 1e-9)), -1)
    return {column.name: row[index] for column, row in zip(columns, rows, strict=True)}
