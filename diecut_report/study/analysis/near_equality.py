"""Numbers that differ by rounding alone."""

from __future__ import annotations

import numpy as np

from diecut_report.expressions import Array

DIGITS = 10


def rounded(values: Array) -> Array:
    """Return the values to ten digits, so that nothing is better than another by rounding."""
    sizes = np.abs(np.where(np.isfinite(values) & (values != 0), values, 1.0))
    unit = 10.0 ** (np.floor(np.log10(sizes)) + 1 - DIGITS)
    found: Array = np.where(np.isfinite(values), np.round(values / unit) * unit, values)
    return found
