"""One diagram on paper: its axes, lines, areas, marks, names and legend."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MaxNLocator, MultipleLocator

from diecut_report.quantities.units import pretty
from diecut_report.report.figures.drawing import hatching, strokes
from diecut_report.report.figures.labels import SIZE, Frame, LabelLayout, PanelData, pieces
from diecut_report.report.figures.style import (
    ACCENT,
    FONT_SIZE,
    INK,
    LINE,
    PALE,
    SOFT,
    WIDTHS,
    SizesSize,
    marked,
    plain,
    symbol,
    text_size,
    wrapped,
)
from diecut_report.report.text import Catalogue, number

WIDTH = WIDTHS[SizesSize.LARGE]
STROKES: tuple[tuple[str, Any, float], ...] = (  # more lines than there are here are named at the lines
    (ACCENT, "-", 1.4),
    (INK, (0, (5, 2)), 1.1),
    (SOFT, (0, (6, 1.5, 1.2, 1.5)), 1.1),
    (INK, (0, (1.2, 1.4)), 1.1),
    (INK, "-", 0.6),
    (ACCENT, (0, (10, 2.5)), 1.3),
    (SOFT, (0, (6, 1.4, 1.2, 1.4, 1.2, 1.4)), 1.1),
    (ACCENT, (0, (2.6, 1.6)), 1.4),
)
LEVELS: tuple[Any, ...] = (  # unlike the strokes of the lines, beside which they stand in a legend
    (0, (1, 1.6)),
    (0, (10, 2, 1.2, 2)),
    (0, (4, 1.5, 1.2, 1.5, 1.2, 1.5)),
)
UPRIGHT = (0, (4, 2.5))
MARKS = "os^Dv<>pPX"
HEAD, TITLE, ROW = 20.0, 17.0, 12.6  # points above a diagram: its head, in it the title, each row of a legend above it
# of a legend, in font sizes: its strokes, the room behind them, between columns
HANDLE, BESIDE, BETWEEN = 2.6, 0.8, 1.6
OF_HANDLE = (HANDLE + BESIDE) * SIZE + 8  # beside a text of a legend, points
APART, ABOVE = 24.0, 11.0  # the least room for a number at an axis, points


class Legend(NamedTuple):
    """How the legend above a diagram is set: beside the title, or in rows below it."""

    columns: int
    rows: int
    beside: bool


class Diagram:
    """A panel whose names have found their places."""

    def __init__(self, panel: PanelData, width: float, height: float) -> None:
        self.panel = panel
        self.names = LabelLayout(panel, width, height)
        self.frame = self.names.frame
        self.tags = self.names.tags if len(panel.lines) > 1 else []
        self.areas = [marked(panel.fills[index].label) for index in self.names.outside]
        notes = [getattr(panel, kind)[index].text for kind, index in self.names.told]
        self._told = [tag for tag in self.tags if tag] + self.areas + notes
        self.left_out: set[str] = set()  # names that another diagram's legend has
        self.title = wrapped(self._title(), width)
        self.legend = legend(self.told, width, text_size(self.title)[0])
        self.across = wrapped(titled(*panel.across[:3]), width)

    @property
    def told(self) -> list[str]:
        """The names in the legend, in lines where one has no room."""
        return [wrapped(text, self.frame.width - OF_HANDLE, SIZE) for text in self._told]

    @property
    def head(self) -> float:
        """The room that it needs above."""
        above = 0.0 if self.legend is None or self.legend.beside else self.legend.rows * ROW
        return HEAD + further(self.title) + above

    def naming(self, named: Collection[tuple[float, str]]) -> Diagram:
        """Return the diagram with the names of those vertical lines alone, told by their places and texts."""
        kept = [note if (note.x, note.text) in named else note._replace(text="") for note in self.panel.verticals]
        if kept == self.panel.verticals:
            return self
        return Diagram(replace(self.panel, verticals=kept), self.frame.width, self.frame.height)

    def follow(self, first: Diagram) -> None:
        """Leave away of a legend what the first diagram's legend names already, line by line and area by area."""
        if self.legend is None:
            return
        are_lines_told = self.tags == first.tags[: len(self.tags)]
        are_areas_told = self.areas == first.areas[: len(self.areas)]
        self.left_out = {*(self.tags if are_lines_told else ()), *(self.areas if are_areas_told else ())}
        self._told = [text for text in self._told if text not in self.left_out]
        self.legend = legend(self.told, self.frame.width, text_size(self.title)[0])

    def draw(self, axes: Axes, words: Catalogue, *, named: bool) -> None:
        """Draw into axes; ``named`` puts numbers and a title below."""
        axes.set_xlim(self.frame.across)
        axes.set_ylim(self.frame.upwards)
        handles = [*self._lines(axes), *self._areas(axes), *self._notes(axes)]
        handles = [handle for handle in handles if str(handle.get_label()) not in self.left_out]
        _ticks(axes, self.panel, self.frame, words)
        axes.tick_params(labelbottom=named)
        if named:
            axes.set_xlabel(self.across, labelpad=2)
        self._head(axes, handles)
        for text in self.names.texts:
            face, alpha = PALE if text.soft else "white", 1.0 if text.solid else 0.8
            halo = {"facecolor": face, "edgecolor": "none", "alpha": alpha, "pad": 0.6}
            place = text.x / self.frame.width, text.y / self.frame.height
            if text.leader:
                ends = np.reshape(text.leader, (2, 2)) / (self.frame.width, self.frame.height)
                axes.plot(*ends.T, color=SOFT, linewidth=0.5, transform=axes.transAxes, zorder=4)
            axes.text(*place, text.text, transform=axes.transAxes, ha="center", va="center", size=SIZE,
                      color=INK, zorder=6, bbox=halo)  # fmt: skip

    def _title(self) -> str:
        lines = self.panel.lines
        label = marked(lines[0].label) if len(lines) == 1 else ""
        parts = [plain(self.panel.title)] + ([label] if "$" in label else [])
        shown = pretty(self.panel.unit)
        return " ".join(parts) + (f", {shown}" if shown else "")

    def _head(self, axes: Axes, handles: list[Any]) -> None:
        axes.set_title(self.title, pad=4, y=1.0)  # where it stands is known: matplotlib need not look for room
        if self.legend is None:
            return
        above = 1 + (TITLE + further(self.title)) / self.frame.height
        beside = self.legend.beside
        axes.legend(
            handles, self.told, loc="lower right" if beside else "lower left",
            bbox_to_anchor=(1.01, 1.0) if beside else (-0.01, above), ncols=self.legend.columns, borderaxespad=0,
            borderpad=0.25, columnspacing=BETWEEN, handletextpad=BESIDE, handlelength=HANDLE, labelspacing=0.25, fontsize=SIZE,
        )  # fmt: skip

    def _lines(self, axes: Axes) -> list[Line2D]:
        handles = []
        for index, line in enumerate(self.panel.lines):
            colour, dashes, width = STROKES[index % len(STROKES)]
            look = {"color": colour, "linestyle": dashes, "linewidth": width, "zorder": 3 - 0.1 * index}
            handles += axes.plot(line.x, line.y, **look)
        for handle, tag in zip(handles, self.tags, strict=False):
            handle.set_label(tag)
        return [handle for handle, tag in zip(handles, self.tags, strict=False) if tag]

    def _areas(self, axes: Axes) -> list[Patch]:
        """The areas, pale and hatched, each in its direction; those that the legend names."""
        for index, area in enumerate(self.panel.fills):
            axes.fill_between(area.x, area.y, 0, facecolor=PALE, linewidth=0, zorder=0.6)
            zero = self.frame.points(0, 0)[1]
            loops = [
                np.vstack([edge, [edge[-1, 0], zero], [edge[0, 0], zero], edge[:1]])
                for edge in pieces(self.frame.points(area.x, area.y))
            ]
            if loops:
                hatched = strokes(*hatching(loops, falling=bool(index % 2)))
                axes.plot(*self.frame.numbers(hatched), color=SOFT, linewidth=0.35, zorder=0.7)
        return [
            Patch(facecolor=PALE, edgecolor=SOFT, linewidth=0.5, hatch=("////", "\\\\\\\\")[index % 2],
                  label=marked(self.panel.fills[index].label)) for index in self.names.outside
        ]  # fmt: skip

    def _notes(self, axes: Axes) -> list[Line2D]:
        """The zero line, levels, vertical lines, marked points and ranges, without their texts; those that the legend names."""
        panel, marks, ink = self.panel, list[Line2D](), dict[str, Any](color=INK, zorder=2)
        axes.axhline(0, color=INK, linewidth=0.6, zorder=1)
        levels = [
            axes.axhline(level.y, linewidth=0.7, linestyle=LEVELS[index % len(LEVELS)], **ink)
            for index, level in enumerate(panel.levels)
        ]
        uprights = [axes.axvline(each.x, linewidth=0.6, linestyle=UPRIGHT, **ink) for each in panel.verticals]
        for index, mark in enumerate(panel.marks):
            marks += axes.plot([mark.x], [mark.y], MARKS[index % len(MARKS)], markersize=4.5, markerfacecolor="white",
                               markeredgecolor=INK, zorder=5, clip_on=False)  # fmt: skip
        for span in panel.spans:
            axes.axvspan(span.start, span.end, color=PALE, linewidth=0, zorder=0)
        handles = {"marks": marks, "levels": levels, "verticals": uprights}
        for kind, index in self.names.told:
            handles[kind][index].set_label(getattr(panel, kind)[index].text)
        return [handles[kind][index] for kind, index in self.names.told]


def legend(told: list[str], width: float, title: float) -> Legend | None:
    """How a legend of these texts is set over a diagram of a width with a title of another; None where there is nothing."""
    if not told:
        return None
    wide = [HANDLE * SIZE + BESIDE * SIZE + text_size(text, SIZE)[0] for text in told]
    for columns in range(len(wide), 0, -1):
        groups = np.array_split(np.array(wide), columns)  # column by column, as matplotlib fills them
        total = sum(float(group.max()) for group in groups) + BETWEEN * SIZE * (columns - 1) + 6
        if columns == len(wide) and total + title + 12 <= width:
            return Legend(columns, 1, beside=True)
        if total <= width:
            break
    further_lines = max(sum(text.count("\n") for text in column) for column in np.array_split(np.array(told), columns))
    return Legend(columns, -(-len(wide) // columns) + int(further_lines), beside=False)


def further(text: str) -> float:
    """Return the height of all lines of a text but its first, in points."""
    return text.count("\n") * LINE * FONT_SIZE


def titled(words: str, sign: str, shown: str) -> str:
    """Quantity, symbol and unit as the title of an axis: ``Crank angle φ, °``."""
    parts = [plain(words)] + ([symbol(sign)] if sign else [])
    return " ".join(parts) + (f", {pretty(shown)}" if pretty(shown) else "")


def _ticks(axes: Axes, panel: PanelData, frame: Frame, words: Catalogue) -> None:
    """Round numbers at both axes: angles in steps that divide a turn, whole numbers under points that are counted."""
    across = panel.across
    is_counted = len(panel.marks) > 1 and all(float(mark.x).is_integer() for mark in panel.marks)
    span = across.high - across.low
    if across.unit == "deg" and span > 60:
        axes.xaxis.set_major_locator(MultipleLocator(60 if span > 200 else 30))
        axes.xaxis.set_minor_locator(MultipleLocator(30 if span > 200 else 10))
    else:
        steps = [1, 1.5, 3, 5, 10] if across.unit == "deg" else [1, 2, 2.5, 5, 10]
        most, is_whole = min(9, int(frame.width / APART)), is_counted and across.unit == "1"
        axes.xaxis.set_major_locator(MaxNLocator(most, steps=steps, integer=is_whole))
    axes.yaxis.set_major_locator(MaxNLocator(min(6, int(frame.height / ABOVE)), steps=[1, 2, 2.5, 5, 10]))
    printed = FuncFormatter(lambda value, _: number(f"{value:.10g}", words["decimal"]))
    axes.xaxis.set_major_formatter(printed)
    axes.yaxis.set_major_formatter(printed)
