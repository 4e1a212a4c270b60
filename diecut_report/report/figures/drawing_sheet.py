"""A sheet to draw on: what all shapes of a drawing have in common, and the texts, which find their places at last."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from diecut_report.quantities.units import pretty, unit
from diecut_report.report.figures.drawing_scale import PAGE, folded, scaled
from diecut_report.report.figures.shapes import extent
from diecut_report.report.figures.style import INK, MM, Box, Labels, canvas, marked, overlap, sampled, text_size
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import joined, number, significant

Array = NDArray[Any]
Shape = Mapping[str, Any]
THIN_LINE: dict[str, Any] = {"color": INK, "linewidth": 0.45, "zorder": 2.5}
ARROW, SLENDER = 7.0, 0.17  # the head of a dimension
THICK, THIN = 8.0, 2.0  # how much texts keep clear of lines
FAR = 12.0  # a point's name no nearer than this gets a leader
FREE = 9.0  # what may be in the way of a text
LONG = 50.0  # a text of so many points may be folded


class DrawingSheet:
    """A drawing in work: shapes in points, what texts must keep clear of, and the box that all of it needs."""

    def __init__(self, figure: Mapping[str, Any], words: Catalogue, room: Array) -> None:
        self.shapes: list[Shape] = figure["shapes"]
        self.unit: str = figure["unit"]
        self.schematic: bool = figure.get("schematic", False)
        self.words = words
        self.scale = scaled(self.shapes, room, schematic=self.schematic)
        corners = np.concatenate([extent(shape) for shape in self.shapes]) * self.scale.both
        self.lines: list[tuple[Array, float]] = []  # with how much texts are to keep clear of them
        self.boxes: list[Box] = [(*corners.min(axis=0), *corners.max(axis=0))]
        self.solid: list[Box] = []  # where no text may stand
        self.wished: list[tuple[float, float]] = []  # from where to where labels reach where they are asked for
        self.crowded = 0.0  # how much stands in the way of texts
        self.texts: list[Callable[[Labels], None]] = []
        self.sheet = canvas(10, 10)
        self.axes: Axes = self.sheet.add_axes((0, 0, 1, 1))
        self.axes.set_axis_off()

    def finish(self) -> None:
        """Draws all shapes first, then the texts between them; the sheet is cut to what is on it."""
        for shape in self.shapes:
            self.draw(shape)
        labels = self._labels()
        for write in self.texts:
            write(labels)
        self.boxes += labels.taken
        if not self.schematic and pretty(self.unit):
            self._scale_bar()
        left, bottom, right, top = (pick(box[i] for box in self.boxes) for i, pick in enumerate((min, min, max, max)))
        left, bottom, right, top = left - 4, bottom - 4, right + 4, top + 4
        self.axes.set_xlim(left, right)
        self.axes.set_ylim(bottom, top)
        self.sheet.set_size_inches((right - left) / 72, (top - bottom) / 72)
        self.crowded += 50 * float(np.maximum([right - left, top - bottom] - PAGE, 0.0).sum())
        self.crowded += sum(overlap(one, other) for one, other in combinations(self.solid, 2))

    def _labels(self) -> Labels:
        """Where texts may stand: clear of all lines and boxes, and on the page."""
        lines = [(sampled(line), weight) for line, weight in self.lines]
        weights = np.concatenate([np.zeros(0), *(np.full(len(line), weight) for line, weight in lines)])
        points = np.concatenate([np.empty((0, 2)), *(line for line, _ in lines)])
        wide = [(self.boxes[0][0], self.boxes[0][2]), *self.wished]
        middle = (min(left for left, _ in wide) + max(right for _, right in wide)) / 2
        labels = Labels(points, (middle - PAGE[0] / 2 + 5, -np.inf, middle + PAGE[0] / 2 - 5, np.inf), weights)
        labels.taken += self.solid
        return labels

    def _points(self, coordinates: Any) -> Array:
        points: Array = np.asarray(coordinates, dtype=float).reshape(-1, 2) * self.scale.both
        return points

    def _line(self, points: Array, **look: Any) -> None:
        self.axes.plot(points[:, 0], points[:, 1], **look)
        self.lines.append((points, THIN if look["linewidth"] < 0.6 else THICK))

    def draw(self, shape: Shape) -> None:
        """Draw a shape."""
        raise NotImplementedError

    def _head(
        self,
        tip: Array,
        along: Array,
        length: float = ARROW,
        slender: float = SLENDER,
        color: str = INK,
        zorder: float = 2.6,
    ) -> None:
        """The head of an arrow."""
        across = np.array([-along[1], along[0]]) * length * slender
        corners = np.array([tip, tip - length * along + across, tip - length * along - across])
        self.axes.fill(*corners.T, color=color, linewidth=0, zorder=zorder)

    def _later(
        self,
        text: str,
        proposed: Callable[[tuple[float, float]], Iterable[tuple[float, float]]],
        leader: tuple[float, float] | None = None,
    ) -> None:
        """A text that finds its place when all shapes are drawn, in two or three lines where it has none in one.

        Far from its ``leader`` it gets a line to it.
        """
        variants = ["\n".join(map(marked, lines)) for lines in _folds(text)]

        def write(labels: Labels) -> None:
            found = [(said, text_size(said)) for said in variants]
            tried = [(*labels.best(size, proposed(size)), said, size) for said, size in found]
            (x, y), cost, said, size = next((t for t in tried if t[1] <= FREE), min(tried, key=lambda t: t[1]))
            labels.take((x, y), size)
            self.crowded += max(cost - FREE, 0.0)
            if leader and np.hypot(x - leader[0], y - leader[1]) > FAR + size[0] / 2:
                self.axes.plot([leader[0], x], [leader[1], y], **THIN_LINE)
            halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8}
            self.axes.text(x, y, said, ha="center", va="center", zorder=7, bbox=halo)

        self.texts.append(write)

    def _scale_bar(self) -> None:
        """A bar of a round length below the drawing, at the left."""
        factor = unit(self.unit).factor
        scale = self.scale.round
        target = 30 * MM / scale / factor
        power = 10.0 ** np.floor(np.log10(target))
        length = max(step * power for step in (1, 2, 5) if step * power <= target)
        left, bottom = min(box[0] for box in self.boxes), min(box[1] for box in self.boxes) - 16
        right, middle = left + length * factor * scale, left + 0.5 * length * factor * scale
        self.axes.fill([left, middle, middle, left], [bottom, bottom, bottom + 3, bottom + 3], color=INK, linewidth=0)
        self.axes.plot(
            [left, right, right, left, left], [bottom, bottom, bottom + 3, bottom + 3, bottom], color=INK, linewidth=0.5
        )
        text = joined(
            number(significant(length, 1) if length < 1 else f"{length:.0f}", self.words["decimal"]), pretty(self.unit)
        )
        self.axes.text(right + 5, bottom + 1.5, text, va="center", ha="left", size=8)
        self.axes.text(left, bottom + 6, "0", va="bottom", ha="center", size=0.1, alpha=0)
        self.boxes.append((left, bottom - 3, right + 5 + text_size(text, 8)[0], bottom + 8))


def _folds(text: str) -> list[list[str]]:
    """A text whole, and in ever narrower lines."""
    wide = text_size(marked(text))[0]
    found = [[text]]
    for share in (0.62, 0.4):
        lines = folded(text, share * wide)
        if wide > LONG and len(lines) > len(found[-1]):
            found.append(lines)
    return found
