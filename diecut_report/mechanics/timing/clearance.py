"""The height that a rolling cylinder with a flat leaves the gripper carriages, which stand and move below it.

Lengths in metres, x along the feed from the die's middle; angles in radians, of the main shaft unless said otherwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.mechanics import numerics

Number = Any  # a number, or a column of one for each machine
EVERY = np.pi / 720  # rad of the main shaft between the places that are looked at first
ACROSS = 32  # parts of a closer look
CLOSE = 1e-13  # of the period, to which the least height is searched
TOGETHER = 32  # machines that are looked at together first, as each takes many places

Heights = Callable[[Array, Array], Array]  # of main-shaft angles (rows, points) and the machine (rows,) of each row


@dataclass(frozen=True)
class Station:
    """Hold the cylinder (radius, half the central angle of its flat, stroke of its axis) and the carriages on their way.

    Numbers, or columns (machines, 1) of them. ``with_feed`` says whether the forward stroke runs with the feed.
    ``carriage_stop`` is where the middle of a carriage stands, ``step`` the way from one to the next, ``carriage_width``
    its length along the feed.
    """

    radius: Number
    half_angle: Number
    stroke: Number
    with_feed: bool
    carriage_stop: Number
    step: Number
    carriage_width: Number

    @property
    def direction(self) -> int:
        """Return D, +1 with the feed and −1 against it."""
        return 1 if self.with_feed else -1

    def of(self, machine: Array) -> Station:
        """Return the stations of some of the machines, as columns."""
        parts = {each.name: getattr(self, each.name) for each in fields(self)}
        return replace(self, **{name: part[machine] for name, part in parts.items() if np.ndim(part) and len(part) > 1})


def profile_height(station: Station, tilt: Array, distance: Array) -> Array:
    """Return the height Y of the cylinder's lower side at a distance ξ along the feed from its axis, abs(ξ) < R.

    The tilt τ of the flat is positive where it has turned with the feed; at τ = 0 the flat is down. A flat that faces upwards
    leans inwards: beyond its lower corner there is no cylinder, and the height is infinite.
    """
    radius, flat = station.radius, station.radius * np.cos(station.half_angle)
    depth = np.sqrt(np.maximum(radius**2 - distance**2, 0.0))
    cosine, aside = np.cos(tilt), distance * np.sin(tilt)
    chord = radius - (flat + aside) / np.where(cosine > 0, cosine, 1.0)
    beyond = np.where(depth * cosine - aside > flat, np.inf, 0.0)
    found: Array = np.maximum(radius - depth, np.where(cosine > 0, chord, beyond))
    return found


def lowest_distance(station: Station, tilt: Array) -> Array:
    """Return the distance ξ* of the lowest point from the axis: the flat's lower corner, or below the axis where that is round."""
    corner = np.sign(tilt) * station.radius * np.sin(station.half_angle - np.abs(tilt))
    return np.where(np.abs(tilt) < station.half_angle, corner, 0.0)


def carriage_clearance(station: Station, rotation: Array, displacement: Array) -> Array:
    """Return the least height over all carriages, infinite where none is below the cylinder.

    ``rotation`` is the cylinder's angle θ in [0, 2π] from the outer end, ``displacement`` the carriages' way s, of one shape.
    """
    tilt = station.direction * np.where(rotation <= np.pi, rotation, rotation - 2 * np.pi)
    axis = station.direction * (station.radius * rotation - station.stroke / 2)
    lowest, half = lowest_distance(station, tilt), station.carriage_width / 2
    first = station.carriage_stop + displacement - axis
    near = first - np.round(first / station.step) * station.step
    found = np.full(np.shape(near), np.inf)
    for number in _reached(station):
        middle = near + number * station.step
        nearest = np.clip(lowest, middle - half, middle + half)
        height = profile_height(station, tilt, nearest)
        found = np.where(np.abs(nearest) < station.radius, np.minimum(found, height), found)
    return found


def _reached(station: Station) -> range:
    """Numbers of the carriages that may be below the cylinder, counted from the one that is nearest to its axis."""
    far = (station.radius + station.carriage_width / 2) / station.step
    reach = int(np.ceil(np.nanmax(far)))
    return range(-reach, reach + 1)


@dataclass(frozen=True)
class LeastClearance:
    """Hold for each machine the least height (m; infinite where no carriage is ever below the cylinder) and the main-shaft angle of it."""

    height: Array
    angle: Array


def least_clearance(height: Heights, period: Array) -> LeastClearance:
    """Return the least height over the period (rad) of each machine, shape (machines,), to 1e-9 of it; infinite where one has no period."""
    machines = np.flatnonzero(np.isfinite(period))
    if not len(machines):
        return LeastClearance(np.full(len(period), np.inf), np.zeros(len(period)))
    shares = np.linspace(0, 1, 1 + round(float(np.max(period[machines])) / EVERY))
    parts = np.array_split(machines, -(-len(machines) // TOGETHER))
    found = [_candidates(height, shares, period, each) for each in parts]
    machine, angle = (np.concatenate([part[index] for part in found]) for index in (0, 1))
    return _closer(height, machine, angle, shares[1] * period, period)


def _candidates(height: Heights, shares: Array, period: Array, machines: Array) -> tuple[Array, Array]:
    """Angles that may be beside the least height, with their machines: no neighbour is lower, none else by more than the steps there are."""
    angles = shares * period[machines, None]
    heights = height(angles, machines)
    padded = np.concatenate([heights[:, -2:-1], heights, heights[:, 1:2]], axis=1)
    low = np.isfinite(heights) & (heights <= padded[:, :-2]) & (heights <= padded[:, 2:])
    bounded = np.where(np.isfinite(padded), padded, np.nan)
    steps = np.nan_to_num(np.abs(np.diff(bounded, axis=1))).max(axis=1, keepdims=True)
    least = np.where(low, heights, np.inf).min(axis=1, keepdims=True)
    row, place = np.nonzero(low & (heights <= least + 2 * steps))
    return machines[row], angles[row, place]


def _closer(height: Heights, machine: Array, angle: Array, step: Array, period: Array) -> LeastClearance:
    """Look closer about all places at once, until the steps are small."""
    found = LeastClearance(np.full(len(period), np.inf), np.zeros(len(period)))
    whole, width = period[machine], step[machine]
    if len(machine):
        rounds = 1 + int(np.log(np.max(width / whole) / CLOSE) / np.log(ACROSS / 2))
        angle, lowest = numerics.least(
            lambda x, own: height(x % whole[own, None], machine[own]), angle - width, angle + width, ACROSS, rounds
        )
        for place in np.argsort(-lowest, kind="stable"):  # the lowest of a machine comes last
            found.height[machine[place]], found.angle[machine[place]] = lowest[place], angle[place] % whole[place]
    return found
