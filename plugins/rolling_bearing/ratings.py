"""Ratings and factors of a bearing, and its equivalent loads."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Steps, formula, interpolated, own_table, pi

# fmt: off


@formula
def equivalent_load(radial: Any, axial: Any, x: Any, y: Any, e: Any) -> Any:
    """Return the dynamic equivalent load, not below the radial force."""
    return np.where(axial <= e * radial, radial, np.maximum(x * radial + y * axial, radial))


@formula
def static_load(radial: Any, axial: Any, x0: Any, y0: Any) -> Any:
    """Return the static equivalent load."""
    return np.maximum(radial, x0 * radial + y0 * axial)


@formula
def relative_axial(f0: Any, axial: Any, static_rating: Any) -> Any:
    """Return by what the factors of deep groove ball bearings go."""
    return f0 * axial / static_rating


@formula
def held(relative: Any) -> Any:
    """Return the same, held at the ends of the table."""
    return np.clip(relative, 0.172, 6.89)


@formula
def revolutions(rating: Any, load: Any, exponent: Any) -> Any:
    """Return the basic rating life in revolutions."""
    return 1e6 * (rating / load) ** exponent


@formula
def duration(turns: Any, speed: Any) -> Any:
    """Return how long so many revolutions last."""
    return 2 * pi * turns / speed


@formula
def modified(reliability: Any, a_iso: Any, life: Any) -> Any:
    """Return the modified rating life."""
    return reliability * a_iso * life


Array = NDArray[Any]
RADIAL_FACTOR = 0.56
STATIC_FACTORS = 0.6, 0.5  # X_0 and Y_0 (ISO 76)
FACTORS = own_table(
    title="Factors e and Y of single-row deep groove ball bearings, normal clearance (ISO 281, table 3)",
    columns={"ratio": "1", "e": "1", "Y": "1"},
    rows=((0.172, 0.19, 2.30), (0.345, 0.22, 1.99), (0.689, 0.26, 1.71), (1.03, 0.28, 1.55), (1.38, 0.30, 1.45), (2.07, 0.34, 1.31),
          (3.45, 0.38, 1.15), (5.17, 0.42, 1.04), (6.89, 0.44, 1.00)),
    sources=("SKF, general catalogue, calculation factors of single row deep groove ball bearings, normal clearance",
             "NSK, rolling bearings, catalogue, dynamic equivalent load of deep groove ball bearings"),
    left_out="The columns for clearances C3 and C4.",
)
RATIOS = FACTORS.columns[0].values

between = Steps()
between.table_e = (interpolated(FACTORS, of="held_axial", column="e", key="bearings", output=False), "e_t", "1",
    "Limit of F_a/F_r, from the table (deep groove)", "ISO 281, table 3")
between.table_y = (interpolated(FACTORS, of="held_axial", column="Y", key="bearings", output=False), "Y_t", "1",
    "Axial factor, from the table (deep groove)", "ISO 281, table 3")


def table_factors(axial: Array, static_rating: Array, f0: Array) -> tuple[Array, Array]:
    """Return e and Y of deep groove ball bearings."""
    relative = np.asarray(held.function(relative_axial.function(f0, axial, static_rating)))
    e, y = (step.between.function(relative) for step in between.steps if hasattr(step, "between"))
    return e, y


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
        return np.asarray(equivalent_load.function(radial, axial, x, y, e), dtype=float)

    def static_load(self, radial: Array, axial: Array) -> Array:
        """Return the static equivalent load."""
        return np.asarray(static_load.function(radial, axial, self.x0, self.y0), dtype=float)

    def bends(self, radial: Array, axial: Array) -> Iterator[Array]:
        """Yield what changes its sign where the equivalent load has a corner or jumps between those of its factors."""
        x, y, e = self.factors(axial)
        yield axial - e * radial
        yield x * radial + y * axial - radial

    def bends_of_factors(self, axial: Array) -> Iterator[Array]:
        """Yield what changes its sign where the factors have corners."""
        if self.by_table:
            relative = relative_axial.function(self.f0, axial, self.static)
            yield from (relative - row for row in RATIOS)
