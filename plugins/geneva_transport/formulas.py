"""Formulas of the Geneva drive's geometry and motion."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import arccos, as_angle, formula, pi


@formula
def crank_ratio(slots: Any) -> Any:
    """Crank radius to centre distance: the roller enters along the slot."""
    return np.sin(pi / slots)


@formula
def engagement_half_angle(slots: Any) -> Any:
    """Crank angle from the middle of the motion to its end."""
    return pi / 2 - pi / slots


@formula
def cutout_angle(slots: Any) -> Any:
    """Crank angle of the whole engagement, which the locking disc's cut-out takes."""
    return 2 * engagement_half_angle(slots)


@formula
def locking_play(locking_radius: Any, disc_radius: Any, center_distance: Any, cover: Any) -> Any:
    """Angle by which the wheel turns until its locking arc meets the end of the disc's arc, a cover past the line of centres."""
    room = locking_radius**2 - disc_radius**2
    lever = 2 * center_distance * disc_radius * np.sin(cover)
    lift = 4 * center_distance * (center_distance - disc_radius * np.cos(cover))
    return 2 * np.arctan2(room, lever + np.sqrt(lever**2 + room * (lift - room)))


@formula
def disc_for_play(locking_radius: Any, center_distance: Any, cover: Any, play: Any) -> Any:
    """Radius of the disc that lets the wheel turn by a play."""
    half = 2 * center_distance * np.sin(play / 2)
    inward = half * np.sin(cover - play / 2)
    return np.sqrt(np.maximum(inward**2 + locking_radius**2 - half**2, 0)) - inward


@formula
def motion_fraction(slots: Any) -> Any:
    """Share of a turn in which the wheel turns."""
    return (slots - 2) / (2 * slots)


@formula
def dwell_fraction(slots: Any) -> Any:
    """Share of a turn in which it dwells."""
    return (slots + 2) / (2 * slots)


@formula
def acceleration_peak_angle(crank_ratio: Any) -> Any:
    """Crank angle from the middle of the motion at which the wheel's acceleration is greatest."""
    term = (1 + crank_ratio**2) / (4 * crank_ratio)
    return np.arccos(np.sqrt(term**2 + 2) - term)


@formula
def wheel_angle(angle: Any, turns: Any, step_angle: Any, crank_ratio: Any) -> Any:
    """Angle of the wheel from the middle of its motion."""
    return turns * step_angle + np.arctan2(crank_ratio * np.sin(angle), 1 - crank_ratio * np.cos(angle))


@formula
def speed_ratio(angle: Any, crank_ratio: Any) -> Any:
    """Angular speed of the wheel to the crank's."""
    return crank_ratio * (np.cos(angle) - crank_ratio) / (1 - 2 * crank_ratio * np.cos(angle) + crank_ratio**2)


@formula
def acceleration_ratio(angle: Any, crank_ratio: Any) -> Any:
    """Angular acceleration of the wheel to the square of the crank's speed, which is constant."""
    distance_squared = 1 - 2 * crank_ratio * np.cos(angle) + crank_ratio**2
    return -crank_ratio * (1 - crank_ratio**2) * np.sin(angle) / distance_squared**2


@formula
def rate(ratio: Any, crank_speed: Any) -> Any:
    """Angular speed of the wheel."""
    return ratio * crank_speed


@formula
def rate_of_rate(ratio: Any, crank_speed: Any) -> Any:
    """Angular acceleration of the wheel."""
    return as_angle(ratio * crank_speed**2)


@formula
def travel(angle: Any, travel_radius: Any) -> Any:
    """Way, speed or acceleration of the conveyor from the wheel's."""
    return angle * travel_radius


@formula
def travel_rate(ratio: Any, crank_speed: Any, travel_radius: Any) -> Any:
    """Speed of the conveyor."""
    return ratio * crank_speed * travel_radius


@formula
def travel_acceleration(ratio: Any, crank_speed: Any, travel_radius: Any) -> Any:
    """Acceleration of the conveyor."""
    return ratio * crank_speed**2 * travel_radius


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
def roller_distance(crank_angle: Any, center_distance: Any, crank_ratio: Any) -> Any:
    """Distance of the roller from the wheel's axis."""
    return center_distance * np.sqrt(1 - 2 * crank_ratio * np.cos(crank_angle) + crank_ratio**2)


@formula
def roller_force(driven_inertia: Any, wheel_acceleration: Any, roller_distance: Any) -> Any:
    """Force of the roller on the slot's flank, square to the slot."""
    return driven_inertia * wheel_acceleration / roller_distance


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
def tip_half_angle(center_distance: Any, rim_radius: Any, locking_radius: Any) -> Any:
    """Half the angle of a locking arc at the wheel's axis; zero where it does not reach the rim."""
    cosine = (center_distance**2 + rim_radius**2 - locking_radius**2) / (2 * center_distance * rim_radius)
    return arccos(np.minimum(cosine, 1))
