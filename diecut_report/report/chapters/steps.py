"""The steps of a chapter: sections with formulas, values in lines, tables and figures, numbered as they stand on the page."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any, NamedTuple

from diecut_report.quantities.formatting import is_nothing
from diecut_report.report.chapters.repetition import SaidOnce, ToldBefore
from diecut_report.report.chapters.tables import SectionTablesColumn, Tables, brought_together, is_in_line
from diecut_report.report.chapters.value_tables import ValueRow, listed_row, value_row
from diecut_report.report.equations import Equations
from diecut_report.report.model import Heading, Item, PrintedSection, gathered_notes
from diecut_report.report.text import Catalogue, in_words, is_words, quantity
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import ItemRecord, MechanismRecord, SectionRecord
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


Row = tuple[Placed, ...]  # a figure, or two side by side in the place of the second


def rows_of(figures: list[Placed], *, paired: bool) -> list[Row]:
    """Return the figures in their order, alone or (``paired``) two by two: the first waits for the second, which stands near."""
    found: list[Row] = []
    waiting: Placed | None = None
    for each in figures:
        is_narrow = paired and _is_narrow(each.figure)
        if waiting and is_narrow and each.place.section - waiting.place.section <= NEAR:
            found.append((waiting, each))
            waiting = None
            continue
        found += [(waiting,)] if waiting else []
        waiting = each if is_narrow else None
        found += [] if waiting else [(each,)]
    return found + ([(waiting,)] if waiting else [])


def _is_narrow(figure: FigureRecord) -> bool:
    """Whether a figure can be drawn half as wide as a sheet: it has few diagrams, no bars, no scheme of boxes, no long legend, few names within."""
    longest = [sum(map(len, _labels(panel.lines, panel.fills, panel.series))) for panel in figure.panels]
    longest += [sum(len(label) + VALUE for label in _labels(panel.marks)) for panel in figure.panels]
    lines = [len(_labels(panel.lines, panel.series)) for panel in figure.panels]  # that a legend names
    notes = [len(_labels(panel.marks, panel.levels, panel.verticals, panel.fills)) for panel in figure.panels]
    is_small = len(figure.panels) < MANY and max(lines, default=0) <= MOST_LINES and max(notes, default=0) <= MOST_NOTES
    return is_small and figure.type != "bars" and not figure.schematic and max(longest, default=0) <= LONGEST_LEGEND


def _labels(*parts: Sequence[Any]) -> list[str]:
    return [each.label for several in parts for each in several if each.label]


def row_item(row: Row) -> Item:
    """A figure, or two, among the steps."""
    items = [Item("figure", number=n, title=each.title, caption=each.caption) for _, n, each in row]
    return items[0] if len(items) == 1 else Item("pair", pair=tuple(items))


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
    """Prints sections; but in a report with all nothing is printed twice, and what has no formula stands in lines."""

    def __init__(
        self, letter: str, equations: Equations, words: Catalogue, tables: Tables, figures: Sequence[Row], told: ToldBefore
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
        self.told.begin(section.items)
        steps = self._figures(Place(index, BEFORE))
        items = section.items if self.told.is_full else gathered_notes(brought_together(section, self.columns))
        for place, item in enumerate(items):
            steps += [] if item is None else list(self._step(item, notes))
            steps += self._figures(Place(index, place))
        text = "".join(self.told.new([section.text]))
        places = [f"{at.symbol} = {quantity(at.text, at.unit, self.decimal)}" for at in section.shown]
        shown = self.words.say("shown_at", places=self.words.listed(places)) if places else ""
        return PrintedSection(heading, text, _gathered(steps), shown)

    def _figures(self, place: Place) -> list[_PrintedStep]:
        return [_PrintedStep(row_item(row)) for row in self.figures if row[-1].place == place]

    def _step(self, item: ItemRecord, notes: set[str]) -> Iterator[_PrintedStep]:
        if item.type == "note":
            yield from (_PrintedStep(Item("note", text=text)) for text in self.told.new([item.text]))
        elif item.type == "table" and is_in_line(item) and not self.told.is_full:
            yield _PrintedStep(Item("note"), listed_row(item, self.decimal), is_told=True)
        elif item.type == "table":
            yield _PrintedStep(Item("table", table=self.tables.of_item(item)))
        else:
            self.formulas += 1
            number = f"{self.letter}.{self.formulas}"
            self.given.setdefault(item.symbol, number)
            yield self._formula(item, notes, number)

    def _formula(self, item: ItemRecord, notes: set[str], number: str) -> _PrintedStep:
        refers = self.told.find(item)
        if refers is None:
            self.told.keep(item, number)
            printed = self._item(item, notes, number)
            is_line = _is_bare(item) and not printed.notes and not self.told.is_full
            row = value_row(item, number, None, "", self.decimal, self.tables.names) if is_line else None
            return _PrintedStep(printed, row)
        self.told.keep_named(item, refers)
        note = " ".join(self._said_beside(item, notes))
        row = value_row(item, number, refers, note, self.decimal, self.tables.names)
        return _PrintedStep(Item("note"), row, is_told=True)

    def _said_beside(self, item: ItemRecord, notes: set[str]) -> Iterator[str]:
        yield from filter(None, [item.table_rows])
        if item.series and item.note.startswith(item.series):  # which is told once for all chapters of a kind
            yield from self.told.new([item.note])
        elif item.note:
            yield from self._each_once(item.note, notes)

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
            choice = worded(item.key)
            told = (
                self.words.say("looked_up", table=item.table, choice=choice) if item.table else f"{item.by}: {choice}"
            )
            yield from self._each_once(told, notes)
        if item.series and not item.note.startswith(item.series):
            yield from self.told.new([f"{self.words['series']}: {item.series}"])
        is_picked = item.type == "reduction" and item.operation == "pick"
        if self.told.is_full or item.chosen or is_picked:  # why this value and no other is never told elsewhere
            yield from self._proof(item, notes)
        yield from self.said.conversions(item)
        yield from self._said_beside(item, notes)
        if len(item.source) > LONGEST_SOURCE:
            yield f"{self.words['source']}: {item.source}"

    def _each_once(self, note: str, notes: set[str]) -> Iterator[str]:
        """A note, where the section has not said it; a report with all says it at each step."""
        if self.told.is_full or note not in notes:
            notes.add(note)
            yield note

    def _proof(self, item: ItemRecord, notes: set[str]) -> Iterator[str]:
        method, residual = item.method, item.residual
        if method and method not in notes:
            notes.add(method)
            yield f"{self.words['method']}: {method}"
        if residual and residual.text != UNPRINTED_RESIDUAL:
            is_rounding = not is_words(residual.text) and is_nothing(float(residual.text), residual.unit)
            key = ("residual" if item.type == "found" else "checked_to") + ("_rounded" if is_rounding else "")
            yield self.words.say(key, residual=quantity(residual.text, residual.unit, self.decimal))


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
