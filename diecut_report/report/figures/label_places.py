"""Places that are proposed for the texts of figures, the best liked first (all in points)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
