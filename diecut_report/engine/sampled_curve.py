"""A curve that is given as a list of values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.expressions import Array


@dataclass(frozen=True)
class SampledCurve:
    """Hold a curve given as equally spaced values over one period; between them it runs straight."""

    numbers: tuple[float, ...]

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares of the period, of any shape (all variants have the same curve, which has no jumps)."""
        places = np.arange(len(self.numbers) + 1) / len(self.numbers)
        found: Array = np.interp(share % 1, places, [*self.numbers, self.numbers[0]])
        return found

    @property
    def breakpoints(self) -> Array:
        """Return the given places, where the curve has its corners, as shares of the period, shape (1, places)."""
        return np.arange(len(self.numbers))[None, :] / len(self.numbers)

    joints = breakpoints
    cycle = "list"  # of values, over whatever takes it

    def gain(self, rows: Array | None) -> Array:
        """Return nothing: the curve closes."""
        return np.zeros((1, 1))
