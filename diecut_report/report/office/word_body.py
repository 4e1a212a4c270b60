"""The body of a DOCX while it is written: what counts up in it, and the parts that stand in several places."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from markupsafe import Markup

from diecut_report.pictures import SVG, natural_size
from diecut_report.report.chapters.printed_tables import PartsTable, PrintedTable, TableCell
from diecut_report.report.chapters.value_tables import RecordTable, ValueRow
from diecut_report.report.equations import Equation
from diecut_report.report.model import CheckRow, Item, QuantityRow
from diecut_report.report.office.wordml import (
    Inline,
    OfficeMath,
    TableColumn,
    bold,
    bookmark,
    key,
    link,
    new_line,
    office_math,
    paragraph,
    picture,
    rich,
    run,
    small,
    table,
)
from diecut_report.report.symbols import own_words, prose
from diecut_report.report.text import Catalogue
from diecut_report.results.model import LogoRecord

if TYPE_CHECKING:
    from diecut_report.report.figures.by_type import Raster


MARKS = {"pass": "✓", "warn": "!", "fail": "✗", "error": "✗", "skipped": "–", "not_checked": "?", "conditional": "?"}
NAMED_PART = 3.0  # the share of a column that names parts, where they have more than numbers


class WordBody:
    """Gathers the paragraphs and tables of a document in their order."""

    def __init__(
        self, words: Catalogue, rasters: Mapping[str, Raster], failed: Callable[[str], str], embed: Callable[[bytes], str]
    ) -> None:  # fmt: skip
        self.words, self.rasters, self.failed, self.embed = words, rasters, failed, embed
        self.math = OfficeMath(words, words["decimal"])
        self.parts: list[str] = []
        self._anchors: dict[str, str] = {}
        self._drawn = 0
        self._placed = 0

    def anchor(self, name: str) -> str:
        """The bookmark of an anchor of the report: short, and of letters that a bookmark may have."""
        return self._anchors.setdefault(name, f"r{len(self._anchors) + 1}")

    def heading(self, level: int, number: str, title: str, anchor: str) -> None:
        """A heading with its number, to which links lead."""
        self._placed += 1
        inner = run(f"{number}\u2002" if number else "") + rich(prose(title))
        self.parts.append(paragraph(bookmark(self._placed, self.anchor(anchor), inner), f"Heading{level}"))

    def subheading(self, title: str) -> None:
        """A heading without a number, which no contents list."""
        self.parts.append(paragraph(rich(prose(title)), "Heading4"))

    def say(self, inner: Inline, style: str = "", *, keep: bool = False) -> None:
        """A paragraph."""
        if inner:
            self.parts.append(paragraph(inner, style, keep=keep))

    def tell(self, text: str, style: str = "") -> None:
        """A paragraph of a text."""
        self.say(rich(prose(text)), style)

    def listed(self, lines: Iterable[Inline]) -> None:
        """Lines with a dot before each."""
        for line in lines:
            self.say(line, "ListBullet")

    def table(self, columns: Sequence[TableColumn], rows: Sequence[Sequence[Inline]], *, headed: bool = True) -> None:
        """A table, and air below it."""
        if rows:
            self.parts += [table(columns, rows, headed=headed), paragraph("", "TableText")]

    def titled_table(self, title: str, heads: str, rows: Sequence[Sequence[Inline]]) -> None:
        """A table under its title; nothing where it has no rows."""
        if rows:
            self.subheading(title)
            self.table(self.heads(heads), rows)

    def heads(self, heads: str) -> list[TableColumn]:
        """Columns with words of the catalogue as their heads: ``check:5 demand:2> :0.6``, each with its share, > stands right."""
        parted = ([*head.rstrip(">").split(":"), head[-1]] for head in heads.split())
        return [
            TableColumn(run(self.words[word] if word else ""), float(part), end == ">") for word, part, end in parted
        ]

    def status(self, status: str) -> Inline:
        """A verdict by its sign and its word."""
        return bold(f"{MARKS[status]} {self.words[status]}")

    def linked(self, row: CheckRow) -> Inline:
        """The title of a check that leads to its chapter."""
        return link(self.anchor(f"m-{row.chapter}"), rich(prose(row.title)))

    def caption(self, word: str, number: str, title: Inline, *, keep: bool = False) -> None:
        """What a table or a figure is called."""
        self.say(run(f"{self.words[word]} {number} ") + title, "Caption", keep=keep)

    def quantities(self, rows: Sequence[QuantityRow], *, sourced: bool = True) -> None:
        """Quantities, a line for each."""
        is_placed = any(row.at for row in rows)
        more = " place:2.6" * is_placed + " source:3" * sourced
        cells = []
        for row in rows:
            value = rich(own_words(row.value)) if row.wordy else run(row.value)
            cells.append([rich(prose(row.description)), rich(row.symbol), value, run(row.unit)])
            cells[-1] += [rich(row.at)] * is_placed + [small(prose(row.source))] * sourced
        self.table(self.heads(f"quantity:7 symbol:1.6 value:2.4> unit:1.6{more}"), cells)

    def data_table(self, found: PrintedTable) -> None:
        """A table of the calculation."""
        self.caption("table", found.number, rich(prose(found.title)), keep=True)
        columns = [
            TableColumn(_named(*column), 2 if kind in ("named", "words") else 1, not kind)
            for kind, column in zip(found.kinds, found.columns, strict=True)
        ]
        self.table(columns, [[run(text) for text in row] for row in found.rows])

    def parts_table(self, found: PartsTable) -> None:
        """A table of repeated parts."""
        title = rich(prose(found.title)) + (run(" ") + key(found.family) if found.family else "")
        title = title or run(self.words.say("repeated_parts", n=len(found.lines)))
        self.caption("table", found.number, title, keep=True)
        is_counted = bool(found.lines) and found.lines[0][0].isdigit()
        columns = self.heads(f"part:{1 if is_counted else NAMED_PART}")
        for each in found.columns:
            head = _named(each.title, each.symbol, each.unit) + (new_line() + key(each.key) if each.key else "")
            columns.append(TableColumn(head + (new_line() + small(prose(each.source)) if each.source else ""), 2))
        self.table(columns, [[run(number), *map(_noted, cells)] for number, cells in found.lines])

    def record_table(self, found: RecordTable) -> None:
        """A table of a few repeated parts side by side."""
        self.caption("table", found.number, rich(prose(f"{found.title} ".lstrip())) + key(found.family), keep=True)
        heads = [TableColumn(run(head), 2) for head in found.heads]
        columns = [*self.heads("quantity:4 symbol:1"), *heads, *self.heads("unit:1 origin:2")]
        rows = [
            [rich(prose(row.description)) + new_line() + key(row.key), rich(row.symbol),
             *map(_noted, row.cells), run(row.unit), small(row.note.replace("\n", "; "))]
            for row in found.rows
        ]  # fmt: skip
        self.table(columns, rows)

    def formula(self, equation: Equation) -> None:
        """An equation that can be edited, in one or several lines."""
        lines = office_math(equation, self.math)
        for index, line in enumerate(lines, 1):
            self.say(line, "Formula" if index == 1 else "FormulaRow", keep=index < len(lines))

    def figure(self, number: str, title: str, caption: str) -> None:
        """A figure above its caption; where it could not be drawn, why."""
        drawing = self.rasters.get(number)
        if drawing is None:
            self.say(bold(self.words["not_drawn"]) + run(" ") + rich(prose(self.failed(number))), keep=True)
        else:
            told = " ".join(filter(None, (f"{title}.", caption)))
            self.say(self.drawn(drawing, told), keep=True)
        self.caption("figure", number, bold(f"{title}.") + (run(" ") + rich(prose(caption)) if caption else ""))

    def drawn(self, drawing: Raster, told: str, vector: str = "") -> Inline:
        """A picture in its natural size; ``vector`` names the same as SVG in the file."""
        self._drawn += 1
        return picture(self._drawn, self.embed(drawing.content), drawing.width, drawing.height, told, vector)

    def item(self, item: Item) -> None:
        """One step of a calculation."""
        if item.type == "note":
            self.tell(item.text, "Why")
        elif item.type == "figure":
            self.figure(item.number, item.title, item.caption)
        elif item.type == "pair":
            for each in item.pair:
                self.item(each)
        elif item.rows:
            self.values(item.rows)
        elif item.table is not None:
            self.data_table(item.table)
        else:
            self._step(item)

    def values(self, rows: Sequence[ValueRow]) -> None:
        """Steps without their formulas, a line for each."""
        self.table(self.heads("number:1.2 quantity:7 symbol:1.6 value:3"), [self._value(row) for row in rows])

    def _value(self, row: ValueRow) -> list[Inline]:
        source = row.named_formula(self.words) if row.refers else prose(row.source)
        told = Markup(" ").join(filter(None, (source, prose(row.note))))
        value = run(row.value) + (run(f" {self.words['at']} ") + rich(row.at) if row.at else "")
        what = rich(prose(row.description)) + (run("  ") + small(told) if told else "")
        return [run(f"({row.number})" if row.number else ""), what, rich(row.symbol), value]

    def _step(self, item: Item) -> None:
        result = f": {item.text}" if item.text else ""
        source = run("  ") + small(prose(item.source)) if item.source else ""
        self.say(run(f"({item.number}) ") + rich(prose(item.description)) + bold(result) + source, "Lead")
        if item.words:
            self.tell(f"{self.words['since']}: {item.words}", "Why")
        for equation in filter(None, (item.condition, item.equation)):
            self.formula(equation)
        for definition in item.definitions:
            self.tell(self.words["where"], "Why")
            self.formula(definition)
        for note in item.notes:
            self.tell(note, "Why")


def _named(title: str, symbol: Markup, unit: str) -> Inline:
    return rich(prose(title)) + (run(" ") + rich(symbol) if symbol else "") + run(f", {unit}" if unit else "")


def _noted(cell: TableCell) -> Inline:
    return run(cell.text) + (new_line() + small(cell.note) if cell.note else "")


# The organisation's logo above the title of a DOCX: a PNG as it is, an SVG beside a picture for programs that show none.


WIDEST, HIGHEST, LEAST_SIDE = 144.0, 48.0, 1.0  # points
POINTS = 0.75  # to a pixel


def logo(body: WordBody, given: LogoRecord, owner: str, embed_svg: Callable[[bytes], str]) -> None:
    """Show the logo of the results; ``embed_svg`` puts an SVG into the file and returns what names it there.

    Word shows the SVG since 2016. Older programs show the picture of points beside it: as nothing here draws an SVG as one,
    it is the owner's name.
    """
    from diecut_report.report.figures.by_type import Raster, raster_of_text  # with matplotlib

    content = b64decode(given.base64)
    told = owner or body.words["logo"]
    width, height = (POINTS * side for side in natural_size(content))
    scale = min(WIDEST / width, HIGHEST / height)
    if given.media_type == SVG:
        plain = raster_of_text(told, max(width * scale, LEAST_SIDE), max(height * scale, LEAST_SIDE))
        body.say(body.drawn(plain, told, embed_svg(content)))
    else:
        shown = Raster(content, width * min(1.0, scale), height * min(1.0, scale))
        body.say(body.drawn(shown, told))
