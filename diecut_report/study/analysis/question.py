"""What is asked of stored variants: a condition, the order, how many, which columns; judged, and written as one query."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.conditions.where import Condition, column_named, condition

SHOWN = 20  # variants of a table that asks for no number of them
ROWS = 2_000  # at a time

Row = tuple[Any, ...]


@dataclass(frozen=True)
class Request:
    """Hold what a user asks, as typed: ``sort`` names columns parted by commas, ``picked`` are variants by their numbers."""

    where: str | None = None
    sort: str | None = None
    top: int | None = None
    columns: Sequence[str] | None = None
    picked: Sequence[int] = ()


@dataclass(frozen=True)
class Question:
    """Say what is asked: a condition, the order, how many, and which columns."""

    condition: Condition
    order: tuple[tuple[StoredColumn, bool], ...]
    top: int | None
    columns: tuple[StoredColumn, ...]
    picked: tuple[int, ...] = ()

    @property
    def where(self) -> str:
        """Return the condition as SQL."""
        chosen = f" AND variant IN ({', '.join(map(str, self.picked))})" if self.picked else ""
        return f"WHERE ({self.condition.sql}){chosen}"

    @property
    def sql(self) -> str:
        """Return the whole question; variants of equal rank stand in the order of the sample, missing values last."""
        names = ", ".join(column.sql for column in self.columns)
        order = [f"{column.sql} {'DESC' if falls else 'ASC'} NULLS LAST" for column, falls in self.order]
        limit = "" if self.top is None else f" LIMIT {self.top}"
        return f"SELECT {names} FROM v {self.where} ORDER BY {', '.join([*order, 'variant'])}{limit}"

    def rows(self, stored: Stored) -> Iterator[Row]:
        """Yield the variants that answer it."""
        cursor = stored.connection.execute(self.sql, self.condition.parameters)
        while rows := cursor.fetchmany(ROWS):
            yield from rows


def question(stored: Stored, asked: Request, *, is_table: bool) -> Question:
    """Return the question; UserError in words for what cannot be asked.

    A table for people shows the varied quantities and what the question names, of at most 20 variants; other answers hold all.
    """
    if asked.top is not None and asked.top < 1:
        raise UserError(Problem(Phrase("--top is {top}; a number of variants from 1 on is needed.", top=asked.top)))
    _refuse_strange(stored, asked.picked)
    where = asked.where if asked.where and asked.where.strip() else None
    found = condition(where, stored.columns) if where else Condition("true", [])
    order = tuple(_order(asked.sort or "", stored))
    top = SHOWN if is_table and asked.top is None else asked.top
    columns = _columns(stored, found, order, is_table, asked.columns)
    return Question(found, order, top, tuple(columns), tuple(asked.picked))


def _refuse_strange(stored: Stored, picked: Sequence[int]) -> None:
    if not picked:
        return
    found = {number for (number,) in stored.rows(f"SELECT variant FROM v WHERE variant IN ({_listed(picked)})")}
    if missing := [number for number in picked if number not in found]:
        first, last = stored.rows("SELECT min(variant), max(variant) FROM v")[0]
        words = Phrase(
            "There is no variant {listed} here. The stored ones are within {first} … {last}.",
            listed=_listed(missing),
            first=first,
            last=last,
        )
        raise UserError(Problem(words, str(stored.folder)))


def _listed(numbers: Iterable[int]) -> str:
    return ", ".join(map(str, numbers))


def _order(sort: str, stored: Stored) -> Iterator[tuple[StoredColumn, bool]]:
    for part in filter(None, (part.strip() for part in sort.split(","))):
        yield column_named(part.removeprefix("-").strip(), stored.columns), part.startswith("-")


def _columns(
    stored: Stored,
    asked: Condition,
    order: Iterable[tuple[StoredColumn, bool]],
    is_table: bool,
    named: Sequence[str] | None,
) -> list[StoredColumn]:
    """The columns to give, each once."""
    if named is not None:
        found = dict.fromkeys(["variant", *(column_named(name, stored.columns).name for name in named)])
        return [stored.columns[name] for name in found]
    if not is_table:
        return list(stored.columns.values())
    objectives = [name for each in stored.study.get("objectives") or () for name in each.values()]
    wanted = ["variant", "status", "governing", *(column.name for column, _ in order), *asked.columns, *objectives]
    reason = ["error"] if _has_errors(stored, asked) else []
    shown = dict.fromkeys([*wanted, *(column.name for column in stored.varied), *reason])
    return [stored.columns[name] for name in shown if name in stored.columns]


def _has_errors(stored: Stored, asked: Condition) -> bool:
    sql = f"SELECT 1 FROM v WHERE error IS NOT NULL AND {asked.sql} LIMIT 1"
    return bool(stored.rows(sql, asked.parameters))
