"""What joins two shafts: ratio, pitch radii, distance of the axes, travel of a chain."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.formula import formula
from diecut_report.formulas.tree import as_number


@formula
def speed_ratio(driving: Any, driven: Any) -> Any:
    """Speed of the driven part for each of the driving one, by their teeth or diameters."""
    return driving / driven


@formula
def reference_diameter(module: Any, teeth: Any, helix_angle: Any) -> Any:
    """Diameter of the reference circle of a gear (ISO 21771)."""
    return module * teeth / np.cos(helix_angle)


@formula
def pitch_radius(module: Any, teeth: Any, helix_angle: Any) -> Any:
    """Pitch radius of a gear without profile shift."""
    return reference_diameter(module, teeth, helix_angle) / 2


@formula
def center_distance(radius_1: Any, radius_2: Any) -> Any:
    """Distance of the axes of two gears in mesh."""
    return radius_1 + radius_2


@formula
def sprocket_diameter(pitch: Any, teeth: Any) -> Any:
    """Pitch diameter of a sprocket: the circle through the joints of the chain on it."""
    return pitch / np.sin(np.pi / teeth)


@formula
def chain_travel(teeth: Any, pitch: Any) -> Any:
    """Travel of a chain per radian of its sprocket."""
    return teeth * pitch / (2 * as_number(np.pi))
