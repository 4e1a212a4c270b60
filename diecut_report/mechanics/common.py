"""Formulas that any calculation needs: the next multiple of a step, the angle between two sides."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.expression import arccos
from diecut_report.formulas.formula import formula


@formula
def rounded_up(quantity: Any, step: Any) -> Any:
    """The next multiple of a step; 1e-9 of a step below, so that what is a multiple stays as it is."""
    return step * np.ceil(quantity / step - 1e-9)


# The law of cosines.


@formula
def enclosed_angle(one_side: Any, other_side: Any, opposite_side: Any) -> Any:
    """Angle between two sides of a triangle (law of cosines)."""
    return arccos((one_side**2 + other_side**2 - opposite_side**2) / (2 * one_side * other_side))
