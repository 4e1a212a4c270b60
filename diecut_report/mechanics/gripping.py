"""What the grippers of a conveyor have to hold: the sheet's own inertia."""

from __future__ import annotations

from typing import Any

from diecut_report.expressions import formula


@formula
def sheet_mass(grammage: Any, sheet_length: Any, sheet_width: Any) -> Any:
    """Mass of a sheet."""
    return grammage * sheet_length * sheet_width


@formula
def sheet_force(sheet_mass: Any, sheet_acceleration_max: Any) -> Any:
    """Force with which a sheet pulls at its grippers at its greatest acceleration."""
    return sheet_mass * sheet_acceleration_max
