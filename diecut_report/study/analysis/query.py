"""What is asked of stored variants: a condition, the order, how many, which columns; judged, and written as one query."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from diecut_report.errors import nearest, refusal
from diecut_report.formulas.condition_parts import Name, read
from diecut_report.formulas.condition_tree import (
    Call,
    Chain,
    ColumnName,
    Compared,
    Joined,
    Like,
    Missing,
    Negative,
    Node,
    Not,
    Number,
    Power,
    TextLiteral,
    Truth,
    names,
)
from diecut_report.formulas.conditions import ConditionError
from diecut_report.study.analysis.variants import Stored, StoredColumn
from diecut_report.text.phrases import Phrase, phrase

# A condition as SQL with parameters for DuckDB; see `tree` for what holds where there is no value.
#
# Nothing of what a user writes reaches DuckDB but as a parameter or as the quoted name of a known column.


_SIGNS = {"==": "=", "!=": "<>", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_LEAST = {"min": "<=", "max": ">="}


class Sql(NamedTuple):
    """Hold an expression and what goes into its question marks."""

    text: str
    parameters: tuple[Any, ...] = ()


def _filled(form: str, *parts: Sql) -> Sql:
    return Sql(form.format(*(part.text for part in parts)), tuple(value for part in parts for value in part.parameters))


@dataclass(frozen=True)
class SqlWriter:
    """Write conditions whose names are all columns."""

    columns: Mapping[str, StoredColumn]

    def expression(self, node: Node) -> Sql:
        """Return a side of a comparison or a condition; what is calculated and not finite is NULL."""
        match node:
            case ColumnName(name):
                return Sql(self.columns[name].sql)
            case Number(value) | TextLiteral(value):
                return Sql("?", (value,))
            case Truth(value):
                return Sql("true" if value else "false")
            case Negative() | Chain() | Power() | Call():
                return _filled("list_transform([{}], lambda x: CASE WHEN isfinite(x) THEN x END)[1]", self.number(node))
            case Compared(sign, left, right):
                return _filled(f"({{}} {_SIGNS[sign]} {{}})", self.expression(left), self.expression(right))
            case Like(text, pattern):
                return _filled("({} LIKE {})", self.expression(text), Sql("?", (pattern,)))
            case Missing(of):
                return _filled("({} IS NULL)", self.expression(of))
            case Not(of):
                return _filled("(NOT {})", self.expression(of))
            case Joined(word, parts):
                places = f" {word.upper()} ".join(["{}"] * len(parts))
                return _filled(f"({places})", *map(self.expression, parts))

    def number(self, node: Node) -> Sql:
        """Return a number that something is calculated from; NaN and infinite ones go on through sums, products and roots."""
        match node:
            case ColumnName(name) if self.columns[name].kind == "int":
                return Sql(f"CAST({self.columns[name].sql} AS DOUBLE)")
            case Negative(of):
                return _filled("(-{})", self.number(of))
            case Chain(first, rest):
                found = self.number(first)
                for sign, part in rest:
                    # one divided by what is infinite would be 0
                    other = self._finite(part) if sign == "/" else self.number(part)
                    found = _filled(f"({{}} {sign} {{}})", found, other)
                return found
            case Power(base, exponent):  # 1 ** NaN would be 1
                return _filled("pow({}, {})", self._finite(base), self._finite(exponent))
            case Call(name, of) if name in _LEAST:  # least() and greatest() would pass over what is NULL
                least = f"lambda x, y: CASE WHEN x {_LEAST[name]} y THEN x WHEN y {_LEAST[name]} x THEN y END"
                given = ", ".join(["{}"] * len(of))
                return _filled(f"list_reduce([{given}], {least})", *map(self._finite, of))
            case Call(name, (of,)):
                return _filled(f"{name}({{}})", self.number(of))
        return self.expression(node)

    def _finite(self, node: Node) -> Sql:
        """Return a number that is NULL where it is calculated and not finite."""
        return self.number(node) if isinstance(node, ColumnName | Number) else self.expression(node)


# Conditions on stored variants: ``drive.crank_torque_peak < '40 N*m' and status = 'pass'`` to SQL with parameters.


EXAMPLE = "drive.crank_torque_peak < '40 N*m' and status = 'pass'"
MAX_SHOWN = 300  # letters of a condition in a message


def condition(given: str, columns: Mapping[str, StoredColumn]) -> tuple[Sql, list[str]]:
    """Return the condition that a text says, and the columns that it names; UserError, with the place, for what cannot be asked."""

    def name(name: str) -> Name:
        if name not in columns:
            near = nearest(name, columns) or phrase("; put texts in quotes")
            raise ConditionError("{name} is not a column of these variants{near}.", name=repr(name), near=near)
        return columns[name].in_condition

    try:
        tree = read(given, columns, name, EXAMPLE)
    except ConditionError as fault:
        where = "" if fault.place is None else Phrase(", at character {place}", place=fault.place + 1)
        shown = given if len(given) <= MAX_SHOWN else given[:MAX_SHOWN] + "…"
        raise refusal("The condition “{shown}”{where}: {words}", shown=shown, where=where, words=fault.words) from None
    return SqlWriter(columns).expression(tree), list(names(tree))


def column_named(name: str, columns: Mapping[str, StoredColumn]) -> StoredColumn:
    """Return the column of a name; UserError with the nearest where there is none."""
    if name not in columns:
        template = "{name} is not a column of these variants{nearest}."
        raise refusal(template, name=repr(name), nearest=nearest(name, columns))
    return columns[name]


DEFAULT_TOP = 20  # variants of a table that asks for no number of them
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

    condition: Sql
    order: tuple[tuple[StoredColumn, bool], ...]
    top: int | None
    columns: tuple[StoredColumn, ...]
    picked: tuple[int, ...] = ()

    @property
    def where(self) -> str:
        """Return the condition as SQL."""
        chosen = f" AND variant IN ({', '.join(map(str, self.picked))})" if self.picked else ""
        return f"WHERE ({self.condition.text}){chosen}"

    def rows(self, stored: Stored) -> Iterator[Row]:
        """Yield the variants that answer it; those of equal rank stand in the order of the sample, missing values last."""
        chosen = ", ".join(column.sql for column in self.columns)
        order = [f"{column.sql} {'DESC' if falls else 'ASC'} NULLS LAST" for column, falls in self.order]
        limit = "" if self.top is None else f" LIMIT {self.top}"
        sql = f"SELECT {chosen} FROM v {self.where} ORDER BY {', '.join([*order, 'variant'])}{limit}"
        cursor = stored.connection.execute(sql, list(self.condition.parameters))
        while rows := cursor.fetchmany(ROWS):
            yield from rows


def question(stored: Stored, asked: Request, *, is_table: bool) -> Question:
    """Return the question; UserError for what cannot be asked.

    A table for people shows the varied quantities and what the question names, of at most 20 variants; other answers hold all.
    """
    _refuse_strange(stored, asked.picked)
    where = (asked.where or "").strip()
    found, names_asked = condition(where, stored.columns) if where else (Sql("true"), [])
    parts = [part.strip() for part in (asked.sort or "").split(",") if part.strip()]
    named = [(column_named(part.removeprefix("-").strip(), stored.columns), part.startswith("-")) for part in parts]
    top = DEFAULT_TOP if is_table and asked.top is None else asked.top
    if asked.columns is not None:
        given = [column_named(name, stored.columns).name for name in asked.columns]
        shown = [stored.columns[name] for name in dict.fromkeys(["variant", *given])]
    elif is_table:
        shown = _shown(stored, found, [*(column.name for column, _ in named), *names_asked])
    else:
        shown = list(stored.columns.values())
    return Question(found, tuple(named), top, tuple(shown), tuple(asked.picked))


def _refuse_strange(stored: Stored, picked: Sequence[int]) -> None:
    if not picked:
        return
    listed = ", ".join(map(str, picked))
    found = {number for (number,) in stored.rows(f"SELECT variant FROM v WHERE variant IN ({listed})")}
    if missing := [number for number in picked if number not in found]:
        first, last = stored.rows("SELECT min(variant), max(variant) FROM v")[0]
        template = "There is no variant {listed} here. The stored ones are within {first} … {last}."
        raise refusal(template, stored.folder, listed=", ".join(map(str, missing)), first=first, last=last)


def _shown(stored: Stored, asked: Sql, needed: Sequence[str]) -> list[StoredColumn]:
    objectives = [name for each in stored.study.get("objectives") or () for name in each.values()]
    sql = f"SELECT 1 FROM v WHERE error IS NOT NULL AND {asked.text} LIMIT 1"
    reason = ["error"] if stored.rows(sql, asked.parameters) else []
    varied = (column.name for column in stored.varied)
    wanted = ["variant", "verdict", "status", "governing", *needed, *objectives, *varied, *reason]
    return [stored.columns[name] for name in dict.fromkeys(wanted) if name in stored.columns]
