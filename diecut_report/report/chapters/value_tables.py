"""Steps in one line each: what they give, without a formula, or with the place where it stands that is not printed again."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field

from markupsafe import Markup

from diecut_report.quantities.units import pretty
from diecut_report.report.chapters.printed_tables import DASH, TableCell
from diecut_report.report.chapters.repetition import Parts, Reference
from diecut_report.report.symbols import symbol
from diecut_report.report.text import Catalogue, in_words, number, quantity
from diecut_report.results.mechanism_record import ItemRecord, PlaceRecord, QuantityRecord
from diecut_report.text.phrases import NAMING


@dataclass(frozen=True)
class ValueRow:
    """A step without its formula; ``letters`` are those that take the place of others in the formula that ``refers`` numbers."""

    number: str
    description: str
    symbol: Markup
    value: str
    at: Markup = field(default_factory=Markup)
    source: str = ""
    refers: str = ""
    letters: tuple[tuple[Markup, Markup], ...] = ()
    note: str = ""
    changed: str = ""

    def named_formula(self, words: Catalogue, *, linked: bool = False) -> Markup:
        """Where the formula stands that is not printed again, and which letters take the place of others in it."""
        number = Markup('<a href="#eq-{0}">{0}</a>').format(self.refers) if linked else self.refers
        letters = ", ".join(words.say("letter_for", new=new, old=old) for new, old in self.letters)
        key = "as_formula_with" if letters else "as_formula"
        return Markup(words.say(key, number=number, letters=letters))  # words of the catalogue, and symbols


def place_of(at: PlaceRecord | None, decimal: str) -> Markup:
    """Return the place at which a value is taken, as it is printed beside it; nothing where there is none."""
    return symbol(at.symbol) + f" = {quantity(at.text, at.unit, decimal)}" if at else Markup("")


def value_row(
    item: ItemRecord, step: str, refers: Reference | None, note: str, decimal: str, names: Collection[str] = ()
) -> ValueRow:
    """A step of the results in one line."""
    result = item.outcome
    return ValueRow(
        number=step,
        description=item.description,
        symbol=symbol(item.symbol),
        value=quantity(in_words(result.text, names), result.unit, decimal),
        at=place_of(item.at, decimal),
        source="" if refers else item.source,
        refers=refers.number if refers else "",
        letters=tuple((symbol(new), symbol(old)) for new, old in refers.letters) if refers else (),
        note=note,
        changed=item.before,
    )


def listed_row(table: ItemRecord, decimal: str) -> ValueRow:
    """A table of one quantity of numbered parts in one line."""
    column = table.columns[1]
    numbers = [number(row[1], decimal) for row in table.rows]
    value = quantity("", column.unit) if column.unit != "1" else ""
    return ValueRow("", table.title, symbol(column.symbol), "; ".join(numbers) + value)


# Inputs of a few repeated parts: a line for each quantity and a column for each part, so that what is said of a quantity has room.


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


def record_rows(parts: Parts, cell: Callable[[QuantityRecord], TableCell]) -> tuple[list[str], list[RecordRow]]:
    """Return the heads of the columns and the lines, each value as a cell."""
    heads = [str(number) for number in parts.numbers]
    lines = []
    for head, first in parts.heads:
        given = [parts.columns[head].get(number) for number in parts.numbers]
        names = {str(each[1].value): None for each in given if each} if head in NAMING else {}
        if len(names) == len(given):
            heads = list(names)
        else:
            lines.append((head, first, [cell(each[1]) if each else TableCell(DASH) for each in given]))
    return heads, [_row(*line, heads) for line in lines]


def _row(quantity: str, first: QuantityRecord, cells: list[TableCell], heads: list[str]) -> RecordRow:
    """A line, and behind it what is to be said of its values: of all alike once, at length of each with its name."""
    said = [(head, cell.note) for head, cell in zip(heads, cells, strict=True) if cell.text != DASH]
    notes = {note for _, note in said}
    if len(notes) == 1:
        note = notes.pop()
    else:
        is_long = any(len(note) > SHORT for note in notes)
        note = "\n".join(_named(said)) if is_long else ""
    kept = [TableCell(cell.text, "", cell.wordy, cell.changed) for cell in cells] if note else cells
    unit = pretty(first.display.unit)
    return RecordRow(first.description, symbol(first.symbol), unit, quantity, kept, note)


def _named(said: Sequence[tuple[str, str]]) -> Iterator[str]:
    for note in dict.fromkeys(note for _, note in said if note):
        yield f"{', '.join(head for head, other in said if other == note)}: {note}"
