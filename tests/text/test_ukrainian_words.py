"""The Ukrainian catalogues say what the English texts say: the same places, numbers and keys, in Ukrainian letters and signs."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest

from diecut_report.text import po_files

ROOT = Path(__file__).parents[2]
CATALOGUES = {
    file.parts[-3]: file for file in [*ROOT.glob("plugins/*/locale/uk.po"), *ROOT.glob("diecut_report/locale/uk.po")]
}
PLACE = re.compile(r"\{[^{}]*\}")
STANDARD = re.compile(r"\b(?:ANSI|DIN|IEC|ISO|ansi)[/ ]\S+(?: \d+)?")
NUMBER = re.compile(r"(?<![\w₀-₉.])\d+(?:\.\d+)?(?!\w)")
KEY = re.compile(r"\b[a-z]+(?:_[a-z0-9]+)+\b")
MIXED = re.compile(r"[а-яіїєґА-ЯІЇЄҐ][a-zA-Z]|[a-zA-Z][а-яіїєґА-ЯІЇЄҐ]|[ыэъёЫЭЪЁ]")
TYPED = re.compile(r"`[^`]*`")  # what is typed stands as it is
SIGNS = re.compile(r"['\"“”]|  ")  # the apostrophe is ’, quotation marks are « »
NAMES = re.compile(r"--?\w+|\b[A-Z]{2,}\b|\[[^\]]*\]")  # options, places of a command, what stands in brackets of YAML
TERMS = {  # of the glossary, each with the beginnings of its words
    "plugin": ("плагін",), "objective": ("ціл",), "study": ("дослідж",), "Pareto": ("парето",), "constraint": ("обмеж",),
    "cyclogram": ("циклограм",), "dwell": ("вист",), "rocker": ("коромис",), "governing check": ("визначальн",),
}  # fmt: skip
TOLD = re.compile(r"([^\W\d_]+)[^:.;]*: (?:задан|прийнят|визначен|обчислен)(ий|а|е|і)\b")
ORDER = re.compile(r"(?<!\w)\w+(?:іть|йте|ьте)(?!\w)", re.IGNORECASE)
ADDED_NUMBERS = {
    "`3,17`",  # two numbers, typed
    "figure 2a",
    "figure 2b",
    "figure 2c",
    "Edition 2006",
    "ansi b29",
}  # written apart or together in one language alone


class Translated(NamedTuple):
    """Hold a text and one form of its translation."""

    english: str
    ukrainian: str

    def differ(self, pattern: re.Pattern[str]) -> Counter[str]:
        """Return what of a pattern only one of the two has, apart from places and names of standards."""
        english, ukrainian = (
            Counter(pattern.findall(STANDARD.sub("", PLACE.sub("", text)))) for text in (self.english, self.point)
        )
        return (english - ukrainian) + (ukrainian - english)

    @property
    def point(self) -> str:
        """The translation with its decimal commas as points."""
        return re.sub(r"(\d),(\d)", r"\1.\2", self.ukrainian)


@cache
def translations(name: str) -> tuple[Translated, ...]:
    """Return all texts of a catalogue."""
    return tuple(_read(CATALOGUES[name]))


def _read(file: Path) -> Iterator[Translated]:
    for message in po_files.read(file, "uk"):
        forms = message.string if isinstance(message.string, tuple) else (message.string,)
        english = message.id if isinstance(message.id, str) else message.id[-1]
        yield from (Translated(english, form) for form in forms if english and form)


pytestmark = pytest.mark.parametrize("name", CATALOGUES)


def test_there_are_words(name: str) -> None:
    assert len(translations(name)) > 10


def test_places_are_the_same(name: str) -> None:
    assert [
        text for text in translations(name) if set(PLACE.findall(text.english)) != set(PLACE.findall(text.ukrainian))
    ] == []


def test_numbers_are_the_same(name: str) -> None:
    told = [text for text in translations(name) if not any(part in text.english for part in ADDED_NUMBERS)]
    assert [text for text in told if text.differ(NUMBER)] == []


def test_keys_that_are_named_are_the_same(name: str) -> None:
    assert [
        text for text in translations(name) if set(KEY.findall(text.english)) - set(KEY.findall(text.ukrainian))
    ] == []


def test_letters_and_signs_are_ukrainian(name: str) -> None:
    wrong = [
        text
        for text in translations(name)
        if MIXED.search(text.ukrainian) or SIGNS.search(TYPED.sub("x", text.ukrainian.lstrip()))
    ]
    assert wrong == []


def test_a_term_has_one_word(name: str) -> None:
    """As the glossary has it: whoever reads of one thing by two names looks for a second thing."""
    words = {re.compile(rf"(?<![\w.-]){term}s?(?![\w:])", re.IGNORECASE): stems for term, stems in TERMS.items()}
    for text in translations(name):
        told = NAMES.sub("", TYPED.sub("", PLACE.sub("", text.english)))
        found = text.ukrainian.lower()
        assert [
            stems for word, stems in words.items() if word.search(told) and not any(map(found.count, stems))
        ] == [], text


def test_advice_is_an_infinitive(name: str) -> None:
    assert [text for text in translations(name) if ORDER.search(TYPED.sub("", text.ukrainian))] == []


def test_what_is_told_of_a_quantity_has_its_gender(name: str) -> None:
    """Кількість: задана, число: задане, модуль: заданий, оберти: задані."""
    found = [(text, TOLD.fullmatch(text.ukrainian)) for text in translations(name)]
    assert [text.ukrainian for text, told in found if told and told[2] != ending(told[1])] == []


def ending(head: str) -> str:
    """The ending of what is told of a noun, or of one whose adjective stands first."""
    if head.endswith(("ння", "ття")):
        return "е"
    return (
        "а"
        if head.endswith("ість")
        else {"а": "а", "я": "а", "е": "е", "о": "е", "і": "і", "и": "і"}.get(head[-1], "ий")
    )
