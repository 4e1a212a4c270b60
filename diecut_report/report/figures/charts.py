"""Charts of the results: diagrams one below the other, of curves or of lines of their own."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise, zip_longest
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from diecut_report.quantities.units import pretty, to_display, unit
from diecut_report.report.curves import continuous, period_of
from diecut_report.report.figures.diagram import HEAD, Diagram, further
from diecut_report.report.figures.panel_data import Across, Line, Note, PanelData, SpanData, limits_of, range_of
from diecut_report.report.figures.sizes import WIDTHS, Size
from diecut_report.report.figures.style import canvas, marked, plain
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import displayed, joined, sentence

Data = Mapping[str, Any]
Array = NDArray[Any]
LEFT, RIGHT, TOP = 46.0, 10.0, 6.0  # points
FOOT, NAMED_FOOT = 8.0, 34.0  # below a diagram: without and with its numbers and their title
HEIGHTS = {  # of a diagram, by the number of diagrams; more share a page
    Size.LARGE: {1: 140.0, 2: 104.0, 3: 86.0, 4: 68.0},
    Size.LOW: {1: 96.0, 2: 74.0, 3: 60.0, 4: 52.0},
    Size.HALF: {1: 96.0, 2: 68.0, 3: 50.0, 4: 46.0},
}
MANY = 4
PAGE = 650.0  # no chart is higher


def plot(figure: Data, curves: Data, words: Catalogue, size: Size = Size.LARGE) -> Figure:
    """Curves of the results, over a common abscissa."""
    return _sheet(diagrams(figure, curves, words), words, size)


def chart(figure: Data, curves: Data, words: Catalogue, size: Size = Size.LARGE) -> Figure:
    """Lines that the figure brings itself, each diagram over what it likes."""
    return _sheet(diagrams(figure, curves, words), words, size)


def diagrams(figure: Data, curves: Data, words: Catalogue) -> list[PanelData]:
    """What the diagrams of a plot or a chart hold, from top to bottom."""
    if figure["type"] == "plot":
        return [_of_curves(panel, curves, curves[figure["abscissa"]], words) for panel in figure["panels"]]
    return [_of_lines(panel, words) for panel in figure["panels"]]


def _sheet(panels: list[PanelData], words: Catalogue, size: Size) -> Figure:
    """All diagrams, one below the other; on a sheet that is to be saved many stand two by two."""
    return _side_by_side(panels, words) if size is Size.LOW and len(panels) >= MANY else _column(panels, words, size)


def _side_by_side(panels: list[PanelData], words: Catalogue) -> Figure:
    """Diagrams in rows of two; numbers stand below the last one of a column, and where the next one runs over something else."""
    width, share = WIDTHS[Size.LOW], WIDTHS[Size.LOW] / 2
    wide, height = share - LEFT - RIGHT, HEIGHTS[Size.HALF][2]
    drawn = _named_once([Diagram(panel, wide, height) for panel in panels])
    for diagram in drawn[1:]:
        diagram.follow(drawn[0])
    below = [each is None or each.across != one.across for one, each in zip_longest(panels, panels[2:])]
    rows = [range(start, min(start + 2, len(panels))) for start in range(0, len(panels), 2)]
    heads = [max(drawn[index].head for index in row) for row in rows]
    feet = [max(NAMED_FOOT + further(drawn[i].across) if below[i] else FOOT for i in row) for row in rows]
    total = TOP + sum(heads) + height * len(rows) + sum(feet)
    sheet, bottom = canvas(width, total), total - TOP
    for row, head, foot in zip(rows, heads, feet, strict=True):
        bottom -= head + height
        for index in row:
            left = LEFT + share * (index % 2)
            axes = sheet.add_axes((left / width, bottom / total, wide / width, height / total))
            drawn[index].draw(axes, words, named=below[index])
        bottom -= foot
    return sheet


def _column(panels: list[PanelData], words: Catalogue, size: Size) -> Figure:
    """All diagrams; numbers stand below a diagram where the next one runs over something else."""
    feet = [NAMED_FOOT if one.across != two.across else FOOT for one, two in pairwise(panels)]
    feet.append(NAMED_FOOT)
    room = (PAGE - TOP - sum(feet) - HEAD * len(panels)) / len(panels)
    height = min(HEIGHTS[size if size in HEIGHTS else Size.LOW][min(len(panels), MANY)], room)
    width = WIDTHS[size]
    wide = width - LEFT - RIGHT
    drawn = _named_once([Diagram(panel, wide, height) for panel in panels])
    for diagram in drawn[1:]:
        diagram.follow(drawn[0])
    named = [foot == NAMED_FOOT for foot in feet]
    feet = [foot + further(each.across) * below for foot, each, below in zip(feet, drawn, named, strict=True)]
    total = TOP + sum(diagram.head for diagram in drawn) + height * len(panels) + sum(feet)
    sheet, bottom = canvas(width, total), total - TOP
    for diagram, foot, below in zip(drawn, feet, named, strict=True):
        bottom -= diagram.head + height
        axes = sheet.add_axes((LEFT / width, bottom / total, wide / width, height / total))
        diagram.draw(axes, words, named=below)
        bottom -= foot
    return sheet


def _named_once(drawn: list[Diagram]) -> list[Diagram]:
    """Name a vertical line that goes through several diagrams in one of them alone, where its name covers nothing."""
    places: dict[tuple[float, str], list[int]] = {}
    for index, diagram in enumerate(drawn):
        for note in diagram.panel.verticals:
            places.setdefault((note.x, note.text), []).append(index)
    kept = {key: next((i for i in found if drawn[i].names.is_clear(key[1])), found[0]) for key, found in places.items()}
    return [diagram.naming({key for key, i in kept.items() if i == index}) for index, diagram in enumerate(drawn)]


def _of_curves(panel: Data, curves: Data, over: Data, words: Catalogue) -> PanelData:
    """A panel of curves, over a whole turn where the abscissa is one."""
    shown, across = panel["unit"], over["display_unit"]
    period = period_of(over)
    end = over["values"][0] + period if period else over["values"][-1]
    lines = []
    for series in panel["series"]:
        x, y = continuous(curves[series["curve"]], over, period)
        lines.append(Line(x / unit(across).factor, y / unit(shown).factor, series["label"]))
    factor = unit(across).factor
    return PanelData(
        title=panel["title"],
        unit=shown,
        across=Across(sentence(over["description"]), over["symbol"], across, *(to_display(v, across) for v in (over["values"][0], end))),
        lines=lines,
        marks=[_mark(mark, across, shown, words) for mark in panel["marks"]],
        levels=[_level(level, shown, words) for level in panel["levels"]],
        spans=[SpanData(span["from"] / factor, span["to"] / factor, span["label"]) for span in panel["spans"]],
        zero=True,
        limits=limits_of(panel, shown),
    )  # fmt: skip


def _of_lines(panel: Data, words: Catalogue) -> PanelData:
    """A panel of lines of its own, as far across as they reach."""
    shown, over = panel["unit"], panel["x"]
    across = over["unit"]
    lines, fills = ([_line(line, across, shown) for line in panel[key]] for key in ("lines", "fills"))
    marks = [_mark(mark, across, shown, words) for mark in panel["marks"]]
    factor = unit(across).factor
    verticals = [Note(line["x"] / factor, 0.0, _phase(line["label"])) for line in panel["verticals"]]
    low, high = range_of([*(line.x for line in (*lines, *fills)), [note.x for note in (*marks, *verticals)]])
    return PanelData(
        title=panel["title"],
        unit=shown,
        across=Across(sentence(over["title"]), over["symbol"], across, low, high if high > low else low + 1),
        lines=lines,
        fills=fills,
        marks=marks,
        levels=[_level(level, shown, words) for level in panel["levels"]],
        verticals=verticals,
        limits=limits_of(panel, shown),
    )


def _line(line: Data, across: str, shown: str) -> Line:
    x, y = (np.array([np.nan if v is None else v for v in line[key]], dtype=float) for key in ("x", "y"))
    return Line(x / unit(across).factor, y / unit(shown).factor, line["label"])


def _mark(mark: Data, across: str, shown: str, words: Catalogue) -> Note:
    """A marked point: its name, its value, and its place."""
    text = f"{marked(mark['label'])} {_value(mark['y'], shown, words)} ({_value(mark['x'], across, words)})"
    return Note(mark["x"] / unit(across).factor, mark["y"] / unit(shown).factor, text if mark["label"] else "")


def _phase(name: str) -> str:
    """The name of a vertical line: a numbered phase, or words and symbols."""
    return name if name and not set(name) - set("IVX") else marked(name)


def _level(level: Data, shown: str, words: Catalogue) -> Note:
    """A level: its name and its value."""
    text = f"{marked(level['label'])} {_value(level['value'], shown, words)}"
    return Note(0.0, level["value"] / unit(shown).factor, text)


def _value(value: float, shown: str, words: Catalogue) -> str:
    return plain(joined(displayed(value, shown, words["decimal"]), pretty(shown)))
