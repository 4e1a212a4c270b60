"""Papers by their number in the list of sources."""

from __future__ import annotations

from diecut_report.report.chapters.sources import numbered


def test_papers_stand_by_their_number_and_nothing_else_changes() -> None:
    sources = [{"id": "003", "citation": "C"}, {"id": "ISO 76", "citation": "I"}, {"id": "000", "citation": "A"}]
    item = {
        "source": "003 eq. 4, ISO 76",
        "symbol": "I_000",
        "text": "as I_000 (figure 3 of 000): 10 000 h, 0.003 mm, 5,003",
    }
    curves = {"x": {"values": [3], "source": "000"}}
    mechanism = {
        "sources": sources,
        "sections": [{"items": [item]}],
        "curves": curves,
        "inputs": {"load": {"description": "Line load (000)", "note": "drawing 003, sheet 4", "text": "003"}},
        "assumptions": ["the press (000)", "003."],
    }
    found = numbered({"mechanisms": {"m": mechanism}, "config": {"file": "000"}})
    assert [source["id"] for source in found["mechanisms"]["m"]["sources"]] == ["[2]", "ISO 76", "[1]"]
    (printed,) = found["mechanisms"]["m"]["sections"][0]["items"]
    assert printed == {
        "source": "[2] eq. 4, ISO 76",
        "symbol": "I_000",
        "text": "as I_000 (figure 3 of [1]): 10 000 h, 0.003 mm, 5,003",
    }
    assert found["mechanisms"]["m"]["assumptions"] == ["the press [1]", "[2]."]
    assert found["mechanisms"]["m"]["inputs"]["load"] == {
        "description": "Line load [1]",
        "note": "drawing 003, sheet 4",
        "text": "003",
    }
    assert found["config"] == {"file": "000"}


def test_results_without_papers_stay_as_they_are() -> None:
    results = {"mechanisms": {"m": {"sources": [{"id": "ISO 76", "citation": "I"}], "summary": "100 of 000"}}}
    assert numbered(results) is results


def test_inputs_that_were_changed_keep_what_was_typed() -> None:
    sources = [{"id": "003", "citation": "C"}]
    row = {"path": "m.load", "description": "Line load (003)", "new": "drawing 003", "note": "003"}
    found = numbered({"mechanisms": {"m": {"sources": sources}}, "changes": {"inputs": [row]}})
    assert found["changes"]["inputs"] == [row | {"description": "Line load [1]"}]
