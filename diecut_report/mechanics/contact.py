"""Hertz line contact of two cylinders with parallel axes, as formulas (Johnson, Contact Mechanics, 1985, chapter 4).

The load is even over the length; all take numbers or arrays. On a plane surface the effective radius is the roller's own; on the
profile of a cam see ``cam.effective_radius``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.expression import pi
from diecut_report.formulas.formula import formula


@formula
def effective_modulus_alike(elastic_modulus: Any, poisson_ratio: Any) -> Any:
    """E*, modulus of the contact of two bodies of one material."""
    return elastic_modulus / (2 * (1 - poisson_ratio**2))


@formula
def contact_pressure(force: Any, effective_modulus: Any, effective_radius: Any, length: Any) -> Any:
    """Greatest pressure in the middle of the contact, for a force in either direction."""
    return np.sqrt(abs(force) * effective_modulus / (pi * effective_radius * length))


@formula
def contact_half_width(force: Any, effective_modulus: Any, effective_radius: Any, length: Any) -> Any:
    """Half the width of the contact, along the motion."""
    return 2 * np.sqrt(abs(force) * effective_radius / (pi * effective_modulus * length))


@formula
def required_length(force: Any, effective_modulus: Any, effective_radius: Any, allowable_pressure: Any) -> Any:
    """Length of contact with which a force presses with the allowed pressure."""
    return abs(force) * effective_modulus / (pi * effective_radius * allowable_pressure**2)


# What the grippers of a conveyor have to hold: the sheet's own inertia.


@formula
def sheet_mass(grammage: Any, sheet_length: Any, sheet_width: Any) -> Any:
    """Mass of a sheet."""
    return grammage * sheet_length * sheet_width


@formula
def sheet_force(sheet_mass: Any, sheet_acceleration_max: Any) -> Any:
    """Force with which a sheet pulls at its grippers at its greatest acceleration."""
    return sheet_mass * sheet_acceleration_max
