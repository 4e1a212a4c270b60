"""The largest productivity that the margins of time allow: angles stay, and a time takes more angle the faster the shaft turns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite, pi
from typing import Literal

from diecut_report.mechanics.timing.intervals import (
    Intervals,
    Moved,
    Tents,
    best_offset,
    feasible_shifts,
    margins_within,
    relevant,
    tents,
    worst,
)

CLOSE = 1e-10  # relative, to which the limit is found

Reason = Literal["no_time_margin", "angles_decide"]


@dataclass(frozen=True)
class Interlock:
    """Hold what must lie within what on the main shaft, at the offsets that are set (an ``apart_from`` as within the complement).

    ``moved`` is the side that the line with the automatic offset has; None where it has neither or both. ``margin_angle``
    (rad) and ``margin_time`` (s) are required at each end; they add up.
    """

    name: str
    inner: Intervals
    outer: Intervals
    moved: Moved | None = None
    margin_angle: float = 0.0
    margin_time: float = 0.0

    def required(self, productivity: float) -> float:
        """Return the required margin (rad) at a productivity (sheets, so turns of the main shaft, per second)."""
        return self.margin_angle + 2 * pi * productivity * self.margin_time


@dataclass(frozen=True)
class ProductivityLimit:
    """Hold the largest productivity (1/s), or why there is none: no margin is a time, or none holds at any speed."""

    value: float | None
    reason: Reason | None = None


def tents_of(interlocks: Sequence[Interlock], period: float, productivity: float) -> Tents:
    """Return the tents of all interlocks that the moved line takes part in with one side."""
    return tuple(
        row
        for each in interlocks
        if each.moved is not None
        for row in tents(each.inner, each.outer, period, each.moved, each.required(productivity))
    )


def productivity_limit(interlocks: Sequence[Interlock], period: float, span: float) -> ProductivityLimit:
    """Return the largest productivity with the line's offset free in [0, span); interlocks without it stand as they are."""
    fixed = fixed_productivity_limit([each for each in interlocks if each.moved is None], period)
    free = _free_limit([each for each in interlocks if each.moved is not None], period, span)
    if "angles_decide" in (fixed.reason, free.reason):
        return ProductivityLimit(None, "angles_decide")
    return _limit(min(inf if each.value is None else each.value for each in (fixed, free)))


def fixed_productivity_limit(interlocks: Sequence[Interlock], period: float) -> ProductivityLimit:
    """Return the largest productivity with all offsets as they are."""
    least = inf
    for each in interlocks:
        pair = worst(margins_within(each.inner, each.outer, period))
        room = inf if pair is None else pair.least - each.margin_angle
        if room < 0:
            return ProductivityLimit(None, "angles_decide")
        if each.margin_time > 0:
            least = min(least, room / (2 * pi * each.margin_time))
    return _limit(least)


def _limit(least: float) -> ProductivityLimit:
    return ProductivityLimit(least) if isfinite(least) else ProductivityLimit(None, "no_time_margin")


def _free_limit(interlocks: Sequence[Interlock], period: float, span: float) -> ProductivityLimit:
    """Bisect: a higher productivity never makes a shift feasible."""
    still = relevant(tents_of(interlocks, period, 0.0), span)
    if not feasible_shifts(still, span):
        return ProductivityLimit(None, "angles_decide")
    high = min((_alone(each, period, span) for each in interlocks if each.margin_time > 0), default=inf)
    if not isfinite(high):
        return ProductivityLimit(None, "no_time_margin")
    return ProductivityLimit(_bisected(interlocks, period, span, high))


def _alone(interlock: Interlock, period: float, span: float) -> float:
    """Largest productivity if this interlock were the only one: its margin is the same at all its ends."""
    room = best_offset(tents_of([interlock], period, 0.0), span).slack
    return room / (2 * pi * interlock.margin_time)


def _bisected(interlocks: Sequence[Interlock], period: float, span: float, high: float) -> float:
    def holds(productivity: float) -> bool:
        return bool(feasible_shifts(tents_of(interlocks, period, productivity), span))

    if holds(high):
        return high
    low = 0.0
    while high - low > CLOSE * high:
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low
