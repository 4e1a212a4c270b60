"""One mechanism's chapter: its inputs, calculation, results and checks, numbered and with printed numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from diecut_report.report.equations import Equations
from diecut_report.report.i18n import Words
from diecut_report.report.numbers import displayed, number, quantity
from diecut_report.report.rows import (
    Chapter,
    CheckRow,
    Heading,
    Item,
    QuantityRow,
    Section,
    Table,
    quantity_row,
    utilisation,
)
from diecut_report.report.symbols import symbol
from diecut_report.units import pretty, to_display

Data = Mapping[str, Any]
CURVE_ROWS = 12
CURVE_COLUMNS = 7
UNPRINTED_RESIDUAL = "0"


def chapter(letter: str, name: str, mechanism: Data, equations: Equations, words: Words) -> Chapter:
    """The chapter of one mechanism's results."""
    part = Chapter(
        letter=letter,
        name=name,
        anchor=f"m-{letter}",
        title=mechanism.get("title") or name,
        kind=mechanism["kind"],
        version=mechanism.get("plugin_version", ""),
        status=mechanism["status"],
        error=mechanism.get("error", ""),
    )
    if not part.lost:
        _Filler(part, mechanism, equations, words).fill()
    return part


class _Filler:
    """Fills a chapter in the order of the printed page, so that all numbers count up."""

    def __init__(self, part: Chapter, mechanism: Data, equations: Equations, words: Words) -> None:
        self.part, self.mechanism, self.equations, self.words = part, mechanism, equations, words
        self.decimal = words["decimal"]
        self.formulas = self.tables = 0

    def fill(self) -> None:
        part, mechanism = self.part, self.mechanism
        part.summary, part.assumptions = mechanism["summary"], mechanism["assumptions"]
        self._head("purpose")
        self._head("inputs")
        part.inputs = [self._input(key, row) for key, row in mechanism["inputs"].items()]
        part.sections = [self._section(section) for section in mechanism["sections"]]
        self._head("results")
        part.outputs = [quantity_row(row, self.decimal) for row in mechanism["outputs"].values()]
        keyed = [row for row in mechanism["outputs"].values() if row.get("key")] or list(mechanism["outputs"].values())
        part.key_results = [quantity_row(row, self.decimal) for row in keyed]
        self._curves()
        self._head("checks")
        part.warnings = mechanism["warnings"]
        part.checks = [self._check(check) for check in mechanism["checks"]]
        if mechanism["figures"]:
            self._head("figures")
            part.figures = [(f"{part.letter}.{n}", figure) for n, figure in enumerate(mechanism["figures"], 1)]
        part.absent = mechanism["absent"]
        if part.absent:
            self._head("absent")
        part.errata = [(e["source"], e["text"], self._touched(e)) for e in mechanism["errata"]]
        if part.errata:
            self._head("errata")

    def _head(self, key: str, title: str = "") -> Heading:
        number = f"{self.part.letter}.{len(self.part.headings) + 1}"
        heading = Heading(number, title or self.words[key], f"s-{number}")
        self.part.headings.append(heading)
        if key:
            self.part.parts[key] = heading
        return heading

    def _input(self, key: str, row: Data) -> QuantityRow:
        told = self._origin(row)
        shown = quantity_row(row, self.decimal)
        return QuantityRow(
            shown.description, shown.symbol, shown.value, shown.unit,
            typed=str(row.get("text") or ""), origin=told, key=key, wordy=shown.wordy,
        )  # fmt: skip

    def _origin(self, row: Data) -> str:
        """Where an input comes from; the path of a reference stands in what was typed."""
        if not row.get("path"):
            return self.words[row["origin"]]
        if row["path"] in str(row.get("text", "")):
            return self.words["reference"]
        return self.words.say("refers" if row["origin"] == "reference" else "from_press", path=row["path"])

    def _section(self, section: Data) -> Section:
        heading = self._head("", section["title"])
        told: set[str] = set()
        return Section(heading, section.get("text", ""), [self._item(item, told) for item in section["items"]])

    def _item(self, item: Data, told: set[str]) -> Item:
        if item["type"] == "note":
            return Item("note", text=item["text"])
        if item["type"] == "table":
            return Item("table", table=self._table(item))
        self.formulas += 1
        return Item(
            item["type"],
            number=f"{self.part.letter}.{self.formulas}",
            description=item["description"],
            source=item["source"],
            equation=self.equations.of(item),
            condition=self.equations.condition(item),
            words=item.get("words", ""),
            text="" if item.get("equation") or item["type"] in ("found", "reduction") else item["result"]["text"],
            notes=tuple(self._notes(item, told)),
        )

    def _notes(self, item: Data, told: set[str]) -> Iterator[str]:
        """The method, where it was not told already in this section, what proves the value, and a note."""
        method, residual = item.get("method", ""), item.get("residual")
        if method and method not in told:
            told.add(method)
            yield f"{self.words['method']}: {method}"
        if residual and residual["text"] != UNPRINTED_RESIDUAL:
            key = "residual" if item["type"] == "found" else "checked_to"
            yield self.words.say(key, residual=quantity(residual["text"], residual["unit"], self.decimal))
        if item.get("note"):
            yield item["note"]

    def _table(self, item: Data) -> Table:
        self.tables += 1
        columns = [(c["title"], symbol(c["symbol"]), pretty(c["unit"])) for c in item["columns"]]
        rows = [[number(text, self.decimal) for text in row] for row in item["rows"]]
        return Table(item["title"], columns, rows, f"{self.part.letter}.{self.tables}")

    def _curves(self) -> None:
        """Some rows of all curves, by their abscissa, so many columns a table as the page holds."""
        curves: Data = self.mechanism["curves"]
        groups: dict[str, list[Data]] = {}
        for curve in curves.values():
            if "abscissa" in curve:
                groups.setdefault(curve["abscissa"], []).append(curve)
        if groups:
            self._head("curves")
        for axis, members in groups.items():
            tables = -(-len(members) // CURVE_COLUMNS)
            size = -(-len(members) // tables)
            for start in range(0, len(members), size):
                self.part.curves.append(self._curve_table(curves[axis], members[start : start + size]))

    def _curve_table(self, axis: Data, members: list[Data]) -> Table:
        self.tables += 1
        shown = [axis, *members]
        count = len(axis["values"])
        places = (
            [round(k * count / CURVE_ROWS) for k in range(CURVE_ROWS)] if count > CURVE_ROWS else list(range(count))
        )
        columns = [(c["description"], symbol(c["symbol"]), pretty(c["display_unit"])) for c in shown]
        rows = [[self._sample(c, place) for c in shown] for place in places]
        return Table(self.words["curves"], columns, rows, f"{self.part.letter}.{self.tables}")

    def _sample(self, curve: Data, place: int) -> str:
        value, shown = curve["values"][place], curve["display_unit"]
        if "abscissa" not in curve:
            return number(f"{to_display(value, shown):.6g}", self.decimal)
        scale = max(abs(v) for v in curve["values"])
        return displayed(value if abs(value) > 1e-12 * scale else 0.0, shown, 4, self.decimal)

    def _check(self, check: Data) -> CheckRow:
        texts = {
            side: quantity(check[f"{side}_display"]["text"], check[f"{side}_display"]["unit"], self.decimal)
            for side in ("demand", "limit", "margin")
        }
        return CheckRow(
            id=check["id"],
            mechanism=self.part.name,
            chapter=self.part.letter,
            chapter_title=self.part.title,
            anchor=f"c-{self.part.letter}-{check['id']}",
            title=check["title"],
            status=check["status"],
            demand=texts["demand"],
            demand_label=check["demand_label"],
            operator={"<": "<", "<=": "≤", ">": ">", ">=": "≥"}[check["operator"]],
            limit=texts["limit"],
            limit_label=check["limit_label"],
            margin=texts["margin"],
            utilisation=utilisation(check["utilisation"], check["status"], self.decimal),
            source=check["source"],
            message=check["message"],
        )

    def _touched(self, erratum: Data) -> str:
        rows = self.mechanism["outputs"] | self.mechanism["values"] | self.mechanism["curves"]
        return ", ".join(rows[key]["description"] if key in rows else key for key in erratum["touches"])
