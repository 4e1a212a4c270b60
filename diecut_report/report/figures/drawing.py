"""Drawings from shapes in metres: outlines, hatched sections, dimensions, arrows, boxes, texts clear of the lines."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import combinations, islice
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path
from numpy.typing import NDArray

from diecut_report.quantities.units import pretty, unit
from diecut_report.report.figures import labels
from diecut_report.report.figures.style import (
    ACCENT,
    FONT_SIZE,
    INK,
    LINE,
    MM,
    SOFT,
    Box,
    Labels,
    SizesSize,
    canvas,
    in_lines,
    marked,
    overlap,
    sampled,
    text_size,
)
from diecut_report.report.text import Catalogue, joined, number, significant
from diecut_report.results.figure_record import (
    ArcRecord,
    ArrowRecord,
    BoxRecord,
    CircleRecord,
    DimensionRecord,
    FigureRecord,
    LabelRecord,
    PointRecord,
    PolylineRecord,
    RadiusDimensionRecord,
    RegionRecord,
    Shape,
)

# Shapes of drawings as points: where they reach, circles and arcs, the strokes of hatched areas.


Array = NDArray[Any]
Place = tuple[float, float]
HATCH_STEP = 5.0  # points between the strokes


def extent(shape: Shape) -> Array:
    """Points that bound a shape, in metres (texts are measured later)."""
    match shape:
        case PolylineRecord(points=points) | RegionRecord(outer=points):
            return np.asarray(points, dtype=float).reshape(-1, 2)
        case CircleRecord():
            return _round(shape, 0, 2 * np.pi)
        case ArcRecord():
            return _round(shape, shape.start, shape.end)
        case RadiusDimensionRecord():
            return _round(shape, shape.angle, shape.angle)
        case DimensionRecord():
            one, two = np.asarray(shape.start), np.asarray(shape.end)
            along = (two - one) / np.hypot(*(two - one))
            line: Array = np.array([one, two]) + shape.offset * np.array([-along[1], along[0]])
            return line
        case ArrowRecord():
            return np.array([shape.start, shape.end])
        case BoxRecord(width=width, height=height):
            return np.asarray(shape.center) + 0.5 * np.array([[-width, -height], [width, height]])
    return np.array([shape.at])


Round = CircleRecord | ArcRecord | RadiusDimensionRecord


def _round(shape: Round, start: float, end: float) -> Array:
    points: Array = np.asarray(shape.center) + shape.radius * circular(start, end)
    return points


def circular(start: float, end: float, fewest: int = 16, in_radian: int = 40) -> Array:
    """Points on the unit circle from angle to angle (rad), close enough to look round."""
    angles = np.linspace(start, end, max(fewest, int(abs(end - start) * in_radian)))
    points: Array = np.column_stack([np.cos(angles), np.sin(angles)])
    return points


def beyond(start: Array, end: Array, center: Array, half: Array) -> Array:
    """The place where the way from start to end leaves a box that start lies in; start itself where it lies outside.

    The box is taken with its edge; where end lies in it too, start stays.
    """
    edge = half * (1 + 1e-9)
    if (np.abs(start - center) > edge).any() or (np.abs(end - center) <= edge).all():
        return start
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.where(way == 0, np.inf, (half * np.sign(way) - (start - center)) / way)
    left: Array = start + float(np.clip(shares.min(), 0.0, 1.0)) * way
    return left


def hatching(loops: list[Array], step: float = HATCH_STEP, *, falling: bool = False) -> tuple[Array, Array]:
    """Starts and ends of strokes at 45° inside closed loops (even-odd), ``step`` apart."""
    turn = np.array([1.0, -1.0 if falling else 1.0])
    along, across = turn / np.sqrt(2), np.array([-1.0, 1.0]) * turn / np.sqrt(2)
    starts = np.concatenate([loop[:-1] for loop in loops])
    ends = np.concatenate([loop[1:] for loop in loops])
    height_a, height_b = starts @ across, ends @ across
    places: list[Array] = [np.empty((0, 2))]
    for level in np.arange(np.floor(height_a.min() / step) + 0.5, height_a.max() / step) * step:
        cut = (height_a <= level) != (height_b <= level)
        share = (level - height_a[cut]) / (height_b[cut] - height_a[cut])
        reach = np.sort((starts[cut] + share[:, None] * (ends[cut] - starts[cut])) @ along)
        places.append(level * across + reach[:, None] * along)
    points = np.concatenate(places)
    return points[::2], points[1::2]


def strokes(starts: Array, ends: Array) -> Array:
    """Many short lines as one path."""
    return np.stack([starts, ends, np.full_like(starts, np.nan)], axis=1).reshape(-1, 2)


# How large a drawing is on paper: its scale, and the size of the text in its boxes.


PAGE = np.array([172 * MM, 222 * MM])  # what a figure may take, in points
LARGEST = np.array([130 * MM, 80 * MM])  # of the shapes, their texts come beside them
TALL = 1.2  # a tall drawing may be so many times as high as others
SIZES = (FONT_SIZE, 8.0, 7.5, 7.0, 6.5)  # of text in boxes, the least last
PAD = np.array([8.0, 6.0])  # between a box and its text, both sides together
ROW = 1.5  # sizes of the text from row to row at least
ROOMY = 2.5  # a schematic gives its boxes no more than so many times what their text needs


class Scale(NamedTuple):
    """Points a metre, across and upwards; how round things are scaled; the size of the text in boxes."""

    across: float
    upwards: float
    text: float

    @property
    def both(self) -> Array:
        return np.array([self.across, self.upwards])

    @property
    def round(self) -> float:
        """For radii, which stay round."""
        return min(self.across, self.upwards)


def scaled(shapes: Sequence[Shape], room: Array, *, schematic: bool) -> Scale:
    """As large as the room lets it be; a schematic is stretched, where it must be, until the text fits its boxes and its rows."""
    corners = np.concatenate([extent(shape) for shape in shapes])
    size = np.maximum(np.ptp(corners, axis=0), 1e-12)
    tall = float(np.clip(size[1] / size[0] / 1.1, 1.0, TALL))
    limits = room * np.array([1.0, tall]) / size
    scale = float(limits.min())
    boxes = [shape for shape in shapes if isinstance(shape, BoxRecord)]
    needs = {text: needed(boxes, text) for text in SIZES}
    if not boxes or not schematic:
        fitting = [text for text in SIZES if (needs[text] <= scale).all()]
        rows = min(row_scale(shapes), float(PAGE[1] / size[1])) if schematic else 0.0
        return Scale(scale, max(scale, rows), fitting[0] if fitting else SIZES[-1])
    scale = min(scale, ROOMY * float(needs[FONT_SIZE].max()))
    limits = np.maximum(limits * (PAGE / LARGEST) ** [1, 0], scale)
    fitting = [text for text in SIZES if (needs[text] <= limits).all()]
    text = fitting[0] if fitting else SIZES[-1]
    across, upwards = np.clip(needs[text], scale, limits)
    return Scale(float(across), float(upwards), text)


def rows_of(shapes: Sequence[Shape]) -> dict[tuple[str, float], list[float]]:
    """The heights of the labels that begin or end at one place, by their anchor and that place: what stands in rows keeps its row."""
    found: dict[tuple[str, float], list[float]] = {}
    for shape in shapes:
        if isinstance(shape, LabelRecord) and shape.anchor != "center":
            found.setdefault((shape.anchor, shape.at[0]), []).append(shape.at[1])
    return {place: heights for place, heights in found.items() if len(heights) > 1}


def row_scale(shapes: Sequence[Shape]) -> float:
    """The scale upwards at which rows stand clear of each other; 0 without rows."""
    gaps = np.concatenate([np.zeros(0), *(np.diff(np.unique(heights)) for heights in rows_of(shapes).values())])
    return float(ROW * FONT_SIZE / gaps.min()) if len(gaps) else 0.0


def needed(boxes: Sequence[BoxRecord], text: float) -> Array:
    """The scales, across and upwards, at which the text of a size fits all boxes."""
    scales = [(content(box.lines, text) + PAD) / (box.width, box.height) for box in boxes]
    found: Array = np.max(scales, axis=0) if scales else np.zeros(2)
    return found


def content(lines: Sequence[str], text: float) -> Array:
    """Width and height of the lines in a box."""
    wide = max((text_size(marked(line), text)[0] for line in lines), default=0.0)
    return np.array([wide, text * (1.08 + LINE * (len(lines) - 1)) if lines else 0.0])


def filled(box: BoxRecord, scale: Scale) -> tuple[list[str], Array]:
    """A box on paper: its lines and its size; lines that are too wide are folded, and at last it grows about its text."""
    size = np.array([box.width, box.height]) * scale.both
    lines: list[str] = [*box.lines]
    if (content(lines, scale.text) + PAD > size * (1 + 1e-9)).any():
        widest = content([part for line in lines for part in folded(line, 0.0, scale.text)], scale.text)[0]
        lines = [part for line in lines for part in folded(line, max(size[0] - PAD[0], widest), scale.text)]
    return lines, np.maximum(size, content(lines, scale.text) + PAD)


_BREAKS = (re.compile(r"(?<=[,;:]) "), re.compile(r"(?<![=<>·\d]) (?![=<>·\d])"))  # no unit is torn from its number


def folded(text: str, width: float, size: float = FONT_SIZE) -> list[str]:
    """A text in lines no wider than ``width``, as far as its parts let it: broken behind commas, else between words."""
    if text_size(marked(text), size)[0] <= width:
        return [text]
    for breaks in _BREAKS:
        parts = breaks.split(text)
        if len(parts) > 1:
            lines = in_lines(parts, lambda longer: text_size(marked(longer), size)[0] <= width)
            return [line for part in lines for line in folded(part, width, size)]
    return [text]


# A sheet to draw on: what all shapes of a drawing have in common, and the texts, which find their places at last.


THIN_LINE: dict[str, Any] = {"color": INK, "linewidth": 0.45, "zorder": 2.5}
ARROW, SLENDER = 7.0, 0.17  # the head of a dimension
THICK, THIN = 8.0, 2.0  # how much texts keep clear of lines
FAR = 12.0  # a point's name no nearer than this gets a leader
FREE = 9.0  # what may be in the way of a text
LONG = 50.0  # a text of so many points may be folded


def _folds(text: str) -> list[list[str]]:
    wide = text_size(marked(text))[0]
    found = [[text]]
    for share in (0.62, 0.4):
        lines = folded(text, share * wide)
        if wide > LONG and len(lines) > len(found[-1]):
            found.append(lines)
    return found


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
    SizesSize.LARGE: (1.0, 0.87, 0.75, 0.64, 0.5),
    SizesSize.LOW: (0.66, 0.58, 0.75, 0.87, 0.5),
    SizesSize.HALF: (0.52, 0.46, 0.58),
    SizesSize.SKETCH: (0.36, 0.3, 0.42, 0.5),
}
MANY_TEXTS = 20
SCHEMES = (0.6, 0.5)  # of sketches whose boxes hold texts
WORTH = 25.0  # what stands in the way of texts, for which the drawing is rather made a step smaller


def drawing(
    figure: FigureRecord, _curves: Mapping[str, Any], words: Catalogue, size: SizesSize = SizesSize.LARGE
) -> Figure:
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


def _shares(figure: FigureRecord, size: SizesSize) -> tuple[float, ...]:
    """How large a drawing is tried: one with many texts is not made lower, nor is a scheme's sketch so small as others."""
    if size is SizesSize.SKETCH and figure.schematic:
        return SCHEMES
    return SHARES[SizesSize.LARGE if size is SizesSize.LOW and len(figure.texts) > MANY_TEXTS else size]


def _look(shape: PolylineRecord | CircleRecord | ArcRecord | ArrowRecord | BoxRecord) -> dict[str, Any]:
    if shape.role not in ROLES:
        raise ValueError(f"{shape.role!r} is not a role of a {shape.shape}; known: {', '.join(ROLES)}")
    return ROLES[shape.role]


def scale_bar(axes: Axes, corner: Place, scale: float, unit_shown: str, words: Catalogue) -> Box:
    """Draw a bar of a round length from its lower left corner, at so many points a metre; return what it takes."""
    factor, (left, bottom) = unit(unit_shown).factor, corner
    target = 30 * MM / scale / factor
    power = 10.0 ** np.floor(np.log10(target))
    length = max(step * power for step in (1, 2, 5) if step * power <= target)
    right, middle, top = left + length * factor * scale, left + 0.5 * length * factor * scale, bottom + 3
    axes.fill([left, middle, middle, left], [bottom, bottom, top, top], color=INK, linewidth=0)
    axes.plot([left, right, right, left, left], [bottom, bottom, top, top, bottom], color=INK, linewidth=0.5)
    shown = significant(length, 1) if length < 1 else f"{length:.0f}"
    text = joined(number(shown, words["decimal"]), pretty(unit_shown))
    axes.text(right + 5, bottom + 1.5, text, va="center", ha="left", size=8)
    axes.text(left, bottom + 6, "0", va="bottom", ha="center", size=0.1, alpha=0)
    return left, bottom - 3, right + 5 + text_size(text, 8)[0], bottom + 8


def bounds(boxes: Sequence[Box]) -> Box:
    """Return the box about all boxes."""
    (left, bottom), (right, top) = np.min(boxes, axis=0)[:2], np.max(boxes, axis=0)[2:]
    return left, bottom, right, top


def cut_to(axes: Axes, box: Box, margin: float) -> Array:
    """Cut the sheet that axes fill to a box with a margin, and return its size, in points."""
    left, bottom, right, top = box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    size: Array = np.array([right - left, top - bottom])
    axes.figure.set_size_inches(*size / 72)  # type: ignore[union-attr]
    return size


class Shapes:
    """A drawing in work: shapes in points, what texts must keep clear of, and the box that all of it needs."""

    def __init__(self, figure: FigureRecord, words: Catalogue, room: Array) -> None:
        self.shapes = figure.shapes
        self.unit: str = figure.unit
        self.schematic: bool = figure.schematic
        self.words = words
        self.rows = rows_of(self.shapes) if self.schematic else {}
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
            getattr(self, f"_{shape.shape}")(shape)
        labels = self._labels()
        for write in self.texts:
            write(labels)
        self.boxes += labels.taken
        if not self.schematic and pretty(self.unit):
            left, bottom, *_ = bounds(self.boxes)
            self.boxes.append(scale_bar(self.axes, (left, bottom - 16), self.scale.round, self.unit, self.words))
        size = cut_to(self.axes, bounds(self.boxes), 4)
        self.crowded += 50 * float(np.maximum(size - PAGE, 0.0).sum())
        self.crowded += sum(overlap(one, other) for one, other in combinations(self.solid, 2))

    def _labels(self) -> Labels:
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

    def _head(
        self, tip: Array, along: Array, length: float = ARROW, slender: float = SLENDER, color: str = INK, zorder: float = 2.6,
    ) -> None:  # fmt: skip
        across = np.array([-along[1], along[0]]) * length * slender
        corners = np.array([tip, tip - length * along + across, tip - length * along - across])
        self.axes.fill(*corners.T, color=color, linewidth=0, zorder=zorder)

    def _later(
        self,
        text: str,
        proposed: Callable[[Place], Iterable[Place]],
        leader: Place | None = None,
        *,
        is_whole: bool = False,
    ) -> None:
        """A text that finds its place when all shapes are drawn, in two or three lines where it has none in one, unless it stays whole.

        Far from its ``leader`` it gets a line to it.
        """
        variants = ["\n".join(map(marked, lines)) for lines in ([[text]] if is_whole else _folds(text))]

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

    def _polyline(self, shape: PolylineRecord) -> None:
        points = self._points(shape.points)
        if shape.closed:
            points = np.vstack([points, points[:1]])
        if shape.role in ("body", "shade"):
            self.axes.fill(points[:, 0], points[:, 1], color=BODY, linewidth=0, zorder=1)
        if shape.role != "shade":
            self._line(points, **_look(shape))
        if shape.role == "ground":  # short strokes below a line that stands still
            feet = sampled(points, 6.0)[1:-1]
            self.axes.plot(*strokes(feet, feet - 4.5).T, **THIN_LINE)

    def _circle(self, shape: CircleRecord) -> None:
        bow = self._bow(shape, 0.0, 2 * np.pi)
        if shape.role == "body":
            self.axes.fill(*bow.T, color=BODY, linewidth=0, zorder=1)
        self._line(bow, **_look(shape))

    def _bow(self, shape: CircleRecord | ArcRecord, start: float, end: float) -> Array:
        radius = shape.radius * self.scale.round
        points: Array = self._points(shape.center)[0] + radius * circular(start, end)
        return points

    def _arc(self, shape: ArcRecord) -> None:
        self._line(self._bow(shape, shape.start, shape.end), **_look(shape))

    def _region(self, shape: RegionRecord) -> None:
        loops = [self._points(loop) for loop in (shape.outer, *shape.holes)]
        loops = [np.vstack([loop, loop[:1]]) for loop in loops]
        outline = Path.make_compound_path(*(Path(loop, closed=True) for loop in loops))
        self.axes.add_patch(PathPatch(outline, facecolor="none", edgecolor=INK, linewidth=1.2, zorder=2.2))
        self.axes.plot(*strokes(*hatching(loops)).T, color=SOFT, linewidth=0.35, zorder=1.2)
        self.lines += [(loop, THICK) for loop in loops]

    def _point(self, shape: PointRecord) -> None:
        x, y = self._points(shape.at)[0]
        if shape.role == "mark":
            self.axes.plot([x], [y], "o", markersize=6, markerfacecolor="white", markeredgecolor=ACCENT, zorder=4)
            self.axes.plot([x], [y], "+", markersize=9, markeredgecolor=ACCENT, markeredgewidth=0.9, zorder=5)
        else:
            self.axes.plot([x], [y], "o", markersize=6.5 if shape.role == "pivot" else 4.5, markerfacecolor="white",
                           markeredgecolor=INK, markeredgewidth=1.0, zorder=5)  # fmt: skip
            if shape.role == "pivot":
                self.axes.plot([x], [y], "o", markersize=1.8, color=INK, zorder=6)
        self.lines.append((np.array([[x - 4, y], [x + 4, y], [x, y - 4], [x, y + 4]]), THICK))
        self.boxes.append((x - 5, y - 5, x + 5, y + 5))
        if shape.text:
            self._later(shape.text, lambda size: labels.near(x, y, size), leader=(x, y))

    def _label(self, shape: LabelRecord) -> None:
        x, y = self._points(shape.at)[0]
        size = text_size(marked(shape.text))
        middle, _ = next(labels.at(x, y, size, shape.anchor))
        self.wished.append((middle - size[0] / 2, middle + size[0] / 2))
        is_row = (shape.anchor, shape.at[0]) in self.rows
        self._later(
            shape.text, lambda size: islice(labels.at(x, y, size, shape.anchor), 1 if is_row else None), is_whole=is_row
        )

    def _arrow(self, shape: ArrowRecord) -> None:
        """A straight arrow from box to box; its head has its size on paper, and is smaller only on a shorter arrow."""
        tail, tip = self._outside(self._points(shape.start)[0], self._points(shape.end)[0])
        look, length = _look(shape), float(np.hypot(*(tip - tail)))
        if length == 0:
            self._point(PointRecord(shape="point", at=shape.start, role="joint", text=shape.text))
            return
        along, head = (tip - tail) / length, min(HEAD + 2.2 * look["linewidth"], length)
        self._line(np.array([tail, tip - 0.8 * head * along]), **look | {"solid_capstyle": "butt"})
        self._head(tip, along, head, STOUT, look["color"], look.get("zorder", 2.6))
        self.lines.append((np.array([tip - head * along, tip]), THICK))
        self.boxes.append((*(tip - 3), *(tip + 3)))
        if shape.text:
            self._later(shape.text, lambda size: labels.by_arrow(tail, tip, size), leader=tuple((tail + tip) / 2))

    def _outside(self, tail: Array, tip: Array) -> tuple[Array, Array]:
        for shape in self.shapes:
            if isinstance(shape, BoxRecord):
                center, half = self._points(shape.center)[0], filled(shape, self.scale)[1] / 2
                tail, tip = beyond(tail, tip, center, half), beyond(tip, tail, center, half)
        return tail, tip

    def _box(self, shape: BoxRecord) -> None:
        center, (lines, size) = self._points(shape.center)[0], filled(shape, self.scale)
        look = {"edgecolor" if key == "color" else key: value for key, value in _look(shape).items()}
        face = BODY if shape.role == "body" else "white"
        self.axes.add_patch(Rectangle(center - size / 2, *size, facecolor=face, **look | {"zorder": 4.2}))
        for index, line in enumerate(lines):
            y = center[1] + self.scale.text * LINE * ((len(lines) - 1) / 2 - index)
            look = {"size": self.scale.text, "ha": "center", "va": "center_baseline", "zorder": 7}
            self.axes.text(center[0], y, marked(line), **look)
        self.solid.append((*(center - size / 2 - 1.5), *(center + size / 2 + 1.5)))
        self.boxes.append(self.solid[-1])

    def _radius_dimension(self, shape: RadiusDimensionRecord) -> None:
        center, angle = self._points(shape.center)[0], shape.angle
        along = np.array([np.cos(angle), np.sin(angle)])
        radius = shape.radius * self.scale.round
        tip = center + radius * along
        self._line(np.array([center, tip]), **THIN_LINE)
        self._head(tip, along)
        self._later(shape.text, lambda size: labels.along_radius(center, along, radius, size))

    def _dimension(self, shape: DimensionRecord) -> None:
        start, end = self._points(shape.start)[0], self._points(shape.end)[0]
        reach = float(np.hypot(*(end - start)))
        along = (end - start) / reach
        aside = np.array([-along[1], along[0]]) * np.sign(shape.offset)
        away = abs(shape.offset) * self.scale.round
        one, two = start + away * aside, end + away * aside
        for foot, top in ((start, one), (end, two)):
            self.axes.plot(*zip(foot + 2.0 * aside, top + 3.0 * aside, strict=True), **THIN_LINE)
            self.lines.append((np.array([foot + 2.0 * aside, top + 3.0 * aside]), THIN))
        inside = reach > 3 * ARROW
        over = np.zeros(2) if inside else 2 * ARROW * along
        self._line(np.array([one - over, two + over]), **THIN_LINE)
        self._head(one, -along if inside else along)
        self._head(two, along if inside else -along)
        self._later(shape.text, lambda size: labels.by_line(one - over, two + over, aside, size))
