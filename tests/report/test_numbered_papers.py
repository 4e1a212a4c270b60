"""Papers by their number in the list of sources."""

from __future__ import annotations

from diecut_report.report.text import numbered
from diecut_report.results.mechanism_record import ItemRecord
from diecut_report.results.model import ChangedQuantityRecord, ResultsRecord
from tests.records import filled


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
