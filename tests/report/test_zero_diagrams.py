"""What figures need not tell: what is zero everywhere is said in a sentence, and a long sentence of captions once."""

from __future__ import annotations

from typing import Any

from diecut_report.report.chapters.repetition import without_zero_diagrams
from diecut_report.report.chapters.steps import BEFORE, Place, Placed, told_once
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import MechanismRecord
from tests.records import filled

WORDS = Catalogue("en")
CURVES = {"torque": {"values": [0.0, 1e-14, -0.0]}, "moment": {"values": [0.0, 5.0, 2.0]}}


def panel(title: str, *curves: str, **more: Any) -> dict[str, Any]:
    return {"title": title, "unit": "N*m", "series": [{"curve": name, "label": ""} for name in curves], **more}


def machine(*panels: dict[str, Any]) -> MechanismRecord:
    figure = {
        "id": "along",
        "title": "Along",
        "caption": "Over the shaft.",
        "type": "plot",
        "panels": list(panels),
        "shows": ["torque"],
    }
    items = [{"type": "formula", "id": "torque"}, {"type": "formula", "id": "moment"}]
    data = {"figures": [figure], "curves": CURVES, "sections": [{"title": "Loads", "items": items}]}
    return filled(MechanismRecord, data)


def test_a_diagram_that_is_zero_everywhere_is_a_sentence_of_the_caption() -> None:
    [figure] = without_zero_diagrams(machine(panel("Torque", "torque"), panel("Moment", "moment")), WORDS).figures
    assert [each.title for each in figure.panels] == ["Moment"]
    assert figure.caption == "Over the shaft. Torque: 0 everywhere."


def test_a_figure_that_is_zero_everywhere_is_a_note_behind_the_step_that_it_shows() -> None:
    found = without_zero_diagrams(machine(panel("Torque", "torque")), WORDS)
    assert found.figures == []
    assert [item.type for item in found.sections[0].items] == ["formula", "note", "formula"]
    assert found.sections[0].items[1].text == "Torque: 0 everywhere."


def test_a_zero_line_beside_another_or_under_a_limit_is_drawn() -> None:
    both, limited = (
        panel("Both", "torque", "moment"),
        panel("Torque", "torque", levels=[{"value": 3.0, "label": "allowed"}]),
    )
    [figure] = without_zero_diagrams(machine(both, limited), WORDS).figures
    assert len(figure.panels) == 2


def test_a_long_sentence_of_a_caption_is_told_once_and_a_short_one_each_time() -> None:
    long = "Angles count from the middle of the motion: what the results call α above 180° is here 360° less, in the same place."
    captions = [f"Motion of the wheel. {long} Shaded: dwell.", f"Motion of the sheet. {long} Shaded: dwell.", long]
    drawn = [filled(FigureRecord, {"caption": caption}) for caption in captions]
    figures = [Placed(Place(0, BEFORE), f"G.{n}", figure) for n, figure in enumerate(drawn, 1)]
    found = [each.figure.caption for each in told_once(figures)]
    assert found == [captions[0], "Motion of the sheet. Shaded: dwell.", ""]
