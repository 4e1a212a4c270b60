"""Formulas of the rubber damper: energy, size, stop, buckling, and the stop against a drive that still pushes."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Constant, as_angle, as_number, formula
from diecut_report.mechanics.common import rounded_up

GENT = Constant(98_100.0, "p_G", "Pa")
USUAL_LOSS = 0.2
SLENDEREST = 3.0  # length over smaller side up to which a block with clamped ends does not buckle


@formula
def gent_modulus(shore_hardness: Any) -> Any:
    """Elastic modulus of rubber from its Shore A hardness."""
    return GENT * (56 + 7.62336 * shore_hardness) / (0.137505 * (254 - 2.54 * shore_hardness))


@formula
def kinetic_energy(
    mass: Any,
    inertia: Any,
    rolling_radius: Any,
    velocity: Any,
    carriage_mass: Any,
    static_unbalance: Any,
    contact_distance: Any,
) -> Any:
    """Energy of a rolling cylinder whose centre of mass lies away from the die at the end of its travel, and of what moves with its axis."""
    unbalance = 2 * static_unbalance * np.cos(as_angle(contact_distance / rolling_radius)) / rolling_radius
    return (carriage_mass + mass + inertia / rolling_radius**2 + unbalance) * velocity**2 / 2


@formula
def whole_steps_above(length: Any, length_step: Any) -> Any:
    """The next multiple of the step, at least one."""
    return np.maximum(rounded_up(length, length_step), length_step)


@formula
def stress(kinetic_energy: Any, elastic_modulus: Any, damper_count: Any, area: Any, adopted_length: Any) -> Any:
    """Greatest compression stress while the dampers take up the energy."""
    return np.sqrt(2 * kinetic_energy * elastic_modulus / (damper_count * area * adopted_length))


@formula
def stiffness_borne(
    kinetic_energy: Any, modulus: Any, damper_count: Any, area: Any, adopted_length: Any, allowable_stress: Any
) -> Any:
    """How much stiffer than at rest the rubber may be, so that the stress does not exceed the allowable one."""
    return damper_count * area * adopted_length * allowable_stress**2 / (2 * kinetic_energy * modulus)


@formula
def reduced_mass(kinetic_energy: Any, velocity: Any) -> Any:
    """Mass that has the energy at the speed."""
    return 2 * kinetic_energy / velocity**2


@formula
def half_the_sheets(productivity: Any) -> Any:
    """Impacts at one end of the travel: there and back are two sheets."""
    return productivity / 2


@formula
def three_sides(side: Any) -> Any:
    """Length up to which a block with clamped ends does not buckle."""
    return 3 * side


@formula
def stiffness(damper_count: Any, area: Any, elastic_modulus: Any, adopted_length: Any) -> Any:
    """Stiffness of all dampers together."""
    return damper_count * area * elastic_modulus / adopted_length


@formula
def driven_stop_time(reduced_mass: Any, stiffness: Any, driving_force: Any, velocity: Any) -> Any:
    """Time from contact to rest of a mass on a spring with a constant force behind it."""
    late = np.arctan(driving_force / (velocity * np.sqrt(stiffness * reduced_mass)))
    return np.sqrt(reduced_mass / stiffness) * as_number(np.pi / 2 + late)


@formula
def stress_limit(allowable_stress: Any, elastic_modulus: Any, max_strain: Any) -> Any:
    """Stress that is allowed and strains the rubber within its linear law."""
    return np.minimum(allowable_stress, elastic_modulus * max_strain)


@formula
def driven_length(
    kinetic_energy: Any, elastic_modulus: Any, stress_limit: Any, damper_count: Any, area: Any, driving_force: Any
) -> Any:
    """Length at which the dampers take up energy and work of the drive with a stress."""
    borne = damper_count * area * stress_limit - 2 * driving_force
    return 2 * kinetic_energy * elastic_modulus / (stress_limit * borne)


@formula
def driven_count(
    kinetic_energy: Any, elastic_modulus: Any, driving_force: Any, stress_limit: Any, adopted_length: Any, area: Any
) -> Any:
    """Dampers of this pad and length that take up energy and work of the drive with a stress."""
    demanded = 2 * (kinetic_energy * elastic_modulus + driving_force * stress_limit * adopted_length)
    return np.ceil(demanded / (area * stress_limit**2 * adopted_length) - 1e-9)
