"""Formulas of the drive's motion and cutting; those of the linkage are in ``mechanics.four_bar``."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def rolled(angle: Any, sector_ratio: Any, cylinder_radius: Any) -> Any:
    """Rolled length, speed or acceleration of the cylinder from the rocker's angle or its derivative."""
    return angle * sector_ratio * cylinder_radius


@formula
def cutting_length(cylinder_radius: Any, material_thickness: Any) -> Any:
    """Length over which the cylinder cuts at one time, along its motion."""
    return np.sqrt(2 * cylinder_radius * material_thickness - material_thickness**2)


@formula
def cuts_always(cutting_arc_fraction: Any) -> Any:
    """Whether the board is cut over the whole stroke."""
    return cutting_arc_fraction >= 1


@formula
def turn_later(angle: Any) -> Any:
    """The same crank angle a turn later."""
    return angle + 2 * np.pi
