"""Formulas of the friction clutch: forces of the wedge, lining, travel, heat and temperature."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula


@formula
def cosine(angle: Any) -> Any:
    """Cosine of an angle."""
    return np.cos(angle)


@formula
def held_by_friction(wedge_friction: Any, wedge_angle: Any) -> Any:
    """Share of the cone's normal force that the wedge's friction keeps from the shoes."""
    return wedge_friction * np.sin(wedge_angle)


@formula
def widest_wedge(wedge_friction: Any) -> Any:
    """Wedge angle from which the cone no longer lifts the shoes."""
    return np.pi / 2 - np.arctan(wedge_friction)


@formula
def greatest_friction(wedge_angle: Any) -> Any:
    """Wedge friction from which the cone no longer lifts the shoes."""
    return 1 / np.tan(wedge_angle)


@formula
def wedge_normal_force(pressing_force: Any, wedge_angle: Any, wedge_friction: Any) -> Any:
    """Force square to the cone's face under all shoes together."""
    return pressing_force / (np.cos(wedge_angle) - wedge_friction * np.sin(wedge_angle))


@formula
def engagement_force(wedge_normal_force: Any, wedge_angle: Any, wedge_friction: Any) -> Any:
    """Axial force that drives the cone in, against the normal force and its friction."""
    return wedge_normal_force * (np.sin(wedge_angle) + wedge_friction * np.cos(wedge_angle))


@formula
def friction_angle(wedge_friction: Any) -> Any:
    """Angle of friction; a wedge up to it locks itself."""
    return np.arctan(wedge_friction)


@formula
def slope(wedge_angle: Any) -> Any:
    """Slope of the cone's face; friction from it on locks the wedge."""
    return np.tan(wedge_angle)


@formula
def locks_itself(wedge_angle: Any, wedge_friction: Any) -> Any:
    """Whether friction holds the cone in."""
    return np.tan(wedge_angle) <= wedge_friction


@formula
def release_force(pressing_force: Any, friction_angle: Any, wedge_angle: Any) -> Any:
    """Axial pull that releases the cone, friction now holding it in."""
    return pressing_force * np.tan(friction_angle - wedge_angle)


@formula
def width_at_pressure(pressing_force: Any, shoe_radius: Any, shoe_coverage: Any, allowable_pressure: Any) -> Any:
    """Width of lining that carries the force at a pressure."""
    return pressing_force / (2 * np.pi * shoe_radius * shoe_coverage * allowable_pressure)


@formula
def lining_area(shoe_radius: Any, lining_width: Any, shoe_coverage: Any) -> Any:
    """Area of the lining."""
    return 2 * np.pi * shoe_radius * lining_width * shoe_coverage


@formula
def width_ratio(lining_width: Any, shoe_radius: Any) -> Any:
    """Width of the lining to the drum's diameter."""
    return lining_width / (2 * shoe_radius)


@formula
def radius_of_square_shoes(design_torque: Any, shoe_friction: Any, shoe_coverage: Any, allowable_pressure: Any) -> Any:
    """Radius at which the sized width is as large, half the diameter."""
    return (design_torque / (2 * np.pi * shoe_friction * shoe_coverage * allowable_pressure)) ** (1 / 3)


@formula
def radius_of_given_shoes(lining_width: Any, shoe_radius: Any, shoe_width: Any) -> Any:
    """Radius at which a width is half the diameter, or carries the force at the allowed pressure, whichever is greater."""
    return np.maximum(lining_width, shoe_radius * np.sqrt(shoe_width / lining_width))


@formula
def travel(lift: Any, wedge_angle: Any) -> Any:
    """Axial travel of the cone that lifts the shoes so far."""
    return lift / np.tan(wedge_angle)


@formula
def travel_with_wear(radial_gap: Any, wear_allowance: Any, wedge_angle: Any) -> Any:
    """Axial travel of the cone until the lining is worn."""
    return (radial_gap + wear_allowance) / np.tan(wedge_angle)


@formula
def angle_of_travel(radial_gap: Any, wear_allowance: Any, available_travel: Any) -> Any:
    """Wedge angle with which a travel does for gap and wear."""
    return np.arctan((radial_gap + wear_allowance) / available_travel)


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


@formula
def rise_after_engagement(mass_rise: Any, engagements_per_hour: Any, time_constant: Any) -> Any:
    """Rise right after each engagement, once the drum has warmed up: what is left of all engagements before, summed up."""
    return mass_rise / (1 - np.exp(-1 / (engagements_per_hour * time_constant)))


@formula
def engagements_limit(power_density: Any, lining_area: Any, engagement_energy: Any) -> Any:
    """Engagements in a time that a mean power for each area permits."""
    return power_density * lining_area / engagement_energy
