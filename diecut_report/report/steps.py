"""The steps of a chapter: sections with formulas, values in lines, tables and figures, numbered as they stand on the page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any, NamedTuple

from diecut_report.languages.tokens import worded
from diecut_report.quantities.display import is_nothing
from diecut_report.report.equations import Equations
from diecut_report.report.figure_places import BEFORE, Place, Row, figures_at
from diecut_report.report.given_names import in_words
from diecut_report.report.i18n import Catalogue
from diecut_report.report.left_out import gathered_notes
from diecut_report.report.model import Heading, Item, PrintedSection
from diecut_report.report.number_format import is_words, quantity
from diecut_report.report.said_once import SaidOnce
from diecut_report.report.section_tables import Column, brought_together
from diecut_report.report.tables import Tables
from diecut_report.report.told_before import Reference, ToldBefore
from diecut_report.report.value_rows import ValueRow, listed_row, value_row

Data = Mapping[str, Any]
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
        self.columns: set[Column] = set()  # that tables have told
        self.reason = ""  # of the branch that is named beside the step before

    def section(self, index: int, section: Data, heading: Heading) -> PrintedSection:
        """A section with its figures."""
        notes: set[str] = set()
        if self.told is not None:
            self.told.begin(section["items"])
        steps = [_PrintedStep(item) for item in figures_at(self.figures, Place(index, BEFORE))]
        for place, item in enumerate(
            section["items"] if self.told is None else gathered_notes(brought_together(section, self.columns))
        ):
            steps += [] if item is None else list(self._step(item, notes))
            steps += [_PrintedStep(each) for each in figures_at(self.figures, Place(index, place))]
        return PrintedSection(heading, self._text(section), _gathered(steps), self._shown(section.get("shown", ())))

    def _text(self, section: Data) -> str:
        text: str = section.get("text", "")
        return text if self.told is None or not text else "".join(self.told.new([text]))

    def _shown(self, places: Sequence[Data]) -> str:
        """Where the curves of a section are shown, in words."""
        told = [f"{at['symbol']} = {quantity(at['text'], at['unit'], self.decimal)}" for at in places]
        return self.words.say("shown_at", places=self.words.listed(told)) if told else ""

    def _step(self, item: Data, notes: set[str]) -> Iterator[_PrintedStep]:
        if item["type"] == "note":
            if self.told is None or self.told.new([item["text"]]):
                yield _PrintedStep(Item("note", text=item["text"]))
        elif item["type"] == "listed":
            yield _PrintedStep(Item("note"), listed_row(item, self.decimal), is_told=True)
        elif item["type"] == "table":
            yield _PrintedStep(Item("table", table=self.tables.of_item(item)))
        else:
            self.formulas += 1
            number = f"{self.letter}.{self.formulas}"
            self.given.setdefault(item["symbol"], number)
            yield self._formula(item, notes, number)

    def _formula(self, item: Data, notes: set[str], number: str) -> _PrintedStep:
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

    def _line(self, item: Data, number: str, refers: Reference | None = None, note: str = "") -> ValueRow:
        return value_row(item, number, refers, note, self.decimal, self.tables.names)

    def _said_beside(self, item: Data, notes: set[str]) -> Iterator[str]:
        """The rows of a table between which a number lies, and a note."""
        yield from filter(None, (item.get("table_rows"), self._new_note(item, notes)))

    def _new_note(self, item: Data, notes: set[str]) -> str:
        """The note of a step, where the section has not said it; a report with all says it at each step."""
        note: str = item.get("note", "")
        if self.told is None:
            return note
        if item.get("series") and note.startswith(
            item["series"]
        ):  # where standard values stand is told once for all chapters of a kind
            return "".join(self.told.new([note]))
        is_new = note not in notes
        notes.add(note)
        return note if is_new else ""

    def _item(self, item: Data, notes: set[str], number: str) -> Item:
        source = item["source"] if len(item["source"]) <= LONGEST_SOURCE else ""
        condition, words = self.said.condition(item), item.get("words", "")
        reason = words if words and item.get("condition") and condition is None else ""
        if reason:  # which was told; it is named beside the first of the steps that follow
            source, words = " · ".join(filter(None, (source, reason if reason != self.reason else ""))), ""
        self.reason = reason
        return Item(
            item["type"],
            number=number,
            description=item["description"],
            source=source,
            equation=self.equations.of(item),
            condition=condition,
            definitions=tuple(self.said.definitions(item)),
            words=words,
            text=""
            if item.get("equation") or item["type"] in WORDLESS
            else in_words(item["result"]["text"], self.tables.names),
            notes=tuple(self._notes(item, notes)),
            changed=item.get("changed", ""),
        )

    def _notes(self, item: Data, notes: set[str]) -> Iterator[str]:
        """The method, where it was not said already in this section, what proves the value, and a note."""
        if item["type"] == "lookup":
            yield from self._each_once(self._looked_up(item), notes)
        if item.get("series") and not item.get("note", "").startswith(item["series"]):
            yield from self._new([f"{self.words['series']}: {item['series']}"])
        if self.told is None or _is_chosen(item):  # why this value and no other is never told elsewhere
            yield from self._proof(item, notes)
        yield from self.said.conversions(item)
        yield from self._said_beside(item, notes)
        if len(item["source"]) > LONGEST_SOURCE:
            yield f"{self.words['source']}: {item['source']}"

    def _each_once(self, note: str, notes: set[str]) -> Iterator[str]:
        """A note, where the section has not said it; a report with all says it at each step."""
        if self.told is None or note not in notes:
            notes.add(note)
            yield note

    def _new(self, texts: Sequence[str]) -> Sequence[str]:
        """Those of the texts that no chapter of this kind has said; a report with all says them at each step."""
        return texts if self.told is None else self.told.new(texts)

    def _proof(self, item: Data, notes: set[str]) -> Iterator[str]:
        method, residual = item.get("method", ""), item.get("residual")
        if method and method not in notes:
            notes.add(method)
            yield f"{self.words['method']}: {method}"
        if residual and residual["text"] != UNPRINTED_RESIDUAL:
            key = "residual" if item["type"] == "found" else "checked_to"
            key += "_rounded" if _is_rounding(residual) else ""
            yield self.words.say(key, residual=quantity(residual["text"], residual["unit"], self.decimal))

    def _looked_up(self, item: Data) -> str:
        """Where a number was taken from: the table's title, and the text that chose it."""
        if item["table"]:
            return self.words.say("looked_up", table=item["table"], choice=worded(item["key"]))
        return f"{item['by']}: {worded(item['key'])}"


def _is_rounding(residual: Data) -> bool:
    """Return whether what is left of an equation is but the rounding of the computer."""
    return not is_words(residual["text"]) and is_nothing(float(residual["text"]), residual["unit"])


def _is_chosen(item: Data) -> bool:
    """Return whether a value was taken from a series, or sought in the place of one that may be given."""
    return bool(item.get("chosen") or (item["type"] == "reduction" and item["operation"] == "pick"))


def _is_bare(item: Data) -> bool:
    """Whether a step gives a value and nothing else: it has no formula, branch or table that it comes from."""
    is_found = item["type"] == "found" and not item.get("relation") and not item.get("equation")
    return is_found and not item.get("words") and len(item["source"]) <= LONGEST_SOURCE


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
