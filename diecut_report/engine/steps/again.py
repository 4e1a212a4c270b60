"""The same machines calculated again with other inputs, for plain code that seeks a size: many of them at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from diecut_report.contract.inputs import texts_given
from diecut_report.contract.varying import Extremes
from diecut_report.engine.calculation import Calculation, CurveHandle, Impossible, Unproven
from diecut_report.engine.steps.needed import needed
from diecut_report.expressions import Array

Calculate = Callable[..., Calculation]


@dataclass(frozen=True)
class RowsOf:
    """Hold a curve of other variants: which one for each."""

    curve: CurveHandle
    rows: Array

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values as the curve gives them."""
        return self.curve.values(share, middle, self.rows if rows is None else self.rows[rows])

    @property
    def breakpoints(self) -> Array:
        """Return those of the curve, of each variant."""
        return self.curve.breakpoints[self.rows]

    @property
    def joints(self) -> Array:
        """Return those of the curve, of each variant."""
        return self.curve.joints[self.rows]

    @property
    def cycle(self) -> str:
        """Return what the curve runs over."""
        return self.curve.cycle


class Again:
    """Calculate machines that differ from those of a calculation in some inputs."""

    def __init__(self, calc: Calculation, calculate: Calculate) -> None:
        self.mechanism, self.count, self.calculate = calc.mechanism, calc.count, calculate
        self.inputs = {name: value for name, value in calc.inputs.items() if name in calc.given}

    def __call__(self, changed: Mapping[str, Any], rows: Array, names: Sequence[str]) -> dict[str, Array]:
        """Return quantities of the machines ``rows`` (variants of the calculation), each with the inputs ``changed`` (machines, parts).

        NaN where a machine is impossible then, and where it does not have the quantity.
        """
        inputs = {name: _of(value, rows, self.count) for name, value in self.inputs.items()} | dict(changed)
        only = needed(self.mechanism, frozenset(inputs) | texts_given(inputs), names)
        try:
            made = self.calculate(self.mechanism, inputs, len(rows), only)
        except (Impossible, Unproven):
            return {name: np.full(len(rows), np.nan) for name in names}
        possible = np.ones(len(rows), dtype=bool)
        possible[list(made.flaws)] = False
        return {name: np.where(possible, made[name][:, 0], np.nan) for name in names}


def _of(value: Any, rows: Array, count: int) -> Any:
    """An input of these rows of a calculation of so many variants."""
    match value:
        case np.ndarray():
            return value[rows]
        case tuple():
            return tuple(_of(part, rows, count) for part in value)
        case Extremes(low=low, high=high):
            return replace(value, low=_of(low, rows, count), high=_of(high, rows, count))
        case CurveHandle() if count > 1:
            return RowsOf(value, rows)
    return value
