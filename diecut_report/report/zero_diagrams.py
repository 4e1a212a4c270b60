"""Diagrams in which all is zero: a sentence says that, and nothing is drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from diecut_report.quantities.display import is_nothing
from diecut_report.report.i18n import Catalogue

Data = Mapping[str, Any]
NOTED = ("levels", "marks", "verticals", "fills")  # what a diagram may tell beside its lines


def without_zero_diagrams(mechanism: Data, words: Catalogue) -> Data:
    """Return a mechanism whose figures draw what is not zero everywhere; what is stands as a sentence in the caption, or as a note."""
    figures, notes = [], []
    for figure in mechanism.get("figures", ()):
        flat = [panel for panel in figure.get("panels", ()) if _is_flat(panel, mechanism["curves"])]
        left = [panel for panel in figure.get("panels", ()) if panel not in flat]
        told = words.say("zero_everywhere", names="; ".join(dict.fromkeys(panel["title"] for panel in flat)))
        if flat and not left:
            notes.append((figure, {"type": "note", "text": told}))
        elif flat:
            figures.append({**figure, "panels": left, "caption": f"{figure['caption']} {told}"})
        else:
            figures.append(figure)
    return (
        {**mechanism, "figures": figures, "sections": _noted(mechanism["sections"], notes)}
        if figures or notes
        else mechanism
    )


def _is_flat(panel: Data, curves: Data) -> bool:
    """Whether all lines of a diagram are zero, and nothing else stands in it."""
    if not panel["title"] or any(panel.get(kind) for kind in NOTED):
        return False
    rows = [curves[series["curve"]]["values"] for series in panel.get("series", ())]
    rows += [line["y"] for line in panel.get("lines", ())]
    return bool(rows) and all(is_nothing(value, panel["unit"]) for row in rows for value in row if value is not None)


def _noted(sections: Sequence[Data], notes: Sequence[tuple[Data, Data]]) -> Sequence[Data]:
    """The sections with each note behind the last step that its figure shows."""
    found: list[Data] = [{**section, "items": list(section["items"])} for section in sections]
    for figure, note in notes:
        places = [
            (section, index + 1)
            for section in found
            for index, item in enumerate(section["items"])
            if item.get("id") in figure.get("shows", ())
        ]
        if places:
            section, index = places[-1]
            section["items"].insert(index, note)
    return found
