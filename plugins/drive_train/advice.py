"""What to change in the V-belt drive, in words for messages: pulleys, distance of the shafts and gears that meet its checks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Phrase, joined, phrase, si, standard_series, standard_series_by, told
from diecut_report.mechanics import belt_path
from diecut_report.mechanics.numerics import root
from diecut_report.plugins.drive_train.belts import length_left_over

Array = NDArray[Any]
PULLEYS = standard_series("renard_r40_lengths")
SERIES: Array = np.asarray([si(value, PULLEYS.unit) for value in PULLEYS.values])
LENGTHS = standard_series_by("iso_4184_lengths")
BELTS: Array = np.unique([si(value, series.unit) for series in LENGTHS.values() for value in series.values])
NAMED = 3  # diameters in a message

LARGEST_RATIO = 7.0
LARGEST_DEVIATION = 2.0  # of the output's speed, %
FASTEST_BELT = 30.0  # m/s
LEAST_WRAP = 120.0  # deg


@dataclass(frozen=True)
class Room:
    """What the V-belt must fit into, SI: the wanted distance of the shafts, the shortest and longest belt of the section."""

    distance: float
    shortest: float
    longest: float

    @property
    def belts(self) -> Array:
        """The standard lengths of the section: all sections have those of one series between their ends."""
        return BELTS[(self.shortest * (1 - 1e-9) <= BELTS) & (self.longest * (1 + 1e-9) >= BELTS)]

    def holds(self, drivers: Array, driven: Array) -> Array:
        """Whether pulleys of these diameters have room, a standard belt, and with it enough wrap."""
        small, large = np.minimum(drivers, driven) / 2, np.maximum(drivers, driven) / 2
        length = belt_path.open_belt_length(np.maximum(self.distance, small + large), small, large)
        belt = self.belts[np.argmin(np.abs(self.belts - length[:, None]), axis=1)]
        there = (length >= self.shortest) & (length <= self.longest) & (small + large < self.distance)
        held: Array = there & is_wrapped(distance_of(belt, small, large), small, large)
        return held


@dataclass(frozen=True)
class Demand:
    """What the pulleys must meet, SI: the V-belt's ratio, the least driver of its section, the speed of the motor, the room."""

    ratio: float
    least: float
    speed: float
    room: Room

    def holds(self, drivers: Array, driven: Array) -> Array:
        """Whether pulleys of these diameters meet all but the speed of the output."""
        runs = (drivers >= self.least * (1 - 1e-9)) & (self.speed * drivers / 2 <= FASTEST_BELT)
        return runs & self.room.holds(drivers, driven)

    def drivers(self) -> Array:
        """Diameters of R40 for the motor's pulley with which all is met."""
        driven = SERIES[np.argmin(np.abs(SERIES[:, None] * self.ratio - SERIES), axis=1)]
        exact = np.abs(SERIES * self.ratio / driven - 1) <= si(LARGEST_DEVIATION, "%")
        found: Array = SERIES[exact & self.holds(SERIES, driven)]
        return found


def distance_of(belt: Array, small: Array, large: Array) -> Array:
    """Distance of the shafts with belts of these lengths, NaN where they are too short for the pulleys."""
    touching = small + large
    small, large, belt, touching = np.broadcast_arrays(small, large, belt, touching)

    def left_over(distance: Array, row: Array) -> Array:
        return np.asarray(length_left_over.function(distance, *(each.ravel()[row] for each in (small, large, belt))))

    found = root(left_over, touching.ravel(), np.maximum(belt / 2, touching).ravel())
    return found.reshape(belt.shape)


def is_wrapped(distance: Array, small: Array, large: Array) -> Array:
    """Whether the smaller pulley's wrap is enough; not where there is no distance."""
    there = np.isfinite(distance)
    wrap = belt_path.wrap_small(np.where(there, distance, small + large), small, large)
    found: Array = there & (wrap >= si(LEAST_WRAP, "deg"))
    return found


def driver_advice(
    ratio: float, diameter: float, least: float, distance: float, shortest: float, longest: float, speed: float
) -> str:
    """What to make the motor's pulley: diameters of R40 nearest to the present ``diameter``, else one turned to measure."""
    demand = Demand(ratio, least, speed, Room(distance, shortest, longest))
    found = demand.drivers()
    if not len(found):
        return _turned(demand, diameter)
    near = np.sort(found[np.argsort(np.abs(found - diameter), kind="stable")[:NAMED]])
    *others, last = (told(driver, "mm") for driver in near)
    return Phrase(
        "with vbelt.driver_diameter = {text} it is met",
        text=joined([joined(others, ", "), last] if others else [last], " or "),
    )


def _turned(demand: Demand, diameter: float) -> str:
    """The driver that turns a driven pulley of R40 at the right speed, no standard diameter itself."""
    drivers = SERIES / demand.ratio
    held = demand.holds(drivers, SERIES)
    if not held.any():
        return phrase(
            "no motor's pulley meets it with this ratio and distance; change the gears' teeth or vbelt.center_distance"
        )
    best = np.argmin(np.where(held, np.abs(drivers - diameter), np.inf))
    return Phrase(
        "no driver of R40 meets it with this ratio and distance; turn the motor's pulley to {drivers} "
        "for a driven one of {series}, or change the gears' teeth",
        drivers=told(drivers[best], "mm"),
        series=told(SERIES[best], "mm"),
    )


def slower_belt_advice(
    ratio: float, diameter: float, least: float, distance: float, shortest: float, longest: float, speed: float
) -> str:
    """Which smaller motor's pulley makes the belt slow enough."""
    demand = Demand(ratio, least, speed, Room(distance, shortest, longest))
    if len(demand.drivers()):
        return driver_advice(ratio, diameter, least, distance, shortest, longest, speed)
    greatest = 2 * FASTEST_BELT / speed
    if greatest < least:
        return phrase(
            "no pulley of this section is small enough for this motor_speed: take a smaller section or a slower motor"
        )
    return Phrase("take a vbelt.driver_diameter of at most {greatest}", greatest=told(greatest, "mm", up=False))


def distance_advice(small: float, large: float, shortest: float, longest: float) -> str:
    """Between which distances of the shafts these pulleys have a standard belt, and with it enough wrap."""
    belts = Room(0.0, shortest, longest).belts
    distances = distance_of(belts, np.asarray(small), np.asarray(large))
    good = distances[is_wrapped(distances, np.asarray(small), np.asarray(large))]
    if not len(good):
        return phrase(
            "no standard belt of this section is long enough for these pulleys at any distance: take a larger vbelt.section, "
            "a smaller motor's pulley, or gears of a greater ratio"
        )
    if len(good) == 1:
        return Phrase("take a vbelt.center_distance of {good}", good=told(good[0], "mm"))
    return Phrase(
        "take a vbelt.center_distance of {min} … {max}",
        min=told(good.min(), "mm", up=True),
        max=told(good.max(), "mm", up=False),
    )


def gears_advice(total: float, diameter: float, distance: float, shortest: float, longest: float) -> str:
    """Which ratio the gears need, so that one V-belt covers the rest with this motor's pulley at this distance."""
    driven = SERIES[(diameter * (1 - 1e-9) <= SERIES) & (diameter * LARGEST_RATIO >= SERIES)]
    held = driven[Room(distance, shortest, longest).holds(np.full_like(driven, diameter), driven)]
    greatest = held.max() / diameter if len(held) else LARGEST_RATIO
    words = Phrase(
        "give the gears a ratio of at least {total}, with more driven teeth or another pair",
        total=told(total / greatest, "1", up=True),
    )
    return words if len(held) else Phrase("{words}, and choose vbelt.center_distance anew", words=words)
