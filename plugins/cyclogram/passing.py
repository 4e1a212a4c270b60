"""Stations that the sheet passes: the angles at which it is at two places of a step, of all machines at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import pi
from typing import Any

import numpy as np

from diecut_report.api import GivenMechanism, Phrase, Refusal, told
from diecut_report.mechanics.numerics import root
from diecut_report.plugins.cyclogram.kinds import POSITION, STEP

TURN = 2 * pi
CLOSE = 1e-14  # share of the period to which a place is known
LONGER = 1 + 1e-12  # by which rounding may let a way pass its step


@dataclass(frozen=True, eq=False)
class Stretch:
    """Hold a stretch of the way in each machine, shapes (variants,): from where to where it is (m), and the own angles there (rad)."""

    name: str
    every: Any
    first: Any
    start: Any
    end: Any
    begins: Any
    ends: Any

    def of_machine(self, row: int) -> Stretch:
        """Return the stretch in one of the machines."""
        parts = {
            name: _of_row(getattr(self, name), row) for name in ("every", "first", "start", "end", "begins", "ends")
        }
        return replace(self, **parts)

    def require(self, mechanism: GivenMechanism, key: str) -> None:
        """Raise Refusal in words where there is no such stretch in the (only) machine."""
        step = mechanism.number(STEP)
        if step is None or not is_known(mechanism):
            raise Refusal(
                key,
                Phrase(
                    "tells what the sheet passes, but the travel of the sheet is not known in {name}",
                    name=mechanism.name,
                ),
            )
        if not self.start < self.end <= step * LONGER:
            way = Phrase("goes from {start} to {end}", start=told(self.start, "mm", 6), end=told(self.end, "mm", 6))
            message = Phrase(
                "{way}; it must go forward, and no further than the step of {step}", way=way, step=told(step, "mm")
            )
            raise Refusal(key, message)


def _of_row(values: Any, row: int) -> Any:
    return np.ravel(values)[row if np.size(values) > 1 else 0].item()


def is_known(mechanism: GivenMechanism) -> bool:
    """Return whether a line moves a sheet on a way that is known."""
    return mechanism.curve(POSITION) is not None and "moving" in mechanism.phases


def stretches(given: Mapping[str, Any]) -> tuple[tuple[Stretch, ...], ...]:
    """Return what the sheet passes on each line."""
    mechanisms = given["lines.mechanism"]
    passing = given.get("lines.passing") or ((),) * len(mechanisms)
    return tuple(
        tuple(_stretch(mechanism, each) for each in own or ())
        for mechanism, own in zip(mechanisms, passing, strict=True)
    )


def _stretch(mechanism: Any, passage: Any) -> Stretch:
    asked = [np.atleast_1d(np.asarray(getattr(passage, side), dtype=float)) for side in ("from", "to")]
    places = (
        _angles(mechanism, np.stack(np.broadcast_arrays(*asked), axis=1)) if _has_way(mechanism) else (np.nan, np.nan)
    )
    return Stretch(passage.name, passage.every, passage.first, *asked, *places)


def _has_way(mechanism: Any) -> bool:
    return mechanism.curve(POSITION) is not None and mechanism.numbers(STEP) is not None


def _angles(mechanism: Any, wanted: Any) -> tuple[Any, Any]:
    """Own angles (rad, 2π a period) at which the sheet is at places (variants, 2): the one root each of the displacement, which never falls."""
    position, step = mechanism.curve(POSITION), mechanism.numbers(STEP)[:, 0]
    low, high = _moving(mechanism, len(step))
    before = _way(position, step, low, np.arange(len(step)))
    rows = np.repeat(np.arange(len(step)), 2)

    places = np.broadcast_to(wanted, (len(step), 2)).ravel()

    def above(share: Any, end: Any) -> Any:
        return _way(position, step, share, rows[end]) - before[rows[end]] - places[end]

    found = root(above, low[rows], high[rows], CLOSE)
    ends = np.select([places <= 0, places >= step[rows]], [low[rows], high[rows]], found).reshape(-1, 2)
    return TURN * ends[:, 0], TURN * ends[:, 1]


def _moving(mechanism: Any, count: int) -> tuple[Any, Any]:
    """Shares of the period at which the sheet begins to move and stops, of each machine; NaN where it does not move."""
    found = np.full((count, 2), np.nan)
    for row in range(count):
        own = mechanism.of_machine(row)
        moving = own.phases.get("moving")
        if moving is not None:
            (low, high), period = moving.intervals()[0], moving.period()
            back = 1.0 if high > period * LONGER else 0.0
            found[row] = low / period - back, high / period - back
    return found[:, 0], found[:, 1]


def _way(position: Any, step: Any, share: Any, row: Any) -> Any:
    """The way at shares of the period (each of the machine of its row), a step more after each period."""
    passed = np.floor(share)
    inside = (share - passed)[:, None]
    return position.values(inside, inside, row)[:, 0] + passed * step[row]
