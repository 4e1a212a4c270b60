"""The law of cosines."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.expressions import arccos, formula


@formula
def enclosed_angle(one_side: Any, other_side: Any, opposite_side: Any) -> Any:
    """Angle between two sides of a triangle (law of cosines)."""
    return arccos((one_side**2 + other_side**2 - opposite_side**2) / (2 * one_side * other_side))


@formula
def third_side(one_side: Any, other_side: Any, enclosed: Any) -> Any:
    """Side of a triangle opposite the angle that two others enclose (law of cosines)."""
    return np.sqrt(one_side**2 + other_side**2 - 2 * one_side * other_side * np.cos(enclosed))
