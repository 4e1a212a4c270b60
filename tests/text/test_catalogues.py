"""The catalogues hold each text that there is, and no other, all of them translated."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from babel.messages.catalog import Message

from diecut_report.config.plugins import Discovery
from diecut_report.declaration.texts import texts
from diecut_report.text import po_files
from diecut_report.text.catalogues import languages
from tools.make_catalogues import ROOT, untranslatable, wanted

KINDS = sorted(Discovery().origins)
FILES = sorted([*ROOT.glob("diecut_report/locale/*.po"), *ROOT.glob("plugins/*/locale/*.po")])


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


@pytest.mark.parametrize("kind", KINDS)
def test_what_code_makes_of_words_and_numbers_is_a_phrase(kind: str) -> None:
    declared = list(texts(Discovery().mechanism(kind)))
    assert [found.text for found in untranslatable(ROOT / "plugins" / kind, declared)] == []
