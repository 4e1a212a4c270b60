"""How fast the cylinder still is shortly before the ends of its travel, by plain code over one machine or many."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Curve
from diecut_report.mechanics.numerics import first

Array = NDArray[np.float64]
TURN = 2 * np.pi
PARTS, LOOKS_CLOSER = 32, 8  # of a bracket, and how often it is looked at closer
LOOKS = 181  # places of a stroke at which its speed is looked at
INNER = ("displacement", "velocity", "stroke", "dead_center_outer", "dead_center_inner")


def inner_speed(displacement: Curve, velocity: Curve, stroke: Array, outer: Array, inner: Array, way: Array) -> Array:
    """Speed at a way before the inner end."""
    return _speed_at(displacement, velocity, outer, inner, stroke - way)


def outer_speed(displacement: Curve, velocity: Curve, stroke: Array, outer: Array, inner: Array, way: Array) -> Array:
    """Speed at a way before the outer end."""
    return _speed_at(displacement, velocity, inner, outer + TURN, way)


def inner_way(displacement: Curve, velocity: Curve, stroke: Array, outer: Array, inner: Array, speed: Array) -> Array:
    """Way before the inner end from which the cylinder is slower than a speed; the stroke where it always is."""
    return _way_below(displacement, velocity, outer, inner, speed, stroke)


def outer_way(displacement: Curve, velocity: Curve, stroke: Array, outer: Array, inner: Array, speed: Array) -> Array:
    """Way before the outer end from which the cylinder is slower than a speed; the stroke where it always is."""
    return _way_below(displacement, velocity, inner, outer + TURN, speed, stroke)


def _at(curve: Curve, angle: Array) -> Array:
    share = angle / TURN % 1
    return curve.values(share, share, None)


def _first(passed: Callable[[Array], NDArray[np.bool_]], low: Array, high: Array) -> Array:
    """The angle from which a condition holds that does not hold at the low one."""
    return first(lambda angles, _: passed(angles), low[:, 0], high[:, 0], PARTS, LOOKS_CLOSER)[1][:, None]


def _speed_at(displacement: Curve, velocity: Curve, start: Array, end: Array, place: Array) -> Array:
    """Speed where a stroke comes to a place."""
    rises = _at(displacement, start) < _at(displacement, end)
    angle = _first(lambda x: (_at(displacement, x) >= place) == rises, start, end)
    return np.abs(_at(velocity, angle))


def _way_below(displacement: Curve, velocity: Curve, start: Array, end: Array, speed: Array, stroke: Array) -> Array:
    """Way to the end of a stroke from where its speed last is the given one."""
    angles = start + (end - start) * np.linspace(0, 1, LOOKS)
    fast = np.abs(_at(velocity, angles)) >= speed
    last = LOOKS - 2 - np.argmax(fast[:, -2::-1], axis=1)[:, None]
    low, high = (np.take_along_axis(angles, each, axis=1) for each in (last, last + 1))
    angle = _first(lambda x: np.abs(_at(velocity, x)) < speed, low, high)
    way = np.abs(_at(displacement, end) - _at(displacement, angle))
    return np.where(fast.any(axis=1, keepdims=True), way, stroke)
