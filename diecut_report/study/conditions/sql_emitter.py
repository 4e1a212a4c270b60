"""A condition as SQL with parameters for DuckDB; see `tree` for what holds where there is no value.

Nothing of what a user writes reaches DuckDB but as a parameter or as the quoted name of a known column.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from diecut_report.conditions.tree import (
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
)
from diecut_report.study.analysis.stored_variants import StoredColumn

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
