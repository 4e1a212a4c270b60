"""The drive line drawn to scale from its record: a front view of axes and wheels, and the shafts side by side along their axes.

Each shaft, part and join is drawn once in a view, in the tone of its governing check, hatched where nothing rates it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import partial
from typing import Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from diecut_report.report.chapters.drive_line import LOW, MIDDLE, TONES, DriveLineFigure, Key
from diecut_report.report.figures import labels
from diecut_report.report.figures.drawing import DASH_DOT, bounds, circular, cut_to, hatching, scale_bar, strokes
from diecut_report.report.figures.style import (  # fmt: skip
    INK,
    MM,
    SOFT,
    Box,
    Labels,
    SizesSize,
    Svg,
    canvas,
    plain,
    sampled,
    text_size,
)
from diecut_report.report.text import displayed, joined
from diecut_report.results.model import JoinRecord, MachineShaftRecord, PlacedPartRecord

Array = NDArray[Any]
Loops = Sequence[Array]
FILLS = dict(zip(TONES, ("#e6f0f7", "#a6c8e0", "#e39b2d", "#a3161a"), strict=True))
"""From light to dark, so that a print without colours tells them too; blue, orange and dark red are told apart by every eye."""
CENTRE_LINE: dict[str, Any] = {"color": SOFT, "linewidth": 0.45, "linestyle": DASH_DOT}
HATCH = 3.2  # points between strokes
SMALL = 6.8  # points of the letters of parts
WIDTH = 172 * MM
ORDER, STROKES, EDGE = 1e-3, 1e-4, 2e-4  # from part to part, and what lies over its area
LEGEND_ROW, PATCH = 12.0, 14.0  # points
_round = partial(circular, fewest=8, in_radian=14)  # as close as a sketch needs


class ViewSheet:
    """A view in work, in points: what is drawn, what texts keep clear of, and what all of it takes."""

    def __init__(self, figure: DriveLineFigure) -> None:
        self.figure, self.words = figure, figure.words
        self.places = {key: index for index, key in enumerate(figure.looks)}
        self.boxes: list[Box] = []
        self.lines: list[Array] = []
        self.sheet = canvas(10, 10)
        self.axes = self.sheet.add_axes((0, 0, 1, 1))
        self.axes.set_axis_off()

    def part(self, key: Key, loops: Loops, zorder: float) -> None:
        """Draw a part: its area in its tone, strokes over it where nothing rates it, and its outline, which leads to its calculation."""
        look = self.figure.looks[key]
        closed = [np.vstack([loop, loop[:1]]) for loop in loops]
        outline = Path.make_compound_path(*(Path(loop, closed=True) for loop in closed))
        face = FILLS.get(look.tone, "#ffffff")
        self.axes.add_artist(PathPatch(outline, facecolor=face, edgecolor="none", linewidth=0, zorder=zorder))
        if look.state in ("not_rated", "accepted"):
            lines = hatching(closed, HATCH, falling=look.state == "accepted")
            self._stroke(strokes(*lines), color=INK, linewidth=0.35, zorder=zorder + STROKES)
        # an artist, not a patch of the axes, whose limits are set at last
        drawn = {"facecolor": "none", "edgecolor": INK, "linewidth": 0.55, "zorder": zorder + EDGE}
        self.axes.add_artist(PathPatch(outline, url=self._address(key), **drawn))
        self.lines += closed
        self.boxes += [(*loop.min(axis=0), *loop.max(axis=0)) for loop in loops]

    def band(self, key: Key, points: Array, zorder: float) -> None:
        """Draw a belt or a chain as a band in its tone between dark edges; one that nothing rates in pieces."""
        look = self.figure.looks[key]
        is_rated = look.state == "rated"
        self._stroke(points, color=INK, linewidth=3.0, zorder=zorder, solid_capstyle="butt")
        dashes = {} if is_rated else {"linestyle": (0, (2.2, 1.6)), "dash_capstyle": "butt"}
        face = {"color": FILLS.get(look.tone, "#ffffff"), "linewidth": 1.9}
        self._stroke(points, url=self._address(key), zorder=zorder + EDGE, **face, **dashes)
        self.lines.append(points)
        self.boxes.append((*points.min(axis=0), *points.max(axis=0)))

    def _address(self, key: Key) -> str:
        return f"part-{self.places[key]}"

    def line(self, points: Iterable[Any], **look: Any) -> None:
        """Draw a thin line that no part is."""
        self._stroke(np.asarray([*points]), **CENTRE_LINE | look)

    def _stroke(self, points: Array, **look: Any) -> None:
        self.axes.add_artist(Line2D(*points.T, **look))

    def write(self, x: float, y: float, text: str, size: float, ha: str = "left") -> None:
        """Write a text at its left end, middle or right end."""
        wide, high = text_size(plain(text), size)
        left = x - {"left": 0.0, "center": 0.5, "right": 1.0}[ha] * wide
        halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.2}
        self.axes.text(x, y, plain(text), size=size, ha=ha, va="center_baseline", zorder=8, bbox=halo)
        self.boxes.append((left, y - high / 2, left + wide, y + high / 2))

    def finish(self, scale: float) -> Figure:
        """Draw the legend with a bar of the scale below all, and cut the sheet to what is on it."""
        left, bottom, right, _ = bounds(self.boxes)
        self._legend(left, bottom - 14, max(right - left, 0.6 * WIDTH), scale)
        cut_to(self.axes, bounds(self.boxes), 3)
        return self.sheet

    def _legend(self, left: float, top: float, width: float, scale: float) -> None:
        bar = scale_bar(self.axes, (left, top - 1.5), scale, "mm", self.words)
        self.boxes.append(bar)
        x, y = bar[2] + 14, top
        low, middle = (joined(displayed(share, "%", self.words["decimal"]), "%") for share in (LOW, MIDDLE))
        states = {look.state for look in self.figure.looks.values()}
        entries = [(f"tone_{tone}", tone) for tone in TONES] + [("part_not_rated", "")]
        entries += [(f"part_{state}", "") for state in ("accepted", "none") if state in states]
        for name, tone in entries:
            text = self.words.say(name, low=low, middle=middle)
            step = PATCH + 4 + text_size(plain(text), 7.5)[0] + 10
            if x + step - 10 > left + width:
                x, y = left, y - LEGEND_ROW
            self._sample(x, y, name, tone)
            self.write(x + PATCH + 4, y, text, 7.5)
            x += step

    def _sample(self, x: float, y: float, name: str, tone: str) -> None:
        box = np.array([[x, y - 3.5], [x + PATCH, y - 3.5], [x + PATCH, y + 3.5], [x, y + 3.5], [x, y - 3.5]])
        self.axes.fill(*box.T, facecolor=FILLS.get(tone, "#ffffff"), edgecolor=INK, linewidth=0.55)
        if name in ("part_not_rated", "part_accepted"):
            lines = hatching([box], HATCH, falling=name == "part_accepted")
            self._stroke(strokes(*lines), color=INK, linewidth=0.35, zorder=3)


# The front view.


RIM = 7.0  # points that the rim of a wheel is drawn wide
FRONT = {SizesSize.LARGE: 112 * MM, SizesSize.LOW: 92 * MM, SizesSize.SKETCH: 80 * MM}  # height
WHEELS = ("gear", "pulley", "sprocket", "clutch", "coupling", "brake", "flywheel", "cam")
ARMS = ("crank", "rocker")
JOINED = {"mesh": "gear", "chain": "sprocket", "belt": "pulley"}
SLOT = 0.16  # width of a Geneva wheel's slots in its radius
SMALLEST = 0.05  # m: no drawing is made larger than for that
ARM = 3.4  # half of the width of a crank, points
NEARER = 0.75  # as far to its own axis as to any other a name stands at most
FAR = 14.0  # points from its axis to a name, beyond which a line leads there


def view(figure: DriveLineFigure, _curves: Any, _words: Any, size: SizesSize) -> Figure:
    """Draw a view of the drive line."""
    made = _Front(figure, FRONT[size]) if figure.type == "front_view" else _Side(figure, SIDE[size])
    return made.drawn()


class _Front:
    """The axes where the frame has them, with what stands on them and joins them."""

    def __init__(self, figure: DriveLineFigure, height: float) -> None:
        self.sheet = ViewSheet(figure)
        self.shafts = [each for each in figure.line.shafts if each.axis]
        self.joins = figure.line.joins
        placed = np.array([each.axis for each in self.shafts])
        reach = np.array([[max([_shaft_radius(each), *(part.radius for part in each.parts)])] for each in self.shafts])
        corners = np.concatenate([placed - reach, placed + reach])
        self.places = dict(zip((each.name for each in self.shafts), placed - corners.min(axis=0), strict=True))
        self.axes = {part.name: self.places[each.name] for each in self.shafts for part in each.parts}
        drawn = (*WHEELS, *ARMS, "geneva_wheel")
        self.parts: dict[Key, PlacedPartRecord] = {
            (part.kind, part.name): part for each in self.shafts for part in each.parts if part.kind in drawn
        }
        extent = np.maximum(np.ptp(corners, axis=0), SMALLEST)
        self.scale = float(min(WIDTH / extent[0], height / extent[1]))

    def drawn(self) -> Figure:
        wheels = [each for each in self.parts.values() if each.radius and each.kind not in ARMS]
        for order, each in enumerate(sorted(wheels, key=lambda one: -one.radius)):  # the greatest behind all others
            self.sheet.part((each.kind, each.name), self._wheel(each), 1 + ORDER * order)
        for join in self.joins:
            if join.kind != "mesh" and (points := self._around(join)) is not None:
                self.sheet.band((join.kind, join.name), points, 3)
        for shaft in self.shafts:
            self._on_axis(shaft)
        self._names()
        return self.sheet.finish(self.scale)

    def _center(self, part: PlacedPartRecord) -> Array:
        center: Array = self.axes[part.name] * self.scale
        return center

    def _direction(self, part: PlacedPartRecord) -> float:
        """Where the axis lies with which a part works: of its mesh, or of the other ports of its mechanism; upwards where there is none."""
        met = [name for join in self.joins for name in (*join.drivers, *join.driven) if part.name in (*join.drivers, *join.driven)]  # fmt: skip
        home = part.of.partition(".")[0]
        met += [each.name for each in self.parts.values() if home and each.of.startswith(f"{home}.")]
        own = self.axes[part.name]
        other = next((self.axes[name] for name in met if name in self.axes and (self.axes[name] != own).any()), None)
        return float(np.arctan2(*(other - own)[::-1])) if other is not None else np.pi / 2

    def _wheel(self, part: PlacedPartRecord) -> Loops:
        center, radius = self._center(part), part.radius * self.scale
        if part.slots:
            return [center + radius * self._slotted(part)]
        inner = max(radius - RIM, 0.0)
        if part.toothed < 1:
            half, middle = np.pi * part.toothed, self._direction(part)
            arc = _round(middle - half, middle + half)
            for edge in (arc[0], arc[-1]):
                self.sheet.line([center, center + inner * edge], zorder=0.8)
            return [center + np.vstack([radius * arc, inner * arc[::-1]])]
        loops = [center + radius * _round(0, 2 * np.pi)]
        return [*loops, center + inner * _round(2 * np.pi, 0)] if inner else loops

    def _slotted(self, part: PlacedPartRecord) -> Array:
        """The outline of a Geneva wheel of radius 1, one of its slots towards the crank, as deep as the roller comes."""
        home, first = part.of.partition(".")[0], self._direction(part)
        crank = next((each for each in self.parts.values() if each.kind == "crank" and home and each.of.startswith(f"{home}.")), None)  # fmt: skip
        end = 0.35
        if crank is not None:
            away = float(np.hypot(*(self.axes[crank.name] - self.axes[part.name]))) - crank.radius
            end = float(np.clip(away / part.radius, 0.15, 0.9))
        half, step = np.arcsin(SLOT / 2), 2 * np.pi / part.slots
        pieces: list[Any] = []
        for index in range(part.slots):
            along = np.array([np.cos(first + index * step), np.sin(first + index * step)])
            aside = np.array([-along[1], along[0]]) * SLOT / 2
            pieces += [[end * along - aside], [end * along + aside]]
            pieces.append(_round(first + index * step + half, first + (index + 1) * step - half))
        return np.vstack(pieces[1:] + pieces[:1])

    def _around(self, join: JoinRecord) -> Array | None:
        """The way of a belt or a chain about its wheels; of one that runs over a mechanism's own wheels its ends, along the frame's x."""
        kind = JOINED[join.kind]
        if any((kind, name) not in self.parts for name in (join.drivers[0], *join.driven[:1])):
            return None
        one = self.parts[kind, join.drivers[0]]
        center, radius = self._center(one), one.radius * self.scale
        if not join.driven:
            far = np.array([[2.5 * radius, 0.0]])
            half = _round(np.pi / 2, 1.5 * np.pi) * radius
            way: Array = center + np.vstack([half[:1] + far, half, half[-1:] + far])
            return way
        other = self.parts[kind, join.driven[0]]
        return _loop(center, radius, self._center(other), other.radius * self.scale)

    def _on_axis(self, shaft: MachineShaftRecord) -> None:
        """The cross of an axis, the arms that turn about it, and the shaft."""
        center = self.places[shaft.name] * self.scale
        for part in shaft.parts:
            if part.kind in ARMS and part.radius:
                self._arm(part, shaft)
        own = max(_shaft_radius(shaft) * self.scale, 2.2)
        self.sheet.part(("shaft", shaft.name), [center + own * _round(0, 2 * np.pi)], 6)
        for way in (np.array([1.0, 0.0]), np.array([0.0, 1.0])):
            self.sheet.line([center - (own + 4) * way, center + (own + 4) * way], zorder=5.9)

    def _arm(self, part: PlacedPartRecord, shaft: MachineShaftRecord) -> None:
        center, radius, angle = self._center(part), part.radius * self.scale, self._direction(part)
        self.sheet.line(center + radius * _round(0, 2 * np.pi), zorder=2)
        near, far = _round(angle + np.pi / 2, angle + 1.5 * np.pi), _round(angle - np.pi / 2, angle + np.pi / 2)
        tip = center + radius * np.array([np.cos(angle), np.sin(angle)])
        self.sheet.part((part.kind, part.name), [np.vstack([center + ARM * near, tip + ARM * far])], 5)
        for pin in (each for each in shaft.parts if each.kind == "pin" and each.name == f"{part.name}.pin"):
            own = max(pin.seat / 2 * self.scale, 2.0)
            self.sheet.part((pin.kind, pin.name), [tip + own * _round(0, 2 * np.pi)], 6)

    def _names(self) -> None:
        """Each shaft's name beside its axis, where it covers least."""
        free = Labels(np.concatenate([sampled(line) for line in self.sheet.lines]))
        for shaft in self.shafts:
            x, y = self.places[shaft.name] * self.scale
            free.take((x, y), (11.0, 11.0))
        for shaft in self.shafts:
            (x, y), size = map(float, self.places[shaft.name] * self.scale), text_size(plain(shaft.name), 8.0)
            at = free.place(size, self._beside(shaft, size))
            if np.hypot(at[0] - x, at[1] - y) > FAR + size[0] / 2:
                self.sheet.line([(x, y), at], linestyle="-", zorder=7)
            self.sheet.write(*at, shaft.name, 8.0, "center")

    def _beside(self, shaft: MachineShaftRecord, size: tuple[float, float]) -> list[tuple[float, float]]:
        """The places for a shaft's name that are clearly nearer to its axis than to any other."""
        own = self.places[shaft.name] * self.scale
        others = [place * self.scale for name, place in self.places.items() if (self.places[shaft.name] != place).any()]

        def is_near(place: tuple[float, float]) -> bool:
            return all(np.hypot(*(place - own)) < NEARER * np.hypot(*(place - other)) for other in others)

        every = [*labels.near(float(own[0]), float(own[1]), size)]
        return [place for place in every if is_near(place)] or every


def _shaft_radius(shaft: MachineShaftRecord) -> float:
    return max((each.diameter / 2 for each in shaft.sections), default=0.0)


def _loop(one: Array, own: float, other: Array, far: float) -> Array:
    """The outline of a belt about two circles."""
    between = other - one
    away = float(np.hypot(*between))
    if away <= abs(own - far):  # one within the other: no belt goes about both
        return one + max(own, far) * _round(0, 2 * np.pi)
    along, lean = float(np.arctan2(*between[::-1])), float(np.arccos((own - far) / away))
    near = _round(along + lean, along + 2 * np.pi - lean)
    beyond = _round(along - lean, along + lean)
    return np.vstack([one + own * near, other + far * beyond, one + own * near[:1]])


# The shafts side by side.


SIDE = {SizesSize.LARGE: 150 * MM, SizesSize.LOW: 126 * MM, SizesSize.SKETCH: 112 * MM}  # height
NAMES = 30 * MM  # room for the names at the left
GAP = 16.0  # points between two rows, for the names of the parts
HUB = 0.8  # radius of a hub in diameters of its shaft
KEY = 0.1  # by which a key reaches into the shaft and out of it, in diameters
BROKEN = 1.25  # in the greatest radius of bearings and hubs: what is farther off is broken off
SERIFS = 2.2  # points of the teeth of a broken edge
LEAST = 4.0  # points that a part is drawn wide whose length is not known


class _Side:
    """The shafts below each other, each where it stands along the axes, with its parts."""

    def __init__(self, figure: DriveLineFigure, height: float) -> None:
        self.sheet, self.line = ViewSheet(figure), figure.line
        rows = [_ShaftRow(each) for each in self.line.shafts]
        ends = np.array([row.ends for row in rows])
        across = max(float(np.ptp(ends)), SMALLEST)
        high = max(sum(row.above + row.below for row in rows), 1e-9)
        self.scale = min((WIDTH - NAMES) / across, (height - GAP * len(rows)) / high)
        self.left = float(ends.min())
        self.rows: dict[str, tuple[_ShaftRow, float]] = {}
        y = 0.0
        for row in rows:
            y -= row.above * self.scale
            self.rows[row.shaft.name] = row, y
            y -= row.below * self.scale + GAP

    def drawn(self) -> Figure:
        for join in self.line.joins:
            self._plane(join)
        for row, y in self.rows.values():
            self._row(row, y)
        return self.sheet.finish(self.scale)

    def _at(self, row: _ShaftRow, points: Any, y: float) -> Array:
        """Points of a shaft, m from its left end and its axis, on the sheet."""
        placed: Array = (
            np.asarray(points, dtype=float) + np.array([row.left - self.left, 0.0])
        ) * self.scale + np.array([0.0, y])
        return placed

    def _plane(self, join: JoinRecord) -> None:
        """The plane in which two parts work together, from row to row."""
        for one, other in zip(join.drivers, join.driven, strict=False):
            near, opposite = (self._found(JOINED[join.kind], name) for name in (one, other))
            if near is None or opposite is None:
                continue
            (row, part, y), (far, _, end) = near, opposite
            x = self._at(row, [(part.start + part.end) / 2, 0.0], y)[0]
            upper, lower = sorted(((y, row), (end, far)), key=lambda each: -each[0])
            top, foot = upper[0] - upper[1].below * self.scale, lower[0] + lower[1].above * self.scale
            self.sheet.line([(x, top), (x, foot)], zorder=0.5)

    def _found(self, kind: str, name: str) -> tuple[_ShaftRow, PlacedPartRecord, float] | None:
        shown = ((row, part, y) for row, y in self.rows.values() for part in row.shaft.parts)
        return next((each for each in shown if (each[1].kind, each[1].name) == (kind, name)), None)

    def _row(self, row: _ShaftRow, y: float) -> None:
        low, high = row.ends
        self.sheet.line(self._at(row, [(low - row.left - 0.01, 0), (high - row.left + 0.01, 0)], y), zorder=4)
        shaft = ("shaft", row.shaft.name)
        self.sheet.part(shaft, [self._at(row, row.outline(LEAST / self.scale), y)], 1)
        for order, part in enumerate(row.shaft.parts):
            loops = [self._at(row, loop, y) for loop in row.loops(part, LEAST / self.scale, SERIFS / self.scale)]
            above = {"key": 3.0, "pin": 2.8, "pin_bearing": 2.9, "bearing": 2.6}.get(part.kind, 2.0)
            self.sheet.part((part.kind, part.name), loops, above + ORDER * order)
            if part.kind in ("bearing", "pin_bearing"):
                self._cross(loops)
        self._names(row, y)

    def _cross(self, loops: Loops) -> None:
        """The cross of a rolling bearing in each half (ISO 8826)."""
        for loop in loops:
            (left, foot), (right, top) = loop.min(axis=0), loop.max(axis=0)
            for ends in ([(left, foot), (right, top)], [(left, top), (right, foot)]):
                self.sheet.line(ends, color=INK, linewidth=0.4, linestyle="-", zorder=3.4)

    def _names(self, row: _ShaftRow, y: float) -> None:
        looks = self.sheet.figure.looks
        own = [(row.shaft.name, looks["shaft", row.shaft.name])]
        own += [(part.name.partition(".")[2], looks[part.kind, part.name]) for part in row.shaft.parts]
        name, worst = max(own, key=lambda each: each[1].ratio)
        side = -NAMES + 4
        self.sheet.write(side, y + (5 if worst.used else 0), _short(row.shaft.name, NAMES - 8, 8.0), 8.0)
        if worst.used:
            told = "" if name == row.shaft.name else f"{name} "
            self.sheet.write(side, y - 5.5, _short(told, NAMES - 8 - text_size(worst.used, SMALL)[0], SMALL) + worst.used, SMALL)  # fmt: skip
        reached = [-np.inf, -np.inf]  # on two lines below the row
        for part in sorted(row.shaft.parts, key=lambda each: each.start + each.end):
            if part.kind in ("bearing", "key", "pin", "pin_bearing"):
                continue
            text = _short(part.name.partition(".")[2], 22 * MM, SMALL)
            x = float(self._at(row, [(part.start + part.end) / 2, 0.0], y)[0])
            wide = text_size(plain(text), SMALL)[0]
            level = next((k for k in (0, 1) if x - wide / 2 > reached[k] + 2), 0)
            x = max(x, reached[level] + 2 + wide / 2)
            reached[level] = x + wide / 2
            self.sheet.write(x, y - row.below * self.scale - 4.5 - 7.6 * level, text, SMALL, "center")


class _ShaftRow:
    """A shaft as a row of the side view: how far it reaches along the axes, above and below its own axis, m."""

    def __init__(self, shaft: MachineShaftRecord) -> None:
        self.shaft, self.left = shaft, shaft.left or 0.0
        rings = [part.outside / 2 for part in shaft.parts if part.kind == "bearing"]
        hubs = [HUB * part.seat for part in shaft.parts if part.kind not in ("key", "pin", "pin_bearing")]
        self.broken = BROKEN * max([*rings, *hubs, _shaft_radius(shaft)]) or 0.03
        reach = [min(part.radius, self.broken) for part in shaft.parts if part.kind not in ("pin", "pin_bearing")]
        self.below = max([*rings, *hubs, *reach, _shaft_radius(shaft)])
        pins = [part for part in shaft.parts if part.kind in ("pin", "pin_bearing")]
        self.clear = self.broken + max([max(part.outside, part.seat) / 2 for part in pins], default=0.0)
        self.above = max([self.below, *(self.pin(part) + max(part.outside, part.seat) / 2 for part in pins)])

    @property
    def ends(self) -> tuple[float, float]:
        """From where to where it reaches along the axes."""
        own = [(each.start, each.end) for each in self.shaft.sections]
        own += [(each.start, each.end) for each in self.shaft.parts]
        own = own or [(0.0, 0.0)]
        return self.left + min(start for start, _ in own), self.left + max(end for _, end in own)

    def pin(self, part: PlacedPartRecord) -> float:
        """How far off the axis a pin is drawn: where it is, or as near as its arm is broken off."""
        return min(part.radius, self.clear)

    def outline(self, least: float) -> Array:
        """The outline of the shaft; of one without sections a piece as thick as a line."""
        pieces = [(each.start, each.end, each.diameter / 2) for each in self.shaft.sections]
        if not pieces:
            low, high = (end - self.left for end in self.ends)
            pieces = [(min(low, high - 4 * least), high + least, least / 2)]
        top = [(x, radius) for start, end, radius in pieces for x in (start, end)]
        return np.array([*top, *((x, -radius) for x, radius in reversed(top))])

    def loops(self, part: PlacedPartRecord, least: float, teeth: float) -> list[Array]:
        """The outlines of a part, above and below the shaft."""
        start, end = part.start, part.end
        if part.kind == "key":
            return [_box(start, end, (0.5 - KEY) * part.seat, (0.5 + KEY) * part.seat)]
        if part.kind == "pin":
            return [_box(start, end, self.pin(part) - part.seat / 2, self.pin(part) + part.seat / 2)]
        if part.kind in ("bearing", "pin_bearing"):
            middle = self.pin(part) if part.kind == "pin_bearing" else 0.0
            inner, outer = part.seat / 2, (part.outside or 1.8 * part.seat) / 2
            return [_box(start, end, middle + side * inner, middle + side * outer) for side in (1, -1)]
        return self._body(part, least, teeth)

    def _body(self, part: PlacedPartRecord, least: float, teeth: float) -> list[Array]:
        """A hub with the wheel, disc or arm on it; an arm reaches to one side alone."""
        middle, inner = (part.start + part.end) / 2, part.seat / 2
        wide = max(part.width or part.end - part.start, least) / 2
        hub = HUB * part.seat if part.end > part.start else 0.0
        found = []
        for side in (1, -1):
            is_far = part.radius > self.broken and (side == 1 or part.kind not in ARMS)
            reach = part.radius if side == 1 or part.kind not in ARMS else 0.0
            outer = min(reach, self.broken) or hub
            own = min(hub, outer) if part.radius and part.kind not in ARMS else hub
            ends = (middle - wide, outer), (middle + wide, outer)
            top = _torn(*ends, teeth) if is_far else [*ends]
            shoulder = [(part.start, inner), (part.start, own), (middle - wide, own)] if own > inner else [(middle - wide, inner)]  # fmt: skip
            back = [(middle + wide, own), (part.end, own), (part.end, inner)] if own > inner else [(middle + wide, inner)]  # fmt: skip
            found.append(np.array([*shoulder, *top, *back]) * [1, side])
        return found


def _box(left: float, right: float, foot: float, top: float) -> Array:
    return np.array([(left, foot), (right, foot), (right, top), (left, top)])


def _torn(start: tuple[float, float], end: tuple[float, float], teeth: float) -> list[tuple[float, float]]:
    """An edge as it is drawn where a part is broken off."""
    count = 2 * max(1, round((end[0] - start[0]) / teeth / 3))
    inner = [(start[0] + k / count * (end[0] - start[0]), start[1] - teeth * (k % 2)) for k in range(1, count)]
    return [start, *inner, end]


def _short(text: str, width: float, size: float) -> str:
    """A text cut so that it has room."""
    if not text or text_size(plain(text), size)[0] <= width:
        return text
    kept = next((n for n in range(len(text) - 1, 0, -1) if text_size(plain(text[:n] + "…"), size)[0] <= width), 1)
    return text[:kept] + "…"


# What the drawing holds for a reader at a screen: where a part leads, and what is said of it.


_PART = re.compile(r'<a xlink:href="part-(\d+)"[^>]*>(.*?)</a>', re.DOTALL)


def linked(svg: Svg, figure: DriveLineFigure) -> Svg:
    """Return a drawing whose parts lead to their calculations, each with what is said of it."""
    looks = [*figure.looks.items()]

    def placed(found: re.Match[str]) -> str:
        (kind, _), look = looks[int(found[1])]
        look_of = ' class="band"' if kind in ("belt", "chain") else ""
        inner = f"<title>{escape(look.text)}</title>{found[2]}"
        # the table below has the same links for a keyboard
        opened, closed = (f'a href={quoteattr(look.link)} tabindex="-1"', "a") if look.link else ("g", "g")
        return f"<{opened}{look_of}>{inner}</{closed}>"

    text = _PART.sub(placed, svg.text).replace('role="img"', 'role="group" class="drive-line"', 1)
    return svg._replace(text=text)
