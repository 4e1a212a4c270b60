"""What the scripts of the HTML page use: its figures' curves in the units that they show, as JSON that no text breaks out of."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.quantities.formatting import finest
from diecut_report.quantities.units import pretty, to_display, unit
from diecut_report.report.chapters.tables import period_of
from diecut_report.report.context import Material
from diecut_report.report.scope import parts
from diecut_report.report.text import Catalogue, displayed, joined, tidy
from diecut_report.results.figure_record import (
    CircleRecord,
    FigureRecord,
    LabelRecord,
    MovedRecord,
    MovingShape,
    Panel,
    PlotPanelRecord,
    PolylineRecord,
    RigidRecord,
)
from diecut_report.results.mechanism_record import CurveRecord

if TYPE_CHECKING:
    from diecut_report.report.figures.labels import ChartLine, PanelData


# Rows of numbers for the page's scripts, each kept once, and the diagrams and drawings that share a cursor.


Data = Mapping[str, Any]
X_DIGITS, Y_DIGITS = 6, 5  # of the greatest number of a line: finer than a cursor reads


class ReaderRows:
    """Hold rows of numbers, and the groups of diagrams that share a cursor, with the turn after which the place of each comes again."""

    def __init__(self) -> None:
        self.rows: list[list[float | None]] = []
        self.turns: list[float | None] = []
        self._groups: dict[tuple[str, ...], int] = {}
        self._known: dict[tuple[float | None, ...], int] = {}

    def row(self, values: Any, digits: int) -> int:
        """Return the place of a row of numbers, rounded to so many digits of its greatest."""
        found = rounded(values, digits)
        place = self._known.setdefault(tuple(found), len(self.rows))
        if place == len(self.rows):
            self.rows.append(found)
        return place

    def group(self, chapter: str, title: str, symbol: str, shown: str) -> int:
        """Return the number of the group of all that runs over something in a chapter."""
        found = self._groups.setdefault((chapter, title, symbol, shown), len(self._groups))
        if found == len(self.turns):
            self.turns.append(None)
        return found

    def over(self, chapter: str, abscissa: CurveRecord, shown: str) -> int:
        """Return the number of the group of the curves over an abscissa of the results, in the unit that is shown."""
        found = self.group(chapter, abscissa.description, abscissa.symbol, shown)
        period = period_of(abscissa)
        self.turns[found] = period / unit(shown).factor if period else None
        return found


def rounded(values: Any, digits: int = Y_DIGITS) -> list[float | None]:
    """Return numbers rounded to so many digits of their greatest, whole ones without ``.0``, None for what is not finite."""
    found = np.asarray(values, dtype=float)
    greatest = float(np.abs(found[np.isfinite(found)]).max(initial=0.0))
    decimals = digits - 1 - int(np.floor(np.log10(greatest))) if greatest else 0
    kept = (np.round(found, decimals) + 0.0).tolist()  # no minus before a zero
    return [(int(value) if value.is_integer() else value) if math.isfinite(value) else None for value in kept]


# The drawings that move with the cursor of their curves, as the page's scripts take them.


Points = NDArray[Any]
KEPT = ("shape", "role", "closed", "anchor")  # of a shape, where it has them
AIR = 0.03  # around all that is ever drawn, of its greater side
LETTER, WIDE = 0.024, 0.56  # the size of labels, of that side; how wide a letter is in the mean, of that size


def moving_data(
    chapter: str, number: str, figure: FigureRecord, curves: Mapping[str, CurveRecord], pool: ReaderRows
) -> dict[str, Any]:
    """Return a moving drawing: its abscissa, the room that it takes, each shape with its numbers at each place, and what moves with it."""
    moving = figure.moving
    assert moving is not None
    over = curves[moving.over]
    shown, places = over.display_unit, np.array(moving.places)
    ends = [to_display(float(places[end]), shown) for end in (0, -1)]
    return {
        "figure": number, "mechanism": chapter, "group": pool.over(chapter, over, shown), "title": tidy(figure.title),
        "scaled": figure.unit != "1",
        "across": {"title": tidy(over.description), "symbol": over.symbol, "unit": pretty(shown), "range": ends},
        "places": pool.row(places / unit(shown).factor, X_DIGITS),
        "room": _room(moving.shapes),
        "letter": rounded([_letter(moving.shapes)])[0],
        "shapes": [_shape(shape, pool, shown) for shape in moving.shapes],
        "drives": [each.data() | {key: getattr(each, key) / unit(shown).factor for key in ("offset", "period")} for each in moving.drives],
    }  # fmt: skip


def _shape(shape: MovingShape, pool: ReaderRows, shown: str) -> Data:
    """A shape: its own numbers where it stands still, else those at each place, one that does not change once.

    ``during`` says between which places of the abscissa it is filled.
    """
    kept: dict[str, Any] = {key: value for key in KEPT if (value := getattr(shape, key, ""))}
    if isinstance(shape, LabelRecord):
        kept["text"] = tidy(shape.text)
    if isinstance(shape, RigidRecord | MovedRecord) and shape.shape == "rigid":
        kept["shapes"] = [_shape(own, pool, shown) for own in shape.shapes]
    rows = _rows(shape)
    if isinstance(shape, RigidRecord):
        kept["numbers"] = [*rounded(shape.at), *rounded([math.degrees(shape.turned)])]
    elif isinstance(shape, MovedRecord):
        if shape.shape == "rigid":
            rows[:, 2] = np.degrees(rows[:, 2])
        columns = rows.T.copy()
        kept["rows"] = [pool.row(row[:1] if (row == row[0]).all() else row, Y_DIGITS) for row in columns]
    else:
        kept["numbers"] = rounded(rows[0])
    if during := getattr(shape, "during", None):
        kept["during"] = [to_display(end, shown) for end in during]
    return kept


def _rows(shape: MovingShape) -> Points:
    match shape:
        case MovedRecord():
            return np.array(shape.moves)
        case PolylineRecord():
            return np.array(shape.points).reshape(1, -1)
        case CircleRecord():
            return np.array([[*shape.center, shape.radius]])
        case RigidRecord():
            return np.array([[*shape.at, shape.turned]])
    return np.array([shape.at])


def _room(shapes: Sequence[MovingShape]) -> list[float | None]:
    """Left, top, width and height (downwards) of all that is drawn at any place, with some air."""
    size = _letter(shapes)
    ends = [end for shape in shapes for end in _ends(shape)]
    for label in shapes:
        if isinstance(label, LabelRecord):  # whose corners count
            wide, (x, y) = WIDE * size * len(label.text), label.at
            left = x - {"left": 0.0, "center": 0.5, "right": 1.0}[label.anchor] * wide
            ends.append(np.array([[left, y - size / 2], [left + wide, y + size / 2]]))
    every = np.concatenate(ends)
    low, high = every.min(axis=0), every.max(axis=0)
    air = AIR * float((high - low).max())
    return rounded([low[0] - air, -high[1] - air, *(high - low + 2 * air)])


def _letter(shapes: Sequence[MovingShape]) -> float:
    ends = np.concatenate([end for shape in shapes for end in _ends(shape)])
    return LETTER * float((ends.max(axis=0) - ends.min(axis=0)).max())


def _ends(shape: MovingShape) -> list[Points]:
    """Points that a shape reaches at its places, each of shape (any, 2); of a circle the corners about it."""
    rows = _rows(shape)
    if isinstance(shape, RigidRecord | MovedRecord) and shape.shape == "rigid":
        x, y, turned = rows.T[:, :, None]
        c, s = np.cos(turned), np.sin(turned)
        own = ((end[:, 0], end[:, 1]) for part in shape.shapes for end in _ends(part))
        return [np.stack([x + c * a - s * b, y + s * a + c * b], axis=-1).reshape(-1, 2) for a, b in own]
    if shape.shape == "circle":
        centers, radii = rows[:, :2], rows[:, 2:]
        return [np.concatenate([centers - radii, centers + radii])]
    return [rows.reshape(-1, 2)]


READ = ("plot", "chart", "polar")  # figures whose curves are read at the cursor
LEAST = 2  # points of a line at which there is something to read
SAFE = str.maketrans({mark: f"\\u{ord(mark):04x}" for mark in "<>&\u2028\u2029"})


def reader_data(material: Material) -> str:
    """Return all that the page's scripts use as JSON, in which no character opens or closes anything of HTML."""
    pool, figures = ReaderRows(), {}
    calculated, chapters = dict(parts(material.said)), material.document.chapters
    every = [(calculated[part.name].curves, part.name, *each) for part in chapters for each in part.figures]
    drawn = [each for each in every if each[2] in material.figures]
    for curves, name, number, figure in drawn:
        if figure.type in READ and (made := _figure(name, figure, curves, material.words, pool)):
            figures[number] = made
    moving = [
        moving_data(name, number, figure, curves, pool) for curves, name, number, figure in drawn if figure.moving
    ]
    data = {
        "decimal": material.words["decimal"],
        "rows": pool.rows,
        "turns": pool.turns,
        "figures": figures,
        "moving": moving,
    }
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":")).translate(SAFE)


Shown = tuple[str, FigureRecord, Mapping[str, CurveRecord]]  # a figure with its mechanism and that one's curves


def moving_readings(first: Shown, others: Sequence[Shown]) -> dict[str, Any]:
    """Return a moving drawing with what can be dragged in it, those that may move with it, and the rows of numbers that they name."""
    pool = ReaderRows()
    main, *driven = (moving_data(name, "", figure, curves, pool) for name, figure, curves in (first, *others))
    for shape, own in zip(main["shapes"], first[1].moving.shapes if first[1].moving else (), strict=True):
        if grip := getattr(own, "grip", None):
            shape["grip"] = vars(grip)
    return {"moving": main, "driven": driven, "rows": pool.rows}


def figure_readings(
    name: str, figure: FigureRecord, curves: Mapping[str, CurveRecord], words: Catalogue
) -> dict[str, Any] | None:
    """Return what can be read in a figure of curves alone: its panels, and the rows of numbers that they name; None where nothing can."""
    pool = ReaderRows()
    found = _figure(name, figure, curves, words, pool)
    return None if found is None else {**found, "rows": pool.rows}


def _figure(
    name: str, figure: FigureRecord, curves: Mapping[str, CurveRecord], words: Catalogue, pool: ReaderRows
) -> Data | None:
    from diecut_report.report.figures.charts import diagrams  # with matplotlib, which takes half a second

    if figure.type == "polar":
        # its curves as a diagram over its angle, which is read beside it
        whole = PlotPanelRecord(
            title=figure.title, unit=figure.unit, series=figure.series, levels=[], marks=[], spans=[]
        )
        found = _figure(name, figure.with_(type="plot", panels=[whole]), curves, words, pool)
        return found and {**found, "beside": True}
    panels = diagrams(figure, curves, words)
    if not all(map(_is_readable, panels)):
        return None
    made = []
    for panel, raw in zip(panels, figure.panels, strict=True):
        across, over = panel.across, raw.over or figure.abscissa
        group = pool.over(name, curves[over], across.unit) if over else pool.group(name, *across[:3])
        made.append(_panel(panel, raw, words, pool) | {"group": group})
    return {"title": tidy(figure.title), "panels": made}


def _is_readable(panel: PanelData) -> bool:
    """Whether each line has one height at a place: it runs from left to right, and there is one at all."""
    lines = (*panel.lines, *panel.fills)
    return bool(lines) and all(
        len(line.x) >= LEAST and not (np.diff(line.x[np.isfinite(line.x)]) < 0).any() for line in lines
    )


def _panel(panel: PanelData, raw: Panel, words: Catalogue, pool: ReaderRows) -> dict[str, Any]:
    across = panel.across
    return {
        "title": tidy(panel.title), "unit": pretty(panel.unit), "finest": finest(panel.unit),
        "across": {"title": tidy(across.title), "symbol": across.symbol, "unit": pretty(across.unit), "range": [across.low, across.high]},
        "range": [float(end) for end in panel.heights],
        "lines": [_line(line, pool) for line in panel.lines],
        "fills": [_line(line, pool) for line in panel.fills],
        "levels": [{"y": note.y, "text": _said(own.label, own.value, panel.unit, words)}
                   for note, own in zip(panel.levels, raw.levels, strict=True)],
        "marks": [{"x": note.x, "y": note.y, "text": _said(own.label, own.y, panel.unit, words) if own.label else ""}
                  for note, own in zip(panel.marks, raw.marks, strict=True)],
        "uprights": [{"x": note.x, "text": tidy(own.label)}
                     for note, own in zip(panel.verticals, raw.verticals, strict=True)],
        "spans": [{"from": span.start, "to": span.end, "text": tidy(span.text)} for span in panel.spans],
    }  # fmt: skip


def _line(line: ChartLine, pool: ReaderRows) -> Data:
    known = np.maximum.accumulate(np.where(np.isfinite(line.x), np.arange(len(line.x)), 0))
    heights = np.where(np.isfinite(line.x), line.y, np.nan)
    return {"label": tidy(line.label), "x": pool.row(line.x[known], X_DIGITS), "y": pool.row(heights, Y_DIGITS)}


def _said(label: str, value: float, unit: str, words: Catalogue) -> str:
    return f"{tidy(label)} {joined(displayed(value, unit, words['decimal']), pretty(unit))}".strip()
