"""The words of a condition on stored variants, and what its parts measure."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import reduce
from typing import Any, NamedTuple

from diecut_report.errors import Problem, UserError, nearest
from diecut_report.quantities.units import Kind, kind_name, parse_quantity, unit
from diecut_report.study.analysis.stored_variants import Column

MOST_WORDS, DEEPEST = 400, 40  # words of a condition, brackets in each other
PURE: Kind = unit("1").kind
ANGLE = 7  # the plane angle's place in a kind; products lose it, for N·m·rad/s is a power
FUNCTIONS = {"abs": "abs", "sqrt": "sqrt", "min": "least", "max": "greatest"}
COMPARISONS = {
    "=": "=",
    "==": "=",
    "!=": "<>",
    "<>": "<>",
    "<": "<",
    "<=": "<=",
    ">": ">",
    ">=": ">=",
    "≤": "<=",
    "≥": ">=",
    "≠": "<>",
}
WORDS = {"and", "or", "not", "in", "is", "null", "between", "like", "true", "false"}
_TOKEN = re.compile(
    r"""\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?![\w.])|(?P<text>'(?:[^']|'')*'|"(?:[^"]|"")*")"""
    r"""|(?P<sign>\*\*|<=|>=|==|!=|<>|[-+*/^(),<>=≤≥≠])|(?P<name>[^\W\d][\w.-]*))"""
)
EXAMPLE = "for example: drive.crank_torque_peak < '40 N*m' and status = 'pass'"


class Token(NamedTuple):
    """A word of a condition and where it stands (from 0)."""

    sort: str
    text: str
    place: int


@dataclass(frozen=True)
class Term:
    """A part of a condition: its SQL, what goes into it, and what it measures.

    ``sort`` is number, text, quoted (a text that may become a quantity), bool or null. ``bare`` says that it is a number without a
    unit, ``derived`` that its kind comes from a product, ``column`` which column it is or scales, ``told`` what messages call it.
    """

    sql: str
    sort: str
    given: tuple[Any, ...] = ()
    kind: Kind = PURE
    bare: bool = False
    derived: bool = False
    column: Column | None = None
    told: str = "a quantity of another kind"


@dataclass
class Condition:
    """A condition for DuckDB with its parameters, and the columns that it names."""

    sql: str
    parameters: list[Any]
    columns: list[str] = field(default_factory=list)


def column_named(name: str, columns: Mapping[str, Column]) -> Column:
    """The column of a name; UserError with the nearest where there is none."""
    if name not in columns:
        raise UserError(Problem(f"{name!r} is no column of these variants{nearest(name, columns)}."))
    return columns[name]


def tokens(given: str, columns: Mapping[str, Column]) -> list[Token]:
    """The words of a condition; known columns are taken whole, whatever they are made of."""
    names = sorted(columns, key=len, reverse=True)
    known = re.compile(r"\s*(" + "|".join(map(re.escape, names)) + r")(?![\w.])") if names else None
    found, place = [], 0
    while given[place:].strip():
        match = known.match(given, place) if known else None
        sort = "name"
        if match is None:
            match = _TOKEN.match(given, place)
            if match is None:
                at = place + len(given[place:]) - len(given[place:].lstrip())
                raise fault(given, at, f"{given[at : at + 10]!r} cannot be read here; {EXAMPLE}")
            sort = str(match.lastgroup)
        word = match[1] if sort == "name" and match.lastgroup is None else match[match.lastgroup or 1]
        found.append(Token(sort, word, match.end() - len(word)))
        place = match.end()
    _bound(found, given)
    return [*found, Token("end", "the end", len(given))]


def _bound(found: list[Token], given: str) -> None:
    depth = 0
    for token in found:
        depth += {"(": 1, ")": -1}.get(token.text, 0)
        if depth > DEEPEST:
            raise fault(given, token.place, "brackets stand too deep in each other")
    if len(found) > MOST_WORDS:
        raise fault(given, found[MOST_WORDS].place, f"it has more than {MOST_WORDS} words")


def fault(given: str, place: int, words: str) -> UserError:
    return UserError(Problem(f"The condition “{given}”, at character {place + 1}: {words}."))


def same(one: Term, two: Term) -> bool:
    if one.derived or two.derived:
        return one.kind[:ANGLE] == two.kind[:ANGLE]
    return one.kind == two.kind


def known(term: Term) -> str:
    """The SQL of a side of a comparison; what is not defined (a root of less than 0, a division by 0) is neither more nor less."""
    is_made = term.sort == "number" and term.sql[0] not in '?"'
    if not is_made:
        return term.sql
    return reduce(lambda sql, undefined: f"nullif({sql}, '{undefined}'::DOUBLE)", ("NaN", "inf", "-inf"), term.sql)


def measured(typed: str, column: Column | None) -> Term:
    """A quantity in quotes; a bare number in quotes counts in the display unit of the column beside it."""
    match = re.match(r"\s*[-+−]?[\d.]+(?:[eE][-+]?\d+)?\s*\*?\s*(.*)", typed, re.DOTALL)
    own = match[1].strip() if match and not match[1].startswith(",") else ""
    wanted = own or (column.display if column else "1")
    value, measure = parse_quantity(typed, wanted), unit(wanted)
    return Term("?", "number", (value,), measure.kind, told=f"'{typed}' ({kind_name(measure)})")
