"""The words of a condition, or of an expression, where each stands, and the error that tells of a fault there."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from diecut_report.languages.phrases import Phrase, phrase

MOST_LETTERS, MOST_WORDS, DEEPEST = 20_000, 400, 40  # of a condition; brackets in each other
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

    def __init__(self, words: str, place: int | None = None) -> None:
        super().__init__(words)
        self.words, self.place = words, place

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
    found, place = [], _past_blanks(given, 0)
    while place < len(given):
        token, end = _calculated(given, place)
        found.append(token)
        if len(found) > MOST_WORDS:
            raise ConditionError(
                Phrase("the expression has more than {most_words} words. Write it shorter.", most_words=MOST_WORDS),
                place,
            )
        place = _past_blanks(given, end)
    return [*found, Token("end", phrase("the end"), len(given))]


def _calculated(given: str, place: int) -> tuple[Token, int]:
    match = _CALCULATED.match(given, place)
    if match is None:
        raise _not_allowed(given, place, CALCULATED)
    if match["comma"]:
        words = Phrase(
            "“{match}” holds a comma; write a decimal point, or a blank after a comma that parts two values.",
            match=match[0],
        )
        raise ConditionError(words, place)
    if match["word"]:
        return _function(match, given)
    text = f"${{{match['path'].strip()}}}" if match["reference"] else match[0]
    sort = next(sort for group, sort in _SORTS.items() if match[group])
    return Token(sort, text, place), match.end()


def _not_allowed(given: str, place: int, allowed: str) -> ConditionError:
    """What tells of letters that are no word, with what may stand there."""
    letters = repr(given[place : place + 10])
    return ConditionError(
        Phrase("{given} is not allowed here; allowed: {allowed}.", given=letters, allowed=allowed), place
    )


def _function(match: re.Match[str], given: str) -> tuple[Token, int]:
    """Return a word, which is a function or a fault."""
    if not given[match.end() :].lstrip().startswith("("):
        advice = phrase("a value of the configuration stands as ${NAME.KEY}, a unit behind its number")
        raise ConditionError(
            Phrase("{match} is not expected here; {advice}.", match=repr(match[0]), advice=advice), match.start()
        )
    return Token(
        "function", match[0].lower() if match[0].lower() in FUNCTIONS else match[0], match.start()
    ), match.end()


def tokens(given: str, known: Collection[str]) -> list[Token]:
    """Split a condition into its words, the end among them; known names are taken whole, whatever they are made of."""
    if len(given) > MOST_LETTERS:
        words = Phrase(
            "the condition has {count} characters; at most {most_letters} are allowed. Write several conditions.",
            count=len(given),
            most_letters=MOST_LETTERS,
        )
        raise ConditionError(words)
    whole = re.compile("(" + "|".join(map(re.escape, sorted(known, key=len, reverse=True))) + r")(?![\w.])")
    found, place = [], _past_blanks(given, 0)
    while place < len(given):
        name = whole.match(given, place) if known else None
        token, end = (_known(name), name.end()) if name else _token(given, place, known)
        found.append(token)
        if len(found) > MOST_WORDS:
            words = Phrase(
                "the condition has more than {most_words} words. Write several conditions.", most_words=MOST_WORDS
            )
            raise ConditionError(words, place)
        place = _past_blanks(given, end)
    return [*found, Token("end", phrase("the end"), len(given))]


def _past_blanks(given: str, place: int) -> int:
    return len(given) - len(given[place:].lstrip())


def _known(match: re.Match[str]) -> Token:
    word = match[0].lower()
    return Token("keyword", word, match.start()) if word in KEYWORDS else Token("name", match[0], match.start())


def _token(given: str, place: int, known: Collection[str]) -> tuple[Token, int]:
    match = _TOKEN.match(given, place)
    if match is None:
        raise _not_allowed(given, place, ALLOWED)
    if match["quantity"]:
        words = Phrase(
            "“{quantity}”: put a quantity in quotes: '{value} {unit}'.",
            quantity=match["quantity"],
            value=match["value"],
            unit=match["unit"],
        )
        raise ConditionError(words, place)
    return _sorted(match, given, known), match.end()


def _sorted(match: re.Match[str], given: str, known: Collection[str]) -> Token:
    """Return the word of a match, with its sort."""
    text, place = match[0], match.start()
    if match["quoted"]:
        inside = text[1:-1].replace(text[0] * 2, text[0])
        return Token("name" if text[0] == '"' and inside in known else "text", inside, place)
    if match["word"]:
        return _worded(text, place, given[match.end() :].lstrip().startswith("("))
    return Token("name" if match["path"] else "number" if match["number"] else "sign", text, place)


def _worded(text: str, place: int, is_called: bool) -> Token:
    lower = text.lower()
    if lower in KEYWORDS:
        return Token("keyword", lower, place)
    return Token("function", lower if lower in FUNCTIONS else text, place) if is_called else Token("name", text, place)
