"""A driven link on an elastic, damped drive: the inertia I follows the input y through the stiffness K and the damping C.

I·ẍ = K·(y − x) + C·(ẏ − ẋ) with x = y and ẋ = ẏ = 0 at the start, 0 ≤ ζ < 1. The deflection of the drive z = x − y then obeys
z̈ + 2ζω·ż + ω²·z = −ÿ, solved by Duhamel's integral; it is taken apart into two running integrals from the start to the time t,
of ``in_phase_part`` and of ``quadrature_part``, from which ``deflection`` and ``deflection_velocity`` follow. They hold
e^(ζωt), which a number can hold up to ζωt = 700: ``follower_peaks`` goes further, and needs no running integrals.

Formulas take numbers or arrays, and hold as well for a straight movement: the inertia is a mass then, the torque a force.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.expressions import as_angle, as_number, formula


@formula
def natural_angular_frequency(stiffness: Any, inertia: Any) -> Any:
    """ω, angular frequency at which the link would swing without damping."""
    return as_angle(np.sqrt(stiffness / inertia))


@formula
def damped_angular_frequency(angular_frequency: Any, damping_ratio: Any) -> Any:
    """ω_d, angular frequency at which the damped link swings."""
    return angular_frequency * np.sqrt(1 - damping_ratio**2)


@formula
def damping_constant(damping_ratio: Any, inertia: Any, angular_frequency: Any) -> Any:
    """C, torque of the damping for each unit of the speed of deflection."""
    return 2 * damping_ratio * inertia * as_number(angular_frequency)


@formula
def tuning_ratio(angular_frequency: Any, rise_time: Any) -> Any:
    """λ, number of natural periods within the rise."""
    return angular_frequency * rise_time / (2 * np.pi)


@formula
def decay(time: Any, angular_frequency: Any, damping_ratio: Any) -> Any:
    """E, share of a vibration that is left after a time."""
    return np.exp(-damping_ratio * as_number(angular_frequency) * time)


@formula
def phase(time: Any, damped_frequency: Any) -> Any:
    """ψ, phase of the damped vibration."""
    return damped_frequency * time


@formula
def in_phase_part(decay: Any, phase: Any, input_acceleration: Any) -> Any:
    """What the running integral C(t) adds up."""
    return np.cos(phase) * input_acceleration / decay


@formula
def quadrature_part(decay: Any, phase: Any, input_acceleration: Any) -> Any:
    """What the running integral S(t) adds up, a quarter period behind C(t)."""
    return np.sin(phase) * input_acceleration / decay


@formula
def deflection(decay: Any, phase: Any, damped_frequency: Any, in_phase: Any, quadrature: Any) -> Any:
    """z = x − y, by which the link is ahead of the input."""
    return decay / as_number(damped_frequency) * (np.cos(phase) * quadrature - np.sin(phase) * in_phase)


@formula
def swing_speed(decay: Any, phase: Any, in_phase: Any, quadrature: Any) -> Any:
    """The part of the deflection's speed that the phase's growth gives."""
    return -decay * (np.cos(phase) * in_phase + np.sin(phase) * quadrature)


@formula
def deflection_velocity(swing_speed: Any, angular_frequency: Any, damping_ratio: Any, deflection: Any) -> Any:
    """ż, speed at which the deflection grows."""
    return swing_speed - damping_ratio * as_number(angular_frequency) * deflection


@formula
def response_acceleration(angular_frequency: Any, damping_ratio: Any, deflection: Any, deflection_velocity: Any) -> Any:
    """ẍ, acceleration of the driven link."""
    omega = as_number(angular_frequency)
    return -2 * damping_ratio * omega * deflection_velocity - omega**2 * deflection


@formula
def drive_torque(stiffness: Any, damping_constant: Any, deflection: Any, deflection_velocity: Any) -> Any:
    """Torque of the elastic drive on the link, which speeds it up."""
    return -stiffness * deflection - damping_constant * deflection_velocity
