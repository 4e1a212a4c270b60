"""The height that a rolling cylinder with a flat leaves the gripper carriages, which stand and move below it.

Lengths in metres, x along the feed from the die's middle; angles in radians, of the main shaft unless said otherwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from diecut_report.expressions import Array

EVERY = np.pi / 720  # rad of the main shaft between the places that are looked at first
ACROSS = 33  # places of a closer look
CLOSE = 1e-13  # of the period, to which the least height is searched

Motion = Callable[[Array], Array]  # of main-shaft angles (points,)


@dataclass(frozen=True)
class Station:
    """Hold the cylinder (radius, half the central angle of its flat, stroke of its axis) and the carriages on their way.

    ``with_feed`` says whether the forward stroke runs with the feed. ``carriage_stop`` is where the middle of a carriage
    stands, ``step`` the way from one to the next, ``carriage_width`` its length along the feed.
    """

    radius: float
    half_angle: float
    stroke: float
    with_feed: bool
    carriage_stop: float
    step: float
    carriage_width: float

    @property
    def direction(self) -> int:
        """Return D, +1 with the feed and −1 against it."""
        return 1 if self.with_feed else -1


def profile_height(station: Station, tilt: Array, distance: Array) -> Array:
    """Return the height Y of the cylinder's lower side at a distance ξ along the feed from its axis, abs(ξ) < R.

    The tilt τ of the flat is positive where it has turned with the feed; at τ = 0 the flat is down.
    """
    radius, flat = station.radius, station.radius * np.cos(station.half_angle)
    arc = radius - np.sqrt(np.maximum(radius**2 - distance**2, 0.0))
    cosine = np.cos(tilt)
    chord = radius - (flat + distance * np.sin(tilt)) / np.where(cosine > 0, cosine, 1.0)
    return np.where(cosine > 0, np.maximum(arc, chord), arc)


def lowest_distance(station: Station, tilt: Array) -> Array:
    """Return the distance ξ* of the lowest point from the axis: the flat's lower corner, or below the axis where that is round."""
    corner = np.sign(tilt) * station.radius * np.sin(station.half_angle - np.abs(tilt))
    return np.where(np.abs(tilt) < station.half_angle, corner, 0.0)


def carriage_clearance(station: Station, rotation: Array, displacement: Array) -> Array:
    """Return the least height over all carriages, infinite where none is below the cylinder.

    ``rotation`` is the cylinder's angle θ in [0, 2π] from the outer end, ``displacement`` the carriages' way s; both (points,).
    """
    turned = np.where(rotation <= np.pi, rotation, rotation - 2 * np.pi)
    tilt = (station.direction * turned)[:, None]
    axis = station.direction * (station.radius * rotation - station.stroke / 2)
    middle = _carriages(station, displacement, axis)
    half = station.carriage_width / 2
    nearest = np.clip(lowest_distance(station, tilt), middle - half, middle + half)
    heights = profile_height(station, tilt, nearest)
    found: Array = np.where(np.abs(nearest) < station.radius, heights, np.inf).min(axis=1)
    return found


def _carriages(station: Station, displacement: Array, axis: Array) -> Array:
    """Middles of the carriages that may be below the cylinder, from its axis, shape (points, carriages)."""
    reach = int(np.ceil((station.radius + station.carriage_width / 2) / station.step))
    first = station.carriage_stop + displacement - axis
    found: Array = (first - np.round(first / station.step) * station.step)[:, None] + station.step * np.arange(
        -reach, reach + 1
    )
    return found


@dataclass(frozen=True)
class LeastClearance:
    """Hold the least height (m; infinite where no carriage is ever below the cylinder) and the main-shaft angle where it is."""

    height: float
    angle: float


def least_clearance(station: Station, rotation: Motion, displacement: Motion, period: float) -> LeastClearance:
    """Return the least height over a period (rad), to 1e-9 of it; rotation and displacement as functions of the main-shaft angle."""

    def height(angle: Array) -> Array:
        return carriage_clearance(station, rotation(angle), displacement(angle))

    angles = np.linspace(0.0, period, 1 + round(period / EVERY))
    heights = height(angles)
    places = _lowest_places(heights)
    if len(places) == 0:
        return LeastClearance(np.inf, 0.0)
    return _closer(height, angles[places], angles[1] - angles[0], period)


def _lowest_places(heights: Array) -> Array:
    """Places that may be beside the least height: no neighbour is lower, and no other is lower by more than the steps there are."""
    padded = np.concatenate([heights[-2:-1], heights, heights[1:2]])
    low = np.isfinite(heights) & (heights <= padded[:-2]) & (heights <= padded[2:])
    if not low.any():
        return np.empty(0, dtype=int)
    steps = np.abs(np.diff(padded[np.isfinite(padded)]))
    found: Array = np.flatnonzero(low & (heights <= heights[low].min() + 2 * steps.max(initial=0.0)))
    return found


def _closer(height: Motion, angles: Array, step: float, period: float) -> LeastClearance:
    """Look closer about all places at once, until the steps are small."""
    while True:
        around = angles[:, None] + step * np.linspace(-1, 1, ACROSS)
        heights = height((around % period).ravel()).reshape(around.shape)
        best = np.argmin(heights, axis=1)
        angles, found = np.take_along_axis(around, best[:, None], 1)[:, 0], heights.min(axis=1)
        step *= 2 / (ACROSS - 1)
        if step < CLOSE * period:
            lowest = int(np.argmin(found))
            return LeastClearance(float(found[lowest]), float(angles[lowest] % period))
