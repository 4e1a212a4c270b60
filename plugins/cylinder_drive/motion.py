"""Formulas of the drive's motion and cutting; those of the linkage are in ``mechanics.four_bar``."""

from __future__ import annotations

from typing import Any

from diecut_report.api import formula


@formula
def rolled(angle: Any, sector_ratio: Any, cylinder_radius: Any) -> Any:
    """Rolled length, speed or acceleration of the cylinder from the rocker's angle or its derivative."""
    return angle * sector_ratio * cylinder_radius
