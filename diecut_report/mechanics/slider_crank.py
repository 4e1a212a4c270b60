"""Full-turn kinematics of the central slider-crank: exact, and to the first order of crank radius to rod length.

Two ways to count stand side by side, as the sources use them. Formulas named ``…`` count the crank angle from the extended
dead centre (crank and rod in line, the slider farthest from the shaft) and take the rod's length relative to the crank,
λ = l/r; formulas named ``inner_…`` count it from the inner dead centre (the rod folded over the crank, the slider nearest to
the shaft) and take the crank's length relative to the rod, λ = r/l. Displacements are distances from that dead centre, so
that they, the speed after it and the acceleration at it are positive. The crank's angular speed is constant.
Formulas named ``…_first_order`` keep the terms of first order in r/l, as textbooks and the papers do.
All take numbers or arrays.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.formula import formula


@formula
def coupler_angle(crank_angle: Any, rod_ratio: Any) -> Any:
    """β, angle of the rod to the slider's path (rod ratio λ = l/r)."""
    return np.arcsin(np.sin(crank_angle) / rod_ratio)


@formula
def coupler_angle_speed(crank_angle: Any, coupler_angle: Any, rod_ratio: Any) -> Any:
    """dβ/dφ, angular speed of the rod relative to the crank's (rod ratio λ = l/r)."""
    return np.cos(crank_angle) / (rod_ratio * np.cos(coupler_angle))


@formula
def displacement(crank_angle: Any, coupler_angle: Any, crank_radius: Any, rod_ratio: Any) -> Any:
    """S, distance of the slider from its extended dead centre."""
    return crank_radius * (1 + rod_ratio - np.cos(crank_angle) - rod_ratio * np.cos(coupler_angle))


@formula
def velocity(crank_angle: Any, coupler_angle: Any, crank_radius: Any, crank_speed: Any) -> Any:
    """V, speed of the slider away from its extended dead centre."""
    return crank_radius * crank_speed * (np.sin(crank_angle) + np.cos(crank_angle) * np.tan(coupler_angle))


@formula
def acceleration(crank_angle: Any, coupler_angle: Any, crank_radius: Any, rod_ratio: Any, crank_speed: Any) -> Any:
    """W, acceleration of the slider away from its extended dead centre."""
    swing = np.cos(crank_angle) ** 2 / (rod_ratio * np.cos(coupler_angle) ** 3)
    rise = np.cos(crank_angle) + swing - np.sin(crank_angle) * np.tan(coupler_angle)
    return crank_radius * crank_speed**2 * rise


@formula
def displacement_first_order(crank_angle: Any, crank_radius: Any, rod_ratio: Any) -> Any:
    """S to the first order of 1/λ."""
    return crank_radius * (1 - np.cos(crank_angle) + np.sin(crank_angle) ** 2 / (2 * rod_ratio))


@formula
def velocity_first_order(crank_angle: Any, crank_radius: Any, rod_ratio: Any, crank_speed: Any) -> Any:
    """V to the first order of 1/λ."""
    return crank_radius * crank_speed * (np.sin(crank_angle) + np.sin(2 * crank_angle) / (2 * rod_ratio))


@formula
def acceleration_first_order(crank_angle: Any, crank_radius: Any, rod_ratio: Any, crank_speed: Any) -> Any:
    """W to the first order of 1/λ."""
    return crank_radius * crank_speed**2 * (np.cos(crank_angle) + np.cos(2 * crank_angle) / rod_ratio)


@formula
def crank_angle_at(displacement: Any, crank_radius: Any, rod_length: Any) -> Any:
    """Crank angle from the extended dead centre at which the slider is at a distance from it, in [0, π]."""
    u = displacement
    left = 2 * crank_radius - u
    return 2 * np.arctan2(np.sqrt(u * (2 * rod_length - u)), np.sqrt(left * (2 * rod_length + left)))


@formula
def inner_coupler_angle(crank_angle: Any, crank_ratio: Any) -> Any:
    """β, angle of the rod to the slider's path (crank ratio λ = r/l)."""
    return np.arcsin(crank_ratio * np.sin(crank_angle))


@formula
def inner_coupler_angle_speed(crank_angle: Any, coupler_angle: Any, crank_ratio: Any) -> Any:
    """dβ/dφ, angular speed of the rod relative to the crank's (crank ratio λ = r/l)."""
    return crank_ratio * np.cos(crank_angle) / np.cos(coupler_angle)


@formula
def inner_displacement(crank_angle: Any, coupler_angle: Any, crank_radius: Any, rod_length: Any) -> Any:
    """u, distance of the slider from its inner dead centre."""
    return crank_radius * (1 - np.cos(crank_angle)) - rod_length * (1 - np.cos(coupler_angle))


@formula
def inner_arm(crank_angle: Any, coupler_angle: Any, crank_radius: Any) -> Any:
    """V/ω, travel of the slider for each radian of the crank: the arm of its force about the shaft."""
    return crank_radius * (np.sin(crank_angle) - np.cos(crank_angle) * np.tan(coupler_angle))


@formula
def inner_velocity(crank_angle: Any, coupler_angle: Any, crank_radius: Any, crank_speed: Any) -> Any:
    """V, speed of the slider away from its inner dead centre."""
    return crank_speed * inner_arm(crank_angle, coupler_angle, crank_radius)


@formula
def inner_acceleration(
    crank_angle: Any, coupler_angle: Any, crank_radius: Any, crank_ratio: Any, crank_speed: Any
) -> Any:
    """W, acceleration of the slider away from its inner dead centre."""
    swing = crank_ratio * np.cos(crank_angle) ** 2 / np.cos(coupler_angle) ** 3
    rise = np.cos(crank_angle) - swing + np.sin(crank_angle) * np.tan(coupler_angle)
    return crank_radius * crank_speed**2 * rise


@formula
def inner_arm_first_order(crank_angle: Any, crank_radius: Any, crank_ratio: Any) -> Any:
    """V/ω to the first order of λ."""
    return crank_radius * (np.sin(crank_angle) - crank_ratio / 2 * np.sin(2 * crank_angle))


@formula
def inner_velocity_first_order(crank_angle: Any, crank_radius: Any, crank_ratio: Any, crank_speed: Any) -> Any:
    """V to the first order of λ."""
    return crank_speed * inner_arm_first_order(crank_angle, crank_radius, crank_ratio)


@formula
def inner_crank_angle_at(displacement: Any, crank_radius: Any, rod_length: Any) -> Any:
    """Crank angle from the inner dead centre at which the slider is at a distance from it, in [0, π]."""
    u = displacement
    left = 2 * crank_radius - u
    return 2 * np.arctan2(np.sqrt(u * (2 * rod_length + u)), np.sqrt(left * (2 * rod_length - left)))
