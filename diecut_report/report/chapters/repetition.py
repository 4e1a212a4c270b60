"""What is said of a formula where it is first needed in a chapter: what its names stand for, how its units are converted."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from diecut_report.quantities.formatting import is_nothing
from diecut_report.report.equations import Equation, Equations
from diecut_report.report.mathematics import letters_of
from diecut_report.report.text import Catalogue, quantity
from diecut_report.results.figure_record import FigureRecord, Panel
from diecut_report.results.mechanism_record import (
    CurveRecord,
    ItemRecord,
    MechanismRecord,
    QuantityRecord,
    SectionRecord,
)


class SaidOnce:
    """Remembers what a chapter has said already."""

    def __init__(self, equations: Equations, words: Catalogue) -> None:
        self.equations, self.words = equations, words
        self.said: set[str] = set()

    def definitions(self, item: ItemRecord) -> Iterator[Equation]:
        """What names in the formula stand for, where that was not said already."""
        found = {equation.text: equation for equation in self.equations.definitions(item)}
        yield from (found[text] for text in self._new(found))

    def condition(self, item: ItemRecord) -> Equation | None:
        """Return the condition of the branch taken, with its numbers, where it says something and the chapter has not shown it already."""
        match item.condition_substituted:
            case ["cmp", "==", ["qty" | "num", left, *_], ["qty" | "num", right, *_]] if item.words and left == right:
                return None  # a flag that is 1
        equation = self.equations.condition(item)
        is_new = equation and [*self._new([f"{item.words}: {equation.text}"])]
        return equation if is_new or not item.words else None

    def conversions(self, item: ItemRecord) -> Iterator[str]:
        """How numbers of the formula follow from what stands elsewhere in another unit, where that was not said already."""
        decimal, told = self.words["decimal"], []
        for each in item.conversions:
            own, converted = (quantity(side.text, side.unit, decimal) for side in (each.shown, each.converted))
            told.append(f"{each.symbol} = {own} = {converted}")
        if new := [*self._new(told)]:
            yield f"{self.words['where']} {self.words.listed(new)}"

    def _new(self, texts: Iterable[str]) -> Iterator[str]:
        for text in texts:
            if text not in self.said:
                yield text
            self.said.add(text)


# What a reader has been told already: formulas of this chapter, and all of an earlier chapter of the same kind. Nothing is printed twice.


SAME = (
    "type", "symbol", "equation", "relation", "condition", "words", "operation", "of", "method", "key", "column", "table", "by", "where",
)  # fmt: skip
FEWEST = 5  # operations of a formula that is rather named than printed again with other letters
MANY = 7  # formulas of one form in a section, of which a short one, too, is printed once: the ratios of drives that are compared
MOST_LETTERS = 4  # that differ


class Reference(NamedTuple):
    """Where a formula stands, and which letters take the place of which there."""

    number: str
    letters: tuple[tuple[str, str], ...] = ()


_Known = tuple[str, ItemRecord, tuple[str, ...]]  # a formula's number, its step, its letters in their order


@dataclass
class ToldBefore:
    """Remembers the formulas, texts and symbols of a chapter; ``letter`` is that of the earlier chapter of the same kind.

    In a report with all (``is_full``) everything is told again.
    """

    letter: str = ""
    is_full: bool = False
    steps: dict[str, _Known] = field(default_factory=dict)
    named: dict[str, tuple[ItemRecord, Reference]] = field(default_factory=dict)  # steps that only name their formula
    texts: set[str] = field(default_factory=set)
    shapes: dict[str, _Known] = field(default_factory=dict)
    repeated: set[str] = field(default_factory=set)  # forms of short formulas that fill the section

    def begin(self, items: Sequence[ItemRecord]) -> None:
        """Learn which short formulas fill the section that begins."""
        counted = Counter(_shape(item)[0] for item in items)
        self.repeated = {shape for shape, count in counted.items() if shape and count >= MANY}

    def next(self, letter: str) -> ToldBefore:
        """What is known when another chapter of this kind begins; ``letter`` is this one's."""
        return ToldBefore(self.letter or letter, self.is_full, dict(self.steps), dict(self.named), set(self.texts))

    def find(self, item: ItemRecord) -> Reference | None:
        """Where the same step of an earlier chapter stands, or the same formula of this one."""
        if self.is_full:
            return None
        before, named = self.steps.get(item.id), self.named.get(item.id)
        if before and _are_same(before[1], item):
            return Reference(before[0])
        if named and _are_same(named[0], item):
            return named[1]
        shape, letters = self._named_form(item)
        if shape not in self.shapes:
            return None
        number, _, known = self.shapes[shape]
        differing = tuple(pair for pair in zip(letters, known, strict=True) if pair[0] != pair[1])
        is_plain = not {new for new, _ in differing} & {old for _, old in differing}  # no letters change places
        return Reference(number, differing) if is_plain and len(differing) <= MOST_LETTERS else None

    def keep(self, item: ItemRecord, number: str) -> None:
        """Remember a step that is printed."""
        shape, letters = self._named_form(item)
        if item.id:
            self.steps.setdefault(item.id, (number, item, letters))
        if shape:
            self.shapes.setdefault(shape, (number, item, letters))

    def _named_form(self, item: ItemRecord) -> tuple[str, tuple[str, ...]]:
        """The form of a formula and its letters, where it is rather named than printed again."""
        shape, letters = _shape(item)
        is_named = shape in self.repeated or (shape and _operations(item.equation) >= FEWEST)
        return (shape, letters) if is_named else ("", ())

    def keep_named(self, item: ItemRecord, reference: Reference) -> None:
        """Remember a step of which only is said where its formula stands: the next chapter says the same."""
        if item.id and item.id not in self.steps:
            self.named.setdefault(item.id, (item, reference))

    def new(self, texts: Sequence[str]) -> list[str]:
        """Those of the texts that were not told; they are now."""
        found = [text for text in texts if self.is_full or text not in self.texts]
        self.texts.update(texts)
        return found


def _are_same(one: ItemRecord, other: ItemRecord) -> bool:
    return all(getattr(one, key) == getattr(other, key) for key in SAME)


def _shape(item: ItemRecord) -> tuple[str, tuple[str, ...]]:
    tree = item.equation
    if item.type != "formula" or not tree or item.where:
        return "", ()
    letters = tuple(dict.fromkeys(letters_of(tree)))
    places = {letter: index for index, letter in enumerate(letters)}
    return json.dumps(_numbered(tree, places), ensure_ascii=False), letters


def _numbered(tree: Any, places: Mapping[str, int]) -> Any:
    match tree:
        case ["sym", letter]:
            return places[letter]
        case list():
            return [_numbered(part, places) for part in tree]
    return tree


def _operations(tree: Any) -> int:
    if not isinstance(tree, list) or tree[:1] in (["sym"], ["num"], ["qty"]):
        return 0
    return (isinstance(tree[0], str) if tree else 0) + sum(_operations(part) for part in tree)


# Quantities of repeated parts (``gears.0.driver_teeth``, ``shaft_3_speed``) gathered, to be printed with a line for each part.


REPEATED_PARTS_FEWEST = 3  # parts of results that make a table; fewer stay single lines
FEWEST_GIVEN = 2  # parts of a list of the inputs


@dataclass
class Parts:
    """A table: for each part (counted as in print) its quantities by their ids in the results; a ``listed`` family is a list."""

    family: str
    numbers: list[int]
    listed: bool = True
    columns: dict[str, dict[int, tuple[str, QuantityRecord]]] = field(default_factory=dict)

    @property
    def heads(self) -> Iterator[tuple[str, QuantityRecord]]:
        """Each column's quantity, and a row of the results that says what it is."""
        return ((quantity, next(iter(rows.values()))[1]) for quantity, rows in self.columns.items())

    def without(self, quantities: Collection[str]) -> Parts:
        """The table without some of its quantities."""
        left = {quantity: rows for quantity, rows in self.columns.items() if quantity not in quantities}
        return Parts(self.family, self.numbers, self.listed, left)

    def add(self, name: str, row: QuantityRecord) -> None:
        """Put a row of the results into its place."""
        assert row.part is not None, "only what is of repeated parts is gathered"
        number = number_of(row)
        self.columns.setdefault(row.part.quantity or row.part.family, {})[number] = (name, row)
        self.numbers = sorted({*self.numbers, number})


def number_of(row: QuantityRecord) -> int:
    """Return the number of a row's part in print: the one in its name, or of a list counted from 1."""
    assert row.part is not None, "only what is of repeated parts has a number"
    return row.part.index + 1 if row.part.number is None else row.part.number


def gathered(
    rows: Mapping[str, QuantityRecord], fewest: int = REPEATED_PARTS_FEWEST
) -> tuple[dict[str, QuantityRecord], list[Parts]]:
    """Return the lone quantities, and tables of those of at least so many repeated parts, of a single quantity of at least three."""
    least = max(fewest, REPEATED_PARTS_FEWEST)
    tables = [table for table in _tables(rows) if len(table.numbers) >= (fewest if len(table.columns) > 1 else least)]
    told = {name for table in tables for column in table.columns.values() for name, _ in column.values()}
    return {name: row for name, row in rows.items() if name not in told}, tables


def _tables(rows: Mapping[str, QuantityRecord]) -> list[Parts]:
    tables: dict[tuple[str, bool], Parts] = {}
    for name, row in rows.items():
        if not row.part:
            continue
        family, listed = row.part.family, not row.part.number
        is_alone = listed and not row.part.quantity  # a path of its own, not in a list that could be named
        table = tables.setdefault((family, listed), Parts("" if is_alone else family, [], listed))
        table.add(name, row)
    return list(tables.values())


def counted(rows: Mapping[str, QuantityRecord]) -> dict[str, int]:
    """Return the numbers of the parts, as in print, of all quantities that share their description with another one."""
    said = Counter(row.description for row in rows.values())
    return {name: number_of(row) for name, row in rows.items() if row.part and said[row.description] > 1}


# Diagrams in which all is zero: a sentence says that, and nothing is drawn.


def without_zero_diagrams(mechanism: MechanismRecord, words: Catalogue) -> MechanismRecord:
    """Return a mechanism whose figures draw what is not zero everywhere; what is stands as a sentence in the caption, or as a note."""
    figures: list[FigureRecord] = []
    notes: list[tuple[FigureRecord, ItemRecord]] = []
    for figure in mechanism.figures:
        flat = [panel for panel in figure.panels if _is_flat(panel, mechanism.curves)]
        left = [panel for panel in figure.panels if panel not in flat]
        told = words.say("zero_everywhere", names="; ".join(dict.fromkeys(panel.title for panel in flat)))
        if flat and not left:
            notes.append((figure, ItemRecord(type="note", text=told)))
        elif flat:
            figures.append(figure.with_(panels=left, caption=f"{figure.caption} {told}"))
        else:
            figures.append(figure)
    return mechanism.with_(figures=figures, sections=_noted(mechanism.sections, notes))


def _is_flat(panel: Panel, curves: Mapping[str, CurveRecord]) -> bool:
    """Whether all lines of a diagram are zero, and nothing else stands in it."""
    if not panel.title or panel.levels or panel.marks or panel.verticals or panel.fills:
        return False
    rows: list[Sequence[float | None]] = [curves[series.curve].values for series in panel.series]
    rows += [line.y for line in panel.lines]
    return bool(rows) and all(is_nothing(value, panel.unit) for row in rows for value in row if value is not None)


def _noted(sections: Sequence[SectionRecord], notes: Sequence[tuple[FigureRecord, ItemRecord]]) -> list[SectionRecord]:
    items = [list(section.items) for section in sections]
    for figure, note in notes:
        places = [(own, index + 1) for own in items for index, item in enumerate(own) if item.id in figure.shows]
        if places:
            own, index = places[-1]
            own.insert(index, note)
    return [section.with_(items=own) for section, own in zip(sections, items, strict=True)]
