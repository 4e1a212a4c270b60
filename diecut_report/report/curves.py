"""Curves of the results as they are drawn and tabled: jumps at their true place, closed over a turn (all SI)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Data = Mapping[str, Any]
Array = NDArray[Any]
CURVE_ROWS = 18  # of a table of curves: of a turn each twentieth degree
MOST_JUMPS = 8  # of which a table tells: with more it would grow too long
SIDES: tuple[Literal["left", "right"], ...] = ("left", "right")

ROUNDING = 1e-5  # of a curve's greatest value; where a root is taken of rounding, it grows to about a millionth


class CurvePlace(NamedTuple):
    """Where a row of a table is taken: x, and the list of a curve's results and the number in it (from 0) of the value."""

    x: float
    values: Literal["values", "left", "right"]
    number: int


def continuous(curve: Data, over: Data, period: float | None) -> tuple[Array, Array]:
    """Samples of a curve over its abscissa, a jump as two points at its true place, led to the end of a full period (SI)."""
    x, y = np.asarray(over["values"], dtype=float), np.asarray(curve["values"], dtype=float)
    places = np.asarray(curve.get("breakpoints", []), dtype=float)
    if period:
        x, y = np.append(x, x[0] + period), np.append(y, _end(y))
    if not len(places):
        return x, y
    clear = (np.abs(x[:, None] - places) > 1e-12 * max(1.0, float(np.abs(x).max()))).all(axis=1)
    x, y, order = x[clear], y[clear], np.full(int(clear.sum()), 0)
    x = np.concatenate([x, places, places])
    y = np.concatenate([y, curve["left"], curve["right"]])
    order = np.concatenate([order, np.full(len(places), 0), np.full(len(places), 1)])
    sorting = np.lexsort((order, x))
    return x[sorting], y[sorting]


def _end(y: Array) -> float:
    """A curve's value at the end of a period: its first one, or where it leads to if it does not close (a growing angle)."""
    ahead = 2 * y[-1] - y[-2]
    bends = np.abs(np.diff(np.concatenate([y[:4], y[-4:]]), 2))[[0, 1, -2, -1]]
    closes = abs(y[0] - ahead) <= max(10 * float(bends.max()), 0.02 * float(np.ptp(y)))
    return float(y[0] if closes else ahead)


def period_of(over: Data) -> float | None:
    """A full turn, where the abscissa is an angle that runs over one."""
    values = over["values"]
    if over["unit"] != "rad" or len(values) < 3:
        return None
    step = values[1] - values[0]
    return 2 * np.pi if abs(values[-1] + step - values[0] - 2 * np.pi) < 0.5 * step else None


def through_pole(x: Array, y: Array) -> tuple[Array, Array]:
    """A change of sign passes through the pole: a jump by a radial line, a crossing at its interpolated place."""
    change = np.nonzero(np.sign(y[:-1]) * np.sign(y[1:]) < 0)[0]
    places = x[change] - y[change] * (x[change + 1] - x[change]) / (y[change + 1] - y[change])
    return np.insert(x, change + 1, places), np.insert(y, change + 1, 0.0)


def table_places(over: Data, members: Sequence[Data]) -> list[CurvePlace]:
    """Rows of a table of curves: at even steps of the samples; a jump adds two, before and after it.

    Of curves that jump at many places, or at different ones, no jump is told.
    """
    x, breaks = over["values"], members[0].get("breakpoints", [])
    if len(breaks) >= MOST_JUMPS or any(curve.get("breakpoints", []) != breaks for curve in members):
        breaks = []
    jumps = [index for index in range(len(breaks)) if any(_jumps(curve, index) for curve in members)]
    sides = [CurvePlace(breaks[index], side, index) for index in jumps for side in SIDES]
    even = [CurvePlace(float(x[number]), "values", number) for number in range(0, len(x), max(1, len(x) // CURVE_ROWS))]
    margin = 1e-9 * float(np.ptp(x))
    clear = [each for each in even if all(abs(each.x - breaks[index]) > margin for index in jumps)]
    return sorted(clear + sides, key=lambda place: place.x)  # of equal ones the left side stays the first


def _jumps(curve: Data, index: int) -> bool:
    """Whether a curve jumps at a breakpoint by more than rounding."""
    jump = abs(curve["right"][index] - curve["left"][index])
    return bool(jump > ROUNDING * max(map(abs, curve["values"])))
