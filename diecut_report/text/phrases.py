"""Texts that remember what they were filled with, so that they can be said in another language.

A ``Phrase`` is the English sentence itself, a ``str``, and goes wherever a text goes; its template and values are asked for when
the results are finished.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from types import MappingProxyType
from typing import Any

PLACE = re.compile(
    r"\{(\w[\w.]*(?::[a-z]+)?)\}"
)  # ``{name}``; ``{name:capital}`` and ``{name:small}`` say how it begins
CAPITAL, SMALL = ":capital", ":small"
PLAIN = re.compile(r"[\w./@+'’-]+(?: [\w./@+'’-]+)*…?")  # names of people and files
LONGEST_CELL = 80
NOTHING: Mapping[str, str] = MappingProxyType({})
MessageData = dict[str, Any]


class Phrase(str):
    """Hold a text made of a template and of what stands at its places: ``Phrase("set {key} to {low}", key=key, low=told(low, "mm"))``.

    The template is what is translated. A value that is a phrase, too, is translated by itself; any other is a number with its unit, a
    key or a name, and stands as it is but for the sign of decimals.
    """

    __slots__ = ("template", "values")
    template: str
    values: Mapping[str, str]

    def __new__(cls, template: str, filling: Mapping[str, object] = NOTHING, /, **named: object) -> Phrase:
        """Fill a template, whose places are named by ``filling`` or by keywords."""
        values = {name: value if isinstance(value, str) else str(value) for name, value in {**filling, **named}.items()}
        made = super().__new__(cls, filled(template, values))
        made.template, made.values = template, values
        return made

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return what a copy is made of."""
        return self.template, dict(self.values)

    def __str__(self) -> str:
        """Return the text, which remembers its parts."""
        return self

    def __add__(self, other: str) -> Phrase:
        """Return both texts one after the other."""
        return Phrase("{first}{next}", first=self, next=phrase(other)) if other else self

    def __radd__(self, other: str) -> Phrase:
        """Return both texts one after the other."""
        return Phrase("{first}{next}", first=phrase(other), next=self) if other else self


class Counted(Phrase):
    """Hold a text that goes with a number ``n``: ``Counted(3, "{n} variant", "{n} variants")``; the first is that of one.

    A language has as many forms of it as it has for numbers; catalogues know the text by the form of one.
    """

    __slots__ = ("many", "number", "one")
    number: int
    one: str
    many: str

    def __new__(
        cls, count: int, one: str, many: str, filling: Mapping[str, object] = NOTHING, /, **named: object
    ) -> Counted:
        """Fill the form that goes with the number; ``n`` is the number, if it is not given in another form."""
        values = {"n": str(count), **filling, **named}
        made: Counted = super().__new__(cls, one if count == 1 else many, values)  # type: ignore[assignment]  # it is of ``cls``
        made.number, made.one, made.many = count, one, many
        return made

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return what a copy is made of."""
        return self.number, self.one, self.many, dict(self.values)


def filled(template: str, values: Mapping[str, str]) -> str:
    """Return a template with its values in; a place without a value stands as it is."""
    if "{" not in template:
        return template

    def said(place: re.Match[str]) -> str:
        name = place[1]
        text = values.get(name, place[0])
        if name.endswith(SMALL) and text[1:2].islower():  # not that of ISO, nor of K factors
            return text[:1].lower() + text[1:]
        return text[:1].upper() + text[1:] if name.endswith(CAPITAL) else text

    return PLACE.sub(said, template)


def phrase(text: str) -> Phrase:
    """Return a text as a phrase: one that is none is its own template."""
    return text if isinstance(text, Phrase) else Phrase(text)


def message(template: str, values: Mapping[str, object]) -> Phrase:
    """Return a template filled with values; without values it may be a phrase already."""
    return Phrase(template, values) if values else phrase(template)


class MessageError(Exception):
    """An error that a user reads: the template of its message, and the values at the template's places."""

    def __init__(self, template: str, /, **values: object) -> None:
        super().__init__(message(template, values))


def capital(sentence: str) -> Phrase:
    """Return a sentence that begins with a capital letter."""
    return Phrase("{sentence:capital}", {f"sentence{CAPITAL}": sentence})


def small(words: str) -> Phrase:
    """Return words that begin with a small letter, unless they begin with a symbol or an abbreviation."""
    return Phrase("{words:small}", {f"words{SMALL}": phrase(words)})


def joined(parts: Iterable[str], between: str) -> str:
    """Return texts with one and the same between them, ``", or "``; each is translated by itself."""
    return named([phrase(part) for part in parts], between)


def named(parts: Sequence[str], between: str) -> str:
    """Return keys or names, which are not translated, with words between them that are."""
    template = f"{{first}}{between}{{next}}"
    return reduce(lambda first, each: Phrase(template, first=first, next=each), parts) if parts else ""


def keys_listed(keys: Sequence[str]) -> str:
    """Return keys as a sentence names them: one, one and another, one, another and a third."""
    *most, last = keys
    return named((named(most, ", "), last) if most else (last,), " and ")


DEEPEST = 40  # messages within messages


def message_data(text: str) -> MessageData:
    """Return a message as plain data: template, values and the English text, as the results file holds it."""
    made = phrase(text)
    values = {name: message_data(value) if isinstance(value, Phrase) else value for name, value in made.values.items()}
    counted = {"one": made.one, "count": made.number} if isinstance(made, Counted) else {}
    return {"template": made.template, "values": values, "text": str.__str__(made)} | counted


def message_of(given: Any, depth: int = 0) -> Phrase:
    """Return a message from plain data; ValueError where its text is not its template with its values."""
    template, values = (given.get(key) for key in ("template", "values")) if isinstance(given, dict) else (None, None)
    known = {"template", "values", "text", "one", "count"}
    if not isinstance(template, str) or not isinstance(values, dict) or given.keys() - known or depth > DEEPEST:
        raise ValueError(phrase("a message is needed: template, values, text"))
    found = {name: value if isinstance(value, str) else message_of(value, depth + 1) for name, value in values.items()}
    made = _counted(given, template, found) if "one" in given or "count" in given else Phrase(template, found)
    if given.get("text") != made:
        raise ValueError(phrase("the text of a message is its template with its values"))
    return made


def _counted(given: Mapping[str, Any], template: str, values: Mapping[str, str]) -> Counted:
    one, count = given.get("one"), given.get("count")
    if not isinstance(one, str) or type(count) is not int or (count == 1 and one != template):
        raise ValueError(phrase("a message that goes with a number has the form of one and the number"))
    return Counted(count, one, template, values)


def cell(text: str) -> str:
    """Return a text of others as one part of a line: in quotes where it could read as more than one, and not without end."""
    short = " ".join(text.split())
    short = short if len(short) <= LONGEST_CELL else f"{short[:LONGEST_CELL]}…"
    return short if PLAIN.fullmatch(short) else json.dumps(short, ensure_ascii=False)


# Keys of configurations as words.


NAMING = ("name", "mechanism")
"""The keys that say what a part of a list is called."""

_TOKEN = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)+")
_JOINED = re.compile(r"\bcrank (?=rocker\b|slider\b)")
_POWERS = re.compile(r"(?<=\bpolynomial )[0-9]+")


def worded(text: str) -> str:
    """Return a text input as words: ``stainless_304`` → stainless 304; other texts as they are.

    ``polynomial_345`` → polynomial 3-4-5, ``crank_rocker`` → crank-rocker.
    """
    if not _TOKEN.fullmatch(text):
        return text
    words = _JOINED.sub("crank-", text.replace("_", " "))
    return _POWERS.sub(lambda powers: "-".join(powers[0]), words)
