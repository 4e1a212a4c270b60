"""What joins two shafts: ratio, pitch radii, distance of the axes by teeth or by the links of a chain, travel of a chain."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.expression import as_number, pi
from diecut_report.formulas.formula import formula


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
    return pitch / np.sin(pi / teeth)


@formula
def chain_travel(teeth: Any, pitch: Any) -> Any:
    """Travel of a chain per radian of its sprocket."""
    return teeth * pitch / (2 * as_number(pi))


@formula
def free_links(links: Any, teeth_1: Any, teeth_2: Any) -> Any:
    """Links that are not on the sprockets."""
    return links - (teeth_1 + teeth_2) / 2


@formula
def links_discriminant(free: Any, teeth_1: Any, teeth_2: Any) -> Any:
    """What must be above zero for the chain to go round both sprockets."""
    return free**2 - 8 * ((teeth_2 - teeth_1) / (2 * as_number(pi))) ** 2


@formula
def chain_center_distance(pitch: Any, free: Any, root_of: Any) -> Any:
    """Distance of the axes of two sprockets at which whole links fit."""
    return pitch / 4 * (free + np.sqrt(root_of))


@formula
def root_diameter(diameter: Any, module: Any, dedendum: Any, shift: Any) -> Any:
    """Root diameter of a gear, of its reference circle (ISO 21771)."""
    return diameter - 2 * module * (dedendum - shift)
