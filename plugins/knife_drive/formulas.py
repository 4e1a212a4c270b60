"""Formulas of the folding knife's drives; those of slider-crank and four-bar are in ``mechanics``."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def planetary_velocity(crank_angle: Any, carrier_radius: Any, crank_speed: Any) -> Any:
    """Velocity of the edge, upwards."""
    return 2 * carrier_radius * crank_speed * np.cos(crank_angle)


@formula
def planetary_acceleration(crank_angle: Any, carrier_radius: Any, crank_speed: Any) -> Any:
    """Acceleration of the edge, upwards."""
    return -2 * carrier_radius * crank_speed**2 * np.sin(crank_angle)


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
def holds(flag: Any) -> Any:
    """Whether a flag is set."""
    return flag > 0
