"""Curves of the results as they are drawn: jumps at their true place, closed over a turn (all SI)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Data = Mapping[str, Any]
Array = NDArray[Any]


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
