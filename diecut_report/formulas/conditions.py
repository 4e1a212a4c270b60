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
import re
from bisect import bisect_right
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import NoReturn

from diecut_report.quantities.units import DIMENSIONS, Kind, Unit, kind_name, si_text, unit
from diecut_report.text.phrases import Phrase, message, phrase

# The words of a condition, or of an expression, where each stands, and the error that tells of a fault there.


MAX_LENGTH, MAX_WORDS, MAX_BRACKETS = 20_000, 400, 40  # of a condition; brackets in each other
MAX_SHOWN_LETTERS = 60  # of what is not a word, in a message
KEYWORDS = ("and", "or", "not", "in", "is", "null", "between", "like", "true", "false")
FUNCTIONS = ("abs", "min", "max", "sqrt")
ALLOWED = (
    "names, numbers, quantities and texts in quotes, + - * / **, comparisons, and, or, not, in (…), between … and …, like, "
    f"is null, {', '.join(FUNCTIONS)}"
)

CALCULATED = "references, numbers, quantities with their units, + - * / **, brackets, " + ", ".join(FUNCTIONS)

_NUMBER = r"(?>(?:\d+(?:_\d+)*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
_UNIT = rf"(?!(?:{'|'.join(KEYWORDS)})\b)[^\W\d_°%][^\W_]*(?:[*/^·]+[^\W_]+)*|[°%]\w*"
_TOKEN = re.compile(
    rf"""(?P<quantity>(?P<value>{_NUMBER})[^\S\n]*(?P<unit>(?i:{_UNIT})))
    |(?P<number>{_NUMBER}(?![\w.]))
    |(?P<quoted>'(?:[^']|'')*'|"(?:[^"]|"")*")
    |(?P<sign>\*\*|<=|>=|==|!=|<>|[-+*/^(),<>=≤≥≠−])
    |(?P<path>(?:mechanisms\.[^\W\d_][\w-]*|[^\W\d]\w*)(?:\.\w+)+)
    |(?P<word>[^\W\d]\w*)""",
    re.VERBOSE,
)
_NAME = rf"(?!(?:{'|'.join(FUNCTIONS)})\s*\()(?:[^\W\d_]|[°%])[^\W_]*(?:(?:\*\*|\^)-?\d\d?)?"
_CALCULATED = re.compile(
    rf"""(?P<reference>\$\{{(?P<path>[^${{}}]*)\}})
    |(?P<comma>{_NUMBER},\d+)
    |(?P<quantity>{_NUMBER}[^\S\n]*(?:[^\S\n]1/)?{_NAME}(?:[*/·](?:{_NAME}|\({_NAME}(?:[*/·]{_NAME})*\)))*)
    |(?P<number>{_NUMBER}(?![\w.]))
    |(?P<sign>\*\*|[-+*/^(),−])
    |(?P<word>[^\W\d]\w*)""",
    re.VERBOSE,
)
_SORTS = {"reference": "name", "quantity": "text", "number": "number", "sign": "sign"}  # of a word, by its group


class ConditionError(ValueError):
    """Report a condition that cannot be used: words that say why and what to write instead; ``place`` counts its letters from 0."""

    def __init__(self, template: str, place: int | None = None, /, **values: object) -> None:
        self.words, self.place = message(template, values), place
        super().__init__(self.words)

    def __str__(self) -> str:
        where = "" if self.place is None else Phrase(" (At character {place}.)", place=self.place + 1)
        return self.words + where


@dataclass(frozen=True)
class Token:
    """Hold a word of a condition and where it stands (from 0).

    ``sort`` is number, text, name, function, keyword, sign or end; ``text`` what it says, without the quotes.
    """

    sort: str
    text: str
    place: int

    @property
    def shown(self) -> str:
        """Return the word as messages name it."""
        return self.text if self.sort == "end" else repr(self.text)


def calculation(given: str) -> list[Token]:
    """Split an expression of a configuration into its words, the end among them: references are names, quantities texts."""
    too_long = phrase("the expression has more than {most_words} words. Write it shorter.")
    return _split(given, lambda place: _calculated(given, place), too_long)


def _split(given: str, word_at: Callable[[int], tuple[Token, int]], too_long: str) -> list[Token]:
    found, place = list[Token](), _past_blanks(given, 0)
    while place < len(given):
        token, end = word_at(place)
        found.append(token)
        if len(found) > MAX_WORDS:
            raise ConditionError(too_long, place, most_words=MAX_WORDS)
        place = _past_blanks(given, end)
    return [*found, Token("end", phrase("the end"), len(given))]


def _calculated(given: str, place: int) -> tuple[Token, int]:
    match = _CALCULATED.match(given, place)
    if match is None:
        raise _not_allowed(given, place, CALCULATED)
    if match["comma"]:
        template = "“{match}” holds a comma; write a decimal point, or a blank after a comma that parts two values."
        raise ConditionError(template, place, match=match[0])
    if match["word"]:
        if not given[match.end() :].lstrip().startswith("("):
            advice = phrase("a value of the configuration stands as ${NAME.KEY}, a unit behind its number")
            raise ConditionError("{match} is not expected here; {advice}.", place, match=repr(match[0]), advice=advice)
        return _worded(match[0], place, is_called=True), match.end()
    text = f"${{{match['path'].strip()}}}" if match["reference"] else match[0]
    sort = next(sort for group, sort in _SORTS.items() if match[group])
    return Token(sort, text, place), match.end()


def _not_allowed(given: str, place: int, allowed: str) -> ConditionError:
    """What is wrong with letters that are not a word, with what may stand there."""
    whole = given[place:].split(maxsplit=1)[0]
    letters = repr(whole if len(whole) <= MAX_SHOWN_LETTERS else f"{whole[: MAX_SHOWN_LETTERS - 1]}…")
    if whole.startswith("${"):
        return ConditionError("{reference} has no closing brace; write ${NAME.KEY}.", place, reference=letters)
    return ConditionError("{given} is not allowed here; allowed: {allowed}.", place, given=letters, allowed=allowed)


def tokens(given: str, known: Collection[str]) -> list[Token]:
    """Split a condition into its words, the end among them; known names are taken whole, whatever they are made of."""
    if len(given) > MAX_LENGTH:
        template = "the condition has {count} characters; at most {most_letters} are allowed. Write several conditions."
        raise ConditionError(template, count=len(given), most_letters=MAX_LENGTH)
    whole = re.compile("(" + "|".join(map(re.escape, sorted(known, key=len, reverse=True))) + r")(?![\w.])")

    def word_at(place: int) -> tuple[Token, int]:
        if name := whole.match(given, place) if known else None:
            return _worded(name[0], place, is_called=False), name.end()
        return _token(given, place, known)

    return _split(given, word_at, phrase("the condition has more than {most_words} words. Write several conditions."))


def _past_blanks(given: str, place: int) -> int:
    return len(given) - len(given[place:].lstrip())


def _token(given: str, place: int, known: Collection[str]) -> tuple[Token, int]:
    match = _TOKEN.match(given, place)
    if match is None:
        raise _not_allowed(given, place, ALLOWED)
    if match["quantity"]:
        template = "“{quantity}”: put a quantity in quotes: '{value} {unit}'."
        raise ConditionError(template, place, quantity=match["quantity"], value=match["value"], unit=match["unit"])
    text = match[0]
    if match["quoted"]:
        inside = text[1:-1].replace(text[0] * 2, text[0])
        return Token("name" if text[0] == '"' and inside in known else "text", inside, place), match.end()
    if match["word"]:
        return _worded(text, place, is_called=given[match.end() :].lstrip().startswith("(")), match.end()
    return Token("name" if match["path"] else "number" if match["number"] else "sign", text, place), match.end()


def _worded(text: str, place: int, *, is_called: bool) -> Token:
    lower = text.lower()
    if lower in KEYWORDS:
        return Token("keyword", lower, place)
    return Token("function", lower if lower in FUNCTIONS else text, place) if is_called else Token("name", text, place)


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


def parsed(words: Sequence[Token]) -> Parsed:
    """Parse the words of a condition; ConditionError in words, with the place, for what is not one by its words alone."""
    pieces = _GrammarWriter(words).pieces()
    starts = [0, *accumulate(len(piece) + 1 for piece in pieces[:-1])]
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
            raise ConditionError("the condition is empty; write a comparison.", 0)
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
        template = "{operand} is missing before {shown}."
        raise ConditionError(template, self.next.place, operand=OPERAND, shown=self.next.shown)

    def _unexpected(self) -> ConditionError:
        return ConditionError("{shown} is not expected here.", self.next.place, shown=self.next.shown)

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
        if len(self.open) > MAX_BRACKETS + 1:
            raise ConditionError("brackets stand too deep in each other. Write several conditions.", self.next.place)
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
            self._decided()
            if self.open[-1].sort not in ("call", "list"):
                raise self._unexpected()
            self._write(",")
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
            self._write("")
            if not self._is("in", "between", "like"):
                raise ConditionError("'in', 'between' or 'like' is missing after 'not'.", self.next.place)
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
            template = "{wanted} is missing before {shown}."
            raise ConditionError(template, self.next.place, wanted=repr(wanted), shown=self.next.shown)

    def _close(self, by: str) -> None:
        self._decided()
        closed = self.open.pop()
        if by == "end" and closed.sort != "whole":
            raise ConditionError("')' is missing before {shown}.", self.next.place, shown=self.next.shown)
        if by == ")" and closed.sort == "whole":
            raise self._unexpected()
        if by == ")":
            self._write("]" if closed.sort == "list" else ")")

    def _decided(self) -> None:
        if self.open[-1].waiting:
            template = "'and' is missing before {shown}: write between … and …."
            raise ConditionError(template, self.next.place, shown=self.next.shown)


# The kinds of quantities in conditions and expressions, in words.


NUMBER: Kind = (0.0,) * len(DIMENSIONS)
LENGTH, ANGLE = DIMENSIONS.index("length"), DIMENSIONS.index("angle")


def alike(one: Kind, other: Kind) -> bool:
    """Return whether two kinds may be equalled: they are the same, or differ by the angle alone beside a length."""
    return one == other or bool(one[LENGTH] and without_angle(one) == without_angle(other))


def without_angle(kind: Kind) -> Kind:
    """Return a kind without its power of the angle."""
    return (*kind[:ANGLE], 0.0, *kind[ANGLE + 1 :])


def told_kind(kind: Kind, own: str = "") -> str:
    """Return what a kind is, in words; the unit ``own`` names it best where it is of that kind."""
    if kind == NUMBER:
        return phrase("a pure number")
    named = unit(own) if own else None
    return phrase(kind_name(named if named and named.kind == kind else Unit("", 1.0, si_text(kind), kind)))
