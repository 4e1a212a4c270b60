"""How steps of one line each share the lines of a sheet: two side by side, or one that is long alone, so that they take the fewest lines."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from diecut_report.report.value_rows import ValueRow

LETTER = 1.55  # mm, of the letters of a description
REFERENCE = 0.86  # how wide letters of what is referred to are, against those
HALF, WHOLE = 69.0, 158.0  # mm for a description and its value, side by side with another one and alone
FORMS = (
    (19.0, 50, ""),
    (27.0, 42, "less"),
    (35.0, 34, "least"),
)  # width of a value, that of its description, and its class
ALONE = "broad"


def in_lines(rows: Sequence[ValueRow]) -> list[tuple[ValueRow, str]]:
    """Return the rows, each with how it is set: in a half, with less room for its description, or alone."""
    fewest = [0] * (len(rows) + 2)
    halves = [_half(row) for row in rows]
    alone = [_lines(_said(row) + _value(row) + 4, WHOLE) for row in rows]
    is_pair = [False] * len(rows)
    for place in range(len(rows) - 1, -1, -1):
        fewest[place] = alone[place] + fewest[place + 1]
        if place + 1 < len(rows):
            pair = max(halves[place][0], halves[place + 1][0]) + fewest[place + 2]
            is_pair[place] = pair < fewest[place]
            fewest[place] = min(pair, fewest[place])
    found: list[tuple[ValueRow, str]] = []
    while len(found) < len(rows):
        place = len(found)
        taken = (place, place + 1) if is_pair[place] else (place,)
        found += [(rows[each], halves[each][1] if len(taken) > 1 else ALONE) for each in taken]
    return found


def _half(row: ValueRow) -> tuple[int, str]:
    """The lines of a row beside another one, and its form."""
    value = _value(row)
    for widest, room, form in FORMS:
        if value <= widest:
            return _lines(_said(row), room), form
    return _lines(_said(row), HALF) + 1, ""


def _lines(width: float, room: float) -> int:
    return ceil(width / room)


def _said(row: ValueRow) -> float:
    """How wide what is said of a row is, mm."""
    letters = sum(len(new.striptags()) + len(old.striptags()) + 10 for new, old in row.letters)
    behind = len(row.refers) + 7 + letters if row.refers else len(row.source) + 1
    return LETTER * (len(row.description) + REFERENCE * (behind + len(row.note)))


def _value(row: ValueRow) -> float:
    """How wide its symbol and value are, mm."""
    place = len(row.at.striptags()) + 4 if row.at else 0
    return LETTER * (len(row.symbol.striptags()) * REFERENCE + len(row.value) + place + 3)
