"""What a standard report of the published press says, and how often: read from its content, without a sheet laid out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

import pytest

from diecut_report.report.document import ReportDocument
from diecut_report.report.model import Item, PrintedChapter
from diecut_report.report.rendering import Rendering
from diecut_report.results.mechanism_record import ShownRecord
from diecut_report.results.model import ResultsRecord
from tests.processes import Example

Data = dict[str, Any]


@pytest.fixture(scope="module", params=["en", "uk"])
def printed(request: pytest.FixtureRequest, example: Example) -> ReportDocument:
    """The content of the report, without its figures."""
    results = ResultsRecord.model_validate_json(example.told)
    results = results.with_(
        project=results.project.with_(language=request.param),
        report=results.report.with_(detail="standard"),
        mechanisms={name: data.with_(figures=[]) for name, data in results.mechanisms.items()},
    )
    return Rendering(results).document


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


def test_what_is_but_rounding_is_said_so(example: Example) -> None:
    results = ResultsRecord.model_validate_json(example.told)
    noted = set()
    for name, data in results.mechanisms.items():
        for item in (item for section in data.sections for item in section.items):
            text, told = item.result.text if item.result else "", data.outputs.get(item.id)
            assert "e-" not in text or float(text) > 1e-12, (name, item.id)
            if text == "0" and "machine precision" in item.note:
                noted.add((name, item.id))
            assert not (text == "0" and told and told.value) or (name, item.id) in noted
    assert ("drive", "energy_residual") in noted


def test_what_a_mechanism_takes_by_itself_is_said_in_short(printed: ReportDocument) -> None:
    chapters = {part.name: part for part in printed.chapters}
    found = chapters["consistency"]
    assert len(found.inputs) < 8 and {"drive", "train"} <= {row.key for row in found.partners}
    assert {"timing", "drive", "clutch"} <= {group.home for group in found.taken}
    told = {(group.home, row.key) for group in found.taken for row in group.rows}
    assert ("drive", "stroke") in told and len(told) > 30
    assert not any(part.taken or part.partners for part in printed.chapters if not part.between and part is not found)


def test_a_phase_that_is_others_together_is_told_in_one_line(printed: ReportDocument) -> None:
    drive = next(part for part in printed.chapters if part.name == "drive")
    (table,) = drive.phases
    places = [tuple(row[2:4]) for row in table.rows]
    assert len(places) == len(set(places)) > 8
    assert len([text for text in drive.phases_absent if "combined" in text or "разом" in text]) == 2


def test_a_number_is_told_alike_in_all_chapters_that_hand_it_on(example: Example) -> None:
    mechanisms = ResultsRecord.model_validate_json(example.told).mechanisms
    told = {f"{name}.{key}": row.display for name, data in mechanisms.items() for key, row in data.outputs.items()}
    for data in mechanisms.values():
        for row in data.inputs.values():
            there = told.get(row.path, row.display)
            assert row.origin != "reference" or there.unit != row.display.unit or there == row.display
    forces: dict[float, set[str]] = {}
    for data in mechanisms.values():
        for row in data.outputs.values():
            if row.unit == "N":
                forces.setdefault(round(float(row.value), 6), set()).add(row.display.unit)  # type: ignore[arg-type]
    assert all(len(units) == 1 for units in forces.values())
    assert mechanisms["sector"].outputs["tangential_force"].display == ShownRecord(text="3.548", unit="kN")
