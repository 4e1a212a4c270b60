"""Conditions on stored variants: ``drive.crank_torque_peak < '40 N*m' and status = 'pass'`` to a checked SQL expression.

The grammar is closed: known columns, numbers, quantities and texts in quotes, arithmetic, comparisons, ``and``, ``or``, ``not``,
``in``, ``between``, ``like``, ``is null`` and four functions. Nothing of what a user writes reaches DuckDB but as a parameter or
as the quoted name of a known column.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NoReturn

from diecut_report.errors import nearest
from diecut_report.quantities.units import UnitError, kind_name, pretty, unit
from diecut_report.study.analysis.stored_variants import Column
from diecut_report.study.conditions.where_words import (
    COMPARISONS,
    EXAMPLE,
    FUNCTIONS,
    PURE,
    WORDS,
    Condition,
    Term,
    Token,
    fault,
    known,
    measured,
    same,
    tokens,
)


def condition(given: str, columns: Mapping[str, Column]) -> Condition:
    """The condition that a text says; UserError in words, with the place, for what cannot be asked."""
    reader = _Reader(given, columns)
    term = reader.alternatives()
    if reader.next.sort != "end":
        reader.refuse(f"{reader.next.text!r} is not expected here")
    if term.sort != "bool":
        reader.refuse(f"this is no condition; compare it with something; {EXAMPLE}")
    return Condition(term.sql, list(term.given), list(dict.fromkeys(reader.named)))


class _Reader:
    """Reads a condition from left to right, each method a level of binding."""

    def __init__(self, given: str, columns: Mapping[str, Column]) -> None:
        self.given, self.columns = given, columns
        self.left = tokens(given, columns)
        self.named: list[str] = []

    @property
    def next(self) -> Token:
        return self.left[0]

    def refuse(self, words: str) -> NoReturn:
        raise fault(self.given, self.next.place, words)

    def take(self, *wanted: str) -> str:
        """The next word if it is one of these, and past it."""
        word = self.next.text.lower() if self.next.sort in ("sign", "name") else ""
        if word and word in wanted:
            self.left.pop(0)
            return word
        return ""

    def expect(self, wanted: str) -> None:
        if not self.take(wanted):
            self.refuse(f"{wanted!r} is missing before {self.next.text!r}")

    # --- conditions ---

    def alternatives(self) -> Term:
        found = self.conjunction()
        while self.take("or"):
            found = self.both(found, "OR", self.conjunction())
        return found

    def conjunction(self) -> Term:
        found = self.negation()
        while self.take("and"):
            found = self.both(found, "AND", self.negation())
        return found

    def both(self, one: Term, word: str, two: Term) -> Term:
        if (one.sort, two.sort) != ("bool", "bool"):
            self.refuse(f"{word.lower()!r} stands between conditions; compare both sides with something")
        return Term(f"({one.sql} {word} {two.sql})", "bool", one.given + two.given)

    def negation(self) -> Term:
        if not self.take("not"):
            return self.comparison()
        found = self.negation()
        if found.sort != "bool":
            self.refuse("'not' stands before a condition")
        return Term(f"(NOT {found.sql})", "bool", found.given)

    def comparison(self) -> Term:
        found = self.sum()
        sign = self.take(*COMPARISONS)
        if sign:
            found = self.compared(found, COMPARISONS[sign], self.sum())
            if self.next.text in COMPARISONS:
                self.refuse("a chain of comparisons is not read; join them by and")
            return found
        if self.take("is"):
            word = "IS NOT NULL" if self.take("not") else "IS NULL"
            self.expect("null")
            return Term(f"({found.sql} {word})", "bool", found.given)
        return self.membership(found, "NOT " if self.take("not") else "")

    def membership(self, found: Term, negated: str) -> Term:
        """``in (…)``, ``between … and …``, ``like '…'``, or nothing of these."""
        if self.take("in"):
            self.expect("(")
            parts = [self.compared(found, "=", self.sum())]
            while self.take(","):
                parts.append(self.compared(found, "=", self.sum()))
            self.expect(")")
            return self.joined(parts, " OR ", negated)
        if self.take("between"):
            low = self.compared(found, ">=", self.sum())
            self.expect("and")
            return self.joined([low, self.compared(found, "<=", self.sum())], " AND ", negated)
        if self.take("like"):
            pattern = self.sum()
            if (found.sort, pattern.sort) != ("text", "quoted"):
                self.refuse("'like' compares a column of words with a pattern in quotes, such as 'drive.%'")
            return Term(f"({negated}{found.sql} LIKE {pattern.sql})", "bool", found.given + pattern.given)
        if negated:
            self.refuse("'in', 'between' or 'like' is missing after 'not'")
        return found

    def joined(self, parts: list[Term], word: str, negated: str) -> Term:
        sql = word.join(part.sql for part in parts)
        return Term(f"({negated}({sql}))", "bool", sum((part.given for part in parts), ()))

    def compared(self, one: Term, sign: str, two: Term) -> Term:
        one, two = self.matched(one, two)
        return Term(f"({known(one)} {sign} {known(two)})", "bool", one.given + two.given)

    def matched(self, one: Term, two: Term) -> tuple[Term, Term]:
        """Two terms that can be held against each other; what is in quotes becomes a quantity beside a number."""
        if "text" in (one.sort, two.sort):
            if {one.sort, two.sort} <= {"text", "quoted"}:
                return one, two
            self.refuse("words are compared with words in quotes, such as 'pass'")
        if (one.sort, two.sort) == ("bool", "bool"):
            return one, two
        one, two = self.number(one, two), self.number(two, one)
        self.alike(one, two)
        return one, two

    def alike(self, one: Term, two: Term) -> None:
        """Refuses different kinds, and numbers without unit where the unit that people read is not the SI unit."""
        for term, other in ((one, two), (two, one)):
            if term.bare and (other.kind != PURE or other.column):
                self.bare(term, other)
                return
        if same(one, two):
            return
        self.refuse(f"{one.told} cannot be held against {two.told}")

    def bare(self, term: Term, other: Term) -> None:
        zero = term.given == (0.0,)
        column = other.column
        if zero or (column and column.unit == column.display):
            return
        shown = (
            f"{pretty(column.display)}, for example '{term.given[0]:g} {column.display}'"
            if column
            else "its unit, in quotes"
        )
        self.refuse(f"a number beside {other.told} needs {shown}")

    # --- numbers ---

    def sum(self) -> Term:
        found = self.product()
        while sign := self.take("+", "-"):
            one, two = found, self.product()
            one, two = self.number(one, two), self.number(two, one)
            self.alike(one, two)
            whole = two if one.bare else one
            given, bare, derived = one.given + two.given, one.bare and two.bare, one.derived or two.derived
            found = Term(f"({one.sql} {sign} {two.sql})", "number", given, whole.kind, bare, derived, whole.column)
        return found

    def product(self) -> Term:
        found = self.power()
        while sign := self.take("*", "/"):
            one, two = self.number(found), self.number(self.power())
            turn = 1 if sign == "*" else -1
            kind = tuple(a + turn * b for a, b in zip(one.kind, two.kind, strict=True))
            scaled = one if two.bare else two if one.bare and sign == "*" else None
            found = Term(f"({one.sql} {sign} {two.sql})", "number", one.given + two.given, kind, one.bare and two.bare,
                         derived=scaled.derived if scaled else True, column=scaled.column if scaled else None)  # fmt: skip
        return found

    def power(self) -> Term:
        found = self.signed()
        if not self.take("**", "^"):
            return found
        base, exponent = self.number(found), self.number(self.signed())
        if not exponent.bare or len(exponent.given) != 1:
            self.refuse("a power is a number, such as x ** 2")
        kind = tuple(part * exponent.given[0] for part in base.kind)
        return Term(
            f"pow({base.sql}, {exponent.sql})", "number", base.given + exponent.given, kind, base.bare, derived=True
        )

    def signed(self) -> Term:
        if self.take("-"):
            found = self.number(self.signed())
            if found.bare and found.sql == "?":
                return Term("?", "number", (-found.given[0],), bare=True, told=found.told)
            return Term(f"(-{found.sql})", "number", found.given, found.kind, found.bare, found.derived, found.column)
        self.take("+")
        return self.atom()

    def atom(self) -> Term:
        token = self.next
        if self.take("("):
            found = self.alternatives()
            self.expect(")")
            return found
        if token.sort == "number":
            self.left.pop(0)
            return Term("?", "number", (float(token.text),), bare=True, told="a pure number")
        if token.sort == "text":
            return self.quoted(token)
        if token.sort == "name":
            return self.name(token)
        return self.refuse(f"a column, a number or a quantity is missing before {token.text!r}")

    def quoted(self, token: Token) -> Term:
        """What stands in quotes: a column in double quotes, else a text."""
        self.left.pop(0)
        inside = token.text[1:-1].replace(token.text[0] * 2, token.text[0])
        return self.of(inside) if token.text[0] == '"' and inside in self.columns else Term("?", "quoted", (inside,))

    def name(self, token: Token) -> Term:
        word = token.text.lower()
        if token.text in self.columns:
            self.left.pop(0)
            return self.of(token.text)
        if word in FUNCTIONS and self.left[1].text == "(":
            return self.function(FUNCTIONS[word])
        if word in ("true", "false"):
            self.left.pop(0)
            return Term(word, "bool")
        if word in WORDS:
            self.refuse(f"a column, a number or a quantity is missing before {token.text!r}")
        self.refuse(f"{token.text!r} is no column of these variants{nearest(token.text, self.columns)}")

    def of(self, name: str) -> Term:
        self.named.append(name)
        column = self.columns[name]
        sort = "number" if column.is_number else column.kind
        return Term(
            column.sql,
            sort,
            kind=unit(column.unit).kind,
            column=column,
            told=f"{name} ({kind_name(unit(column.unit))})",
        )

    def function(self, name: str) -> Term:
        self.left.pop(0)
        self.expect("(")
        parts = [self.number(self.sum())]
        while self.take(","):
            parts.append(self.number(self.sum()))
            self.alike(parts[0], parts[-1])
        self.expect(")")
        if name in ("abs", "sqrt") and len(parts) != 1:
            self.refuse(f"{name!r} takes one number")
        given = sum((part.given for part in parts), ())
        first = next((part for part in parts if not part.bare), parts[0])
        kind = tuple(part / 2 for part in first.kind) if name == "sqrt" else first.kind
        column = None if name == "sqrt" else first.column
        sql, derived = f"{name}({', '.join(part.sql for part in parts)})", name == "sqrt" or first.derived
        return Term(sql, "number", given, kind, first.bare, derived, column)

    def number(self, term: Term, beside: Term | None = None) -> Term:
        """The term as a number; what is in quotes is a quantity."""
        if term.sort == "quoted":
            return self.quantity(str(term.given[0]), beside)
        if term.sort != "number":
            self.refuse("a number or a quantity is needed here, not words or a condition")
        return term

    def quantity(self, typed: str, beside: Term | None) -> Term:
        """A quantity in quotes; a bare number in quotes counts in the unit of the column beside it."""
        try:
            return measured(typed, beside.column if beside else None)
        except UnitError as error:
            self.refuse(str(error).rstrip("."))
