"""The catalogues: complete, up to date, with the same placeholders as the English texts, and in one alphabet."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from babel.messages.catalog import Message

from diecut_report.config.discovery import Discovery
from diecut_report.declaration.texts import texts
from diecut_report.languages import po_files
from diecut_report.languages.catalogues import languages
from tools.make_catalogues import ROOT, untranslatable, wanted

KINDS = sorted(Discovery().origins)
FILES = sorted([*ROOT.glob("diecut_report/locale/*.po"), *ROOT.glob("plugins/*/locale/*.po")])
PLACE = re.compile(r"\{[^{}]*\}")
WORD = re.compile(r"[^\W\d_]+")
CYRILLIC = re.compile(r"[\u0400-\u04ff]")
LATIN = re.compile(r"[A-Za-z]")


def name(file: Path) -> str:
    return str(file.relative_to(ROOT))


@cache
def messages(file: Path) -> tuple[Message, ...]:
    return tuple(message for message in po_files.read(file, file.stem) if message.id)


def pairs(file: Path) -> Iterator[tuple[str, str]]:
    """Each English text with its translation; of what is counted the form for many with each of the translated ones."""
    for message in messages(file):
        if isinstance(message.id, tuple):
            yield from ((message.id[1], form) for form in message.string)
        else:
            yield message.id, str(message.string)


def test_each_language_has_a_catalogue_of_each_kind() -> None:
    wanted = {f"plugins/{kind}/locale/{language}.po" for kind in KINDS for language in languages()[1:]}
    assert {name(file) for file in FILES} == wanted | {f"diecut_report/locale/{each}.po" for each in languages()[1:]}


@pytest.mark.parametrize("file", FILES, ids=name)
def test_nothing_is_missing_or_only_guessed(file: Path) -> None:
    assert [english for english, said in pairs(file) if not said.strip()] == []
    assert [message.id for message in messages(file) if message.fuzzy] == []


def test_the_files_hold_the_texts_that_there_are() -> None:
    """So no text of a declaration or of code is missing in them, and none is there that is not needed any more."""
    for file, _, found in wanted("uk"):
        needed = {(each.context, each.text) for each in found}
        there = {(m.context, m.id[0] if isinstance(m.id, tuple) else m.id) for m in messages(file)}
        assert there == needed, f"run: python -m tools.make_catalogues ({name(file)})"


@pytest.mark.parametrize("file", FILES, ids=name)
def test_a_translation_has_the_placeholders_of_its_text(file: Path) -> None:
    places = {
        english: (sorted(set(PLACE.findall(english))), sorted(set(PLACE.findall(said))))
        for english, said in pairs(file)
    }
    assert {english: both for english, both in places.items() if both[0] != both[1]} == {}


@pytest.mark.parametrize("file", FILES, ids=name)
def test_no_word_has_letters_of_two_alphabets(file: Path) -> None:
    words = {word for _, said in pairs(file) for word in WORD.findall(PLACE.sub(" ", said))}
    assert {word for word in words if CYRILLIC.search(word) and LATIN.search(word)} == set()


@pytest.mark.parametrize("file", FILES, ids=name)
def test_latin_words_of_a_translation_are_those_of_its_text(file: Path) -> None:
    """Keys, symbols, units and names stay as they are; anything else is a word that was not translated, or misspelt."""
    found = {}
    for english, said in pairs(file):
        strange = {
            w
            for w in WORD.findall(PLACE.sub(" ", said))
            if LATIN.search(w) and w.lower() not in english.lower() and len(w) > 1
        }
        found |= {english: strange} if strange else {}
    assert found == {}


@pytest.mark.parametrize("kind", KINDS)
def test_what_code_makes_of_words_and_numbers_is_a_phrase(kind: str) -> None:
    declared = list(texts(Discovery().mechanism(kind)))
    assert [found.text for found in untranslatable(ROOT / "plugins" / kind, declared)] == []
