"""Geometry of the segment that a chord cuts off a circle (angles in rad, lengths in m).

``half_angle`` is half the central angle of the segment's arc; the segment is less than half the circle.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.expression import arccos, as_number
from diecut_report.formulas.formula import formula


@formula
def half_angle(radius: Any, height: Any) -> Any:
    """Half the central angle of a segment of this height."""
    return arccos((radius - height) / radius)


@formula
def chord(radius: Any, height: Any) -> Any:
    """Length of the chord."""
    return 2 * np.sqrt(2 * height * radius - height**2)


@formula
def arc_length_huygens(radius: Any, height: Any) -> Any:
    """Huygens' approximation of the arc's length, from its chord and height."""
    return np.sqrt((24 * height * radius + 4 * height**2) / 3)


@formula
def area(radius: Any, half_angle: Any) -> Any:
    """Area of the segment."""
    return radius**2 * (as_number(half_angle) - np.sin(half_angle) * np.cos(half_angle))


@formula
def first_moment(chord: Any) -> Any:
    """Area times the distance of its centroid from the circle's centre."""
    return chord**3 / 12


@formula
def polar_second_moment(radius: Any, distance: Any, half_angle: Any) -> Any:
    """Polar second moment of the segment about the circle's centre, the chord being at ``distance`` from it."""
    triangles = distance**4 / 2 * (np.tan(half_angle) + np.tan(half_angle) ** 3 / 3)
    return radius**4 * half_angle / 2 - triangles


@formula
def second_moment_along_chord(radius: Any, half_angle: Any) -> Any:
    """Second moment of the segment about the circle's diameter parallel to the chord."""
    return radius**4 / 4 * (as_number(half_angle) - np.sin(4 * half_angle) / 4)
