"""The list of a chapter's symbols: each letter of its formulas with its meaning and unit, and what a source writes for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import accumulate
from math import ceil
from typing import Any, NamedTuple

from markupsafe import Markup

from diecut_report.quantities.units import pretty
from diecut_report.report.printed_tables import WIDE
from diecut_report.report.symbols import symbol

Data = Mapping[str, Any]
GROUPS = ("inputs", "curves", "outputs", "values")
COLUMNS, ROOM = 3, 33  # on paper, and the letters that a line has beside its symbol
LINES = 14  # of a block's columns: less than a third of a sheet is left empty before one
TREES = ("equation", "relation", "condition")


class SymbolRow(NamedTuple):
    """A symbol with its meaning, its unit, and the letter of the source where that is another one."""

    symbol: Markup
    meaning: str
    unit: str
    in_source: Markup
    name: str = ""
    stands: str = ""  # the number of the step, or of the inputs, where it is explained
    is_step: bool = False

    @property
    def anchor(self) -> str:
        """Where the link to that place leads."""
        return f"{'eq' if self.is_step else 's'}-{self.stands}"


def symbol_rows(mechanism: Data) -> list[SymbolRow]:
    """The symbols that stand in a chapter's formulas, in the order of the alphabet, Latin letters first."""
    used = set(used_symbols(mechanism["sections"]))
    printed = {item["id"] for section in mechanism["sections"] for item in section["items"] if "id" in item}
    rows = [(name, row) for group in GROUPS for name, row in mechanism[group].items()]
    known: dict[str, Data] = {}
    for _, row in sorted(rows, key=lambda each: each[0] not in printed):  # what a step prints, before a chart's curves
        if row["symbol"] in used and any(map(str.isalpha, row["symbol"])):
            known.setdefault(row["symbol"], row)
    return [_row(known[name]) for name in sorted(known, key=_order)]


def in_blocks(rows: list[SymbolRow]) -> list[list[list[SymbolRow]]]:
    """The rows for paper, in blocks of columns that no sheet's end cuts: each block is read column by column."""
    blocks: list[list[SymbolRow]] = [[]]
    room = COLUMNS * LINES
    for row in rows:
        if sum(map(_lines, blocks[-1])) + _lines(row) > room:
            blocks.append([])
        blocks[-1].append(row)
    return [_in_columns(block) for block in blocks if block]


def _lines(row: SymbolRow) -> int:
    """How many lines a row takes on paper, about."""
    return ceil((len(row.meaning) + len(row.unit) + 2) / ROOM)


def _in_columns(rows: list[SymbolRow]) -> list[list[SymbolRow]]:
    """The rows in columns, of about as many lines each."""
    lines = [_lines(row) for row in rows]
    count = min(COLUMNS, len(rows))
    share = ceil(sum(lines) / count)
    before = [0, *accumulate(lines)]
    columns: list[list[SymbolRow]] = [[] for _ in range(count)]
    for row, above, height in zip(rows, before, lines, strict=False):
        columns[min(int((above + height / 2) / share), count - 1)].append(row)
    return columns


def symbols_at(rows: list[SymbolRow], steps: Mapping[str, str], inputs: Mapping[str, str]) -> list[SymbolRow]:
    """The rows with the place of each symbol: the step that gives it, else the inputs; by their names."""
    return [
        row._replace(stands=steps.get(row.name) or inputs.get(row.name, ""), is_step=row.name in steps) for row in rows
    ]


def _row(row: Data) -> SymbolRow:
    unit = row["display_unit"] if "display_unit" in row else row["display"]["unit"]
    in_source = row.get("source_symbol", "")
    return SymbolRow(
        symbol(row["symbol"]),
        row["description"].partition(";")[0],
        pretty(unit),
        symbol(in_source) if in_source else Markup(""),
        row["symbol"],
    )


def _order(name: str) -> tuple[bool, str, str]:
    letter = name.lstrip("|[0123456789")
    return not letter[:1].isascii(), letter.casefold(), letter


def used_symbols(sections: list[Data]) -> Iterator[str]:
    """The symbols of results and of formulas."""
    for section in sections:
        for item in section["items"]:
            if any(map(str.isalpha, item.get("symbol", ""))):  # no arrow before a choice in words
                yield item["symbol"]
            if len(columns := item.get("columns", ())) >= WIDE:
                yield from (column["symbol"] for column in columns if column["symbol"])
            for tree in (item.get(key) for key in TREES):
                yield from _leaves(tree)
            for each in item.get("where", ()):
                yield from _leaves(each["as"])


def _leaves(tree: Any) -> Iterator[str]:
    if isinstance(tree, list):
        if len(tree) == 2 and tree[0] == "sym":
            yield tree[1]
        else:
            for part in tree:
                yield from _leaves(part)
