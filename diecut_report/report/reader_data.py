"""What the scripts of the HTML page use: its figures' curves in the units that they show, as JSON that no text breaks out of."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from diecut_report.quantities.units import pretty, to_display, unit
from diecut_report.report.context import Material
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import displayed, joined, tidy
from diecut_report.report.scope import parts

if TYPE_CHECKING:
    from diecut_report.report.figures.panel_data import Line, PanelData

Data = Mapping[str, Any]
X_DIGITS, Y_DIGITS = 6, 5  # of the greatest number of a line: finer than a cursor reads
LEAST = 2  # points of a line at which there is something to read
SAFE = str.maketrans({mark: f"\\u{ord(mark):04x}" for mark in "<>&\u2028\u2029"})


def reader_data(material: Material) -> str:
    """Return all that the page's scripts use as JSON, in which no character opens or closes anything of HTML."""
    pool = _Pool()
    figures = {number: made for number, made in _figures(material, pool) if made}
    moving = list(_moving(material, pool))
    data = {
        "decimal": material.words["decimal"],
        "rows": pool.rows,
        "groups": len(pool.groups),
        "figures": figures,
        "moving": moving,
    }
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":")).translate(SAFE)


def figure_readings(name: str, figure: Data, curves: Data, words: Catalogue) -> dict[str, Any] | None:
    """Return what can be read in a figure of curves alone: its panels, and the rows of numbers that they name; None where nothing can."""
    pool = _Pool()
    found = _figure(name, figure, curves, words, pool)
    return None if found is None else {**found, "rows": pool.rows}


class _Pool:
    """Rows of numbers, each kept once, and the groups of diagrams that share a cursor."""

    def __init__(self) -> None:
        self.rows: list[list[float | None]] = []
        self.groups: dict[tuple[str, ...], int] = {}
        self._known: dict[tuple[float | None, ...], int] = {}

    def row(self, values: Any, digits: int) -> int:
        """Return the place of a row of numbers, rounded to so many digits of its greatest."""
        found = _rounded(np.asarray(values, dtype=float), digits)
        place = self._known.setdefault(tuple(found), len(self.rows))
        if place == len(self.rows):
            self.rows.append(found)
        return place

    def group(self, *name: str) -> int:
        """Return the number of a group."""
        return self.groups.setdefault(name, len(self.groups))


def _rounded(values: Any, digits: int) -> list[float | None]:
    finite = values[np.isfinite(values)]
    greatest = float(np.abs(finite).max(initial=0.0))
    decimals = digits - 1 - int(np.floor(np.log10(greatest))) if greatest else 0
    rounded = np.round(values, decimals) + 0.0  # no minus before a zero
    return [value if math.isfinite(value) else None for value in rounded.tolist()]


def _figures(material: Material, pool: _Pool) -> Iterable[tuple[str, Data | None]]:
    """The figures by their numbers with what can be read in them; None where nothing can."""
    calculated = dict(parts(material.said))
    for chapter in material.document.chapters:
        for number, figure in chapter.figures:
            if figure["type"] in ("plot", "chart") and number in material.figures:
                yield number, _figure(chapter.name, figure, calculated[chapter.name]["curves"], material.words, pool)


def _moving(material: Material, pool: _Pool) -> Iterator[Data]:
    """The drawings that move with the cursor of their curves: their abscissa, and each shape's numbers at each place."""
    calculated = dict(parts(material.said))
    for chapter in material.document.chapters:
        for number, figure in chapter.figures:
            if "moving" in figure and number in material.figures:
                moving, curves = figure["moving"], calculated[chapter.name]["curves"]
                over = curves[moving["over"]]
                shown, places = over["display_unit"], np.array(moving["places"])
                yield {
                    "figure": number, "group": pool.group(chapter.name, over["description"], over["symbol"], shown),
                    "title": tidy(figure["title"]),
                    "across": {"title": tidy(over["description"]), "symbol": over["symbol"], "unit": pretty(shown),
                               "range": [to_display(float(places[0]), shown), to_display(float(places[-1]), shown)]},
                    "places": pool.row(places / unit(shown).factor, X_DIGITS),
                    "shapes": [_shape(shapes, pool) for shapes in zip(*moving["frames"], strict=True)],
                }  # fmt: skip


def _shape(at_places: Sequence[Data], pool: _Pool) -> Data:
    """A shape with the numbers that it has at each place: a polyline's points, a circle's centre and radius, a point."""
    first = at_places[0]
    rows = [pool.row(_numbers(shape), Y_DIGITS) for shape in at_places]
    return {"shape": first["shape"], "role": first["role"], "closed": bool(first.get("closed")), "rows": rows}


def _numbers(shape: Data) -> list[float]:
    if shape["shape"] == "polyline":
        return [number for point in shape["points"] for number in point]
    return [*shape["center"], shape["radius"]] if shape["shape"] == "circle" else list(shape["at"])


def _figure(name: str, figure: Data, curves: Data, words: Catalogue, pool: _Pool) -> Data | None:
    from diecut_report.report.figures.charts import diagrams  # with matplotlib, which takes half a second

    panels = diagrams(figure, curves, words)
    if not all(_is_readable(panel) for panel in panels):
        return None
    made = [_panel(name, panel, raw, words, pool) for panel, raw in zip(panels, figure["panels"], strict=True)]
    return {"title": tidy(figure["title"]), "panels": made}


def _is_readable(panel: PanelData) -> bool:
    """Whether each line has one height at a place: it runs from left to right, and there is one at all."""
    lines = (*panel.lines, *panel.fills)
    return bool(lines) and all(len(line.x) >= LEAST and not (np.diff(_finite(line.x)) < 0).any() for line in lines)


def _finite(values: Any) -> Any:
    return values[np.isfinite(values)]


def _panel(name: str, panel: PanelData, raw: Data, words: Catalogue, pool: _Pool) -> Data:
    across = panel.across
    return {
        "group": pool.group(name, across.title, across.symbol, across.unit),
        "title": tidy(panel.title), "unit": pretty(panel.unit),
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


def _line(line: Line, pool: _Pool) -> Data:
    """A line with the rows of its numbers; where it breaks it keeps its place, and has no height."""
    known = np.maximum.accumulate(np.where(np.isfinite(line.x), np.arange(len(line.x)), 0))
    heights = np.where(np.isfinite(line.x), line.y, np.nan)
    return {"label": tidy(line.label), "x": pool.row(line.x[known], X_DIGITS), "y": pool.row(heights, Y_DIGITS)}


def _said(label: str, value: float, unit: str, words: Catalogue) -> str:
    return f"{tidy(label)} {joined(displayed(value, unit, words['decimal']), pretty(unit))}".strip()
