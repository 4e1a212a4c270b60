"""Formulas of the platen press; those of the slider-crank are in ``mechanics.slider_crank``."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import GRAVITY, formula
from diecut_report.mechanics.slider_crank import inner_arm_first_order


@formula
def friction_arm(
    friction_platen_pin: Any,
    friction_crank_pin: Any,
    friction_journal: Any,
    platen_pin_radius: Any,
    crank_pin_radius: Any,
    journal_radius: Any,
    lambda_ratio: Any,
) -> Any:
    """Arm of the joints' friction at the dead centre."""
    crank_pin = friction_crank_pin * crank_pin_radius * (1 - lambda_ratio)
    return friction_platen_pin * platen_pin_radius * lambda_ratio + crank_pin + friction_journal * journal_radius


@formula
def joint_arm(
    friction_platen_pin: Any,
    friction_crank_pin: Any,
    friction_journal: Any,
    platen_pin_radius: Any,
    crank_pin_radius: Any,
    journal_radius: Any,
    rod_speed_ratio: Any,
    rod_angle: Any,
) -> Any:
    """Arm of the joints' friction for each unit of the rods' force along the guides."""
    crank_pin = friction_crank_pin * crank_pin_radius * abs(1 - rod_speed_ratio) / np.cos(rod_angle)
    return (
        friction_platen_pin * platen_pin_radius * abs(rod_speed_ratio) + crank_pin + friction_journal * journal_radius
    )


@formula
def true_travel(platen_displacement: Any, material_thickness: Any, drive_deformation: Any) -> Any:
    """Distance of the platen from the dead centre of the unloaded drive while it cuts and the rods stretch."""
    share = material_thickness / (material_thickness + drive_deformation)
    return drive_deformation + platen_displacement * share


@formula
def stretched_length(standing_distance: Any, crank_radius: Any, crank_angle: Any) -> Any:
    """Distance between crank pin and platen pin while the platen stands."""
    along = 2 * standing_distance * crank_radius * np.cos(crank_angle)
    return np.sqrt(standing_distance**2 + crank_radius**2 + along)


@formula
def weight_torque(
    friction_guide: Any, platen_mass: Any, offset_weight: Any, guide_length: Any, velocity_max: Any, crank_speed: Any
) -> Any:
    """The most that the guides' friction under the platen's weight alone can ask for."""
    weight = platen_mass * GRAVITY
    return 2 * friction_guide * weight * abs(offset_weight) * velocity_max / (guide_length * crank_speed)


@formula
def torque_as_printed(
    force: Any,
    crank_angle: Any,
    crank_radius: Any,
    lambda_ratio: Any,
    material_thickness: Any,
    drive_deformation: Any,
    friction_arm: Any,
) -> Any:
    """Torque with the platen's true speed for the arm of the rods' force."""
    share = material_thickness / (material_thickness + drive_deformation)
    return force * (abs(inner_arm_first_order(crank_angle, crank_radius, lambda_ratio)) * share + friction_arm)


@formula
def deformation_limit(rod_length: Any, crank_radius: Any, friction_arm: Any) -> Any:
    """Stretch of the drive at which the relaxed rods pass the shaft at the friction's arm."""
    along = rod_length - np.sqrt(crank_radius**2 - friction_arm**2)
    return np.sqrt(along**2 + friction_arm**2) - (rod_length - crank_radius)
