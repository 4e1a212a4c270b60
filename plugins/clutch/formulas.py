"""Formulas of the friction clutch: forces of the wedge, lining, travel, heat and temperature."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula


@formula
def wedge_normal_force(pressing_force: Any, wedge_angle: Any, wedge_friction: Any) -> Any:
    """Force square to the cone's face under all shoes together."""
    return pressing_force / (np.cos(wedge_angle) - wedge_friction * np.sin(wedge_angle))


@formula
def friction_angle(wedge_friction: Any) -> Any:
    """Angle of friction; a wedge up to it locks itself."""
    return np.arctan(wedge_friction)


@formula
def lining_area(shoe_radius: Any, lining_width: Any, shoe_coverage: Any) -> Any:
    """Area of the lining."""
    return 2 * np.pi * shoe_radius * lining_width * shoe_coverage


@formula
def slip_time(driven_inertia: Any, speed: Any, accelerating_torque: Any) -> Any:
    """Time until the driven side runs with the driving shaft."""
    return driven_inertia * as_number(speed) / accelerating_torque


@formula
def engagement_energy(driven_inertia: Any, speed: Any, design_torque: Any, accelerating_torque: Any) -> Any:
    """Heat of one engagement against a shaft at constant speed."""
    return driven_inertia * speed**2 * design_torque / (2 * accelerating_torque)


@formula
def heat_flux(design_torque: Any, speed: Any, shoe_radius: Any, lining_width: Any) -> Any:
    """Heat flux into the drum's swept surface as slipping begins."""
    return design_torque * speed / (2 * np.pi * shoe_radius * lining_width)


@formula
def surface_rise(heat_flux: Any, slip_time: Any, conductivity: Any, density: Any, specific_heat: Any) -> Any:
    """Greatest rise of a thick body's surface under a flux that falls evenly to zero; it is reached at half the time."""
    return 4 / 3 * heat_flux * np.sqrt(slip_time / (2 * as_number(np.pi) * conductivity * density * specific_heat))


@formula
def penetration_depth(slip_time: Any, conductivity: Any, density: Any, specific_heat: Any) -> Any:
    """Depth that the heat reaches while the clutch slips."""
    return 2 * np.sqrt(conductivity * slip_time / (density * specific_heat))


@formula
def time_constant(mass: Any, specific_heat: Any, heat_transfer_coefficient: Any, area: Any) -> Any:
    """Time constant with which the drum cools."""
    return mass * specific_heat / (heat_transfer_coefficient * area)
