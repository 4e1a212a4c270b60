"""Formulas of the modified motion laws, which join sine waves and straight lines; ``motion_laws`` names and registers them."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.expressions import as_number, formula


@formula
def quick_wave(k: Any) -> Any:
    """Position that a sine wave of the acceleration, four half waves over the rise, gives from rest."""
    return k - np.sin(4 * np.pi * k) / as_number(4 * np.pi)


@formula
def quick_rate(k: Any) -> Any:
    """Velocity of the same wave."""
    return 1 - np.cos(4 * np.pi * k)


@formula
def slow_angle(k: Any) -> Any:
    """Phase of the modified sine's slow wave."""
    return np.pi / 3 + 4 * np.pi * k / 3


@formula
def sine_position(k: Any) -> Any:
    """Position of the modified sine."""
    pi = as_number(np.pi)
    factor = pi / (4 + pi)
    middle = factor * (2 / pi + k - 9 / (4 * pi) * np.sin(slow_angle(k)))
    end = factor * (4 / pi + quick_wave(k))
    return np.where(k < 1 / 8, factor * quick_wave(k), np.where(k <= 7 / 8, middle, end))


@formula
def sine_velocity(k: Any) -> Any:
    """Velocity of the modified sine."""
    pi = as_number(np.pi)
    factor = pi / (4 + pi)
    middle = factor * (1 - 3 * np.cos(slow_angle(k)))
    return np.where((k < 1 / 8) | (k > 7 / 8), factor * quick_rate(k), middle)


@formula
def sine_acceleration(k: Any) -> Any:
    """Acceleration of the modified sine: a quick quarter wave, a slow half wave, a quick quarter wave."""
    pi = as_number(np.pi)
    peak = 4 * pi**2 / (4 + pi)
    return np.where((k < 1 / 8) | (k > 7 / 8), peak * np.sin(4 * np.pi * k), peak * np.sin(slow_angle(k)))


@formula
def sine_jerk(k: Any) -> Any:
    """Jerk of the modified sine."""
    pi = as_number(np.pi)
    peak = 16 * pi**3 / (4 + pi)
    return np.where((k < 1 / 8) | (k > 7 / 8), peak * np.cos(4 * np.pi * k), peak / 3 * np.cos(slow_angle(k)))


@formula
def sine_joint(k: Any) -> Any:
    """Changes its sign where the quick and the slow wave meet."""
    return (k - 1 / 8) * (k - 7 / 8)


@formula
def sine_peak_velocity() -> Any:
    """Peak velocity of the modified sine, in the middle."""
    pi = as_number(np.pi)
    return 4 * pi / (4 + pi)


@formula
def sine_peak_acceleration() -> Any:
    """Peak acceleration of the modified sine, where its waves meet."""
    pi = as_number(np.pi)
    return 4 * pi**2 / (4 + pi)


@formula
def trapezoidal_position(k: Any) -> Any:
    """Position of the modified trapezoidal law."""
    pi = as_number(np.pi)
    factor = 2 / (2 + pi)
    rising = factor * (k - 1 / (4 * pi) + 2 * pi * (k - 1 / 8) ** 2)
    middle = 1 / 2 + factor * ((1 + pi) * (k - 1 / 2) + np.sin(4 * np.pi * k) / (4 * pi))
    falling = 1 - factor * (1 - k - 1 / (4 * pi) + 2 * pi * (7 / 8 - k) ** 2)
    later = np.where(k <= 7 / 8, falling, 1 - factor * quick_wave(1 - k))
    half = np.where(k <= 5 / 8, middle, later)
    return np.where(k < 1 / 8, factor * quick_wave(k), np.where(k < 3 / 8, rising, half))


@formula
def trapezoidal_velocity(k: Any) -> Any:
    """Velocity of the modified trapezoidal law."""
    pi = as_number(np.pi)
    factor = 2 / (2 + pi)
    rising = factor * (1 + 4 * pi * (k - 1 / 8))
    middle = factor * (1 + pi + np.cos(4 * np.pi * k))
    falling = factor * (1 + 4 * pi * (7 / 8 - k))
    inside = np.where(k < 3 / 8, rising, np.where(k <= 5 / 8, middle, falling))
    return np.where((k < 1 / 8) | (k > 7 / 8), factor * quick_rate(k), inside)


@formula
def trapezoidal_acceleration(k: Any) -> Any:
    """Acceleration of the modified trapezoidal law: quarter waves between stretches of constant acceleration."""
    pi = as_number(np.pi)
    peak = 8 * pi / (2 + pi)
    middle = np.where(k <= 5 / 8, -peak * np.sin(4 * np.pi * k), -peak)
    inside = np.where(k < 3 / 8, peak, middle)
    return np.where((k < 1 / 8) | (k > 7 / 8), peak * np.sin(4 * np.pi * k), inside)


@formula
def trapezoidal_jerk(k: Any) -> Any:
    """Jerk of the modified trapezoidal law."""
    pi = as_number(np.pi)
    peak = 32 * pi**2 / (2 + pi)
    middle = np.where((k < 3 / 8) | (k > 5 / 8), 0, -peak * np.cos(4 * np.pi * k))
    return np.where((k < 1 / 8) | (k > 7 / 8), peak * np.cos(4 * np.pi * k), middle)


@formula
def trapezoidal_joint(k: Any) -> Any:
    """Changes its sign where waves and straight lines meet."""
    return (k - 1 / 8) * (k - 3 / 8) * (k - 5 / 8) * (k - 7 / 8)


@formula
def trapezoidal_peak_velocity() -> Any:
    """Peak velocity of the modified trapezoidal law, in the middle."""
    return 2


@formula
def trapezoidal_peak_acceleration() -> Any:
    """Peak acceleration of the modified trapezoidal law."""
    pi = as_number(np.pi)
    return 8 * pi / (2 + pi)
