"""Charts of the results: diagrams one below the other, of curves or of lines of their own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import pretty, to_display, unit
from diecut_report.report.chapters.tables import continuous, period_of, through_pole
from diecut_report.report.figures.diagram import HEAD as CHARTS_HEAD
from diecut_report.report.figures.diagram import STROKES, WIDTH, Diagram, further, titled
from diecut_report.report.figures.labels import Across, ChartLine, Note, PanelData, SpanData, limits_of, range_of
from diecut_report.report.figures.style import (
    ACCENT,
    INK,
    MM,
    WIDTHS,
    SizesSize,
    canvas,
    marked,
    plain,
    text_size,
)
from diecut_report.report.model import TornadoFigure
from diecut_report.report.text import Catalogue, displayed, joined, number, sentence, significant
from diecut_report.results.figure_record import (
    BarGroupRecord,
    ChartPanelRecord,
    FigureRecord,
    LevelRecord,
    LineRecord,
    MarkRecord,
    PlotPanelRecord,
)
from diecut_report.results.mechanism_record import CurveRecord

LEFT, RIGHT, TOP = 46.0, 10.0, 6.0  # points
FOOT, NAMED_FOOT = 8.0, 34.0  # below a diagram: without and with its numbers and their title
HEIGHTS = {  # of a diagram, by the number of diagrams; more share a page
    SizesSize.LARGE: {1: 140.0, 2: 104.0, 3: 86.0, 4: 68.0},
    SizesSize.LOW: {1: 96.0, 2: 74.0, 3: 60.0, 4: 52.0},
    SizesSize.HALF: {1: 96.0, 2: 68.0, 3: 50.0, 4: 46.0},
}
MANY = 4
PAGE = 650.0  # no chart is higher


def chart(
    figure: FigureRecord, curves: Mapping[str, CurveRecord], words: Catalogue, size: SizesSize = SizesSize.LARGE
) -> Figure:
    """The diagrams of a plot or a chart, one below the other; on a sheet that is to be saved many stand two by two."""
    panels = diagrams(figure, curves, words)
    return _sheet(panels, words, size, columns=2 if size is SizesSize.LOW and len(panels) >= MANY else 1)


def diagrams(figure: FigureRecord, curves: Mapping[str, CurveRecord], words: Catalogue) -> list[PanelData]:
    """What the diagrams of a plot or a chart hold, from top to bottom."""
    return [
        _of_lines(each, words) if isinstance(each, ChartPanelRecord) else _of_curves(each, curves, curves[figure.abscissa], words)
        for each in figure.panels
    ]  # fmt: skip


def _sheet(panels: list[PanelData], words: Catalogue, size: SizesSize, columns: int) -> Figure:
    """All diagrams; numbers stand below the last one of a column, and where the next one runs over something else."""
    width, share = WIDTHS[size], WIDTHS[size] / columns
    below = [after is None or after.across != one.across for one, after in zip_longest(panels, panels[columns:])]
    room = (PAGE - TOP - sum(NAMED_FOOT if each else FOOT for each in below)) / len(panels) - CHARTS_HEAD
    height = HEIGHTS[SizesSize.HALF][2]
    if columns == 1:
        height = min(HEIGHTS[size if size in HEIGHTS else SizesSize.LOW][min(len(panels), MANY)], room)
    wide = share - LEFT - RIGHT
    drawn = _named_once([Diagram(panel, wide, height) for panel in panels])
    for diagram in drawn[1:]:
        diagram.follow(drawn[0])
    rows = [range(start, min(start + columns, len(panels))) for start in range(0, len(panels), columns)]
    heads = [max(drawn[index].head for index in row) for row in rows]
    feet = [max(NAMED_FOOT + further(drawn[i].across) if below[i] else FOOT for i in row) for row in rows]
    total = TOP + sum(heads) + height * len(rows) + sum(feet)
    sheet, bottom = canvas(width, total), total - TOP
    for row, head, foot in zip(rows, heads, feet, strict=True):
        bottom -= head + height
        for index in row:
            left = LEFT + share * (index % columns)
            axes = sheet.add_axes((left / width, bottom / total, wide / width, height / total))
            drawn[index].draw(axes, words, named=below[index])
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


def _of_curves(
    panel: PlotPanelRecord, curves: Mapping[str, CurveRecord], over: CurveRecord, words: Catalogue
) -> PanelData:
    shown, across = panel.unit, over.display_unit
    period = period_of(over)
    end = over.values[0] + period if period else over.values[-1]
    lines = []
    for series in panel.series:
        x, y = continuous(curves[series.curve], over, period)
        lines.append(ChartLine(x / unit(across).factor, y / unit(shown).factor, series.label))
    factor = unit(across).factor
    return PanelData(
        title=panel.title,
        unit=shown,
        across=Across(sentence(over.description), over.symbol, across, *(to_display(v, across) for v in (over.values[0], end))),
        lines=lines,
        marks=[_mark(mark, across, shown, words) for mark in panel.marks],
        levels=[_level(level, shown, words) for level in panel.levels],
        spans=[SpanData(span.start / factor, span.end / factor, span.label) for span in panel.spans],
        zero=True,
        limits=limits_of(panel.range, shown),
    )  # fmt: skip


def _of_lines(panel: ChartPanelRecord, words: Catalogue) -> PanelData:
    shown, over = panel.unit, panel.x
    across = over.unit
    lines, fills = ([_line(line, across, shown) for line in lines] for lines in (panel.lines, panel.fills))
    marks = [_mark(mark, across, shown, words) for mark in panel.marks]
    factor = unit(across).factor
    named = [(line.x / factor, line.label) for line in panel.verticals]  # a numbered phase, or words and symbols
    verticals = [Note(x, 0.0, name if name and not set(name) - set("IVX") else marked(name)) for x, name in named]
    low, high = range_of([*(line.x for line in (*lines, *fills)), [note.x for note in (*marks, *verticals)]])
    return PanelData(
        title=panel.title,
        unit=shown,
        across=Across(sentence(over.title), over.symbol, across, low, high if high > low else low + 1),
        lines=lines,
        fills=fills,
        marks=marks,
        levels=[_level(level, shown, words) for level in panel.levels],
        verticals=verticals,
        limits=limits_of(panel.range, shown),
    )


def _line(line: LineRecord, across: str, shown: str) -> ChartLine:
    x, y = (np.array(numbers, dtype=float) for numbers in (line.x, line.y))
    return ChartLine(x / unit(across).factor, y / unit(shown).factor, line.label)


def _mark(mark: MarkRecord, across: str, shown: str, words: Catalogue) -> Note:
    text = f"{marked(mark.label)} {_value(mark.y, shown, words)} ({_value(mark.x, across, words)})"
    return Note(mark.x / unit(across).factor, mark.y / unit(shown).factor, text if mark.label else "")


def _level(level: LevelRecord, shown: str, words: Catalogue) -> Note:
    text = f"{marked(level.label)} {_value(level.value, shown, words)}"
    return Note(0.0, level.value / unit(shown).factor, text)


def _value(value: float, shown: str, words: Catalogue) -> str:
    return plain(joined(displayed(value, shown, words["decimal"]), pretty(shown)))


# Horizontal bars of quantities, in groups.


TALL, BESIDE, LEAST = 17.0, 14.0, 56.0  # of a bar with its room, beside a group, and the least width for bars, points


def bars(figure: FigureRecord, _curves: Any, words: Catalogue, size: SizesSize = SizesSize.LARGE) -> Figure:
    """Horizontal bars in groups side by side, in rows where they have no room; what is subtracted is hatched."""
    groups, width = figure.groups, WIDTHS[size]
    rows = _rows(groups, width)
    below = 20 if any(group.range for group in groups) else 8
    heights = [26 + TALL * max(len(group.bars) for group in row) + below for row in rows]
    height = 4 + sum(heights)
    sheet, top = canvas(width, height), height - 2
    names = [max(map(_names, column)) for column in zip_longest(*rows, fillvalue=rows[0][0])]
    for row, step in zip(rows, heights, strict=True):
        left = 0.0
        for group, named in zip(row, names, strict=False):
            room, tall = _room(names, width), TALL * len(group.bars)
            box = (left + named + 4) / width, (top - 22 - tall) / height, room / width, tall / height
            _group(sheet.add_axes(box), width, group, words)
            left += named + room + BESIDE
        top -= step
    return sheet


def _rows(groups: Sequence[BarGroupRecord], width: float) -> list[list[BarGroupRecord]]:
    """The groups in as few rows as leave room for their bars and their titles."""
    for columns in range(len(groups), 1, -1):
        rows = [list(groups[start : start + columns]) for start in range(0, len(groups), columns)]
        room = _room([max(map(_names, column)) for column in zip_longest(*rows, fillvalue=groups[0])], width)
        if all(max(LEAST, text_size(_title(group))[0]) <= room for group in groups):
            return rows
    return [[group] for group in groups]


def _names(group: BarGroupRecord) -> float:
    return max(text_size(plain(bar.label))[0] for bar in group.bars) + 8


def _room(names: Sequence[float], width: float) -> float:
    """How wide the bars of each group in a row are beside names of these widths, points."""
    return (width - sum(names) - BESIDE * len(names)) / len(names)


def _title(group: BarGroupRecord) -> str:
    return plain(group.label) + (f", {pretty(group.unit)}" if pretty(group.unit) else "")


def _group(axes: Axes, width: float, group: BarGroupRecord, words: Catalogue) -> None:
    values = [bar.value / unit(group.unit).factor for bar in group.bars]
    rows = np.arange(len(values))[::-1]
    last = len(values) - 1
    for index, (row, value) in enumerate(zip(rows, values, strict=True)):
        colour, hatch = ("white", "/////") if value < 0 else (ACCENT if index == last else "#9fb4c4", None)
        axes.barh(row, value, 0.62, edgecolor=INK, linewidth=0.6, facecolor=colour, hatch=hatch)
        text = displayed(group.bars[index].value, group.unit, words["decimal"])
        axes.annotate(text, (max(value, 0), row), (3, 0), textcoords="offset points", va="center_baseline", size=8)
    _across(axes, width, values, limits_of(group.range, group.unit), words)
    axes.set_yticks(rows, [plain(bar.label) for bar in group.bars], va="center_baseline")
    axes.set_ylim(-0.6, len(values) - 0.4)
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.set_title(_title(group), pad=5)
    axes.grid(visible=False)
    axes.tick_params(axis="y", length=0)
    axes.spines[:].set_visible(False)


def _across(
    axes: Axes, width: float, values: Sequence[float], limits: tuple[float | None, float | None] | None, words: Catalogue
) -> None:  # fmt: skip
    """Lay out the axis of the bars on a sheet of a width, with room for their numbers; where its range is declared its ends are named."""
    room = max(text_size(number(significant(value)))[0] for value in values) + 6
    points = axes.get_position().width * width
    own = min([0.0, *values]), max([0.0, *values])
    low, high = (each if end is None else end for each, end in zip(own, limits or (None, None), strict=True))
    margin = 0.0 if limits and limits[0] is not None else 0.02 * (max(map(abs, values)) or 1.0)
    axes.set_xlim(low - margin, high + room * (high - low) / max(points - room, 1))
    axes.tick_params(axis="x", bottom=limits is not None, labelbottom=limits is not None)
    if limits:
        axes.set_xticks([low, high], [number(number_text(end), words["decimal"]) for end in (low, high)])


# Polar diagrams: curves of the results over an angle.


TURN = 360.0
SIDES = {SizesSize.LARGE: 100 * MM, SizesSize.LOW: 74 * MM, SizesSize.HALF: 74 * MM}  # of the square about the circles
HEADS = {SizesSize.LARGE: 16.0, SizesSize.HALF: 30.0}  # above it: beside the uppermost angle, or higher


def polar(
    figure: FigureRecord, curves: Mapping[str, CurveRecord], words: Catalogue, size: SizesSize = SizesSize.LARGE
) -> Figure:
    """Size of curves as distance from the pole over an angle; what is negative has another line."""
    over = curves[figure.abscissa]
    side, width = SIDES.get(size, SIDES[SizesSize.LOW]), WIDTHS[size]
    total = side + HEADS.get(size, HEADS[SizesSize.HALF])
    sheet = canvas(width, total)
    box = (width - side + 40) / 2 / width, 30 / total, (side - 40) / width, (side - 30) / total
    axes = sheet.add_axes(box, projection="polar")
    for index, series in enumerate(figure.series):
        x, y = through_pole(*continuous(curves[series.curve], over, period_of(over)))
        y = y / unit(figure.unit).factor
        for sign, shade in ((1, 0), (-1, 1)):
            colour, dashes, width = STROKES[(2 * index + shade) % len(STROKES)]
            said = f"{marked(series.label)}, {words['positive' if sign > 0 else 'negative']}"
            sizes = np.where(sign * y >= 0, np.abs(y), np.nan)
            axes.plot(x, sizes, color=colour, linestyle=dashes, linewidth=width, label=said)
    axes.set_rlabel_position(_emptiest(axes))  # type: ignore[attr-defined]
    axes.set_xticks(np.radians(np.arange(0, TURN, 30)))
    axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))
    axes.tick_params(pad=1)
    low, high = limits_of(figure.range, figure.unit) or (None, None)
    axes.set_ylim(low or 0, high)
    greatest = max(tick for tick in axes.get_yticks() if tick <= axes.get_ylim()[1])
    axes.yaxis.set_major_formatter(FuncFormatter(lambda v, _: _radial(v, greatest, figure.unit, words)))
    sheet.text(0.02, 1 - 14 / total, titled(over.description, over.symbol, over.display_unit))
    sheet.legend(*axes.get_legend_handles_labels(), loc="lower center", ncols=2, borderaxespad=0.1)
    return sheet


def _emptiest(axes: Axes) -> float:
    """The direction, in degrees, in which the curves stay nearest to the pole: there the circles are named."""
    drawn = np.concatenate([np.column_stack(line.get_data()) for line in axes.lines])
    angles, sizes = np.degrees(drawn[:, 0]) % TURN, np.nan_to_num(drawn[:, 1])
    directions = np.arange(15.0, TURN, 30.0)
    return float(min(directions, key=lambda d: sizes[np.abs((angles - d + 180) % TURN - 180) < 14].max(initial=0.0)))


def _radial(value: float, greatest: float, shown: str, words: Catalogue) -> str:
    text = number(f"{value:.10g}", words["decimal"])
    return "" if value == 0 else joined(text, pretty(shown)) if value == greatest else text


# A tornado: what each input does to a number, lowered and raised, as bars beside today's value.


ROW, HEAD, TORNADO_FOOT = 17.0, 14.0, 24.0  # points
LOWERED = "#b06a2c"


def tornado(figure: TornadoFigure, _curves: Any, words: Catalogue, _size: SizesSize = SizesSize.LARGE) -> Figure:
    """Draw the bars, with the input lowered and raised, about today's value."""
    today, bars = figure.today, figure.bars
    height = HEAD + TORNADO_FOOT + ROW * len(bars)
    sheet = canvas(WIDTH, height)
    names = max(text_size(bar.name)[0] for bar in bars) + 10
    box = names / WIDTH, TORNADO_FOOT / height, (WIDTH - names - 12) / WIDTH, ROW * len(bars) / height
    axes = sheet.add_axes(box)
    places = np.arange(len(bars))[::-1]
    for place, bar in zip(places, bars, strict=True):
        for side, colour in (("low", LOWERED), ("high", ACCENT)):
            if (value := getattr(bar, side)) is not None:
                axes.barh(place, value - today, 0.62, left=today, color=colour, alpha=0.85)
            else:
                axes.plot(today, place, "x", color=colour)
    axes.set_yticks(places, [bar.name for bar in bars], va="center_baseline")
    axes.xaxis.set_major_formatter(lambda value, _: number(number_text(value), words["decimal"]))
    axes.set_ylim(-0.6, len(bars) - 0.4)
    axes.axvline(today, color=INK, linewidth=0.8)
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    axes.spines[["top", "right", "left"]].set_visible(False)
    axes.set_axisbelow(True)
    return sheet
