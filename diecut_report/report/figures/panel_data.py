"""What one diagram of a chart holds, in the units that it shows, and where its numbers lie on the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from diecut_report.quantities.units import unit

Array = NDArray[Any]
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


class Line(NamedTuple):
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
    lines: list[Line]
    fills: list[Line] = field(default_factory=list)
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


def limits_of(drawn: Mapping[str, Any], shown: str) -> tuple[float | None, float | None] | None:
    """The range of an axis that is declared with what is drawn, in the unit that is shown; None where there is none."""
    if "range" not in drawn:
        return None
    low, high = (None if end is None else end / unit(shown).factor for end in drawn["range"])
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


def framed(panel: PanelData, width: float, height: float) -> Frame:
    """The panel's frame on paper."""
    return Frame(width, height, (panel.across.low, panel.across.high), panel.heights)
