"""What the scripts of the HTML page use: its figures' curves in the units that they show, as JSON that no text breaks out of."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from diecut_report.quantities.display import finest
from diecut_report.quantities.units import pretty
from diecut_report.report.context import Material
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import displayed, joined, tidy
from diecut_report.report.reader_moving import moving_data
from diecut_report.report.reader_pool import X_DIGITS, Y_DIGITS, ReaderRows
from diecut_report.report.scope import parts

if TYPE_CHECKING:
    from diecut_report.report.figures.panel_data import Line, PanelData

Data = Mapping[str, Any]
READ = ("plot", "chart", "polar")  # figures whose curves are read at the cursor
LEAST = 2  # points of a line at which there is something to read
SAFE = str.maketrans({mark: f"\\u{ord(mark):04x}" for mark in "<>&\u2028\u2029"})


def reader_data(material: Material) -> str:
    """Return all that the page's scripts use as JSON, in which no character opens or closes anything of HTML."""
    pool = ReaderRows()
    figures = {number: made for number, made in _figures(material, pool) if made}
    moving = list(_moving(material, pool))
    data = {
        "decimal": material.words["decimal"],
        "rows": pool.rows,
        "turns": pool.turns,
        "figures": figures,
        "moving": moving,
    }
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":")).translate(SAFE)


def figure_readings(name: str, figure: Data, curves: Data, words: Catalogue) -> dict[str, Any] | None:
    """Return what can be read in a figure of curves alone: its panels, and the rows of numbers that they name; None where nothing can."""
    pool = ReaderRows()
    found = _figure(name, figure, curves, words, pool)
    return None if found is None else {**found, "rows": pool.rows}


def _figures(material: Material, pool: ReaderRows) -> Iterable[tuple[str, Data | None]]:
    """The figures by their numbers with what can be read in them; None where nothing can."""
    calculated = dict(parts(material.said))
    for chapter in material.document.chapters:
        for number, figure in chapter.figures:
            if figure["type"] in READ and number in material.figures:
                yield number, _figure(chapter.name, figure, calculated[chapter.name]["curves"], material.words, pool)


def _moving(material: Material, pool: ReaderRows) -> Iterator[Data]:
    """The drawings that move with the cursor of their curves."""
    calculated = dict(parts(material.said))
    for chapter in material.document.chapters:
        for number, figure in chapter.figures:
            if "moving" in figure and number in material.figures:
                yield moving_data(chapter.name, number, figure, calculated[chapter.name]["curves"], pool)


def _figure(name: str, figure: Data, curves: Data, words: Catalogue, pool: ReaderRows) -> Data | None:
    from diecut_report.report.figures.charts import diagrams  # with matplotlib, which takes half a second

    if figure["type"] == "polar":
        found = _figure(name, _unrolled(figure), curves, words, pool)
        return found and {**found, "beside": True}
    panels = diagrams(figure, curves, words)
    if not all(_is_readable(panel) for panel in panels):
        return None
    made = []
    for panel, raw in zip(panels, figure["panels"], strict=True):
        across, over = panel.across, raw.get("over") or figure.get("abscissa")
        group = pool.over(name, curves[over], across.unit) if over else pool.group(name, *across[:3])
        made.append(_panel(panel, raw, words, pool) | {"group": group})
    return {"title": tidy(figure["title"]), "panels": made}


def _unrolled(figure: Data) -> Data:
    """A polar figure's curves as a diagram over its angle, which is read beside it."""
    notes: dict[str, Any] = {"levels": [], "marks": [], "spans": []}
    return {
        **figure,
        "type": "plot",
        "panels": [{"title": figure["title"], "unit": figure["unit"], "series": figure["series"], **notes}],
    }


def _is_readable(panel: PanelData) -> bool:
    """Whether each line has one height at a place: it runs from left to right, and there is one at all."""
    lines = (*panel.lines, *panel.fills)
    return bool(lines) and all(len(line.x) >= LEAST and not (np.diff(_finite(line.x)) < 0).any() for line in lines)


def _finite(values: Any) -> Any:
    return values[np.isfinite(values)]


def _panel(panel: PanelData, raw: Data, words: Catalogue, pool: ReaderRows) -> dict[str, Any]:
    across = panel.across
    return {
        "title": tidy(panel.title), "unit": pretty(panel.unit), "finest": finest(panel.unit),
        "across": {"title": tidy(across.title), "symbol": across.symbol, "unit": pretty(across.unit), "range": [across.low, across.high]},
        "range": [float(end) for end in panel.heights],
        "lines": [_line(line, pool) for line in panel.lines],
        "fills": [_line(line, pool) for line in panel.fills],
        "levels": [{"y": note.y, "text": _said(own["label"], own["value"], panel.unit, words)}
                   for note, own in zip(panel.levels, raw["levels"], strict=True)],
        "marks": [{"x": note.x, "y": note.y, "text": _said(own["label"], own["y"], panel.unit, words) if own["label"] else ""}
                  for note, own in zip(panel.marks, raw["marks"], strict=True)],
        "uprights": [{"x": note.x, "text": tidy(own["label"])}
                     for note, own in zip(panel.verticals, raw.get("verticals", ()), strict=True)],
        "spans": [{"from": span.start, "to": span.end, "text": tidy(span.text)} for span in panel.spans],
    }  # fmt: skip


def _line(line: Line, pool: ReaderRows) -> Data:
    """A line with the rows of its numbers; where it breaks it keeps its place, and has no height."""
    known = np.maximum.accumulate(np.where(np.isfinite(line.x), np.arange(len(line.x)), 0))
    heights = np.where(np.isfinite(line.x), line.y, np.nan)
    return {"label": tidy(line.label), "x": pool.row(line.x[known], X_DIGITS), "y": pool.row(heights, Y_DIGITS)}


def _said(label: str, value: float, unit: str, words: Catalogue) -> str:
    return f"{tidy(label)} {joined(displayed(value, unit, words['decimal']), pretty(unit))}".strip()
