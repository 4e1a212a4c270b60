"""Texts in another language: looked up as a whole, or made anew of their template and values."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar, Token
from functools import cached_property
from typing import NamedTuple

from diecut_report.errors import Problem
from diecut_report.text.catalogues import SOURCE_LANGUAGE, Catalogues, built_in
from diecut_report.text.phrases import Counted, Phrase, filled

DECIMAL = re.compile(r"(?<![\w.,])(\d+)\.(\d+)(?![\w.]*\.?\d)")
CITATION = "citation"  # the context of the words about sources
PAPER = "paper"  # the context of papers, each as it is cited in the language that it is written in
EQUATIONS = {
    re.compile(r"(?P<paper>\b\d{3}) eq\. (?P<numbers>\d[\w–-]*(?:, \d[\w–-]*)*)"): "{paper} eq. {numbers}",
    re.compile(r"\beq\. (?P<numbers>\d[\w–-]*(?:, \d[\w–-]*)*)"): "eq. {numbers}",
}


def with_decimal(text: str, sign: str) -> str:
    """Return a text with another sign of decimals in its numbers."""
    return text if sign == "." else DECIMAL.sub(rf"\1{sign}\2", text)


class Translator:
    """Translate texts into the language of the catalogues."""

    def __init__(self, catalogues: Catalogues, decimal: str) -> None:
        self.catalogues, self.decimal = catalogues, decimal
        self.unknown: dict[str, None] = {}

    def of(self, kind: str) -> Callable[[str], str]:
        """Return what translates the texts of a kind of mechanism."""
        return lambda text: self.said(text, kind)

    def said(self, text: str, kind: str = "") -> str:
        """Return a text in the language; one that no catalogue has stands as it is."""
        if not isinstance(text, Phrase):
            return self.known(text, kind) or text
        values = {name: self.said(value, kind) if isinstance(value, Phrase) else self.numbers(value)
                  for name, value in text.values.items()}  # fmt: skip
        return filled(self._form(text, kind) or text.template, values)

    def known(self, text: str, kind: str = "") -> str | None:
        """Return a text that a catalogue has; None where none has it."""
        for catalogue in self.catalogues.ahead(kind):
            if found := catalogue.text(text):
                return found
        return None

    def _form(self, text: Phrase, kind: str) -> str | None:
        """A template in the language, of what is counted the form that goes with its number."""
        if not isinstance(text, Counted):
            return self.known(text.template, kind)
        found = (each.plural(text.one, text.number) for each in self.catalogues.ahead(kind))
        return next(filter(None, found), None)

    def numbers(self, text: str) -> str:
        """Return a text with the language's sign of decimals in its numbers."""
        return with_decimal(text, self.decimal)

    def source(self, text: str, kind: str = "") -> str:
        """Return where a formula comes from: its words in the language, names of authors and standards as they are.

        What a plugin of others names is in its catalogue as a whole, or stands as it is: its words may be part of a title.
        """
        if kind and not built_in(kind):
            own = self.catalogues.of(kind)
            return (own.text(text) if own else None) or text
        for pattern, template in EQUATIONS.items():
            wanted = self._citation.get(template, template)
            text = pattern.sub(lambda found, wanted=wanted: filled(wanted, found.groupdict()), text)  # type: ignore[misc]
        return self._cited.sub(lambda words: self._citation[words[0]], text)

    def paper(self, citation: str, kind: str = "") -> str:
        """Return how a work is cited in the language: one that is written in it by its own title, others as they are given."""
        return self._papers.get(citation) or self.known(citation, kind) or citation

    @cached_property
    def _papers(self) -> dict[str, str]:
        return self.catalogues.program.of_context(PAPER)

    @cached_property
    def _citation(self) -> dict[str, str]:
        return self.catalogues.program.of_context(CITATION)

    @cached_property
    def _cited(self) -> re.Pattern[str]:
        longest_first = sorted(self._citation, key=len, reverse=True)
        return re.compile(rf"(?<![\w{{])(?:{'|'.join(map(re.escape, longest_first))})(?![\w}}])")


# The language in which is being spoken: that of messages, and of documents while they are made.
#
# It holds for all that is called within ``speaking``. What goes into results, and what is stored, is English, as phrases.


class Speech(NamedTuple):
    """Hold a language with its sign of decimals, and what says texts in it; nothing for English, in which they are written."""

    language: str
    decimal: str
    translator: Translator | None = None


ENGLISH = Speech(SOURCE_LANGUAGE, ".")
_NOW = ContextVar("speech", default=ENGLISH)


def speak(language: str, catalogues: Catalogues | None = None) -> Token[Speech]:
    """Speak a language from now on; UnknownLanguage where the program has no words of it."""
    if language == SOURCE_LANGUAGE:
        return _NOW.set(ENGLISH)
    known = catalogues or Catalogues(language)
    decimal = known.program.text(".", "decimal") or "."
    return _NOW.set(Speech(language, decimal, Translator(known, ".")))  # what a message names stands as it is typed


@contextmanager
def speaking(language: str, catalogues: Catalogues | None = None) -> Iterator[None]:
    """Speak a language meanwhile."""
    before = speak(language, catalogues)
    try:
        yield
    finally:
        _NOW.reset(before)


def spoken_language() -> str:
    """Return the language that is spoken."""
    return _NOW.get().language


def catalogues_spoken() -> Catalogues | None:
    """Return the catalogues of the language that is spoken; None for the one that texts are written in."""
    translator = _NOW.get().translator
    return None if translator is None else translator.catalogues


def decimal_sign() -> str:
    """Return its sign of decimals."""
    return _NOW.get().decimal


def know_plugins(kinds: Iterable[str]) -> None:
    """Let the words of these plugins be known in the language that is spoken; UserError where a catalogue cannot be read."""
    translator = _NOW.get().translator
    if translator is not None:
        translator.catalogues.know(kinds)


def know_all_plugins() -> list[Problem]:
    """Let the words of all plugins be known; return what is wrong with catalogues of others that cannot be read."""
    translator = _NOW.get().translator
    return [] if translator is None else translator.catalogues.know_all()


def said(text: str, kind: str = "") -> str:
    """Return a text, or a phrase, in the language that is spoken; one that no catalogue has stands as it is."""
    translator = _NOW.get().translator
    return text if translator is None else translator.said(text, kind)


def say(template: str, /, **named: object) -> str:
    """Return a text with its places filled in the language that is spoken."""
    return said(Phrase(template, named))


def say_counted(count: int, one: str, many: str, /, **named: object) -> str:
    """Return what is said of a number ``n`` of things in the language that is spoken; ``one`` is the form of one of them."""
    return said(Counted(count, one, many, named))


def localised(text: str) -> str:
    """Return a text with the sign of decimals of the language that is spoken in its numbers."""
    return with_decimal(text, _NOW.get().decimal)
