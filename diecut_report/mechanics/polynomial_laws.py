"""Formulas of the motion laws that are polynomials of k; ``motion_laws`` names and registers them."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.expressions import formula


@formula
def parabolic_position(k: Any) -> Any:
    """Position: two parabolas."""
    return np.where(k < 1 / 2, 2 * k**2, 1 - 2 * (1 - k) ** 2)


@formula
def parabolic_velocity(k: Any) -> Any:
    """Velocity: up and down in straight lines."""
    return np.where(k < 1 / 2, 4 * k, 4 * (1 - k))


@formula
def parabolic_acceleration(k: Any) -> Any:
    """Acceleration, which jumps at both ends and in the middle."""
    return np.where(k < 1 / 2, 4, -4)


@formula
def parabolic_jerk(k: Any) -> Any:
    """Jerk: nothing but impulses, which are left out."""
    return 0 * k


@formula
def parabolic_joint(k: Any) -> Any:
    """Changes its sign in the middle."""
    return k - 1 / 2


@formula
def parabolic_peak_velocity() -> Any:
    """Peak velocity, in the middle."""
    return 2


@formula
def parabolic_peak_acceleration() -> Any:
    """Peak acceleration, all the time."""
    return 4


@formula
def fifth_position(k: Any) -> Any:
    """Position of the polynomial 3-4-5."""
    return 10 * k**3 - 15 * k**4 + 6 * k**5


@formula
def fifth_velocity(k: Any) -> Any:
    """Velocity of the polynomial 3-4-5."""
    return 30 * k**2 * (1 - k) ** 2


@formula
def fifth_acceleration(k: Any) -> Any:
    """Acceleration of the polynomial 3-4-5."""
    return 60 * k * (1 - k) * (1 - 2 * k)


@formula
def fifth_jerk(k: Any) -> Any:
    """Jerk of the polynomial 3-4-5."""
    return 60 * (1 - 6 * k + 6 * k**2)


@formula
def fifth_peak_velocity() -> Any:
    """Peak velocity, in the middle."""
    return 15 / 8


@formula
def fifth_peak_acceleration() -> Any:
    """Peak acceleration, where 6k(1 − k) = 1."""
    return 10 / np.sqrt(3)


@formula
def seventh_position(k: Any) -> Any:
    """Position of the polynomial 4-5-6-7."""
    return 35 * k**4 - 84 * k**5 + 70 * k**6 - 20 * k**7


@formula
def seventh_velocity(k: Any) -> Any:
    """Velocity of the polynomial 4-5-6-7."""
    return 140 * k**3 * (1 - k) ** 3


@formula
def seventh_acceleration(k: Any) -> Any:
    """Acceleration of the polynomial 4-5-6-7."""
    return 420 * k**2 * (1 - k) ** 2 * (1 - 2 * k)


@formula
def seventh_jerk(k: Any) -> Any:
    """Jerk of the polynomial 4-5-6-7."""
    return 840 * k * (1 - k) * (1 - 5 * k + 5 * k**2)


@formula
def seventh_peak_velocity() -> Any:
    """Peak velocity, in the middle."""
    return 35 / 16


@formula
def seventh_peak_acceleration() -> Any:
    """Peak acceleration, where 5k(1 − k) = 1."""
    return 84 / (5 * np.sqrt(5))
