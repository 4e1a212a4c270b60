"""Questions to the stored variants: which fulfil a condition, the best first, as a table, CSV or JSON."""

from __future__ import annotations

import csv
import io
import json
import math
import shutil
import sys
from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from diecut_report.errors import Problem, UserError
from diecut_report.report.number_format import number
from diecut_report.study.analysis.stored_variants import (
    FIXED,
    Stored,
    StoredColumn,
    opened,
)
from diecut_report.study.conditions.where import Condition, column_named, condition
from diecut_report.study.storage.state import read_state

FORMATS = ("table", "csv", "json")
SHOWN, WIDE = 20, 12  # variants and quantities of a table that asks for no number of them
ROWS = 2_000  # at a time

Row = tuple[Any, ...]


@dataclass(frozen=True)
class Question:
    """Say what is asked: a condition, the order, how many, and which columns."""

    condition: Condition
    order: tuple[tuple[StoredColumn, bool], ...]
    top: int | None
    columns: tuple[StoredColumn, ...]

    @property
    def where(self) -> str:
        """Return the condition as SQL."""
        return f"WHERE {self.condition.sql}"

    @property
    def sql(self) -> str:
        """Return the whole question; variants of equal rank stand in the order of the sample, missing values last."""
        names = ", ".join(column.sql for column in self.columns)
        order = [f"{column.sql} {'DESC' if falls else 'ASC'} NULLS LAST" for column, falls in self.order]
        limit = "" if self.top is None else f" LIMIT {self.top}"
        return f"SELECT {names} FROM v {self.where} ORDER BY {', '.join([*order, 'variant'])}{limit}"


def variants(
    directory: Path,
    where: str | None = None,
    sort: str | None = None,
    top: int | None = None,
    format: str = "table",
    columns: Sequence[str] | None = None,
    width: int | None = None,
) -> Generator[str, None, None]:
    """Yield the answer in pieces of text: a ``table`` for people (in the units that they read), ``csv`` or ``json`` (SI, all columns).

    ``sort`` names columns, parted by commas, with - for the greatest first; without ``columns`` a table shows the varied
    quantities and what the question names. UserError in words for what cannot be asked.
    """
    with opened(directory) as stored:
        question = _question(stored, where, sort, top, format, columns)
        yield from {"table": _table, "csv": _csv, "json": _json}[format](stored, question, width)


def unfinished(directory: Path) -> Iterator[str]:
    """Return a warning where a study is not calculated to its end: its best variant may still come."""
    state = read_state(directory)
    if state.get("state") != "complete":
        parts, rows, chunk = len(list((directory / "variants").glob("part-*.parquet"))), state["rows"], state["chunk"]
        yield (
            f"This study is not finished: {parts} of {-(-rows // chunk)} parts are calculated. Go on with: "
            f"diecut-report batch --resume {directory}"
        )


def _question(
    stored: Stored, where: str | None, sort: str | None, top: int | None, format: str, columns: Sequence[str] | None
) -> Question:
    if format not in FORMATS:
        raise UserError(Problem(f"{format!r} is not a format of variants; known: {', '.join(FORMATS)}."))
    if top is not None and top < 1:
        raise UserError(Problem(f"--top is {top}; a number of variants from 1 on is needed."))
    asked = condition(where, stored.columns) if where and where.strip() else Condition("true", [])
    order = tuple(_order(sort or "", stored))
    if format == "table" and top is None:
        top = SHOWN
    return Question(asked, order, top, tuple(_columns(stored, asked, order, format, columns)))


def _order(sort: str, stored: Stored) -> Iterator[tuple[StoredColumn, bool]]:
    for part in filter(None, (part.strip() for part in sort.split(","))):
        yield column_named(part.removeprefix("-").strip(), stored.columns), part.startswith("-")


def _columns(
    stored: Stored,
    asked: Condition,
    order: Iterable[tuple[StoredColumn, bool]],
    format: str,
    named: Sequence[str] | None,
) -> list[StoredColumn]:
    """The columns to give, each once."""
    if named is not None:
        return [stored.columns["variant"], *(column_named(name, stored.columns) for name in named if name != "variant")]
    if format != "table":
        return list(stored.columns.values())
    objectives = [name for each in stored.study.get("objectives") or () for name in each.values()]
    wanted = ["variant", "status", "governing", *(column.name for column, _ in order), *asked.columns, *objectives]
    inputs = [column.name for column in stored.varied]
    reason = ["error"] if _has_errors(stored, asked) else []
    found = dict.fromkeys([*wanted, *inputs[: max(WIDE - len(wanted), 3)], *reason])
    return [stored.columns[name] for name in found if name in stored.columns]


def _has_errors(stored: Stored, asked: Condition) -> bool:
    sql = f"SELECT 1 FROM v WHERE error IS NOT NULL AND {asked.sql} LIMIT 1"
    return bool(stored.rows(sql, asked.parameters))


def _fetched(stored: Stored, question: Question) -> Iterator[Row]:
    cursor = stored.connection.execute(question.sql, question.condition.parameters)
    while rows := cursor.fetchmany(ROWS):
        yield from rows


# --- formats ---------------------------------------------------------------------------------------------------------


def _csv(stored: Stored, question: Question, _width: int | None) -> Iterator[str]:
    """SI numbers, units in the header, as a study reads its tables."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(c.name + (f" [{c.unit}]" if c.unit != "1" else "") for c in question.columns)
    for row in _fetched(stored, question):
        writer.writerow("" if value is None else _plain(value) for value in row)
        if buffer.tell() > 1 << 16:
            yield _emptied(buffer)
    yield _emptied(buffer)


def _emptied(buffer: io.StringIO) -> str:
    text = buffer.getvalue()
    buffer.seek(0)
    buffer.truncate()
    return text


def _plain(value: Any) -> Any:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else value


def _json(stored: Stored, question: Question, _width: int | None) -> Iterator[str]:
    """SI numbers, with the units of the columns; a line for each variant."""
    names = [column.name for column in question.columns]
    units = {column.name: column.unit for column in question.columns if column.name not in FIXED and column.is_number}
    yield f'{{"units": {json.dumps(units, ensure_ascii=False)},\n "variants": ['
    before = "\n  "
    for row in _fetched(stored, question):
        yield before + json.dumps(dict(zip(names, map(_finite, row), strict=True)), ensure_ascii=False, allow_nan=False)
        before = ",\n  "
    yield "]}\n"


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _table(stored: Stored, question: Question, width: int | None) -> Iterator[str]:
    """A table for people, and how many variants there are."""
    from diecut_report.study.analysis.variant_table import table_text

    rows = list(_fetched(stored, question))
    found, without = table_text(question.columns, rows, width or _terminal())
    yield f"{found}\n{_counted(stored, question, len(rows))}\n"
    if without:
        yield f"No room on a line for: {', '.join(column.name for column in without)} (--format csv has them all).\n"


def _terminal() -> int | None:
    """How many letters a line of the terminal has; nothing where the answer goes elsewhere."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def _counted(stored: Stored, question: Question, given: int) -> str:
    sql = f"SELECT count(*) FILTER ({question.where}), count(*) FROM v"
    found, total = stored.rows(sql, question.condition.parameters)[0]
    of_all = f"{number(str(found))} of {number(str(total))} variants"
    words = of_all if question.condition.sql == "true" else f"Fulfilling the condition: {of_all}"
    return words + (f"; {given} are shown (--top, --format csv)." if given < found else ".")


__all__ = ["FORMATS", "variants"]
