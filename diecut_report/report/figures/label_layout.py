"""What is written into a diagram, and where: clear of the lines and of each other. In points from its lower left corner."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.report.figures.label_places import anywhere, around, beside_level, beside_vertical, within
from diecut_report.report.figures.panel_data import Frame, Line, PanelData, pieces
from diecut_report.report.figures.style import Box, Labels, marked, overlap, plain, sampled, text_size

Array = NDArray[Any]
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
    size: float = SIZE
    soft: bool = False
    solid: bool = False
    leader: Box | None = None


class LabelLayout:
    """The texts of a panel; ``tags`` are the names of its lines as the legend gives them, none where they stand at the lines."""

    def __init__(self, panel: PanelData, frame: Frame) -> None:
        self.panel, self.frame = panel, frame
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
        # marks, levels and vertical lines whose names have no room, and stand in the legend
        self.told_marks: list[int] = []
        self.told_levels: list[int] = []
        self.told_uprights: list[int] = []
        self._notes()

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
        """Points of levels and edges of areas."""
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
            text = plain(span.text)
            if text:
                size = text_size(text, SIZE)
                start, end = (float(self.frame.points(x, 0)[0]) for x in (span.start, span.end))
                x, y = self.labels.place(size, within(start, end, self.frame.height, size))
                self.texts.append(LabelText(x, y, text, soft=True))

    def _notes(self) -> None:
        """Marks, levels and vertical lines."""
        frame, panel = self.frame, self.panel
        for index, note in enumerate(panel.marks):
            x, y = map(float, frame.points(note.x, note.y))
            size, room = text_size(note.text, SIZE), (frame.width, frame.height)
            around_it = chain(around(x, y), anywhere(x, y, room, size))
            if note.text and not self._write(note.text, around_it, (x, y), IN_THE_WAY):
                self.told_marks.append(index)
        for index, note in enumerate(panel.levels):
            height = float(frame.points(0, note.y)[1])
            places = beside_level(height, frame.width, text_size(note.text, SIZE))
            if note.text and not self._write(note.text, places, most=IN_THE_WAY):
                self.told_levels.append(index)
        for index, note in enumerate(panel.verticals):
            at = float(frame.points(note.x, 0)[0])
            places = beside_vertical(at, frame.width, frame.height, text_size(note.text, SIZE))
            if note.text and not self._write(note.text, places, most=IN_THE_WAY):
                self.told_uprights.append(index)

    # areas
    def _inside(self, area: Line) -> bool:
        """Writes an area's name into it, where it has room for it that covers no other line; whether it had."""
        text = marked(area.label)
        size = text_size(text, SIZE)
        edges = pieces(self.frame.points(area.x, area.y))
        zero = float(self.frame.points(0, 0)[1])
        rooms = sorted((room for edge in edges for room in _rooms(edge, zero, size)), reverse=True)
        places = [(x, y) for room, _, x, y in rooms if room >= size[1] + 4]
        if places:
            return self._write(text, iter(places), most=IN_THE_WAY)
        return False

    # names of lines
    def _tags(self) -> list[str]:
        """The lines' names as the legend gives them: with numbers that stand at the lines, where dashes alone do not do."""
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
        """Places on a line with the gap to all other lines, texts and the frame."""
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
