"""Formulas of the parallel key (DIN 6892, method B): each is bound to shaft, hub and key, and to both torques."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def key_force(torque: Any, shaft_diameter: Any, key_count: Any, key_share: Any) -> Any:
    """Force on the worst loaded key."""
    return 2 * torque / (shaft_diameter * key_count * key_share)


@formula
def direction_factor(changes_of_flank: Any) -> Any:
    """Load direction factor by the changes of flank in the life (DIN 6892, method B)."""
    return np.minimum(1, 2 * np.maximum(changes_of_flank, 1) ** -0.1)
