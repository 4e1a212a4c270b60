"""Formulas of the motor, the flywheel and the run-up."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula


@formula
def peak_at_motor(torque_peak: Any, gear_ratio: Any, belt_ratio: Any, efficiency: Any) -> Any:
    """A torque of the output at the motor's shaft, losses included."""
    return torque_peak / (gear_ratio * belt_ratio * efficiency)


@formula
def inertia(energy: Any, speed_fluctuation: Any, speed: Any) -> Any:
    """Moment of inertia that keeps the fluctuation of the speed."""
    return energy / (speed_fluctuation * speed**2)


@formula
def disc_diameter(inertia: Any, density: Any) -> Any:
    """Diameter of a disc a fifth as wide."""
    return (160 * inertia / (np.pi * density)) ** (1 / 5)


@formula
def disc_width(diameter: Any) -> Any:
    """Width of the disc."""
    return diameter / 5


@formula
def disc_mass(density: Any, diameter: Any, width: Any) -> Any:
    """Mass of the disc."""
    return density * as_number(np.pi) * diameter**2 / 4 * width


@formula
def inertia_before(own: Any, behind: Any, ratio: Any, efficiency: Any) -> Any:
    """Inertia that a shaft feels: its own, and what turns slower behind a ratio, with the losses between."""
    return own + behind / (ratio**2 * efficiency)


@formula
def referred(behind: Any, ratio: Any, efficiency: Any) -> Any:
    """Inertia that a shaft feels of what turns slower behind a ratio, with the losses between."""
    return behind / (ratio**2 * efficiency)


@formula
def run_up_time(inertia: Any, speed: Any, accelerating_torque: Any) -> Any:
    """Time in which a constant torque brings the inertia to its speed."""
    return inertia * as_number(speed) / accelerating_torque


@formula
def accelerates(accelerating_torque: Any, inertia: Any) -> Any:
    """Whether there is an inertia, and the motor's torque is above the load."""
    return (accelerating_torque > 0) & (inertia > 0)
