"""What a chapter of the report holds: rows of tables, steps of the calculation, headings. Data without layout."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from markupsafe import Markup

from diecut_report.quantities.units import pretty
from diecut_report.report.equations import Equation
from diecut_report.report.number_format import joined, number, parts, quantity
from diecut_report.report.symbols import symbol

Data = Mapping[str, Any]


@dataclass(frozen=True)
class QuantityRow:
    """A quantity in a table."""

    description: str
    symbol: Markup
    value: str
    unit: str
    source: str = ""
    at: Markup = field(default_factory=Markup)
    typed: str = ""
    origin: str = ""
    key: str = ""
    wordy: bool = False


@dataclass(frozen=True)
class CheckRow:
    """A check with its verdict."""

    id: str
    mechanism: str
    chapter: str
    chapter_title: str
    anchor: str
    title: str
    status: str
    demand: str
    demand_label: str
    operator: str
    limit: str
    limit_label: str
    margin: str
    utilisation: str
    source: str
    message: str
    parts: PartsTable | None = None


@dataclass(frozen=True)
class Heading:
    """A heading within a chapter."""

    number: str
    title: str
    anchor: str


@dataclass(frozen=True)
class Item:
    """One step of a calculation, of any type; what does not apply is empty."""

    type: str
    number: str = ""
    description: str = ""
    source: str = ""
    equation: Equation | None = None
    condition: Equation | None = None
    definitions: tuple[Equation, ...] = ()
    words: str = ""
    text: str = ""
    notes: tuple[str, ...] = ()
    table: PrintedTable | None = None


@dataclass(frozen=True)
class PrintedTable:
    """A table of the calculation, or of curves."""

    title: str
    columns: list[tuple[str, Markup, str]]  # title, symbol, unit
    rows: list[list[str]]
    number: str = ""


@dataclass(frozen=True)
class TableCell:
    """A value in a table of repeated parts, and what is to be said of it: where it comes from, how it was typed."""

    text: str
    note: str = ""
    wordy: bool = False


@dataclass(frozen=True)
class PrintedColumn:
    """The head of a column in a table of repeated parts."""

    title: str
    symbol: Markup
    unit: str
    key: str
    source: str


@dataclass(frozen=True)
class PartsTable:
    """Quantities of repeated parts: a line for each part, by its number."""

    number: str
    title: str
    family: str
    columns: list[PrintedColumn]
    lines: list[tuple[str, list[TableCell]]]


@dataclass(frozen=True)
class File:
    """A file beside the report."""

    name: str
    content: str


@dataclass(frozen=True)
class PrintedSection:
    """A part of the calculation."""

    heading: Heading
    text: str
    items: list[Item]
    shown: str = ""


@dataclass
class PrintedChapter:
    """All that is reported of one mechanism."""

    letter: str
    name: str
    anchor: str
    title: str
    kind: str
    version: str
    status: str
    source_sha256: str = ""
    source_file: str = ""
    error: str = ""
    summary: str = ""
    assumptions: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    between: list[PrintedChapter] = field(default_factory=list)
    inputs: list[QuantityRow] = field(default_factory=list)
    input_parts: list[PartsTable] = field(default_factory=list)
    key_results: list[QuantityRow] = field(default_factory=list)
    outputs: list[QuantityRow] = field(default_factory=list)
    output_parts: list[PartsTable] = field(default_factory=list)
    sections: list[PrintedSection] = field(default_factory=list)
    checks: list[CheckRow] = field(default_factory=list)
    curves: list[PrintedTable] = field(default_factory=list)
    figures: list[tuple[str, Data]] = field(default_factory=list)
    files: list[File] = field(default_factory=list)
    absent: list[Data] = field(default_factory=list)
    errata: list[tuple[str, str, str]] = field(default_factory=list)
    parts: dict[str, Heading] = field(default_factory=dict)
    headings: list[Heading] = field(default_factory=list)

    @property
    def lost(self) -> bool:
        """Whether it could not be calculated."""
        return self.status in ("error", "skipped")


def quantity_row(row: Data, decimal: str, description: str = "") -> QuantityRow:
    """A quantity of the results as a row of a table; another description may stand for its own."""
    shown, at = row["display"], row.get("at")
    place = Markup("")
    if at:
        place = symbol(at["symbol"]) + f" = {quantity(at['text'], at['unit'], decimal)}"
    text = number(shown["text"], decimal)
    return QuantityRow(
        description=description or row["description"],
        symbol=symbol(row["symbol"]),
        value=text,
        unit=pretty(shown["unit"]),
        source=row.get("source", ""),
        at=place,
        key=row.get("path", ""),
        wordy=is_words(shown["text"]) and not pretty(shown["unit"]),
    )


def is_words(text: str) -> bool:
    """Whether the text of a value is not a number."""
    return parts(text) is None


def utilisation(ratio: float | None, status: str, decimal: str) -> str:
    """A utilisation in per cent: as many decimals as show on which side of 100 it lies."""
    if ratio is None:
        return "–"
    percent = 100 * ratio
    digits = 0 if percent >= 1000 else 1
    while digits < 6 and status != "pass" and f"{percent:.{digits}f}" == f"{100:.{digits}f}":
        digits += 1
    return joined(number(f"{percent:.{digits}f}", decimal), "%")
