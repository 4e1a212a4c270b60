"""What is asked of stored variants: a condition, the order, how many, which columns; judged, and written as one query."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from diecut_report.errors import Problem, UserError, nearest
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
    given: tuple[Any, ...] = ()


def written(node: Node, columns: Mapping[str, StoredColumn]) -> Sql:
    """Return a condition as an SQL expression; each name in it must be a column."""
    return _SqlWriter(columns).expression(node)


class _SqlWriter:
    def __init__(self, columns: Mapping[str, StoredColumn]) -> None:
        self.columns = columns

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
                return self._chain(first, rest)
            case Power(base, exponent):  # 1 ** NaN would be 1
                return _filled("pow({}, {})", self._finite(base), self._finite(exponent))
            case Call(name, of) if name in _LEAST:  # least() and greatest() would pass over what is NULL
                least = f"lambda x, y: CASE WHEN x {_LEAST[name]} y THEN x WHEN y {_LEAST[name]} x THEN y END"
                given = ", ".join(["{}"] * len(of))
                return _filled(f"list_reduce([{given}], {least})", *map(self._finite, of))
            case Call(name, (of,)):
                return _filled(f"{name}({{}})", self.number(of))
        return self.expression(node)

    def _chain(self, first: Node, rest: tuple[tuple[str, Node], ...]) -> Sql:
        found = self.number(first)
        for sign, node in rest:
            # one divided by what is infinite would be 0
            found = _filled(f"({{}} {sign} {{}})", found, self._finite(node) if sign == "/" else self.number(node))
        return found

    def _finite(self, node: Node) -> Sql:
        """Return a number that is NULL where it is calculated and not finite."""
        return self.number(node) if isinstance(node, ColumnName | Number) else self.expression(node)


def _filled(form: str, *parts: Sql) -> Sql:
    """Return the form with these expressions in its braces."""
    return Sql(form.format(*(part.text for part in parts)), tuple(value for part in parts for value in part.given))


# Conditions on stored variants: ``drive.crank_torque_peak < '40 N*m' and status = 'pass'`` to SQL with parameters.


EXAMPLE = "drive.crank_torque_peak < '40 N*m' and status = 'pass'"
WHERE_SHOWN = 300  # letters of a condition in a message


@dataclass
class Condition:
    """Hold a condition for DuckDB with its parameters, and the columns that it names."""

    sql: str
    parameters: list[Any]
    columns: list[str] = field(default_factory=list)


def condition(given: str, columns: Mapping[str, StoredColumn]) -> Condition:
    """Return the condition that a text says; UserError in words, with the place, for what cannot be asked."""
    try:
        tree = read(given, columns, lambda name: _name(name, columns), EXAMPLE)
    except ConditionError as fault:
        where = "" if fault.place is None else Phrase(", at character {place}", place=fault.place + 1)
        shown = given if len(given) <= WHERE_SHOWN else given[:WHERE_SHOWN] + "…"
        raise UserError(
            Problem(Phrase("The condition “{shown}”{where}: {words}", shown=shown, where=where, words=fault.words))
        ) from None
    sql = written(tree, columns)
    return Condition(sql.text, list(sql.given), list(names(tree)))


def column_named(name: str, columns: Mapping[str, StoredColumn]) -> StoredColumn:
    """Return the column of a name; UserError with the nearest where there is none."""
    if name not in columns:
        raise UserError(
            Problem(
                Phrase(
                    "{name} is not a column of these variants{nearest}.",
                    name=repr(name),
                    nearest=nearest(name, columns),
                )
            )
        )
    return columns[name]


def _name(name: str, columns: Mapping[str, StoredColumn]) -> Name:
    if name not in columns:
        near = nearest(name, columns) or phrase("; put texts in quotes")
        raise ConditionError(Phrase("{name} is not a column of these variants{near}.", name=repr(name), near=near))
    column = columns[name]
    if column.is_number:
        return Name(name, "number", column.unit, column.display)
    return Name(name, "truth" if column.kind == "bool" else "text")


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
