"""The chart of parallel coordinates: each variant a line from its inputs to its results, and where on each axis variants pass."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from diecut_report.report.figures.diagram import WIDTH
from diecut_report.report.figures.style import INK, Svg, canvas, text_size
from diecut_report.study.analysis.stored_variants import STATUSES, StoredColumn
from diecut_report.study.summary.charts import chart, panel
from diecut_report.study.summary.data import SampledVariants
from diecut_report.study.summary.quantity_names import display, titled, value_told, wrapped

Array = NDArray[Any]
Ends = tuple[float, float, bool]  # of an axis, and whether greater values stand at its upper end
MOST = 120  # lines of those that do not fail, and of those that fail
MOST_WORDS = 16  # on an upright axis
FIELDS, FIELD = 12, 7.0  # of an axis, and how many points they are wide
SPREAD = 0.5  # of the distance between words, over which their lines are spread
HIGH, SIDE = 190.0, 38.0  # points of the axes, and beside the outermost ones
SMALL, LEAST = 6.5, 5.0  # points of letters
LOOKS: dict[str, dict[str, Any]] = {  # dark before pale, also in grey
    "fail": {"color": "#dca09d", "linewidth": 0.4, "alpha": 0.8, "zorder": 2.0},
    "warn": {"color": "#a8741a", "linewidth": 0.8, "alpha": 0.9, "zorder": 2.1, "linestyle": (0, (4, 1.5))},
    "pass": {"color": "#123f66", "linewidth": 0.8, "alpha": 0.75, "zorder": 2.2},
}
DARK = "#123f66"


class DrawnLines(NamedTuple):
    """Hold the variants that are drawn as lines, by their place in the sample, and of how many they were taken."""

    sound: Array
    failing: Array
    all_sound: int
    all_failing: int

    @property
    def is_whole(self) -> bool:
        """Return whether none is left out."""
        return len(self.sound) == self.all_sound and len(self.failing) == self.all_failing


def drawn_lines(sample: SampledVariants) -> DrawnLines:
    """Return which variants are drawn: of those that do not fail and of those that fail at most so many, evenly taken from the sample."""
    sound = np.flatnonzero(sample.status < STATUSES.index("fail"))
    failing = np.flatnonzero(sample.status == STATUSES.index("fail"))
    return DrawnLines(_evenly(sound), _evenly(failing), len(sound), len(failing))


def _evenly(places: Array) -> Array:
    """At most so many places of many, at equal distances."""
    if len(places) <= MOST:
        return places
    found: Array = places[np.linspace(0, len(places) - 1, MOST).round().astype(int)]
    return found


def parallel(
    sample: SampledVariants, lines: DrawnLines, columns: Sequence[StoredColumn], ends: Mapping[str, Ends], told: str
) -> Svg:
    """Return the variants as lines over upright axes, passing ones in front; the darker a field of an axis, the more of it passes."""
    return chart(partial(_parallel, sample, lines, columns, ends), told, "parallel")


def _parallel(
    sample: SampledVariants, lines: DrawnLines, columns: Sequence[StoredColumn], ends: Mapping[str, Ends]
) -> Figure:
    pitch = (WIDTH - 2 * SIDE) / (len(columns) - 1)
    names = [wrapped(titled(column), min(pitch, 100) - 6, SMALL, 6) for column in columns]
    foot = 18 + 8.8 * max(name.count("\n") + 1 for name in names)
    sheet = canvas(WIDTH, HIGH + 14 + foot)
    axes = panel(sheet, SIDE, foot, WIDTH - 2 * SIDE, HIGH)
    scaled = _scaled(sample, columns, ends)
    _lines(axes, sample, lines, scaled)
    room = min(pitch, 2 * SIDE) - 4
    for place, column in enumerate(columns):
        _fields(axes, place, scaled[:, place], sample.status, FIELD / pitch)
        axes.axvline(place, color=INK, linewidth=0.6, zorder=3)
        _scale(axes, place, column, ends[column.name], sample.words.get(column.name), room)
        _text(axes, names[place], (place, 0), -13, SMALL)
    axes.set_ylim(-0.01, 1.01)
    axes.set_xlim(0, len(columns) - 1)
    axes.set_axis_off()
    return sheet


def _scaled(sample: SampledVariants, columns: Sequence[StoredColumn], ends: Mapping[str, Ends]) -> Array:
    """The heights of all variants on all axes, from 0 to 1; words a little to both sides of their place."""
    found = []
    for column in columns:
        values, (low, top, _) = sample.values[column.name], ends[column.name]
        if column.name in sample.words:
            low, top = low - SPREAD, top + SPREAD
            values = values + SPREAD * (np.arange(len(values)) * 0.618 % 1 - 0.5)
        found.append((np.minimum(values, top) - low) / ((top - low) or 1.0))
    made: Array = np.column_stack(found)
    return made


def _lines(axes: Axes, sample: SampledVariants, lines: DrawnLines, scaled: Array) -> None:
    across = np.arange(scaled.shape[1])
    kept = np.concatenate([lines.failing, lines.sound])
    for status, look in LOOKS.items():
        here = kept[sample.status[kept] == STATUSES.index(status)]
        axes.plot(across, scaled[here].T, **{"linestyle": "-", "solid_joinstyle": "round", **look})


def _fields(axes: Axes, place: int, heights: Array, status: Array, wide: float) -> None:
    """Fields along an axis, the darker the larger the share of its variants that do not fail."""
    there = np.isfinite(heights) & (status != STATUSES.index("error"))
    edges = np.linspace(0, 1, FIELDS + 1)
    every, sound = (
        np.histogram(heights[chosen], edges)[0] for chosen in (there, there & (status < STATUSES.index("fail")))
    )
    for low, high, count, good in zip(edges, edges[1:], every, sound, strict=False):
        if count:
            share = good / count
            look: dict[str, Any] = {"facecolor": "white", "edgecolor": "#9aa4ae", "linewidth": 0.4, "zorder": 2.6}
            axes.add_patch(Rectangle((place - wide / 2, low), wide, high - low, clip_on=False, **look))
            dark: dict[str, Any] = {"facecolor": DARK, "alpha": float(share), "linewidth": 0, "zorder": 2.7}
            axes.add_patch(Rectangle((place - wide / 2, low), wide, high - low, clip_on=False, **dark))


def _scale(axes: Axes, place: int, column: StoredColumn, ends: Ends, words: list[str] | None, room: float) -> None:
    """The ends of an upright axis; of words each at its place."""
    low, top, is_cut = ends
    if words is None:
        _fitted(axes, display(low, column), (place, 0), -3, room)
        _fitted(axes, f"{'≥ ' if is_cut else ''}{display(top, column)}", (place, 1), 3, room)
        return
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.6}
    for index, word in list(enumerate(words))[:: -(-len(words) // MOST_WORDS)]:
        height = (index + SPREAD) / (top - low + 2 * SPREAD)
        said = wrapped(value_told(word), room, 6.0, 2)
        axes.annotate(said, (place, height), ha="center", va="center", size=6.0, bbox=box, zorder=4, linespacing=1.0)


def _fitted(axes: Axes, text: str, place: tuple[float, float], above: float, room: float) -> None:
    """A text in letters that are small enough to leave its neighbours their room."""
    size = 7.0
    while size > LEAST and text_size(text, size)[0] > room:
        size -= 0.5
    _text(axes, text, place, above, size)


def _text(axes: Axes, text: str, place: tuple[float, float], above: float, size: float) -> None:
    """A text above or below a place, some points away."""
    side = "bottom" if above > 0 else "top"
    axes.annotate(
        text, place, (0, above), textcoords="offset points", ha="center", va=side, size=size, linespacing=1.05
    )
