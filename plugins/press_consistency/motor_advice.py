"""What a motor that gets too hot, stalls or lets the speed swing needs: a heavier flywheel, more slip, or more power.

Each is found by trying: the time constant of the lag grows with the flywheel's inertia and with the motor's slip, and falls as
its power grows, while what it may carry grows with that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from diecut_report.api import Curve, Phrase, joined, phrase, told
from diecut_report.mechanics.timing.engagement import motor_response
from diecut_report.mechanics.timing.shaft_curves import PieceRows
from diecut_report.plugins.press_consistency.motor import load_of

DOUBLINGS = 16
CLOSE = 1e-7  # relative
MOST_SLIP = 0.15  # of the synchronous speed: no usual motor has more

Bearable = Callable[[PieceRows, float], bool]  # whether a response is, at so many times the motor's power


def thermal(torque: Curve, *numbers: float) -> str:
    """Return what keeps the root mean square of a motor's torque at its rated one."""
    return _advice(torque, numbers, lambda rated, _: lambda found, times: found.rms[0] <= rated * times)


def peak(torque: Curve, *numbers: float) -> str:
    """Return what keeps its greatest torque below the breakdown torque, which is the last of the numbers times the rated one."""
    return _advice(
        torque,
        numbers,
        lambda rated, ratio: lambda found, times: max(found.largest[0], -found.least[0]) <= rated * ratio * times,
    )


def swing(torque: Curve, *numbers: float) -> str:
    """Return the flywheel that keeps the swing of its speed below the last of the numbers; more slip or power is not the way."""
    *motor, stiffness, speed, fluctuation = numbers
    follow, lag = _follower(torque, motor[0], motor[1]), motor[2]
    allowed = stiffness * speed * fluctuation
    needed = _least(lambda times: _range(follow(lag * times)) <= allowed)
    if not np.isfinite(needed):
        return phrase("no flywheel keeps it that even")
    return Phrase(
        "the flywheel needs an inertia of at least {motor}", motor=told(motor[3] * needed, "kg*m**2", up=True)
    )


def _range(found: PieceRows) -> float:
    return float(found.largest[0] - found.least[0])


def _follower(torque: Curve, turns: float, period: float) -> Callable[[float], PieceRows]:
    """The motor's torque by the time constant of its lag."""
    load = load_of(torque, np.array([[turns]]))
    return lambda lag: motor_response(load, np.array([period]), np.array([lag]))


def _advice(torque: Curve, numbers: tuple[float, ...], limit: Callable[[float, float], Bearable]) -> str:
    """Words on what would do, for the load's turns and period, the lag, the flywheel, and the motor with its belt."""
    turns, period, lag, inertia, rated, ratio, efficiency, speed, synchronous, *more = numbers
    follow = _follower(torque, turns, period)
    bearable = limit(rated * ratio * efficiency, more[0] if more else 1.0)
    heavier = _least(lambda times: bearable(follow(lag * times), 1.0))
    stronger = _least(lambda times: bearable(follow(lag / times), times))
    ways = list(_ways(heavier, stronger, inertia, rated * speed, synchronous - speed, synchronous))
    return (
        Phrase("it needs {ways}", ways=joined(ways, ", or "))
        if ways
        else phrase("no flywheel and no motor of this speed would do")
    )


def _ways(
    heavier: float, stronger: float, inertia: float, power: float, slip: float, synchronous: float
) -> Iterator[str]:
    if np.isfinite(heavier):
        yield Phrase("a flywheel of at least {inertia}", inertia=told(inertia * heavier, "kg*m**2", up=True))
    if heavier * slip <= MOST_SLIP * synchronous:
        yield Phrase("a slip of at least {heavier} at the rated torque", heavier=told(heavier * slip, "rpm", up=True))
    if np.isfinite(stronger):
        yield Phrase(
            "a rated power of at least {power}, by a greater reserve_factor of the drive train",
            power=told(power * stronger, "kW", up=True),
        )


def _least(holds: Callable[[float], Any]) -> float:
    """Return the least multiple from 1 on with which something holds, a little above the root; infinite where none does."""
    high = next((2.0**n for n in range(DOUBLINGS) if holds(2.0**n)), np.inf)
    if not 1 < high < np.inf:
        return high
    low = high / 2
    while high - low > CLOSE * high:
        middle = (low + high) / 2
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high
