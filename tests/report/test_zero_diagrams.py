"""What is zero everywhere is said in a sentence, not drawn."""

from __future__ import annotations

from typing import Any

from diecut_report.report.i18n import Catalogue
from diecut_report.report.zero_diagrams import without_zero_diagrams

WORDS = Catalogue("en")
CURVES = {"torque": {"values": [0.0, 1e-14, -0.0]}, "moment": {"values": [0.0, 5.0, None]}}


def panel(title: str, *curves: str, **more: Any) -> dict[str, Any]:
    return {"title": title, "unit": "N*m", "series": [{"curve": name, "label": ""} for name in curves], **more}


def machine(*panels: dict[str, Any]) -> dict[str, Any]:
    figure = {
        "id": "along",
        "title": "Along",
        "caption": "Over the shaft.",
        "type": "plot",
        "panels": list(panels),
        "shows": ["torque"],
    }
    items = [{"type": "formula", "id": "torque"}, {"type": "formula", "id": "moment"}]
    return {"figures": [figure], "curves": CURVES, "sections": [{"title": "Loads", "items": items}]}


def test_a_diagram_that_is_zero_everywhere_is_a_sentence_of_the_caption() -> None:
    [figure] = without_zero_diagrams(machine(panel("Torque", "torque"), panel("Moment", "moment")), WORDS)["figures"]
    assert [each["title"] for each in figure["panels"]] == ["Moment"]
    assert figure["caption"] == "Over the shaft. Torque: 0 everywhere."


def test_a_figure_that_is_zero_everywhere_is_a_note_behind_the_step_that_it_shows() -> None:
    found = without_zero_diagrams(machine(panel("Torque", "torque")), WORDS)
    assert found["figures"] == []
    assert [item["type"] for item in found["sections"][0]["items"]] == ["formula", "note", "formula"]
    assert found["sections"][0]["items"][1]["text"] == "Torque: 0 everywhere."


def test_a_zero_line_beside_another_or_under_a_limit_is_drawn() -> None:
    both, limited = (
        panel("Both", "torque", "moment"),
        panel("Torque", "torque", levels=[{"value": 3.0, "label": "allowed"}]),
    )
    [figure] = without_zero_diagrams(machine(both, limited), WORDS)["figures"]
    assert len(figure["panels"]) == 2
