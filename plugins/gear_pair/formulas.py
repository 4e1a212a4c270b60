"""Formulas of the gear pair's rating: each is bound to the pinion and to the wheel (ISO 6336-2 and -3:2006, method B)."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Constant, as_number, formula, number, pi
from diecut_report.mechanics.involute import involute

MILLIMETRE = Constant(1e-3, "1 mm", "m")
MICROMETRE = Constant(1e-6, "1 µm", "m")
METRE_PER_SECOND = Constant(1.0, "1 m/s", "m/s")
LINE_LOAD = Constant(1e3, "1 N/mm", "N/m")
MEGAPASCAL = Constant(1e6, "1 MPa", "Pa")
STIFFNESS = Constant(1e9, "1 N/(mm·µm)", "Pa")
STEEL = Constant(206e9, "206 GPa", "Pa")
MIDDLE_DEVIATION = Constant(80e-6, "80 µm", "m")
SMALL_DEVIATION = Constant(40e-6, "40 µm", "m")

# --- geometry --------------------------------------------------------------------------------------------------------


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
def tip_thickness(tip_diameter: Any, half_thickness: Any, helix_angle: Any, reference_diameter: Any) -> Any:
    """Normal thickness of the tooth at its tip; ``half_thickness`` is half of it as an angle."""
    helix_at_tip = np.arctan(np.tan(helix_angle) * tip_diameter / reference_diameter)
    return tip_diameter * half_thickness * np.cos(helix_at_tip)


# --- pitting ---------------------------------------------------------------------------------------------------------


@formula
def single_contact(
    working_angle: Any, tip_angle: Any, teeth: Any, tip_angle_mate: Any, teeth_mate: Any, contact_ratio: Any
) -> Any:
    """M: flank pressure at the gear's inner point of single contact, to that at the pitch point, for spur teeth."""
    own = np.tan(tip_angle) - 2 * as_number(pi) / teeth
    mate = np.tan(tip_angle_mate) - (contact_ratio - 1) * 2 * as_number(pi) / teeth_mate
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
def half_tip_width(dedendum: Any, pressure_angle: Any, root_radius: Any) -> Any:
    """E: distance of the rack's rounding centre from the middle of its tooth."""
    beside = dedendum * np.tan(pressure_angle) + (1 - np.sin(pressure_angle)) * root_radius / np.cos(pressure_angle)
    return as_number(pi) / 4 - beside


@formula
def root_chord(virtual_teeth: Any, theta: Any, center_height: Any, root_radius: Any) -> Any:
    """Chord of the root at the critical section, where tangents at 30° touch it."""
    return virtual_teeth * np.sin(pi / 3 - theta) + np.sqrt(number(3)) * (center_height / np.cos(theta) - root_radius)


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
    there = at_tip - as_number(pi) * np.cos(pressure_angle) * (virtual_contact_ratio - 1)
    return 2 * np.sqrt(there**2 + base**2 / 4)


@formula
def load_arm(
    half_thickness: Any, load_angle: Any, diameter: Any, virtual_teeth: Any, theta: Any, center_height: Any, root_radius: Any
) -> Any:  # fmt: skip
    """Arm of the load about the critical section: from where its line crosses the tooth's centre line."""
    crossing = (np.cos(half_thickness) - np.sin(half_thickness) * np.tan(load_angle)) * diameter
    section = virtual_teeth * np.cos(pi / 3 - theta) + center_height / np.cos(theta) - root_radius
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
def worse_notch(notch_parameter_1: Any, notch_parameter_2: Any) -> Any:
    """The parameter of the two that leaves the range 1 … 8, or comes nearest to its end."""
    least = np.minimum(notch_parameter_1, notch_parameter_2)
    return np.where(least < 1, least, np.maximum(notch_parameter_1, notch_parameter_2))


# --- load factors (ISO 6336-1:2019) ----------------------------------------------------------------------------------


@formula
def dynamic_factor(line_load: Any, k_1: Any, k_2: Any, speed_parameter: Any) -> Any:
    """Dynamic factor by method C, below the resonance."""
    speed = speed_parameter / METRE_PER_SECOND
    slope = np.where(speed <= 0.2, 2, 2.071 - 0.357 * speed)
    return 1 + (k_1 / np.maximum(line_load, 100 * LINE_LOAD) + k_2) * speed * slope


@formula
def of_overlap(spur: Any, helical: Any, overlap_ratio: Any) -> Any:
    """Between what holds for spur teeth and, from an overlap ratio of 1 on, for helical teeth."""
    return spur - np.minimum(overlap_ratio, 1) * (spur - helical)


@formula
def tooth_compliance(teeth_1: Any, teeth_2: Any, shift_1: Any, shift_2: Any) -> Any:
    """Compliance q′ of a pair of teeth of steel, theoretical, by the teeth of the virtual gears."""
    series = (
        0.04723 + 0.15551 / teeth_1 + 0.25791 / teeth_2 - 0.00635 * shift_1 - 0.11654 * shift_1 / teeth_1 - 0.00193 * shift_2
        - 0.24188 * shift_2 / teeth_2 + 0.00529 * shift_1**2 + 0.00182 * shift_2**2
    )  # fmt: skip
    return series / STIFFNESS


@formula
def tooth_stiffness(
    compliance: Any, dedendum: Any, pressure_angle: Any, helix_angle: Any, elastic_modulus_1: Any, elastic_modulus_2: Any
) -> Any:  # fmt: skip
    """Stiffness c′ of a pair of teeth of solid gears under a line load from 100 N/mm on."""
    rack = (1 + (1.2 - dedendum) / 2) * (1 - 0.02 * as_number(pi / 9 - pressure_angle) * 180 / as_number(pi))
    modulus = 2 * elastic_modulus_1 * elastic_modulus_2 / (elastic_modulus_1 + elastic_modulus_2)
    return 0.8 / compliance * rack * np.cos(helix_angle) * modulus / STEEL


@formula
def mesh_stiffness(stiffness: Any, contact_ratio: Any, line_load: Any) -> Any:
    """Mean stiffness c_γα of all teeth in mesh."""
    low_load = np.minimum(line_load / (100 * LINE_LOAD), 1) ** 0.25
    return stiffness * low_load * (0.75 * contact_ratio + 0.25)


@formula
def helix_deviation(diameter: Any, face_width: Any, grade_step: Any) -> Any:
    """Permissible helix slope deviation f_Hβ (ISO 1328-1:2013)."""
    size = 0.05 * np.sqrt(diameter / MILLIMETRE) + 0.35 * np.sqrt(face_width / MILLIMETRE) + 4
    return size * grade_step * MICROMETRE


@formula
def run_in_deviation(deviation: Any, velocity: Any, slow: Any, fast: Any) -> Any:
    """The part of a deviation that running in reduces in proportion: all of it at low speed."""
    reached = np.where(velocity <= fast, MIDDLE_DEVIATION, SMALL_DEVIATION)
    return np.where(velocity <= slow, deviation, np.minimum(deviation, reached))


@formula
def misalignment(bending: Any, manufacture: Any, crowning: Any, line_load: Any, deviation_1: Any, deviation_2: Any) -> Any:  # fmt: skip
    """Equivalent misalignment F_βx before running in."""
    least = np.maximum(0.005 * line_load / LINE_LOAD * MICROMETRE, np.maximum(deviation_1, deviation_2) / 2)
    return np.maximum(crowning * (1.33 * bending + manufacture), least)


@formula
def transverse_factor(contact_ratio_total: Any, stiffness: Any, deviation: Any, line_load: Any) -> Any:
    """Transverse load factor of method B, before its limits."""
    share = 0.4 * stiffness * deviation / line_load
    many = np.sqrt(2 * (contact_ratio_total - 1) / contact_ratio_total)
    return np.where(contact_ratio_total <= 2, contact_ratio_total / 2 * (0.9 + share), 0.9 + share * many)


@formula
def limited_for_flank(factor: Any, contact_ratio: Any, overlap_ratio: Any, contact_ratio_total: Any) -> Any:
    """K_Hα: at least 1, at most what a single pair of teeth carries."""
    limit = contact_ratio_total / (contact_ratio * contact_ratio_factor(contact_ratio, overlap_ratio) ** 2)
    return np.maximum(np.minimum(factor, limit), 1)
