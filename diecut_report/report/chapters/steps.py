"""The steps of a chapter: sections with formulas, values in lines, tables and figures, numbered as they stand on the page."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any, NamedTuple

from diecut_report.quantities.formatting import is_nothing
from diecut_report.report.chapters.repetition import Reference, SaidOnce, ToldBefore
from diecut_report.report.chapters.tables import SectionTablesColumn, Tables, brought_together
from diecut_report.report.chapters.value_tables import ValueRow, listed_row, value_row
from diecut_report.report.equations import Equations
from diecut_report.report.model import Heading, Item, ListedNumbers, PrintedSection, Step, gathered_notes
from diecut_report.report.text import Catalogue, in_words, is_words, quantity
from diecut_report.results.figure_record import FigureRecord, Panel
from diecut_report.results.mechanism_record import ItemRecord, MechanismRecord, PlaceRecord, SectionRecord, ShownRecord
from diecut_report.text.phrases import worded

# Where the figures of a chapter stand: after the step that gives what they show, numbered in that order.


BEFORE = -1  # the first step of a section
NEAR = 2  # sections later a figure may stand, beside another one
MOST_NOTES = 3  # within a diagram that has room for them over half the width
MOST_LINES = 6  # of a diagram over half the width, whose legend would else be higher than the diagram
LONGEST_LEGEND = 110  # letters in the names of a diagram's lines, or of its marks, that have room over half the width
MANY = 4  # diagrams of one figure, which stand two by two over the whole width
SKETCHED_TEXTS = 12  # of a drawing that is legible as a sketch
VALUE = 16  # letters of the numbers behind the name of a mark


class Place(NamedTuple):
    """The section and the step that a figure follows."""

    section: int
    step: int


class Placed(NamedTuple):
    """A figure with its number and its place."""

    place: Place
    number: str
    figure: FigureRecord


def placed(letter: str, mechanism: MechanismRecord) -> list[Placed]:
    """Return the figures of a mechanism in the order of the printed page."""
    given = {item.id: Place(section, step) for section, part in enumerate(mechanism.sections)
             for step, item in enumerate(part.items) if item.id}  # fmt: skip
    last = Place(len(mechanism.sections) - 1, len(mechanism.sections[-1].items) - 1) if given else Place(0, BEFORE)
    found = sorted(((_place(figure, given, last), figure) for figure in mechanism.figures), key=lambda pair: pair[0])
    return [Placed(place, f"{letter}.{n}", figure) for n, (place, figure) in enumerate(found, 1)]


def _place(figure: FigureRecord, given: Mapping[str, Place], last: Place) -> Place:
    """The section that gives most of what a figure shows, the last of them, and there the last step that does.

    A figure of inputs alone stands before the calculation if it is a drawing, any other after it.
    """
    places = [given[name] for name in figure.shows if name in given]
    if not places:
        return Place(0, BEFORE) if figure.type == "drawing" else last
    counts = Counter(place.section for place in places)
    section = max(counts, key=lambda number: (counts[number], number))
    return max(place for place in places if place.section == section)


class Row(NamedTuple):
    """A figure, or two side by side, and the place that they follow."""

    place: Place
    figures: tuple[Placed, ...]


def rows_of(figures: list[Placed], *, paired: bool) -> list[Row]:
    """Return the figures in their order, alone or (``paired``) two by two: the first waits for the second, which stands near."""
    found: list[Row] = []
    waiting: Placed | None = None
    for each in figures:
        is_narrow = paired and _is_narrow(each.figure)
        if waiting and is_narrow and _are_near(waiting.place, each.place):
            found.append(Row(each.place, (waiting, each)))
            waiting = None
            continue
        found += [Row(waiting.place, (waiting,))] if waiting else []
        waiting = each if is_narrow else None
        found += [] if waiting else [Row(each.place, (each,))]
    return found + ([Row(waiting.place, (waiting,))] if waiting else [])


def _is_narrow(figure: FigureRecord) -> bool:
    """Whether a figure can be drawn half as wide as a sheet: it has few diagrams, no bars, no scheme of boxes, no long legend, few names within."""
    names = [sum(map(len, _labels(panel.lines, panel.fills, panel.series))) for panel in figure.panels]
    marked = [sum(len(label) + VALUE for label in _labels(panel.marks)) for panel in figure.panels]
    is_large = len(figure.panels) >= MANY or _most_lines(figure) > MOST_LINES
    if figure.type == "bars" or figure.schematic or is_large:
        return False
    longest, most = max([*names, *marked], default=0), max(map(_notes, figure.panels), default=0)
    return longest <= LONGEST_LEGEND and most <= MOST_NOTES


def _most_lines(figure: FigureRecord) -> int:
    """How many lines a diagram of the figure has that a legend names."""
    return max((len(_labels(panel.lines, panel.series)) for panel in figure.panels), default=0)


def _notes(panel: Panel) -> int:
    """How many names stand within a diagram, beside those of its lines."""
    return len(_labels(panel.marks, panel.levels, panel.verticals, panel.fills))


def _labels(*parts: Sequence[Any]) -> list[str]:
    """The names of parts of a diagram."""
    return [each.label for several in parts for each in several if each.label]


def _are_near(one: Place, other: Place) -> bool:
    return other.section - one.section <= NEAR


def figures_at(rows: Sequence[Row], place: Place) -> Iterator[Item]:
    """The figures that stand at a place."""
    for row in rows:
        if row.place == place:
            yield row_item(row)


def row_item(row: Row) -> Item:
    """A figure, or two, among the steps."""
    items = tuple(
        Item("figure", number=each.number, title=each.figure.title, caption=each.figure.caption) for each in row.figures
    )
    return items[0] if len(items) == 1 else Item("pair", pair=items)


def sketch(figures: list[Placed]) -> list[Placed]:
    """Return the one figure of a mechanism that a brief report shows: a drawing of few texts, if one can be to scale; others would be too small."""
    drawn = [each for each in figures if each.figure.type == "drawing" and len(each.figure.texts) <= SKETCHED_TEXTS]
    to_scale = [each for each in drawn if not each.figure.schematic]
    return (to_scale or drawn)[:1]


UNPRINTED_RESIDUAL = "0"
LONGEST_SOURCE = 80  # letters; a longer one stands below the result
WORDLESS = ("found", "reduction", "lookup")  # their result is always typeset


class _PrintedStep(NamedTuple):
    """A printed step; in one line it is ``row``, and has to be where its formula is not printed again."""

    item: Item
    row: ValueRow | None = None
    is_told: bool = False


class PrintedSteps:
    """Prints sections; where ``told`` is given nothing is printed twice, and what has no formula stands in lines."""

    def __init__(
        self, letter: str, equations: Equations, words: Catalogue, tables: Tables, figures: Sequence[Row],
        told: ToldBefore | None,
    ) -> None:  # fmt: skip
        self.letter, self.equations, self.words, self.tables = letter, equations, words, tables
        self.figures, self.told = figures, told
        self.decimal = words["decimal"]
        self.formulas = 0
        self.given: dict[str, str] = {}  # the numbers of the steps by the symbols that they give
        self.said = SaidOnce(equations, words)
        self.columns: set[SectionTablesColumn] = set()  # that tables have told
        self.reason = ""  # of the branch that is named beside the step before

    def section(self, index: int, section: SectionRecord, heading: Heading) -> PrintedSection:
        """A section with its figures."""
        notes: set[str] = set()
        if self.told is not None:
            self.told.begin(section.items)
        steps = [_PrintedStep(item) for item in figures_at(self.figures, Place(index, BEFORE))]
        for place, item in enumerate(
            section.items if self.told is None else gathered_notes(brought_together(section, self.columns))
        ):
            steps += [] if item is None else list(self._step(item, notes))
            steps += [_PrintedStep(each) for each in figures_at(self.figures, Place(index, place))]
        return PrintedSection(heading, self._text(section), _gathered(steps), self._shown(section.shown))

    def _text(self, section: SectionRecord) -> str:
        text: str = section.text
        return text if self.told is None or not text else "".join(self.told.new([text]))

    def _shown(self, places: Sequence[PlaceRecord]) -> str:
        """Where the curves of a section are shown, in words."""
        told = [f"{at.symbol} = {quantity(at.text, at.unit, self.decimal)}" for at in places]
        return self.words.say("shown_at", places=self.words.listed(told)) if told else ""

    def _step(self, item: Step, notes: set[str]) -> Iterator[_PrintedStep]:
        if isinstance(item, ListedNumbers):
            yield _PrintedStep(Item("note"), listed_row(item.table, self.decimal), is_told=True)
        elif item.type == "note":
            if self.told is None or self.told.new([item.text]):
                yield _PrintedStep(Item("note", text=item.text))
        elif item.type == "table":
            yield _PrintedStep(Item("table", table=self.tables.of_item(item)))
        else:
            self.formulas += 1
            number = f"{self.letter}.{self.formulas}"
            self.given.setdefault(item.symbol, number)
            yield self._formula(item, notes, number)

    def _formula(self, item: ItemRecord, notes: set[str], number: str) -> _PrintedStep:
        """A step with its formula, unless that stands elsewhere."""
        told = self.told
        if told is None:
            return _PrintedStep(self._item(item, notes, number))
        refers = told.find(item)
        if refers is None:
            told.keep(item, number)
            printed = self._item(item, notes, number)
            return _PrintedStep(printed, self._line(item, number) if _is_bare(item) and not printed.notes else None)
        told.keep_named(item, refers)
        return _PrintedStep(
            Item("note"), self._line(item, number, refers, " ".join(self._said_beside(item, notes))), is_told=True
        )

    def _line(self, item: ItemRecord, number: str, refers: Reference | None = None, note: str = "") -> ValueRow:
        return value_row(item, number, refers, note, self.decimal, self.tables.names)

    def _said_beside(self, item: ItemRecord, notes: set[str]) -> Iterator[str]:
        """The rows of a table between which a number lies, and a note."""
        yield from filter(None, (item.table_rows, self._new_note(item, notes)))

    def _new_note(self, item: ItemRecord, notes: set[str]) -> str:
        """The note of a step, where the section has not said it; a report with all says it at each step."""
        note: str = item.note
        if self.told is None:
            return note
        if item.series and note.startswith(
            item.series
        ):  # where standard values stand is told once for all chapters of a kind
            return "".join(self.told.new([note]))
        is_new = note not in notes
        notes.add(note)
        return note if is_new else ""

    def _item(self, item: ItemRecord, notes: set[str], number: str) -> Item:
        source = item.source if len(item.source) <= LONGEST_SOURCE else ""
        condition, words = self.said.condition(item), item.words
        reason = words if words and item.condition and condition is None else ""
        if reason:  # which was told; it is named beside the first of the steps that follow
            source, words = " · ".join(filter(None, (source, reason if reason != self.reason else ""))), ""
        self.reason = reason
        return Item(
            item.type,
            number=number,
            description=item.description,
            source=source,
            equation=self.equations.of(item),
            condition=condition,
            definitions=tuple(self.said.definitions(item)),
            words=words,
            text="" if item.equation or item.type in WORDLESS else in_words(item.outcome.text, self.tables.names),
            notes=tuple(self._notes(item, notes)),
            changed=item.before,
        )

    def _notes(self, item: ItemRecord, notes: set[str]) -> Iterator[str]:
        """The method, where it was not said already in this section, what proves the value, and a note."""
        if item.type == "lookup":
            yield from self._each_once(self._looked_up(item), notes)
        if item.series and not item.note.startswith(item.series):
            yield from self._new([f"{self.words['series']}: {item.series}"])
        if self.told is None or _is_chosen(item):  # why this value and no other is never told elsewhere
            yield from self._proof(item, notes)
        yield from self.said.conversions(item)
        yield from self._said_beside(item, notes)
        if len(item.source) > LONGEST_SOURCE:
            yield f"{self.words['source']}: {item.source}"

    def _each_once(self, note: str, notes: set[str]) -> Iterator[str]:
        """A note, where the section has not said it; a report with all says it at each step."""
        if self.told is None or note not in notes:
            notes.add(note)
            yield note

    def _new(self, texts: Sequence[str]) -> Sequence[str]:
        """Those of the texts that no chapter of this kind has said; a report with all says them at each step."""
        return texts if self.told is None else self.told.new(texts)

    def _proof(self, item: ItemRecord, notes: set[str]) -> Iterator[str]:
        method, residual = item.method, item.residual
        if method and method not in notes:
            notes.add(method)
            yield f"{self.words['method']}: {method}"
        if residual and residual.text != UNPRINTED_RESIDUAL:
            key = "residual" if item.type == "found" else "checked_to"
            key += "_rounded" if _is_rounding(residual) else ""
            yield self.words.say(key, residual=quantity(residual.text, residual.unit, self.decimal))

    def _looked_up(self, item: ItemRecord) -> str:
        """Where a number was taken from: the table's title, and the text that chose it."""
        if item.table:
            return self.words.say("looked_up", table=item.table, choice=worded(item.key))
        return f"{item.by}: {worded(item.key)}"


def _is_rounding(residual: ShownRecord) -> bool:
    """Return whether what is left of an equation is but the rounding of the computer."""
    return not is_words(residual.text) and is_nothing(float(residual.text), residual.unit)


def _is_chosen(item: ItemRecord) -> bool:
    """Return whether a value was taken from a series, or sought in the place of one that may be given."""
    return bool(item.chosen or (item.type == "reduction" and item.operation == "pick"))


def _is_bare(item: ItemRecord) -> bool:
    """Whether a step gives a value and nothing else: it has no formula, branch or table that it comes from."""
    is_found = item.type == "found" and not item.relation and not item.equation
    return is_found and not item.words and len(item.source) <= LONGEST_SOURCE


def _gathered(steps: list[_PrintedStep]) -> list[Item]:
    """The steps as items, those that stand in one line gathered into lists; a lone value keeps its place among formulas."""
    found: list[Item] = []
    for in_line, group in groupby(steps, key=lambda step: step.row is not None):
        run = list(group)
        if in_line and (len(run) > 1 or run[0].is_told):
            found.append(Item("values", rows=tuple(step.row for step in run if step.row)))
        else:
            found += [step.item for step in run]
    return found


# Captions of a chapter's figures: a long sentence that an earlier one has said is not said again.


BETWEEN = re.compile(r"(?<=[.!?]) (?=[^\W\d_])")  # of sentences
LONG = 80  # letters; a shorter one, as what is shaded, stands with each figure


def told_once(figures: Sequence[Placed]) -> Iterator[Placed]:
    """Yield the figures in their order, each caption without the long sentences of those before it."""
    told: set[str] = set()
    for each in figures:
        sentences = BETWEEN.split(each.figure.caption)
        left = [text for text in sentences if text not in told]
        told.update(text for text in sentences if len(text) >= LONG)
        yield each._replace(figure=each.figure.with_(caption=" ".join(left)))
