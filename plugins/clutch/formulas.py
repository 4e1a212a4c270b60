"""Formulas of the friction clutch: forces of the wedge, lining, travel, heat and temperature."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula


@formula
def slip_time(driven_inertia: Any, speed: Any, accelerating_torque: Any) -> Any:
    """Time until the driven side runs with the driving shaft."""
    return driven_inertia * as_number(speed) / accelerating_torque


@formula
def heat_flux(design_torque: Any, speed: Any, shoe_radius: Any, lining_width: Any) -> Any:
    """Heat flux into the drum's swept surface as slipping begins."""
    return design_torque * speed / (2 * np.pi * shoe_radius * lining_width)


@formula
def surface_rise(heat_flux: Any, slip_time: Any, conductivity: Any, density: Any, specific_heat: Any) -> Any:
    """Greatest rise of a thick body's surface under a flux that falls evenly to zero; it is reached at half the time."""
    return 4 / 3 * heat_flux * np.sqrt(slip_time / (2 * as_number(np.pi) * conductivity * density * specific_heat))


@formula
def penetration_depth(slip_time: Any, conductivity: Any, density: Any, specific_heat: Any) -> Any:
    """Depth that the heat reaches while the clutch slips."""
    return 2 * np.sqrt(conductivity * slip_time / (density * specific_heat))
