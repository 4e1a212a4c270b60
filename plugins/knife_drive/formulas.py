"""Formulas of the folding knife's drives; those of slider-crank and four-bar are in ``mechanics``."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_angle, formula


@formula
def roller_velocity(roller_diameter: Any, roller_ratio: Any, cycle_time: Any) -> Any:
    """Speed of the rollers' surface."""
    return np.pi * roller_diameter * roller_ratio / cycle_time


@formula
def time_of_angle(angle: Any, cycle_time: Any) -> Any:
    """Time in which the shaft turns by an angle."""
    return angle * cycle_time / (2 * np.pi)


@formula
def planetary_stroke(carrier_radius: Any) -> Any:
    """Stroke of the edge: carrier and arm in line, up and down."""
    return 4 * carrier_radius


@formula
def planetary_displacement(crank_angle: Any, carrier_radius: Any) -> Any:
    """Displacement of the edge from the carrier's axis, upwards."""
    return 2 * carrier_radius * np.sin(crank_angle)


@formula
def planetary_velocity(crank_angle: Any, carrier_radius: Any, crank_speed: Any) -> Any:
    """Velocity of the edge, upwards."""
    return 2 * carrier_radius * crank_speed * np.cos(crank_angle)


@formula
def planetary_acceleration(crank_angle: Any, carrier_radius: Any, crank_speed: Any) -> Any:
    """Acceleration of the edge, upwards."""
    return -2 * carrier_radius * crank_speed**2 * np.sin(crank_angle)


@formula
def planetary_working_angle(working_depth: Any, carrier_radius: Any) -> Any:
    """Turn of the carrier from the contact at the table to the lowest point."""
    return 2 * np.arcsin(np.sqrt(working_depth / (4 * carrier_radius)))


@formula
def turn_later(angle: Any) -> Any:
    """The same crank angle a turn later."""
    return angle + 2 * np.pi


@formula
def slider_end_acceleration(crank_radius: Any, rod_ratio: Any, crank_speed: Any) -> Any:
    """Acceleration of the edge at its lowest point, crank and rod extended."""
    return crank_radius * crank_speed**2 * (1 + 1 / rod_ratio)


@formula
def raised_direction(outer_direction: Any, working_depth: Any, knife_arm: Any) -> Any:
    """Direction of the rocker with the edge at the table, the lowest point being at the outer dead centre."""
    return outer_direction + as_angle(working_depth / knife_arm)


@formula
def lowered_direction(outer_direction: Any, swing_angle: Any, working_depth: Any, knife_arm: Any) -> Any:
    """Direction of the rocker with the edge at the table, the lowest point being at the inner dead centre."""
    return outer_direction + swing_angle - as_angle(working_depth / knife_arm)


@formula
def angle_from_inner(outer_direction: Any, swing_angle: Any, rocker_direction: Any) -> Any:
    """Angle of the rocker from its inner dead centre."""
    return outer_direction + swing_angle - rocker_direction


@formula
def edge_velocity(speed_ratio: Any, crank_speed: Any, knife_arm: Any) -> Any:
    """Velocity of the edge, upwards, where the rocker's angle grows as it rises."""
    return speed_ratio * crank_speed * knife_arm


@formula
def edge_velocity_inner(speed_ratio: Any, crank_speed: Any, knife_arm: Any) -> Any:
    """Velocity of the edge, upwards, where the rocker's angle falls as it rises."""
    return -speed_ratio * crank_speed * knife_arm


@formula
def edge_acceleration(acceleration_ratio: Any, crank_speed: Any, knife_arm: Any) -> Any:
    """Acceleration of the edge, upwards, where the rocker's angle grows as it rises."""
    return acceleration_ratio * crank_speed**2 * knife_arm


@formula
def edge_acceleration_inner(acceleration_ratio: Any, crank_speed: Any, knife_arm: Any) -> Any:
    """Acceleration of the edge, upwards, where the rocker's angle falls as it rises."""
    return -acceleration_ratio * crank_speed**2 * knife_arm


@formula
def longer_by_one(ratio: Any) -> Any:
    """Crank and coupler extended, in crank lengths."""
    return ratio + 1


@formula
def shorter_by_one(ratio: Any) -> Any:
    """Crank folded over the coupler, in crank lengths."""
    return ratio - 1


@formula
def end_acceleration_outer(
    knife_arm: Any, crank_speed: Any, coupler_ratio: Any, rocker_ratio: Any, dead_angle: Any
) -> Any:
    """Acceleration of the edge at the outer dead centre, where the rocker stands."""
    return knife_arm * crank_speed**2 * (1 + 1 / coupler_ratio) / (rocker_ratio * np.sin(dead_angle))


@formula
def end_acceleration_inner(
    knife_arm: Any, crank_speed: Any, coupler_ratio: Any, rocker_ratio: Any, dead_angle: Any
) -> Any:
    """Acceleration of the edge at the inner dead centre, where the rocker stands."""
    return knife_arm * crank_speed**2 * (1 - 1 / coupler_ratio) / (rocker_ratio * np.sin(dead_angle))


@formula
def holds(flag: Any) -> Any:
    """Whether a flag is set."""
    return flag > 0


@formula
def least_of_three(first: Any, second: Any, third: Any) -> Any:
    """The least of three quantities."""
    return np.minimum(np.minimum(first, second), third)


@formula
def is_best_and_allowed(own: Any, best: Any, allowed: Any) -> Any:
    """Whether a quantity is not above the best one, and allowed."""
    return (own <= best) & (best <= allowed)
