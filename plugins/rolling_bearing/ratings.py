"""Ratings and factors of a bearing, and its equivalent loads."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.plugins.rolling_bearing import formulas as f
from diecut_report.plugins.rolling_bearing.factors import RATIOS, table_factors

Array = NDArray[Any]


@dataclass(frozen=True)
class Ratings:
    """Ratings and factors of a bearing, (variants, 1) each; x, y and e of a deep groove ball bearing follow from the table."""

    dynamic: Array
    static: Array
    f0: Array
    x: Array
    y: Array
    e: Array
    x0: Array
    y0: Array
    by_table: bool

    def of(self, rows: Array) -> Ratings:
        """Return those of some variants."""
        arrays: dict[str, Any] = {name: each[rows] for name, each in vars(self).items() if isinstance(each, np.ndarray)}
        return replace(self, **arrays)

    def factors(self, axial: Array) -> tuple[Array, Array, Array]:
        """Return X, Y and e under an axial force (variants, places)."""
        if not self.by_table:
            return self.x, self.y, self.e
        e, y = table_factors(axial, self.static, self.f0)
        return self.x, y, e

    def equivalent(self, radial: Array, axial: Array) -> Array:
        """Return the equivalent load."""
        x, y, e = self.factors(axial)
        found: Array = np.asarray(f.equivalent_load.function(radial, axial, x, y, e), dtype=float)
        return found

    def static_load(self, radial: Array, axial: Array) -> Array:
        """Return the static equivalent load."""
        found: Array = np.asarray(f.static_load.function(radial, axial, self.x0, self.y0), dtype=float)
        return found

    def bends(self, radial: Array, axial: Array) -> Iterator[Array]:
        """Yield what changes its sign where the equivalent load has a corner or jumps between those of its factors."""
        x, y, e = self.factors(axial)
        yield axial - e * radial
        yield x * radial + y * axial - radial

    def bends_of_factors(self, axial: Array) -> Iterator[Array]:
        """Yield what changes its sign where the factors have corners."""
        if self.by_table:
            relative = f.relative_axial.function(self.f0, axial, self.static)
            yield from (relative - row for row in RATIOS)
