"""Geometry of a belt around pulleys: the tangent polygon with its arcs (angles in rad, lengths in m).

The belt runs round a closed loop counter-clockwise and meets the pulleys in their order. A pulley inside the loop
(side +1) lies on the left of the belt, one outside (side -1) on the right; the side times the radius is the signed radius.
Each quantity is a row over the pulleys; what belongs to a straight run stands at the pulley that the run leaves.
Radii are to the belt's pitch line.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import arccos, number, pi
from diecut_report.formulas.formula import formula

TOUCHING = 1e-9  # share of the layout's size below which pulleys and runs touch only


@formula
def signed(side: Any, size: Any) -> Any:
    """A radius or wrap, negative outside the loop."""
    return side * size


@formula
def center_distance(x: Any, y: Any, next_x: Any, next_y: Any) -> Any:
    """Distance of the centres of two pulleys."""
    return np.sqrt((next_x - x) ** 2 + (next_y - y) ** 2)


@formula
def has_tangent(center_distance: Any, radius: Any, next_radius: Any) -> Any:
    """Whether two pulleys have the common tangent on which the belt runs (signed radii)."""
    return center_distance > abs(next_radius - radius) * (number(1) + 1e-9)


@formula
def run_length(center_distance: Any, radius: Any, next_radius: Any) -> Any:
    """Length of the straight run between two pulleys (signed radii)."""
    return np.sqrt(center_distance**2 - (next_radius - radius) ** 2)


@formula
def run_direction(x: Any, y: Any, next_x: Any, next_y: Any, center_distance: Any, radius: Any, next_radius: Any) -> Any:
    """Direction in which the belt runs from one pulley to the next (signed radii)."""
    return np.arctan2(next_y - y, next_x - x) - np.arcsin((next_radius - radius) / center_distance)


@formula
def wrap(side: Any, direction_before: Any, direction: Any) -> Any:
    """Wrap of a pulley: the turn from the run before it to the run behind it, around the pulley, without full turns.

    1e-9 of a turn below nothing is rounding, no full turn.
    """
    turn = side * (direction - direction_before)
    return turn - 2 * pi * np.floor(turn / (2 * pi) + 1e-9)


@formula
def turns(sum_of_wraps: Any) -> Any:
    """Turns of the belt's direction along its path, from the wraps, those outside counted negative: 1 where it is a loop."""
    return np.round(sum_of_wraps / (2 * pi))


@formula
def open_belt_length(center_distance: Any, small: Any, large: Any) -> Any:
    """Length of an open belt over two pulleys: runs, half turns, and the angle of the runs to the line of centres."""
    runs = 2 * np.sqrt(center_distance**2 - (large - small) ** 2)
    return runs + pi * (large + small) + 2 * (large - small) * np.arcsin((large - small) / center_distance)


@formula
def wrap_small(center_distance: Any, small: Any, large: Any) -> Any:
    """Wrap of the small pulley of an open belt."""
    return 2 * arccos((large - small) / center_distance)


@formula
def wrap_large(wrap_small: Any) -> Any:
    """Wrap of the large pulley of an open belt."""
    return 2 * pi - wrap_small


class Path(NamedTuple):
    """A belt's path, rows of shape (…, pulleys): lengths and directions of the runs, where they leave a pulley
    (``leave_x``) and meet the next (``meet_x``), and the wraps (not negative). NaN where a tangent does not exist."""

    runs: Array
    directions: Array
    leave_x: Array
    leave_y: Array
    meet_x: Array
    meet_y: Array
    wraps: Array


def path(x: Any, y: Any, radius: Any) -> Path:
    """The path of a belt over pulleys at x, y with signed radii, rows of shape (…, pulleys)."""
    x, y, radius = (np.asarray(row, dtype=float) for row in (x, y, radius))
    behind = tuple(np.roll(row, -1, axis=-1) for row in (x, y, radius))
    with np.errstate(all="ignore"):
        distance = center_distance(x, y, *behind[:2])
        directions = run_direction(x, y, *behind[:2], distance, radius, behind[2])
        wraps = wrap(np.sign(radius), np.roll(directions, 1, axis=-1), directions)
        runs = run_length(distance, radius, behind[2])
    along, across = np.cos(directions), np.sin(directions)
    leave = x + radius * across, y - radius * along
    meet = behind[0] + behind[2] * across, behind[1] - behind[2] * along
    return Path(runs, directions, *leave, *meet, wraps)


def length(belt: Path, radius: Any) -> Array:
    """Length of the belt, shape (…)."""
    total: Array = np.sum(belt.runs + np.abs(radius) * belt.wraps, axis=-1)
    return total


def is_loop(x: Any, y: Any, radius: Any) -> Array:
    """Whether the belt turns once, counter-clockwise, shape (…)."""
    found: Array = turns(np.sum(np.sign(radius) * path(x, y, radius).wraps, axis=-1)) == 1
    return found


def overlapping(x: Array, y: Array, radius: Array) -> Array:
    """For each pulley the index of one that it overlaps, -1 for none; neighbours without a tangent are left out.

    All rows here and below are of shape (variants, pulleys).
    """
    apart = np.hypot(_pairs(x), _pairs(y))
    sum_of_radii = np.abs(radius)[:, :, None] + np.abs(radius)[:, None, :]
    clash = apart < sum_of_radii * (1 - TOUCHING)
    without = ~has_tangent(apart, radius[:, None, :], radius[:, :, None])
    places = np.arange(x.shape[1])
    steps = (places[:, None] - places) % x.shape[1]
    is_neighbour = (steps == 1) | (steps == x.shape[1] - 1)
    return _first(clash & ~(is_neighbour & without) & (steps != 0))


def crossing(x: Array, y: Array, radius: Array) -> Array:
    """For each pulley the index of one whose run crosses its own run, -1 for none (and where the belt is not a loop)."""
    belt = path(x, y, radius)
    leave = belt.leave_x + 1j * belt.leave_y
    meet = belt.meet_x + 1j * belt.meet_y
    heading = np.exp(1j * belt.directions)
    beside = _beside(leave[:, None, :], leave, heading), _beside(meet[:, None, :], leave, heading)
    least = TOUCHING * _size(x, y)
    parted = (beside[0] * beside[1] < 0) & (np.minimum(np.abs(beside[0]), np.abs(beside[1])) > least)
    return _first(parted & parted.swapaxes(1, 2) & is_loop(x, y, radius)[:, None, None])


def pierced(x: Array, y: Array, radius: Array) -> Array:
    """For each pulley the index of one whose run passes through it, -1 for none (and where the belt is not a loop)."""
    belt = path(x, y, radius)
    heading = np.exp(1j * belt.directions)
    center = (x + 1j * y)[:, :, None]
    away = (center - (belt.leave_x + 1j * belt.leave_y)[:, None, :]) * np.conj(heading)[:, None, :]
    runs = belt.runs[:, None, :]
    distance = np.hypot(away.real - np.clip(away.real, 0, runs), away.imag)
    places = np.arange(x.shape[1])
    own = (places[:, None] == places) | (places[:, None] == (places + 1) % x.shape[1])
    cut = distance < np.abs(radius)[:, :, None] - TOUCHING * _size(x, y)
    return _first(cut & ~own & is_loop(x, y, radius)[:, None, None])


def is_possible(x: Array, y: Array, radius: Array) -> Array:
    """Whether a belt can run over the pulleys in their order, shape (variants,)."""
    rules = (overlapping, crossing, pierced)
    found = [(rule(x, y, radius) == -1).all(axis=1) for rule in rules]
    possible: Array = is_loop(x, y, radius) & np.logical_and.reduce(found)
    return possible


def clockwise(x: Array, y: Array, radius: Array) -> Array:
    """For the first pulley the index of the last one where the pulleys are listed clockwise, else -1.

    They are where a belt cannot run over them in their order, but can in the reversed one.
    """
    found = np.full(x.shape, -1)
    wrong = ~is_possible(x, y, radius)
    wrong[wrong] = is_possible(*(row[wrong, ::-1] for row in (x, y, radius)))
    found[wrong, 0] = x.shape[1] - 1
    return found


def _pairs(row: Array) -> Array:
    """Differences of all pairs, shape (variants, pulleys, pulleys)."""
    return row[:, :, None] - row[:, None, :]


def _beside(point: Array, start: Array, heading: Array) -> Array:
    """Distances of points from the lines of the runs, positive on the left, shape (variants, runs, points)."""
    return ((point - start[:, :, None]) * np.conj(heading)[:, :, None]).imag


def _size(x: Array, y: Array) -> Array:
    """Size of the layout, shape (variants, 1, 1)."""
    size: Array = np.maximum(np.ptp(x, axis=1), np.ptp(y, axis=1))
    return size[:, None, None]


def _first(pairs: Array) -> Array:
    """The first other one of each row of pairs, -1 where there is none."""
    return np.where(pairs.any(axis=2), pairs.argmax(axis=2), -1)
