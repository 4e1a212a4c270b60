"""What is written into a diagram, and where: clear of the lines and of each other. In points from its lower left corner."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.quantities.units import unit
from diecut_report.report.figures.style import Box, Labels, marked, overlap, plain, sampled, text_size

# Places that are proposed for the texts of figures, the best liked first (all in points).


Array = NDArray[Any]
Place = tuple[float, float]
Size = tuple[float, float]
CLEAR = 4.0  # between a line and its text


def near(x: float, y: float, size: Size) -> Iterator[Place]:
    """Around a point, the right-hand upper one first."""
    for away in (5.0, 10.0, 17.0, 26.0, 36.0, 48.0):
        for h, v in ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1)):
            yield x + h * (min(away, 5.0) + size[0] / 2), y + v * (away + size[1] / 2)


def at(x: float, y: float, size: Size, anchor: str) -> Iterator[Place]:
    """At a point by the text's left end, middle or right end, then a little above and below, then farther away."""
    aside = {"left": 0.5, "center": 0.0, "right": -0.5}[anchor] * size[0]
    for up in (0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5, 2.5, -2.5):
        yield x + aside, y + up * size[1]
    for up in (0.0, 1.2, -1.2, 2.4, -2.4, 3.6, -3.6):
        for more in (0.5, -0.5, 1.0, -1.0):
            yield x + aside + more * size[0], y + up * size[1]


def along_radius(center: Array, along: Array, radius: float, size: Size) -> Iterator[Place]:
    """Beside a radius, then beyond its end."""
    across = np.array([-along[1], along[0]])
    clear = reach(size, across) + CLEAR
    for share in (0.6, 0.5, 0.7, 0.4, 0.8):
        for side in (1, -1):
            yield tuple(center + share * radius * along + side * clear * across)
    yield tuple(center + (radius + reach(size, along) + 5) * along)


def by_line(one: Array, two: Array, aside: Array, size: Size) -> Iterator[Place]:
    """For a dimension's text: on the side of ``aside`` of its line, on the other, beyond its ends."""
    along = (two - one) / np.hypot(*(two - one))
    clear, beyond = reach(size, aside) + CLEAR, reach(size, along) + 3
    for share in (0.5, 0.35, 0.65, 0.22, 0.78):
        middle = one + share * (two - one)
        yield from (tuple(middle + clear * aside), tuple(middle - clear * aside))
    yield from (tuple(two + beyond * along), tuple(one - beyond * along))
    for away in (6.0, 14.0):
        yield tuple((one + two) / 2 + (clear + away) * aside)


def by_arrow(tail: Array, tip: Array, size: Size) -> Iterator[Place]:
    """For an arrow's text: beside its middle, beyond its tip, then beside its ends."""
    along = (tip - tail) / np.hypot(*(tip - tail))
    aside = np.array([-along[1], along[0]])
    aside = aside if aside[1] > 0 or (aside[1] == 0 and aside[0] > 0) else -aside
    clear = reach(size, aside) + CLEAR
    for share in (0.5, 0.62, 0.38):
        middle = tail + share * (tip - tail)
        yield from (tuple(middle + clear * aside), tuple(middle - clear * aside))
    yield tuple(tip + (reach(size, along) + CLEAR) * along)
    for share in (0.75, 0.25, 0.9, 0.1):
        middle = tail + share * (tip - tail)
        yield from (tuple(middle + clear * aside), tuple(middle - clear * aside))
    for away in (8.0, 16.0, 24.0, 32.0, 42.0, 54.0):
        yield from (tuple((tail + tip) / 2 + side * (clear + away) * aside) for side in (1, -1))


def beside_level(y: float, width: float, size: Size) -> Iterator[Place]:
    """Above or below a horizontal line across a diagram, from the right to the left."""
    for x in np.linspace(width - size[0] / 2 - 6, size[0] / 2 + 6, 24):
        yield from ((x, y + 7.0), (x, y - 7.0))


def beside_vertical(x: float, width: float, height: float, size: Size) -> Iterator[Place]:
    """To the right or left of a vertical line across a diagram, from the top to the bottom; within the frame at last."""
    aside = CLEAR + size[0] / 2
    inmost = min(max(x, size[0] / 2 + CLEAR), width - size[0] / 2 - CLEAR)
    for y in np.linspace(height - size[1] / 2 - 4, size[1] / 2 + 4, 16):
        yield from ((x + aside, y), (x - aside, y), (inmost, y))


def within(start: float, end: float, height: float, size: Size) -> Iterator[Place]:
    """Within a range across a diagram, at its upper edge and then at its lower one, its middle first."""
    middle, room = (start + end) / 2, max((end - start - size[0]) / 2 - 2, 0.0)
    for share in (0.0, -0.5, 0.5, -1.0, 1.0):
        for y in (height - size[1] / 2 - 4, size[1] / 2 + 4):  # clear of the frame
            yield middle + share * room, y


def around(x: float, y: float) -> Iterator[Place]:
    """Above and below a marked point of a diagram, near ones first."""
    for away in (9.0, 16.0, 26.0, 34.0, 44.0, 56.0):
        for aside in (0.0, 48.0, -48.0, 75.0, -75.0, 110.0, -110.0):
            yield from ((x + aside, y + away), (x + aside, y - away))


def anywhere(x: float, y: float, within: Size, size: Size) -> Iterator[Place]:
    """All over a diagram, those near a marked point first; for a text that a thin line leads to."""
    half = size[0] / 2 + CLEAR, size[1] / 2 + CLEAR
    columns, rows = (
        np.linspace(least, max(room - least, least), count)
        for least, room, count in zip(half, within, (13, 5), strict=True)
    )
    places = [(float(column), float(row)) for column in columns for row in rows]
    yield from sorted(places, key=lambda place: abs(place[0] - x) + abs(place[1] - y))


def reach(size: Size, direction: Array) -> float:
    """How far a text's box reaches from its middle in a direction."""
    return float(0.5 * (abs(direction[0]) * size[0] + abs(direction[1]) * size[1]))


# What one diagram of a chart holds, in the units that it shows, and where its numbers lie on the paper.


ROOM = 0.08  # of the diagram's height, above and below what is drawn
MORE_ROOM = 0.16  # where names stand there
BASE = 0.02  # beyond zero, where all is on one side of it


class Across(NamedTuple):
    """What a diagram's lines run over, and its range."""

    title: str
    symbol: str
    unit: str
    low: float
    high: float


class ChartLine(NamedTuple):
    """A line, or the edge of an area; NaN breaks it."""

    x: Array
    y: Array
    label: str


class Note(NamedTuple):
    """A place with what is written there; a level has no x, a vertical line no y."""

    x: float
    y: float
    text: str


class SpanData(NamedTuple):
    """A named range of the abscissa."""

    start: float
    end: float
    text: str


@dataclass(frozen=True, kw_only=True)
class PanelData:
    """One diagram; ``zero`` says that its zero line is always shown."""

    title: str
    unit: str
    across: Across
    lines: list[ChartLine]
    fills: list[ChartLine] = field(default_factory=list)
    marks: list[Note] = field(default_factory=list)
    levels: list[Note] = field(default_factory=list)
    verticals: list[Note] = field(default_factory=list)
    spans: list[SpanData] = field(default_factory=list)
    zero: bool = False
    limits: tuple[float | None, float | None] | None = None

    @property
    def heights(self) -> tuple[float, float]:
        """The range upwards: its ends as they are given, else all that is drawn, zero where it is near, and some room."""
        limits = self.limits or (None, None)
        low, high = (own if end is None else end for own, end in zip(self._drawn, limits, strict=True))
        span = (high - low) or abs(high) or 1.0
        room = span * (MORE_ROOM if self.marks or self.verticals else ROOM)
        below, above = (span * BASE if edge == 0 and not self.zero else room for edge in (low, high))
        return low - below * (limits[0] is None), high + above * (limits[1] is None)

    @property
    def _drawn(self) -> tuple[float, float]:
        """The least and the greatest of what is drawn; without a given range zero is shown where it is near."""
        heights = [line.y for line in (*self.lines, *self.fills)] + [[note.y] for note in (*self.marks, *self.levels)]
        if self.limits is not None:
            return range_of(heights)
        low, high = range_of([*heights, [0.0] if self.fills or self.zero else []])
        near = high - low > 0.5 * max(abs(low), abs(high))
        return (min(low, 0.0), max(high, 0.0)) if near else (low, high)


class Frame(NamedTuple):
    """A diagram on paper: its size in points, and the ranges of its axes."""

    width: float
    height: float
    across: tuple[float, float]
    upwards: tuple[float, float]

    def points(self, x: Any, y: Any) -> Array:
        """Numbers as points from the diagram's lower left corner."""
        (x0, x1), (y0, y1) = self.across, self.upwards
        across = (np.asarray(x, dtype=float) - x0) / (x1 - x0) * self.width
        upwards = (np.asarray(y, dtype=float) - y0) / (y1 - y0) * self.height
        found: Array = np.stack(np.broadcast_arrays(across, upwards), axis=-1)
        return found

    def numbers(self, points: Array) -> tuple[Array, Array]:
        """Points from the corner as numbers of the axes."""
        (x0, x1), (y0, y1) = self.across, self.upwards
        return x0 + points[:, 0] / self.width * (x1 - x0), y0 + points[:, 1] / self.height * (y1 - y0)


def limits_of(ends: Sequence[float | None], shown: str) -> tuple[float | None, float | None] | None:
    """The range of an axis that is declared with what is drawn, in the unit that is shown; None where there is none."""
    if not ends:
        return None
    low, high = (None if end is None else end / unit(shown).factor for end in ends)
    return low, high


def range_of(numbers: Sequence[Any]) -> tuple[float, float]:
    """The least and the greatest of several rows of numbers; zero where there are none."""
    found = np.concatenate([np.zeros(0), *numbers])
    found = found[np.isfinite(found)]
    return (float(found.min()), float(found.max())) if len(found) else (0.0, 0.0)


def pieces(points: Array) -> list[Array]:
    """The unbroken pieces of a line that have a length, each from left to right."""
    whole = np.isfinite(points).all(axis=1)
    edges = np.flatnonzero(np.diff(whole)) + 1
    found = [piece for piece in np.split(points, edges) if len(piece) > 1 and np.isfinite(piece[0]).all()]
    return [piece if piece[-1, 0] >= piece[0, 0] else piece[::-1] for piece in found]


SIZE = 8.0
AWAY = 14.0  # from a mark to its name, for which a thin line leads there, points
DASHES_DIFFER = 4  # so many lines are told apart by their dashes alone; more are named at the lines
# how much each point counts that a text covers: of a curve, of a mark or a line across, of a level or an edge of an area
OVER_CURVE, OVER_MARK, OVER_NOTE = 8.0, 13.0, 3.0
AIR = 1.0
WIDE_ENOUGH = 4.0  # between a line's name and the other lines, points
IN_THE_WAY = 24.0  # what a text would cover: three points of a line; it stands in the legend then
MARGIN = 8.0  # between a line's name and the frame


class LabelText(NamedTuple):
    """A text with its place; nothing shows through a solid one, and a thin line leads from what it names to one that stands away."""

    x: float
    y: float
    text: str
    soft: bool = False
    solid: bool = False
    leader: Box | None = None


class LabelLayout:
    """The texts of a panel; ``tags`` are the names of its lines as the legend gives them, none where they stand at the lines.

    ``told`` are marks, levels and vertical lines whose names have no room, and stand in the legend: the list of the panel, the place in it.
    """

    def __init__(self, panel: PanelData, width: float, height: float) -> None:
        self.panel = panel
        self.frame = frame = Frame(width, height, (panel.across.low, panel.across.high), panel.heights)
        self.texts: list[LabelText] = []
        self.lines = [sampled(frame.points(line.x, line.y)) for line in panel.lines]
        marks, notes = self._marks(), self._noted()
        self.notes = np.concatenate([marks, notes])
        curves = np.concatenate([np.empty((0, 2)), *self.lines])
        weights = np.repeat([OVER_CURVE, OVER_MARK, OVER_NOTE], [len(curves), len(marks), len(notes)])
        self.labels = Labels(np.concatenate([curves, self.notes]), (2, 2, frame.width - 2, frame.height - 2), weights)
        self._spans()
        self.tags = self._tags()
        self.outside = [index for index, area in enumerate(panel.fills) if area.label and not self._inside(area)]
        self.told = list(self._notes())

    def is_clear(self, text: str) -> bool:
        """Return whether a text stands in the diagram and covers nothing."""
        return any(each.text == text and not each.solid for each in self.texts)

    def _marks(self) -> Array:
        """Points of marks and of vertical lines, which a text would hide, or cut in two."""
        frame, panel = self.frame, self.panel
        uprights = [
            np.array([[x, 0], [x, frame.height]]) for x in (frame.points(note.x, 0)[0] for note in panel.verticals)
        ]
        marks = [frame.points(note.x, note.y) + np.array([[-3, -3], [3, 3]]) for note in panel.marks]
        return np.concatenate([np.empty((0, 2)), *map(sampled, [*uprights, *marks])])

    def _noted(self) -> Array:
        frame, panel = self.frame, self.panel
        levels = [np.array([[0, y], [frame.width, y]]) for y in (frame.points(0, note.y)[1] for note in panel.levels)]
        edges = [frame.points(area.x, area.y) for area in panel.fills]
        return np.concatenate([np.empty((0, 2)), *map(sampled, [*levels, *edges])])

    def _write(
        self, text: str, places: Iterator[tuple[float, float]], of: tuple[float, float] | None = None, most: float = np.inf,
    ) -> bool:  # fmt: skip
        """Write a text at the best of the places; not where it would cover more than ``most``: whether it stands there.

        Over lines, where all places are, nothing shows through it.
        """
        size = text_size(text, SIZE)
        (x, y), cost = self.labels.best(size, places)
        if cost > most:
            return False
        self.labels.take((x, y), size)
        self.texts.append(LabelText(x, y, text, solid=cost > 0, leader=_leader((x, y), size, of) if of else None))
        return True

    def _spans(self) -> None:
        """The names of ranges, at the edge and the place along it that is clear of the lines."""
        for span in self.panel.spans:
            if text := plain(span.text):
                size = text_size(text, SIZE)
                start, end = (float(self.frame.points(x, 0)[0]) for x in (span.start, span.end))
                x, y = self.labels.place(size, within(start, end, self.frame.height, size))
                self.texts.append(LabelText(x, y, text, soft=True))

    def _notes(self) -> Iterator[tuple[str, int]]:
        """Write the names of marks, levels and vertical lines; yield those for which there is no room."""
        frame, panel = self.frame, self.panel
        for kind in ("marks", "levels", "verticals"):
            for index, note in enumerate(getattr(panel, kind)):
                x, y = map(float, frame.points(note.x, note.y))
                size = text_size(note.text, SIZE)
                places: Iterator[Place]
                if kind == "marks":
                    places = chain(around(x, y), anywhere(x, y, (frame.width, frame.height), size))
                elif kind == "verticals":
                    places = beside_vertical(x, frame.width, frame.height, size)
                else:
                    places = beside_level(y, frame.width, size)
                of = (x, y) if kind == "marks" else None
                if note.text and not self._write(note.text, places, of, IN_THE_WAY):
                    yield kind, index

    # areas
    def _inside(self, area: ChartLine) -> bool:
        """Writes an area's name into it, where it has room for it that covers no other line; whether it had."""
        text = marked(area.label)
        size = text_size(text, SIZE)
        edges = pieces(self.frame.points(area.x, area.y))
        zero = float(self.frame.points(0, 0)[1])
        rooms = sorted((room for edge in edges for room in _rooms(edge, zero, size)), reverse=True)
        places = [(x, y) for room, _, x, y in rooms if room >= size[1] + 4]
        return bool(places) and self._write(text, iter(places), most=IN_THE_WAY)

    # names of lines
    def _tags(self) -> list[str]:
        labels = [marked(line.label) for line in self.panel.lines]
        if len(labels) <= DASHES_DIFFER:
            return labels
        if self._tagged(labels, least=AIR):
            return ["" for _ in labels]
        numbers = [str(index) if label else "" for index, label in enumerate(labels, 1)]
        self._tagged(numbers)
        return [f"{number}  {label}" if label else "" for number, label in zip(numbers, labels, strict=True)]

    def _tagged(self, names: list[str], least: float = -np.inf) -> bool:
        """Writes each line's name on the line, all of them or, where one comes nearer to another line than ``least``, none."""
        before = len(self.texts), len(self.labels.taken)
        for index, name in enumerate(names):
            if not name or not len(self.lines[index]):
                continue
            size = text_size(name, SIZE)
            gap, x, y = max(self._on_line(index, size))
            if gap < least:
                del self.texts[before[0] :], self.labels.taken[before[1] :]
                return False
            self.labels.take((x, y), size)
            self.texts.append(LabelText(x, y, name, solid=True))
        return True

    def _on_line(self, index: int, size: tuple[float, float]) -> Iterator[tuple[float, float, float]]:
        wide, high = size[0] / 2, size[1] / 2
        others = np.concatenate([self.notes, *(line for place, line in enumerate(self.lines) if place != index)])
        own = self.lines[index]
        for x, y in own[:: max(1, len(own) // 80)]:
            inside = min(x - wide, self.frame.width - x - wide, y - high, self.frame.height - y - high) - MARGIN
            aside, up = np.abs(others - [x, y]).T
            gap = min(float(np.maximum(aside - wide, up - high).min(initial=WIDE_ENOUGH)), WIDE_ENOUGH)
            if gap <= 0:  # over other lines, the farther from the nearest one the better
                gap = float(np.hypot(aside, up).min()) / (wide + high) - 1
            box = (x - wide - AIR, y - high - AIR, x + wide + AIR, y + high + AIR)
            covered = sum(overlap(box, other) for other in self.labels.taken) + max(-100 * inside, 0)
            yield gap - covered, float(x), float(y)


def _leader(center: tuple[float, float], size: tuple[float, float], of: tuple[float, float]) -> Box | None:
    """A line from a mark to the nearest place of its name's box; None where the name stands at the mark."""
    x, y = (float(np.clip(mark, at - side / 2, at + side / 2)) for mark, at, side in zip(of, center, size, strict=True))
    away = float(np.hypot(x - of[0], y - of[1]))
    return (*of, x, y) if away > AWAY else None


def _rooms(edge: Array, zero: float, size: tuple[float, float]) -> Iterator[tuple[float, float, float, float]]:
    """Between an edge and the zero line: the height free over a text's width, how near the middle, and the place."""
    half, enough = size[0] / 2 + 2, 4 * size[1]
    left, right = edge[0, 0] + half, edge[-1, 0] - half
    for x in np.linspace(left, right, 40) if right > left else ():
        heights = np.interp([x - half, x, x + half], edge[:, 0], edge[:, 1]) - zero
        heights = np.append(heights, edge[np.abs(edge[:, 0] - x) <= half, 1] - zero)
        if (heights > 0).all() or (heights < 0).all():
            room = float(heights[np.abs(heights).argmin()])
            yield min(abs(room), enough), -abs(float(x - (left + right) / 2)), float(x), zero + room / 2
