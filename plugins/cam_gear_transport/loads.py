"""Formulas of torque, forces and the rollers' places."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def gear_torque(conveyor_mass: Any, sheet_acceleration: Any, sheet_step: Any) -> Any:
    """Torque at the gear's shaft that moves the conveyor."""
    return conveyor_mass * sheet_acceleration * sheet_step / (2 * np.pi)


@formula
def tooth_force(gear_torque: Any, gear_radius: Any) -> Any:
    """Tangential force between the teeth of sector and gear."""
    return gear_torque / gear_radius


@formula
def rocker_moment(sector_inertia: Any, sector_acceleration: Any, tooth_force: Any, sector_radius: Any) -> Any:
    """Moment about O₃ that the cams give the rocker: it accelerates the sector and bears the teeth's reaction."""
    return sector_inertia * sector_acceleration - tooth_force * sector_radius


@formula
def carried_moment(rocker_moment: Any, arm_direction: Any) -> Any:
    """Part of the moment that this roller's cam gives: it can only push the roller outwards."""
    asked = -np.sign(np.sin(arm_direction)) * rocker_moment
    return (asked + abs(asked)) / 2


@formula
def lowest_direction(arm_angle: Any, sector_stop_sweep: Any) -> Any:
    """Direction of an arm at the start of phase I."""
    return arm_angle - sector_stop_sweep / 2


@formula
def highest_direction(lowest: Any, sector_sweep: Any) -> Any:
    """Direction of an arm at the end of phase III."""
    return lowest + sector_sweep


@formula
def stays_on_one_side(lowest: Any, highest: Any) -> Any:
    """Whether an arm stays on one side of the line O₁O₃ (its sweep is below half a turn)."""
    return np.sin(lowest) * np.sin(highest) > 1e-12  # on the line itself the cams could not move the arm
