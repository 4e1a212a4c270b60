"""The grammar of conditions, which is Python's: the words of a condition are written as a Python expression and parsed by ``ast``.

Each number, text, name and function stands there as ``_0``, ``_1``, …, so that nothing of a text is Python but signs, brackets
and ``and or not``. What Python does not know is written as what it knows and conditions do not use:

| condition             | Python             |
| --------------------- | ------------------ |
| ``=``, ``<>``, ``≤``  | ``==``, ``!=``, ``<=`` |
| ``^``                 | ``**``             |
| ``x in (1, 2)``       | ``_0 in [_1, _2]`` |
| ``x is not null``     | ``_0 is not _1``   |
| ``x between 1 and 2`` | ``_0 is _1 is _2`` |
| ``x like 'a%'``       | ``_0 in ~_1``      |
"""

from __future__ import annotations

import ast
from bisect import bisect_right
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import NoReturn

from diecut_report.conditions.words import (
    DEEPEST,
    ConditionError,
    Token,
    tokens,
)
from diecut_report.languages.phrases import Phrase, phrase

OPERAND = phrase("a name, a number or a quantity")
_SIGNS = {"=": "==", "<>": "!=", "≠": "!=", "≤": "<=", "≥": ">=", "^": "**", "−": "-"}
_JOINING = ("**", "<=", ">=", "==", "!=", "<", ">", "+", "-", "*", "/")
_BEFORE_NOT = ("and", "or", "not", "(")
_VALUES = ("number", "text", "name")


@dataclass(frozen=True)
class Parsed:
    """Hold a condition as Python parsed it; each name ``_3`` in it stands for the word 3."""

    body: ast.expr
    words: Sequence[Token]
    starts: Sequence[int]  # where each word begins in the Python text

    def word(self, at: ast.expr) -> Token:
        """Return the word at which a part begins; for a name the one that it stands for."""
        if isinstance(at, ast.Name):
            return self.words[int(at.id[1:])]
        return self.words[bisect_right(self.starts, at.col_offset) - 1]


def parsed(given: str, known: Collection[str]) -> Parsed:
    """Parse a condition; ConditionError in words, with the place, for what is not a condition by its words alone."""
    return parsed_words(tokens(given, known))


def parsed_words(words: Sequence[Token]) -> Parsed:
    """Parse what was split into words already."""
    pieces = _GrammarWriter(words).pieces()
    starts, at = [], 0
    for piece in pieces:
        starts.append(at)
        at += len(piece) + 1
    return Parsed(ast.parse(" ".join(pieces), mode="eval").body, words, starts)


@dataclass
class _Bracket:
    """An open bracket, or the whole text: what it is for, and how many ``between`` in it wait for their ``and``."""

    sort: str
    waiting: int = 0


class _GrammarWriter:
    """Writes the words of a condition as Python, one piece for each, and refuses what does not follow on each other."""

    def __init__(self, words: Sequence[Token]) -> None:
        self.words, self.at = words, 0
        self.written: list[str] = []
        self.open = [_Bracket("whole")]

    @property
    def next(self) -> Token:
        return self.words[self.at]

    def pieces(self) -> list[str]:
        """The Python text of each word; the end has an empty one."""
        if self.next.sort == "end":
            raise ConditionError(phrase("the condition is empty; write a comparison."), 0)
        is_operand_next = True
        while self.next.sort != "end":
            is_operand_next = self._before_value() if is_operand_next else self._after_value()
        if is_operand_next:
            self._lack()
        self._close("end")
        return [*self.written, ""]

    def _write(self, piece: str) -> None:
        self.written.append(piece)
        self.at += 1

    def _lack(self) -> NoReturn:
        raise ConditionError(
            Phrase("{operand} is missing before {shown}.", operand=OPERAND, shown=self.next.shown), self.next.place
        )

    def _unexpected(self) -> ConditionError:
        return ConditionError(Phrase("{shown} is not expected here.", shown=self.next.shown), self.next.place)

    def _is(self, *wanted: str) -> bool:
        return self.next.sort in ("keyword", "sign") and self.next.text in wanted

    # Each of the two writes what may stand there, and returns whether a value is to come.

    def _before_value(self) -> bool:
        word = self.next
        if word.sort in _VALUES or self._is("true", "false"):
            self._write(f"_{self.at}")
            return False
        if self._is("-", "−", "+") or (self._is("not") and (self.written or ["("])[-1] in _BEFORE_NOT):
            self._write(_SIGNS.get(word.text, word.text))
            return True
        if word.sort == "function":
            self._write(f"_{self.at}")
            return self._opened("call", "(")
        if self._is("("):
            return self._opened("group", "(")
        if self._is(")") and self.open[-1].sort in ("call", "list") and self.written[-1] in (",", "("):  # f(), f(x,)
            return self._after_value()
        self._lack()

    def _opened(self, sort: str, bracket: str) -> bool:
        self.open.append(_Bracket(sort))
        if len(self.open) > DEEPEST + 1:
            raise ConditionError(
                phrase("brackets stand too deep in each other. Write several conditions."), self.next.place
            )
        self._write(bracket)
        return True

    def _after_value(self) -> bool:
        word = self.next
        if self._is("and") and self.open[-1].waiting:
            self.open[-1].waiting -= 1
            self._write("is")
        elif self._is("and", "or"):
            self._decided()
            self._write(word.text)
        elif (sign := _SIGNS.get(word.text, word.text)) in _JOINING and word.sort == "sign":
            self._write(sign)
        elif self._is(","):
            self._comma()
        elif self._is(")"):
            self._close(")")
            return False
        else:
            return self._worded()
        return True

    def _worded(self) -> bool:
        """``is null``, ``in``, ``between``, ``like`` and their contraries."""
        if self._is("is"):
            return self._null()
        negated = "not " if self._is("not") else ""
        if negated:
            self.written.append("")
            self.at += 1
            if not self._is("in", "between", "like"):
                raise ConditionError(phrase("'in', 'between' or 'like' is missing after 'not'."), self.next.place)
        if self._is("between"):
            self.open[-1].waiting += 1
            self._write("is " + negated)
            return True
        if self._is("like"):
            self._write(f"{negated}in ~")
            return True
        if self._is("in"):
            self._write(f"{negated}in")
            self._need("(")
            return self._opened("list", "[")
        raise self._unexpected()

    def _null(self) -> bool:
        self._write("is")
        if self._is("not"):
            self._write("not")
        self._need("null")
        self._write(f"_{self.at}")
        return False

    def _need(self, wanted: str) -> None:
        if not self._is(wanted):
            raise ConditionError(
                Phrase("{wanted} is missing before {shown}.", wanted=repr(wanted), shown=self.next.shown),
                self.next.place,
            )

    def _comma(self) -> None:
        self._decided()
        if self.open[-1].sort not in ("call", "list"):
            raise self._unexpected()
        self._write(",")

    def _close(self, by: str) -> None:
        self._decided()
        closed = self.open.pop()
        if by == "end" and closed.sort != "whole":
            raise ConditionError(Phrase("')' is missing before {shown}.", shown=self.next.shown), self.next.place)
        if by == ")" and closed.sort == "whole":
            raise self._unexpected()
        if by == ")":
            self._write("]" if closed.sort == "list" else ")")

    def _decided(self) -> None:
        if self.open[-1].waiting:
            raise ConditionError(
                Phrase("'and' is missing before {shown}: write between … and ….", shown=self.next.shown),
                self.next.place,
            )
