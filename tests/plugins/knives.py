"""Circular knives that the tests calculate, and the same knife as a rigid body of its own."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.circular_knife import MECHANISM
from tests.machines import inputs, number
from tests.validation.rows_circular_knife import KEYS

STEEP: dict[str, Any] = {"front_distance": "33 mm", "cut_length": "7 mm", "thickness": "1.2 mm"}
# The edge's centre passes the height of the shaft during the cut: the knife angle runs from below zero to above.
THROUGH_ZERO: dict[str, Any] = {"depth": "95 mm", "front_distance": "35 mm", "cut_length": "30 mm", "thickness": "2 mm"}
BEFORE_ZERO: dict[str, Any] = {"depth": "90 mm", "front_distance": "25 mm", "cut_length": "12 mm"}
LARGE: dict[str, Any] = {"eccentricity": "60 mm", "edge_radius": "250 mm", "depth": "280 mm", "front_distance": "70 mm",
                         "cut_length": "45 mm", "thickness": "4 mm", "speed": "25 rpm", "friction": 0.15}  # fmt: skip
SHAPES: dict[str, dict[str, Any]] = {
    "example": {},
    "steep": STEEP,
    "through zero": THROUGH_ZERO,
    "before zero": BEFORE_ZERO,
    "large": LARGE,
}


def knife(**changes: Any) -> Calculation:
    """The knife of the worked example with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, KEYS | changes))


def in_cut(calc: Calculation, points: int = 401, inside: float = 1e-6) -> Array:
    """Knife angles from start to end of the cut."""
    start, end = number(calc, "angle_start"), number(calc, "angle_end")
    found: Array = start + (end - start) * np.linspace(inside, 1 - inside, points)
    return found


def edge_points(calc: Calculation, angle: float, points: int = 200_001) -> Array:
    """The right half of the edge as a polygon that turns with the shaft: x, and y down; shape (points, 2)."""
    r, radius = number(calc, "eccentricity"), number(calc, "edge_radius")
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    on_knife = np.linspace(
        -angle, np.pi / 2 - angle, points
    )  # places on the edge that point right to down at this angle
    body = np.column_stack([r + radius * np.cos(on_knife), radius * np.sin(on_knife)])
    found: Array = body @ turn
    return found


def crossing(calc: Calculation, angle: float, depth: Any, points: int = 200_001) -> Array:
    """Where the polygon crosses depths."""
    x, y = edge_points(calc, angle, points).T
    found: Array = np.interp(depth, y, x)
    return found
