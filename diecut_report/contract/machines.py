"""What plain code gets of one among many machines: the values of its inputs, the mechanisms that it names, what was made of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from diecut_report.contract.other_units import InOtherUnit
from diecut_report.contract.placeholders import Curve
from diecut_report.expressions import Array


class Machines(tuple[Any, ...]):
    """Hold what plain code made of each of many machines; None of one that cannot be."""

    __slots__ = ()


@dataclass(frozen=True)
class CurveOfMachine:
    """Hold the curve of one among many machines, as the curve of a single one."""

    curve: Curve
    row: int

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares, shape (rows, points), as ``Curve`` does."""
        return self.curve.values(share, middle, np.full(len(share), self.row))

    @property
    def breakpoints(self) -> Array:
        """Return the inner edges of its smooth pieces, shape (1, places)."""
        return _row(self.curve.breakpoints, self.row)

    @property
    def joints(self) -> Array:
        """Return those of them where the curve jumps or has a corner."""
        return _row(self.curve.joints, self.row)

    @property
    def cycle(self) -> str:
        """Return the id of what the curve runs over."""
        return self.curve.cycle


def of_machine(value: Any, row: int, count: int) -> Any:
    """Return what a value of many machines is of one of them: arrays with one row, texts as they are."""
    match value:
        case Machines():
            return value[row]
        case InOtherUnit():
            return replace(value, value=_of_all(value.value, row))
        case np.ndarray() if value.shape[:1] == (count,):
            return value[row : row + 1]
        case tuple():
            return tuple(of_machine(each, row, count) for each in value)
    if hasattr(value, "of_machine"):
        return value.of_machine(row)
    return CurveOfMachine(value, row) if hasattr(value, "breakpoints") else value


def _of_all(value: Any, row: int) -> Any:
    """The number of a machine; one that holds for all has a single one."""
    return value if np.ndim(value) == 0 or len(value) == 1 else value[row]


def _row(places: Array, row: int) -> Array:
    found: Array = places[row if len(places) > 1 else 0]
    return found[None, :]
