"""Formulas of the parallel key (in the manner of DIN 6892, method C): each is bound to shaft, hub and key, and to both torques."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def key_force(torque: Any, shaft_diameter: Any, key_count: Any, key_share: Any) -> Any:
    """Force on the worst loaded key."""
    return 2 * torque / (shaft_diameter * key_count * key_share)


@formula
def pressure(force: Any, height: Any, length: Any) -> Any:
    """Mean pressure on the height that bears."""
    return force / (height * length)


@formula
def allowed_pressure(factor: Any, strength: Any) -> Any:
    """Pressure that a part may take: nine tenths of its strength, with the factor of its load."""
    return factor * 0.9 * strength


@formula
def length_for(force: Any, height: Any, allowed: Any) -> Any:
    """Bearing length at which the pressure is the allowed one."""
    return force / (height * allowed)


@formula
def least_of_six(shaft: Any, hub: Any, key: Any, shaft_peak: Any, hub_peak: Any, key_peak: Any) -> Any:
    """The least of three parts under two loads."""
    return np.minimum(np.minimum(np.minimum(shaft, hub), key), np.minimum(np.minimum(shaft_peak, hub_peak), key_peak))


@formula
def greatest_of_six(shaft: Any, hub: Any, key: Any, shaft_peak: Any, hub_peak: Any, key_peak: Any) -> Any:
    """The greatest of three parts under two loads."""
    return np.maximum(np.maximum(np.maximum(shaft, hub), key), np.maximum(np.maximum(shaft_peak, hub_peak), key_peak))
