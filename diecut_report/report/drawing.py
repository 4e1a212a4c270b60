"""Drawings to scale from shapes in metres: outlines, hatched sections, dimensions, texts clear of the lines."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from diecut_report.report.figures import ACCENT, INK, MM, SOFT, Box, Labels, canvas, marked, sampled, text_size
from diecut_report.report.i18n import Words
from diecut_report.report.numbers import joined, number, significant
from diecut_report.units import pretty, unit

Array = NDArray[Any]
Shape = Mapping[str, Any]
LARGEST = (150 * MM, 104 * MM)  # of the shapes, in points
DASHED, DASH_DOT = (0, (5, 2.5)), (0, (12, 2, 2, 2))
ROLES: dict[str, dict[str, Any]] = {
    "outline": {"color": INK, "linewidth": 1.1},
    "section": {"color": INK, "linewidth": 1.2},
    "hidden": {"color": INK, "linewidth": 0.7, "linestyle": DASHED},
    "centerline": {"color": SOFT, "linewidth": 0.5, "linestyle": DASH_DOT, "zorder": 1.5},
    "ground": {"color": INK, "linewidth": 1.0},
    "link": {"color": ACCENT, "linewidth": 2.4, "solid_capstyle": "round", "zorder": 3},
    "ghost": {"color": "#93a0ac", "linewidth": 0.8, "zorder": 1.6},
    "mark": {"color": ACCENT, "linewidth": 1.2, "zorder": 4},
    "body": {"color": INK, "linewidth": 0.9},
}
THIN_LINE: dict[str, Any] = {"color": INK, "linewidth": 0.45, "zorder": 2.5}
HATCH_STEP, ARROW, SLENDER = 5.0, 7.0, 0.17
THICK, THIN = 8.0, 2.0
FAR = 12.0  # a point's name no nearer than this gets a leader


def drawing(figure: Mapping[str, Any], _curves: Mapping[str, Any], words: Words) -> Figure:
    """The shapes of a drawing, as large as the page lets them be, with a scale bar."""
    return Sheet(figure, words).drawn()


class Sheet:
    """A drawing in work: shapes in points, what texts must keep clear of, and the box that all of it needs."""

    def __init__(self, figure: Mapping[str, Any], words: Words) -> None:
        self.shapes: list[Shape] = figure["shapes"]
        self.unit: str = figure["unit"]
        self.words = words
        corners = np.concatenate([_extent(shape) for shape in self.shapes])
        low, high = corners.min(axis=0), corners.max(axis=0)
        self.scale = float(np.min(np.array(LARGEST) / np.maximum(high - low, 1e-12)))  # points a metre
        self.lines: list[tuple[Array, float]] = []  # with how much texts are to keep clear of them
        self.boxes: list[Box] = [(*(low * self.scale), *(high * self.scale))]
        self.texts: list[Callable[[Labels], None]] = []
        self.sheet = canvas(10, 10)
        self.axes: Axes = self.sheet.add_axes((0, 0, 1, 1))
        self.axes.set_axis_off()

    def drawn(self) -> Figure:
        """All shapes first, then the texts between them; at last the sheet is cut to what is on it."""
        for shape in self.shapes:
            getattr(self, f"_{shape['shape']}")(shape)
        lines = [(sampled(line), weight) for line, weight in self.lines]
        weights = np.concatenate([np.full(len(line), weight) for line, weight in lines])
        labels = Labels(np.concatenate([line for line, _ in lines]), weights=weights)
        for write in self.texts:
            write(labels)
        self.boxes += labels.taken
        self._scale_bar()
        left, bottom, right, top = (pick(box[i] for box in self.boxes) for i, pick in enumerate((min, min, max, max)))
        left, bottom, right, top = left - 4, bottom - 4, right + 4, top + 4
        self.axes.set_xlim(left, right)
        self.axes.set_ylim(bottom, top)
        self.sheet.set_size_inches((right - left) / 72, (top - bottom) / 72)
        return self.sheet

    def _points(self, coordinates: Any) -> Array:
        return np.asarray(coordinates, dtype=float).reshape(-1, 2) * self.scale

    def _line(self, points: Array, **look: Any) -> None:
        self.axes.plot(points[:, 0], points[:, 1], **look)
        self.lines.append((points, THIN if look["linewidth"] < 0.6 else THICK))

    # shapes
    def _polyline(self, shape: Shape) -> None:
        points = self._points(shape["points"])
        if shape["closed"]:
            points = np.vstack([points, points[:1]])
        if shape["role"] == "body":
            self.axes.fill(points[:, 0], points[:, 1], color="#f1f4f6", linewidth=0, zorder=1)
        self._line(points, **ROLES[shape["role"]])
        if shape["role"] == "ground":
            self._ground(points)

    def _ground(self, points: Array) -> None:
        """Short strokes below a line that stands still."""
        feet = sampled(points, 6.0)[1:-1]
        self._strokes(feet, feet - 4.5, THIN_LINE)

    def _strokes(self, starts: Array, ends: Array, look: dict[str, Any]) -> None:
        """Many short lines as one path."""
        points = np.stack([starts, ends, np.full_like(starts, np.nan)], axis=1).reshape(-1, 2)
        self.axes.plot(points[:, 0], points[:, 1], **look)

    def _circle(self, shape: Shape) -> None:
        self._arc({**shape, "start": 0.0, "end": 2 * np.pi})

    def _arc(self, shape: Shape) -> None:
        self._line(self._points(_round(shape, shape["start"], shape["end"])), **ROLES[shape["role"]])

    def _region(self, shape: Shape) -> None:
        loops = [self._points(loop) for loop in (shape["outer"], *shape["holes"])]
        loops = [np.vstack([loop, loop[:1]]) for loop in loops]
        outline = Path.make_compound_path(*(Path(loop, closed=True) for loop in loops))
        self.axes.add_patch(PathPatch(outline, facecolor="none", edgecolor=INK, linewidth=1.2, zorder=2.2))
        self._strokes(*hatching(loops), {"color": SOFT, "linewidth": 0.35, "zorder": 1.2})
        self.lines += [(loop, THICK) for loop in loops]

    def _point(self, shape: Shape) -> None:
        x, y = self._points(shape["at"])[0]
        if shape["role"] == "mark":
            self.axes.plot([x], [y], "o", markersize=6, markerfacecolor="white", markeredgecolor=ACCENT, zorder=4)
            self.axes.plot([x], [y], "+", markersize=9, markeredgecolor=ACCENT, markeredgewidth=0.9, zorder=5)
        else:
            self.axes.plot([x], [y], "o", markersize=6.5 if shape["role"] == "pivot" else 4.5, markerfacecolor="white",
                           markeredgecolor=INK, markeredgewidth=1.0, zorder=5)  # fmt: skip
            if shape["role"] == "pivot":
                self.axes.plot([x], [y], "o", markersize=1.8, color=INK, zorder=6)
        self.lines.append((np.array([[x - 4, y], [x + 4, y], [x, y - 4], [x, y + 4]]), THICK))
        self.boxes.append((x - 5, y - 5, x + 5, y + 5))
        if shape.get("label"):
            size = text_size(marked(shape["label"]))
            self._later(shape["label"], lambda: _near(x, y, size), leader=(x, y))

    def _label(self, shape: Shape) -> None:
        x, y = self._points(shape["at"])[0]
        width, height = text_size(marked(shape["text"]))
        aside = {"left": width / 2, "center": 0.0, "right": -width / 2}[shape["anchor"]]
        self._later(shape["text"], lambda: ((x + aside, y + k * 0.5 * height) for k in (0, 1, -1, 2, -2, 3, -3, 5, -5)))

    def _radius_dimension(self, shape: Shape) -> None:
        center, angle = self._points(shape["center"])[0], shape["angle"]
        along = np.array([np.cos(angle), np.sin(angle)])
        radius = shape["radius"] * self.scale
        tip = center + radius * along
        width, height = text_size(marked(shape["text"]))
        self._line(np.array([center, tip]), **THIN_LINE)
        self._arrow(tip, along)
        self._later(shape["text"], lambda: _along(center, along, radius, width, height))

    def _dimension(self, shape: Shape) -> None:
        start, end = self._points(shape["from"])[0], self._points(shape["to"])[0]
        reach = float(np.hypot(*(end - start)))
        along = (end - start) / reach
        aside = np.array([-along[1], along[0]]) * np.sign(shape["offset"])
        away = abs(shape["offset"]) * self.scale
        one, two = start + away * aside, end + away * aside
        for foot, top in ((start, one), (end, two)):
            self.axes.plot(*zip(foot + 2.0 * aside, top + 3.0 * aside, strict=True), **THIN_LINE)
            self.lines.append((np.array([foot + 2.0 * aside, top + 3.0 * aside]), THIN))
        inside = reach > 3 * ARROW
        over = np.zeros(2) if inside else 2 * ARROW * along
        self._line(np.array([one - over, two + over]), **THIN_LINE)
        self._arrow(one, -along if inside else along)
        self._arrow(two, along if inside else -along)
        size = text_size(marked(shape["text"]))
        self._later(shape["text"], lambda: _by_line(one - over, two + over, along, aside, size))

    def _arrow(self, tip: Array, along: Array) -> None:
        across = np.array([-along[1], along[0]]) * ARROW * SLENDER
        self.axes.fill(
            *np.array([tip, tip - ARROW * along + across, tip - ARROW * along - across]).T,
            color=INK,
            linewidth=0,
            zorder=2.6,
        )

    # texts
    def _later(
        self, text: str, places: Callable[[], Iterator[tuple[float, float]]], leader: tuple[float, float] | None = None
    ) -> None:
        said = marked(text)

        def write(labels: Labels) -> None:
            size = text_size(said)
            x, y = labels.place(size, places())
            if leader and np.hypot(x - leader[0], y - leader[1]) > FAR + size[0] / 2:
                self.axes.plot([leader[0], x], [leader[1], y], **THIN_LINE)
            halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8}
            self.axes.text(x, y, said, ha="center", va="center", zorder=7, bbox=halo)

        self.texts.append(write)

    def _scale_bar(self) -> None:
        """A bar of a round length below the drawing, at the left."""
        factor = unit(self.unit).factor
        target = 30 * MM / self.scale / factor
        power = 10.0 ** np.floor(np.log10(target))
        length = max(step * power for step in (1, 2, 5) if step * power <= target)
        left, bottom = min(box[0] for box in self.boxes), min(box[1] for box in self.boxes) - 16
        right, middle = left + length * factor * self.scale, left + 0.5 * length * factor * self.scale
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


def _round(shape: Shape, start: float, end: float) -> Array:
    angles = np.linspace(start, end, max(16, int(abs(end - start) * 40)))
    points: Array = np.asarray(shape["center"]) + shape["radius"] * np.column_stack([np.cos(angles), np.sin(angles)])
    return points


def _extent(shape: Shape) -> Array:
    """Points that bound a shape, in metres (texts are measured later)."""
    match shape:
        case {"shape": "polyline", "points": points} | {"shape": "region", "outer": points}:
            return np.asarray(points, dtype=float).reshape(-1, 2)
        case {"shape": "circle"}:
            return _round(shape, 0, 2 * np.pi)
        case {"shape": "arc", "start": start, "end": end}:
            return _round(shape, start, end)
        case {"shape": "radius_dimension", "angle": angle}:
            return _round(shape, angle, angle)
        case {"shape": "dimension", "from": start, "to": end, "offset": offset}:
            one, two = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
            along = (two - one) / np.hypot(*(two - one))
            line: Array = np.array([one, two]) + offset * np.array([-along[1], along[0]])
            return line
    return np.asarray(shape["at"], dtype=float).reshape(-1, 2)


def hatching(loops: list[Array], step: float = HATCH_STEP) -> tuple[Array, Array]:
    """Starts and ends of strokes at 45° inside closed loops (even-odd), ``step`` apart."""
    along, across = np.array([1.0, 1.0]) / np.sqrt(2), np.array([-1.0, 1.0]) / np.sqrt(2)
    starts = np.concatenate([loop[:-1] for loop in loops])
    ends = np.concatenate([loop[1:] for loop in loops])
    height_a, height_b = starts @ across, ends @ across
    places: list[Array] = []
    for level in np.arange(np.floor(height_a.min() / step) + 0.5, height_a.max() / step) * step:
        cut = (height_a <= level) != (height_b <= level)
        share = (level - height_a[cut]) / (height_b[cut] - height_a[cut])
        reach = np.sort((starts[cut] + share[:, None] * (ends[cut] - starts[cut])) @ along)
        places.append(level * across + reach[:, None] * along)
    points = np.concatenate(places)
    return points[::2], points[1::2]


def _near(x: float, y: float, size: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Places around a point, the right-hand upper one first."""
    for away in (5.0, 10.0, 17.0, 26.0, 36.0, 48.0):
        for h, v in ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1)):
            yield x + h * (min(away, 5.0) + size[0] / 2), y + v * (away + size[1] / 2)


def _along(center: Array, along: Array, radius: float, width: float, height: float) -> Iterator[tuple[float, float]]:
    """Places beside a radius, then beyond its end."""
    across = np.array([-along[1], along[0]])
    clear = 0.5 * (abs(across[0]) * width + abs(across[1]) * height) + 4.0
    for share in (0.6, 0.5, 0.7, 0.4, 0.8):
        for side in (1, -1):
            yield tuple(center + share * radius * along + side * clear * across)
    beyond = radius + 0.5 * (abs(along[0]) * width + abs(along[1]) * height) + 5
    yield tuple(center + beyond * along)


def _by_line(
    one: Array, two: Array, along: Array, aside: Array, size: tuple[float, float]
) -> Iterator[tuple[float, float]]:
    """Places for a dimension's text: above its line, below it, beyond its ends."""
    width, height = size
    clear = 0.5 * (abs(aside[0]) * width + abs(aside[1]) * height) + 4.0
    beyond = 0.5 * (abs(along[0]) * width + abs(along[1]) * height) + 3
    for share in (0.5, 0.35, 0.65, 0.22, 0.78):
        at = one + share * (two - one)
        yield from (tuple(at + clear * aside), tuple(at - clear * aside))
    yield from (tuple(two + beyond * along), tuple(one - beyond * along))
    for away in (6.0, 14.0):
        yield tuple((one + two) / 2 + (clear + away) * aside)
