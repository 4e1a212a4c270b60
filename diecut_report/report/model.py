"""What a chapter of the report holds: rows of tables, steps of the calculation, headings. Data without layout."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any

from markupsafe import Markup

from diecut_report.quantities.units import pretty
from diecut_report.report.chapters.printed_tables import PartsTable, PrintedTable
from diecut_report.report.chapters.value_tables import RecordTable, ValueRow, place_of
from diecut_report.report.equations import Equation
from diecut_report.report.symbols import SymbolRow, symbol
from diecut_report.report.text import is_words, joined, number, value_in_words
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import AbsentRecord, ItemRecord, MechanismRecord, QuantityRecord
from diecut_report.results.model import MovedBarRecord

STATUSES = ("fail", "warn", "pass", "not_checked")  # of checks, in their order


@dataclass(frozen=True)
class TornadoFigure:
    """What each input moves of one number; ``today`` is the number without a change."""

    title: str
    today: float
    bars: Sequence[MovedBarRecord]
    type: str = "tornado"
    error: str = ""


Drawn = FigureRecord | TornadoFigure


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
    note: str = ""
    changed: str = ""  # what stood here before, where that is another thing


@dataclass(frozen=True)
class CheckRow:
    """A check with its verdict."""

    id: str
    mechanism: str
    chapter: str
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
    used: str = ""
    check_class: str = ""
    ratio: float | None = None
    is_sized: bool = False
    is_presumed: bool = False
    missing: tuple[str, ...] = ()
    parts: PartsTable | None = None
    changed: str = ""
    part: str = ""

    @property
    def home(self) -> str:
        """Where it stands: the letter of its chapter; of the many chapters of a machine's parts the name too."""
        return f"{self.chapter} {self.mechanism}" if self.part else self.chapter

    def repeats(self, other: CheckRow) -> bool:
        """Whether it is the check before it, of another part: its words are the same but for the part's name."""
        title, _, part = self.title.partition(": ")
        words = (self.check_class, self.source, self.demand_label, self.limit_label)
        same = (other.check_class, other.source, other.demand_label, other.limit_label)
        return bool(part) and other.title.startswith(f"{title}: ") and words == same and not self.is_sized

    @property
    def is_made(self) -> bool:
        """Whether it judges the machine: neither left unchecked, nor a self-test of the calculation."""
        return self.status != "not_checked" and not self.is_self_test

    @property
    def is_self_test(self) -> bool:
        """Whether it judges the calculation itself."""
        return self.check_class == "numerical"

    @property
    def order(self) -> tuple[int, bool, float]:
        """By what the checks of a report are sorted: what fails first, then the most utilised, what shows no reserve last."""
        known = self.ratio if self.ratio is not None else -math.inf if self.status == "pass" else math.inf
        return STATUSES.index(self.status), self.is_sized or self.is_presumed, -known


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
    title: str = ""
    caption: str = ""
    changed: str = ""
    rows: tuple[ValueRow, ...] = ()
    pair: tuple[Item, ...] = ()


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
    record: MechanismRecord
    assumptions: list[str] = field(default_factory=list)
    between: list[PrintedChapter] = field(default_factory=list)
    inputs: list[QuantityRow] = field(default_factory=list)
    defaults: list[QuantityRow] = field(default_factory=list)  # inputs that a standard report tells in a paragraph
    partners: list[QuantityRow] = field(default_factory=list)  # mechanisms that it found by itself
    taken: list[Any] = field(default_factory=list)  # groups of what it takes from others by itself
    input_parts: list[PartsTable | RecordTable] = field(default_factory=list)
    key_results: list[QuantityRow] = field(default_factory=list)
    outputs: list[QuantityRow] = field(default_factory=list)
    output_parts: list[PartsTable] = field(default_factory=list)
    sections: list[PrintedSection] = field(default_factory=list)
    checks: list[CheckRow] = field(default_factory=list)
    curves: list[PrintedTable] = field(default_factory=list)
    phases: list[PrintedTable] = field(default_factory=list)
    phases_absent: list[str] = field(default_factory=list)
    figures: list[tuple[str, FigureRecord]] = field(default_factory=list)
    pairs: tuple[tuple[str, ...], ...] = ()  # the numbers of figures that stand side by side
    loose: list[Item] = field(default_factory=list)
    files: list[File] = field(default_factory=list)
    absent: list[AbsentRecord] = field(default_factory=list)
    symbols: list[SymbolRow] = field(default_factory=list)
    are_defaults_told: bool = False  # whether some of the defaults are those of that chapter
    is_named: bool = False  # whether its title ends in its name
    is_open: bool = False  # whether something of it is left open
    told_in: str = ""  # the letter of the earlier chapter of the same kind, whose formulas and texts are not repeated
    errata: list[tuple[str, str, str]] = field(default_factory=list)
    parts: dict[str, Heading] = field(default_factory=dict)
    headings: list[Heading] = field(default_factory=list)

    @property
    def lost(self) -> bool:
        """Whether it could not be calculated."""
        return self.record.status in ("error", "skipped")

    def count(self, status: str) -> int:
        """How many checks of the machine have a status."""
        return sum(row.status == status and not row.is_self_test for row in self.checks)

    @property
    def face(self) -> str:
        """The verdict as it is shown: one that does not fail, but leaves something open, is conditional."""
        return "conditional" if self.is_open and self.record.status in ("pass", "warn") else self.record.status


FACES = ("pass", "warn", "conditional", "fail", "skipped", "error")  # from the best to the worst


@dataclass(frozen=True)
class JudgedPart:
    """A row of the first page: a mechanism, or a part of the machine with all calculations that are made of it."""

    chapters: list[PrintedChapter]

    @property
    def title(self) -> str:
        """The chapters' letters with the title of the mechanism, or the name of the part."""
        first, last = self.chapters[0], self.chapters[-1]
        letters = first.letter if first is last else f"{first.letter}–{last.letter}"
        return f"{letters} {first.record.part or first.title}"

    @property
    def anchor(self) -> str:
        """The first of its chapters."""
        return self.chapters[0].anchor

    @property
    def worst_strength(self) -> CheckRow | None:
        """The check of strength or safety that fails first or is most utilised; none where none is made."""
        return self._worst("strength", "safety")

    @property
    def worst_function(self) -> CheckRow | None:
        """The check of function that fails first or is most utilised; none where none is made."""
        return self._worst("function")

    def _worst(self, *classes: str) -> CheckRow | None:
        every = (row for each in self.chapters for row in each.checks if row.is_made and row.check_class in classes)
        return min(every, key=lambda row: row.order, default=None)

    @property
    def counts(self) -> list[int]:
        """How many checks fail, warn, pass, and are not made."""
        return [sum(each.count(status) for each in self.chapters) for status in STATUSES]

    @property
    def face(self) -> str:
        """The worst verdict of its chapters as it is shown."""
        return max((each.face for each in self.chapters), key=FACES.index)


def judged_parts(chapters: Iterable[PrintedChapter]) -> list[JudgedPart]:
    """Return the rows of the first page: chapters of one part together, and none of a comparison without checks."""
    groups: dict[str, list[PrintedChapter]] = {}
    for each in chapters:
        if each.checks or not each.between:
            groups.setdefault(each.record.part or each.anchor, []).append(each)
    return [JudgedPart(each) for each in groups.values()]


def quantity_row(row: QuantityRecord, decimal: str, description: str = "", names: Collection[str] = ()) -> QuantityRow:
    """A quantity of the results as a row of a table; another description may stand for its own."""
    shown = row.display
    return QuantityRow(
        description=description or row.description,
        symbol=symbol(row.symbol),
        value=number(value_in_words(row, names), decimal),
        unit=pretty(shown.unit),
        source=row.source,
        at=place_of(row.at, decimal),
        key=row.path,
        wordy=is_words(shown.text) and not pretty(shown.unit),
        changed=row.before,
    )


def basis_of(row: QuantityRecord, words: Mapping[str, str]) -> str:
    """What an input rests on, in words; nothing where it is only given."""
    return words[row.basis] if row.basis and row.basis != "given" else ""


def rested(shown: QuantityRow, row: QuantityRecord, words: Mapping[str, str]) -> QuantityRow:
    """The row of an input with what it rests on beside where it comes from, and with its note."""
    basis = basis_of(row, words)
    origin = "" if basis and row.origin == "given" else shown.origin
    return replace(shown, origin=", ".join(filter(None, (origin, basis))), note=row.note)


def utilisation(ratio: float | None, status: str, decimal: str) -> str:
    """A utilisation in per cent: as many decimals as show on which side of 100 it lies."""
    if ratio is None:
        return "–"
    percent = 100 * ratio
    digits = 0 if percent >= 1000 else 1
    while digits < 6 and status != "pass" and f"{percent:.{digits}f}" == f"{100:.{digits}f}":
        digits += 1
    return joined(number(f"{percent:.{digits}f}", decimal), "%")


# How steps of one line each share the lines of a sheet: two side by side, or each alone, so that no description stands in a narrow column.


LETTER = 1.55  # mm, of the letters of a description
REFERENCE = 0.86  # how wide letters of what is referred to are, against those
ROOM, WIDEST = 50.0, 19.0  # mm for a description and for its value, in half a line
ALONE = "broad"


def in_lines(rows: Sequence[ValueRow]) -> list[tuple[ValueRow, str]]:
    """Return the rows, each with how it is set: two by two where all of them have room in half a line, else each in a line of its own."""
    is_short = len(rows) > 1 and all(_value(row) <= WIDEST and _said(row) <= ROOM for row in rows)
    return [(row, "" if is_short else ALONE) for row in rows]


def _said(row: ValueRow) -> float:
    letters = sum(len(new.striptags()) + len(old.striptags()) + 10 for new, old in row.letters)
    behind = len(row.refers) + 7 + letters if row.refers else len(row.source) + 1
    return LETTER * (len(row.description) + REFERENCE * (behind + len(row.note)))


def _value(row: ValueRow) -> float:
    place = len(row.at.striptags()) + 4 if row.at else 0
    return LETTER * (len(row.symbol.striptags()) * REFERENCE + len(row.value) + place + 3)


# Steps that do not apply to a machine: those that stand one after the other in one sentence, not in a line each.


def gathered_notes(items: Sequence[ItemRecord | None]) -> list[ItemRecord | None]:
    """Return the steps in their places; the notes of one kind that follow each other stand as one in the first's place."""
    found: list[ItemRecord | None] = []
    for said, group in groupby(items, key=_left_out_said):
        run = list(group)
        if said and len(run) > 1:
            start, names = said.rstrip("."), "; ".join(note.description for note in run if note)
            note = ItemRecord(type="note", text=f"{start[:1].upper()}{start[1:]}: {names}.")
            run = [note, *[None] * (len(run) - 1)]
        found += run
    return found


def under_heading(absent: Sequence[AbsentRecord], heading: str) -> list[AbsentRecord]:
    """Return why parts are absent, without the words of the heading that stands above them; those for one reason in one line."""
    titles: dict[str, list[str]] = {}
    for each in absent:
        titles.setdefault(each.text.removeprefix(f"{heading.lower()}: "), []).append(each.title)
    return [AbsentRecord(title="; ".join(named), text=text) for text, named in titles.items()]


def _left_out_said(item: ItemRecord | None) -> str:
    if item is None or item.type != "note" or not item.text.startswith(name := f"{item.description}: "):
        return ""
    return item.text.removeprefix(name) if item.description else ""
