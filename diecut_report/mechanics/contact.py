"""Hertz line contact of two cylinders with parallel axes, as formulas (Johnson, Contact Mechanics, 1985, chapter 4).

A roller of one radius on a surface that is convex, plane or concave along its motion; the load is even over the length.
All take numbers or arrays. A plane surface needs no effective radius of its own: it is the roller's.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.expressions import formula


@formula
def effective_modulus(
    elastic_modulus: Any, poisson_ratio: Any, other_elastic_modulus: Any, other_poisson_ratio: Any
) -> Any:
    """E*, modulus of the contact of two materials."""
    return 1 / ((1 - poisson_ratio**2) / elastic_modulus + (1 - other_poisson_ratio**2) / other_elastic_modulus)


@formula
def effective_modulus_alike(elastic_modulus: Any, poisson_ratio: Any) -> Any:
    """E*, modulus of the contact of two bodies of one material."""
    return elastic_modulus / (2 * (1 - poisson_ratio**2))


@formula
def effective_radius_convex(roller_radius: Any, surface_radius: Any) -> Any:
    """Effective radius of a roller on a convex surface."""
    return roller_radius * surface_radius / (surface_radius + roller_radius)


@formula
def effective_radius_concave(roller_radius: Any, surface_radius: Any) -> Any:
    """Effective radius of a roller in a concave surface, whose radius is the greater one."""
    return roller_radius * surface_radius / (surface_radius - roller_radius)


@formula
def effective_radius(roller_radius: Any, surface_curvature: Any) -> Any:
    """Effective radius of a roller on a surface of any curvature: above zero convex, zero plane, below zero concave."""
    return roller_radius / (1 + roller_radius * surface_curvature)


@formula
def contact_pressure(force: Any, effective_modulus: Any, effective_radius: Any, length: Any) -> Any:
    """Greatest pressure in the middle of the contact, for a force in either direction."""
    return np.sqrt(abs(force) * effective_modulus / (np.pi * effective_radius * length))


@formula
def contact_half_width(force: Any, effective_modulus: Any, effective_radius: Any, length: Any) -> Any:
    """Half the width of the contact, along the motion."""
    return 2 * np.sqrt(abs(force) * effective_radius / (np.pi * effective_modulus * length))


@formula
def allowed_force(allowable_pressure: Any, effective_modulus: Any, effective_radius: Any, length: Any) -> Any:
    """Force at which the pressure reaches the allowed one."""
    return np.pi * effective_radius * length * allowable_pressure**2 / effective_modulus


@formula
def required_length(force: Any, effective_modulus: Any, effective_radius: Any, allowable_pressure: Any) -> Any:
    """Length of contact with which a force presses with the allowed pressure."""
    return abs(force) * effective_modulus / (np.pi * effective_radius * allowable_pressure**2)
