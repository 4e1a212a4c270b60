"""Formulas of the folding knife's drives; those of slider-crank and four-bar are in ``mechanics``."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_angle, as_number, formula


@formula
def shaft_speed(cylinder_rate: Any, drive_ratio: Any) -> Any:
    """Angular speed of the knife's shaft."""
    return 2 * np.pi * cylinder_rate * drive_ratio


@formula
def turn_time(crank_speed: Any) -> Any:
    """Time of a turn."""
    return 2 * np.pi / crank_speed


@formula
def roller_velocity(roller_diameter: Any, roller_ratio: Any, cycle_time: Any) -> Any:
    """Speed of the rollers' surface."""
    return np.pi * roller_diameter * roller_ratio / cycle_time


@formula
def time_of_angle(angle: Any, cycle_time: Any) -> Any:
    """Time in which the shaft turns by an angle."""
    return angle * cycle_time / (2 * np.pi)


@formula
def signature_interval(cycle_time: Any, drive_ratio: Any) -> Any:
    """Time between two signatures, one for each half turn of the plate cylinder."""
    return cycle_time * drive_ratio / 2


@formula
def roller_time(signature_length: Any, working_depth: Any, roller_velocity: Any) -> Any:
    """Time from the knife's lowest point until the trailing edge has left the table."""
    return (signature_length - working_depth) / roller_velocity


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
def three_quarter_turn() -> Any:
    """Three quarters of a turn."""
    return 3 * np.pi / 2


@formula
def full_turn() -> Any:
    """A full turn."""
    return 2 * np.pi


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
def is_within(crank_angle: Any, lowest_angle: Any, working_angle: Any) -> Any:
    """Whether a crank angle lies within the working stroke: nearer to its middle than half of it."""
    return np.cos(crank_angle - lowest_angle + working_angle / 2) > np.cos(working_angle / 2)


@formula
def holds(flag: Any) -> Any:
    """Whether a flag is set."""
    return flag > 0


@formula
def end_factor(acceleration_end: Any, stroke: Any, crank_speed: Any) -> Any:
    """Acceleration at the lowest point to that of a harmonic motion of the same stroke."""
    return 2 * acceleration_end / (stroke * as_number(crank_speed) ** 2)


@formula
def grip_acceleration(roller_velocity: Any, grip_velocity: Any, grip_time: Any) -> Any:
    """Acceleration that brings the signature from the knife's speed to the rollers'."""
    return (roller_velocity - grip_velocity) / grip_time


@formula
def least_of_three(first: Any, second: Any, third: Any) -> Any:
    """The least of three quantities."""
    return np.minimum(np.minimum(first, second), third)


@formula
def is_best_and_allowed(own: Any, best: Any, allowed: Any) -> Any:
    """Whether a quantity is not above the best one, and allowed."""
    return (own <= best) & (best <= allowed)


@formula
def is_by_stroke(stroke_ratio: Any, factor_ratio: Any) -> Any:
    """Whether the strokes differ more than the factors of the drives."""
    return np.maximum(stroke_ratio, 1 / stroke_ratio) >= np.maximum(factor_ratio, 1 / factor_ratio)
