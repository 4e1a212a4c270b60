"""Drawings from shapes in metres: outlines, hatched sections, dimensions, arrows, boxes, texts clear of the lines."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path
from numpy.typing import NDArray

from diecut_report.report.figures import label_places
from diecut_report.report.figures.drawing_scale import LARGEST, filled
from diecut_report.report.figures.drawing_sheet import ARROW, THICK, THIN, THIN_LINE, DrawingSheet
from diecut_report.report.figures.shapes import beyond, circular, hatching
from diecut_report.report.figures.sizes import Size
from diecut_report.report.figures.style import ACCENT, INK, LINE, SOFT, marked, sampled, text_size
from diecut_report.report.i18n import Catalogue

Array = NDArray[Any]
Shape = Mapping[str, Any]
BODY = "#f1f4f6"
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
    "shade": {"color": BODY, "linewidth": 0.0, "zorder": 1.0},
}
HEAD, STOUT = 5.5, 0.28  # of arrows, and what its strokes add to the head
SHARES = {  # of the largest, at which a drawing is tried, so that its texts find places
    Size.LARGE: (1.0, 0.87, 0.75, 0.64, 0.5),
    Size.LOW: (0.66, 0.58, 0.75, 0.87, 0.5),
    Size.HALF: (0.52, 0.46, 0.58),
    Size.SKETCH: (0.36, 0.3, 0.42, 0.5),
}
MANY_TEXTS = 20
SCHEMES = (0.6, 0.5)  # of sketches whose boxes hold texts
WORTH = 25.0  # what stands in the way of texts, for which the drawing is rather made a step smaller


def drawing(figure: Mapping[str, Any], _curves: Mapping[str, Any], words: Catalogue, size: Size = Size.LARGE) -> Figure:
    """The shapes of a drawing, as large as their place on the page lets them be, with a scale bar unless it is a schematic."""
    best, least = None, np.inf
    for step, share in enumerate(_shares(figure, size)):
        sheet = Shapes(figure, words, LARGEST * share)
        sheet.finish()
        cost = sheet.crowded + step * WORTH
        if cost < least:
            best, least = sheet.sheet, cost
        if sheet.crowded <= WORTH:
            break
    assert best is not None
    return best


def _shares(figure: Mapping[str, Any], size: Size) -> tuple[float, ...]:
    """How large a drawing is tried: one with many texts is not made lower, nor is a scheme's sketch so small as others."""
    if size is Size.SKETCH and figure.get("schematic"):
        return SCHEMES
    texts = sum(bool(shape.get("text") or shape.get("label")) for shape in figure["shapes"])
    return SHARES[Size.LARGE if size is Size.LOW and texts > MANY_TEXTS else size]


def _look(shape: Shape) -> dict[str, Any]:
    """The look of a shape's role; ValueError where there is no such role."""
    if shape["role"] not in ROLES:
        raise ValueError(f"{shape['role']!r} is not a role of a {shape['shape']}; known: {', '.join(ROLES)}")
    return ROLES[shape["role"]]


class Shapes(DrawingSheet):
    """A sheet with a way to draw each kind of shape."""

    def draw(self, shape: Shape) -> None:
        """Draw a shape; ValueError where nothing is known of its kind."""
        way = getattr(self, f"_{shape['shape']}", None)
        if way is None:
            raise ValueError(f"{shape['shape']!r} is not a shape that can be drawn")
        way(shape)

    def _polyline(self, shape: Shape) -> None:
        points = self._points(shape["points"])
        if shape["closed"]:
            points = np.vstack([points, points[:1]])
        if shape["role"] in ("body", "shade"):
            self.axes.fill(points[:, 0], points[:, 1], color=BODY, linewidth=0, zorder=1)
        if shape["role"] != "shade":
            self._line(points, **_look(shape))
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
        if shape["role"] == "body":
            self.axes.fill(*self._bow(shape, 0.0, 2 * np.pi).T, color=BODY, linewidth=0, zorder=1)
        self._arc({**shape, "start": 0.0, "end": 2 * np.pi})

    def _bow(self, shape: Shape, start: float, end: float) -> Array:
        radius = shape["radius"] * self.scale.round
        points: Array = self._points(shape["center"])[0] + radius * circular(start, end)
        return points

    def _arc(self, shape: Shape) -> None:
        self._line(self._bow(shape, shape["start"], shape["end"]), **_look(shape))

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
            self._later(shape["label"], lambda size: label_places.near(x, y, size), leader=(x, y))

    def _label(self, shape: Shape) -> None:
        x, y = self._points(shape["at"])[0]
        size = text_size(marked(shape["text"]))
        middle, _ = next(label_places.at(x, y, size, shape["anchor"]))
        self.wished.append((middle - size[0] / 2, middle + size[0] / 2))
        self._later(shape["text"], lambda size: label_places.at(x, y, size, shape["anchor"]))

    def _arrow(self, shape: Shape) -> None:
        """A straight arrow from box to box; its head has its size on paper, and is smaller only on a shorter arrow."""
        tail, tip = self._outside(self._points(shape["from"])[0], self._points(shape["to"])[0])
        look, length = _look(shape), float(np.hypot(*(tip - tail)))
        if length == 0:
            self._point({"at": shape["from"], "role": "joint", "label": shape.get("label")})
            return
        along, head = (tip - tail) / length, min(HEAD + 2.2 * look["linewidth"], length)
        self._line(np.array([tail, tip - 0.8 * head * along]), **look | {"solid_capstyle": "butt"})
        self._head(tip, along, head, STOUT, look["color"], look.get("zorder", 2.6))
        self.lines.append((np.array([tip - head * along, tip]), THICK))
        self.boxes.append((*(tip - 3), *(tip + 3)))
        if shape.get("label"):
            self._later(
                shape["label"], lambda size: label_places.by_arrow(tail, tip, size), leader=tuple((tail + tip) / 2)
            )

    def _outside(self, tail: Array, tip: Array) -> tuple[Array, Array]:
        """An arrow without what lies in the boxes of its ends."""
        for shape in self.shapes:
            if shape["shape"] == "box":
                center, half = self._points(shape["center"])[0], filled(shape, self.scale)[1] / 2
                tail, tip = beyond(tail, tip, center, half), beyond(tip, tail, center, half)
        return tail, tip

    def _box(self, shape: Shape) -> None:
        """A box with lines of text."""
        center, (lines, size) = self._points(shape["center"])[0], filled(shape, self.scale)
        look = {"edgecolor" if key == "color" else key: value for key, value in _look(shape).items()}
        face = BODY if shape["role"] == "body" else "white"
        self.axes.add_patch(Rectangle(center - size / 2, *size, facecolor=face, **look | {"zorder": 4.2}))
        for index, line in enumerate(lines):
            y = center[1] + self.scale.text * LINE * ((len(lines) - 1) / 2 - index)
            self.axes.text(
                center[0], y, marked(line), size=self.scale.text, ha="center", va="center_baseline", zorder=7
            )
        self.solid.append((*(center - size / 2 - 1.5), *(center + size / 2 + 1.5)))
        self.boxes.append(self.solid[-1])

    def _radius_dimension(self, shape: Shape) -> None:
        center, angle = self._points(shape["center"])[0], shape["angle"]
        along = np.array([np.cos(angle), np.sin(angle)])
        radius = shape["radius"] * self.scale.round
        tip = center + radius * along
        self._line(np.array([center, tip]), **THIN_LINE)
        self._head(tip, along)
        self._later(shape["text"], lambda size: label_places.along_radius(center, along, radius, size))

    def _dimension(self, shape: Shape) -> None:
        start, end = self._points(shape["from"])[0], self._points(shape["to"])[0]
        reach = float(np.hypot(*(end - start)))
        along = (end - start) / reach
        aside = np.array([-along[1], along[0]]) * np.sign(shape["offset"])
        away = abs(shape["offset"]) * self.scale.round
        one, two = start + away * aside, end + away * aside
        for foot, top in ((start, one), (end, two)):
            self.axes.plot(*zip(foot + 2.0 * aside, top + 3.0 * aside, strict=True), **THIN_LINE)
            self.lines.append((np.array([foot + 2.0 * aside, top + 3.0 * aside]), THIN))
        inside = reach > 3 * ARROW
        over = np.zeros(2) if inside else 2 * ARROW * along
        self._line(np.array([one - over, two + over]), **THIN_LINE)
        self._head(one, -along if inside else along)
        self._head(two, along if inside else -along)
        self._later(shape["text"], lambda size: label_places.by_line(one - over, two + over, aside, size))
