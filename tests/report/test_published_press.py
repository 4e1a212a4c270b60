"""What a standard report of the published press says, and how often: read from its content, without a sheet laid out."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from typing import Any

import pytest

from diecut_report.report import Rendering
from diecut_report.report.document import ReportDocument
from diecut_report.report.model import Item, PrintedChapter
from tests.processes import Example

Data = dict[str, Any]


@pytest.fixture(scope="module", params=["en", "uk"])
def printed(request: pytest.FixtureRequest, example: Example) -> ReportDocument:
    """The content of the report, without its figures."""
    results = json.loads(example.told)
    results["project"]["language"] = request.param
    results["report"] = {**results.get("report", {}), "detail": "standard"}
    for mechanism in results["mechanisms"].values():
        mechanism["figures"] = []
    return Rendering(results).material.document


def items(chapter: PrintedChapter) -> Iterator[Item]:
    """The steps of a chapter."""
    return (item for section in chapter.sections for item in section.items)


def test_no_result_that_a_list_of_the_calculation_gives_is_printed_again(printed: ReportDocument) -> None:
    chapters = {part.name: part for part in printed.chapters}
    for name in ("drive", "train"):
        assert not chapters[name].outputs and not chapters[name].output_parts


def test_the_source_of_a_series_is_said_once(printed: ReportDocument) -> None:
    for chapter in printed.chapters:
        notes = Counter(note for item in items(chapter) for note in item.notes if len(note) > 120)
        assert not [note for note, count in notes.items() if count > 1]


def test_numbers_of_clauses_keep_their_point(printed: ReportDocument) -> None:
    told = " ".join(note for chapter in printed.chapters for item in items(chapter) for note in item.notes)
    assert "clause 2.2" in told or "п. 2.2" in told


def test_parts_with_names_stand_under_them(printed: ReportDocument) -> None:
    timing = next(part for part in printed.chapters if part.name == "timing")
    lines, interlocks = timing.input_parts
    assert interlocks.heads == ["sheet_rests", "carriage_passes"]  # type: ignore[union-attr]
    assert lines.heads == ["drive", "feeder"]  # type: ignore[union-attr]
    firsts = [[row[0] for row in item.table.rows] for item in items(timing) if item.table]
    assert ["sheet_rests", "carriage_passes"] in firsts and ["1", "2"] not in firsts


def test_every_source_is_listed_as_the_formulas_name_it(printed: ReportDocument) -> None:
    listed = {name for ids, _ in printed.sources for name in ids.split(", ")}
    bearings = next(part for part in printed.chapters if part.name == "bearings")
    named = {item.source for item in items(bearings)} | {row.source for item in items(bearings) for row in item.rows}
    assert any(source.startswith("Lundberg") for source in named)
    assert {source for source in named if source.startswith("Lundberg")} <= listed


def test_a_comparison_names_its_sources_in_the_language_of_the_report(printed: ReportDocument) -> None:
    comparison = next(part for part in printed.chapters if part.between)
    told = {item.source for item in items(comparison)}
    assert ("kinematics" in told) == (printed.words["and"] == "and")


def test_chapters_can_be_told_apart_by_their_titles(printed: ReportDocument) -> None:
    titles = Counter(part.title for part in printed.chapters)
    assert not [title for title, count in titles.items() if count > 1]


def test_every_symbol_of_the_list_has_a_letter(printed: ReportDocument) -> None:
    assert all(any(map(str.isalpha, row.name)) for part in printed.chapters for row in part.symbols)
