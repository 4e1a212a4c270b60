"""First and total Sobol indices from the rows of a `SobolIndices` sample."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.expressions import Array
from diecut_report.languages.phrases import phrase

SOURCE = phrase(
    "first order: Saltelli et al. 2010, Computer Physics Communications 181, 259–270, table 2 (b); "
    "total: Jansen 1999, Computer Physics Communications 117, 35–43 (table 2 (f) there)"
)


@dataclass(frozen=True)
class Indices:
    """Hold what part of the variance of a quantity the inputs cause, in the order of the sample's paths.

    `first` is the part that an input causes alone, `total` the part in which it takes part at all. Both are estimates
    and may lie a little outside 0 … 1. `points` of the sample's points were complete and served.
    """

    first: Array
    total: Array
    points: int


def sobol_indices(values: Array) -> Indices | None:
    """Return the indices from the values of a quantity, (points, paths + 2) in the order of `Saltelli`; NaN where there is none.

    A point of which any value is missing is left out whole, since its rows only count together. None where fewer than
    two points remain or the quantity is the same in all of them. See SOURCE for the formulas.
    """
    complete = values[np.isfinite(values).all(axis=1)]
    if len(complete) < 2:
        return None
    both = complete[:, :2]
    scale = np.abs(both).max()
    middle = both.mean()
    variance = both.var()
    if variance <= (1e-14 * scale) ** 2:
        return None
    a, b, ab = complete[:, :1] - middle, complete[:, 1:2] - middle, complete[:, 2:] - middle
    first = (b * (ab - a)).mean(axis=0) / variance
    total = ((a - ab) ** 2).mean(axis=0) / (2 * variance)
    return Indices(first, total, len(complete))
