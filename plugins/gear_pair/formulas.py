"""Formulas of the gear pair's rating: each is bound to the pinion and to the wheel (ISO 6336-2 and -3:2006, method B)."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula
from diecut_report.mechanics.involute import involute

# --- geometry --------------------------------------------------------------------------------------------------------


@formula
def least_distance(module: Any, teeth_1: Any, teeth_2: Any, helix_angle: Any, alpha: Any) -> Any:
    """Distance of the axes at which the base circles touch: the working pressure angle is 0."""
    return module * (teeth_1 + teeth_2) * np.cos(alpha) / (2 * np.cos(helix_angle))


@formula
def shift_of_distance(
    working_pressure_angle: Any, alpha: Any, pressure_angle: Any, shift_1: Any, teeth_1: Any, teeth_2: Any
) -> Any:
    """Profile shift of the wheel with which the pair has no backlash at its working pressure angle."""
    turned = involute(working_pressure_angle) - involute(alpha)
    return turned * (teeth_1 + teeth_2) / (2 * np.tan(pressure_angle)) - shift_1


@formula
def tip_above_base(teeth: Any, alpha: Any, helix_angle: Any, tip_height: Any) -> Any:
    """Whether the tip circle lies outside the base circle."""
    return teeth + 2 * tip_height * np.cos(helix_angle) > teeth * np.cos(alpha)


@formula
def distance_coefficient(teeth_1: Any, teeth_2: Any, helix_angle: Any, alpha: Any, working_angle: Any) -> Any:
    """How far the axes are drawn apart beyond their reference distance, in modules."""
    return (teeth_1 + teeth_2) / (2 * np.cos(helix_angle)) * (np.cos(alpha) / np.cos(working_angle) - 1)


@formula
def reference_diameter(module: Any, teeth: Any, helix_angle: Any) -> Any:
    """Diameter of the reference circle."""
    return module * teeth / np.cos(helix_angle)


@formula
def tip_thickness(tip_diameter: Any, half_thickness: Any, helix_angle: Any, reference_diameter: Any) -> Any:
    """Normal thickness of the tooth at its tip; ``half_thickness`` is half of it as an angle."""
    helix_at_tip = np.arctan(np.tan(helix_angle) * tip_diameter / reference_diameter)
    return tip_diameter * half_thickness * np.cos(helix_at_tip)


# --- pitting ---------------------------------------------------------------------------------------------------------


@formula
def zone_factor(base_helix_angle: Any, working_angle: Any, alpha: Any) -> Any:
    """Zone factor Z_H: curvature of the flanks at the pitch point."""
    return np.sqrt(2 * np.cos(base_helix_angle) * np.cos(working_angle) / (np.cos(alpha) ** 2 * np.sin(working_angle)))


@formula
def elasticity(elastic_modulus_1: Any, elastic_modulus_2: Any) -> Any:
    """Square of the elasticity factor Z_E, Poisson's ratio being 0.3."""
    return 1 / (as_number(np.pi) * ((1 - 0.3**2) / elastic_modulus_1 + (1 - 0.3**2) / elastic_modulus_2))


@formula
def single_contact(
    working_angle: Any, tip_angle: Any, teeth: Any, tip_angle_mate: Any, teeth_mate: Any, contact_ratio: Any
) -> Any:
    """M: flank pressure at the gear's inner point of single contact, to that at the pitch point, for spur teeth."""
    own = np.tan(tip_angle) - 2 * as_number(np.pi) / teeth
    mate = np.tan(tip_angle_mate) - (contact_ratio - 1) * 2 * as_number(np.pi) / teeth_mate
    return np.tan(working_angle) / np.sqrt(own * mate)


@formula
def contact_factor(single_contact: Any, overlap_ratio: Any) -> Any:
    """Z_B of the pinion, Z_D of the wheel: M where it is above 1, less for helical teeth."""
    return np.maximum(1, single_contact - np.minimum(overlap_ratio, 1) * (single_contact - 1))


@formula
def contact_ratio_factor(contact_ratio: Any, overlap_ratio: Any) -> Any:
    """Contact ratio factor Z_ε, which is √(1/ε_α) from an overlap ratio of 1 on."""
    overlap = np.minimum(overlap_ratio, 1)
    return np.sqrt((4 - contact_ratio) * (1 - overlap) / 3 + overlap / contact_ratio)


@formula
def nominal_contact_stress(
    zone_factor: Any, elasticity: Any, contact_ratio_factor: Any, helix_factor: Any, force: Any, ratio: Any, diameter: Any, face_width: Any
) -> Any:  # fmt: skip
    """Contact stress at the pitch point of a pair without errors under the nominal load."""
    pressure = elasticity * abs(force) * (ratio + 1) / (diameter * face_width * ratio)
    return zone_factor * contact_ratio_factor * helix_factor * np.sqrt(pressure)


@formula
def contact_stress(
    nominal: Any, contact_factor: Any, application: Any, dynamic: Any, face: Any, transverse: Any
) -> Any:
    """Contact stress with what raises it."""
    return contact_factor * nominal * np.sqrt(application * dynamic * face * transverse)


@formula
def pitting_safety(limit: Any, life: Any, film: Any, stress: Any) -> Any:
    """Safety against pitting."""
    return limit * life * film / stress


# --- root: lengths in normal modules ---------------------------------------------------------------------------------


@formula
def virtual_teeth(teeth: Any, base_helix_angle: Any, helix_angle: Any) -> Any:
    """Teeth of the virtual spur gear of the normal section."""
    return teeth / (np.cos(base_helix_angle) ** 2 * np.cos(helix_angle))


@formula
def half_tip_width(dedendum: Any, pressure_angle: Any, root_radius: Any) -> Any:
    """E: distance of the rack's rounding centre from the middle of its tooth."""
    beside = dedendum * np.tan(pressure_angle) + (1 - np.sin(pressure_angle)) * root_radius / np.cos(pressure_angle)
    return as_number(np.pi) / 4 - beside


@formula
def root_chord(virtual_teeth: Any, theta: Any, center_height: Any, root_radius: Any) -> Any:
    """Chord of the root at the critical section, where tangents at 30° touch it."""
    return virtual_teeth * np.sin(np.pi / 3 - theta) + np.sqrt(3) * (center_height / np.cos(theta) - root_radius)


@formula
def fillet_radius(virtual_teeth: Any, theta: Any, center_height: Any, root_radius: Any) -> Any:
    """Radius of the root's curvature there."""
    return root_radius + 2 * center_height**2 / (
        np.cos(theta) * (virtual_teeth * np.cos(theta) ** 2 - 2 * center_height)
    )


@formula
def single_contact_diameter(
    virtual_teeth: Any, tip_height: Any, pressure_angle: Any, virtual_contact_ratio: Any
) -> Any:
    """Diameter of the outer point of single contact, where the whole load acts."""
    base = virtual_teeth * np.cos(pressure_angle)
    at_tip = np.sqrt((virtual_teeth + 2 * tip_height) ** 2 - base**2) / 2
    there = at_tip - as_number(np.pi) * np.cos(pressure_angle) * (virtual_contact_ratio - 1)
    return 2 * np.sqrt(there**2 + base**2 / 4)


@formula
def load_arm(
    half_thickness: Any, load_angle: Any, diameter: Any, virtual_teeth: Any, theta: Any, center_height: Any, root_radius: Any
) -> Any:  # fmt: skip
    """Arm of the load about the critical section: from where its line crosses the tooth's centre line."""
    crossing = (np.cos(half_thickness) - np.sin(half_thickness) * np.tan(load_angle)) * diameter
    section = virtual_teeth * np.cos(np.pi / 3 - theta) + center_height / np.cos(theta) - root_radius
    return (crossing - section) / 2


@formula
def form_factor(load_arm: Any, load_angle: Any, root_chord: Any, pressure_angle: Any) -> Any:
    """Form factor Y_F."""
    return 6 * load_arm * np.cos(load_angle) / (root_chord**2 * np.cos(pressure_angle))


@formula
def stress_factor(root_chord: Any, load_arm: Any, notch_parameter: Any) -> Any:
    """Stress correction factor Y_S."""
    slender = root_chord / load_arm
    return (1.2 + 0.13 * slender) * notch_parameter ** (1 / (1.21 + 2.3 / slender))


@formula
def root_stress(nominal: Any, application: Any, dynamic: Any, face: Any, transverse: Any) -> Any:
    """Root stress with what raises it."""
    return nominal * application * dynamic * face * transverse


@formula
def worse_notch(notch_parameter_1: Any, notch_parameter_2: Any) -> Any:
    """The parameter of the two that leaves the range 1 … 8, or comes nearest to its end."""
    least = np.minimum(notch_parameter_1, notch_parameter_2)
    return np.where(least < 1, least, np.maximum(notch_parameter_1, notch_parameter_2))
