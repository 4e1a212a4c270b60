"""A report in Ukrainian: no English word is left in it, and numbers have a decimal comma."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.press import Press
from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ResultsRecord
from diecut_report.text import po_files
from tests.examples import few

ROOT = Path(__file__).parents[2]
CONFIGS = ROOT / "configs"
LATIN = re.compile(
    r"(?<![\w.])[A-Za-z][a-z]{2,}[A-Za-z]*(?![a-z]*[_\d])"
)  # symbols and units are shorter, or have other signs; hashes have digits
VERBATIM = ("id", "symbol", "unit", "path", "source_text", "file", "kind", "name", "sha256", "missing")
TYPED = ("text", "note")  # of what the user gave: elsewhere they are the program's words
GIVEN = ("inputs", "press", "config")
WORD = {"symbol": re.compile("[A-Za-z]+")}  # an index stands by itself; of a key bearing_a no word "bearing" is known
CITED = ("paper", "citation")  # the contexts of what stands in other languages: titles
OWN = {
    "cooling",  # keys of a configuration that are not there
    "transport",
    "true",
    "cos",
    "arccos",
    "arctan",
    "Num",
    "Sci",
    "Python",
    "diecut",
    "report",
    "verify",
    "results",
    "json",
    "config",
    "yaml",
    "SHA",
    "rpm",
    "mrad",
    "rad",
    "min",
    "max",
    "PDF",
    "tan",
    "sin",
    "steels",  # a table of one's own
}
MARKUP = (r"<(style|script|math|pre)\b.*?</\1>", r"<a [^>]*download.*?</a>", r'<(\w+) class="?(?:key|sy)\b.*?</\1>')


def visible(page: str) -> list[str]:
    """The texts of a page, those of its figures too; formulas, keys and symbols left out."""
    figures = " ".join(re.findall(r'aria-label="([^"]*)"', page))
    for pattern in MARKUP:
        page = re.sub(pattern, " ", page, flags=re.DOTALL)
    return [line for line in re.split(r"<[^>]*>", html.unescape(page + figures)) if line.strip()]


def verbatim(data: Any, key: str = "", typed: bool = False) -> Iterator[str]:
    """Words of results that stand in a report as they are: names, keys, symbols, what was typed."""
    if isinstance(data, dict):
        if data.keys() >= {"template", "values", "text"}:  # a text of the program
            return
        for name, part in data.items():
            yield name
            yield from verbatim(part, name, typed or name in GIVEN)
    elif isinstance(data, list):
        for part in data:
            yield from verbatim(part, key, typed)
    elif isinstance(data, str) and (key in VERBATIM or (typed and key in TYPED)):
        yield from WORD.get(key, re.compile(r"\w+")).findall(data)


@cache
def titles() -> frozenset[str]:
    """The words of the catalogues that stand in them in another language: titles of works, names of makers and authors."""
    found = set()
    for file in (ROOT / "diecut_report" / "locale" / "uk.po", *ROOT.glob("plugins/*/locale/uk.po")):
        for message in po_files.read(file, "uk"):
            if message.context in CITED or any(
                "standard series" in of or "of a table" in of for of in message.auto_comments
            ):
                found.update(re.findall("[A-Za-z]+", str(message.string)))
    return frozenset(found)


def in_ukrainian(results: ResultsRecord) -> str:
    """The page of a report."""
    return Rendering(results.with_(project=results.project.with_(language="uk"))).html()


def left_over(results: ResultsRecord, page: str) -> dict[str, str]:
    """The Latin words of a page that neither the user nor a source wrote, each with its line."""
    told = {**results.data(), "project": None}
    project = re.findall(r"[A-Za-z]+", " ".join(map(str, results.project.data().values())))
    known = {*verbatim(told), *project, *OWN, *titles()}
    return {w: line.strip() for line in visible(page) for w in LATIN.findall(line) if w not in known}


@pytest.fixture(scope="module")
def small(small_report: Path) -> ResultsRecord:
    """The results of the small press."""
    return ResultsRecord.model_validate_json((small_report / "small.json").read_bytes())


def test_no_english_word_is_left(small: ResultsRecord) -> None:
    page = in_ukrainian(small)
    assert 'lang="uk"' in page and "Основні результати" in page
    assert left_over(small, page) == {}


def test_papers_are_cited_in_ukrainian(small: ResultsRecord) -> None:
    cited = [source.citation for data in small.mechanisms.values() for source in data.sources]
    page = in_ukrainian(small)
    assert any(citation.startswith("Loizyk") for citation in cited)
    assert "Лойзик В. В." in page and "Loizyk" not in " ".join(visible(page))


def test_numbers_have_a_decimal_comma(small: ResultsRecord) -> None:
    numbers = [
        found for line in visible(in_ukrainian(small)) for found in re.findall(r"(?<![\w.])\d+[.,]\d+(?![\w.])", line)
    ]
    pointed = {number for number in numbers if "." in number}
    typed = {row.text for data in small.mechanisms.values() for row in data.inputs.values()}
    assert sum("," in number for number in numbers) > 10
    assert {number for number in pointed if not any(number in text for text in typed)} <= {"0.1", "1.0"}  # versions


@pytest.mark.parametrize(
    "config", few(sorted(CONFIGS.glob("*.yaml")), lambda file: file.stem == "circular_knife"), ids=lambda f: f.stem
)
def test_no_english_word_is_left_in_an_example(config: Path) -> None:
    if "study" in config.stem:
        return
    outcome = Press.read(config, Discovery([])).calculate()
    assert left_over(outcome.results, in_ukrainian(outcome.results)) == {}
