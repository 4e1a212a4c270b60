"""A report in Ukrainian: no English word is left in it; names that a configuration gives, and papers by their number."""

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
from diecut_report.report.chapters.value_tables import value_row
from diecut_report.report.rendering import Rendering
from diecut_report.report.text import given_names, numbered, translated, value_in_words
from diecut_report.results.mechanism_record import ItemRecord, MechanismRecord, QuantityRecord, ShownRecord
from diecut_report.results.model import ChangedQuantityRecord, ResultsRecord
from diecut_report.text import po_files
from diecut_report.text.catalogues import Catalogues
from tests.examples import few
from tests.records import filled
from tests.report.made_results import typed

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


Data = dict[str, Any]


def named(text: str, quantity: str = "name", **more: Any) -> QuantityRecord:
    """An input of a part of a list."""
    part = {"family": "loads", "index": 0, "quantity": quantity}
    given = {"value": text, "display": {"text": text, "unit": "1"}, "origin": "given", "text": text, "part": part}
    return filled(QuantityRecord, given | more)


@pytest.mark.parametrize(
    ("row", "text"),
    [
        (named("main_a"), "main_a"),
        (named("deep_groove", "type"), "deep groove"),
        (named("crank_rocker", "type"), "crank-rocker"),
        (named("gripper_chain", "mechanism", origin="reference", path="gripper_chain"), "gripper_chain"),
    ],
)
def test_a_name_keeps_its_form_and_a_choice_is_said_in_words(row: QuantityRecord, text: str) -> None:
    assert value_in_words(row) == text


def test_a_result_that_is_the_name_of_a_part_is_printed_as_it_is_typed() -> None:
    found = filled(QuantityRecord, {"value": "main_b", "display": {"text": "main_b", "unit": "1"}})
    assert value_in_words(found, {"main_b"}) == "main_b" and value_in_words(found) == "main b"
    result = ShownRecord(text="main_b", unit="1")
    item = ItemRecord(type="lookup", description="Bearing with the shortest life", symbol="B_L", result=result)
    assert value_row(item, "F.21", None, "", ".", {"main_b"}).value == "main_b"


def test_names_are_those_of_parts_and_of_mechanisms_that_are_taken() -> None:
    inputs = {
        "loads.0.name": named("crank"),
        "loads.0.type": named("gear", "type"),
        "drives": named("", "", value=["feeder"]),
        "pulleys.0.role": named("cylinder", "role"),  # a word that one of the mechanisms is called by, too
    }
    assert given_names(filled(MechanismRecord, {"inputs": inputs}), {"feeder", "gear_1", "cylinder"}) == {
        "crank",
        "feeder",
    }


def test_a_name_that_is_a_word_of_the_catalogue_is_not_translated(plain: Data) -> None:
    """“drive” is a word of several catalogues."""
    data = plain["mechanisms"]["cylinder"]
    data["inputs"]["lines.0.name"], data["kind"] = named("drive"), "roller_chain"
    data["figures"] = [
        {"id": "torque", "type": "chart", "panels": [{"lines": [{"label": "drive"}]}]},
        {"id": "declared", "type": "plot", "panels": [{"series": [{"label": "drive"}]}]},
    ]
    catalogues = Catalogues("uk")
    catalogues.know(["cyclogram", "roller_chain"])
    one = typed({**plain, "mechanisms": {"cylinder": data}, "comparisons": {}})
    said = translated(one, catalogues).mechanisms["cylinder"]
    assert said.inputs["lines.0.name"].display.text == "drive"
    assert said.figures[0].panels[0].lines[0].label == "drive"
    assert not said.figures[1].panels[0].series[0].label.isascii()


def test_papers_stand_by_their_number_and_nothing_else_changes() -> None:
    sources = [{"id": "003", "citation": "C"}, {"id": "ISO 76", "citation": "I"}, {"id": "000", "citation": "A"}]
    item = ItemRecord(
        type="note",
        source="003 eq. 4, ISO 76",
        symbol="I_000",
        text="as I_000 (figure 3 of 000): 10 000 h, 0.003 mm, 5,003",
    )
    curves = {"x": {"values": [3.0], "source": "000"}}
    mechanism = {
        "sources": sources,
        "sections": [{"items": [item]}],
        "curves": curves,
        "inputs": {"load": {"description": "Line load (000)", "note": "drawing 003, sheet 4", "text": "003"}},
        "assumptions": ["the press (000)", "003."],
    }
    results = filled(ResultsRecord, {"mechanisms": {"m": mechanism}, "config": {"file": "000"}})
    found = numbered(results)
    assert [source.id for source in found.mechanisms["m"].sources] == ["[2]", "ISO 76", "[1]"]
    (printed,) = found.mechanisms["m"].sections[0].items
    assert printed == item.with_(
        source="[2] eq. 4, ISO 76", text="as I_000 (figure 3 of [1]): 10 000 h, 0.003 mm, 5,003"
    )
    assert found.mechanisms["m"].assumptions == ["the press [1]", "[2]."]
    load = results.mechanisms["m"].inputs["load"]
    assert load.note == "drawing 003, sheet 4" and load.text == "003"
    assert found.mechanisms["m"].inputs["load"] == load.with_(description="Line load [1]")
    assert found.mechanisms["m"].curves["x"].values == [3.0]
    assert found.config == results.config


def test_results_without_papers_stay_as_they_are() -> None:
    mechanism = {"sources": [{"id": "ISO 76", "citation": "I"}], "summary": "100 of 000"}
    results = filled(ResultsRecord, {"mechanisms": {"m": mechanism}})
    assert numbered(results) is results


def test_inputs_that_were_changed_keep_what_was_typed() -> None:
    sources = [{"id": "003", "citation": "C"}]
    new = {"value": "drawing 003", "display": {"text": "drawing 003", "unit": "1"}}
    row = filled(
        ChangedQuantityRecord, {"path": "m.load", "description": "Line load (003)", "new": new, "follows": "003"}
    )
    given = {"mechanisms": {"m": {"sources": sources}}, "changes": {"inputs": [row]}}
    found = numbered(filled(ResultsRecord, given))
    assert found.changes is not None and found.changes.inputs == [row.with_(description="Line load [1]")]
