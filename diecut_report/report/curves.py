"""Curves of the results as they are drawn and tabled: jumps at their true place, closed over a turn (all SI)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Data = Mapping[str, Any]
Array = NDArray[Any]
CURVE_ROWS = 12  # of a table of curves without breakpoints
MOST_PIECES = 8  # for which a table has the ends and the middle of each: with more it would grow too long

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


def table_places(over: Data, members: Sequence[Data]) -> Iterator[CurvePlace]:
    """Rows of a table of curves: each smooth piece's ends, the middle and as many beside it as there is room for.

    A jump gives two rows, before and after it. Pieces that are too many are not told apart.
    """
    x, breaks = np.asarray(over["values"], dtype=float), members[0].get("breakpoints", [])
    if len(breaks) >= MOST_PIECES or any(curve.get("breakpoints", []) != breaks for curve in members):
        breaks = []
    count = max(1, CURVE_ROWS // (len(breaks) + 1) - 1) | 1  # an odd number has the middle
    yield CurvePlace(float(x[0]), "values", 0)
    for piece, (start, end) in enumerate(pairwise([x[0], *breaks, 2 * x[-1] - x[-2]])):
        if piece:
            yield CurvePlace(start, "left", piece - 1)
        if piece and any(_jumps(curve, piece - 1) for curve in members):
            yield CurvePlace(start, "right", piece - 1)
        yield from (CurvePlace(float(x[index]), "values", index) for index in _within(x, start, end, count))


def _jumps(curve: Data, index: int) -> bool:
    """Whether a curve jumps at a breakpoint by more than rounding."""
    jump = abs(curve["right"][index] - curve["left"][index])
    return bool(jump > ROUNDING * max(map(abs, curve["values"])))


def _within(x: Array, start: float, end: float, count: int) -> list[int]:
    """So many samples between the ends of a piece, about equally far apart; fewer where it has fewer."""
    margin = 1e-9 * float(np.ptp(x))
    inside = np.nonzero((x > start + margin) & (x < end - margin))[0]
    if not len(inside):
        return []
    sought = start + (end - start) * np.arange(1, count + 1) / (count + 1)
    nearest = np.abs(x[inside] - sought[:, None]).argmin(axis=1)
    return [int(index) for index in inside[np.unique(nearest)]]
