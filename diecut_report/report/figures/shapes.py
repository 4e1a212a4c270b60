"""Shapes of drawings as points: where they reach, circles and arcs, the strokes of hatched areas."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Shape = Mapping[str, Any]
HATCH_STEP = 5.0  # points between the strokes


def extent(shape: Shape) -> Array:
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
        case {"shape": "arrow", "from": start, "to": end}:
            return np.array([start, end], dtype=float)
        case {"shape": "box", "center": center, "width": width, "height": height}:
            return np.asarray(center, dtype=float) + 0.5 * np.array([[-width, -height], [width, height]])
    return np.asarray(shape["at"], dtype=float).reshape(-1, 2)


def _round(shape: Shape, start: float, end: float) -> Array:
    points: Array = np.asarray(shape["center"], dtype=float) + shape["radius"] * circular(start, end)
    return points


def circular(start: float, end: float) -> Array:
    """Points on the unit circle from angle to angle (rad), close enough to look round."""
    angles = np.linspace(start, end, max(16, int(abs(end - start) * 40)))
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
