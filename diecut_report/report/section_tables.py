"""The tables of a section, brought together: those of the same parts in one, none that a formula has said already, and no column twice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

Data = Mapping[str, Any]
Column = tuple[Any, ...]  # the names of its lines, its title, symbol and unit, its texts
MOST = 8  # columns of a table that is put together, the first one among them
LONGEST_LIST = 12  # numbers in a line


def brought_together(section: Data, told: set[Column]) -> list[Data | None]:
    """Return the steps of a section in their places; none where a table went into a later one, or says nothing new.

    ``told`` are the columns that the chapter has printed already, each with the lines that it stands beside; those that follow are put to them.
    """
    items: list[Data | None] = list(section["items"])
    for place, item in enumerate(items):
        if item is not None and item["type"] == "table":
            items[place] = None if _is_said(item, section["items"][:place]) else _with_new_columns(item, told)
    for place, item in enumerate(items):
        if item is not None and item["type"] == "table":
            _move_on(items, place, section["title"])
    return [_listed(item) if item is not None and item["type"] == "table" else item for item in items]


def _with_new_columns(table: Data, told: set[Column]) -> Data | None:
    """A table without the columns that stand in an earlier one beside the same lines; none where all do. One that is declared stays whole."""
    if "id" in table:
        return table
    texts = [*zip(*table["rows"], strict=True)]
    columns = [
        (texts[0], column["title"], column["symbol"], column["unit"], text)
        for column, text in zip(table["columns"], texts, strict=True)
    ]
    is_single = texts[0] == ("1",)  # what it follows from stands in the formula before it
    new = [
        k
        for k, column in enumerate(columns)
        if not k or (column not in told and (not is_single or column[1] == table["title"]))
    ]
    told.update(columns)
    if len(new) == 1:
        return None
    rows = [[row[k] for k in new] for row in table["rows"]]
    return {**table, "columns": [table["columns"][k] for k in new], "rows": rows}


def _is_said(table: Data, before: Sequence[Data]) -> bool:
    """Whether a table is of one part, whose numbers stand in the formula before it."""
    last = next((item for item in reversed(before) if item["type"] != "table"), None)
    return (
        len(table["rows"]) == 1
        and bool(last and last.get("equation"))
        and table["title"] == (last or {})["description"]
    )


def _move_on(items: list[Data | None], place: int, title: str) -> None:
    """Put a table into the next one of the same parts, where both have room in one."""
    one = items[place]
    assert one is not None
    for later in range(place + 1, len(items)):
        other = items[later]
        if other is None or other["type"] != "table" or not _are_alike(one, other):
            continue
        both = _joined(one, other, title)
        if len(both["columns"]) <= MOST:
            items[place], items[later] = None, both
        return


def _are_alike(one: Data, other: Data) -> bool:
    first = [(table["columns"][0], [row[0] for row in table["rows"]]) for table in (one, other)]
    return first[0] == first[1] and len(set(first[0][1])) == len(first[0][1])


def _joined(one: Data, other: Data, title: str) -> Data:
    """Two tables side by side, each column once."""
    known = [(column["title"], column["symbol"]) for column in one["columns"]]
    new = [k for k, column in enumerate(other["columns"]) if (column["title"], column["symbol"]) not in known]
    columns = [*one["columns"], *(other["columns"][k] for k in new)]
    rows = [[*left, *(right[k] for k in new)] for left, right in zip(one["rows"], other["rows"], strict=True)]
    return {"type": "table", "title": title, "columns": columns, "rows": rows}


def _listed(table: Data) -> Data:
    """A table of one quantity of parts that have numbers alone, to be set in a line."""
    numbers = [str(number) for number in range(1, len(table["rows"]) + 1)]
    is_plain = (
        len(table["columns"]) == 2 and [row[0] for row in table["rows"]] == numbers and len(numbers) <= LONGEST_LIST
    )
    return {**table, "type": "listed"} if is_plain and table["title"] == table["columns"][1]["title"] else table
