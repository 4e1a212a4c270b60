"""How steps of one line each share the lines of a sheet: two side by side, or each alone, so that no description stands in a narrow column."""

from __future__ import annotations

from collections.abc import Sequence

from diecut_report.report.value_rows import ValueRow

LETTER = 1.55  # mm, of the letters of a description
REFERENCE = 0.86  # how wide letters of what is referred to are, against those
ROOM, WIDEST = 50.0, 19.0  # mm for a description and for its value, in half a line
ALONE = "broad"


def in_lines(rows: Sequence[ValueRow]) -> list[tuple[ValueRow, str]]:
    """Return the rows, each with how it is set: two by two where all of them have room in half a line, else each in a line of its own."""
    is_short = len(rows) > 1 and all(_value(row) <= WIDEST and _said(row) <= ROOM for row in rows)
    return [(row, "" if is_short else ALONE) for row in rows]


def _said(row: ValueRow) -> float:
    """How wide what is said of a row is, mm."""
    letters = sum(len(new.striptags()) + len(old.striptags()) + 10 for new, old in row.letters)
    behind = len(row.refers) + 7 + letters if row.refers else len(row.source) + 1
    return LETTER * (len(row.description) + REFERENCE * (behind + len(row.note)))


def _value(row: ValueRow) -> float:
    """How wide its symbol and value are, mm."""
    place = len(row.at.striptags()) + 4 if row.at else 0
    return LETTER * (len(row.symbol.striptags()) * REFERENCE + len(row.value) + place + 3)
