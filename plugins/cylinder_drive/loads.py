"""Formulas of the drive's motion, moments, torque, energy, clearance and forces."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import GRAVITY, arccos, formula


@formula
def inertia_moment(
    reduced_inertia: Any,
    cylinder_radius: Any,
    static_unbalance: Any,
    cylinder_rotation: Any,
    cylinder_speed: Any,
    cylinder_acceleration: Any,
) -> Any:
    """Moment on the cylinder's axis that its inertia and the weight of its unbalance ask for."""
    varying = reduced_inertia + 2 * cylinder_radius * static_unbalance * np.cos(cylinder_rotation)
    centrifugal = cylinder_radius * static_unbalance * np.sin(cylinder_rotation) * cylinder_speed**2
    weight = GRAVITY * static_unbalance * np.sin(cylinder_rotation)
    return varying * cylinder_acceleration - centrifugal - weight


@formula
def efficiency_behind_rocker(
    efficiency_sector: Any, efficiency_gear: Any, efficiency_chain: Any, efficiency_bearings: Any
) -> Any:
    """Efficiency from the rocker to the cylinder."""
    return efficiency_sector * efficiency_gear * efficiency_chain * efficiency_bearings


@formula
def clear_rotation(half_angle: Any, carriage_clearance: Any, cylinder_radius: Any) -> Any:
    """Rotation from the flat's lowest position at which its lower edge still leaves the clearance."""
    return half_angle - arccos(1 - carriage_clearance / cylinder_radius)


@formula
def length_of(ratio: Any, crank_length: Any) -> Any:
    """Length of a link."""
    return ratio * crank_length


@formula
def flat_arrives(sector_ratio: Any, swing_angle: Any, clear_rotation: Any) -> Any:
    """Whether the flat comes within the clear rotation of its lowest position at the inner dead centre."""
    return abs(sector_ratio * swing_angle - 2 * np.pi) <= clear_rotation


@formula
def flat_leaves(sector_ratio: Any, swing_angle: Any, clear_rotation: Any) -> Any:
    """Whether the cylinder turns beyond the clear rotation at all."""
    return clear_rotation <= sector_ratio * swing_angle


@formula
def far_swing(contact_rotation: Any, sector_ratio: Any, swing_angle: Any) -> Any:
    """Rocker angle at which the flat's other corner leaves the board, no more than the whole swing."""
    return np.minimum((2 * np.pi - contact_rotation) / sector_ratio, swing_angle)


@formula
def touches_board(contact_rotation: Any, sector_ratio: Any, swing_angle: Any) -> Any:
    """Whether the flat clears the board, and the cylinder turns beyond it."""
    return (contact_rotation > 0) & (contact_rotation < sector_ratio * swing_angle)


@formula
def moves_at_all(standstill_swing: Any, swing_angle: Any) -> Any:
    """Whether the rocker swings further than what counts as standstill."""
    return standstill_swing < swing_angle
