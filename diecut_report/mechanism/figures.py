"""Figures are data: a plot names curves, a drawing holds shapes in metres. The report draws them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanism.names import here, placed
from diecut_report.quantities.formatting import si

Point = tuple[float, float]
Shape = dict[str, Any]
Range = tuple[str | float | None, str | float | None]


class View(Protocol):
    """Give a drawing what it may ask of the calculated machine."""

    def __getitem__(self, name: str) -> float:
        """A number by its id, SI."""

    def __contains__(self, name: str) -> bool:
        """Whether there is a number of this id."""

    def get(self, name: str, default: float) -> float:
        """Return a number by its id, or the default where there is none."""

    def at(self, curve: str, place: float) -> float:
        """Return a curve's value at a place of its abscissa, SI."""

    def text(self, name: str) -> str:
        """Return a quantity as it is printed: ``h = 40 mm``."""

    def word(self, name: str) -> str:
        """Return a text by its id: an input, or what a choice gave."""

    def row(self, name: str) -> list[float]:
        """Return the values of all repeated parts, SI."""

    def words(self, name: str) -> list[str]:
        """Return a text input of all repeated parts."""

    def curve(self, name: str) -> list[float]:
        """Return a curve (or an abscissa) at the samples of the results, SI."""

    def prepared(self, name: str) -> Any:
        """Return what plain code prepared, by its id."""

    def varied(self, inputs: Mapping[str, Any], *names: str) -> dict[str, Array]:
        """Return numbers of the machine calculated again with other inputs (SI; arrays of one length give arrays of it).

        Only what they need is calculated. NaN where the machine is then impossible.
        """

    def varied_curves(
        self, inputs: Mapping[str, Any], *names: str, points: int = 361
    ) -> tuple[Array, dict[str, Array]]:
        """Return the abscissa and the values, over the whole abscissa, of curves of the machine calculated again with other inputs."""

    def once(self, make: Callable[[Any], Any]) -> Any:
        """Return what a function of the view makes, made once for all places of what moves: an outline that only turns."""


@dataclass(frozen=True, eq=False)
class Series:
    """Declare one curve in a plot."""

    curve: str
    label: str


@dataclass(frozen=True, eq=False)
class Level:
    """Declare a horizontal line at a quantity's value."""

    value: str
    label: str


@dataclass(frozen=True, eq=False)
class Mark:
    """Declare a marked point: ids of its place and its value. Of the greatest size of a curve (``abs_max``) it stands on the curve."""

    x: str
    y: str
    label: str


@dataclass(frozen=True, eq=False)
class Span:
    """Declare a marked range of the abscissa between two quantities."""

    start: str
    end: str
    label: str


@dataclass(frozen=True, eq=False)
class Panel:
    """Declare one diagram of a plot: curves of one unit over the abscissa.

    ``range`` is that of its axis, (0, None): ids or numbers in the panel's unit, None for an end that follows from the curves.
    Without it zero is always shown.
    """

    title: str
    unit: str
    series: tuple[Series, ...]
    levels: tuple[Level, ...] = ()
    marks: tuple[Mark, ...] = ()
    spans: tuple[Span, ...] = ()
    range: Range | None = None


@dataclass(frozen=True, eq=False)
class Figure:
    """Declare what all figures have; ``needs`` names the optional inputs without which it is left out."""

    id: str
    title: str
    caption: str
    needs: tuple[str, ...] = field(default=(), kw_only=True)
    at: str = field(default_factory=here, kw_only=True, repr=False, compare=False)


@dataclass(frozen=True, eq=False)
class Plot(Figure):
    """Declare diagrams one below the other over a common abscissa."""

    abscissa: str
    panels: tuple[Panel, ...]


@dataclass(frozen=True, eq=False)
class Polar(Figure):
    """Declare curves over an angle, as distance from the pole; negative values are drawn with another line.

    ``range`` is that of the distance, as in a ``Panel``; without it the pole is zero.
    """

    abscissa: str
    unit: str
    series: tuple[Series, ...]
    range: Range | None = None


@dataclass(frozen=True, eq=False)
class Bars(Figure):
    """Declare bars in groups: each group has its own unit, each bar the id of a quantity."""

    groups: tuple[BarGroup, ...]


@dataclass(frozen=True, eq=False)
class BarGroup:
    """Declare bars of one unit; a bar is a label and the id of its quantity, subtracted ones with ``-ID``.

    ``range`` is that of the bars' axis, as in a ``Panel``; without it zero is always shown.
    """

    label: str
    unit: str
    bars: tuple[tuple[str, str], ...]
    range: Range | None = None


@dataclass(frozen=True)
class Driven:
    """Hold a mechanism whose drawing moves with another's: where the abscissa of that one is at its zero, and how far it goes in its period (SI)."""

    mechanism: str
    offset: float
    period: float


@dataclass(frozen=True, eq=False)
class Drawing(Figure):
    """Declare a drawing to scale: ``build`` gives its shapes from the calculated machine, in metres.

    ``scaled_by`` names the optional input without which the shapes have relative lengths (``unit`` is then a pure number).
    A ``schematic`` one is not to scale: its coordinates only say what stands beside what.
    ``moving`` gives polylines, circles, points and what is ``rigid`` at a place of the curves' abscissa ``over``, always the same ones
    in the same order: on a screen they move with the cursor of the curves. Labels may stand among them; a shape
    with ``"during": [start, end]`` is filled while the cursor is between these places. A machine without that abscissa has the drawing alone.
    ``drives`` gives the mechanisms that move with it: on a screen their drawings stand below it on one sheet.
    """

    build: Callable[[View], list[Shape]]
    unit: str = "mm"
    scaled_by: str = ""
    schematic: bool = False
    moving: Callable[[View, float], list[Shape]] | None = None
    over: str = ""
    drives: Callable[[View], Sequence[Driven]] | None = None


@dataclass(frozen=True, eq=False)
class Chart(Figure):
    """Declare diagrams of lines that are not curves of the results: ``build`` gives its panels (``chart_panel``) from the machine.

    A machine of which it gives none has no such figure.
    """

    build: Callable[[View], list[Shape]]


@dataclass(frozen=True)
class Grip:
    """Hold the number that a shape stands for: its key, by how much it grows where the shape is dragged a metre to the right, its value (SI)."""

    input: str
    per_metre: float
    value: float


def polyline(
    points: Sequence[Point], role: str = "outline", *, closed: bool = False, grip: Grip | None = None
) -> Shape:
    """Return straight lines from point to point.

    ``grip`` tells of what moves which number they stand for, where dragging them on the live page changes it.
    """
    shape = {"shape": "polyline", "points": [list(p) for p in points], "closed": closed, "role": role}
    return shape | ({"grip": grip} if grip else {})


def region(outer: Sequence[Point], holes: Sequence[Sequence[Point]] = (), role: str = "section") -> Shape:
    """Return a cut area, hatched."""
    return {
        "shape": "region",
        "outer": [list(p) for p in outer],
        "holes": [[list(p) for p in h] for h in holes],
        "role": role,
    }


def circle(center: Point, radius: float, role: str = "outline") -> Shape:
    """Return a full circle."""
    return {"shape": "circle", "center": list(center), "radius": radius, "role": role}


def arc(center: Point, radius: float, start: float, end: float, role: str = "outline") -> Shape:
    """Return an arc, counter-clockwise from ``start`` to ``end`` (rad)."""
    return {"shape": "arc", "center": list(center), "radius": radius, "start": start, "end": end, "role": role}


def dimension(start: Point, end: Point, offset: float, text: str) -> Shape:
    """Return a dimension line between two points, set off to the left of the direction start → end by ``offset`` (m)."""
    return {"shape": "dimension", "from": list(start), "to": list(end), "offset": offset, "text": text}


def radius_dimension(center: Point, radius: float, angle: float, text: str) -> Shape:
    """Return a radius with its text, drawn at an angle (rad)."""
    return {"shape": "radius_dimension", "center": list(center), "radius": radius, "angle": angle, "text": text}


def label(at: Point, text: str, anchor: str = "left") -> Shape:
    """Return a text in the drawing."""
    return {"shape": "label", "at": list(at), "text": text, "anchor": anchor}


def arrow(start: Point, end: Point, role: str = "mark", text: str = "") -> Shape:
    """Return a force or a direction."""
    return {"shape": "arrow", "from": list(start), "to": list(end), "role": role} | ({"label": text} if text else {})


def box(center: Point, width: float, height: float, lines: Sequence[str], role: str = "outline") -> Shape:
    """Return a box of a schematic with its lines of text."""
    return {
        "shape": "box",
        "center": list(center),
        "width": width,
        "height": height,
        "role": role,
        "lines": list(lines),
    }


def point(at: Point, role: str = "mark", text: str = "") -> Shape:
    """Return a marked point or pivot."""
    return {"shape": "point", "at": list(at), "role": role} | ({"label": text} if text else {})


def rigid(shapes: Sequence[Shape], at: Point = (0.0, 0.0), turned: float = 0.0) -> Shape:
    """Return polylines, circles and points that move as one: they are turned (rad, counter-clockwise), then shifted by ``at``."""
    return {"shape": "rigid", "shapes": list(shapes), "at": list(at), "turned": turned}


# The data of charts: lines, areas and marks over an abscissa of any kind, all in SI.


Data = dict[str, Any]
Values = Sequence[float] | Array


def chart_panel(
    title: str,
    unit: str,
    x_title: str,
    x_symbol: str,
    x_unit: str,
    *,
    lines: Sequence[Data],
    fills: Sequence[Data] = (),
    marks: Sequence[Data] = (),
    levels: Sequence[Data] = (),
    verticals: Sequence[Data] = (),
    range: tuple[float | None, float | None] | None = None,
    over: str = "",
) -> Data:
    """Return one diagram of a chart; ``unit`` and ``x_unit`` are display units, ``title`` says what stands upwards.

    ``range`` is that of the upright axis, (0, None), in ``unit``; None for an end that follows from the lines. ``over`` names
    the abscissa of the machine's curves whose places these are, or whole turns off: on a screen they share its cursor.
    """
    limits: Data = {"range": [None if end is None else si(end, unit) for end in range]} if range else {}
    limits |= {"over": over} if over else {}
    return {"title": title, "unit": unit, "x": {"title": x_title, "symbol": x_symbol, "unit": x_unit},
            "lines": list(lines), "fills": list(fills), "marks": list(marks), "levels": list(levels),
            "verticals": list(verticals), **limits}  # fmt: skip


def line(x: Values, y: Values, label: str) -> Data:
    """Return a line; it is broken where a value is NaN."""
    return {"x": _plain(x), "y": _plain(y), "label": label}


def fill(x: Values, y: Values, label: str) -> Data:
    """Return the area between a line and zero."""
    return line(x, y, label)


def mark(x: float, y: float, label: str) -> Data:
    """Return a marked point."""
    return {"x": float(x), "y": float(y), "label": label}


def level(y: float, label: str) -> Data:
    """Return a horizontal line."""
    return {"value": float(y), "label": label}


def vertical(x: float, label: str) -> Data:
    """Return a vertical line."""
    return {"x": float(x), "label": label}


def _plain(values: Values) -> list[float | None]:
    """Numbers as results hold them, null where there is none."""
    numbers = np.asarray(values, dtype=float)
    plain = numbers.astype(object)
    plain[~np.isfinite(numbers)] = None
    return list(plain)


# Curves over a range of their own, the same for every machine: what the results hold beside the machine's own curves.


@dataclass(frozen=True, kw_only=True, eq=False)
class SpectrumLine:
    """Declare one curve of a spectrum: ``values`` (SI) at those of the spectrum."""

    id: str
    symbol: str
    description: str
    values: Array
    unit: str = "1"
    source: str = ""
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Spectrum(SpectrumLine):
    """Declare what ``lines`` run over: its ``values`` ascend. ``lines`` is called when a machine's results are made."""

    lines: Callable[[], Sequence[SpectrumLine]]
