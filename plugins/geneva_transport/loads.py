"""Formulas of the Geneva drive's torque, roller force and locking."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import arccos, formula


@formula
def is_driven(acceleration_ratio: Any) -> Any:
    """Whether the roller drives the wheel, which always turns the same way."""
    return acceleration_ratio >= 0


@formula
def driven_with_losses(driven_inertia: Any, own_inertia: Any, efficiency: Any) -> Any:
    """Inertia that the roller feels where it drives the wheel: what is behind the gear by its efficiency more."""
    return own_inertia + (driven_inertia - own_inertia) / efficiency


@formula
def braked_with_losses(driven_inertia: Any, own_inertia: Any, efficiency: Any) -> Any:
    """Inertia that the roller feels where it brakes the wheel: what is behind the gear by its efficiency less."""
    return own_inertia + (driven_inertia - own_inertia) * efficiency


@formula
def driving_torque(driven_inertia: Any, crank_speed: Any, acceleration_ratio: Any, speed_ratio: Any) -> Any:
    """Torque at the crank that moves the wheel's inertia."""
    return driven_inertia * crank_speed**2 * acceleration_ratio * speed_ratio


@formula
def energy_lost(kinetic_energy_max: Any, driven_inertia: Any, own_inertia: Any, efficiency: Any) -> Any:
    """Energy that the gear takes while it drives what is behind it, and while it is driven by that."""
    return kinetic_energy_max * (1 - own_inertia / driven_inertia) * (1 / efficiency - efficiency)


@formula
def roller_distance(crank_angle: Any, center_distance: Any, crank_ratio: Any) -> Any:
    """Distance of the roller from the wheel's axis."""
    return center_distance * np.sqrt(1 - 2 * crank_ratio * np.cos(crank_angle) + crank_ratio**2)


@formula
def roller_force(driven_inertia: Any, wheel_acceleration: Any, roller_distance: Any) -> Any:
    """Force of the roller on the slot's flank, square to the slot."""
    return driven_inertia * wheel_acceleration / roller_distance


@formula
def force_along(
    roller_force: Any, crank_angle: Any, center_distance: Any, crank_ratio: Any, roller_distance: Any
) -> Any:
    """Force of the wheel on the crank along the line of centres, towards the wheel."""
    return -roller_force * center_distance * crank_ratio * np.sin(crank_angle) / roller_distance


@formula
def force_across(
    roller_force: Any, crank_angle: Any, center_distance: Any, crank_ratio: Any, roller_distance: Any
) -> Any:
    """Force of the wheel on the crank across the line of centres, the way the crank turns where it is nearest to the wheel."""
    return -roller_force * center_distance * (1 - crank_ratio * np.cos(crank_angle)) / roller_distance


@formula
def flank_distance(crank_radius: Any, roller_radius: Any) -> Any:
    """Distance of the nearest flanks of the two neighbouring slots from the crank's axis in the dwell."""
    return crank_radius - roller_radius


@formula
def rim_distance(center_distance: Any, rim_radius: Any) -> Any:
    """Distance of the wheel's rim, before its arcs are cut, from the crank's axis."""
    return center_distance - rim_radius


@formula
def thick_tip(crank_radius: Any, roller_radius: Any) -> Any:
    """Radius of the locking arcs with an arm's tip as thick as the roller."""
    return crank_radius - 3 * roller_radius


@formula
def half_crank(crank_radius: Any) -> Any:
    """Radius of the locking arcs, half the crank's."""
    return crank_radius / 2


@formula
def halfway(flank_distance: Any, rim_distance: Any) -> Any:
    """Radius of the locking arcs halfway between rim and flank."""
    return (flank_distance + rim_distance) / 2


@formula
def leaves_thick_tip(crank_radius: Any, roller_radius: Any, flank_distance: Any, rim_distance: Any) -> Any:
    """Whether a tip as thick as the roller leaves the locking arc both its least radii."""
    least = np.maximum(half_crank(crank_radius), halfway(flank_distance, rim_distance))
    return thick_tip(crank_radius, roller_radius) >= least


@formula
def is_deep_enough(crank_radius: Any, flank_distance: Any, rim_distance: Any) -> Any:
    """Whether half the crank's radius reaches halfway from rim to flank."""
    return half_crank(crank_radius) >= halfway(flank_distance, rim_distance)


@formula
def tip_half_angle(center_distance: Any, rim_radius: Any, locking_radius: Any) -> Any:
    """Half the angle of a locking arc at the wheel's axis; zero where it does not reach the rim."""
    cosine = (center_distance**2 + rim_radius**2 - locking_radius**2) / (2 * center_distance * rim_radius)
    return arccos(np.minimum(cosine, 1))


@formula
def corner_place(wheel_angle: Any, turns: Any, step_angle: Any, tip_half_angle: Any, slots: Any) -> Any:
    """Angle of the corner between locking arc and rim at the wheel's axis, from the line of centres."""
    return wheel_angle - turns * step_angle + tip_half_angle - np.pi / slots


@formula
def corner_along(center_distance: Any, rim_radius: Any, corner_place: Any, crank_angle: Any) -> Any:
    """Distance of the corner from the crank's axis, along the crank."""
    return center_distance * np.cos(crank_angle) - rim_radius * np.cos(crank_angle + corner_place)
