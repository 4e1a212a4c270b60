"""The live page's template and script: each of their words is translated, and the script has those that it says."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser

from diecut_report.live.page import WORDS, assets, page
from diecut_report.text.translation import speaking

FILE = "knife.yaml"
SAME = {FILE, "PDF"}  # in each language
CYRILLIC = re.compile("[а-яіїєґ]")
BY_STATE = {"status_": {"pass", "warn", "fail", "not_checked"}}


class Read(HTMLParser):
    """What a reader of a page is told: its texts and names, the words of its script."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.texts: list[str] = []
        self.words: dict[str, str] = {}
        self.feed(text)

    def handle_starttag(self, _tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.texts += [given["aria-label"] or ""] if "aria-label" in given else []
        self.words |= json.loads(given.get("data-words") or "{}")

    def handle_data(self, data: str) -> None:
        self.texts += [data.strip()] if data.strip() else []


def test_all_that_stands_on_it_is_in_the_language_that_is_spoken() -> None:
    with speaking("uk"):
        read = Read(page(FILE).decode())
    assert len(read.texts) > 20 and read.words.keys() == WORDS.keys()
    assert [
        text for text in (*read.texts, *read.words.values()) if text not in SAME and not CYRILLIC.search(text)
    ] == []


def test_the_words_of_the_script_are_those_that_it_says_with_the_same_places() -> None:
    script = assets()["live.js"].content.decode()
    said = set(re.findall(r'\bt\("(\w+)"[,)]', script))
    for start in re.findall(r'\bt\("(\w+)" \+', script):
        said |= {start + state for state in BY_STATE[start]}
    assert said == set(WORDS)
    for name, places in re.findall(r'\bt\("(\w+)", \{([^}]*)\}', script):
        assert set(re.findall(r"(\w+):", places)) == set(re.findall(r"\{(\w+)\}", WORDS[name])), name
