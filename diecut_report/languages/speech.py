"""The language in which is being spoken: that of messages, and of documents while they are made.

It holds for all that is called within ``speaking``. What goes into results, and what is stored, is English, as phrases.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar, Token
from typing import NamedTuple

from diecut_report.errors import Problem
from diecut_report.languages.catalogues import SOURCE_LANGUAGE, Catalogues
from diecut_report.languages.phrases import Counted, Phrase
from diecut_report.languages.translation import Translator, with_decimal


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
    return _NOW.set(Speech(language, decimal, Translator(known, {}, ".")))  # what a message names stands as it is typed


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
