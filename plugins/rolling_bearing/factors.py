"""The factors of single-row deep groove ball bearings by the relative axial force (ISO 281, table 3)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Interpolated, Steps, own_table
from diecut_report.plugins.rolling_bearing import formulas as f

# fmt: off

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
between.interpolated("table_e", "e_t", "1", "Limit of F_a/F_r, from the table (deep groove)", FACTORS, of="held_axial", column="e", key="bearings",
    source="ISO 281, table 3", output=False)
between.interpolated("table_y", "Y_t", "1", "Axial factor, from the table (deep groove)", FACTORS, of="held_axial", column="Y", key="bearings",
    source="ISO 281, table 3", output=False)


def table_factors(axial: Array, static_rating: Array, f0: Array) -> tuple[Array, Array]:
    """Return e and Y of deep groove ball bearings."""
    relative = np.asarray(f.held.function(f.relative_axial.function(f0, axial, static_rating)))
    e, y = (step.between.function(relative) for step in between.steps if isinstance(step, Interpolated))
    return e, y
