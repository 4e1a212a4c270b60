"""Which pulley of the motor would meet the demanded speed, in words for the message of a check."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import si, standard_series, told
from diecut_report.mechanics import belt_path

Array = NDArray[Any]
PULLEYS = standard_series("renard_r40_lengths")
SERIES: Array = np.asarray([si(value, PULLEYS.unit) for value in PULLEYS.values])
NAMED = 3  # diameters in a message

LARGEST_RATIO = 7.0
LARGEST_DEVIATION = 2.0  # of the output's speed, %
FASTEST_BELT = 30.0  # m/s
LEAST_WRAP = 120.0  # deg


@dataclass(frozen=True)
class Demand:
    """What the pulleys must meet, SI: the V-belt's ratio, the least driver of its section, the wanted distance of the shafts, the
    shortest and longest belt of the section, and the speed of the motor."""

    ratio: float
    least: float
    distance: float
    shortest: float
    longest: float
    speed: float

    def drivers(self) -> Array:
        """Diameters of R40 for the motor's pulley with which speed, room, belt, wrap and speed of the belt are as demanded."""
        drivers = SERIES[self.least * (1 - 1e-9) <= SERIES]
        driven = SERIES[np.argmin(np.abs(drivers[:, None] * self.ratio - SERIES), axis=1)]
        met = np.abs(drivers * self.ratio / driven - 1) <= si(LARGEST_DEVIATION, "%")
        small, large = np.minimum(drivers, driven) / 2, np.maximum(drivers, driven) / 2
        apart = np.maximum(self.distance, small + large)
        length = belt_path.open_belt_length(apart, small, large)
        fits = (small + large < self.distance) & (length >= self.shortest) & (length <= self.longest)
        runs = (belt_path.wrap_small(apart, small, large) >= si(LEAST_WRAP, "deg")) & (
            self.speed * drivers / 2 <= FASTEST_BELT
        )
        found: Array = drivers[met & fits & runs]
        return found


def driver_advice(
    ratio: float, diameter: float, least: float, distance: float, shortest: float, longest: float, speed: float
) -> str:
    """What to make the motor's pulley: diameters of R40 nearest to the present ``diameter``, else one turned to measure."""
    demand = Demand(ratio, least, distance, shortest, longest, speed)
    found = demand.drivers()
    if not len(found):
        return _turned(ratio, diameter, least)
    near = np.sort(found[np.argsort(np.abs(found - diameter), kind="stable")[:NAMED]])
    *others, last = (told(driver, "mm") for driver in near)
    return f"with vbelt.driver_diameter = {' or '.join([', '.join(others), last] if others else [last])} it is met"


def _turned(ratio: float, diameter: float, least: float) -> str:
    """The driver that turns the nearest driven pulley of R40 at the right speed, no standard diameter itself."""
    drivers = SERIES / ratio
    best = np.argmin(np.where(drivers >= least, np.abs(drivers - diameter), np.inf))
    return (
        f"no driver of R40 meets it with this ratio and distance; turn the motor's pulley to {told(drivers[best], 'mm')} "
        f"for a driven one of {told(SERIES[best], 'mm')}, or change the gears' teeth"
    )
