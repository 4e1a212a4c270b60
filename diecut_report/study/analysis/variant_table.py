"""Stored variants as a table for people: in the units that they read, as many columns as the line holds."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

from diecut_report.languages.speech import decimal_sign, say
from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import pretty, unit
from diecut_report.report.number_format import number
from diecut_report.study.analysis.stored_variants import StoredColumn

if TYPE_CHECKING:
    from rich.table import Table

FREE = 10_000  # letters of a line that no terminal breaks
HEAD = 14  # letters of a line of a heading
BETWEEN, REASON = 3, 40  # letters between columns; on a line of a reason, at least
FEWEST = 3  # columns that stand whatever the line holds


def table_text(
    columns: Sequence[StoredColumn], rows: Sequence[Sequence[Any]], width: int | None
) -> tuple[str, list[StoredColumn]]:
    """Return the table, and the columns that the line has no room for."""
    heads = [_head(column) for column in columns]
    texts = [[shown(value, column) for value, column in zip(row, columns, strict=True)] for row in rows]
    wide = [max(map(len, (*head.split("\n"), *column))) for head, *column in zip(heads, *texts, strict=True)]
    kept = _kept(columns, wide, width or FREE)
    return _drawn(columns, heads, texts, kept, width or FREE), [c for i, c in enumerate(columns) if i not in kept]


def compared_text(
    columns: Sequence[StoredColumn], rows: Sequence[Sequence[Any]], width: int | None, *, keep_equal: bool
) -> tuple[str, int]:
    """Return variants side by side, a line for each quantity with its unit, and how many quantities are left out as equal for all."""
    from rich.text import Text

    table = _empty_table()
    for head in (say("quantity"), say("unit")):
        table.add_column(Text(head), justify="left", overflow="fold")
    for row in rows:
        table.add_column(Text(str(row[0])), justify="right", overflow="fold")
    lines = [(column, [row[index] for row in rows]) for index, column in enumerate(columns) if column.name != "variant"]
    kept = [(column, values) for column, values in lines if keep_equal or any(value != values[0] for value in values)]
    for column, values in kept:
        texts = [column.name, pretty(column.display), *(shown(value, column) for value in values)]
        table.add_row(*map(Text, texts))
    return _printed(table, width or FREE), len(lines) - len(kept)


def _kept(columns: Sequence[StoredColumn], wide: Sequence[int], room: int) -> list[int]:
    """The columns that fit, by index: the first ones, the reason of an error (on several lines, if need be), then what fits."""
    reason = [index for index, column in enumerate(columns) if column.name == "error"]
    kept: list[int] = []
    used = 0
    for index in dict.fromkeys([*range(min(FEWEST, len(wide))), *reason, *range(len(wide))]):
        own = BETWEEN + (min(wide[index], REASON) if index in reason else wide[index])
        if used + own <= room or len(kept) < FEWEST:
            kept.append(index)
            used += own
    return sorted(kept)


def _drawn(
    columns: Sequence[StoredColumn],
    heads: Sequence[str],
    texts: Sequence[Sequence[str]],
    kept: Sequence[int],
    width: int,
) -> str:
    from rich.text import Text

    table = _empty_table()
    for index in kept:
        justify: Literal["left", "right"] = "right" if columns[index].is_number else "left"
        table.add_column(Text(heads[index]), justify=justify, overflow="fold")
    for row in texts:
        table.add_row(*(Text(row[index]) for index in kept))
    return _printed(table, width)


def _empty_table() -> Table:
    from rich import box
    from rich.table import Table

    return Table(box=box.SIMPLE_HEAD, pad_edge=False)


def _printed(table: Table, width: int) -> str:
    from rich.console import Console

    target = io.StringIO()
    Console(file=target, width=width, color_system=None, soft_wrap=False, legacy_windows=False).print(table)
    return "\n".join(line.rstrip() for line in target.getvalue().splitlines())


def _head(column: StoredColumn) -> str:
    """The name on short lines, and the unit below it."""
    lines = [""]
    for part in re.findall(r"[^._]*[._]|[^._]+", column.name.removeprefix("mechanisms.")):
        if lines[-1] and (lines[-1].endswith(".") or len(lines[-1] + part) > HEAD):
            lines.append("")
        lines[-1] += part
    sign = pretty(column.display)
    return "\n".join([*lines, sign] if sign else lines)


def shown(value: Any, column: StoredColumn) -> str:
    """Return a stored value as people read it, in the column's display unit, without the unit."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return say("yes") if value else say("no")
    if isinstance(value, float):
        return number(number_text(unit(column.display).from_si(value), 5), decimal_sign()) if value else "0"
    return number(str(value)) if isinstance(value, int) and column.name != "variant" else str(value)
